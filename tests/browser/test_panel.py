"""The Studio's panel, by mouse and keys alone."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Locator, expect

from .jupyter import Notebook
from .keys import retype

Show = Callable[[str], Notebook]

BLANK = "model = FacadeModel(time_limit=600.0)\nStudio(model)"


def drag(field: Locator, dx: int) -> None:
    """Drag on a number."""
    field.scroll_into_view_if_needed()
    box = field.bounding_box()
    assert box
    mouse = field.page.mouse
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + dx / 2, y)
    mouse.move(x + dx, y)
    mouse.up()


def test_from_an_empty_canvas_to_a_facade(show: Show) -> None:
    studio = show(BLANK)
    page, keys = studio.page, studio.page.keyboard
    studio.button("Add a layer").click()
    expect(page.locator(".fnb-layer .fnb-fresh")).to_have_text("no shapes yet")
    studio.field("Pattern P1").click()
    keys.type("A2(B A2)^k")
    studio.field("Pattern P2").click()
    keys.type("QQ")
    names = "rows => rows.map(row => row.dataset.symbol)"
    studio.expect_python("list(model.design.symbols)", ["A2", "B", "Q"])
    rows = page.locator(".fnb-symbol[data-symbol]")
    expect(rows).to_have_count(3)
    assert rows.evaluate_all(names) == ["A2", "B", "Q"]
    expect(page.locator(".fnb-symbol .fnb-fresh:visible")).to_have_count(3)
    expect(page.locator(".fnb-fault:visible")).to_have_count(0)
    size = studio.retype("Preferred size of Q in metres", "1.5")
    expect(page.locator(".fnb-symbol .fnb-fresh:visible")).to_have_count(2)
    expect(size).to_be_focused()
    expect(page.locator(".fnb-elevation [data-shape]")).to_have_count(0)
    studio.button("Pair B Q of layer 1").click()
    studio.field("material of B Q in layer 1").click()
    page.get_by_role("option", name="brick", exact=True).click()
    expect(page.locator(".fnb-elevation [data-shape][data-x=B]").first).to_be_attached()
    expect(page.locator(".fnb-elevation [data-x=A2]")).to_have_count(0)
    expect(page.locator(".fnb-layer .fnb-fresh:visible")).to_have_count(0)
    studio.button("Pair A2 Q of layer 1").click()
    studio.button("Pair B Q of layer 1").click(modifiers=["Shift"])
    expect(page.locator(".fnb-inspector b + span")).to_have_text("2 pairs")
    studio.field("material of the picked pairs in layer 1").click()
    page.get_by_role("option", name="stone", exact=True).click()
    studio.expect_python("{s.material for s in model.layout.shapes} == {'stone'}", True)
    studio.expect_python("{s.x for s in model.layout.shapes} == {'A2', 'B'}", True)


def test_the_focus_stays_whatever_is_added_renamed_removed_and_undone(show: Show) -> None:
    studio = show("Studio(model)")
    page, keys = studio.page, studio.page.keyboard

    def stays() -> None:
        """The focus is in the studio, and what is typed there reaches no cell."""
        studio.settle()
        assert page.evaluate("() => !!document.activeElement.closest('.fnb-part-studio')")
        assert page.evaluate("() => document.activeElement.matches(':disabled, [hidden]')") is False
        expect(page.locator(".jp-Notebook-cell")).to_have_count(1)

    studio.button("Add a pattern").click()
    text = studio.field("Pattern P1")
    expect(text).to_be_focused()
    expect(text).to_have_value("")
    keys.type("dd")
    expect(text).to_have_value("dd")
    studio.expect_python("model.design.patterns['P1'].text", "dd")
    stays()
    name = studio.field("Name of pattern P1")
    retype(name, "roofline")
    keys.press("Enter")
    expect(studio.field("Pattern roofline")).to_be_focused()
    stays()
    name = studio.field("Name of layer door")
    retype(name, "portal")
    keys.press("Enter")
    expect(studio.field("Name of layer portal")).to_be_focused()
    stays()
    for remove in ("Remove pattern roofline", "Remove layer portal", "Remove layer roof"):
        studio.button(remove).click()
        stays()
        keys.press("Escape") if page.evaluate("() => document.activeElement.matches('textarea')") else None
    undo = studio.button("Undo (Ctrl+Z)")
    while studio.python("model.can_undo"):
        undo.click()
        stays()
    for key in "dd":
        keys.press(key)
    stays()
    redo = studio.button("Redo (Ctrl+Shift+Z)")
    while studio.python("model.can_redo"):
        redo.focus()
        keys.press("Enter")
        stays()
    keys.press("d")
    keys.press("d")
    stays()


def test_names_are_edited_in_place(show: Show) -> None:
    studio = show("Studio(model)")
    page, keys = studio.page, studio.page.keyboard
    studio.button("Pick symbol B").dblclick()
    expect(studio.field("Name of symbol B")).to_be_focused()
    keys.press("ControlOrMeta+a")
    keys.type("bay")
    keys.press("Enter")
    expect(studio.button("Pick symbol bay")).to_be_focused()
    expect(studio.field("Pattern Bx")).to_have_value("A(<bay>A)^k")
    studio.button("Counter k").press("F2")
    keys.press("ControlOrMeta+a")
    keys.type("n")
    keys.press("Enter")
    expect(studio.field("Pattern Bx")).to_have_value("A(<bay>A)^n")
    group = studio.field("The horizontal alignment group of base")
    group.press("F2")
    keys.type("front")
    keys.press("Enter")
    studio.expect_python("{l.y.group for l in model.design.layers} == {'front'}", True)
    for _ in range(3):
        keys.press("ControlOrMeta+z")
    expect(studio.field("Pattern Bx")).to_have_value("A(BA)^k")
    studio.button("Pick symbol A").press("F2")
    keys.type("zz")
    keys.press("Escape")
    expect(studio.button("Pick symbol A")).to_be_focused()
    keys.press("F2")
    keys.press("ControlOrMeta+a")
    keys.type("B")
    keys.press("Enter")
    expect(page.locator(".fnb-notices > .fnb-notice")).to_contain_text("'B' is taken")


def test_one_instance_has_a_look_of_its_own_and_tells_where_each_value_comes_from(show: Show) -> None:
    studio = show("Studio(model)")
    page = studio.page
    page.locator(".fnb-elevation [data-layer=base][data-x=B][data-y=Q]").nth(1).click()
    look = page.locator(".fnb-look[data-look=material]")
    before = look.locator(".fnb-origin").text_content()
    studio.field("Which shapes are edited").select_option("B[2] Q[1]")
    studio.field("material of B Q in base").click()
    page.get_by_role("option", name="brick", exact=True).click()
    expect(look.locator(".fnb-origin")).to_have_text("B[2] Q[1] in base")
    studio.expect_python(
        "[s.number for s in model.layout.shapes if (s.x, s.material) == ('B', 'brick')]", [[2, 1]]
    )
    studio.retype("Canvas width in metres", "8")
    studio.expect_python("model.layout.shapes[model.selection.shape].number", [2, 1])
    studio.button("Reset material of B Q").click()
    expect(look.locator(".fnb-origin")).to_have_text(before or "")
    studio.field("Which shapes are edited").select_option("B *")
    studio.field("Whose shapes are edited").select_option("the design")
    studio.button("B Q of base is visible").click()
    studio.expect_python("model.design.shapes['B *'].visible", False)
    studio.field("Which shapes are edited").select_option("B Q")
    page.get_by_role("button", name="Add a variant").click()
    page.get_by_role("button", name="Add a variant").click()
    studio.retype("weight of variant 2 of B Q", "3")
    page.keyboard.press("Enter")
    studio.expect_python("[v.weight for v in model.design.shapes['B Q'].variants]", [1, 3])


def test_symbols_counters_and_layers(show: Show) -> None:
    studio = show("Studio(model)")
    page = studio.page
    size = studio.field("Preferred size of B in metres")
    value = float(size.input_value())
    drag(size, -40)
    expect(size).to_have_value(f"{value - 0.2:g}")
    studio.expect_python("round(model.design.symbols['B'].size, 2)", round(value - 0.2, 2))
    studio.button("Undo (Ctrl+Z)").click()
    expect(size).to_have_value(f"{value:g}")
    studio.retype("Pattern Bx", "A^k")
    expect(page.locator(".fnb-symbol[data-symbol=B] .fnb-unused")).to_be_visible()
    page.get_by_role("button", name="Remove the unused symbol").click()
    expect(page.locator(".fnb-symbol[data-symbol=B]")).to_have_count(0)
    while studio.field("Pattern Bx").input_value() != "A(BA)^k":  # typed slowly, it is several steps
        studio.button("Undo (Ctrl+Z)").click()
        studio.settle()
    expect(page.locator(".fnb-counter[data-counter=k] .fnb-solved")).to_have_text("3")
    studio.button("Fix counter k at 3").click()
    studio.expect_python("model.design.counters['k'].value", 3)
    studio.button("Let counter k go free").click()
    studio.expect_python("model.design.counter('k').value", None)
    only = studio.field("Only this symbol of the horizontal pattern of base")
    only.select_option("only B")
    studio.expect_python("model.design.layers[0].x.mask", ["B"])
    only.select_option("all of them")
    studio.expect_python("model.design.layers[0].x.mask", None)
    studio.button("Duplicate layer columns").click()
    expect(studio.field("The horizontal pattern of columns copy")).to_be_focused()
    studio.button("Show layer base alone, or all again").click()
    studio.expect_python("[l.name for l in model.design.layers if l.visible]", ["base"])
    studio.button("Show layer base alone, or all again").click()
    studio.expect_python("all(l.visible for l in model.design.layers)", True)


@pytest.mark.parametrize("theme", ["Light", "Dark"])
def test_looks(show: Show, out: Path, theme: str) -> None:
    studio = show(
        'model = FacadeModel(gallery.load("concert-hall"), time_limit=600.0)\nStudio(model, height=860)'
    )
    studio.theme(f"JupyterLab {theme}")  # type: ignore[arg-type]
    page = studio.page
    page.locator(".fnb-elevation [data-shape]").nth(40).click()
    expect(page.locator(".fnb-inspector")).to_be_visible()
    for width in (1600, 1200, 900):
        studio.resize(width)
        page.screenshot(path=out / f"panel-{theme.lower()}-{width}.png")
        wide = page.locator(".fnb-panel").evaluate("el => el.scrollWidth - el.clientWidth")
        assert wide <= 0, f"the panel is {wide} px too narrow for what it has"
    studio.theme("JupyterLab Light")
