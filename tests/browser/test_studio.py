"""The Studio in JupyterLab, as a person uses it."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import expect

from .jupyter import Notebook
from .keys import retype
from .waiting import frames

Show = Callable[[str], Notebook]


@pytest.fixture
def studio(show: Show) -> Notebook:
    """The Studio on the residential house: three bays, 17 shapes."""
    lab = show("Studio(model)")
    expect(lab.page.locator(".fnb-elevation [data-shape]")).to_have_count(17)
    return lab


def shapes(lab: Notebook, count: int) -> None:
    expect(lab.page.locator(".fnb-elevation [data-shape]")).to_have_count(count)


def status(lab: Notebook, text: str | re.Pattern[str]) -> None:
    expect(lab.page.locator(".fnb-status-line")).to_contain_text(text)


def test_the_facade_follows_every_keystroke(studio: Notebook) -> None:
    field = studio.field("Pattern Bx")
    field.click()
    field.press("End")
    field.press("Backspace")  # "A(BA)^": a fault, the last façade stays
    expect(studio.page.locator(".fnb-pattern[data-pattern=Bx] .fnb-fault-text")).to_be_visible()
    expect(studio.page.locator(".fnb-elevation .fnb-tag")).to_be_visible()
    shapes(studio, 17)
    field.press("2")  # "A(BA)^2": two bays
    expect(studio.page.locator(".fnb-elevation [data-layer=base]")).to_have_count(10)
    expect(studio.page.locator(".fnb-elevation .fnb-tag")).to_be_hidden()
    for text, base in (("", 10), ("|", 10), ("A", 10), ("B", 10)):
        field.press_sequentially(text)
        expect(field).to_be_focused()
        expect(studio.page.locator(".fnb-elevation [data-layer=base]")).to_have_count(base)
    assert field.input_value() == "A(BA)^2|AB"
    expect(studio.page.locator(".fnb-fault:visible")).to_have_count(0)
    studio.expect_python("model.design.patterns['Bx'].text", "A(BA)^2|AB")


def test_fast_typing_loses_nothing(studio: Notebook) -> None:
    field = studio.field("Pattern Bx")
    retype(field, "")
    text = "A(BA)^k | AB(AB)^k | A(B A)^{k}"
    field.press_sequentially(text)
    assert field.input_value() == text
    expect(studio.page.locator(".fnb-fault:visible")).to_have_count(0)
    studio.expect_python("model.design.patterns['Bx'].text", text)
    assert field.input_value() == text


def test_a_wider_canvas_has_more_bays(studio: Notebook) -> None:
    field = studio.field("Canvas width in metres")
    retype(field, "9,4")
    expect(studio.page.locator(".fnb-elevation [data-layer=base][data-x=B][data-y=Q]")).to_have_count(5)
    expect(studio.page.locator(".fnb-counter[data-counter=k] .fnb-solved")).to_have_text("5")
    assert field.input_value() == "9,4"
    field.blur()
    expect(field).to_have_value("9.4")  # once the kernel has answered
    field.press("ArrowUp")
    expect(field).to_have_value("9.5")
    retype(field, "wide")
    expect(studio.page.locator(".fnb-canvas .fnb-fault-text")).to_contain_text("number of metres")
    studio.expect_python("model.design.canvas.width", 9.5)


PATIENT = """
from facade_nb.solver import tuning
hurried = tuning.REMEDIES, tuning.REMEDY
tuning.REMEDIES, tuning.REMEDY = 600.0, 600.0
Studio(model)
"""


def test_a_change_that_helps_is_one_click_away(show: Show) -> None:
    studio = show(
        PATIENT
    )  # what would help is tried for a fraction of a second: here, for as long as it takes
    try:
        retype(studio.field("Preferred size of A in metres"), "9")
        fix = studio.page.locator(".fnb-suggestions .fnb-fix").first
        expect(fix).to_be_visible()
        sentence = studio.page.locator(".fnb-status-text")
        expect(sentence).to_contain_text((fix.text_content() or "").removeprefix("Fix: "))
        fix.click()
        expect(studio.page.locator(".fnb-suggestions")).to_be_hidden()
        status(studio, "Solved in")
        studio.expect_python("model.message", "")
    finally:
        studio.python("[setattr(tuning, 'REMEDIES', hurried[0]), setattr(tuning, 'REMEDY', hurried[1])]")


@pytest.mark.parametrize(("side", "dx", "dy"), [("width", 120, 0), ("height", 0, -60)])
def test_dragging_an_edge_resizes_the_canvas(studio: Notebook, side: str, dx: int, dy: int) -> None:
    page = studio.page
    edge = page.locator(f".fnb-edge-{side}")
    if side == "height":  # there must be room above for the pointer
        page.mouse.move(0, 0)
    before = studio.python(f"model.design.canvas.{side}")
    box = edge.bounding_box()
    assert box
    scale = page.evaluate(
        "() => { const s = document.querySelector('.fnb-sheet > svg');"
        " return s.getBoundingClientRect().width / s.viewBox.baseVal.width * s.dataset.scale }"
    )
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, 11):
        page.mouse.move(x + dx * step / 10, y + dy * step / 10)
    expect(edge.locator(".fnb-measure")).to_be_visible()
    grown = before + (dx - dy) / scale
    expected = round(grown / 0.05) * 0.05
    expect(edge).to_have_attribute("aria-valuenow", f"{expected:.3f}".rstrip("0").rstrip("."))
    page.mouse.up()
    expect(studio.field(f"Canvas {side} in metres")).to_have_value(f"{expected:.3f}".rstrip("0").rstrip("."))
    status(studio, "Solved in")
    assert studio.python(f"model.wait(60) and model.layout.canvas.{side}") == pytest.approx(expected)
    studio.button("Undo (Ctrl+Z)").click()
    expect(studio.field(f"Canvas {side} in metres")).to_have_value(f"{before:g}")


def test_arrow_keys_on_an_edge_resize_the_canvas(studio: Notebook) -> None:
    edge = studio.page.locator(".fnb-edge-width")
    edge.press("ArrowRight")
    expect(studio.field("Canvas width in metres")).to_have_value("6.1")
    edge.press("Shift+ArrowLeft")
    expect(studio.field("Canvas width in metres")).to_have_value("5.1")
    expect(edge).to_have_attribute("aria-valuetext", "5.1 metres")


def test_a_fault_stands_under_its_field_with_the_caret_at_its_place(studio: Notebook) -> None:
    studio.retype("Pattern Bx", "A(BA^k")
    row = studio.page.locator(".fnb-pattern[data-pattern=Bx]")
    expect(row.locator(".fnb-fault-text")).to_contain_text("not closed")
    expect(row.locator(".fnb-caret")).to_have_text(" ^")
    expect(studio.field("Pattern Bx")).to_have_attribute("aria-invalid", "true")
    # The caret stands under the bracket: both texts begin at one place and have one font.
    same = studio.page.evaluate(
        """() => {
            const row = document.querySelector('.fnb-pattern[data-pattern=Bx]');
            const [code, caret] = ['.fnb-code', '.fnb-caret'].map(q => row.querySelector(q));
            const left = e => e.getBoundingClientRect().left + e.clientLeft
                + parseFloat(getComputedStyle(e).paddingLeft);
            const font = e => [getComputedStyle(e).fontFamily, getComputedStyle(e).fontSize].join();
            return Math.abs(left(code) - left(caret)) < 1.5 && font(code) === font(caret);
        }"""
    )
    assert same
    studio.retype("Pattern Bx", "A(BA)^k;\nx := (A")
    expect(row.locator(".fnb-caret")).to_contain_text("x := (A\n     ^")
    status(studio, "At fault: Bx in patterns")


def test_a_design_without_a_layout_says_why_and_keeps_the_last_facade(studio: Notebook) -> None:
    field = studio.retype("Least value of counter k", "4")  # which has a layout, with more bays
    expect(studio.page.locator(".fnb-counter[data-counter=k] .fnb-solved")).to_have_text("5")
    shapes(studio, 25)
    field.press("0")
    expect(studio.page.locator(".fnb-status")).to_have_attribute("data-state", "none")
    expect(studio.page.locator(".fnb-elevation .fnb-tag")).to_be_visible()
    expect(studio.page.locator(".fnb-status-text")).to_have_text(studio.python("model.message"))
    shapes(studio, 25)
    studio.retype("Least value of counter k", "")
    expect(studio.page.locator(".fnb-elevation .fnb-tag")).to_be_hidden()
    status(studio, "Solved in")
    shapes(studio, 17)


def test_undo_and_redo_by_buttons_and_keys(studio: Notebook) -> None:
    undo, redo = studio.button("Undo (Ctrl+Z)"), studio.button("Redo (Ctrl+Shift+Z)")
    expect(undo).to_be_disabled()
    field = studio.field("Pattern Bx")
    retype(field, "A(BA)^2")
    studio.retype("Canvas width in metres", "8")
    expect(studio.page.locator(".fnb-elevation [data-layer=base]")).to_have_count(10)
    undo.click()
    expect(studio.field("Canvas width in metres")).to_have_value("6")
    field.press("Control+z")  # in the field: the text follows, though the field has the focus
    expect(field).to_have_value("A(BA)^k")
    shapes(studio, 17)
    expect(undo).to_be_disabled()
    field.press("Control+Shift+Z")
    expect(field).to_have_value("A(BA)^2")
    redo.click()
    expect(studio.field("Canvas width in metres")).to_have_value("8")
    expect(redo).to_be_disabled()


def test_a_click_on_a_shape_leads_to_its_symbols_and_layer(studio: Notebook) -> None:
    page = studio.page
    page.locator(".fnb-elevation [data-layer=door]").click()
    expect(page.locator(".fnb-layer[data-layer=door]")).to_have_attribute("data-picked", "")
    picked = page.locator(".fnb-symbol[data-picked]")
    expect(picked).to_have_count(2)
    assert picked.evaluate_all("rows => rows.map(row => row.dataset.symbol)") == ["P", "D"]
    expect(page.locator(".fnb-inspector")).to_contain_text("door")
    expect(page.locator(".fnb-pick")).to_have_count(1)
    page.keyboard.press("Escape")
    expect(page.locator("[data-picked]")).to_have_count(0)
    expect(page.locator(".fnb-inspector")).to_have_count(0)


def test_arrow_keys_go_from_shape_to_shape(studio: Notebook) -> None:
    page = studio.page
    page.locator(".fnb-elevation [data-layer=base][data-x=B][data-y=Q]").first.click()
    first = studio.python("model.selection.shape")
    page.locator(".fnb-paper").press("ArrowRight")
    expect(page.locator(".fnb-inspector")).to_contain_text("A×Q")
    assert studio.python("model.selection.shape") != first
    page.locator(".fnb-paper").press("Escape")
    expect(page.locator(".fnb-pick")).to_have_count(0)


def test_the_looks_of_a_picked_cell_can_be_changed(studio: Notebook) -> None:
    studio.page.locator(".fnb-elevation [data-layer=door]").click()
    studio.field("material of D P in door").click()
    studio.page.get_by_role("option", name="painted-blue", exact=True).click()
    expect(studio.page.locator(".fnb-elevation [data-layer=door] title")).to_contain_text("painted-blue")
    studio.expect_python("model.design.layers[2].shapes['D P'].material", "painted-blue")


def test_layers_are_reordered_hidden_and_masked_by_keyboard(studio: Notebook) -> None:
    page = studio.page

    def order() -> list[str]:
        rows: list[str] = page.locator(".fnb-layer").evaluate_all(
            "rows => rows.map(row => row.dataset.layer)"
        )
        return rows

    assert order() == ["roof", "door", "columns", "base"]
    grip = studio.button("Move layer door")
    grip.press("Alt+ArrowDown")
    expect(page.locator(".fnb-layer").nth(2)).to_have_attribute("data-layer", "door")
    expect(grip).to_be_focused()
    grip.press("Alt+ArrowDown")
    expect(page.locator(".fnb-layer").nth(3)).to_have_attribute("data-layer", "door")
    studio.button("Move layer door up").click()
    expect(page.locator(".fnb-layer").nth(2)).to_have_attribute("data-layer", "door")
    studio.expect_python("[layer.name for layer in model.design.stack]", order())

    studio.button("Hide layer roof").press("Enter")
    expect(page.locator(".fnb-elevation [data-layer=roof]")).to_have_count(0)
    studio.button("Show layer roof").press("Enter")
    expect(page.locator(".fnb-elevation [data-layer=roof]")).to_have_count(1)

    chip = page.get_by_role("group", name="The vertical mask of columns").get_by_role("button", name="Q")
    expect(chip).to_have_attribute("aria-pressed", "false")
    chip.press("Space")
    expect(chip).to_have_attribute("aria-pressed", "true")
    expect(page.locator(".fnb-elevation [data-layer=columns]")).to_have_count(4)
    assert studio.python("next(l.y.mask for l in model.design.layers if l.name == 'columns')") is None


def test_layers_are_reordered_by_dragging(studio: Notebook) -> None:
    page = studio.page
    grip = studio.button("Move layer roof")
    grip.scroll_into_view_if_needed()
    start, end = grip.bounding_box(), studio.button("Move layer columns").bounding_box()
    assert start
    assert end
    page.mouse.move(start["x"] + 8, start["y"] + 12)
    page.mouse.down()
    page.mouse.move(start["x"] + 8, start["y"] + 40, steps=4)
    page.mouse.move(end["x"] + 8, end["y"] + 50, steps=4)
    page.mouse.up()
    expect(page.locator(".fnb-layer").nth(2)).to_have_attribute("data-layer", "roof")


def test_patterns_and_groups_of_a_layer_are_chosen(studio: Notebook) -> None:
    studio.field("The horizontal pattern of columns").select_option("Bx")
    expect(studio.page.locator(".fnb-elevation [data-layer=columns][data-x=A]").first).to_be_attached()
    studio.field("The horizontal alignment group of columns").select_option("new group…")
    studio.page.keyboard.type("own")
    studio.page.keyboard.press("Enter")
    studio.expect_python("model.design.layers[1].x.group", "own")
    expect(studio.field("The horizontal alignment group of base").locator("option[value=own]")).to_have_count(
        1
    )


def test_symbols_have_sizes_bounds_and_qualifiers(studio: Notebook) -> None:
    studio.retype("Preferred size of B in metres", "0.6")
    expect(studio.page.locator(".fnb-counter[data-counter=k] .fnb-solved")).to_have_text("5")
    studio.retype("Greatest size of B in metres", "0.5")
    expect(studio.page.locator(".fnb-symbol[data-symbol=B] .fnb-solved")).to_have_text("0.5 −0.10")
    studio.button("B is attached").press("Enter")
    expect(studio.button("B is attached")).to_have_attribute("aria-pressed", "true")
    studio.expect_python("[model.design.symbols['B'].attached, model.design.symbols['B'].max]", [True, 0.5])
    studio.button("Placement of C: center").click()
    expect(studio.button("Placement of C: left")).to_be_visible()


def test_parts_of_a_design_are_added_renamed_and_removed(studio: Notebook) -> None:
    studio.button("Add a symbol").click()
    expect(studio.field("Preferred size of E in metres")).to_have_value("1")
    studio.button("Add a pattern").click()
    studio.retype("Pattern P1", "EA")
    name = studio.field("Name of pattern P1")
    retype(name, "Extra")
    name.press("Enter")
    expect(studio.field("Pattern Extra")).to_have_value("EA")
    studio.button("Add a layer").click()
    expect(studio.page.locator(".fnb-layer").first).to_have_attribute("data-layer", "layer 1")
    studio.button("Remove layer layer 1").click()
    expect(studio.page.locator(".fnb-layer")).to_have_count(4)


def test_save_and_open(studio: Notebook, tmp_path: Path) -> None:
    page = studio.page
    studio.retype("Pattern Bx", "A(BA)^2")
    shapes(studio, 14)
    with page.expect_download() as download:
        studio.button("Save the design as a JSON file").click()
    saved = tmp_path / "saved.json"
    download.value.save_as(saved)
    assert download.value.suggested_filename == "residential-house.json"
    assert json.loads(saved.read_text())["patterns"]["Bx"] == "A(BA)^2"

    studio.retype("Pattern Bx", "A(BA")
    faulty = tmp_path / "faulty.json"
    faulty.write_text(saved.read_text().replace('"width": 6.0', '"width": "<b>wide</b>"'))
    page.locator("input[type=file]").set_input_files(faulty)
    notice = page.locator(".fnb-notices .fnb-notice")
    expect(notice).to_contain_text("canvas.width")
    expect(notice).to_contain_text("<b>wide</b>")
    assert notice.locator("b").count() == 0
    assert studio.field("Pattern Bx").input_value() == "A(BA"  # nothing lost

    page.locator("input[type=file]").set_input_files(saved)
    expect(studio.field("Pattern Bx")).to_have_value("A(BA)^2")
    expect(notice).to_contain_text("Opened saved.json")


def test_the_gallery_opens_designs(studio: Notebook) -> None:
    studio.button("Open a design of the gallery").click()
    studio.page.locator(".fnb-popover:visible").get_by_label("Open apartment house").click()
    expect(studio.field("Name of the design")).not_to_have_value("Residential house")
    expect(studio.page.locator(".fnb-elevation [data-shape]").nth(30)).to_be_attached()
    studio.button("Undo (Ctrl+Z)").click()
    shapes(studio, 17)


def test_text_of_the_user_is_never_markup(studio: Notebook) -> None:
    name = studio.field("Name of layer door")
    retype(name, '<img src=x onerror="window.hurt=1">&')
    name.press("Enter")
    expect(studio.page.locator(".fnb-layer").nth(1)).to_have_attribute("data-layer", re.compile("<img"))
    studio.page.locator(".fnb-elevation [data-x=D]").click()
    expect(studio.page.locator(".fnb-inspector b")).to_contain_text("<img src=x")
    assert studio.page.evaluate("window.hurt") is None
    assert studio.page.locator(".fnb img[onerror]").count() == 0


def test_running_the_cell_again_leaks_no_context_and_no_thread(studio: Notebook) -> None:
    page = studio.page
    contexts = "() => globalThis[Symbol.for('facade_nb.pipeline.context')]?.made ?? 0"  # since the page began
    made = page.evaluate(contexts)
    threads = "__import__('threading').active_count()"
    before = studio.python(threads)
    for _ in range(10):
        studio.run()
        studio.button("3D").click()
        expect(page.locator(".fnb-building-canvas")).not_to_have_attribute("data-state", "empty")
    assert page.evaluate(contexts) == max(made, 1)
    assert studio.python(threads) <= before + 1
    assert [text for text in studio.take_problems() if "context" in text.lower()] == []


def test_the_state_survives_a_reload_of_the_page(studio: Notebook) -> None:
    field = studio.retype("Pattern Bx", "A(BA)^2")
    shapes(
        studio, 14
    )  # which of the texts between would be solved depends on the machine: from here there is one
    field.press("End")
    field.press_sequentially("(")
    expect(studio.page.locator(".fnb-fault-text:visible")).to_have_count(1)
    studio.page.evaluate("() => window.jupyterapp.commands.execute('docmanager:save')")
    studio.page.reload()
    studio.take_problems()
    expect(studio.field("Pattern Bx")).to_have_value("A(BA)^2(")
    expect(studio.page.locator(".fnb-fault-text:visible")).to_have_count(1)
    shapes(studio, 14)
    studio.retype("Pattern Bx", "A(BA)^3")
    shapes(studio, 17)


@pytest.mark.parametrize("width", [1400, 900])
@pytest.mark.parametrize("theme", ["JupyterLab Light", "JupyterLab Dark"])
def test_looks(studio: Notebook, out: Path, theme: str, width: int) -> None:
    """Screenshots for people, and what can be checked of them: the theme is followed and nothing sticks out."""
    page = studio.page
    try:
        studio.theme(theme)  # type: ignore[arg-type]
        studio.resize(width)
        dark = theme.endswith("Dark")
        expect(page.locator(".fnb")).to_have_attribute("data-theme", "dark" if dark else "light")
        paper = page.locator(".fnb-paper").evaluate("e => getComputedStyle(e).backgroundColor")
        level = sum(int(value) for value in re.findall(r"\d+", paper)[:3]) / 3
        assert (level < 100) == dark
        wide = page.locator(".fnb").evaluate(
            """root => [...root.querySelectorAll('button, input, select, textarea')].filter(e => e.checkVisibility())
                .filter(e => e.getBoundingClientRect().right > root.getBoundingClientRect().right + 1)
                .map(e => e.getAttribute('aria-label'))"""
        )
        assert wide == []
        frames(page)
        page.screenshot(path=out / f"{'dark' if dark else 'light'}-{width}.png")
    finally:
        studio.theme("JupyterLab Light")
