"""`align` against exhaustive search (`tests.oracle`): equal wherever that can be run."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import TypeVar

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from facade_nb.solver import Letter, Objective, align
from facade_nb.solver.alignment.core.search import search_best
from facade_nb.solver.alignment.group import make_group
from tests.oracle import DEFAULT, Case, TooBig, Weights, best, check, make_case

T = TypeVar("T")
LIMIT = 500
"""Partial structures that the oracle may look at: half a second or so."""


def objective(weights: Weights) -> Objective:
    """The objective of the package that the oracle's weights stand for."""
    if weights.paper:
        return Objective.paper()
    return Objective(empty=weights.empty, loose=weights.loose, fit=weights.fit)


@st.composite
def cases(draw: st.DrawFn, unsized: bool = False) -> Case:
    """Inputs of `align`, as `make_case` puts them together."""

    def pick(options: Sequence[T]) -> T:
        return draw(st.sampled_from(options))

    return make_case(pick, unsized)


def compare(case: Case, limit: int | None = None) -> None:
    """Assert that both searches find what the oracle finds, and that what they return is an alignment."""
    expected = best(case.rows, case.canvas, case.tolerance, case.weights, case.cuts, limit=limit)
    for search in ("best", "ida"):
        found = align(
            case.rows,
            canvas=case.canvas,
            tolerance=case.tolerance,
            objective=objective(case.weights),
            search=search,
            cuts=case.cuts,
        )
        assert (found is None) == (expected is None), (search, case)
        if found is None or expected is None:
            continue
        faults = check(found, case.rows, case.canvas, case.tolerance, case.weights, case.cuts)
        assert faults == [], (search, case)
        assert found.cost == pytest.approx(expected.cost, abs=1e-6), (search, case)
        if (
            expected.strict_columns is not None
        ):  # else each optimum has a piece of no length, and nobody says how many
            assert len(found.columns) == expected.strict_columns, (search, case)


def compare_if_small(case: Case) -> None:
    """Leave out what would keep the oracle busy for long."""
    try:
        compare(case, limit=LIMIT)
    except TooBig:
        assume(False)


class TestAgainstExhaustiveSearch:
    @settings(max_examples=75)
    @given(case=cases())
    def test_sized_letters(self, case: Case) -> None:
        compare_if_small(case)

    @settings(max_examples=30)
    @given(case=cases(unsized=True))
    def test_unsized_letters(self, case: Case) -> None:
        compare_if_small(case)

    @pytest.mark.parametrize("seed", range(60))
    def test_spread_out_inputs(self, seed: int) -> None:
        """Hypothesis keeps to simple inputs; these are as wild as `make_case` gets."""
        compare(make_case(random.Random(seed).choice))


def letters(text: str) -> tuple[Letter, ...]:
    """Read "d:2 E:2": lower-case letters are transparent, one without a number is unsized."""
    found = []
    for one in text.split():
        symbol, _, size = one.partition(":")
        found.append(Letter(symbol, float(size) if size else None, transparent=symbol.islower()))
    return tuple(found)


@pytest.mark.parametrize(
    ("rows", "canvas", "tolerance"),
    [
        (["d:2", "E:2", "D:2"], 4.0, 0.0),
        (["C:1.13", "d:1.13", "D:1.13"], 2.26, 0.0),
        (["E:2 d:2", "E:2 B:2"], 6.25, 1.0),
        (["b:1 D:1", "D:1 A:1"], 4.0, 1.0),
        (["a A:0.8", "C:3.05 A:0.8"], 5.5, 0.5),
        (["b", "A:0.5", "B:0.5"], 2.0, 1.0),
        (["B:2 c:0.5", "a b"], 2.5, 1.0),
        (["B:2 B:2 c:0.5", "a b"], 4.2, 1.0),
    ],
)
def test_found_by_long_runs(rows: list[str], canvas: float, tolerance: float) -> None:
    """Whole placeholders beside columns that leave their row empty; unsized ones with more columns at equal cost."""
    compare(Case(tuple(map(letters, rows)), canvas, tolerance, DEFAULT, cuts=True))


def test_objective_is_the_default_of_solving() -> None:
    """The weights that the oracle takes for the default are those of the package."""
    ours = Objective()
    assert (ours.empty, ours.loose, ours.fit) == (DEFAULT.empty, DEFAULT.loose, DEFAULT.fit)


@pytest.mark.parametrize("search", ["best", "ida"])
def test_a_row_that_has_no_letters(search: str) -> None:
    """Alone, the paper's Ω is degenerate: an empty lower word costs nothing (docs/problem.md)."""
    found = align([[Letter("A", 3.0)], []], canvas=3.0, search=search)
    assert found is not None and found.error == 0.0
    assert [[len(cell) for cell in column] for column in found.columns] == [[1, 0]]


@pytest.mark.parametrize("search", ["best", "ida"])
def test_wider_paths_with_the_same_pieces(search: str) -> None:
    """A path with more columns is not the better one where its pieces make it too wide for the tolerance."""
    soft = Letter("A", 1.13, opaque=False)
    rows = [[soft, soft, Letter("a", 1.13, transparent=True)], [soft, soft]]
    found = align(rows, 3.39, 1.695, search=search)
    assert found is not None and found.cost == pytest.approx(0.0, abs=1e-9)
    assert len(found.columns) == 5


def test_where_one_search_is_lost_the_other_is_not() -> None:
    """Placeholders that are much too short for the canvas can be cut in more ways than there is room to keep."""
    b, a = (Letter(symbol, size, transparent=True) for symbol, size in (("b", 2.26), ("a", 3.05)))
    rows = [[], [b, b, Letter("A", 3.05, opaque=False, attached=True)], [b], [a, a, b]]
    weights = Objective(empty=1.5, loose=0.1, fit=0.6)
    group = make_group(rows, 8.36, 0.5, weights)
    assert search_best([group], nodes=20_000).cut
    found = [align(rows, 8.36, 0.5, weights, search) for search in ("best", "ida")]
    assert [own and (own.cost, len(own.columns)) for own in found] == [(pytest.approx(5.44225), 6)] * 2
