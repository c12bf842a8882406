"""A town as data: a plan from a seed or from real footprints, its façades' styles, and the mesh that carries them."""

from .stages import TownStopped
from .town import Town

__all__ = ["Town", "TownStopped"]
