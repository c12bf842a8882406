"""Which edges leave a node: only those worth weighing are made (supplement 3.3).

A column takes an element from every word. There are exponentially many, nearly all of them bad: the elements
differ by more than the tolerance, or leave rows behind that can no longer be aligned well. They are never
formed:

1. Every word is paired with the reference, and the tolerance region of the two is traced. Beside an
   element of the reference only those of the region are looked at, and ε and elastic elements, which fit
   anything. A row with a non-opaque letter need not fill its column (supplement 3.4), so that one border of
   the region is open for it.
2. What is left of the words is joined in a hierarchy: two and two, then pairs of pairs, and so on. At every
   level what does not fit into the tolerance, or into the limit together with the bound for what is ahead,
   is dropped before it is joined further.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf

from ...model.precision import EPS
from ..elements import Option, Position
from ..group import Group
from ..rules import Tally, fills, price
from .guides import Guide
from .hierarchy import Hierarchy
from .observer import Watch
from .tolerance_region import Region, trace

__all__ = ["Weighing"]

_Part = tuple[float, Tally, tuple[Option, ...]]
"""Elements of some words: what is ahead of them beyond the least there could be; what they come to; themselves."""


class Weighing:
    """The edges that leave one node.

    Attributes
    ----------
    beyond
        Edges that were left out because of the limit cost at least this with what is ahead behind them.

    Parameters
    ----------
    state
        Where the heads stand.
    limit
        What a column and the bound of what is ahead behind it may cost together.
    guides
        Heads go only where these let them.
    """

    def __init__(
        self,
        group: Group,
        pairs: Hierarchy,
        state: Sequence[Position],
        limit: float,
        check: Callable[[], None] | None = None,
        watch: Watch | None = None,
        guides: Sequence[Guide] = (),
    ) -> None:
        self.group, self.pairs, self.limit, self.check, self.watch = group, pairs, limit + EPS, check, watch
        self.plain, self.added = group.objective.plain, pairs.added
        self.window = min(group.tolerance, max(0.0, limit)) + EPS
        self.choices = [band.options(p) for band, p in zip(group.bands, state, strict=True)]
        places = tuple([p >> 2 for p in state])
        for guide in guides:
            for b, targets in guide.targets(places).items():
                self.choices[b] = tuple(o for o in self.choices[b] if o.target >> 2 in targets)
        self.beyond = inf if self.window >= group.tolerance else self.window
        self._calls = 0

    def elements(self) -> list[tuple[tuple[Option, ...], float]]:
        """Columns within the limit, as far as ω, E, Λ and the pairs can say, each with what is ahead of it."""
        if not all(self.choices):
            return []  # an attached letter that ends its word forbids any further column (C4)
        first = self.pairs.reference
        others = [b for b in range(len(self.choices)) if b != first]
        regions = {b: self._region(first, b) for b in others}
        order = [first, *others]
        place = [order.index(b) for b in range(len(order))]
        found: list[tuple[tuple[Option, ...], float]] = []
        runs = 0  # sized elements of the reference so far
        for option in self.choices[first]:
            sized = option.size is not None and not option.empty
            runs += sized
            own = self._part(option, 0.0)
            if not others:
                found.append(((option,), 0.0))
                continue
            lists: list[list[_Part]] = []
            least: list[float] = []
            for b in others:
                row = self._row(b, option)
                choices = self._beside(option, runs if sized else None, regions[b], self.choices[b])
                floor = min([row[o.target >> 2] for o in choices], default=inf)
                if floor == inf:
                    break
                least.append(floor)
                # added up, only what exceeds the least that each pair costs anyway is counted part by part
                lists.append(
                    [self._part(o, row[o.target >> 2] - (floor if self.added else 0.0)) for o in choices]
                )
            if len(lists) < len(others):
                continue
            base = sum(least) if self.added else max(least)
            if base > self.limit:
                self.beyond = min(self.beyond, base)
                continue
            for part in self._joined(own, base, lists):
                taken = (option, *part[2])
                ahead = base + part[0] if self.added else max(base, part[0])
                found.append((tuple([taken[n] for n in place]), ahead))
        return found

    def _row(self, b: int, option: Option) -> list[float]:
        table = self.pairs.tables[b]
        assert table is not None
        return table.row(option.target >> 2)

    def _region(self, first: int, b: int) -> Region:
        """Trace the region of the reference and another word."""
        a, c = (_totals(self.choices[n]) for n in (first, b))
        region = trace(a, c, self.window, keep=self.watch is not None)
        if self.watch is not None:
            self.watch.traced((first, b), region.lower, region.upper)
        return region

    def _beside(
        self, option: Option, run: int | None, region: Region, choices: Sequence[Option]
    ) -> Sequence[Option]:
        """Elements of another word that may stand beside an element of the reference, its `run`-th sized one."""
        if run is None:
            return choices
        first, last = region.first[run], region.last[run]
        out: list[Option] = []
        j = 0
        for other in choices:
            if other.empty or other.size is None:
                out.append(other)
                continue
            j += 1
            # whoever is soft may be shorter, as long as another row fills the column
            if (j >= first or not fills(self.group, other)) and (j <= last or not fills(self.group, option)):
                out.append(other)
        return out

    def _part(self, option: Option, ahead: float) -> _Part:
        return (ahead, Tally().plus(option, self.plain), (option,))

    def _joined(self, own: _Part, base: float, lists: list[list[_Part]]) -> list[_Part]:
        """Join the words pairwise, the pairs pairwise, and so on; `own` is the reference's element."""
        level = [self._fitting(own, base, parts) for parts in lists]
        while len(level) > 1:
            if not all(level):
                return []
            level = [
                self._join(own, base, level[n], level[n + 1]) if n + 1 < len(level) else level[n]
                for n in range(0, len(level), 2)
            ]
        return level[0]

    def _fitting(self, own: _Part, base: float, parts: list[_Part]) -> list[_Part]:
        fits = [part for part in parts if self._fits(own, base, part)]
        fits.sort(key=_ahead)
        return fits

    def _fits(self, own: _Part, base: float, part: _Part) -> bool:
        column = own[1].joined(part[1])
        omega = column.omega_so_far
        if omega > self.window:
            return False
        value = price(self.group, column, omega) + (base + part[0] if self.added else max(base, part[0]))
        if value > self.limit:
            self.beyond = min(self.beyond, value)
            return False
        return True

    def _join(self, own: _Part, base: float, left: list[_Part], right: list[_Part]) -> list[_Part]:
        """Every fitting pair of a part from the left and one from the right; both come by what is ahead."""
        out: list[_Part] = []
        added, spare = self.added, self.limit - base
        for p in left:
            if self.check is not None:
                self._calls += len(right)
                if self._calls > 500:
                    self._calls = 0
                    self.check()
            for q in right:
                if added:
                    ahead = p[0] + q[0]
                    if ahead > spare:
                        self.beyond = min(self.beyond, base + ahead)
                        break
                else:
                    ahead = max(p[0], q[0])
                part = (ahead, p[1].joined(q[1]), p[2] + q[2])
                if self._fits(own, base, part):
                    out.append(part)
        out.sort(key=_ahead)
        return out


def _ahead(part: _Part) -> float:
    return part[0]


def _totals(choices: Sequence[Option]) -> list[float]:
    """Sizes of the sized elements, which grow by a letter each; ε comes first."""
    return [0.0, *[o.size for o in choices if o.size is not None and not o.empty]]
