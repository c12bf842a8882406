"""Lessons, the numbers of a search, two runs, and the code that is played, in a real JupyterLab, on one page."""

from __future__ import annotations

from playwright.sync_api import expect

from .conftest import Watch
from .waiting import until


def test_a_lesson_is_chosen_stepped_through_and_left(watch: Watch) -> None:
    lab = watch("view = SolverView(traced('figure-8'), views=['code', 'network']); view")
    page = lab.page
    lessons = page.get_by_role("combobox", name="Lesson", exact=True)
    lessons.focus()
    page.keyboard.type("4")  # its number begins its name
    page.keyboard.press("Enter")
    expect(page.locator(".fnb-play-lesson")).to_contain_text("six times, each time with a larger limit")
    page.get_by_role("combobox", name="What a step goes to").select_option("pass")
    for n in range(1, 7):
        page.get_by_role("button", name="Step forward").click()
        expect(page.locator(".fnb-strip-said")).to_contain_text(f"Pass {n}")
        expect(page.locator(".fnb-strip-said")).to_contain_text("best so far –")
    expect(page.locator(".fnb-strip-said")).to_contain_text("limit 2.09 m")
    expect(page.locator(".fnb-code-line[data-now]")).to_contain_text("meeting = Meeting(")
    expect(page.locator(".fnb-code-values")).to_contain_text("self._threshold = 2.09")
    page.get_by_role("combobox", name="What a step goes to").select_option("improvement")
    page.get_by_role("button", name="Step forward").click()
    expect(page.locator(".fnb-strip-said")).to_contain_text("best so far 1.8 m")
    page.get_by_role("button", name="Step forward").click()
    expect(page.locator(".fnb-strip-said")).to_contain_text("best so far 1.55 m")
    # a click on the course goes there
    track = page.get_by_role("slider", name="Course of the search")
    box = track.bounding_box()
    assert box
    page.mouse.click(box["x"] + 3, box["y"] + 10)
    expect(page.locator(".fnb-strip-said")).to_contain_text("best so far –")
    lessons.select_option("")
    expect(page.locator(".fnb-play-lesson")).to_be_hidden()
    expect(page.locator(".fnb-net-status").first).to_contain_text("4 × 6 nodes")


def test_two_runs_go_on_together_and_are_counted(watch: Watch) -> None:
    lab = watch("view = RunsView(traced('figure-8'), player=False); view.model.lesson = 'table'; view")
    page = lab.page
    steps = page.get_by_role("slider", name="Nodes expanded")
    expect(page.locator(".fnb-runs-side .fnb-net-status")).to_have_count(2)
    expect(page.locator(".fnb-runs-counts")).to_be_hidden()
    steps.focus()
    page.keyboard.press("ArrowRight")
    expect(page.locator(".fnb-runs-side > p").first).to_have_text("1 node expanded")
    page.keyboard.press("End")
    expect(page.locator(".fnb-runs-side > p").first).to_have_text("done after 11 nodes")
    expect(page.locator(".fnb-runs-side > p").last).to_have_text("done after 27 nodes")
    row = page.locator(".fnb-runs-counts tr", has_text="J, m")
    assert row.locator("td").all_inner_texts() == ["1.365", "1.365"]
    page.get_by_role("combobox", name="What is changed").select_option("table")
    until(
        page,
        lambda: "13 nodes" in (steps.press("End") or page.locator(".fnb-runs-side > p").last.inner_text()),
    )
