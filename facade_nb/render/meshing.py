"""From parts to triangles. Every part becomes a closed body, its triangles counter-clockwise seen from outside."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray

from .parts import Block, Moulding, Part, Point, Polyhedron, Prism, Ring, Turned

__all__ = [
    "SEGMENTS",
    "Mesh",
    "assembled",
    "corner_normals",
    "corner_places",
    "have_area",
    "mesh_part",
    "mesh_parts",
    "surface_axes",
    "triangulate",
]

SEGMENTS = 32
"""Sides of a turned body."""

_EDGE = 0.5
"""Cosine of the angle between a curved face and its neighbours' average from which on they meet at an edge."""

_LEVEL = 0.97
"""From that cosine on a surface lies flat: its texture runs along x and back."""

_NEXT, _AFTER = [1, 2, 0], [2, 0, 1]

_BOX = np.array(
    [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4],
     [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]]
)  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
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
    smooth
        (m,) bool: shaded as a curved surface, with the normals of its neighbours.
    names
        The slots.
    bodies
        (m,) int64: which of the closed bodies a triangle belongs to.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    slots: NDArray[np.int64]
    smooth: NDArray[np.bool_]
    names: tuple[str, ...]
    bodies: NDArray[np.int64]


Body = tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.bool_], str]
"""Vertices (n, 3), faces (m, 3), which faces are curved (m,), and the slot of one closed body."""


def mesh_parts(parts: Sequence[Part]) -> Mesh:
    """One mesh of all parts."""
    return assembled((*mesh_part(part), part.slot) for part in parts)


def assembled(bodies: Iterable[Body]) -> Mesh:
    """One mesh of closed bodies."""
    vertices, faces, slots, smooth = [], [], [], []
    names: list[str] = []
    count = 0
    for points, triangles, curved, slot in bodies:
        if slot not in names:
            names.append(slot)
        vertices.append(points)
        faces.append(triangles + count)
        slots.append(np.full(len(triangles), names.index(slot)))
        smooth.append(curved)
        count += len(points)
    if not vertices:
        return Mesh(
            np.zeros((0, 3)), np.zeros((0, 3), int), np.zeros(0, int), np.zeros(0, bool), (), np.zeros(0, int)
        )
    mesh = Mesh(
        np.concatenate(vertices),
        np.concatenate(faces),
        np.concatenate(slots),
        np.concatenate(smooth),
        tuple(names),
        np.repeat(np.arange(len(faces)), [len(triangles) for triangles in faces]),
    )
    sound = have_area(mesh.vertices[mesh.faces])
    return mesh if sound.all() else _welded(mesh)


def have_area(corners: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which triangles (m, 3, 3) have an area, their corners as exact as files and drawing libraries have them."""
    single = corners.astype(np.float32).astype(np.float64)
    found: NDArray[np.bool_] = (_across(single) != 0).any(axis=1)
    return found


def _across(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """The cross product of two sides of each triangle; faster than `numpy.cross`, which asks what it was given."""
    a, b = (corners[:, k] - corners[:, 0] for k in (1, 2))
    return a[:, _NEXT] * b[:, _AFTER] - a[:, _AFTER] * b[:, _NEXT]


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
    return Mesh(
        mesh.vertices, faces[kept], mesh.slots[kept], mesh.smooth[kept], mesh.names, mesh.bodies[kept]
    )


def mesh_part(part: Part) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.bool_]]:
    """Vertices (n, 3), faces (m, 3) and which faces are curved (m,) of one part."""
    match part:
        case Block():
            points, faces = _block(part)
        case Ring():
            points, faces = _ring(part)
        case Prism():
            points, faces = _extruded([(x, y) for x, y in part.points], part.z0, part.z1)
        case Moulding():
            points, faces = _moulding(part)
        case Turned():
            return _turned(part)
        case Polyhedron():
            points = np.array(part.points, float)
            faces = np.array([(f[0], f[i], f[i + 1]) for f in part.faces for i in range(1, len(f) - 1)])
    return points, faces, np.zeros(len(faces), bool)


def _block(b: Block) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    plan = ((b.x0, b.y0), (b.x1, b.y0), (b.x1, b.y1), (b.x0, b.y1))
    return np.array([(x, y, z) for z in (b.z0, b.z1) for x, y in plan], float), _BOX


def _ring(r: Ring) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    t = r.width
    outer = ((r.x0, r.y0), (r.x1, r.y0), (r.x1, r.y1), (r.x0, r.y1))
    inner = ((r.x0 + t, r.y0 + t), (r.x1 - t, r.y0 + t), (r.x1 - t, r.y1 - t), (r.x0 + t, r.y1 - t))
    points = np.array([(x, y, z) for z in (r.z0, r.z1) for loop in (outer, inner) for x, y in loop], float)
    faces: list[tuple[int, int, int]] = []
    for i in range(4):
        j = (i + 1) % 4
        a, b, c, e = (
            i,
            j,
            4 + i,
            4 + j,
        )  # back: outer i, outer j, inner i, inner j; the front lies 8 further on
        for quad in ((a + 8, b + 8, e + 8, c + 8), (a, c, e, b), (a, b, b + 8, a + 8), (c, c + 8, e + 8, e)):
            faces += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
    return points, np.array(faces)


def _extruded(
    polygon: Sequence[Point], z0: float, z1: float
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    n = len(polygon)
    points = np.array([(x, y, z) for z in (z0, z1) for x, y in polygon], float)
    cap = triangulate(polygon)
    i = np.arange(n)
    j = (i + 1) % n
    sides = np.concatenate([np.stack([i, j, j + n], 1), np.stack([i, j + n, i + n], 1)])
    return points, np.concatenate([cap[:, ::-1], cap + n, sides])


def _moulding(m: Moulding) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    # Seen from the right end (+x) with z to the left and y up, front and back run counter-clockwise as (-z, y).
    loop = [(-z, y) for y, z in m.profile]
    loop = [(-m.z0, loop[0][1]), *loop[::1], (-m.z0, loop[-1][1])]
    points, faces = _extruded(_without_spikes(loop[::-1]), m.x0, m.x1)
    return np.stack([points[:, 2], points[:, 1], -points[:, 0]], 1), faces


def _without_spikes(polygon: Sequence[Point]) -> list[Point]:
    """The polygon without corners that are there twice, and without ways that lead somewhere and straight back."""
    left = list(polygon)
    k = 0
    while k < len(left) and len(left) > 3:
        a, b, c = left[k - 1], left[k], left[(k + 1) % len(left)]
        ahead = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1])
        if b in (a, c) or (_turn(a, b, c) == 0 and ahead < 0):
            del left[k]
            k = max(k - 2, 0)
        else:
            k += 1
    return left


def _turned(t: Turned) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.bool_]]:
    angles = [2 * pi * i / SEGMENTS for i in range(SEGMENTS)]
    around = np.array([(cos(a), sin(a)) for a in angles])
    rings = [
        np.stack([t.cx + r * around[:, 0], np.full(SEGMENTS, y), t.cz + r * around[:, 1]], 1)
        for y, r in t.profile
    ]
    i = np.arange(SEGMENTS)
    j = (i + 1) % SEGMENTS
    sides = []
    for level in range(len(rings) - 1):
        low, high = level * SEGMENTS, (level + 1) * SEGMENTS
        sides += [np.stack([low + i, high + j, low + j], 1), np.stack([low + i, high + i, high + j], 1)]
    bottom, top = len(rings) * SEGMENTS, len(rings) * SEGMENTS + 1
    last = (len(rings) - 1) * SEGMENTS
    caps = [
        np.stack([np.full(SEGMENTS, bottom), i, j], 1),
        np.stack([np.full(SEGMENTS, top), last + j, last + i], 1),
    ]
    centres = np.array([[t.cx, t.profile[0][0], t.cz], [t.cx, t.profile[-1][0], t.cz]])
    faces = np.concatenate([*sides, *caps])
    smooth = np.arange(len(faces)) < len(faces) - 2 * SEGMENTS
    return np.concatenate([*rings, centres]), faces, smooth


def triangulate(polygon: Sequence[Point]) -> NDArray[np.int64]:
    """Triangles (m, 3), as indices, of a simple counter-clockwise polygon, by cutting off ears.

    Every simple polygon has an ear with an area, corners without an angle or not: so has every triangle here.

    Raises
    ------
    ValueError
        For a polygon that crosses itself or runs clockwise.
    """
    left = list(range(len(polygon)))
    triangles: list[tuple[int, int, int]] = []
    xs, ys = [x for x, _ in polygon], [y for _, y in polygon]
    flat = (
        1e-13 * (max(xs) - min(xs)) * (max(ys) - min(ys))
    )  # what a corner turns by at most that has no angle
    while len(left) > 3:
        for k in range(len(left)):
            a, b, c = left[k - 1], left[k], left[(k + 1) % len(left)]
            if _turn(polygon[a], polygon[b], polygon[c]) <= flat:
                continue
            others = (polygon[p] for p in left if p not in (a, b, c))
            if not any(_inside(p, polygon[a], polygon[b], polygon[c]) for p in others):
                triangles.append((a, b, c))
                del left[k]
                break
        else:
            raise ValueError("expected a simple counter-clockwise polygon")
    triangles.append((left[0], left[1], left[2]))
    return np.array(triangles)


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _inside(p: Point, a: Point, b: Point, c: Point) -> bool:
    return _turn(a, b, p) >= 0 and _turn(b, c, p) >= 0 and _turn(c, a, p) >= 0 and p not in (a, b, c)


def corner_normals(mesh: Mesh) -> NDArray[np.float64]:
    """Unit normals (m, 3, 3) at the corners of each triangle: the face's own, or averaged where it is smooth.

    Where faces meet at an edge (on a column that is wider than high, say) the average would be no face's: each keeps
    its own.
    """
    corners = mesh.vertices[mesh.faces]
    across = _across(corners)
    lengths = np.linalg.norm(across, axis=1, keepdims=True)
    flat = across / np.where(lengths > 0, lengths, 1)
    normals = np.repeat(flat[:, None, :], 3, axis=1)
    if mesh.smooth.any():
        summed = np.zeros_like(mesh.vertices)
        curved = mesh.faces[mesh.smooth]
        for k in range(3):
            np.add.at(summed, curved[:, k], across[mesh.smooth])
        sizes = np.linalg.norm(summed, axis=1, keepdims=True)
        average = (summed / np.where(sizes > 0, sizes, 1))[curved]
        own = normals[mesh.smooth]
        near = (average * own).sum(axis=2, keepdims=True) > _EDGE
        normals[mesh.smooth] = np.where(near, average, own)
    return normals


def surface_axes(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """For each triangle (m, 3, 3) three unit vectors: along it, level; up it; out of it.

    A surface that lies flat has those that run along x, and back.
    """
    out = _across(corners)
    out = out / np.maximum(np.sqrt((out * out).sum(axis=1, keepdims=True)), 1e-30)
    along = np.stack([out[:, 2], np.zeros(len(out)), -out[:, 0]], axis=1)  # up × out
    level = np.abs(out[:, 1]) > _LEVEL
    along[level] = np.array([1.0, 0.0, 0.0]) - out[level, :1] * out[level]
    along /= np.maximum(np.sqrt((along * along).sum(axis=1, keepdims=True)), 1e-30)
    up = out[:, _NEXT] * along[:, _AFTER] - out[:, _AFTER] * along[:, _NEXT]
    return np.stack([along, up, out], axis=1)


def corner_places(mesh: Mesh) -> NDArray[np.float64]:
    """Texture coordinates (m, 3, 2) at the corners of each triangle: metres along its surface, level, and up it.

    Lengths on the surface are lengths in the texture. Surfaces of one plane share one texture, which begins at the
    origin. The sides of a round body lie beside each other, unrolled, where its radius is greatest.
    """
    corners = mesh.vertices[mesh.faces]
    axes = surface_axes(corners)
    places = np.stack([(corners * axes[:, None, k]).sum(axis=2) for k in (0, 1)], axis=2)
    for body in np.unique(mesh.bodies[mesh.smooth]):
        own = np.flatnonzero(mesh.smooth & (mesh.bodies == body))
        spots = corners[own].reshape(-1, 3)
        middle = (spots.min(axis=0) + spots.max(axis=0)) / 2
        side = np.round(np.arctan2(axes[own, 2, 0], axes[own, 2, 2]) * SEGMENTS / (2 * np.pi) - 0.5) + 0.5
        across = ((corners[own] - middle) * axes[own][:, None, 0]).sum(axis=2)
        places[own, :, 0] = across + 2 * np.abs(across).max() * side[:, None]
    return places
