"""Many designs in a widget: row by row, stopped and gone on with, opened in the studio, saved."""

from __future__ import annotations

import asyncio
import json
import threading
import zlib
from typing import Any

import pytest

from facade_nb import Design, gallery, sweep, vary
from facade_nb.design.edit import with_canvas
from facade_nb.variations import answers, solve_each
from facade_nb.widgets import FacadeModel, Studio, VariationsView

WIDTHS = [6.0, 0.3, 7.5]


@pytest.fixture(scope="module")
def house() -> Design:
    return gallery.load("residential-house")


def kept(view: VariationsView) -> dict[str, Any]:
    return json.loads(zlib.decompress(view.channel.pictures))


def test_it_solves_what_sweep_does_and_opens_a_row_as_one_step(house: Design) -> None:
    view = VariationsView(house, width=WIDTHS)
    rows = view.channel.rows
    assert [row["state"] for row in rows] == ["done", "error", "done"]
    table = sweep(house, width=WIDTHS, progress=False)
    assert view.table.drop(columns="seconds").equals(table.drop(columns="seconds"))
    assert "'Rx'" in rows[1]["error"] and rows[2]["windows"] == table["windows"][2]
    assert all(kept(view)["drawn"][row].startswith("<svg ") for row in ("0", "2"))
    assert kept(view)["drawn"]["1"] == ""
    facade = view.facade
    assert facade.design == house
    view.channel._receive(view, {"op": "open", "row": 2, "client": "c"}, [])
    assert facade.design == with_canvas(house, width=7.5) and view.channel.state["opened"] == 2
    view.channel._receive(view, {"op": "undo", "client": "c"}, [])
    assert facade.design == house and not facade.can_undo and view.channel.state["opened"] == 0


def test_designs_and_tables_are_shown_too_in_the_studio_that_is_given(house: Design) -> None:
    designs = [vary(house, seed, width=(6, 9)) for seed in (3, 4)]
    studio = Studio(house, name="")
    view = VariationsView(designs, studio)
    assert view.channel.columns == ["seed", "width"] and view.facade is studio.model
    assert [row["values"] for row in view.channel.rows] == [[d.seed, d.canvas.width] for d in designs]
    view.model.open(1)
    assert studio.model.design == designs[1]
    again = VariationsView(solve_each(designs, progress=False).iloc[::-1], FacadeModel(house))
    assert [row["values"][0] for row in again.channel.rows] == [4, 3]
    table = sweep(house, width=WIDTHS, progress=False)
    refused = VariationsView(
        table.iloc[1:]
    )  # without a layout a row has the design of another, with its own values
    refused.model.open(0)
    assert refused.facade.design == with_canvas(house, width=0.3)
    assert "0.3" in refused.to_html() and "its shortest word" in refused.to_html()


@pytest.mark.parametrize(
    ("source", "said"),
    [
        (3, "expected a design, designs, or a table that sweep returned; found int"),
        (["a"], "found str"),
    ],
)
def test_what_is_no_source(source: Any, said: str) -> None:
    with pytest.raises(ValueError, match="VariationsView") as told:
        VariationsView(source)
    assert said in str(told.value)
    with pytest.raises(ValueError, match="model: expected a FacadeModel or a Studio, found int"):
        VariationsView([], 3)


def test_cancel_ends_the_variant_under_way_and_run_goes_on(
    house: Design, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The second variant would take for ever; what it has when it is stopped does not count."""
    begun, solve = threading.Event(), answers.solve

    def endless(design: Design, *, should_stop: Any, **more: Any) -> Any:
        if design.canvas.width == 7.5 and not begun.is_set():
            begun.set()
            while not should_stop():
                threading.Event().wait(0.01)
        return solve(design, should_stop=should_stop, **more)

    monkeypatch.setattr(answers, "solve", endless)

    async def run() -> None:
        view = VariationsView(house, width=[6, 7.5, 9])
        assert view.model.running
        await asyncio.to_thread(begun.wait)
        view.channel._receive(view, {"op": "stop", "client": "c"}, [])
        view.model.wait()
        assert [row["state"] for row in view.channel.rows] == ["done", "waiting", "waiting"]
        assert view.channel.state["running"] is False
        view.channel._receive(view, {"op": "run", "client": "c"}, [])
        view.model.wait()
        assert [row["state"] for row in view.channel.rows] == ["done", "done", "done"]

    asyncio.run(run())


def test_without_anybody_looking_it_keeps_no_pictures(house: Design) -> None:
    view = VariationsView(house, width=[6])
    channel = view.channel
    pictures = channel.pictures
    for here in (True, False):
        channel._receive(view, {"op": "view", "client": "c", "here": here}, [])
    assert pictures and channel.pictures == b"" and channel.rows[0]["state"] == "done"
    channel._receive(view, {"op": "view", "client": "c", "here": True}, [])
    assert channel.pictures == pictures
