"""A dual active-set method, small and plain, that tells its steps (Goldfarb and Idnani 1983).

The QP code that sizes façades does not say which constraints it takes up and lets go. This one does. It begins with
the equations and the least of the objective under them, then takes up the constraint that is missed most, and lets
go of those whose multiplier would turn against their side. Its answer is the same, as the objective is strictly
convex; where some weights are zero, a small term that pulls to the last answer makes it so, and the method is run
again from what it found until that changes nothing (the proximal-point method, as in `qp`).

Often several constraints are missed by as much, or stand in the way at the same point; then the first of them is
taken, in the order in which the system names them. The last bits of sums have no say in it: what differs by less than
`_TINY` is equal, nothing is added up by BLAS or LAPACK (`sums`), and what is told is rounded to `PLACES` decimals of a
metre, as the places of letters are.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf

import numpy as np
from numpy.typing import NDArray

from ..model.sizing import FREE
from ..model.sums import dot, times
from .basis import Basis

__all__ = ["Run", "Step", "steps"]

_Array = NDArray[np.float64]
_TINY = 1e-9
PLACES = 12
"""Decimals of what is told."""
_NOTHING = 1e-15
"""Smaller multipliers are none; others are equal that differ by `_TINY` of the largest."""
_DEPENDENT = 1e-8
"""A constraint of which no larger part than this is new follows from the active ones."""
_MOST = 500
_RHO = 1e-3
_PASSES = 40


@dataclass(frozen=True, slots=True)
class Step:
    """What entered and what left, as numbers of constraints: variables' bounds first, then rows; x after it."""

    entered: tuple[int, ...]
    left: tuple[int, ...]
    active: int
    objective: float
    violation: float
    x: _Array


@dataclass(slots=True)
class Run:
    """All steps; the answer; whether it came to an end."""

    steps: list[Step] = field(default_factory=list)
    x: _Array = field(default_factory=lambda: np.zeros(0))
    complete: bool = True


def steps(weight: _Array, target: _Array, rows: _Array, lower: _Array, upper: _Array) -> Run:
    """Minimise ``Σ weight·(x − target)²`` subject to ``lower <= [x; rows @ x] <= upper``, step by step."""
    run = Run(x=target.copy())
    singular = bool((weight <= 0).any())
    normals = np.vstack([np.eye(target.size), rows])
    method: _Method | None = None
    for number in range(_PASSES if singular else 1):
        pull = _RHO if singular else 0.0
        scale = np.sqrt(weight + pull)
        centre = (weight * target + pull * run.x) / (weight + pull)
        if method is not None and method.still_optimal(scale, centre):
            found = method.answer(scale, centre)
        else:
            method = _Method(normals, lower, upper, weight, target, run)
            found = method.solve(scale, centre, first=number == 0)
        moved = float(np.abs(found - run.x).max(initial=0.0))
        run.x = found
        if moved <= 1e-10 or not run.complete:
            break
    if run.complete and method is not None and run.steps:
        run.steps[-1] = method.step(run.x, run.steps[-1].entered, run.steps[-1].left)
    return run


class _Method:
    """One pass: minimise |scale·(x − centre)|² under the constraints."""

    def __init__(
        self, normals: _Array, lower: _Array, upper: _Array, weight: _Array, target: _Array, run: Run
    ) -> None:
        self.normals, self.lower, self.upper = normals, lower, upper
        self.weight, self.target, self.run = weight, target, run
        self.equal = np.nonzero(lower == upper)[0].tolist()
        self.fixed = set(self.equal)
        self.active: list[int] = []
        self.side: list[float] = []
        self.basis = Basis(target.size)
        self.multipliers = np.zeros(0)

    def answer(self, scale: _Array, centre: _Array) -> _Array:
        """The least under the active constraints taken as equations; sets their multipliers."""
        if not self.active:
            return centre.copy()
        bound = np.where(np.array(self.side) < 0, self.upper[self.active], self.lower[self.active])
        missed = np.array(self.side) * (bound - times(self.normals[self.active], centre))
        moved, self.multipliers = self.basis.least(missed)
        x: _Array = centre + moved / scale
        return x

    def still_optimal(self, scale: _Array, centre: _Array) -> bool:
        """Whether the constraints that were active in the last pass are the right ones for this one too."""
        x = self.answer(scale, centre)
        own = zip(self.active, self.multipliers.tolist(), strict=True)
        kind = all(c in self.fixed or value >= -_TINY for c, value in own)
        return kind and self._violation(x)[0] <= _TINY

    def _violation(self, x: _Array) -> tuple[float, int, float]:
        """The constraint that is missed most: by how much, which, and its side (1: lower, -1: upper)."""
        at = np.concatenate([x, times(self.normals[x.size :], x)])
        low = np.where(self.lower > -FREE, self.lower - at, -inf)
        high = np.where(self.upper < FREE, at - self.upper, -inf)
        worst = np.maximum(low, high)
        worst[self.active] = -inf
        missed = float(worst.max(initial=0.0))
        # all but as much counts as much; of the two sides of one constraint only one is missed
        c = int(np.argmax(worst >= missed - _TINY)) if worst.size else 0
        return missed, c, 1.0 if worst.size and low[c] >= high[c] else -1.0

    def step(self, x: _Array, entered: tuple[int, ...], left: tuple[int, ...]) -> Step:
        """What there is to tell at x."""
        off = x - self.target
        told = round(dot(self.weight, off * off), PLACES), round(self._violation(x)[0], PLACES)
        return Step(entered, left, len(self.active), *told, x.round(PLACES) + 0.0)  # no −0

    def solve(self, scale: _Array, centre: _Array, first: bool) -> _Array:
        """From the equations to the optimum."""
        for c in self.equal:  # those that follow from others stay outside: they hold by themselves
            if self.basis.take(self.normals[c] / scale, _DEPENDENT):
                self.active.append(c)
                self.side.append(1.0)
        x = self.answer(scale, centre)
        if first:
            self.run.steps.append(self.step(x, tuple(self.active), ()))
        while len(self.run.steps) < _MOST:
            missed, c, side = self._violation(x)
            if missed <= _TINY:
                return x
            left = self._enter(x, c, side, scale)
            if left is None:
                break
            x = self.answer(scale, centre)
            self.run.steps.append(self.step(x, (c,), tuple(left)))
        self.run.complete = False
        return x

    def _enter(self, x: _Array, c: int, side: float, scale: _Array) -> list[int] | None:
        """Take a constraint up; those leave whose multipliers would change their sign on the way. None: no way."""
        left: list[int] = []
        own = self.normals[c] * side / scale
        value = 0.0
        bound = self.lower[c] if side > 0 else self.upper[c]
        short = side * (bound - dot(self.normals[c], x))
        while True:
            new = self.basis.beyond(own, _DEPENDENT)
            share = self.basis.share(own)
            near = max(_NOTHING, _TINY * float(np.abs(self.multipliers).max(initial=0.0)))
            most, leaving = self._first_in_the_way(share, near)
            length = 0.0 if new is None else dot(new, new)
            full = short / length if new is not None else inf
            if most == inf and full == inf:
                return None
            go = min(most, full)
            self.multipliers = self.multipliers - go * share
            value += go
            short -= go * length
            if full <= most + near:
                self.basis.take(own, _DEPENDENT)
                self.active.append(c)
                self.side.append(side)
                self.multipliers = np.append(self.multipliers, value)
                return left
            self.basis.drop(leaving)
            left.append(self.active.pop(leaving))
            del self.side[leaving]
            self.multipliers = np.delete(self.multipliers, leaving)

    def _first_in_the_way(self, share: _Array, near: float) -> tuple[float, int]:
        """How far it is until a multiplier would change its sign, and the place of that constraint among the active."""
        ways = [
            (float(self.multipliers[n] / share[n]), a, n)
            for n, a in enumerate(self.active)
            if a not in self.fixed and share[n] > _TINY
        ]
        if not ways:
            return inf, -1
        most = min(ways)[0]
        _, leaving = min((a, n) for way, a, n in ways if way <= most + near)
        return most, leaving
