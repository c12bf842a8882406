"""Where one sees a town from afar: most of the picture is houses that stand close together."""

from __future__ import annotations

import numpy as np

from ..pipeline.viewpoint import Viewpoint
from .chance import Floats
from .plan import Plan
from .rings import areas

__all__ = ["from_afar", "town_share"]

_ANGLE = 52.0
"""Of the picture from side to side, degrees."""

_CELL = 50.0
"""Metres of each side of a cell in which what is built is summed up."""

_SPOTS, _AROUND = 40, 450.0
"""So many of the densest cells are looked at, so near to the middle of the densest part, metres."""

_HALL = 600.0
"""A building counts as one that is so large at the most, square metres: halls are no town."""

_WAYS = (
    (0.62, 0.785),
    (-0.785, 0.62),
    (-0.62, -0.785),
    (0.785, -0.62),
    (0.995, 0.1),
    (-0.1, 0.995),
    (-0.995, -0.1),
    (0.1, -0.995),
)
"""Directions in which one looks, east and north."""

_NEARER = (1.0, 0.6, 0.36)
"""How far away one stands, as parts of the furthest."""

_CLOSE = 0.3
"""The part of the ground that is built on where houses stand close together."""

_FAR = 2500.0
"""What is further is in the haze, metres."""

_ACROSS, _DOWN = 16, 12
"""The picture is judged by so many points."""


def from_afar(plan: Plan, middle: Floats, reach: float) -> Viewpoint:
    """The viewpoint, of some over the densest part of a town, whose picture has most town in it.

    `middle`: of that part; `reach`: how far the town reaches around it, metres; from so far one looks at the most.
    """
    built, low = _built(plan)
    cells = low + (np.indices(built.shape).reshape(2, -1).T + 0.5) * _CELL
    near = np.abs(cells - middle).max(axis=1) < _AROUND
    best = np.argsort(-np.where(near, np.round(built, 6).ravel(), 0.0), kind="stable")[:_SPOTS]
    spots = cells[best]
    places = [
        (way[1], _place(spot, way, part * reach)) for part in _NEARER for spot in spots for way in _WAYS
    ]
    # From further away there is more to be seen, and with the sun at one's back more of it.
    worth = [
        round(_share(built, low, place), 2) + 0.0012 * place.eye[1] + 0.04 * north for north, place in places
    ]
    return places[int(np.argmax(np.round(worth, 6)))][1]


def town_share(plan: Plan, place: Viewpoint) -> float:
    """How much of a picture is town, 0 to 1: ground counts whole where houses stand close together, and sky nothing."""
    return _share(*_built(plan), place)


def _place(spot: Floats, way: tuple[float, float], away: float) -> Viewpoint:
    """So far before a spot, and so high that the roofs behind it are seen, too."""
    (x, y), (east, north) = spot.tolist(), way
    eye = (round(x - 1.21 * away * east, 3), round(12.0 + 0.42 * away, 3), round(-y + 1.21 * away * north, 3))
    aim = (x + 0.15 * away * east, 0.0, -y - 0.15 * away * north)
    return Viewpoint.towards(eye, aim, _ANGLE)


def _built(plan: Plan) -> tuple[Floats, Floats]:
    """The part that is built on of the nine cells around each of a net (c, r), and the net's lower left corner."""
    building = plan.building
    begin = np.flatnonzero(np.append(True, building[1:] != building[:-1]))
    low, high = (own.reduceat(plan.corners, begin, axis=0) for own in (np.minimum, np.maximum))
    size = np.zeros(len(plan))
    np.add.at(size, plan.ring_of, areas(plan.corners, plan.rings))
    cell = np.floor((low + high) / 2 / _CELL).astype(np.int64)
    first = cell.min(axis=0) - 1
    table = np.zeros(cell.max(axis=0) - first + 2)
    np.add.at(table, tuple((cell - first).T), np.minimum(np.rint(size), _HALL))
    near = sum(np.roll(table, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1))
    return np.asarray(near) / (9 * _CELL * _CELL), first * _CELL


def _share(built: Floats, low: Floats, place: Viewpoint) -> float:
    seen = place.frustum((4, 3))
    left, bottom, right, top = seen.window
    x, y = (
        start + (end - start) * (np.arange(n) + 0.5) / n
        for start, end, n in ((left, right, _ACROSS), (bottom, top, _DOWN))
    )
    rays = (seen.ahead + y[:, None, None] * seen.up + x[:, None] * seen.right).reshape(-1, 3)
    falls = np.maximum(-rays[:, 1], 1e-6)
    away = seen.eye[1] / falls * np.sqrt(rays[:, 0] ** 2 + rays[:, 2] ** 2)
    spot = seen.eye + rays * (seen.eye[1] / falls)[:, None]
    cell = np.floor((spot[:, ::2] * (1, -1) - low) / _CELL)
    inside = (away < _FAR) & (cell >= 0).all(axis=1) & (cell < built.shape).all(axis=1)
    own = built[tuple(cell[inside].astype(np.int64).T)]
    return float(np.minimum(own / _CLOSE, 1.0).sum()) / len(rays)
