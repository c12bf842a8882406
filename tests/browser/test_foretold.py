"""What the studio and the picture of a texture ask, answered wrong and right, by keys, in a real JupyterLab."""

from __future__ import annotations

import textwrap
from pathlib import Path

from playwright.sync_api import expect

from .jupyter import Notebook
from .test_questions import PIXEL, RED, press

HOUSE = """
from facade_nb import gallery
from facade_nb.widgets import *
house = Studio(gallery.load("residential-house"), name="", height=420)
display(house)
"""


def test_another_width_and_a_pixel_are_predicted(lab: Notebook, out: Path) -> None:
    """A wrong number brings the hint; the right one is green, and the canvas changes when the reader says so."""
    texture = textwrap.dedent(PIXEL).replace(
        "PixelInspector(model)", "TextureView(model, layout={'width': '420px'})"
    )
    lab.run(HOUSE + texture)
    own = lab.page.locator(".fnb-predicting")
    expect(own.get_by_role("button")).to_have_count(1)  # nothing else is there until it asks
    press(own, "Predict")
    expect(own).to_contain_text("The canvas becomes 9 m wide. How many B will Bx have? Now there are 3.")
    own.get_by_role("radio", name="3", exact=True).press("Space")
    press(own, "Check")
    expect(own.locator(".fnb-quiz-outcome")).to_have_text("Not yet.")
    expect(own.locator(".fnb-quiz-hint")).to_contain_text("makes 1.7 m")
    own.get_by_role("radio", name="5", exact=True).press("Space")
    press(own, "Check")
    expect(own.locator(".fnb-quiz-outcome")).to_contain_text("Right. The solver takes it")
    assert own.evaluate(RED) == []
    lab.page.locator(".fnb-studio").screenshot(path=out / "question-width.png")
    lab.expect_python("house.model.design.canvas.width", 6.0)
    press(own, "Make it 9 m wide")
    lab.expect_python("house.model.design.canvas.width", 9.0)
    expect(own.locator(".fnb-quiz")).to_have_count(0)

    view = lab.page.locator(".fnb-tex-picture")
    press(view, "Predict")
    view.get_by_role("radio", name="Side", exact=True).press("Space")
    press(view, "Check")
    expect(view.locator(".fnb-quiz-outcome")).to_have_text("Not yet.")
    view.get_by_role("radio", name="Column", exact=True).press("Space")
    press(view, "Check")
    expect(view.locator(".fnb-quiz-outcome")).to_have_text("Right. It lies in this part.")
    assert view.evaluate(RED) == []
    view.screenshot(path=out / "question-picture.png")
