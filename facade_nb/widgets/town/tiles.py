"""Tiles as the browser asks for them: some names, in sizes up to a side; at first small ones, drawn in haste."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...render import Grammar
from ...render.texture.atlas import Tiles
from ...render.texture.question import Question
from ...render.tiles import TileSet

__all__ = ["COARSE", "coarse_tiles", "question_of", "tiles_of", "tiles_piece"]

COARSE = 32
"""The side of what comes first: a tile that has not been drawn yet is drawn in that size, which takes little time."""

Images = Sequence[NDArray[np.uint8]]


def tiles_of(grammar: Grammar) -> Tiles:
    """The tiles that a grammar was read with."""
    return grammar.tiles if grammar.tiles is not None else TileSet.builtin()


def coarse_tiles(grammar: Grammar) -> Tiles | None:
    """Small tiles in the place of a grammar's, of which some have not been drawn yet; None: all have been."""
    tiles = tiles_of(grammar)
    drawn = getattr(tiles, "is_drawn", None)
    if drawn is None or all(map(drawn, grammar.encoding.tiles)):
        return None
    return _small(tiles)


def _small(tiles: Any) -> Any:
    return tiles.of(COARSE)


class _Unseen:
    """Tiles of one pixel, for who asks of a grammar all but its tiles: to read and pack those takes a while."""

    def __init__(self, names: Sequence[str]) -> None:
        self.names = names

    def mips(self, name: str) -> Sequence[NDArray[Any]]:
        """Nothing to see."""
        return (np.zeros((1, 1, 4), np.uint8),)


def question_of(grammar: Grammar) -> Question:
    """What an evaluator needs, but for tiles, which come one by one."""
    return grammar.question((1.0, 1.0), tiles=_Unseen(grammar.encoding.tiles))


def tiles_piece(
    tiles: Tiles, names: Sequence[str], above: Sequence[int], upto: int
) -> tuple[list[dict[str, Any]], bytes]:
    """What is told of tiles, and their sizes beyond `above` (of each) up to the side `upto`, row 0 at the bottom."""
    told, parts = [], []
    for name, least in zip(names, above, strict=True):
        levels, draft = _levels(tiles, name, upto)
        sides = [max(level.shape[:2]) for level in levels]
        first = next((k for k, side in enumerate(sides) if side <= upto), len(levels) - 1)
        end = next((k for k, side in enumerate(sides) if side <= least), len(levels))
        told.append(
            {
                "name": name,
                "sizes": [[level.shape[1], level.shape[0]] for level in levels],
                "first": first,
                "end": end,
                "grey": bool((levels[0][..., 3] == 255).all()),
                "draft": draft,
            }
        )
        parts += [np.ascontiguousarray(level[::-1]).tobytes() for level in levels[first:end]]
    return told, b"".join(parts)


def _levels(tiles: Tiles, name: str, upto: int) -> tuple[Images, bool]:
    """All sizes of a tile; of one that has not been drawn yet only small ones, where no more is asked for."""
    drawn = getattr(tiles, "is_drawn", None)
    if drawn is not None and upto <= COARSE and not drawn(name):
        return _small(tiles).stored(name), True
    stored = getattr(tiles, "stored", None)
    if stored is not None:
        return stored(name), False
    return [(np.clip(level, 0, 1) * 255 + 0.5).astype(np.uint8) for level in tiles.mips(name)], False
