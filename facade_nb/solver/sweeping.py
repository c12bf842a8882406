"""Good alignments of many rows without wildcards, at once.

To begin with, each row's letters are given a place, say, from the left. Columns can then end at any of these places,
each row with the letter that ends next to it, and the cheapest columns are a shortest path over places. A sweep takes
each row out and lays it back in where it costs least, given where all others stand, again a shortest path, over columns
and letters; empty columns stand between the others, for letters that fit in none. Then neighbouring columns are joined
wherever that makes J less. From where the letters stand now all begins anew, until nothing changes.

Nothing is proven by it: it is what there is while the exact search goes on, and what that need not exceed. J is
counted as in SPEC 3, but while a row is laid, W's distance from the canvas is taken to grow as it does without the row.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from math import inf

import numpy as np
from numpy.typing import NDArray

from .columns import EPS, Group, Option
from .pricing import Priced, Structure, price

__all__ = ["can_sweep", "sweeps"]

_Floats = NDArray[np.float64]
_Cuts = NDArray[np.intp]

_PLACES = 160
"""Places closer than this part of the canvas count as one."""
_ELEMENTS = 300_000
"""With more elements than this between places, wide columns are not looked at to begin with."""
_SWEEPS = 12
_LETTERS = 60
"""Words of more letters take too long: there are as many ways to lay one as the cube of its length."""


def can_sweep(groups: Sequence[Group]) -> bool:
    """Whether there is one group, of several words without transparent letters and not too long.

    And an objective of more than Ω.
    """
    return (
        len(groups) == 1
        and len(groups[0].bands) > 1
        and max(len(band.letters) for band in groups[0].bands) <= _LETTERS
        and not groups[0].objective.plain
        and not any(letter.transparent for band in groups[0].bands for letter in band.letters)
    )


def sweeps(group: Group, check: Callable[[], None] | None = None) -> Iterator[Priced]:
    """Alignments that keep all constraints, each cheaper than the one before. `check` may raise `Stopped`."""
    table = _Table(group, check)
    best = inf
    starts = [table.between(ends) for ends in table.starts()]
    for cuts in sorted(starts, key=table.cost):
        cost = inf
        while True:
            cuts = table.settled(cuts)
            now = table.cost(cuts)
            if now >= cost - EPS:
                break
            cost = now
            structure = _structure(group, cuts) if now < best - EPS else None
            priced = None if structure is None else price([group], structure)
            if priced is not None and priced.cost < best - EPS:
                best = priced.cost
                yield priced
            cuts = table.between(table.ends(cuts))


class _Table:
    """Sizes and prices of every run of letters of every row; `cuts[b, j]` is the letter that column j begins with."""

    def __init__(self, group: Group, check: Callable[[], None] | None) -> None:
        self.group, self.check = group, check
        objective, share = group.objective, group.share
        self.by_empty, self.by_loose = objective.empty * share, objective.loose * share
        self.size: list[_Floats] = []
        self.loose: list[_Floats] = []
        self.soft: list[NDArray[np.bool_]] = []
        for band in group.bands:
            sizes = [letter.size or 0.0 for letter in band.letters]
            ends = np.concatenate([[0.0], np.cumsum(sizes)])
            joints = np.concatenate([[0.0], np.cumsum([min(a, b) for a, b in pairwise(sizes)]), [0.0]])
            softs = np.concatenate([[0], np.cumsum([not letter.opaque for letter in band.letters])])
            n = len(sizes) + 1
            p, q = np.arange(n)[:, None], np.arange(n)[None, :]
            self.size.append(np.where(q > p, ends[None, :] - ends[:, None], 0.0))
            inner = joints[np.maximum(np.arange(n) - 1, 0)][None, :] - joints[:, None]
            self.loose.append(np.where(q > p, inner, 0.0))
            self.soft.append((q > p) & (softs[None, :] > softs[:, None]))

    def settled(self, cuts: _Cuts) -> _Cuts:
        """Columns that neither a sweep nor joining them makes cheaper."""
        cuts = self._joined(cuts)
        cost = self.cost(cuts)
        for _ in range(_SWEEPS):
            wide = self._with_gaps(cuts)
            for b in range(len(self.size)):
                wide[b] = self._laid(wide, b)
            wide = self._joined(wide)
            now = self.cost(wide)
            if now >= cost - EPS:
                break
            cuts, cost = wide, now
        return cuts

    def starts(self) -> Iterator[list[_Floats]]:
        """Where the letters of each row may end, to begin with.

        Rows begin at the left, end at the right, stand in the middle; or fill the longest one's length, or the canvas.
        """
        longest = max(float(own[0, -1]) for own in self.size)
        for part in (0.0, 1.0, 0.5):
            yield [own[0] + part * (longest - own[0, -1]) for own in self.size]
        for length in (longest, self.group.canvas):
            yield [own[0] * (length / own[0, -1] if own[0, -1] > 0 else 1.0) for own in self.size]

    def ends(self, cuts: _Cuts) -> list[_Floats]:
        """Where the letters of each row end in these columns, if they begin at the left of theirs."""
        lefts = np.concatenate([[0.0], np.cumsum(self._columns(cuts)[1])])
        out: list[_Floats] = []
        for own, row in zip(self.size, cuts, strict=True):
            ends = own[0].copy()
            for j in range(len(row) - 1):
                ends[row[j] : row[j + 1]] += lefts[j] - own[0, row[j]]
            ends[row[-1] :] = lefts[-1]
            out.append(ends)
        return out

    def between(self, ends: Sequence[_Floats]) -> _Cuts:
        """The cheapest columns between positions near which rows have boundaries, which are at `ends`."""
        every = np.unique(np.concatenate(ends))
        canvas = self.group.canvas
        cells = np.unique(np.round(every / (canvas / _PLACES)).astype(int), return_index=True)[1]
        places = every[cells]
        at = np.stack([_nearest(own, places) for own in ends])
        at[:, 0] = 0
        at[:, -1] = [len(own) - 1 for own in ends]
        m = at.shape[1]
        i, j = np.triu_indices(m, 1)
        keep = places[j] - places[i] <= places[-1] * min(1.0, _ELEMENTS / (len(i) * len(at)))
        keep |= (i == 0) & (j == m - 1)
        i, j = i[keep], j[keep]
        cost = np.full((m, m), inf)
        cost[i, j] = self._columns_between(at, i, j)
        reached = np.full(m, inf)
        reached[0] = 0.0
        came = np.zeros(m, dtype=np.intp)
        for k in range(1, m):
            through = reached[:k] + cost[:k, k]
            came[k] = int(np.argmin(through))
            reached[k] = through[came[k]]
        chosen = [m - 1]
        while chosen[-1] > 0:
            chosen.append(int(came[chosen[-1]]))
        return at[:, chosen[::-1]]

    @staticmethod
    def _with_gaps(cuts: _Cuts) -> _Cuts:
        """An empty column before, between and behind all others."""
        return np.repeat(cuts, 2, axis=1)

    def _elements(
        self, begin: _Cuts, end: _Cuts
    ) -> tuple[_Floats, _Floats, NDArray[np.bool_], NDArray[np.bool_]]:
        """Per row and column: size, looseness, holds a letter that is not opaque, holds any."""
        rows = range(len(begin))
        size = np.stack([self.size[b][begin[b], end[b]] for b in rows])
        loose = np.stack([self.loose[b][begin[b], end[b]] for b in rows])
        soft = np.stack([self.soft[b][begin[b], end[b]] for b in rows])
        return size, loose, soft, end > begin

    def _price(
        self,
        high: _Floats,
        low: _Floats,
        empties: _Floats,
        loose: _Floats,
        softs: _Floats,
        soft_sizes: _Floats,
        backed: NDArray[np.bool_],
    ) -> _Floats:
        """ω + empty·E + loose·Λ of columns; infinite where C1 or the tolerance forbids them."""
        omega = np.maximum(0.0, high - low)
        cost: _Floats = (
            omega + self.by_empty * empties * high + self.by_loose * (loose + softs * high - soft_sizes)
        )
        forbidden = omega > self.group.tolerance + EPS
        if not self.group.waived:
            forbidden |= ((empties > 0) | (softs > 0)) & ~backed
        return np.where(high > 0, np.where(forbidden, inf, cost), 0.0)

    def _columns(self, cuts: _Cuts) -> tuple[_Floats, _Floats]:
        """Cost and width of each column."""
        return self._priced(*self._elements(cuts[:, :-1], cuts[:, 1:]))

    def _columns_between(self, cuts: _Cuts, i: _Cuts, j: _Cuts) -> _Floats:
        """Cost of the columns from some boundaries to others."""
        return self._priced(*self._elements(cuts[:, i], cuts[:, j]))[0]

    def _priced(
        self, size: _Floats, loose: _Floats, soft: NDArray[np.bool_], some: NDArray[np.bool_]
    ) -> tuple[_Floats, _Floats]:
        rest = np.min(np.where(some & ~soft, size, inf), axis=0)
        low = np.where(rest < inf, rest, np.min(np.where(some, size, inf), axis=0))
        high = np.max(size, axis=0)
        cost = self._price(
            high,
            np.where(low < inf, low, 0.0),
            np.sum(~some, axis=0).astype(float),
            np.sum(loose, axis=0),
            np.sum(soft, axis=0).astype(float),
            np.sum(np.where(soft, size, 0.0), axis=0),
            np.any(some & ~soft, axis=0),
        )
        return cost, high

    def cost(self, cuts: _Cuts) -> float:
        """J of the whole."""
        if np.any(cuts[:, -1] < [own.shape[0] - 1 for own in self.size]):
            return inf
        cost, width = self._columns(cuts)
        total = float(np.sum(width))
        canvas, mu = self.group.canvas, self.group.tolerance
        if abs(total - canvas) > mu + EPS:
            return inf
        return float(np.sum(cost)) + self.group.objective.fit * abs(total - canvas)

    def _laid(self, cuts: _Cuts, b: int) -> _Cuts:
        """Where a row costs least, given all others: the shortest path from its first letter through all columns."""
        if self.check is not None:
            self.check()
        others = [o for o in range(len(cuts)) if o != b]
        placed = [o for o in others if cuts[o, -1] == self.size[o].shape[0] - 1]
        size, loose, soft, some = self._elements(cuts[:, :-1], cuts[:, 1:])
        size, loose, soft, some = size[placed], loose[placed], soft[placed], some[placed]
        high = np.max(size, axis=0, initial=0.0)[:, None, None]
        rest = np.min(np.where(some & ~soft, size, inf), axis=0, initial=inf)[:, None, None]
        least = np.min(np.where(some, size, inf), axis=0, initial=inf)[:, None, None]
        empties = np.sum(~some, axis=0).astype(float)[:, None, None]
        own_size, own_loose, own_soft = self.size[b][None], self.loose[b][None], self.soft[b][None]
        n = own_size.shape[1]
        own_some = np.triu(np.ones((n, n), dtype=bool), 1)[None]
        top = np.maximum(high, own_size)
        firm = np.minimum(rest, np.where(own_some & ~own_soft, own_size, inf))
        low = np.where(firm < inf, firm, np.minimum(least, np.where(own_some, own_size, inf)))
        costs = self._price(
            top,
            np.where(low < inf, low, 0.0),
            empties + ~own_some,
            np.sum(loose, axis=0)[:, None, None] + own_loose,
            np.sum(soft, axis=0)[:, None, None] + own_soft.astype(float),
            np.sum(np.where(soft, size, 0.0), axis=0)[:, None, None] + np.where(own_soft, own_size, 0.0),
            np.any(some & ~soft, axis=0)[:, None, None] | (own_some & ~own_soft),
        )
        over = float(np.sum(high)) > self.group.canvas
        costs = costs + (1.0 if over else -1.0) * self.group.objective.fit * (top - high)
        costs = np.where(np.tril(np.ones((n, n), dtype=bool), -1)[None], inf, costs)
        reached = np.full(n, inf)
        reached[0] = 0.0
        came: list[_Cuts] = []
        for j in range(costs.shape[0]):
            through = reached[:, None] + costs[j]
            came.append(np.argmin(through, axis=0))
            reached = np.min(through, axis=0)
        out: _Cuts = cuts[b]
        if reached[-1] == inf:
            return out
        out = np.empty(costs.shape[0] + 1, dtype=np.intp)
        out[-1] = n - 1
        for j in range(costs.shape[0] - 1, -1, -1):
            out[j] = came[j][out[j + 1]]
        return out

    def _joined(self, cuts: _Cuts) -> _Cuts:
        """The same without empty columns, and with those joined that cost less as one."""
        cuts = cuts[:, np.concatenate([[True], np.any(cuts[:, 1:] > cuts[:, :-1], axis=0)])]
        while cuts.shape[1] > 2:
            cost, width = self._columns(cuts)
            together, wide = self._priced(*self._elements(cuts[:, :-2], cuts[:, 2:]))
            over = float(np.sum(width)) > self.group.canvas
            fit = (1.0 if over else -1.0) * self.group.objective.fit
            gain = cost[:-1] + cost[1:] - together - fit * (wide - width[:-1] - width[1:])
            gain = np.where(np.isnan(gain), -inf, gain)
            best = int(np.argmax(gain))
            if not gain[best] > EPS:
                break
            cuts = np.delete(cuts, best + 1, axis=1)
        return cuts


def _nearest(ends: _Floats, places: _Floats) -> _Cuts:
    """For each place the nearest of some growing numbers."""
    right = np.clip(np.searchsorted(ends, places), 1, len(ends) - 1)
    left_is_nearer = places - ends[right - 1] <= ends[right] - places
    out: _Cuts = right - left_is_nearer
    return out


def _structure(group: Group, cuts: _Cuts) -> Structure | None:
    """The options that these elements are; None where C3 or C4 forbids one."""
    state = list(group.start)
    columns: list[tuple[Option, ...]] = []
    for j in range(cuts.shape[1] - 1):
        column: list[Option] = []
        for b, band in enumerate(group.bands):
            letters = tuple(range(int(cuts[b, j]), int(cuts[b, j + 1])))
            found = next((o for o in band.options(state[b]) if o.letters == letters), None)
            if found is None:
                return None
            column.append(found)
            state[b] = found.target
        if any(o.guarded and any(column[g].soft for g in group.guards[b]) for b, o in enumerate(column)):
            return None
        columns.append(tuple(column))
    if any(position >> 3 != len(band.letters) for position, band in zip(state, group.bands, strict=True)):
        return None
    return (tuple(columns),)
