"""Tall stacks: the skeleton's bound, the edges made by it, and dives, against the search that knows none of them."""

from __future__ import annotations

import random
from collections.abc import Iterator
from math import inf

import pytest

from facade_nb.solver import Letter, Objective, align, tuning
from facade_nb.solver.alignment.core.search import search_best as search
from facade_nb.solver.alignment.group import Group, make_group
from facade_nb.solver.alignment.reference.dives import Dives
from facade_nb.solver.alignment.reference.skeleton import Skeleton, greatest_width
from tests.oracle import DEFAULT, Case, check, make_case


def case_of(seed: int) -> Case:
    """A random input of `align` under an objective that looks at more than Ω."""
    for attempt in range(50):
        case = make_case(random.Random(1000 * seed + attempt).choice, seed % 4 == 0)
        if not case.weights.paper:
            return case
    raise AssertionError("no such case")


def group_of(case: Case) -> Group:
    """The group of a case."""
    weights = case.weights
    objective = Objective(empty=weights.empty, loose=weights.loose, fit=weights.fit)
    return make_group(case.rows, case.canvas, case.tolerance, objective, cuts=case.cuts)


def stack(rows: int, cells: int, seed: int, jitter: float = 0.0) -> tuple[list[tuple[Letter, ...]], float]:
    """Distinct rows over one grid of cells, each with its own way of joining them, and the canvas they fill."""
    draw = random.Random(seed)
    grid = [draw.choice([0.6, 0.8, 1.0, 1.2]) for _ in range(3)] * (cells // 3)
    words: dict[tuple[Letter, ...], None] = {}
    while len(words) < rows:
        word: list[Letter] = []
        i = 0
        while i < len(grid):
            k = min(draw.choice([1, 1, 1, 2, 3]), len(grid) - i)
            size = sum(grid[i : i + k]) * (1 + draw.uniform(-jitter, jitter))
            word.append(Letter(f"S{size:.4f}", size))
            i += k
        words.setdefault(tuple(word))
    return list(words), sum(grid)


@pytest.fixture
def tall(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Every group with a rigid band counts as tall."""
    monkeypatch.setattr(tuning, "TALL", 1)
    yield


class TestSameAnswer:
    @pytest.mark.parametrize("seed", range(48))
    def test_by_skeleton(self, seed: int, tall: None) -> None:
        case = case_of(seed)
        group = group_of(case)
        found = search([group]).best
        tuning.TALL = 99  # the fixture puts it back
        expected = search([group_of(case)]).best
        assert (found is None) == (expected is None), case
        if found is not None and expected is not None:
            assert found.cost == pytest.approx(expected.cost, abs=1e-7), case
            assert found.columns == expected.columns, case

    @pytest.mark.parametrize("seed", range(4))
    def test_many_rows(self, seed: int) -> None:
        rows, canvas = stack(7, 6, seed, jitter=0.03 * (seed % 2))
        found = align(rows, canvas, 0.5 * canvas, Objective(), search="best")
        assert found is not None
        assert check(found, rows, canvas, 0.5 * canvas, DEFAULT, True) == []
        slow = make_group(rows, canvas, 0.5 * canvas, Objective())
        object.__setattr__(slow, "tall", False)
        expected = search([slow]).best
        assert expected is not None and found.cost == pytest.approx(expected.cost, abs=1e-7)
        assert len(found.columns) == expected.columns

    def test_forty_distinct_rows(self) -> None:
        """The bound is the optimum where rows are consistent, so that this ends."""
        rows, canvas = stack(40, 9, 1)
        found = align(rows, canvas, 0.5 * canvas, Objective(), search="best")
        assert found is not None
        assert check(found, rows, canvas, 0.5 * canvas, DEFAULT, True) == []
        assert found.error == pytest.approx(0.0, abs=1e-9)


class TestBound:
    @pytest.mark.parametrize("seed", range(40))
    def test_never_says_more_than_the_truth(self, seed: int) -> None:
        case = case_of(100 + seed)
        group = group_of(case)
        expected = search([group]).best
        if expected is None:
            return
        for limit in (expected.cost + 1e-9, expected.cost + 0.3, 2.0 * expected.cost + 1.0):
            skeleton = Skeleton(group, limit)
            assert skeleton.root <= expected.cost + 1e-7, case

    def test_is_the_optimum_of_consistent_rows(self) -> None:
        rows, canvas = stack(12, 9, 3)
        group = make_group(rows, canvas, 0.5 * canvas, Objective())
        found = search([group]).best
        assert found is not None
        assert Skeleton(group, found.cost + 1e-9).root == pytest.approx(found.cost, abs=1e-6)
        assert Skeleton(group, found.cost - 1e-3).root == inf

    def test_greatest_width(self) -> None:
        """Two rows of 4 m on 5 m: each metre beyond costs fit and two shares of 0.8 / 2."""
        rows = [(Letter("A", 4.0),), (Letter("B", 2.0), Letter("C", 2.0))]
        group = make_group(rows, 5.0, 2.0, Objective())
        assert greatest_width(group, 0.8) == pytest.approx(5.0)
        assert greatest_width(group, 0.8 + 1.05 * 0.5) == pytest.approx(5.5)
        assert greatest_width(group, 100.0) == 7.0


class TestDives:
    @pytest.mark.parametrize("seed", range(40))
    def test_come_to_the_optimum(self, seed: int) -> None:
        case = case_of(200 + seed)
        group = group_of(case)
        expected = search([group_of(case)]).best
        dives = Dives([group], 0.0)
        costs: list[float] = []
        for _ in range(400):
            if dives.done:
                break
            if dives.dive():
                assert dives.best is not None
                costs.append(dives.best.cost)
        assert (dives.best is None) == (expected is None), case
        assert costs == sorted(costs, reverse=True)
        if expected is not None:
            assert costs[-1] >= expected.cost - 1e-7
            if dives.done:
                assert costs[-1] == pytest.approx(expected.cost, abs=1e-7), case

    def test_structures_that_will_not_do_are_passed_over(self) -> None:
        rows, canvas = stack(7, 6, 5)
        group = make_group(rows, canvas, 0.5 * canvas, Objective())
        dives = Dives([group], 0.0, accept=lambda priced: priced.columns < 3)
        while not dives.done and dives.best is None:
            dives.dive()
        assert dives.best is not None and dives.best.columns < 3
