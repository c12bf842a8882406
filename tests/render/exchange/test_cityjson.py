"""CityJSON, read again by cjio and by a reader that knows the specification's rules; areas by shapely."""

from __future__ import annotations

import json
from collections import Counter
from typing import Any

import pytest
import shapely

from facade_nb import Layout
from facade_nb.render import to_cityjson

from .samples import NAMES, layout, shape, solved, wall_with_window

# cjio has the whole process write JSON to six decimals from where it is imported on: that is taken back.
encoder = json.encoder.c_make_encoder
from cjio import cityjson  # noqa: E402

json.encoder.c_make_encoder = encoder
vars(json.encoder).pop("float", None)

KINDS = {"window": "Window", "door": "Door"}


def read(own: Layout) -> tuple[dict[str, Any], list[Any]]:
    """The geometry, and its surfaces as polygons seen from the street; every rule of the format holds."""
    text = to_cityjson(own)
    document = json.loads(text)
    assert (document["type"], document["version"]) == ("CityJSON", "2.0")
    scale, shift = document["transform"]["scale"], document["transform"]["translate"]
    assert all(isinstance(value, int) for vertex in document["vertices"] for value in vertex)
    points = [[n * s + t for n, s, t in zip(v, scale, shift, strict=True)] for v in document["vertices"]]
    assert len({tuple(vertex) for vertex in document["vertices"]}) == len(points)
    (building,) = document["CityObjects"].values()
    assert building["type"] == "Building"
    (geometry,) = building["geometry"]
    assert (geometry["type"], geometry["lod"]) == ("MultiSurface", "3")
    semantics = geometry["semantics"]
    assert len(semantics["values"]) == len(geometry["boundaries"])
    assert set(semantics["values"]) == set(range(len(semantics["surfaces"])))
    for number, surface in enumerate(semantics["surfaces"]):
        assert surface["type"] in {"WallSurface", "RoofSurface", "Window", "Door"}
        for child in surface.get("children", ()):
            assert semantics["surfaces"][child]["parent"] == number
        if "parent" in surface:
            assert number in semantics["surfaces"][surface["parent"]]["children"]
    used: set[int] = set()
    polygons = []
    for outer, *inner in geometry["boundaries"]:
        rings = []
        for ring in (outer, *inner):
            assert len(ring) >= 3 and len(set(ring)) == len(ring)  # not closed by its first point again
            used |= set(ring)
            assert {points[k][1] for k in ring} == {0.0}  # plane
            rings.append(shapely.LinearRing([(points[k][0], points[k][2]) for k in ring]))
        assert rings[0].is_ccw and not any(ring.is_ccw for ring in rings[1:])
        polygon = shapely.Polygon(rings[0], rings[1:])
        assert polygon.is_valid
        polygons.append(polygon)
    assert used == set(range(len(points)))  # no vertex without use
    model = cityjson.CityJSON(j=json.loads(text))
    assert model.get_version() == "2.0" and model.number_city_objects_level1() == 1
    assert not model.remove_duplicate_vertices() and not model.remove_orphan_vertices()
    return geometry, polygons


def test_the_reader_leaves_json_as_it_was() -> None:
    assert json.dumps(0.1 + 0.2) == "0.30000000000000004"


@pytest.mark.parametrize("name", NAMES)
def test_openings_are_those_of_the_layout(name: str) -> None:
    own = solved(name)
    geometry, polygons = read(own)
    surfaces, values = geometry["semantics"]["surfaces"], geometry["semantics"]["values"]
    found = Counter(surface["type"] for surface in surfaces)
    expected = Counter(KINDS[s.kind] for s in own.shapes if s.kind in KINDS)
    assert {kind: found[kind] for kind in ("Window", "Door")} == {
        kind: expected[kind] for kind in ("Window", "Door")
    }
    for value, surface in enumerate(surfaces):
        polygon = shapely.union_all([p for p, v in zip(polygons, values, strict=True) if v == value])
        if surface["type"] in KINDS.values():
            rect = own.shapes[surface["shape"]].rect
            assert (surface["width"], surface["height"]) == pytest.approx(
                (rect[2] - rect[0], rect[3] - rect[1]), abs=1e-4
            )
            later = [s for s in own.shapes[surface["shape"] + 1 :] if s.kind in KINDS]
            cut = shapely.union_all([shapely.box(*s.rect) for s in later])
            assert polygon.area == pytest.approx(shapely.box(*rect).difference(cut).area, abs=2e-3)
            assert shapely.box(*rect).buffer(1e-4).contains(polygon)
            assert surfaces[surface["parent"]]["type"] in ("WallSurface", "RoofSurface")
    whole = shapely.union_all([shapely.box(*s.rect) for s in own.shapes])
    total = sum(polygon.area for polygon in polygons)
    assert total == pytest.approx(whole.area, rel=1e-3)  # they cover what the shapes cover,
    assert shapely.union_all(polygons).area == pytest.approx(total, rel=1e-6)  # and never each other


def test_the_opening_is_cut_out_of_the_wall() -> None:
    geometry, polygons = read(wall_with_window())
    wall, window = polygons
    assert len(wall.interiors) == 1 and wall.area == 4 * 3 - 2 and window.area == 2
    assert geometry["semantics"]["surfaces"][0] == {"type": "WallSurface", "children": [1]}
    assert geometry["semantics"]["surfaces"][1]["name"] == "windows/W F"


def test_a_door_on_the_ground_is_a_notch_and_a_window_in_a_door_is_cut_out_of_it() -> None:
    own = layout(
        4,
        3,
        shape((0, 0, 4, 3)),
        shape((1, 0, 2, 2), "door", layer="doors"),
        shape((1.25, 1, 1.75, 1.5), "window", layer="panes"),
        shape((0, 3, 4, 4), "roof", layer="roof"),
    )
    geometry, polygons = read(own)
    types = [geometry["semantics"]["surfaces"][value]["type"] for value in geometry["semantics"]["values"]]
    areas = {kind: polygon.area for kind, polygon in zip(types, polygons, strict=True)}
    assert areas == pytest.approx({"WallSurface": 10, "RoofSurface": 4, "Door": 1.75, "Window": 0.25})


def test_an_opening_that_later_ones_cover_is_left_out() -> None:
    own = layout(2, 1, shape((0, 0, 1, 1), "window"), shape((0, 0, 2, 1), "window", layer="over"))
    geometry, polygons = read(own)
    assert [polygon.area for polygon in polygons] == [2]
    assert "parent" not in geometry["semantics"]["surfaces"][0]  # there is no wall


def test_an_empty_layout() -> None:
    document = json.loads(to_cityjson(layout(3, 2)))
    assert document["CityObjects"]["building-1"]["geometry"] == [] and document["vertices"] == []
