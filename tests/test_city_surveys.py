"""City models at LoD 3 as surveys: CityGML 2 and 3 and CityJSON written by hand, what we write, and what is wrong."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from facade_nb import Design, gallery, solve
from facade_nb.cli import main
from facade_nb.render import write_cityjson
from facade_nb.survey import SurveyError, buildings, load_survey

HEAD = (
    '<?xml version="1.0" encoding="UTF-8"?>\n<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" '
    'xmlns:bldg="http://www.opengis.net/citygml/building/2.0" '
    'xmlns:con="http://www.opengis.net/citygml/construction/3.0" '
    'xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink">\n'
)


def ring(*corners: tuple[float, float, float]) -> str:
    text = " ".join(f"{v:g}" for corner in (*corners, corners[0]) for v in corner)
    return f"<gml:exterior><gml:LinearRing><gml:posList>{text}</gml:posList></gml:LinearRing></gml:exterior>"


def surface(*corners: tuple[float, float, float], level: str = "bldg:lod3MultiSurface", id: str = "") -> str:
    own = f' gml:id="{id}"' if id else ""
    return (
        f"<{level}><gml:MultiSurface><gml:surfaceMember><gml:Polygon{own}>{ring(*corners)}</gml:Polygon>"
        f"</gml:surfaceMember></gml:MultiSurface></{level}>"
    )


def east(y0: float, z0: float, y1: float, z1: float, depth: float = 0.0) -> list[tuple[float, float, float]]:
    """A rectangle of a wall at x = 30 that looks east, where y goes to the right."""
    x = 30.0 - depth
    return [(x, y0, z0), (x, y1, z0), (x, y1, z1), (x, y0, z1)]


def south(x0: float, z0: float, x1: float, z1: float) -> list[tuple[float, float, float]]:
    """A rectangle of a wall at y = 5 that looks south, where x goes to the right."""
    return [(x0, 5.0, z0), (x1, 5.0, z0), (x1, 5.0, z1), (x0, 5.0, z1)]


def opening(kind: str, id: str, corners: list[tuple[float, float, float]]) -> str:
    return f'<bldg:opening><bldg:{kind} gml:id="{id}">\n{surface(*corners)}</bldg:{kind}></bldg:opening>\n'


def wall(id: str, corners: list[tuple[float, float, float]], *inside: str, kind: str = "WallSurface") -> str:
    own = f'<bldg:{kind} gml:id="{id}">\n{surface(*corners)}{"".join(inside)}</bldg:{kind}>'
    return f"<bldg:boundedBy>{own}</bldg:boundedBy>\n"


def model(*parts: str, id: str = "b7") -> str:
    own = f'<bldg:Building gml:id="{id}">\n{"".join(parts)}</bldg:Building>'
    return f"{HEAD}<core:cityObjectMember>{own}</core:cityObjectMember>\n</core:CityModel>\n"


HOUSE = model(
    wall(
        "east",
        east(10, 400, 16, 406),
        opening("Window", "w1", east(11, 401, 12, 402.5, depth=0.15)),  # in its reveal
        opening("Door", "d1", east(13, 400, 14.1, 402.2)),
    ),
    wall("east above", east(10, 406, 16, 409), opening("Window", "w2", east(11, 407, 12, 408.5))),
    wall("south", south(20, 400, 30, 409), opening("Window", "w3", south(22, 401, 23.5, 402))),
    wall("blank", [(20, 9, 400), (20, 5, 400), (20, 5, 409), (20, 9, 409)]),
    wall(
        "top",
        [(20, 5, 409), (30, 5, 409), (30, 16, 409), (20, 16, 409)],
        opening("Window", "sky", [(22, 6, 409), (23, 6, 409), (23, 7, 409), (22, 7, 409)]),
        kind="RoofSurface",
    ),
)


def rects(building: str, path: Path) -> list[tuple[str, list[float]]]:
    return [(o["kind"], o["rect"]) for o in load_survey(building, path).openings]


@pytest.fixture
def written(tmp_path: Path) -> Any:
    def write(text: str, name: str = "city.gml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_a_file_as_a_building_model_is_exported(tmp_path: Path) -> None:
    """CityGML 1 of an IFC model: no names, its own encoding, last corners given twice, walls with two faces each."""

    def twice(text: str) -> str:  # the last corner of each ring
        return re.sub(r"(\S+ \S+ \S+)</gml:posList>", r"\1 \1</gml:posList>", text)

    def face(depth: float, turn: int) -> str:
        return "".join(
            wall(
                "", east(0.0 + depth, 0, 12.0 - depth, 2.7, depth)[::turn],
                *(opening(kind, "", east(*rect, depth)[::turn]) for kind, rect in openings),
            )
            for openings in ((("Window", (1, 0.8, 3, 2)), ("Door", (8, 0, 9, 2.01))),)
        )  # fmt: skip

    sill = [(30.0, 8.0, 0.0), (30.0, 9.0, 0.0), (29.7, 9.0, 0.0), (29.7, 8.0, 0.0)]
    threshold = wall("", sill, opening("Door", "", sill))
    text = model("<gml:name>Haus für alle</gml:name>", face(0.0, 1), face(0.3, -1), threshold)
    text = twice(text).replace(' gml:id=""', "").replace(' gml:id="b7"', "").replace("/2.0", "/1.0")
    path = tmp_path / "house.gml"
    path.write_bytes(text.replace("UTF-8", "windows-1252").encode("windows-1252"))
    assert buildings(path) == ("building 1/1", "building 1/2")  # from the street, and from the room
    outside, inside = (load_survey(name, path) for name in buildings(path))
    assert (outside.width, outside.height) == (12.0, 2.7)
    assert [(own["kind"], own["rect"]) for own in outside.openings] == [
        ("window", [1.0, 0.8, 3.0, 2.0]),
        ("door", [8.0, 0.0, 9.0, 2.01]),
    ]
    assert [own["rect"][0] for own in inside.openings] == [pytest.approx(8.7), pytest.approx(2.7)]
    path.write_bytes(text.replace("UTF-8", "klingon").encode("windows-1252"))
    with pytest.raises(SurveyError, match="it cannot be read as klingon, which it declares to be in"):
        buildings(path)


def test_openings_stand_where_one_sees_them_from_the_street(written: Any) -> None:
    """Walls in one plane are one façade; one without openings, and a window in a flat roof, are none."""
    path = written(HOUSE)
    assert buildings(path) == ("east", "south")
    survey = load_survey("east", path)
    assert (survey.width, survey.height) == (6.0, 9.0)
    assert rects("east", path) == [
        ("window", [1.0, 1.0, 2.0, 2.5]),
        ("door", [3.0, 0.0, 4.1, 2.2]),
        ("window", [1.0, 7.0, 2.0, 8.5]),
    ]
    assert rects("south", path) == [("window", [2.0, 1.0, 3.5, 2.0])]
    assert load_survey("east above", path).openings == survey.openings
    # The other way round, one looks from the other side.
    turned = model(wall("w", east(10, 0, 16, 3)[::-1], opening("Window", "a", east(11, 1, 12, 2)[::-1])))
    assert rects("b7", written(turned)) == [("window", [4.0, 1.0, 5.0, 2.0])]


def test_citygml_3_and_references(written: Any) -> None:
    link = (
        "<core:lod3MultiSurface><gml:MultiSurface><gml:surfaceMember>"
        '<gml:OrientableSurface orientation="+"><gml:baseSurface xlink:href="#p"/></gml:OrientableSurface>'
        "</gml:surfaceMember></gml:MultiSurface></core:lod3MultiSurface>"
    )
    text = (
        f'{HEAD}<core:cityObjectMember><bldg:Building gml:id="b"><core:boundary><con:WallSurface gml:id="w">'
        f"{surface(*south(0, 0, 8, 3), level='core:lod3MultiSurface')}"
        f'<con:fillingSurface><con:WindowSurface gml:id="o">{link}</con:WindowSurface></con:fillingSurface>'
        '<con:fillingSurface><con:DoorSurface gml:id="d">'
        f"{surface(*south(4, 0, 5, 2), level='core:lod3MultiSurface')}</con:DoorSurface></con:fillingSurface>"
        "</con:WallSurface></core:boundary></bldg:Building></core:cityObjectMember><gml:spare>"
        f'<gml:Polygon gml:id="p">{ring(*south(1, 1, 2, 2.5))}</gml:Polygon></gml:spare></core:CityModel>'
    )
    assert rects("b", written(text)) == [("window", [1, 1, 2, 2.5]), ("door", [4, 0, 5, 2])]
    with pytest.raises(SurveyError, match="there is no 'q'"):
        buildings(written(text.replace('"#p"', '"#q"')))


@pytest.mark.parametrize("name", ["residential-house", "teaser", "figure-8"])
def test_what_is_written_is_read_back_to_the_millimetre(name: str, tmp_path: Path) -> None:
    """In the teaser openings lie over others."""
    layout = solve(gallery.load(name))
    path = write_cityjson(layout, tmp_path / "house.json")
    expected = sorted((s.kind, *s.rect) for s in layout.shapes if s.kind in ("window", "door"))
    [building] = buildings(path)
    survey = load_survey(building, path)
    found = sorted((o["kind"], *o["rect"]) for o in survey.openings)
    assert [kind for kind, *_ in found] == [kind for kind, *_ in expected] and len(found) > 1
    for own, other in zip(found, expected, strict=True):
        assert own[1:] == pytest.approx(other[1:], abs=0.001)
    assert (survey.width, survey.height) == pytest.approx(
        (layout.canvas.width, layout.canvas.height), abs=0.001
    )


def cityjson(**changes: Any) -> dict[str, Any]:
    """A solid of version 1.1, with a wall and a window in it."""
    vertices = [*south(0, 0, 8, 3), *south(1, 1, 2, 2.5)]
    semantics = {
        "surfaces": [
            {"type": "WallSurface", "children": [1]},
            {"type": "Window", "parent": 0},
            {"type": "RoofSurface"},
        ],
        "values": [[0, 1, None]],
    }
    geometry = {
        "type": "Solid",
        "lod": "3.2",
        "boundaries": [[[[0, 1, 2, 3], [4, 7, 6, 5]], [[4, 5, 6, 7]], [[0, 1, 2]]]],
        "semantics": semantics | changes.pop("semantics", {}),
    }
    coarse = {"type": "MultiSurface", "lod": "2", "boundaries": []}
    return {
        "type": "CityJSON",
        "version": "1.1",
        "transform": {"scale": [0.01, 0.01, 0.01], "translate": [700000, 5400000, 0]},
        "CityObjects": {"h": {"type": "Building", "geometry": [coarse, geometry]}},
        "vertices": [[round(100 * v) for v in vertex] for vertex in vertices],
    } | changes


def test_a_solid_with_a_transform(written: Any) -> None:
    assert rects("h", written(json.dumps(cityjson()), "c.json")) == [("window", [1, 1, 2, 2.5])]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (HOUSE.replace("30 13 400 ", "30 13 4OO ", 1), "line 8: posList: expected numbers of metres, found '4OO'"),
        (HOUSE.replace("30 13 400 ", "30 13 ", 1), "line 8: posList: expected at least three corners"),
        (HOUSE.replace("</bldg:Door>", "</bldg:Dor>"), "line 8, column"),
        (
            HOUSE.replace("<core", '<!DOCTYPE x [<!ENTITY a "b">]>\n<core', 1),
            "a city model has no document type and no entities",
        ),
        (HOUSE.replace("<gml:MultiSurface>", '<gml:MultiSurface srsName="EPSG:4326">'), "expected coordinates"),
        ("<a/>", "line 1: a: expected a CityModel"),
        (
            model(wall("w", east(0, 0, 5, 3), '<bldg:opening><bldg:Window gml:id="w9"/></bldg:opening>')),
            "Window 'w9': expected an opening with a lod3MultiSurface of at least one polygon",
        ),
        (json.dumps(cityjson(vertices=[[0, 0]])), "vertices[0]: expected three numbers"),
        (
            json.dumps(cityjson(semantics={"values": [[0, 1]]})),
            "h.geometry[1].semantics.values: expected a number, or null, for each of the 3 surfaces; found 2",
        ),
        (json.dumps(cityjson(semantics={"values": [[0, 7, None]]})), "values[1]: expected a number from 0 to 2"),
        (
            json.dumps(cityjson(semantics={"surfaces": [{"type": "WallSurface"}, {"type": "Door", "parent": 5}]})),
            "semantics.surfaces[1].parent: expected the number of a surface that is no opening; found 5",
        ),
        (json.dumps(cityjson(CityObjects=3)), "CityObjects: expected an object with city objects; found 3"),
    ],
)  # fmt: skip
def test_faults_are_told_with_their_place_in_the_file(text: str, said: str, written: Any) -> None:
    with pytest.raises(SurveyError) as error:
        buildings(written(text))
    assert said in str(error.value)


def test_a_fault_of_a_facade_is_told_of_it_alone(written: Any) -> None:
    path = written(HOUSE.replace(surface(*south(22, 401, 23.5, 402)), surface(*south(22, 401, 22, 402))))
    assert len(load_survey("east", path).openings) == 3
    with pytest.raises(
        SurveyError, match=r"façade south: line \d+: Window 'w3': expected an opening with an extent"
    ):
        load_survey("south", path)


def test_the_command_infers_from_a_city_model(
    written: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(HOUSE)
    assert main(["infer", str(path)]) == 2
    assert "--building: expected the number of a façade;" in capsys.readouterr().err
    assert main(["infer", str(path), "--building", "est"]) == 2
    assert "did you mean 'east'" in capsys.readouterr().err
    out = tmp_path / "design.json"
    assert main(["infer", str(path), "--building", "east", "--out", str(out)]) == 0
    assert Design.from_json(out).canvas.width == 6
