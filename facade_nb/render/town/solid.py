"""Narrow blocks of an old town: houses that reach from street to street, or two rows with a slit of a yard between."""

from __future__ import annotations

from math import sqrt

import numpy as np

from .chance import chance
from .footprints import Group
from .perimeter import Blocks
from .roles import COURT, SIDE, STREET

__all__ = ["sliced"]

DEEPEST = 75.0
"""Blocks of a greater depth are none of these, metres."""

_Corner = tuple[float, float]
_Ring = list[tuple[_Corner, int]]
"""Corners with the role of the edge that begins there."""


def sliced(blocks: Blocks, seed: int) -> tuple[list[Group], Blocks]:
    """Houses in narrow blocks, and the blocks that are too deep or too small for it."""
    random = chance(seed, 11)
    by_count: dict[int, list[tuple[_Ring, int, int, bool]]] = {}
    rest = []
    for k in range(len(blocks.rank)):
        corners = blocks.corners[blocks.offsets[k] : blocks.offsets[k + 1]].tolist()
        shakes = random.random(64).tolist()
        rings = _slices([((x, y), STREET) for x, y in corners], shakes)
        if not rings:
            rest.append(k)
        for number, (ring, corner) in enumerate(rings):
            by_count.setdefault(len(ring), []).append((ring, k, number, corner))
    groups = []
    for count in sorted(by_count):
        found = by_count[count]
        block = np.array([k for _, k, _, _ in found])
        street = np.minimum.reduceat(blocks.street, blocks.offsets[:-1])[block]
        groups.append(
            Group(
                np.array([[corner for corner, _ in ring] for ring, _, _, _ in found]),
                np.array([[role for _, role in ring] for ring, _, _, _ in found], np.uint8),
                blocks.rank[block],
                np.array([number for _, _, number, _ in found]),
                blocks.district[block],
                street,
                np.array([corner for _, _, _, corner in found]),
            )
        )
    return groups, blocks.take(np.array(rest, np.int64))


def _slices(ring: _Ring, shakes: list[float]) -> list[tuple[_Ring, bool]]:
    """A block cut across its length, and along its middle where it is deep; whether each piece turns a corner."""
    ways = [(b[0] - a[0], b[1] - a[1]) for (a, _), (b, _) in zip(ring, ring[1:] + ring[:1], strict=True)]
    turns = [a[0] * b[1] - a[1] * b[0] for a, b in zip(ways, ways[1:] + ways[:1], strict=True)]
    if min(turns) < -6.0:
        return []
    spans = [round(x * x + y * y, 3) for x, y in ways]
    longest = spans.index(max(spans))
    span = sqrt(ways[longest][0] ** 2 + ways[longest][1] ** 2)
    u = (ways[longest][0] / span, ways[longest][1] / span)
    n = (-u[1], u[0])
    along = [p[0] * u[0] + p[1] * u[1] for p, _ in ring]
    across = [p[0] * n[0] + p[1] * n[1] for p, _ in ring]
    low, wide, deep = min(along), max(along) - min(along), max(across) - min(across)
    if deep > DEEPEST or wide < 12 or deep < 6:
        return []
    rows = [ring]
    if deep > 19:
        middle, gap = min(across) + deep / 2, max(3.0, deep - 23)
        rows = [
            _clip(ring, n, middle - gap / 2, 1, COURT),
            _clip(ring, n, middle + gap / 2, -1, COURT),
        ]
    found = []
    for j, row in enumerate(rows):
        count = max(1, min(24, round(wide / (8.5 + 3.5 * shakes[j]))))
        cuts = [low + wide * (k + 0.3 * (shakes[2 + 24 * j + k] - 0.5)) / count for k in range(1, count)]
        bounds = [low - 1, *cuts, low + wide + 1]
        for k in range(count):
            piece = _clip(_clip(row, u, bounds[k], -1, SIDE), u, bounds[k + 1], 1, SIDE)
            if len(piece) > 2 and _area(piece) > 28:
                found.append((piece, k in (0, count - 1)))
    return found


def _area(ring: _Ring) -> float:
    return sum(
        a[0] * b[1] - a[1] * b[0] for (a, _), (b, _) in zip(ring, ring[1:] + ring[:1], strict=True)
    ) / 2  # fmt: skip


def _clip(ring: _Ring, normal: _Corner, at: float, sign: int, role: int) -> _Ring:
    """What of a ring lies below a line across a direction (sign 1) or above it (-1); the cut has a role of its own."""
    found: _Ring = []
    sides = [round(sign * (at - p[0] * normal[0] - p[1] * normal[1]), 3) for p, _ in ring]
    for i, (corner, own) in enumerate(ring):
        j = (i + 1) % len(ring)
        here, there = sides[i], sides[j]
        if here > 0 or (here == 0 and there > 0):
            found.append((corner, own))
        elif here == 0 and sides[i - 1] > 0:
            found.append((corner, role))
        if here * there < 0:
            t = here / (here - there)
            (x0, y0), (x1, y1) = corner, ring[j][0]
            crossing = (round(x0 + t * (x1 - x0), 3), round(y0 + t * (y1 - y0), 3))
            found.append((crossing, role if here > 0 else own))
    return found
