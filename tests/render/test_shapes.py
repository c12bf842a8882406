"""The library of shapes: parameters, what they cut, meshes of the user's, rules as materials."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterator
from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb import Design, DesignError
from facade_nb.cli import main
from facade_nb.design.model import Canvas
from facade_nb.render import GEOMETRIES, DrawingWarning, build_scene, elevation_svg, to_glb
from facade_nb.render.geometry import find_geometry
from facade_nb.render.mesh import to_trimesh
from facade_nb.render.meshing import mesh_part, mesh_parts
from facade_nb.render.parts import Prism
from facade_nb.render.pipeline.solids import solids_of
from facade_nb.render.surroundings import building
from facade_nb.solver.model.layout import Layout, PlacedShape

SIZES = ((0.3, 0.3, 0.01), (0.9, 1.0, 0.2), (3.0, 2.0, 0.4), (0.5, 9.0, 2.0), (12.0, 0.95, 0.05))


def wall(*shapes: PlacedShape, size: tuple[float, float] = (4.0, 4.0), **fields: object) -> Layout:
    """Shapes, each in a layer of its own, on a wall 0.3 m thick."""
    base = PlacedShape("wall", "A", "P", (0, 0, *size), geometry="box", thickness=0.3)
    own = tuple(replace(shape, layer=f"l{k}") for k, shape in enumerate(shapes))
    return Layout("wall", Canvas(*size), shapes=(replace(base, **fields), *own))


def shape(rect: tuple[float, float, float, float], geometry: str, **fields: object) -> PlacedShape:
    return replace(PlacedShape("l", "B", "Q", rect, geometry=geometry, thickness=0.3), **fields)


def volume(layout: Layout, index: int = 0) -> float:
    mesh = build_scene(layout).solids[index].mesh()
    body = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    assert body.is_watertight and body.is_winding_consistent
    return float(body.volume)


def variants() -> Iterator[str]:
    """Each parameter of each geometry at its least and its greatest, or with each of its words."""
    for name, geometry in GEOMETRIES.items():
        for parameter in geometry.parameters:
            values = parameter.words or (("CAFÉ 12",) if parameter.text else (parameter.low, parameter.high))
            yield from (f"{name}({parameter.name}={value})" for value in values)


@pytest.mark.parametrize("name", [*variants()])
def test_parameters_at_their_ends_are_sound(name: str) -> None:
    for w, h, d in SIZES:
        parts = find_geometry(name).parts(w, h, d)
        for part in parts:
            vertices, faces = mesh_part(part)
            body = trimesh.Trimesh(vertices, faces, process=False)
            assert body.is_watertight and body.is_winding_consistent and body.volume > 0, (w, h, d, part)
        mesh = mesh_parts(parts)
        corners = mesh.vertices[mesh.faces].astype(np.float32).astype(float)
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert (np.linalg.norm(across, axis=1) > 0).all()


def test_parameters_change_what_they_name() -> None:
    def keystones(name: str) -> int:
        return sum(
            isinstance(part, Prism) and len(part.points) == 4 for part in find_geometry(name).parts(9, 4, 2)
        )

    assert [keystones(f"arcade(bays={k})") for k in (1, 4, 7)] == [1, 4, 7]
    assert len(find_geometry("stair(risers=5, cheeks=no)").parts(2, 1, 1)) == 10
    assert find_geometry("mansard").full and not find_geometry("mansard(ends=hipped)").full
    deep, deeper = (
        build_scene(wall(shape((0, 0, 3, 3), f"loggia(depth={d})"))).solids[1].depth for d in (1, 2.5)
    )
    assert (deep, deeper) == (1, 2.5)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        (
            "arcade(bay=3)",
            "parameter of arcade: expected one of bays, depth, pier; found 'bay'; did you mean 'bays'?",
        ),
        ("arcade(bays=2.5)", "bays of arcade: expected a whole number from 1 to 40; found '2.5'"),
        ("dormer(roof=gabel)", "expected one of gable, arch, flat; found 'gabel'; did you mean 'gable'?"),
        ("box(a=1)", "parameter of box: expected none; found 'a'"),
        ("arcad(bays=3)", "did you mean 'arcade'?"),
        ("arcade(bays)", "found 'arcade(bays)'"),
    ],
)
def test_what_is_wrong_with_parameters_is_told(name: str, told: str) -> None:
    with pytest.raises(DesignError) as caught:
        elevation_svg(wall(shape((0, 0, 1, 1), name)))
    assert told in str(caught.value) and "shapes[\"B Q\"] in layer 'l0': geometry" in str(caught.value)


def test_an_arched_window_cuts_an_arch() -> None:
    whole = volume(wall())
    cut = volume(wall(shape((1, 1, 3, 4), "arched-window")))
    opening = 2 * 2 + pi / 2  # a square under half a circle
    assert whole - cut == pytest.approx(0.3 * opening, rel=0.01)


def test_walls_that_are_no_boxes_are_cut_too() -> None:
    for geometry in ("panel", "gable(form=stepped)", "sign"):
        layout = wall(shape((1, 0.6, 2, 2.0), "window"), geometry=geometry)
        assert volume(layout) < volume(replace(layout, shapes=layout.shapes[:1])) - 0.29
        # also by an outline that is no rectangle
        arch = wall(shape((1, 0.6, 2, 2.0), "arched-window"), geometry=geometry)
        assert volume(layout) < volume(arch) < volume(replace(layout, shapes=layout.shapes[:1]))


@settings(max_examples=25)
@given(
    left=st.floats(-0.5, 3.5), low=st.floats(-0.5, 3.5), w=st.floats(0.02, 5), h=st.floats(0.02, 5),
    name=st.sampled_from(["window", "arched-window", "statue", "quoin", "gable(form=curved)"]),
    own=st.sampled_from(["box", "panel", "arcade", "ledge", "gable(form=stepped)"]),
)  # fmt: skip
def test_walls_that_are_cut_stay_closed(
    left: float, low: float, w: float, h: float, name: str, own: str
) -> None:
    layout = wall(shape((left, low, left + w, low + h), name, offset=-0.02), geometry=own)
    mesh = build_scene(layout).solids[0].mesh()
    body = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    assert body.is_watertight and body.is_winding_consistent
    corners = mesh.vertices[mesh.faces]
    assert (
        np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) > 0
    ).all()
    assert len(mesh.faces) == 0 or body.volume > 0


def test_what_stands_in_a_wall_lies_in_a_niche_of_its_outline() -> None:
    figure = shape((1, 1, 2, 3), "statue", offset=-0.05)
    niche = volume(wall()) - volume(wall(figure))
    assert 0.05 < niche < 0.3 * 2  # less than its rectangle
    assert volume(wall(replace(figure, offset=0.0))) == volume(
        wall()
    )  # in front of the wall it leaves it whole


def test_a_loggia_is_open_as_deep_as_it_is() -> None:
    """No wall of the house fills it: a layer's wall is thinner than a loggia is deep."""
    triangles = building(wall(shape((0.5, 0.5, 3.5, 3.5), "loggia(parapet=none)")))
    behind = triangles.positions[triangles.shapes == -1].mean(axis=1)
    inside = (np.abs(behind[:, :2] - 2) < 1.2).all(axis=1) & (behind[:, 2] > -1.0)
    assert not inside.any()


def test_what_is_written_is_not_mirrored() -> None:
    plain, mirrored = (
        build_scene(wall(shape((0, 0, 3, 1), "sign(text=R)", mirrored=(own, False)))).solids[1].parts
        for own in (False, True)
    )
    assert plain == mirrored
    left, right = (
        build_scene(wall(shape((0, 0, 1, 3), "quoin", mirrored=(own, False)))).solids[1].mesh().vertices[:, 0]
        for own in (False, True)
    )
    assert np.allclose(np.sort(1 - left), np.sort(right))


def test_alike_shapes_share_a_mesh_though_their_walls_are_cut() -> None:
    cells = [PlacedShape("walls", "A", "P", (2 * k, 0, 2 * k + 2, 3), geometry="panel") for k in range(3)]
    arches = [
        PlacedShape("arches", "B", "Q", (2 * k + 0.5, 0.5, 2 * k + 1.5, 2.5), geometry="arched-window")
        for k in range(3)
    ]
    data = to_glb(Layout("row", Canvas(6, 3), shapes=(*cells, *arches)))
    tree = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    assert len(tree["nodes"]) == 6 and len(tree["meshes"]) == 2


# Rules ------------------------------------------------------------------------------------------------------

GRAMMAR = """
Flag -> SplitX(Rel, 1, Red, Rel, 1, Blue)
Red -> Mat(Color, 0, 1, 0, 0, 1)
Blue -> Mat(Color, 0, 0, 0, 1, 1)
"""


def ruled(material: str = "rule:Flag", grammar: str = GRAMMAR) -> Layout:
    layout = wall(shape((1, 1, 2, 2), "box", material=material), size=(3, 3), material="brick")
    return replace(layout, design=Design(grammar=grammar))


def test_a_design_keeps_its_grammar() -> None:
    design = Design(grammar=GRAMMAR)
    assert Design.from_json(design.to_json()) == design
    with pytest.raises(DesignError, match="grammar: expected the text of a texture grammar; found 3"):
        Design.from_dict({**design.to_dict(), "grammar": 3})


def test_a_rule_is_drawn_in_elevation_mesh_and_pipeline() -> None:
    layout = ruled()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert "data:image/png" in elevation_svg(layout)
        bodies = to_trimesh(build_scene(layout)).geometry
        solids = solids_of(layout, ground=False)
    (flag,) = [body for name, body in bodies.items() if "rule:Flag" in name]
    picture = np.asarray(flag.visual.material.baseColorTexture)
    assert (picture[0, 0] == (255, 0, 0)).all() and (picture[-1, -1] == (0, 0, 255)).all()
    ahead = flag.face_normals[:, 2] > 0.9
    spots, places = (
        flag.vertices[flag.faces[ahead]].reshape(-1, 3),
        flag.visual.uv[flag.faces[ahead]].reshape(-1, 2),
    )
    assert np.allclose(spots[:, :2], places)  # from 0 to 1 over a square of one metre
    own = solids.scene.vertices.reshape(-1, 3)[solids.shapes == 1]
    front = own[own["normal"][:, 0, 2] > 0.9]
    assert np.allclose(front["place"], front["position"][:, :, :2] - 1) and (front["size"] == 1).all()
    grammar = solids.scene.grammar
    (start,) = np.unique(front["start"].reshape(-1, 2), axis=0).tolist()
    places_of = dict(zip(grammar.encoding.names, grammar.encoding.positions, strict=True))
    assert tuple(start) == tuple(places_of["Flag"])


@pytest.mark.parametrize(
    ("layout", "told"),
    [
        (
            ruled("rule:Flug"),
            "expected a rule of the design's grammar; found 'rule:Flug'; did you mean 'Flag'?",
        ),
        (ruled(grammar=""), "expected a rule of the design's grammar, which is empty; found 'rule:Flag'"),
        (ruled(grammar="Flag -> Nonsense(3)"), "the design's grammar has a fault"),
    ],
)
def test_a_rule_that_there_is_not_is_told_and_the_rest_drawn(layout: Layout, told: str) -> None:
    for draw in (elevation_svg, to_glb, solids_of):
        with pytest.warns(DrawingWarning) as caught:
            draw(layout)
        assert told in str(caught[0].message)
        assert "shapes[\"B Q\"] in layer 'l0': material" in str(caught[0].message)


# Files ------------------------------------------------------------------------------------------------------


def test_a_mesh_file_is_fitted_to_its_cell_and_mirrored(tmp_path: Path) -> None:
    wedge = trimesh.Trimesh(
        [(0, 0, 0), (2, 0, 0), (0, 4, 0), (0, 0, 1), (2, 0, 1), (0, 4, 1)],
        [(0, 2, 1), (3, 4, 5), (0, 1, 4), (0, 4, 3), (1, 2, 5), (1, 5, 4), (2, 0, 3), (2, 3, 5)],
    )
    name = f"file:{tmp_path / 'wedge.obj'}"
    wedge.export(tmp_path / "wedge.obj")
    for mirrored in ((False, False), (True, False)):
        layout = wall(shape((1, 1, 3, 2), name, offset=0.1, mirrored=mirrored))
        mesh = build_scene(layout).solids[1].mesh()
        low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
        assert np.allclose((low[:2], high[:2]), ((1, 1), (3, 2))) and high[2] == pytest.approx(0.1)
        assert volume(layout, 1) > 0
        top = mesh.vertices[mesh.vertices[:, 1] > 1.9, 0]
        assert np.allclose(top, 3 if mirrored[0] else 1)
        elevation_svg(layout)
    kept = build_scene(wall(shape((1, 1, 3, 2), f"{name}(fit=keep)"))).solids[1].mesh().vertices
    assert np.ptp(kept, axis=0) == pytest.approx((0.5, 1, 0.25)) and kept[:, 0].mean() == pytest.approx(
        1.9167, abs=1e-3
    )
    wedge.faces = wedge.faces[:, ::-1]  # inside out: turned the right way
    wedge.export(tmp_path / "wedge.obj")
    assert volume(wall(shape((1, 1, 3, 2), name)), 1) > 0


@pytest.mark.parametrize("unit", [1e-30, 1e-9, 1e30])
def test_a_mesh_file_may_be_in_any_unit(tmp_path: Path, unit: float) -> None:
    box = trimesh.creation.box((1, 2, 0.5)).apply_translation((-3, 0, 0))
    trimesh.Trimesh(box.vertices * unit, box.faces, process=False).export(tmp_path / "box.stl")
    layout = wall(shape((1, 1, 3, 2), f"file:{tmp_path / 'box.stl'}(fit=keep)"))
    vertices = build_scene(layout).solids[1].mesh().vertices
    assert np.ptp(vertices, axis=0) == pytest.approx((0.5, 1, 0.25))


def test_a_bad_mesh_is_told_and_the_rest_drawn(tmp_path: Path) -> None:
    box = trimesh.creation.box()
    box.export(tmp_path / "box.stl")
    (tmp_path / "empty.obj").write_text("")
    (tmp_path / "torn.glb").write_bytes(b"glTF and nothing else")
    trimesh.creation.icosphere(5).export(tmp_path / "ball.ply")
    trimesh.Trimesh(box.vertices, box.faces[:5]).export(tmp_path / "open.obj")
    trimesh.Trimesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]).export(tmp_path / "flat.off")
    (tmp_path / "folder.stl").mkdir()
    (tmp_path / "loop.stl").symlink_to("loop.stl")
    os.mkfifo(tmp_path / "pipe.stl")
    for number in ("nan", "inf"):
        text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 {}\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
        (tmp_path / f"{number}.obj").write_text(text.format(number))
        odd = trimesh.Trimesh([*box.vertices[:7], (1, 1, float(number))], box.faces, process=False)
        with np.errstate(all="ignore"):
            odd.export(tmp_path / f"{number}.stl")
    told = {
        "folder.stl": "folder.stl' is a folder",
        "loop.stl": "loop.stl' cannot be read: too many levels",
        "pipe.stl": "pipe.stl' is a device or a pipe",
        "nan.obj": "nan.obj' has corners that are no numbers",
        "inf.obj": "inf.obj' has corners that are no numbers",
        "nan.stl": "nan.stl' has corners that are no numbers",
        "inf.stl": "inf.stl' has corners that are no numbers",
        "bix.stl": "did you mean 'box.stl'?",
        "empty.obj": "empty.obj'",
        "torn.glb": "cannot be read as a mesh",
        "ball.ply": "has 20,480 triangles; expected at most 20,000",
        "open.obj": "is not closed",
        "flat.off": "is flat",
        "box.step": "expected a file that ends in .glb, .gltf, .obj",
        "box.stl(fit=kep)": "did you mean 'keep'?",
        "": "",
    }
    for name, what in told.items():
        layout = wall(shape((1, 1, 2, 2), f"file:{tmp_path / name}"))
        with pytest.warns() as caught:
            text = elevation_svg(layout)
        assert {each.category for each in caught} == {DrawingWarning}  # none of a library's
        message = str(caught[0].message)
        assert what in message and message.startswith("shapes[\"B Q\"] in layer 'l0': geometry"), message
        assert text.count("data-shape") == 2


def test_the_command_line_tells_what_it_could_not_draw(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    document = {
        "format": "facade-nb/design/1",
        "canvas": {"width": 2, "height": 2},
        "symbols": {"A": {"size": 1}, "P": {"size": 2}},
        "patterns": {"across": "AA", "up": "P"},
        "layers": [{"name": "wall", "x": {"pattern": "across"}, "y": {"pattern": "up"}}],
        "shapes": {"A[1] P": {"geometry": "file:urn.obj"}, "A[2] P": {"material": "rule:Poster"}},
    }
    (tmp_path / "a.json").write_text(json.dumps(document))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert (
            main(
                [
                    "solve",
                    str(tmp_path / "a.json"),
                    "--svg",
                    str(tmp_path / "a.svg"),
                    "--out",
                    str(tmp_path / "b"),
                ]
            )
            == 0
        )
    told = capsys.readouterr().err
    assert "Note: shapes[\"A P\"] in layer 'wall': geometry: there is no file 'urn.obj'" in told
    assert "found 'rule:Poster'" in told
    assert (tmp_path / "a.svg").read_text().count("data-shape") == 2
