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
