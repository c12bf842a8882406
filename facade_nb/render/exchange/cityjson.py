"""CityJSON 2.0: one building at LoD 3, its wall with the openings cut out, windows and doors in them.

The façade stands on the ground plane: x to the right, z up, y away from the street; the origin is its lower
left corner.
All surfaces lie in its plane and look at the street.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ...design.files import write_atomically
from ...solver.model.layout import Layout, PlacedShape
from .schedule import OTHER

__all__ = ["STEP", "Surfaces", "document_of", "surfaces_of", "to_cityjson", "write_cityjson"]

STEP = 0.0001
"""Metres: what a whole number of the file stands for."""

_OPENINGS = {"window": "Window", "door": "Door"}
_ROOF = "roof"


class Surfaces(NamedTuple):
    """The surfaces of a façade in its plane.

    Attributes
    ----------
    polygons
        Shapely polygons, each with the number of its surface. Outer rings run counter-clockwise.
    surfaces
        What CityJSON says of each; `parent` and `children` are numbers of others.
    """

    polygons: list[tuple[Any, int]]
    surfaces: list[dict[str, Any]]


def surfaces_of(layout: Layout) -> Surfaces:
    """Walls with their openings cut out of them, roofs, windows and doors (see `to_cityjson`)."""
    import shapely

    openings = [(index, shape) for index, shape in enumerate(layout.shapes) if shape.kind in _OPENINGS]
    areas = _free([_box(shape) for _, shape in openings])
    roofs: list[Any] = []
    walls: list[Any] = []
    for shape in layout.shapes:
        if shape.kind not in _OPENINGS:
            (roofs if shape.kind == _ROOF else walls).append(_box(shape))
    cut = shapely.union_all([area for _, area in areas], grid_size=STEP)
    roof = shapely.difference(shapely.union_all(roofs, grid_size=STEP), cut, grid_size=STEP)
    wall = shapely.union_all(walls, grid_size=STEP)
    wall = shapely.difference(shapely.difference(wall, cut, grid_size=STEP), roof, grid_size=STEP)

    found: list[tuple[Any, int]] = []
    surfaces: list[dict[str, Any]] = []
    pieces = list(_polygons(wall))
    covers = list(_polygons(roof))
    for kind, polygons in (("WallSurface", pieces), ("RoofSurface", covers)):
        for polygon in polygons:
            found.append((polygon, len(surfaces)))
            surfaces.append({"type": kind})
    around = [*pieces, *covers]
    for position, area in areas:
        index, shape = openings[position]
        own = len(surfaces)
        surfaces.append({"type": _OPENINGS[shape.kind], **_told(shape, index)})
        found += [(polygon, own) for polygon in _polygons(area)]
        parent = _parent(area, around, len(pieces))
        if parent is not None:
            surfaces[own]["parent"] = parent
            surfaces[parent].setdefault("children", []).append(own)
    return Surfaces(found, surfaces)


def to_cityjson(layout: Layout) -> str:
    """Return a layout as CityJSON.

    There is a ``WallSurface`` for each connected piece of wall (whatever is no window, door or roof counts as wall), a
    ``RoofSurface`` for each piece of roof, and a ``Window`` or ``Door`` for each shape of that kind, the child of the
    wall around it. An opening of a later layer is cut out of those it covers.
    """
    found = surfaces_of(layout)
    points: dict[tuple[int, int], int] = {}
    boundaries = [list(_rings(polygon, points)) for polygon, _ in found.polygons]
    canvas = layout.canvas
    return document_of(
        layout.name,
        boundaries,
        [surface for _, surface in found.polygons],
        found.surfaces,
        [(x, 0, y) for x, y in points],
        (0.0, 0.0, 0.0, canvas.width, 0.0, canvas.height),
        "facade",
    )


def document_of(
    name: str,
    boundaries: list[Any],
    values: list[int],
    surfaces: list[dict[str, Any]],
    vertices: Sequence[tuple[int, int, int]],
    extent: tuple[float, ...],
    untitled: str,
) -> str:
    """The document of one building.

    Parameters
    ----------
    boundaries, values, surfaces
        Rings of indices for each polygon, the surface that it belongs to, and what is said of the surfaces.
    vertices
        In steps of `STEP`.
    extent
        Least x, y, z and greatest, metres.
    """
    geometry = {
        "type": "MultiSurface",
        "lod": "3",
        "boundaries": boundaries,
        "semantics": {"surfaces": surfaces, "values": values},
    }
    document = {
        "type": "CityJSON",
        "version": "2.0",
        "transform": {"scale": [STEP, STEP, STEP], "translate": [0.0, 0.0, 0.0]},
        "metadata": {"title": name or untitled, "geographicalExtent": list(extent)},
        "CityObjects": {
            "building-1": {
                "type": "Building",
                "attributes": {"name": name},
                "geometry": [geometry] if boundaries else [],
            }
        },
        "vertices": [list(vertex) for vertex in vertices],
    }
    return json.dumps(document, ensure_ascii=False, allow_nan=False) + "\n"


def write_cityjson(layout: Layout, path: str | Path) -> Path:
    """Write a layout as CityJSON (see `to_cityjson`), atomically, and return the path.

    Raises
    ------
    DesignError
        If the file cannot be written.
    """
    write_atomically(path, to_cityjson(layout))
    return Path(path)


def _box(shape: PlacedShape) -> Any:
    import shapely

    return shapely.box(*(round(value / STEP) * STEP for value in shape.rect))


def _free(boxes: list[Any]) -> list[tuple[int, Any]]:
    """What is left of each opening once those after it are taken away; what is covered is left out."""
    import shapely

    if not boxes:
        return []
    tree = shapely.STRtree(boxes)
    first, second = tree.query(boxes, predicate="intersects")
    result = []
    for k, box in enumerate(boxes):
        later = [boxes[j] for j in second[first == k] if j > k]
        rest = shapely.difference(box, shapely.union_all(later), grid_size=STEP) if later else box
        if rest.area > STEP**2:
            result.append((k, rest))
    return result


def _polygons(shape: Any) -> Iterator[Any]:
    import shapely

    for part in shapely.get_parts(
        shapely.orient_polygons(shape)
    ):  # outer rings counter-clockwise, holes clockwise
        if part.geom_type == "Polygon" and part.area > STEP**2:
            yield part


def _rings(polygon: Any, points: dict[tuple[int, int], int]) -> Iterator[list[int]]:
    """The rings of a polygon as indices of points, seen from the street; the first is not repeated at the end."""
    for ring in (polygon.exterior, *polygon.interiors):
        corners = [(round(x / STEP), round(y / STEP)) for x, y in ring.coords[:-1]]
        yield [points.setdefault(corner, len(points)) for corner in corners]


def _parent(area: Any, around: list[Any], walls: int) -> int | None:
    """Which surface an opening is in: the one it shares most of its boundary with; else the nearest, walls first."""
    if not around:
        return None
    shared = [float(area.boundary.intersection(piece.boundary).length) for piece in around]
    best = max(range(len(around)), key=lambda k: (round(shared[k], 6), k < walls, -k))
    if shared[best] > STEP:
        return best
    return min(range(len(around)), key=lambda k: (k >= walls, float(area.distance(around[k])), k))


def _told(shape: PlacedShape, index: int) -> dict[str, Any]:
    """What else is said of an opening."""
    left, bottom, right, top = shape.rect
    return {
        "name": f"{shape.layer}/{shape.x} {shape.y}",
        "shape": index,
        "kind": shape.kind or OTHER,
        "geometry": shape.geometry,
        "material": shape.material,
        "width": round(right - left, 4),
        "height": round(top - bottom, 4),
        "rect": [round(side, 4) for side in shape.rect],  # all of it, also what another one covers
    }
