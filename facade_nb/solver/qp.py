"""Least squares under linear constraints, by an active-set QP code, behind one function (the paper's 5.3)."""

from __future__ import annotations

from dataclasses import dataclass

import daqp
import numpy as np
from numpy.typing import NDArray

__all__ = ["FREE", "Solution", "least_squares"]

FREE = 1e30
"""Bounds at or beyond this are none."""

_Array = NDArray[np.float64]


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


def least_squares(
    weight: _Array,
    target: _Array,
    rows: _Array,
    lower: _Array,
    upper: _Array,
    *,
    rho: float = 1e-3,
    tolerance: float = 1e-11,
) -> Solution | None:
    """Minimise ``Σ weight·(x − target)²`` subject to ``lower <= [x; rows @ x] <= upper``.

    Parameters
    ----------
    weight, target
        Shape (n,). Weights may be zero: the Hessian is then singular, and the proximal-point method (a term
        ``rho·‖x − x_k‖²``, solved again from the answer) leads to an exact minimiser, with few rounds.
    rows
        Shape (m, n).
    lower, upper
        Shape (n + m,): bounds of the variables, then of the rows; equal ones make an equation.
    tolerance
        By how much a constraint may be violated.

    Returns
    -------
    The solution, or None where the constraints contradict each other.
    """
    sense = np.zeros(upper.size, dtype=np.int32)
    sense[upper == lower] = 5
    singular = bool((weight <= 0).any())
    hessian = np.diag(2.0 * (weight + (rho if singular else 0.0)))
    base = -2.0 * weight * target
    x = target.copy()
    iterations = 0
    lam = np.zeros(upper.size)
    for _ in range(40 if singular else 1):
        linear = base - 2.0 * rho * x if singular else base
        new, _value, flag, info = daqp.solve(
            hessian,
            linear,
            rows,
            upper,
            lower,
            sense.copy(),
            primal_tol=tolerance,
            dual_tol=1e-12,
            eps_prox=0.0,
        )
        if flag != 1:
            return None
        iterations += int(info["iterations"])
        moved = float(np.abs(new - x).max(initial=0.0))
        x, lam = new, np.asarray(info["lam"])
        if moved <= 1e-10:
            break
    return Solution(x, lam, iterations)
