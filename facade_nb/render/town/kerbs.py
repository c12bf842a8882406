"""What stands along kerbs: trees in rows where a street is wide, and lamps."""

from __future__ import annotations

import numpy as np

from .chance import Floats, chance, length, millimetres
from .rings import Ints, after, ragged, ring_numbers
from .streets import AVENUE, BOULEVARD, LANE, MINOR, WALKS, Cells
from .things import LAMP, LIME, MAPLE, Things

__all__ = ["along_kerbs"]

_ROW, _CLEAR = 10.0, 9.0
"""From tree to tree, and from a crossing to the first, metres."""

_LAMPS, _FIRST = 50.0, 14.0
"""From lamp to lamp, and from a crossing to the first, metres: halfway between two trees."""

_CROWN = {BOULEVARD: 5.6, AVENUE: 3.9}
"""How wide crowns are at most: they keep clear of the walls behind the pavement, metres."""


def along_kerbs(cells: Cells, built: Ints, seed: int) -> Things:
    """Trees and lamps on the pavements of cells that are built up."""
    own = np.isin(ring_numbers(cells.offsets), built) & (cells.sizes > 0)[ring_numbers(cells.offsets)]
    own &= cells.street < LANE
    start = np.flatnonzero(own)
    end = after(cells.offsets)[start]
    kind = cells.street[start]
    foot, way = cells.kerbs[start], cells.kerbs[end] - cells.kerbs[start]
    span = length(way)
    wall = cells.blocks[start] - foot
    kept = (span > 2 * _FIRST) & (length(wall) > 0.5)
    foot, way, span, kind = foot[kept], way[kept], span[kept], kind[kept]
    unit = way / span[:, None]
    inward = np.column_stack([-unit[:, 1], unit[:, 0]])
    avenue = kind <= AVENUE
    edge, at = _spaced(foot[avenue], unit[avenue], span[avenue], _ROW, _CLEAR)
    edge = np.flatnonzero(avenue)[edge]
    crown = np.array([_CROWN[BOULEVARD], _CROWN[AVENUE]])[kind[edge]]
    aside = np.round(np.minimum(1.3, WALKS[kind[edge]] / 2), 3)
    random = chance(seed, 63)
    young = random.random(len(edge))
    row = np.where(chance(seed, 64).random(len(start)) < 0.6, LIME, MAPLE)[edge]
    wide = np.round(crown * (0.84 + 0.16 * young), 3)
    trees = Things.of(at + inward[edge] * aside[:, None], row, np.round(1.62 * wide + 1.4, 2), wide)
    # In small streets lamps stand on one side.
    side = (kind < MINOR) | (way[:, 0] + 0.618 * way[:, 1] > 0)
    edge, at = _spaced(foot[side], unit[side], span[side], _LAMPS, _FIRST)
    edge = np.flatnonzero(side)[edge]
    lamps = Things.of(at + 0.45 * inward[edge], LAMP, 4.4, 0.8)
    return trees + lamps


def _spaced(foot: Floats, unit: Floats, span: Floats, step: float, clear: float) -> tuple[Ints, Floats]:
    """Places along lines, as many as there is room for, clear of both ends: the line of each, and where it is."""
    room = np.maximum(np.floor((span - 2 * clear) / step).astype(np.int64) + 1, 0)
    edge = np.repeat(np.arange(len(span)), room)
    number = ragged(np.zeros(len(span), np.int64), room)
    return edge, millimetres(foot[edge] + unit[edge] * (clear + step * number)[:, None])
