"""The studio of a building: one wall is edited, the heights of all follow."""

from __future__ import annotations

from dataclasses import replace

import pytest

from facade_nb import Building
from facade_nb.building.treatments import quoins
from facade_nb.design.model import Canvas
from facade_nb.widgets import BuildingStudio
from tests.building.houses import FRONT, SIDE


@pytest.fixture
def studio():
    building = Building.rectangle(
        9.0, 7.2, [FRONT, SIDE, FRONT, None], height=9.9, corners={0: ("quoins", quoins())}
    )
    made = BuildingStudio(building)
    yield made
    made.close()


def test_an_edit_of_one_wall_moves_the_heights_of_all(studio):
    assert studio.wall == "wall 1"
    before = studio.solved.face("wall 2").layout.y.groups["default"].columns
    studio.model.enter("symbols.G.size", "4.6")
    studio.model.wait()
    after = studio.solved
    assert studio.building.designs["Front"].symbol("G").size == 4.6
    assert after.face("wall 2").layout.y.groups["default"].columns[1] > before[1] + 0.2
    assert studio.model.layout.shapes == after.face("wall 3").layout.shapes  # of the same design and width
    assert {shape.layer for shape in studio.model.layout.shapes} == {"wall"}  # quoins are not this design's


def test_another_wall_is_chosen(studio):
    studio.model.enter("symbols.G.size", "4.6")
    studio.model.wait()
    studio.choose("wall 2")
    assert studio.model.design == replace(SIDE, canvas=Canvas(7.2, 9.9))
    assert studio.model.layout.y.groups["default"].columns == (
        studio.solved.face("wall 1").layout.y.groups["default"].columns
    )
    studio.choose("wall 3")  # it has what was edited on wall 1, and nothing to undo into another wall
    assert studio.model.design.symbol("G").size == 4.6
    studio.choose("quoins Quoins")
    assert studio.model.layout.shapes and studio.model.design.canvas.width == pytest.approx(1.5)
    assert "wall 2" in studio._strip.value and "Walls meet at" in studio._strip.value
    with pytest.raises(
        ValueError, match="expected one of wall 1, wall 2, wall 3, quoins Quoins; found 'wall 4'"
    ):
        studio.choose("wall 4")


def test_the_width_is_the_plans_and_the_height_the_buildings(studio):
    studio.model.edit(lambda own: replace(own, canvas=Canvas(5.0, 11.0)))
    studio.model.wait()
    assert studio.model.design.canvas == Canvas(9.0, 11.0)
    assert studio.building.height == 11.0 and studio.solved.building.height == 11.0
    studio.building = Building.rectangle(4.5, 3.0, [SIDE, None, None, None], height=9.9)
    assert studio.model.design.canvas == Canvas(4.5, 9.9)
    assert studio.solved.building == studio.building
