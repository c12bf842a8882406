"""Alignment, in a real JupyterLab: the matrix as it stands on the screen, and dragging its boundaries."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from .conftest import Watch
from .waiting import eventually, frames


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
    page = watch("AlignmentView(traced('figure-8'))").page
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
    frames(page)
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
    lab = watch("view = AlignmentView(traced('figure-8')); view")
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
        frames(lab.page)
        view = lab.page.locator(".fnb-view").bounding_box()
        assert view
        for own in lab.page.locator(".fnb-align").all():
            box = own.bounding_box()
            assert box
            assert box["x"] + box["width"] <= view["x"] + view["width"] + 1
        lab.page.screenshot(path=out / f"solver-alignment-{theme[11:].lower()}.png")
    finally:
        lab.theme("JupyterLab Light")


def legible(page: Page) -> None:
    """Each number is whole, or not there; none runs into the next."""
    for line in (".fnb-align-head", ".fnb-align-values"):
        seen = page.locator(line).evaluate_all(
            """lines => lines.map(line => [...line.querySelectorAll(':scope > [data-link] > span:first-child')]
            .filter(label => getComputedStyle(label).visibility !== 'hidden').map(label => {
                const range = document.createRange();
                range.selectNodeContents(label);
                const box = range.getBoundingClientRect();
                const inner = label.closest('.fnb-view').getBoundingClientRect();
                return [Math.round(box.top), box.left, box.right, label.textContent,
                    box.left >= inner.left && box.right <= inner.right];
            }))"""
        )
        assert sum(map(len, seen)) > 50
        for labels in seen:
            assert all(whole for *_, whole in labels)
            for top in {label[0] for label in labels}:
                own = sorted(label[1:] for label in labels if label[0] == top)
                ends = [(own[n][1], own[n + 1][0]) for n in range(len(own) - 1)]
                assert all(right <= left + 0.5 for right, left in ends), (line, own)


def test_labels_of_narrow_columns_are_whole(watch: Watch) -> None:
    """Each number stands on the screen as a whole, or not at all; none runs into the next."""
    lab = watch("AlignmentView(traced('apartment-house'), player=False)")
    for width in (1400, 900):
        lab.resize(width)
        eventually(lab.page, lambda: legible(lab.page))
    errors = lab.page.locator(".fnb-align-errors > [data-error]")
    assert set(errors.all_inner_texts()) == {"0.017"}


def test_the_next_column_is_predicted(watch: Watch, out: Path) -> None:
    lab = watch("view = AlignmentView(traced('apartment-house'), player=False, predict=True); view")
    page = lab.page
    page.get_by_role("button", name="Show the horizontal axis").click()
    expect(page.locator(".fnb-quiz-prompt")).to_have_text("Group 1: Where does column 2 end?")
    expect(page.locator(".fnb-align-number")).to_have_text(["1", "?"])
    expect(page.locator(".fnb-align-values, .fnb-align-figure")).to_have_count(0)
    own = page.locator(".fnb-offers li", has_text="first floor corners: D B D B")
    own.filter(has_text="base: ε").get_by_role("radio").check()
    lab.button("Hint").click()
    lab.button("Check").click()
    expect(page.locator(".fnb-quiz-outcome")).to_have_text(
        "No. G is attached and ends its element, so “base” may not be empty next (C4)."
    )
    expect(page.locator(".fnb-align-number")).to_have_count(17)
    expect(page.locator("li[data-verdict=missed]")).to_contain_text("first floor corners: D B D Bbase: C A")
    lab.expect_python("view.answer", {"right": [], "wrong": ["D B D B / ε"], "missed": []})
    page.screenshot(path=out / "alignment-next.png")
    lab.button("Again").click()
    expect(page.locator(".fnb-quiz-prompt")).not_to_have_text("Group 1: Where does column 2 end?")


def test_what_a_moved_boundary_breaks_is_predicted(watch: Watch, out: Path) -> None:
    lab = watch("view = AlignmentView(traced('residential-house'), player=False, predict=True); view")
    page = lab.page
    page.get_by_role("button", name="Show the horizontal axis").click()
    page.get_by_label("Question").select_option("a moved boundary")
    expect(page.locator(".fnb-quiz-prompt")).to_contain_text("was moved to the")
    expect(page.locator("[data-broken]")).to_have_count(0)
    boxes = page.get_by_role("checkbox")
    for n in range(boxes.count()):
        boxes.nth(n).check()
    lab.button("Hint").click()
    lab.button("Check").click()
    right = page.locator(".fnb-offers li[data-verdict=right]")
    said = page.locator(".fnb-align-broken li[data-constraint]")
    assert right.count() == len(set(said.evaluate_all("all => all.map(e => e.dataset.constraint)"))) > 0
    reason = said.first.inner_text().split(": ", 1)[1]
    expect(page.locator(".fnb-offers")).to_contain_text(reason)
    lab.expect_python("len(view.answer['right'])", right.count())
    lab.button("Predict").click()
    expect(page.get_by_role("slider", name="Boundary 1 of base", exact=True)).to_be_visible()
    page.screenshot(path=out / "alignment-moved.png")
