"""The ground under real footprints: a paved strip around each building, paved places, and a plain."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, millimetres
from .grounds import Pieces
from .plan import Ground
from .rings import Ints, line_offsets, offsets_of, ring_numbers
from .roofing import triangulated

__all__ = ["plain_of"]

APRON = 1.5
"""How wide the paved strip is, metres."""

TILE = 240.0
"""The plain is made in squares of so many metres."""

_PAVEMENT, _GRASS = 1, 3


def plain_of(offsets: Ints, corners: Floats, paved: Floats) -> Ground:
    """Strips and plain.

    Parameters
    ----------
    offsets, corners
        The buildings' outer rings.
    paved
        Corners (p, 4, 2) of places that are paved, too.
    """
    rings = shapely.linearrings(corners, indices=ring_numbers(offsets))
    houses = np.asarray(shapely.polygons(rings), object)
    moved = millimetres(line_offsets(corners, offsets, -APRON))
    wide = np.asarray(shapely.polygons(shapely.linearrings(moved, indices=ring_numbers(offsets))), object)
    # Where a mitre is long or edges turn over, the strip is made with care, which takes longer.
    good = shapely.is_valid(wide) & (shapely.area(wide) > shapely.area(houses))
    reach = shapely.bounds(wide) - shapely.bounds(houses)
    good &= (np.abs(reach) < 3 * APRON).all(axis=1)
    aprons = wide
    aprons[~good] = shapely.buffer(houses[~good], APRON, join_style="mitre", mitre_limit=2.0)
    if len(paved):
        aprons = np.concatenate([aprons, shapely.polygons(paved)])
    low = np.floor(corners.min(axis=0) / TILE) - 2
    high = np.ceil(corners.max(axis=0) / TILE) + 2
    columns, rows = (high - low).astype(int).tolist()
    x, y = (low[k] * TILE + np.arange(n) * TILE for k, n in ((0, columns), (1, rows)))
    xs, ys = (v.ravel() for v in np.meshgrid(x, y))
    tiles = np.asarray(shapely.box(xs, ys, xs + TILE, ys + TILE), object)
    tile, apron = shapely.STRtree(aprons).query(tiles, predicate="intersects")
    order = np.lexsort((apron, tile))
    tile, apron = tile[order], apron[order]
    built, first = np.unique(tile, return_index=True)
    joined = [
        shapely.union_all(part) for part in np.split(aprons[apron], first[1:])
    ] if len(built) else []  # fmt: skip
    strips = shapely.intersection(tiles[built], joined)
    green = shapely.difference(tiles[built], joined)
    empty = np.delete(tiles, built)
    pieces = Pieces()
    _triangles(pieces, shapely.get_parts(strips), _PAVEMENT)
    for parts in (shapely.get_parts(green), empty, _frame(x, y)):
        _triangles(pieces, parts, _GRASS)
    return pieces.ground()


def _frame(x: Floats, y: Floats) -> np.ndarray:
    """What lies around all tiles, as far as one sees; it has a corner wherever two tiles meet."""
    x, y = np.append(x, x[-1] + TILE), np.append(y, y[-1] + TILE)
    far = max(4000.0, float(x[-1] - x[0]) / 2)
    hole = np.concatenate(
        [
            np.column_stack([x[:-1], np.full(len(x) - 1, y[0])]),
            np.column_stack([np.full(len(y) - 1, x[-1]), y[:-1]]),
            np.column_stack([x[:0:-1], np.full(len(x) - 1, y[-1])]),
            np.column_stack([np.full(len(y) - 1, x[0]), y[:0:-1]]),
        ]
    )
    shell = [
        (x[0] - far, y[0] - far),
        (x[-1] + far, y[0] - far),
        (x[-1] + far, y[-1] + far),
        (x[0] - far, y[-1] + far),
    ]
    return np.array([shapely.Polygon(shell, [hole])], object)


def _triangles(pieces: Pieces, polygons: NDArray[np.object_], kind: int) -> None:
    """Add polygons; lines and points among them are passed over."""
    polygons = polygons[shapely.get_type_id(polygons) == 3]
    if not len(polygons):
        return
    rings, polygon = shapely.get_rings(polygons, return_index=True)
    points, ring = shapely.get_coordinates(rings, return_index=True)
    closing = np.append(ring[1:] != ring[:-1], True)
    points, ring = millimetres(points[~closing]), ring[~closing]
    triangles = triangulated(points, offsets_of(np.bincount(ring, minlength=len(rings))), polygon)
    pieces.add(points, triangles, np.full(len(points), kind), polygon[ring])
