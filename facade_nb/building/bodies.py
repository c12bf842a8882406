"""What stands on each face, as meshes in its own frame: x along the wall, y up, z out of it; corners are mitred.

At a corner two walls meet in the plane that halves their angle. Whatever ends there with a face of its own, a wall, a
cornice, a quoin, is drawn out to that plane where it stands before the wall, and cut back to it behind. So nothing
overlaps at a corner, and nothing gapes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import tan

import numpy as np
from numpy.typing import NDArray

from ..render.materials import DEFAULT_MATERIAL
from ..render.meshing import Mesh, mesh_parts
from ..render.parts import Block, Part
from ..render.ruled import library_of
from ..render.scene import Solid, build_scene
from ..render.seating import Slope
from .layout import BuildingLayout, SolvedFace
from .roofline import is_dormer
from .rules import Rules

__all__ = ["NEAR", "Body", "Frame", "bodies_of", "deepest", "drawn_by", "house_end", "rules_of", "slope_of"]

_END = 1e-4
"""Metres: so near its end a thing ends with the wall."""

NEAR = 0.3
"""Beyond the overhang the roof of a face reaches so far before the wall; what is nearer is another wing's, metres."""

_DORMER = 12.0
"""How far a dormer goes back at most, metres."""

_STEP = 0.1

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """Where a face stands in space: x east, y up, z south.

    Attributes
    ----------
    origin
        Its lower left corner.
    axes
        (3, 3): along it, up, and out of it.
    """

    origin: Floats
    axes: Floats

    @classmethod
    def of(cls, own: SolvedFace) -> Frame:
        """Of a face."""
        (x, y), (u, v) = own.face.start, own.face.way
        return cls(np.array([x, 0.0, -y]), np.array([[u, 0.0, -v], [0.0, 1.0, 0.0], [v, 0.0, u]]))

    def place(self, points: Floats) -> Floats:
        """Points (…, 3) of the face's frame, in space."""
        return self.origin + points @ self.axes


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """A mesh in the frame of a face.

    Attributes
    ----------
    solid
        The shape that it is; None: what fills the wall behind shapes.
    index
        Of the shape in the face's `shown` layout; −1: of none.
    materials
        Of the mesh's slots.
    library
        The texture grammar of the design of the face, whose rules may be materials.
    """

    solid: Solid | None
    index: int
    mesh: Mesh
    materials: Mapping[str, str]
    library: str = ""


def slope_of(layout: BuildingLayout, own: SolvedFace) -> Slope:
    """The roof over all as one sees it before a face."""
    frame = Frame.of(own)
    triangles = (layout.roofing.positions - frame.origin) @ frame.axes.T
    return Slope(triangles, layout.building.roof.overhang + NEAR, layout.eaves)


def rules_of(layout: BuildingLayout) -> Rules:
    """The texture grammars of all faces, as one."""
    return Rules.of(library_of(own.shown) for own in layout.faces)


def deepest(layout: BuildingLayout) -> float:
    """How far the walls of all faces go back behind their planes, metres."""
    depths = [
        solid.depth - solid.face
        for own in layout.faces
        for solid in build_scene(own.shown).solids
        if solid.geometry.full
    ]
    return max([0.05, *depths])


def bodies_of(layout: BuildingLayout, own: SolvedFace, back: float) -> list[Body]:
    """The meshes of a face.

    Parameters
    ----------
    back
        How far walls go back: what is less deep is filled up behind.
    """
    scene = build_scene(own.shown, over=slope_of(layout, own))
    made = [Body(solid, solid.index, solid.mesh(), solid.materials) for solid in scene.solids]
    made += _filling(layout, scene.solids, back)
    made += _dormers(layout, own, scene.solids)
    return [
        replace(body, mesh=_mitred(body.mesh, own), library=scene.library)
        for body in made
        if len(body.mesh.faces)
    ]


def drawn_by(body: Body, rules: Rules) -> Mapping[str, str]:
    """The materials of a body, as they are called where the rules of all faces are."""
    return {slot: rules.material(body.library, name) for slot, name in body.materials.items()}


def _filling(layout: BuildingLayout, solids: tuple[Solid, ...], back: float) -> Iterator[Body]:
    """What is between the backs of walls and the building's body, so that no light leaks in."""
    found: dict[str, list[Part]] = {}
    for solid in solids:
        behind = solid.face - solid.depth
        if solid.geometry.full and behind > 1e-6 - back and not is_dormer(solid.shape, layout.eaves):
            name = solid.materials["body"]
            left, bottom, right, top = solid.rect
            name = "plaster" if name in ("glass", DEFAULT_MATERIAL) else name
            found.setdefault(name, []).append(
                Block(left, bottom, right, min(top, layout.eaves), -back, behind)
            )
    for name, parts in found.items():
        yield Body(None, -1, mesh_parts(parts), {"body": name})


def _dormers(layout: BuildingLayout, own: SolvedFace, solids: tuple[Solid, ...]) -> Iterator[Body]:
    """The houses of dormers, which go back into the roof."""
    wall = layout.building.material
    for solid in solids:
        if is_dormer(solid.shape, layout.eaves) and solid.geometry.full:
            left, bottom, right, top = solid.rect
            behind = solid.face - solid.depth
            block = Block(left, bottom, right, top, house_end(layout, own, solid), behind)
            yield Body(None, -1, mesh_parts([block]), {"body": wall})


def house_end(layout: BuildingLayout, own: SolvedFace, solid: Solid) -> float:
    """Where the house of a dormer ends, z in the face's frame: where all of its top is within the roof.

    A dormer that is higher than the roof behind it ends where that is highest.
    """
    left, _, right, top = solid.rect
    behind = solid.face - solid.depth
    steps: Floats = behind - _STEP * np.arange(1.0, round(_DORMER / _STEP) + 1)
    triangles = slope_of(layout, own).triangles
    ends = []
    for x in (left + _END, (left + right) / 2, right - _END):
        heights = _heights(triangles, x, steps)
        reached = np.flatnonzero(heights >= top)
        ends.append(steps[reached[0] if len(reached) else int(heights.argmax())])
    return float(min(ends))


def _heights(triangles: Floats, x: float, depths: Floats) -> Floats:
    """How high the highest of some triangles (t, 3, 3) is above places (x, z); without any, as low as can be."""
    flat = triangles[:, :, [0, 2]]
    a, ab, ac = flat[:, 0], flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    size = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    lying = np.abs(size) > 1e-9
    a, ab, ac, size, y = a[lying], ab[lying], ac[lying], size[lying], triangles[lying, :, 1]
    off = np.stack([np.full_like(depths, x), depths], axis=1)[:, None] - a
    u = (off[..., 0] * ac[:, 1] - off[..., 1] * ac[:, 0]) / size
    v = (ab[:, 0] * off[..., 1] - ab[:, 1] * off[..., 0]) / size
    above = y[:, 0] + u * (y[:, 1] - y[:, 0]) + v * (y[:, 2] - y[:, 0])
    within = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9)
    return np.where(within, above, -np.inf).max(axis=1, initial=-np.inf)


def _mitred(mesh: Mesh, own: SolvedFace) -> Mesh:
    """The mesh with its ends in the planes of the corners, where it ends with the wall by a face of its own."""
    left, right = own.face.turns
    vertices = mesh.vertices
    moved = vertices.copy()
    for at, angle, sign in ((0.0, left, -1.0), (own.face.length, right, 1.0)):
        near = np.abs(vertices[:, 0] - at) < _END
        if angle and near.any() and _flat(vertices[near]):
            moved[near, 0] = at + sign * vertices[near, 2] * tan(angle / 2)
    return replace(mesh, vertices=moved)


def _flat(points: Floats) -> bool:
    """Whether points of one plane span a face, and not only a line."""
    spread = points[:, 1:] - points[:, 1:].mean(axis=0)
    return bool(np.linalg.matrix_rank(spread, tol=1e-6) == 2)
