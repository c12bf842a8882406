"""The buildings that ship: each is read as it is written, solved to the best, and drawn whole."""

from __future__ import annotations

import json
from importlib import resources
from pathlib import Path

import pytest

from facade_nb import DesignError
from facade_nb import building as buildings
from facade_nb.building import Building
from facade_nb.render import drawing_faults

NAMES = ["corner-house", "row-of-houses", "yard-house"]


@pytest.mark.parametrize("name", NAMES)
def test_each_is_proven_and_drawn_whole(name: str) -> None:
    layout = buildings.load(name).solve()
    assert layout.proven and layout.complete and layout.warnings == ()
    for own in layout.faces:
        assert own.layout.holes == (), own.face.name
        if own.face.design is not None:  # what meets, meets in the wall itself
            bounds = {edge for shape in own.layout.shapes for edge in shape.rect[1::2]}
            assert set(layout.heights.groups["heights"].columns) <= bounds, own.face.name
    assert not drawing_faults(layout.developed)


def test_each_is_read_as_it_is_written() -> None:
    assert buildings.names() == NAMES
    for name in NAMES:
        file = resources.files("facade_nb.building").joinpath("documents", f"{name}.json")
        building = buildings.load(name)
        assert building.to_dict() == json.loads(file.read_text(encoding="utf-8"))
        assert Building.from_json(building.to_json()) == building


def test_each_shows_what_the_page_says() -> None:
    corner, yard, row = (buildings.load(name) for name in ("corner-house", "yard-house", "row-of-houses"))
    assert [own.kind for own in corner.corners.values()] == ["quoins", "chamfer", "quoins"]
    assert (len(yard.plan), yard.walls.count(None)) == (6, 2)
    assert row.walls[:4] == ("Brick house", "Painted house", "Brick house", "Painted house")
    kinds = {shape.geometry for own in yard.solve().faces for shape in own.shown.shapes}
    assert {"arch", "arcade(bays=1)", "loggia(depth=1.2)"} <= kinds


def test_an_unknown_name_tells_the_nearest() -> None:
    with pytest.raises(DesignError, match="found 'corner-hose'; did you mean 'corner-house'"):
        buildings.load("corner-hose")


def test_the_page_tells_of_each(root: Path) -> None:
    page = (root / "docs" / "buildings.md").read_text(encoding="utf-8")
    assert all(f"`{name}`" in page for name in buildings.names())
