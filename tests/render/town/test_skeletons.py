"""Hipped roofs over any footprint: planes that cover it once, all as steep."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from facade_nb.render.town.rings import after, offsets_of, ring_numbers
from facade_nb.render.town.skeletons import Shrunk, shrink

from .places import ell

Corners = list[tuple[float, float]]

SHAPES: dict[str, Corners] = {
    "square": [(0, 0), (8, 0), (8, 8), (0, 8)],
    "rectangle": [(0, 0), (14, 0), (14, 8), (0, 8)],
    "triangle": [(0, 0), (14, 0), (5, 9)],
    "ell": list(ell(0, 0)),
    "ell of equal arms": list(ell(0, 0, 16, 16, 7)),
    "tee": [(0, 0), (18, 0), (18, 8), (13, 8), (13, 16), (6, 16), (6, 8), (0, 8)],
    "zed": [(0, 0), (12, 0), (12, 5), (20, 5), (20, 13), (8, 13), (8, 8), (0, 8)],
    "you": [(0, 0), (20, 0), (20, 14), (13, 14), (13, 7), (7, 7), (7, 14), (0, 14)],
    "cross": [
        (5, 0), (10, 0), (10, 5), (15, 5), (15, 10), (10, 10), (10, 15), (5, 15), (5, 10), (0, 10), (0, 5), (5, 5),
    ],
    "arrow": [(0, 0), (10, 5), (20, 0), (10, 18)],
    "waist": [(0, 0), (20, 0), (12, 6), (20, 12), (0, 12), (8, 6)],
}  # fmt: skip


def shrunk(*shapes: Corners, most: float = 50.0) -> tuple[np.ndarray, np.ndarray, Shrunk]:
    corners = np.concatenate([np.array(shape, float) for shape in shapes])
    offsets = offsets_of(np.array([len(shape) for shape in shapes]))
    return corners, offsets, shrink(corners, offsets, np.full(len(shapes), most))


def check(corners: np.ndarray, offsets: np.ndarray, found: Shrunk, near: float = 0.01) -> None:
    """All of a footprint lies under one strip or top, and a strip's corners are as far from its edge as it says."""
    start, end = corners, corners[after(offsets)]
    way = end - start
    inward = np.stack([-way[:, 1], way[:, 0]], axis=1) / np.hypot(way[:, 0], way[:, 1])[:, None]
    away = ((found.strips - start[found.edge][:, None]) * inward[found.edge][:, None]).sum(axis=2)
    wanted = np.stack([found.low, found.low, found.high, found.high], axis=1)
    assert np.abs(away - wanted).max() < near
    ring = ring_numbers(offsets)[found.edge]
    points, tops, of = found.tops
    for k in range(len(offsets) - 1):
        parts = [shapely.Polygon(strip) for strip in found.strips[ring == k]]
        parts += [shapely.Polygon(points[tops[i] : tops[i + 1]]) for i in np.flatnonzero(of == k)]
        whole = shapely.Polygon(corners[offsets[k] : offsets[k + 1]])
        assert sum(part.area for part in parts) == pytest.approx(whole.area, rel=2e-3, abs=0.03)
        assert shapely.union_all([part.buffer(0.005) for part in parts]).area >= whole.area - 0.01


@pytest.mark.parametrize("name", list(SHAPES))
def test_shapes_are_covered_once(name: str) -> None:
    check(*shrunk(SHAPES[name]))
    check(*shrunk(SHAPES[name], most=1.3))


def test_convex_shapes_end_in_a_ridge() -> None:
    for name, far in (("square", 4.0), ("rectangle", 4.0), ("ell", 3.0), ("ell of equal arms", 3.5)):
        _, _, found = shrunk(SHAPES[name])
        assert found.far == pytest.approx([far], abs=0.01)
        assert not len(found.tops[2])


def test_a_limit_leaves_a_level_top() -> None:
    corners, offsets, found = shrunk(SHAPES["rectangle"], most=2.0)
    check(corners, offsets, found)
    points, tops, of = found.tops
    assert of.tolist() == [0] and shapely.Polygon(points[tops[0] : tops[1]]).area == pytest.approx(40)


def test_many_shapes_together_are_as_alone() -> None:
    _, _, together = shrunk(*SHAPES.values())
    alone = [shrunk(shape)[2] for shape in SHAPES.values()]
    assert together.far.tolist() == [float(one.far[0]) for one in alone]
    assert len(together.strips) == sum(len(one.strips) for one in alone)


def test_random_shapes_are_covered_once() -> None:
    rng = np.random.default_rng(8)
    shapes = []
    while len(shapes) < 150:
        count = int(rng.integers(3, 13))
        angles = np.sort(rng.random(count)) * 2 * np.pi
        radii = rng.uniform(4, 14, count)
        points = np.round(np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1), 3)
        polygon = shapely.Polygon(points)
        if polygon.is_valid and polygon.area > 20 and polygon.exterior.is_ccw:
            shapes.append([(float(x), float(y)) for x, y in points])
    check(*shrunk(*shapes), near=0.25)  # after many events, edges of centimetres have no sure direction
