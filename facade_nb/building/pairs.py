"""What spines cost at least when they are cut alike, from what each two of them cost.

Of k numbers the largest and the smallest differ by at least 1/⌊k²/4⌋ of the sum of all differences between two of them.
So the columns of k spines cost at least that part of what the columns of all pairs cost, and the cheapest way to cut
two spines is soon found, up to every cut and from every cut on.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from math import inf

import numpy as np
from numpy.typing import NDArray

from ..solver.alignment.group import Group
from .reaches import Reach

__all__ = ["PairTable", "Spine", "fitting", "pair_table", "part_of", "together"]

Floats = NDArray[np.float64]

_SLACK = 1e-6
_EPS = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Spine:
    """The letters of a spine.

    Attributes
    ----------
    sizes
        (n + 1,) their preferred sizes, summed.
    loose
        (n + 1,) what neighbours have loose that stand in one column, summed.
    """

    sizes: Floats
    loose: Floats
    reach: Reach

    @classmethod
    def of(cls, letters: Sequence[float], reach: Reach) -> Spine:
        """Of letters with these sizes."""
        loose = [0.0, *(min(pair) for pair in pairwise(letters)), 0.0]
        return cls(np.cumsum([0.0, *letters]), np.cumsum(loose)[: len(letters) + 1], reach)

    @staticmethod
    def all(same: Sequence[Spine]) -> Spine:
        """One spine that stands in several designs: what all of them allow."""
        if len(same) == 1:
            return same[0]
        low = np.max([own.reach.low for own in same], axis=0)
        high = np.min([own.reach.high for own in same], axis=0)
        return Spine(same[0].sizes, same[0].loose, Reach(low, high))


@dataclass(frozen=True, slots=True, eq=False)
class PairTable:
    """The cheapest ways to cut two spines alike.

    Attributes
    ----------
    before, after
        (n + 1, m + 1): up to a cut, and from it on; infinite where there is none.
    """

    before: Floats
    after: Floats


def part_of(spines: int) -> float:
    """What part of the costs of all pairs so many spines cost at least."""
    return 1.0 / max(spines * spines // 4, 1)


def fitting(group: Group, spines: Sequence[Spine]) -> tuple[float, float]:
    """What spines cost at least for not filling the canvas, and what a metre of ω costs then."""
    fit, canvas = group.objective.fit, group.canvas
    whole = max(float(own.sizes[-1]) for own in spines)
    # Columns make W larger than the longest spine by no more than their ω.
    return fit * abs(whole - canvas), 1.0 - fit if whole < canvas else 1.0


def pair_table(a: Spine, b: Spine, omega: float, loose: float, tolerance: float) -> PairTable:
    """The cheapest ways to cut two spines, at so much a metre of difference, and of looseness."""
    n, m = len(a.sizes), len(b.sizes)
    at = np.stack(np.meshgrid(np.arange(n), np.arange(m), indexing="ij"), -1).reshape(-1, 2)
    start, end = (at[:, None, 0], at[:, None, 1]), (at[None, :, 0], at[None, :, 1])
    one = a.sizes[end[0]] - a.sizes[start[0]]
    other = b.sizes[end[1]] - b.sizes[start[1]]
    differ = np.abs(one - other)
    cost = omega * differ
    cost = cost + loose * (a.loose[end[0] - 1] - a.loose[start[0]] + b.loose[end[1] - 1] - b.loose[start[1]])
    low = np.maximum(a.reach.low[start[0], end[0]], b.reach.low[start[1], end[1]])
    high = np.minimum(a.reach.high[start[0], end[0]], b.reach.high[start[1], end[1]])
    good = (end[0] > start[0]) & (end[1] > start[1]) & (low <= high + _SLACK) & (differ <= tolerance + _EPS)
    cost[~good] = inf
    count = len(at)
    before, after = np.full(count, inf), np.full(count, inf)
    before[0] = after[-1] = 0.0
    for k in range(1, count):
        before[k] = (before + cost[:, k]).min()
    for k in range(count - 2, -1, -1):
        after[k] = (after + cost[k]).min()
    return PairTable(before.reshape(n, m), after.reshape(n, m))


def together(tables: Mapping[tuple[int, int], PairTable], cuts: NDArray[np.int64]) -> Floats:
    """What alignments through some cuts (c, k) cost at least in all pairs of spines."""
    found = np.zeros(len(cuts))
    for i, j in combinations(range(cuts.shape[1]), 2):
        table = tables[i, j]
        at = cuts[:, i], cuts[:, j]
        found += table.before[at] + table.after[at]
    return found
