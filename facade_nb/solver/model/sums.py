"""Sums that are the same on every machine.

``a @ b`` calls BLAS, which adds up in an order that depends on the processor and on how many numbers there are. So the
last bits of its sums differ from machine to machine, and of two that ought to be equal either may be the larger. Here
products are added up one after the other, in the order of their indices. Where something is chosen by such sums, those
that differ by next to nothing count as equal nevertheless, and the first one is taken.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["dot", "times"]

_Array = NDArray[np.float64]


def dot(a: _Array, b: _Array) -> float:
    """``Σ a·b``."""
    return float(np.add.accumulate(a * b)[-1]) if a.size else 0.0


def times(matrix: _Array, x: _Array) -> _Array:
    """``matrix @ x``, shape (m,)."""
    if not x.size:
        return np.zeros(len(matrix))
    found: _Array = np.add.accumulate(matrix * x, axis=1)[:, -1]
    return found
