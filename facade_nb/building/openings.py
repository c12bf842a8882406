"""What stands in the roof over all opens it: a dormer, a gable; so no tiles go through a window, nor before a wall."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..render.cuts import Cut
from ..render.scene import build_scene, room_of
from .bodies import NEAR, Frame, house_end, slope_of
from .layout import BuildingLayout
from .roofline import is_dormer

__all__ = ["Opening", "opened", "openings"]

Floats = NDArray[np.float64]

_LEAST = 1e-8
"""Square metres: what is smaller of a triangle is nothing."""

_EPS = 1e-7


@dataclass(frozen=True, slots=True, eq=False)
class Opening:
    """A convex room in space: points p inside have `normals @ p <= limits`.

    Attributes
    ----------
    low, high
        Of the box around it.
    """

    normals: Floats
    limits: Floats
    low: Floats
    high: Floats


def openings(layout: BuildingLayout) -> list[Opening]:
    """The rooms of all that stands above the eaves."""
    return list(_openings(layout))


def _openings(layout: BuildingLayout) -> Iterator[Opening]:
    near = layout.building.roof.overhang + NEAR
    for own in layout.faces:
        frame = Frame.of(own)
        for solid in build_scene(own.shown, over=slope_of(layout, own)).solids:
            if not is_dormer(solid.shape, layout.eaves) or not (solid.geometry.full or solid.geometry.cuts):
                continue
            for cut in room_of(solid):
                back = house_end(layout, own, solid) if solid.geometry.full else cut.back
                for outline in _convex(cut):
                    yield _opening(frame, outline, back, near)


def _convex(cut: Cut) -> Iterator[Floats]:
    """The outline of an opening, in convex pieces, each counter-clockwise."""
    import shapely
    from trimesh.creation import triangulate_polygon

    polygon = shapely.make_valid(shapely.Polygon(cut.outline))
    for part in shapely.get_parts(polygon):
        if part.geom_type != "Polygon" or part.area < _LEAST:
            continue
        if part.convex_hull.area < part.area + _LEAST:
            yield np.array(shapely.orient_polygons(part.convex_hull).exterior.coords[:-1])
            continue
        points, faces = triangulate_polygon(part, engine="earcut")
        for corners in points[faces]:
            a, b, c = corners
            clockwise = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0
            yield corners[::-1] if clockwise else corners


def _opening(frame: Frame, outline: Floats, back: float, near: float) -> Opening:
    following = np.roll(outline, -1, axis=0)
    along = following - outline
    sides = np.column_stack([along[:, 1], -along[:, 0], np.zeros(len(along))])
    sides /= np.linalg.norm(sides, axis=1)[:, None]
    normals = np.concatenate([sides, [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]]])
    limits = np.concatenate([(sides[:, :2] * outline).sum(axis=1), [-back, near]])
    corners = np.array([(x, y, z) for x, y in outline for z in (back, near)])
    placed = frame.place(corners)
    turned = normals @ frame.axes
    return Opening(turned, limits + turned @ frame.origin, placed.min(axis=0), placed.max(axis=0))


def opened(triangles: Floats, rooms: Sequence[Opening]) -> Floats:
    """Triangles (t, 3, 3) without what lies in some rooms."""
    for room in rooms:
        low, high = triangles.min(axis=1), triangles.max(axis=1)
        met = ((low < room.high - _EPS) & (high > room.low + _EPS)).all(axis=1)
        if met.any():
            rest = [piece for triangle in triangles[met] for piece in _without(triangle, room)]
            triangles = np.concatenate([triangles[~met], np.array(rest).reshape(-1, 3, 3)])
    return triangles


def _without(triangle: Floats, room: Opening) -> Iterator[Floats]:
    """What of a triangle lies outside of a room, as triangles."""
    inside, outside = triangle, list[Floats]()
    for normal, limit in zip(room.normals, room.limits, strict=True):
        beyond = inside @ normal - limit
        if (beyond >= -_EPS).all():  # all of it is outside
            yield triangle
            return
        if (beyond <= _EPS).all():
            continue
        outside.append(_half(inside, beyond))
        inside = _half(inside, -beyond)
    for polygon in outside:
        for k in range(1, len(polygon) - 1):
            piece = polygon[[0, k, k + 1]]
            if np.linalg.norm(np.cross(piece[1] - piece[0], piece[2] - piece[0])) > 2 * _LEAST:
                yield piece


def _half(polygon: Floats, beyond: Floats) -> Floats:
    """The part of a convex polygon where a distance is not below nothing."""
    found = []
    for k, (point, far) in enumerate(zip(polygon, beyond, strict=True)):
        if far >= 0:
            found.append(point)
        after, then = polygon[(k + 1) % len(polygon)], beyond[(k + 1) % len(polygon)]
        if far * then < 0:
            found.append(point + (after - point) * (far / (far - then)))
    return np.array(found)
