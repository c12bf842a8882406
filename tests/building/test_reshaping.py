"""What an editor of buildings changes: plans, walls, corners; and the studio that does, with its undo and its 3D."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from facade_nb import Building, DesignError
from facade_nb.building.reshaping import plan_of, reshaped, treated, walled
from facade_nb.render.pipeline.solids import BODY, GROUND
from facade_nb.widgets import BuildingStudio
from facade_nb.widgets.studio.whole import OTHER
from tests.building.houses import FRONT, SIDE

WALLS = {"front": FRONT, "right": SIDE, "back": SIDE, "left": FRONT}
HOUSE = Building.rectangle(12.0, 9.0, WALLS, height=9.9)


def test_a_plan_is_known_by_its_lengths_wherever_it_stands() -> None:
    ell = Building.ell(14.0, 12.0, (7.0, 6.0), FRONT, height=9.9)
    moved = replace(ell, plan=tuple((x + 3.0, y - 2.0) for x, y in ell.plan))
    assert plan_of(moved) == ("ell", {"width": 14.0, "depth": 12.0, "deep": 7.0, "wide": 6.0})
    row = Building.row([(5.0, FRONT), (6.0, SIDE)], 8.0, height=9.9)
    assert plan_of(row) == ("row", {"house 1": 5.0, "house 2": 6.0, "depth": 8.0})
    assert plan_of(HOUSE) == ("rectangle", {"width": 12.0, "depth": 9.0})
    skew = replace(HOUSE, plan=((0.0, 0.0), (12.0, 1.0), (12.0, 9.0), (0.0, 9.0)))
    assert plan_of(skew) == ("other", {})
    for one in (moved, row, HOUSE):
        assert reshaped(one, *plan_of(one)) == one


def test_walls_and_corners_are_found_again_in_another_plan() -> None:
    house = treated(treated(HOUSE, 1, "quoins"), 3, "chamfer", 2.0)
    assert [house.corners[k].kind for k in (1, 3)] == ["quoins", "chamfer"] and house.corners[3].width == 2.0
    ell = reshaped(house, "ell", {"deep": 4.0})
    assert ell.walls == ("Front", "Side", "Side", "Side", "Side", "Front")
    assert {k: corner.kind for k, corner in ell.corners.items()} == {1: "quoins", 5: "chamfer"}
    row = reshaped(house, "row", {"house 1": 4.0, "house 2": 5.0, "house 3": 6.0})
    assert row.walls == ("Front", "Front", "Front", "Side", "Side", "Side", "Side", "Front")
    assert {k: corner.kind for k, corner in row.corners.items()} == {3: "quoins", 7: "chamfer"}
    for other in (ell, row):
        assert reshaped(other, "rectangle", {"width": 12.0, "depth": 9.0}) == house
    assert treated(treated(house, 1, None), 3, None).corners == {}
    assert walled(HOUSE, 2, None).walls == ("Front", "Side", None, "Front")
    with pytest.raises(DesignError, match="room for the corners"):
        treated(HOUSE, 0, "chamfer", 30.0)


@pytest.fixture
def studio() -> Iterator[BuildingStudio]:
    made = BuildingStudio(HOUSE)
    yield made
    made.close()


def field(studio: BuildingStudio, label: str) -> object:
    return studio._panel._kept[label]


def test_plan_corners_and_roof_are_edited_and_undone(studio: BuildingStudio) -> None:
    field(studio, "Width").value = 10.0
    assert studio.building.plan[1] == (10.0, 0.0) and studio.model.design.canvas.width == 10.0
    studio.model.wait()
    assert studio.solved.building == studio.building
    field(studio, "Roof").value = "mansard"
    field(studio, "Rise").value = "2.5"
    field(studio, "Corner 2").value = "quoins"
    assert studio.building.roof.kind == "mansard" and studio.building.roof.rise == 2.5
    assert studio.building.corners[1].kind == "quoins"
    before = studio.building
    field(studio, "Rise").value = "high"
    assert "found &#x27;high&#x27;" in studio._panel._fault.value and studio.building == before
    field(studio, "Depth").value = 0.01
    assert "expected walls of at least 0.1 m" in studio._panel._fault.value and studio.building == before
    for wall in range(1, 5):
        field(studio, f"Wall {wall}").value = ""
    assert "all would be blind" in studio._panel._fault.value and studio.building.walls[3] == "Front"
    for wall, design in enumerate(HOUSE.walls, 1):
        field(studio, f"Wall {wall}").value = design
    for _ in range(6):
        studio.undo()
    assert studio.building == before
    studio.model.enter("symbols.G.size", "3.6")
    for _ in range(4):
        studio._panel.undo_button.click()
    assert studio._panel.undo_button.disabled
    assert (studio.building.plan, studio.building.roof, studio.building.corners) == (
        HOUSE.plan,
        HOUSE.roof,
        {},
    )
    assert field(studio, "Width").value == 12.0 and field(studio, "Roof").value == "hip"
    assert (
        studio.building.designs["Front"].symbol("G").size == 3.6
    )  # the wall's, which has an undo of its own
    for _ in range(4):
        studio._panel.redo_button.click()
    assert (studio.building.roof, set(studio.building.corners)) == (before.roof, {1})
    studio.choose("wall 2")
    field(studio, "Plan").value = "ell"
    assert (
        studio.wall == "wall 2"
        and len(studio.building.plan) == 6
        and studio.solved.building == studio.building
    )


def test_its_3d_has_the_whole_building_around_the_wall(studio: BuildingStudio) -> None:
    studio.choose("wall 2")
    studio.model.wait()
    solids = studio.model.whole.solids(studio.model.layout)
    names = list(studio.model.whole.walls())
    assert names == ["wall 1", "wall 2", "wall 3", "wall 4"]
    found = set(np.unique(solids.shapes).tolist())
    shapes = set(range(len(studio.model.layout.shapes)))
    others = {OTHER - k for k in (0, 2, 3)}
    assert found <= shapes | others | {BODY, GROUND} and others | {BODY, GROUND} <= found
    corners = solids.scene.vertices["position"][solids.scene.indices].reshape(-1, 3, 3)
    for k, shape in enumerate(studio.model.layout.shapes):  # where the elevation has it
        own = corners[solids.shapes == k].reshape(-1, 3)
        if len(own) and shape.geometry == "box" and shape.rect[0] > 0.5 and shape.rect[2] < 8.5:
            assert own[:, :2].min(axis=0) == pytest.approx(shape.rect[:2], abs=1e-4)
            assert own[:, :2].max(axis=0) == pytest.approx(shape.rect[2:], abs=1e-4)
    behind = corners[solids.shapes == OTHER - 3].reshape(-1, 3)  # across the house
    assert behind[:, 2].max() == pytest.approx(-12.0, abs=1.0)
    studio.model.whole.choose(0)
    assert studio.wall == "wall 1"
