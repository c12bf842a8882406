"""The active constraints of `activeset` as an orthonormal basis, kept up as they come and go.

By Gram and Schmidt, each vector twice, with plain sums (`sums`): LAPACK's factorizations differ in their last bits from
processor to processor.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..model.sums import dot, times

__all__ = ["Basis"]

_Array = NDArray[np.float64]


class Basis:
    """Vectors that do not depend on each other, as the rows of ``R·Q``: Q orthonormal, R a lower triangle.

    Parameters
    ----------
    size
        How many components a vector has.
    """

    def __init__(self, size: int) -> None:
        self._own = np.zeros((0, size))
        self._q = np.zeros((0, size))
        self._r = np.zeros((0, 0))

    def _split(self, vector: _Array) -> tuple[_Array, _Array]:
        """What a vector is made of in Q, and what is left of it."""
        along, rest = np.zeros(len(self._q)), vector
        for _ in range(2):  # once more takes away what rounding has left
            more = times(self._q, rest)
            along, rest = along + more, rest - times(self._q.T, more)
        return along, rest

    def beyond(self, vector: _Array, least: float) -> _Array | None:
        """What is new in a vector; None where that is no larger part of it than `least`."""
        rest = self._split(vector)[1]
        return rest if dot(rest, rest) > least**2 * dot(vector, vector) else None

    def share(self, vector: _Array) -> _Array:
        """The coefficients with which the vectors come nearest to another one."""
        return self._solved(self._split(vector)[0])

    def take(self, vector: _Array, least: float) -> bool:
        """Add a vector, unless there is no more new in it than `least`; whether it was added."""
        along, rest = self._split(vector)
        length = dot(rest, rest)
        if length <= least**2 * dot(vector, vector):
            return False
        n = len(self._q)
        r = np.zeros((n + 1, n + 1))
        r[:n, :n], r[n, :n], r[n, n] = self._r, along, np.sqrt(length)
        self._own, self._q, self._r = np.vstack([self._own, vector]), np.vstack([self._q, rest / r[n, n]]), r
        return True

    def drop(self, n: int) -> None:
        """Let the nth vector go; those that came after it are made anew."""
        after = self._own[n + 1 :]
        self._own, self._q, self._r = self._own[:n], self._q[:n], self._r[:n, :n]
        for vector in after:
            self.take(vector, 0.0)

    def least(self, products: _Array) -> tuple[_Array, _Array]:
        """The shortest vector that has these products with the vectors, and what it is made of."""
        along = products.copy()
        for n in range(len(along)):
            along[n] = (along[n] - dot(self._r[n, :n], along[:n])) / self._r[n, n]
        return times(self._q.T, along), self._solved(along)

    def _solved(self, along: _Array) -> _Array:
        """Of which coefficients of the vectors something in Q is made."""
        out = along.copy()
        for n in range(len(out) - 1, -1, -1):
            out[n] = (out[n] - dot(self._r[n + 1 :, n], out[n + 1 :])) / self._r[n, n]
        return out
