"""A small set of tiles for tests: of odd sizes, with and without alpha, drawn from a seed."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

__all__ = ["StandIn", "stand_in"]

_SIZES = {
    "wall1": (16, 16),
    "wall2": (9, 14),
    "wall3": (8, 8),
    "window1": (13, 11),
    "window2": (16, 5),
    "window3": (7, 7),
}


class StandIn:
    """Tiles as `facade_nb.render.texture.atlas.Atlas` asks for them."""

    def __init__(self) -> None:
        self._images: dict[str, NDArray[np.uint8]] = {}
        for k, (name, (height, width)) in enumerate(_SIZES.items()):
            image = np.random.Generator(np.random.PCG64(k)).integers(0, 256, (height, width, 4), np.uint8)
            if name != "window2":
                image[..., 3] = 255
            self._images[name] = image
        mask = np.zeros((12, 12, 4), np.uint8)
        mask[..., 3] = 255
        mask[2:9, 3:10, :3] = 255
        self._images["hole"] = mask
        disc = np.full((16, 16, 4), 255, np.uint8)
        y, x = np.mgrid[:16, :16] - 7.5
        disc[..., 3] = np.clip(255 * (6.5 - np.hypot(x, y)), 0, 255)
        self._images["disc"] = disc

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self._images)

    def image(self, name: str) -> NDArray[np.uint8]:
        """(h, w, 4), row 0 at the top."""
        return self._images[name]

    def mips(self, name: str) -> list[NDArray[np.float32]]:
        level = self._images[name].astype(np.float32) / 255
        levels = [level]
        while min(level.shape[:2]) >= 2:
            h, w = level.shape[0] // 2, level.shape[1] // 2
            level = level[: 2 * h, : 2 * w].reshape(h, 2, w, 2, 4).mean(axis=(1, 3))
            levels.append(level)
        return levels


@lru_cache(maxsize=1)
def stand_in() -> StandIn:
    return StandIn()
