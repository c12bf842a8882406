"""CityJSON of a solved building: one ``Building`` at LoD 3 with all its walls, its roof and the ground under it.

x runs east, y north, z up. Walls lie in the planes of their faces, openings in them.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..render.exchange.cityjson import STEP, document_of, surfaces_of
from ..solver.model.layout import Layout, PlacedShape
from .layout import BuildingLayout, SolvedFace
from .roofline import is_dormer
from .roofs import outline, roofing

__all__ = ["to_cityjson"]

_Point = tuple[int, int, int]


def to_cityjson(layout: BuildingLayout) -> str:
    """Return a building as CityJSON. Surfaces of walls, windows and doors name their `face`.

    Dormers count as openings of the wall below them. Gables are walls of no face.
    """
    points: dict[_Point, int] = {}
    boundaries: list[Any] = []
    values: list[int] = []
    surfaces: list[dict[str, Any]] = []

    def index(x: float, y: float, z: float) -> int:
        own = (round(x / STEP), round(y / STEP), round(z / STEP))
        return points.setdefault(own, len(points))

    for own in layout.faces:
        found = surfaces_of(_upright(own.shown, layout.eaves))
        first = len(surfaces)
        for surface in found.surfaces:
            moved = dict(surface, face=own.face.name)
            if "parent" in moved:
                moved["parent"] += first
            if "children" in moved:
                moved["children"] = [k + first for k in moved["children"]]
            surfaces.append(moved)
        for polygon, number in found.polygons:
            rings = (polygon.exterior, *polygon.interiors)
            boundaries.append(
                [[index(*_placed(own, *corner)) for corner in ring.coords[:-1]] for ring in rings]
            )
            values.append(number + first)
    roof = roofing(layout)
    seen: set[frozenset[int]] = set()
    for k, name in enumerate(roof.names):
        triangles = []
        for corners in roof.positions[roof.parts == k]:
            ring = [index(x, -z, y) for x, y, z in corners.tolist()]
            if len(set(ring)) == 3 and frozenset(ring) not in seen:  # what hangs over is seen from both sides
                seen.add(frozenset(ring))
                triangles.append([ring])
        if triangles:
            values += [len(surfaces)] * len(triangles)
            boundaries += triangles
            surfaces.append({"type": "RoofSurface" if name in ("roof", "flat") else "WallSurface"})
    feet = outline(layout)[::-1].tolist()
    boundaries.append([[index(x, y, 0.0) for x, y in feet]])
    values.append(len(surfaces))
    surfaces.append({"type": "GroundSurface"})
    every = np.array(list(points)) * STEP
    extent = (*every.min(axis=0).round(4).tolist(), *every.max(axis=0).round(4).tolist())
    return document_of(layout.name, boundaries, values, surfaces, list(points), extent, "building")


def _upright(shown: Layout, eaves: float) -> Layout:
    """What lies in the plane of a wall: nothing above the eaves but the windows of dormers."""

    def kept(shape: PlacedShape) -> bool:
        return not is_dormer(shape, eaves) or shape.kind in ("window", "door")

    return replace(shown, shapes=tuple(shape for shape in shown.shapes if kept(shape)))


def _placed(own: SolvedFace, x: float, z: float) -> tuple[float, float, float]:
    """A point of a face's plane in space; at its ends it is the corner itself."""
    face = own.face
    if abs(x) < STEP:
        return (*face.start, z)
    if abs(x - face.length) < STEP:
        return (*face.end, z)
    (a, b), (u, v) = face.start, face.way
    return a + u * x, b + v * x, z
