"""Partial alignments with lengths still open, bounded by a linear programme.

What a finished alignment costs, `pricing` finds by a linear programme over the lengths of its pieces. The same can be
asked of a partial one: its columns are priced as they will be, letters that have ended have their sizes, the letter
in hand has taken no more than its own, and the rest of each word is still to be laid, at the least that `remainder`
knows: W is what is laid plus what is to come, which is no shorter than the longest rest, and whoever is shorter makes
up for it. Whatever comes, the answer of the whole is no less.

That costs a fraction of a millisecond, so it is asked only where columns hold pieces whose lengths depend on each
other; and there it saves following columns that cost nothing as long as nobody asks for lengths.

Where an alignment is known that costs as much, with nothing but positive pieces, a partial one must be able to have
positive pieces at that cost too; otherwise nothing that begins like it can be better.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

import numpy as np

from ...model.sums import dot
from ..elements import Option
from ..group import Group
from ..linear_programme import FREE, solve_lp
from ..rules import fills, slope
from .halves import Half, Side

__all__ = ["Relaxation"]

_Linear = dict[int, float]
_SHORTEST = 1e-6
"""Pieces shorter than this are nothing, metres."""


class Relaxation:
    """The linear programme of one partial alignment.

    Attributes
    ----------
    value
        Lower bound of J of all alignments that begin like this, those of later groups left out; infinite where
        no lengths keep within the tolerances.
    """

    def __init__(self, side: Side, half: Half) -> None:
        self._low: list[float] = []
        self._high: list[float] = []
        self._cost: list[float] = []
        self._rows: list[_Linear] = []
        self._bounds: list[tuple[float, float]] = []
        self._constant = 0.0
        self._pieces: list[int] = []
        self._symbols: dict[str, int] = {}
        self._groups = side.groups
        self._side = side
        self._build(half)
        x = self._solve()
        self._x = x
        self.value = inf if x is None else self._constant + dot(np.array(self._cost), x)

    def positive(self) -> float:
        """The same where every piece has to be longer than nothing."""
        x = self._x
        if x is None:
            return inf
        if not self._pieces or min(x[p] for p in self._pieces) >= _SHORTEST:
            return self.value
        for p in self._pieces:
            self._low[p] = _SHORTEST
        x = self._solve()
        return inf if x is None else self._constant + dot(np.array(self._cost), x)

    def _variable(self, low: float = 0.0, high: float = FREE, cost: float = 0.0) -> int:
        self._low.append(low)
        self._high.append(high)
        self._cost.append(cost)
        return len(self._low) - 1

    def _add(self, row: _Linear, low: float, high: float) -> None:
        self._rows.append(row)
        self._bounds.append((low, high))

    def _solve(self) -> np.ndarray | None:
        n = len(self._low)
        rows = np.zeros((len(self._rows), n))
        for r, row in enumerate(self._rows):
            for v, coefficient in row.items():
                rows[r, v] = coefficient
        lower = np.array([*self._low, *(b[0] for b in self._bounds)])
        upper = np.array([*self._high, *(b[1] for b in self._bounds)])
        return solve_lp(np.array(self._cost), rows, upper, lower)

    def _symbol(self, name: str) -> int:
        found = self._symbols.get(name)
        if found is None:
            found = self._symbols[name] = self._variable()
            self._pieces.append(found)
        return found

    def _build(self, half: Half) -> None:
        taken: dict[tuple[int, int, int], list[int]] = {}
        widths: list[tuple[float, _Linear]] = [(0.0, {}) for _ in self._groups]
        laid = half.laid()
        for g, column in laid:
            group = self._groups[g]
            if not column.elastic:
                self._constant += column.cost
                constant, terms = widths[g]
                widths[g] = (constant + column.width, terms)
                continue
            sizes = [
                (option, *self._size(g, b, group, option, taken))
                for b, option in enumerate(column.options)
                if not option.empty
            ]
            high = self._price(group, sizes, sum(option.empty for option in column.options))
            widths[g][1][high] = 1.0
        for (g, b, i), pieces in taken.items():
            letter = self._groups[g].bands[b].letters[i]
            open_ = g == half.group and half.state[b] >> 2 == 2 * i + 1
            row = dict.fromkeys(pieces, 1.0)
            if letter.size is not None:
                self._add(row, -FREE if open_ else letter.size, letter.size)
            else:
                row[self._symbol(letter.symbol)] = -1.0
                self._add(row, -FREE if open_ else 0.0, 0.0)
        for g, group in enumerate(self._groups[: half.group + 1]):
            self._fit(group, *widths[g], self._future(half, taken) if g == half.group else None)

    def _size(
        self, g: int, b: int, group: Group, option: Option, taken: dict[tuple[int, int, int], list[int]]
    ) -> tuple[float, _Linear]:
        """The size of an element."""
        if option.size is not None:
            return option.size, {}
        band = group.bands[b]
        constant = 0.0
        terms: _Linear = {}
        for i in option.letters:
            letter = band.letters[i]
            cut = (i == option.letters[0] and not option.begins) or (
                i == option.letters[-1] and not option.ends
            )
            if cut:
                v = self._variable()
                self._pieces.append(v)
                taken.setdefault((g, b, i), []).append(v)
                terms[v] = 1.0
            elif letter.size is not None:
                constant += letter.size
            else:
                v = self._symbol(letter.symbol)
                terms[v] = terms.get(v, 0.0) + 1.0
        return constant, terms

    def _price(self, group: Group, sizes: Sequence[tuple[Option, float, _Linear]], empties: int) -> int:
        """ω, E and Λ of an elastic column; its largest size as a variable."""
        softs = [own for own in sizes if own[0].soft]
        filling = [own for own in sizes if fills(group, own[0])] or list(sizes)
        high = self._variable(0.0, FREE, slope(group, empties, len(softs)))
        low = self._variable(-FREE, FREE, -1.0)
        for _, constant, terms in sizes:
            if terms:
                self._add({high: 1.0, **{v: -c for v, c in terms.items()}}, constant, FREE)
            else:
                self._low[high] = max(self._low[high], constant)
        for _, constant, terms in filling:
            if terms:
                self._add({low: 1.0, **{v: -c for v, c in terms.items()}}, -FREE, constant)
            else:
                self._high[low] = min(self._high[low], constant)
        self._add({high: 1.0, low: -1.0}, -FREE, group.tolerance)
        self._constant += group.by_loose * (sum(own[0].loose for own in sizes) - sum(own[1] for own in softs))
        return high

    def _future(self, half: Half, taken: dict[tuple[int, int, int], list[int]]) -> int:
        """The width still to come in the group that is being read, as a variable; what it costs is added."""
        g = half.group
        group = self._groups[g]
        future, omega = self._variable(), self._variable()
        cost = self._variable(self._side.lattices[g].ahead(half.state), FREE, 1.0)
        weights = self._side.remainders[g].weights
        paid: _Linear = {cost: 1.0, omega: -1.0}
        for b, (band, position, weight) in enumerate(zip(group.bands, half.state, weights, strict=True)):
            i, cut = position >> 3, position & 4
            constant = 0.0
            rest: _Linear = {}
            for k in range(i, len(band.letters)):
                letter = band.letters[k]
                if letter.size is not None:
                    constant += letter.size
                elif letter.symbol in self._symbols or letter.symbol not in band.free:
                    v = self._symbol(letter.symbol)
                    rest[v] = rest.get(v, 0.0) + 1.0
                else:
                    weight = 0.0  # its rest may be as long as it likes
            if cut:
                for v in taken.get((g, b, i), ()):
                    rest[v] = rest.get(v, 0.0) - 1.0
            short = {future: 1.0, **{v: -c for v, c in rest.items()}}
            self._add(short, constant, FREE)
            if weight > 0:
                made_up = self._variable()
                self._add({**short, omega: -1.0, made_up: -1.0}, -FREE, constant)
                paid[made_up] = -weight
        if not group.objective.plain:
            self._add(paid, 0.0, FREE)
        return future

    def _fit(self, group: Group, constant: float, terms: _Linear, future: int | None) -> None:
        """W within the tolerance, and what it misses the canvas by."""
        row = dict(terms)
        if future is not None:
            row[future] = 1.0
        gap = group.canvas - constant
        if row:
            self._add(row, gap - group.tolerance, gap + group.tolerance)
        fit = group.objective.fit
        if fit:
            miss = self._variable(0.0, FREE, fit)
            self._add({miss: 1.0, **{v: -c for v, c in row.items()}}, -gap, FREE)
            self._add({miss: 1.0, **row}, gap, FREE)
