"""Openings whose geometry is a template: CityGML's implicit representations and CityJSON's geometry templates."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from facade_nb.survey import SurveyError, load_survey
from tests.test_city_surveys import east, model, ring, wall

EAST = "0 -1 0 0  1 0 0 0  0 0 1 0  0 0 0 1"  # x of the template runs along y of the wall
RECTANGLE = ring((0, 0, 0), (1, 0, 0), (1, 0, 2), (0, 0, 2))
PANE = (
    f'<gml:MultiSurface gml:id="pane"><gml:surfaceMember><gml:Polygon>{RECTANGLE}</gml:Polygon>'
    "</gml:surfaceMember></gml:MultiSurface>"
)
FILE = "<core:libraryObject>window.wrl</core:libraryObject>"
ELSEWHERE = '<bldg:lod3ImplicitRepresentation xlink:href="#w"/>'


def implicit(relative: str, at: str, matrix: str = EAST) -> str:
    return (
        "<bldg:lod3ImplicitRepresentation><core:ImplicitGeometry>"
        f"<core:transformationMatrix>{matrix}</core:transformationMatrix>\n{relative}"
        f"<core:referencePoint><gml:Point><gml:pos>{at}</gml:pos></gml:Point></core:referencePoint>"
        "</core:ImplicitGeometry></bldg:lod3ImplicitRepresentation>"
    )


def window(id: str, inside: str) -> str:
    return f'<bldg:opening><bldg:Window gml:id="{id}">\n{inside}</bldg:Window></bldg:opening>'


WHOLE = f"<core:relativeGMLGeometry>{PANE}</core:relativeGMLGeometry>"
SAME = '<core:relativeGMLGeometry xlink:href="#pane"/>'
WIDER = "0 -1 0 0  1.5 0 0 0.25  0 0 0.5 0  0 0 0 1"  # half as high again as wide, and moved along


def test_implicit_representations_are_turned_and_put_in_their_place(tmp_path: Path) -> None:
    path = tmp_path / "city.gml"
    windows = [
        window("a", implicit(WHOLE, "30 11 401")),
        window("b", implicit(SAME, "29.9 13 401")),  # in its reveal
        window("c", implicit(SAME, "30 11 404", WIDER)),
        window(
            "d", implicit(SAME, "30 15 404", "0 1 0 0  -1 0 0 0  0 0 1 0  0 0 0 1")
        ),  # the other way round
    ]
    path.write_text(model(wall("east", east(10, 400, 16, 409), *windows)), encoding="utf-8")
    survey = load_survey("b7", path)
    assert (survey.width, survey.height) == (6.0, 9.0)
    assert [own["rect"] for own in survey.openings] == [
        [1.0, 1.0, 2.0, 3.0], [3.0, 1.0, 4.0, 3.0], [1.25, 4.0, 2.75, 5.0], [4.0, 4.0, 5.0, 6.0],
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("inside", "told"),
    [
        (implicit(FILE, "30 11 401"), "expected a relativeGMLGeometry"),
        (implicit(WHOLE, "30 11"), "expected a referencePoint of three numbers; found 2"),
        (implicit(WHOLE, "30 11 401", "1 0 0"), "expected 16 numbers, row by row; found 3"),
        (implicit(SAME, "30 11 401"), "there is no 'pane'"),
        (ELSEWHERE, "expected an ImplicitGeometry of this file; there is no 'w'"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_them_is_told_with_its_line(inside: str, told: str, tmp_path: Path) -> None:
    path = tmp_path / "city.gml"
    path.write_text(model(wall("east", east(10, 400, 16, 409), window("a", inside))), encoding="utf-8")
    with pytest.raises(SurveyError) as error:
        load_survey("b7", path)
    assert told in str(error.value) and "line " in str(error.value)


def city(*instances: dict[str, Any], **changed: Any) -> dict[str, Any]:
    """A wall 6 m wide and 3 m high in the plane y = 0, seen from the south, and a template of a window 1 m by 1.5 m."""
    square = {"type": "MultiSurface", "lod": "3.0", "boundaries": [[[0, 1, 2, 3]]]}
    semantics = [{"type": kind} for kind in ("WallSurface", "Window")]
    walls = {**square, "semantics": {"surfaces": semantics[:1], "values": [0]}}
    template = {**square, "semantics": {"surfaces": semantics[1:], "values": [0]}}
    corners = [[0, 0, 0], [6000, 0, 0], [6000, 0, 3000], [0, 0, 3000]]
    return {
        "type": "CityJSON", "version": "2.0",
        "transform": {"scale": [0.001] * 3, "translate": [100, 0, 50]},
        "CityObjects": {"house": {"type": "Building", "geometry": [walls, *instances]}},
        "vertices": [*corners, [1000, 0, 1000], [4000, 0, 1000]],
        "geometry-templates": {
            "templates": [template], "vertices-templates": [[0, 0, 0], [1, 0, 0], [1, 0, 1.5], [0, 0, 1.5]],
        },
        **changed,
    }  # fmt: skip


def instance(spot: Any, *, template: Any = 0, matrix: Any = None) -> dict[str, Any]:
    still = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    given = {"transformationMatrix": still if matrix is None else matrix}
    return {"type": "GeometryInstance", "template": template, "boundaries": [spot], **given}


def test_templates_stand_beside_the_walls_of_their_level(tmp_path: Path) -> None:
    path = tmp_path / "city.json"
    mirrored = [-1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    path.write_text(json.dumps(city(instance(4), instance(5, matrix=mirrored))), encoding="utf-8")
    survey = load_survey("house", path)
    assert (survey.width, survey.height) == (6.0, 3.0)
    assert [own["rect"] for own in survey.openings] == [[1.0, 1.0, 2.0, 2.5], [3.5, 1.0, 4.5, 2.5]]


@pytest.mark.parametrize(
    ("one", "told"),
    [
        (instance(4, template=1), "geometry[1].template: expected the number of a template, 0 to 0; found 1"),
        (instance(9), "geometry[1].boundaries: expected the number of one vertex, 0 to 5"),
        (instance(4, matrix=[1, 2]), "geometry[1].transformationMatrix: expected 16 numbers, row by row"),
    ],
)
def test_what_is_wrong_with_a_template_is_told_with_its_place(one: Any, told: str, tmp_path: Path) -> None:
    path = tmp_path / "city.json"
    path.write_text(json.dumps(city(one, instance(4))), encoding="utf-8")
    with pytest.raises(SurveyError) as error:
        load_survey("house", path)
    assert told in str(error.value)
