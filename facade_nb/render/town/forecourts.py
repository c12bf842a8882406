"""Before real houses: the way from the street to the door, a place for a car, hedges along the street."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, chance, length, millimetres
from .openness import roads_before
from .rings import Ints
from .roads import HALF, WALK, Roads
from .roles import STREET
from .street_life import Cars, Hedges, cars_like
from .things import Things

if TYPE_CHECKING:
    from .plan import Plan

__all__ = ["Forecourts", "cars_before", "forecourts_of", "hedges_before"]

_BESIDE, _WIDE, _AXIS = 1.6, 3.0, 3.6
"""From the front's middle, where its door may be, to a place for a car; its width; from wall to car, metres."""

_NEAR, _FURTHER = 8.6, 24.0
"""A wall that has a place for a car is so far from the middle of its street, metres."""

_WAY, _LONGEST = 0.65, 90.0
"""Half the width of a way to a door, and how long it is at the most, metres."""

_CARS, _HEDGES = 0.19, 0.34
"""So many of each there are at the most for each house."""


@dataclass(frozen=True, slots=True, eq=False)
class _Fronts:
    """The wall of each building that has its door, else its widest on the street.

    Middle, unit vectors along and outwards, span, building; metres to the middle of the road before it (`inf`: none is
    seen) and to its edge.
    """

    middle: Floats
    unit: Floats
    out: Floats
    span: Floats
    building: Ints
    road: Floats
    kerb: Floats

    @classmethod
    def of(cls, plan: Plan, gaps: Floats, roads: Roads) -> _Fronts:
        way = plan.corners[plan.following] - plan.corners
        span = np.round(length(way), 3)
        door = np.zeros(len(span), bool)
        door[plan.entrance[plan.entrance >= 0]] = True
        edge = np.flatnonzero((plan.role == STREET) & (span >= 1.5) & (gaps >= 1.5))
        building = plan.building[edge]
        order = edge[np.lexsort((edge, -span[edge], ~door[edge], building))]
        building = plan.building[order]
        first = np.append(True, building[1:] != building[:-1]) if len(order) else np.zeros(0, bool)
        own = order[first]
        unit = way[own] / span[own, None]
        out = np.column_stack([unit[:, 1], -unit[:, 0]])
        middle = plan.corners[own] + way[own] / 2
        road, which = roads_before(middle, out, gaps[own], roads)
        wide = np.where(which >= 0, (HALF + WALK)[roads.kind[which]] if len(roads) else 0.0, 0.0)
        return cls(middle, unit, out, span[own], plan.building[own], road, road - wide)

    def at(self, which: Ints, along: Floats, out: Floats | float) -> Floats:
        """Points so far along some fronts from their middles, and so far before them."""
        ahead = np.broadcast_to(np.asarray(out, float), (len(which),))
        return np.asarray(
            self.middle[which] + self.unit[which] * along[:, None] + self.out[which] * ahead[:, None]
        )


@dataclass(frozen=True, slots=True, eq=False)
class Forecourts:
    """Fronts, and what is paved before them.

    Places for cars: corners (p, 4, 2), which front, on which side of its middle. Lines of the ways from doors to
    streets; buildings with a door from which no street is reached.
    """

    fronts: _Fronts
    corners: Floats
    front: Ints
    side: Floats
    ways: NDArray[np.object_]
    lost: Ints

    def paved(self) -> NDArray[np.object_]:
        """All of it, as polygons."""
        strips = shapely.buffer(self.ways, _WAY, cap_style="flat", join_style="mitre")
        return np.concatenate([np.asarray(strips, object), self.places()])

    def places(self) -> NDArray[np.object_]:
        """Places for cars, as polygons."""
        return np.asarray(shapely.polygons(self.corners), object).reshape(-1)


def forecourts_of(
    plan: Plan, gaps: Floats, roads: Roads, houses: NDArray[np.object_], seed: int
) -> Forecourts:
    """Ways to doors, and places for cars where a street is not too near and not too far.

    Parameters
    ----------
    gaps
        (n,) of each edge of the plan.
    houses
        All footprints, as polygons.
    """
    fronts = _Fronts.of(plan, gaps, roads)
    ways, lost = _ways(plan, roads, houses)
    wish, side = chance(seed, 80).random((2, len(fronts.span)))
    own = np.flatnonzero(
        (fronts.road >= _NEAR) & (fronts.road <= _FURTHER) & (fronts.span >= 4.0) & (wish < 0.62)
    )
    sign = np.where(side[own] < 0.5, -1.0, 1.0)
    near, far = sign * _BESIDE, sign * (_BESIDE + _WIDE)
    low, high = np.minimum(near, far), np.maximum(near, far)
    deep = fronts.road[own]
    none, least = np.zeros(len(own)), np.full(len(own), 0.35)

    def boxes(near: Floats) -> Floats:
        spots = [(low, near), (high, near), (high, deep), (low, deep)]
        return np.stack([fronts.at(own, along, out) for along, out in spots], axis=1)

    corners = millimetres(boxes(none)[:, ::-1])
    clear = np.asarray(shapely.polygons(boxes(least)), object).reshape(-1)
    good = np.ones(len(own), bool)
    if len(own):
        tree = shapely.STRtree(clear)
        good[tree.query(houses, predicate="dwithin", distance=0.3)[1]] = False
        good[tree.query(ways, predicate="dwithin", distance=_WAY)[1]] = False
        one, other = tree.query(clear, predicate="dwithin", distance=0.4)
        good[np.maximum(one, other)[(one != other) & good[one] & good[other]]] = False
    kept = np.flatnonzero(good)
    kept = np.sort(kept[np.lexsort((kept, np.round(wish[own[kept]], 6)))][: int(_CARS * len(houses)) + 6])
    return Forecourts(fronts, corners[kept], own[kept], sign[kept], ways, lost)


def _ways(plan: Plan, roads: Roads, houses: NDArray[np.object_]) -> tuple[NDArray[np.object_], Ints]:
    """From doors to the middle of a street: straight on, else the shortest way that no house stands in."""
    building = np.flatnonzero(plan.entrance >= 0)
    edge = plan.entrance[building]
    a, b = plan.corners[edge], plan.corners[plan.following[edge]]
    way = b - a
    out = np.column_stack([way[:, 1], -way[:, 0]]) / np.maximum(length(way), 1e-9)[:, None]
    middle = millimetres((a + b) / 2)
    found = np.full(len(building), None, object)
    if not len(roads) or not len(building):
        return np.zeros(0, object), building
    lines, tree = roads.lines(), shapely.STRtree(houses)
    net = shapely.STRtree(lines)
    straight = shapely.linestrings(np.stack([middle, middle + 30.0 * out], axis=1))
    ray, line = net.query(straight, predicate="intersects")
    meets = shapely.intersection(straight[ray], lines[line])
    apart = np.full(len(building), np.inf)
    np.minimum.at(apart, ray, np.round(shapely.distance(shapely.points(middle[ray]), meets), 3))
    ahead = np.flatnonzero(np.isfinite(apart))
    _take(
        found,
        ahead,
        np.stack([middle[ahead], middle[ahead] + out[ahead] * apart[ahead, None]], axis=1),
        building,
        tree,
    )
    step = millimetres(middle + 1.1 * out)
    for start in (shapely.points(step), houses[building]):
        open_ = np.flatnonzero(shapely.is_missing(found))
        (which, line) = net.query_nearest(start[open_], max_distance=_LONGEST, all_matches=False)
        ends = shapely.get_coordinates(shapely.shortest_line(start[open_[which]], lines[line])).reshape(
            -1, 2, 2
        )
        _take(found, open_[which], ends, building, tree)
    good = ~shapely.is_missing(found)
    return found[good], building[~good]


def _take(
    found: NDArray[np.object_], which: Ints, ends: Floats, building: Ints, houses: shapely.STRtree
) -> None:
    """Note those lines that no other house stands in."""
    lines = np.asarray(shapely.linestrings(millimetres(ends)), object)
    line, house = houses.query(lines, predicate="dwithin", distance=0.3)
    # The own house is met where the way begins; elsewhere it is in the way as others are.
    own = house == building[which[line]]
    shared = shapely.length(shapely.intersection(lines[line], houses.geometries[house]))
    blocked = np.zeros(len(which), bool)
    blocked[line[~own | (shared > 0.05)]] = True
    good = ~blocked & (shapely.length(lines) > 0.01)
    found[which[good]] = lines[good]


def cars_before(plan: Plan, courts: Forecourts, seed: int) -> Cars:
    """A car on each place, its front to the house or to the street."""
    random = chance(seed, 81)
    jitter, turned = random.random((2, len(courts.front)))
    along = courts.side * (_BESIDE + _WIDE / 2) + 0.3 * (jitter - 0.5)
    way = courts.fronts.out[courts.front] * np.where(turned < 0.3, 1.0, -1.0)[:, None]
    return cars_like(millimetres(courts.fronts.at(courts.front, along, _AXIS)), way, random)


def hedges_before(
    plan: Plan,
    houses: shapely.STRtree,
    courts: Forecourts,
    gardens: NDArray[np.bool_],
    things: Things,
    roads: Roads,
    seed: int,
) -> Hedges:
    """Hedges between the gardens (b,) before houses and the street, clear of ways, cars and all else."""
    fronts = courts.fronts
    random = chance(seed, 82)
    wish, size = random.random((2, len(fronts.span)))
    own = np.flatnonzero(
        gardens[fronts.building] & (fronts.kerb >= 3.5) & (fronts.kerb <= 22.0) & (wish < 0.62)
    )
    out = np.round(fronts.kerb[own] - 0.55, 2)
    half = np.round(0.5 * fronts.span[own] + 1.0 + 2.5 * size[own], 2)
    cells = []
    for sign in (-1, 1):
        # In pieces, so that one gives way to a drive and others stay.
        for part in (0, 1):
            low, high = (1.3 + (half - 1.3) * share for share in (0.5 * part, 0.5 * part + 0.5))
            cells.append(np.stack([fronts.at(own, sign * along, out) for along in (low, high)], axis=1))
    ends = millimetres(np.concatenate(cells)) if len(own) else np.zeros((0, 2, 2))
    tall = np.round(np.tile(0.85 + 0.55 * size[own], 4), 2)
    lines = shapely.linestrings(ends)
    good = length(ends[:, 1] - ends[:, 0]) > 0.9
    if len(lines):
        tree = shapely.STRtree(lines)
        good[houses.query(lines, predicate="dwithin", distance=0.7)[0]] = False
        near = [(courts.ways, _WAY + 0.35), (courts.places(), 0.35)]
        near.append((shapely.points(things.at[things.foot == 0]), 0.8))
        for others, distance in near:
            good[tree.query(others, predicate="dwithin", distance=distance)[1]] = False
        net = roads.lines()
        good[tree.query(net, predicate="dwithin", distance=(HALF + WALK)[roads.kind] + 0.3)[1]] = False
        one, other = tree.query(lines, predicate="dwithin", distance=0.5)
        crossing = (one != other) & (np.abs(one - other) % len(own) != 0)
        good[np.maximum(one, other)[crossing]] = False
    most = np.flatnonzero(good)[: int(_HEDGES * len(plan)) + 12]
    return Hedges(ends[most, 0], ends[most, 1], millimetres(tall[most]), np.full(len(most), 0.5))
