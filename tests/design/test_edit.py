"""Edits make new, valid designs."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from facade_nb.design import Canvas, Counter, Design, DesignError, LayerAxis, Shape, edit
from facade_nb.design.document import read

from .test_document import HOUSE


@pytest.fixture
def design() -> Design:
    return read(HOUSE)


def test_canvas(design: Design) -> None:
    assert edit.with_canvas(design, width=8).canvas == Canvas(8, 3)
    assert edit.with_canvas(design, height=4).canvas == Canvas(6, 4)
    assert design.canvas == Canvas(6, 3)


def test_symbols(design: Design) -> None:
    assert edit.with_symbol(design, "A", size=2, attached=True).symbols["A"].attached
    assert edit.with_symbol(design, "new", size=2).symbols["new"].size == 2
    assert edit.with_symbol(design, "e", size=None) == design


def test_counters(design: Design) -> None:
    assert edit.with_counter(design, "k", value=3).counters["k"] == Counter("k", value=3)
    assert edit.with_counter(edit.with_counter(design, "k", value=3), "k", value=None) == design


def test_patterns(design: Design) -> None:
    assert edit.with_pattern(design, "Bx", "(AB)^k").patterns["Bx"].text == "(AB)^k"
    assert edit.with_pattern(design, "Dx", "AA").patterns["Dx"].text == "AA"
    hidden = edit.with_pattern(design, "Cx", hidden=["C"])
    assert (hidden.patterns["Cx"].text, hidden.patterns["Cx"].hidden) == ("cec; c := C", ("C",))
    renamed = edit.rename_pattern(design, "By", "Vy")
    assert list(renamed.patterns) == ["Bx", "Vy", "Cx"]
    assert [layer.y.pattern for layer in renamed.layers] == ["Vy", "Vy"]


def test_layers(design: Design) -> None:
    changed = edit.with_layer(
        design, "columns", x={"mask": ["C"]}, y={"mask": None}, depth=4, name="pillars"
    ).layers[1]
    assert (changed.name, changed.x, changed.y, changed.depth) == (
        "pillars",
        LayerAxis("Cx", mask=("C",)),
        LayerAxis("By"),
        4,
    )
    assert edit.with_layer(design, "columns", x="Bx").layers[1].x.pattern == "Bx"
    more = edit.add_layer(design, "top", "Bx", {"pattern": "By", "group": "left"}, visible=False)
    assert [layer.name for layer in more.layers] == ["base", "columns", "top"]
    assert (more.layers[2].y.group, more.layers[2].visible) == ("left", False)
    for index, order in (
        (0, "top base columns"),
        (1, "base top columns"),
        (-1, "base columns top"),
        (-2, "base top columns"),
    ):
        assert [layer.name for layer in edit.move_layer(more, "top", index).layers] == order.split()
    assert edit.remove_layer(more, "top") == design
    assert [layer.name for layer in edit.add_layer(design, "low", "Bx", "By", 0).layers] == [
        "low",
        "base",
        "columns",
    ]


def test_shapes(design: Design) -> None:
    assert edit.with_shape(design, "B Q", material=None, kind="window").shapes["B Q"] == Shape(
        "window", "box", None, -0.05, 0.1
    )
    assert edit.with_shape(design, "C *", pattern="Cx", kind="column").patterns["Cx"].shapes == {
        "C *": Shape("column")
    }
    gone = edit.with_shape(design, "C P", layer="columns", geometry=None, material=None)
    assert gone.layers[1].shapes == {}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: edit.with_canvas(d, width=-1), "canvas.width: expected a number greater than 0; found -1"),
        (
            lambda d: edit.with_symbol(d, "A", sise=1),
            "symbols.A.sise: unknown field 'sise'; did you mean 'size'?",
        ),
        (
            lambda d: edit.with_symbol(d, "A", size="big"),
            "symbols.A.size: expected a number greater than 0; found 'big'",
        ),
        (
            lambda d: edit.with_symbol(d, "A", size=None),
            "patterns.Bx, line 1, column 1: symbol 'A' has no size",
        ),
        (lambda d: edit.with_counter(d, "k", min=2, max=1), "counters.k.min: expected at most max"),
        (lambda d: edit.with_pattern(d, "Bx", "A("), "patterns.Bx, line 1, column 3: expected a symbol"),
        (lambda d: edit.with_pattern(d, "New", hidden=["A"]), "patterns.New.text: this field is missing"),
        (lambda d: edit.rename_pattern(d, "Vy", "By"), "found 'Vy'; did you mean 'By'?"),
        (lambda d: edit.rename_pattern(d, "By", "Bx"), "expected a new name for pattern 'By'; 'Bx' is taken"),
        (lambda d: edit.with_layer(d, "bas", depth=1), "found 'bas'; did you mean 'base'?"),
        (
            lambda d: edit.with_layer(d, "base", x="Dx"),
            r"layers\[0\].x.pattern: expected the name of a pattern",
        ),
        (lambda d: edit.with_layer(d, "base", name="columns"), "expected a name of its own"),
        (lambda d: edit.add_layer(d, "base", "Bx", "By"), r"layers\[2\].name: expected a name of its own"),
        (
            lambda d: edit.remove_layer(d, "roof"),
            r"expected the name of a layer \('base', 'columns'\); found 'roof'",
        ),
        (lambda d: edit.with_shape(d, "B", kind="x"), "expected two symbols with a blank between them"),
        (lambda d: edit.with_shape(d, "B Q", pattern="Zx", kind="x"), "expected the name of a pattern"),
    ],
)
def test_a_faulty_edit_is_refused_with_its_place(
    design: Design, change: Callable[[Design], Design], message: str
) -> None:
    with pytest.raises(DesignError, match=message):
        change(design)
    assert design == read(HOUSE)
