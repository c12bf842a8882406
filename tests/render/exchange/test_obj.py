"""OBJ and MTL, read again by trimesh and line by line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from facade_nb import DesignError
from facade_nb.render import build_scene, to_obj, write_obj
from facade_nb.render.mesh import to_trimesh

from .samples import NAMES, layout, shape, solved, wall_with_window


@pytest.mark.parametrize("name", NAMES)
def test_a_group_for_each_shape(name: str) -> None:
    own = solved(name)
    text, materials = to_obj(own, "a.mtl")
    lines = text.splitlines()
    groups = [line[2:] for line in lines if line.startswith("g ")]
    assert groups == [f"{s.layer}/{s.x} {s.y}" for s in own.shapes]
    objects = [line[2:] for line in lines if line.startswith("o ")]
    assert len(set(objects)) == len(objects) == len(own.shapes)
    used = {line.split()[1] for line in lines if line.startswith("usemtl ")}
    assert used == {line.split()[1] for line in materials.splitlines() if line.startswith("newmtl ")}
    faces = sum(line.startswith("f ") for line in lines)
    assert faces == sum(len(solid.mesh().faces) for solid in build_scene(own).solids)


def test_trimesh_reads_the_same_bodies(tmp_path: Path) -> None:
    own = solved("residential-house")
    path = write_obj(own, tmp_path / "my house.obj")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["my house.mtl", "my house.obj"]
    back = trimesh.load(path, split_objects=True, group_material=True)
    expected = to_trimesh(build_scene(own))
    assert np.allclose(back.bounds, expected.bounds, atol=1e-5)
    assert back.area == pytest.approx(expected.area, rel=1e-4)
    colours = {tuple(body.visual.material.main_color[:3]) for body in back.geometry.values()}
    assert len(colours) > 5  # the MTL was found, blank and all


def test_each_group_has_the_size_of_its_shape() -> None:
    text, _ = to_obj(wall_with_window())
    assert "mtllib" not in text
    points: list[list[float]] = []
    spans: dict[str, list[int]] = {}
    for line in text.splitlines():
        word, *rest = line.split()
        if word == "v":
            points.append([float(value) for value in rest])
        elif word == "g":
            group = spans.setdefault(" ".join(rest), [])
        elif word == "f":
            group += [int(corner.split("/")[0]) - 1 for corner in rest]
    corners = np.array(points)[spans["windows/W F"]]
    assert corners[:, :2].min(axis=0).tolist() == [1, 1] and corners[:, :2].max(axis=0).tolist() == [3, 2]
    wall = np.array(points)[spans["base/A P"]]
    assert wall[:, :2].max(axis=0).tolist() == [4, 3]


def test_colours_and_names_that_the_format_would_misread() -> None:
    own = layout(1, 1, shape((0, 0, 1, 1), material="#c8b9a0", layer="two\nlines"))
    text, materials = to_obj(own)
    assert "\ng two lines/A P\n" in text and "usemtl paint-c8b9a0" in text
    assert "newmtl paint-c8b9a0\nKd 0.7843 0.7255 0.6275" in materials


def test_neither_is_written_where_one_cannot_be(tmp_path: Path) -> None:
    (tmp_path / "a.mtl").mkdir()
    with pytest.raises(DesignError, match=r"a\.mtl"):
        write_obj(wall_with_window(), tmp_path / "a.obj")
    assert [p.name for p in tmp_path.iterdir()] == ["a.mtl"]
    with pytest.raises(DesignError, match=r'shapes\["A P"\] in layer \'base\'.*box'):
        write_obj(layout(1, 1, shape((0, 0, 1, 1), geometry="bax")), tmp_path / "b.obj")
    assert [p.name for p in tmp_path.iterdir()] == ["a.mtl"]


def test_into_a_stream_go_no_materials() -> None:
    write_obj(wall_with_window(), "/dev/null")
    assert not Path("/dev/null.mtl").exists()
