"""A solved building as one set of triangles, and as the scene that pictures are drawn of."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..render.bodies import extruded
from ..render.meshing import Mesh, triangles_in
from ..render.pipeline.solids import Solids, combined, solids_scene
from ..render.scene import Triangles, triangles_of
from ..solver.model.layout import Rect
from .bodies import Frame, bodies_of, deepest, drawn_by, rules_of
from .layout import BuildingLayout, SolvedFace
from .openings import opened, openings
from .roofline import wall_material
from .roofs import outline

__all__ = ["over_all", "solids_of_building"]

Floats = NDArray[np.float64]


def over_all(layout: BuildingLayout, back: float) -> list[tuple[str, Mesh, str]]:
    """The roof's parts and the body within the walls, in space: name, mesh, material."""
    building = layout.building
    roof, rooms = layout.roofing, openings(layout)
    materials = {
        "roof": building.roof.material,
        "flat": "concrete" if building.roof.kind == "flat" else "metal",
        "plain": building.material,
    }
    found = []
    for k, name in enumerate(roof.names):
        own = opened(roof.positions[roof.parts == k], rooms)
        if name == "gable":
            for material, some in _gables(layout, own).items():
                found.append((f"roof/{name}", _mesh_of(own[some]), material))
        elif len(own):
            found.append((f"roof/{name}", _mesh_of(own), materials[name]))
    core = _core(layout, back)
    if len(core):
        found.append(("body", _mesh_of(core), building.material))
    return found


def _gables(layout: BuildingLayout, triangles: Floats) -> dict[str, list[int]]:
    """Which gables are of which material: that of the wall below."""
    found: dict[str, list[int]] = {}
    frames = [(own, Frame.of(own)) for own in layout.faces]
    for k, corners in enumerate(triangles):

        def away(frame: Frame, corners: Floats = corners) -> float:
            local = (corners - frame.origin) @ frame.axes.T
            return float(np.abs(local[:, 2]).max())

        below = min(frames, key=lambda one: away(one[1]))[0]
        material = wall_material(below.shown.shapes) or layout.building.material
        found.setdefault(material, []).append(k)
    return found


def _mesh_of(triangles: Floats) -> Mesh:
    """Triangles (t, 3, 3) with shared vertices."""
    points, index = np.unique(triangles.reshape(-1, 3).round(6), axis=0, return_inverse=True)
    faces = index.reshape(-1, 3)
    count = len(faces)
    return Mesh(points, faces, np.zeros(count, int), np.zeros(count, bool), ("body",), np.zeros(count, int))


def _core(layout: BuildingLayout, back: float) -> Floats:
    """The body within the walls, from the ground to the eaves, as triangles (t, 3, 3)."""
    import shapely

    inner = shapely.Polygon(outline(layout)).buffer(-back, join_style="mitre", mitre_limit=20)
    found = [np.zeros((0, 3, 3))]
    for part in shapely.get_parts(inner):
        if not part.is_empty:
            body = extruded((part.exterior.coords[:-1],), 0.0, layout.eaves).rotate((-90.0, 0.0, 0.0))
            vertices, faces = triangles_in(body)
            found.append(vertices[faces])
    return np.concatenate(found)


def solids_of_building(
    layout: BuildingLayout, *, ground: bool = True, before: SolvedFace | None = None
) -> Solids:
    """The scene of a building. Its triangles name shapes by face and index: those of all faces one after the other.

    Parameters
    ----------
    before
        A face that is to be in the plane z = 0, its lower left corner the origin.
    """
    back, rules = deepest(layout), rules_of(layout)
    parts: list[tuple[Triangles, list[Rect], Frame | None, int]] = []
    first = 0
    for own in layout.faces:
        bodies = bodies_of(layout, own, back)
        triangles = triangles_of(
            [(body.index, body.mesh, drawn_by(body, rules)) for body in bodies], rules.text
        )
        parts.append((triangles, [shape.rect for shape in own.shown.shapes], Frame.of(own), first))
        first += len(own.shown.shapes)
    rest = [(-1, mesh, {"body": material}) for _, mesh, material in over_all(layout, back)]
    parts.append((triangles_of(rest, rules.text), [], None, 0))
    names = tuple(dict.fromkeys(name for some, *_ in parts for name in some.material_names))
    made = []
    for triangles, rects, frame, start in parts:
        solids = solids_scene(_renamed(triangles, names), rects, ground=False)
        if frame is not None:
            solids = solids.moved(frame.origin, frame.axes)
        shapes = np.where(solids.shapes >= 0, solids.shapes + start, solids.shapes)
        made.append(replace(solids, shapes=shapes))
    if before is not None:
        place = Frame.of(before)
        made = [part.moved(-place.origin @ place.axes.T, place.axes.T) for part in made]
    return combined(made, names, rules.text, ground=ground)


def _renamed(triangles: Triangles, names: tuple[str, ...]) -> Triangles:
    """The same triangles with materials out of a longer list."""
    place = np.array([names.index(name) for name in triangles.material_names], np.int64)
    return replace(triangles, materials=place[triangles.materials], material_names=names)
