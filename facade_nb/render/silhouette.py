"""What parts cover as the viewer sees them, and what they throw shadow on within their own shape."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any

from .parts import Block, Loft, Part, Point, Polyhedron, Ring, front, outline

__all__ = ["covered", "pieces", "polygon_of", "shade_on", "silhouette"]

_GRID = 1e-6
"""Metres: what lies closer is one place."""

_SLIGHT = 0.028
"""Bars thinner than this throw no shadow that could be told, metres."""


def polygon_of(part: Part) -> Any:
    """A part as a shapely polygon, seen from the front."""
    import shapely

    match part:
        case Ring():
            t = part.width
            hole = ((part.x0 + t, part.y0 + t), (part.x1 - t, part.y0 + t),
                    (part.x1 - t, part.y1 - t), (part.x0 + t, part.y1 - t))  # fmt: skip
            return shapely.Polygon(outline(part), [hole])
        case Loft() | Polyhedron():
            faces = [shapely.Polygon([part.points[i][:2] for i in face]) for face in part.faces]
            return shapely.union_all([face for face in faces if face.area > 0], grid_size=_GRID)
        case _:
            return shapely.make_valid(shapely.Polygon(outline(part)))


def covered(parts: Iterable[Part]) -> Any:
    """All that parts cover, as one shapely geometry."""
    import shapely

    return shapely.union_all([polygon_of(part) for part in parts], grid_size=_GRID)


def silhouette(parts: Iterable[Part]) -> tuple[tuple[Point, ...], ...]:
    """The outlines of all that parts cover, without what is open within, counter-clockwise."""
    import shapely

    whole = covered(parts)
    found = [
        shapely.Polygon(piece.exterior) for piece in shapely.get_parts(whole) if piece.geom_type == "Polygon"
    ]
    merged = shapely.get_parts(shapely.union_all(found))
    return tuple(
        tuple(shapely.Polygon(piece.exterior).normalize().exterior.coords[:0:-1]) for piece in merged
    )


def pieces(parts: Iterable[Part]) -> list[tuple[Point, ...]]:
    """All that parts cover, as triangles."""
    import shapely
    from trimesh.creation import triangulate_polygon

    found: list[tuple[Point, ...]] = []
    for polygon in shapely.get_parts(covered(parts).simplify(1e-3)):
        if polygon.geom_type == "Polygon" and polygon.area > 0:
            points, faces = triangulate_polygon(polygon, engine="earcut")
            found += [tuple((float(x), float(y)) for x, y in points[face]) for face in faces]
    return found


def shade_on(
    receivers: Sequence[Part], parts: Iterable[Part], light: Point, opening: Sequence[Point] | None = None
) -> Any:
    """What of parts of one depth lies in the shadow of those in front of them.

    Parameters
    ----------
    receivers
        Parts whose fronts are in one plane.
    parts
        All parts of the shape.
    light
        The shadow of a place one metre in front: metres to the right, metres down.
    opening
        The outline, in the plane of the face, of the hole in a wall through which light comes; None: there is none.

    Returns
    -------
    shapely geometry
        In the frame of the shape.
    """
    import shapely
    from shapely.affinity import translate

    level = front(receivers[0])
    field = covered(receivers)
    shadows = []
    for part in parts:
        if front(part) < level + 0.03 or (isinstance(part, Block) and _slight(part)):
            continue
        if isinstance(part, Loft | Polyhedron):
            spots = [(x, y, max(z - level, 0.0)) for x, y, z in part.points]
            swept = shapely.MultiPoint(
                [(x + t * light[0], y - t * light[1]) for x, y, t in spots]
            ).convex_hull
            shadows.append(swept)
            continue
        near = max(getattr(part, "z0", level) - level, 0.0)
        shadows.append(_swept(polygon_of(part), near, front(part) - level, light))
    if opening is not None and level < 0:
        lit = translate(shapely.Polygon(opening), -level * light[0], level * light[1])
        shadows.append(field.difference(lit))
    return (
        shapely.union_all([shadow.intersection(field) for shadow in shadows])
        if shadows
        else shapely.Polygon()
    )


def _slight(part: Block) -> bool:
    return min(part.x1 - part.x0, part.y1 - part.y0) < _SLIGHT


def _swept(shape: Any, near: float, far: float, light: Point) -> Any:
    """What a flat shape passes over on its way along the light from one distance to another."""
    import shapely
    from shapely.affinity import translate

    (ax, ay), (bx, by) = ((t * light[0], -t * light[1]) for t in (near, far))
    pieces = [translate(shape, ax, ay), translate(shape, bx, by)]
    for polygon in shapely.get_parts(shape):
        for ring in (polygon.exterior, *polygon.interiors):
            for (px, py), (qx, qy) in pairwise(ring.coords):
                corners = [(px + ax, py + ay), (qx + ax, qy + ay), (qx + bx, qy + by), (px + bx, py + by)]
                pieces.append(shapely.MultiPoint(corners).convex_hull)
    return shapely.union_all([piece for piece in pieces if piece.area > 0])
