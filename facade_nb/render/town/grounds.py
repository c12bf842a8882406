"""The ground of a generated town: streets, pavements, yards and greens, and the fields around."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .chance import Floats, length, millimetres
from .footprints import District
from .plan import Ground
from .rings import Ints, after, ring_numbers, take_rings
from .roofing import triangulated
from .streets import AVENUE, WALKS, WIDTHS, Cells

__all__ = ["ASPHALT", "COURT", "FIELD", "GRASS", "PAVEMENT", "Pieces", "ground_of"]

ASPHALT, PAVEMENT, COURT, GRASS, LINE, FIELD = range(6)

_LINE = 0.07
"""Half the width of the line in the middle of a street, metres."""

_INSIDE = {
    District.MARKET: PAVEMENT,
    District.OLD: COURT,
    District.INNER: COURT,
    District.INDUSTRY: COURT,
}

_GARDENS = 3
"""In so many fifths of the dense quarters' blocks the yard is a garden."""


def ground_of(cells: Cells, district: Ints, built: Ints) -> Ground:
    """The ground of cells with buildings, and of those that lie among them.

    Parameters
    ----------
    built
        Cells with buildings.
    """
    inside = cells.reach < 0.97 * cells.reach[built].max()
    inside &= np.isin(district, (District.MARKET, District.PARK))
    inside[built] = True
    chosen = np.flatnonzero(inside)
    index, offsets = take_rings(cells.offsets, chosen)
    outer, kerb, block = cells.corners[index], cells.kerbs[index], cells.blocks[index]
    good = cells.sizes[chosen] > 0
    number = ring_numbers(offsets)
    i = np.flatnonzero(good[number])
    j = after(offsets)[i]
    pieces = Pieces()
    marked = cells.street[index[i]] <= AVENUE
    # Wide streets have a line in their middle: each side half of it.
    share = np.where(marked, _LINE / (WIDTHS / 2 - WALKS)[cells.street[index[i]]], 0.0)[:, None]
    lines = [millimetres(outer[k] + (kerb[k] - outer[k]) * share) for k in (i, j)]
    pieces.strips(outer[i][marked], outer[j][marked], lines[1][marked], lines[0][marked], LINE)
    pieces.strips(lines[0], lines[1], kerb[j], kerb[i], ASPHALT)
    pieces.strips(kerb[i], kerb[j], block[j], block[i], PAVEMENT)
    kinds = np.array([_INSIDE.get(k, GRASS) for k in range(8)])[district[chosen]]
    garden = (chosen * 2654435761 >> 12) % 5 < _GARDENS  # of fifths
    kinds = np.where((district[chosen] == District.INNER) & garden, GRASS, kinds)
    inner = np.where(good[number][:, None], block, outer)
    triangles = triangulated(inner, offsets, np.arange(len(chosen)))
    pieces.add(inner, triangles, np.where(good, kinds, ASPHALT)[number], number)
    _fields(pieces, cells, np.flatnonzero(~inside))
    return pieces.ground()


@dataclass(slots=True)
class Pieces:
    """Gathers pieces of ground."""

    parts: list[tuple[Floats, Ints, Ints, Ints, NDArray[np.bool_]]] = field(default_factory=list)

    def add(self, corners: Floats, triangles: Ints, kind: Ints, piece: Ints, along: bool = False) -> None:
        """Corners with their kinds and pieces, and triangles of them."""
        if len(corners):
            self.parts.append((corners, triangles, kind, piece, np.full(len(corners), along)))

    def strips(self, a: Floats, b: Floats, c: Floats, d: Floats, kind: int) -> None:
        """Pieces of four corners (n, 2) each, along a street: from a to b on its side. Asphalt has no pattern."""
        quad = np.stack([a, b, c, d], axis=1).reshape(-1, 2)
        corner = 4 * np.arange(len(a))[:, None]
        triangles = np.concatenate([corner + np.array([0, 1, 2]), corner + np.array([0, 2, 3])])
        self.add(quad, triangles, np.full(len(quad), kind), np.arange(len(quad)) // 4, kind != ASPHALT)

    def ground(self) -> Ground:
        """All of them, without triangles that are lines."""
        corners, triangles, kind, piece, along = zip(*self.parts, strict=True)
        starts = np.cumsum([0] + [len(points) for points in corners[:-1]])
        numbers = np.cumsum([0] + [int(own.max()) + 1 for own in piece[:-1]])
        every = np.concatenate([t + start for t, start in zip(triangles, starts, strict=True)])
        points = np.concatenate(corners)
        a, b, c = (np.rint(points[every[:, k]] * 1000).astype(np.int64) for k in range(3))
        area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
        return Ground(
            points,
            every[area > 0],
            np.concatenate(kind).astype(np.uint8),
            np.concatenate([own + first for own, first in zip(piece, numbers, strict=True)]),
            np.concatenate(along),
        )


def _fields(pieces: Pieces, cells: Cells, others: Ints) -> None:
    """What lies around the town: cells that are not built up, and what is beyond them all, as far as one sees.

    Main streets go on there, and those between a cell that is built up and one that is not have both their halves.
    """
    _, name = np.unique(cells.corners, axis=0, return_inverse=True)
    start = name.reshape(-1).astype(np.int64)
    end = start[after(cells.offsets)]
    every = np.isin(ring_numbers(cells.offsets), others)
    built = np.isin(start * len(start) + end, (end * len(start) + start)[~every])
    index, offsets = take_rings(cells.offsets, others)
    outer, kerb, number = cells.corners[index], cells.kerbs[index], ring_numbers(offsets)
    good = (cells.sizes[others] > 0)[number]
    street = built | (cells.street <= AVENUE)
    i = np.flatnonzero(good)
    j = after(offsets)[i]
    quad = np.stack([outer[i], outer[j], kerb[j], kerb[i]], axis=1).reshape(-1, 2)
    corner = 4 * np.arange(len(i))[:, None]
    triangles = np.concatenate([corner + np.array([0, 1, 2]), corner + np.array([0, 2, 3])])
    kind = np.repeat(np.where(street[index[i]], ASPHALT, FIELD), 4)
    pieces.add(quad, triangles, kind, np.arange(len(quad)) // 4)
    inner = np.where(good[:, None], kerb, outer)
    triangles = triangulated(inner, offsets, np.arange(len(others)))
    pieces.add(inner, triangles, np.full(len(inner), FIELD), number)
    # Edges that no cell has the other way are the rim. It lies around the market, so that it can be drawn apart.
    rim = np.flatnonzero(~np.isin(start * len(start) + end, end * len(start) + start))
    here, there = cells.corners[rim], cells.corners[after(cells.offsets)[rim]]
    reach = float(length(here).max())
    times = np.round(max(2.0, 3000.0 / reach), 1)
    quad = np.stack([here, millimetres(here * times), millimetres(there * times), there], axis=1).reshape(
        -1, 2
    )
    corner = 4 * np.arange(len(rim))[:, None]
    triangles = np.concatenate([corner + np.array([0, 1, 2]), corner + np.array([0, 2, 3])])
    pieces.add(quad, triangles, np.full(len(quad), FIELD), np.arange(len(quad)) // 4)
