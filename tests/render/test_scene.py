"""Scenes, geometry and meshes."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely
import trimesh

from facade_nb.design.errors import DesignError
from facade_nb.design.model import Canvas
from facade_nb.render import GEOMETRIES, MATERIALS, build_scene, write_glb
from facade_nb.render.lofts import arc
from facade_nb.render.materials import find_material, mix
from facade_nb.render.meshing import mesh_part, mesh_parts
from facade_nb.render.parts import Block, Prism, front, outline
from facade_nb.render.surfaces import corner_normals, corner_places
from facade_nb.solver.model.layout import Layout, PlacedShape

from .houses import apartment, house

SIZES = [
    (0.3, 1.6, 0.3),
    (0.9, 1.4, 0.2),
    (1.6, 2.6, 0.3),
    (3.0, 2.8, 0.2),
    (6.0, 1.5, 4.0),
    (0.12, 0.12, 0.05),
]
OVERHANG = {  # metres beyond the rectangle: left and right, below; and beyond the face
    "window": (0, 0, 0.06),
    "french-window": (0, 0, 0.1),
    "shop": (0, 0, 0.04),
    "door": (0, 0, 0.3),
    "arch": (0, 0, 0.03),
    "roof": (0.25, 0.25, 0.25),
    "hip": (0.3, 0.1, 0.36),
    "pitched": (0, 0.1, 0.36),
    "hipped": (0.3, 0.14, 0.39),
    "mansard": (0, 0.1, 0.31),
    "dormer": (0, 0, 0.12),
    "gable": (0, 0, 0.05),
    "arched-window": (0, 0, 0.06),
    "arcade": (0, 0, 0.072),
    "sign": (0, 0, 0.03),
}


@pytest.mark.parametrize("name", GEOMETRIES)
@pytest.mark.parametrize("size", SIZES, ids=str)
def test_parts_are_closed_and_face_outwards(name: str, size: tuple[float, float, float]) -> None:
    for part in GEOMETRIES[name].parts(*size):
        vertices, faces = mesh_part(part)
        body = trimesh.Trimesh(vertices, faces, process=True, merge_norm=True, merge_tex=True)
        assert body.is_watertight, part
        assert body.is_winding_consistent, part
        assert body.volume > 0, part


@pytest.mark.parametrize("name", GEOMETRIES)
@pytest.mark.parametrize("size", SIZES, ids=str)
def test_meshes_stay_in_their_box_but_for_the_documented_overhang(
    name: str, size: tuple[float, float, float]
) -> None:
    w, h, _ = size
    side, below, ahead = OVERHANG.get(name, (0, 0, 0))
    vertices = mesh_parts(GEOMETRIES[name].parts(*size)).vertices
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    assert low[0] >= -side - 1e-9
    assert high[0] <= w + side + 1e-9
    assert low[1] >= -below - 1e-9
    assert high[1] <= h + 1e-9
    assert high[2] <= ahead + 1e-9


@pytest.mark.parametrize("name", [n for n, g in GEOMETRIES.items() if g.full and n != "pitched"])
def test_full_geometries_leave_no_gap(name: str) -> None:
    w, h = 1.2, 1.8
    mesh = mesh_parts(GEOMETRIES[name].parts(w, h, 0.2))
    seen = shapely.union_all(shapely.polygons(mesh.vertices[mesh.faces][..., :2]), grid_size=1e-9)
    assert shapely.box(0, 0, w, h).difference(seen.buffer(1e-6)).area < 1e-9


def test_the_drawn_outline_is_the_outline_of_the_mesh() -> None:
    for name, geometry in GEOMETRIES.items():
        for part in geometry.parts(1.3, 1.9, 0.25):
            vertices, _ = mesh_part(part)
            drawn = np.array(outline(part))
            assert drawn.min(axis=0) == pytest.approx(vertices[:, :2].min(axis=0), abs=1e-9), name
            assert drawn.max(axis=0) == pytest.approx(vertices[:, :2].max(axis=0), abs=1e-9), name
            assert front(part) == pytest.approx(vertices[:, 2].max(), abs=1e-9), name


def test_mirrored_shapes_are_mirrored_and_stay_closed() -> None:
    def solid(mirrored: tuple[bool, bool]) -> np.ndarray:
        shape = PlacedShape("l", "A", "P", (1, 2, 2, 4.2), mirrored, geometry="door", material="oak")
        mesh = build_scene(Layout("m", Canvas(4, 5), shapes=(shape,))).solids[0].mesh()
        body = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
        assert body.volume > 0
        return mesh.vertices

    plain, across, down = solid((False, False)), solid((True, False)), solid((False, True))
    assert sorted((3 - across[:, 0]).round(9)) == sorted(plain[:, 0].round(9))
    assert sorted((6.2 - down[:, 1]).round(9)) == sorted(plain[:, 1].round(9))
    assert not np.allclose(
        sorted(across[:, 0]), sorted(plain[:, 0])
    )  # a door with its handle is no mirror image


def test_offset_places_the_face_and_thickness_goes_back() -> None:
    def reach(offset: float, thickness: float, geometry: str = "box") -> tuple[float, float]:
        shape = PlacedShape(
            "l", "A", "P", (0, 0, 1, 1), geometry=geometry, offset=offset, thickness=thickness
        )
        z = build_scene(Layout("o", Canvas(1, 1), shapes=(shape,))).solids[0].mesh().vertices[:, 2]
        return float(z.min()), float(z.max())

    assert reach(0.0, 0.2) == pytest.approx((-0.2, 0.0))
    assert reach(-0.1, 0.2) == pytest.approx((-0.3, -0.1))
    assert reach(0.5, 0.2) == pytest.approx((0.0, 0.5))  # reaches back to the façade, so that nothing floats
    assert reach(0.0, 0.2, "balcony") == pytest.approx((0.0, 0.9))  # stands out by nature
    assert reach(0.4, 0.2, "balcony") == pytest.approx((0.0, 0.4))


def test_a_recessed_opening_of_a_higher_layer_cuts_the_wall() -> None:
    wall = PlacedShape("wall", "A", "P", (0, 0, 4, 3))
    window = PlacedShape("windows", "B", "Q", (1, 1, 2, 2), geometry="window", material="wood")
    scene = build_scene(Layout("cut", Canvas(4, 3), shapes=(wall, window)))
    mesh = scene.solids[0].mesh()
    body = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    assert body.volume == pytest.approx((12 - 1) * 0.2)
    proud = PlacedShape("windows", "B", "Q", (1, 1, 2, 2), geometry="window", material="wood", offset=0.1)
    whole = build_scene(Layout("cut", Canvas(4, 3), shapes=(wall, proud))).solids[0].mesh()
    assert trimesh.Trimesh(whole.vertices, whole.faces, process=False).volume == pytest.approx(12 * 0.2)


def test_unsuitable_materials_give_way_and_others_hold() -> None:
    def body(geometry: str, material: str) -> str:
        shape = PlacedShape("l", "A", "P", (0, 0, 1, 2), geometry=geometry, material=material)
        return build_scene(Layout("m", Canvas(1, 2), shapes=(shape,))).solids[0].materials["body"]

    assert body("door", "plaster") == "oak"
    assert body("window", "glass") == "painted-wood"
    assert body("window", "bronze") == "bronze"
    assert body("roof", "plaster") == "tiles"
    assert body("box", "plaster") == "plaster"


def test_triangles_carry_shape_and_colour_for_picking() -> None:
    layout = apartment()
    triangles = build_scene(layout).triangles()
    count = len(triangles.positions)
    assert triangles.positions.shape == triangles.normals.shape == (count, 3, 3)
    assert triangles.positions.dtype == np.float32
    assert set(triangles.shapes.tolist()) == set(range(len(layout.shapes)))
    assert np.allclose(np.linalg.norm(triangles.normals, axis=2), 1, atol=1e-4)
    assert triangles.colours.shape == (count, 3)
    assert max(triangles.materials) == len(triangles.material_names) - 1


def test_an_empty_layout_is_an_empty_scene(tmp_path: Path) -> None:
    layout = Layout("Nothing", Canvas(6, 3))
    assert build_scene(layout).triangles().positions.shape == (0, 3, 3)


def test_glb_round_trip(tmp_path: Path) -> None:
    layout = house()
    path = write_glb(layout, tmp_path / "house.glb")
    assert [p.name for p in tmp_path.iterdir()] == ["house.glb"]
    back = trimesh.load(path)
    low, high = back.bounds
    assert low == pytest.approx([-0.25, 0.0, -0.2], abs=1e-6)
    assert high == pytest.approx([6.25, 4.3, 0.3], abs=1e-6)
    data = path.read_bytes()
    tree = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    nodes = tree["nodes"]
    drawn = [index for index in range(len(layout.shapes)) if index != 3]
    assert [
        node["extras"]["index"] for node in nodes
    ] == drawn  # 3: the window that the door covers altogether
    for node, shape in zip(nodes, (layout.shapes[index] for index in drawn), strict=True):
        left, bottom, right, top = shape.rect
        assert node["name"] == f"{shape.layer}/{shape.x} {shape.y}"
        assert node["extras"]["size"] == [right - left, top - bottom]
        assert node["translation"][:2] == [left, bottom]
    assert tree["scenes"] == [{"nodes": list(range(len(nodes)))}]
    assert len(tree["meshes"]) < len(nodes)  # equal windows share their mesh
    windows = [node["mesh"] for node in nodes if layout.shapes[node["extras"]["index"]].geometry == "window"]
    assert windows and len(set(windows)) < len(windows)
    paints = {body.visual.material.name for body in back.geometry.values()}
    assert {"plaster", "brick", "glass", "stone", "oak", "tiles"} <= paints


def test_glb_of_a_faulty_layout_leaves_no_file(tmp_path: Path) -> None:
    shape = PlacedShape("l", "A", "P", (0, 0, 1, 1), geometry="bax")
    with pytest.raises(DesignError, match="did you mean 'box'"):
        write_glb(Layout("x", Canvas(1, 1), shapes=(shape,)), tmp_path / "x.glb")
    assert not list(tmp_path.iterdir())


def test_a_bow_is_smooth_and_its_edge_crisp() -> None:
    """Normals of the barrel of an arched roof are those of a circle; those of its ends look straight ahead."""
    barrel = Prism(arc(0, 0, 1, 1, 20), -2, 0)
    mesh = mesh_parts((barrel,))
    normals, corners = corner_normals(mesh), mesh.vertices[mesh.faces]
    own = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    own /= np.linalg.norm(own, axis=1, keepdims=True)
    bow = (np.abs(own[:, 2]) < 0.5) & (own[:, 1] > 0)
    inner = bow[:, None] & (corners[:, :, 1] > 0.01)  # at the foot is an edge
    assert inner.sum() > 80
    assert np.allclose(normals[inner], corners[inner] * (1, 1, 0), atol=1e-9)
    assert np.allclose(normals[~bow], own[~bow][:, None])
    # Its texture is unrolled: corners that lie on one line along the barrel have one place across it.
    places = corner_places(mesh)[bow].reshape(-1, 2)
    angle = np.arctan2(*corners[bow].reshape(-1, 3).T[1::-1])
    apart = [2 * np.sin(np.pi / 40) * k for k in range(21)]  # so many chords
    for axis in (0, 1):
        if np.ptp(places[:, axis]) > 2.5:
            along = np.abs(places[:, axis] - places[np.argmin(angle), axis])
            assert np.allclose(np.sort(np.unique(along.round(6))), np.round(apart, 6))
            break
    else:
        raise AssertionError("nothing is unrolled")


def test_stones_along_a_curve_are_one_body() -> None:
    """Prisms of one slot and depth have no seams between them; others stay apart."""
    stones = [Prism(((x, 0), (x + 1, 0), (x + 1, 1), (x, 1)), 0, 1, "coping") for x in (0, 1, 2)]
    mesh = mesh_parts((*stones, replace(stones[0], slot="body"), Block(5, 0, 6, 1, 0, 1)))
    assert set(mesh.bodies) == {0, 1, 2}
    row = mesh.vertices[mesh.faces[mesh.bodies == 0]]
    ends = row[np.ptp(row[:, :, 0], axis=1) < 1e-9][:, 0, 0]  # faces across it
    assert sorted(ends) == pytest.approx([0, 0, 3, 3])


def test_every_material_has_sound_numbers() -> None:
    for name, material in MATERIALS.items():
        assert find_material(name) is material
        assert 0 <= material.roughness <= 1
        assert 0 <= material.metallic <= 1
        assert material.summary
    assert find_material("#abc").fill == "#aabbcc"
    assert mix("#000000", "#ffffff", 0.5) == "#808080"


def test_parts_of_a_profile_rise() -> None:
    for name in ("cornice", "ledge"):
        (part,) = GEOMETRIES[name].parts(2.0, 0.4, 0.3)
        heights = [y for y, _ in part.profile]  # type: ignore[union-attr]
        assert all(b >= a for a, b in pairwise(heights))
        assert heights[0] == 0
        assert heights[-1] == pytest.approx(0.4)
