"""City models at LoD 3 as surveys: the openings in the plane of each wall (docs/surveys.md)."""

from .model import City, Facade
from .reading import city_of, looks_like_city

__all__ = ["City", "Facade", "city_of", "looks_like_city"]
