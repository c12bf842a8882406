"""Alignment, in a real JupyterLab: the matrix as it stands on the screen, and dragging its boundaries."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from .jupyter import Notebook
from .test_solver_network import TRACED

Watch = Callable[[str], Notebook]


@pytest.fixture
def watch(lab: Notebook) -> Watch:
    """Show views; the code's last line is displayed."""

    def run(code: str) -> Notebook:
        lab.run(TRACED + textwrap.dedent(code))
        expect(lab.page.locator(".fnb-align-row").first).to_be_visible()
        return lab

    return run


def group(page: Page, name: str) -> Locator:
    return page.locator(f".fnb-align-group[data-group='{name}']")


def rows(page: Page, name: str) -> list[str]:
    """The rows of a matrix as they are read on the screen."""
    return (
        group(page, name)
        .locator(".fnb-align-row")
        .evaluate_all(
            """rows => rows.map(row => [...row.querySelectorAll('.fnb-box')]
            .map(box => [Math.round(box.getBoundingClientRect().left), box.innerText.replaceAll('\\n', '')])
            .sort((a, b) => a[0] - b[0]).map(([, text]) => text).join(' '))"""
        )
    )


def test_the_matrix_is_to_scale(watch: Watch) -> None:
    page = watch("AlignmentView(solve(FIGURE_8, trace=True))").page
    assert rows(page, "default") == ["C e1 e2 e3 C", "A B A B A"]
    boxes = group(page, "default").locator(".fnb-align-row").nth(1).locator(".fnb-box")
    widths = boxes.evaluate_all("boxes => boxes.map(box => box.getBoundingClientRect().width)")
    assert [w / widths[0] for w in widths] == pytest.approx([1, 1.5, 1, 1.5, 1], abs=0.02)
    # The edges of both rows meet.
    top = group(page, "default").locator(".fnb-align-row").nth(0).locator(".fnb-box")
    lefts = [
        own.evaluate_all("boxes => boxes.map(box => box.getBoundingClientRect().left)")
        for own in (top, boxes)
    ]
    assert lefts[0] == pytest.approx(lefts[1], abs=1)


def test_a_boundary_can_be_dragged(watch: Watch) -> None:
    page = watch("AlignmentView(traced('residential-house'), player=False)").page
    page.get_by_role("button", name="Show the horizontal axis").click()
    own = group(page, "default")
    expect(own.locator(".fnb-align-figure").first).to_have_text("Ω = 0.1 m")
    handle = own.get_by_role("slider", name="Boundary 1 of base", exact=True)
    box = handle.bounding_box()
    second = own.locator(".fnb-align-row").nth(2).locator(".fnb-box").nth(1).bounding_box()
    assert box
    assert second
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(second["x"] + second["width"], box["y"] + box["height"] / 2, steps=6)
    # It is judged while it is dragged, before the button is let go.
    expect(own.locator(".fnb-align-figure").first).to_contain_text("solver: 0.1")
    assert rows(page, "default")[2] == "A B A B A B A"
    expect(own.locator("li[data-constraint]").first).to_contain_text("column 1")
    page.mouse.up()
    page.mouse.move(box["x"] - 200, box["y"])  # the drag is over
    tried = own.locator(".fnb-align-figure").first.inner_text()
    page.wait_for_timeout(100)
    assert own.locator(".fnb-align-figure").first.inner_text() == tried
    page.get_by_role("button", name="Back to the solver's").click()
    expect(own.locator(".fnb-align-figure").first).to_have_text("Ω = 0.1 m")
    expect(own.locator(".fnb-align-fine")).to_be_visible()


def test_by_keys_it_says_what_breaks_and_where(watch: Watch) -> None:
    page = watch("AlignmentView(traced('residential-house'), player=False)").page
    page.get_by_role("button", name="Show the horizontal axis").click()
    own = group(page, "default")
    handle = own.get_by_role("slider", name="Boundary 4 of door", exact=True)
    handle.press("ArrowRight")
    expect(own.locator("li[data-constraint=C2]")).to_contain_text("partly transparent, partly not (C2)")
    expect(own.locator(".fnb-align-cell[data-broken]")).to_have_count(1)
    assert page.evaluate("document.activeElement.getAttribute('aria-label')") == "Boundary 4 of door"
    page.keyboard.press("ArrowLeft")
    expect(own.locator(".fnb-align-fine")).to_be_visible()


def test_it_needs_no_kernel(watch: Watch) -> None:
    lab = watch("view = AlignmentView(solve(FIGURE_8, trace=True)); view")
    page = lab.page
    sent = page.evaluate(
        """() => {
            const kernel = window.jupyterapp.shell.currentWidget.sessionContext.session.kernel;
            window.sent = 0;
            kernel.anyMessage.connect((_, args) => { if (args.direction === 'send') window.sent++; });
            return window.sent;
        }"""
    )
    assert sent == 0
    own = group(page, "default")
    handle = own.get_by_role("slider", name="Boundary 2 of all rows", exact=True)
    handle.press("Delete")
    expect(own.locator(".fnb-align-figure").first).to_contain_text("solver: 0")
    assert page.evaluate("window.sent") == 0


def test_its_columns_light_up_on_the_facade(watch: Watch) -> None:
    page = watch(
        "layout = traced('residential-house'); "
        "display(AlignmentView(layout, player=False), FacadeView(layout, player=False))"
    ).page
    page.get_by_role("button", name="Show the horizontal axis").click()
    group(page, "default").locator(".fnb-align-number").nth(1).hover()
    expect(page.locator(".fnb-traced-column")).to_have_count(1)
    lit = page.locator(".fnb-traced-lit").first.bounding_box()
    assert lit


@pytest.mark.parametrize("theme", ["JupyterLab Light", "JupyterLab Dark"])
def test_looks(watch: Watch, out: Path, theme: str) -> None:
    """Screenshots for people; nothing is wider than its view."""
    lab = watch("AlignmentView(traced('apartment-house'), player=False)")
    try:
        lab.theme(theme)  # type: ignore[arg-type]
        lab.page.wait_for_timeout(400)
        view = lab.page.locator(".fnb-view").bounding_box()
        assert view
        for own in lab.page.locator(".fnb-align").all():
            box = own.bounding_box()
            assert box
            assert box["x"] + box["width"] <= view["x"] + view["width"] + 1
        lab.page.screenshot(path=out / f"solver-alignment-{theme[11:].lower()}.png")
    finally:
        lab.theme("JupyterLab Light")
