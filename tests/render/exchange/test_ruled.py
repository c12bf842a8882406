"""What a rule of the design's grammar draws, in OBJ, PDF, the 3D view and the files of buildings, opened again."""

from __future__ import annotations

import io
import warnings
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pypdf
import pytest
import trimesh

from facade_nb import Building, DesignError, Layout
from facade_nb.cli import main
from facade_nb.design import Design
from facade_nb.render import DrawingWarning, elevation_svg, to_pdf, write_obj
from facade_nb.widgets.studio.massing import layout_mesh

from .samples import layout, shape

RED, BLUE = (255, 0, 0), (0, 0, 255)
GRAMMAR = """
Flag -> SplitX(Rel, 1, Red, Rel, 1, Blue)
Red -> Mat(Color, 0, 1, 0, 0, 1)
Blue -> Mat(Color, 0, 0, 0, 1, 1)
"""
DESIGN = Design.from_dict(
    {
        "format": "facade-nb/design/1",
        "name": "Flags",
        "canvas": {"width": 4.0, "height": 3.0},
        "symbols": {"A": {"size": 2.0}, "P": {"size": 3.0}},
        "patterns": {"x": "AA", "y": "P"},
        "layers": [{"name": "wall", "x": {"pattern": "x"}, "y": {"pattern": "y"}}],
        "shapes": {"* *": {"kind": "wall", "material": "rule:Flag", "thickness": 0.3}},
        "grammar": GRAMMAR,
    }
)


@pytest.fixture(autouse=True)
def _no_fault_is_told() -> Iterator[None]:
    with warnings.catch_warnings():
        warnings.simplefilter("error", DrawingWarning)
        yield


def flags() -> Layout:
    """Two walls of one size and one of another, drawn by one rule; a plain one."""
    own = layout(
        8, 2,
        shape((0, 0, 2, 2), material="rule:Flag", x="A"),
        shape((2, 0, 4, 2), material="rule:Flag", x="B"),
        shape((4, 0, 7, 2), material="rule:Flag", x="C"),
        shape((7, 0, 8, 2), material="brick", x="D"),
    )  # fmt: skip
    return replace(own, design=Design(grammar=GRAMMAR))


def seen(scene: trimesh.Scene, at: tuple[float, float, float], ahead: tuple[float, float, float]) -> object:
    """The colour of a picture at a place of a surface that looks that way."""
    for body in scene.dump():
        image = getattr(body.visual.material, "image", None) or getattr(
            body.visual.material, "baseColorTexture", None
        )
        if image is None:
            continue
        corners = body.triangles
        weights = trimesh.triangles.points_to_barycentric(corners, np.repeat([at], len(corners), axis=0))
        on = (weights > -1e-6).all(axis=1) & (body.face_normals @ ahead > 0.9)
        on &= np.abs(((at - corners[:, 0]) * body.face_normals).sum(axis=1)) < 1e-6
        if not on.any():
            continue
        face = int(np.flatnonzero(on)[0])
        u, v = (weights[face] @ body.visual.uv[body.faces[face]]) % 1.0
        pixels = np.asarray(image.convert("RGB"))
        return tuple(pixels[int((1 - v) * len(pixels)), int(u * pixels.shape[1])].tolist())
    return None


def test_obj_has_a_picture_for_each_size_of_face(tmp_path: Path) -> None:
    write_obj(flags(), tmp_path / "my house.obj")
    names = {"my house.obj", "my house.mtl", "my_house-rule-1.png", "my_house-rule-2.png"}
    assert {path.name for path in tmp_path.iterdir()} == names
    scene = trimesh.load_scene(tmp_path / "my house.obj", split_objects=True, group_material=True)
    front = (0.0, 0.0, 1.0)
    places = {0.5: RED, 1.5: BLUE, 2.5: RED, 3.5: BLUE, 5.0: RED, 6.0: BLUE, 7.5: None}
    assert {x: seen(scene, (x, 1.0, 0.0), front) for x in places} == places


def test_pictures_are_refused_where_they_would_be_another_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    DESIGN.to_json(tmp_path / "design.json")
    command = ["solve", "design.json", "--out", "layout.json", "--obj", "a.obj"]
    assert main([*command, "--svg", "a-rule-1.png"]) != 0
    assert "'a-rule-1.png'" in capsys.readouterr().err
    assert {path.name for path in tmp_path.iterdir()} == {"design.json"}
    assert main(command) == 0
    wanted = {"design.json", "layout.json", "a.obj", "a.mtl", "a-rule-1.png"}
    assert {path.name for path in tmp_path.iterdir()} == wanted
    (tmp_path / "b-rule-1.png").mkdir()
    with pytest.raises(DesignError, match=r"b-rule-1\.png"):
        write_obj(flags(), tmp_path / "b.obj")
    assert not (tmp_path / "b.obj").exists() and not (tmp_path / "b.mtl").exists()


def test_files_of_others_beside_an_obj_are_left_alone(tmp_path: Path) -> None:
    kept = {"a.mtl": "newmtl theirs\n", "a-rule-1.png": "theirs", "a-rule-2~2.png": "theirs"}
    for name, text in kept.items():
        (tmp_path / name).write_text(text)
    write_obj(flags(), tmp_path / "a.obj")
    ours = {"a.obj", "a~2.mtl", "a-rule-1~2.png", "a-rule-2.png"}
    assert {path.name for path in tmp_path.iterdir()} == {*kept, *ours}
    assert {name: (tmp_path / name).read_text() for name in kept} == kept
    write_obj(flags(), tmp_path / "a.obj")  # ours are written anew
    assert {path.name for path in tmp_path.iterdir()} == {*kept, *ours}
    assert "mtllib a~2.mtl" in (tmp_path / "a.obj").read_text()
    scene = trimesh.load_scene(tmp_path / "a.obj", split_objects=True, group_material=True)
    assert seen(scene, (0.5, 1.0, 0.0), (0.0, 0.0, 1.0)) == RED


def test_pdf_shows_the_pictures_pale() -> None:
    (page,) = pypdf.PdfReader(io.BytesIO(to_pdf(flags()))).pages
    pictures = [np.asarray(image.image.convert("RGB")).astype(int) for image in page.images]
    assert len(pictures) == 2  # one for each size, used where it is seen
    for pixels in pictures:
        assert pixels[0, 0].tolist() == [255, 102, 102] and pixels[-1, -1].tolist() == [102, 102, 255]


def test_the_3d_view_has_a_mesh_with_a_texture_for_each_picture() -> None:
    mesh = layout_mesh(flags())
    plain = mesh.geometry.attributes["position"].array
    assert plain[:, 0].min() == 7 and plain[:, 0].max() == 8
    spans = []
    for own in mesh.children:
        front = own.geometry.attributes["normal"].array[:, 2] > 0.9
        spots, places = (own.geometry.attributes[name].array[front] for name in ("position", "uv"))
        spans.append((spots[:, 0].min(), spots[:, 0].max()))
        turns = (spots[:, 0] - spans[-1][0]) / (2 if spans[-1][0] == 0 else 3)
        assert np.allclose(np.exp(2j * np.pi * turns), np.exp(2j * np.pi * places[:, 0]), atol=1e-5)
        pixels = own.material.map.data
        assert (pixels[0, 0] == RED).all() and (pixels[-1, -1] == BLUE).all()
    assert sorted(spans) == [(0, 4), (4, 7)]


def test_a_building_shows_them_in_all_its_files(tmp_path: Path) -> None:
    solved = Building.rectangle(4, 4, DESIGN, height=3).solve()
    solved.write_obj(tmp_path / "b.obj")
    solved.write_glb(tmp_path / "b.glb")
    for name in ("b.obj", "b.glb"):
        scene = trimesh.load_scene(tmp_path / name)
        at = {0.5: RED, 1.5: BLUE, 2.5: RED, 3.5: BLUE}
        assert {x: seen(scene, (x, 1.0, 0.0), (0.0, 0.0, 1.0)) for x in at} == at
        assert {x: seen(scene, (4.0, 1.0, -x), (1.0, 0.0, 0.0)) for x in at} == at  # the wall to its right
    assert elevation_svg(solved.developed).count("data:image/png") == 1
    assert len(pypdf.PdfReader(io.BytesIO(solved.to_pdf())).pages[0].images) == 1
