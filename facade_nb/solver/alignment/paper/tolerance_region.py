"""The tolerance region of two words, traced along its borders (supplement 3.3 and its Figure 6).

From a node, one head may read i letters of the first word and another j of the second. The column that holds
them errs by |A_i − B_j|, where A and B are running totals of sizes. Those that err by at most μ form a band
along the diagonal of the lattice. Its lower border is followed by a pointer that reads the second word while
the second is not too far ahead, and the first word otherwise; its upper border by one with the words changed
about. Both take at most one step a letter, so that a region of two words of n letters is known after 4n
steps, and the n² sums outside it are never formed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...model.precision import EPS

__all__ = ["Region", "trace"]


@dataclass(frozen=True, slots=True)
class Region:
    """The pairs (i, j) with |A_i − B_j| ≤ μ.

    Attributes
    ----------
    first, last
        Per i from 0 to the length of the first word: the first j of the region and the last one; where first
        is more than last there is none.
    lower, upper
        The nodes that the pointer passes, as (i, j), in order.
    """

    first: tuple[int, ...]
    last: tuple[int, ...]
    lower: tuple[tuple[int, int], ...] = ()
    upper: tuple[tuple[int, int], ...] = ()


def trace(a: Sequence[float], b: Sequence[float], mu: float, keep: bool = False) -> Region:
    """Walk along both borders of the tolerance region.

    Parameters
    ----------
    a, b
        Running totals of the sizes of the letters, metres, both from 0.
    mu
        Tolerance μ, metres.
    keep
        Whether the walks are wanted too.
    """
    lower: list[tuple[int, int]] = []
    upper: list[tuple[int, int]] = []
    mu += EPS
    last = _border(a, b, mu, lower if keep else None)
    beyond = _border(b, a, mu, upper if keep else None)
    # `beyond[j]` is the last i whose total is at most B_j + μ: the first j that reaches i is found by merging.
    first: list[int] = []
    j = 0
    for i in range(len(a)):
        while j < len(b) and beyond[j] < i:
            j += 1
        first.append(j)
    return Region(tuple(first), tuple(last), tuple(lower), tuple((i, j) for j, i in upper))


def _border(
    a: Sequence[float], b: Sequence[float], mu: float, walk: list[tuple[int, int]] | None
) -> list[int]:
    """Per i the last j with B_j − A_i ≤ μ."""
    i = j = 0
    last: list[int] = []
    while True:
        if walk is not None:
            walk.append((i, j))
        inside = b[j] - a[i] <= mu
        if inside and j + 1 < len(b):
            j += 1
            continue
        last.append(j if inside else j - 1)
        i += 1
        if i == len(a):
            return last
