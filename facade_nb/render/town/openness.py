"""Which way a building looks where no street is known: towards the open."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, length
from .neighbours import Cut
from .rings import Ints, after, ring_numbers
from .roles import COURT, PARTY, SIDE, STREET

__all__ = ["gaps_of", "look_out"]

SIGHT = 40.0
"""Nothing further away matters, metres."""


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
    lines = shapely.linestrings(np.stack([start, end], axis=1))
    ray, wall = shapely.STRtree(lines).query(rays, predicate="intersects")
    # Where a ray meets a wall: by the wall's line; where they run along each other, at its nearer end.
    a, d, u = first[ray], out[edge][ray], way[wall]
    to = start[wall] - a
    cross = d[:, 0] * u[:, 1] - d[:, 1] * u[:, 0]
    level = np.abs(cross) < 1e-9 * np.maximum(span[wall], 1e-9)
    t = (to[:, 0] * u[:, 1] - to[:, 1] * u[:, 0]) / np.where(level, 1, cross)
    ends = np.minimum((to * d).sum(axis=1), ((to + u) * d).sum(axis=1))
    t = np.round(np.where(level, ends, t), 3)
    gaps = np.full(len(start), SIGHT)
    np.minimum.at(gaps, edge[ray], np.clip(t, 0, SIGHT))
    gaps[~free] = 0
    return gaps


def look_out(cut: Cut, ring_of: Ints, holes: NDArray[np.bool_], gaps: Floats) -> NDArray[np.uint8]:
    """Roles of walls.

    The front is where the longest walls look furthest. What looks the same way is on the street, also around the corner
    of a house between neighbours; what looks away from it is behind, the rest beside.
    """
    ring = ring_numbers(cut.offsets)
    building = np.asarray(ring_of)[ring]
    way = cut.corners[after(cut.offsets)] - cut.corners
    span = length(way)
    out = np.stack([way[:, 1], -way[:, 0]], axis=1) / np.maximum(span, 1e-9)[:, None]
    party = np.zeros(len(span), bool)
    party[cut.wall] = True
    worth = np.where(party | holes[ring], 0, np.round(np.minimum(span, 16) * (gaps + 2), 1))
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
