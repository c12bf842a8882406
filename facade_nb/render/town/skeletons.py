"""Rings that shrink, their edges moving inwards alike: the planes of a hipped roof over any footprint.

It is the straight skeleton as far as edges vanish. Where a ring would fall apart in two, it ends: the roof is flat
above. All rings shrink together, event by event.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, length, millimetres
from .rings import Ints, after, areas, before, line_offsets, offsets_of, ring_numbers, take_rings

__all__ = ["Shrunk", "shrink"]

_EVENTS = 24
"""A ring with more of them is flat above the last."""

_POINT = 0.004
"""Edges of a smaller length have vanished, metres."""


@dataclass(frozen=True, slots=True, eq=False)
class Shrunk:
    """What rings have passed over.

    Attributes
    ----------
    strips
        (q, 4, 2) from an edge, at its lower time, to where it is next: lower left and right, upper right and left.
    low, high
        (q,) how far in these are from the first ring's edge, metres.
    edge
        (q,) the first ring's edge that each belongs to.
    tops
        Corners (v, 2), offsets, and rings (p,) of what is left level.
    far
        (r,) how far each ring has shrunk, metres.
    """

    strips: Floats
    low: Floats
    high: Floats
    edge: Ints
    tops: tuple[Floats, Ints, Ints]
    far: Floats


def shrink(corners: Floats, offsets: Ints, most: Floats) -> Shrunk:
    """Shrink rings (counter-clockwise) until nothing is left of them, or by `most` (r,) metres.

    Where events fall so close together that a ring gets entangled, it stops before its first one.
    """
    found = _shrink(corners, offsets, most)
    size = areas(corners, offsets)
    bad = np.abs(_covered(found, offsets) - size) > 0.02 + 1e-3 * size
    if not bad.any():
        return found
    first, _ = _steps(corners, offsets, most)
    first, _ = _whole(corners, offsets, line_offsets(corners, offsets, 1.0) - corners, first)
    return _shrink(corners, offsets, np.where(bad, np.round(0.9 * first, 3), most))


def _covered(shrunk: Shrunk, offsets: Ints) -> Floats:
    """The area that strips and tops of each ring have together, seen from above."""
    ring = ring_numbers(offsets)[shrunk.edge]
    a, b, c, d = (shrunk.strips[:, k] for k in range(4))
    one, other = c - a, d - b
    total = np.zeros(len(offsets) - 1)
    np.add.at(total, ring, np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]) / 2)
    corners, tops, of = shrunk.tops
    np.add.at(total, of, areas(corners, tops))
    return total


def _shrink(corners: Floats, offsets: Ints, most: Floats) -> Shrunk:
    far = np.zeros(len(offsets) - 1)
    ring: Ints = np.arange(len(far))
    edge: Ints = np.arange(len(corners))
    strips: list[tuple[Floats, Floats, Floats, Ints]] = []
    tops: list[tuple[Floats, Ints, Ints]] = []
    for event in range(_EVENTS):
        if not len(ring):
            break
        number, following = ring_numbers(offsets), after(offsets)
        step, speed = _steps(corners, offsets, most[ring] - far[ring])
        step, split = _whole(corners, offsets, speed, step)
        moved = millimetres(corners + speed * step[number][:, None])
        tangled = _tangled(_cleaned(offsets, moved, edge, np.arange(len(ring)), split))
        if len(tangled):  # what vanishes at the event itself would leave a ring that crosses itself
            step[tangled] = np.round(0.97 * step[tangled], 3)
            split[tangled] = True
            moved = millimetres(corners + speed * step[number][:, None])
        quads = np.stack([corners, corners[following], moved[following], moved], axis=1)
        low, high = far[ring][number], (far[ring] + step)[number]
        passed = step[number] > 0
        strips.append((quads[passed], low[passed], high[passed], edge[passed]))
        far[ring] = far[ring] + step
        done = split | (far[ring] >= most[ring] - 1e-9) | (event == _EVENTS - 1)
        offsets, corners, edge, ring, done = _cleaned(offsets, moved, edge, ring, done)
        ended = np.flatnonzero(done)
        index, flat = take_rings(offsets, ended)
        tops.append((corners[index], np.diff(flat), ring[ended]))
        left = np.flatnonzero(~done)
        index, offsets = take_rings(offsets, left)
        corners, edge, ring = corners[index], edge[index], ring[left]
    quads, low, high, edge = (np.concatenate(parts) for parts in zip(*strips, strict=True))
    points, counts, of = (np.concatenate(parts) for parts in zip(*tops, strict=True))
    return Shrunk(quads, low, high, edge, (points, offsets_of(counts), of), np.round(far, 3))


def _steps(corners: Floats, offsets: Ints, most: Floats) -> tuple[Floats, Floats]:
    """How far each ring goes until an edge vanishes, and how corners move for each metre."""
    following = after(offsets)
    way = corners[following] - corners
    span = length(way)
    speed = line_offsets(corners, offsets, 1.0) - corners
    along = way / np.maximum(span, 1e-9)[:, None]
    closing = speed - speed[following]
    rate = closing[:, 0] * along[:, 0] + closing[:, 1] * along[:, 1]
    time = np.where(rate > 1e-6, span / np.maximum(rate, 1e-6), 1e9)
    return np.minimum(np.minimum.reduceat(time, offsets[:-1]), most), speed


def _whole(corners: Floats, offsets: Ints, speed: Floats, step: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    """Steps after which rings are still whole, and which rings have been held back for it."""
    number = ring_numbers(offsets)
    split = np.zeros(len(step), bool)
    trying = np.flatnonzero(np.diff(offsets) > 3)
    for share in (0.97, 0.7, 0.45, 0.2, 0.0):
        if not len(trying):
            break
        reach = step * share
        moved = corners + speed * reach[number][:, None]
        index, own = take_rings(offsets, trying)
        polygons = shapely.polygons(shapely.linearrings(moved[index], indices=ring_numbers(own)))
        bad = trying[~shapely.is_valid(polygons)] if share else trying
        if share < 0.9:
            good = np.setdiff1d(trying, bad)
            if not share:
                good = trying
            step[good] = np.round(step[good] * share, 3)
            split[good] = True
        trying = bad
    return step, split


def _tangled(cleaned: tuple[Ints, Floats, Ints, Ints, NDArray[np.bool_]]) -> Ints:
    """Rings that cross themselves."""
    offsets, corners, _, ring, _ = cleaned
    if not len(ring):
        return ring
    polygons = shapely.polygons(shapely.linearrings(corners, indices=ring_numbers(offsets)))
    return ring[~shapely.is_valid(polygons)]


def _cleaned(
    offsets: Ints, corners: Floats, edge: Ints, ring: Ints, done: NDArray[np.bool_]
) -> tuple[Ints, Floats, Ints, Ints, NDArray[np.bool_]]:
    """Rings without edges that have vanished, nor edges that lie upon each other; rings of no area are gone."""
    while len(corners):
        following, preceding = after(offsets), before(offsets)
        way = corners[following] - corners
        span = length(way)
        there = way[preceding]
        dot = (way * there)[:, 0] + (way * there)[:, 1]
        cross = there[:, 0] * way[:, 1] - there[:, 1] * way[:, 0]
        both = span * span[preceding]
        # A corner at which the ring turns back: the longer of its two edges goes on.
        spike = (dot < 0) & (np.abs(cross) < 2e-3 * np.maximum(both, 1e-9)) & (span > _POINT)
        spike &= (span[preceding] > _POINT) & (np.minimum(span, span[preceding]) > 0)
        longer = spike & (span[preceding] <= span)
        gone = span <= _POINT
        # One corner of a ring at a time: its neighbours are looked at again.
        turning = np.flatnonzero(spike & ~gone)
        number = ring_numbers(offsets)
        first = turning[np.unique(number[turning], return_index=True)[1]]
        if gone.any():
            kept = ~gone
        elif len(first):
            kept = np.ones(len(corners), bool)
            kept[first] = False
            edge = edge.copy()
            take = first[longer[first]]
            edge[preceding[take]] = edge[take]
        else:
            kept = np.ones(len(corners), bool)
        counts = np.bincount(number[kept], minlength=len(ring))
        alive = counts > 2
        kept &= alive[number]
        if kept.all() and alive.all():
            break
        corners, edge = corners[kept], edge[kept]
        offsets, ring, done = offsets_of(counts[alive]), ring[alive], done[alive]
    if len(ring):
        solid = areas(corners, offsets) > 1e-4
        index, offsets = take_rings(offsets, np.flatnonzero(solid))
        corners, edge, ring, done = corners[index], edge[index], ring[solid], done[solid]
    return offsets, corners, edge, ring, done
