"""Walls that stand against each other: found, and cut where a neighbour covers a part."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, length, millimetres
from .rings import Ints, after, offsets_of, ragged

__all__ = ["Cut", "cut_walls", "with_hidden"]

TOLERANCE = 0.08
"""Walls no further apart stand against each other, metres."""

_LEAST = 0.3
"""They do so along so many metres at least."""
_PIECE = 0.25
"""No wall is cut so near its end, metres."""


@dataclass(frozen=True, slots=True, eq=False)
class Cut:
    """Rings with corners where a neighbour's wall begins or ends.

    Attributes
    ----------
    offsets, corners
        The rings.
    source
        (n,) which edge each edge was, or was a part of.
    added
        (n,) whether a corner was added.
    wall, neighbour
        (m,) an edge, and a building that stands against it.
    """

    offsets: Ints
    corners: Floats
    source: Ints
    added: NDArray[np.bool_]
    wall: Ints
    neighbour: Ints


def cut_walls(offsets: Ints, corners: Floats, building: Ints) -> Cut:
    """Find walls in common.

    Parameters
    ----------
    offsets, corners
        Rings: outside is on the right of an edge.
    building
        (n,) of each corner.
    """
    following = after(offsets)
    ends = corners[following]
    span = length(ends - corners)
    along = (ends - corners) / np.maximum(span, 1e-9)[:, None]
    lines = shapely.linestrings(np.stack([corners, ends], axis=1))
    one, other = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=TOLERANCE)
    apart = building[one] != building[other]
    one, other = one[apart], other[apart]
    edge, first, last, neighbour = _common(corners, ends, along, span, one, other)
    neighbour = building[neighbour]
    crossed, crossing = _crossings(corners, ends, along, span, one, other)
    # Where edges are cut: at the ends of what is common and where one enters another building, unless that is near an
    # end, or near another cut.
    at_edge, at = np.concatenate([edge, edge, crossed]), np.concatenate([first, last, crossing])
    inner = (at > _PIECE) & (at < span[at_edge] - _PIECE)
    at_edge, at = at_edge[inner], at[inner]
    order = np.lexsort((at, at_edge))
    at_edge, at = at_edge[order], at[order]
    fresh = np.ones(len(at), bool)
    held = -1.0
    for k in range(len(at)):
        if k and at_edge[k] == at_edge[k - 1] and at[k] - held < _PIECE:
            fresh[k] = False
        else:
            held = float(at[k])
    at_edge, at = at_edge[fresh], at[fresh]
    count = len(corners)
    source = np.concatenate([np.arange(count), at_edge])
    begin = np.concatenate([np.zeros(count), at])
    points = np.concatenate([corners, millimetres(corners[at_edge] + along[at_edge] * at[:, None])])
    order = np.lexsort((begin, source))
    added = (np.arange(len(order)) >= count)[order]
    source, begin, points = source[order], begin[order], points[order]
    pieces = np.bincount(source, minlength=count)
    starts = offsets_of(pieces)
    new = offsets_of(np.diff(starts[offsets]))
    # Which piece each common part covers: pieces are cut at its ends, so their middles tell.
    end = np.append(begin[1:], 0.0)
    end[starts[1:] - 1] = span
    pair = np.repeat(np.arange(len(edge)), pieces[edge])
    piece = ragged(starts[edge], pieces[edge])
    middle = (begin[piece] + end[piece]) / 2
    covered = (middle > first[pair]) & (middle < last[pair])
    return Cut(new, points, source, added, piece[covered], neighbour[pair[covered]])


def with_hidden(cut: Cut, building: Ints, polygons: NDArray[np.object_]) -> Cut:
    """The same with those walls that lie within another building: footprints drawn over each other.

    Parameters
    ----------
    building
        (n,) of each edge of `cut`.
    polygons
        (b,) the buildings.
    """
    ends = cut.corners[after(cut.offsets)]
    way = ends - cut.corners
    out = np.stack([way[:, 1], -way[:, 0]], axis=1) / np.maximum(length(way), 1e-9)[:, None]
    tree = shapely.STRtree(polygons)
    found = []
    for share in (0.25, 0.5, 0.75):
        probes = shapely.points(cut.corners + way * share + 0.1 * out)
        wall, other = tree.query(probes, predicate="within")
        apart = building[wall] != other
        found.append(wall[apart] * len(polygons) + other[apart])
    # Within the same one at each of the three places.
    codes, times = np.unique(np.concatenate(found), return_counts=True)
    codes = codes[times == len(found)]
    known = np.concatenate([cut.wall * len(polygons) + cut.neighbour, codes])
    wall, neighbour = np.divmod(np.unique(known), len(polygons))
    return replace(cut, wall=wall, neighbour=neighbour)


def _common(
    corners: Floats, ends: Floats, along: Floats, span: Floats, one: Ints, other: Ints
) -> tuple[Ints, Floats, Floats, Ints]:
    """Edges, from where to where along them (metres) another building's edge stands against them, and that edge."""
    facing = along[one][:, 0] * along[other][:, 0] + along[one][:, 1] * along[other][:, 1] < -0.9
    one, other = one[facing], other[facing]
    u, foot = along[one], corners[one]

    def place(points: Floats) -> tuple[Floats, Floats]:
        way = points - foot
        return way[:, 0] * u[:, 0] + way[:, 1] * u[:, 1], way[:, 0] * u[:, 1] - way[:, 1] * u[:, 0]

    # The other wall runs the other way: it ends first.
    low, low_out = place(ends[other])
    high, high_out = place(corners[other])
    first, last = np.maximum(low, 0), np.minimum(high, span[one])
    slope = (high_out - low_out) / np.maximum(high - low, 1e-9)
    gaps = np.maximum(np.abs(low_out + slope * (first - low)), np.abs(low_out + slope * (last - low)))
    kept = (np.round(last - first, 3) >= np.minimum(_LEAST, np.round(0.8 * span[one], 3))) & (
        np.round(gaps, 3) <= TOLERANCE
    )
    kept &= last > first
    first, last = np.round(first, 3), np.round(last, 3)
    return one[kept], first[kept], last[kept], other[kept]


def _crossings(
    corners: Floats, ends: Floats, along: Floats, span: Floats, one: Ints, other: Ints
) -> tuple[Ints, Floats]:
    """Edges, and where along them (metres) an edge of another building goes across."""
    u, v = along[one], along[other]
    cross = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    steep = np.abs(cross) > 0.1
    one, other, u, v, cross = one[steep], other[steep], u[steep], v[steep], cross[steep]
    way = corners[other] - corners[one]
    s = (way[:, 0] * v[:, 1] - way[:, 1] * v[:, 0]) / cross
    t = (way[:, 0] * u[:, 1] - way[:, 1] * u[:, 0]) / cross
    s, t = np.round(s, 3), np.round(t, 3)
    # Walls that only end at each other stay whole.
    inner = (t > TOLERANCE) & (t < span[other] - TOLERANCE) & (s > 0) & (s < span[one])
    return one[inner], s[inner]
