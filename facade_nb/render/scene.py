"""The scene: what a layout looks like in space. Metres, x right, y up, z towards the viewer, façade plane at z = 0."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import TYPE_CHECKING

from ..design.errors import DesignError, Fault
from ..solver.model.layout import Layout, PlacedShape, Rect
from .cuts import Cut
from .geometry import find_geometry
from .lettering import undrawn
from .materials import Material, rgb
from .meshfile import file_geometry, is_file
from .parts import Block, Part, Point, back, front
from .roofed import before_roof, seated
from .ruled import is_rule, library_of, material_of, rule_fault
from .seating import Slope
from .standing import Solid, place_of, solids_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .meshing import Mesh

__all__ = [
    "DrawingWarning",
    "Scene",
    "Solid",
    "Triangles",
    "build_scene",
    "drawing_faults",
    "room_of",
    "within_roof",
    "without",
]

_EPS = 1e-9
_LEAST = 1e-4
"""Metres: what is no wider is not drawn. The solver's small positive minimum may be next to nothing."""


class DrawingWarning(UserWarning):
    """Something of a design cannot be drawn as it says; the rest is."""


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
    round
        (t,) bool: of a body that stands for a round one, as columns do.
    shapes
        (t,) int64: which shape of the layout a triangle belongs to, for picking.
    material_names, library
        Names of the materials, and the grammar of those that are rules.
    """

    positions: NDArray[np.float32]
    normals: NDArray[np.float32]
    colours: NDArray[np.uint8]
    materials: NDArray[np.int64]
    round: NDArray[np.bool_]
    shapes: NDArray[np.int64]
    material_names: tuple[str, ...]
    library: str = ""

    def material(self, name: str) -> Material:
        """A material of its triangles; a rule has its mean colour."""
        return material_of(self.library, name)


@dataclass(frozen=True, slots=True)
class Scene:
    """The solids of a layout, in its order (bottom layer first), on its canvas (width, height).

    Attributes
    ----------
    canvas, solids
        As said.
    library
        The texture grammar whose rules are materials.
    faults
        What cannot be drawn as the design says, each with its shape and layer. Something plain stands for it.
    """

    canvas: tuple[float, float]
    solids: tuple[Solid, ...]
    library: str = field(default="", repr=False)
    faults: tuple[Fault, ...] = ()

    def material(self, name: str) -> Material:
        """A material of its solids; a rule has its mean colour."""
        return material_of(self.library, name)

    def triangles(self) -> Triangles:
        """All triangles of all solids."""
        bodies = [(solid.index, solid.mesh(), solid.materials) for solid in self.solids]
        return triangles_of(bodies, self.library)


def triangles_of(bodies: Sequence[tuple[int, Mesh, Mapping[str, str]]], library: str = "") -> Triangles:
    """The triangles of meshes, each with its shape's index and the materials of its slots; rules are of `library`."""
    import numpy as np

    from .meshing import have_area

    names: dict[str, int] = {}
    positions, normals, materials, curved, shapes = [], [], [], [], []
    for index, mesh, slots in bodies:
        if not len(mesh.faces):
            continue
        lookup = np.array([names.setdefault(slots[slot], len(names)) for slot in mesh.names])
        positions.append(mesh.vertices[mesh.faces])
        normals.append(mesh.normals)
        materials.append(lookup[mesh.slots])
        curved.append(mesh.round)
        shapes.append(np.full(len(mesh.faces), index))
    if not positions:
        empty = np.zeros((0, 3, 3), np.float32)
        none = np.zeros(0, int)
        return Triangles(empty, empty, np.zeros((0, 3), np.uint8), none, none.astype(bool), none, (), library)
    palette = np.array([rgb(material_of(library, name).base) for name in names], np.uint8)
    corners = np.concatenate(positions)
    kept = have_area(corners)  # far from the origin single precision tells less
    material = np.concatenate(materials)[kept]
    return Triangles(
        corners[kept].astype(np.float32),
        np.concatenate(normals)[kept].astype(np.float32),
        palette[material],
        material,
        np.concatenate(curved)[kept],
        np.concatenate(shapes)[kept],
        tuple(names),
        library,
    )


def build_scene(layout: Layout, *, roof_depth: float | None = None, over: Slope | None = None) -> Scene:
    """Give every shape of a layout its body.

    A window of a higher layer opens the wall of a lower one, as it does when shapes are painted in order: a
    wall is cut away where a later shape does not stand in front of it, by the outline of that shape. A roof is cut
    where a later shape stands in it, as far back as that goes: by a dormer, a roof window, a gable wall.

    Parameters
    ----------
    layout
        A solved layout, or one read from JSON.
    roof_depth
        How far roofs go back, metres; None: as far as their shapes are thick.
    over
        The roof of a building over all, in the frame of this façade.

    Raises
    ------
    DesignError
        If a geometry or a material is unknown; it has one fault for each pair of symbols with such a shape.

    Warns
    -----
    DrawingWarning
        For each shape that cannot be drawn as the design says: a rule that the design's grammar does not have, a
        mesh file that cannot be read. It is drawn plain. So it is for letters that a sign's lettering lacks. A dormer
        that its roof does not cover is drawn as high as that does.
    """
    solids, told = seated(tuple(solids_of(layout, roof_depth)), over)
    solids = _cut(solids)
    faults = (*_looks_faults(layout), *told)
    for fault in faults:
        warnings.warn(str(fault), DrawingWarning, stacklevel=2)
    return Scene((layout.canvas.width, layout.canvas.height), solids, library_of(layout), faults)


def drawing_faults(layout: Layout) -> tuple[Fault, ...]:
    """What of a layout cannot be drawn as its design says, each with its shape and layer."""
    faults = _looks_faults(layout)
    if not any(map(before_roof, layout.shapes)):
        return faults
    try:
        return (*faults, *seated(tuple(solids_of(layout, None)), None)[1])
    except DesignError:  # who draws it tells that
        return faults


def within_roof(layout: Layout, over: Slope) -> tuple[Layout, tuple[Fault, ...]]:
    """A layout before the roof of a building: dormers as high as that covers them, and what there is to say of it.

    Raises
    ------
    DesignError
        As `build_scene`.
    """
    solids, faults = seated(tuple(solids_of(layout, None)), over)
    return (replace(layout, shapes=tuple(own.shape for own in solids)) if faults else layout), faults


def _looks_faults(layout: Layout) -> tuple[Fault, ...]:
    found: dict[str, Fault] = {}
    library = library_of(layout)
    looks = {(shape.geometry, shape.material): shape for shape in layout.shapes}
    suspect = {look for look, shape in looks.items() if any(_faults(shape, library))}
    for shape in layout.shapes if suspect else ():
        if (shape.geometry, shape.material) in suspect:
            found.update((str(fault), fault) for fault in _faults(shape, library))
    return tuple(found.values())


def _faults(shape: PlacedShape, library: str) -> Iterator[Fault]:
    """What of a shape cannot be drawn as its design says."""
    if is_rule(shape.material):
        fault = rule_fault(library, shape.material, f"{place_of(shape)}: material")
        if fault is not None:
            yield fault
    if is_file(shape.geometry):
        try:
            file_geometry(shape.geometry, f"{place_of(shape)}: geometry")
        except DesignError as error:
            yield from error.faults
    else:
        yield from _blanks(shape)


def _blanks(shape: PlacedShape) -> Iterator[Fault]:
    """The letters of its geometry's texts that are left blank."""
    try:
        geometry = find_geometry(shape.geometry)
    except DesignError:  # who draws it tells that
        return
    for parameter in geometry.parameters:
        lacking = undrawn(geometry.told.get(parameter.name, "")) if parameter.text else []
        if lacking:
            letters = ", ".join(repr(letter) for letter in lacking)
            message = (
                f"{parameter.name} of {geometry.name}: the lettering has no {letters}; a blank is left there"
            )
            yield Fault(f"{place_of(shape)}: geometry", message)


def _cut(solids: tuple[Solid, ...]) -> tuple[Solid, ...]:
    import numpy as np

    layers = {solid.shape.layer for solid in solids}
    if len(layers) < 2:  # the cells of one layer do not overlap
        return solids
    cutters = [solid for solid in solids if solid.geometry.full or solid.geometry.cuts]
    walls = [solid for solid in solids if solid.geometry.wall or solid.geometry.roof]
    # Of the many pairs only few overlap: all are compared at once.
    lefts, bottoms, rights, tops = np.array([own.rect for own in cutters]).reshape(-1, 4).T
    left, bottom, right, top = np.array([own.rect for own in walls]).reshape(-1, 4).T[:, :, None]
    over = (lefts < right - _EPS) & (rights > left + _EPS)
    over &= (bottoms < top - _EPS) & (tops > bottom + _EPS)
    over &= np.array([own.index for own in cutters]) > np.array([own.index for own in walls])[:, None]
    before: dict[int, list[Solid]] = {}
    for n, k in zip(*(own.tolist() for own in divmod(np.flatnonzero(over), len(cutters) or 1)), strict=True):
        wall, other = walls[n], cutters[k]
        if other.shape.layer != wall.shape.layer and _stands_in(other, wall):
            before.setdefault(wall.index, []).append(other)
    done: list[Solid] = []
    for solid in solids:
        found = before.get(solid.index, [])
        if not found:
            done.append(solid)
            continue
        if solid.geometry.roof:
            done.append(replace(solid, cuts=tuple(cut for other in found for cut in _room_of(other, solid))))
            continue
        holes = [other.rect for other in found if other.geometry.full]
        cuts = [cut for other in found if not other.geometry.full for cut in _cuts_of(other, solid)]
        rest = without(solid.rect, holes) if holes else [solid.rect]
        if rest and solid.geometry.name != "box":
            cuts += [_hole(rect, solid) for rect in holes]
        elif holes:
            d, (left, bottom) = solid.depth, solid.rect[:2]
            blocks = tuple(Block(r[0] - left, r[1] - bottom, r[2] - left, r[3] - bottom, -d, 0) for r in rest)
            # `replace` takes long, and there are many
            solid = Solid(
                solid.index, solid.shape, solid.geometry, solid.face, solid.depth, blocks, solid.materials
            )
        done.append(replace(solid, cuts=tuple(cuts)) if cuts else solid)
    return tuple(done)


def _stands_in(solid: Solid, behind: Solid) -> bool:
    """Whether a shape opens another, if they overlap: a wall that it does not stand before, a roof that it reaches."""
    if behind.geometry.roof:
        near = max((front(part) for part in behind.parts), default=0.0)
        return not solid.geometry.roof and _deepest(solid) < behind.face + near - _EPS
    return behind.geometry.wall and solid.face <= behind.face + _EPS


def _deepest(solid: Solid) -> float:
    """How far a shape goes back, z in metres."""
    return solid.face + min((back(part) for part in solid.parts), default=0.0)


def _room_of(solid: Solid, roof: Solid) -> Iterator[Cut]:
    """What a shape opens in a roof, in the roof's frame."""
    dx, dy = roof.rect[:2]
    for cut in room_of(solid):
        outline = tuple((round(x - dx, 6), round(y - dy, 6)) for x, y in cut.outline)
        yield Cut(outline, round(cut.back - roof.face, 6))


def room_of(solid: Solid) -> Iterator[Cut]:
    """What a shape opens in a roof, in the façade's frame: as far back as it is itself, and all before it.

    A dormer opens what is between its cheeks and below its own roof, which goes on into the slope.
    """
    deep = _deepest(solid)
    left, bottom, right, top = solid.rect
    if solid.geometry.full:
        yield Cut(((left, bottom), (right, bottom), (right, top), (left, top)), deep)
        return
    house = tuple(part for part in solid.parts if part.slot in ("body", "cheek"))
    parts = house if solid.geometry.name == "dormer" and house else solid.parts
    for outline in _outlines(parts):
        yield Cut(tuple((x + left, y + bottom) for x, y in outline), deep)


def _hole(rect: Rect, wall: Solid) -> Cut:
    """A rectangle, opened in a wall."""
    left, bottom = wall.rect[:2]
    l, b, r, t = (  # noqa: E741
        round(v, 6) for v in (rect[0] - left, rect[1] - bottom, rect[2] - left, rect[3] - bottom)
    )
    return Cut(((l, b), (r, b), (r, t), (l, t)))


def _cuts_of(solid: Solid, wall: Solid) -> Iterator[Cut]:
    """What a shape that does not fill its rectangle opens in a wall: its outline, through the wall for an opening."""
    dx, dy = solid.rect[0] - wall.rect[0], solid.rect[1] - wall.rect[1]
    through = solid.geometry.recess(solid.depth) > 0
    behind = min((back(part) for part in solid.parts), default=0.0)
    for outline in _outlines(solid.parts):
        points = tuple((round(x + dx, 6), round(y + dy, 6)) for x, y in outline)
        yield Cut(points) if through else Cut(points, round(solid.face + behind - wall.face, 6))


@lru_cache(maxsize=512)
def _outlines(parts: tuple[Part, ...]) -> tuple[tuple[Point, ...], ...]:
    from .silhouette import silhouette

    return silhouette(parts)


def without(rect: Rect, holes: Sequence[Rect]) -> list[Rect]:
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
