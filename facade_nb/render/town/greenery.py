"""Where trees stand: on grass and in yards, away from walls and roads, more of them near houses."""

from __future__ import annotations

import numpy as np
import shapely

from .chance import Floats, chance, field, millimetres
from .plan import Plan
from .rings import Ints
from .things import BIRCH, LIME, MAPLE, SPRUCE, Things

__all__ = ["near_houses", "trees_of"]

_NET = 7.5
"""Of so many metres is the net in whose cells a tree may stand, one in each."""

_REACH = 34.0
"""Trees stand up to that far from a house, metres."""

_WALL, _ROAD = 0.7, 0.9
"""Between a crown and a wall, and between a trunk and what is paved, metres."""

_CLOSER = 3
"""So many times as many places are looked at closely."""


def trees_of(plan: Plan, seed: int, each: float) -> Things:
    """Trees in gardens, yards and greens; at most a few for each house, so that memory stays in bounds.

    Parameters
    ----------
    plan
        With buildings and ground.
    seed
        Of the town.
    each
        So many trees there are at the most for each house.
    """
    west, south, east, north = plan.bounds
    low = np.floor(np.array([west, south]) / _NET) - 5
    columns, rows = (np.ceil(np.array([east, north]) / _NET) + 5 - low).astype(int).tolist()
    random = chance(seed, 60)
    # Only cells near a house are looked at: a country is large.
    near = _cells_near(plan, low, columns, rows)
    x, y = near % columns, near // columns
    wish, *jitter = random.random((3, len(near)))
    at = millimetres((low + np.column_stack([x, y]) + 0.12 + 0.76 * np.column_stack(jitter)) * _NET)
    clump = field(at, seed + 61, 130.0)[:, 0]
    most = int(each * len(plan)) + 40
    # The best of them are looked at more closely, some more than there will be.
    wish = np.round(wish - 0.6 - 0.25 * clump, 6)
    best = np.lexsort((np.arange(len(wish)), wish))[: _CLOSER * most]
    at, wish, clump = at[best], wish[best], clump[best]
    kinds, sizes = random.random((2, len(at)))
    chosen, free = _first_free(plan, at, np.flatnonzero(wish < 0), most)
    at = at[chosen]
    room = np.round(2 * (free - _WALL), 3)
    spruce = (kinds[chosen] < 0.2 + 0.25 * field(at, seed + 62, 260.0)[:, 1]) & (room > 3.2)
    leafy = np.select([kinds[chosen] < 0.55, kinds[chosen] < 0.8], [LIME, MAPLE], BIRCH)
    kind = np.where(spruce, SPRUCE, leafy)
    # A tree grows as large as there is room; not all are old.
    tall = np.minimum(
        np.round(3.8 + 7.4 * sizes[chosen] * sizes[chosen] + 0.8 * clump[chosen], 2), 2.6 * room
    )
    wide = np.minimum(np.where(spruce, 0.42, 0.74) * tall, room)
    return Things.of(at, kind, tall * np.where(spruce, 1.25, 1.0), wide)


def _cells_near(plan: Plan, low: Floats, columns: int, rows: int) -> Ints:
    """Numbers of the net's cells that lie near a corner of a house."""
    reach = int(_REACH / _NET) + 1
    marked = np.zeros((rows, columns), bool)
    cell = np.floor(plan.corners / _NET).astype(np.int64) - low.astype(np.int64)
    marked[np.clip(cell[:, 1], 0, rows - 1), np.clip(cell[:, 0], 0, columns - 1)] = True
    for axis in (0, 1):
        grown = marked.copy()
        for step in range(1, reach + 1):
            for way in (-step, step):
                grown |= np.roll(marked, way, axis)
        marked = grown
    return np.flatnonzero(marked)


def _first_free(plan: Plan, at: Floats, best: Ints, most: int) -> tuple[Ints, Floats]:
    """The first of the places `best` where a tree can stand, up to `most`, and how far each is from a house."""
    paved, houses = _paved(plan), shapely.STRtree(plan.outlines())
    found: list[Ints] = [np.zeros(0, np.int64)]
    apart: list[Floats] = [np.zeros(0)]
    left = most
    # Only so many are looked at as are needed.
    while len(best) and left > 0:
        some, best = best[:most], best[most:]
        free = near_houses(houses, at[some])
        good = (free > 2.2) & (free < _REACH)
        some, free = some[good], free[good]
        good = np.ones(len(some), bool)
        # What is on open ground takes longer to say than how far a house is.
        good[paved.query(shapely.points(at[some]), predicate="dwithin", distance=_ROAD)[0]] = False
        found.append(some[good][:left])
        apart.append(free[good][:left])
        left -= len(found[-1])
    return np.concatenate(found), np.concatenate(apart)


def _paved(plan: Plan) -> shapely.STRtree:
    """What is neither grass nor a yard: where that is a step away, a tree may stand, for there is ground everywhere."""
    ground = plan.ground
    soft = [ground.names.index(name) for name in ("grass", "court")]
    hard = ground.triangles[~np.isin(ground.kind[ground.triangles[:, 0]], soft)]
    return shapely.STRtree(shapely.polygons(ground.corners[hard]))


def near_houses(houses: shapely.STRtree, at: Floats) -> Floats:
    """How far the next wall is from points, metres; 0 inside a house or its yard's walls."""
    points = shapely.points(at)
    (point, _), distance = houses.query_nearest(
        points, max_distance=2 * _REACH, return_distance=True, all_matches=False
    )
    free = np.full(len(at), 2 * _REACH)
    free[point] = np.round(distance, 3)
    return free
