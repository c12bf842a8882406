"""Small GeoJSON documents."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

CENTRE = (11.58, 49.95)
DEGREE = 111_000.0
EAST = DEGREE * float(np.cos(np.radians(CENTRE[1])))

Ring = Sequence[tuple[float, float]]


def place(x: float, y: float) -> list[float]:
    """Longitude and latitude of metres east and north of the centre, about."""
    return [CENTRE[0] + x / EAST, CENTRE[1] + y / DEGREE]


def ring(points: Ring) -> list[list[float]]:
    return [place(x, y) for x, y in [*points, points[0]]]


def box(x: float, y: float, w: float = 10, h: float = 8) -> Ring:
    return [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]


def feature(*rings: Ring, **tags: Any) -> dict[str, Any]:
    geometry = {"type": "Polygon", "coordinates": [ring(points) for points in rings]}
    return {"type": "Feature", "properties": {"building": "yes", **tags}, "geometry": geometry}


def collection(*features: Any) -> dict[str, Any]:
    return {"type": "FeatureCollection", "features": list(features)}


def turned(points: Ring, turns: float, about: tuple[float, float]) -> Ring:
    c, s = float(np.cos(2 * np.pi * turns)), float(np.sin(2 * np.pi * turns))
    return [
        (
            about[0] + c * (x - about[0]) - s * (y - about[1]),
            about[1] + s * (x - about[0]) + c * (y - about[1]),
        )
        for x, y in points
    ]


def ell(x: float, y: float, w: float = 14, h: float = 12, arm: float = 6) -> Ring:
    return [(x, y), (x + w, y), (x + w, y + arm), (x + arm, y + arm), (x + arm, y + h), (x, y + h)]


def mixed_geojson() -> dict[str, Any]:
    """Shapes of every kind, alone and wall to wall, turned every way, with every roof."""
    rng = np.random.default_rng(4)
    features = []
    roofs = ["flat", "gabled", "hipped", "mansard", "skillion", None]
    for i in range(12):
        for j in range(10):
            x, y, turn = 40.0 * i, 40.0 * j, float(rng.random())
            roof = roofs[int(rng.integers(len(roofs)))]
            tags = {"roof:shape": roof} if roof else {}
            w, h = (float(v) for v in rng.uniform(6, 16, 2))
            kind = int(rng.integers(7))
            if kind == 0:
                shapes: list[list[Ring]] = [[box(x, y, w, h)], [box(x + w, y + 1.5, 7, h)]]
            elif kind == 1:
                shapes = [[ell(x, y, w + 6, h + 6, 5)]]
            elif kind == 2:
                shapes = [[box(x, y, 24, 22), box(x + 7, y + 7, 9, 8)[::-1]]]
            elif kind == 3:
                corners = 5 + int(rng.integers(5))
                angles = np.sort(rng.random(corners)) + np.arange(corners)
                shapes = [[[(x + 9 * np.cos(a), y + 7 * np.sin(a)) for a in 2 * np.pi * angles / corners]]]
            elif kind == 4:
                shapes = [[[(x, y), (x + 18, y), (x + 18, y + 9), (x + 12, y + 9), (x + 12, y + 15), (x + 6, y + 15),
                            (x + 6, y + 9), (x, y + 9)]]]  # fmt: skip
            else:
                shapes = [[box(x, y, w, h)]]
            for rings in shapes:
                features.append(feature(*(turned(points, turn, (x, y)) for points in rings), **tags))
    return collection(*features)
