"""From parts to triangles: the closed bodies of a shape as one mesh."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .bodies import bodies_of, body_of
from .parts import Loft, Part, Turned
from .surfaces import across, corner_normals, corner_places

__all__ = ["Mesh", "assembled", "have_area", "mesh_part", "mesh_parts", "triangles_in"]


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles of several closed parts.

    Attributes
    ----------
    vertices
        (n, 3) float64, metres.
    faces
        (m, 3) int64, indices into `vertices`.
    slots
        (m,) int64, index into `names`: which material slot a triangle has.
    round
        (m,) bool: of a body that stands for a round one.
    names
        The slots.
    bodies
        (m,) int64: which of the closed bodies a triangle belongs to.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    slots: NDArray[np.int64]
    round: NDArray[np.bool_]
    names: tuple[str, ...]
    bodies: NDArray[np.int64]

    @cached_property
    def normals(self) -> NDArray[np.float64]:
        """Unit normals (m, 3, 3) at the corners of each triangle (`corner_normals`)."""
        return corner_normals(self)

    @cached_property
    def places(self) -> NDArray[np.float64]:
        """Texture coordinates (m, 3, 2) at the corners of each triangle, metres (`corner_places`)."""
        return corner_places(self)

    def moved(self, by: NDArray[np.float64]) -> Mesh:
        """The same elsewhere; its normals stay."""
        there = replace(self, vertices=self.vertices + by)
        vars(there)["normals"] = self.normals
        return there


def mesh_parts(parts: Sequence[Part]) -> Mesh:
    """One mesh of all parts."""
    return assembled(bodies_of(parts))


def mesh_part(part: Part) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Vertices (n, 3) and triangles (m, 3) of one part, these counter-clockwise seen from outside."""
    return triangles_in(body_of(part))


def triangles_in(body: Any) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Vertices (n, 3) and triangles (m, 3) of a `manifold3d.Manifold`."""
    mesh = body.to_mesh64()
    order = np.argsort(mesh.face_id, kind="stable")  # triangles of one plane follow one another
    return np.array(mesh.vert_properties[:, :3]), np.asarray(mesh.tri_verts, np.int64)[order]


def assembled(bodies: Iterable[tuple[Part, Any]]) -> Mesh:
    """One mesh of closed bodies (`manifold3d.Manifold`), each with the part that it is of; an empty one is left out."""
    vertices, faces, looks = [np.zeros((0, 3))], [np.zeros((0, 3), np.int64)], []
    names: dict[str, int] = {}
    count = 0
    for part, body in bodies:
        points, triangles = triangles_in(body)
        if not len(triangles):
            continue
        vertices.append(points)
        faces.append(triangles + count)
        round_ = isinstance(part, Turned) or (isinstance(part, Loft) and part.round)
        looks.append((names.setdefault(part.slot, len(names)), round_))
        count += len(points)
    sizes = [len(triangles) for triangles in faces[1:]]
    slots, curved = np.repeat(np.array(looks, np.int64).reshape(-1, 2), sizes, axis=0).T
    mesh = Mesh(
        np.concatenate(vertices),
        np.concatenate(faces),
        slots,
        curved.astype(bool),
        tuple(names),
        np.repeat(np.arange(len(sizes)), sizes),
    )
    return mesh if have_area(mesh.vertices[mesh.faces]).all() else _welded(mesh)


def have_area(corners: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which triangles (m, 3, 3) have an area, their corners as exact as files and drawing libraries have them."""
    single = corners.astype(np.float32).astype(np.float64)
    found: NDArray[np.bool_] = (across(single) != 0).any(axis=1)
    return found


def _welded(mesh: Mesh) -> Mesh:
    """The mesh without triangles that have no area: corners that are one in single precision made one.

    A mesh has such only where a detail is smaller than what a file can tell from nothing: a base of a column 0.1 mm
    wide and 100 m high.
    """
    _, first, number = np.unique(
        mesh.vertices.astype(np.float32), axis=0, return_index=True, return_inverse=True
    )
    faces = first[number.reshape(-1)][mesh.faces]
    kept = have_area(mesh.vertices[faces])
    return Mesh(mesh.vertices, faces[kept], mesh.slots[kept], mesh.round[kept], mesh.names, mesh.bodies[kept])
