"""The least-squares system, told: what its variables are, and the steps that lead to its solution (the paper's 5.3)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..events import ActiveSetStep, Event, LeftOut, SystemPosed, VariableNote
from ..model.sizing import Solution, System
from .active_set import Step, steps

__all__ = ["active_set", "system_posed"]


def system_posed(axis: str, system: System) -> SystemPosed:
    """The system with its matrix as triplets."""
    rows, columns = np.nonzero(system.matrix)
    return SystemPosed(
        axis,
        system.variables,
        tuple(map(_meaning, system.keys)),
        system.rows,
        tuple(
            (r, c, float(system.matrix[r, c])) for r, c in zip(rows.tolist(), columns.tolist(), strict=True)
        ),
        tuple(system.lower.tolist()),
        tuple(system.upper.tolist()),
        tuple(system.weight.tolist()),
        tuple(system.target.tolist()),
        tuple(system.pull.tolist()),
    )


def _meaning(key: tuple[Any, ...]) -> VariableNote:
    """What a variable is, by what its name is spelled from (see `sizing.System`)."""
    kind, *rest = key
    if kind == "|":
        return VariableNote("size", symbol=rest[0])
    if kind == ":":
        return VariableNote("boundary", group=rest[0], column=rest[1])
    group, band, column, place = rest
    return VariableNote("start" if kind == "s" else "end", "", group, band, column, place)


def active_set(axis: str, system: System, solution: Solution) -> Iterator[Event]:
    """The steps of both rounds."""
    rounds = (
        (system.weight, system.lower, system.upper),
        (system.pull, *system.kept(solution.x)),
    )
    for number, (weight, lower, upper) in enumerate(rounds, 1):
        own = steps(weight, system.target, system.matrix, lower, upper)
        for n, step in enumerate(own.steps):
            yield _event(axis, number, n, step)
        if not own.complete:
            yield LeftOut(axis, f"active-set steps of round {number}", 1)


def _event(axis: str, number: int, n: int, step: Step) -> ActiveSetStep:
    return ActiveSetStep(
        axis,
        number,
        n,
        step.entered,
        step.left,
        step.active,
        step.objective,
        step.violation,
        tuple(step.x.tolist()),
    )
