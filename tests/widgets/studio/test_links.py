"""A model's canvas, counters and sizes as traits: linked to widgets, and called by `interact`."""

from __future__ import annotations

import pytest
from ipywidgets import FloatSlider, IntSlider, interactive, link
from traitlets import TraitError

from facade_nb import gallery
from facade_nb.design import DesignError
from facade_nb.design.edit import with_counter
from facade_nb.widgets import FacadeModel


def house() -> FacadeModel:
    return FacadeModel(gallery.load("residential-house"))


def test_sliders_are_linked_to_the_canvas_both_ways() -> None:
    model = house()
    width, height = FloatSlider(min=4, max=40, step=0.1), FloatSlider(min=4, max=40, step=0.1)
    link((model, "width"), (width, "value"))
    link((height, "value"), (model, "height"))  # whichever stands first
    assert (width.value, model.height) == (6.0, 4.0)
    width.value = 7.2
    assert model.design.canvas.width == 7.2
    assert model.layout is not None and model.layout.canvas.width == 7.2
    model.enter(("canvas", "width"), "9")
    assert width.value == 9.0
    model.undo()
    assert (width.value, model.width) == (7.2, 7.2)


def test_a_slider_is_linked_to_a_counter() -> None:
    model = house()
    counter = model.counter("k")
    assert (counter.value, counter.fixed) == (3, None)  # free, and found by the solver
    slider = IntSlider(min=0, max=9)
    link((counter, "value"), (slider, "value"))
    assert slider.value == 3
    assert model.design.counter("k").value is None  # being looked at fixes nothing
    slider.value = 2
    assert model.design.counter("k").value == 2
    assert model.layout is not None and model.layout.counters["k"] == 2
    counter.free()
    assert (counter.value, counter.fixed, slider.value) == (3, None, 3)
    model.edit(with_counter(model.design, "k", min=1, max=4))
    assert (counter.min, counter.max) == (1, 4)
    assert model.counter("k") is counter


def test_a_slider_is_linked_to_a_size() -> None:
    model = house()
    size = model.size("A")
    slider = FloatSlider(min=0.1, max=4, step=0.05)
    link((size, "value"), (slider, "value"))
    before = size.solved["x"]
    slider.value = 0.8
    assert model.design.symbols["A"].size == 0.8
    assert size.solved["x"] != before
    model.undo()
    assert (slider.value, size.solved["x"]) == (0.5, before)


def test_all_sizes_and_counters_are_tables() -> None:
    model = house()
    assert model.counters == {"k": None}
    assert model.sizes["A"] == 0.5 and model.sizes["e"] is None
    heard = []
    model.observe(lambda change: heard.append(change["new"]["A"]), "sizes")
    model.sizes = {"A": 0.7}  # the others stay as they are
    assert model.design.symbols["A"].size == 0.7
    assert model.sizes["B"] == 1.2
    assert heard[-1] == 0.7
    model.counters = {"k": 2}
    assert model.layout is not None and model.layout.counters["k"] == 2
    model.undo()
    model.undo()
    assert (model.sizes["A"], model.counters) == (0.5, {"k": None})


def test_interact_calls_with_them() -> None:
    model = house()

    def show(width: float, k: int) -> int:
        model.width = width
        model.counter("k").value = k
        return len(model.layout.shapes) if model.layout else 0

    control = interactive(show, width=(4.0, 12.0), k=(1, 6))
    for slider, value in zip(control.children[:2], (8.4, 4), strict=True):
        slider.value = value
    assert (model.design.canvas.width, model.design.counter("k").value) == (8.4, 4)


def test_what_is_not_possible_is_refused_and_nothing_changes() -> None:
    model = house()
    before = model.design
    for name, value in (("width", -1.0), ("height", float("nan"))):
        with pytest.raises(DesignError):
            setattr(model, name, value)
    with pytest.raises(TraitError):
        model.width = "wide"
    with pytest.raises(DesignError, match="did you mean 'k'"):
        model.counters = {"K": 2}
    with pytest.raises(DesignError):
        model.sizes = {"A": -2}
    with pytest.raises(DesignError):
        model.counter("k").value = -3
    with pytest.raises(KeyError, match="found 'Q2'"):
        model.size("Q2")
    assert model.design == before
    assert (model.width, model.height) == (6.0, 4.5)
    assert model.sizes["A"] == 0.5 and model.counters == {"k": None}
    assert model.counter("k").value == 3
    assert not model.can_undo


def test_who_edits_as_a_value_changes_has_the_last_word() -> None:
    model = house()

    def widen(change: dict[str, float]) -> None:
        if change["new"] < 5:
            model.width = 5.0

    model.observe(widen, "width")
    model.width = 4.0
    assert (model.width, model.design.canvas.width) == (5.0, 5.0)
