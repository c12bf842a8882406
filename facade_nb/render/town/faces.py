"""Faces of a mesh: polygons in space, each a rectangle of façade coordinates about it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..pipeline.vertices import VERTEX
from .chance import Floats
from .rings import Ints
from .welding import welded

__all__ = ["Faces"]


_NOTHING = 1e-5
"""Planes of a smaller area are none, square metres."""


@dataclass(slots=True, eq=False)
class Faces:
    """Gathers faces. Positions are x east, y north, z up; they turn to x east, y up, z south as they come in.

    Attributes
    ----------
    vertices
        Arrays of VERTEX.
    triangles
        Arrays (t, 3) of indices into all vertices.
    owners
        The building of each vertex; -1: ground.
    own
        Which vertices tell what their face shows (`welding`): the last of all its triangles.
    """

    vertices: list[np.ndarray] = field(default_factory=list)
    triangles: list[Ints] = field(default_factory=list)
    owners: list[Ints] = field(default_factory=list)
    own: list[NDArray[np.bool_]] = field(default_factory=list)
    count: int = 0

    @property
    def mark(self) -> tuple[int, int]:
        """How many arrays of vertices and of triangles there are: what `weld` may begin with."""
        return len(self.vertices), len(self.triangles)

    def weld(self, mark: tuple[int, int] = (0, 0)) -> None:
        """Let faces that came after a mark share corners (`welding`); none of their owners has any before it."""
        first, more = mark
        if len(self.vertices) == first:
            return
        base = sum(map(len, self.vertices[:first]))
        vertices, owners, own = (np.concatenate(v[first:]) for v in (self.vertices, self.owners, self.own))
        triangles = np.concatenate(self.triangles[more:]) - base
        kept, triangles = welded(vertices["position"], triangles, owners, own)
        self.vertices[first:], self.triangles[more:] = [vertices[kept]], [triangles + base]
        self.owners[first:], self.own[first:] = [owners[kept]], [own[kept]]
        self.count = base + len(kept)

    def walls(
        self, foot: Floats, end: Floats, low: Floats, high: Floats, start: Floats, seed: Floats, owner: Ints
    ) -> None:
        """Upright rectangles above lines (f, 2) from foot to end, seen from their right, between two heights (f,).

        Their façade goes down to the ground, whatever stands before it.
        """
        way = end - foot
        span = np.sqrt(way[:, 0] * way[:, 0] + way[:, 1] * way[:, 1])
        u = way / np.maximum(span, 1e-9)[:, None]
        zero = np.zeros(len(foot))
        points = np.stack(
            [np.column_stack([p, h]) for p, h in ((foot, low), (end, low), (end, high), (foot, high))], axis=1
        )
        place = np.stack(
            [np.column_stack([x, y]) for x, y in ((zero, low), (span, low), (span, high), (zero, high))],
            axis=1,
        )
        normal = np.column_stack([u[:, 1], -u[:, 0], zero])
        tangent = np.column_stack([u, zero])
        self.add(points, place, np.column_stack([span, high]), start, seed, normal, tangent, owner)

    def planes(
        self,
        points: Floats,
        along: Floats,
        start: Floats,
        seed: Floats,
        owner: Ints,
        foot: Floats | None = None,
        plane: Ints | None = None,
        both: NDArray[np.bool_] | None = None,
    ) -> None:
        """Flat polygons (f, k, 3), counter-clockwise from outside, whose width runs along vectors (f, 3) in them.

        Parameters
        ----------
        foot, plane
            (f, 3), (f,) where polygons are parts of larger planes: a point of each plane, and its number. All parts of
            a plane have one façade.
        both
            (f,) which are seen from behind, too.
        """
        normal, size = _normals(points)
        kept = size > _NOTHING  # where a chain of corners stands still, its planes are lines
        points, along, normal, start, seed = (v[kept] for v in (points, along, normal, start, seed))
        owner = owner[kept]
        across = _unit(_cross(normal, _unit(along)))
        tangent = _cross(across, normal)
        away = points if foot is None else points - foot[kept][:, None]
        u = (away * tangent[:, None]).sum(axis=2)
        v = (away * across[:, None]).sum(axis=2)
        place = np.stack([u, v], axis=2)
        low, high = place.min(axis=1), place.max(axis=1)
        if plane is not None and len(low):
            _, part = np.unique(plane[kept], return_inverse=True)
            ends = [np.full((int(part.max()) + 1, 2), sign * np.inf) for sign in (1, -1)]
            np.minimum.at(ends[0], part, low)
            np.maximum.at(ends[1], part, high)
            low, high = ends[0][part], ends[1][part]
        place = np.round(np.maximum(place - low[:, None], 0), 4)
        self.add(points, place, np.round(high - low, 4), start, seed, normal, tangent, owner)
        if both is not None and len(points) and both[kept].any():
            self._behind(points.shape[:2], both[kept])

    def _behind(self, shape: tuple[int, int], chosen: NDArray[np.bool_]) -> None:
        """Add the faces that came last once more, the other way round, with the same vertices."""
        f, k = shape
        triangles = self.triangles[-1].reshape(f, k - 2, 3)[chosen]
        self.triangles.append(triangles[..., [1, 0, 2]].reshape(-1, 3))

    def add(
        self,
        points: Floats,
        place: Floats,
        size: Floats,
        start: Floats,
        seed: Floats,
        normal: Floats,
        tangent: Floats,
        owner: Ints,
    ) -> None:
        """Convex polygons (f, k, 3); what is the same for all corners of a face is (f, …)."""
        f, k = points.shape[:2]
        if not f:
            return
        fan = np.array([[i, i + 1, 0] for i in range(1, k - 1)])
        triangles = (np.arange(f)[:, None, None] * k + fan).reshape(-1, 3)
        size, start, seed, normal, tangent = (
            np.repeat(v, k, axis=0) for v in (size, start, seed, normal, tangent)
        )
        owner = np.repeat(owner, k)
        self.loose(
            points.reshape(-1, 3), place.reshape(-1, 2), size, start, seed, normal, tangent, owner, triangles
        )
        self.own[-1] = np.arange(f * k) % k == 0

    def loose(
        self,
        points: Floats,
        place: Floats,
        size: Floats,
        start: Floats,
        seed: Floats,
        normal: Floats,
        tangent: Floats,
        owner: Ints,
        triangles: Ints,
    ) -> None:
        """Vertices (v, …) and triangles of them."""
        made = np.empty(len(points), VERTEX)
        made["position"] = _turned(points)
        made["place"], made["size"], made["start"], made["seed"] = place, size, start, seed
        made["normal"], made["tangent"] = _turned(normal), _turned(tangent)
        self.vertices.append(made)
        self.triangles.append(triangles + self.count)
        self.owners.append(np.asarray(owner, np.int64))
        self.own.append(np.ones(len(made), bool))
        self.count += len(made)


def _turned(v: Floats) -> Floats:
    """From x east, y north, z up to x east, y up, z south. There is no minus zero."""
    return np.stack([v[:, 0], v[:, 2], -v[:, 1]], axis=1).astype(np.float32) + np.float32(0)


def _cross(a: Floats, b: Floats) -> Floats:
    return np.stack(
        [
            a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1],
            a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2],
            a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0],
        ],
        axis=1,
    )


def _unit(v: Floats) -> Floats:
    span = np.sqrt(v[:, 0] * v[:, 0] + v[:, 1] * v[:, 1] + v[:, 2] * v[:, 2])
    return np.asarray(v / np.maximum(span, 1e-12)[:, None])


def _normals(points: Floats) -> tuple[Floats, Floats]:
    """Unit normals of polygons, also where some of their corners coincide or lie in a line, and twice their areas."""
    total = np.zeros((len(points), 3))
    for i in range(1, points.shape[1] - 1):
        total = total + _cross(points[:, i] - points[:, 0], points[:, i + 1] - points[:, 0])
    size = np.sqrt(total[:, 0] * total[:, 0] + total[:, 1] * total[:, 1] + total[:, 2] * total[:, 2])
    return _unit(total), size
