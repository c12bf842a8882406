"""From where a town is worth being looked at: from afar, in a street, close to a façade."""

from __future__ import annotations

from math import atan2, degrees, hypot

import numpy as np
from numpy.typing import NDArray

from ...render.pipeline.scene import Scene
from ...render.pipeline.viewpoint import Viewpoint
from ...render.town import Town
from ...render.town.plan import PARTY, Plan

__all__ = ["EYE", "edges_of", "views_of"]

EYE = 1.7
"""Metres of the eye above the ground."""

_CANDIDATES = 80
_AROUND = 350.0  # metres


def edges_of(plan: Plan) -> NDArray[np.float32]:
    """Walls (n, 4) on the ground: x and z of both ends. Outside is on the right, seen from above."""
    ends = plan.corners[plan.following]
    return (np.column_stack([plan.corners, ends]) * (1, -1, 1, -1)).astype(np.float32)


def views_of(source: Town | Scene) -> dict[str, Viewpoint]:
    """Viewpoints by name; the first is where one begins."""
    if isinstance(source, Scene):
        return {"front": _before(source)}
    west, south, east, north = source.plan.bounds
    x, z = (west + east) / 2, -(south + north) / 2
    radius = max(hypot(east - west, north - south) / 2, 30.0)
    back, high = min(0.8 * radius, 900.0), min(0.19 * radius, 200.0)
    distance = Viewpoint.towards((x, high, z + back), (x, 0.0, z - 0.25 * back))
    street, close = _in_the_street(source.plan, (x, z))
    return {"distance": distance, "street": street or distance, "close-up": close or distance}


def _before(scene: Scene) -> Viewpoint:
    low, high = scene.box
    middle = (low + high) / 2
    away = max(float(high[0] - low[0]), 1.6 * float(high[1] - low[1]), 1.0)
    eye = (float(middle[0]) + 0.25 * away, float(middle[1]), float(high[2]) + 0.95 * away)
    return Viewpoint.towards(eye, (float(middle[0]), float(middle[1]), float(high[2])))


def _in_the_street(plan: Plan, centre: tuple[float, float]) -> tuple[Viewpoint | None, Viewpoint | None]:
    """In a street with a long view, and before a door, as near the middle as may be."""
    every = edges_of(plan).astype(np.float64)
    near = (np.abs((every[:, :2] + every[:, 2:]) / 2 - centre) < _AROUND).all(axis=1)
    edges = every[near & (plan.role != PARTY)]
    doors = np.unique(plan.entrance[plan.entrance >= 0])
    if not len(doors):
        return None, None
    a, b = every[doors, :2], every[doors, 2:]
    middle = (a + b) / 2
    away = np.hypot(*(middle - centre).T)
    tall = plan.storeys[plan.building[doors]]
    best = np.argsort(away - 12.0 * np.minimum(tall, 4), kind="stable")[:_CANDIDATES]
    street: tuple[float, Viewpoint] | None = None
    close: tuple[float, Viewpoint] | None = None
    for k in best.tolist():
        along = (b[k] - a[k]) / max(hypot(*(b[k] - a[k])), 1e-9)
        out = np.array([-along[1], along[0]])  # z runs south: outside is on the left here
        eye = middle[k] + 7.0 * out
        room = _free(eye, out, edges)
        if room <= 4.0:
            continue
        for way in (along, -along):
            look = way - 0.3 * out
            free = _free(eye, look / np.hypot(*look), edges)
            if free > 4.0:
                ahead = _free(eye, way, edges)
                score = min(ahead, 140.0) + min(free, 60.0) - 3.0 * max(0.0, room - 14.0)
                if street is None or score > street[0]:
                    street = (score, _looking(eye, way - 0.04 * out, 6.0))
            near = middle[k] + 3.6 * out - 1.1 * way
            score = -abs(float(away[k]) - 60.0) + 8.0 * min(int(tall[k]), 4)
            if room > 6.0 and (close is None or score > close[0]):
                close = (score, _looking(near, -out + 0.55 * way, 12.0))
    return street and street[1], close and close[1]


def _looking(eye: NDArray[np.float64], way: NDArray[np.float64], pitch: float) -> Viewpoint:
    x, z = (round(float(value), 2) for value in eye)
    return Viewpoint((x, EYE, z), round(degrees(atan2(way[0], -way[1])), 1), pitch)


def _free(eye: NDArray[np.float64], way: NDArray[np.float64], edges: NDArray[np.float64]) -> float:
    """How far one sees from a point on the ground in a direction, metres."""
    a, d = edges[:, :2] - eye, edges[:, 2:] - edges[:, :2]
    across = way[0] * d[:, 1] - way[1] * d[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        far = (a[:, 0] * d[:, 1] - a[:, 1] * d[:, 0]) / across
        part = (a[:, 0] * way[1] - a[:, 1] * way[0]) / across
    hit = (np.abs(across) > 1e-9) & (far > 0) & (part >= 0) & (part <= 1)
    return float(far[hit].min(initial=1e4))
