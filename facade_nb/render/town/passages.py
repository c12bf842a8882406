"""Where one can go between buildings: halfway between two of them, as Voronoi's cells of their walls meet."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from .chance import Floats, length, millimetres
from .linking import groups_of
from .rings import Ints, after, offsets_of, ragged, ring_numbers

__all__ = ["NO_PASSAGES", "Passages", "passages_of", "runs_of"]

_STEP = 5.0
"""Walls are points so far apart, metres."""

_ROOM, _FAR = 2.55, 400.0
"""No passage is nearer to a building, or further from it, metres. Nearer than half of `_STEP` it may be indoors."""

_JOINED = 3.0
"""Shorter passages are a place where others meet, metres."""


@dataclass(frozen=True, slots=True, eq=False)
class Passages:
    """Passages (m) between two buildings each; they meet at joints (j).

    Attributes
    ----------
    joints
        (j, 2) whole millimetres.
    offsets, points
        The line of passage k: ``points[offsets[k]:offsets[k + 1]]``, from one joint to another.
    ends
        (m, 2) joints.
    sides
        (m, 2) buildings on both sides.
    room
        (m,) the least distance to them, metres.
    span
        (m,) metres.
    """

    joints: Floats
    offsets: Ints
    points: Floats
    ends: Ints
    sides: Ints
    room: Floats
    span: Floats

    def __len__(self) -> int:
        return len(self.room)

    def line(self, number: int, back: bool = False) -> Floats:
        """The points of a passage, from its first end or from its second one."""
        own = self.points[self.offsets[number] : self.offsets[number + 1]]
        return own[::-1] if back else own


_NONE = np.zeros(0, np.int64)
NO_PASSAGES = Passages(
    np.zeros((0, 2)), np.zeros(1, np.int64), np.zeros((0, 2)), np.zeros((0, 2), np.int64),
    np.zeros((0, 2), np.int64), np.zeros(0), np.zeros(0),
)  # fmt: skip
"""None."""


def passages_of(offsets: Ints, corners: Floats) -> Passages:
    """Passages between buildings, given their outer rings."""
    from scipy.spatial import Delaunay, QhullError  # a studio is imported without

    points, building = _samples(offsets, corners)
    try:
        net = Delaunay(points)
    except (QhullError, ValueError):  # fewer than three points, or all in a line
        return NO_PASSAGES
    centre, radius = _circles(points[net.simplices])
    tri, k = np.nonzero(net.neighbors > np.arange(len(centre))[:, None])
    other = net.neighbors[tri, k]
    a, b = (net.simplices[tri, (k + step) % 3] for step in (1, 2))
    apart = building[a] != building[b]
    tri, other, a, b = tri[apart], other[apart], a[apart], b[apart]
    middle = (points[a] + points[b]) / 2
    here, there = centre[tri] - middle, centre[other] - middle
    between = (here * there).sum(axis=1) <= 0
    least = np.where(between, length(points[a] - points[b]) / 2, np.minimum(radius[tri], radius[other]))
    room = np.round(least, 3)
    kept = (room >= _ROOM) & (np.maximum(radius[tri], radius[other]) <= _FAR)
    cells = np.stack([tri, other], axis=1)[kept]
    pair = np.sort(np.stack([building[a], building[b]], axis=1)[kept], axis=1)
    return _joined(centre, cells, pair, room[kept])


def _samples(offsets: Ints, corners: Floats) -> tuple[Floats, Ints]:
    """Points along walls, whole millimetres, and the building of each: the first where two have one."""
    way = corners[after(offsets)] - corners
    count = np.maximum(np.ceil(np.round(length(way) / _STEP, 3)), 1).astype(np.int64)
    edge = np.repeat(np.arange(len(corners)), count)
    part = ragged(np.zeros(len(corners), np.int64), count) / count[edge]
    points = millimetres(corners[edge] + way[edge] * part[:, None])
    _, first = np.unique(np.rint(points * 1000).astype(np.int64), axis=0, return_index=True)
    first.sort()
    return points[first], ring_numbers(offsets)[edge[first]]


def _circles(corners: Floats) -> tuple[Floats, Floats]:
    """Middles (whole millimetres) and radii of the circles through the corners (t, 3, 2) of triangles."""
    a = corners[:, 0]
    b, c = corners[:, 1] - a, corners[:, 2] - a
    twice = 2 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    flat = np.abs(twice) < 1e-6
    bb, cc = (b * b).sum(axis=1), (c * c).sum(axis=1)
    x = c[:, 1] * bb - b[:, 1] * cc
    y = b[:, 0] * cc - c[:, 0] * bb
    to = np.stack([x, y], axis=1) / np.where(flat, 1.0, twice)[:, None]
    radius = np.where(flat, np.inf, np.round(length(to), 3))
    return millimetres(np.where((radius < 1e5)[:, None], a + to, a)), radius


def _joined(centre: Floats, cells: Ints, pair: Ints, room: Floats) -> Passages:
    """Pieces between two cells each, put together where they go on between the same two buildings."""
    if not len(cells):
        return NO_PASSAGES
    count = len(cells)
    piece, end = np.tile(np.arange(count), 2), np.repeat([0, 1], count)
    at = cells.T.ravel()
    name = pair[:, 0] * (int(pair.max()) + 1) + pair[:, 1]
    order = np.lexsort((piece, name[piece], at))
    same = (at[order][1:] == at[order][:-1]) & (name[piece[order]][1:] == name[piece[order]][:-1])
    one, two = order[:-1][same], order[1:][same]
    links = np.full((count, 2), -1)
    links[piece[one], end[one]] = 2 * piece[two] + end[two]
    links[piece[two], end[two]] = 2 * piece[one] + end[one]
    every, back, begin = _runs(links)
    # The cell where each run begins, and the one behind each of its pieces.
    first, onward = cells[every[begin[:-1]], back[begin[:-1]]], cells[every, 1 - back]
    offsets = offsets_of(np.diff(begin) + 1)
    points = centre[np.insert(onward, begin[:-1], first)]
    steps = length(np.diff(points, axis=0))
    steps[offsets[1:-1] - 1] = 0.0
    sums = np.concatenate([[0.0], np.cumsum(np.round(steps, 3))])
    span = np.round(sums[offsets[1:] - 1] - sums[offsets[:-1]], 3)
    least = np.minimum.reduceat(room[every], begin[:-1])
    ends = np.stack([first, onward[begin[1:] - 1]], axis=1)
    return _met(offsets, points, ends, pair[every[begin[:-1]]], least, span)


def _met(offsets: Ints, points: Floats, ends: Ints, sides: Ints, room: Floats, span: Floats) -> Passages:
    """Passages without those that are so short that others meet there."""
    names, ends = np.unique(ends, return_inverse=True)
    ends = ends.reshape(-1, 2)
    short = span < _JOINED
    count, label = groups_of(ends[short], len(names))
    joint: Floats = np.zeros((count, 2))
    seen = np.zeros(count, np.int64)
    first = np.stack([points[offsets[:-1]], points[offsets[1:] - 1]], axis=1)
    np.add.at(joint, label[ends], np.rint(first * 1000))
    np.add.at(seen, label[ends], 1)
    joint = millimetres(joint / np.maximum(seen, 1)[:, None] / 1000)
    kept = np.flatnonzero(~short)
    index = ragged(offsets[kept], np.diff(offsets)[kept])
    new = offsets_of(np.diff(offsets)[kept])
    moved = points[index].copy()
    ends = label[ends[kept]]
    moved[new[:-1]], moved[new[1:] - 1] = joint[ends[:, 0]], joint[ends[:, 1]]
    return Passages(joint, new, moved, ends, sides[kept], room[kept], span[kept])


def runs_of(links: NDArray[np.integer]) -> list[list[tuple[int, int]]]:
    """Pieces one after the other, each with 1 where it is gone through from its second end.

    Parameters
    ----------
    links
        (n, 2) what goes on at each end: twice a piece's number, 1 more where it is met at its second end; -1: nothing.
        Of pieces in a ring the first comes first.
    """
    piece, back, offsets = _runs(np.asarray(links))
    pairs = list(zip(piece.tolist(), back.tolist(), strict=True))
    return [pairs[low:high] for low, high in pairwise(offsets.tolist())]


def _runs(links: NDArray[np.integer]) -> tuple[Ints, Ints, Ints]:
    """The same in flat arrays: pieces, whether each is gone through from its second end, and where runs begin."""
    # A piece is gone through two ways: twice its number, and one more. Before each of them comes one, or none.
    ways = np.arange(2 * len(links))
    linked = links.ravel()
    before = np.where(linked < 0, ways, linked ^ 1)
    first, rank = before, (linked >= 0).astype(np.int64)
    for _ in range(len(ways).bit_length()):
        if (linked[first] < 0).all():
            break
        # Where one is that comes so much earlier, what comes twice as much earlier is known, too.
        rank, first = rank + rank[first], first[first]
    # Of both ways through a run the one from the lower number.
    open_ = (linked[first] < 0) & (first < first[ways ^ 1])
    order = np.flatnonzero(open_)
    order = order[np.lexsort((rank[order], first[order]))]
    found = [order]
    counts = np.diff(np.append(np.flatnonzero(rank[order] == 0), len(order))).tolist()
    closed = np.flatnonzero(linked[first[::2]] >= 0)
    seen: set[int] = set()
    for start in closed.tolist():
        way, ring = 2 * start, []
        while way >> 1 not in seen:
            seen.add(way >> 1)
            ring.append(way)
            way = int(linked[way ^ 1])
        if ring:
            found.append(np.array(ring))
            counts.append(len(ring))
    every = np.concatenate(found)
    return every >> 1, every & 1, offsets_of(np.array(counts, np.int64))
