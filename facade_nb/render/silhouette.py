"""What parts cover as the viewer sees them, and what they throw shadow on within their own shape."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import pairwise
from math import atan2
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

    found = [polygon_of(part) for part in parts]
    return found[0] if len(found) == 1 else shapely.union_all(found, grid_size=_GRID)


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


@lru_cache(maxsize=256)
def shade_on(
    receivers: tuple[Part, ...],
    parts: tuple[Part, ...],
    light: Point,
    opening: tuple[Point, ...] | None = None,
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
    import numpy as np
    import shapely
    from shapely.affinity import translate

    level = front(receivers[0])
    field = covered(receivers)
    shadows: list[Any] = []
    spots: list[list[Point]] = []  # of convex parts, which pass over no more than lies between their corners
    for part in parts:
        if front(part) < level + 0.03 or (isinstance(part, Block) and _slight(part)):
            continue
        match part:
            case Loft() | Polyhedron():
                corners = [(x, y, max(z - level, 0.0)) for x, y, z in part.points]
            case _:
                near, far = max(getattr(part, "z0", level) - level, 0.0), front(part) - level
                if isinstance(part, Ring) or not _convex(outline(part)):
                    shadows.append(_swept(polygon_of(part), near, far, light))
                    continue
                corners = [(x, y, t) for x, y in outline(part) for t in (near, far)]
        spots.append([(x + t * light[0], y - t * light[1]) for x, y, t in corners])
    if spots:
        owners = np.repeat(np.arange(len(spots)), [len(own) for own in spots])
        points = shapely.points(np.array([spot for own in spots for spot in own]))
        shadows.extend(shapely.convex_hull(shapely.multipoints(points, indices=owners)))
    if opening is not None and level < 0:
        lit = translate(shapely.Polygon(opening), -level * light[0], level * light[1])
        shadows.append(field.difference(lit))
    return shapely.union_all(shapely.intersection(shadows, field)) if shadows else shapely.Polygon()


def _slight(part: Block) -> bool:
    return min(part.x1 - part.x0, part.y1 - part.y0) < _SLIGHT


def _swept(shape: Any, near: float, far: float, light: Point) -> Any:
    """What a flat shape passes over on its way along the light from one distance to another."""
    import shapely
    from shapely.affinity import translate

    (ax, ay), (bx, by) = ((t * light[0], -t * light[1]) for t in (near, far))
    ends = [translate(shape, ax, ay), translate(shape, bx, by)]
    sides = [
        ((px + ax, py + ay), (qx + ax, qy + ay), (qx + bx, qy + by), (px + bx, py + by))
        for polygon in shapely.get_parts(shape)
        for ring in (polygon.exterior, *polygon.interiors)
        for (px, py), (qx, qy) in pairwise(ring.coords)
    ]
    swept = shapely.polygons(sides)
    return shapely.union_all([*ends, *swept[shapely.area(swept) > 0]])


def _convex(points: Sequence[Point]) -> bool:
    """Whether an outline turns to one side only, and goes around once."""
    turns, around = set(), 0.0
    for (px, py), (qx, qy), (rx, ry) in zip(
        points, (*points[1:], points[0]), (*points[2:], *points[:2]), strict=True
    ):
        cross = (qx - px) * (ry - qy) - (qy - py) * (rx - qx)
        along = (qx - px) * (rx - qx) + (qy - py) * (ry - qy)
        around += atan2(cross, along)
        if abs(cross) > _GRID**2:
            turns.add(cross > 0)
    return len(turns) == 1 and abs(around) < 7.0
