"""What is written of a building, read again by independent readers."""

from __future__ import annotations

import io
import json
import re
from collections import Counter

import numpy as np
import pytest
from shapely import Polygon

from facade_nb import Building
from facade_nb.__main__ import main
from facade_nb.building import Roof, load
from facade_nb.building.bodies import Frame, bodies_of, deepest
from facade_nb.building.developed import GAP
from facade_nb.building.mesh import parts_of
from facade_nb.building.roofs import roofing
from facade_nb.building.treatments import chamfer
from facade_nb.render import elevation_svg
from tests.building.houses import FRONT, SIDE, corner_house

# cjio has the whole process write JSON to six decimals from where it is imported on: that is taken back.
encoder = json.encoder.c_make_encoder
from cjio import cityjson  # noqa: E402

json.encoder.c_make_encoder = encoder
vars(json.encoder).pop("float", None)


def test_the_document_is_read_again_as_it_was():
    building = corner_house().building
    document = json.loads(building.to_json())
    assert document["format"] == "facade-nb/building/1"
    assert Building.from_dict(document) == building
    assert Building.from_json(building.to_json()) == building


def test_faults_of_a_document_are_all_told():
    document = Building.rectangle(5.0, 5.0, FRONT).to_dict()
    document["height"] = "tall"
    document["plan"][1] = [5.0]
    document["roof"] = {"kind": "hipped"}
    document["designs"]["Front"]["patterns"]["bays"] = "A(BA"
    document["colour"] = "red"
    with pytest.raises(ValueError) as error:
        Building.from_dict(document)
    places = [fault.place for fault in error.value.faults]
    assert places == ["colour", "height", "plan[1]", "designs.Front.patterns.bays", "roof.kind"]


def test_walls_end_in_the_plane_that_halves_their_corner():
    layout = corner_house()
    back = deepest(layout)
    count = 0
    for own in layout.faces:
        left, right = own.face.turns
        for body in bodies_of(layout, own, back):
            x, z = body.mesh.vertices[:, 0], body.mesh.vertices[:, 2]
            if body.solid is not None and body.solid.shape.geometry not in ("box", "cornice"):
                continue
            assert (x >= -z * np.tan(left / 2) - 1e-6).all(), own.face.name
            assert (x <= own.face.length + z * np.tan(right / 2) + 1e-6).all(), own.face.name
            count += 1
    assert count > 100
    # The cornice of wall 2 goes on around the inner corner where that of wall 3 begins, point by point.
    meet = {}
    for name, at in (("wall 3", 1), ("wall 4", 0)):
        own = layout.face(name)
        frame = Frame.of(own)
        for body in bodies_of(layout, own, back):
            if body.solid is not None and body.solid.shape.kind == "cornice":
                points = frame.place(body.mesh.vertices)
                corner = np.array([own.face.end if at else own.face.start]) * [1, -1]
                aside = points[:, [0, 2]] - corner
                on = np.abs(aside[:, 0] + aside[:, 1]) < 1e-6  # the plane between them
                meet.setdefault(name, set()).update(map(tuple, points[on].round(6)))
    assert meet["wall 3"] == meet["wall 4"] and len(meet["wall 3"]) >= 6


@pytest.mark.parametrize("kind", ["hip", "gable", "mansard", "flat"])
def test_the_roof_covers_the_plan(kind):
    layout = Building.ell(14.0, 12.0, (7.0, 6.0), None, height=6.0, roof=Roof(kind)).solve()
    roof = roofing(layout)
    a, b, c = (roof.positions[:, k] for k in range(3))
    up = np.cross(b - a, c - a)[:, 1]
    assert up[up > 0].sum() / 2 == pytest.approx(14 * 7 + 6 * 5, rel=1e-3)
    assert roof.positions[:, :, 1].min() >= 6.0 - 0.5
    assert (roof.positions[:, :, 1].max() > 6.0 + 1e-6) == (kind != "flat")


def test_glb_and_obj():
    import trimesh

    layout = corner_house()
    loaded = trimesh.load(io.BytesIO(layout.to_glb()), file_type="glb")
    parts = list(parts_of(layout))
    points = np.concatenate([part.mesh.vertices for part in parts])
    assert loaded.bounds == pytest.approx(np.stack([points.min(axis=0), points.max(axis=0)]), abs=1e-4)
    wanted = Counter(part.mesh.faces.shape[0] > 0 for part in parts)[True]
    tree = json.loads(layout.to_glb()[20:].split(b"\0", 1)[0].rsplit(b"}", 1)[0] + b"}")
    assert len(tree["nodes"]) == wanted
    text, _ = layout.to_obj("house.mtl")
    groups = Counter(line[2:] for line in text.splitlines() if line.startswith("g "))
    assert groups == Counter(" ".join(part.name.split()) for part in parts)
    doors = [part for part in parts if part.shape is not None and part.shape.kind == "door"]
    assert {part.face for part in doors} == {"corner 1", "wall 1", "wall 2", "wall 3", "wall 4", "wall 6"}


def test_cityjson(tmp_path):
    layout = corner_house()
    with layout.write_cityjson(tmp_path / "house.city.json").open() as file:
        found = cityjson.reader(file, ignore_duplicate_keys=False)
    (building,) = found.j["CityObjects"].values()
    assert building["type"] == "Building"
    (geometry,) = building["geometry"]
    surfaces = geometry["semantics"]["surfaces"]
    kinds = Counter(surface["type"] for surface in surfaces)
    shapes = Counter(shape.kind for own in layout.faces for shape in own.shown.shapes)
    assert (kinds["Window"], kinds["Door"]) == (shapes["window"], shapes["door"])
    assert {surface["face"] for surface in surfaces if "face" in surface} == {
        own.face.name for own in layout.faces
    }
    for k, surface in enumerate(surfaces):
        for child in surface.get("children", ()):
            assert surfaces[child]["parent"] == k and surfaces[child]["face"] == surface["face"]
    vertices = np.array(found.j["vertices"]) * found.j["transform"]["scale"]
    ground = next(k for k, s in enumerate(surfaces) if s["type"] == "GroundSurface")
    (rings,) = [
        own
        for own, k in zip(geometry["boundaries"], geometry["semantics"]["values"], strict=True)
        if k == ground
    ]
    assert Polygon(vertices[rings[0], :2]).area == pytest.approx(14 * 7 + 6 * 5 - 2.4**2 / 4, abs=0.01)


def test_drawings_of_all_walls():
    import ezdxf
    import pypdf

    layout = Building.rectangle(4.5, 3.0, [FRONT, SIDE, None, None], height=9.9).solve()
    shapes = [shape for own in layout.faces for shape in own.shown.shapes]
    drawing = ezdxf.read(io.StringIO(layout.to_dxf()))
    for kind in ("window", "door", "wall", "cornice"):
        found = drawing.modelspace().query(f'LWPOLYLINE[layer=="{kind}"]')
        assert len(found) == sum(shape.kind == kind for shape in shapes)
    text = pypdf.PdfReader(io.BytesIO(layout.to_pdf())).pages[0].extract_text()
    assert "4.50" in text and "3.00" in text
    rows = layout.to_schedule().splitlines()[1:]
    windows = [row.split(",") for row in rows if row.split(",")[1] == "window"]
    assert sum(int(row[6]) for row in windows) == sum(shape.kind == "window" for shape in shapes)


@pytest.mark.parametrize(
    ("building", "lengths"),
    [
        (Building.ell(6.0, 5.0, (2.7, 2.4), FRONT), (6.0, 2.7, 3.6, 2.3, 2.4, 5.0)),
        (Building.row([(4.5, FRONT), (6.0, SIDE)], 4.0), (4.5, 6.0, 4.0, 6.0, 4.5, 4.0)),
        (Building.rectangle(4.5, 3.0, [FRONT, SIDE, None, None]), (4.5, 3.0, 4.5, 3.0)),
    ],
)
def test_no_dimension_measures_what_lies_between_walls(building, lengths):
    import ezdxf
    import pypdf

    layout = building.solve()
    rows = {0: [], 90: []}
    for dimension in ezdxf.read(io.StringIO(layout.to_dxf())).modelspace().query("DIMENSION"):
        rows[int(dimension.dxf.angle)].append(dimension.get_measurement())
    assert sorted(rows[0]) == pytest.approx(sorted(lengths), abs=1e-3)
    assert sum(rows[90]) == pytest.approx(2 * max(rows[90]), abs=1e-3)  # the parts, and their sum
    pages = pypdf.PdfReader(io.BytesIO(layout.to_pdf())).pages
    text = [line for page in pages for line in page.extract_text().splitlines()]
    assert {f"{length:.2f}" for length in lengths} <= set(text)
    sizes = [re.fullmatch(r"(\d+\.\d\d) × (\d+\.\d\d) m", line) for line in text]
    found = [(float(size[1]), float(size[2])) for size in sizes if size]
    assert sum(width for width, _ in found) == pytest.approx(sum(lengths), abs=0.02)
    assert {height for _, height in found} == {round(layout.developed.canvas.height, 2)}
    written = {
        float(n) for n in re.findall(r">(\d+\.\d\d)</text>", elevation_svg(layout.developed, dimensions=True))
    }
    assert {round(length, 2) for length in lengths} <= written
    assert max(written) <= max(*lengths, layout.developed.canvas.height) and GAP not in written


def test_a_row_of_houses_stands_on_several_sheets_of_one_scale():
    """Ten walls would stand on one sheet at 1:500. Each has its name; a mark means the same on all sheets."""
    import pypdf

    layout = load("row-of-houses").solve()
    pages = [page.extract_text() for page in pypdf.PdfReader(io.BytesIO(layout.to_pdf())).pages]
    assert [re.findall(r"1:\d+ \(A3\)", page) for page in pages] == [["1:100 (A3)"]] * 3
    assert [int(n) for page in pages for n in re.findall(r"^wall (\d+)$", page, re.M)] == [*range(1, 11)]
    assert all(f"sheet {n} of 3" in page for n, page in enumerate(pages, 1))
    rows = {}
    for page in pages:
        for mark, *told in re.findall(r"^([WD]\d+)\n(window|door)\n(.+)\n(.+)\n(.+)\n(.+)$", page, re.M):
            assert rows.setdefault(mark, told) == told
    assert len(rows) == 9


def test_the_command_line_solves_a_building(tmp_path, capsys):
    source, out, svg = tmp_path / "house.json", tmp_path / "out.json", tmp_path / "house.svg"
    Building.rectangle(4.5, 3.0, [FRONT, SIDE, None, None], height=9.9).to_json(source)
    assert main(["solve", str(source), "--out", str(out), "--svg", str(svg)]) == 0
    document = json.loads(out.read_text())
    assert document["format"] == "facade-nb/building-layout/1"
    assert [face["name"] for face in document["faces"]] == ["wall 1", "wall 2", "wall 3", "wall 4"]
    assert svg.read_text().startswith("<svg")
    assert main(["solve", str(source), "--trace", str(tmp_path / "trace.json")]) == 2
    assert "--trace: expected a design" in capsys.readouterr().err
    source.write_text('{"format": "facade-nb/building/1", "height": 3}')
    assert main(["solve", str(source)]) == 2
    assert "plan: this field is missing" in capsys.readouterr().err


@pytest.mark.parametrize("kind", ["flat", "gable", "hip", "mansard"])
def test_no_part_has_triangles_without_an_area(kind: str) -> None:
    """Beside a corner that is cut, an eave of the roof shrinks to a point: no triangle is left of it."""
    plan = Building.rectangle(
        14, 9, SIDE, height=10, corners={0: ("chamfer", chamfer(ground=3.2, storey=2.9))}, roof=Roof(kind)
    )
    for part in parts_of(plan.solve()):
        sides = np.diff(part.mesh.vertices[part.mesh.faces], axis=1)
        assert np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).min() > 1e-8
        assert np.linalg.norm(part.mesh.normals, axis=-1) == pytest.approx(1)
