"""The garbage collector is kept back while somebody holds it, and never left so."""

from __future__ import annotations

import asyncio
import gc
import threading
from collections.abc import Iterator

import pytest

from facade_nb import solve
from facade_nb.solver.resized import resized
from facade_nb.solver.solution import forget
from facade_nb.widgets import FacadeModel
from facade_nb.widgets.shared.collecting import hold, release
from facade_nb.widgets.studio.background import LatestSolver, Outcome

from ..houses import house


@pytest.fixture(autouse=True)
def as_it_was() -> Iterator[None]:
    yield
    gc.enable()


def test_it_goes_on_when_the_last_holder_lets_it_go() -> None:
    one, two = object(), object()
    hold(one)
    hold(two)
    release(one)
    assert not gc.isenabled()
    release(two)
    assert gc.isenabled()
    release(two)
    gc.disable()  # what the user has switched off stays off
    hold(one)
    release(one)
    assert not gc.isenabled()


def test_an_edit_keeps_it_back_and_lets_it_go(monkeypatch: pytest.MonkeyPatch) -> None:
    during: list[bool] = []
    told = LatestSolver._tell

    def tell(self: LatestSolver, outcome: object) -> None:
        during.append(gc.isenabled())
        told(self, outcome)  # type: ignore[arg-type]

    monkeypatch.setattr(LatestSolver, "_tell", tell)
    forget()  # what is known to its end is not shown before

    async def session() -> None:
        model = FacadeModel(house(), solve=lambda design, **_: solve(design), quick=-1.0, known=resized)
        while model.busy:
            await asyncio.sleep(0.002)
        during.clear()
        model.enter("canvas.width", 7.0)
        while model.busy:
            await asyncio.sleep(0.002)
        model.close()

    asyncio.run(session())
    assert during == [False, True]  # at once, and after the search
    assert gc.isenabled()


def test_it_goes_on_where_nobody_can_be_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """The thread ends with what its listener raised; the collector is let go, and the next submission is solved."""
    monkeypatch.setattr(threading, "excepthook", lambda _: None)
    told: list[int] = []

    def deliver(outcome: Outcome) -> None:
        told.append(outcome.revision)
        if outcome.revision == 1:
            raise RuntimeError("the loop is closed")

    solver = LatestSolver(deliver, lambda design, **_: solve(design))
    solver.submit(1, house(), first=1.0)
    assert solver.join() and gc.isenabled()
    solver.submit(2, house(), first=1.0)
    assert solver.join() and gc.isenabled()
    assert told == [1, 2]
