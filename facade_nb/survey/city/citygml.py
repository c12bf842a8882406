"""CityGML 2 and 3: buildings, their boundary surfaces, and the windows and doors in these."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...design.errors import quoted
from ...design.fields import Faults
from .globe import Globe, in_degrees
from .model import Hole, Object, Points, Surface
from .xml import Element

__all__ = ["objects_of"]

_BUILDINGS = ("Building", "BuildingPart")
_OPENINGS = {"Window": "window", "Door": "door", "WindowSurface": "window", "DoorSurface": "door"}
"""In CityGML 2, and in CityGML 3."""
_SURFACES = (
    "WallSurface", "RoofSurface", "GroundSurface", "ClosureSurface", "OuterFloorSurface", "OuterCeilingSurface",
)  # fmt: skip
_LEVELS = ("lod3", "lod4", "lod2")
"""Geometries, the first one that there is."""
_INSIDE = ("Room", "BuildingRoom", "Storey", "BuildingUnit")


def objects_of(root: Element, faults: Faults) -> Iterator[Object]:
    """The buildings of a document, and their parts; what is wrong is noted with its line."""
    if root.name != "CityModel":
        faults.add(root.place, "expected a CityModel")
        return
    polygons = {own.id: own for own in root.walk() if own.id and own.name in _GEOMETRIES}
    globe = None
    for own in root.walk():
        srs = own.attributes.get("srsName", "")
        if globe is None and in_degrees(srs):
            globe = Globe.of(srs)
            if globe is None:
                faults.add(
                    own.place,
                    f"expected coordinates in metres, or a name that tells the order of latitude and longitude "
                    f"(urn:ogc:def:crs:EPSG::4979); found the degrees of {quoted(srs)}",
                )
                return
    number = 0
    for own in root.walk():
        if own.name in _BUILDINGS:
            number += 1
            found = _object(own, own.id or f"building {number}", polygons, faults)
            if globe is not None:
                inside = [one for one in own.walk() if one.name == "ImplicitGeometry"]
                for one in inside[:1]:
                    faults.add(
                        one.place, "expected coordinates in metres: an ImplicitGeometry is in none of degrees"
                    )
                globe.flatten(found)
            yield found


_FACES = ("Polygon", "PolygonPatch", "Triangle", "Rectangle")
_GEOMETRIES = (
    *_FACES, "Surface", "TriangulatedSurface", "Tin", "Shell", "CompositeSurface", "OrientableSurface",
    "MultiSurface", "Solid", "MultiSolid", "CompositeSolid", "MultiGeometry", "ImplicitGeometry",
)  # fmt: skip
_IMPLICIT = "ImplicitRepresentation"
_RELATIVE = ("relativeGMLGeometry", "relativeGeometry")
"""In CityGML 2, and in CityGML 3."""


def _object(building: Element, name: str, polygons: dict[str, Element], faults: Faults) -> Object:
    made = Object(name)
    surfaces: dict[int, Surface] = {}
    for own in building.walk("BuildingPart", *_INSIDE):
        if own.name in _SURFACES:
            surface = Surface(own.id, own.place, _polygons(own, polygons, faults))
            surfaces[id(own)] = surface
            made.surfaces.append(surface)
        elif own.name in _OPENINGS:
            hole = Hole(_OPENINGS[own.name], own.id, own.place, _polygons(own, polygons, faults))
            if not hole.polygons and any(one.name in _OPENINGS for one in own.walk()):
                continue  # a window of CityGML 3 whose own surfaces follow
            if not hole.polygons:
                faults.add(
                    hole.place,
                    "expected an opening with a lod3MultiSurface of at least one polygon, or a "
                    "lod3ImplicitRepresentation; found none",
                )
                continue
            around = own.within(*_SURFACES)
            if around is not None and id(around) in surfaces:
                surfaces[id(around)].holes.append(hole)
            else:
                made.loose.append(hole)
    return made


def _polygons(surface: Element, polygons: dict[str, Element], faults: Faults) -> list[Points]:
    """The polygons of the most detailed geometry of a surface or an opening, without those of openings in it."""
    level = {
        own: k for own in surface.children for k, name in enumerate(_LEVELS) if own.name.startswith(name)
    }
    given = [
        own for own in level if own.children or (own.name.endswith(_IMPLICIT) and own.attributes.get("href"))
    ]
    best = min(given, key=lambda own: (level[own], own.name.endswith(_IMPLICIT)), default=None)
    if best is None:
        return []
    return (
        _implicit(best, polygons, faults)
        if best.name.endswith(_IMPLICIT)
        else _within(best, polygons, faults)
    )


def _implicit(representation: Element, polygons: dict[str, Element], faults: Faults) -> list[Points]:
    """The polygons of a geometry of its own, which is turned by a matrix and put at a place."""
    given = next((own for own in representation.walk() if own.name == "ImplicitGeometry"), None)
    href = representation.attributes.get("href", "")
    if given is None:
        given = polygons.get(href.removeprefix("#"))
    if given is None or given.name != "ImplicitGeometry":
        told = f"; there is no {quoted(href.removeprefix('#'))}" if href else ""
        faults.add(representation.place, f"expected an ImplicitGeometry of this file{told}")
        return []
    parts = {own.name: own for own in given.children}
    relative = next((parts[name] for name in _RELATIVE if name in parts), None)
    if relative is None:
        faults.add(
            given.place, "expected a relativeGMLGeometry; a libraryObject, in a file of its own, is not read"
        )
        return []
    matrix = np.eye(4)
    if (turned := parts.get("transformationMatrix")) is not None:
        values = _floats(turned, faults)
        if len(values) != 16:
            faults.add(turned.place, f"expected 16 numbers, row by row; found {len(values)}")
            return []
        matrix = np.array(values).reshape(4, 4)
    point = next(
        (own for own in given.walk() if own.name in ("pos", "coordinates") and own.within("referencePoint")),
        None,
    )
    at = _floats(point, faults) if point is not None else []
    if len(at) != 3:
        faults.add(given.place, f"expected a referencePoint of three numbers; found {len(at)}")
        return []
    way = -1 if np.linalg.det(matrix[:3, :3]) < 0 else 1  # a mirror turns corners around
    return [
        (corners @ matrix[:3, :3].T + matrix[:3, 3] + at)[::way]
        for corners in _within(relative, polygons, faults)
    ]


def _floats(own: Element, faults: Faults) -> list[float]:
    """The numbers of an element; none of them, with a fault, where one is no number."""
    values: list[float] = []
    for word in own.text.replace(",", " ").split():
        try:
            value = float(word)
        except ValueError:
            value = float("nan")
        if not abs(value) < 1e12:
            faults.add(own.place, f"expected numbers, found {quoted(word)}")
            return []
        values.append(value)
    return values


def _within(best: Element, polygons: dict[str, Element], faults: Faults) -> list[Points]:
    """The polygons of a geometry, and of those that it refers to."""
    found: list[Points] = []
    for own in (best, *best.walk()):
        href = own.attributes.get("href", "")
        if href.startswith("#"):
            target = polygons.get(href[1:])
            if target is None:
                faults.add(
                    own.place,
                    f"expected a reference to a polygon of this file; there is no {quoted(href[1:])}",
                )
                continue
            inner = [target, *target.walk()]
        else:
            inner = [own]
        for one in inner:
            if one.name in _FACES:
                ring = _ring(one, faults)
                if ring is not None:
                    found.append(ring[::-1] if _turned(one, best) else ring)
    return found


def _turned(polygon: Element, geometry: Element) -> bool:
    """Whether surfaces around a polygon turn it over."""
    turned = False
    own = polygon.parent
    while own is not None and own is not geometry:
        turned ^= own.name == "OrientableSurface" and own.attributes.get("orientation") == "-"
        own = own.parent
    return turned


def _ring(polygon: Element, faults: Faults) -> Points | None:
    """The corners of the outer ring of a polygon."""
    outer = next((own for own in polygon.walk() if own.name == "exterior"), None)
    if outer is None:
        faults.add(polygon.place, "expected a polygon with an exterior")
        return None
    lists = [own for own in outer.walk() if own.name in ("posList", "pos", "coordinates")]
    values: list[float] = []
    for own in lists:
        dimension = own.attributes.get("srsDimension", "3")
        if dimension != "3":
            faults.add(own.place, f"expected coordinates in 3 dimensions, found {quoted(dimension)}")
            return None
        for word in own.text.replace(",", " ").split():
            try:
                value = float(word)
            except ValueError:
                value = float("nan")
            if not abs(value) < 1e12:
                faults.add(own.place, f"expected numbers of metres, found {quoted(word)}")
                return None
            values.append(value)
    if len(values) % 3 or len(values) < 9:
        where = lists[0].place if lists else outer.place
        faults.add(
            where, f"expected at least three corners of three numbers each, found {len(values)} numbers"
        )
        return None
    corners = np.array(values).reshape(-1, 3)
    if len(corners) > 3 and np.array_equal(corners[0], corners[-1]):
        corners = corners[:-1]
    return corners
