"""Where the letters of each row stand: what columns cost, and laying one row where it costs least, given the others.

A row is at a *spot* at each boundary between columns: before a letter, or within a transparent one that is cut there.
So an alignment is a matrix of spots, one row per band, one column per boundary. In a column between two spots stands a
run of solid letters, or pieces of transparent ones, or nothing.

J is counted as in docs/problem.md, but for this: pieces take whatever is left for them, and a transparent letter that
is to have a size pays 1 a metre by which the columns it spans miss that. What a structure really costs says
`pricing.price`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from math import inf

import numpy as np

from ... import tuning
from ...model.precision import EPS
from ..elements import Option
from ..group import Group
from ..rules import occluded
from .runs import Bools, Cuts, Floats, Row, Sum

__all__ = ["Table", "with_gaps", "without_gaps"]

_NEVER = 1e6
"""Instead of infinity, where sums are taken apart again."""


class Table:
    """What runs of letters of every row cost together; `cuts[b, j]` is the spot of row b at boundary j."""

    def __init__(self, group: Group, check: Callable[[], None] | None = None) -> None:
        self.group, self._check = group, check
        objective, share = group.objective, group.share
        self._by_empty, self._by_loose = objective.empty * share, objective.loose * share
        self._rows = [Row(band) for band in group.bands]
        most = max((row.last + 1 for row in self._rows), default=1)
        shape = (len(self._rows), most, most)
        numbers, flags = np.zeros((7, *shape)), np.zeros((3, *shape), dtype=bool)
        self._elements = Sum(*numbers, *flags)
        for b, row in enumerate(self._rows):
            row.elements = row.elements.within(self._elements.at(b))
        self._sized: list[list[tuple[int, float]]] = [[] for _ in self._rows]
        self.wild = [b for b, row in enumerate(self._rows) if row.wild]
        self.rigid = [b for b, row in enumerate(self._rows) if not row.wild and row.last > 0]
        solid = [float(row.elements.high.max(initial=0.0)) for row in self._rows]
        self.order = [*self.rigid, *sorted(self.wild, key=lambda b: -solid[b])]
        self.assume({})

    def assume(self, unsized: Mapping[str, float]) -> None:
        """Give unsized symbols a size, where not each one can have its own."""
        self._sized = [
            row.sized(band, unsized) for row, band in zip(self._rows, self.group.bands, strict=True)
        ]
        if not self.rigid:  # then some row has to say how wide the columns of its placeholders are
            first = self.order[0]
            self._rows[first].fill(self.group.bands[first], dict(self._sized[first]), self.group.canvas)

    def starts(self) -> list[Cuts]:
        """Columns to begin with, of the rows without placeholders; of one row with some, where all have.

        Rows begin at the left, end at the right, stand in the middle; or fill the longest one's length, or the canvas.
        """
        if not self.rigid:
            first = self._rows[self.order[0]]
            cuts = np.zeros((len(self._rows), len(first.before)), dtype=np.intp)
            cuts[self.order[0]] = first.before
            return [cuts]
        rows = [self._rows[b].elements.high[0] for b in self.rigid]
        longest = max(float(own[-1]) for own in rows)
        ends = [[own + part * (longest - own[-1]) for own in rows] for part in (0.0, 1.0, 0.5)]
        for length in (longest, self.group.canvas):
            ends.append([own * (length / own[-1] if own[-1] > 0 else 1.0) for own in rows])
        starts = [self._between(dict(zip(self.rigid, own, strict=True))) for own in ends]
        return sorted(starts, key=self._so_far)

    def again(self, cuts: Cuts) -> Cuts:
        """Columns to begin with, from where the letters stand now."""
        lefts = np.concatenate([[0.0], np.cumsum(self._columns(cuts)[1])])
        return self._between(
            {b: self._ends(b, cuts[b], lefts) for b in self._laid(cuts) if self._rows[b].last}
        )

    def _ends(self, b: int, own: Cuts, lefts: Floats) -> Floats:
        """Where the letters of a row begin, and the last one ends, if solid ones begin at the left of their columns."""
        row = self._rows[b]
        size = row.elements.high[0][row.before]
        if not row.wild:
            ends = size.copy()
            for j in range(len(own) - 1):
                ends[own[j] : own[j + 1]] += lefts[j] - size[own[j]]
            ends[own[-1] :] = lefts[-1]
            return np.asarray(ends)
        band = self.group.bands[b]
        ends = np.zeros(len(row.before))
        ends[-1] = lefts[-1]
        for i, letter in enumerate(band.letters):
            # the column in which it begins
            j = max(0, int(np.searchsorted(own, row.before[i], "right")) - 1)
            first = int(row.letter[own[j]])
            before = sum(a.size or 0.0 for a in band.letters[first:i] if not a.transparent)
            after = i > 0 and not band.letters[i - 1].transparent
            ends[i] = (
                ends[i - 1] + (band.letters[i - 1].size or 0.0)
                if after and letter.transparent
                else lefts[j] + before
            )
        return np.asarray(np.maximum.accumulate(ends))

    def _between(self, ends: Mapping[int, Floats]) -> Cuts:
        """The cheapest columns between positions near which rows have boundaries, which are at `ends`."""
        every = np.unique(np.concatenate(list(ends.values())))
        canvas = self.group.canvas
        cells = np.unique(np.round(every / (canvas / tuning.PLACES)).astype(int), return_index=True)[1]
        places = every[cells]
        m = len(places)
        at = np.zeros((len(self._rows), m), dtype=np.intp)
        for b, own in ends.items():
            at[b] = self._rows[b].nearest(own, places, canvas / tuning.PLACES)
            at[b, 0], at[b, -1] = 0, self._rows[b].last
        i, j = np.triu_indices(m, 1)
        keep = places[j] - places[i] <= places[-1] * min(1.0, tuning.ELEMENTS / (len(i) * len(at)))
        keep |= (i == 0) & (j == m - 1)
        i, j = i[keep], j[keep]
        cost = np.full((m, m), inf)
        cost[i, j] = self._price(self._sum(at[:, i], at[:, j], list(ends)))
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

    def cost(self, cuts: Cuts) -> float:
        """J of the whole, about; infinite where a row is not laid yet."""
        if len(self._laid(cuts)) < len(self._rows):
            return inf
        return self._so_far(cuts)

    def _so_far(self, cuts: Cuts) -> float:
        """J of the rows that are laid."""
        cost, width = self._columns(cuts)
        total = float(np.sum(width))
        canvas, mu = self.group.canvas, self.group.tolerance
        if abs(total - canvas) > mu + EPS:
            return inf
        at = np.concatenate([[0.0], np.cumsum(width)])
        missed = 0.0
        for b, sized in enumerate(self._sized):
            before = self._rows[b].before
            for i, size in sized:
                begin = int(np.searchsorted(cuts[b], before[i], "right")) - 1
                end = int(np.searchsorted(cuts[b], before[i + 1], "left"))
                if end < cuts.shape[1]:
                    missed += abs(float(at[end] - at[begin]) - size)
        return float(np.sum(cost)) + self.group.objective.fit * abs(total - canvas) + missed

    def _laid(self, cuts: Cuts) -> list[int]:
        """The rows that are."""
        return [b for b, row in enumerate(self._rows) if cuts[b, -1] == row.last]

    def _sum(self, begin: Cuts, end: Cuts, rows: Sequence[int]) -> Sum:
        """What stands in columns between spots, of some rows."""
        which = np.array(rows, dtype=np.intp)[:, None]
        own = self._elements.at((which, begin[rows], end[rows]))
        return Sum(
            own.high.max(axis=0, initial=0.0),
            own.rest.min(axis=0, initial=inf),
            own.least.min(axis=0, initial=inf),
            *[field.sum(axis=0) for field in own[3:7]],
            *[field.any(axis=0) for field in own[7:]],
        )

    def _price(self, own: Sum) -> Floats:
        """ω + empty·E + loose·Λ of columns; infinite where C1 or the tolerance forbids them."""
        backed = own.rest < inf
        high = own.high
        least = np.where(own.elastic, high, np.where(own.least < inf, own.least, high))
        omega = np.maximum(0.0, high - np.where(backed, own.rest, least))
        cost: Floats = (
            omega
            + self._by_empty * own.empties * high
            + self._by_loose * (own.loose + own.softs * high - own.soft_sizes)
        )
        forbidden = omega > self.group.tolerance + EPS
        if not self.group.waived:
            forbidden |= ((own.empties > 0) | (own.softs > 0)) & ~backed
        return np.where(own.bad | (own.some & forbidden), inf, np.where(own.some, cost, 0.0))

    def _columns(self, cuts: Cuts) -> tuple[Floats, Floats]:
        """Cost and width of each column, of the rows that are laid."""
        own = self._sum(cuts[:, :-1], cuts[:, 1:], self._laid(cuts))
        return self._price(own), own.high

    def laid(self, cuts: Cuts, b: int, elsewhere: int | None = None) -> Cuts:
        """The same with a row where it costs least, given all others.

        A shortest path from its first letter through all columns, some of which a row with placeholders may join.
        `elsewhere` is a column in which it may not have the letters that it has there now.
        """
        if self._check is not None:
            self._check()
        return (self._with_placeholders if self._rows[b].wild else self._without)(cuts, b, elsewhere)

    def without(self, cuts: Cuts, j: int) -> Cuts:
        """Two neighbouring columns as one; rows that have both letters and pieces in it are laid again."""
        out = np.delete(cuts, j, axis=1)
        for b, row in enumerate(self._rows):
            if row.elements.bad[cuts[b, j - 1], cuts[b, j + 1]]:
                out[b] = 0
        for b in self.order:
            if out[b, -1] < self._rows[b].last:
                out = self.laid(out, b)
        return out

    def runs(self, cuts: Cuts, b: int) -> list[int]:
        """Columns in which a row has solid letters."""
        begin, end = cuts[b, :-1], cuts[b, 1:]
        return np.flatnonzero((end > begin) & ~self._rows[b].elements.elastic[begin, end]).tolist()

    def _fit(self, widths: Floats) -> float:
        """By how much W's distance from the canvas grows with a metre more."""
        return (1.0 if float(np.sum(widths)) > self.group.canvas else -1.0) * self.group.objective.fit

    def _without(self, cuts: Cuts, b: int, elsewhere: int | None) -> Cuts:
        """A row without placeholders."""
        others = self._sum(cuts[:, :-1], cuts[:, 1:], [o for o in self._laid(cuts) if o != b])
        columns = others.at((slice(None), None))
        last = self._rows[b].last
        ends, begins = np.tril_indices(last + 1)  # runs by where they end
        first = np.searchsorted(ends, np.arange(last + 1))
        no = np.zeros((), dtype=bool)
        own = self._rows[b].elements.at((begins, ends))._replace(elastic=no, bad=no)
        both = columns.plus(own)
        costs = self._price(both) + self._fit(others.high) * (both.high - columns.high)
        if elsewhere is not None:
            p, q = cuts[b, elsewhere : elsewhere + 2]
            costs[elsewhere, first[q] + p] = inf
        reached = [np.full(last + 1, inf)]
        reached[0][0] = 0.0
        for column in costs:
            reached.append(np.minimum.reduceat(reached[-1][begins] + column, first))
        if reached[-1][-1] == inf:
            return cuts
        out = cuts.copy()
        q = out[b, -1] = last
        for j in range(len(costs) - 1, -1, -1):
            q = out[b, j] = int(np.argmin(reached[j][: q + 1] + costs[j, first[q] : first[q] + q + 1]))
        return out

    def _with_placeholders(self, cuts: Cuts, b: int, elsewhere: int | None) -> Cuts:
        """A row with placeholders: each spans any number of columns, and columns may be joined for a run of letters."""
        row, band, m = self._rows[b], self.group.bands[b], cuts.shape[1] - 1
        n = len(band.letters)
        rows = [o for o in self._laid(cuts) if o != b]
        others = self._sum(cuts[:, :-1], cuts[:, 1:], rows)
        fit = self._fit(others.high)
        at = np.concatenate([[0.0], np.cumsum(others.high)])
        nothing = row.elements.at((0, 0))
        no, yes = np.zeros(()), np.ones((), dtype=bool)
        piece = nothing._replace(empties=no, some=yes, elastic=yes)
        empty = np.minimum(self._price(others.plus(nothing)), _NEVER)
        # a letter neither begins nor ends where nothing else stands (C1); between its pieces such a column is none
        pieces = np.where(
            others.some | self.group.waived, np.minimum(self._price(others.plus(piece)), _NEVER), 0.0
        )
        spanned = np.concatenate([[0.0], np.cumsum(pieces)])
        bare = np.where(others.some | self.group.waived, 0.0, _NEVER)
        # solid runs, in as many columns joined as there is time for
        most = max(1, min(m, tuning.SPANS // (m * (n + 1) ** 2 + 1)))
        i, j = np.triu_indices(m + 1, 1)
        near = np.flatnonzero(j - i <= most)
        near = near[np.lexsort((i[near], j[near]))]  # by where they end
        i, j = i[near], j[near]
        joined = self._sum(cuts[:, i], cuts[:, j], rows)
        own = row.elements.at(np.ix_(row.before, row.before))
        both = joined.at((slice(None), None, None)).plus(own.at(None))
        costs = self._price(both) + fit * (both.high - (at[j] - at[i])[:, None, None])
        costs = np.where(own.elastic | (own.empties > 0), inf, costs)
        if elsewhere is not None:
            p, q = row.letter[cuts[b, elsewhere : elsewhere + 2]]
            costs[(i <= elsewhere) & (j > elsewhere), p, q] = inf
        came = self._shortest(b, at, empty, spanned, bare, i, j, costs)
        if came is None:
            return cuts
        kept, spots = [m], [row.last]
        k, q = m, n
        while k > 0:
            begin, p = map(int, came[k, q])
            if q > p and band.letters[p].transparent:
                for inside in range(k - 1, begin, -1):
                    kept.append(inside)
                    spots.append(int(row.before[p]) + 1)
            kept.append(begin)
            spots.append(int(row.before[p]))
            k, q = begin, p
        out = cuts[:, kept[::-1]]
        out[b] = spots[::-1]
        return out

    def _shortest(
        self,
        b: int,
        at: Floats,
        empty: Floats,
        spanned: Floats,
        bare: Floats,
        i: Cuts,
        j: Cuts,
        costs: Floats,
    ) -> Cuts | None:
        """The shortest path of a row through columns and letters: per boundary and letter whence it comes, or None.

        Parameters
        ----------
        at, empty, spanned
            Where boundaries are; what a column costs with nothing of the row in it; up to each boundary, with pieces.
        bare
            What it costs if a letter begins or ends in a column.
        i, j, costs
            Boundaries between which columns are joined, by where they end, and the cost of runs of letters in these.
        """
        letters, m = self.group.bands[b].letters, len(at) - 1
        n = len(letters)
        sizes = dict(self._sized[b])
        held = np.array([p for p, letter in enumerate(letters) if letter.transparent])
        wanted = np.array([sizes.get(p, 0.0) for p in held.tolist()])
        strict = np.array([1.0 if p in sizes else 0.0 for p in held.tolist()])
        first, every = np.searchsorted(j, np.arange(m + 2)), np.arange(n + 1)
        reached = np.full((m + 1, n + 1), inf)
        reached[0, 0] = 0.0
        came = np.zeros((m + 1, n + 1, 2), dtype=np.intp)
        for k in range(1, m + 1):
            now, origin = reached[k], came[k]
            now[:] = reached[k - 1] + empty[k - 1]
            origin[:, 0], origin[:, 1] = k - 1, every
            these = slice(first[k], first[k + 1])
            through = (reached[i[these]][:, :, None] + costs[these]).reshape(-1, n + 1)
            which = through.argmin(axis=0)
            value = through[which, every]
            better = np.flatnonzero(value < now - EPS)
            now[better] = value[better]
            begins, letter = np.divmod(which[better], n + 1)
            origin[better, 0], origin[better, 1] = i[these][begins], letter
            missed = np.abs((at[k] - at[:k])[:, None] - wanted) * strict
            through = (
                reached[:k, held] + (spanned[k] - spanned[:k] + bare[:k] + bare[k - 1])[:, None] + missed
            )
            begins = through.argmin(axis=0)
            value = through[begins, np.arange(len(held))]
            better = np.flatnonzero(value < now[held + 1] - EPS)
            now[held[better] + 1] = value[better]
            origin[held[better] + 1, 0], origin[held[better] + 1, 1] = begins[better], held[better]
        return came if reached[m, n] < _NEVER else None

    def joined(self, cuts: Cuts) -> Cuts:
        """The same without empty columns, and with those joined that cost less as one, or where no letter ends."""
        cuts = without_gaps(cuts)
        rows = self._laid(cuts)
        while cuts.shape[1] > 2:
            cost, width = (np.minimum(own, _NEVER) for own in self._columns(cuts))
            both = self._sum(cuts[:, :-2], cuts[:, 2:], rows)
            fit = self._fit(width)
            gain = cost[:-1] + cost[1:] - self._price(both) - fit * (both.high - width[:-1] - width[1:])
            gain[self._idle(cuts, rows) & (gain > -_NEVER / 2)] += _NEVER
            best = int(np.argmax(gain))
            if not gain[best] > EPS:
                break
            cuts = np.delete(cuts, best + 1, axis=1)
        return cuts

    def _idle(self, cuts: Cuts, rows: Sequence[int]) -> Bools:
        """Whether no letter ends or begins at each inner boundary."""
        event = np.zeros(cuts.shape[1] - 2, dtype=bool)
        for b in rows:
            own = cuts[b]
            event |= ~self._rows[b].mid[own[1:-1]] & ((own[1:-1] > own[:-2]) | (own[2:] > own[1:-1]))
        return ~event

    def spots(self, columns: Sequence[Sequence[Option]]) -> Cuts:
        """Where rows stand at the boundaries of columns."""
        out = np.zeros((len(self._rows), len(columns) + 1), dtype=np.intp)
        for j, column in enumerate(columns, 1):
            for b, option in enumerate(column):
                out[b, j] = self._rows[b].before[option.target >> 3] + bool(option.target & 4)
        return out

    def structure(self, cuts: Cuts) -> tuple[tuple[Option, ...], ...] | None:
        """The options that these elements are; None where C3 or C4 forbids one, or a boundary is no letter's end."""
        group = self.group
        state = list(group.start)
        columns: list[tuple[Option, ...]] = []
        for j in range(cuts.shape[1] - 1):
            column: list[Option] = []
            for b, band in enumerate(group.bands):
                row, p, q = self._rows[b], int(cuts[b, j]), int(cuts[b, j + 1])
                mid = bool(row.mid[q])
                letters = tuple(range(int(row.letter[p]), int(row.letter[q]) + mid))
                found = next(
                    (o for o in band.options(state[b]) if o.letters == letters and bool(o.target & 4) == mid),
                    None,
                )
                if found is None:
                    return None
                column.append(found)
                state[b] = found.target
            if any(occluded(group, column)):
                return None
            columns.append(tuple(column))
        if any(position >> 3 != len(band.letters) for position, band in zip(state, group.bands, strict=True)):
            return None
        for left, right in pairwise(columns):
            if not any(o.ends for o in left) and not any(o.begins for o in right):
                return None
        return tuple(columns)


def with_gaps(cuts: Cuts) -> Cuts:
    """With an empty column before, between and behind all others, for letters that fit in none."""
    return np.repeat(cuts, 2, axis=1)


def without_gaps(cuts: Cuts) -> Cuts:
    """Without columns in which nothing stands."""
    return cuts[:, np.concatenate([[True], np.any(cuts[:, 1:] > cuts[:, :-1], axis=0)])]
