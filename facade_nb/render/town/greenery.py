"""Where trees stand: on grass and in yards, away from walls and roads, more of them near houses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, chance, field, millimetres
from .plan import Ground
from .rings import Ints
from .things import BIRCH, LIME, MAPLE, SPRUCE, Things

__all__ = ["Sites", "near_houses", "sites_of", "trees_of"]

_NET = 7.5
"""Of so many metres is the net in whose cells a tree may stand, one in each."""

_REACH = 34.0
"""Trees stand up to that far from a house, metres."""

_WALL, _ROAD = 0.7, 0.9
"""Between a crown and a wall, and between a trunk and what is paved, metres."""

_CLUMPS, _CLOSE, _GARDEN = 0.05, 0.006, 6.5
"""How much trees like to stand in groups, and each metre nearer to where they like best to be, so far from a house, as
parts of chance."""

_CLOSER = 3
"""So many times as many places are looked at closely."""


@dataclass(frozen=True, slots=True, eq=False)
class Sites:
    """Where trees may stand, the best places first, whatever the ground is there.

    Attributes
    ----------
    at
        (n, 2) metres.
    free
        (n,) how far each is from a house, metres.
    clump
        (n,) a smooth field: trees stand in groups.
    chances
        (3, n) random numbers for the kind and the size, and a field for woods of spruces.
    most
        There are no more trees.
    """

    at: Floats
    free: Floats
    clump: Floats
    chances: Floats
    most: int


def sites_of(corners: Floats, houses: NDArray[np.object_], seed: int, each: float) -> Sites:
    """Places for trees about houses.

    Parameters
    ----------
    corners
        (n, 2) of all rings.
    houses
        Footprints without their courtyards, as polygons.
    seed
        Of the town.
    each
        So many trees there are at the most for each house.
    """
    low = np.floor(corners.min(axis=0) / _NET) - 5
    columns, rows = (np.ceil(corners.max(axis=0) / _NET) + 5 - low).astype(int).tolist()
    random = chance(seed, 60)
    # Only cells near a house are looked at: a country is large.
    near = _cells_near(corners, low, columns, rows)
    x, y = near % columns, near // columns
    wish, *jitter = random.random((3, len(near)))
    at = millimetres((low + np.column_stack([x, y]) + 0.12 + 0.76 * np.column_stack(jitter)) * _NET)
    clump = field(at, seed + 61, 130.0)[:, 0]
    most = int(each * len(houses)) + 40
    # The best of them are looked at more closely, some more than there will be.
    wish = np.round(wish - 0.6 - _CLUMPS * clump, 6)
    best = np.lexsort((np.arange(len(wish)), wish))[: _CLOSER * most]
    free = near_houses(shapely.STRtree(houses), at[best])
    # Most stand in the gardens of houses.
    order = np.lexsort((best, np.round(wish[best] + _CLOSE * np.abs(free - _GARDEN), 6)))
    best, free = best[order], free[order]
    chances = np.vstack([random.random((2, len(best))), field(at[best], seed + 62, 260.0)[:, 1]])
    good = (wish[best] < 0) & (free > 2.2) & (free < _REACH)
    best = best[good]
    return Sites(at[best], free[good], clump[best], chances[:, good], most)


def trees_of(sites: Sites, ground: Ground) -> Things:
    """Trees in gardens, yards and greens; at most a few for each house, so that memory stays in bounds."""
    chosen = _first_open(sites, ground)
    at, clump, (kinds, sizes, woods) = sites.at[chosen], sites.clump[chosen], sites.chances[:, chosen]
    room = np.round(2 * (sites.free[chosen] - _WALL), 3)
    spruce = (kinds < 0.2 + 0.25 * woods) & (room > 3.2)
    leafy = np.select([kinds < 0.55, kinds < 0.8], [LIME, MAPLE], BIRCH)
    kind = np.where(spruce, SPRUCE, leafy)
    # A tree grows as large as there is room; not all are old.
    tall = np.minimum(np.round(3.8 + 7.4 * sizes * sizes + 0.8 * clump, 2), 2.6 * room)
    wide = np.minimum(np.where(spruce, 0.42, 0.74) * tall, room)
    return Things.of(at, kind, tall * np.where(spruce, 1.25, 1.0), wide)


def _cells_near(corners: Floats, low: Floats, columns: int, rows: int) -> Ints:
    """Numbers of the net's cells that lie near a corner of a house."""
    reach = int(_REACH / _NET) + 1
    marked = np.zeros((rows, columns), bool)
    cell = np.floor(corners / _NET).astype(np.int64) - low.astype(np.int64)
    marked[np.clip(cell[:, 1], 0, rows - 1), np.clip(cell[:, 0], 0, columns - 1)] = True
    for axis in (0, 1):
        grown = marked.copy()
        for step in range(1, reach + 1):
            for way in (-step, step):
                grown |= np.roll(marked, way, axis)
        marked = grown
    return np.flatnonzero(marked)


def _first_open(sites: Sites, ground: Ground) -> Ints:
    """The first places that are on grass or a field, or in a yard, as many as there are trees at the most.

    Where a step away something else is, none stands: there is ground everywhere.
    """
    soft = [ground.names.index(name) for name in ("grass", "court", "field")]
    hard = ground.triangles[~np.isin(ground.kind[ground.triangles[:, 0]], soft)]
    paved = shapely.STRtree(shapely.polygons(ground.corners[hard]))
    found: list[Ints] = [np.zeros(0, np.int64)]
    left, waiting = sites.most, np.arange(len(sites.at))
    # Only so many are looked at as are needed.
    while len(waiting) and left > 0:
        some, waiting = waiting[: sites.most], waiting[sites.most :]
        good = np.ones(len(some), bool)
        good[paved.query(shapely.points(sites.at[some]), predicate="dwithin", distance=_ROAD)[0]] = False
        found.append(some[good][:left])
        left -= len(found[-1])
    return np.concatenate(found)


def near_houses(houses: shapely.STRtree, at: Floats) -> Floats:
    """How far the next wall is from points, metres; 0 inside a house or its yard's walls."""
    points = shapely.points(at)
    (point, _), distance = houses.query_nearest(
        points, max_distance=2 * _REACH, return_distance=True, all_matches=False
    )
    free = np.full(len(at), 2 * _REACH)
    free[point] = np.round(distance, 3)
    return free
