"""The best way to cut spines alike, among all that sizes of the symbols can make.

A *cut* says how many letters of each spine stand before a boundary. An alignment is a chain of cuts from the bottom to
the top; its cost is a sum over its columns. Chains are searched best first, and what is still to come is bounded by the
cheapest rest, known for every cut beforehand.

Two things keep the search small, and neither loses an answer. Each design by itself allows a boundary only some heights
(`Reach`): cuts and columns on whose heights the designs do not agree are left out. A chain whose cuts no sizes make
together is tried once, and the cuts that are to blame are kept: no chain with all of them is tried again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import count, pairwise
from math import inf, prod
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..solver.alignment.bands import Band
from ..solver.alignment.elements import Option, Position
from ..solver.alignment.group import Group
from ..solver.alignment.pricing import Columns, Priced, price
from ..solver.budget import Stopped
from ..solver.effort import Effort
from .pairs import PairTable, Spine, fitting, part_of, together

__all__ = ["Cut", "Ways", "priced"]

T = TypeVar("T")
Cut = tuple[int, ...]
Floats = NDArray[np.float64]

_GRID = 2_000_000
"""So many cuts are looked at, and so many of them may be left (`_CUTS`); else the search is too large."""

_CUTS = 6_000

_BLOCK = 128
"""So many cuts are looked at together."""

_TIES = 64
"""So many alignments of the least cost are sized; the best of them is taken."""

_EPS = 1e-9
_SLACK = 1e-6


@dataclass
class Ways:
    """All ways to cut the spines of a group alike.

    Attributes
    ----------
    spines
        Of the group's bands.
    tables
        Of all pairs of them.
    """

    group: Group
    spines: Sequence[Spine]
    tables: Mapping[tuple[int, int], PairTable]
    check: Effort
    limit: float = field(default=-inf, init=False)
    """Alignments that cost more are left out; nothing is looked at before it is set (`open`)."""
    _cuts: NDArray[np.int64] = field(init=False)
    _rest: Floats = field(init=False)
    _nexts: dict[int, tuple[NDArray[np.int64], Floats, Floats]] = field(default_factory=dict, init=False)
    _blamed: list[frozenset[int]] = field(default_factory=list, init=False)
    _queue: list[tuple[float, int, tuple[int, ...], float, int]] = field(default_factory=list, init=False)
    _ticks: Iterator[int] = field(default_factory=count, init=False)

    def __post_init__(self) -> None:
        self._least = self._through(np.zeros((1, len(self.spines)), np.int64)).item()

    @property
    def floor(self) -> float:
        """No alignment that is left costs less; infinite without any."""
        if self.limit == -inf:
            return self._least
        return self._queue[0][0] if self._queue else inf

    def open(self, limit: float) -> bool:
        """Be ready to look at all alignments within a limit; False: there are too many."""
        self.limit = limit
        if not self._agreed():
            return False
        self._look_ahead()
        self._push(self._base + float(self._rest[0]), (0,), 0.0, 0)
        return True

    def _through(self, cuts: NDArray[np.int64]) -> Floats:
        """What alignments through some cuts cost at least."""
        least = fitting(self.group, self.spines)[0]
        return least + part_of(len(self.spines)) * together(self.tables, cuts)

    def _agreed(self) -> bool:
        """The cuts on whose height the designs agree and that may be of use, from the bottom to the top."""
        counts = [len(band.letters) for band in self.group.bands]
        if prod(n - 1 for n in counts if n > 1) > _GRID:
            return False
        inner = np.stack(np.meshgrid(*(np.arange(1, n) for n in counts), indexing="ij"), -1)
        inner = inner.reshape(-1, len(counts))
        low = np.max([own.reach.low[0, inner[:, b]] for b, own in enumerate(self.spines)], axis=0)
        high = np.min([own.reach.high[0, inner[:, b]] for b, own in enumerate(self.spines)], axis=0)
        inner = inner[low <= high + _SLACK]
        inner = inner[self._through(inner) <= self.limit + _EPS]
        if len(inner) > _CUTS:
            return False
        self._cuts = np.concatenate([np.zeros((1, len(counts)), np.int64), inner, [counts]])
        fit, canvas = self.group.objective.fit, self.group.canvas
        # W is the sum of the largest in each column: above the canvas whatever the columns, or maybe not
        self._sign = 1.0 if max(own.sizes[-1] for own in self.spines) >= canvas else -1.0
        self._base = -self._sign * fit * canvas
        self._sizes = np.stack([own.sizes[self._cuts[:, b]] for b, own in enumerate(self.spines)], 1)
        return True

    def _costs(self, rows: slice) -> Floats:
        """What the column between some cuts and every other one costs at least; infinite: there is none."""
        cuts, group = self._cuts, self.group
        cost = np.zeros((len(cuts[rows]), len(cuts)))
        later = np.ones(cost.shape, bool)
        low, high = np.zeros(cost.shape), np.full(cost.shape, inf)
        small, large = np.full(cost.shape, inf), np.zeros(cost.shape)
        for b, own in enumerate(self.spines):
            reach, loose = own.reach, own.loose
            start, end = cuts[rows, b, None], cuts[None, :, b]
            later &= end > start
            low = np.maximum(low, reach.low[start, end])
            high = np.minimum(high, reach.high[start, end])
            size = self._sizes[None, :, b] - self._sizes[rows, b, None]
            small, large = np.minimum(small, size), np.maximum(large, size)
            cost += group.by_loose * (loose[end - 1] - loose[start])
        omega = large - small
        cost += omega + self._sign * group.objective.fit * large
        cost[~(later & (low <= high + _SLACK) & (omega <= group.tolerance + _EPS))] = inf
        return cost

    def _look_ahead(self) -> None:
        """What comes after each cut costs at least this."""
        count = len(self._cuts)
        self._rest = np.full(count, inf)
        self._rest[-1] = 0.0
        for start in range((count - 2) // _BLOCK * _BLOCK, -1, -_BLOCK):
            self.check()
            cost = self._costs(slice(start, min(start + _BLOCK, count - 1)))
            for k in range(len(cost) - 1, -1, -1):
                self._rest[start + k] = (cost[k] + self._rest).min()

    def _following(self, k: int) -> tuple[NDArray[np.int64], Floats, Floats]:
        """The cuts that may follow one, the cheapest whole first; what the column costs, and what with all after it."""
        if k not in self._nexts:
            cost = self._costs(slice(k, k + 1))[0]
            whole = cost + self._rest
            after = np.argsort(whole, kind="stable")
            after = after[whole[after] < inf]
            self._nexts[k] = after, cost[after], whole[after]
        return self._nexts[k]

    def advance(self, fits: Callable[[Priced], T | None], limit: float) -> list[T]:
        """What `fits` makes of further alignments; none that costs more than `limit` is looked at.

        Alignments come in the order of their cost. As soon as some are taken, the search is over, once all that are as
        cheap as the first have been tried.
        """
        goal = len(self._cuts) - 1
        found = list[T]()
        while self._queue and len(found) < _TIES:
            floor, _, path, spent, rank = self._queue[0]
            if floor > limit:
                break
            self.check()
            heappop(self._queue)
            if path[-1] == goal:
                own = self._made(path, fits)
                if own is not None:
                    limit = min(limit, floor + _EPS)
                    found.append(own)
                continue
            after, cost, whole = self._following(path[-1])
            if rank >= len(after):
                continue
            if rank + 1 < len(after):
                self._push(self._base + spent + float(whole[rank + 1]), path, spent, rank + 1)
            longer, so_far = (*path, int(after[rank])), spent + float(cost[rank])
            if longer[-1] == goal:
                complete = self._priced(longer)
                if complete is not None:
                    self._push(max(floor, complete.cost), longer, so_far, 0)
            else:
                try:
                    possible = self._can_be(longer, fits)
                except Stopped:
                    self._push(floor, path, spent, rank)
                    raise
                if possible:
                    self._push(floor, longer, so_far, 0)
        return found

    def _push(self, floor: float, path: tuple[int, ...], spent: float, rank: int) -> None:
        heappush(self._queue, (floor, next(self._ticks), path, spent, rank))

    def _can_be(self, path: tuple[int, ...], fits: Callable[[Priced], T | None]) -> bool:
        """Whether sizes can make the boundaries of a chain that has begun; where not, which of them are to blame."""
        own = frozenset(path)
        if any(blamed <= own for blamed in self._blamed):
            return False
        if not self._fails(path, fits):
            return True
        blamed = path
        for cut in path[1:-1]:
            self.check()
            fewer = tuple(k for k in blamed if k != cut)
            if self._fails(fewer, fits):
                blamed = fewer
        self._blamed.append(frozenset(blamed[1:]))
        return False

    def _fails(self, path: tuple[int, ...], fits: Callable[[Priced], T | None]) -> bool:
        begun = self._priced((*path, len(self._cuts) - 1))
        return begun is not None and fits(begun) is None

    def _made(self, path: tuple[int, ...], fits: Callable[[Priced], T | None]) -> T | None:
        own = self._priced(path)
        return None if own is None else fits(own)

    def _priced(self, path: Sequence[int]) -> Priced | None:
        return priced(self.group, [self._cut(k) for k in path])

    def _cut(self, k: int) -> Cut:
        return tuple(int(n) for n in self._cuts[k])


def priced(group: Group, cuts: Sequence[Cut]) -> Priced | None:
    """The alignment with some boundaries; None: its columns are out of tolerance."""
    rows = [list(_elements(band, [cut[b] for cut in cuts])) for b, band in enumerate(group.bands)]
    columns: Columns = tuple(zip(*rows, strict=True))
    return price([group], (columns,))


def _elements(band: Band, stops: Sequence[int]) -> Iterator[Option]:
    """The elements of a spine between its boundaries."""
    position: Position = 0
    for start, end in pairwise(stops):
        option = next(o for o in band.options(position) if o.letters == tuple(range(start, end)))
        position = option.target
        yield option
