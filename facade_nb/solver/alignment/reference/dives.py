"""Good alignments soon: anytime column search (Vadlamudi et al. 2012) over the alignment decision network.

The exact search may take long where many rows have to agree. Dives go through the network from its first
column to its last and take up, at each depth, the best path that is waiting there. So each gives an alignment, or frees
the way for the next one, and what was passed over is taken up by a later dive. An answer bounds what need be looked
for, and lower bounds that hold below an answer become sharper with it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from heapq import heappop, heappush
from itertools import count
from math import inf

from ... import tuning
from ...model.precision import EPS
from ..bands import Band
from ..group import Group
from ..pairs import PairTable
from ..pricing import Priced, price
from .network import Network, ceiling
from .paths import Path

__all__ = ["Dives"]


class _BothWays:
    """The least cost of aligning the reference and one other word through two positions."""

    def __init__(self, group: Group, reference: Band, other: Band) -> None:
        self._ahead = PairTable(reference, other, group.objective, group.share, 1)
        self._behind = PairTable(_turned(reference), _turned(other), group.objective, group.share, 1)
        self._ends = 2 * len(reference.letters), 2 * len(other.letters)
        self.least = self._ahead.at(0, 0)

    def through(self, reference: int, other: int) -> float:
        """What has to be paid before and after."""
        a, b = reference >> 2, other >> 2
        return self._ahead.row(a << 2)[b] + self._behind.row((self._ends[0] - a) << 2)[self._ends[1] - b]


def _turned(band: Band) -> Band:
    return Band(
        tuple(reversed(band.letters)), band.rows, cuts=band.cuts, free=band.free, origins=(), check=band.check
    )


def _both_ways(group: Group) -> list[_BothWays | None]:
    if group.reference is None:
        return []
    reference = group.bands[group.reference]
    return [
        None if b == group.reference else _BothWays(group, reference, band)
        for b, band in enumerate(group.bands)
    ]


class Dives:
    """Dives into the network of some groups.

    A path's place in the queue of its depth is its bound and by how much its rows, two by two, leave their
    own best alignments with the reference.

    Parameters
    ----------
    least
        Lower bound of J: alignments not much dearer are looked for first.
    accept
        Says whether a structure will do. If there is one, it is taken to refuse what cannot be sized.

    Attributes
    ----------
    best
        The best alignment so far.
    done
        There is no better one.
    """

    def __init__(
        self,
        groups: Sequence[Group],
        least: float,
        check: Callable[[], None] | None = None,
        accept: Callable[[Priced], bool] | None = None,
    ) -> None:
        tall = any(group.tall for group in groups)
        plain = any(group.objective.plain for group in groups)  # there next to every column costs nothing
        self.network = Network(groups, check, most=tuning.DIVE_COLUMNS if tall or plain else inf)
        self.network.sizable = accept is not None
        self.check, self._accept = check, accept
        self.best: Priced | None = None
        self.done = self.network.later[0] == inf
        self._canvas = max(group.canvas for group in groups)
        self._ceiling = ceiling(groups)
        self._serial = count()
        self._limit = max(least, self.network.later[0])
        self._waiting: list[list[tuple[float, int, float, Path]]] = []
        self._idle = 0
        self._pairs = [_both_ways(group) for group in groups]
        if not self.done:
            self._widen()

    def dive(self) -> bool:
        """Go through the network once; whether a better alignment was found."""
        if self.done:
            return False
        if self._idle >= tuning.DIVE_PATIENCE or not any(self._waiting):
            if self.best is not None or self._limit >= self._ceiling:
                self.done = not any(self._waiting)
            else:
                self._widen()
            self._idle = 0
        found = False
        for waiting in self._waiting:
            found = self._go_deeper(waiting) or found
        self._idle = 0 if found else self._idle + 1
        if found:
            self._begin()
        return found

    def offer(self, priced: Priced) -> None:
        """An alignment that is known already: only cheaper ones are looked for."""
        self.best = priced
        self._limit = priced.cost - 2 * EPS
        self._begin()

    def _go_deeper(self, waiting: list[tuple[float, int, float, Path]]) -> bool:
        """Take up the first path that waits at a depth; whether it ends in a better alignment."""
        while waiting:
            _, _, bound, path = heappop(waiting)
            if bound > self._limit + EPS:
                continue
            if self.check is not None:
                self.check()
            if self.network.complete(path):
                return self._take(path)
            if self._go_on(path, bound):
                break
        return False

    def _widen(self) -> None:
        self._limit = min(self._ceiling, self._limit * 1.3 + 0.01 * self._canvas)
        self._begin()

    def _begin(self) -> None:
        """Everything anew, below the limit."""
        self._waiting = [[] for _ in range(tuning.DIVE_DEPTHS * len(self.network.groups) + 1)]
        if self.network.bind(self._limit):
            self._push(self.network.later[0], self.network.root())

    def _push(self, bound: float, path: Path) -> None:
        rank = bound + self._strays(path)
        heappush(self._waiting[self._depth(path)], (rank, next(self._serial), bound, path))

    def _strays(self, path: Path) -> float:
        """By how much the rows, two by two, leave their own best alignments with the reference."""
        if self.network.complete(path):
            return 0.0
        reference = self.network.groups[path.group].reference
        if reference is None:
            return 0.0
        place = path.state[reference]
        return sum(
            pair.through(place, position) - pair.least
            for pair, position in zip(self._pairs[path.group], path.state, strict=True)
            if pair is not None
        )

    def _depth(self, path: Path) -> int:
        groups = self.network.groups
        if self.network.complete(path):
            return tuning.DIVE_DEPTHS * len(groups)
        bands = groups[path.group].bands
        done = sum((p >> 2) / (2 * max(1, len(b.letters))) for b, p in zip(bands, path.state, strict=True))
        return path.group * tuning.DIVE_DEPTHS + min(
            tuning.DIVE_DEPTHS - 1, int(tuning.DIVE_DEPTHS * done / len(bands))
        )

    def _go_on(self, path: Path, bound: float) -> bool:
        """Make the columns that raise the bound least; the path waits for its turn to make more."""
        network, step = self.network, path.step or tuning.DIVE_STEP * self._canvas
        while True:
            upto = min(self._limit, max(bound, path.made) + step)
            children = network.children(path, path.made, upto)
            path.made, step = upto, 2.0 * step
            if children or upto >= self._limit:
                break
        for least, child in children:
            self._push(least, child)
        path.step = step
        if upto < self._limit:
            self._push(upto, path)
        return bool(children)

    def _take(self, path: Path) -> bool:
        priced = price(self.network.groups, self.network.structure(path))
        if priced is None or priced.cost > self._limit + EPS:
            return False
        if self._accept is not None and not self._accept(priced):
            return False
        self.best = priced
        self._limit = priced.cost - 2 * EPS
        return True
