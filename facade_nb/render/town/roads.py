"""Streets among real buildings: as they are told, else along the passages that most houses look at.

Where nothing is told, long straight passages between rows of houses become streets, those first along which most houses
stand that have none yet. What is left apart is joined by the shortest way.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from itertools import combinations, pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, length, millimetres
from .linking import groups_of
from .passages import Passages, runs_of
from .rings import Ints, after, offsets_of, ring_numbers, take_rings

__all__ = ["HALF", "LANE", "MAIN", "NO_ROADS", "STREET", "WALK", "Roads", "laid_out", "told"]

MAIN, STREET, LANE = range(3)
"""Kinds of roads, the widest first."""

HALF = np.array([3.3, 2.7, 1.7])
"""Half of a roadway, metres."""

WALK = np.array([2.0, 1.5, 0.0])
"""Pavement on each side, metres."""

_MANY = 14
"""Along a main street stand so many buildings, at least."""

_INDOORS = 0.3
"""No road's middle is so near to a house, metres."""

_SHORT = 70.0
"""What joins two streets is a street itself where it is no longer, metres; else a lane."""

_STRAIGHT = -0.77
"""Passages go on in each other where they turn by less than 40 degrees: cosine of the angle between them."""

_AWAY, _BEYOND = 10.0, 45.0
"""A street before a single house is so far from its wall, and goes on so far beyond it, metres."""

_TANGENT = 9.0
"""So far from a joint a passage's direction is taken, metres."""

_GOOD = 0.4
"""A passage is a building's street where it suits it at least so much as the one that suits it best."""

_TOLERANCES = (5.0, 3.0, 1.6, 0.8, 0.3)
"""How far a street is drawn straight at the most, metres: the first by which it keeps away from houses."""


@dataclass(frozen=True, slots=True, eq=False)
class Roads:
    """Roads in the middle of which lines run.

    Attributes
    ----------
    offsets, points
        The line of road k: ``points[offsets[k]:offsets[k + 1]]``, whole millimetres.
    kind
        (k,) MAIN, STREET, LANE.
    """

    offsets: Ints
    points: Floats
    kind: Ints

    def __len__(self) -> int:
        return len(self.kind)

    def lines(self) -> NDArray[np.object_]:
        """As shapely's lines."""
        return np.asarray(shapely.linestrings(self.points, indices=ring_numbers(self.offsets)), object)

    def take(self, chosen: Ints) -> Roads:
        """Some of them."""
        index, offsets = take_rings(self.offsets, chosen)
        return Roads(offsets, self.points[index], self.kind[chosen])

    @classmethod
    def of(cls, lines: Sequence[Floats], kind: Ints) -> Roads:
        """Roads of lines (p, 2)."""
        points = np.concatenate(lines) if len(lines) else np.zeros((0, 2))
        return cls(offsets_of(np.array([len(line) for line in lines], np.int64)), points, np.asarray(kind))


NO_ROADS = Roads.of([], np.zeros(0, np.int64))
"""None."""


def laid_out(
    passages: Passages, offsets: Ints, corners: Floats, houses: NDArray[np.object_], large: NDArray[np.bool_]
) -> Roads:
    """Streets along passages.

    Parameters
    ----------
    passages
        Between the buildings.
    offsets, corners
        The buildings' outer rings.
    houses
        The same as polygons.
    large
        (b,) which of them want a street: sheds do without.
    """
    if not len(passages):
        return _before(offsets, corners, houses)
    worth = np.where(large[passages.sides], _worth(passages, offsets, corners, len(houses)), 0.0)
    runs, kinds = _streets(passages, _strokes(passages), worth, len(houses))
    if not runs:
        return _before(offsets, corners, houses)
    joined = _connections(passages, {number for run in runs for number, _ in run})
    runs += joined
    long = [sum(passages.span[number] for number, _ in run) for run in joined]
    kinds += [LANE if span > _SHORT else STREET for span in long]
    lines = [_line(passages, run) for run in runs]
    starts = [(_joint(passages, run, 0), _joint(passages, run, -1)) for run in runs]
    roads = _met(
        _straightened(lines, np.array(kinds), houses), starts, runs, passages, shapely.STRtree(houses)
    )
    out = np.ones(len(roads), bool)
    out[shapely.STRtree(houses).query(roads.lines(), predicate="dwithin", distance=_INDOORS)[0]] = False
    return roads.take(np.flatnonzero(out))


_KINDS: Mapping[str, int] = {
    **dict.fromkeys(("motorway", "trunk", "primary", "secondary", "tertiary"), MAIN),
    **dict.fromkeys(("residential", "unclassified", "living_street", "pedestrian", "road"), STREET),
    **dict.fromkeys(("service", "track", "footway", "path", "cycleway", "bridleway"), LANE),
}
"""Kinds of roads by OpenStreetMap's ``highway``; links are as what they lead to, others are none."""


def told(lines: Sequence[tuple[Floats, str]], houses: NDArray[np.object_]) -> Roads:
    """Roads as they are told, without what runs through houses.

    Parameters
    ----------
    lines
        Each with the value of its ``highway``.
    houses
        As polygons.
    """
    found, kinds = [], []
    tree = shapely.STRtree(houses)
    for points, value in lines:
        kind = _KINDS.get(value.removesuffix("_link"))
        if kind is None:
            continue
        line = shapely.LineString(points)
        near = tree.query(line, predicate="dwithin", distance=_INDOORS)
        if len(near):
            line = shapely.difference(
                line, shapely.union_all(shapely.buffer(houses[near], _INDOORS, join_style="mitre"))
            )
        for part in shapely.get_parts(line):
            own = millimetres(shapely.get_coordinates(part))
            if shapely.length(part) > 2.0:
                found.append(own)
                kinds.append(kind)
    return Roads.of(found, np.array(kinds, np.int64))


def _worth(passages: Passages, offsets: Ints, corners: Floats, count: int) -> Floats:
    """How well each passage (m, 2) suits the buildings on its sides as their street; 0 where another does better."""
    way = corners[after(offsets)] - corners
    span = np.round(length(way), 3)
    owner = ring_numbers(offsets)
    longest = np.lexsort((np.arange(len(span)), -span, owner))
    first = longest[np.append(True, owner[longest][1:] != owner[longest][:-1])]
    axis = way[first] / np.maximum(span[first], 1e-9)[:, None]
    chord = passages.joints[passages.ends[:, 1]] - passages.joints[passages.ends[:, 0]]
    unit = chord / np.maximum(length(chord), 1e-9)[:, None]
    own = axis[passages.sides]
    dot = np.abs((own * unit[:, None]).sum(axis=2))
    cross = np.abs(own[..., 0] * unit[:, None, 1] - own[..., 1] * unit[:, None, 0])
    along = 0.25 + 0.75 * (np.maximum(dot, cross) - 0.7071) / 0.2929
    wide = np.clip((passages.room - 1.6) / 6.0, 0.03, 1) * np.minimum(1, 18.0 / passages.room)
    worth = np.round(along * (wide * np.minimum(passages.span, 22.0))[:, None], 3)
    best = np.zeros(count)
    np.maximum.at(best, passages.sides, worth)
    return np.where(worth >= _GOOD * best[passages.sides], worth, 0.0)


def _before(offsets: Ints, corners: Floats, houses: NDArray[np.object_]) -> Roads:
    """A street before a house that stands alone, or houses wall to wall: along the longest wall that is free."""
    way = corners[after(offsets)] - corners
    span = np.round(length(way), 3)
    unit = way / np.maximum(span, 1e-9)[:, None]
    out = np.column_stack([unit[:, 1], -unit[:, 0]])
    for edge in np.lexsort((np.arange(len(span)), -span)).tolist():
        foot = corners[edge] + _AWAY * out[edge]
        line = millimetres(
            np.array([foot - _BEYOND * unit[edge], foot + (span[edge] + _BEYOND) * unit[edge]])
        )
        if not shapely.dwithin(houses, shapely.LineString(line), _AWAY - 0.1).any():
            return Roads.of([line], np.array([STREET]))
    return NO_ROADS


def _strokes(passages: Passages) -> list[list[tuple[int, int]]]:
    """Passages that go straight on in each other."""
    count = len(passages)
    points, begin, end = passages.points, passages.offsets[:-1], passages.offsets[1:] - 1
    owner, place = ring_numbers(passages.offsets), np.arange(len(points))
    # From each end to the first point that is far enough, else to the other end.
    away = [length(points - points[ends][owner]) >= _TANGENT for ends in (begin, end)]
    first = np.minimum.reduceat(np.where(away[0], place, end[owner]), begin)
    last = np.maximum.reduceat(np.where(away[1], place, begin[owner]), begin)
    ways = np.stack([points[first] - points[begin], points[last] - points[end]], axis=1)
    ways /= np.maximum(length(ways), 1e-9)[..., None]
    ends = passages.ends.ravel()
    order = np.argsort(ends, kind="stable")
    begin = np.searchsorted(ends[order], np.arange(len(passages.joints) + 1))
    pairs: list[tuple[int, int]] = []
    met = order.tolist()
    for low, high in pairwise(begin.tolist()):
        pairs += combinations(met[low:high], 2)
    a, b = np.array(pairs, np.int64).reshape(-1, 2).T
    flat = ways.reshape(-1, 2)
    dot = np.round((flat[a] * flat[b]).sum(axis=1), 4)
    links = [-1] * (2 * count)
    straight = np.lexsort((b, a, dot))[: int((dot <= _STRAIGHT).sum())]
    for i, j in zip(a[straight].tolist(), b[straight].tolist(), strict=True):
        if links[i] < 0 and links[j] < 0 and i // 2 != j // 2:
            links[i], links[j] = j, i
    return runs_of(np.array(links, np.int64).reshape(-1, 2))


def _streets(
    passages: Passages, strokes: list[list[tuple[int, int]]], worth: Floats, count: int
) -> tuple[list[list[tuple[int, int]]], list[int]]:
    """The strokes that are streets, cut where no house needs them any more, and their kinds."""
    sides, value, span = passages.sides.tolist(), worth.tolist(), passages.span.tolist()
    served = [False] * count

    def gain(run: list[tuple[int, int]]) -> tuple[float, int, int, int]:
        """What a stroke is worth, how many it serves anew, and the part of it along which these stand."""
        new: dict[int, float] = {}
        first, last = len(run), -1
        for place, (number, _) in enumerate(run):
            for side in (0, 1):
                building, own = sides[number][side], value[number][side]
                if own > 0 and not served[building]:
                    new[building] = max(own, new.get(building, 0.0))
                    first, last = min(first, place), place
        total = sum(span[number] for number, _ in run[first : last + 1])
        return round(sum(new.values()) - 0.12 * total, 3), len(new), first, last

    heap = [(-gain(run)[0], k) for k, run in enumerate(strokes)]
    heapify(heap)
    runs, kinds = [], []
    while heap:
        before, k = heappop(heap)
        now, fresh, first, last = gain(strokes[k])
        if not fresh:
            continue
        if -now > before and heap and (-now, k) > heap[0]:
            heappush(heap, (-now, k))
            continue
        run = strokes[k][first : last + 1]
        for number, _ in run:
            for side in (0, 1):
                if value[number][side] > 0:
                    served[sides[number][side]] = True
        runs.append(run)
        kinds.append(MAIN if fresh >= _MANY else STREET if fresh >= 3 else LANE)
    return runs, kinds


def _connections(passages: Passages, taken: set[int]) -> list[list[tuple[int, int]]]:
    """The shortest ways between streets that are apart, as far as there are ways between them."""
    from scipy.sparse import coo_matrix  # a studio is imported without
    from scipy.sparse.csgraph import dijkstra

    joints = len(passages.joints)
    ends = passages.ends
    price = np.maximum(np.round(passages.span * (1 + 6.0 / passages.room), 1), 0.1)
    own = np.array(sorted(taken))
    _, label = groups_of(ends[own], joints)
    # Of passages between the same joints the cheapest.
    pair = np.sort(ends, axis=1)
    order = np.lexsort((np.arange(len(pair)), price, pair[:, 1], pair[:, 0]))
    order = order[pair[order, 0] != pair[order, 1]]
    name = pair[order, 0] * joints + pair[order, 1]
    order = order[np.append(True, name[1:] != name[:-1])] if len(order) else order
    between = dict(zip(map(tuple, pair[order].tolist()), order.tolist(), strict=True))
    graph = coo_matrix((price[order], pair[order].T), (joints, joints)).tocsr()
    found = dijkstra(
        graph, directed=False, indices=np.unique(ends[own]), min_only=True, return_predecessors=True
    )
    apart, before, source = found
    reached = np.isfinite(apart)
    home = np.where(reached, label[np.where(reached, source, 0)], -1)
    a, b = pair[order].T
    bridge = np.flatnonzero((home[a] >= 0) & (home[b] >= 0) & (home[a] != home[b]))
    cost = np.round(apart[a[bridge]] + price[order[bridge]] + apart[b[bridge]], 1)
    group = list(range(joints))

    def root(joint: int) -> int:
        while group[joint] != joint:
            group[joint] = group[group[joint]]
            joint = group[joint]
        return joint

    runs = []
    for k in bridge[np.lexsort((bridge, cost))].tolist():
        one, two = root(int(home[a[k]])), root(int(home[b[k]]))
        if one == two:
            continue
        group[max(one, two)] = min(one, two)
        path = [int(order[k])]
        halves = []
        for joint in (int(a[k]), int(b[k])):
            half = []
            while before[joint] >= 0:
                previous = int(before[joint])
                half.append(between[(min(joint, previous), max(joint, previous))])
                joint = previous
            halves.append(half)
        path = [*halves[0][::-1], *path, *halves[1]]
        runs.append(_directed(path, ends))
    return runs


def _directed(path: list[int], ends: Ints) -> list[tuple[int, int]]:
    """Passages one after the other, each with 1 where it is gone through from its second end."""
    if len(path) == 1:
        return [(path[0], 0)]
    run = []
    for k, number in enumerate(path):
        if k + 1 < len(path):
            back = int(ends[number, 0] in ends[path[k + 1]])
        else:
            back = int(ends[number, 0] not in ends[path[k - 1]])
        run.append((number, back))
    return run


def _line(passages: Passages, run: list[tuple[int, int]]) -> Floats:
    parts = [passages.line(number, bool(back)) for number, back in run]
    return np.concatenate([parts[0][:1], *(part[1:] for part in parts)])


def _joint(passages: Passages, run: list[tuple[int, int]], which: int) -> int:
    number, back = run[which]
    return int(passages.ends[number, back if which == 0 else 1 - back])


def _straightened(lines: list[Floats], kinds: Ints, houses: NDArray[np.object_]) -> Roads:
    """Lines as straight as houses allow, bends of streets rounded. One that comes too near to a house stays."""
    rough = _shapes(lines)
    tree = shapely.STRtree(houses)
    need = HALF[kinds] + 0.4
    chosen = list(lines)
    waiting = np.arange(len(rough))
    for tolerance in _TOLERANCES:
        plain = _coordinates(shapely.simplify(rough[waiting], tolerance))
        smooth = [
            millimetres(line) if lane else _rounded(line)
            for line, lane in zip(plain, (kinds[waiting] == LANE).tolist(), strict=True)
        ]
        shapes = _shapes(smooth)
        near = np.zeros(len(waiting), bool)
        room = need[waiting] if tolerance > _TOLERANCES[-1] else 0.5
        near[tree.query(shapes, predicate="dwithin", distance=room)[0]] = True
        for k in np.flatnonzero(~near).tolist():
            chosen[waiting[k]] = smooth[k]
        waiting = waiting[near]
        if not len(waiting):
            break
    return Roads.of(chosen, kinds)


def _shapes(lines: Sequence[Floats]) -> NDArray[np.object_]:
    """Lines (p, 2) as shapely's."""
    numbers = np.repeat(np.arange(len(lines)), [len(line) for line in lines])
    return np.asarray(shapely.linestrings(np.concatenate(lines), indices=numbers), object)


def _coordinates(lines: NDArray[np.object_]) -> list[Floats]:
    points, number = shapely.get_coordinates(lines, return_index=True)
    return np.split(points, np.flatnonzero(np.diff(number)) + 1)


def _rounded(line: Floats) -> Floats:
    """A line whose bends are cut at up to 8 m on both sides."""
    if len(line) < 3:
        return millimetres(line)
    way = np.diff(line, axis=0)
    span = length(way)
    cut = np.minimum(8.0, 0.3 * span) / np.maximum(span, 1e-9)
    before, behind = line[1:-1] - way[:-1] * cut[:-1, None], line[1:-1] + way[1:] * cut[1:, None]
    bends = np.stack([before, behind], axis=1).reshape(-1, 2)
    return millimetres(np.concatenate([line[:1], bends, line[-1:]]))


def _met(
    roads: Roads,
    starts: list[tuple[int, int]],
    runs: list[list[tuple[int, int]]],
    passages: Passages,
    houses: shapely.STRtree,
) -> Roads:
    """Roads that end on the lines of those that they met before these were straightened."""
    through: dict[int, list[int]] = {}
    for k, run in enumerate(runs):
        for number, _ in run:
            for joint in passages.ends[number].tolist():
                if not through.setdefault(joint, []) or through[joint][-1] != k:
                    through[joint].append(k)
    shapes = roads.lines()
    # Ends in the order of roads, each with all others that it met.
    met = [
        (2 * k + last, own)
        for k, joints in enumerate(starts)
        for last, joint in enumerate(joints)
        for own in through[joint]
        if own != k
    ]
    end, other = np.array(met, np.int64).reshape(-1, 2).T
    spots = roads.points[np.stack([roads.offsets[:-1], roads.offsets[1:] - 1], axis=1).ravel()]
    apart = np.round(shapely.distance(shapes[other], shapely.points(spots[end])), 3)
    order = np.lexsort((other, apart, end))
    order = order[np.append(True, end[order][1:] != end[order][:-1])[: len(order)]]
    end, other = end[order], other[order]
    ties = shapely.get_coordinates(shapely.shortest_line(shapely.points(spots[end]), shapes[other]))
    at = millimetres(ties.reshape(-1, 2, 2)[:, 1])
    ways = np.asarray(shapely.linestrings(np.stack([spots[end], at], axis=1)), object).reshape(-1)
    good = shapely.length(ways) > 0
    good[houses.query(ways, predicate="dwithin", distance=0.5)[0]] = False
    # What is added comes before or behind the road's own points.
    place = np.where(end % 2 == 0, roads.offsets[:-1][end // 2], roads.offsets[1:][end // 2])[good]
    counts = np.diff(roads.offsets) + np.bincount(end[good] // 2, minlength=len(roads))
    return Roads(offsets_of(counts), np.insert(roads.points, place, at[good], axis=0), roads.kind)
