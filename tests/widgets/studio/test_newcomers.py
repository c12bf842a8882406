"""Symbols and counters come by themselves as they are typed, and go again."""

from __future__ import annotations

import pytest

from facade_nb import Design
from facade_nb.design.edit import with_pattern, with_shape
from facade_nb.widgets import FacadeModel

from ..houses import house

BX, BY, CX = (("patterns", name, "text") for name in ("Bx", "By", "Cx"))


def blank() -> FacadeModel:
    """An empty canvas with one empty pattern."""
    return FacadeModel(with_pattern(Design(), "P1", "ε"))


def keys(model: FacadeModel, text: str, path: tuple[str, ...] = ("patterns", "P1", "text")) -> None:
    """Type a text letter by letter."""
    for end in range(1, len(text) + 1):
        model.enter(path, text[:end])


def test_symbols_come_with_a_size_and_letters_on_the_way_go_again() -> None:
    model = blank()
    keys(model, "A2(BA2)^k")
    assert {name: symbol.size for name, symbol in model.design.symbols.items()} == {"A2": 1.0, "B": 1.0}
    assert set(model.newcomers.symbols) == {"A2", "B"}
    assert model.newcomers.counters == {"k"}
    assert model.drafts == {}
    model.enter(("patterns", "P1", "text"), "B")
    assert set(model.design.symbols) == {"B"} and model.newcomers.counters == frozenset()


def test_typing_and_what_came_with_it_are_one_step() -> None:
    model = blank()
    before = model.design
    keys(model, "ABC")
    model.undo()
    assert (model.design, model.newcomers.symbols) == (before, {})
    model.redo()
    assert set(model.design.symbols) == set(model.newcomers.symbols) == {"A", "B", "C"}


def test_the_size_is_the_median_on_the_axis_in_centimetres() -> None:
    model = FacadeModel(house())
    model.enter(BX, "A(BA)^kZ")
    assert model.design.symbols["Z"].size == 0.8  # of 1, 0.8 and 0.3
    model.enter(BY, "PQW")
    assert model.design.symbols["W"].size == 1.5
    assert model.drafts == {} and not model.stale


def test_a_touched_symbol_stays() -> None:
    model = blank()
    keys(model, "AB")
    model.enter(("symbols", "A", "size"), "1")  # the size that it had: touched all the same
    model.enter(("symbols", "B", "opaque"), False)
    assert model.newcomers.symbols == {}
    model.enter(("patterns", "P1", "text"), "")
    assert set(model.design.symbols) == {"A", "B"}
    assert model.design.patterns["P1"].text == "ε" and model.drafts == {}


def test_a_letter_that_becomes_a_placeholder_is_unsized_again() -> None:
    model = blank()
    keys(model, "ece; c := C")
    assert set(model.design.symbols) == {"C"}
    assert model.design.symbol("e").size is None
    house_model = FacadeModel(house())
    house_model.enter(("symbols", "e", "attached"), True)
    house_model.enter(CX, "cec")
    assert house_model.design.symbols["e"].size is not None
    house_model.enter(CX, "cec; c := C")
    assert house_model.design.symbols["e"].size is None and house_model.design.symbols["e"].attached


def test_masks_and_hidden_symbols_come_back_with_their_letters() -> None:
    start = with_pattern(house(), "By", hidden=["Q"])
    model = FacadeModel(start)
    model.enter(BY, "Q")
    assert model.drafts == {} and model.design.layers[1].y.mask is None
    model.enter(BY, "")
    assert model.design.patterns["By"].hidden == ()
    keys(model, "PQ", BY)
    assert model.design == start
    model.enter(BY, "Q")
    model.enter(("layers", "columns", "y", "mask"), ["Q"])
    model.enter(BY, "PQ")
    assert model.design.layers[1].y.mask == ("Q",)


@pytest.mark.parametrize("key", ["* e", "e[2] *", "C P"])
def test_text_is_never_at_fault_for_what_shapes_name(key: str) -> None:
    model = FacadeModel(with_shape(house(), key, material="glass"))
    model.enter(CX, "A")
    assert model.drafts == {}
    model.enter(CX, "cec; c := C")
    assert model.drafts == {} and model.design.symbol("e").size is None


def test_what_is_named_by_a_removed_pattern_alone_goes_with_it() -> None:
    model = blank()
    keys(model, "AB")
    document = model.design.to_dict()
    del document["patterns"]["P1"]
    model.edit(Design.from_dict(document))
    assert model.design.symbols == {} and model.newcomers.symbols == {}


def test_a_fault_leaves_all_as_it_is() -> None:
    model = blank()
    keys(model, "A(")
    assert set(model.drafts) == {("patterns", "P1", "text")}
    assert set(model.design.symbols) == {"A"}
    keys(model, "A(B)")
    assert model.drafts == {} and set(model.design.symbols) == {"A", "B"}
