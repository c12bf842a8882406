"""Sizing, in a real JupyterLab: forces, objective, active set and the system as they stand on the screen."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from playwright.sync_api import expect

from .conftest import Watch
from .waiting import eventually, frames


def test_the_equations_of_figure_7_are_on_the_screen(watch: Watch) -> None:
    lab = watch("SizingView(traced('figure-8'), player=False)")
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


def test_the_table_stays_in_its_view(watch: Watch) -> None:
    """Beside the façade on a page there is half the room: every multiplier is in sight, one below the other."""
    lab = watch("SizingView(traced('apartment-house'), player=False)")
    page = lab.page
    lab.button("Show the horizontal axis").click()

    def whole() -> None:
        right = page.locator(".fnb-view").evaluate("e => e.getBoundingClientRect().right")
        cells = page.locator(".fnb-rows .fnb-size-row").evaluate_all(
            "rows => rows.map(row => row.lastElementChild.getBoundingClientRect().right)"
        )
        assert len(cells) > 10
        assert max(cells) <= right
        assert max(cells) - min(cells) < 1

    for width in (1400, 900, 640):
        lab.resize(width)
        eventually(page, whole)


@pytest.mark.parametrize("theme", ["JupyterLab Light", "JupyterLab Dark"])
def test_looks(watch: Watch, out: Path, theme: str) -> None:
    """Screenshots for people; no text of the pictures is cut off by the view."""
    lab = watch("SizingView(traced('apartment-house'), player=False)")
    try:
        lab.theme(theme)  # type: ignore[arg-type]
        lab.button("Show the horizontal axis").click()
        frames(lab.page)
        box = lab.page.locator(".fnb-forces").bounding_box()
        view = lab.page.locator(".fnb-view").bounding_box()
        assert box
        assert view
        assert box["x"] + box["width"] <= view["x"] + view["width"]
        lab.page.screenshot(path=out / f"solver-sizing-{theme[11:].lower()}.png")
    finally:
        lab.theme("JupyterLab Light")


def test_which_symbols_grow_is_predicted(watch: Watch, out: Path) -> None:
    lab = watch("""
        layout = traced('residential-house')
        likes = {s: own.size for s, own in layout.design.symbols.items() if own.size is not None}
        sizes = layout.x.sizes
        SizingView(layout, player=False, predict=True)
    """)
    page = lab.page
    lab.button("Show the horizontal axis").click()
    expect(page.locator(".fnb-quiz-prompt")).to_have_text(
        "Which symbols end larger than they like? Tick them."
    )
    expect(page.locator(".fnb-forces-letter, .fnb-force, .fnb-size-table")).to_have_count(0)
    page.get_by_role("checkbox", name=re.compile("^D likes")).check()
    lab.button("Hint").click()
    lab.button("Check").click()
    grown = lab.python("[s for s, size in sizes.items() if s in likes and size > likes[s] + 1e-6]")
    size = lab.python("sizes['D']")
    assert "D" in grown
    expect(page.locator(".fnb-offers li[data-verdict=right]")).to_have_count(1)
    expect(page.locator(".fnb-offers li[data-verdict=right]")).to_contain_text(f"gets {round(size, 4):g} m")
    expect(page.locator(".fnb-offers li[data-verdict=missed]")).to_have_count(len(grown) - 1)
    expect(page.locator(".fnb-force").first).to_be_visible()
    page.screenshot(path=out / "sizing-grown.png")


def test_the_equation_of_a_letter_is_predicted(watch: Watch, out: Path) -> None:
    lab = watch("view = SizingView(traced('figure-8'), player=False, predict=True); view")
    page = lab.page
    lab.button("Show the horizontal axis").click()
    page.get_by_label("Question").select_option("an equation")
    expect(page.locator(".fnb-quiz-prompt")).to_have_text(
        "Which equation says how long the marked letter C (1-1-1) is?"
    )
    marked = page.locator(".fnb-forces-letter[data-marked]")
    expect(marked).to_have_count(1)
    box, first = marked.bounding_box(), page.locator(".fnb-forces-letter").first.bounding_box()
    assert box == first
    page.get_by_role("radio", name="1-1-1.t − 1-1-1.s = 2", exact=True).check()
    lab.button("Hint").click()
    lab.button("Check").click()
    expect(page.locator(".fnb-quiz-outcome")).to_have_text(
        "No. 2 m is what C likes: that stands in the objective, and gives way."
    )
    expect(page.locator(".fnb-offers li[data-verdict=missed]")).to_contain_text("1-1-1.t − 1-1-1.s = |C|")
    lab.button("Again").click()
    expect(page.locator(".fnb-quiz-prompt")).to_contain_text("the marked letter e (1-2-1)")
    expect(marked).to_have_count(3)
    page.screenshot(path=out / "sizing-equation.png")


def test_the_next_active_constraint_is_predicted(watch: Watch) -> None:
    lab = watch("view = SizingView(traced('terraced-house'), predict=True, at='x/sizing+1'); view")
    page = lab.page
    page.get_by_label("Question").select_option("the active set")
    expect(page.locator(".fnb-quiz-prompt")).to_have_text("Which constraint becomes active next?")
    page.get_by_role("radio", name="default: γ before 1-3-1 ≥ 0").check()
    lab.button("Hint").click()
    lab.button("Check").click()
    expect(page.locator(".fnb-quiz-outcome")).to_contain_text(
        "Right. It is broken by 0.0123 m at these sizes"
    )


def test_the_forces_stand_on_the_facade(watch: Watch, out: Path) -> None:
    lab = watch(
        "layout = traced('residential-house'); "
        "view = FacadeView(layout, player=False); display(SizingView(layout, player=False), view)"
    )
    page = lab.page
    lab.button("Show the horizontal axis").click()
    loads = page.locator(".fnb-loads .fnb-load")
    expect(loads).to_have_count(0)  # the façade is done, and its sizing is not played
    lab.button("Show the forces of the horizontal axis").click()
    expect(loads).to_have_count(6)
    legend = page.get_by_role("note", name="Forces")
    expect(legend).to_have_text(
        "Forces along xstretched, pullssqueezed, pushesheld by the canvaslargest 0.18 m² per m"
    )
    # The door is stretched: its arrows start at its edges, and point inwards.
    door = page.locator(".fnb-traced [data-layer=door] .cell").first.bounding_box()
    assert door
    arrows = """(path, { scale }) => [...path.getAttribute('d').matchAll(/M([\\d.-]+) [\\d.-]+L([\\d.-]+) /g)]
        .filter((_, n) => n % 2 === 0).map(([, from, to]) => [from, to].map(x =>
            new DOMPoint(x, 0).matrixTransform(path.getScreenCTM()).x))"""
    first, last = loads.first.locator(".fnb-load-arrow").evaluate(arrows, {"scale": 1})
    assert [first[0], last[0]] == pytest.approx([door["x"], door["x"] + door["width"]], abs=1.5)
    assert first[1] > first[0] + 15
    assert last[1] < last[0] - 15
    blue, red = (
        page.locator(f".fnb-loads [data-kind={kind}] .fnb-load-arrow").first.evaluate(
            "e => getComputedStyle(e).stroke.match(/\\d+/g).map(Number)"
        )
        for kind in ("pull", "push")
    )
    assert blue[2] > blue[0] + 50
    assert red[0] > red[2] + 50
    # It lights with its equation, and its equation with it.
    letter = page.locator(".fnb-load-letter").first
    row = page.locator(".fnb-rows .fnb-size-row", has_text="|D|").first
    row.hover()
    expect(letter).to_have_attribute("data-lit", "")
    expect(page.locator(".fnb-load-letter[data-lit]")).to_have_count(1)
    letter.hover()
    expect(row).to_have_attribute("data-lit", "")
    page.screenshot(path=out / "facade-forces.png")
    # What the player shows is what is solved by then.
    lab.button("Show forces while the sizing is played").click()
    lab.python("setattr(view.model, 'moment', 'x/sizing+0')")
    expect(legend).to_have_text("The forces along x are known when its system is solved.")


def test_forces_are_not_shown_while_a_view_of_the_page_asks(watch: Watch) -> None:
    lab = watch("""
        layout = traced('residential-house')
        page = SolverView(layout, views=['facade', 'sizing'], at='y/analysis+0')
        display(page, FacadeView(layout, player=False))
    """)
    page = lab.page
    for choice in page.get_by_role("button", name="Show the forces of the horizontal axis").all():
        choice.click()
    asks, other = page.locator(".fnb-part-solver"), page.locator(".fnb-part-facade")
    loads = ".fnb-loads .fnb-load"
    expect(asks.locator(loads)).to_have_count(6)
    asks.locator(".fnb-view", has=page.locator(".fnb-sizing")).get_by_role("button", name="Predict").click()
    expect(asks.locator(loads)).to_have_count(0)
    expect(asks.get_by_role("note", name="Forces")).to_have_text("Forces are not shown while a view asks.")
    # Another widget has no question: it stays as it is.
    expect(other.locator(loads)).to_have_count(6)
    lab.button("Hint").click()
    lab.button("Check").click()
    expect(asks.locator(loads)).to_have_count(6)
