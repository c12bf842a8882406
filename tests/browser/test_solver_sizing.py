"""Sizing, in a real JupyterLab: forces, objective, active set and the system as they stand on the screen."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import expect

from .jupyter import Notebook
from .test_solver_network import TRACED

Watch = Callable[[str], Notebook]


@pytest.fixture
def watch(lab: Notebook) -> Watch:
    """Show views; the code's last line is displayed."""

    def run(code: str) -> Notebook:
        lab.run(TRACED + textwrap.dedent(code))
        expect(lab.page.locator(".fnb-sizing")).to_be_visible()
        return lab

    return run


def test_the_equations_of_figure_7_are_on_the_screen(watch: Watch) -> None:
    lab = watch("SizingView(solve(FIGURE_8, trace=True), player=False)")
    page = lab.page
    lab.button("Show the horizontal axis").click()
    rows = page.locator(".fnb-rows .fnb-size-row")
    expect(rows.first.locator(".fnb-size-text")).to_have_text("1-1-1.t − 1-1-1.s = |C|")
    # An entry of the matrix stands under the name of its variable.
    entry = rows.first.locator(".fnb-size-cell").nth(1).bounding_box()
    name = page.locator(".fnb-size-variable", has_text="x1").bounding_box()
    assert entry
    assert name
    assert entry["x"] == pytest.approx(name["x"], abs=1.5)
    lab.button("written out").click()
    expect(page.locator(".fnb-size-min li").first).to_have_text("(1-1-1.t − 1-1-1.s − 2)²")
    expect(page.locator(".fnb-size-boxed", has_text="Stitch")).to_contain_text("1-1-1.t = 1-2-1.s")


def test_letters_stand_before_and_after(watch: Watch) -> None:
    lab = watch("SizingView(traced('residential-house'), player=False)")
    page = lab.page
    lab.button("Show the horizontal axis").click()
    ends = page.evaluate(
        """() => {
            const right = selector => Math.max(...[...document.querySelectorAll(selector)]
                .map(box => box.getBoundingClientRect().right));
            const line = [...document.querySelectorAll('.fnb-forces-canvas')]
                .map(own => own.getBoundingClientRect().left).sort((a, b) => a - b);
            const base = [...document.querySelectorAll('.fnb-forces-before')].slice(-7);
            return [right('.fnb-forces-letter') - line[1],
                base.at(-1).getBoundingClientRect().right - line[1], line[1] - line[0]];
        }"""
    )
    assert ends[0] == pytest.approx(0, abs=1.5)  # after: up to the canvas
    assert ends[1] / ends[2] == pytest.approx(-0.4 / 6, abs=0.01)  # before: 5.6 of 6 m
    expect(page.locator(".fnb-size-terms tbody tr", has_text="D")).to_contain_text("1.19")
    expect(page.locator(".fnb-force-wall")).to_have_count(2)


def test_a_step_of_the_active_set_is_a_moment(watch: Watch) -> None:
    lab = watch("view = SizingView(traced('residential-house')); view")
    page = lab.page
    lab.button("Show the horizontal axis").click()
    page.locator(".fnb-size-step").first.click()
    expect(page.locator(".fnb-size-sum")).to_contain_text("Round 1 (sizes), step 0: 19 active")
    expect(page.locator(".fnb-play-caption")).to_contain_text("Active set, sizes, step 0")
    expect(page.locator(".fnb-size-step[data-now]")).to_have_count(1)
    lab.button("active").click()
    expect(page.locator(".fnb-rows .fnb-size-row:not([data-active])")).to_have_count(0)


def test_a_row_lights_its_letters_on_the_facade(watch: Watch) -> None:
    lab = watch(
        "layout = traced('residential-house'); "
        "display(SizingView(layout, player=False), FacadeView(layout, player=False))"
    )
    page = lab.page
    lab.button("Show the horizontal axis").click()
    row = page.locator(".fnb-forces-letter[data-link*='door']").nth(3)  # D
    row.hover()
    expect(page.locator(".fnb-size-row[data-lit] .fnb-size-text").first).to_contain_text("|D|")
    expect(page.locator(".fnb-traced-lit").first).to_be_attached()


@pytest.mark.parametrize("theme", ["JupyterLab Light", "JupyterLab Dark"])
def test_looks(watch: Watch, out: Path, theme: str) -> None:
    """Screenshots for people; no text of the pictures is cut off by the view."""
    lab = watch("SizingView(traced('apartment-house'), player=False)")
    try:
        lab.theme(theme)  # type: ignore[arg-type]
        lab.button("Show the horizontal axis").click()
        lab.page.wait_for_timeout(400)
        box = lab.page.locator(".fnb-forces").bounding_box()
        view = lab.page.locator(".fnb-view").bounding_box()
        assert box
        assert view
        assert box["x"] + box["width"] <= view["x"] + view["width"]
        lab.page.screenshot(path=out / f"solver-sizing-{theme[11:].lower()}.png")
    finally:
        lab.theme("JupyterLab Light")
