"""Every kind of question the views of the solver ask, answered wrong and right, by keys, in a real JupyterLab."""

from __future__ import annotations

import re
import textwrap
from pathlib import Path

import pytest
from playwright.sync_api import Locator, expect

from .conftest import Watch
from .jupyter import Notebook

ASKED = """
    house, terraced = traced('residential-house'), traced('terraced-house')
    display(
        AnalysisView(house, player=False, predict=True), WordsView(house, player=False, predict=True),
        CandidatesView(house, player=False, predict=True), NetworkView(house, player=False, predict=True),
        AlignmentView(house, player=False, predict=True), SizingView(terraced, player=False, predict=True))
    NetworkView(traced('figure-8'), at='x/alignment+2', predict=True)
"""

RED = """view => {
    const probe = Object.assign(document.createElement('i'), { style: 'color: var(--fnb-error)' });
    view.append(probe);
    const red = getComputedStyle(probe).color;
    probe.remove();
    return [...view.querySelectorAll('[data-verdict]:is([data-verdict=right], [data-verdict=missed],'
        + '[data-verdict=passed])')].flatMap(own => [own, ...own.querySelectorAll('*')]).filter(own => {
            const { color, borderLeftColor, borderLeftWidth, boxShadow } = getComputedStyle(own);
            const text = own.textContent.trim() && color === red;
            return text || (borderLeftColor === red && borderLeftWidth !== '0px') || boxShadow.includes(red);
        }).map(own => own.textContent);
}"""
"""Texts of what was right and is painted red."""


def inputs(view: Locator) -> Locator:
    """What can be chosen."""
    return view.locator(".fnb-view-body input:is([type=radio], [type=checkbox])")


def verdicts(view: Locator) -> list[str]:
    """How each thing stands that can be chosen."""
    return inputs(view).evaluate_all("list => list.map(own => own.closest('[data-verdict]').dataset.verdict)")


def press(view: Locator, name: str) -> None:
    """Press a button of a question by the keyboard."""
    view.get_by_role("button", name=name, exact=True).press("Enter")


def anew(view: Locator) -> None:
    """The same question once more."""
    press(view, "Predict")
    press(view, "Predict")
    expect(view.locator(".fnb-quiz-outcome")).to_have_text("")
    expect(view.locator(".fnb-quiz-hint")).to_be_hidden()


def choose(view: Locator, places: list[int]) -> None:
    """Choose by the keyboard."""
    for place in places:
        inputs(view).nth(place).press("Space")
        expect(inputs(view).nth(place)).to_be_checked()


def answered(view: Locator) -> None:
    """A question: what is right is learnt, then it is answered wrong, then right."""
    outcome, hint = view.locator(".fnb-quiz-outcome"), view.locator(".fnb-quiz-hint")
    single = inputs(view).first.get_attribute("type") == "radio"
    press(view, "Hint")
    expect(hint).to_contain_text("Hint: ")
    if single:
        choose(view, [0])
    press(view, "Check")
    expect(outcome).not_to_have_text("")
    states = verdicts(view)
    right = [place for place, state in enumerate(states) if state in ("right", "missed")]
    wrong = [
        place for place, state in enumerate(states) if state == "wrong" or (state == "passed" and not right)
    ]
    wrong = wrong or [place for place, state in enumerate(states) if state == "passed"]
    assert wrong, states
    anew(view)
    choose(view, wrong[:1])
    press(view, "Check")
    expect(outcome).to_have_text("Not yet.")  # and nothing more: neither what was wrong nor what is right
    expect(hint).to_be_visible()
    assert set(verdicts(view)) == {"open"}
    press(view, "Check")
    expect(outcome).to_have_text(re.compile(r"^No\. .|wrong"))
    assert verdicts(view)[wrong[0]] == "wrong"
    assert view.evaluate(RED) == []
    anew(view)
    choose(view, right[:1] if single else right)
    press(view, "Check")
    expect(outcome).to_have_text(re.compile(r"^(Right|All right)"))
    assert "wrong" not in verdicts(view)
    assert view.evaluate(RED) == []


@pytest.fixture
def page(watch: Watch) -> Notebook:
    """Every view, each asking."""
    return watch(ASKED)


def test_every_question_is_answered_wrong_and_right(page: Notebook, out: Path) -> None:
    asked: list[str] = []
    for view in page.page.locator(".fnb-view").all():
        names = view.locator(".fnb-quiz-which option").all_text_contents()
        for name in names[:3] or [""]:
            if name:
                view.locator(".fnb-quiz-which").select_option(name)
            asked.append(view.locator(".fnb-quiz-prompt").text_content() or "")
            answered(view)
        title = view.locator(".fnb-view-title").inner_text().lower()
        view.screenshot(path=out / f"question-{title.replace(' ', '-')}.png")
    for part in (
        "contradict",
        "equation of pair",
        "words fit",
        "becomes the layout",
        "edge is next",
        "column",
    ):
        assert any(part in prompt for prompt in asked), (part, asked)
    assert any("was moved to" in prompt for prompt in asked)
    assert any("end larger" in prompt for prompt in asked)
    assert any("marked letter" in prompt for prompt in asked)


def test_a_network_is_built_up_part_by_part(watch: Watch, out: Path) -> None:
    lab = watch("NetworkView(traced('figure-8'), player=False)")
    page = lab.page
    status, told = page.locator(".fnb-net-status"), page.locator(".fnb-net-built-text")
    expect(told).to_be_hidden()
    lab.button("Build up").press("Enter")
    expect(told).to_have_text(re.compile(r"^The first node: nothing is read\. .* are left\.$"))
    expect(status).not_to_contain_text("The path has")  # the search is not shown while it is built up
    slider = page.get_by_role("slider", name="Parts of the network")
    slider.press("ArrowRight")
    expect(told).to_contain_text("A node is a boundary in both words.")
    told_all: list[str] = []
    for theme in ("JupyterLab Light", "JupyterLab Dark"):
        lab.theme(theme)
        for width in (900, 1600):
            lab.resize(width)
            for share in (0.2, 0.45, 0.8, 1.0):
                most = int(slider.get_attribute("max") or 0)
                slider.evaluate(
                    f"e => {{ e.value = {int(share * most)}; e.dispatchEvent(new Event('input')); }}"
                )
                expect(page.locator(".fnb-net-built-count")).to_have_text(f"{int(share * most)} / {most}")
                told_all.append(told.inner_text())
                page.screenshot(path=out / f"built-{width}-{theme[11:].lower()}-{int(100 * share)}.png")
    text = " ".join(told_all)
    assert "step of the automaton reads" in text
    assert "That is the whole network" in text
    lab.button("A part less").press("Enter")
    expect(told).to_have_text(re.compile(r"(Permitted|Forbidden): "))
    lab.button("Build up").press("Enter")
    expect(status).to_contain_text("The path has")
    for theme in ("JupyterLab Light", "JupyterLab Dark"):
        lab.theme(theme)
        for width in (900, 1600):
            lab.resize(width)
            page.screenshot(path=out / f"network-all-{width}-{theme[11:].lower()}.png")
            canvas = page.locator(".fnb-plane-canvas")
            canvas.focus()
            canvas.press("ArrowRight")
            page.screenshot(path=out / f"network-node-{width}-{theme[11:].lower()}.png")
            page.keyboard.press("Escape")
    lab.theme("JupyterLab Light")
    lab.resize(1400)


PIXEL = """
    text = '''S -> RepeatX(2.5, Bay)
    Bay -> SplitX(Rel, 1, Side, Abs, 1.2, Column, Rel, 1, Side)
    Column -> SplitY(Abs, 0.9, Side, Rel, 1, Window)
    Window -> Mat(Color, 0, 0.2, 0.2, 0.8, 1)
    Side -> Mat(Color, 0, 0.6, 0.3, 0.2, 1)'''
    model = TextureModel(text, size=(10, 9), lit=False)
    model.pick((3.7, 1.5))
    PixelInspector(model)
"""


def test_the_part_that_a_pixel_falls_into_is_predicted(lab: Notebook, out: Path) -> None:
    lab.run("from facade_nb.widgets import *\n" + textwrap.dedent(PIXEL))
    own = lab.page.locator(".fnb-tex-inspector")
    steps = own.locator(".fnb-tex-steps li")
    expect(steps).to_have_count(4)
    press(own, "Predict")
    expect(steps).to_have_count(2)
    expect(own).not_to_contain_text("part 2 of 3")
    own.get_by_role("radio", name="Side", exact=True).press("Space")
    press(own, "Check")
    expect(own.locator(".fnb-quiz-outcome")).to_have_text("Not yet.")
    expect(own.locator(".fnb-quiz-hint")).to_contain_text("Abs is metres")
    expect(steps).to_have_count(2)
    own.get_by_role("radio", name="Column", exact=True).press("Space")
    press(own, "Check")
    expect(own.locator(".fnb-quiz-outcome")).to_have_text("Right. It lies in this part.")
    expect(steps).to_have_count(4)
    assert own.evaluate(RED) == []
    own.screenshot(path=out / "question-pixel.png")
    press(own, "Again")
    expect(steps).to_have_count(3)
