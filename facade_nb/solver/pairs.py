"""What two rows cost each other: a lower bound for alignments of many rows (the paper's pairwise hierarchy, 5.2).

Leave all rows but two out of an alignment, and the columns that are empty then: what remains aligns the
two, and every column costs no more than before. ω is a maximum over rows, and E and Λ are sums over them
with the same shares. So the least cost of aligning the rests of two rows, found once for each pair of
positions, bounds what any path has still to pay.

The constraints are left out, which only makes the bound smaller. Values are worked out when they are asked for.
"""

from __future__ import annotations

from collections.abc import Sequence

from .letters import Letter
from .objective import Objective

__all__ = ["PairTable"]


class PairTable:
    """Least ω + empty·E + loose·Λ of aligning the rests of two words of solid letters.

    Parameters
    ----------
    a, b
        The words; every letter has a size and none is transparent.
    share
        A row's share in E and Λ.
    """

    def __init__(self, a: Sequence[Letter], b: Sequence[Letter], objective: Objective, share: float) -> None:
        self._empty, self._loose = objective.empty * share, objective.loose * share
        self._plain = objective.plain
        self._runs = (_runs(a, self._loose), _runs(b, self._loose))
        self._ends = (len(a), len(b))
        self._known: dict[tuple[int, int], float] = {(len(a), len(b)): 0.0}

    def at(self, i: int, j: int) -> float:
        """The bound where letters i and j come next. Works from the end, so that it needs no recursion."""
        found = self._known.get((i, j))
        if found is None:
            for p in range(self._ends[0], i - 1, -1):
                for q in range(self._ends[1], j - 1, -1):
                    if (p, q) not in self._known:
                        self._known[p, q] = self._least(p, q)
            found = self._known[i, j]
        return found

    def _least(self, i: int, j: int) -> float:
        known, by_empty, by_loose, plain = self._known, self._empty, self._loose, self._plain
        runs_a, runs_b = self._runs[0][i], self._runs[1][j]
        best = float("inf")
        for end, size, own, _ in runs_a:  # b is empty
            value = by_empty * size + own
            if value >= best:
                break
            best = min(best, value + known[end, j])
        for end, size, own, _ in runs_b:
            value = by_empty * size + own
            if value >= best:
                break
            best = min(best, value + known[i, end])
        for end_a, size_a, own_a, soft_a in runs_a:
            if own_a >= best:
                break
            for end_b, size_b, own_b, soft_b in runs_b:
                over = size_b - size_a
                value = own_a + own_b
                if over > 0:  # a is the shorter: it is short by ω, or loose if it need not fill the column
                    value += over * by_loose if soft_a and not plain else over
                    if value >= best and not soft_a:
                        break
                elif over < 0:
                    value += -over * by_loose if soft_b and not plain else -over
                if value < best:
                    rest = value + known[end_a, end_b]
                    if rest < best:
                        best = rest
        return best


def _runs(word: Sequence[Letter], by_loose: float) -> list[list[tuple[int, float, float, bool]]]:
    """Per position the runs from there: (end, size, price of letters that share the element, holds a soft letter)."""
    out: list[list[tuple[int, float, float, bool]]] = []
    for i in range(len(word) + 1):
        runs: list[tuple[int, float, float, bool]] = []
        size = loose = 0.0
        soft = False
        for j in range(i, len(word)):
            own = word[j].size or 0.0
            if j > i:
                loose += min(own, word[j - 1].size or 0.0)
            size += own
            soft = soft or not word[j].opaque
            runs.append((j + 1, size, by_loose * loose, soft))
        out.append(runs)
    return out
