"""The scene: what a layout looks like in space. Metres, x right, y up, z towards the viewer, façade plane at z = 0."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import TYPE_CHECKING

from ..design.errors import DesignError, Fault
from ..solver.model.layout import Layout, PlacedShape, Rect
from .geometry import Geometry, find_geometry
from .materials import find_material, rgb
from .parts import Block, Part, flip

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .meshing import Mesh

__all__ = ["Scene", "Solid", "Triangles", "build_scene"]

_ROOFS = frozenset({"roof", "hip", "pitched"})
_EPS = 1e-9
_LEAST = 1e-4
"""Metres: what is no wider is not drawn. The solver's small positive minimum may be next to nothing."""


@dataclass(frozen=True, slots=True)
class Solid:
    """One shape of the layout as a body.

    Attributes
    ----------
    index
        Which of `Layout.shapes` it is.
    shape
        That shape.
    geometry
        The geometry that made it.
    face
        Where its face is, z in metres: the shape's offset, or, if that is 0, where its geometry puts it.
    depth
        How far it goes back from the face, metres; at least to the plane of the façade.
    parts
        Its parts, in the frame of the shape (see `parts`).
    materials
        The material of each slot of its parts.
    """

    index: int
    shape: PlacedShape
    geometry: Geometry = field(repr=False)
    face: float
    depth: float
    parts: tuple[Part, ...] = field(repr=False)
    materials: Mapping[str, str]

    @property
    def rect(self) -> Rect:
        """Left, bottom, right, top, metres."""
        return self.shape.rect

    @property
    def plane(self) -> float:
        """Z of the surface that takes the shadow of its neighbours."""
        return self.face - self.geometry.recess(self.depth)

    def mesh(self) -> Mesh:
        """Its triangles, in the scene's frame."""
        from .meshing import mesh_parts

        local = mesh_parts(self.parts)
        from numpy import array

        corner = array([self.rect[0], self.rect[1], self.face])
        return replace(local, vertices=local.vertices + corner)


@dataclass(frozen=True, slots=True, eq=False)
class Triangles:
    """Every triangle of a scene, unshared, as drawing libraries want them.

    Attributes
    ----------
    positions, normals
        (t, 3, 3) float32: corner by corner.
    colours
        (t, 3) uint8, sRGB.
    materials
        (t,) int64: index into `material_names`.
    shapes
        (t,) int64: which shape of the layout a triangle belongs to, for picking.
    """

    positions: NDArray[np.float32]
    normals: NDArray[np.float32]
    colours: NDArray[np.uint8]
    materials: NDArray[np.int64]
    shapes: NDArray[np.int64]
    material_names: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Scene:
    """The solids of a layout, in its order (bottom layer first), on its canvas (width, height)."""

    canvas: tuple[float, float]
    solids: tuple[Solid, ...]

    def triangles(self) -> Triangles:
        """All triangles of all solids."""
        return triangles_of([(solid.index, solid.mesh(), solid.materials) for solid in self.solids])


def triangles_of(bodies: Sequence[tuple[int, Mesh, Mapping[str, str]]]) -> Triangles:
    """The triangles of meshes, each with its shape's index and the materials of its slots."""
    import numpy as np

    from .meshing import corner_normals, have_area

    names: dict[str, int] = {}
    positions, normals, materials, shapes = [], [], [], []
    for index, mesh, slots in bodies:
        if not len(mesh.faces):
            continue
        lookup = np.array([names.setdefault(slots[slot], len(names)) for slot in mesh.names])
        positions.append(mesh.vertices[mesh.faces])
        normals.append(corner_normals(mesh))
        materials.append(lookup[mesh.slots])
        shapes.append(np.full(len(mesh.faces), index))
    if not positions:
        empty = np.zeros((0, 3, 3), np.float32)
        return Triangles(empty, empty, np.zeros((0, 3), np.uint8), np.zeros(0, int), np.zeros(0, int), ())
    palette = np.array([rgb(find_material(name).base) for name in names], np.uint8)
    corners = np.concatenate(positions)
    kept = have_area(corners)  # far from the origin single precision tells less
    material = np.concatenate(materials)[kept]
    return Triangles(
        corners[kept].astype(np.float32),
        np.concatenate(normals)[kept].astype(np.float32),
        palette[material],
        material,
        np.concatenate(shapes)[kept],
        tuple(names),
    )


def build_scene(layout: Layout, *, roof_depth: float | None = None) -> Scene:
    """Give every shape of a layout its body.

    A window of a higher layer opens the wall of a lower one, as it does when shapes are painted in order: a
    plain box is cut away where a later shape fills its own rectangle and does not stand in front of the box.

    Parameters
    ----------
    layout
        A solved layout, or one read from JSON.
    roof_depth
        How far roofs go back, metres; None: as far as their shapes are thick.

    Raises
    ------
    DesignError
        If a geometry or a material is unknown; it has one fault for each pair of symbols with such a shape.
    """
    return Scene((layout.canvas.width, layout.canvas.height), _cut(tuple(_solids(layout, roof_depth))))


def _solids(layout: Layout, roof_depth: float | None) -> Iterator[Solid]:
    faults: dict[str, Fault] = {}
    for index, shape in enumerate(layout.shapes):
        place = f'shapes["{shape.x} {shape.y}"] in layer {shape.layer!r}'
        try:
            geometry = find_geometry(shape.geometry, f"{place}: geometry")
            own = geometry.material("body", shape.material)
            find_material(shape.material, f"{place}: material")
        except DesignError as error:
            faults.update((str(fault), fault) for fault in error.faults)
            continue
        if faults:
            continue  # nothing will be drawn: only look for the rest of the faults
        left, bottom, right, top = shape.rect
        width, height = right - left, top - bottom
        face = shape.offset or geometry.stand(width, height)
        depth = max(shape.thickness, face, 0.01)
        if roof_depth is not None and geometry.name in _ROOFS:
            depth = max(depth, roof_depth)
        parts = _parts(geometry.name, round(width, 6), round(height, 6), round(depth, 6), shape.mirrored)
        materials = {"body": own, **geometry.slots}
        for part in parts:
            materials.setdefault(part.slot, own)
        yield Solid(index, shape, geometry, face, depth, parts, materials)
    if faults:
        raise DesignError(faults.values())


@lru_cache(maxsize=2048)
def _parts(
    name: str, width: float, height: float, depth: float, mirrored: tuple[bool, bool]
) -> tuple[Part, ...]:
    if min(width, height) <= _LEAST:  # no room for parts
        return ()
    return flip(find_geometry(name).parts(width, height, depth), width, height, mirrored)


def _cut(solids: tuple[Solid, ...]) -> tuple[Solid, ...]:
    layers = {solid.shape.layer for solid in solids}
    if len(layers) < 2:  # the cells of one layer do not overlap
        return solids
    fronts = [
        (solid.index, solid.rect, solid.face, solid.shape.layer) for solid in solids if solid.geometry.full
    ]
    done: list[Solid] = []
    for solid in solids:
        left, bottom, right, top = solid.rect
        holes = [
            rect
            for index, rect, face, layer in fronts
            if index > solid.index
            and layer != solid.shape.layer
            and face <= solid.face + _EPS
            and rect[0] < right - _EPS
            and rect[2] > left + _EPS
            and rect[1] < top - _EPS
            and rect[3] > bottom + _EPS
        ]
        rest = _without(solid.rect, holes) if holes and solid.geometry.full else None
        if rest is None or (rest and solid.shape.geometry != "box"):
            done.append(solid)
            continue
        d = solid.depth
        blocks = tuple(Block(r[0] - left, r[1] - bottom, r[2] - left, r[3] - bottom, -d, 0) for r in rest)
        done.append(replace(solid, parts=blocks))
    return tuple(done)


def _without(rect: Rect, holes: list[Rect]) -> list[Rect]:
    """What is left of a rectangle, as rectangles."""
    rest = [rect]
    for hole in holes:
        pieces: list[Rect] = []
        for l, b, r, t in rest:  # noqa: E741
            hl, hb, hr, ht = max(l, hole[0]), max(b, hole[1]), min(r, hole[2]), min(t, hole[3])
            if hl >= hr - _EPS or hb >= ht - _EPS:
                pieces.append((l, b, r, t))
                continue
            strips = ((l, b, r, hb), (l, ht, r, t), (l, hb, hl, ht), (hr, hb, r, ht))
            pieces += [s for s in strips if s[2] - s[0] > _LEAST and s[3] - s[1] > _LEAST]
        rest = pieces
    return rest
