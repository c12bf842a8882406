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
            for line in range(label.shape[1]):
                for start, end, value in _runs(label[:, line]):
                    layer, kind = divmod(value, 3)
                    at, p, q = float(across[line]), float(along[start]), float(along[end])
                    found[layer][kind].append((at, p, at, q) if upright else (p, at, q, at))
        return [Edges(tuple(outer), tuple(deep), tuple(joint)) for outer, deep, joint in found]

    def shadows(self) -> list[list[NDArray[np.float64]]]:
        """The polygons in shade on the skin, layer by layer, each clipped to the surface it falls on.

        They overlap; fill them with the non-zero rule. All run the same way round.
        """
        result: list[list[NDArray[np.float64]]] = [[] for _ in self.layers]
        receivers = self._receivers
        boxes, odd = self._casters
        if not receivers:
            return result
        rects = np.array([rect for _, _, rect, _ in receivers])
        for where, which, starts, ends in self._met(boxes):
            swept = _swept_boxes(boxes.bounds[which], starts, ends)
            for n, polygon in zip(where.tolist(), clip_all(swept, rects[where]), strict=True):
                if len(polygon) > 2:
                    result[receivers[n][0]].append(polygon)
        for found in self._met(_around(odd)):
            for n, k, start, end in zip(*(own.tolist() for own in found), strict=True):
                layer, _, rect, _ = receivers[n]
                cut = clip(_swept(odd[k], start, end), rect)
                if len(cut) > 2:
                    result[layer].append(np.array(cut))
        return result

    def _met(self, boxes: _Boxes) -> Iterator[tuple[NDArray[Any], ...]]:
        """Which receivers the shadows of boxes may fall on, some at a time.

        Of each such pair: the receiver, the box, and how far along the light its shadow begins and ends, metres.
        """
        receivers = self._receivers
        planes = np.array([plane for _, plane, _, _ in receivers])[:, None]
        rects = np.array([rect for _, _, rect, _ in receivers])
        home = {index: n for n, (_, _, _, members) in enumerate(receivers) for index in members}
        within = np.array([home.get(index, -1) for index in boxes.of.tolist()], dtype=int)
        left, low, right, high = boxes.bounds.T
        step = max(1, _AT_ONCE // max(1, len(within)))
        for first in range(0, len(receivers) if len(within) else 0, step):
            rows = slice(first, first + step)
            reach = boxes.far - planes[rows]
            x0, y0, x1, y1 = rects[rows].T[:, :, None]
            hit = (reach > 1e-4) & (left < x1) & (right + reach * LIGHT[0] > x0)
            hit &= (low - reach * LIGHT[1] < y1) & (high > y0)
            hit &= within != np.arange(first, first + len(reach))[:, None]  # nothing throws shadow on itself
            where, which = np.nonzero(hit)
            ends = reach[where, which]
            where += first
            yield where, which, np.maximum(boxes.near[which] - planes[where, 0], 0.0), ends

    @cached_property
    def _receivers(self) -> list[tuple[int, float, Rect, frozenset[int]]]:
        """Layer, plane, rectangle and solids of what takes shadow, neighbours at one depth merged."""
        groups: dict[tuple[int, float], list[Solid]] = defaultdict(list)
        for solid in self._skin:
            groups[self.layers[solid.shape.layer], round(solid.plane, 4)].append(solid)
        return [
            (layer, plane, rect, frozenset(members))
            for (layer, plane), solids in groups.items()
            for rect, members in _joined([(solid.rect, [solid.index]) for solid in solids])
        ]

    @cached_property
    def _casters(self) -> tuple[_Boxes, list[_Caster]]:
        """What throws shadow: boxes, which are many, and all else."""
        made: list[_Boxes] = []
        odd: list[_Caster] = []
        planes = np.array([*(round(solid.plane, 4) for solid in self._skin), np.nan])
        stands = np.array([solid.geometry.name not in ("cornice", "ledge") for solid in self._skin] + [False])
        heights = np.where(stands, planes, np.nan)[self._top]
        levels = np.unique(heights[~np.isnan(heights)])
        xs, ys = self._xs.tolist(), self._ys.tolist()
        for level in levels[1:]:  # nothing lies behind the lowest
            rects: list[tuple[Rect, list[int]]] = []
            # Its runs along all rows, which end where the row does.
            turns = np.diff(np.pad(heights == level, ((0, 0), (1, 1))).astype(np.int8), axis=1)
            starts, ends = np.nonzero(turns > 0), np.nonzero(turns < 0)
            for row, start, end in zip(*(own.tolist() for own in (*starts, ends[1])), strict=True):
                rects.append(((xs[start], ys[row], xs[end], ys[row + 1]), []))
            joined = np.array([rect for rect, _ in _joined(rects)])
            ones = np.ones(len(joined))
            made.append(_Boxes(joined, levels[0] * ones, level * ones, np.full(len(joined), -1)))
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


def _runs(labels: NDArray[np.int64]) -> Iterable[tuple[int, int, int]]:
    """Start, end and value of each run of equal labels that are not negative."""
    cuts = np.flatnonzero(np.diff(labels)) + 1
    starts = [0, *cuts.tolist()]
    for start, end in zip(starts, [*starts[1:], len(labels)], strict=True):
        if end > start and labels[start] >= 0:
            yield start, end, int(labels[start])


def _joined(rects: Sequence[tuple[Rect, list[int]]]) -> list[tuple[Rect, list[int]]]:
    """Rectangles that share a whole side made one, first side by side, then one above the other."""
    for axis in (0, 1):
        lo, hi, other, end = axis, axis + 2, 1 - axis, 3 - axis
        ordered = sorted(
            [(round(rect[other], 6), round(rect[end], 6), rect[lo], n) for n, (rect, _) in enumerate(rects)]
        )
        done: list[tuple[Rect, list[int]]] = []
        for rect, members in [rects[n] for *_, n in ordered]:
            if done:
                last, before = done[-1]
                same = abs(last[other] - rect[other]) < 1e-6 and abs(last[end] - rect[end]) < 1e-6
                if same and abs(last[hi] - rect[lo]) < 1e-6:
                    joined = (last[0], last[1], rect[2], rect[3])
                    done[-1] = (joined, before + members)
                    continue
            done.append((rect, list(members)))
        rects = done
    return list(rects)


def _corners(rect: Rect) -> tuple[Point, ...]:
    left, bottom, right, top = rect
    return ((left, bottom), (right, bottom), (right, top), (left, top))


def _bounds(points: Sequence[Point]) -> Rect:
    xs, ys = [x for x, _ in points], [y for _, y in points]
    return min(xs), min(ys), max(xs), max(ys)
