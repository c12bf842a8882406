"""The mixed-integer programmes that the bench compares with find the optimum: checked against the oracle."""

from __future__ import annotations

import random

import pytest

from facade_nb.solver import Letter
from tests.bench.milp import Task, TooLarge, pose_paths
from tests.bench.milp_reference import pose_reference
from tests.oracle.alignment import TooBig, best
from tests.oracle.cases import Case, make_case
from tests.oracle.pricing import DEFAULT, PAPER


def _expected(case: Case) -> float | None:
    found = best(case.rows, case.canvas, case.tolerance, case.weights, case.cuts, limit=1000)
    return None if found is None else found.cost


def _task(case: Case) -> Task:
    return Task(case.rows, case.canvas, case.tolerance, case.weights, case.cuts)


def _checked(seeds: range) -> tuple[int, int]:
    """How often each formulation was posed; every optimum is the oracle's."""
    paths = reference = 0
    for seed in seeds:
        case = make_case(random.Random(seed).choice, unsized=seed % 2 == 0)
        if not any(case.rows) or sum(map(len, set(case.rows))) > 7:
            continue
        try:
            cost = _expected(case)
        except TooBig:
            continue
        programmes = [pose_paths(_task(case))]
        paths += 1
        try:
            programmes.append(pose_reference(_task(case), gaps=3))
            reference += 1
        except ValueError:  # no solid word, or nothing opaque
            pass
        for programme in programmes:
            answer = programme.solve(20.0)
            assert answer.proven or not answer.feasible, str(case)
            if cost is None:
                assert not answer.feasible, str(case)
            else:
                assert answer.cost == pytest.approx(cost, abs=1e-6), str(case)
    return paths, reference


def test_both_formulations_find_the_optimum_of_the_oracle() -> None:
    paths, reference = _checked(range(2000, 2050))
    assert paths > 30 and reference > 15  # there was something to check


def _letters(word: str, **sizes: float) -> tuple[Letter, ...]:
    return tuple(Letter(s, sizes[s], s.islower(), s.isupper()) for s in word)


@pytest.mark.parametrize("seed", [595, 648, 894])
def test_a_width_above_its_largest_row_is_not_allowed(seed: int) -> None:
    """Only a column wider than its letters would reach the canvas: the first programme makes one."""
    case = make_case(random.Random(seed).choice, unsized=seed % 2 == 0)
    answer = pose_paths(_task(case)).solve(20.0)
    assert answer.inflated
    cost = _expected(case)
    assert answer.feasible == (cost is not None)
    if cost is not None:
        assert answer.cost == pytest.approx(cost, abs=1e-6)


def test_the_reference_is_no_wider_than_its_largest_row() -> None:
    rows = (_letters("f", f=2.0), _letters("A", A=2.0))
    assert not pose_reference(Task(rows, 3.0, 0.5, DEFAULT)).solve(20.0).feasible


def test_figure_8_under_the_paper_s_objective() -> None:
    rows = (_letters("CeC", C=2.0, e=8.0), _letters("ABABA", A=2.0, B=3.0))
    for programme in (pose_paths(Task(rows, 12.0, 0.5, PAPER)), pose_reference(Task(rows, 12.0, 0.5, PAPER))):
        answer = programme.solve(20.0)
        assert answer.proven and answer.cost == pytest.approx(0.0, abs=1e-6)


def test_too_many_columns_are_refused() -> None:
    rows = tuple(_letters(word, A=1.0, B=2.0, C=1.5) for word in ("ABABABAB", "CCCCCC", "ACACACAC"))
    with pytest.raises(TooLarge, match="more than 1000 columns"):
        pose_paths(Task(rows, 12.0, 6.0, DEFAULT), most=1000)
    with pytest.raises(TooLarge, match="more than 1000 arcs"):
        pose_reference(Task(rows, 12.0, 6.0, DEFAULT), most=1000)


def test_a_reference_must_be_solid() -> None:
    rows = (_letters("aB", a=1.0, B=2.0), _letters("Ba", a=1.0, B=2.0))
    with pytest.raises(ValueError, match="without transparent letters"):
        pose_reference(Task(rows, 3.0, 1.0, DEFAULT))
