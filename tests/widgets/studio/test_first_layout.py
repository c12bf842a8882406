"""What a search has after its first moment is shown while it goes on; what is told in the end is as exact as ever."""

from __future__ import annotations

import asyncio
import random
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

import pytest

from facade_nb import Design, Layout, NoLayout, gallery, solve
from facade_nb.render.elevation import elevation_pieces
from facade_nb.solver.resized import resized
from facade_nb.solver.solution import forget
from facade_nb.widgets import FacadeModel
from facade_nb.widgets.studio.background import FIRST

from ..houses import house
from .test_channel import Line


class Slow:
    """A solver that has a layout after the first moment, and needs more for the proof."""

    def __init__(self) -> None:
        self.proof = threading.Event()
        self.begun: list[float] = []

    def __call__(
        self, design: Design, *, time_limit: float, should_stop: Callable[[], bool], **_: object
    ) -> Layout:
        layout = solve(design)
        if time_limit == FIRST:
            return replace(layout, complete=False, warnings=("The search was cut short.",))
        self.begun.append(design.canvas.width)
        while not self.proof.wait(0.002):
            if should_stop():
                raise NoLayout("stopped")
        return layout


async def _until(happens: Callable[[], bool]) -> None:
    while not happens():
        await asyncio.sleep(0.002)


def test_the_best_of_the_first_moment_is_shown_and_the_proof_sends_no_drawing() -> None:
    solver = Slow()

    async def session() -> Line:
        model = FacadeModel(house(), solve=solver)
        line = Line(model)
        await _until(lambda: model.proving)
        line.updates.clear()
        line.set("canvas/width", "7")
        await _until(lambda: model.proving)
        assert model.busy
        assert model.layout is not None
        assert model.layout.canvas.width == 7.0
        assert not model.layout.warnings  # that it was cut short is no news while it goes on
        solver.proof.set()
        await _until(lambda: not model.busy)
        return line

    line = asyncio.run(session())
    first = next(update for update in line.updates if "svg" in update)
    assert first["status"]["proving"]
    assert first["status"]["busy"]
    last = line.updates[-1]
    assert "svg" not in last
    assert not last["status"]["proving"]
    assert last["status"]["solved"]["complete"]
    assert solver.begun[-1] == 7.0


def test_stopping_the_proof_keeps_what_is_shown_and_says_that_it_was_cut_short() -> None:
    async def session() -> FacadeModel:
        model = FacadeModel(house(), solve=Slow())
        await _until(lambda: model.proving)
        model.stop()
        await _until(lambda: not model.busy)
        return model

    model = asyncio.run(session())
    assert model.layout is not None
    assert not model.layout.complete
    assert model.layout.warnings
    assert model.message == ""


def test_an_answer_is_the_same_after_a_search_that_was_cut_short() -> None:
    design = gallery.load("bookshop")
    forget()
    alone = solve(design, time_limit=None)
    forget()
    with suppress(NoLayout):
        solve(design, time_limit=0.0)
    after = solve(design, time_limit=None)
    assert after.complete
    assert after.shapes == alone.shapes
    assert after.x.cost == alone.x.cost
    assert after.y.cost == alone.y.cost


def test_an_edit_is_shown_with_the_structure_that_there_was_before_it_is_searched() -> None:
    forget()
    asked: list[float] = []
    go = threading.Event()

    def searched(design: Design, **options: object) -> Layout:
        asked.append(design.canvas.width)
        if len(asked) > 1:
            go.wait()  # what is shown is there before anything is searched
        return solve(design)

    async def session() -> Line:
        model = FacadeModel(house(), solve=searched, quick=-1.0, known=resized)
        line = Line(model)
        await _until(lambda: not model.busy)
        line.updates.clear()
        line.set("canvas/width", "7")
        await _until(lambda: model.proving)
        shown = model.layout
        assert shown is not None
        assert shown.canvas.width == 7.0
        assert not shown.complete
        assert not shown.warnings  # the status line says that the search goes on
        go.set()
        await _until(lambda: not model.busy)
        assert model.layout is not None
        assert model.layout.shapes == shown.shapes
        assert model.layout.complete
        return line

    line = asyncio.run(session())
    first, last = next(update for update in line.updates if "svg" in update), line.updates[-1]
    assert first["status"]["proving"]
    assert "svg" not in last
    assert last["status"]["solved"]["proven"]
    assert asked == [6.0, 7.0]  # and it is searched once


@pytest.mark.parametrize("name", ["residential-house", "figure-7", "apartment-house"])
def test_the_last_picture_is_that_of_the_layout_drawn_afresh(name: str) -> None:
    """Whatever came before it: the structure that there was, a picture that is kept, a search that was passed over."""
    forget()
    design, draw = gallery.load(name), random.Random(name)
    sized = [symbol.name for symbol in design.symbols.values() if symbol.size is not None]
    shown: list[Layout] = []

    def known(design: Design, **options: object) -> Layout | None:
        found = resized(design)
        shown.extend([] if found is None else [found])
        return found

    async def session() -> None:
        model = FacadeModel(
            design, solve=lambda own, **_: solve(own, time_limit=None), quick=-1.0, known=known
        )
        line = Line(model)
        await _until(lambda: not model.busy)
        for turn in range(6):
            symbol = draw.choice(sized)
            size = round((design.symbol(symbol).size or 1.0) * draw.uniform(0.97, 1.03), 3)
            width = round(design.canvas.width * draw.uniform(0.98, 1.02), 2)
            line.set(*(("canvas/width", width), (f"symbols/{symbol}/size", size))[turn % 2])
            await _until(lambda: not model.busy)
            if model.message:  # the last good picture stays
                continue
            layout = model.layout
            assert layout is not None
            prefix = f"f{line.channel.model_id}"
            fresh = elevation_pieces(layout, holes=True, background=False, prefix=prefix)
            assert line.channel.svg == "\n".join(fresh)
        model.close()

    asyncio.run(session())
    assert len(shown) > 2
    for layout in shown:
        for solved in (layout.x, layout.y):
            assert solved.sizing is not None
            assert solved.sizing.primal_residual < 1e-9


def test_a_search_that_is_quick_is_waited_for() -> None:
    """What comes before the answer is of use only where that takes long."""

    async def session() -> Line:
        model = FacadeModel(house(), first=9.0, quick=1e9)
        line = Line(model)
        await _until(lambda: not model.busy)
        line.updates.clear()
        line.set("canvas/width", "7")
        await _until(lambda: not model.busy)
        return line

    assert not any(update.get("status", {}).get("proving") for update in asyncio.run(session()).updates)
