"""Openings in bodies: what shapes cut out of the walls that they stand in, by manifold3d."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .cuts import Cut
from .meshing import Mesh, assembled, mesh_part
from .parts import Part, front

__all__ = ["carved"]

_AHEAD = 10.0
"""How far in front of a body its cuts begin, metres."""


def carved(parts: Sequence[Part], cuts: Sequence[Cut]) -> Mesh:
    """The mesh of parts with openings cut out. Bodies stay closed; a part that is cut away is left out."""
    return assembled(_carved(parts, cuts))


def _carved(
    parts: Sequence[Part], cuts: Sequence[Cut]
) -> Iterator[tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.bool_], str]]:
    for part in parts:
        points, faces, curved = mesh_part(part)
        low, high = points.min(axis=0), points.max(axis=0)
        here = [cut for cut in cuts if _meets(cut, low, high)]
        if not here:
            yield points, faces, curved, part.slot
            continue
        body = _body(points, faces)
        for cut in here:
            body -= _cutter(cut, front(part), float(low[2]))
        mesh = body.to_mesh64()
        if len(mesh.tri_verts):
            found = np.asarray(mesh.tri_verts, np.int64)
            yield np.array(mesh.vert_properties[:, :3]), found, np.zeros(len(found), bool), part.slot


def _meets(cut: Cut, low: NDArray[np.float64], high: NDArray[np.float64]) -> bool:
    left, bottom, right, top = cut.box
    return bool(
        left < high[0] and right > low[0] and bottom < high[1] and top > low[1] and cut.back < high[2]
    )


def _body(points: NDArray[np.float64], faces: NDArray[np.int64]) -> Any:
    from manifold3d import Manifold, Mesh64

    return Manifold(Mesh64(points, faces.astype(np.uint64)))


def _cutter(cut: Cut, near: float, far: float) -> Any:
    from manifold3d import CrossSection, Manifold

    back = max(cut.back, far - 1.0)
    outline = CrossSection([np.array(cut.outline, np.float64)])
    return Manifold.extrude(outline, near + _AHEAD - back).translate((0.0, 0.0, back))
