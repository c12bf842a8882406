"""A still picture of a texture model: for pages where none can be drawn."""

from __future__ import annotations

from io import BytesIO

from ...render.texture.picture import png, texture_pixels
from ..shared.pictured import picture_html
from .model import TextureModel

__all__ = ["LARGEST", "SIDE", "described", "image", "still"]

LARGEST = 400_000
"""Bytes up to which a saved notebook carries a picture."""

SIDE = 360
"""Pixels of its width, and at most of its height."""

_EXACT, _QUALITY = 40_000, 85
"""Bytes up to which it stays as exact as a PNG is; how good the JPEG is of one that is larger."""


def still(model: TextureModel) -> bytes:
    """The façade straight on, in the light it is shown in, as PNG or as JPEG; empty without a grammar.

    Plain colours take less room in one, bricks in the other.
    """
    if model.grammar is None:
        return b""
    height = max(1, min(SIDE, round(SIDE * model.size[1] / model.size[0])))
    hour = model.hour if model.lit else None
    drawn = texture_pixels(model.grammar, size=model.size, seed=model.seed, pixels=(SIDE, height), hour=hour)
    exact = png(drawn)
    if len(exact) <= _EXACT or (drawn[..., 3] < 255).any():  # a JPEG has no holes
        return exact
    from PIL import Image

    out = BytesIO()
    Image.fromarray(drawn[..., :3]).save(out, "JPEG", quality=_QUALITY, optimize=True)
    return out.getvalue()


def described(model: TextureModel) -> str:
    """What the picture shows, in words."""
    return f"Façade of {model.size[0]:g} × {model.size[1]:g} m drawn by a texture grammar"


def image(model: TextureModel, data: bytes) -> str:
    """A picture as HTML; empty if there is none, or if it is too large for a notebook."""
    return picture_html(described(model), data if len(data) <= LARGEST else b"")
