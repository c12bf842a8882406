"""The edges that leave a node: every column that may come next, as far as a budget allows."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from math import inf

from ... import tuning
from ...model.precision import EPS
from ..elements import Option
from ..group import Group
from ..rules import Tally, broken, price, slope
from .paths import Edge, State
from .shortfall import ahead

__all__ = ["Made", "Maker", "edges"]

Made = dict[tuple[State, bool], tuple[float, list[Edge]]]
"""Edges by the node that they leave: up to which rise of the bound they were made, and they, the least first."""


def edges(
    group: Group,
    state: State,
    owed: bool,
    made: float,
    limit: float,
    check: Callable[[], None] | None = None,
    most: float = inf,
    made_before: Made | None = None,
) -> list[Edge]:
    """Every column that may come next and keeps the constraints and the tolerance, by how much the bound rises with it.

    Only those that make it rise by more than `made` and at most `limit`, the least first. The edges of a node
    are kept in `made_before`, as other paths lead to it too. With `most`, only so many, whichever come first.
    """
    if most < inf:
        return Maker(group, state, owed, limit, check, most).make()
    kept = {} if made_before is None else made_before
    known = kept.get((state, owed))
    if known is None or known[0] < limit:
        further = limit + tuning.FURTHER * group.canvas
        fresh = Maker(group, state, owed, further, check).make()
        fresh.sort(key=_by_rise)
        known = kept[state, owed] = (further, fresh)
    found = known[1]
    return found[
        bisect_right(found, made + EPS, key=_by_rise) : bisect_right(found, limit + EPS, key=_by_rise)
    ]


def _by_rise(edge: Edge) -> float:
    return edge.rise


class Maker:
    """Makes the edges that leave a node.

    Elements are chosen band by band, the reference first. What is chosen bounds ω, E and Λ from below, and
    so do the pairs of the reference's next position with those of the other bands; a column that has become
    too dear is given up. Runs of solid letters only grow, so that the rest of a band's runs goes with one
    whose ω is too large.
    """

    def __init__(
        self,
        group: Group,
        state: State,
        owed: bool,
        limit: float,
        check: Callable[[], None] | None,
        most: float = inf,
    ) -> None:
        self.group, self.owed, self.check, self.most = group, owed, check, most
        self.before = 0.0 if group.tall else ahead(group, state)
        self.limit = limit + EPS + self.before
        self.floor = -inf
        self.mu = group.tolerance + EPS
        self.plain = group.objective.plain
        self.by_empty, self.by_loose = group.by_empty, group.by_loose
        self.choices = [band.options(position) for band, position in zip(group.bands, state, strict=True)]
        bands = range(len(group.bands))
        self.order = (
            list(bands) if group.reference is None else sorted(bands, key=lambda b: b != group.reference)
        )
        self.rows: list[list[float] | None] = [None] * len(group.bands)
        self.rest = [0.0] * (len(group.bands) + 1)
        self.chosen: list[Option] = [options[0] for options in self.choices if options]
        self.made: list[Edge] = []
        self.calls = 0

    def make(self) -> list[Edge]:
        """All of them, in no order."""
        if len(self.chosen) < len(self.choices):
            return []  # an attached letter that ends its word forbids any further column (C4)
        self._descend(0, Tally(), 0.0)
        return self.made

    def _enter(self, option: Option) -> None:
        """Take the reference's element: look the pairs up that its next position is part of."""
        group = self.group
        total = 0.0
        for n in range(len(self.order) - 1, 0, -1):
            b = self.order[n]
            table = group.pairs[b]
            assert table is not None
            row = self.rows[b] = table.row(option.target)
            total += min([row[o.target >> 2] for o in self.choices[b]], default=inf)
            self.rest[n] = total

    def _descend(self, n: int, so_far: Tally, ahead_so_far: float) -> None:
        if n == len(self.order):
            self._close(so_far, ahead_so_far)
            return
        if self.check is not None:
            self.calls += 1
            if not self.calls & 7:
                self.check()
        if len(self.made) >= self.most:
            return
        b = self.order[n]
        by_empty, by_loose, limit, plain = self.by_empty, self.by_loose, self.limit, self.plain
        paired = self.group.reference is not None
        for option in self.choices[b]:
            own = so_far.plus(option, plain)
            if paired and n == 0:
                self._enter(option)
            row = self.rows[b]
            ahead_ = ahead_so_far + row[option.target >> 2] if row is not None and n else ahead_so_far
            omega = own.omega_so_far
            bound = (
                omega
                + by_empty * own.empties * own.high
                + by_loose * own.loose
                + ahead_
                + (self.rest[n + 1] if paired else 0.0)
            )
            if omega > self.mu or bound > limit:
                size = option.size
                if (
                    size is not None
                    and size > own.filling
                    and omega > min(self.mu, limit)
                    and not option.transparent
                ):
                    break  # longer runs are dearer still
                continue
            self.chosen[b] = option
            self._descend(n + 1, own, ahead_)

    def _close(self, column: Tally, after: float) -> None:
        group, chosen = self.group, self.chosen
        omega = column.omega
        cost = price(group, column, omega)
        if cost + after > self.limit or cost + after <= self.floor or omega > self.mu:
            return
        if broken(group, self.owed, chosen, omega) is not None:
            return
        rested = column.filling < inf
        ended = any(option.ends for option in chosen)
        tied = any(option.tied for option in chosen)
        pinched = rested and any(
            not option.empty and option.size is None and option.least >= column.high - EPS
            for option in chosen
        )
        firm = rested or not column.elastic
        pieces = tuple([(b, o.letters) for b, o in enumerate(chosen) if o.tied]) if tied and firm else ()
        self.made.append(
            Edge(
                tuple(chosen),
                tuple([option.target for option in chosen]),
                cost,
                omega,
                column.high,
                column.low,
                cost + after - self.before,
                after,
                firm,
                not ended,
                tied or not firm,
                pieces,
                slope(group, column.empties, column.softs),
                pinched,
            )
        )
