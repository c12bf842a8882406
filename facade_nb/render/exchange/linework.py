"""The elevation as lines: what is seen of each surface, and the lines between them by weight. Metres, y up.

The scene is looked at straight on. Each solid's triangles become facets: surfaces of one plane, or of one curved body.
What facets in front hide is cut away; neighbours that run on in one plane and material are made one. The boundaries
of what is left are the drawing.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solver.model.layout import Rect
from ..baked import drawable
from ..materials import DEFAULT_MATERIAL
from ..meshing import Mesh, mesh_parts
from ..parts import Part
from ..scene import Scene, Solid

__all__ = ["WEIGHTS", "Drawn", "Line", "Linework", "Surface", "linework"]

WEIGHTS = {"outline": 0.5, "edge": 0.25, "fine": 0.13}
"""Widths of the pens, millimetres: the façade's outline; where the surface breaks in depth; between materials."""

_STEP = 0.025
"""Smaller differences in depth, metres, are drawn with the fine pen."""

_GRID = 1e-5
"""Metres: what lies closer is one place."""

_OPEN = 0.2
"""Metres: what is seen of the sky through narrower gaps, between the bars of a railing, has no outline."""

_FACING = 0.02
"""How far a surface must be turned towards the viewer to be seen: the cosine of its angle to the view."""

_COURSES = frozenset({"cornice", "ledge", "pitched", "mansard"})
"""Geometries that run on from cell to cell without a joint."""

Line = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Surface:
    """What is seen of one material in one plane: a shapely polygon or several."""

    material: str
    polygon: Any


@dataclass(frozen=True, slots=True)
class Drawn:
    """What is seen of a rule of the design's grammar: its shape's rectangle, in which it is drawn, and the polygon."""

    material: str
    rect: Rect
    polygon: Any


@dataclass(frozen=True, slots=True)
class Linework:
    """The drawing: lines of each weight (the names of `WEIGHTS`), the surfaces between them, and rules over these."""

    lines: dict[str, tuple[Line, ...]]
    surfaces: tuple[Surface, ...]
    drawn: tuple[Drawn, ...] = ()

    @property
    def bounds(self) -> tuple[float, float, float, float] | None:
        """Left, bottom, right, top of all that is drawn; None where that is nothing."""
        points = [point for lines in self.lines.values() for line in lines for point in line]
        if not points:
            return None
        xs, ys = [x for x, _ in points], [y for _, y in points]
        return min(xs), min(ys), max(xs), max(ys)


@dataclass(frozen=True, slots=True)
class _Facet:
    """A surface before anything hides it; z = a x + b y + c on it, `near` is where it comes nearest."""

    polygon: Any
    slot: str
    plane: tuple[float, float, float]
    near: float
    curved: bool


def linework(scene: Scene) -> Linework:
    """Draw a scene, seen straight on."""
    import shapely

    made: dict[tuple[Part, ...], list[_Facet]] = {}
    polygons, nears, keys, planes, rects = [], [], [], [], []
    layers: dict[str, int] = {}
    for solid in scene.solids:
        if solid.parts not in made:
            made[solid.parts] = list(_facets(mesh_parts(solid.parts)))
        left, bottom, face = solid.rect[0], solid.rect[1], solid.face
        for number, facet in enumerate(made[solid.parts]):
            a, b, c = facet.plane
            plane = (a, b, c + face - a * left - b * bottom)
            polygons.append(shapely.transform(facet.polygon, partial(np.add, (left, bottom))))
            nears.append((layers.setdefault(solid.shape.layer, len(layers)), facet.near + face))
            planes.append(plane)
            rects.append(solid.rect)
            keys.append((*_key(solid, facet, number), *np.round(plane, 4).tolist()))
    if not polygons:
        return Linework(dict.fromkeys(WEIGHTS, ()), ())
    found = _seen(_met(np.array(polygons)), np.array(nears))
    regions: dict[tuple[object, ...], list[Any]] = defaultdict(list)
    ruled: dict[tuple[str, Rect], list[Any]] = defaultdict(list)
    level: dict[tuple[object, ...], tuple[float, float, float]] = {}
    for key, plane, polygon, rect in zip(keys, planes, found, rects, strict=True):
        if not polygon.is_empty:
            regions[key].append(polygon)
            level[key] = plane
            if drawable(scene.library, str(key[0])):
                ruled[str(key[0]), rect].append(polygon)
    merged = {key: shapely.union_all(parts, grid_size=_GRID) for key, parts in regions.items()}
    surfaces = [(key, part) for key, whole in merged.items() for part in _polygons(whole)]
    lines = _weighed([part for _, part in surfaces], np.array([level[key] for key, _ in surfaces]))
    drawn = [
        Drawn(material, rect, part)
        for (material, rect), own in ruled.items()
        for part in _polygons(shapely.union_all(own, grid_size=_GRID))
    ]
    return Linework(lines, tuple(Surface(str(key[0]), part) for key, part in surfaces), tuple(drawn))


def _facets(mesh: Mesh) -> Iterator[_Facet]:
    """The surfaces of a mesh that look at the viewer."""
    import shapely

    corners = mesh.vertices[mesh.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(across, axis=1)
    normal = across / np.where(size > 0, size, 1)[:, None]
    groups: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for k in np.flatnonzero(normal[:, 2] > _FACING).tolist():
        if mesh.round[k]:
            groups[int(mesh.slots[k]), "curved", round(1.5 * float(normal[k, 1]))].append(k)
        else:
            away = float(normal[k] @ corners[k, 0])
            groups[(int(mesh.slots[k]), *normal[k].round(3).tolist(), round(away, 4))].append(k)
    for key, members in groups.items():
        triangles = shapely.polygons(corners[members][:, :, :2])
        polygon = shapely.union_all(triangles, grid_size=_GRID / 100)
        if polygon.is_empty:
            continue
        curved = key[1] == "curved"
        near = float(corners[members][:, :, 2].max())
        nx, ny, nz = (0.0, 0.0, 1.0) if curved else normal[members[0]].tolist()
        x, y, z = corners[members[0], 0].tolist()
        plane = (0.0, 0.0, near) if curved else (-nx / nz, -ny / nz, z + (nx * x + ny * y) / nz)
        yield _Facet(polygon, mesh.names[int(mesh.slots[members[0]])], plane, near, curved)


def _key(solid: Solid, facet: _Facet, number: int) -> tuple[object, ...]:
    """What neighbouring facets have in common that are drawn as one: material first, then what sets them apart."""
    shape = solid.shape
    material = solid.materials[facet.slot]
    if facet.curved:
        return material, "curved", solid.index, number
    runs_on = material != DEFAULT_MATERIAL and facet.slot == "body"
    if runs_on and solid.geometry.name in ("box", "arch", "arcade"):
        return material, "wall", 0, 0
    if solid.geometry.name in _COURSES:
        return material, shape.geometry, round(shape.rect[1], 4), round(shape.rect[3], 4)
    return material, shape.geometry, solid.index, 0


def _met(polygons: NDArray[Any]) -> NDArray[Any]:
    """The polygons with coordinates that differ by next to nothing made one, so that neighbours leave no crack."""
    import shapely

    points = shapely.get_coordinates(polygons)
    for axis in (0, 1):
        values, back = np.unique(points[:, axis], return_inverse=True)
        first = np.insert(np.diff(values) > 2 * _GRID, 0, True)
        points[:, axis] = values[first][np.cumsum(first) - 1][back.reshape(-1)].round(5)
    met = shapely.set_coordinates(polygons, points)
    return np.where(shapely.is_valid(met), met, shapely.buffer(met, 0))


def _seen(polygons: NDArray[Any], nears: NDArray[np.float64]) -> list[Any]:
    """What is left of each polygon once those in front of it are taken away.

    `nears` (n, 2) has the layer of each and how near it comes. As in every elevation here, a later layer is in front;
    within a layer, what is nearer; of two as near, the later.
    """
    import shapely

    order = np.lexsort((nears[:, 1], nears[:, 0]))
    rank = np.empty(len(order), int)
    rank[order] = np.arange(len(order))
    first, second = shapely.STRtree(polygons).query(polygons, predicate="intersects")
    box = shapely.bounds(polygons)
    meet = np.minimum(box[first, 2:], box[second, 2:]) - np.maximum(box[first, :2], box[second, :2])
    hides = (rank[second] > rank[first]) & (meet > 2 * _GRID).all(axis=1)  # not only along an edge
    behind: dict[int, list[int]] = defaultdict(list)
    for k, front in zip(first[hides].tolist(), second[hides].tolist(), strict=True):
        behind[k].append(front)
    result = list(polygons)
    for k, fronts in behind.items():
        cover = shapely.union_all(polygons[fronts])
        result[k] = shapely.difference(polygons[k], cover, grid_size=_GRID)
    return result


def _polygons(shape: Any) -> Iterator[Any]:
    """The polygons of a shape, without slivers that no pen could draw."""
    import shapely

    for part in shapely.get_parts(shape):
        if part.geom_type == "Polygon" and part.area > 1e-7:
            yield part


def _weighed(polygons: list[Any], planes: NDArray[np.float64]) -> dict[str, tuple[Line, ...]]:
    """The boundaries of polygons, each stretch once, by what lies on its two sides."""
    import shapely

    network = shapely.union_all([polygon.boundary for polygon in polygons], grid_size=_GRID)
    stretches = [
        (a, b) for part in shapely.get_parts(network) for a, b in pairwise(shapely.get_coordinates(part))
    ]
    ends = np.array(stretches)
    way = ends[:, 1] - ends[:, 0]
    length = np.linalg.norm(way, axis=1)
    beside = np.stack([-way[:, 1], way[:, 0]], 1) / length[:, None] * (20 * _GRID)
    middle = ends.mean(axis=1)
    tree = shapely.STRtree(polygons)
    depths = []
    for side in (1, -1):
        points = middle + side * beside
        depth = np.full(len(points), np.nan)
        at, which = tree.query(shapely.points(points), predicate="within")
        a, b, c = planes[which].T
        depth[at] = a * points[at, 0] + b * points[at, 1] + c
        depths.append(depth)
    step = np.abs(depths[0] - depths[1])
    weight = np.where(np.isnan(step), 1, np.where(step > _STEP, 1, 2))
    free = np.flatnonzero(np.isnan(depths[0]) != np.isnan(depths[1]))
    whole = shapely.union_all(polygons, grid_size=_GRID)
    rim = whole.buffer(_OPEN / 2, join_style="mitre").buffer(-_OPEN / 2, join_style="mitre").boundary
    shapely.prepare(rim)
    weight[free[shapely.dwithin(rim, shapely.points(middle[free]), 1e-3)]] = 0
    weight[np.isnan(depths[0]) & np.isnan(depths[1])] = 2  # a crack between two surfaces
    return {name: tuple(_joined(ends[weight == number])) for number, name in enumerate(WEIGHTS)}


def _joined(ends: NDArray[np.float64]) -> Iterator[Line]:
    """Stretches as long lines, without corners that turn nowhere."""
    import shapely

    if not len(ends):
        return
    whole = shapely.line_merge(shapely.multilinestrings([shapely.linestrings(pair) for pair in ends]))
    for part in shapely.get_parts(shapely.simplify(whole, _GRID)):
        yield tuple((float(x), float(y)) for x, y in shapely.get_coordinates(part).round(6) + 0.0)
