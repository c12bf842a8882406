"""The deferred pipeline: meshes whose vertices carry a façade, and the passes that draw them."""

from .vertices import VERTEX

__all__ = ["VERTEX"]
