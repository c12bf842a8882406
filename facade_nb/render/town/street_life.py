"""Who and what is in the streets: people on pavements and squares, cars at kerbs and in lanes, hedges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, chance, length, millimetres
from .footprints import District
from .rings import Ints, after, ragged, ring_numbers
from .streets import LANE, MINOR, SECOND, WALKS, WIDTHS, Cells
from .things import LAMP, PEOPLE, PERSON, Things

if TYPE_CHECKING:
    from .plan import Plan

__all__ = [
    "NO_CARS",
    "NO_HEDGES",
    "Cars",
    "Hedges",
    "cars_like",
    "cars_of",
    "hedges_of",
    "people_of",
    "ways_of",
]

_SLOT, _CLEAR = 6.0, 9.5
"""From one parked car to the next, and from a crossing to the first, metres."""

_KINDS, _LONG = (0.42, 0.66, 0.89), np.array([3.7, 4.3, 4.3, 4.5])
"""Up to which part of all cars each kind goes, and how long one is at least, metres."""

_CARS, _PEOPLE, _HEDGES = 0.16, 0.16, 0.4
"""So many of each there are at the most for each house: so memory stays in bounds."""

_SQUARE = 70.0
"""Square metres of a square for each of those who walk there."""


@dataclass(frozen=True, slots=True, eq=False)
class Cars:
    """Cars as flat arrays.

    Attributes
    ----------
    at
        (c, 2) the middle of each, metres.
    way
        (c, 2) unit vectors: where it heads.
    kind
        (c,) 0 hatchback, 1 saloon, 2 estate, 3 van.
    moves
        (c,) whether it is on its way: then its lamps are lit by night.
    long
        (c,) metres.
    seed
        (c, 2) steps of 1/64 m.
    """

    at: Floats
    way: Floats
    kind: Ints
    moves: NDArray[np.bool_]
    long: Floats
    seed: Ints

    def __len__(self) -> int:
        return len(self.at)

    def __add__(self, other: Cars) -> Cars:
        pairs = ((getattr(self, name), getattr(other, name)) for name in self.__slots__)
        return Cars(*(np.concatenate(pair) for pair in pairs))


@dataclass(frozen=True, slots=True, eq=False)
class Hedges:
    """Hedges (h, …): where the middle line of each begins and ends, and how high and wide it is, metres."""

    start: Floats
    end: Floats
    tall: Floats
    wide: Floats

    def __len__(self) -> int:
        return len(self.start)


NO_CARS = Cars(
    np.zeros((0, 2)),
    np.zeros((0, 2)),
    np.zeros(0, np.int64),
    np.zeros(0, bool),
    np.zeros(0),
    np.zeros((0, 2), np.int64),
)
NO_HEDGES = Hedges(np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0), np.zeros(0))


@dataclass(frozen=True, slots=True, eq=False)
class _Kerbs:
    """Kerbs (k, …) of cells that are built up: foot, unit vector along, towards the houses, span, kind, reach."""

    foot: Floats
    unit: Floats
    inward: Floats
    span: Floats
    kind: Ints
    reach: Floats
    edge: Ints

    @classmethod
    def of(cls, cells: Cells, built: Ints) -> _Kerbs:
        number = ring_numbers(cells.offsets)
        own = np.isin(number, built) & (cells.sizes > 0)[number]
        start = np.flatnonzero(own)
        foot = cells.kerbs[start]
        way = cells.kerbs[after(cells.offsets)[start]] - foot
        span = length(way)
        kept = span > 4.0
        start, foot, way, span = start[kept], foot[kept], way[kept], span[kept]
        unit = way / span[:, None]
        inward = np.column_stack([-unit[:, 1], unit[:, 0]])
        return cls(foot, unit, inward, span, cells.street[start], cells.reach[number[start]], start)

    def slots(self, which: Ints, step: float, clear: float) -> tuple[Ints, Floats]:
        """Places along some kerbs, clear of both ends: the kerb of each, and metres from its foot."""
        room = np.maximum(np.floor((self.span[which] - 2 * clear) / step).astype(np.int64) + 1, 0)
        edge = np.repeat(which, room)
        at = ragged(np.zeros(len(which), np.int64), room) * step
        spare = np.repeat((self.span[which] - 2 * clear - (room - 1) * step) / 2, room)
        return edge, clear + at + spare


def cars_of(cells: Cells, built: Ints, houses: int, seed: int) -> Cars:
    """Cars that are parked at kerbs, and some on their way, more of them where the town is dense."""
    kerbs = _Kerbs.of(cells, built)
    half = (WIDTHS / 2 - WALKS)[kerbs.kind]
    # In small streets they stand on one side, that without lamps.
    free = (kerbs.kind < MINOR) | ((kerbs.kind == MINOR) & (kerbs.unit[:, 0] + 0.618 * kerbs.unit[:, 1] <= 0))
    random = chance(seed, 70)
    edge, along = kerbs.slots(np.flatnonzero(free & (kerbs.kind < LANE)), _SLOT, _CLEAR)
    moved, moving = kerbs.slots(np.flatnonzero(kerbs.kind <= SECOND), 34.0, 14.0)
    parked = np.append(np.ones(len(edge), bool), np.zeros(len(moved), bool))
    edge, along = np.append(edge, moved), np.append(along, moving)
    wish, jitter, kind, size, turned = random.random((5, len(edge)))
    along = along + np.where(parked, 0.7, 9.0) * (jitter - 0.5)
    aside = np.where(parked, 1.08, np.minimum(half[edge] - 1.6, 4.1))
    score = np.round(wish + 0.55 * kerbs.reach[edge] + np.where(parked, 0.0, 0.12), 6)
    order = np.lexsort((np.arange(len(edge)), score))
    order = order[score[order] < 1.0][: int(_CARS * houses) + 12]
    chosen = np.sort(order)
    edge, parked = edge[chosen], parked[chosen]
    at = kerbs.foot[edge] + kerbs.unit[edge] * along[chosen, None] - kerbs.inward[edge] * aside[chosen, None]
    # One drives on the right: the kerb lies on the right of who goes the other way than its edge.
    back = np.where(parked & (turned[chosen] < 0.12), 1.0, -1.0)
    way = kerbs.unit[edge] * back[:, None]
    return _cars(millimetres(at), way, ~parked, kind[chosen], size[chosen], random)


def _cars(
    at: Floats, way: Floats, moves: NDArray[np.bool_], kind: Floats, size: Floats, random: np.random.Generator
) -> Cars:
    """Cars at places; of what kind and how long each is follows from two numbers from 0 to 1."""
    sort = np.searchsorted(_KINDS, kind, side="right")
    long = _LONG[sort] + np.round(0.3 * size, 2)
    return Cars(at, way, sort, moves, millimetres(long), random.integers(0, 1 << 20, (len(at), 2)))


def cars_like(at: Floats, way: Floats, random: np.random.Generator) -> Cars:
    """Cars at places, of all kinds, as they are parked in streets."""
    kind, size = random.random((2, len(at)))
    return _cars(at, way, np.zeros(len(at), bool), kind, size, random)


def people_of(plan: Plan, cells: Cells, built: Ints, things: Things, seed: int) -> Things:
    """People on pavements and squares, none in a house, a tree or a lamp."""
    kerbs = _Kerbs.of(cells, built)
    random = chance(seed, 71)
    walk = WALKS[kerbs.kind]
    edge, along = kerbs.slots(np.flatnonzero(walk > 1.5), 7.0, 4.5)
    wish, jitter, aside = random.random((3, len(edge)))
    score = np.round(wish + 0.9 * kerbs.reach[edge], 6)
    order = np.lexsort((np.arange(len(edge)), score))
    chosen = np.sort(order[score[order] < 0.95][: int(_PEOPLE * len(plan)) + 12])
    edge, along, aside = edge[chosen], (along + 6.0 * (jitter - 0.5))[chosen], aside[chosen]
    out = 0.55 + (walk[edge] - 1.1) * aside
    at = kerbs.foot[edge] + kerbs.unit[edge] * along[:, None] + kerbs.inward[edge] * out[:, None]
    at = millimetres(np.concatenate([at, _on_squares(plan, seed)]))
    points = shapely.points(at)
    walls = shapely.STRtree(
        shapely.polygons(shapely.linearrings(plan.corners, indices=ring_numbers(plan.rings)))
    )
    near = things.take((things.kind <= LAMP) & (things.foot == 0))
    ground = plan.ground
    roads = shapely.STRtree(
        shapely.polygons(ground.corners[ground.triangles[ground.kind[ground.triangles[:, 0]] == 0]])
    )
    good = np.ones(len(at), bool)
    good[roads.query(points, predicate="dwithin", distance=0.45)[0]] = False
    good[walls.query(points, predicate="dwithin", distance=0.45)[0]] = False
    good[shapely.STRtree(shapely.points(near.at)).query(points, predicate="dwithin", distance=0.75)[0]] = (
        False
    )
    at = at[good]
    kind = random.integers(0, PEOPLE, len(at))
    tall = 1.60 + 0.02 * random.integers(0, 14, len(at))
    return Things.of(at, PERSON + kind, tall, 0.7 * tall / 1.86)


def _on_squares(plan: Plan, seed: int) -> Floats:
    """Points on what is paved and no strip along a street."""
    ground = plan.ground
    first = ground.triangles[:, 0]
    paved = (ground.kind[first] == ground.names.index("pavement")) & ~ground.along[first]
    a, b, c = (ground.corners[ground.triangles[paved, k]] for k in range(3))
    area = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    count = np.floor(np.round(area / _SQUARE, 6)).astype(np.int64)
    which = np.repeat(np.arange(len(count)), count)
    u, v = chance(seed, 72).random((2, len(which)))
    over = u + v > 1
    u, v = np.where(over, 1 - u, u), np.where(over, 1 - v, v)
    return np.asarray(a[which] + (b - a)[which] * u[:, None] + (c - a)[which] * v[:, None])


def hedges_of(plan: Plan, cells: Cells, district: Ints, built: Ints, things: Things, seed: int) -> Hedges:
    """Hedges along the street before houses in gardens: none before a door, in a tree or in a house."""
    garden = built[np.isin(district[built], (District.ROWS, District.DETACHED))]
    kerbs = _Kerbs.of(cells, garden)
    random = chance(seed, 73)
    ends = after(cells.offsets)[kerbs.edge]
    foot, end = cells.blocks[kerbs.edge], cells.blocks[ends]
    span = length(end - foot)
    step = 8.0
    room = np.maximum(np.floor((span - 3.0) / step).astype(np.int64), 0)
    edge = np.repeat(np.arange(len(span)), room)
    begin = 1.5 + ragged(np.zeros(len(span), np.int64), room) * step
    wish, size, low, high = random.random((4, len(edge)))
    street = chance(seed, 74).random(len(span))[edge]
    chosen = np.flatnonzero(wish < 0.25 + 0.6 * street)
    unit = ((end - foot) / np.maximum(span, 1e-9)[:, None])[edge[chosen]]
    inward = np.column_stack([-unit[:, 1], unit[:, 0]])
    start = foot[edge[chosen]] + unit * (begin[chosen] + 0.4 * low[chosen])[:, None] + inward * 0.45
    stop = start + unit * (5.2 + 2.2 * size[chosen])[:, None]
    start, stop = millimetres(start), millimetres(stop)
    tall = np.round(0.85 + 0.6 * street[chosen] * high[chosen] + 0.25 * street[chosen], 2)
    wide = np.full(len(start), 0.5)
    lines = shapely.linestrings(np.stack([start, stop], axis=1))
    good = np.ones(len(lines), bool)
    if len(lines):
        tree = shapely.STRtree(lines)
        houses = shapely.polygons(shapely.linearrings(plan.corners, indices=ring_numbers(plan.rings)))
        good[tree.query(houses, predicate="dwithin", distance=0.7)[1]] = False
        stems = shapely.points(things.at[(things.foot == 0)])
        good[tree.query(stems, predicate="dwithin", distance=0.8)[1]] = False
        good[tree.query(ways_of(plan), predicate="dwithin", distance=0.9)[1]] = False
        # Two that meet at a corner: the first stays.
        one, other = tree.query(lines, predicate="dwithin", distance=0.6)
        good[np.maximum(one, other)[one != other]] = False
    most = np.flatnonzero(good)
    most = np.sort(most[np.lexsort((most, np.round(wish[chosen][most], 6)))][: int(_HEDGES * len(plan)) + 12])
    return Hedges(start[most], stop[most], millimetres(tall[most]), wide[most])


def ways_of(plan: Plan) -> np.ndarray:
    """Lines from doors straight out, as far as a front garden is deep."""
    edge = plan.entrance[plan.entrance >= 0]
    a, b = plan.corners[edge], plan.corners[plan.following[edge]]
    way = b - a
    out = np.column_stack([way[:, 1], -way[:, 0]]) / np.maximum(length(way), 1e-9)[:, None]
    middle = (a + b) / 2
    return np.asarray(shapely.linestrings(np.stack([middle, middle + 9.0 * out], axis=1)))
