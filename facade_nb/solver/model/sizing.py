"""The sizing problem of an axis as data: the system, its answer, which constraint pulls where, and the proof.

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

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .sums import times

__all__ = ["FREE", "Force", "Key", "Sizing", "Solution", "System"]

_Array = NDArray[np.float64]
Key = tuple[Any, ...]
"""What a name is spelled from: its kind, then symbols, indices, or places."""
FREE = 1e30
"""Bounds at or beyond this are none."""
_FELT = 1e-9
"""Metres: smaller multipliers pull nothing."""


@dataclass(frozen=True, slots=True)
class Solution:
    """Answer of `least_squares`.

    Attributes
    ----------
    x
        Shape (n,).
    multipliers
        Shape (n + m,): of the variables' bounds, then of the rows. Positive: the upper bound pulls;
        negative: the lower one.
    iterations
        Active-set changes.
    """

    x: _Array
    multipliers: _Array
    iterations: int


@dataclass(frozen=True, slots=True)
class System:
    """The least-squares system as it was posed.

    Attributes
    ----------
    variables
        Names: ``|A|`` the size of a symbol, ``g:j`` the right edge of column j of group g, ``g:ijk.t`` the
        upper bound of letter k of row i in column j, ``g:ijk.s`` its lower bound where a gap parts it from
        the column's edge.
    rows
        Names of the equations and inequalities.
    keys, row_keys
        What the names are spelled from.
    matrix, lower, upper
        The rows, shape (m, n); bounds of the variables, then of the rows.
    weight, target, pull
        Per variable: weight in the first round, where it would like to be, weight in the second round.
    """

    keys: tuple[Key, ...]
    row_keys: tuple[Key, ...]
    matrix: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    weight: np.ndarray
    target: np.ndarray
    pull: np.ndarray

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables; spelled when asked for, because a search poses many systems and shows one."""
        return tuple(map(_spelled, self.keys))

    @property
    def rows(self) -> tuple[str, ...]:
        """Names of the rows."""
        return tuple(map(_spelled, self.row_keys))

    def kept(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The bounds of the second round: sized symbols keep the sizes that they have in x."""
        n, kept = x.size, self.weight > 0
        lower, upper = self.lower.copy(), self.upper.copy()
        lower[:n][kept] = upper[:n][kept] = x[kept]
        return lower, upper


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


def _spelled(key: Key) -> str:
    """The name of a variable or a row."""
    kind, *rest = key
    match kind:
        case "|":
            return f"|{rest[0]}|"
        case ":":
            return f"{rest[0]}:{rest[1]}"
        case "<":
            return f"{rest[0]}:{rest[1]} < {rest[0]}:{rest[1] + 1}"
        case "=":
            return " + ".join(map(_placed, rest[1:])) + f" = |{rest[0]}|"
        case "extent":
            return f"extent of {rest[0]} = |{rest[0]}|"
        case "column":
            return f"{rest[0]}:{rest[2]}: row {rest[1]} = the first row"
        case "canvas":
            return f"{rest[0]}: columns = canvas"
    name = _placed(rest)
    match kind:
        case "piece":
            return f"{name}.s < {name}.t"
        case "before" | "after":
            return f"{name}: gap {kind} ≥ 0"
        case "gaps":
            return f"{name}: gaps equal"
    return f"{name}.{kind}"


def _placed(place: Sequence[int]) -> str:
    """Group, row, column and place in the element of a letter or piece."""
    g, row, j, i = place
    return f"{g}:{row}-{j}-{i}"
