"""Heights, uses and roofs of real footprints: what tags say, and what is inferred where they are silent."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from facade_nb.render.town import Town
from facade_nb.render.town.plan import KINDS, ROOFS
from facade_nb.render.town.tags import USES, levels_of, metres_of, roof_of, use_of

from .places import box, collection, feature


@pytest.mark.parametrize(
    ("value", "metres"),
    [
        ("12", 12), (12, 12), (12.5, 12.5), ("12 m", 12), ("12m", 12), (" 12.5 metres ", 12.5), ("12,5", 12.5),
        ("40 ft", 12.192), ("40'", 12.192), ("40'6\"", 12.344), ("40 feet", 12.192),
        ("", None), ("high", None), ("-5", None), (0, None), ("0", None), (True, None), (None, None), ([12], None),
        ("12 km", None), ("1e3", None), (500, None), ("12 m 3\"", None), (float("nan"), None), ("1" * 50, None),
    ],
)  # fmt: skip
def test_heights(value: Any, metres: float | None) -> None:
    assert metres_of(value) == metres


@pytest.mark.parametrize(
    ("value", "levels"),
    [
        ("3", 3), (3, 3), ("2.5", 3), (2.5, 3), ("3;4", 3), ("2+1", 2), ("1", 1),
        ("0", None), ("-2", None), ("many", None), (True, None), (None, None), ("500", None), (float("nan"), None),
        (float("inf"), None), ([3], None),
    ],
)  # fmt: skip
def test_storeys(value: Any, levels: int | None) -> None:
    assert levels_of(value) == levels


@pytest.mark.parametrize(
    ("tags", "use"),
    [
        ({"building": "yes"}, "unknown"), ({"building": "House"}, "house"), ({"building": "garage"}, "outbuilding"),
        ({"building": "apartments"}, "apartments"), ({"building": "warehouse"}, "industry"),
        ({"building": "yes", "shop": "wine"}, "commerce"), ({"building": "yes", "amenity": "school"}, "public"),
        ({"building": "church"}, "public"), ({"building": "retail"}, "commerce"),
        ({"building": 7}, "unknown"), ({}, "unknown"),
    ],
)  # fmt: skip
def test_uses(tags: dict[str, Any], use: str) -> None:
    assert USES[use_of(tags)] == use


@pytest.mark.parametrize(
    ("shape", "kind"),
    [("flat", "flat"), ("gabled", "gable"), ("Hipped", "hip"), ("mansard", "mansard"), ("skillion", "shed")],
)
def test_roofs_are_those_that_are_given(shape: str, kind: str) -> None:
    assert ROOFS[roof_of({"roof:shape": shape})] == kind
    town = Town.from_geojson(collection(feature(box(0, 0, 12, 9), **{"roof:shape": shape})))
    assert town.buildings["roof"].tolist() == [kind]


def test_a_roof_of_an_unknown_shape_is_as_if_none_were_given() -> None:
    assert roof_of({"roof:shape": "onion"}) == roof_of({}) == roof_of({"roof:shape": 3}) == -1


def first(**tags: Any) -> Any:
    return Town.from_geojson(collection(feature(box(0, 0, 14, 11), **tags))).buildings.iloc[0]


def test_a_height_is_that_of_the_ridge() -> None:
    for roof in ("flat", "gabled", "hipped", "mansard", "skillion"):
        own = first(height="14.5 m", **{"roof:shape": roof, "building:levels": "9"})
        assert own["height"] == pytest.approx(14.5)
        assert (own["eaves"] < 14.5) == (roof != "flat")
    assert first(height="3", **{"roof:shape": "gabled"})["eaves"] > 1


def test_levels_are_kept_and_have_a_style_that_suits_them() -> None:
    for levels in (1, 2, 3, 5, 9, 14, 40):
        own = first(**{"building:levels": str(levels)})
        assert own["storeys"] == levels
    town = Town.from_geojson(collection(feature(box(0, 0, 14, 11), **{"building:levels": "9"})))
    style = town.styles[town.plan.style[0]]
    assert style.storeys[0] <= 9 <= style.storeys[1]
    assert town.plan.eaves[0] == pytest.approx(style.eaves(9))


def test_the_storeys_of_a_height_are_those_that_the_grammar_makes() -> None:
    for height in ("7", "11", "16", "22", "31"):
        town = Town.from_geojson(collection(feature(box(0, 0, 14, 11), height=height)))
        own, style = town.buildings.iloc[0], town.styles[town.plan.style[0]]
        assert own["storeys"] == style.fit(float(own["eaves"]))


def test_what_is_not_told_follows_area_and_neighbours() -> None:
    alone = [feature(box(60 * k, 0, 11, 10)) for k in range(20)]
    small = [feature(box(60 * k, 60, 5, 5)) for k in range(20)]
    large = [feature(box(140 * k, 200, 60, 40)) for k in range(10)]
    street = [feature(box(12 * k, 400 + 16 * j, 12, 13)) for k in range(12) for j in range(4)]
    buildings = Town.from_geojson(collection(*alone, *small, *large, *street)).buildings
    parts = np.split(np.arange(len(buildings)), np.cumsum([20, 20, 10]))
    houses, sheds, halls, town = (buildings.iloc[part] for part in parts)
    assert houses["storeys"].between(1, 3).all() and set(houses["kind"]) == {KINDS[0]}
    assert (sheds["kind"] == "outbuilding").all() and (sheds["height"] < 4).all()
    assert (halls["kind"] == "industrial").all()
    assert town["storeys"].mean() > houses["storeys"].mean() + 0.8


def test_another_seed_chooses_otherwise_and_keeps_what_is_told() -> None:
    source = collection(
        *(feature(box(30 * k, 0), **({"building:levels": "2"} if k % 2 else {})) for k in range(30))
    )
    one, same, other = (Town.from_geojson(source, seed).buildings for seed in (1, 1, 2))
    assert one.equals(same) and not one.equals(other)
    assert (one["area"] == other["area"]).all() and (other["storeys"].iloc[1::2] == 2).all()
