"""The edges that leave a node: every column that may come next, as far as a budget allows."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from math import inf

from ..columns import EPS, Group, Option
from .paths import Edge, State
from .shortfall import ahead

__all__ = ["Maker", "edges"]

_FURTHER = 0.01
"""Edges are made a little further than asked, as a fraction of the canvas: limits grow in small steps."""


def edges(
    group: Group,
    state: State,
    owed: bool,
    made: float,
    limit: float,
    check: Callable[[], None] | None = None,
    most: float = inf,
) -> list[Edge]:
    """Every column that may come next and keeps the constraints and the tolerance, by how much the bound rises with it.

    Only those that make it rise by more than `made` and at most `limit`, the least first. The edges of a node
    are kept with the group, as other paths lead to it too. With `most`, only so many, whichever come first.
    """
    if most < inf:
        return Maker(group, state, owed, limit, check, most).make()
    known = group.edges.get((state, owed))
    if known is None or known[0] < limit:
        further = limit + _FURTHER * group.canvas
        fresh = Maker(group, state, owed, further, check).make()
        fresh.sort(key=_by_rise)
        known = group.edges[state, owed] = (further, fresh)
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
        objective, share = group.objective, group.share
        self.plain = objective.plain
        self.by_empty, self.by_loose = objective.empty * share, objective.loose * share
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
        self._descend(0, 0.0, inf, inf, 0, 0.0, 0, 0.0, False, 0.0)
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

    def _descend(
        self,
        n: int,
        high: float,
        low: float,
        low_all: float,
        empties: int,
        loose: float,
        softs: int,
        soft_sizes: float,
        elastic: bool,
        ahead_so_far: float,
    ) -> None:
        if n == len(self.order):
            self._close(high, low, low_all, empties, loose, softs, soft_sizes, elastic, ahead_so_far)
            return
        if self.check is not None:
            self.calls += 1
            if not self.calls & 7:
                self.check()
        if len(self.made) >= self.most:
            return
        b = self.order[n]
        by_empty, by_loose, limit = self.by_empty, self.by_loose, self.limit
        paired = self.group.reference is not None
        for option in self.choices[b]:
            high_, low_, low_all_, empties_, loose_, softs_, sizes_, elastic_ = (
                high, low, low_all, empties, loose, softs, soft_sizes, elastic,
            )  # fmt: skip
            if paired and n == 0:
                self._enter(option)
            row = self.rows[b]
            ahead_ = ahead_so_far + row[option.target >> 2] if row is not None and n else ahead_so_far
            size = option.size
            if option.empty:
                empties_ += 1
            elif size is None:
                elastic_ = True
                if option.least > high:
                    high_ = option.least
            else:
                if size > high:
                    high_ = size
                if size < low_all:
                    low_all_ = size
                if size < low and (self.plain or not option.soft):
                    low_ = size
                loose_ += option.loose
                if option.soft:
                    softs_ += 1
                    sizes_ += size
            omega = high_ - low_ if low_ < inf else 0.0
            bound = (
                omega
                + by_empty * empties_ * high_
                + by_loose * loose_
                + ahead_
                + (self.rest[n + 1] if paired else 0.0)
            )
            if omega > self.mu or bound > limit:
                if size is not None and size > low and omega > min(self.mu, limit) and not option.transparent:
                    break  # longer runs are dearer still
                continue
            self.chosen[b] = option
            self._descend(n + 1, high_, low_, low_all_, empties_, loose_, softs_, sizes_, elastic_, ahead_)

    def _close(
        self,
        high: float,
        low: float,
        low_all: float,
        empties: int,
        loose: float,
        softs: int,
        soft_sizes: float,
        elastic: bool,
        after: float,
    ) -> None:
        rested = low < inf
        if not rested:
            low = high if elastic else low_all
        omega = high - low if high > low else 0.0
        cost = omega + self.by_empty * empties * high + self.by_loose * (loose + softs * high - soft_sizes)
        if cost + after > self.limit or cost + after <= self.floor or omega > self.mu:
            return
        some = backed = begun = ended = tied = guarded = pinched = False
        needy = empties > 0
        chosen = self.chosen
        for option in chosen:
            if option.empty:
                continue
            some = True
            begun = begun or option.begins
            ended = ended or option.ends
            tied = tied or option.tied
            guarded = guarded or option.guarded
            backed = backed or option.opaque
            needy = needy or option.soft
            pinched = pinched or (rested and option.size is None and option.least >= high - EPS)
        if not some or (self.owed and not begun) or (needy and not backed and not self.group.waived):  # C1
            return
        if guarded:  # C3
            for b, option in enumerate(chosen):
                if option.guarded and any(chosen[o].soft for o in self.group.guards[b]):
                    return
        firm = rested or not elastic
        pieces = tuple([(b, o.letters) for b, o in enumerate(chosen) if o.tied]) if tied and firm else ()
        self.made.append(
            Edge(
                tuple(chosen),
                tuple([option.target for option in chosen]),
                cost,
                omega,
                high,
                low,
                cost + after - self.before,
                after,
                firm,
                not ended,
                tied or not firm,
                pieces,
                1.0 + self.by_empty * empties + self.by_loose * softs,
                pinched,
            )
        )
