"""What a reader predicts in the studio is the solver's answer, and the design stays as it is."""

from __future__ import annotations

import pytest

from facade_nb import gallery, solve
from facade_nb.design.edit import with_canvas
from facade_nb.widgets import FacadeModel
from facade_nb.widgets.studio.channel import Channel
from facade_nb.widgets.studio.foretold import foretold
from facade_nb.widgets.studio.requests import REQUESTS


def test_another_width_is_answered_and_changes_nothing() -> None:
    house = gallery.load("residential-house")
    model = FacadeModel(house)
    model.wait()
    channel = Channel.of(model)
    told = REQUESTS["foretell"](channel, {"op": "foretell", "width": 9, "client": "a", "seq": 1})
    assert told is not None and model.design == house and not model.busy
    then = solve(with_canvas(house, width=9.0))
    (count,) = told["counts"]
    assert (count["pattern"], count["symbol"], count["now"]) == ("Bx", "B", 3)
    assert count["later"] == then.counters["k"] == 5
    assert count["length"] == pytest.approx([5.6, 9.0])
    moves = {own["symbol"]: own for own in told["moves"]}
    assert moves["B"]["by"] == pytest.approx(then.x.sizes["B"] - 1.2)
    assert [name for name, own in moves.items() if own["most"]] == [
        max(moves, key=lambda name: abs(moves[name]["by"]))
    ]


def test_where_nothing_fits_nothing_is_asked() -> None:
    house = gallery.load("residential-house")
    assert foretold(house, solve(house), 0.4)["counts"] == []
    assert foretold(house, None, 9.0) == {"kind": "foretold", "width": 9.0, "counts": [], "moves": []}
