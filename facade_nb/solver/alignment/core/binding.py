"""The best-first search and the dives in WebAssembly: the same steps as `reference`, many times faster.

The headers beside this file are a transcription of `reference` (with `pairs` and `pricing`) into C++, a module each.
It takes the same decisions in the same order, and tests hold it to that: as many paths, the same structures. It finds
what a structure costs, but not its sizes: each one that could be among the best is priced again in Python.

A trace is made by the search in Python. Where there is no wasmtime (in a browser, say), or no room for an instance
(see `instances`), that is used for everything.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf
from typing import Any

from ... import tuning
from ...effort import spend
from ...model.precision import EPS
from ..elements import Option
from ..found import Found
from ..group import Group
from ..observer import PathObserver
from ..pricing import Priced, Structure, price
from ..reference.best_first import BestFirst
from ..reference.dives import Dives
from ..reference.network import ceiling
from .instances import (
    DIVES,
    ENDED,
    LEFT,
    PAUSED,
    PRICE,
    SEARCH,
    UNLIMITED,
    NoRoom,
    instance,
    may_be_compiled,
    without,
)

__all__ = ["CompiledDives", "CompiledSearch", "best_first", "dives"]


def _structure(groups: Sequence[Group], numbers: Sequence[int]) -> Structure:
    """A structure from the numbers of the options that were taken."""
    at = 0
    out: list[tuple[tuple[Option, ...], ...]] = []
    for group in groups:
        count = numbers[at]
        at += 1
        state = list(group.start)
        columns: list[tuple[Option, ...]] = []
        for _ in range(count):
            column: list[Option] = []
            for b, band in enumerate(group.bands):
                option = band.option(state[b], numbers[at])
                state[b] = option.target
                column.append(option)
                at += 1
            columns.append(tuple(column))
        out.append(tuple(columns))
    return tuple(out)


class CompiledSearch:
    """Does what `reference.best_first.BestFirst` does, and has its attributes.

    Attributes
    ----------
    expected
        A structure that is not priced again where it is found.
    """

    def __init__(
        self,
        groups: Sequence[Group],
        *,
        keep: int = 8,
        nodes: int = 1_000_000,
        check: Callable[[], None] | None = None,
        accept: Callable[[Priced], bool] | None = None,
        turn: float = inf,
    ) -> None:
        self.groups, self.keep, self.check, self.accept = tuple(groups), keep, check, accept
        self.paused = False
        self.expected: Priced | None = None
        core = self._core = instance()
        turn = min(turn, UNLIMITED)
        numbers = (core.groups(groups), keep, nodes, turn, accept is not None)
        _, bound, _, _, self._search = core.ask(check, "search_new", *numbers)
        core.owned(self, SEARCH, self._search)
        self.found = Found(bound=bound)
        self.done = bound == inf
        self._ceiling = ceiling(groups)

    def advance(self, limit: float) -> None:
        """Go on until the optimum is known, or is known to cost more than `limit`, or it is the turn of others."""
        found = self.found
        if self.done or limit < found.bound - EPS:
            return
        paused, self.paused = self.paused, False
        status = self._ask("search_advance", float(limit), paused)
        while status != ENDED:
            if status == LEFT:
                structure = _structure(self.groups, self._core.integers(self._structure))
                expected = self.expected
                known = expected is not None and expected.structure == structure
                spend(self.check, tuning.ALIGNED)
                item = expected if known else price(self.groups, structure)
                if item is not None and (self.accept is None or self.accept(item)):
                    found.offer(item, self.keep)
                    limit = min(limit, item.cost)
                status = self._ask("search_judged", *self._known(), float(limit))
            elif status == PAUSED:
                self.paused = True
                return
            else:
                found.cut = self.done = True
                return
        if found.ties:
            self.done = True
        elif limit >= self._ceiling:
            self.done = True
            found.bound = inf
        else:
            found.bound = max(found.bound, limit)

    def _known(self) -> tuple[float, int, bool, bool]:
        best = self.found.best
        if best is None:
            return inf, 0, False, False
        return best.cost, best.columns, best.proper, len(self.found.ties) >= self.keep

    def _ask(self, name: str, *arguments: float) -> float:
        try:
            status, *_ = self._core.ask(self.check, name, self._search, *arguments)
        finally:
            if self._core.told:  # not where it ran out of memory
                _, bound, nodes, self._structure, _ = self._core.told
                self.found.nodes = int(nodes)
                if not self.found.ties:
                    self.found.bound = max(self.found.bound, bound)
        return status


class CompiledDives:
    """Does what `dive.Dives` does, and has its attributes."""

    def __init__(
        self,
        groups: Sequence[Group],
        least: float,
        check: Callable[[], None] | None = None,
        accept: Callable[[Priced], bool] | None = None,
    ) -> None:
        self.groups, self.check, self._accept = tuple(groups), check, accept
        self.best: Priced | None = None
        core = self._core = instance()
        self.done = False
        """There is no better one."""
        self._dives = core.ask(check, "dives_new", core.groups(groups), least, accept is not None)[4]
        core.owned(self, DIVES, self._dives)
        self._ask("dives_begin", ceiling(groups))

    def _ask(self, name: str, *arguments: float) -> tuple[float, ...]:
        told = self._core.ask(self.check, name, self._dives, *arguments)
        self.done = told[2] != 0.0
        return told

    def dive(self) -> bool:
        """Go through the network once; whether a better alignment was found."""
        status, limit, _, structure, _ = self._ask("dives_dive", self.best is not None)
        if status != PRICE:
            return False
        spend(self.check, tuning.ALIGNED)
        priced = price(self.groups, _structure(self.groups, self._core.integers(structure)))
        if (
            priced is None
            or priced.cost > limit + EPS
            or (self._accept is not None and not self._accept(priced))
        ):
            self._ask("dives_missed")
            return False
        self.offer(priced)
        return True

    def offer(self, priced: Priced) -> None:
        """An alignment that is known already: only cheaper ones are looked for."""
        self.best = priced
        self._ask("dives_found", priced.cost)


def best_first(
    groups: Sequence[Group], *, log: PathObserver | None = None, **options: Any
) -> BestFirst | CompiledSearch:
    """The search to be used: the compiled one where there is one and nobody wants to know what it does."""
    if log is None and may_be_compiled():
        try:
            return CompiledSearch(groups, **options)
        except NoRoom:
            without()
    return BestFirst(groups, log=log, **options)


def dives(
    groups: Sequence[Group],
    least: float,
    check: Callable[[], None] | None = None,
    accept: Callable[[Priced], bool] | None = None,
) -> Dives | CompiledDives:
    """The dives to be used."""
    if may_be_compiled():
        try:
            return CompiledDives(groups, least, check, accept)
        except NoRoom:
            without()
    return Dives(groups, least, check, accept)
