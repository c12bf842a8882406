"""The search of one cluster of groups: its turns, what helps it when it takes long, and what it has come to."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from math import inf

from .. import tuning
from ..alignment.core.binding import CompiledDives, CompiledSearch, best_first, dives
from ..alignment.found import Found
from ..alignment.group import Group
from ..alignment.heuristic.local_search import can_sweep, mended, polished, sweeps
from ..alignment.lone import lone
from ..alignment.observer import NetworkObserver, Observer
from ..alignment.paper.deepening import Ends
from ..alignment.paper.ida import search_ida
from ..alignment.pricing import Priced
from ..alignment.reference.best_first import BestFirst
from ..alignment.reference.dives import Dives
from ..budget import Stopped
from ..effort import Effort
from ..model.precision import EPS

__all__ = ["PLAINER", "GroupSearch"]


PLAINER = ("no-heuristic", "no-table")
"""The reference search without one of its parts: as exact, and slower. Lessons compare them."""


class GroupSearch:
    """The search of one cluster of groups, by either method, shared by all candidates that give it the same words.

    Among structures that are equally good, which come first depends on the limits that a search went through. So
    it goes through the same ones every time, each further from its lower bound by `STEP_GROWTH`. Where the best answer
    so far allows less than the next of them it goes no further than that; if it ends there with more answers than
    are kept, the search is repeated in steps. That makes an answer the same whatever was searched before.

    A search that takes long is helped by sweeps, and by dives, which take as long again. `spent` is its effort until
    now: it is counted (`effort`), so that what helps when is the same every time too.
    """

    def __init__(
        self,
        groups: Sequence[Group],
        method: str,
        nodes: int,
        check: Callable[[], None] | None,
        accept: Callable[[Priced], bool] | None,
        log: NetworkObserver | None = None,
        known: tuple[list[Priced], float] | None = None,
        fits: Callable[[Priced], bool] | None = None,
        strain: Callable[[Priced], float] | None = None,
    ) -> None:
        self.groups, self.log, self._fits, self._strain = groups, log, fits, strain
        self._plain = any(group.objective.plain for group in groups)
        self._effort = check if isinstance(check, Effort) else Effort(check)
        self._options = (method, nodes, self._effort, accept)
        self._first: BestFirst | CompiledSearch | None = None
        self._dives: Dives | CompiledDives | None = None
        self._ends: Ends | None = None
        self._sweeps = (
            sweeps(groups, Effort(self._effort, tuning.SWEPT), fits)
            if accept is None and can_sweep(groups)
            else None
        )
        self._swept: Priced | None = None
        self._was_swept = False
        self._slow = tuning.SLOW if all(group.stiff for group in groups) else tuning.SLOW_ELASTIC
        self.spent = self._dived = 0.0
        self._again = False
        told = (
            log is not None
            and sum(len(band.letters) for group in groups for band in group.bands) <= tuning.TOLD_LETTERS
        )
        alone = lone(groups) if known is None and accept is None and not told else None
        if known is not None:
            self._found, self.done = Found(*known), True
        elif alone is not None:
            self._found, self.done = alone, True
        else:
            self._begin()

    def _begin(self) -> None:
        method, nodes, check, accept = self._options
        plain = partial(BestFirst, informed=method != "no-heuristic", table=method != "no-table")
        self._first = (plain if method in PLAINER else best_first)(
            self.groups,
            keep=tuning.TIES,
            nodes=nodes,
            check=check,
            accept=accept,
            log=self.log,
            turn=tuning.TURN_PATHS,
        )
        self._ida = method == "ida"
        self._found, self.done = self._first.found, self._first.done
        self._base = self._found.bound
        self._step = tuning.FIRST_STEP * max((group.canvas for group in self.groups), default=1.0)
        self._stepwise = True
        self._goal: float | None = None

    def advance(self, limit: float, top: float = inf) -> None:
        """Find the optimum, if it costs no more than `limit`; nothing above `top` is of any use."""
        if self.done or limit < self._found.bound - EPS:
            return
        begin = self._effort.seconds
        if self.log is None:
            self._go_on(limit, top)
        else:
            with self.log.turn():
                self._go_on(limit, top)
            self.log.known(self.floor, len(self.ties), self.cut)
        self.spent += self._effort.seconds - begin
        self._tidy()

    def expect(self, priced: Priced) -> None:
        """A structure that the search may well come to has been priced already."""
        if isinstance(self._first, CompiledSearch):
            self._first.expected = priced

    def _tidy(self) -> None:
        if self.done:
            self._first = self._dives = self._ends = None  # they take much memory

    @property
    def long(self) -> bool:
        """The search has taken long."""
        return not self.done and (
            (self._sweeps is not None and self.slow) or self._found.nodes >= tuning.LONG_PATHS
        )

    @property
    def slow(self) -> bool:
        """The search has taken so long that sweeps may help."""
        return self.spent > self._slow

    def dive(self, *, at_once: bool = False, sweep: bool = False) -> None:
        """Look for some alignment as long as the search has taken; or, `at_once`, until there is one.

        With `sweep` by sweeps alone, where they are possible.
        """
        _, _, check, accept = self._options
        if self._settled or accept is not None:
            return
        able = self._sweeps is not None or self._was_swept
        if at_once or self.slow:
            self._sweep()
        if (sweep and able) or (self._found.nodes < tuning.LONG_PATHS and self._swept is not None):
            return
        if self._dives is None:
            self._dives = dives(self.groups, self.floor, check, self._fits)
            if self._swept is not None:
                self._dives.offer(self._swept)
        begin, before = self._effort.seconds, self._dived
        while not self._dives.done and (self._dived <= self.spent or (at_once and self._dives.best is None)):
            self._effort()
            self._dives.dive()
            self._dived = before + self._effort.seconds - begin

    def _sweep(self) -> None:
        """Sweep, once."""
        if self._sweeps is None:
            return
        ways, self._sweeps, self._was_swept = self._sweeps, None, True
        try:
            for priced in ways:
                self._swept = priced
        except Stopped:
            if self._swept is None:
                raise  # else that is what there was time for

    def mend(self) -> None:
        """Where sweeps have come to nothing that can be sized: make something that can of what they have come to."""
        _, _, check, _ = self._options
        if not self._settled and self._was_swept and self._swept is None and self._strain is not None:
            self._swept = mended(self.groups, self._strain, Effort(check, tuning.SWEPT))

    def polish(self) -> Iterator[None]:
        """Make the best that is known better, bit by bit."""
        _, _, check, accept = self._options
        if self._settled or accept is not None or not self._was_swept or not self.known or self._fits is None:
            return
        for better in polished(self.groups, self.known[0], self._fits, Effort(check, tuning.SWEPT)):
            self._swept = better
            yield

    def give_up(self) -> None:
        """Let go of the search, but not of what it has found."""
        if not self.done:
            self._swept = next(iter(self.known), None)
            self._first = self._dives = self._ends = None

    @property
    def known(self) -> list[Priced]:
        """The optimal structures, where they are known; else the best so far."""
        dived = None if self._dives is None else self._dives.best
        best = min(
            (own for own in (self._swept, dived) if own is not None), key=lambda own: own.cost, default=None
        )
        return self._found.ties or ([best] if best is not None else [])

    def _go_on(self, limit: float, top: float) -> None:
        if self._ida and limit == inf:  # it deepens by itself, from the start in every step
            self._go_to(inf)
        while not self.done:
            if self._goal is None:
                rung = self._base + self._step
                if rung > top and not self._again:
                    self._stepwise, self._goal = False, limit
                else:
                    self._step, self._goal = self._step * tuning.STEP_GROWTH, rung
            goal = self._goal
            self._go_to(goal)
            if self.paused:
                return
            self._goal = None
            if goal >= limit:
                break
        if self.done and not self._stepwise and len(self._found.ties) >= tuning.TIES:
            self._again = True
            self._begin()
            self._go_on(limit, top)
        elif self.done and not self._ida:
            self._found.ties.sort(key=_in_order)

    @property
    def paused(self) -> bool:
        """It has not come to the end of what it was asked for."""
        return not self.done and self._first is not None and self._first.paused

    def _go_to(self, limit: float) -> None:
        if not self._ida:
            assert self._first is not None, "a search that was given up is not gone on with"
            self._first.advance(limit)
            self.done = self._first.done
            if self.cut and self._plain:
                self._otherwise()
        else:
            budget = tuning.PAPER_PATHS if self.log is None else inf  # a trace would tell everything again
            while not self.done:
                self._found = self._paper(limit, budget, self.log)
                if budget >= self._options[1] or not self._found.cut:
                    self.done = bool(self._found.ties) or self._found.bound == inf or self._found.cut
                    return
                budget *= 4

    def _paper(self, limit: float, budget: float, observer: Observer | None) -> Found:
        """What the paper's search finds, of at most so many partial alignments."""
        _, nodes, check, accept = self._options
        if self._ends is None and observer is None:
            self._ends = Ends(self.groups, check)
        return search_ida(
            self.groups,
            cap=limit,
            keep=tuning.TIES,
            nodes=int(min(nodes, budget)),
            check=check,
            accept=accept,
            observer=observer,
            ends=self._ends,
        )

    def _otherwise(self) -> None:
        """Under the paper's objective bounds say little; where best first gets lost, its own search may not.

        Nobody is told of it: a network has the steps of one search.
        """
        first, self._first = self._found, None
        other = self._paper(inf, tuning.PAPER_PATHS, None)
        better = other.best is not None and (first.best is None or other.best.cost < first.best.cost)
        if better or not other.cut:
            other.nodes += first.nodes
            other.bound = max(other.bound, first.bound)
            self._found = other

    @property
    def ties(self) -> list[Priced]:
        """The optimal structures; empty where they are not known, or there are none."""
        return self._found.ties if self.done else []

    @property
    def floor(self) -> float:
        """Proven lower bound."""
        return self._found.bound

    @property
    def cut(self) -> bool:
        """It gave up."""
        return self._found.cut

    @property
    def _settled(self) -> bool:
        """Nothing better can be found."""
        return self.done and not self.cut


def _in_order(priced: Priced) -> tuple[tuple[tuple[tuple[int, ...], ...], ...], ...]:
    """Equally good structures have an order of their own."""
    return tuple(
        tuple(tuple(option.letters for option in column) for column in columns)
        for columns in priced.structure
    )
