"""Network, in a real JupyterLab: what stands on the canvas and beside it."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from .conftest import Watch
from .jupyter import Notebook
from .waiting import eventually, frames, until


@pytest.fixture
def watch(watch: Watch) -> Watch:
    """The same, and the canvas is painted."""

    def run(code: str) -> Notebook:
        lab = watch(code)
        expect(lab.page.locator(".fnb-plane-canvas")).to_be_visible()
        until(lab.page, lambda: colour_at(lab.page, 4, 4)[3])
        return lab

    return run


def colour_at(page: Page, x: float, y: float) -> list[int]:
    """The colour of the canvas at a point, CSS pixels from its corner; clear while the canvas has no place yet."""
    return page.evaluate(
        """([x, y]) => {
            const canvas = document.querySelector('.fnb-plane-canvas');
            const { width } = canvas.getBoundingClientRect();
            if (width === 0 || canvas.width === 0) return [0, 0, 0, 0];
            const ratio = canvas.width / width;
            return [...canvas.getContext('2d').getImageData(Math.round(x * ratio), Math.round(y * ratio), 1, 1).data];
        }""",
        [x, y],
    )


def count(page: Page, colour: str) -> int:
    """How many pixels of the canvas have nearly the colour of a variable of the style sheet."""
    return page.evaluate(
        """name => {
            const canvas = document.querySelector('.fnb-plane-canvas');
            const own = getComputedStyle(canvas).getPropertyValue(name).trim();
            const [r, g, b] = own.match(/[0-9a-f]{2}/gi).map(part => parseInt(part, 16));
            const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
            let found = 0;
            for (let n = 0; n < data.length; n += 4)
                if (Math.abs(data[n] - r) + Math.abs(data[n + 1] - g) + Math.abs(data[n + 2] - b) < 24) found++;
            return found;
        }""",
        colour,
    )


def papered(page: Page, light: bool) -> None:
    """The canvas has the colour of the theme."""
    *paper, alpha = colour_at(page, 4, 4)
    assert alpha
    assert sum(paper) > 600 if light else sum(paper) < 200


def test_figure_8_is_on_the_screen(watch: Watch) -> None:
    page = watch("NetworkView(traced('figure-8'))").page
    status = page.locator(".fnb-net-status")
    expect(status).to_contain_text("4 × 6 nodes and 6 within cut letters")
    expect(status).to_contain_text("The path has 5 columns, Ω = 0 m, J = 0 m.")
    until(page, lambda: count(page, "--fnb-net-path") > 300)
    until(page, lambda: count(page, "--fnb-net-step") > 500)
    page.get_by_role("checkbox", name="cut letters").uncheck()
    expect(status).to_contain_text("4 × 6 nodes, μ")
    expect(status).to_contain_text("The path has 3 columns, Ω = 0 m.")
    first = page.locator(".fnb-net-edge[data-path] .fnb-net-column")
    assert first.locator(".fnb-net-element").all_inner_texts() == ["C", "A"]


def test_a_node_that_is_clicked_shows_its_region_and_its_edges(watch: Watch) -> None:
    page = watch("NetworkView(traced('figure-8'), player=False)").page
    canvas = page.locator(".fnb-plane-canvas")
    canvas.focus()
    canvas.press("ArrowRight")
    canvas.press("ArrowDown")
    expect(page.locator(".fnb-net-leaving h4 code")).to_have_text("eC / BABA")
    expect(page.locator(".fnb-net-legend")).to_contain_text("δ from ✕")
    refused = page.locator(".fnb-net-edge[data-constraint=C1]").first
    expect(refused).to_contain_text("no row stands behind it with opaque letters (C1)")
    # A click does the same: find the first node by what the keys have told.
    box = canvas.bounding_box()
    assert box
    canvas.press("Escape")
    expect(page.locator(".fnb-net-leaving h4 code")).to_have_text("CeC / ABABA")
    for dx in range(0, 160, 10):  # in the third row, right of the middle, there is a node
        canvas.click(position={"x": box["width"] / 2 + dx, "y": box["height"] / 2 + 40})
        frames(page)
        if page.locator(".fnb-net-leaving h4 code").inner_text() != "CeC / ABABA":
            break
    text = page.locator(".fnb-net-leaving h4 code").inner_text()
    assert text in {"C / BA", "C / A"}


def test_the_network_follows_the_player(watch: Watch) -> None:
    lab = watch("view = NetworkView(traced('residential-house'), at='x/alignment+100'); view")
    page = lab.page
    expect(page.locator(".fnb-net-status")).to_contain_text("expanded")
    expect(page.locator(".fnb-net-status")).not_to_contain_text("The path has")
    before = page.locator(".fnb-network").inner_html()

    def differs(before: str) -> None:
        assert page.locator(".fnb-network").inner_html() != before

    def equals(before: str) -> None:
        assert page.locator(".fnb-network").inner_html() == before

    until(page, lambda: count(page, "--fnb-net-path") < 20)
    for _ in range(8):
        lab.button("Step forward").click()
    eventually(page, lambda: differs(before))
    for _ in range(8):
        lab.button("Step back").click()
    eventually(page, lambda: equals(before))
    page.get_by_role("slider", name="Position in the trace").press("End")
    expect(page.locator(".fnb-net-status")).to_contain_text("The path has 7 columns")
    until(page, lambda: count(page, "--fnb-net-path") > 200)
    expect(page.locator(".fnb-warp-node")).to_have_count(8)
    lab.button("Step back").click()


def test_which_edge_is_next(watch: Watch) -> None:
    lab = watch("view = NetworkView(traced('residential-house'), predict=True, at='x/alignment+120'); view")
    page = lab.page
    expect(page.locator(".fnb-quiz-prompt")).to_have_text("Which edge is next?")
    expect(page.get_by_role("radio")).not_to_have_count(0)
    assert "J ≥" not in page.locator(".fnb-network").inner_text()
    page.get_by_role("radio").first.check()
    lab.button("Hint").click()
    lab.button("Check").click()
    right = bool(lab.python("view.answer.get('right', [])"))
    expect(page.locator(".fnb-quiz-outcome")).to_contain_text("Right." if right else "No.")
    expect(page.locator(".fnb-net-edge[data-verdict]").first).to_contain_text("J")
    lab.expect_python("len(view.answer['right']) + len(view.answer['wrong'])", 1)


def test_columns_light_up_across_views(watch: Watch) -> None:
    lab = watch(
        "layout = traced('residential-house'); "
        "display(NetworkView(layout, player=False), FacadeView(layout, player=False))"
    )
    page = lab.page
    page.locator(".fnb-warp-column").nth(3).dispatch_event("pointerover", {"bubbles": True})
    expect(page.locator(".fnb-traced-column")).to_have_count(1)


@pytest.mark.parametrize("theme", ["JupyterLab Light", "JupyterLab Dark"])
def test_looks(watch: Watch, out: Path, theme: str) -> None:
    """Screenshots for people; and the canvas is drawn in the theme's colours."""
    lab = watch("NetworkView(traced('apartment-house'), player=False)")
    try:
        lab.theme(theme)  # type: ignore[arg-type]
        eventually(lab.page, lambda: papered(lab.page, theme.endswith("Light")))
        lab.page.screenshot(path=out / f"solver-network-{theme[11:].lower()}.png")
    finally:
        lab.theme("JupyterLab Light")
