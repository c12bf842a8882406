"""Under what the answers of axes are kept between calls (`cache.CACHE`)."""

from __future__ import annotations

from collections.abc import Hashable

from ..model.objective import Objective
from ..model.problem import AxisProblem
from .tolerances import TOLERANCES

__all__ = ["kept_as", "last_as", "spelled_as"]


def kept_as(
    problems: tuple[AxisProblem, ...],
    objective: Objective,
    tolerances: tuple[float, ...] = TOLERANCES,
    search: str = "best",
) -> Hashable:
    """What a complete answer is kept under."""
    return problems, objective, tolerances, search


def spelled_as(problem: AxisProblem, objective: Objective) -> Hashable:
    """What the answer found last for the same patterns is kept under, whatever the sizes."""
    return problem.axis, problem.groups, problem.patterns, objective


def last_as(problem: AxisProblem, objective: Objective) -> Hashable:
    """What the answer found last on an axis is kept under, whatever has been edited but its groups' rows."""
    return problem.axis, problem.groups, objective
