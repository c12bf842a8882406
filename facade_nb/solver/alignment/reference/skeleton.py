"""Where the columns of many rows can end: a lower bound for tall stacks.

Let x be what W has come to at a column's edge. A row that stands at letter p there has laid at most x and has
still to lay its rest, so that ``prefix(p) <= x <= W - rest(p)``: a row with nothing to spare stays in step. The edges
of an alignment, its *skeleton*, can therefore only lie where every row has a letter boundary within its slack
W − R; on consistent façades these are few places. How large W may get follows from the limit that the
cost has to keep: each metre that a row falls short of W is paid for.

Between two edges the rows choose their elements independently of each other, once ω is given. So the
least cost of a column between any two places is a minimum over ω of a sum over rows, and a shortest path over places
is a lower bound of J. Only one thing is relaxed: that a row stands at the same letter on both sides of an edge.
Places are gathered into *cells*, intervals of x. Rows with elastic letters are left out, which makes the bound smaller.

All of it holds for alignments that cost no more than the limit, and only for them.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from itertools import pairwise
from math import inf

import numpy as np
from numpy.typing import NDArray

from ... import tuning
from ...model.precision import EPS
from ..bands import Band
from ..group import Group

__all__ = ["Skeleton", "greatest_width"]

_Array = NDArray[np.float64]


def greatest_width(group: Group, limit: float) -> float:
    """The largest W of an alignment that costs at most `limit` (see `reference.shortfall`)."""
    top = group.canvas + group.tolerance
    rests = sorted(
        (band.rest_max[0], weight) for band, weight in zip(group.bands, group.weights, strict=True)
    )
    width = max((band.rest_min[0] for band in group.bands), default=0.0)
    fit = group.objective.fit

    def cost(w: float) -> float:
        return fit * max(0.0, w - group.canvas) + sum(k * (w - rest) for rest, k in rests if rest < w)

    turns = [width, *(t for t in sorted({group.canvas, *(r for r, _ in rests)}) if width < t < top), top]
    for a, b in pairwise(turns):
        high = cost(b)
        if high > limit:
            low = cost(a)
            if low > limit:
                return a
            return a + (b - a) * (limit - low) / (high - low) + EPS
    return top


class Skeleton:
    """The bound of one group at one limit.

    Attributes
    ----------
    root
        No alignment within the limit costs less; infinite where there is none.
    width
        The largest W there can be.
    """

    def __init__(self, group: Group, limit: float, check: Callable[[], None] | None = None) -> None:
        self._group, self._limit, self._check = group, limit, check
        objective, share = group.objective, group.share
        self._by_empty, self._by_loose = objective.empty * share, objective.loose * share
        self.width = greatest_width(group, limit)
        self._bands = [band for band in group.bands if not any(a.transparent for a in band.letters)]
        self._prefix = [np.array([band.rest_min[0] - r for r in band.rest_min]) for band in self._bands]
        self.root = inf
        self._lows: list[float] = []
        self._highs: list[float] = []
        self._rest: list[float] = []
        self._build()

    def ahead(self, low: float, high: float) -> float:
        """What is still to be paid by a path whose W so far lies between two values."""
        n = bisect_right(self._lows, high + EPS) - 1
        best = inf
        while n >= 0 and self._highs[n] >= low - EPS:
            best = min(best, self._rest[n])
            n -= 1
        return best

    # Making it -----------------------------------------------------------------------------------------

    def _build(self) -> None:
        """From coarse to fine: cells that no alignment within the limit can use are dropped, the others are split."""
        size = self._group.canvas / tuning.SKELETON_COARSE
        low, high = self._places(size)
        end_low, end_high = self._ends(size)
        for _ in range(tuning.SKELETON_ROUNDS):
            if self._check is not None:
                self._check()
            if not end_low.size:
                self.root = inf
                return
            through, rest = self._walk(low, high, end_low, end_high)
            self.root = float(rest[0])
            keep = through <= self._limit + EPS
            m = low.size
            low, high, kept = low[keep[1 : m + 1]], high[keep[1 : m + 1]], keep[m + 1 :]
            end_low, end_high = end_low[kept], end_high[kept]
            self._cells = [
                cell for cell, k in zip(self._all[1 : m + 1], keep[1 : m + 1].tolist(), strict=True) if k
            ]
            if self.root > self._limit + EPS:
                self.root = inf
                return
            if low.size + end_low.size > tuning.SKELETON_CELLS // 2:
                break
            self.width = min(self.width, float(end_high.max()))
            low, high = self._split(low, high)
            end_low, end_high = _halves(end_low, end_high)
        cells = self._cells
        self._lows = [c[0] for c in cells]
        self._highs = [c[1] for c in cells]
        self._rest = [c[2] for c in cells]

    def _walk(self, low: _Array, high: _Array, end_low: _Array, end_high: _Array) -> tuple[_Array, _Array]:
        """Per cell (the start, those between, the ends): least cost of an alignment through it, and of the rest."""
        m = low.size
        cell_low = np.concatenate([[0.0], low, end_low])
        cell_high = np.concatenate([[0.0], high, end_high])
        total = cell_low.size
        first, last = self._windows(cell_low, cell_high, m)
        i, j = np.triu_indices(total, 1)
        i, j = i[i <= m], j[i <= m]
        table = np.full((total, total), inf)
        table[i, j] = self._columns(i, j, cell_low, cell_high, first, last)
        rest = np.full(total, inf)
        canvas, fit = self._group.canvas, self._group.objective.fit
        rest[m + 1 :] = fit * np.maximum(0.0, np.maximum(end_low - canvas, canvas - end_high))
        for k in range(m, -1, -1):
            rest[k] = float(np.min(table[k, k + 1 :] + rest[k + 1 :], initial=inf))
        laid = np.full(total, inf)
        laid[0] = 0.0
        for k in range(1, total):
            laid[k] = float(np.min(laid[: min(k, m + 1)] + table[: min(k, m + 1), k], initial=inf))
        self._all = list(zip(cell_low.tolist(), cell_high.tolist(), rest.tolist(), strict=True))
        return laid + rest, rest

    def _places(self, size: float) -> tuple[_Array, _Array]:
        """Cells of x at which every row has a letter boundary, without the ends."""
        return _cells(self._runs([(0.0, self.width)]), size)

    def _runs(self, runs: list[tuple[float, float]]) -> list[tuple[float, float]]:
        for band, prefix in zip(self._bands, self._prefix, strict=True):
            slack = self.width - band.rest_min[0]
            own: list[tuple[float, float]] = []
            for s in prefix.tolist():
                if own and s <= own[-1][1] + EPS:
                    own[-1] = (own[-1][0], s + slack)
                else:
                    own.append((s, s + slack))
            runs = _meet(runs, own)
        return runs

    def _split(self, low: _Array, high: _Array) -> tuple[_Array, _Array]:
        a, b = _halves(low, high)
        return a, b

    def _ends(self, size: float) -> tuple[_Array, _Array]:
        """Cells of W."""
        least = max((band.rest_min[0] for band in self._group.bands), default=0.0)
        if least > self.width + EPS:
            return np.empty(0), np.empty(0)
        canvas = self._group.canvas
        turns = [least, *([canvas] if least < canvas < self.width else []), max(least, self.width)]
        return _cells(list(pairwise(turns)), size)

    def _windows(
        self, low: _Array, high: _Array, m: int
    ) -> tuple[list[NDArray[np.intp]], list[NDArray[np.intp]]]:
        """Per row, per cell: the first and the last letter it may stand at."""
        first: list[NDArray[np.intp]] = []
        last: list[NDArray[np.intp]] = []
        for band, prefix in zip(self._bands, self._prefix, strict=True):
            slack = self.width - band.rest_min[0]
            a = np.searchsorted(prefix, low - slack - 1e-9)
            z = np.searchsorted(prefix, high + 1e-9, side="right") - 1
            a[0] = z[0] = 0
            a[m + 1 :] = z[m + 1 :] = len(band.letters)
            first.append(a)
            last.append(z)
        return first, last

    def _columns(
        self,
        i: NDArray[np.intp],
        j: NDArray[np.intp],
        low: _Array,
        high: _Array,
        first: Sequence[NDArray[np.intp]],
        last: Sequence[NDArray[np.intp]],
    ) -> _Array:
        """Least cost of a column from cell i to cell j."""
        least, most = np.maximum(0.0, low[j] - high[i]), high[j] - low[i]
        steps = np.concatenate(
            [[0.0, 1e-8], np.linspace(0.0, min(self._limit, self._group.tolerance), tuning.SKELETON_BINS)[1:]]
        )
        total = np.zeros((steps.size, i.size))
        at = np.arange(i.size)
        for band, prefix, a, z in zip(self._bands, self._prefix, first, last, strict=True):
            ai, zi, aj, zj = a[i], z[i], a[j], z[j]
            if float(np.mean((zi - ai + 1) * (zj - aj + 1))) > tuning.SKELETON_WINDOW**2:
                continue
            own = np.full((steps.size + 1, i.size), inf)
            own[0] = np.where((np.minimum(zi, zj) >= np.maximum(ai, aj)), self._by_empty * least, inf)
            loose = _looseness(band)
            softs = np.concatenate([[0], np.cumsum([not letter.opaque for letter in band.letters])])
            for dp in range(int(np.max(zi - ai)) + 1):
                p = ai + dp
                for dq in range(int(np.max(zj - aj)) + 1):
                    q = aj + dq
                    fine = (p <= zi) & (q <= zj) & (q > p)
                    if not fine.any():
                        continue
                    p_, q_ = np.minimum(p, zi), np.minimum(q, zj)
                    size = prefix[q_] - prefix[p_]
                    fine &= size <= most + 1e-9
                    inner = loose[np.maximum(q_ - 1, 0)] - loose[p_]
                    price = self._by_loose * inner
                    short = np.maximum(0.0, least - size)
                    soft = softs[q_] > softs[p_]
                    price = np.where(soft, price + self._by_loose * short, price)
                    need = np.where(soft, 0.0, short)
                    k = np.searchsorted(steps, need - 1e-9)
                    price = np.where(fine, price, inf)
                    own[k, at] = np.minimum(own[k, at], price)
            total += np.minimum.accumulate(own, axis=0)[: steps.size]
        floor = np.concatenate([[0.0], steps[:-1]])
        cheapest: _Array = np.min(total + floor[:, None], axis=0, initial=inf)
        return cheapest


def _looseness(band: Band) -> _Array:
    """Sum of the smaller of neighbouring sizes, up to the joint behind each letter."""
    sizes = [letter.size or 0.0 for letter in band.letters]
    joints = [min(a, b) for a, b in pairwise(sizes)]
    return np.concatenate([[0.0], np.cumsum(joints), [0.0]])


def _cells(runs: Sequence[tuple[float, float]], size: float) -> tuple[_Array, _Array]:
    """Intervals, cut into parts no longer than `size`."""
    lows: list[float] = []
    highs: list[float] = []
    for low, high in runs:
        parts = max(1, int(np.ceil((high - low) / size - 1e-6)))
        edges = np.linspace(low, high, parts + 1).tolist()
        lows += edges[:-1]
        highs += edges[1:]
    return np.array(lows), np.array(highs)


def _halves(low: _Array, high: _Array) -> tuple[_Array, _Array]:
    """Every interval cut in two; those that are a point stay one."""
    wide = high - low > 1e-6
    middle = (low + high) / 2.0
    a = np.concatenate([low, middle[wide]])
    b = np.concatenate([np.where(wide, middle, high), high[wide]])
    order = np.argsort(a, kind="stable")
    return a[order], b[order]


def _meet(a: Sequence[tuple[float, float]], b: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """What two lists of disjoint, growing intervals have in common."""
    out: list[tuple[float, float]] = []
    i = j = 0
    while i < len(a) and j < len(b):
        low, high = max(a[i][0], b[j][0]), min(a[i][1], b[j][1])
        if low <= high + EPS:
            out.append((low, max(low, high)))
        if a[i][1] < b[j][1]:
            i += 1
        else:
            j += 1
    return out
