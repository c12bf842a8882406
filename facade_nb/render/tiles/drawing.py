"""From a recipe to its pictures: colour in the light of an overcast sky, normals, highlights."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

import numpy as np

from .canvas import Canvas, Floats
from .catalogue import CATALOGUE
from .images import evened
from .relief import Relief, normals, relief_of, sky_light

__all__ = ["draw", "relief"]


@lru_cache(maxsize=8)
def draw(name: str, size: int) -> Mapping[str, Floats]:
    """The pictures (size, size, 4) of a tile: ``color``, and those of `MAPS` that it has. Row 0 is at the top."""
    recipe, canvas = CATALOGUE[name], _drawn(name, size)
    facing = normals(canvas) if recipe.shade or "normal" in recipe.maps else None
    colour = canvas.colour
    if recipe.shade and facing is not None:
        sky = sky_light(canvas)
        # An overcast sky: brighter from above, and a little from the left as in drawings.
        turned = 1 + 0.24 * facing[..., 1] - 0.10 * facing[..., 0] - 0.3 * (1 - facing[..., 2])
        light = (0.3 + 0.7 * sky**0.9) * turned
        light = 1 + (light - 1) * (
            1 - 0.6 * np.clip(canvas.gloss - 0.6, 0, 0.4) / 0.4
        )  # glass shows what it mirrors
        colour = np.clip(colour * (1 + recipe.shade * (light - 1))[..., None], 0, 1)
    if recipe.even:
        colour = np.clip(evened(colour, recipe.even), 0, 1)
    pictures = {"color": np.concatenate([colour, canvas.alpha[..., None]], axis=-1)}
    if "normal" in recipe.maps and facing is not None:
        pictures["normal"] = np.concatenate([0.5 + 0.5 * facing, canvas.alpha[..., None]], axis=-1)
    if "specular" in recipe.maps:
        pictures["specular"] = np.concatenate(
            [np.repeat(canvas.gloss[..., None], 3, axis=-1), canvas.alpha[..., None]], axis=-1
        )
    finished = {key: np.clip(picture, 0, 1).astype(np.float32) for key, picture in pictures.items()}
    for picture in finished.values():
        picture.setflags(write=False)
    return MappingProxyType(finished)


def relief(name: str, size: int) -> Relief | None:
    """How deep the tile is, where; None if it is flat, or if nothing stands out of what it shows (no normal map)."""
    recipe = CATALOGUE[name]
    return relief_of(_drawn(name, size)) if recipe.relief and "normal" in recipe.maps else None


def _drawn(name: str, size: int) -> Canvas:
    recipe = CATALOGUE[name]
    canvas = Canvas(size, recipe.width, recipe.height, wrap=("x" in recipe.tiling, "y" in recipe.tiling))
    recipe.draw(canvas, recipe.seed)
    return canvas
