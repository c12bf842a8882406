"""A traced solve gives the answer of an untraced one: same layout, same `proven`, same warnings."""

from __future__ import annotations

import json
from typing import Any

import pytest

from facade_nb import Design, NoLayout, gallery, solve
from facade_nb.solver import Objective, tuning
from facade_nb.solver import solution as front
from tests.known import TELLING
from tests.oracle.designs import design, make_design

OBJECTIVES = {"default": None, "paper": Objective.paper()}
# Under the paper's objective the search of these takes long in Python, which is what traces.
LONG = {
    "residential-house", "bookshop", "terraced-house", "concert-hall", "apartment-house", "teaser",
    "ingolstadt-4018215", "figure-2", "qualifiers-b", "qualifiers-c", "qualifiers-d",
}  # fmt: skip
GALLERY = [(name, kind) for name in TELLING for kind in OBJECTIVES if kind == "default" or name not in LONG]


def answer(of: Design, **options: Any) -> tuple[object, bool]:
    """What is told of a layout, or of why there is none; and whether the search came to its end."""
    front.forget()
    try:
        layout = solve(of, time_limit=None, **options)
    except NoLayout as error:
        return (error.axis, error.constraint, error.patterns, error.symbols), error.constraint != "memory"
    if options.get("trace"):
        assert layout.trace.events
        document = layout.trace.to_dict()
        assert document["format"] == "facade-nb/trace/1"
        json.dumps(document, allow_nan=False)  # raises where a number is none
    else:
        assert layout.trace is None
    return layout.to_dict(), layout.complete


def agree(of: Design, objective: str) -> None:
    chosen = OBJECTIVES[objective]
    plain, ended = answer(of, objective=chosen)
    traced, also = answer(of, objective=chosen, trace=True)
    assert ended == also
    if ended:
        assert traced == plain


@pytest.mark.parametrize(("name", "objective"), GALLERY)
def test_of_the_gallery(name: str, objective: str) -> None:
    agree(gallery.load(name), objective)


@pytest.mark.parametrize("objective", OBJECTIVES)
@pytest.mark.parametrize("seed", range(20))
def test_of_random_designs(seed: int, objective: str) -> None:
    agree(make_design(9_000 + seed), objective)


@pytest.mark.parametrize("objective", OBJECTIVES)
def test_of_long_words(objective: str) -> None:
    """A word of more letters than a trace tells of is proven all the same."""
    one = design({"T": 0.02}, {"t": "T^k"}, ["t"], 5.0)
    assert tuning.TOLD_LETTERS < 250
    plain, _ = answer(one, objective=OBJECTIVES[objective])
    traced, ended = answer(one, objective=OBJECTIVES[objective], trace=True)
    assert ended and traced == plain
    assert isinstance(traced, dict) and traced["counters"] == {"k": 250}


def test_what_rescues_a_search_rescues_a_traced_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """Best first gives up soon under the paper's objective; the paper's search finds the answer in either case."""
    from facade_nb.solver.selection.clusters import GroupSearch

    rescues = 0
    otherwise = GroupSearch._otherwise

    def counted(self: GroupSearch) -> None:
        nonlocal rescues
        otherwise(self)
        rescues += self.log is not None and bool(self._found.ties)

    monkeypatch.setattr(tuning, "PATHS", 10_000)
    monkeypatch.setattr(GroupSearch, "_otherwise", counted)
    for seed in range(10, 20):
        one = make_design(9_500 + seed)
        plain, traced = (answer(one, objective=OBJECTIVES["paper"], trace=trace) for trace in (False, True))
        assert plain == traced
    assert rescues >= 1
