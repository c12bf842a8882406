"""Small linear programmes, solved exactly by a sequence of quadratic ones.

The alignment search prices hundreds of structures with ten to fifty variables each. A general LP code
spends a millisecond on any of them before it begins; daqp, a dual active-set QP code, answers in hundredths
of one. Adding ``ρ/2·‖x − x_k‖²`` to a linear objective and solving again from the answer is the
proximal-point method, which daqp has built in (`eps_prox`); on a linear programme it ends after finitely many
rounds (Ferris 1991), nearly always two, with the exact vertex.
"""

from __future__ import annotations

import daqp
import numpy as np
from numpy.typing import NDArray

__all__ = ["FREE", "solve_lp"]

FREE = 1e30
"""Bounds at or beyond this are none."""

_Array = NDArray[np.float64]


def solve_lp(cost: _Array, rows: _Array, upper: _Array, lower: _Array, rho: float = 1e-2) -> _Array | None:
    """Minimise ``cost @ x`` subject to ``lower <= [x; rows @ x] <= upper``.

    Parameters
    ----------
    cost
        Shape (n,).
    rows
        Shape (m, n).
    upper, lower
        Shape (n + m,): bounds of the variables, then of the rows; equal ones make an equation.

    Returns
    -------
    x of shape (n,), or None where the constraints contradict each other.
    """
    n = cost.size
    sense = np.zeros(upper.size, dtype=np.int32)
    sense[upper == lower] = 5
    x: _Array
    x, _value, flag, _info = daqp.solve(
        np.zeros((n, n)),
        cost,
        rows,
        upper,
        lower,
        sense,
        primal_tol=1e-11,
        dual_tol=1e-12,
        eps_prox=rho,
        eta_prox=1e-10,
    )
    return x if flag == 1 else None
