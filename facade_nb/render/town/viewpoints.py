"""Where one looks at a town from: afar, in a street, close to a house (the texture paper's Figure 10)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import atan2, degrees, hypot
from typing import Literal

import numpy as np
import shapely

from ..pipeline.viewpoint import Viewpoint
from .overview import from_afar
from .plan import STREET, Plan
from .roads import HALF, LANE
from .things import LAMP, PERSON

__all__ = ["VIEWS", "View", "viewpoint"]

View = Literal["distance", "street", "close-up"]
VIEWS: tuple[View, ...] = ("distance", "street", "close-up")
"""Names of the views."""

_EYE = 1.65
"""Height of eyes, metres."""

_ROOM = 3.6
"""Metres from the middle of a car to the way that one looks: half its length, and room to see past it."""

_CELL = 160.0
_CANDIDATES = 60


def viewpoint(plan: Plan, view: View) -> Viewpoint:
    """Where one stands for a view. It depends on the plan alone.

    Raises
    ------
    ValueError
        For an unknown view, or a town without buildings.
    """
    if view not in VIEWS:
        raise ValueError(f"view: expected one of {', '.join(VIEWS)}; found {view!r}")
    if not len(plan):
        raise ValueError("there is no building to be looked at")
    spot, reach = _densest(plan)
    if view == "distance":
        return from_afar(plan, spot, max(reach, 90.0))
    if view == "street" and (found := _on_road(plan, spot)) is not None:
        return found
    corner, along, out, free, across = _street(plan, spot)
    if view == "street":
        wide = min(0.45 * across, 5.5)
        asides = (wide, 0.45 * across, 0.5 * across, 0.3 * across)
        choice = [(aside, back) for back in (4.0, 7.0, 1.0, 10.0) for aside in asides]
        aside, back = _clear(plan, choice, corner, out, -along, along * 9.0)
        eye_at = corner + out * aside - along * back
        aim = corner + along * min(free, 40.0) + out * 0.55 * aside
        dx, dy = aim - eye_at
        yaw = degrees(atan2(dx, dy))
        return Viewpoint((float(eye_at[0]), _EYE, float(-eye_at[1])), yaw, 7.0, 66.0)
    choice = [(away, side) for side in (1.0, 4.0, -2.0, 7.0) for away in (min(0.7 * across, 6.5), 3.4, 2.6)]
    away, side = _clear(plan, choice, corner, out, along, along * 2.6 - out * 3.0)
    eye_at = corner + along * side + out * away
    aim = corner + along * (side + 2.6)
    return Viewpoint.towards(
        (float(eye_at[0]), _EYE, float(-eye_at[1])), (float(aim[0]), 2.6, float(-aim[1])), 58.0
    )


def _clear(
    plan: Plan,
    choice: Sequence[tuple[float, float]],
    start: np.ndarray,
    out: np.ndarray,
    along: np.ndarray,
    way: np.ndarray,
) -> tuple[float, float]:
    """How far out of a wall and along it one stands: the first of a choice with nobody in the way, else the freest."""
    best = -1.0, choice[0]
    kind = plan.things.kind
    others = [(plan.cars.at, 0.0), (plan.things.at[kind >= PERSON], 1.5), (plan.things.at[kind == LAMP], 2.8)]
    for far, side in choice:
        eye = start + out * far + along * side
        line = shapely.LineString([eye, eye + way])
        near = _ROOM
        for at, less in others:
            if len(at):
                near = min(near, round(float(shapely.distance(line, shapely.points(at)).min()) + less, 3))
        if near > best[0]:
            best = near, (far, side)
    return best[1]


def _middles(plan: Plan) -> np.ndarray:
    begin = np.flatnonzero(np.append(True, plan.building[1:] != plan.building[:-1]))
    low = np.minimum.reduceat(plan.corners, begin, axis=0)
    return np.asarray((low + np.maximum.reduceat(plan.corners, begin, axis=0)) / 2)


def _densest(plan: Plan) -> tuple[np.ndarray, float]:
    """The middle of the part with the most storeys that people live in, and how far the town reaches around it."""
    middles = _middles(plan)
    cell = np.floor(middles / _CELL).astype(np.int64)
    low = cell.min(axis=0)
    table = np.zeros(cell.max(axis=0) - low + 3)
    np.add.at(table, tuple((cell - low + 1).T), np.where(plan.kind <= 1, plan.storeys, 0))
    around = sum(np.roll(table, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1)) + table
    best = np.unravel_index(int(np.argmax(around)), table.shape)
    spot = (np.array(best) + low - 1 + 0.5) * _CELL
    near = np.abs(middles - spot).max(axis=1) < 2 * _CELL
    reach = float(np.ptp(middles[near], axis=0).max()) if near.any() else 0.0
    return spot, min(max(reach, 40.0), 420.0)


def _street(plan: Plan, spot: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, float, float]:
    """A corner of a front, its direction and outside, how far the street is free along it and across it.

    Of the fronts nearest to a spot it is the one before which most is free, as far as that counts, and houses are high.
    """
    tree = shapely.STRtree(_outlines(plan))
    best: tuple[float, tuple[np.ndarray, np.ndarray, np.ndarray, float, float]] | None = None
    for building, edge in _fronts(plan, spot):
        a, b = plan.corners[edge], plan.corners[plan.following[edge]]
        wide = float(np.hypot(*(b - a)))
        along = (b - a) / wide
        out = np.array([along[1], -along[0]])
        across = _free(tree, (a + b) / 2, out, 40.0)
        aside = min(0.45 * across, 5.5)
        free = _free(tree, a + out * aside - along * 4.0, along, 130.0)
        sunny = 18.0 * max(-float(out[1]), 0.0)  # it looks south
        worth = round(min(free, 110.0) + 3.0 * float(plan.eaves[building]) - abs(across - 15.0) + sunny, 1)
        if across > 5.0 and (best is None or worth > best[0]):
            best = worth, (a, along, out, free, across)
    if best is None:
        a, b = plan.corners[0], plan.corners[plan.following[0]]
        along = (b - a) / max(hypot(*(b - a)), 1e-9)
        return a, along, np.array([along[1], -along[0]]), 20.0, 12.0
    return best[1]


def _on_road(plan: Plan, spot: np.ndarray) -> Viewpoint | None:
    """On the right side of a street near a spot, looking along it: where it goes on furthest, most houses beside it.

    None: there is no street, or none as long as that.
    """
    lines = plan.roads.lines()
    some = np.flatnonzero((plan.roads.kind < LANE) & (shapely.length(lines) > 45.0))
    if not len(some):
        return None
    far = np.rint(shapely.distance(shapely.Point(*spot), lines[some]))
    some = some[np.lexsort((some, far))][:_CANDIDATES]
    tree = shapely.STRtree(_outlines(plan))
    best: tuple[float, np.ndarray, np.ndarray] | None = None
    for road in some.tolist():
        for line in (lines[road], shapely.reverse(lines[road])):
            here, there = (
                shapely.get_coordinates(shapely.line_interpolate_point(line, at))[0] for at in (9.0, 42.0)
            )
            along = (there - here) / max(hypot(*(there - here)), 1e-9)
            right = np.array([along[1], -along[0]])
            eye = here + right * (HALF[plan.roads.kind[road]] - 0.9)
            free = _free(tree, eye, along, 120.0)
            ahead = shapely.LineString([here, here + 55.0 * along])
            beside = len(tree.query(ahead, predicate="dwithin", distance=20.0))
            sunny = 10.0 * max(-float(along[1]), 0.0)  # what looks south is beside one's back
            worth = round(min(free, 90.0) + 7.0 * min(beside, 12) - sunny, 1)
            if free > 12.0 and (best is None or worth > best[0]):
                best = worth, eye, along
    if best is None:
        return None
    _, eye, along = best
    right = np.array([along[1], -along[0]])
    choice = [(aside, back) for back in (0.0, 4.0, -4.0) for aside in (0.0, -0.8, 1.4, -1.8)]
    aside, back = _clear(plan, choice, eye, right, -along, along * 9.0)
    eye = eye + right * aside - along * back
    return Viewpoint((float(eye[0]), _EYE, float(-eye[1])), degrees(atan2(*along)), 4.0, 66.0)


def _fronts(plan: Plan, spot: np.ndarray) -> Iterator[tuple[int, int]]:
    """Buildings near a spot with an edge on the street, the one with the door if it has one."""
    far = np.rint(np.hypot(*(_middles(plan) - spot).T))
    order = np.lexsort((np.arange(len(far)), far))
    given = 0
    for building in order.tolist():
        edge = int(plan.entrance[building])
        if edge >= 0 and plan.role[edge] == STREET:
            yield building, edge
            given += 1
            if given == _CANDIDATES:
                return


def _outlines(plan: Plan) -> list[shapely.Polygon]:
    """Outer rings."""
    rings = [k for k in range(len(plan.ring_of)) if not plan.holes[k]]
    return [shapely.Polygon(plan.corners[plan.rings[k] : plan.rings[k + 1]]) for k in rings]


def _free(tree: shapely.STRtree, start: np.ndarray, way: np.ndarray, far: float) -> float:
    """How far one can go from a point in a direction until there is a house, metres."""
    ray = shapely.LineString([start + 0.2 * way, start + far * way])
    hits = tree.query(ray, predicate="intersects")
    if not len(hits):
        return far
    eye = shapely.Point(*(start + 0.2 * way))
    parts = shapely.intersection(tree.geometries[hits], ray)
    return round(float(shapely.distance(parts, eye).min()), 2)
