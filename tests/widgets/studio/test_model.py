"""The shared model: edits, drafts, undo, selection, and solving beside the event loop."""

from __future__ import annotations

import asyncio
import gc
import json
import threading
import time
import weakref
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from facade_nb import Design, DesignError, Layout, NoLayout, solve
from facade_nb.design.edit import with_canvas, with_pattern
from facade_nb.widgets import FacadeModel, Selection

from ..houses import HOUSE, house

BX = ("patterns", "Bx", "text")
WIDTH = ("canvas", "width")


def solver_threads_end() -> bool:
    """Whether no solver thread is left, a moment's grace given to one that is just ending."""
    for thread in threading.enumerate():
        if thread.name == "facade_nb-solver":
            thread.join(1.0)
    return not any(thread.name == "facade_nb-solver" for thread in threading.enumerate())


def test_without_a_loop_an_edit_waits_for_its_layout() -> None:
    model = FacadeModel(house())
    assert model.layout is not None
    assert model.layout.counters == {"k": 3}
    model.edit(lambda design: with_canvas(design, width=9.0))
    assert not model.busy
    assert model.layout.canvas.width == 9.0
    assert model.layout.counters == {"k": 4}
    assert solver_threads_end()


def test_a_model_without_a_design_is_an_empty_canvas() -> None:
    model = FacadeModel()
    assert model.layout is not None
    assert model.layout.shapes == ()
    assert model.message == ""


def test_reads_text_and_paths(tmp_path: Path) -> None:
    path = tmp_path / "house.json"
    path.write_text(json.dumps(HOUSE), encoding="utf-8")
    assert FacadeModel(path).design == FacadeModel(json.dumps(HOUSE)).design == house()


def test_an_invalid_edit_raises_and_changes_nothing() -> None:
    model = FacadeModel(house())
    before, version = model.design, model.version
    with pytest.raises(DesignError, match="not closed"):
        model.edit(lambda design: with_pattern(design, "Bx", "A(B"))
    with pytest.raises(DesignError, match="width"):
        model.edit(replace(before, canvas=replace(before.canvas, width=-1.0)))
    assert (model.design, model.version, model.can_undo) == (before, version, False)


def test_faulty_text_is_kept_as_a_draft_and_the_layout_stays() -> None:
    model = FacadeModel(house())
    layout = model.layout
    model.enter(BX, "A(BA^k")
    assert model.drafts[BX].value == "A(BA^k"
    (fault,) = model.drafts[BX].faults
    assert (fault.line, fault.column) == (1, 2)
    assert fault.excerpt.splitlines() == ["A(BA^k", " ^"]
    assert model.design.patterns["Bx"].text == "A(BA)^k"
    assert model.layout is layout
    assert model.stale
    model.enter(BX, "A(BA)^2")
    assert model.drafts == {}
    assert not model.stale
    assert model.layout is not None
    assert model.layout.counters == {}


def test_numbers_are_read_as_typed_and_kept_where_they_are_none() -> None:
    model = FacadeModel(house())
    model.enter(WIDTH, "7,5")
    assert model.design.canvas.width == 7.5
    for text, expected in (("", "found nothing"), ("wide", "'wide'"), ("-2", "width"), ("nan", "number")):
        model.enter(WIDTH, text)
        assert model.drafts[WIDTH].value == text
        assert expected in str(model.drafts[WIDTH].faults[0])
        assert model.design.canvas.width == 7.5
    model.discard(WIDTH)
    assert model.drafts == {}


def test_a_draft_is_taken_over_once_a_later_edit_makes_it_valid() -> None:
    model = FacadeModel(house())
    side = ("layers", "base", "x", "pattern")
    model.enter(side, "Z")
    assert "Z" in str(model.drafts[side].faults[0])
    model.edit(lambda design: with_pattern(design, "Z", "(AB)^k"))
    assert model.drafts == {}
    assert model.design.layers[0].x.pattern == "Z"
    assert model.layout is not None


def test_a_design_without_a_layout_says_why_and_keeps_the_last_one() -> None:
    model = FacadeModel(house())
    layout = model.layout
    model.enter(("counters", "k", "min"), "40")
    assert isinstance(model.blame, NoLayout)
    assert model.message == str(model.blame) != ""
    assert model.stale
    assert model.layout is layout
    assert model.drafts == {}
    model.enter(("counters", "k", "min"), "0")
    assert model.message == ""
    assert model.blame is None
    assert not model.stale


def test_undo_goes_back_by_fields_not_by_keystrokes() -> None:
    model = FacadeModel(house())
    for text in ("A(BA)^k|", "A(BA)^k|A", "A(BA)^k|AB"):
        model.enter(BX, text)
    model.enter(WIDTH, "7")
    model.undo()
    assert model.design.canvas.width == 6.0
    assert model.design.patterns["Bx"].text == "A(BA)^k|AB"
    model.undo()
    assert model.design == house()
    assert not model.can_undo
    model.undo()
    model.redo()
    model.redo()
    assert model.design.canvas.width == 7.0
    assert not model.can_redo
    model.undo()
    model.enter(WIDTH, "8")
    assert not model.can_redo


def test_undo_brings_drafts_back() -> None:
    model = FacadeModel(house())
    model.enter(BX, "A(")
    model.enter(WIDTH, "7")
    model.load(house())
    assert model.drafts == {}
    model.undo()
    assert model.drafts[BX].value == "A("
    assert model.stale


def test_loading_a_faulty_document_tells_every_fault_and_changes_nothing() -> None:
    model = FacadeModel(house())
    faulty = HOUSE | {"canvas": {"width": 0, "height": "high"}}
    with pytest.raises(DesignError) as caught:
        model.load(json.dumps(faulty))
    assert {fault.place for fault in caught.value.faults} == {"canvas.width", "canvas.height"}
    assert model.design == house()
    assert not model.can_undo


def test_save_writes_what_load_reads(tmp_path: Path) -> None:
    model = FacadeModel(house())
    model.enter(WIDTH, "7")
    text = model.save(tmp_path / "design.json")
    assert Design.from_json(text) == Design.from_json(tmp_path / "design.json") == model.design


def test_selection_leads_from_a_shape_to_its_layer_and_symbols_and_survives_a_new_layout() -> None:
    model = FacadeModel(house())
    assert model.layout is not None
    index = next(i for i, s in enumerate(model.layout.shapes) if s.layer == "columns")
    model.select(index)
    assert model.selection == Selection(index, "columns", "C", "P", (1, 1))
    model.enter(BX, "A(BA)^2")
    assert model.selection.shape is not None
    picked = model.layout.shapes[model.selection.shape]
    assert (picked.layer, picked.x, picked.y) == ("columns", "C", "P")
    model.enter(("layers", "columns", "visible"), False)
    assert model.selection == Selection(None, "columns", "C", "P", (1, 1))
    model.select(layer="base")
    assert model.selection == Selection(None, "base")
    model.select()
    assert model.selection == Selection()


def test_what_is_picked_twice_is_picked_no_more_and_pairs_join_and_leave() -> None:
    model = FacadeModel(house())
    for what in ({"layer": "base"}, {"x": "A"}, {"y": "P"}):
        model.toggle(**what)
        assert model.selection == Selection(**what)
        model.toggle(**what)
        assert model.selection == Selection()
    model.toggle(layer="base", x="A", y="P")
    for pair in (("B", "P"), ("A", "Q"), ("A", "P"), ("A", "P")):
        model.toggle(layer="base", x=pair[0], y=pair[1], add=True)
    assert model.selection == Selection(None, "base", "B", "P", None, (("A", "Q"), ("A", "P")))
    for pair in (("B", "P"), ("A", "Q"), ("A", "P")):
        model.toggle(layer="base", x=pair[0], y=pair[1], add=True)
    assert model.selection == Selection(None, "base")
    model.toggle(layer="base", x="A", y="P", add=True)
    model.toggle(layer="columns", x="C", y="P", add=True)
    assert model.selection == Selection(None, "columns", "C", "P")


def test_version_rises_once_per_change_when_all_is_consistent() -> None:
    model = FacadeModel(house())
    seen: list[tuple[float, float]] = []
    model.observe(lambda _: seen.append((model.design.canvas.width, model.layout.canvas.width)), "version")
    model.enter(WIDTH, "7")
    assert seen == [(7.0, 7.0)]


class Gate:
    """A solver that waits to be let go, and notes what it is asked."""

    def __init__(self) -> None:
        self.started: list[float] = []
        self.stopped: list[float] = []
        self.open = threading.Event()

    async def reaches(self, width: float) -> None:
        while self.started[-1:] != [width]:
            await asyncio.sleep(0.002)

    def __call__(
        self, design: Design, *, time_limit: float | None, should_stop: Callable[[], bool]
    ) -> Layout:
        width = design.canvas.width
        self.started.append(width)
        while not self.open.wait(0.002):
            if should_stop():
                self.stopped.append(width)
                raise NoLayout("stopped")
        return solve(design)


def test_the_latest_design_wins() -> None:
    gate = Gate()

    async def session() -> FacadeModel:
        model = FacadeModel(house(), solve=gate)
        layouts: list[float] = []
        model.observe(lambda change: layouts.append(change["new"].canvas.width), "layout")
        for width in (7, 8, 9):
            await gate.reaches(width - 1.0)
            model.enter(WIDTH, str(width))
            assert model.busy
        await gate.reaches(9.0)
        gate.open.set()
        while model.busy:
            await asyncio.sleep(0.002)
        assert layouts == [9.0]
        return model

    model = asyncio.run(session())
    assert gate.started == [6.0, 7.0, 8.0, 9.0]
    assert gate.stopped == [6.0, 7.0, 8.0]
    assert model.message == ""
    assert solver_threads_end()


def test_designs_that_wait_are_skipped() -> None:
    gate = Gate()

    async def session() -> None:
        model = FacadeModel(house(), solve=gate)
        for width in range(7, 60):
            model.enter(WIDTH, str(width))
        gate.open.set()
        while model.busy:
            await asyncio.sleep(0.002)
        assert model.layout is not None
        assert model.layout.canvas.width == 59.0

    asyncio.run(session())
    assert len(gate.started) < 30


def test_the_event_loop_turns_while_a_solve_is_under_way() -> None:
    turned = threading.Event()
    waited: list[bool] = []

    def slow(design: Design, **_: object) -> Layout:
        waited.append(turned.wait(60.0))  # for ever, if the loop stood still
        return solve(design)

    async def session() -> int:
        model = FacadeModel(house(), solve=slow)
        turns = 0
        while model.busy:
            await asyncio.sleep(0.001)
            turns += 1
            if turns == 20:
                turned.set()
        return turns

    assert asyncio.run(session()) >= 20
    assert waited == [True]


def test_an_outcome_that_comes_after_its_loop_has_closed_waits_for_wait() -> None:
    gate = Gate()

    async def begin() -> FacadeModel:
        return FacadeModel(house(), solve=gate)

    model = asyncio.run(begin())
    assert model.busy
    gate.open.set()
    assert model.wait(600.0)
    assert model.layout is not None
    assert not model.busy


def test_wait_gives_up_after_its_time_and_close_stops_the_solve() -> None:
    gate = Gate()

    async def session() -> None:
        model = FacadeModel(house(), solve=gate)
        assert not model.wait(0.05)
        model.close()
        assert not model.busy

    asyncio.run(session())
    assert gate.stopped == [6.0]
    assert solver_threads_end()


def test_an_unexpected_error_in_the_solver_is_told_and_the_next_edit_recovers() -> None:
    def brittle(design: Design, **_: object) -> Layout:
        if design.canvas.width == 7.0:
            raise ZeroDivisionError("a fault of ours")
        return solve(design)

    model = FacadeModel(house(), solve=brittle)
    model.enter(WIDTH, "7")
    assert isinstance(model.trouble, ZeroDivisionError)
    assert model.stale
    model.enter(WIDTH, "8")
    assert model.trouble is None
    assert not model.stale


def test_models_are_collected_with_all_they_hold() -> None:
    model = FacadeModel(house())
    model.enter(WIDTH, "7")
    dead = weakref.ref(model)
    del model
    gc.collect()
    assert dead() is None


def test_edits_of_a_cell_and_of_a_view_at_once_are_all_kept() -> None:
    """JupyterLab answers views in a thread of its own while a cell runs."""
    model = FacadeModel(house())
    slow = threading.Event()

    def change(design: Design) -> Design:
        """One that takes a while: what it is made from must not change meanwhile."""
        slow.set()
        time.sleep(0.05)
        return replace(design, canvas=replace(design.canvas, width=7.0))

    cell = threading.Thread(target=model.edit, args=(change,))
    cell.start()
    slow.wait()
    model.enter(("symbols", "A", "size"), "0.6")
    cell.join()
    model.wait()
    assert (model.design.canvas.width, model.design.symbols["A"].size) == (7.0, 0.6)
    model.undo()
    assert (model.design.canvas.width, model.design.symbols["A"].size) == (7.0, 1.0)
