"""One half of the bidirectional search: depth first from one end to the middle of the network.

Depth first, so that no global ranking of edges is needed: each node has a local queue of the edges that leave it,
and what exceeds the limit is not followed (informed iterative deepening). A partial alignment that has come to the
middle is handed over to `bidirectional`, which joins it with those from the other end.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import inf

from ... import tuning
from ...effort import spend
from ...model.precision import EPS
from ..elements import Option
from ..group import Group
from ..observer import Observer, Places
from ..pricing import Priced, Structure
from .decision_network import Column, Lattice, State
from .observer import Watch, places_from_left
from .pieces import Stretch, ledger_bound, with_column
from .remainder import Remainder

__all__ = ["Half", "Side"]


@dataclass(slots=True, eq=False)
class Half:
    """A partial alignment, read from one end: linked columns, the newest at the front.

    Attributes
    ----------
    group, state, owed
        The node it has come to; `group` counts in the order of reading.
    cost
        Lower bound of J so far; exact where no column's price depends on lengths.
    width, columns
        W so far in this group; columns so far.
    firm
        No column of this group could be made wider without cost.
    spans
        See `remainder.Remainder.shortfall`.
    ledger
        What is known of the tied letters it has cut (`pieces`).
    trail
        The columns whose price depends on lengths in ways the ledger does not tell.
    lax
        Columns of this group hold elastic letters that neither ledger nor trail tells of; they could be made
        wider, at a cost, to reach the canvas.
    bound
        What an alignment costs at least that begins like this.
    """

    group: int
    state: State
    owed: bool = False
    cost: float = 0.0
    width: float = 0.0
    columns: int = 0
    firm: bool = True
    spans: tuple[tuple[float, float], ...] = ()
    ledger: tuple[Stretch, ...] = ()
    trail: tuple[object, ...] = ()
    lax: bool = False
    bound: float = 0.0
    parent: Half | None = None
    column: Column | None = None
    dropped: bool = False

    def laid(self) -> list[tuple[int, Column]]:
        """Its columns in the order of reading, each with its group."""
        out: list[tuple[int, Column]] = []
        node = self
        while node.parent is not None and node.column is not None:
            out.append((node.parent.group, node.column))
            node = node.parent
        out.reverse()
        return out


class Side:
    """The networks of all groups, read in one direction.

    Attributes
    ----------
    way
        ``"forward"`` or ``"backward"``.
    lattices
        In the order of reading.
    later
        Per group: lower bound of the groups behind it; one more entry at the end.
    beyond
        The least bound that exceeded the limit since this was last set.
    relaxed
        What linear programmes have said of partial alignments: lower bounds, without and with positive pieces.
    priced
        What they have said of whole ones.
    """

    def __init__(self, way: str, lattices: Sequence[Lattice]) -> None:
        self.way = way
        self.lattices = tuple(lattices)
        self.groups: tuple[Group, ...] = tuple(lattice.group for lattice in lattices)
        self.observer: Observer | None = None
        self.beyond = inf
        self.relaxed: dict[tuple[Column, ...], tuple[float, float]] = {}
        self.priced: dict[Structure, Priced | None] = {}
        self.remainders = [Remainder(group) for group in self.groups]
        total = sum(lattice.total for lattice in lattices)
        self.behind = [0] * (len(lattices) + 1)
        for g, lattice in enumerate(lattices):
            self.behind[g + 1] = self.behind[g] + lattice.total
        self.total = total
        self.later = [0.0] * (len(lattices) + 1)
        for g in range(len(lattices) - 1, -1, -1):
            self.later[g] = self.later[g + 1] + self._least(self._enter(Half(g, ())))

    def root(self) -> Half:
        """Before the first column."""
        root = self._enter(Half(0, ()))
        root.bound = self.later[0]
        return root

    def _enter(self, half: Half) -> Half:
        """Stand at the first node of its group."""
        half.width, half.firm, half.lax = 0.0, True, False
        half.owed = False
        if half.group < len(self.groups):
            group = self.groups[half.group]
            half.state = group.start
            half.spans = ((0.0, 0.0),) * len(group.bands)
        else:
            half.state, half.spans = (), ()
        return half

    def progress(self, half: Half) -> int:
        """How far it has come: the sum of its places."""
        return self.behind[half.group] + sum(p >> 2 for p in half.state)

    def key(self, half: Half) -> tuple[int, Places]:
        """The node, counted from the left whichever way it was reached."""
        if self.way == "forward":
            return half.group, tuple([p >> 2 for p in half.state])
        last = len(self.groups) - 1
        if half.group > last or not any(p >> 2 for p in half.state):
            g = last + 1 - half.group  # all of group g − 1 is to the left
            here = self.groups[half.group - 1] if half.group else None
            return g, () if here is None else (0,) * len(here.bands)
        return last - half.group, places_from_left(self.groups[half.group], half.state, self.way)

    def _least(self, half: Half) -> float:
        """Lower bound of what its group still costs."""
        group = self.groups[half.group]
        short = self.remainders[half.group].shortfall(half.state, half.spans, half.width, half.firm)
        longest = max(band.at_least(p) for band, p in zip(group.bands, half.state, strict=True))
        over = max(0.0, half.width + longest - group.canvas)
        return max(short, self.lattices[half.group].ahead(half.state) + group.objective.fit * over)

    def onward(self, half: Half, limit: float) -> Iterable[Half]:
        """Longer by one column, the edges in the order of the local queue; none dearer than the limit."""
        g = half.group
        lattice = self.lattices[g]
        laid = half.cost + self.later[g + 1]
        columns, beyond = lattice.columns(
            half.state, half.owed, limit - laid, self.observer, self.way, self._index(g)
        )
        self.beyond = min(self.beyond, laid + beyond)
        for column in columns:
            spend(lattice.check, tuning.EXTENDED)
            child = self._extend(half, column)
            if child is None:
                continue
            if child.bound <= limit + EPS:
                yield child
            else:
                self.beyond = min(self.beyond, child.bound)
                self.pruned(child, "bound", limit)

    def pruned(self, child: Half, reason: str, against: float) -> None:
        """Tell whoever watches that a partial alignment is not followed, and what it was held against."""
        half = child.parent
        if self.observer is None or half is None or child.column is None:
            return
        index = self._index(half.group)
        watch = Watch(self.observer, self.way, index, self.groups[half.group], half.state)
        watch.pruned(child.column.options, reason, child.cost, child.bound, against)

    def _index(self, g: int) -> int:
        return g if self.way == "forward" else len(self.groups) - 1 - g

    def _extend(self, half: Half, column: Column) -> Half | None:
        g = half.group
        group, lattice = self.groups[g], self.lattices[g]
        ledger, trail, lax = half.ledger, half.trail, half.lax
        cost, width = half.cost + column.cost, half.width + column.width
        if column.elastic:
            if column.piece is not None or column.tied:
                entered = with_column(ledger, g, group.bands, column)
                if entered is None:
                    return None
                ledger, more, wider, closed = entered
                cost += more
                width += wider
                lax = lax or closed
            else:
                lax = True  # its elastic letters are free
            if column.tied:
                trail = (*trail, column)
        firm = half.firm and column.firm
        child = Half(
            g,
            column.state,
            column.owed,
            cost,
            width,
            half.columns + 1,
            firm,
            (),
            ledger,
            trail,
            lax,
            0.0,
            half,
            column,
        )
        if lattice.finished(column.state):
            cost = child.cost = cost + closing(group, width, firm)
            if cost == inf:
                return None
            child.group += 1
            if width < group.canvas - group.tolerance - EPS or any(s.group == g for s in ledger):
                child.trail = (*trail, child)  # W of this group is not settled, so it is like no other
            self._enter(child)
            child.bound = cost + self.later[g + 1] + ledger_bound(ledger, self.groups)
            return child
        child.spans = _spans(half.spans, column.options, column) if group.tied else half.spans
        child.bound = cost + self._least(child) + self.later[g + 1]
        if ledger:
            child.bound += ledger_bound(ledger, self.groups)
        return child


def closing(group: Group, width: float, firm: bool) -> float:
    """Price of W at the end of a group: exact where nothing is elastic, a lower bound otherwise.

    To make a firm column wider costs at least 1 a metre and gains `fit` < 1.
    """
    over = width - group.canvas
    if over > group.tolerance + EPS or (group.stiff and -over > group.tolerance + EPS):
        return inf
    return group.objective.fit * over if over > 0 else -(group.objective.fit if firm else group.under) * over


def _spans(
    spans: tuple[tuple[float, float], ...], options: Sequence[Option], column: Column
) -> tuple[tuple[float, float], ...]:
    """What the pieces of the letters in hand have taken, at no cost."""
    most = column.width if column.firm else inf
    out: list[tuple[float, float]] = []
    for span, option in zip(spans, options, strict=True):
        if option.empty:
            out.append(span)
        elif not option.transparent or option.ends:
            out.append((0.0, 0.0))
        else:
            begun = span if len(option.letters) == 1 and not option.begins else (0.0, 0.0)
            least = column.least if column.firm and len(option.letters) == 1 else 0.0
            out.append((begun[0] + least, begun[1] + most))
    return tuple(out)
