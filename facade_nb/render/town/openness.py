"""Which way a building looks: towards the street that it sees, else towards the open."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, length
from .neighbours import Cut
from .rings import Ints, after, ring_numbers
from .roads import Roads
from .roles import COURT, PARTY, SIDE, STREET

__all__ = ["SIGHT", "gaps_of", "look_out", "roads_before"]

SIGHT = 40.0
"""Nothing further away matters, metres."""

_ALLEY = 3.0
"""A road whose middle is nearer to a wall is an alley, metres: a house looks elsewhere, if it can."""


def gaps_of(cut: Cut) -> Floats:
    """How far it is from the middle of each wall, straight out, to the next building (its own too), up to `SIGHT`."""
    start, end = cut.corners, cut.corners[after(cut.offsets)]
    way = end - start
    span = length(way)
    out = np.stack([way[:, 1], -way[:, 0]], axis=1) / np.maximum(span, 1e-9)[:, None]
    middle = (start + end) / 2
    free = np.ones(len(start), bool)
    free[cut.wall] = False
    edge = np.flatnonzero(free & (span > 0))
    first = middle[edge] + 0.05 * out[edge]
    rays = shapely.linestrings(np.stack([first, middle[edge] + SIGHT * out[edge]], axis=1))
    ray, t = _hits(first, out[edge], rays, start, way)
    gaps = np.full(len(start), SIGHT)
    np.minimum.at(gaps, edge[ray], np.clip(t, 0, SIGHT))
    gaps[~free] = 0
    return gaps


def _hits(
    first: Floats, out: Floats, rays: NDArray[np.object_], start: Floats, way: Floats
) -> tuple[Ints, Floats]:
    """Rays (n) that meet lines from `start` on by `way`, and how far from their `first` points, metres.

    Where they run along each other they meet at the line's nearer end.
    """
    lines = shapely.linestrings(np.stack([start, start + way], axis=1))
    ray, line = shapely.STRtree(lines).query(rays, predicate="intersects")
    a, d, u = first[ray], out[ray], way[line]
    to = start[line] - a
    cross = d[:, 0] * u[:, 1] - d[:, 1] * u[:, 0]
    level = np.abs(cross) < 1e-9 * np.maximum(length(u), 1e-9)
    t = (to[:, 0] * u[:, 1] - to[:, 1] * u[:, 0]) / np.where(level, 1, cross)
    ends = np.minimum((to * d).sum(axis=1), ((to + u) * d).sum(axis=1))
    return ray, np.round(np.where(level, ends, t), 3)


def roads_before(middle: Floats, out: Floats, gaps: Floats, roads: Roads) -> tuple[Floats, Ints]:
    """How far roads' middles are, straight out from places (n, 2) of walls, and which roads; `inf` and -1: none.

    Parameters
    ----------
    out
        (n, 2) unit vectors out of the walls.
    gaps
        (n,) to the next building: what lies behind is not seen.
    """
    apart, which = np.full(len(middle), np.inf), np.full(len(middle), -1)
    some = np.flatnonzero(gaps > 1.0)
    if not len(roads) or not len(some):
        return apart, which
    inner = np.ones(len(roads.points), bool)
    inner[roads.offsets[1:] - 1] = False
    start = np.flatnonzero(inner)
    way = roads.points[start + 1] - roads.points[start]
    rays = shapely.linestrings(np.stack([middle[some], middle[some] + out[some] * gaps[some, None]], axis=1))
    ray, t = _hits(middle[some], out[some], rays, roads.points[start], way)
    np.minimum.at(apart, some[ray], np.maximum(t, 0))
    spot = shapely.points(middle + out * np.where(np.isfinite(apart), apart, 0.0)[:, None])
    seen = np.flatnonzero(np.isfinite(apart))
    if len(seen):
        which[seen] = shapely.STRtree(roads.lines()).nearest(spot[seen])
    return apart, which


def look_out(
    cut: Cut, ring_of: Ints, holes: NDArray[np.bool_], gaps: Floats, apart: Floats
) -> NDArray[np.uint8]:
    """Roles of walls. `apart`: how far a road is before each (`roads_before`).

    The front is where the longest walls see a road that is no mere alley, the nearest; where none does, where they look
    furthest. What looks the same way is on the street, also around the corner of a house between neighbours; what looks
    away from it is behind, the rest beside.
    """
    ring = ring_numbers(cut.offsets)
    building = np.asarray(ring_of)[ring]
    way = cut.corners[after(cut.offsets)] - cut.corners
    span = length(way)
    out = np.stack([way[:, 1], -way[:, 0]], axis=1) / np.maximum(span, 1e-9)[:, None]
    party = np.zeros(len(span), bool)
    party[cut.wall] = True
    seen = np.isfinite(apart) & (apart >= _ALLEY)
    free = np.where(seen, 20 * (SIGHT + 12 - np.minimum(apart, SIGHT)), gaps + 2)
    worth = np.where(party | holes[ring], 0, np.round(np.minimum(span, 16) * free, 1))
    begin = np.searchsorted(building, np.arange(int(building.max()) + 2))
    count = np.diff(begin)[building]
    one = np.repeat(np.arange(len(span)), count)
    other = np.arange(len(one)) - np.repeat(np.cumsum(count) - count, count) + begin[building[one]]
    dot = np.round(out[one][:, 0] * out[other][:, 0] + out[one][:, 1] * out[other][:, 1], 4)
    alike = dot > 0.85
    score = np.zeros(len(span))
    np.add.at(score, one[alike], worth[other[alike]])
    score = np.where(worth > 0, np.round(score, 1), -1.0)
    order = np.lexsort((np.arange(len(span)), -worth, -score, building))
    front = order[begin[:-1]]
    facing = front[building]
    dot = np.round(out[:, 0] * out[facing][:, 0] + out[:, 1] * out[facing][:, 1], 4)
    joined = np.zeros(len(front), bool)
    np.logical_or.at(joined, building, party)
    role = np.where(dot > 0.7, STREET, np.where(dot < -0.7, COURT, SIDE))
    role = np.where((role == STREET) & (gaps < 3.0) & (dot < 0.999), SIDE, role)
    around = joined[building] & (role == SIDE) & (dot > -0.3) & (gaps >= 12) & (span >= 5)
    role = np.where(around, STREET, role)
    role = np.where(holes[ring], COURT, role)
    return np.where(party, PARTY, role).astype(np.uint8)
