"""Lessons in the views, and views whose design has been changed."""

from __future__ import annotations

import pytest

from facade_nb import DesignError, gallery, solve
from facade_nb.design.edit import with_canvas
from facade_nb.widgets import FacadeModel, WordsView
from facade_nb.widgets.solver.captions import captions
from facade_nb.widgets.solver.model import TraceModel

from .test_views import unpack as unpacked


def test_a_lesson_takes_the_place_of_the_source_and_gives_it_back() -> None:
    trace = solve(gallery.load("figure-8"), trace=True).trace
    view = WordsView(trace)
    view.model.moment = "x/words+2"
    view.channel.lesson = "deepening"  # as the page does
    assert view.model.lesson == "deepening" and view.model.name == "Six passes of deepening"
    assert view.model.moment == gallery.lesson_note("deepening").moment
    assert view.channel.about == gallery.lesson_note("deepening").look
    assert unpacked(view.channel.timeline)["search"] == "ida"
    view.model.lesson = "table"
    assert unpacked(view.channel.timeline)["search"] == "best"
    view.model.lesson = ""
    assert view.model.trace is trace and view.model.moment == "x/words+2"
    assert view.channel.about == "" and view.channel.lesson == ""
    with pytest.raises(DesignError, match="did you mean 'table'"):
        view.model.lesson = "tabel"
    assert [name for name, _ in view.channel.lessons] == gallery.lessons()


def test_a_model_goes_on_while_a_lesson_is_looked_at() -> None:
    model = FacadeModel(gallery.load("figure-8"))
    own = TraceModel.of(model)
    own.lesson = "weights"
    shown = own.trace
    model.edit(lambda design: with_canvas(design, width=12.5))
    assert own.trace is shown
    own.lesson = ""
    assert own.trace is model.trace


def test_a_view_says_what_it_shows_of_a_design_that_was_changed() -> None:
    model = FacadeModel(gallery.load("residential-house"))
    view = WordsView(model)
    assert view.channel.stale == ""
    model.enter(("patterns", "Bx", "text"), "A(BA")
    assert "is at fault" in view.channel.stale
    model.discard(("patterns", "Bx", "text"))
    assert view.channel.stale == ""
    # A design without a layout was searched in vain: that is told, and is no earlier solve.
    model.enter(("counters", "k", "min"), 40)
    assert view.channel.stale == ""
    said = captions(view.model.trace)["text"]
    assert said[-1].startswith("It ends without a layout") and "All done" not in " ".join(said)


def test_while_it_is_solved_the_view_is_of_the_design_before() -> None:
    model = FacadeModel(gallery.load("figure-8"))
    view = WordsView(model)
    told: list[str] = []
    view.channel.observe(lambda change: told.append(change["new"]), "stale")
    model.busy, model.version = True, model.version + 1
    model.busy, model.version = False, model.version + 1
    assert [bool(text) for text in told] == [True, False] and "being solved" in told[0]
