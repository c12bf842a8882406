"""What stands in the roof over all opens it, as far back as it goes, and nothing else of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from facade_nb import Building
from facade_nb.building import Roof
from facade_nb.building.bodies import Frame, bodies_of
from facade_nb.building.openings import Opening, opened
from facade_nb.building.roofs import roofing
from facade_nb.building.scene import over_all
from facade_nb.design import Design

WALL = {
    "format": "facade-nb/design/1",
    "name": "Dormers",
    "canvas": {"width": 8.0, "height": 7.5},
    "symbols": {"A": {"size": 8.0}, "P": {"size": 4.5}, "R": {"size": 3.0}}
    | {"C": {"size": 3.0}, "E": {"size": 2.0}, "H": {"size": 1.8}, "S": {"size": 1.2}},
    "patterns": {"whole": "A", "up": "PR", "gaps": "CEC", "high": "PHS"},
    "layers": [
        {"name": "wall", "x": {"pattern": "whole"}, "y": {"pattern": "up"}},
        {"name": "dormers", "x": {"pattern": "gaps", "group": "d", "mask": ["E"]},
         "y": {"pattern": "high", "group": "d", "mask": ["H"]}},
    ],
    "shapes": {
        "A P": {"kind": "wall", "thickness": 0.3},
        "A R": {"kind": "roof", "geometry": "pitched"},
        "E H": {"kind": "dormer", "geometry": "dormer"},
    },
}  # fmt: skip


def on(triangles: np.ndarray, count: int, seed: int) -> np.ndarray:
    """Places on triangles, many on large ones."""
    rng = np.random.default_rng(seed)
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    k = rng.choice(len(triangles), count, p=areas / areas.sum())
    u, v = rng.random((2, count, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return a[k] + u * (b - a)[k] + v * (c - a)[k]


def area(triangles: np.ndarray) -> float:
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


@pytest.mark.parametrize("geometry", ["dormer", "window"])
def test_no_tiles_are_where_a_dormer_stands(geometry):
    shapes = WALL["shapes"] | {"E H": {"kind": "dormer", "geometry": geometry, "thickness": 0.2}}
    design = Design.from_dict(WALL | {"shapes": shapes})
    building = Building.rectangle(8.0, 7.0, [design, None, None, None], roof=Roof("hip", 3.0, overhang=0.4))
    layout = building.solve()
    (shape,) = (own for own in layout.faces[0].shown.shapes if own.kind == "dormer")
    left, bottom, right, _ = shape.rect
    assert layout.eaves == bottom == 4.5

    def before(triangles: np.ndarray) -> int:
        """Places in the middle of the dormer, up to its own roof, and before it."""
        frame = Frame.of(layout.faces[0])
        x, y, z = ((on(triangles, 60_000, 3) - frame.origin) @ frame.axes.T).T
        inside = (x > left + 0.2) & (x < right - 0.2) & (y > bottom + 0.02) & (y < bottom + 1.0)
        return int((inside & (z > -2.0)).sum())

    whole = roofing(layout).positions
    cut = np.concatenate(
        [mesh.vertices[mesh.faces] for name, mesh, _ in over_all(layout, 0.3) if name != "body"]
    )
    assert before(whole) > 100
    assert before(cut) == 0
    assert area(whole) - 12.0 < area(cut) < area(whole) - 1.0


def test_what_is_outside_of_a_room_stays():
    rng = np.random.default_rng(8)
    normals = np.concatenate([np.eye(3), -np.eye(3)])
    room = Opening(normals, np.full(6, 0.5), np.full(3, -0.5), np.full(3, 0.5))
    triangles = rng.uniform(-1.2, 1.2, (60, 3, 3))
    rest = opened(triangles, [room])
    assert (np.abs(on(rest, 20_000, 1)) > 0.5 - 1e-6).any(axis=1).all()
    gone = np.mean((np.abs(on(triangles, 200_000, 2)) < 0.5).all(axis=1))
    assert area(rest) == pytest.approx(area(triangles) * (1 - gone), rel=0.005)
    assert area(opened(rest, [room])) == pytest.approx(area(rest))


@pytest.mark.parametrize("geometry", ["dormer", "window"])
def test_dormers_beside_a_hip_are_as_high_as_the_roof_has_room(geometry):
    document = WALL | {
        "symbols": WALL["symbols"] | {"C": {"size": 0.6}},
        "patterns": WALL["patterns"] | {"gaps": "CECECEC"},
        "shapes": WALL["shapes"] | {"E H": {"kind": "dormer", "geometry": geometry, "thickness": 0.2}},
    }
    building = Building.rectangle(
        8.0, 7.0, [Design.from_dict(document), None, None, None], roof=Roof("hip", 3.5)
    )
    layout = building.solve()
    shapes = [own for own in layout.faces[0].shown.shapes if own.kind == "dormer"]
    tall = [own.rect[3] - own.rect[1] for own in shapes]
    assert (
        tall[0] == pytest.approx(tall[2], abs=2e-3)
        and 0.3 < tall[0] < 1.5
        and tall[1] == pytest.approx(1.8, abs=0.2)
    )
    for body in bodies_of(layout, layout.faces[0], 0.3):  # the hips rise by a metre in a metre
        points = body.mesh.vertices
        above = points[(points[:, 1] > layout.eaves + 0.01)]
        assert (above[:, 1] - layout.eaves <= np.minimum(above[:, 0], 8.0 - above[:, 0]) + 0.01).all()
    assert sum('shapes["E H"] in layer' in told for told in layout.warnings) == 2
    flat = replace(building, roof=Roof("flat")).solve()
    assert not any(own.kind == "dormer" for own in flat.faces[0].shown.shapes)
    assert all("left out" in told for told in flat.warnings if "dormers" in told)
