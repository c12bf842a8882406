"""Values of many counters at once whose words have about a given size.

A word's size is a sum of what each counter adds to it, so that the sums that the last counters can make are known
beforehand, on a grid: how many ways there are to make each. Values are then enumerated without dead ends, and the
window around the canvas that holds so many words as are wanted is found without looking for them.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Mapping, Sequence
from itertools import accumulate
from math import inf, prod
from random import Random

import numpy as np

from .. import tuning

__all__ = ["Sums"]

_NEAR = 1e-9


class Sums:
    """The sums that can be made of one number from each of several tables.

    Parameters
    ----------
    tables
        Per name: possible values, each with the metres it adds (0 or more).
    limit
        Metres; larger sums are left out.
    """

    def __init__(
        self,
        tables: Mapping[str, Sequence[tuple[int, float]]],
        limit: float,
        check: Callable[[], None] | None = None,
    ) -> None:
        self._check = check
        self._limit = limit
        self._fixed = {name: table[0][0] for name, table in tables.items() if len(table) == 1}
        self._base = sum(table[0][1] for table in tables.values() if len(table) == 1)
        open_ones = [name for name in tables if name not in self._fixed]
        self._names = sorted(open_ones, key=lambda name: max((own for _, own in tables[name]), default=0.0))[
            ::-1
        ]
        self._tables = [sorted(tables[name], key=_metres) for name in self._names]
        self._cell = max(limit, _NEAR) / tuning.SUM_CELLS
        # where there are few sums, dead ends cost less than knowing them
        few = prod(map(len, self._tables)) <= tuning.SUM_FEW
        self._up_to = None if few else self._counted()

    def _counted(self) -> list[list[float]]:
        """Per table: how many sums of it and those after it there are up to each cell, about."""
        counts = np.zeros(tuning.SUM_CELLS + 2)
        counts[0] = 1.0
        found = [list(accumulate(counts.tolist(), initial=0.0))]
        for table in reversed(self._tables):
            after, counts = counts, np.zeros(tuning.SUM_CELLS + 2)
            for _, size in table:
                if self._check is not None:
                    self._check()
                shift = int(size / self._cell)
                if shift <= tuning.SUM_CELLS + 1:
                    counts[shift:] += after[: tuning.SUM_CELLS + 2 - shift]
            found.append(list(accumulate(counts.tolist(), initial=0.0)))
        return found[::-1]

    def _about(self, k: int, low: float, high: float) -> float:
        """How many sums of the tables from k on lie between two sizes, about; 0 only where there is none."""
        if self._up_to is None:
            return 1.0
        tables = len(self._tables) - k
        first = min(max(0, int(low / self._cell) - tables - 1), tuning.SUM_CELLS + 2) if low > 0 else 0
        last = min(int(high / self._cell) + 1, tuning.SUM_CELLS + 1) if high > -self._cell else -1
        return self._up_to[k][last + 1] - self._up_to[k][first] if last >= first else 0.0

    def within(
        self, low: float, high: float, most: float = inf
    ) -> tuple[list[tuple[float, dict[str, int]]], bool]:
        """Sums between two sizes, each with the values that make it, and whether these are all.

        With `most`, no more than that are looked for.
        """
        found: list[tuple[float, dict[str, int]]] = []
        chosen: list[int] = [0] * len(self._tables)
        high = min(high, self._limit)
        names, tables, check, about = self._names, self._tables, self._check, self._about
        fixed = self._fixed
        last = len(tables) - 1

        def descend(k: int, size: float) -> bool:
            if k == len(tables):
                if low - _NEAR <= size <= high + _NEAR:
                    found.append((size, {**fixed, **dict(zip(names, chosen, strict=True))}))
                return len(found) <= most
            if check is not None:
                check()
            table = tables[k]
            # no need to look at those that are too small
            first = bisect_left(table, low - size - _NEAR, key=_metres) if k == last else 0
            for index in range(first, len(table)):
                value, own = table[index]
                total = size + own
                if total > high + _NEAR:
                    break
                if about(k + 1, low - total - _NEAR, high - total + _NEAR):
                    chosen[k] = value
                    if not descend(k + 1, total):
                        return False
            return True

        complete = descend(0, self._base)
        return found, complete

    def nearest(
        self, canvas: float, low: float, most: int
    ) -> tuple[list[tuple[float, dict[str, int]]], float]:
        """About `most` sums that are nearest to the canvas, and no less than `low`.

        Returns
        -------
        sums
            With their values, in no particular order.
        left
            Every sum that is left out misses the canvas by at least so many metres; infinite where none is.
        """
        if self._up_to is None:
            found, _ = self.within(low, self._limit)
            found.sort(key=lambda own: abs(own[0] - canvas))
            return found[:most], abs(found[most][0] - canvas) if len(found) > most else inf
        everything = max(canvas - max(0.0, low), self._limit - canvas)
        window = (
            everything
            if self._about(0, low - self._base, self._limit - self._base) <= most
            else self._window(canvas, most)
        )
        found, complete = self._around(canvas, window, low, most)
        if not complete:  # so many about one size
            found, window = [], self._cell / 2.0
            while not found and window < 2.0 * everything:
                found = self.some(max(low, canvas - window), canvas + window, most)
                window *= 4.0
            return found, 0.0
        while len(found) < max(1, most // 4) and window < everything:
            more, complete = self._around(canvas, 2.0 * window, low, most)
            if not complete and not found:
                return self.some(max(low, canvas - 2.0 * window), canvas + 2.0 * window, most), window
            if not complete:
                break
            found, window = more, 2.0 * window
        found.sort(key=lambda own: abs(own[0] - canvas))
        if len(found) > most:
            return found[:most], abs(found[most][0] - canvas)
        return found, inf if window >= everything else window

    def _around(
        self, canvas: float, window: float, low: float, most: int
    ) -> tuple[list[tuple[float, dict[str, int]]], bool]:
        return self.within(max(low, canvas - window), canvas + window, 4 * most)

    def some(self, low: float, high: float, most: int) -> list[tuple[float, dict[str, int]]]:
        """Sums between two sizes, no more than `most`, with values as different as can be. The same every time."""
        shuffle = Random(0).shuffle
        tables = [list(table) for table in self._tables]
        for table in tables[:-1]:
            shuffle(table)
        last = len(tables) - 1
        found: list[tuple[float, dict[str, int]]] = []
        chosen: list[int] = [0] * len(tables)

        def descend(k: int, size: float, quota: int) -> int:
            if k == len(tables):
                inside = low - _NEAR <= size <= high + _NEAR
                if inside:
                    found.append((size, {**self._fixed, **dict(zip(self._names, chosen, strict=True))}))
                return int(inside)
            if self._check is not None:
                self._check()
            made = 0
            table = tables[k]
            first, entries = 0, len(table)
            if k == last:
                first = bisect_left(table, low - size - _NEAR, key=_metres)
                entries = bisect_left(table, high - size + 2 * _NEAR, key=_metres) - first
            turn = 7919 * len(found) % max(1, entries)  # each time begins elsewhere
            for n in range(entries):  # in place: a copy of a long table, once for each sum, takes minutes
                value, own = table[first + (turn + n) % entries]
                total = size + own
                if total <= high + _NEAR and self._about(k + 1, low - total - _NEAR, high - total + _NEAR):
                    chosen[k] = value
                    made += descend(k + 1, total, -((made - quota) // (entries - n)))
                    if made >= quota:
                        break
            return made

        descend(0, self._base, most)
        return found

    def _window(self, canvas: float, most: int) -> float:
        """A window around the canvas with about `most` sums in it."""
        low, high = 0.0, max(canvas, self._limit - canvas)
        centre = canvas - self._base
        for _ in range(20):
            middle = (low + high) / 2.0
            if self._about(0, centre - middle, centre + middle) > most:
                high = middle
            else:
                low = middle
        return max(high, self._cell)


def _metres(entry: tuple[int, float]) -> float:
    return entry[1]
