"""A building's studio in JupyterLab: a click in its 3D chooses another wall; the strip has the theme of the page."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from playwright.sync_api import expect

from .jupyter import Notebook
from .waiting import frames, until

CODE = """
from facade_nb import Building
import numpy as np
house = gallery.load("residential-house")
walls = BuildingStudio(Building.rectangle(6, 5, house), time_limit=600.0, height=420, view="building")
def middle(name, pixels):
    # Where the middle of a wall is in the picture, as a share of it.
    from facade_nb.building.bodies import Frame
    chosen, own = (Frame.of(walls.solved.face(one)) for one in (walls.wall, name))
    face = walls.solved.face(name).face
    point = own.place(np.array([face.length / 2, 1.5, 0.0]))
    x, y, z = chosen.axes @ (point - chosen.origin)
    studio = walls._studios[walls.wall]
    clip = studio.viewpoint(pixels).frustum(pixels).matrix @ np.array([x, y, z, 1.0])
    return [float((clip[0] / clip[3] + 1) / 2), float((1 - clip[1] / clip[3]) / 2)]
walls
"""


def test_a_click_on_another_wall_chooses_it(show: Callable[[str], Notebook], out: Path) -> None:
    notebook = show(CODE)
    page = notebook.page
    canvas = page.locator(".fnb-building-canvas")
    expect(canvas).to_have_attribute("data-state", "sharp")
    canvas.scroll_into_view_if_needed()
    frames(page)
    box = canvas.bounding_box()
    assert box
    pixels = round(box["width"]), round(box["height"])
    across, down = notebook.python(f"middle('wall 2', {pixels})")
    assert 0.5 < across < 1  # the right side, seen from the front's right
    where = box["x"] + across * box["width"], box["y"] + down * box["height"]
    page.mouse.move(*where)
    expect(canvas).to_have_attribute("data-wall", "wall 2")
    page.mouse.click(*where)
    notebook.expect_python("[walls.wall, walls.model.design.canvas.width]", ["wall 2", 5.0])
    button = page.get_by_role("button", name="wall 2 · Residential house")
    expect(button).to_have_class(re.compile(r"\bmod-active\b"))


def test_the_strip_has_the_theme_of_the_page(show: Callable[[str], Notebook], out: Path) -> None:
    notebook = show(CODE)
    page = notebook.page
    strip = page.locator(".facade-nb-around")
    expect(strip.locator("svg")).to_be_visible()
    before = strip.locator("svg").inner_html()
    strip.scroll_into_view_if_needed()
    page.screenshot(path=out / "walls-light.png")
    notebook.theme("JupyterLab Dark")
    try:
        until(page, lambda: strip.locator("svg").inner_html() != before)
        expect(page.locator(".fnb-building-canvas")).to_have_attribute("data-state", "sharp")
        page.screenshot(path=out / "walls-dark.png")
    finally:
        notebook.theme("JupyterLab Light")
    until(page, lambda: strip.locator("svg").inner_html() == before)
