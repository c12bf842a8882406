"""The façade as a relief: which surface lies at each place, where it breaks in depth, and what throws shadow on what.

Everything here is in metres with y up; the elevation turns it into ink. Only shapes that fill their rectangles make
up the *skin*; the others (columns, balconies, roofs) stand before it and only throw shadow.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..solver.model.layout import Rect
from .ink import clip, hull
from .parts import Block, Loft, Moulding, Point, Polyhedron, Prism, Turned, front, outline
from .polygons import clip_all
from .scene import Scene, Solid
from .silhouette import pieces
from .style import LIGHT

__all__ = ["Edges", "Relief"]

_STEP = 0.025
"""Smaller differences in depth, metres, are drawn as a fine line, not as an edge."""

_MANY = 60
"""Bodies of so few faces are taken as convex."""

_COURSES = frozenset({"cornice", "ledge", "pitched", "mansard"})
"""Geometries that run on from cell to cell without a joint."""

_AT_ONCE = 1_000_000
"""Pairs of what throws and what takes shadow that are looked at together: of a few megabytes."""

Segment = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Edges:
    """Lines of the skin to draw once a layer is: at its outline, at breaks in depth, between materials."""

    outline: tuple[Segment, ...]
    depth: tuple[Segment, ...]
    joint: tuple[Segment, ...]


@dataclass(frozen=True, slots=True)
class _Caster:
    """What throws shadow: convex, between two depths. `of` is its solid if part of the skin; a `box` is a rectangle.

    A `body` has corners that each have a depth of their own.
    """

    points: tuple[Point, ...]
    z0: float
    z1: float
    of: int | None = None
    box: bool = True
    body: tuple[tuple[float, float, float], ...] = ()


class _Boxes(NamedTuple):
    """Casters that are boxes, together: their rectangles, depths, and solids if they are part of the skin, else -1."""

    bounds: NDArray[np.float64]
    near: NDArray[np.float64]
    far: NDArray[np.float64]
    of: NDArray[np.int64]


class _Receivers(NamedTuple):
    """What takes shadow: layers, planes and rectangles; and of each solid, by its index, which one it is part of."""

    layers: NDArray[np.int64]
    planes: NDArray[np.float64]
    rects: NDArray[np.float64]
    home: NDArray[np.int64]


class Relief:
    """The relief of a scene.

    Parameters
    ----------
    scene
        Its solids, in painting order.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        names = list(dict.fromkeys(solid.shape.layer for solid in scene.solids))
        self.layers: dict[str, int] = {name: i for i, name in enumerate(names)}
        self._skin = [solid for solid in scene.solids if solid.geometry.full and solid.parts]
        rects = np.array([solid.rect for solid in self._skin]).reshape(-1, 4)
        self._xs, self._ys = _merged(rects[:, [0, 2]]), _merged(rects[:, [1, 3]])
        left, right = (np.searchsorted(self._xs, rects[:, k] - 1e-6) for k in (0, 2))
        low, high = (np.searchsorted(self._ys, rects[:, k] - 1e-6) for k in (1, 3))
        self._rects, self._sides = rects, np.stack([left, low, right, high], axis=1)
        top = np.full((max(len(self._ys) - 1, 0), max(len(self._xs) - 1, 0)), -1)
        for k in range(len(self._skin)):
            top[low[k] : high[k], left[k] : right[k]] = k
        self._top = top
        """Index into the skin of the surface seen in each cell of the grid (row from the bottom); -1: none."""

    def edges(self) -> list[Edges]:
        """The skin's lines, layer by layer in painting order: each where the later of its two surfaces is painted."""
        keys: dict[tuple[object, ...], int] = {}
        number, plane, stage = [], [], []
        for solid in self._skin:
            shape, name = solid.shape, solid.geometry.name
            plain = name == "arch" or (name == "box" and shape.material != "glass")
            same = None if plain else shape.rect[1::2] if name in _COURSES else solid.index
            key = (round(solid.plane, 4), solid.materials["body"], "" if plain else shape.geometry, same)
            number.append(keys.setdefault(key, len(keys)))
            plane.append(solid.plane)
            stage.append(self.layers[shape.layer])
        surfaces = np.array([*number, -1])  # the last entry is what -1 finds: nothing there
        planes, stages = np.array([*plane, np.nan]), np.array([*stage, -1])
        found: list[tuple[list[Segment], list[Segment], list[Segment]]] = [([], [], []) for _ in self.layers]
        framed = np.pad(self._top, 1, constant_values=-1)
        for upright, grid in ((True, framed[1:-1, :]), (False, framed[:, 1:-1].T)):
            a, b = grid[:, :-1], grid[:, 1:]
            if not a.size:
                continue
            differ = surfaces[a] != surfaces[b]
            step = np.abs(planes[a] - planes[b])
            weight = np.where(np.isnan(step), 0, np.where(step > _STEP, 1, 2))
            label = np.where(differ, weight + 3 * np.maximum(stages[a], stages[b]), -1)
            across, along = (self._xs, self._ys) if upright else (self._ys, self._xs)
            line, start, end, value = _runs(label.T)
            at, p, q = across[line], along[start], along[end]
            segments = np.stack((at, p, at, q) if upright else (p, at, q, at), axis=1)
            for own in np.unique(value).tolist():
                layer, kind = divmod(own, 3)
                found[layer][kind].extend(map(tuple, segments[value == own].tolist()))
        return [Edges(tuple(outer), tuple(deep), tuple(joint)) for outer, deep, joint in found]

    def shadows(self) -> list[list[NDArray[np.float64]]]:
        """The polygons in shade on the skin, layer by layer, each clipped to the surface it falls on.

        They overlap; fill them with the non-zero rule. All run the same way round.
        """
        result: list[list[NDArray[np.float64]]] = [[] for _ in self.layers]
        receivers = self._receivers
        boxes, odd = self._casters
        if not len(receivers.rects):
            return result
        for where, which, starts, ends in self._met(boxes):
            swept = _swept_boxes(boxes.bounds[which], starts, ends)
            layers = receivers.layers[where].tolist()
            for layer, polygon in zip(layers, clip_all(swept, receivers.rects[where]), strict=True):
                if len(polygon) > 2:
                    result[layer].append(polygon)
        for found in self._met(_around(odd)):
            for n, k, start, end in zip(*(own.tolist() for own in found), strict=True):
                left, low, right, high = receivers.rects[n].tolist()
                cut = clip(_swept(odd[k], start, end), (left, low, right, high))
                if len(cut) > 2:
                    result[receivers.layers[n]].append(np.array(cut))
        return result

    def _met(self, boxes: _Boxes) -> Iterator[tuple[NDArray[Any], ...]]:
        """Which receivers the shadows of boxes may fall on, some at a time.

        Of each such pair: the receiver, the box, and how far along the light its shadow begins and ends, metres.
        """
        receivers = self._receivers
        rects, planes = receivers.rects, receivers.planes[:, None]
        within = receivers.home[boxes.of]  # of -1, which is no solid, it has -1 too
        left, low, right, high = boxes.bounds.T
        step = max(1, _AT_ONCE // max(1, len(within)))
        for first in range(0, len(rects) if len(within) else 0, step):
            rows = slice(first, first + step)
            reach = boxes.far - planes[rows]
            x0, y0, x1, y1 = rects[rows].T[:, :, None]
            hit = (reach > 1e-4) & (left < x1) & (right + reach * LIGHT[0] > x0)
            hit &= (low - reach * LIGHT[1] < y1) & (high > y0)
            hit &= within != np.arange(first, first + len(reach))[:, None]  # nothing throws shadow on itself
            where, which = divmod(np.flatnonzero(hit), len(within))
            ends = reach[where, which]
            where += first
            yield where, which, np.maximum(boxes.near[which] - planes[where, 0], 0.0), ends

    @cached_property
    def _receivers(self) -> _Receivers:
        """What takes shadow, neighbours at one depth merged: side by side first, then one above the other."""
        known: dict[tuple[int, float], int] = {}
        group = np.array(
            [
                known.setdefault((self.layers[solid.shape.layer], round(solid.plane, 4)), len(known))
                for solid in self._skin
            ],
            dtype=int,
        )
        first, last, row = _joined(group, self._sides, 0)
        sides = np.concatenate([self._sides[first, :2], self._sides[last, 2:]], axis=1)
        low, high, whole = _joined(group[first], sides, 1)
        home = np.full(max((solid.index for solid in self._skin), default=-1) + 2, -1)
        home[[solid.index for solid in self._skin]] = whole[row]
        layers, planes = np.array([*known]).reshape(-1, 2).T
        own = group[first][low]
        rects = np.concatenate([self._rects[first[low], :2], self._rects[last[high], 2:]], axis=1)
        return _Receivers(layers[own].astype(int), planes[own], rects, home)

    @cached_property
    def _casters(self) -> tuple[_Boxes, list[_Caster]]:
        """What throws shadow: boxes, which are many, and all else."""
        made: list[_Boxes] = []
        odd: list[_Caster] = []
        planes = np.array([*(round(solid.plane, 4) for solid in self._skin), np.nan])
        stands = np.array([solid.geometry.name not in ("cornice", "ledge") for solid in self._skin] + [False])
        heights = np.where(stands, planes, np.nan)[self._top]
        levels = np.unique(heights[~np.isnan(heights)])
        xs, ys = self._xs, self._ys
        if len(levels) > 1:  # nothing lies behind the lowest
            label = np.where(heights > levels[0], np.searchsorted(levels, heights), -1)
            row, start, end, height = _runs(label)
            sides = np.stack([start, row, end, row + 1], axis=1)
            first, last, _ = _joined(height, sides, 1)
            bounds = np.stack([xs[start[first]], ys[row[first]], xs[end[first]], ys[row[last] + 1]], axis=1)
            ones = np.ones(len(bounds))
            near, far = levels[0] * ones, levels[height[first]]
            made.append(_Boxes(bounds, near, far, np.full(len(bounds), -1)))
        alike: dict[tuple[object, ...], list[Solid]] = defaultdict(list)
        for solid in self.scene.solids:
            if not solid.geometry.full or solid.geometry.name != "box":
                # Shapes of one kind and size have the very same parts.
                key = (id(solid.parts), solid.geometry.name, solid.geometry.full, solid.face, solid.plane)
                alike[key].append(solid)
        for solids in alike.values():
            plain: list[_Caster] = []
            for own in _of_parts(solids[0]):
                if own.box:
                    plain.append(own)
                else:
                    odd += [_moved(own, solid) for solid in solids]
            if plain:
                made.append(_standing(plain, solids))
        empty = _Boxes(np.empty((0, 4)), np.empty(0), np.empty(0), np.empty(0, int))
        return _Boxes(*map(np.concatenate, zip(empty, *made, strict=True))), odd


def _around(casters: Sequence[_Caster]) -> _Boxes:
    """The boxes around casters."""
    bounds = np.array([_bounds(own.points) for own in casters]).reshape(-1, 4)
    near, far = np.array([(own.z0, own.z1) for own in casters]).reshape(-1, 2).T
    return _Boxes(
        bounds, near, far, np.array([-1 if own.of is None else own.of for own in casters], dtype=int)
    )


def _standing(casters: Sequence[_Caster], solids: Sequence[Solid]) -> _Boxes:
    """Boxes that are told from a solid's corner, at the place of each of some solids."""
    around = _around(casters)
    bounds = around.bounds + np.array([solid.rect[:2] * 2 for solid in solids])[:, None]
    near, far = np.tile(around.near, len(solids)), np.tile(around.far, len(solids))
    of = [-1 if own.of is None else solid.index for solid in solids for own in casters]
    return _Boxes(bounds.reshape(-1, 4), near, far, np.array(of))


def _moved(caster: _Caster, solid: Solid) -> _Caster:
    """A caster of a solid's parts, which is told from the solid's corner, where it stands."""
    left, bottom = solid.rect[:2]
    return _Caster(
        tuple([(x + left, y + bottom) for x, y in caster.points]),
        caster.z0,
        caster.z1,
        None if caster.of is None else solid.index,
        caster.box,
        tuple([(x + left, y + bottom, z) for x, y, z in caster.body]),
    )


def _of_parts(solid: Solid) -> Iterable[_Caster]:
    """What throws shadow of a solid's parts, from the solid's lower left corner."""
    full = solid.geometry.full
    least = solid.plane - solid.face + 0.03 if full else -1e9
    for part in solid.parts:
        if front(part) <= least and not isinstance(part, Moulding):
            continue
        match part:
            case Block():
                if (
                    min(part.x1 - part.x0, part.y1 - part.y0) < 0.028
                ):  # glazing bars and balusters: too thin to tell
                    continue
                z0, z1, points = part.z0, part.z1, outline(part)
            case Moulding():
                zs = [z for _, z in part.profile]
                most = max(zs) - 0.15 * (max(zs) - min(zs)) - 1e-9
                for (y0, za), (y1, zb) in zip(part.profile, part.profile[1:], strict=False):
                    if y1 > y0 and min(za, zb) >= most:
                        band = _corners((part.x0, y0, part.x1, y1))
                        yield _Caster(band, solid.face + part.z0, solid.face + max(za, zb), solid.index)
                continue
            case Turned():
                radius = max(r for _, r in part.profile[len(part.profile) // 3 :])
                z0, z1 = part.cz - 0.6 * radius, part.cz + 0.6 * radius
                points = _corners(
                    (part.cx - radius, part.profile[0][0], part.cx + radius, part.profile[-1][0])
                )
            case Prism() if not full and part.slot in ("body", "gable"):
                for piece in _convex(part.points):
                    yield _Caster(tuple(piece), solid.face + part.z0, solid.face + part.z1, None, False)
                continue
            case Prism() if solid.geometry.modelled and part.slot in ("trim", "coping", "stripe", "roof"):
                z0, z1, points = part.z0, part.z1, tuple(hull(part.points))
            case Loft() | Polyhedron() if solid.geometry.modelled and not full and not solid.geometry.roof:
                spots = tuple((x, y, z + solid.face) for x, y, z in part.points)
                zs = [z for _, _, z in spots]
                if len(part.faces) > _MANY:  # a body that may have hollows and holes
                    for piece in pieces([part]):
                        yield _Caster(tuple(piece), (min(zs) + max(zs)) / 2, max(zs), None, False)
                    continue
                yield _Caster(tuple((x, y) for x, y, _ in spots), min(zs), max(zs), None, False, spots)
                continue
            case _:
                continue
        yield _Caster(
            tuple(points),
            solid.face + z0,
            solid.face + z1,
            solid.index if full else None,
            not isinstance(part, Prism),
        )


def _swept(caster: _Caster, a: float, b: float) -> list[Point]:
    """The shadow's outline, counter-clockwise, between the caster moved `a` and `b` metres along the light.

    Of boxes, which are many, `_swept_boxes` tells it.
    """
    if caster.body:
        plane = caster.z1 - b
        return hull(
            (x + t * LIGHT[0], y - t * LIGHT[1]) for x, y, z in caster.body for t in (max(z - plane, 0.0),)
        )
    return hull((x + t * LIGHT[0], y - t * LIGHT[1]) for t in (a, b) for x, y in caster.points)


def _swept_boxes(
    boxes: NDArray[np.float64], a: NDArray[np.float64], b: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The same of boxes x0, y0, x1, y1, each with its own `a` and `b`: six corners of each."""
    x0, y0, x1, y1 = boxes.T
    ax, ay, bx, by = a * LIGHT[0], a * LIGHT[1], b * LIGHT[0], b * LIGHT[1]
    across = np.stack([x0 + ax, x0 + bx, x1 + bx, x1 + bx, x1 + ax, x0 + ax], axis=1)
    up = np.stack([y0 - ay, y0 - by, y0 - by, y1 - by, y1 - ay, y1 - ay], axis=1)
    return np.stack([across, up], axis=2)


def _convex(points: Sequence[Point]) -> Iterable[Sequence[Point]]:
    """A polygon as convex pieces: itself, or its triangles."""
    if len(hull(points)) == len(points):
        return [points]
    from manifold3d import triangulate

    return [[points[i] for i in corners] for corners in triangulate([np.array(points)]).tolist()]


def _merged(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Sorted, and those within a micrometre taken as one."""
    ordered = np.unique(values)
    return ordered[np.insert(np.diff(ordered) > 1e-6, 0, True)] if len(ordered) else ordered


def _runs(labels: NDArray[np.int64]) -> tuple[NDArray[np.int64], ...]:
    """Row, start, end and value of each run of equal labels in the rows, in order; negative ones have none."""
    many = labels.shape[1]
    begins = np.ones(labels.shape, bool)
    begins[:, 1:] = labels[:, 1:] != labels[:, :-1]
    starts = np.flatnonzero(begins)
    ends = np.append(starts[1:], labels.size)
    values = labels.ravel()[starts]
    kept = values >= 0
    starts, ends, values = starts[kept], ends[kept], values[kept]
    rows = starts // many
    return rows, starts - rows * many, ends - rows * many, values


def _joined(
    groups: NDArray[np.int64], sides: NDArray[np.int64], axis: int
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Rectangles of one group that share a whole side made one, along an axis.

    Of `sides`, left, low, right, high as lines of a grid. What comes of them is in order: by group, the two other
    sides, and place. Of each: the first and the last rectangle in it; and of each rectangle which one it is part of.
    """
    low, high = sides[:, 1 - axis], sides[:, 3 - axis]
    order = np.lexsort((sides[:, axis], high, low, groups))
    one, group = sides[order], groups[order]
    goes_on = (one[1:, axis] == one[:-1, axis + 2]) & (group[1:] == group[:-1])
    goes_on &= (low[order][1:] == low[order][:-1]) & (high[order][1:] == high[order][:-1])
    begins = np.append(True, ~goes_on)[: len(order)]
    part = np.empty(len(order), dtype=int)
    part[order] = np.cumsum(begins) - 1
    return order[begins], order[np.append(begins[1:], True)[: len(order)]], part


def _corners(rect: Rect) -> tuple[Point, ...]:
    left, bottom, right, top = rect
    return ((left, bottom), (right, bottom), (right, top), (left, top))


def _bounds(points: Sequence[Point]) -> Rect:
    xs, ys = [x for x, _ in points], [y for _, y in points]
    return min(xs), min(ys), max(xs), max(ys)
