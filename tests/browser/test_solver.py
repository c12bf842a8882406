"""The solver made visible, in a real JupyterLab: what stands on the screen, moment by moment."""

from __future__ import annotations

import functools
import re
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from .conftest import TRACED, Visit, Watch
from .waiting import eventually, frames


def section(page: Page, pattern: str) -> Locator:
    return page.locator(f".fnb-words-of[data-pattern={pattern}]")


def rows(page: Page, pattern: str) -> list[str]:
    """The words of a pattern as they are read on the screen: a line each, without the drawing."""
    return (
        section(page, pattern)
        .locator(".fnb-rows .fnb-word")
        .evaluate_all(
            """rows => rows.map(row => [...row.querySelectorAll("[role=cell]:not(.fnb-scale)")]
            .map(cell => cell.innerText.trim().replaceAll("\\n", "")).join(" "))"""
        )
    )


def shown(page: Page) -> str:
    return page.locator(".fnb-view-body").first.inner_html()


def test_figure_7_is_on_the_screen(watch: Watch) -> None:
    page = watch("WordsView(traced('figure-7'), tolerance=1.0, step=1.0)").page
    expect(section(page, "balconies").locator("code")).to_have_text("e b^s e; b := B")
    assert rows(page, "balconies")[:4] == [
        "1 4 eBe 11 ✓ fits",
        "1 3 eBe 9 ✓ fits",
        "2 2 eB2e 10 ✓ fits, taken",
        "3 1 eB3e 11 – no partner",
    ]
    assert [row for row in rows(page, "rooms") if "fits" in row] == [
        "1 4 AC4A 9.2 ✓ fits",
        "1 5 AC5A 10.5 ✓ fits",
        "2 1 A2CA2 9.3 ✓ fits",
        "2 2 A2C2A2 10.6 ✓ fits, taken",
    ]
    expect(page.locator(".fnb-tuple-box h4")).to_have_text("Candidates for alignment (6)")
    # Drawn to scale: AC⁴A ends within the band, a little before the canvas line.
    ends = page.evaluate(
        """() => {
            const row = [...document.querySelectorAll('[data-pattern=rooms] .fnb-word')]
                .find(row => row.querySelector('.fnb-word-text')?.innerText.replaceAll('\\n', '') === 'AC4A');
            const box = selector => [...row.querySelectorAll(selector)].at(-1).getBoundingClientRect();
            const scale = row.querySelector('.fnb-scale').getBoundingClientRect();
            const metre = (box('.fnb-canvas-line').left - scale.left) / 10;
            return [box('.fnb-box').right, box('.fnb-band').left, box('.fnb-band').right]
                .map(x => (x - scale.left) / metre);
        }"""
    )
    assert ends == pytest.approx([9.2, 9.0, 11.0], abs=0.05)


def test_a_smaller_tolerance_is_tried_in_the_browser(watch: Watch) -> None:
    lab = watch("view = WordsView(traced('figure-7')); view")
    page = lab.page
    assert sum(row.endswith("✓ fits") for row in rows(page, "rooms")) > 5
    lab.retype("Tolerance μ in metres", "0.5")
    expect(section(page, "rooms").locator(".fnb-eq")).to_have_text("9.5 ≤ |w| ≤ 10.5 m")
    assert [row for row in rows(page, "rooms") if "✓" in row] == ["1 5 AC5A 10.5 ✓ fits"]
    lab.retype("Tolerance μ in metres", "wide")
    expect(lab.field("Tolerance μ in metres")).to_have_attribute("aria-invalid", "true")


def test_the_player_steps_there_and_back(watch: Watch) -> None:
    lab = watch("view = WordsView(traced('residential-house')); view")
    page = lab.page
    lab.button("x: Words").click()
    expect(page.locator(".fnb-play-caption")).to_contain_text("Words: what each pattern can write")
    expect(page.locator(".fnb-words .fnb-empty")).to_contain_text("No word has been judged yet")
    seen = []
    for _ in range(5):
        seen.append(shown(page))
        lab.button("Step forward").click()
        frames(page)
    expect(page.locator(".fnb-word[data-now]")).to_have_count(1)

    def shows(before: str) -> None:
        assert shown(page) == before

    for before in reversed(seen):
        lab.button("Step back").click()
        eventually(page, functools.partial(shows, before))
    # By keys, on the track; the sentence follows.
    track = page.get_by_role("slider", name="Position in the trace")
    track.press("End")
    expect(page.locator(".fnb-play-caption")).to_contain_text("All done in")
    expect(lab.button("Step forward")).to_be_disabled()
    track.press("Home")
    expect(page.locator(".fnb-play-caption")).to_contain_text("solve was asked for Residential house")
    track.press("PageDown")
    expect(page.locator(".fnb-play-caption")).to_contain_text("Words: what each pattern can write")


def test_it_plays_to_the_end_and_stops(watch: Watch) -> None:
    lab = watch("view = WordsView(traced('qualifiers-a')); view")
    speed = lab.field("Speed in events per second")
    speed.select_option(index=0)  # slow enough to be seen
    lab.button("Play").click()
    expect(lab.button("Pause")).to_be_visible()
    speed.select_option("1024")
    expect(lab.button("Play")).to_be_visible()
    expect(lab.page.locator(".fnb-play-caption")).to_contain_text("All done in")


def test_scrubbing_moves_all_views(watch: Watch) -> None:
    lab = watch(
        "layout = traced('residential-house'); display(WordsView(layout), FacadeView(layout, player=False))"
    )
    page = lab.page
    expect(page.locator(".fnb-traced-note")).to_have_text("17 of 17 shapes")
    box, merging = page.locator(".fnb-play-track").bounding_box(), lab.button("Merging").bounding_box()
    assert box
    assert merging
    page.mouse.move(box["x"] + 3, box["y"] + 8)
    page.mouse.down()
    expect(page.locator(".fnb-traced-note")).to_have_text("Nothing is placed yet")
    assert page.locator(".fnb-traced [data-shape]:not([data-later])").count() == 0
    page.mouse.move(merging["x"] + merging["width"] / 5, box["y"] + 8, steps=5)
    page.mouse.up()
    drawn = page.locator(".fnb-traced [data-shape]:not([data-later])").count()
    assert 0 < drawn < 17
    expect(page.locator(".fnb-traced-note")).to_have_text(f"{drawn} of 17 shapes")


def test_the_moment_is_kept_and_can_be_linked_to(watch: Watch) -> None:
    lab = watch("""
        view = WordsView(traced('residential-house'))
        display(view)
        from IPython.display import Markdown
        display(Markdown("[the third word](#facade-nb=x/words+3)"))
    """)
    page = lab.page
    page.get_by_role("link", name="the third word").click()
    expect(page.locator(".fnb-word[data-now] .fnb-word-text")).to_have_text("CeC")
    lab.expect_python("view.model.moment", "x/words+3")
    lab.python("setattr(view.model, 'moment', 'x/words+2')")
    expect(page.locator(".fnb-word[data-now] .fnb-word-text")).to_have_text("fDf")
    page.evaluate("() => window.jupyterapp.commands.execute('docmanager:save')")
    page.reload()
    lab.take_problems()
    expect(page.locator(".fnb-word[data-now] .fnb-word-text")).to_have_text("fDf")


def test_links_light_up_across_views(watch: Watch) -> None:
    lab = watch(
        "layout = traced('residential-house'); display(WordsView(layout), FacadeView(layout, player=False))"
    )
    page = lab.page
    # The first C of the word that was taken: its one shape, and no other.
    section(page, "Cx").locator(".fnb-box", has_text="C").first.hover()
    expect(page.locator(".fnb-traced-lit:not(.fnb-traced-letter)")).to_have_count(1)
    lit, shape = (
        page.locator(selector).first.bounding_box()
        for selector in (".fnb-traced-lit:not(.fnb-traced-letter)", ".fnb-traced [data-layer=columns] .cell")
    )
    assert lit == pytest.approx(shape, abs=2.5)
    # A word that was not taken stands for its symbols: all shapes of B.
    section(page, "Bx").locator(".fnb-word", has_text="too short").locator(
        ".fnb-box", has_text="A"
    ).first.hover()
    symbols = page.locator(".fnb-traced [data-x=A]").count()
    expect(page.locator(".fnb-traced-lit:not(.fnb-traced-letter)")).to_have_count(symbols)
    page.locator(".fnb-traced [data-layer=door]").hover()
    expect(section(page, "Dx").locator(".fnb-box[data-lit]", has_text="D")).not_to_have_count(0)
    expect(section(page, "Bx").locator(".fnb-box[data-lit]")).to_have_count(0)


def test_the_reader_predicts_words(watch: Watch) -> None:
    lab = watch("view = WordsView(traced('figure-7'), tolerance=1.0, step=1.0, predict=True); view")
    page = lab.page
    expect(page.locator(".fnb-quiz-prompt")).to_contain_text("Which words fit?")
    assert "fits" not in " ".join(rows(page, "rooms"))
    section(page, "rooms").get_by_label("A C C C C A fits", exact=True).check()
    section(page, "rooms").get_by_label("A C C C C C C A fits", exact=True).check()
    lab.button("Hint").click()
    lab.button("Check").click()
    expect(page.locator(".fnb-quiz-outcome")).to_have_text("1 right, 1 wrong, 6 missed.")
    expect(page.locator(".fnb-word[data-verdict=wrong]")).to_contain_text("too long by 0.8")
    lab.expect_python("[len(view.answer[k]) for k in ('right', 'wrong', 'missed')]", [1, 1, 6])
    lab.button("Again").click()
    assert "longer" not in page.locator(".fnb-words").inner_text()


def test_a_live_model_is_followed(watch: Watch) -> None:
    lab = watch("""
        model = FacadeModel(gallery.load("residential-house"), time_limit=600.0)
        display(CanvasEditor(model), WordsView(model))
    """)
    page = lab.page
    before = section(page, "Bx").locator(".fnb-eq").inner_text()
    lab.retype("Canvas width in metres", "9")
    expect(section(page, "Bx").locator(".fnb-tick").first).to_have_text("canvas 9 m")
    assert section(page, "Bx").locator(".fnb-eq").inner_text() != before


def test_an_error_of_ours_is_shown_where_the_view_would_be(watch: Watch) -> None:
    lab = watch("view = WordsView(traced('figure-7')); view")
    lab.run(
        TRACED
        + """
from facade_nb.widgets.solver import channel as _channel
_made, _channel.chunk = _channel.chunk, lambda *_: 1 / 0
view = WordsView(traced('figure-7'))
_channel.chunk = _made
view"""
    )
    expect(lab.page.locator(".fnb-trouble summary")).to_have_text("ZeroDivisionError: division by zero")


def test_an_address_leads_to_a_moment(watch: Watch) -> None:
    lab = watch("view = WordsView(traced('residential-house')); view")
    lab.page.evaluate("() => { location.hash = '#facade-nb=x/words+2&design=Residential%20house'; }")
    expect(lab.page.locator(".fnb-word[data-now] .fnb-word-text")).to_have_text("fDf")
    lab.page.evaluate("() => { location.hash = '#facade-nb=x/words+3&design=Another'; }")
    frames(lab.page)
    expect(lab.page.locator(".fnb-word[data-now] .fnb-word-text")).to_have_text("fDf")
    lab.page.evaluate("() => history.replaceState(null, '', location.pathname + location.search)")


def test_a_copied_link_opens_the_page_at_its_moment(visit_anew: Visit) -> None:
    with visit_anew("lab") as lab:
        page = lab.page
        lab.open(TRACED + "view = WordsView(traced('residential-house')); view", "linked.ipynb")
        lab.run()
        expect(page.locator(".fnb-play-count")).to_have_text(re.compile(r"(\d+) / \1"))
        page.evaluate("() => window.jupyterapp.commands.execute('docmanager:save')")
        page.goto(lab.address("linked.ipynb") + "#facade-nb=x/words+3&design=Residential%20house")
        expect(page.locator(".fnb-word[data-now] .fnb-word-text")).to_have_text("CeC")


@pytest.mark.parametrize("theme", ["JupyterLab Light", "JupyterLab Dark"])
def test_looks(watch: Watch, out: Path, theme: str) -> None:
    """Screenshots for people, and that the theme is followed."""
    lab = watch(
        "layout = traced('apartment-house'); display(WordsView(layout), FacadeView(layout, player=False))"
    )
    try:
        lab.theme(theme)  # type: ignore[arg-type]
        dark = theme.endswith("Dark")
        expect(lab.page.locator(".fnb-solver").first).to_have_attribute(
            "data-theme", "dark" if dark else "light"
        )
        frames(lab.page)
        lab.page.screenshot(path=out / f"solver-words-{'dark' if dark else 'light'}.png")
    finally:
        lab.theme("JupyterLab Light")
