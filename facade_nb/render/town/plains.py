"""The ground under real footprints: streets with pavements, what is paved about houses, and a plain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, millimetres
from .grounds import ASPHALT, COURT, FIELD, GRASS, PAVEMENT, Pieces
from .linking import groups_of
from .plan import Ground
from .rings import Ints, line_offsets, offsets_of, ring_numbers
from .roads import HALF, LANE, WALK, Roads
from .roofing import triangulated
from .workers import Workers

__all__ = ["APRON", "Asphalt", "asphalt_of", "plain_of"]

APRON = 0.6
"""How wide a strip of gravel around a house is, and so near to any no street comes, metres."""

TILE = 240.0
"""The plain is made in squares of so many metres."""

_SHARES = 2
"""Tiles are in so many shares, each for a thread; they are the same where there are no threads."""

_ROUND = 0.4142135623730951
_ENDS = np.array(
    [(1, _ROUND), (_ROUND, 1), (-_ROUND, 1), (-1, _ROUND), (-1, -_ROUND), (-_ROUND, -1), (_ROUND, -1), (1, -_ROUND)]
)  # fmt: skip
"""Streets end and meet as such an octagon; lanes have no ends of their own."""


@dataclass(frozen=True, slots=True, eq=False)
class Asphalt:
    """Roadways on the plain, which follow from footprints and roads alone.

    Attributes
    ----------
    x, y
        Where columns and rows of square tiles begin.
    tiles
        All of them, row by row.
    narrow
        (b,) each footprint with `APRON` around it, which no roadway covers.
    near
        Those of them that one comes near to.
    laid
        Polygons of roadways, which may overlap.
    shown
        (tiles) what of each is asphalt.
    """

    x: Floats
    y: Floats
    tiles: NDArray[np.object_]
    narrow: NDArray[np.object_]
    near: Ints
    laid: NDArray[np.object_]
    shown: NDArray[np.object_]


def asphalt_of(offsets: Ints, corners: Floats, roads: Roads) -> Asphalt:
    """Roadways, given the buildings' outer rings."""
    narrow = _aprons(offsets, corners, np.full(len(offsets) - 1, APRON))
    laid = _laid(roads, HALF[roads.kind])
    # Only houses that a roadway comes near to take something from it.
    near = np.unique(shapely.STRtree(laid).query(narrow, predicate="intersects")[0])
    low = np.floor(corners.min(axis=0) / TILE) - 2
    high = np.ceil(corners.max(axis=0) / TILE) + 2
    columns, rows = (high - low).astype(int).tolist()
    x, y = (low[k] * TILE + np.arange(n) * TILE for k, n in ((0, columns), (1, rows)))
    xs, ys = (v.ravel() for v in np.meshgrid(x, y))
    tiles = np.asarray(shapely.box(xs, ys, xs + TILE, ys + TILE), object)
    shown = np.full(len(tiles), shapely.Polygon(), object)
    some = np.unique(shapely.STRtree(laid).query(tiles, predicate="intersects")[0])
    shown[some] = shapely.difference(_within(tiles[some], laid), _within(tiles[some], narrow[near]))
    return Asphalt(x, y, tiles, narrow, near, laid, shown)


def plain_of(
    offsets: Ints,
    corners: Floats,
    paved: Floats,
    roads: Roads,
    ways: NDArray[np.object_],
    asphalt: Asphalt | None = None,
) -> Ground:
    """Ground.

    Parameters
    ----------
    offsets, corners
        The buildings' outer rings.
    paved
        (b,) how wide the strip around each is, metres: up to `APRON` gravel, pavement where it is wider; 0: none.
    roads
        Streets.
    ways
        Polygons of ways to doors and of places for cars.
    asphalt
        Of the same rings and roads, where it is there already.
    """
    asphalt = asphalt or asphalt_of(offsets, corners, roads)
    narrow, tiles = asphalt.narrow, asphalt.tiles
    wide = _aprons(offsets, corners, np.maximum(paved, APRON))
    walked = roads.take(np.flatnonzero(WALK[roads.kind] > 0))
    walks = _laid(walked, (HALF + WALK)[walked.kind])
    gravel = _groups(np.concatenate([narrow[(paved > 0) & (paved <= APRON)], np.asarray(ways, object)]))
    stones = np.concatenate([walks, wide[paved > APRON]])
    there = np.concatenate([asphalt.laid, stones, gravel, narrow])
    built = np.unique(shapely.STRtree(there).query(tiles, predicate="intersects")[0])
    covers = _in_threads(tiles[built], asphalt.shown[built], stones, gravel)
    pieces = Pieces()
    for parts, kind in zip(covers, (ASPHALT, PAVEMENT, COURT, GRASS), strict=True):
        _triangles(pieces, shapely.get_parts(parts), kind)
    for parts in (np.delete(tiles, built), _frame(asphalt.x, asphalt.y)):
        _triangles(pieces, parts, FIELD)
    return pieces.ground()


def _in_threads(
    tiles: NDArray[np.object_],
    asphalt: NDArray[np.object_],
    stones: NDArray[np.object_],
    gravel: NDArray[np.object_],
) -> list[NDArray[np.object_]]:
    """The covers of all tiles, kind by kind."""
    with Workers() as workers:
        shares = [
            workers.begin(_covers, tiles[part::_SHARES], asphalt[part::_SHARES], stones, gravel)
            for part in range(_SHARES)
        ]
        return [np.concatenate(parts) for parts in zip(*(share() for share in shares), strict=True)]


def _covers(
    tiles: NDArray[np.object_],
    asphalt: NDArray[np.object_],
    stones: NDArray[np.object_],
    gravel: NDArray[np.object_],
) -> list[NDArray[np.object_]]:
    """What of each tile is asphalt, pavement, court and grass. No two pieces of gravel meet."""
    stone, soft = _within(tiles, stones), _within(tiles, gravel, apart=True)
    hard = shapely.union(asphalt, stone)
    pavement, court = shapely.difference(stone, asphalt), shapely.difference(soft, hard)
    return [asphalt, pavement, court, shapely.difference(tiles, shapely.union(hard, soft))]


def _aprons(offsets: Ints, corners: Floats, wide: Floats) -> NDArray[np.object_]:
    """Outer rings with so much around them each."""
    rings = shapely.linearrings(corners, indices=ring_numbers(offsets))
    houses = np.asarray(shapely.polygons(rings), object)
    moved = millimetres(line_offsets(corners, offsets, -wide[ring_numbers(offsets)]))
    found = np.asarray(shapely.polygons(shapely.linearrings(moved, indices=ring_numbers(offsets))), object)
    # Where a mitre is long or edges turn over, the strip is made with care, which takes longer.
    good = shapely.is_valid(found) & (shapely.area(found) > shapely.area(houses))
    reach = shapely.bounds(found) - shapely.bounds(houses)
    good &= (np.abs(reach) < 3 * wide[:, None]).all(axis=1)
    found[~good] = shapely.buffer(houses[~good], wide[~good], join_style="mitre", mitre_limit=2.0)
    return found


def _laid(roads: Roads, half: Floats) -> NDArray[np.object_]:
    """Roads so wide on each side of their lines, and what closes them at both ends."""
    if not len(roads):
        return np.zeros(0, object)
    strips = shapely.buffer(roads.lines(), half, cap_style="flat", join_style="mitre", mitre_limit=2.0)
    wide = np.flatnonzero(roads.kind < LANE)
    ends = roads.points[np.concatenate([roads.offsets[:-1][wide], roads.offsets[1:][wide] - 1])]
    caps = shapely.polygons(millimetres(ends[:, None] + _ENDS * np.tile(half[wide], 2)[:, None, None]))
    return np.concatenate([np.asarray(strips, object), np.asarray(caps, object)])


def _groups(pieces: NDArray[np.object_]) -> NDArray[np.object_]:
    """What the pieces cover, as polygons that lie apart: most meet one or two others, so that this is quick."""
    count = len(pieces)
    one, other = shapely.STRtree(pieces).query(pieces, predicate="intersects")
    groups, label = groups_of(np.stack([one, other], axis=1), count)
    order = np.argsort(label, kind="stable")
    ends = np.cumsum(np.bincount(label, minlength=groups))[:-1]
    found = [part[0] if len(part) == 1 else shapely.union_all(part) for part in np.split(pieces[order], ends)]
    return np.asarray(shapely.get_parts(np.array(found, object)), object)


def _within(
    tiles: NDArray[np.object_], layer: NDArray[np.object_], apart: bool = False
) -> NDArray[np.object_]:
    """What of a layer lies in each tile, as one. `apart`: no two pieces of it meet."""
    found = np.full(len(tiles), shapely.Polygon(), object)
    if not len(layer):
        return found
    tile, piece = shapely.STRtree(layer).query(tiles, predicate="intersects")
    order = np.lexsort((piece, tile))
    tile, piece = tile[order], piece[order]
    some, first, group = np.unique(tile, return_index=True, return_inverse=True)
    if apart:
        joined = shapely.multipolygons(layer[piece], indices=group)
        found[some] = shapely.intersection(tiles[some], joined)
        return found
    joined = [shapely.union_all(part) for part in np.split(layer[piece], first[1:])] if len(some) else []
    found[some] = shapely.intersection(tiles[some], joined)
    return found


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
    """Add polygons; lines, points and nothing among them are passed over."""
    polygons = polygons[(shapely.get_type_id(polygons) == 3) & ~shapely.is_empty(polygons)]
    if not len(polygons):
        return
    rings, polygon = shapely.get_rings(polygons, return_index=True)
    points, ring = shapely.get_coordinates(rings, return_index=True)
    closing = np.append(ring[1:] != ring[:-1], True)
    points, ring = millimetres(points[~closing]), ring[~closing]
    triangles = triangulated(points, offsets_of(np.bincount(ring, minlength=len(rings))), polygon)
    pieces.add(points, triangles, np.full(len(points), kind), polygon[ring])
