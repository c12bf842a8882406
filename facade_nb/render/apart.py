"""Bodies of a mesh that touch along an edge, a hair's breadth apart: programs that merge corners see them closed still.

Two closed bodies side by side share edges. A program that makes one corner of those that lie in one place finds four
faces at such an edge, and calls the mesh neither closed nor a solid. So the smaller of two such bodies is drawn in, by
less than anything is built to.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from itertools import combinations, groupby

import numpy as np
from numpy.typing import NDArray

from .meshing import Mesh

__all__ = ["APART", "apart"]

APART = 5e-5
"""Metres that a body is drawn in by on each side, once or a few times."""

_NEAR = 2.5e-5
"""What lies nearer may be made one."""

_ROUNDS = 12
"""So many times at most is looked whether bodies touch that were drawn in."""

_ASKEW = np.array([0.37, 0.23, 0.41])
"""Which way a body is moved besides, so that an edge in its middle moves as well."""

_SHARE = 0.1
"""Of a body's size: it is drawn in by no more."""

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def apart(mesh: Mesh) -> Mesh:
    """The mesh with bodies of which none has an edge where another one has; it stays as large as it is."""
    count = int(mesh.bodies.max(initial=-1)) + 1
    if count < 2:
        return mesh
    flat, owners = mesh.faces.reshape(-1), np.repeat(mesh.bodies, 3)
    pairs, at = np.unique(np.stack([owners, flat], 1), axis=0, return_inverse=True)
    at = at.reshape(-1, 3)
    owner, points = pairs[:, 0], mesh.vertices[pairs[:, 1]]
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(low, owner, points)
    np.maximum.at(high, owner, points)
    rank = np.argsort(np.argsort(-np.round((high - low).prod(axis=1), 9), kind="stable"), kind="stable")
    ends = _ends(points, owner, rank)
    meets: dict[int, set[int]] = defaultdict(set)
    moved = points
    for _ in range(_ROUNDS):
        found = _touching(moved, at, owner)
        if not found:
            break
        for one, other in found:
            meets[one].add(other)
            meets[other].add(one)
        moved = np.where(ends, points, _drawn_in(points, owner, low, high, _times(meets, rank)))
    return mesh if moved is points else replace(mesh, vertices=moved, faces=at)


def _ends(points: Floats, owner: Ints, rank: Ints) -> NDArray[np.bool_]:
    """Which coordinates stay: for each end of the mesh, those of the largest body that reaches to it."""
    found = np.zeros(points.shape, bool)
    for axis in range(3):
        values = points[:, axis]
        for end in (values.min(), values.max()):
            there = np.flatnonzero(values == end)
            found[there[rank[owner[there]] == rank[owner[there]].min()], axis] = True
    return found


def _touching(points: Floats, faces: Ints, owner: Ints) -> set[tuple[int, int]]:
    """Pairs of bodies that have an edge in one place."""
    places = np.stack([_places(points[:, axis]) for axis in range(3)], 1)
    corner = np.unique(places, axis=0, return_inverse=True)[1].reshape(-1)
    ends = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    edges = np.sort(corner[ends], axis=1)
    rows = np.unique(np.column_stack([edges, owner[ends[:, 0]]]), axis=0)
    again = (rows[1:, :2] == rows[:-1, :2]).all(axis=1)
    if not again.any():
        return set()
    shared = rows[np.append(again, False) | np.insert(again, 0, False)]
    return {
        pair
        for _, group in groupby(shared.tolist(), key=lambda row: (row[0], row[1]))
        for pair in combinations(sorted(row[2] for row in group), 2)
    }


def _places(values: Floats) -> Ints:
    """The number of the place of each value; values with less than `_NEAR` between them have one."""
    order = np.argsort(values, kind="stable")
    number = np.cumsum(np.insert(np.diff(values[order]) > _NEAR, 0, False))
    found = np.empty(len(values), np.int64)
    found[order] = number
    return found


def _times(meets: dict[int, set[int]], rank: Ints) -> dict[int, int]:
    """How often each body is drawn in: the largest not at all, and no two that touch as often."""
    found: dict[int, int] = {}
    for body in sorted(meets, key=lambda body: int(rank[body])):
        taken = {found[other] for other in meets[body] if other in found}
        found[body] = next(k for k in range(len(taken) + 1) if k not in taken)
    return found


def _drawn_in(points: Floats, owner: Ints, low: Floats, high: Floats, times: dict[int, int]) -> Floats:
    by = np.zeros((len(low), 1))
    by[list(times), 0] = [APART * k for k in times.values()]
    size = np.maximum(high - low, 1e-12)
    by = np.minimum(by, _SHARE * size)
    middle = (low + high) / 2
    return middle[owner] + (points - middle[owner]) * (1 - 2 * by / size)[owner] + (by * _ASKEW)[owner]
