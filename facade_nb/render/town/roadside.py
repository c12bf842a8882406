"""What is along the streets of a real town: parked cars, lamps, rows of trees, people on pavements."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, chance, length, millimetres
from .forecourts import Forecourts
from .rings import Ints, ragged
from .roads import HALF, LANE, MAIN, WALK, Roads
from .street_life import Cars, cars_like
from .things import LAMP, LIME, MAPLE, PEOPLE, PERSON, Things

if TYPE_CHECKING:
    from .plan import Plan

__all__ = ["cars_along", "lamps_along", "people_along", "trees_along"]

_CARS, _PEOPLE, _LAMPS, _TREES = 0.09, 0.16, 0.25, 0.2
"""So many of each there are at the most for each house."""

_SLOT, _APART, _ROW = 7.0, 32.0, 11.0
"""From one parked car, lamp, tree to the next, metres."""


def _spots(roads: Roads, which: Ints, step: float, clear: float) -> tuple[Ints, Floats, Floats]:
    """Places along some roads, clear of both ends: the road of each, where it is, and the unit vector along."""
    lines = roads.lines()[which]
    span = np.round(shapely.length(lines), 3)
    count = np.maximum(np.floor((span - 2 * clear) / step).astype(np.int64) + 1, 0)
    road = np.repeat(np.arange(len(which)), count)
    at = clear + step * ragged(np.zeros(len(which), np.int64), count)
    ends = [
        shapely.get_coordinates(shapely.line_interpolate_point(lines[road], at + ahead)).reshape(-1, 2)
        for ahead in (-0.6, 0.0, 0.6)
    ]
    way = ends[2] - ends[0]
    return which[road], ends[1], way / np.maximum(length(way), 1e-9)[:, None]


def _aside(way: Floats, by: Floats | float) -> Floats:
    """To the right of a way."""
    return np.column_stack([way[:, 1], -way[:, 0]]) * np.reshape(by, (-1, 1))


def _free(
    at: Floats,
    others: list[tuple[NDArray[np.object_] | shapely.STRtree, float]],
    roads: Roads,
    own: Ints,
    room: float,
) -> NDArray[np.bool_]:
    """Which points keep away from other things, and from the roadway of other roads than their own."""
    good = np.ones(len(at), bool)
    points = shapely.points(at)
    for shapes, distance in others:
        if len(shapes) and len(at):
            tree = shapes if isinstance(shapes, shapely.STRtree) else shapely.STRtree(shapes)
            good[tree.query(points, predicate="dwithin", distance=distance)[0]] = False
    if len(at):
        lines = roads.lines()
        spot, road = shapely.STRtree(lines).query(points, predicate="dwithin", distance=HALF[MAIN] + room)
        apart = np.round(shapely.distance(points[spot], lines[road]), 3)
        good[spot[(road != own[spot]) & (apart < HALF[roads.kind[road]] + room)]] = False
    return good


def cars_along(plan: Plan, houses: shapely.STRtree, courts: Forecourts, roads: Roads, seed: int) -> Cars:
    """Cars parked at the edges of streets, none before a way or a drive."""
    random = chance(seed, 85)
    road, at, way = _spots(roads, np.flatnonzero(roads.kind < LANE), _SLOT, 9.0)
    wish, jitter, side = random.random((3, len(road)))
    # In a street they stand on one side.
    right = np.where(chance(seed, 86).random(len(roads))[road] < 0.5, 1.0, -1.0)
    at = at + way * (1.2 * (jitter - 0.5))[:, None]
    at = millimetres(at + _aside(way, right * (HALF[roads.kind[road]] - 1.05)))
    good = (wish < 0.34) & _free(
        at, [(houses, 3.0), (courts.ways, 3.2), (courts.places(), 3.2)], roads, road, 3.0
    )
    kept = np.flatnonzero(good)
    kept = np.sort(kept[np.lexsort((kept, np.round(wish[kept], 6)))][: int(_CARS * len(plan)) + 4])
    heads = way[kept] * np.where(side[kept] < 0.9, right[kept], -right[kept])[:, None]
    return cars_like(at[kept], heads, random)


def lamps_along(plan: Plan, houses: shapely.STRtree, courts: Forecourts, roads: Roads, seed: int) -> Things:
    """Lamps at the edges of streets, on one side."""
    road, at, way = _spots(roads, np.flatnonzero(roads.kind < LANE), _APART, 6.0)
    right = np.where(chance(seed, 83).random(len(roads))[road] < 0.5, 1.0, -1.0)
    at = millimetres(at + _aside(way, right * (HALF[roads.kind[road]] + 0.45)))
    good = _free(at, [(houses, 0.7), (courts.ways, 1.0), (courts.places(), 0.4)], roads, road, 0.4)
    points = shapely.points(at[good])
    one, other = shapely.STRtree(points).query(points, predicate="dwithin", distance=0.4 * _APART)
    alone = np.ones(len(points), bool)
    alone[np.maximum(one, other)[one != other]] = False
    return Things.of(at[good][alone][: int(_LAMPS * len(plan)) + 6], LAMP, 4.4, 0.8)


def trees_along(
    plan: Plan, houses: shapely.STRtree, courts: Forecourts, roads: Roads, lamps: Things, seed: int
) -> Things:
    """Rows of trees along some streets, behind the pavement."""
    lined = chance(seed, 87).random(len(roads))
    some = np.flatnonzero((roads.kind == MAIN) | ((roads.kind < LANE) & (lined < 0.3)))
    road, at, way = _spots(roads, some, _ROW, 7.0)
    right = np.where(lined[road] < 0.15, 1.0, -1.0)
    wide = np.round(3.4 + 1.2 * chance(seed, 88).random(len(road)), 2)
    at = millimetres(at + _aside(way, right * ((HALF + WALK)[roads.kind[road]] + 0.9)))
    good = _free(
        at,
        [(houses, 3.2), (courts.ways, 1.4), (courts.places(), 1.0), (shapely.points(lamps.at), 2.0)],
        roads,
        road,
        1.2,
    )
    kept = np.flatnonzero(good)[: int(_TREES * len(plan)) + 4]
    kind = np.where(chance(seed, 89).random(len(roads))[road[kept]] < 0.6, LIME, MAPLE)
    return Things.of(at[kept], kind, np.round(1.6 * wide[kept] + 1.3, 2), wide[kept])


def people_along(
    plan: Plan,
    houses: shapely.STRtree,
    courts: Forecourts,
    roads: Roads,
    cars: Cars,
    things: Things,
    seed: int,
) -> Things:
    """People on pavements, and at the edges of streets that have none; clear of houses, cars, trees and lamps."""
    random = chance(seed, 84)
    road, at, way = _spots(roads, np.flatnonzero(roads.kind < LANE), 9.0, 4.0)
    wish, jitter, out, side = random.random((4, len(road)))
    half, walk = HALF[roads.kind[road]], WALK[roads.kind[road]]
    aside = np.where(side < 0.5, -1.0, 1.0) * (half + 0.4 + (walk - 0.7) * out)
    at = millimetres(at + way * (7.0 * (jitter - 0.5))[:, None] + _aside(way, aside))
    stems = shapely.points(things.at[(things.foot == 0) & (things.kind <= LAMP)])
    # Cars are two metres wide: what keeps away from their middles that far keeps away from them.
    ends = cars.way * (cars.long / 2)[:, None]
    axes = shapely.linestrings(np.stack([cars.at - ends, cars.at + ends], axis=1))
    good = (wish < 0.5) & _free(at, [(houses, 0.45), (stems, 0.75), (axes, 1.25)], roads, road, 0.4)
    kept = np.flatnonzero(good)
    kept = np.sort(kept[np.lexsort((kept, np.round(wish[kept], 6)))][: int(_PEOPLE * len(plan)) + 6])
    kind = random.integers(0, PEOPLE, len(kept))
    tall = 1.60 + 0.02 * random.integers(0, 14, len(kept))
    return Things.of(at[kept], PERSON + kind, tall, 0.7 * tall / 1.86)
