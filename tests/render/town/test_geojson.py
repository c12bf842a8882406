"""Real footprints: what is read, what is left out and why, what is told when nothing can be used."""

from __future__ import annotations

import copy
import gzip
import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from facade_nb.design.errors import DesignError
from facade_nb.render.town import Town
from facade_nb.render.town.geojson import read_outlines
from facade_nb.render.town.projection import to_metres

from .places import CENTRE, box, collection, ell, feature, ring

HOUSE = feature(box(0, 0))
OTHER = feature(box(40, 0))


def polygon(*points: tuple[float, float]) -> dict[str, Any]:
    return feature(points)


def with_coordinates(coordinates: Any, kind: str = "Polygon") -> dict[str, Any]:
    return {
        "type": "Feature",
        "properties": {"building": "yes"},
        "geometry": {"type": kind, "coordinates": coordinates},
    }


FAULTS: list[tuple[str, Any]] = [
    ("crossing itself", polygon((80, 0), (90, 10), (90, 0), (80, 10))),
    (
        "crossing itself",
        polygon((80, 0), (100, 0), (100, 10), (90, 10), (90, -5), (85, -5), (85, 10), (80, 10)),
    ),
    ("crossing itself", feature(box(80, 0, 20, 20), box(95, 5, 10, 4)[::-1])),
    ("smaller than 4 m²", polygon(*box(80, 0, 1, 1))),
    ("smaller than 4 m²", polygon((80, 0), (90, 0), (90, 0.1))),
    ("of fewer than three corners", polygon((80, 0), (90, 0))),
    ("of fewer than three corners", polygon((80, 0), (80, 0), (80, 0), (80, 0))),
    ("empty", with_coordinates([])),
    ("empty", with_coordinates([[]])),
    ("empty", with_coordinates([], "MultiPolygon")),
    ("empty", {"type": "Feature", "properties": {}, "geometry": None}),
    ("given twice", copy.deepcopy(HOUSE)),
    ("given twice", feature([box(0, 0)[k] for k in (2, 3, 0, 1)])),
    ("given twice", feature(box(0, 0)[::-1])),
    ("within another", feature(box(2, 2, 4, 4))),
    ("out of range (longitude ±180, latitude ±90)", with_coordinates([[[11, 95], [11.1, 95], [11.1, 95.1]]])),
    ("out of range (longitude ±180, latitude ±90)", with_coordinates([[[4e5, 5e6], [4e5, 6e6], [5e5, 6e6]]])),
    (
        "further than 60 km from the others",
        with_coordinates([[[13, 49], [13.1, 49], [13.1, 49.1], [13, 49]]]),
    ),
    ("malformed coordinates", with_coordinates("here")),
    ("malformed coordinates", with_coordinates([[["11", "49"], ["12", "49"], ["12", "50"]]])),
    ("malformed coordinates", with_coordinates([[[11], [12], [13]]])),
    ("malformed coordinates", with_coordinates([[11, 49], [12, 49], [12, 50]])),
    ("malformed coordinates", with_coordinates([[[11, None], [12, 49], [12, 50]]])),
    ("malformed coordinates", with_coordinates([[[11, float("nan")], [12, 49], [12, 50]]])),
    ("malformed coordinates", with_coordinates([[[True, 49], [12, 49], [12, 50]]])),
    ("malformed coordinates", with_coordinates({"x": 1})),
    ("malformed coordinates", with_coordinates([7, 8])),
    ("not a polygon", with_coordinates([11, 49], "Point")),
    ("not a polygon", with_coordinates([[11, 49], [12, 49]], "LineString")),
    ("not a feature or geometry", {"type": "Banana"}),
    ("not a feature or geometry", 7),
    ("not a feature or geometry", None),
    ("not a building", {**polygon(*box(80, 0)), "properties": {"landuse": "grass"}}),
    ("not a building", feature(box(80, 0), building="no")),
    ("not a building", {**polygon(*box(80, 0)), "properties": None}),
]


@pytest.mark.parametrize(("reason", "fault"), FAULTS)
def test_one_fault_is_counted_and_the_rest_goes_on(reason: str, fault: Any) -> None:
    found = read_outlines(collection(HOUSE, fault, OTHER))
    assert found.left_out == {reason: 1}
    assert len(found.tags) == 2
    town = Town.from_geojson(collection(HOUSE, fault, OTHER))
    assert len(town.plan) == 2 and town.left_out == {reason: 1}


@pytest.mark.parametrize(
    ("reason", "fault"), [own for own in FAULTS if "twice" not in own[0] and "with" not in own[0]]
)
def test_where_nothing_is_left_it_is_said_why(reason: str, fault: Any) -> None:
    if reason in ("not a building", "further than 60 km from the others"):  # alone it is one
        return
    with pytest.raises(DesignError) as error:
        Town.from_geojson(collection(fault))
    assert "expected footprints of buildings (polygons); found none: left out: 1 " + reason in str(
        error.value
    )


@pytest.mark.parametrize(
    ("document", "message"),
    [
        ({}, r"type: expected GeoJSON \('FeatureCollection', .*\); found no type"),
        ([], "expected GeoJSON as a dict, or the path of a file; found list"),
        (7, "expected GeoJSON as a dict, or the path of a file; found int"),
        ({"type": "Topology"}, "type: expected GeoJSON .*; found 'Topology'"),
        ({"type": "featurecollection"}, "did you mean 'FeatureCollection'"),
        ({"type": "FeatureCollection"}, "features: expected a list of features; found none"),
        (collection(), "found none: there is no feature"),
        ({"type": "Point", "coordinates": [1, 2]}, "found none: left out: 1 not a polygon"),
        (
            {
                **collection(HOUSE),
                "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}},
            },
            r"crs: expected longitude and latitude \(WGS 84, CRS84 or EPSG:4326\); found 'urn:ogc:def:crs:EPSG::25832'",
        ),
        ({**collection(HOUSE), "crs": 7}, "crs: expected longitude and latitude"),
        (
            collection(with_coordinates([[[4e5, 5e6], [4e5, 6e6], [5e5, 6e6]]])),
            "are they metres of a map. Longitude and latitude",
        ),
    ],
)
def test_foreign_documents(document: Any, message: str) -> None:
    with pytest.raises(DesignError, match=message):
        Town.from_geojson(document)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.geojson", b"{", "this is not JSON"),
        ("a.geojson", b"", "this is not JSON"),
        ("a.geojson", b"\xff\xfe{", "not text in UTF-8"),
        ("a.geojson", b"[1, 2]", "expected GeoJSON, an object with a type; found a list"),
        ("a.geojson", b"7", "expected GeoJSON, an object with a type; found 7"),
        ("a.geojson.gz", gzip.compress(b"{}", mtime=0)[:-5], "its gzip is broken"),
        ("a.geojson.gz", b"\x1f\x8bnothing", "its gzip is broken"),
        ("a.geojson.gz", gzip.compress(b"\xff\xff", mtime=0), "not text in UTF-8"),
        ("a.geojson.gz", gzip.compress(b"{", mtime=0), "this is not JSON"),
    ],
)
def test_broken_files(tmp_path: Path, name: str, content: bytes, message: str) -> None:
    file = tmp_path / name
    file.write_bytes(content)
    with pytest.raises(DesignError, match=message) as error:
        Town.from_geojson(file)
    assert name in str(error.value)


def test_files_that_are_not_there(tmp_path: Path) -> None:
    for path in (tmp_path / "none.geojson", tmp_path, "\0"):
        with pytest.raises(DesignError, match="cannot be read as GeoJSON"):
            Town.from_geojson(path)


def test_every_way_to_give_the_same_footprints(tmp_path: Path) -> None:
    document = collection(HOUSE, OTHER)
    wanted = read_outlines(document)
    text = json.dumps(document)
    plain, packed, unnamed = tmp_path / "a.geojson", tmp_path / "a.json.gz", tmp_path / "b.json"
    plain.write_text(text, encoding="utf-8")
    packed.write_bytes(gzip.compress(text.encode()))
    unnamed.write_bytes(b"\xef\xbb\xbf" + text.encode())
    both = [own["geometry"]["coordinates"] for own in (HOUSE, OTHER)]
    high = copy.deepcopy(document)
    for own in high["features"]:
        own["geometry"]["coordinates"] = [[[*p, 431.0] for p in r] for r in own["geometry"]["coordinates"]]
    open_ring = copy.deepcopy(document)
    for own in open_ring["features"]:
        own["geometry"]["coordinates"][0].pop()
    known = {"type": "name", "properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}}
    for source in (
        plain,
        str(packed),
        unnamed,
        text,
        high,
        open_ring,
        {**document, "crs": known},
        {**document, "crs": None},
        {"type": "MultiPolygon", "coordinates": both},
        {"type": "Feature", "properties": {}, "geometry": {"type": "MultiPolygon", "coordinates": both}},
        {"type": "GeometryCollection", "geometries": [own["geometry"] for own in (HOUSE, OTHER)]},
    ):
        found = read_outlines(source)
        assert (found.corners == wanted.corners).all() and (found.offsets == wanted.offsets).all()
        assert not found.left_out


def test_footprints_are_used_as_they_are() -> None:
    yard = feature(box(0, 0, 30, 24), box(8, 8, 10, 8)[::-1])
    shape = feature(ell(60, 0))
    found = read_outlines(collection(yard, shape, HOUSE | {"geometry": feature(box(-40, 0))["geometry"]}))
    assert found.holes.tolist() == [False, True, False, False] and found.ring_of.tolist() == [0, 0, 1, 2]
    sizes = shapely.area(found.polygons())
    assert sizes == pytest.approx([30 * 24 - 80, 14 * 12 - 8 * 6, 80], rel=8e-3)
    town = Town.from_geojson(collection(yard, shape))
    assert town.buildings["area"].tolist() == pytest.approx(sizes[:2].tolist(), abs=0.05)


def test_walls_in_common_are_found_within_centimetres() -> None:
    def roles(gap: float) -> list[int]:
        plan = Town.from_geojson(collection(feature(box(0, 0)), feature(box(10 + gap, 2, 9, 9)))).plan
        return [int((plan.role[plan.building == b] == 3).sum()) for b in (0, 1)]

    assert roles(0.0) == roles(0.03) == roles(-0.03) == [1, 1]
    assert roles(0.4) == [0, 0]


def test_a_wall_that_is_covered_in_part_is_cut() -> None:
    plan = Town.from_geojson(collection(feature(box(0, 0, 12, 20)), feature(box(12, 6, 9, 8)))).plan
    own = plan.building == 0
    assert own.sum() == 6 and plan.added[own].sum() == 2
    spans = np.hypot(*(plan.corners[plan.following] - plan.corners).T)
    assert spans[own & (plan.role == 3)] == pytest.approx([8], rel=5e-3)


def test_buildings_drawn_over_each_other_have_no_door_inside() -> None:
    plan = Town.from_geojson(collection(feature(box(0, 0, 14, 14)), feature(box(8, 4, 14, 5)))).plan
    polygons = [shapely.Polygon(plan.corners[plan.building == b]) for b in (0, 1)]
    middle = (plan.corners + plan.corners[plan.following]) / 2
    for edge, (x, y) in enumerate(middle.tolist()):
        other = polygons[1 - plan.building[edge]]
        assert (plan.role[edge] == 3) == other.contains(shapely.Point(x, y)), edge
    assert (plan.role[plan.entrance] != 3).all()


def test_the_front_looks_to_the_open() -> None:
    """A row of houses with a wall behind it."""
    row = [feature(box(14 * k, 0, 9, 9)) for k in range(6)]
    plan = Town.from_geojson(collection(*row, feature(box(-20, 14, 130, 12)))).plan
    way = plan.corners[plan.following] - plan.corners
    for building in range(1, 5):
        along = way[plan.entrance[building]]
        assert along[0] > 0.9 * np.hypot(*along)  # outside is on the right of east: south


# Projection


def vincenty(a: tuple[float, float], b: tuple[float, float]) -> float:
    """The shortest way on the ellipsoid, metres: Vincenty's inverse formula."""
    axis, f = 6378137.0, 1 / 298.257223563
    polar = axis * (1 - f)
    (l1, p1), (l2, p2) = (np.radians(v) for v in (a, b))
    u1, u2 = np.arctan((1 - f) * np.tan(p1)), np.arctan((1 - f) * np.tan(p2))
    turn = l2 - l1
    lam = turn
    for _ in range(100):
        sin = np.hypot(
            np.cos(u2) * np.sin(lam), np.cos(u1) * np.sin(u2) - np.sin(u1) * np.cos(u2) * np.cos(lam)
        )
        cos = np.sin(u1) * np.sin(u2) + np.cos(u1) * np.cos(u2) * np.cos(lam)
        sigma = np.arctan2(sin, cos)
        alpha = np.cos(u1) * np.cos(u2) * np.sin(lam) / sin
        cos2 = 1 - alpha**2
        mid = cos - 2 * np.sin(u1) * np.sin(u2) / cos2
        c = f / 16 * cos2 * (4 + f * (4 - 3 * cos2))
        lam = turn + (1 - c) * f * alpha * (sigma + c * sin * (mid + c * cos * (2 * mid**2 - 1)))
    square = cos2 * (axis**2 - polar**2) / polar**2
    a_ = 1 + square / 16384 * (4096 + square * (-768 + square * (320 - 175 * square)))
    b_ = square / 1024 * (256 + square * (-128 + square * (74 - 47 * square)))
    delta = (
        b_
        * sin
        * (mid + b_ / 4 * (cos * (2 * mid**2 - 1) - b_ / 6 * mid * (4 * sin**2 - 3) * (4 * mid**2 - 3)))
    )
    return float(polar * a_ * (sigma - delta))


@pytest.mark.parametrize("centre", [(9.5, 47.1), (11.58, 49.95), (-70.0, -33.0), (179.95, 64.0), (0.0, 0.3)])
def test_distances_from_the_centre_are_true(centre: tuple[float, float]) -> None:
    rng = np.random.default_rng(2)
    away = rng.uniform(-0.2, 0.2, (40, 2)) + 1e-4
    places = np.array(centre) + away
    places[:, 0] = (places[:, 0] + 180) % 360 - 180
    metres = to_metres(places, centre)
    for (lon, lat), (x, y) in zip(places.tolist(), metres.tolist(), strict=True):
        apart = centre[0] + (lon - centre[0] + 540) % 360 - 180
        way = vincenty(centre, (apart, lat))
        # From its centre, a transverse projection lengthens ways by x² / 6 R² where they go east.
        assert np.hypot(x, y) == pytest.approx(way * (1 + x * x / (6 * 6.37e6**2)), abs=0.02 + 1e-7 * way)
        assert np.sign(x) == np.sign(apart - centre[0]) and np.sign(y) == np.sign(lat - centre[1])


def test_a_town_on_both_sides_of_the_date_line() -> None:
    def at(x: float) -> dict[str, Any]:
        points = [[(179.9999 + (p[0] - CENTRE[0]) + 180) % 360 - 180, p[1]] for p in ring(box(x, 0))]
        return with_coordinates([points])

    found = read_outlines(collection(at(-20), at(0), at(20)))
    assert not found.left_out and np.ptp(found.corners[:, 0]) == pytest.approx(50, rel=0.01)


# Real towns


def data(name: str) -> Path:
    given = os.environ.get("FACADE_NB_DATA")
    folder = Path(given) if given else Path(__file__).resolve().parents[4] / "shared" / "data"
    file = (folder if folder.is_dir() else folder.parent) / "towns" / name
    if not file.is_file():  # the data have a licence of their own, and are not part of the repository
        pytest.skip(f"{file} is not there: footprints © OpenStreetMap contributors (ODbL)")
    return file


@pytest.mark.parametrize(
    ("name", "buildings", "features"),
    [("liechtenstein.geojson.gz", 1496, 1499), ("bayreuth.geojson.gz", 4266, 4267)],
)
def test_real_towns(name: str, buildings: int, features: int) -> None:
    """All of a town, which is read as a file; every sixth building of a country, villages apart."""
    given: Any = data(name)
    if name.startswith("liechtenstein"):
        given = json.loads(gzip.decompress(given.read_bytes()))
        given["features"] = given["features"][::6]
    town = Town.from_geojson(given)
    assert len(town.buildings) == buildings
    assert buildings + sum(town.left_out.values()) == features
    assert town.buildings["height"].between(2, 30).all()
    assert (town.plan.entrance >= 0).mean() > 0.75
    assert town.stats()["bytes"]["vertices"] < 70e6
    assert town.vertices["position"].max() < 60_000
