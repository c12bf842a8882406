"""Streets: rings and spokes about a market, cells between them that ever smaller ones cut, all bent a little.

A cell is a block with half of the streets around it. Cells leave no gap: each edge has the same corners on both sides.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, chance, direction, field, length, millimetres
from .rings import Ints, after, areas, before, inset, offsets_of, ring_numbers

__all__ = ["AVENUE", "BOULEVARD", "LANE", "MINOR", "SECOND", "Cells", "lay_out"]

BOULEVARD, AVENUE, SECOND, MINOR, LANE = range(5)
"""Kinds of streets, the widest first."""

WIDTHS = np.array([28.0, 20.0, 15.0, 11.0, 7.5])
"""From wall to wall, metres."""

WALKS = np.array([5.0, 3.5, 2.8, 2.2, 1.2])
"""Pavement on each side, metres."""

_CROSSING = 7.0
"""Streets that come from both sides of another meet where they would be no further apart, metres."""

_Point = tuple[float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Cells:
    """Blocks with the streets around them; flat arrays over corners, the same in each.

    Attributes
    ----------
    offsets
        (c + 1,) the corners of cell c.
    corners
        (n, 2) of the cells, which meet in the middle of streets.
    kerbs
        (n, 2) where the pavements begin.
    blocks
        (n, 2) where the streets end and blocks begin.
    street
        (n,) kind of the street along the edge from each corner to the next.
    firm
        (n,) corners of the block; at others a straight street meets others.
    reach
        (c,) how far out a cell lies: 0 at the market, 1 about where the town ends.
    centres
        (c, 2) middle of each cell.
    sizes
        (c,) area of each block, square metres; 0: too narrow to be built on.
    radius
        Where the town ends, about, metres.
    """

    offsets: Ints
    corners: Floats
    kerbs: Floats
    blocks: Floats
    street: Ints
    firm: NDArray[np.bool_]
    reach: Floats
    centres: Floats
    sizes: Floats
    radius: float


def lay_out(radius: float, seed: int, dense: float) -> Cells:
    """Streets of a town of about a radius, and some way beyond.

    Parameters
    ----------
    radius
        Metres.
    seed
        Of the town.
    dense
        The part of the radius that is built up densely: blocks are longer outside.
    """
    random = chance(seed, 1)
    polygons, classes = _cut(_sectors(radius, random), radius, dense, random)
    offsets = offsets_of(np.array([len(polygon) for polygon in polygons]))
    corners = millimetres(np.array([corner for polygon in polygons for corner in polygon]))
    street = np.array([kind for kinds in classes for kind in kinds])
    offsets, corners, street = _joined(offsets, corners, street)
    bend = min(18.0, 0.08 * radius)
    corners = millimetres(
        corners
        + bend * field(corners, 2 * seed, max(260.0, 0.3 * radius))
        + 0.35 * bend * field(corners, 2 * seed + 1, 120.0)
    )
    firm = _firm(corners, offsets)
    some = np.bincount(ring_numbers(offsets), weights=firm, minlength=len(offsets) - 1) < 3
    firm |= some[ring_numbers(offsets)]
    own = offsets_of(
        np.bincount(ring_numbers(offsets), weights=firm, minlength=len(offsets) - 1).astype(np.int64)
    )
    half = WIDTHS[street[firm]] / 2
    kerbs, _ = inset(corners[firm], own, half - WALKS[street[firm]])
    blocks, whole = inset(corners[firm], own, half)
    sizes = np.where(whole, np.maximum(areas(blocks, own), 0), 0)
    kerbs, blocks = (_laid(corners, offsets, firm, ring) for ring in (kerbs, blocks))
    counts = np.diff(offsets)
    centres = millimetres(np.add.reduceat(corners, offsets[:-1], axis=0) / counts[:, None])
    wobble = field(centres, seed + 77, max(200.0, 0.45 * radius))[:, 0]
    reach = np.round(length(centres) / radius * (1 + 0.16 * wobble), 6)
    return Cells(offsets, corners, kerbs, blocks, street, firm, reach, centres, sizes, radius)


def _sectors(radius: float, random: np.random.Generator) -> list[tuple[list[_Point], list[int]]]:
    """The market, and what lies between spokes and rings around it, each convex, with the kinds of its edges."""
    market = min(34.0, max(16.0, 0.12 * radius))
    wall = min(max(0.2 * radius, min(0.36 * radius, 120.0)), 400.0)
    rings = [market, wall] + ([0.52 * radius] if radius > 900 else []) + [1.45 * radius + 60]
    spokes = 5 if radius < 250 else 6 if radius < 900 else 7
    kinds = [LANE, AVENUE if radius < 500 else BOULEVARD, AVENUE, MINOR]
    if len(rings) == 3:
        kinds.pop(2)
    turns = (np.arange(spokes) + 0.34 * (random.random(spokes) - 0.5)) / spokes + random.random()
    knots = []
    for k, ring in enumerate(rings):
        shaken = 0.12 if k < len(rings) - 1 else 0.0
        bent = turns + (0.0 if k == 0 else 0.1 / spokes) * (random.random(spokes) - 0.5)
        radii = ring * (1 + shaken * (2 * random.random(spokes) - 1))
        knots.append((direction(bent) * radii[:, None]).tolist())
    spoke = [SECOND, AVENUE, AVENUE]
    found: list[tuple[list[_Point], list[int]]] = [([tuple(p) for p in knots[0]], [kinds[0]] * spokes)]
    for k in range(len(rings) - 1):
        for i in range(spokes):
            j = (i + 1) % spokes
            quad = [tuple(knots[k][i]), tuple(knots[k + 1][i]), tuple(knots[k + 1][j]), tuple(knots[k][j])]
            found.append((quad, [spoke[min(k, 2)], kinds[k + 1], spoke[min(k, 2)], kinds[k]]))
    return found


def _cut(
    sectors: list[tuple[list[_Point], list[int]]], radius: float, dense: float, random: np.random.Generator
) -> tuple[list[list[_Point]], list[list[int]]]:
    """Cut sectors by streets until each cell is a block's size: small about the market, long further out."""
    polygons, classes = [sectors[0][0]], [sectors[0][1]]
    waiting = sectors[:0:-1]
    while waiting:
        polygon, kinds = waiting.pop()
        size = _area(polygon)
        away = sqrt(sum(sum(p[k] for p in polygon) ** 2 for k in (0, 1))) / len(polygon)
        old = away < min(0.2 * radius, 330.0)
        outer = away > dense * radius
        most = 4200.0 if old else 15500.0 if outer else 11500.0
        if size < most * (0.75 + 0.5 * float(random.random())):
            polygons.append(polygon)
            classes.append(kinds)
            continue
        kind = SECOND if size > 120_000 else LANE if old else MINOR
        for half in _halves(polygon, kinds, kind, outer, random):
            waiting.append(half)
    return polygons, classes


def _area(polygon: list[_Point]) -> float:
    return sum(
        a[0] * b[1] - a[1] * b[0] for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True)
    ) / 2  # fmt: skip


def _halves(
    polygon: list[_Point], kinds: list[int], kind: int, outer: bool, random: np.random.Generator
) -> list[tuple[list[_Point], list[int]]]:
    """Cut a convex polygon in two across its longer side, by a line square to its longest edge, or nearly."""
    edges = list(zip(polygon, polygon[1:] + polygon[:1], strict=True))
    ways = [(b[0] - a[0], b[1] - a[1]) for a, b in edges]
    lengths = [round(x * x + y * y, 3) for x, y in ways]
    longest = ways[lengths.index(max(lengths))]
    ux, uy = _unit(longest)
    ux, uy = _mean((ux, uy), _towards(ways, (-ux, -uy)))
    along = [p[0] * ux + p[1] * uy for p in polygon]
    across = [p[1] * ux - p[0] * uy for p in polygon]
    wide, deep = max(along) - min(along), max(across) - min(across)
    share = 0.5 + 0.2 * (float(random.random()) - 0.5)
    tilt = 0.1 * (float(random.random()) - 0.5)
    # Blocks further out stay longer than they are deep: two rows of gardens back to back.
    if wide * 100 >= deep * (165 if outer and min(wide, deep) < 130 else 95):
        ends = _mean(_towards(ways, (-uy, ux)), _towards(ways, (uy, -ux)))
        wx, wy = _mean((-uy, ux), (-ends[0], -ends[1]) if ends[1] * ux - ends[0] * uy < 0 else ends)
        at, middle = min(along) + share * wide, (min(across) + max(across)) / 2
    else:
        wx, wy = ux, uy
        at, middle = (min(along) + max(along)) / 2, min(across) + share * deep
    foot = (at * ux - middle * uy, at * uy + middle * ux)
    nx, ny = wy + tilt * wx, tilt * wy - wx
    sides = [round((p[0] - foot[0]) * nx + (p[1] - foot[1]) * ny, 3) for p in polygon]
    margin = 16.0 if max(wide, deep) > 90 else 9.0
    sides = [0.0 if abs(side) < margin * 0.7 else side for side in sides]
    halves: tuple[tuple[list[_Point], list[int]], ...] = (([], []), ([], []))
    count = len(polygon)
    for i in range(count):
        j = (i + 1) % count
        here, there = sides[i], sides[j]
        for sign, (points, found) in zip((1, -1), halves, strict=True):
            if here * sign >= 0:
                points.append(polygon[i])
                leaves = here == 0 and there * sign < 0
                found.append(kind if leaves else kinds[i])
        if here * there < 0:
            t = here / (here - there)
            (x0, y0), (x1, y1) = polygon[i], polygon[j]
            crossing = (round(x0 + t * (x1 - x0), 3), round(y0 + t * (y1 - y0), 3))
            for sign, (points, found) in zip((1, -1), halves, strict=True):
                points.append(crossing)
                found.append(kinds[i] if here * sign < 0 else kind)
    good = all(len(points) > 2 and _area(points) > 400 for points, _ in halves)
    return [(points, found) for points, found in halves] if good else [(polygon, kinds)]


def _unit(way: _Point) -> _Point:
    span = sqrt(way[0] * way[0] + way[1] * way[1])
    return way[0] / span, way[1] / span


def _towards(ways: list[_Point], wanted: _Point) -> _Point:
    """The unit vector of the edge that goes most in a direction; the direction itself where none goes nearly there."""
    units = [_unit(way) for way in ways]
    dots = [round(u[0] * wanted[0] + u[1] * wanted[1], 6) for u in units]
    best = max(dots)
    return units[dots.index(best)] if best > 0.75 else wanted


def _mean(one: _Point, other: _Point) -> _Point:
    """The mean of two directions of lines: the other one is turned about where it goes against the first."""
    sign = 1 if one[0] * other[0] + one[1] * other[1] >= 0 else -1
    return _unit((one[0] + sign * other[0], one[1] + sign * other[1]))


def _firm(corners: Floats, offsets: Ints) -> NDArray[np.bool_]:
    """Corners that matter for a block: not those where a straight street meets others, nor slight bends close by."""
    following, preceding = after(offsets), before(offsets)
    onward = corners[following] - corners
    span = length(onward)
    here = onward / np.maximum(span, 1e-9)[:, None]
    there = here[preceding]
    turn = np.round(there[:, 0] * here[:, 1] - there[:, 1] * here[:, 0], 6)
    ahead = there[:, 0] * here[:, 0] + there[:, 1] * here[:, 1] > 0
    short = np.minimum(span, span[preceding]) < 26
    return ~(ahead & ((np.abs(turn) < 0.03) | (short & (np.abs(turn) < 0.2))))


def _laid(corners: Floats, offsets: Ints, firm: NDArray[np.bool_], kept: Floats) -> Floats:
    """Corners of an inset at all corners of cells: those that are not firm lie between firm ones."""
    numbers = np.cumsum(firm) - 1
    rings = ring_numbers(offsets)
    count = np.bincount(rings, weights=firm, minlength=len(offsets) - 1).astype(np.int64)
    first = offsets_of(count)[rings]
    last = first + np.maximum(count[rings] - 1, 0)
    low = np.where(numbers < first, last, numbers)
    high = np.where(numbers >= last, first, np.maximum(numbers, first - 1) + 1)
    own = np.flatnonzero(firm)
    start, end = corners[own[low]], corners[own[high]]
    way = end - start
    squared = np.maximum((way * way)[:, 0] + (way * way)[:, 1], 1e-9)
    from_start = corners - start
    t = np.clip((from_start[:, 0] * way[:, 0] + from_start[:, 1] * way[:, 1]) / squared, 0, 1)
    between = kept[low] + (kept[high] - kept[low]) * t[:, None]
    return millimetres(np.where(firm[:, None], kept[np.maximum(numbers, 0)], between))


def _joined(offsets: Ints, corners: Floats, street: Ints) -> tuple[Ints, Floats, Ints]:
    """Put the corners of all cells into the edges of others on which they lie.

    Corners a few metres apart become one: streets that come from both sides meet in a crossing.
    """
    points, name = np.unique(corners, axis=0, return_inverse=True)
    name = name.reshape(-1)
    ends = corners[after(offsets)]
    lines = shapely.linestrings(np.stack([corners, ends], axis=1))
    tree = shapely.STRtree(shapely.points(points))
    edge, point = tree.query(lines, predicate="dwithin", distance=0.01)
    along = ends - corners
    span = length(along)
    way = points[point] - corners[edge]
    at = (way[:, 0] * along[edge][:, 0] + way[:, 1] * along[edge][:, 1]) / np.maximum(span[edge], 1e-9)
    inner = (point != name[edge]) & (point != name[after(offsets)[edge]])
    edge, point, at = edge[inner], point[inner], np.round(at[inner], 3)
    every = np.concatenate([np.arange(len(corners)), edge])
    order = np.lexsort((np.concatenate([np.full(len(corners), -1.0), at]), every))
    names = np.concatenate([name, point])[order]
    street = street[every[order]]
    ring = ring_numbers(offsets)[every[order]]
    one, other = tree.query(shapely.points(points), predicate="dwithin", distance=_CROSSING)
    same = np.arange(len(points))
    for a, b in zip(*(v[one < other].tolist() for v in (one, other)), strict=True):
        if same[a] == a:  # the first of several near ones takes the others
            same[b] = a
    names = same[names]
    begin = offsets_of(np.bincount(ring, minlength=len(offsets) - 1))
    kept = names != names[after(begin)]
    # A cell that shrinks to a line is gone: those beside it meet.
    kept &= (np.bincount(ring[kept], minlength=len(offsets) - 1) > 2)[ring]
    counts = np.bincount(ring[kept], minlength=len(offsets) - 1)
    return offsets_of(counts[counts > 0]), points[names[kept]], street[kept]
