"""Normals and texture coordinates of meshes: both follow from the triangles alone."""

from __future__ import annotations

from collections import defaultdict, deque
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .bodies import SEGMENTS

if TYPE_CHECKING:
    from .meshing import Mesh

__all__ = ["across", "corner_normals", "corner_places", "surface_axes"]

_BLUNT, _ROUND, _PLANE = float(np.cos(np.radians(25))), float(np.cos(np.radians(46))), 1 - 1e-9
"""Cosines of angles between faces: at less than 25 degrees they are one curved surface, as the sides of an arch are.

Hips of a low roof meet at hardly more. A round body, whose profile has few corners, is curved up to 46 degrees: eight
sides are round.
"""

_LEVEL = 0.97
"""From that cosine on a surface lies flat: its texture runs along x and back."""

_NEXT, _AFTER = [1, 2, 0], [2, 0, 1]


def across(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """The cross product of two sides of each triangle (m, 3, 3); `numpy.cross` takes longer."""
    a, b = (corners[:, k] - corners[:, 0] for k in (1, 2))
    return a[:, _NEXT] * b[:, _AFTER] - a[:, _AFTER] * b[:, _NEXT]


def corner_normals(mesh: Mesh) -> NDArray[np.float64]:
    """Unit normals (m, 3, 3) at the corners of each triangle.

    Around a vertex, faces that meet at less than the crease angle have one normal: the mean of theirs by the weights of
    Nelson Max, which are right on a sphere, and those of a plane face however it is cut into triangles. So a round side
    is smooth, and its edge crisp.
    """
    corners, count = mesh.vertices[mesh.faces], 3 * len(mesh.faces)
    crossed = across(corners)
    own = np.repeat(crossed / np.maximum(np.linalg.norm(crossed, axis=1, keepdims=True), 1e-300), 3, axis=0)
    first, second = _joined(mesh, own)
    if not len(first):
        return own.reshape(-1, 3, 3)
    group = np.arange(count)
    while True:  # the least number of those that a corner is joined to, and they to others
        least = group.copy()
        np.minimum.at(least, first, group[second])
        np.minimum.at(least, second, group[first])
        if (least == group).all():
            break
        group = least
    sides = ((corners[:, [1, 2, 0]] - corners) ** 2).sum(axis=2, keepdims=True)
    mean = np.zeros((count, 3))
    np.add.at(mean, group, (crossed[:, None] / (sides * sides[:, [2, 0, 1]])).reshape(-1, 3))
    mean = mean[group] / np.maximum(np.linalg.norm(mean[group], axis=1, keepdims=True), 1e-300)
    near = (mean * own).sum(axis=1) > _crease(mesh)
    smooth = (np.bincount(group, minlength=count)[group] > 1) & near
    return np.where(smooth[:, None], mean, own).reshape(-1, 3, 3)


def _crease(mesh: Mesh) -> NDArray[np.float64]:
    """The cosine at each corner (3 m,) up to which its surface is curved."""
    return np.repeat(np.where(mesh.round, _ROUND, _BLUNT), 3)


def _joined(mesh: Mesh, own: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Corners, numbered through, on both sides of edges that are no creases; none where all surfaces are plane.

    `own` (3 m, 3) has at each corner the normal of its triangle.
    """
    begins = np.arange(len(own))
    ends = begins + np.where(begins % 3 == 2, -2, 1)
    vertex = mesh.faces.reshape(-1)
    rises = vertex[begins] < vertex[ends]
    low, high = np.where(rises, begins, ends), np.where(rises, ends, begins)
    order = np.lexsort((vertex[high], vertex[low]))
    low, high = low[order], high[order]
    pair = np.flatnonzero((vertex[low[1:]] == vertex[low[:-1]]) & (vertex[high[1:]] == vertex[high[:-1]]))
    bend = (own[low[pair]] * own[low[pair + 1]]).sum(axis=1)
    pair = pair[bend > _crease(mesh)[low[pair]]]
    if not (bend[bend > _BLUNT] < _PLANE).any() and not mesh.round.any():
        pair = pair[:0]
    return (
        np.concatenate([low[pair], high[pair]]),
        np.concatenate([low[pair + 1], high[pair + 1]]),
    )


def surface_axes(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """For each triangle (m, 3, 3) three unit vectors: along it, level; up it; out of it.

    A surface that lies flat has those that run along x, and back.
    """
    out = across(corners)
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
    origin. A curved surface, as that under an arch, is unrolled. The sides of a round body, which cannot be, lie
    beside each other where its radius is greatest.
    """
    corners = mesh.vertices[mesh.faces]
    axes = surface_axes(corners)
    places = np.stack([(corners * axes[:, None, k]).sum(axis=2) for k in (0, 1)], axis=2)
    _unroll(mesh, places, axes[:, 2])
    for body in np.unique(mesh.bodies[mesh.round]):
        own = np.flatnonzero(mesh.round & (mesh.bodies == body))
        spots = corners[own].reshape(-1, 3)
        middle = (spots.min(axis=0) + spots.max(axis=0)) / 2
        side = np.round(np.arctan2(axes[own, 2, 0], axes[own, 2, 2]) * SEGMENTS / (2 * np.pi) - 0.5) + 0.5
        across = ((corners[own] - middle) * axes[own][:, None, 0]).sum(axis=2)
        places[own, :, 0] = across + 2 * np.abs(across).max() * side[:, None]
    return places


def _unroll(mesh: Mesh, places: NDArray[np.float64], out: NDArray[np.float64]) -> None:
    """Turn the triangles of each curved surface so that they meet in the texture; its most upright one stays."""
    first, second = _joined(mesh, np.repeat(out, 3, axis=0))
    count = len(first) // 2
    beside: dict[int, list[tuple[int, ...]]] = defaultdict(list)
    curved: set[int] = set()
    ends = np.stack([first[:count], first[count:], second[:count], second[count:]], axis=1)
    own, other = ends[:, 0] // 3, ends[:, 2] // 3
    bent = ((out[own] * out[other]).sum(axis=1) < _PLANE).tolist()
    for f, g, corners, bends in zip(own.tolist(), other.tolist(), ends.tolist(), bent, strict=True):
        if not mesh.round[f]:
            beside[f].append((g, *corners))
            beside[g].append((f, *corners[2:], *corners[:2]))
            curved.update((f, g) if bends else ())
    flat = places.reshape(-1, 2).view(np.complex128)[:, 0]
    seen: set[int] = set()
    for start in sorted(curved, key=lambda f: (round(abs(float(out[f, 1])), 6), f)):
        if start in seen:
            continue
        seen.add(start)
        todo = deque([start])
        while todo:
            for g, a, b, c, d in beside[todo.popleft()]:
                if g not in seen:
                    turn = (flat[b] - flat[a]) / (flat[d] - flat[c])
                    flat[3 * g : 3 * g + 3] = flat[a] + turn / abs(turn) * (flat[3 * g : 3 * g + 3] - flat[c])
                    seen.add(g)
                    todo.append(g)
