"""The patterns' editor, by mouse and keys: colours, completions, the words, the card, and links with the façade."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import expect

from .conftest import HOUSE
from .jupyter import Notebook
from .waiting import eventually, frames


@pytest.fixture(scope="module")
def shown(opened_lab: Notebook) -> Notebook:
    """One studio for all tests here; each takes back what it has typed."""
    opened_lab.resize(1400)
    opened_lab.run(HOUSE + "Studio(model, height=900)")
    opened_lab.shown()
    return opened_lab


@pytest.fixture
def studio(shown: Notebook) -> Iterator[Notebook]:
    """The studio with the design as it was at first."""
    shown.take_problems()
    yield shown
    shown.page.mouse.move(2, 2)
    shown.python("[model.undo() for _ in iter(lambda: model.can_undo, False)] and None")
    shown.settle()
    assert shown.take_problems() == []


def point_at(studio: Notebook, pattern: str, place: int) -> None:
    """Move the pointer onto a letter of a pattern's text, by where it stands in it."""
    field = studio.field(f"Pattern {pattern}")
    field.scroll_into_view_if_needed()
    letter = studio.page.locator(f".fnb-ink [data-pattern={pattern}][data-place='{place}']")
    box = letter.bounding_box()
    assert box
    studio.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)


def test_a_text_is_coloured_as_it_is_typed_and_its_letters_lie_over_those_of_the_field(
    studio: Notebook,
) -> None:
    page, keys = studio.page, studio.page.keyboard
    field = studio.field("Pattern Bx")
    ink = page.locator(".fnb-pattern[data-pattern=Bx] .fnb-ink")
    field.click()
    page.mouse.move(2, 2)  # what the pointer is on is lit, letters of its kind as well
    keys.press("End")
    keys.type("A" * 60)  # more than a line
    expect(ink).to_have_text("A(BA)^k" + "A" * 60 + "\u200b")
    frames(page)
    expect(ink.locator("[data-lit]")).to_have_count(0)
    assert field.evaluate(
        """field => {
            const ink = field.parentElement.querySelector(".fnb-ink");
            const [a, b] = [field, ink].map(el => getComputedStyle(el));
            const same = ["font", "letterSpacing", "paddingLeft", "paddingTop", "borderLeftWidth", "whiteSpace",
                "overflowWrap"].every(name => a[name] === b[name]);
            return same && ink.clientWidth === field.clientWidth && ink.scrollHeight <= field.clientHeight + 1;
        }"""
    )
    colour = "el => getComputedStyle(el).color"
    letters = ink.locator("[data-letter]")
    assert letters.nth(0).evaluate(colour) == letters.nth(2).evaluate(colour)
    assert letters.nth(0).evaluate(colour) != letters.nth(1).evaluate(colour)
    swatch = page.locator(".fnb-symbol[data-symbol=B] .fnb-tint").evaluate(
        "el => getComputedStyle(el).backgroundColor"
    )
    assert letters.nth(1).evaluate(colour) == swatch
    keys.press("ControlOrMeta+Home")  # the text is longer than a line
    keys.press("ArrowRight")
    keys.type("(")
    fault = ink.locator("[data-fault]")
    expect(fault).to_have_text("(")
    assert fault.evaluate("el => [...el.parentElement.children].indexOf(el)") == 1
    keys.press("Backspace")
    expect(fault).to_have_count(0)


def test_completions_are_chosen_by_keys_and_undone(studio: Notebook) -> None:
    page, keys = studio.page, studio.page.keyboard
    field = studio.field("Pattern Cx")
    options = page.locator(".fnb-suggest:visible [role=option] b")
    field.click()
    keys.press("End")
    keys.type("^")
    expect(options).to_have_text(["k", "~", "|", ".", ":", "@", "-"])
    keys.press("ArrowDown")
    keys.press("Enter")
    expect(field).to_have_value("cec; c := C^k")
    expect(options).to_have_count(0)
    keys.press("Enter")  # a line, as ever
    keys.press("Control+Space")
    expect(options).to_have_text(["e :="])
    keys.press("Escape")
    expect(options).to_have_count(0)
    expect(field).to_be_focused()
    keys.press("Backspace")
    studio.expect_python("model.design.patterns['Cx'].text", "cec; c := C^k")
    keys.press("ControlOrMeta+z")
    eventually(page, lambda: expect(field).not_to_have_value("cec; c := C^k"))
    expect(field).to_be_focused()
    keys.press("Tab")
    expect(studio.button("Words of pattern Cx")).to_be_focused()


def test_the_words_are_listed_and_follow_what_is_typed(studio: Notebook) -> None:
    page, keys = studio.page, studio.page.keyboard
    open_words = studio.button("Words of pattern Bx")
    open_words.click()
    rows = page.locator(".fnb-words:visible .fnb-word-row")
    expect(rows).to_have_count(5)
    chosen = page.locator(".fnb-words:visible [aria-current=true] .fnb-word-letters")
    expect(chosen).to_have_text("ABABABA")
    expect(rows.last.locator(".fnb-word-reason")).to_have_text("not kept: too long")
    expect(page.locator(".fnb-words-more:visible")).to_have_text("and 1 more that is kept")
    studio.retype("Greatest value of counter k", "2")
    expect(chosen).to_have_text("ABABA")
    expect(page.locator(".fnb-words:visible [data-reason=range] .fnb-word-reason")).to_have_text(
        "not kept: beyond k ≤ 2"
    )
    field = studio.field("Pattern Bx")
    field.click()
    keys.press("End")
    keys.type("B")
    expect(chosen).to_have_text("ABABAB")
    studio.button("Words of pattern By").click()
    expect(page.locator(".fnb-words:visible .fnb-word-letters")).to_have_text(["PQ"])
    studio.button("Words of pattern By").click()
    expect(page.locator(".fnb-words:visible")).to_have_count(0)


def test_the_card_draws_every_mode_and_gives_the_focus_back(studio: Notebook) -> None:
    page, keys = studio.page, studio.page.keyboard
    studio.field("Pattern Bx").click()
    keys.press("End")
    keys.press("Escape")
    helper = studio.button("How patterns are written").first
    helper.focus()
    keys.press("Enter")
    card = page.get_by_role("dialog", name="How patterns are written")
    expect(card).to_be_visible()
    words = card.locator(".fnb-mode-word")
    expect(words).to_have_text(
        ["EkGEkG", "EkGGkEEkGGkE", "EkGEkGGkEGkE", "EkGkEEkGkE", "EkGGkEkGGkE", "EkGkEkGkE"]
    )
    copies = card.get_by_label("Copies")
    expect(copies).to_be_focused()
    keys.press("ArrowLeft")
    expect(words.first).to_have_text("EkG")
    box = card.bounding_box()
    assert box and box["x"] >= 0 and box["x"] + box["width"] <= 1400
    keys.press("Escape")
    expect(card).to_be_hidden()
    expect(helper).to_be_focused()


def test_a_letter_of_the_text_and_its_cells_mark_each_other(studio: Notebook) -> None:
    page = studio.page
    lit = page.locator(".fnb-overlay .fnb-lit")
    point_at(studio, "Bx", 2)
    expect(lit).to_have_count(5)  # three B on both floors; one is behind the door
    expect(page.locator(".fnb-symbol[data-symbol=B]")).to_have_attribute("data-lit", "")
    point_at(studio, "Bx", 0)
    expect(lit).to_have_count(2)  # the first A alone
    point_at(studio, "Cx", 1)
    expect(lit).to_have_count(0)  # e is transparent: only where it lies is shown
    expect(page.locator(".fnb-overlay .fnb-lit-band")).to_have_count(1)
    page.mouse.move(2, 2)
    cells = page.locator(".fnb-elevation [data-layer=base][data-x=A][data-y=Q]")
    cells.nth(2).hover()
    marked = page.locator(".fnb-ink [data-lit]")
    expect(marked).to_have_count(2)
    expect(marked.first).to_have_attribute(
        "data-place", "3"
    )  # in A(BA)^k: the third A is the second of those in brackets
    expect(marked.first).to_have_attribute("data-copy", "2 of 3")
    cells.nth(0).click()
    chosen = page.locator(".fnb-ink [data-chosen]")
    expect(chosen).to_have_count(2)
    expect(chosen.first).to_have_attribute("data-place", "0")
    page.locator(".fnb-layer[data-layer=columns] .fnb-grip").hover()
    expect(page.locator(".fnb-pattern[data-lit]")).to_have_count(2)
    page.keyboard.press("Escape")
    expect(chosen).to_have_count(0)


def test_an_input_method_keeps_its_keys_and_its_letters_are_seen(studio: Notebook) -> None:
    page, keys = studio.page, studio.page.keyboard
    field = studio.field("Pattern Rx")
    field.click()
    keys.press("End")
    keys.type("^")
    expect(page.locator(".fnb-suggest:visible")).to_have_count(1)
    client = page.context.new_cdp_session(page)
    client.send("Input.imeSetComposition", {"text": "k", "selectionStart": 1, "selectionEnd": 1})
    assert field.evaluate("el => getComputedStyle(el).color !== 'rgba(0, 0, 0, 0)'")
    expect(page.locator(".fnb-pattern[data-pattern=Rx] .fnb-ink")).to_be_hidden()
    client.send("Input.insertText", {"text": "k"})
    client.detach()
    expect(page.locator(".fnb-pattern[data-pattern=Rx] .fnb-ink")).to_have_text("H^k\u200b")
    expect(page.locator(".fnb-pattern[data-pattern=Rx] .fnb-ink")).to_be_visible()
    studio.expect_python("model.design.patterns['Rx'].text", "H^k")


def test_details_tell_the_terms_of_J_apart(studio: Notebook) -> None:
    page = studio.page
    page.locator(".fnb-details > summary").click()
    heads = page.locator(".fnb-figures th[title]")
    expect(page.locator(".fnb-figures thead th")).to_have_text(
        ["Axis", "J", "Ω", "E", "Λ", "Fit", "Deviation", "Best?"]
    )
    assert heads.count() == 6
    across = [
        text.split()[0] for text in page.locator(".fnb-figures tr[data-axis=x] td").all_inner_texts()[:5]
    ]
    cost, *terms = map(float, across)
    assert abs(cost - sum(terms)) < 0.003
    page.locator(".fnb-details > summary").click()
