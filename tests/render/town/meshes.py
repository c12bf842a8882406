"""Brute force over meshes: which edges of a building's surface have nothing on their other side."""

from __future__ import annotations

import itertools
from collections import defaultdict

import numpy as np
from numpy.typing import NDArray

from facade_nb.render.town import Town

Point = tuple[int, int, int]


def triangles_of(town: Town, building: int) -> NDArray[np.float64]:
    """(t, 3, 3) positions, x east, y up, z south."""
    own = town.indices.reshape(-1, 3)[town.building_of == building]
    return town.vertices["position"][own].astype(np.float64)


def free_edges(triangles: NDArray[np.float64], near: float = 0.004) -> list[tuple[Point, Point]]:
    """Edges (in millimetres) that no triangle has the other way; where one edge meets several, it is parted."""
    mm = np.rint(triangles * 1000).astype(np.int64)
    points = np.unique(mm.reshape(-1, 3), axis=0)
    # Corners a few millimetres apart are one: insets of neighbours round apart.
    name = np.arange(len(points))
    for i in range(len(points)):
        same = np.flatnonzero((np.abs(points - points[i]) <= 1000 * near).all(axis=1))
        name[i] = name[same[0]]
    where = {tuple(point): int(n) for point, n in zip(points.tolist(), name.tolist(), strict=True)}
    kept = np.unique(name)
    count: dict[tuple[int, int], int] = defaultdict(int)
    for triangle in mm.tolist():
        ids = [where[tuple(corner)] for corner in triangle]
        if len(set(ids)) < 3:
            continue
        for a, b in zip(ids, ids[1:] + ids[:1], strict=True):
            p, q = points[a].astype(float), points[b].astype(float)
            way = q - p
            t = (points[kept] - p) @ way / (way @ way)
            away = np.linalg.norm(points[kept] - p - t[:, None] * way, axis=1)
            on = kept[(t > 1e-6) & (t < 1 - 1e-6) & (away <= 1000 * near)]
            order = [a, *on[np.argsort((points[on] - p) @ way)].tolist(), b]
            for one, other in itertools.pairwise(order):
                count[one, other] += 1
    left = []
    for (a, b), n in count.items():
        for _ in range(n - count.get((b, a), 0)):
            left.append((tuple(points[a].tolist()), tuple(points[b].tolist())))
    return left


def volumes(triangles: NDArray[np.float64]) -> NDArray[np.float64]:
    """What a surface encloses, measured along x, y and z: alike if it is closed but for its foot at y = 0."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    normal = np.cross(b - a, c - a) / 2
    return np.asarray((normal * (a + b + c) / 3).sum(axis=0))
