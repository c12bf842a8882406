"""Which constraint pulls where: the multipliers of the sizing problem as forces, and the proof that it is solved.

The sizing problem is ``min Σ weight·(x − target)²`` subject to ``lower <= [x; rows @ x] <= upper``. Its answer has one
multiplier λ for each bound of a variable and for each row, with

    2·weight·(x − target) + λ_bounds + rowsᵀ·λ_rows = 0.

A constraint with λ > 0 is met at its upper end and keeps the expression down; with λ < 0 it is met at its lower end
and keeps it up. What it does to a variable is the force ``−λ·coefficient`` in metres: positive makes the variable
larger. In each variable the forces add up to the tension ``2·weight·(x − target)`` of its spring: a symbol with
positive tension is larger than it would like to be. Moving the end that a constraint is met at by a small δ changes
the objective by ``−λ·δ``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..sums import times
from .least_squares import FREE, Solution
from .system import System

__all__ = ["Force", "Sizing"]

_Array = NDArray[np.float64]
_FELT = 1e-9
"""Metres: smaller multipliers pull nothing."""


@dataclass(frozen=True, slots=True)
class Force:
    """One constraint that pulls.

    Attributes
    ----------
    name
        The row's name, or that of the variable whose bound it is.
    kind
        ``"row"`` or ``"bound"``.
    side
        ``"upper"``, ``"lower"``, or ``"equation"`` where both ends are one.
    multiplier
        λ, metres.
    on
        The force on each variable in it, by the variable's name, metres; positive makes it larger.
    """

    name: str
    kind: str
    side: str
    multiplier: float
    on: Mapping[str, float]


@dataclass(frozen=True)
class Sizing:
    """The sizing problem of an axis with its answer.

    Attributes
    ----------
    system
        Variables and rows by name, matrix, bounds, weights, targets.
    solution
        The answer of the first round, which fixes the sizes, with its multipliers.
    """

    system: System
    solution: Solution

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Of the constraints, in the order of `multipliers`: variables (their bounds), then rows."""
        return (*self.system.variables, *self.system.rows)

    @property
    def multipliers(self) -> _Array:
        """λ, shape (n + m,)."""
        return self.solution.multipliers

    @cached_property
    def values(self) -> _Array:
        """What is held between the bounds, shape (n + m,): the variables, then ``rows @ x``."""
        return np.concatenate([self.solution.x, times(self.system.matrix, self.solution.x)])

    @cached_property
    def tension(self) -> dict[str, float]:
        """``2·weight·(x − target)`` of each variable with a weight, metres; positive: larger than it would like."""
        own = 2.0 * self.system.weight * (self.solution.x - self.system.target)
        return {
            name: float(pull)
            for name, pull, weight in zip(self.system.variables, own, self.system.weight, strict=True)
            if weight > 0
        }

    @cached_property
    def active(self) -> tuple[str, ...]:
        """Names of the constraints that are met at one of their ends, equations among them."""
        at = self.values
        met = (np.abs(at - self.system.lower) <= 1e-8) | (np.abs(self.system.upper - at) <= 1e-8)
        return tuple(name for name, own in zip(self.names, met, strict=True) if own)

    def forces(self) -> list[Force]:
        """The constraints that pull, the strongest first."""
        system, n = self.system, self.solution.x.size
        found: list[Force] = []
        for c in np.flatnonzero(np.abs(self.multipliers) > _FELT):
            pull = float(self.multipliers[c])
            same = system.lower[c] == system.upper[c]
            if c < n:
                on = {system.variables[c]: -pull}
            else:
                row = system.matrix[c - n]
                on = {system.variables[v]: float(-pull * row[v]) for v in np.flatnonzero(row)}
            side = "equation" if same else "upper" if pull > 0 else "lower"
            found.append(Force(self.names[c], "bound" if c < n else "row", side, pull, on))
        # those that pull as hard come in the order of the constraints, whatever the last bits are
        return sorted(found, key=lambda force: -round(abs(force.multiplier), 9))

    @property
    def primal_residual(self) -> float:
        """By how much some constraint is violated at most, metres."""
        at = self.values
        return max(0.0, float((at - self.system.upper).max()), float((self.system.lower - at).max()))

    @property
    def kkt_residual(self) -> float:
        """The worst violation of the optimality conditions: feasibility, stationarity, complementarity.

        With a convex objective, 0 proves that no other sizes are better.
        """
        system, x, pull = self.system, self.solution.x, self.multipliers
        n = x.size
        gradient = 2.0 * system.weight * (x - system.target) + pull[:n] + times(system.matrix.T, pull[n:])
        # a multiplier may only pull at the end that its sign speaks of
        end = np.where(pull > 0, system.upper, system.lower)
        distance = np.where(np.abs(end) < FREE, np.abs(end - self.values), FREE)
        slack = np.where(pull == 0.0, 0.0, np.minimum(distance, np.abs(pull)))
        return max(self.primal_residual, float(np.abs(gradient).max()), float(slack.max()))
