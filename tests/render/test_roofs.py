"""What stands in a roof opens it: dormers, roof windows, gable walls; roofs stay closed bodies."""

from __future__ import annotations

import warnings
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
import trimesh
from shapely import MultiPoint

from facade_nb.render import GEOMETRIES, build_scene, drawing_faults
from facade_nb.render.meshing import mesh_parts
from facade_nb.render.scene import Solid
from facade_nb.solver.model.layout import Canvas, Layout, PlacedShape

ROOFS = [name for name, geometry in GEOMETRIES.items() if geometry.roof]
STANDING = [
    ("dormer", 0.0), ("dormer(roof=arch)", -0.6), ("dormer(roof=flat)", 0.0), ("window", -0.8), ("arched-window", -0.5),
    ("gable", -0.3), ("box", -0.3), ("statue", -0.4),
]  # fmt: skip


def roofed(roof: str, *shapes: tuple[str, float, tuple[float, float, float, float]]) -> tuple[Solid, ...]:
    """The solids of shapes (geometry, offset, rectangle) in a roof 10 m wide and 4 m high, which is the first."""
    base = PlacedShape("roof", "R", "T", (0, 3, 10, 7), geometry=roof, thickness=6.0)
    own = [
        replace(base, layer=f"l{k}", geometry=name, offset=offset, rect=rect, thickness=0.25)
        for k, (name, offset, rect) in enumerate(shapes)
    ]
    return build_scene(Layout("roofs", Canvas(10, 7), shapes=(base, *own))).solids


def bodies(solid: Solid) -> list[trimesh.Trimesh]:
    """Its closed bodies, each told to be one."""
    mesh = solid.mesh()
    found = []
    for k in np.unique(mesh.bodies):
        body = trimesh.Trimesh(mesh.vertices, mesh.faces[mesh.bodies == k], process=False)
        assert body.is_watertight and body.is_winding_consistent and body.volume > 0
        found.append(body)
    return found


def inside(solids: list[trimesh.Trimesh], point: tuple[float, float, float]) -> bool:
    """Whether a point lies within closed bodies: their faces wind around it."""
    for body in solids:
        a, b, c = (body.triangles[:, k] - point for k in range(3))
        la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
        top = (a * np.cross(b, c)).sum(axis=1)
        low = la * lb * lc + (a * b).sum(1) * lc + (b * c).sum(1) * la + (c * a).sum(1) * lb
        if abs(np.arctan2(top, low).sum()) > np.pi:
            return True
    return False


@pytest.mark.parametrize("roof", ROOFS)
def test_any_roof_is_opened_by_what_stands_in_it_and_stays_closed(roof: str) -> None:
    plain = sum(body.volume for body in bodies(roofed(roof)[0]))
    for name, offset in STANDING:
        whole, shape = roofed(roof, (name, offset, (4.0, 3.5, 6.0, 5.5)))
        opened = bodies(whole)
        assert sum(body.volume for body in opened) < plain - 1e-3, name
        back = min(body.bounds[0, 2] for body in bodies(shape))
        for z in np.arange(0.29, back, -0.2):  # before its back nothing of the roof is left in it
            assert not inside(opened, (5.013, 4.017, float(z))), (name, z)


def test_what_does_not_stand_in_a_roof_leaves_it_whole() -> None:
    plain = roofed("hip")[0].mesh()
    others = (
        ("dormer", 0.0, (4.0, 7.2, 6.0, 8.0)),  # above it
        ("box", 3.0, (4.0, 3.5, 6.0, 5.5)),  # reaches back to the façade, but see below
        ("awning", 0.0, (4.0, 3.5, 6.0, 5.5)),  # opens nothing
        ("hip", 0.0, (4.0, 3.5, 6.0, 5.5)),  # another roof
    )
    for k, one in enumerate(others):
        cut = roofed("hip", one)[0].cuts
        assert bool(cut) == (k == 1)
        if not cut:
            assert np.array_equal(roofed("hip", one)[0].mesh().vertices, plain.vertices)


def test_two_dormers_and_a_roof_window_at_once() -> None:
    whole, *_ = roofed(
        "hipped",
        ("dormer", 0.0, (1.5, 3.3, 3.5, 5.0)),
        ("dormer", 0.0, (6.5, 3.3, 8.5, 5.0)),
        ("window", -1.5, (4.5, 4.6, 5.5, 6.0)),
    )
    opened = bodies(whole)
    assert [inside(opened, (x, 4.0, -1.2)) for x in (2.5, 5.0, 7.5)] == [False, True, False]
    assert not inside(opened, (5.0, 5.0, -1.6)) and inside(opened, (5.0, 5.0, -2.2))


@pytest.mark.parametrize("roof", [*ROOFS, "mansard(ends=hipped)", "hipped(ridge=0.1)", "gable"])
def test_a_dormer_stands_within_its_roof_or_is_told_to_have_no_room(roof: str) -> None:
    base = PlacedShape("roof", "R", "T", (0, 3, 10, 7), geometry=roof, thickness=6.0)
    for look, left, foot in product(
        ("dormer", "dormer(roof=flat)", "window"), (0.1, 1.2, 4.3, 8.6), (3.1, 4.4)
    ):
        rect = (left, foot, left + 1.3, foot + 1.6)
        own = PlacedShape("dormers", "D", "Q", rect, kind="window", geometry=look)
        layout = Layout("roofs", Canvas(10, 7), shapes=(base, own))
        told = drawing_faults(layout)
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            whole, *shapes = build_scene(layout).solids
        assert [str(own.message) for own in heard] == [str(fault) for fault in told]
        parts = mesh_parts([part for part in whole.parts if part.slot in ("body", "upper", "gable")])
        seen = MultiPoint(parts.vertices[:, :2] + (0, 3)).convex_hull.buffer(2e-3)
        kept = [solid.mesh().vertices for solid in shapes]
        assert all(seen.covers(MultiPoint(points[points[:, 1] >= foot][:, :2])) for points in kept)
        high = max((points[:, 1].max() - foot for points in kept), default=0.0)
        assert bool(told) == (high < 1.6 - 1e-3)
        assert not told or (told[0].place, "out of the roof" in told[0].message) == (
            "shapes[\"D Q\"] in layer 'dormers': geometry",
            True,
        )


def test_a_dormer_stands_on_the_slope_and_goes_back_to_where_that_covers_it() -> None:
    for foot in (3.0, 3.7, 4.6):
        _, dormer = roofed("pitched", ("dormer", 0.0, (4.0, foot, 5.5, foot + 1.4)))
        slope = -(3.2 + 0.3) / 4.0  # back, a metre up: the ridge is in the middle of a roof 6.4 m deep
        ends = [0.3 + slope * (height - 3.0) for height in (foot, foot + 1.4)]
        assert dormer.face == pytest.approx(ends[0], abs=1e-6) or foot == 3.0
        assert dormer.face - dormer.depth == pytest.approx(ends[1] - 0.05, abs=1e-6)
