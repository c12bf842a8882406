"""Meshes are sound: closed, turned outwards, no triangle without an area, whatever the size; and files are valid."""

from __future__ import annotations

import json
import subprocess
from collections import Counter
from functools import cache
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from facade_nb import gallery, solve
from facade_nb.design.model import Canvas
from facade_nb.render import GEOMETRIES, build_scene, to_glb, write_glb
from facade_nb.render.mesh import to_trimesh
from facade_nb.render.meshing import mesh_part, mesh_parts
from facade_nb.render.parts import Block, Moulding, Part, Prism, Ring, Turned, flip
from facade_nb.render.surfaces import corner_normals, corner_places
from facade_nb.solver.model.layout import Layout, PlacedShape

MIRRORED = tuple(product((False, True), repeat=2))
EDGES = (0.00011, 0.001, 0.01, 0.05, 0.1, 0.29, 0.3, 0.31, 0.72, 1.0, 1.8, 2.3, 2.5, 10.0, 100.0)
"""Sizes in metres, some of them where a geometry changes its parts."""
SIZES = st.sampled_from(EDGES) | st.floats(-3.9, 2.0).map(lambda power: 10.0**power)
DEPTHS = st.sampled_from((0.01, 0.02, 0.075, 0.1, 0.2, 0.24, 0.35, 4.0)) | st.floats(-2.0, 2.0).map(
    lambda power: 10.0**power
)


def areas(corners: NDArray[np.float32]) -> NDArray[np.float64]:
    """Of triangles (m, 3, 3), as exact as their corners are."""
    a, b, c = (corners[:, k].astype(np.float64) for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def ahead(faces: NDArray[np.int64]) -> NDArray[np.int64]:
    """The corner after each corner."""
    return np.roll(faces, -1, axis=1)


def has_room(part: Part) -> bool:
    """Whether a part is no less than nothing in any direction."""
    match part:
        case Block():
            return part.x0 < part.x1 and part.y0 < part.y1 and part.z0 < part.z1
        case Ring():
            inner = min(part.x1 - part.x0, part.y1 - part.y0) - 2 * part.width
            return part.width > 0 and inner > 0 and part.z0 < part.z1
        case Prism():
            return part.z0 < part.z1
        case Moulding():
            return part.x0 < part.x1 and all(part.z0 < z for _, z in part.profile[1:-1])
        case Turned():
            return all(radius > 0 for _, radius in part.profile)
        case _:
            return True


@pytest.mark.parametrize("name", GEOMETRIES)
@settings(max_examples=25)
@given(w=SIZES, h=SIZES, d=DEPTHS, mirrored=st.sampled_from(MIRRORED))
def test_parts_of_any_size(name: str, w: float, h: float, d: float, mirrored: tuple[bool, bool]) -> None:
    h = min(h, 300 / w)  # a window of 100 m by 100 m has 30,000 parts
    parts = flip(GEOMETRIES[name].parts(w, h, d), w, h, mirrored)
    for part in parts:
        assert has_room(part), part
        vertices, faces = mesh_part(part)
        ways = [
            np.sort((f * len(vertices) + t).ravel())
            for f, t in ((faces, ahead(faces)), (ahead(faces), faces))
        ]
        assert (np.diff(ways[0]) > 0).all() and (ways[0] == ways[1]).all(), (
            part
        )  # each edge once there, once back
        corners = (vertices - vertices[0])[faces]
        volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
        assert volume > 0, part  # and turned outwards
    mesh = mesh_parts(parts)
    corners = mesh.vertices[mesh.faces]
    assert np.isfinite(corners).all() and (areas(corners.astype(np.float32)) > 0).all()
    normals = corner_normals(mesh).astype(np.float32)
    assert np.allclose(np.linalg.norm(normals, axis=2), 1, atol=1e-5)
    own = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    own /= np.linalg.norm(own, axis=1, keepdims=True)
    turned = np.einsum("mki,mi->mk", normals, own)
    assert (turned > np.where(mesh.round, 0.69, 0.9)[:, None]).all()
    places = corner_places(mesh)
    for k in range(3):  # texture coordinates are metres on the surface, the right way round
        sides, drawn = (v[:, k] - v[:, k - 1] for v in (corners, places))
        assert np.allclose(np.linalg.norm(sides, axis=1), np.linalg.norm(drawn, axis=1), rtol=1e-9, atol=1e-9)
    first, second = places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]
    assert (first[:, 0] * second[:, 1] > first[:, 1] * second[:, 0]).all()


@cache
def catalogue() -> Layout:
    """Every geometry in many sizes, thick and thin, mirrored and not, side by side."""
    shapes: list[PlacedShape] = []
    left = 0.0
    sizes = ((0.001, 0.001), (0.001, 2.5), (0.3, 0.3), (1.0, 2.5), (9.0, 0.31), (0.31, 30.0), (0.0002, 100.0))
    for name, (w, h), mirrored in product(GEOMETRIES, sizes, MIRRORED):
        thickness, offset = ((0.0, -0.1), (0.24, 0.0))[len(shapes) % 5 % 2]
        rect = (left, 0.0, left + w, h)
        shapes.append(
            PlacedShape("l", "A", "P", rect, mirrored, geometry=name, offset=offset, thickness=thickness)
        )
        left += w
    return Layout("catalogue", Canvas(left, 100.0), shapes=tuple(shapes))


def test_triangles_of_every_geometry_have_an_area() -> None:
    """Also far from the origin, where single precision tells less."""
    scene = build_scene(catalogue())
    triangles = scene.triangles()
    assert (areas(triangles.positions) > 0).all()
    assert np.allclose(np.linalg.norm(triangles.normals, axis=2), 1, atol=1e-5)
    assert set(triangles.shapes.tolist()) == set(range(len(scene.solids)))


def test_files_are_valid(tmp_path: Path, root: Path) -> None:
    """The whole gallery, and every geometry in many sizes: no error, no warning, nothing to remark."""
    files = [write_glb(solve(gallery.load(name)), tmp_path / f"{name}.glb") for name in gallery.names()]
    files.append(write_glb(catalogue(), tmp_path / "every geometry.glb"))
    files.append(write_glb(Layout("nothing", Canvas(1, 1)), tmp_path / "nothing.glb"))
    tiny = PlacedShape("l", "A", "P", (0, 0, 0.00005, 1))
    files.append(write_glb(Layout("too small", Canvas(1, 1), shapes=(tiny,)), tmp_path / "too small.glb"))
    done = subprocess.run(
        ["node", root / "tests" / "render" / "validate_glb.mjs", *files],
        capture_output=True,
        text=True,
        check=True,
    )
    told = json.loads(done.stdout)
    assert len(told) == len(files) > 13
    # Texture coordinates in metres wait for whoever gives a material a texture; the validator remarks that.
    known = {
        path: [one for one in messages if not one["pointer"].endswith("/TEXCOORD_0")]
        for path, messages in told.items()
    }
    assert {Path(path).name: messages[:3] for path, messages in known.items() if messages} == {}


def test_the_validator_finds_faults(tmp_path: Path, root: Path) -> None:
    """A normal of no length, as of a triangle without an area."""
    data = bytearray(to_glb(Layout("one", Canvas(1, 1), shapes=(PlacedShape("l", "A", "P", (0, 0, 1, 1)),))))
    tree = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    accessor = tree["accessors"][tree["meshes"][0]["primitives"][0]["attributes"]["NORMAL"]]
    start = 20 + int.from_bytes(data[12:16], "little") + 8
    start += tree["bufferViews"][accessor["bufferView"]]["byteOffset"]
    data[start : start + 12] = bytes(12)
    (tmp_path / "a.glb").write_bytes(data)
    done = subprocess.run(
        ["node", root / "tests" / "render" / "validate_glb.mjs", tmp_path / "a.glb"],
        capture_output=True,
        text=True,
        check=True,
    )
    (messages,) = json.loads(done.stdout).values()
    found = [message["code"] for message in messages if message["code"] != "UNUSED_OBJECT"]  # of TEXCOORD_0
    assert found == ["ACCESSOR_VECTOR3_NON_UNIT"]


def test_what_each_view_of_the_buffer_is_for() -> None:
    data = to_glb(
        Layout("one", Canvas(1, 2), shapes=(PlacedShape("l", "A", "P", (0, 0, 1, 2), geometry="door"),))
    )
    tree = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    targets = Counter(view.get("target") for view in tree["bufferViews"])
    assert set(targets) == {34962, 34963}
    for mesh in tree["meshes"]:
        for primitive in mesh["primitives"]:
            view = tree["bufferViews"][tree["accessors"][primitive["indices"]]["bufferView"]]
            assert view["target"] == 34963


def test_a_cornice_as_deep_as_it_stands_out() -> None:
    """Its foot was a sheet without a thickness, in front of a part of its back: 50 such triangles in the bookshop."""
    (part,) = GEOMETRIES["cornice"].parts(2.0, 0.4, 0.2)
    assert isinstance(part, Moulding)
    assert min(z for _, z in part.profile) > part.z0 + 0.01
    layout = solve(gallery.load("bookshop"))
    for body in to_trimesh(build_scene(layout)).geometry.values():
        assert body.area_faces.min() > 1e-7


def test_a_profile_that_leads_back_and_straight_on() -> None:
    """Whatever profile a moulding has: a foot in the plane of its back is left away."""
    profile = ((0.0, -0.2), (0.1, -0.2), (0.1, 0.0), (0.3, 0.0), (0.3, -0.2), (0.5, -0.2))
    vertices, faces = mesh_part(Moulding(0, 1, profile, -0.2))
    assert (vertices[:, 1].min(), vertices[:, 1].max()) == pytest.approx((0.1, 0.3))
    corners = vertices[faces]
    assert (areas(corners.astype(np.float32)) > 0).all()
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert volume == pytest.approx(0.2 * 0.2)


@pytest.mark.parametrize("size", [1e-4, 1.0, 1e4])
def test_corners_without_an_angle(size: float) -> None:
    """Every triangle has an area, wherever the corners along a straight line are."""
    polygon = [
        (0, 0),
        (1, 0),
        (2, 0),
        (3, 0),
        (4, 0),
        (4, 1),
        (4, 2),
        (4, 3),
        (2, 3),
        (2, 1.5),
        (2, 1),
        (0, 1),
        (0, 0.5),
    ]
    points = [(x * size, y * size) for x, y in polygon]
    for turn in range(len(points)):
        rolled = points[turn:] + points[:turn]
        vertices, faces = mesh_part(Prism(tuple(rolled), 0, size))
        corners = vertices[faces]
        assert (areas(corners.astype(np.float32)) > 1e-3 * size**2).all()
        volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
        assert volume == pytest.approx(8 * size**3)


def test_a_wall_cut_next_to_its_edge() -> None:
    """What is left beside an opening by the last digits of sizes is no wall."""
    wall = PlacedShape("wall", "A", "P", (0, 0, 80, 3))
    window = PlacedShape("windows", "B", "Q", (3e-8, 1, 80 - 3e-7, 2), geometry="window")
    (solid, _) = build_scene(Layout("cut", Canvas(80, 3), shapes=(wall, window))).solids
    assert len(solid.parts) == 2  # below and above
    assert (areas(solid.mesh().vertices[solid.mesh().faces].astype(np.float32)) > 0).all()
