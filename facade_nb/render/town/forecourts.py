"""Before real houses, of which no street is known: a paved place with a car, hedges, lamps, people.

Streets are not guessed. What stands there follows from the walls that look out (`openness`) and from how much room
there is before them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, chance, length, millimetres
from .neighbours import Cut
from .rings import Ints, after, ring_numbers
from .roles import STREET
from .street_life import Cars, Hedges, cars_like, ways_of
from .things import LAMP, PEOPLE, PERSON, Things

if TYPE_CHECKING:
    from .plan import Plan

__all__ = ["Forecourts", "cars_before", "forecourts_of", "hedges_before", "lamps_before", "people_before"]

_BESIDE, _LONG, _DEEP, _AXIS = 1.9, 5.8, 4.0, 2.75
"""From the front's middle, where its door may be, to the place; how long and deep that is; from wall to car, metres."""

_ROOM = 8.5
"""Free metres before a wall that has a place for a car."""

_CARS, _PEOPLE, _HEDGES, _LAMPS = 0.3, 0.16, 0.4, 0.2
"""So many of each there are at the most for each house."""

_APART = 26.0
"""From one lamp to the next, metres."""


@dataclass(frozen=True, slots=True, eq=False)
class _Fronts:
    """The widest wall of each building that looks out: middle, unit vectors along and outwards, span, gap, building."""

    middle: Floats
    unit: Floats
    out: Floats
    span: Floats
    gap: Floats
    building: Ints

    @classmethod
    def of(
        cls, corners: Floats, following: Ints, building: Ints, roles: NDArray[np.uint8], gaps: Floats
    ) -> _Fronts:
        way = corners[following] - corners
        span = np.round(length(way), 3)
        edge = np.flatnonzero((roles == STREET) & (span >= 4.0) & (gaps >= 4.0))
        order = edge[np.lexsort((edge, -span[edge], building[edge]))]
        first = (
            np.append(True, building[order][1:] != building[order][:-1]) if len(order) else np.zeros(0, bool)
        )
        own = order[first]
        unit = way[own] / span[own, None]
        out = np.column_stack([unit[:, 1], -unit[:, 0]])
        return cls(corners[own] + way[own] / 2, unit, out, span[own], gaps[own], building[own])

    def at(self, which: Ints, along: Floats, out: Floats | float) -> Floats:
        """Points so far along some fronts from their middles, and so far before them."""
        ahead = np.broadcast_to(np.asarray(out, float), (len(which),))
        return np.asarray(
            self.middle[which] + self.unit[which] * along[:, None] + self.out[which] * ahead[:, None]
        )


@dataclass(frozen=True, slots=True, eq=False)
class Forecourts:
    """Fronts, and the paved places before some of them: corners (p, 4, 2), which front, on which side of its middle."""

    fronts: _Fronts
    corners: Floats
    front: Ints
    side: Floats


def forecourts_of(
    cut: Cut, building: Ints, roles: NDArray[np.uint8], gaps: Floats, houses: NDArray[np.object_], seed: int
) -> Forecourts:
    """Places for cars where there is room for one.

    Parameters
    ----------
    building
        (n,) of each edge.
    houses
        All footprints, as polygons.
    """
    fronts = _Fronts.of(cut.corners, after(cut.offsets), building, roles, gaps)
    wish, side = chance(seed, 80).random((2, len(fronts.span)))
    own = np.flatnonzero((fronts.gap >= _ROOM) & (wish < 0.62))
    sign = np.where(side[own] < 0.5, -1.0, 1.0)
    near, far = sign * _BESIDE, sign * (_BESIDE + _LONG)
    low, high = np.minimum(near, far), np.maximum(near, far)
    spots = [(low, 0.0), (high, 0.0), (high, _DEEP), (low, _DEEP)]
    corners = millimetres(np.stack([fronts.at(own, *spot) for spot in spots], axis=1)[:, ::-1])
    clear = shapely.polygons(
        np.stack([fronts.at(own, along, max(out, 0.35)) for along, out in spots], axis=1)
    )
    good = np.ones(len(own), bool)
    if len(own):
        tree = shapely.STRtree(clear)
        good[tree.query(houses, predicate="dwithin", distance=0.3)[1]] = False
        one, other = tree.query(clear, predicate="dwithin", distance=0.4)
        good[np.maximum(one, other)[(one != other) & good[one] & good[other]]] = False
    kept = np.flatnonzero(good)
    kept = np.sort(kept[np.lexsort((kept, np.round(wish[own[kept]], 6)))][: int(_CARS * len(houses)) + 6])
    return Forecourts(fronts, corners[kept], own[kept], sign[kept])


def cars_before(plan: Plan, courts: Forecourts, seed: int) -> Cars:
    """A car on each place, but for those before a door that is not where one would look for it."""
    random = chance(seed, 81)
    jitter, turned = random.random((2, len(courts.front)))
    along = courts.side * (_BESIDE + _LONG / 2) + 0.5 * (jitter - 0.5)
    way = courts.fronts.unit[courts.front] * np.where(turned < 0.5, -1.0, 1.0)[:, None]
    at = millimetres(courts.fronts.at(courts.front, along, _AXIS))
    good = np.ones(len(at), bool)
    if len(at):
        axes = shapely.linestrings(np.stack([at - 2.4 * way, at + 2.4 * way], axis=1))
        good[shapely.STRtree(axes).query(ways_of(plan), predicate="dwithin", distance=1.5)[1]] = False
    return cars_like(at[good], way[good], random)


def hedges_before(
    plan: Plan, courts: Forecourts, gardens: NDArray[np.bool_], things: Things, seed: int
) -> Hedges:
    """Hedges across the gardens (b,) before houses, on both sides of the way to the door, clear of all else."""
    fronts = courts.fronts
    random = chance(seed, 82)
    wish, aside, size = random.random((3, len(fronts.span)))
    own = np.flatnonzero(gardens[fronts.building] & (fronts.gap >= 11.0) & (wish < 0.6))
    out = np.round(np.minimum(0.42 * fronts.gap[own], 5.2 + 2.4 * aside[own]), 2)
    half = 0.5 * fronts.span[own] + 1.5 + 2.0 * size[own]
    start = np.concatenate([fronts.at(own, np.full(len(own), sign * 1.5), out) for sign in (-1, 1)])
    end = np.concatenate([fronts.at(own, sign * half, out) for sign in (-1, 1)])
    start, end = millimetres(start), millimetres(end)
    tall = np.round(np.tile(0.85 + 0.55 * aside[own], 2), 2)
    lines = shapely.linestrings(np.stack([start, end], axis=1))
    good = length(end - start) > 1.5
    if len(lines):
        tree = shapely.STRtree(lines)
        good[tree.query(_houses(plan), predicate="dwithin", distance=0.7)[1]] = False
        good[tree.query(ways_of(plan), predicate="dwithin", distance=0.9)[1]] = False
        good[tree.query(shapely.polygons(courts.corners), predicate="dwithin", distance=0.6)[1]] = False
        good[
            tree.query(shapely.points(things.at[things.foot == 0]), predicate="dwithin", distance=0.8)[1]
        ] = False
        one, other = tree.query(lines, predicate="dwithin", distance=0.6)
        good[np.maximum(one, other)[one != other]] = False
    most = np.flatnonzero(good)[: int(_HEDGES * len(plan)) + 12]
    return Hedges(start[most], end[most], millimetres(tall[most]), np.full(len(most), 0.5))


def lamps_before(plan: Plan, courts: Forecourts, seed: int) -> Things:
    """Lamps on the strips before houses, at one end of the front, none near another."""
    fronts = courts.fronts
    side = np.where(chance(seed, 83).random(len(fronts.span)) < 0.5, -1.0, 1.0)
    own = np.flatnonzero(fronts.gap >= 6.0)
    at = millimetres(fronts.at(own, side[own] * (0.5 * fronts.span[own] - 0.4), 1.25))
    # One in each cell of a net, and none of two across its lines that are near.
    cell = np.floor(at / _APART).astype(np.int64)
    _, first = np.unique(cell, axis=0, return_index=True)
    at = at[np.sort(first)]
    good = np.ones(len(at), bool)
    if len(at):
        points = shapely.points(at)
        one, other = shapely.STRtree(points).query(points, predicate="dwithin", distance=0.6 * _APART)
        good[np.maximum(one, other)[one != other]] = False
        good[shapely.STRtree(_houses(plan)).query(points, predicate="dwithin", distance=0.7)[0]] = False
        if len(courts.corners):
            places = shapely.STRtree(shapely.polygons(courts.corners))
            good[places.query(points, predicate="dwithin", distance=0.2)[0]] = False
    return Things.of(at[good][: int(_LAMPS * len(plan)) + 6], LAMP, 4.4, 0.8)


def people_before(plan: Plan, courts: Forecourts, cars: Cars, things: Things, seed: int) -> Things:
    """People on the strips before houses and beside cars."""
    fronts = courts.fronts
    random = chance(seed, 84)
    wish, along, out = random.random((3, len(fronts.span)))
    own = np.flatnonzero(wish < 0.4)
    at = millimetres(
        fronts.at(own, (along[own] - 0.5) * np.minimum(fronts.span[own], 12.0), 0.7 + 0.7 * out[own])
    )
    points = shapely.points(at)
    good = np.ones(len(at), bool)
    if len(at):
        stems = shapely.points(things.at[(things.foot == 0) & (things.kind <= LAMP)])
        # Cars are two metres wide: what keeps away from their middles that far keeps away from them.
        ends = cars.way * (cars.long / 2)[:, None]
        axes = shapely.linestrings(np.stack([cars.at - ends, cars.at + ends], axis=1))
        for others, distance in ((_houses(plan), 0.45), (stems, 0.75), (axes, 1.25)):
            good[shapely.STRtree(others).query(points, predicate="dwithin", distance=distance)[0]] = False
    kept = np.flatnonzero(good)
    kept = np.sort(kept[np.lexsort((kept, np.round(wish[own[kept]], 6)))][: int(_PEOPLE * len(plan)) + 6])
    kind = random.integers(0, PEOPLE, len(kept))
    tall = 1.60 + 0.02 * random.integers(0, 14, len(kept))
    return Things.of(at[kept], PERSON + kind, tall, 0.7 * tall / 1.86)


def _houses(plan: Plan) -> NDArray[np.object_]:
    outer = np.flatnonzero(~plan.holes)
    return np.asarray(
        shapely.polygons(shapely.linearrings(plan.corners, indices=ring_numbers(plan.rings)))[outer], object
    )
