"""Tiles for a town: those that are small or pale in a street come in half their size, so that all fit 60 MB."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..tiles import CATALOGUE, TileSet
from ..tiles.relief import Relief

__all__ = ["SparingTiles", "town_tiles"]

_WHOLE = frozenset({
    "Walls and roofs", "Windows", "Frames, open between their bars", "Doors, shutters and gates",
    "Ornament and ironwork", "Trees and street lamps",
})  # fmt: skip
"""Groups of tiles that one comes near to; curtains, rooms, furniture and the ground are seen from farther away."""

_SHARP = frozenset({"sign", "awning"})


class SparingTiles:
    """Tiles of a set, some without their largest size.

    Parameters
    ----------
    tiles
        The set.
    """

    def __init__(self, tiles: TileSet) -> None:
        self._tiles = tiles

    @property
    def names(self) -> Sequence[str]:
        """Names of the tiles."""
        return self._tiles.names

    def mips(self, name: str) -> Sequence[NDArray[Any]]:
        """The tile in ever smaller sizes; companions (normals, highlights) begin with a half, as small things do."""
        levels = self._tiles.mips(name)
        return levels if _whole(name) or len(levels) < 2 else levels[1:]

    def stored(self, name: str) -> Sequence[NDArray[np.uint8]]:
        """What `mips` gives, in 8 bits."""
        levels = self._tiles.stored(name)
        return levels if _whole(name) or len(levels) < 2 else levels[1:]

    def is_drawn(self, name: str) -> bool:
        """Whether a tile is at hand."""
        return self._tiles.is_drawn(name)

    def of(self, size: int) -> SparingTiles:
        """The same tiles in another size."""
        return SparingTiles(self._tiles.of(size))

    def relief(self, name: str) -> Relief | None:
        """The heights of a tile, in half its size; None if it is flat."""
        found = self._tiles.relief(name)
        if found is None:
            return None
        whole = found.heights
        parts = whole.reshape(whole.shape[0] // 2, 2, whole.shape[1] // 2, 2)
        return found._replace(heights=parts.mean(axis=(1, 3)))


def _whole(name: str) -> bool:
    recipe = CATALOGUE.get(name)  # None: a companion, or a tile of one's own
    return recipe is not None and (recipe.group in _WHOLE or name in _SHARP)


def town_tiles() -> SparingTiles:
    """The tiles that ship, for a town."""
    return SparingTiles(TileSet.builtin())
