"""The default alignment search: best first, exact, and resumable.

Paths leave a queue by their lower bound; a complete one is priced and goes back with its exact J. What
leaves the queue priced is optimal, because everything else there has a bound that is no better.

The search advances to a limit and stops there, so that the searches of many candidates can take turns
(`axis`): none is taken further than the best of them needs. Columns dearer than the limit allows are not
made, which is what keeps the exponentially many bad ones from being looked at; a path whose columns were
not all made is parked, and taken up again when the limit has grown.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from heapq import heappop, heappush
from itertools import count
from math import inf

from ... import tuning
from ...model.precision import EPS
from ..found import Found
from ..group import Group
from ..observer import PathObserver
from ..pricing import Priced, price
from .dominance import Seen
from .network import Network, ceiling
from .paths import Path

__all__ = ["BestFirst"]


_GRID = 1e10
"""Bounds are rounded to a part of a metre that is less than what tells costs apart."""


class BestFirst:
    """A best-first search of one network.

    Parameters
    ----------
    informed
        Whether what is to come is bounded; if not, only what is laid counts.
    table
        Whether paths that come to one node are compared, and the dearer dropped.

    Attributes
    ----------
    found
        Ties and lower bound so far; where `done`, the ties are all there is to know.
    done
        The optimum is known, or there is none.
    turn
        After so many paths it pauses.
    """

    def __init__(
        self,
        groups: Sequence[Group],
        *,
        keep: int = 8,
        nodes: int = 1_000_000,
        check: Callable[[], None] | None = None,
        accept: Callable[[Priced], bool] | None = None,
        log: PathObserver | None = None,
        turn: float = inf,
        informed: bool = True,
        table: bool = True,
    ) -> None:
        self.network = Network(groups, check, informed=informed)
        self._table = table
        self.turn = turn
        self.paused = False
        self.log = log
        self.keep, self.nodes, self.check, self.accept = keep, nodes, check, accept
        self.found = Found(bound=self.network.later[0])
        self.done = self.found.bound == inf
        self._ceiling = ceiling(groups)
        self._serial = count()
        self._seen = Seen(self.network, keep)
        self._queue: list[tuple[float, bool, int, int, Path | Priced]] = []
        self._parked: list[tuple[float, Path]] = []
        self._horizon = min((group.tolerance for group in groups), default=inf)
        if not self.done:
            self._push(self.found.bound, self.network.root())

    def _push(self, bound: float, item: Path | Priced, *, late: bool = False) -> None:
        # Equal costs come in one order, whatever the last digits are that an addition has left.
        if bound < inf:
            bound = round(bound * _GRID) / _GRID
        heappush(self._queue, (bound, late, -item.columns, next(self._serial), item))

    def advance(self, limit: float) -> None:
        """Go on until the optimum is known, or is known to cost more than `limit`, or it is the turn of others.

        Then the search is `paused`, and has to be taken up again with the same limit.
        """
        found, queue = self.found, self._queue
        if self.done or limit < found.bound - EPS:
            return
        if not self.paused and not self._prepare(limit):
            return
        self.paused = False
        pause = found.nodes + self.turn
        while queue:
            bound = queue[0][0]
            if bound > limit + EPS or (found.ties and bound > found.ties[0].cost + EPS):
                break
            if found.nodes >= pause:
                self.paused = True
                return
            _, late, _, _, item = heappop(queue)
            if not found.ties:
                found.bound = max(found.bound, bound)
            if isinstance(item, Priced):
                if self.accept is None or self.accept(item):
                    found.offer(item, self.keep)
                    limit = min(limit, item.cost)
                continue
            if item.dropped or (late and found.best is not None and found.best.proper):
                continue
            found.nodes += 1
            if self.check is not None:
                self.check()
            if found.nodes >= self.nodes:
                found.cut = self.done = True
                return
            if self.log is not None:
                self.log.node(item, bound)
            if self.network.complete(item):
                priced = price(self.network.groups, self.network.structure(item))
                if self.log is not None:
                    self.log.price(item, priced)
                if priced is not None:
                    self._push(priced.cost, priced)
            elif self.network.tall:
                self._expand_a_little(item, bound, limit)
            else:
                self._expand(item, -inf, limit)
        if found.ties:
            self.done = True
        else:
            self._nothing_within(limit)

    def _prepare(self, limit: float) -> bool:
        """Take up what a lesser limit left aside; whether there is anything to search."""
        if self.log is not None:
            self.log.limit(limit, self.found.bound)
        if self.network.tall:
            if not self.network.bind(limit):
                self._nothing_within(limit)
                return False
            self._begin_again(binds=limit > self._horizon)
        elif not self.network.binds and limit > self._horizon:
            self._begin_again(binds=True)
        parked, self._parked = self._parked, []
        for made, path in parked:
            if not path.dropped:
                self._expand(path, made, limit)
        return True

    def _nothing_within(self, limit: float) -> None:
        if limit >= self._ceiling:
            self.done = True
            self.found.bound = inf
        else:
            self.found.bound = max(self.found.bound, limit)

    def _begin_again(self, *, binds: bool) -> None:
        """Start anew: the bounds hold for another limit, or the tolerance may bind from here on."""
        self.network.binds = binds
        self._seen = Seen(self.network, self.keep)
        self._queue.clear()
        self._parked.clear()
        self._push(self.network.later[0], self.network.root())

    def _expand(self, path: Path, made: float, limit: float) -> None:
        """Make the columns that a limit allows and an earlier one, `made`, did not."""
        for bound, child in self.network.children(path, made, limit):
            self._take(bound, child)
        self._parked.append((limit, path))

    def _expand_a_little(self, path: Path, bound: float, limit: float) -> None:
        """Make only the columns that come next by their bound: of many rows there are too many to make them all.

        The path goes back into the queue to wait for its turn to make more.
        """
        step = path.step or tuning.TALL_STEP * self.network.groups[path.group].canvas
        upto = min(limit, max(bound, path.made) + step)
        for least, child in self.network.children(path, path.made, upto):
            if least <= limit + EPS:
                self._take(least, child)
        path.made, path.step = upto, 2.0 * step
        if upto < limit:
            self._push(upto, path)

    def _take(self, bound: float, child: Path) -> None:
        drops = self.accept is None and self._table and self._seen.drops(child)
        if self.log is not None:
            self.log.edge(child, bound, drops)
        if not drops:
            self._push(bound, child, late=child.late)
