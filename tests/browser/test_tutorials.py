"""A tutorial as a student meets it: opened, run, every question answered, and its pictures for people to look at."""

from __future__ import annotations

import functools
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import pytest
from playwright.sync_api import Locator, Page, expect

from .conftest import Visit
from .jupyter import Notebook
from .waiting import eventually

NAME = "how-the-solver-thinks.ipynb"
SET = """([id, from, to]) => {
    const panel = window.jupyterapp.shell.currentWidget;
    const n = [...panel.content.model.cells].findIndex(cell => cell.id === id);
    const shared = panel.content.model.cells.get(n).sharedModel;
    shared.setSource(shared.source.replace(from, to));
    panel.content.activeCellIndex = n;
    return window.jupyterapp.commands.execute('notebook:run-cell');
}"""


@pytest.fixture(scope="module")
def opened(visit: Visit) -> Iterator[Notebook]:
    with visit("lab") as lab:
        shutil.copy(Path(__file__).resolve().parents[2] / "tutorials" / NAME, lab.root)
        lab.resize(1250)
        lab.visit(NAME)
        yield lab


def cell(page: Page, text: str) -> Locator:
    """The cell of code with that text, on the screen: JupyterLab draws no others."""
    index = page.evaluate(
        """text => {
            const { content } = window.jupyterapp.shell.currentWidget;
            const n = [...content.model.cells].findIndex(
                cell => cell.type === 'code' && cell.sharedModel.source.includes(text));
            return content.scrollToItem(n, 'start').then(() => n);
        }""",
        text,
    )
    return page.locator(f".jp-NotebookPanel:not(.lm-mod-hidden) .jp-Cell[data-windowed-list-index='{index}']")


def answer(own: Locator, *names: str) -> Locator:
    """Choose, check; what the view says of it. Before that it must not have told."""
    expect(own.locator(".fnb-quiz-outcome")).to_be_hidden()
    for name in names:
        own.get_by_label(name, exact=True).check()
    own.get_by_role("button", name="Check", exact=True).click()
    return own.locator(".fnb-quiz-outcome")


def test_before_it_is_run_answers_are_folded_away(opened: Notebook) -> None:
    own = cell(opened.page, "WordsView(solved")
    expect(own.get_by_text("The answer", exact=True)).to_be_visible()
    expect(own.get_by_role("img")).to_be_hidden()
    own.get_by_text("The answer", exact=True).click()
    expect(own.get_by_role("img", name="Words of Tiny house")).to_be_visible()
    assert opened.take_problems() == []


@pytest.fixture(scope="module")
def run(opened: Notebook) -> Notebook:
    opened.run()
    return opened


def test_each_question_is_answered_as_the_text_says(run: Notebook, out: Path) -> None:
    page = run.page
    own = cell(page, "WordsView(solved")
    expect(answer(own, "C e C fits", "A B A B A fits", "A B A B A B A fits")).to_have_text("All right.")
    page.screenshot(path=out / "tutorial-words.png")

    own = cell(page, "AnalysisView(awnings")
    expect(own.locator(".fnb-pair-equation")).to_have_text("⇒ j + 2 = k")
    expect(answer(own)).to_have_text("Right: there are none.")

    own = cell(page, "CandidatesView(solved")
    own.get_by_role("row").filter(has_text="ABABA").get_by_role("radio").check()
    expect(answer(own)).to_contain_text("Right.")

    own = cell(page, 'at="x/alignment+2"')
    expect(own.locator("[data-choice=e]")).to_contain_text("Cε")
    expect(answer(own, "edge e")).to_contain_text("Right.")
    page.screenshot(path=out / "tutorial-network.png")

    own = cell(page, "AlignmentView(slender")
    own.locator(".fnb-offers li", has_text=re.compile(r"front: ?Cwalls: ?A ?J with it")).get_by_role(
        "radio"
    ).check()
    expect(answer(own)).to_contain_text("Right.")
    expect(own.locator(".fnb-offers")).to_contain_text("no row stands behind it with opaque letters (C1)")

    own = cell(page, "SizingView(solved")
    for box in own.get_by_role("checkbox").all():
        box.check()
    expect(answer(own)).to_have_text("All right.")
    expect(own.locator(".fnb-traced [data-shape]")).to_have_count(7)

    own = cell(page, '^|k")), tolerance')
    expect(answer(own, "C e C fits", "A B A A' B' fits")).to_have_text("All right.")
    assert run.take_problems() == []


def test_near_the_end_of_the_search_four_edges_wait(run: Notebook, out: Path) -> None:
    """The moment that the text proposes."""
    page = run.page
    page.evaluate(SET, ["think-10", "+2", "+90"])
    own = cell(page, 'at="x/alignment+90"')
    expect(own.locator("[data-choice]")).to_have_count(4)
    expect(answer(own, "edge a")).to_contain_text(
        "Right. No alignment that goes on so costs less than J = 0.555 m"
    )
    page.screenshot(path=out / "tutorial-network-90.png")
    assert run.take_problems() == []


@pytest.mark.parametrize("theme", ["JupyterLab Light", "JupyterLab Dark"])
def test_looks(run: Notebook, out: Path, theme: Literal["JupyterLab Light", "JupyterLab Dark"]) -> None:
    """Screenshots for people; no view is wider than its cell, at two widths of the window."""
    page = run.page
    try:
        run.theme(theme)
        for width in (1250, 900):
            run.resize(width)
            for name in ("Words", "Analysis", "Candidates", "Network", "Alignment", "Sizing"):
                own = cell(page, f"{name}View(")
                expect(own.locator(".fnb-view").first).to_be_visible()
                eventually(page, functools.partial(fits, own))
                page.screenshot(path=out / f"tutorial-{name.lower()}-{width}-{theme[11:].lower()}.png")
    finally:
        run.theme("JupyterLab Light")
        run.resize(1250)


def fits(own: Locator) -> None:
    """The view of a cell is not wider than it."""
    inner, outer = (own.locator(name).first.bounding_box() for name in (".fnb-view", ".jp-OutputArea"))
    assert inner
    assert outer
    assert inner["x"] + inner["width"] <= outer["x"] + outer["width"] + 1
