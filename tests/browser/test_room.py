"""Where things stand in the studio: nothing over the façade, nothing jumps, long lists are read, full screen."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from .jupyter import Notebook
from .keys import retype
from .places import apart
from .waiting import eventually, frames

Show = Callable[[str], Notebook]

HALL = 'model = FacadeModel(gallery.load("concert-hall"), time_limit=600.0)\nStudio(model)'

PLACES = """() => {
    const box = query => {
        const { x, y, width, height } = document.querySelector(query).getBoundingClientRect();
        return [x, y, width, height];
    };
    const panel = document.querySelector(".fnb-panel");
    const page = [];
    for (let el = panel.parentElement; el; el = el.parentElement) page.push(el.scrollTop);
    const picture = box(".fnb-sheet > svg:not(.fnb-overlay)");
    return { paper: box(".fnb-paper"), picture, panel: panel.scrollTop, page };
}"""


INSIDE = """rows => rows.map(row => {
    const [a, b] = [row, row.closest(".fnb-list")].map(el => el.getBoundingClientRect());
    return a.top >= b.top - 1 && a.bottom <= b.bottom + 1;
})"""


def places(page: Page) -> dict[str, Any]:
    """Where the façade stands and how far all is scrolled."""
    frames(page, 3)
    found: dict[str, Any] = page.evaluate(PLACES)
    return found


@pytest.mark.parametrize("width", [1600, 1200, 900])
def test_what_is_picked_covers_nothing_and_moves_nothing(show: Show, width: int) -> None:
    studio = show("Studio(model)")
    page = studio.page
    studio.resize(width)
    page.locator(".fnb-sheet:not([data-settling])").wait_for()
    page.locator(".fnb-panel").evaluate("panel => { panel.scrollTop = 90; }")
    page.locator(".fnb-elevation [data-layer=base][data-y=Q]").first.scroll_into_view_if_needed()
    before = places(page)
    for query in ("[data-layer=base][data-x=B][data-y=Q]", "[data-layer=door]", "[data-layer=roof]"):
        page.locator(f".fnb-elevation {query}").first.click()
        expect(page.locator(".fnb-inspector-title b")).to_contain_text(query.split("=")[1].split("]")[0])
        assert places(page) == before
        assert apart(page, ".fnb-inspector", ".fnb-paper")
        assert apart(page, ".fnb-inspector", ".fnb-panel")
    page.keyboard.press("Escape")
    expect(page.locator(".fnb-inspector")).to_have_count(0)
    assert places(page) == before


def test_the_facade_alone_has_what_is_picked_under_it(show: Show) -> None:
    studio = show("ElevationView(model)")
    page = studio.page
    paper = page.locator(".fnb-paper")
    before = paper.bounding_box()
    page.locator(".fnb-elevation [data-layer=door]").click()
    expect(page.locator(".fnb-inspector")).to_be_visible()
    assert paper.bounding_box() == before
    assert apart(page, ".fnb-inspector", ".fnb-paper")


def test_of_many_layers_and_symbols_the_picked_are_open_and_in_sight(show: Show) -> None:
    studio = show(HALL)
    page = studio.page
    layers, symbols = page.locator(".fnb-layer"), page.locator(".fnb-symbol[data-symbol]")
    expect(layers).to_have_count(studio.python("len(model.design.layers)"))
    expect(page.locator(".fnb-layer .fnb-side:visible")).to_have_count(0)  # each is a line
    height = "rows => Math.max(...rows.map(row => row.getBoundingClientRect().height))"
    assert layers.evaluate_all(height) < 40
    assert (
        symbols.evaluate_all("rows => rows.filter(row => row.getBoundingClientRect().height < 40).length")
        > 30
    )
    expect(page.locator(".fnb-symbol .fnb-word[aria-pressed=false]:visible")).to_have_count(0)
    before = places(page)
    for layer in studio.python("[own.name for own in (model.design.stack[0], model.design.stack[-1])]"):
        studio.python(f"model.select([own.layer for own in model.layout.shapes].index({layer!r}))")
        own = page.locator(f".fnb-layer[data-layer='{layer}']")
        expect(own.locator(".fnb-side:visible")).to_have_count(2)
        for rows in (own, page.locator(".fnb-symbol[data-picked]")):
            assert any(rows.evaluate_all(INSIDE))
        assert places(page) == before
    own.get_by_label("Name of layer").focus()
    expect(
        page.locator(".fnb-symbol[data-picked] .fnb-word[aria-pressed=false]:visible").first
    ).to_be_attached()


def test_full_screen_is_entered_edited_in_and_left(show: Show) -> None:
    studio = show("Studio(model)")
    page = studio.page
    inside = "() => document.fullscreenElement?.classList.contains('fnb-part-studio') ?? false"
    before = page.locator(".fnb-paper").bounding_box()
    button = studio.button("Full screen")
    button.click()
    page.wait_for_function(inside)
    expect(button).to_have_attribute("aria-pressed", "true")
    frames(page, 3)
    whole = page.locator(".fnb").bounding_box()
    assert whole and (whole["width"], whole["height"]) == (1400, 1000)
    retype(studio.field("Pattern Bx"), "A(BA)^2")
    expect(page.locator(".fnb-elevation [data-layer=base]")).to_have_count(10)
    studio.settle()
    paper = page.locator(".fnb-paper").bounding_box()
    assert before and paper and paper["height"] > before["height"]
    page.locator(".fnb-elevation [data-layer=door]").click()
    expect(page.locator(".fnb-inspector")).to_be_visible()
    assert page.locator(".fnb-paper").bounding_box() == paper
    assert apart(page, ".fnb-inspector", ".fnb-paper")
    for query in (".fnb-status", ".fnb-inspector", ".fnb-panel"):
        expect(page.locator(query)).to_be_in_viewport(ratio=0.99)
    studio.field("material of D P in door").click()  # lists open within the screen
    page.get_by_role("option", name="painted-blue", exact=True).click()
    studio.expect_python("model.design.layers[2].shapes['D P'].material", "painted-blue")
    page.keyboard.press("Escape")  # first what is picked is let go, as anywhere
    expect(page.locator(".fnb-inspector")).to_have_count(0)
    page.wait_for_function(inside)
    page.keyboard.press("Escape")
    page.wait_for_function(f"() => !({inside})()")
    expect(button).to_have_attribute("aria-pressed", "false")
    eventually(page, lambda: _same(page, before))
    button.click()
    page.wait_for_function(inside)
    button.click()
    page.wait_for_function(f"() => !({inside})()")
    eventually(page, lambda: _same(page, before))
    studio.expect_python("model.design.patterns['Bx'].text", "A(BA)^2")


def _same(page: Page, box: Any) -> None:
    assert page.locator(".fnb-paper").bounding_box() == box


@pytest.mark.parametrize("theme", ["Light", "Dark"])
def test_looks_of_a_long_panel(show: Show, out: Path, theme: str) -> None:
    studio = show(HALL)
    studio.theme(f"JupyterLab {theme}")  # type: ignore[arg-type]
    page = studio.page
    try:
        page.locator(".fnb-elevation [data-shape]").nth(40).click()
        expect(page.locator(".fnb-inspector")).to_be_visible()
        for section in ("Layers", "Symbols"):
            title = page.locator(".fnb-title", has_text=section).first
            title.evaluate("title => title.scrollIntoView()")
            frames(page)
            page.screenshot(path=out / f"long-{section.lower()}-{theme.lower()}.png")
    finally:
        studio.theme("JupyterLab Light")
