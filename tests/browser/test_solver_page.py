"""Analysis, candidates, events and code, the whole page, the qualifiers: what stands on the screen."""

from __future__ import annotations

import functools
import itertools
import re
import shutil
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from .conftest import Visit, Watch
from .jupyter import Notebook
from .test_solver import section
from .waiting import eventually, frames, until

PAIR = """
def pair(over, under, counters={}):
    layer = {"y": {"pattern": "Y"}}
    return Design.from_dict({
        "format": "facade-nb/design/1", "name": "A pair", "canvas": {"width": 9.0, "height": 1.0},
        "symbols": {"A": {"size": 2.0}, "C": {"size": 1.3}, "H": {"size": 1.0}}, "counters": counters,
        "patterns": {"Pattern0": over, "Pattern1": under, "Y": "H"},
        "layers": [{"name": "under", "x": {"pattern": "Pattern1", "group": "one"}, **layer},
                   {"name": "over", "x": {"pattern": "Pattern0", "group": "two"}, **layer, "depth": 1}]})
from facade_nb import Design, NoLayout
"""


def texts(page: Page, selector: str) -> list[str]:
    return [text.replace("\n", "") for text in page.locator(selector).all_inner_texts()]


def test_the_supplements_pair_is_on_the_screen(watch: Watch) -> None:
    own = "pair('A^k c C^m c A^k; c := C', 'A^k C^l A^k')"
    lab = watch(f"{PAIR}AnalysisView(solve({own}, trace=True, time_limit=None))")
    page = lab.page
    assert texts(page, ".fnb-pair-middle") == ["Cm+2", "Cl"]
    assert texts(page, ".fnb-pair-prefix") == ["Ak", "Ak"]
    expect(page.locator(".fnb-pair-equation")).to_have_text("⇒ m + 2 = l")
    expect(page.locator("[data-system=counters] .fnb-system-text")).to_have_text("m = l − 2")
    # The common ends are fainter than what is left, and both lines stand one under the other.
    faint = page.locator(".fnb-pair-prefix").first.evaluate("e => Number(getComputedStyle(e).opacity)")
    assert faint < 0.8
    above, below = (page.locator(".fnb-pair-middle").nth(n).bounding_box() for n in (0, 1))
    assert above
    assert below
    assert above["x"] == pytest.approx(below["x"], abs=1)


def test_the_inconsistent_pair_is_red(watch: Watch) -> None:
    lab = watch(
        PAIR
        + """
try:
    solve(pair("A A^m A^m", "A^l A^l", {"m": {"max": 2}, "l": {"max": 2}}), trace=True, time_limit=None)
except NoLayout as none:
    failed = none
AnalysisView(failed)"""
    )
    page = lab.page
    pair = page.locator(".fnb-pair[data-conflict]")
    expect(pair).to_contain_text("2m + 1 = 2l; no whole numbers satisfy that")
    red, _, blue = pair.locator(".fnb-pair-equation").evaluate(
        """e => {
            const pen = document.createElement("canvas").getContext("2d");
            pen.fillStyle = getComputedStyle(e).color;  // in whatever colour space it is told
            pen.fillRect(0, 0, 1, 1);
            return [...pen.getImageData(0, 0, 1, 1).data];
        }"""
    )[:3]
    assert red > blue + 80


def test_candidates_sort_filter_and_are_chosen(watch: Watch) -> None:
    lab = watch("""
        layout = traced('residential-house')
        view = CandidatesView(layout)
        display(view, WordsView(layout, player=False))
    """)
    page = lab.page
    first = page.locator(".fnb-candidate[data-fate]").first
    expect(first).to_contain_text("★ best")
    page.locator(".fnb-sort", has_text="k").first.click()
    page.locator(".fnb-sort", has_text="k").first.click()
    expect(first).to_contain_text("· bound")
    assert texts(page, ".fnb-candidate[data-fate] .fnb-candidate-word:last-child")[0] == "(AB)5A"
    lab.retype("Filter candidates: text, or comparisons such as k=3 or J<1", "k=4")
    expect(page.locator(".fnb-candidate[data-fate]")).to_have_count(1)
    expect(page.locator(".fnb-candidate-count")).to_have_text("1 of 5 candidates")
    page.locator(".fnb-candidate[data-fate]").click()
    expect(section(page, "Bx").locator(".fnb-word[data-chosen] .fnb-word-text")).to_have_text("(AB)4A")
    lab.expect_python("view.model.picked[0]", "candidate:x:1")
    page.locator(".fnb-candidate[data-fate]").press("Escape")
    expect(page.locator(".fnb-word[data-chosen]")).to_have_count(0)


def test_a_chosen_candidate_is_shown_in_all_views(watch: Watch) -> None:
    lab = watch("""
        views = ['facade', 'candidates', 'network', 'alignment', 'sizing']
        view = SolverView(traced('figure-7'), views=views, follow=False, height=2000)
        view
    """)
    page = lab.page
    layout = page.locator(".fnb-alignment .fnb-align-row").first.inner_text()
    lab.button("y: Sizing").click()
    lab.python("setattr(view.model, 'picked', ['candidate:x:0'])")
    said = page.locator(".fnb-alternative:visible")
    for name in ("network", "alignment", "sizing"):
        own = page.locator(f".fnb-{name} .fnb-alternative")
        expect(own).to_contain_text("Candidate 0 (s = 1, t = 5). It was aligned and costs more, J = 0.563 m")
    expect(page.locator(".fnb-net-status")).to_contain_text("The path has 5 columns")
    expect(page.locator(".fnb-align-group header")).to_contain_text("5 columns")
    assert page.locator(".fnb-alignment .fnb-align-row").first.inner_text() != layout
    # Its words are marked, and another candidate's are not.
    lab.button("Words").click()
    expect(page.locator(".fnb-words .fnb-alternative")).to_contain_text("Its words are marked.")
    marked = page.locator(".fnb-words .fnb-word[data-chosen] .fnb-word-text")
    assert [text.replace("\n", "") for text in marked.all_inner_texts()] == ["eBe", "AC5A"]
    lab.button("Words").click()
    # The façade has its five windows, where the layout has fewer.
    expect(page.locator(".fnb-traced-note")).to_contain_text("Candidate 0 (s = 1, t = 5), not the layout")
    expect(page.locator(".fnb-traced-other [data-x=C]")).to_have_count(5)
    boxes = [own.bounding_box() for own in page.locator(".fnb-traced-other [data-x=C]").all()]
    edges = sorted((box["x"], box["x"] + box["width"]) for box in boxes if box)
    assert all(right[0] >= left[1] - 2 for left, right in itertools.pairwise(edges))
    # Another moment, at which it is not judged yet: nothing of it.
    lab.button("x: Words").click()
    expect(said).to_have_count(0)
    expect(page.locator(".fnb-traced-other [data-x=C]")).to_have_count(0)


def test_a_candidate_longer_than_the_canvas_is_all_in_sight(watch: Watch, out: Path) -> None:
    lab = watch("view = FacadeView(traced('apartment-house'), player=False); view")
    page = lab.page
    judged = "[e for e in view.model.trace.events if type(e).__name__ == 'CandidateJudged' and e.axis == 'x']"
    number = lab.python(f"max({judged}, key=lambda e: sum(map(len, e.words.values()))).number")
    lab.python(f"setattr(view.model, 'picked', ['candidate:x:{number}'])")
    expect(page.locator(".fnb-traced-note")).to_contain_text("beyond the canvas.")

    def whole() -> None:
        sheet, line = (
            page.locator(selector).bounding_box()
            for selector in (".fnb-traced-sheet", ".fnb-traced-beyond line")
        )
        assert sheet
        assert line
        cells = page.locator(".fnb-traced-other .cell").evaluate_all(
            "all => all.map(each => each.getBoundingClientRect().right)"
        )
        assert max(cells) <= sheet["x"] + sheet["width"]
        assert line["x"] < max(cells) - 50  # the canvas ends before
        text = page.locator(".fnb-traced-beyond text")
        expect(text).to_have_text("canvas 21 m")
        box = text.bounding_box()
        assert box
        assert 8 < box["height"] < 24

    for width in (1400, 800):
        lab.resize(width)
        eventually(page, whole)
    page.screenshot(path=out / "facade-longer.png")


def test_figures_of_candidates_stay_in_sight(watch: Watch) -> None:
    """Words have a line of their own where they have no room beside the figures; what is cut off is told on hover."""
    lab = watch("CandidatesView(traced('concert-hall'), player=False)")
    page = lab.page
    row = page.locator(".fnb-candidate[data-fate=best]")

    def whole(stacked: bool) -> None:
        view = page.locator(".fnb-view").bounding_box()
        scrolled = page.locator(".fnb-candidate-scroll").evaluate("e => e.scrollWidth - e.clientWidth")
        cells = [each.bounding_box() for each in row.locator("[role=cell]").all()]
        assert view
        assert scrolled == 0
        assert len(cells) > 15
        assert all(box and box["x"] + box["width"] <= view["x"] + view["width"] for box in cells)
        tops = [box["y"] for box in cells if box]
        assert (max(tops) - min(tops) > 15) == stacked

    for width, stacked in ((1900, False), (980, True), (800, True)):
        lab.resize(width)
        expect(page.locator(".fnb-candidates[data-stacked]")).to_have_count(int(stacked))
        eventually(page, functools.partial(whole, stacked))
    long = row.locator(".fnb-candidate-word").nth(1)
    assert long.evaluate("e => e.scrollWidth > e.clientWidth")
    expect(long).to_have_attribute("title", re.compile(r"^E V I U I U"))
    # Rows in sight are as high as the list reckons with: the last one is reached.
    page.locator(".fnb-candidate-table .fnb-rows").evaluate("e => e.scrollTo(0, 1e6)")
    bottom = page.locator(".fnb-candidate-table .fnb-rows").bounding_box()
    last = page.locator(".fnb-rows .fnb-candidate").last
    expect(last.locator(".fnb-candidate-number").first).to_have_text("83")
    box = last.bounding_box()
    assert box
    assert bottom
    assert box["y"] + box["height"] == pytest.approx(bottom["y"] + bottom["height"], abs=2)


def test_a_candidate_is_predicted(watch: Watch) -> None:
    lab = watch("view = CandidatesView(traced('residential-house'), predict=True); view")
    page = lab.page
    assert "best" not in page.locator(".fnb-candidates").inner_text()
    page.locator(".fnb-candidate input").nth(2).check()
    lab.button("Hint").click()
    lab.button("Check").click()
    expect(page.locator(".fnb-quiz-outcome")).to_contain_text("Right. It is the layout.")
    lab.expect_python("view.answer", {"right": ["0"], "wrong": [], "missed": []})


def test_what_can_be_chosen_begins_at_the_top(watch: Watch) -> None:
    """Also where the list was scrolled to the candidate that is played."""
    lab = watch("CandidatesView(traced('apartment-house'), at='x/candidates+60')")
    page = lab.page
    rows = page.locator(".fnb-candidate-table .fnb-rows")
    expect(rows.locator("[data-now]")).to_be_visible()
    assert rows.evaluate("e => e.scrollTop") > 500
    lab.button("Predict").click()
    expect(page.locator(".fnb-candidate-count")).to_have_text("504 candidates")
    frames(page)
    until(page, lambda: rows.evaluate("e => e.scrollTop") == 0)


def test_the_equation_of_a_pair_is_predicted(watch: Watch, out: Path) -> None:
    lab = watch("view = AnalysisView(traced('apartment-house'), predict=True, at='x/analysis+9'); view")
    page = lab.page
    page.get_by_label("Question").select_option("pair (3)")
    expect(page.locator(".fnb-quiz-prompt")).to_have_text("What does the equation of pair (3) say?")
    expect(page.locator(".fnb-pair-follows")).to_have_text("⇒ ?")
    page.get_by_role("radio", name="2|f| = |g| − 1.5j + 4.4", exact=True).check()
    lab.button("Hint").click()
    lab.button("Check").click()
    expect(page.locator(".fnb-quiz-outcome")).to_have_text(
        "Right. What is left of both lines is equally long."
    )
    expect(page.locator(".fnb-offers li[data-verdict=right]")).to_have_count(1)
    expect(page.locator(".fnb-pair-follows")).to_contain_text("⇒ 2|f| = |g| − 1.5j + 4.4")
    lab.expect_python("view.answer['right']", ["2|f| = |g| − 1.5j + 4.4"])
    page.screenshot(path=out / "analysis-equation.png")


def test_the_code_of_what_is_played(watch: Watch) -> None:
    lab = watch("PlayerView(traced('residential-house'), at='x/words+2')")
    page = lab.page
    expect(page.locator(".fnb-event[data-now]")).to_contain_text("WordJudged")
    lab.button("Code").click()
    expect(page.locator(".fnb-code-title")).to_contain_text("solver.trace.word_events.words_judged")
    expect(page.locator(".fnb-code-text")).to_contain_text("def words_judged(")
    lab.button("x: Sizing").click()
    expect(page.locator(".fnb-code-title")).to_contain_text(
        "solver.sizing.system.size_axis · facade_nb/solver/sizing/system.py"
    )
    page.locator(".fnb-event", has_text="ActiveSetStep").first.click()
    expect(page.locator(".fnb-code-title")).to_contain_text("solver.trace.active_set.steps")


def test_the_events_keep_back_what_a_view_asks_for(watch: Watch) -> None:
    lab = watch("view = SolverView(traced('residential-house'), at='x/candidates+3'); view")
    page = lab.page
    events = page.locator(".fnb-event")
    expect(events.filter(has_text="Candidate 0")).to_contain_text("best")
    asking = page.locator(".fnb-view", has=page.locator(".fnb-candidates"))
    asking.get_by_role("button", name="Predict").click()
    kept = page.locator(".fnb-events-kept")
    expect(kept).to_contain_text("kept back while a view asks")  # within a frame
    shown = page.locator(".fnb-page").inner_text()
    assert "best" not in shown
    assert "WordJudged" not in shown  # a word that is taken is the layout's
    expect(page.locator(".fnb-play-caption")).to_have_text("")
    # Also where the list is scrolled to its end.
    last = int(kept.inner_text().split()[1]) - 1
    page.locator(".fnb-events .fnb-rows").evaluate("e => e.scrollTo(0, 1e6)")
    expect(page.locator(".fnb-event-at").last).to_have_text(str(last))
    # The view is taken off the page, and with it its question.
    lab.button("x: Analysis").click()
    expect(kept).to_be_hidden()
    lab.button("x: Candidates").click()
    expect(kept).to_be_visible()
    asking.get_by_role("radio").first.check()
    lab.button("Hint").click()
    lab.button("Check").click()
    expect(kept).to_be_hidden()
    lab.button("Step forward").click()
    expect(page.locator(".fnb-event[data-now]")).to_contain_text("Candidate 0")


def test_the_page_brings_the_view_of_the_stage(watch: Watch) -> None:
    lab = watch("view = SolverView(traced('residential-house'), at='x/analysis+3'); view")
    page = lab.page
    titles = page.locator(".fnb-page .fnb-view:visible .fnb-view-title")
    expect(titles).to_have_text(["Façade", "Events", "Pattern analysis"])
    lab.button("x: Words").click()
    expect(titles).to_have_text(["Façade", "Events", "Words"])
    lab.button("x: Candidates").click()
    lab.button("Step forward").click()
    expect(titles).to_have_text(["Façade", "Events", "Candidates"])
    expect(page.locator(".fnb-candidate[data-now]")).to_contain_text("★ best")
    lab.button("Pattern analysis").click()
    lab.button("Follow the stage").click()
    expect(titles).to_have_text(["Façade", "Events", "Pattern analysis"])
    lab.expect_python("[view.follow, view.views]", [False, ["facade", "player", "analysis"]])


def test_every_stage_has_its_name_on_the_track(watch: Watch) -> None:
    lab = watch("PlayerView(traced('apartment-house'))")
    page = lab.page
    for width in (1400, 1000, 850):
        lab.resize(width)
        for stage in ("x: Candidates", "Merging"):  # the one that is played is bold
            lab.button(stage).click()
            cut = page.locator(".fnb-play-stage").evaluate_all(
                "tabs => tabs.filter(tab => tab.scrollWidth > tab.clientWidth).map(tab => tab.innerText)"
            )
            assert cut == [], (width, stage)
    first = page.locator(".fnb-play-stage i:visible")
    assert [text.strip() for text in first.all_inner_texts()] == ["x", "y"]


def test_letters_light_up_on_the_facade_of_the_page(watch: Watch) -> None:
    lab = watch("SolverView(traced('apartment-house'), views=['facade', 'words'], follow=False)")
    page = lab.page
    row = section(page, "Gx").locator(".fnb-word[data-taken]")
    row.scroll_into_view_if_needed()
    row.locator(".fnb-box", has_text="F").first.hover()
    expect(page.locator(".fnb-traced-lit:not(.fnb-traced-letter)")).to_have_count(1)
    lit = page.locator(".fnb-traced-lit:not(.fnb-traced-letter)").bounding_box()
    door = page.locator(".fnb-traced [data-x=F][data-y=Z] .cell").first.bounding_box()
    assert lit == pytest.approx(door, abs=2.5)


def test_the_four_cases_of_figure_4(watch: Watch) -> None:
    lab = watch("view = QualifiersView(); view")
    page = lab.page
    told = page.locator(".fnb-case-told")
    covers = ["P covers D.", "P covers B.", "P stands between B and D.", "P stands between A and D."]
    expect(told).to_have_text(covers)
    # A post of (b) stands before the middle of its door, on the screen.
    case = page.locator(".fnb-case[data-case=b]")
    post, door = (case.locator(f"[data-x={x}] .cell").first.bounding_box() for x in "PB")
    assert post
    assert door
    assert post["x"] + post["width"] / 2 == pytest.approx(door["x"] + door["width"] / 2, abs=2)
    # Live: what makes (b) of (a), and back.
    switch = lab.button("D is unoccludable, case a")
    switch.click()
    expect(told).to_have_text(["P covers B.", *covers[1:]])
    expect(switch).to_have_attribute("aria-pressed", "true")
    lab.expect_python("view.models[0].design.symbols['D'].unoccludable", True)
    page.locator(".fnb-case[data-case=a]").get_by_role("button", name="As printed").click()
    expect(told).to_have_text(covers)
    lab.python("view.models[2].enter(('symbols', 'P', 'opaque'), False)")
    expect(told.nth(2)).to_have_text("P covers B.")


def test_every_control_has_a_name_and_keeps_its_keys(watch: Watch) -> None:
    lab = watch(
        "display(SolverView(traced('figure-7'), views=['facade', 'words', 'candidates']), QualifiersView())"
    )
    nameless = lab.page.evaluate(
        """() => [...document.querySelectorAll('.fnb :is(button, input, select, [tabindex])')]
            .filter(e => !(e.ariaLabel || e.textContent.trim()) || e.dataset.lmSuppressShortcuts !== 'true')
            .map(e => e.outerHTML.slice(0, 200))"""
    )
    assert nameless == []


@pytest.mark.parametrize("theme", ["JupyterLab Light", "JupyterLab Dark"])
def test_looks(watch: Watch, out: Path, theme: str) -> None:
    """Screenshots of the page at each stage, and that nothing sticks out of it."""
    lab = watch("SolverView(traced('apartment-house'), height=700)")
    page = lab.page
    name = theme.split()[1].lower()
    try:
        lab.theme(theme)  # type: ignore[arg-type]
        for stage in ("x: Analysis", "x: Words", "x: Candidates", "x: Alignment", "x: Sizing", "Merging"):
            lab.button(stage).click()
            for _ in range(3):
                lab.button("Step forward").click()
            lab.settle()
            wide = page.evaluate(
                """() => { const root = document.querySelector('.fnb-page').getBoundingClientRect();
                    return [...document.querySelectorAll('.fnb-view, .fnb-playbar')].filter(e => e.checkVisibility())
                        .filter(e => e.getBoundingClientRect().right > root.right + 1).map(e => e.ariaLabel); }"""
            )
            assert wide == []
            page.screenshot(path=out / f"solver-{name}-{stage.split()[-1].lower()}.png")
    finally:
        lab.theme("JupyterLab Light")


def test_the_notebook_shows_its_saved_state_and_can_be_played_without_a_kernel(
    visit: Visit,
) -> None:
    with visit("lab") as lab:
        page = lab.page
        shutil.copy(Path(__file__).resolve().parents[2] / "notebooks" / "solver.ipynb", lab.root)
        lab.visit("solver.ipynb")
        expect(page.get_by_alt_text("Elevation of Residential house")).to_be_visible()  # before it is trusted
        expect(page.locator("caption", has_text="Stages of Residential house").first).to_be_visible()
        lab.trust()
        house = page.locator(".fnb-page")
        expect(house.locator(".fnb-traced [data-shape]").first).to_be_attached()
        house.get_by_role("button", name="x: Words", exact=True).click()
        for _ in range(3):
            house.get_by_role("button", name="Step forward", exact=True).click()
        expect(house.locator(".fnb-word[data-now]")).to_have_count(1)
        # What was not needed before is not in the saved state, and that is said.
        house.get_by_role("button", name="Code", exact=True).click()
        expect(house.locator(".fnb-code-title")).to_contain_text("run the notebook to see it")
        # A prediction needs no kernel: the pieces of its view are in the saved state.
        asking = page.locator(".fnb-part-alignment")
        asking.scroll_into_view_if_needed()
        expect(asking.locator(".fnb-quiz-prompt")).to_contain_text("Where does column")
        asking.get_by_role("radio").first.check()
        asking.get_by_role("button", name="Hint", exact=True).click()
        asking.get_by_role("button", name="Check", exact=True).click()
        expect(asking.locator(".fnb-quiz-outcome")).to_have_text(re.compile(r"^(Right|No)\. .+"))
        figure = page.locator(".fnb-part-words")
        figure.scroll_into_view_if_needed()
        expect(figure.locator(".fnb-tuple-box h4")).to_have_text("Candidates for alignment (6)")
        assert lab.take_problems() == []


def test_running_the_cell_again_leaves_nothing_behind(watch: Watch) -> None:
    lab: Notebook = watch("view = SolverView(traced('figure-7')); view")
    shown = lab.page.locator(".fnb-view").first
    for _ in range(4):
        shown.evaluate("e => { e.dataset.old = 'true'; }")
        lab.run()
        expect(lab.page.locator(".fnb-view:not([data-old])").first).to_be_visible()
    widgets = "__import__('ipywidgets').Widget.widgets.values()"
    lab.expect_python(f"sum(len(w.timeline) > 0 for w in {widgets} if type(w).__name__ == 'TraceChannel')", 1)
    lab.expect_python(f"sum(type(w).__name__ == 'Code' and w._front == 'solver' for w in {widgets})", 1)
