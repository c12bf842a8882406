"""The studio of a building in JupyterLab: a wall is chosen, an edit moves the heights of all."""

from __future__ import annotations

from collections.abc import Callable

from playwright.sync_api import expect

from .jupyter import Notebook

CODE = """
from facade_nb import Building
house = gallery.load("residential-house")
document = house.to_dict()
document["name"] = "Plain house"
document["layers"] = document["layers"][:1] + document["layers"][3:]
plain = Design.from_dict(document)
around = BuildingStudio(Building.rectangle(6, 5, [house, plain, None, plain]), time_limit=600.0, height=420)
around
"""


def test_a_wall_is_chosen_and_the_heights_of_all_follow(show: Callable[[str], Notebook]) -> None:
    notebook = show(CODE)
    page = notebook.page
    strip = page.locator(".facade-nb-around")
    expect(strip.locator("svg")).to_be_visible()
    expect(strip).to_contain_text("Walls meet at 0.00, 1.60, 3.00, 4.50 m.")
    page.get_by_role("button", name="wall 2 · Plain house").click()
    notebook.expect_python("[around.wall, around.model.design.canvas.width]", ["wall 2", 5.0])
    expect(page.locator(".fnb-studio")).to_have_count(1)
    notebook.retype("Preferred size of P in metres", "2.1")
    notebook.expect_python("around.building.designs['Plain house'].symbols['P'].size", 2.1)
    expect(strip).not_to_contain_text("1.60")
    notebook.expect_python(
        "[around.solved.face('wall 1').layout.y.groups['default'].columns[1] > 1.65, len(around.solved.warnings)]",
        [True, 0],
    )


def test_plan_corners_and_roof_are_edited_by_keys_and_undone(show: Callable[[str], Notebook]) -> None:
    notebook = show(CODE)
    page = notebook.page
    expect(page.locator(".facade-nb-around svg")).to_be_visible()
    page.get_by_role("button", name="Plan, corners and roof").focus()
    page.keyboard.press("Enter")
    panel = page.locator(".facade-nb-plan")

    def retype(label: str, text: str) -> None:
        panel.get_by_label(label, exact=True).click()
        page.keyboard.press("Control+a")
        page.keyboard.type(text)
        page.keyboard.press("Enter")

    def choose(label: str) -> None:
        """Go one down in a list; letters are not the notebook's, where two d would delete the cell."""
        panel.get_by_label(label, exact=True).focus()
        page.keyboard.type("dd")
        page.keyboard.press("ArrowDown")

    retype("Depth", "6.5")
    notebook.expect_python("around.building.plan[2]", [6.0, 6.5])
    expect(page.get_by_role("button", name="wall 2 · Plain house · 6.50 m")).to_be_visible()
    expect(panel.get_by_label("Depth", exact=True)).to_be_focused()
    choose("Roof")
    notebook.expect_python("around.building.roof.kind", "gable")
    choose("Corner 2")
    notebook.expect_python("around.building.corners[1].kind", "quoins")
    retype("Depth", "-3")
    expect(panel.get_by_role("alert")).to_have_text("depth: expected metres above 0; found -3")
    notebook.expect_python("around.building.plan[2]", [6.0, 6.5])

    left = "[len(around.building.corners), around.building.roof.kind, around.building.plan[2][1]]"
    panel.get_by_role("button", name="Undo").focus()
    for state in ([0, "gable", 6.5], [0, "hip", 6.5], [0, "hip", 5.0]):
        page.keyboard.press("Enter")
        notebook.expect_python(left, state)
    expect(panel.get_by_role("button", name="Undo")).to_be_disabled()
    panel.get_by_role("button", name="Redo").focus()
    page.keyboard.press("Enter")
    notebook.expect_python(left, [0, "hip", 6.5])
