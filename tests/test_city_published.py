"""City models as cities publish them: degrees, triangles around corners, references, openings that walls name."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from facade_nb.survey import SurveyError, buildings, load_survey

HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/{0}" xmlns:bldg="http://www.opengis.net/citygml/building/{0}"
 xmlns:con="http://www.opengis.net/citygml/construction/3.0" xmlns:gml="http://www.opengis.net/gml{1}"
 xmlns:xlink="http://www.w3.org/1999/xlink">
"""
Corner = tuple[float, float, float]


def polygon(corners: list[Corner], id: str = "", kind: str = "Polygon") -> str:
    text = " ".join(f"{v:.12g}" for corner in (*corners, corners[0]) for v in corner)
    named = f' gml:id="{id}"' if id else ""
    return (
        f"<gml:{kind}{named}><gml:exterior><gml:LinearRing><gml:posList>{text}</gml:posList></gml:LinearRing>"
        f"</gml:exterior></gml:{kind}>"
    )


def members(*inside: str) -> str:
    parts = "".join(f"<gml:surfaceMember>{own}</gml:surfaceMember>" for own in inside)
    return f"<gml:MultiSurface>{parts}</gml:MultiSurface>"


def south(x0: float, z0: float, x1: float, z1: float, y: float = 0.0) -> list[Corner]:
    return [(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)]


def east(y0: float, z0: float, y1: float, z1: float) -> list[Corner]:
    return [(9.0, y0, z0), (9.0, y1, z0), (9.0, y1, z1), (9.0, y0, z1)]


def triangles(corners: list[Corner]) -> list[str]:
    a, b, c, d = corners
    return [polygon([a, b, c], kind="Triangle"), polygon([a, c, d], kind="Triangle")]


def rects(path: Path, building: str | None = None) -> list[Any]:
    return [[own["kind"], *own["rect"]] for own in load_survey(building, path).openings]


def test_walls_at_lod_2_in_degrees_with_openings_at_lod_3(tmp_path: Path) -> None:
    """As the models of Japan are: latitude first, a height, EPSG 6697."""
    latitude, longitude = 36.086, 140.111

    def degrees(corners: list[Corner]) -> list[Corner]:
        bent = 1 - 0.00669438 * np.sin(np.radians(latitude)) ** 2
        tall = np.radians(1) * 6378137 * (1 - 0.00669438) / bent**1.5
        wide = np.radians(1) * 6378137 / bent**0.5 * np.cos(np.radians(latitude))
        return [(latitude + y / tall, longitude + x / wide, z) for x, y, z in corners]

    text = (
        HEAD.format("2.0", "")
        + '<gml:boundedBy><gml:Envelope srsName="SRS" srsDimension="3"/></gml:boundedBy>'
        '<core:cityObjectMember><bldg:Building gml:id="b"><bldg:boundedBy><bldg:WallSurface gml:id="w">'
        f"<bldg:lod2MultiSurface>{members(polygon(degrees(south(0, 10, 8, 16))))}</bldg:lod2MultiSurface>"
        '<bldg:opening><bldg:Window gml:id="o"><bldg:lod3MultiSurface>'
        f"{members(polygon(degrees(south(1, 11, 2.5, 13, 0.1))))}</bldg:lod3MultiSurface></bldg:Window></bldg:opening>"
        "</bldg:WallSurface></bldg:boundedBy></bldg:Building></core:cityObjectMember></core:CityModel>"
    )
    path = tmp_path / "city.gml"
    path.write_text(text.replace("SRS", "http://www.opengis.net/def/crs/EPSG/0/6697"))
    survey = load_survey("b", path)
    assert (survey.width, survey.height) == pytest.approx((8, 6), abs=1e-3)
    assert rects(path, "b")[0][1:] == pytest.approx([1, 1, 2.5, 3], abs=1e-3)
    path.write_text(text.replace("SRS", "EPSG:6697"))
    with pytest.raises(SurveyError, match=r"line 5: Envelope: expected .* the order of latitude"):
        load_survey("b", path)


def test_one_surface_of_triangles_around_a_corner_and_a_solid_by_reference(tmp_path: Path) -> None:
    """As the first LoD 3 models are. Of the solid's shell the wall has its polygons by their names alone."""
    window = members(polygon(south(1, 1, 2, 2.5, 0.15)[::-1]))  # turned inwards
    door = members(polygon(east(2, 0, 3, 2.1)))
    text = (
        HEAD.format("2.0", "")
        + '<core:cityObjectMember><bldg:Building gml:id="b"><bldg:lod3Solid><gml:Solid>'
        f"<gml:exterior><gml:CompositeSurface><gml:surfaceMember>{polygon(south(0, 0, 9, 6), 'p1')}</gml:surfaceMember>"
        "<gml:surfaceMember><gml:TriangulatedSurface gml:id='t'><gml:trianglePatches>"
        f"{''.join(triangles(east(0, 0, 5, 6)))}</gml:trianglePatches></gml:TriangulatedSurface></gml:surfaceMember>"
        "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod3Solid>"
        '<bldg:boundedBy><bldg:WallSurface gml:id="w"><bldg:lod3MultiSurface><gml:MultiSurface>'
        '<gml:surfaceMember xlink:href="#p1"/><gml:surfaceMember xlink:href="#t"/></gml:MultiSurface>'
        "</bldg:lod3MultiSurface>"
        f"<bldg:opening><bldg:Window><bldg:lod3MultiSurface>{window}</bldg:lod3MultiSurface></bldg:Window></bldg:opening>"
        f"<bldg:opening><bldg:Door><bldg:lod3MultiSurface>{door}</bldg:lod3MultiSurface></bldg:Door></bldg:opening>"
        "</bldg:WallSurface></bldg:boundedBy></bldg:Building></core:cityObjectMember></core:CityModel>"
    )
    path = tmp_path / "city.gml"
    path.write_text(text)
    assert len(buildings(path)) == 2
    assert rects(path, "b/1") == [["window", 1, 1, 2, 2.5]] and load_survey("b/1", path).width == 9
    assert rects(path, "b/2") == [["door", 2, 0, 3, 2.1]] and load_survey("b/2", path).width == 5


def test_a_window_of_citygml_3_that_has_its_surface_in_itself(tmp_path: Path) -> None:
    inner = f"<core:lod3MultiSurface>{members(polygon(south(1, 1, 2, 2.5)))}</core:lod3MultiSurface>"
    text = (
        HEAD.format("3.0", "/3.2")
        + '<core:cityObjectMember><bldg:Building gml:id="b"><core:boundary><con:WallSurface>'
        f"<core:lod3MultiSurface>{members(polygon(south(0, 0, 9, 6)))}</core:lod3MultiSurface></con:WallSurface>"
        "</core:boundary><bldg:buildingConstructiveElement><bldg:BuildingConstructiveElement><con:filling><con:Window>"
        f"<core:boundary><con:WindowSurface>{inner}</con:WindowSurface></core:boundary></con:Window></con:filling>"
        "</bldg:BuildingConstructiveElement></bldg:buildingConstructiveElement></bldg:Building>"
        "</core:cityObjectMember></core:CityModel>"
    )
    path = tmp_path / "city.gml"
    path.write_text(text)
    assert rects(path, "b") == [["window", 1, 1, 2, 2.5]]


@pytest.mark.parametrize("version", ["1.0", "1.1", "2.0"])
def test_cityjson_whose_walls_name_their_openings(version: str, tmp_path: Path) -> None:
    """A solid with a void that has no values, coordinates on a grid, no word of the parent."""
    every = [south(0, 0, 9, 6), south(1, 1, 2, 2.5, 0.3), south(3, 1, 4, 2)]
    vertices = [[round(1000 * v) + 5000 for v in corner] for corners in every for corner in corners]
    faces = [[[4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3]] for k in range(3)]
    document = {
        "type": "CityJSON",
        "version": version,
        "transform": {"scale": [0.001] * 3, "translate": [350000.0, 5600000.0, -5.0]},
        "CityObjects": {
            "b": {
                "type": "Building",
                "geometry": [
                    {
                        "type": "Solid",
                        "lod": 3 if version == "1.0" else "3.2",
                        "boundaries": [faces[:2], faces[2:]],
                        "semantics": {
                            "surfaces": [{"type": "WallSurface", "children": [1]}, {"type": "Window"}],
                            "values": [[0, 1], None],
                        },
                    }
                ],
            }
        },
        "vertices": vertices,
    }
    path = tmp_path / "city.json"
    path.write_text(json.dumps(document))
    assert rects(path, "b") == [["window", 1, 1, 2, 2.5]] and load_survey("b", path).width == 9
