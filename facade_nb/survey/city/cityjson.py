"""CityJSON 1.0 to 2.0: buildings whose surfaces say what they are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...design.fields import Faults, at, describe
from .model import Hole, Object, Points, Surface

__all__ = ["objects_of"]

_OPENINGS = {"Window": "window", "Door": "door"}
_BUILDINGS = ("Building", "BuildingPart")
_NEAR = 0.001
_DEPTHS = {"MultiSurface": 0, "CompositeSurface": 0, "Solid": 1, "MultiSolid": 2, "CompositeSolid": 2}
"""How many lists stand around the list of surfaces."""


def objects_of(document: Mapping[str, Any], faults: Faults) -> Iterator[Object]:
    """The buildings of a document, and its parts; what is wrong is noted with its place."""
    vertices = _vertices(document, faults)
    templates = _templates(document, faults)
    objects = faults.mapping(document.get("CityObjects", {}), "CityObjects", "an object with city objects")
    for name, value in objects.items():
        place = f"CityObjects.{name}"
        own = faults.mapping(value, place)
        if own.get("type") in _BUILDINGS:
            yield _object(str(name), own, place, vertices, templates, faults)


@dataclass(frozen=True, slots=True)
class _Templates:
    """Geometries that stand at many places, and their vertices, which no transform moves."""

    geometries: Sequence[Any]
    vertices: Points


def _templates(document: Mapping[str, Any], faults: Faults) -> _Templates:
    place = "geometry-templates"
    given = faults.mapping(document.get(place, {}), place)
    geometries = faults.sequence(given.get("templates", []), f"{place}.templates", "a list of geometries")
    vertices = {"vertices": given.get("vertices-templates", [])}
    return _Templates(geometries, _vertices(vertices, faults, f"{place}.vertices-templates"))


def _vertices(document: Mapping[str, Any], faults: Faults, place: str = "vertices") -> Points:
    given = faults.sequence(document.get("vertices", []), place, "a list of vertices")
    found = np.zeros((len(given), 3))
    for k, vertex in enumerate(given):
        if (
            isinstance(vertex, Sequence)
            and not isinstance(vertex, str)
            and len(vertex) == 3
            and _numbers(vertex)
        ):
            found[k] = vertex
        else:
            faults.expected(at(place, k), "three numbers", vertex)
    transform = document.get("transform")
    if transform is None:
        return found
    values = faults.mapping(transform, "transform")
    scale, shift = (
        _three(values.get(key, default), f"transform.{key}", faults)
        for key, default in (("scale", [1, 1, 1]), ("translate", [0, 0, 0]))
    )
    return found * scale + shift


def _numbers(values: Sequence[Any]) -> bool:
    return all(isinstance(v, int | float) and not isinstance(v, bool) and abs(v) < 1e12 for v in values)


def _three(value: Any, place: str, faults: Faults) -> Points:
    if isinstance(value, Sequence) and not isinstance(value, str) and len(value) == 3 and _numbers(value):
        return np.array(value, float)
    faults.expected(place, "three numbers", value)
    return np.ones(3)


def _object(
    name: str,
    own: Mapping[str, Any],
    place: str,
    vertices: Points,
    templates: _Templates,
    faults: Faults,
) -> Object:
    """The most detailed of an object's geometries that has openings, with all templates of that level."""
    whole: dict[str, Object] = {}
    added: dict[str, list[Object]] = {}
    for k, value in enumerate(
        faults.sequence(own.get("geometry", []), f"{place}.geometry", "a list of geometries")
    ):
        where = at(f"{place}.geometry", k)
        geometry = faults.mapping(value, where)
        lod = str(geometry.get("lod", ""))
        if geometry.get("type") == "GeometryInstance":
            made = _instance(name, geometry, where, vertices, templates, faults)
            if made is not None:
                added.setdefault(made[0], []).append(made[1])
        elif geometry.get("type") in _DEPTHS and "semantics" in geometry:
            found = _geometry(name, geometry, where, vertices, faults)
            if lod not in whole or _opened(found) or not _opened(whole[lod]):
                whole[lod] = found
    best = Object(name)
    for lod in sorted({*whole, *added}):
        parts = [*([whole[lod]] if lod in whole else []), *added.get(lod, ())]
        found = Object(
            name, [s for one in parts for s in one.surfaces], [h for one in parts for h in one.loose]
        )
        if _opened(found):
            best = found
    return best


def _opened(own: Object) -> bool:
    return bool(own.loose) or any(surface.holes for surface in own.surfaces)


def _instance(
    name: str,
    geometry: Mapping[str, Any],
    place: str,
    vertices: Points,
    templates: _Templates,
    faults: Faults,
) -> tuple[str, Object] | None:
    """A template, turned by a matrix and put at a vertex: its level of detail, and what it is made of."""
    known = templates.geometries
    number = geometry.get("template")
    if not isinstance(number, int) or isinstance(number, bool) or not 0 <= number < len(known):
        faults.expected(f"{place}.template", f"the number of a template, 0 to {len(known) - 1}", number)
        return None
    where = at("geometry-templates.templates", number)
    template = faults.mapping(known[number], where)
    if template.get("type") not in _DEPTHS or "semantics" not in template:
        return None
    spots = geometry.get("boundaries")
    spot = spots[0] if isinstance(spots, list) and len(spots) == 1 else None
    if not isinstance(spot, int) or isinstance(spot, bool) or not 0 <= spot < len(vertices):
        faults.expected(f"{place}.boundaries", f"the number of one vertex, 0 to {len(vertices) - 1}", spots)
        return None
    given = geometry.get("transformationMatrix", np.eye(4).reshape(-1).tolist())
    if not isinstance(given, list) or len(given) != 16 or not _numbers(given):
        faults.expected(f"{place}.transformationMatrix", "16 numbers, row by row", given)
        return None
    matrix = np.array(given, float).reshape(4, 4)
    placed = templates.vertices @ matrix[:3, :3].T + matrix[:3, 3] + vertices[spot]
    made = _geometry(name, template, where, placed, faults)
    if np.linalg.det(matrix[:3, :3]) < 0:  # a mirror turns corners around
        holes = [*made.loose, *(hole for surface in made.surfaces for hole in surface.holes)]
        for polygons in (*(one.polygons for one in made.surfaces), *(one.polygons for one in holes)):
            polygons[:] = [corners[::-1] for corners in polygons]
    return str(template.get("lod", "")), made


def _geometry(name: str, geometry: Mapping[str, Any], place: str, vertices: Points, faults: Faults) -> Object:
    semantics = faults.mapping(geometry["semantics"], f"{place}.semantics")
    told = faults.sequence(semantics.get("surfaces", []), f"{place}.semantics.surfaces", "a list of surfaces")
    surfaces: dict[int, Surface] = {}
    holes: dict[int, Hole] = {}
    parents: dict[int, Any] = {}
    for k, value in enumerate(told):
        where = at(f"{place}.semantics.surfaces", k)
        own = faults.mapping(value, where)
        label = own.get("id", own.get("gml:id", own.get("name", "")))
        label = label if isinstance(label, str) else ""
        if own.get("type") in _OPENINGS:
            holes[k] = Hole(_OPENINGS[own["type"]], label, where)
            parents[k] = own.get("parent")
        else:
            surfaces[k] = Surface(label, where)
    depth = _DEPTHS[geometry["type"]]
    boundaries = list(_flattened(geometry.get("boundaries"), depth))
    numbers = list(_valued(semantics.get("values"), geometry.get("boundaries"), depth))
    for k in surfaces:
        children = told[k].get("children", [])
        for child in children if isinstance(children, list) else []:
            if isinstance(child, int) and child in holes and parents[child] is None:
                parents[child] = k
    if len(numbers) != len(boundaries):
        faults.add(
            f"{place}.semantics.values",
            f"expected a number, or null, for each of the {len(boundaries)} surfaces; found {len(numbers)}",
        )
        return Object(name)
    for n, (number, boundary) in enumerate(zip(numbers, boundaries, strict=True)):
        if number is None:
            continue
        if not isinstance(number, int) or not 0 <= number < len(told):
            faults.expected(
                at(f"{place}.semantics.values", n), f"a number from 0 to {len(told) - 1}, or null", number
            )
            continue
        corners = _polygon(boundary, at(f"{place}.boundaries", n), vertices, faults)
        if corners is not None:
            (holes.get(number) or surfaces[number]).polygons.append(corners)
    made = Object(name, list(surfaces.values()))
    for k, hole in holes.items():
        parent = parents[k]
        whole = _whole(told[k].get("rect"), hole.polygons)
        if whole is not None:
            hole.polygons.append(whole)
        if not hole.polygons:
            faults.add(hole.place, "expected an opening with a surface; no value names it")
        elif parent is None:
            made.loose.append(hole)
        elif isinstance(parent, int) and parent in surfaces:
            surfaces[parent].holes.append(hole)
        else:
            faults.expected(f"{hole.place}.parent", "the number of a surface that is no opening", parent)
    return made


def _whole(rect: Any, polygons: Sequence[Points]) -> Points | None:
    """The whole of an opening that another one covers in part: `render.write_cityjson` tells it, in the plane y = 0."""
    if not polygons or not isinstance(rect, list) or len(rect) != 4 or not _numbers(rect):
        return None
    corners = np.concatenate(polygons)
    left, bottom, right, top = rect
    low, high = corners.min(axis=0), corners.max(axis=0)
    fits = (
        left <= low[0] + _NEAR
        and bottom <= low[2] + _NEAR
        and high[0] <= right + _NEAR
        and high[2] <= top + _NEAR
    )
    if not fits or abs(corners[:, 1]).max() > _NEAR:
        return None
    return np.array([[left, 0, bottom], [right, 0, bottom], [right, 0, top], [left, 0, top]], float)


def _flattened(value: Any, depth: int) -> Iterator[Any]:
    if not isinstance(value, list):
        return
    for member in value:
        if depth:
            yield from _flattened(member, depth - 1)
        else:
            yield member


def _valued(value: Any, boundary: Any, depth: int) -> Iterator[Any]:
    """The value of each surface; null where a whole shell, or all, has none."""
    if value is None:
        yield from (None for _ in _flattened(boundary, depth))
    elif depth and isinstance(value, list) and isinstance(boundary, list) and len(value) == len(boundary):
        for own, around in zip(value, boundary, strict=True):
            yield from _valued(own, around, depth - 1)
    else:
        yield from _flattened(value, depth)


def _polygon(boundary: Any, place: str, vertices: Points, faults: Faults) -> Points | None:
    """The outer ring of a surface."""
    ring = boundary[0] if isinstance(boundary, list) and boundary else None
    if not isinstance(ring, list) or len(ring) < 3:
        faults.add(place, f"expected a ring of at least three vertices; found {describe(ring)}")
        return None
    for k in ring:
        if not isinstance(k, int) or isinstance(k, bool) or not 0 <= k < len(vertices):
            faults.expected(place, f"numbers of vertices, 0 to {len(vertices) - 1}", k)
            return None
    corners: Points = vertices[ring]
    return corners
