"""A still picture of a texture model: for pages where none can be drawn."""

from __future__ import annotations

from ...render.texture.picture import png, texture_pixels
from ..shared.pictured import picture_html
from .model import TextureModel

__all__ = ["LARGEST", "SIDE", "described", "image", "still"]

LARGEST = 400_000
"""Bytes up to which a saved notebook carries a picture."""

SIDE = 360
"""Pixels of its width, and at most of its height."""


def still(model: TextureModel) -> bytes:
    """The façade straight on, in the light it is shown in, as PNG; empty without a grammar."""
    if model.grammar is None:
        return b""
    height = max(1, min(SIDE, round(SIDE * model.size[1] / model.size[0])))
    hour = model.hour if model.lit else None
    return png(
        texture_pixels(model.grammar, size=model.size, seed=model.seed, pixels=(SIDE, height), hour=hour)
    )


def described(model: TextureModel) -> str:
    """What the picture shows, in words."""
    return f"Façade of {model.size[0]:g} × {model.size[1]:g} m drawn by a texture grammar"


def image(model: TextureModel, data: bytes) -> str:
    """A picture as HTML; empty if there is none, or if it is too large for a notebook."""
    return picture_html(described(model), data if len(data) <= LARGEST else b"", "png")
