"""Least squares under linear constraints, by an active-set QP code, behind one function (the paper's 5.3)."""

from __future__ import annotations

import daqp
import numpy as np
from numpy.typing import NDArray

from ..model.sizing import Solution
from ..model.sums import times

__all__ = ["least_squares"]

_MISSED = 1e-11
"""By how much the optimality conditions may be missed, in any component."""

_Array = NDArray[np.float64]


def least_squares(
    weight: _Array,
    target: _Array,
    rows: _Array,
    lower: _Array,
    upper: _Array,
    *,
    tolerance: float = 1e-11,
) -> Solution | None:
    """Minimise ``Σ weight·(x − target)²`` subject to ``lower <= [x; rows @ x] <= upper``.

    Parameters
    ----------
    weight, target
        Shape (n,). Weights may be zero: the Hessian is then singular, and the proximal-point method leads to a
        minimiser (a term ``rho·‖x − x_k‖²``, solved again from the answer). daqp's own does so within one call;
        where that leads to numerical trouble it is repeated here, more slowly.
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
    sense = np.multiply(upper == lower, 5, dtype=np.int32)
    double = 2.0 * weight
    hessian, base = np.zeros((weight.size, weight.size)), -double * target
    hessian.reshape(-1)[:: weight.size + 1] = double
    if weight.size == 0 or weight.min() > 0:
        return _solve(hessian, base, rows, lower, upper, sense, tolerance)
    found = _solve(hessian, base, rows, lower, upper, sense, tolerance, eps_prox=1e-5, eta_prox=1e-12)
    if found is not None:
        n = weight.size
        pull = found.multipliers[:n] + times(rows.T, found.multipliers[n:])
        if np.abs(double * found.x + base + pull).max() <= _MISSED:
            return found
    return _rounds(hessian, base, rows, lower, upper, sense, tolerance, target)


def _solve(
    hessian: _Array,
    linear: _Array,
    rows: _Array,
    lower: _Array,
    upper: _Array,
    sense: NDArray[np.int32],
    tolerance: float,
    **options: float,
) -> Solution | None:
    x, _value, flag, info = daqp.solve(
        hessian, linear, rows, upper, lower, sense.copy(), primal_tol=tolerance, dual_tol=1e-12,
        **{"eps_prox": 0.0, **options},
    )  # fmt: skip
    return Solution(x, np.asarray(info["lam"]), int(info["iterations"])) if flag == 1 else None


def _rounds(
    hessian: _Array,
    base: _Array,
    rows: _Array,
    lower: _Array,
    upper: _Array,
    sense: NDArray[np.int32],
    tolerance: float,
    x: _Array,
    rho: float = 1e-3,
) -> Solution | None:
    """The proximal-point method, until the optimality conditions are missed by next to nothing."""
    convex = hessian + 2.0 * rho * np.eye(x.size)
    found: Solution | None = None
    iterations = 0
    for _ in range(40):
        found = _solve(convex, base - 2.0 * rho * x, rows, lower, upper, sense, tolerance)
        if found is None:
            return None
        iterations += found.iterations
        missed = 2.0 * rho * float(np.abs(found.x - x).max(initial=0.0))
        x = found.x
        if missed <= _MISSED:
            break
    return None if found is None else Solution(found.x, found.multipliers, iterations)
