"""The body of each shape of a layout, before any opens another. Metres, façade plane at z = 0."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import TYPE_CHECKING

from ..design.errors import DesignError, Fault
from ..solver.model.layout import Layout, PlacedShape, Rect
from .cuts import Cut
from .geometry import DEFAULT_GEOMETRY, Geometry, find_geometry
from .materials import find_material
from .meshfile import file_geometry, is_file
from .parts import Part, flip

if TYPE_CHECKING:
    from .meshing import Mesh

__all__ = ["Solid", "forget", "parts_of", "place_of", "size_of", "solid_of", "solids_of"]

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
    cuts
        What later shapes open in its parts, but for rectangles in a plain box: there the parts are what is left.
    """

    index: int
    shape: PlacedShape
    geometry: Geometry = field(repr=False)
    face: float
    depth: float
    parts: tuple[Part, ...] = field(repr=False)
    materials: Mapping[str, str]
    cuts: tuple[Cut, ...] = field(default=(), repr=False)

    @property
    def rect(self) -> Rect:
        """Left, bottom, right, top, metres."""
        return self.shape.rect

    @property
    def plane(self) -> float:
        """Z of the surface that takes the shadow of its neighbours."""
        return self.face - self.geometry.recess(self.depth)

    def body(self) -> Mesh:
        """Its triangles, in its own frame, with openings cut."""
        return _body(self.parts, self.cuts)

    def mesh(self) -> Mesh:
        """Its triangles, in the scene's frame."""
        from numpy import array

        return self.body().moved(array([self.rect[0], self.rect[1], self.face]))


@lru_cache(maxsize=256)
def _body(parts: tuple[Part, ...], cuts: tuple[Cut, ...]) -> Mesh:
    """Alike shapes share their mesh."""
    from .carving import carved
    from .meshing import assembled

    return assembled(carved(parts, cuts))


def place_of(shape: PlacedShape) -> str:
    """Where a shape is said to be in faults."""
    return f'shapes["{shape.x} {shape.y}"] in layer {shape.layer!r}'


def solids_of(layout: Layout, roof_depth: float | None) -> Iterator[Solid]:
    """The bodies of all shapes, roofs `roof_depth` deep at least.

    Raises
    ------
    DesignError
        For every unknown geometry or material, once all shapes are looked at.
    """
    faults: dict[str, Fault] = {}
    known: dict[tuple[str, str], tuple[Geometry, str]] = {}
    slots: dict[tuple[int, str, str], tuple[Mapping[str, str], tuple[Part, ...]]] = {}
    for index, shape in enumerate(layout.shapes):
        look = known.get((shape.geometry, shape.material))
        if look is None:
            try:
                look = known[shape.geometry, shape.material] = _looks(shape)
            except DesignError as error:
                faults.update((str(fault), fault) for fault in error.faults)
                continue
        if faults:
            continue  # nothing will be drawn: only look for the rest of the faults
        geometry, own = look
        width, height = size_of(shape)
        face = shape.offset or geometry.face(width, height)
        depth = max(shape.thickness, face, geometry.depth(width, height), 0.01)
        if roof_depth is not None and geometry.roof:
            depth = max(depth, roof_depth)
        parts = _parts(shape, geometry, depth)
        kind = (id(parts), geometry.name, own)
        if kind not in slots:  # the parts are held with it, so that no others have their place in memory
            slots[kind] = _materials(geometry, own, parts), parts
        yield Solid(index, shape, geometry, face, depth, parts, slots[kind][0])
    if faults:
        raise DesignError(faults.values())


def size_of(shape: PlacedShape) -> tuple[float, float]:
    """Width and height, metres."""
    left, bottom, right, top = shape.rect
    return right - left, top - bottom


def solid_of(
    index: int, shape: PlacedShape, geometry: Geometry, own: str, face: float, depth: float
) -> Solid:
    """The body of a shape; `own` is its material."""
    parts = _parts(shape, geometry, depth)
    return Solid(index, shape, geometry, face, depth, parts, _materials(geometry, own, parts))


def _parts(shape: PlacedShape, geometry: Geometry, depth: float) -> tuple[Part, ...]:
    width, height = size_of(shape)
    make = parts_of if not is_file(shape.geometry) else partial(_fitted, geometry)
    return make(shape.geometry, round(width, 6), round(height, 6), round(depth, 6), shape.mirrored)


def _materials(geometry: Geometry, own: str, parts: Iterable[Part]) -> Mapping[str, str]:
    """The material of each slot of some parts."""
    materials = {"body": own, **geometry.slots}
    for part in parts:
        materials.setdefault(part.slot, own)
    return materials


def _looks(shape: PlacedShape) -> tuple[Geometry, str]:
    """The geometry of a shape, and the material of its body."""
    try:
        geometry = _geometry(shape.geometry)
        find_material(shape.material)
    except DesignError:  # told once more, with the place
        place = place_of(shape)
        geometry = _geometry(shape.geometry, f"{place}: geometry")
        find_material(shape.material, f"{place}: material")
        raise
    return geometry, geometry.material("body", shape.material)


def _geometry(name: str, place: str = "geometry") -> Geometry:
    """The geometry of that name; that of a file which cannot be drawn is a plain block."""
    if not is_file(name):
        return find_geometry(name, place)
    try:
        return file_geometry(name)
    except DesignError:  # `drawing_faults` tells it
        return find_geometry(DEFAULT_GEOMETRY)


def _fitted(
    geometry: Geometry, name: str, width: float, height: float, depth: float, mirrored: tuple[bool, bool]
) -> tuple[Part, ...]:
    if min(width, height) <= _LEAST:  # no room for parts
        return ()
    return flip(geometry.parts(width, height, depth), width, height, mirrored)


@lru_cache(maxsize=2048)
def parts_of(
    name: str, width: float, height: float, depth: float, mirrored: tuple[bool, bool]
) -> tuple[Part, ...]:
    """The parts of a geometry of the library, by its name."""
    geometry = find_geometry(name)
    return _fitted(geometry, name, width, height, depth, mirrored if geometry.turns else (False, False))


def forget() -> None:
    """Let go of parts that were made by the names of their geometries."""
    parts_of.cache_clear()
