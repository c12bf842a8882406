"""Inputs of the tests of the paper's alignment search."""

from __future__ import annotations

import random
from collections.abc import Sequence

from facade_nb.solver import Letter, Objective
from facade_nb.solver.alignment.group import Group, make_group
from tests.oracle import Case, make_case

__all__ = ["PAPER", "case_group", "group_of", "letters", "random_case"]

PAPER = Objective.paper()


def letters(text: str) -> tuple[Letter, ...]:
    """Read "d:2 E:2": lower-case letters are transparent, one without a number is unsized; ° is not opaque."""
    found = []
    for one in text.split():
        opaque = "°" not in one
        symbol, _, size = one.replace("°", "").partition(":")
        found.append(
            Letter(symbol, float(size) if size else None, transparent=symbol.islower(), opaque=opaque)
        )
    return tuple(found)


def group_of(
    rows: Sequence[str],
    canvas: float = 12.0,
    tolerance: float = 0.0,
    objective: Objective = PAPER,
    cuts: bool = True,
) -> Group:
    return make_group([letters(row) for row in rows], canvas, tolerance, objective, cuts=cuts)


def case_group(case: Case) -> Group:
    weights = case.weights
    objective = PAPER if weights.paper else Objective(weights.empty, weights.loose, weights.fit)
    return make_group(case.rows, case.canvas, case.tolerance, objective, cuts=case.cuts)


def random_case(seed: int) -> Case:
    """One to five rows, every qualifier, both objectives, unsized symbols in every other one."""
    rng = random.Random(seed)

    def pick(options: Sequence[object]) -> object:
        options = list(options)
        if options == [1, 2, 2, 2, 3, 3, 4] and seed % 3 == 0:
            options = [4]
        return rng.choice(options)

    case = make_case(pick, unsized=seed % 2 == 1)  # type: ignore[arg-type]
    if seed % 6 == 0:  # a fifth row, made of letters of the others
        letters = [letter for row in case.rows for letter in row]
        extra = tuple(rng.choice(letters) for _ in range(rng.choice([1, 2, 3])) if letters)
        case = Case((extra, *case.rows), case.canvas, case.tolerance, case.weights, case.cuts)
    return case
