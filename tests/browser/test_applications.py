"""Notebook 7 and Voilà: keys, studio and solver on one page of each, as in JupyterLab."""

from __future__ import annotations

import os
import re
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Locator, expect

from .conftest import HOUSE, TRACED, Visit
from .jupyter import App, Notebook
from .places import apart

SHOWN = (
    HOUSE
    + TRACED
    + """
import os
texture = TextureModel("S -> Mat(Color, 0, 1, 0, 0, 1)", size=(12.34, 9.0), hour=9.1)
for each in (model, texture):
    each._history._pause = 1e9  # what is typed is one step, however busy the machine is
print('pid', os.getpid(), '.')
display(Studio(model), GrammarEditor(texture), SolverView(traced("residential-house")))
"""
)
PANEL = "window.jupyterapp.shell.currentWidget"


@pytest.fixture(scope="module", params=["notebook", "voila"])
def opened(visit: Visit, request: pytest.FixtureRequest) -> Iterator[Notebook]:
    app: App = request.param
    with visit(app) as notebook:
        notebook.resize(1200)
        notebook.open(SHOWN, "applications.ipynb")
        if app == "notebook":
            notebook.run()
        expect(studio(notebook).locator("[data-shape]")).to_have_count(17)
        yield notebook


@pytest.fixture
def shown(opened: Notebook) -> Iterator[Notebook]:
    """The page, as it was opened; the test fails if the console has errors or anything offsite was asked for."""
    yield opened
    assert opened.take_problems() == []


def studio(notebook: Notebook) -> Locator:
    return notebook.page.locator(".fnb-part-studio")


def test_keys(shown: Notebook) -> None:
    page = shown.page
    for label in ("Pattern Bx", "Grammar"):
        field = shown.field(label)
        expect(field).to_be_visible()
        before = field.input_value()
        field.click()
        page.keyboard.press("Control+End")
        page.keyboard.press("Enter")
        page.keyboard.type("dd")
        expect(field).to_have_value(f"{before}\ndd")
        page.keyboard.press("Control+z")
        expect(field).to_have_value(before)
    if shown.app == "notebook":
        page.evaluate(f"() => {{ {PANEL}.context.model.dirty = true; }}")
        page.keyboard.press("Control+s")
        page.wait_for_function(f"() => !{PANEL}.context.model.dirty")
        shown.button("Add a pattern").focus()
        for key in "dd":
            page.keyboard.press(key)
        expect(page.locator(".jp-Notebook-cell")).to_have_count(1)


def test_the_studio_works(shown: Notebook) -> None:
    page = shown.page
    base = studio(shown).locator(".fnb-elevation [data-layer=base]")
    before = base.count()
    assert before != 10
    field = shown.retype("Pattern Bx", "A(BA)^")
    expect(page.locator(".fnb-fault-text:visible")).to_have_count(1)
    field.press("End")
    field.press_sequentially("2")
    expect(base).to_have_count(10)
    shown.button("Both").click()
    expect(page.locator(".fnb-building-canvas")).to_have_attribute("data-state", "sharp")
    shown.button("Elevation").click()
    shown.retype("Pattern Bx", "A(BA)^k")
    expect(base).to_have_count(before)


def test_a_shape_is_picked_and_changed(shown: Notebook, out: Path) -> None:
    page = shown.page
    door = studio(shown).locator(".fnb-elevation [data-layer=door]")
    door.click()
    shown.field("material of D P in door").click()
    page.get_by_role("option", name="painted-blue", exact=True).click()
    expect(door.locator("title")).to_contain_text("painted-blue")
    assert apart(page, ".fnb-inspector", ".fnb-part-studio .fnb-paper")
    full = studio(shown).get_by_role("button", name="Full screen", exact=True)
    full.click()
    page.wait_for_function("() => document.fullscreenElement?.matches('.fnb')")
    full.click()
    page.wait_for_function("() => !document.fullscreenElement")
    page.screenshot(path=out / f"studio-{shown.app}.png")


def test_the_views_of_the_solver_work(shown: Notebook) -> None:
    solver = shown.page.locator(".fnb-part-solver")
    expect(solver.locator(".fnb-traced-note")).to_have_text("17 of 17 shapes")
    solver.get_by_role("button", name="x: Words", exact=True).click()
    for _ in range(3):
        solver.get_by_role("button", name="Step forward", exact=True).click()
    expect(solver.locator(".fnb-word[data-now] .fnb-word-text")).to_have_text("CeC")
    solver.get_by_role("button", name="Code", exact=True).click()  # a piece that Python is asked for
    expect(solver.locator(".fnb-code-text")).to_contain_text("def words_judged(")


def test_a_killed_kernel_is_told(opened: Notebook) -> None:
    """The last one: it ends the kernel."""
    expect(opened.page.locator(".fnb-absence:visible")).to_have_count(0)
    [pid] = re.findall(r"pid (\d+)", opened.page.get_by_text("pid ").last.inner_text())
    os.kill(int(pid), signal.SIGKILL)
    told = studio(opened).get_by_text("The kernel died and was started anew.")
    expect(told).to_be_visible()
    expect(opened.field("Pattern Bx")).to_have_attribute("readonly", "")
