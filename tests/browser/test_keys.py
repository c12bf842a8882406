"""Keys, pressed as a person presses them: in JupyterLab, Notebook 7 and Voilà."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import CDPSession, Locator, expect

from .jupyter import Notebook
from .waiting import until

WALL = "S -> Mat(Color, 0, 1, 0, 0, 1)"
SHOWN = f"""
from IPython.display import display
texture = TextureModel({WALL!r}, size=(12.34, 9.0), hour=9.1)
for each in (model, texture):
    each._history._pause = 1e9  # what is typed is one step, however busy the machine is
"""
PANEL = "window.jupyterapp.shell.currentWidget"
SLEEP = f"""seconds => {{ {PANEL}.sessionContext.session.kernel
    .requestExecute({{code: `import time; time.sleep(${{seconds}})`}}); }}"""

Show = Callable[[str], Notebook]
EDITORS = {
    "Pattern Bx": "(model.drafts.get(('patterns', 'Bx', 'text')) or model).value"
    " if model.drafts else model.design.patterns['Bx'].text",
    "Grammar": "texture.text",
}
"""The fields of several lines, and what Python has of each."""

FIELDS = [*EDITORS, "Canvas width in metres", "Name of pattern Bx"]


@pytest.fixture
def both(show: Show) -> Notebook:
    """The studio's parts with fields, and the grammar editor below them."""
    return show(
        SHOWN
        + "display(PatternEditor(model), CanvasEditor(model), LayerEditor(model), GrammarEditor(texture))"
    )


@pytest.fixture
def cdp(both: Notebook) -> Iterator[CDPSession]:
    """The browser's own line: what input methods and other keyboards do."""
    session = both.page.context.new_cdp_session(both.page)
    yield session
    session.detach()


def at_end(lab: Notebook, label: str) -> Locator:
    """The field of that name, with the caret at its end."""
    field = lab.field(label)
    field.click()
    lab.page.keyboard.press("Control+End")
    return field


def caret(field: Locator) -> int:
    """Where the caret is."""
    return int(field.evaluate("field => field.selectionEnd"))


def stroke(cdp: CDPSession, key: str, code: str, number: int, modifiers: int = 0) -> None:
    """A key of any keyboard; modifiers: 2 Ctrl, 8 Shift."""
    common: dict[str, Any] = {
        "key": key,
        "code": code,
        "windowsVirtualKeyCode": number,
        "modifiers": modifiers,
    }
    cdp.send("Input.dispatchKeyEvent", {"type": "rawKeyDown", **common})
    cdp.send("Input.dispatchKeyEvent", {"type": "keyUp", **common})


def compose(cdp: CDPSession, text: str) -> None:
    """What an input method shows while it composes."""
    cdp.send(
        "Input.imeSetComposition", {"text": text, "selectionStart": len(text), "selectionEnd": len(text)}
    )


@pytest.mark.parametrize("editor", EDITORS)
def test_enter_types_a_line(both: Notebook, editor: str) -> None:
    field = at_end(both, editor)
    text = field.input_value()
    for chord in ("Enter", "Shift+Enter", "Control+Enter"):
        both.page.keyboard.press(chord)
        both.page.keyboard.type("B")
        text += "\nB"
        expect(field).to_have_value(text)
    expect(field).to_be_focused()
    both.expect_python(EDITORS[editor], text)
    both.page.keyboard.press("ArrowUp")  # and in the middle
    both.page.keyboard.press("Control+Enter")
    expect(field).to_have_value(text[:-2] + "\n" + text[-2:])
    assert caret(field) == len(text) - 1


def test_enter_in_a_line_does_not_run_the_cell(both: Notebook) -> None:
    name = "Bx"
    for chord in ("Alt+Enter", "Control+Enter", "Shift+Enter"):
        field = at_end(both, f"Name of pattern {name}")
        both.page.keyboard.type("2")
        both.page.keyboard.press(chord)
        name += "2"
        expect(both.field(f"Pattern {name}")).to_be_visible()  # it is committed, in the same widget
        expect(both.page.locator(".jp-Notebook-cell")).to_have_count(1)
        expect(field).to_have_count(0)


def test_the_grammar_is_undone_and_redone(both: Notebook) -> None:
    field, keyboard = at_end(both, "Grammar"), both.page.keyboard
    undo, redo = both.button("Undo (Ctrl+Z)"), both.button("Redo (Ctrl+Shift+Z)")
    assert [each.get_attribute("title") for each in (undo, redo)] == ["Undo (Ctrl+Z)", "Redo (Ctrl+Shift+Z)"]
    expect(undo).to_be_disabled()
    keyboard.press("Enter")
    keyboard.type("Red -> Skip(0)")
    typed = f"{WALL}\nRed -> Skip(0)"
    both.expect_python("texture.text", typed)
    expect(redo).to_be_disabled()
    for back, forward in (("Control+z", "Control+Shift+z"), ("Control+Z", "Control+y")):
        keyboard.press(back)
        expect(field).to_have_value(WALL)
        both.expect_python("[texture.text, texture.grammar.text, len(texture.faults)]", [WALL, WALL, 0])
        keyboard.press(forward)
        expect(field).to_have_value(typed)
        both.expect_python("texture.text", typed)
    undo.click()
    expect(field).to_have_value(WALL)
    expect(undo).to_be_disabled()
    redo.click()
    expect(field).to_have_value(typed)
    expect(redo).to_be_disabled()


KEYBOARDS = {
    "Russian": ("я", "KeyZ", 90, True),
    "Greek": ("ζ", "KeyZ", 90, True),
    "Hebrew": ("ז", "KeyZ", 90, True),
    "German": ("z", "KeyY", 90, True),
    "French": ("z", "KeyW", 90, True),
    "Russian with the capitals' lock": ("Я", "KeyZ", 90, True),
    "French, at the place of Z": ("w", "KeyZ", 87, False),
    "Dvorak, at the place of Z": (";", "KeyZ", 186, False),
}


@pytest.mark.parametrize("editor", EDITORS)
def test_undo_by_letter_or_place(both: Notebook, cdp: CDPSession, editor: str) -> None:
    field = at_end(both, editor)
    before = field.input_value()
    typed = f"{before}\n"
    both.page.keyboard.press("Enter")
    both.expect_python(EDITORS[editor], typed)
    for name, (key, code, number, undoes) in KEYBOARDS.items():
        stroke(cdp, key, code, number, 2)
        # Keys are answered in order: what this letter makes comes after what an undo would have made.
        both.expect_python(EDITORS[editor], before if undoes else typed)
        if undoes:
            expect(field, name).to_have_value(before)
            stroke(cdp, key, code, number, 2 | 8)
            both.expect_python(EDITORS[editor], typed)
        expect(field, name).to_have_value(typed)


def test_a_name_that_is_being_typed_has_an_undo_of_its_own(both: Notebook) -> None:
    width = both.field("Canvas width in metres")
    width.click(click_count=3)
    both.page.keyboard.type("7")
    both.expect_python("model.design.canvas.width", 7)
    name = at_end(both, "Name of pattern Bx")
    both.page.keyboard.type("xyz")
    while (text := name.input_value()) != "Bx":  # the browser joins letters to steps as it likes
        both.page.keyboard.press("Control+z")
        expect(name).not_to_have_value(text)
        assert both.python("model.design.canvas.width") == 7
    both.page.keyboard.press("Control+z")  # nothing is left of it: now the design's
    both.expect_python("model.design.canvas.width == 7", False)


def save(lab: Notebook) -> bool:
    """Press what saves; whether all is saved. The host drops it while it is still at the end of saving before."""
    lab.page.keyboard.press("Control+s")
    return bool(lab.page.evaluate(f"() => !{PANEL}.context.model.dirty"))


def test_the_hosts_keys_reach_it_and_no_others(both: Notebook) -> None:
    page, keyboard = both.page, both.page.keyboard
    side = page.locator("#jp-left-stack")
    for label in (*FIELDS, "Add a pattern", "Move layer door"):
        place = both.field(label)
        page.evaluate(f"() => {{ {PANEL}.context.model.dirty = true; }}")
        place.focus()
        for shown in (True, False):
            keyboard.press("Control+b")
            expect(side).to_be_visible(visible=shown)
        until(page, lambda: save(both))
        expect(place).to_be_focused()
        for key in ("Control+a", "d", "d", "x", "a", "b", "m", "Control+c", "Control+ArrowLeft"):
            keyboard.press(key)
        expect(page.locator(".jp-Notebook-cell")).to_have_count(1)
        assert page.evaluate(f"() => {PANEL}.content.activeCell.model.type") == "code"
        if label in FIELDS:
            expect(place).to_have_value("ddxabm")


def test_escape_leaves_a_field_for_the_notebook(both: Notebook) -> None:
    for label in FIELDS:
        field = at_end(both, label)
        both.page.keyboard.press("Escape")
        expect(field).not_to_be_focused()
        assert both.page.evaluate("() => !!document.activeElement.closest('.jp-Notebook')")
        both.page.keyboard.press("b")  # a command on cells: one is added below
        expect(both.page.locator(".jp-Notebook-cell")).to_have_count(2)
        both.page.keyboard.press("z")
        expect(both.page.locator(".jp-Notebook-cell")).to_have_count(1)


def test_enter_that_ends_a_composition_commits_no_name(both: Notebook, cdp: CDPSession) -> None:
    name = at_end(both, "Name of pattern Bx")
    compose(cdp, "まど")
    stroke(cdp, "Enter", "Enter", 229)
    cdp.send("Input.insertText", {"text": "窓"})
    expect(name).to_be_focused()
    expect(name).to_have_value("Bx窓")
    assert "Bx" in both.python("list(model.design.patterns)")
    both.page.keyboard.press("Enter")
    expect(both.field("Pattern Bx窓")).to_be_visible()


OTHERS = {
    "Pattern Bx": "model.enter(('patterns', 'Bx', 'text'), 'A(BA)^1')",
    "Grammar": "texture.enter('S -> Mat(Color, 0, 0, 1, 0, 1)')",
}


@pytest.mark.parametrize("editor", EDITORS)
def test_half_a_word_is_neither_solved_nor_destroyed(both: Notebook, cdp: CDPSession, editor: str) -> None:
    field, python = at_end(both, editor), EDITORS[editor]
    before = field.input_value()
    for text in ("k", "か", "かn"):
        compose(cdp, text)
        expect(field).to_have_value(before + text)
        assert both.python(python) == before
    both.python(f"[{OTHERS[editor]}, model.enter(('canvas', 'width'), 7.5)]")  # another view, meanwhile
    expect(both.field("Canvas width in metres")).to_have_value("7.5")
    expect(both.button("Undo (Ctrl+Z)")).to_be_enabled(enabled=editor == "Grammar")
    expect(field).to_have_value(f"{before}かn")
    compose(cdp, "かん")
    cdp.send("Input.insertText", {"text": "間"})
    expect(field).to_have_value(f"{before}間")
    both.expect_python(python, f"{before}間")


STEPPED = [
    ("0.65", "ArrowUp", "0.75"),
    ("1.25", "ArrowDown", "1.15"),
    ("0.05", "ArrowDown", "0.05"),
    ("0.05", "ArrowUp", "0.15"),
    ("0.15", "ArrowDown", "0.1"),
    ("0.1", "ArrowDown", "0.1"),
    ("0.2", "ArrowUp", "0.3"),
    ("2,35", "Shift+ArrowUp", "3.35"),
    ("2.345", "PageDown", "1.345"),
]


def test_arrow_keys_step_from_what_stands_there(both: Notebook) -> None:
    field = both.field("Canvas width in metres")
    found = []
    for typed, key, _ in STEPPED:
        field.click(click_count=3)
        both.page.keyboard.type(typed)
        both.page.keyboard.press(key)
        found.append((typed, key, field.input_value()))
    assert found == STEPPED
    both.expect_python("model.design.canvas.width", 1.345)


def test_sliders_step_from_where_they_are(show: Show) -> None:
    lab = show(SHOWN + "TextureView(texture, layout={'width': '300px'})")
    steps = [
        ("Width", "ArrowRight", "texture.size[0]", 12.44),
        ("Width", "ArrowDown", "texture.size[0]", 12.34),
        ("Hour", "ArrowLeft", "texture.hour", 8.85),
        ("Seed", "PageUp", "texture.seed[0]", 10.0),
    ]
    for label, key, expression, value in steps:
        lab.field(label).focus()
        lab.page.keyboard.press(key)
        lab.expect_python(expression, value)
    for expression, value in (("texture.seed[0]", 0), ("texture.hour", 9.1)):  # each is a step of the history
        lab.page.keyboard.press("Control+z")
        lab.expect_python(expression, value)


SENTENCE = "Wall -> Mat(Color, Rep:brick, 0, 0, 0.5, 0.5) # sixty signs!"


@pytest.mark.parametrize("seconds", [0, 0.3])
def test_fast_typing_in_the_middle_loses_no_letter(both: Notebook, seconds: float) -> None:
    both.python(f"texture.enter({WALL!r} + chr(10) * 2 + '# end')")
    if seconds:
        both.python(
            "[globals().update(enter=texture.enter, time=__import__('time')), setattr(texture, 'enter', "
            f"lambda text: (time.sleep({seconds}), enter(text)))][0]"
        )
    field, keyboard = both.field("Grammar"), both.page.keyboard
    field.click()
    keyboard.press("Control+Home")
    keyboard.press("ArrowDown")
    keyboard.type(SENTENCE)
    text, place = f"{WALL}\n{SENTENCE}\n# end", len(WALL) + 1 + len(SENTENCE)
    assert (field.input_value(), caret(field)) == (text, place)
    both.expect_python("texture.text", text)
    assert (field.input_value(), caret(field)) == (text, place)


def test_undo_brings_the_caret_to_its_place(both: Notebook) -> None:
    lines = "\n".join([WALL, *(f"# {n}" for n in range(60))])
    red = lines.replace(WALL, f"{WALL} # red")
    both.python(f"[texture.enter({lines!r}), setattr(texture, 'lit', False)]")
    field, keyboard = both.field("Grammar"), both.page.keyboard
    expect(field).to_have_value(lines)
    field.click()
    keyboard.press("Control+Home")
    keyboard.press("End")
    keyboard.type(" # red")
    both.expect_python("texture.text", red)
    keyboard.press("Control+End")
    assert field.evaluate("field => field.scrollTop") > 500
    keyboard.press("Control+z")
    expect(field).to_have_value(lines)
    assert (caret(field), field.evaluate("field => field.scrollTop")) == (len(WALL), 0)
    keyboard.press("Control+y")
    expect(field).to_have_value(red)
    assert caret(field) == len(f"{WALL} # red")


@pytest.mark.parametrize("editor", EDITORS)
def test_letters_typed_after_undo_stay_when_the_kernel_is_slow(both: Notebook, editor: str) -> None:
    field = at_end(both, editor)
    before = field.input_value()
    both.page.evaluate(SLEEP, 1)
    for key in ("B", "Control+z", "A"):
        both.page.keyboard.press(key)
    expect(field).to_have_value(f"{before}BA")
    both.expect_python(EDITORS[editor], f"{before}BA")
    expect(field).to_have_value(f"{before}BA")


@pytest.mark.parametrize("theme", ["Light", "Dark"])
def test_looks(both: Notebook, out: Path, theme: str) -> None:
    at_end(both, "Grammar")
    both.page.keyboard.press("Enter")
    both.page.keyboard.type("T -> Skp(0)")
    expect(both.page.locator(".fnb-tex-fault")).to_be_visible()
    both.theme(f"JupyterLab {theme}")  # type: ignore[arg-type]
    editor = both.page.locator(".fnb-texture-editor")
    editor.scroll_into_view_if_needed()
    editor.screenshot(path=out / f"grammar-{theme.lower()}.png")
    both.theme("JupyterLab Light")
