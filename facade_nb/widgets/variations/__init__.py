"""The widget that shows many designs at once, and opens one of them in the studio."""

from .model import VariationsModel
from .view import VariationsView

__all__ = ["VariationsModel", "VariationsView"]
