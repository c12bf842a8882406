"""The ground of a generated town: streets, pavements, yards and greens, and the fields around."""

from __future__ import annotations

import numpy as np
import shapely

from .chance import Floats
from .footprints import District
from .plan import Ground
from .rings import Ints, after, ring_numbers, take_rings
from .roofing import triangulated
from .streets import Cells

__all__ = ["ground_of"]

ASPHALT, PAVEMENT, COURT, GRASS = range(4)

_INSIDE = {
    District.MARKET: PAVEMENT,
    District.OLD: COURT,
    District.INNER: COURT,
    District.INDUSTRY: COURT,
}


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
    pieces: list[tuple[Floats, Ints, Ints]] = []
    for one, other, name in ((outer, kerb, ASPHALT), (kerb, block, PAVEMENT)):
        quad = np.stack([one[i], one[j], other[j], other[i]], axis=1).reshape(-1, 2)
        corner = 4 * np.arange(len(i))[:, None]
        triangles = np.concatenate([corner + np.array([0, 1, 2]), corner + np.array([0, 2, 3])])
        pieces.append((quad, triangles, np.full(len(triangles), name)))
    kinds = np.array([_INSIDE.get(k, GRASS) for k in range(8)])[district[chosen]]
    inner = np.where(good[number][:, None], block, outer)
    triangles = triangulated(inner, offsets, np.arange(len(chosen)))
    pieces.append((inner, triangles, np.where(good, kinds, ASPHALT)[number[triangles[:, 0]]]))
    pieces.append(_fields(outer, offsets))
    starts = np.cumsum([0] + [len(points) for points, _, _ in pieces])
    corners = np.concatenate([points for points, _, _ in pieces])
    every = np.concatenate([t + start for (_, t, _), start in zip(pieces, starts[:-1], strict=True)])
    kind = np.concatenate([k for _, _, k in pieces]).astype(np.uint8)
    a, b, c = (np.rint(corners[every[:, k]] * 1000).astype(np.int64) for k in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    return Ground(corners, every[area > 0], kind[area > 0])


def _fields(corners: Floats, offsets: Ints) -> tuple[Floats, Ints, Ints]:
    """What lies around the cells, as far as one sees."""
    rings = shapely.linearrings(corners, indices=ring_numbers(offsets))
    town = shapely.coverage_union_all(shapely.polygons(rings))
    low, high = corners.min(axis=0), corners.max(axis=0)
    wide = np.ceil(max(800.0, float((high - low).max()) * 0.5) / 100) * 100
    low, high = np.floor(low / 100) * 100 - wide, np.ceil(high / 100) * 100 + wide
    square = shapely.box(low[0], low[1], high[0], high[1])
    parts = shapely.get_parts(shapely.difference(square, town))
    found, polygon, counts = [], [], []
    for k, part in enumerate(parts):
        inner = range(shapely.get_num_interior_rings(part))
        shells = [shapely.get_exterior_ring(part), *(shapely.get_interior_ring(part, n) for n in inner)]
        for shell in shells:
            points = shapely.get_coordinates(shell)[:-1]
            found.append(points)
            polygon.append(k)
            counts.append(len(points))
    points = np.concatenate(found)
    ends = np.concatenate([[0], np.cumsum(counts)])
    triangles = triangulated(points, ends, np.array(polygon))
    return points, triangles, np.full(len(triangles), GRASS)
