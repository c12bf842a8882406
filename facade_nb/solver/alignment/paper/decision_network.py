"""The alignment decision network of a group (the paper's 5.2 and Figure 8, supplement 1.2 and 3.3).

An automaton reads every word with a head of its own, one letter at a time. Its states are the places of the
heads; its steps form a square lattice with as many dimensions as there are words. The network is the
transitive closure of that lattice: an edge reads any number of letters with each head, and what it reads is a
column of the alignment. A path from the first state to the last is an alignment.

Here a node also says what the constraints have to know of the column before (see `elements.Position`), and
whether a letter of any word ended there. Transparent letters may be cut, which gives a head a second place in
each of them.

Nothing of the network is made before it is asked for: `Lattice.columns` weighs the edges that leave a node, as
far as they can be of use, and keeps them.

The network is walked from both ends. Backward is forward in the network of the reversed words (`mirrored`): all
constraints and costs are the same from either side. Where every word reads alike from both sides, as in
façades with a mirror axis, that is the same network, and nothing is weighed twice.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf, prod

from ...model.letters import Letter
from ...model.precision import EPS
from ..bands import Band
from ..elements import Option, Position
from ..group import Group, make_group
from ..observer import Observer, Places
from ..rules import broken, price, slope, tally
from .edge_weights import Weighing
from .guides import Guide
from .hierarchy import Hierarchy
from .observer import Watch

__all__ = ["Column", "Lattice", "Piece", "State", "mirrored"]

State = tuple[Position, ...]


@dataclass(frozen=True, slots=True)
class Piece:
    """A piece of a letter whose size answers to an equation, alone of its kind in a column of known width.

    Attributes
    ----------
    band, letter
        Whose it is.
    low, high
        It may be that long at no cost, metres. A metre less costs 1.
    down, up
        By how much it may be shorter, or longer, within the tolerance.
    price
        Of a metre more.
    """

    band: int
    letter: int
    low: float
    high: float
    down: float
    up: float
    price: float


@dataclass(slots=True, eq=False)
class Column:
    """An edge, weighed.

    Attributes
    ----------
    options
        The element of each word.
    state, owed
        The node it leads to; owed: no letter of any word ends there, so that one must begin.
    cost, omega
        ω + empty·E + loose·Λ, and ω, of its solid and its whole sized letters. Elastic ones are charged nothing.
    width, least
        Largest size in it; least size of a row that has to fill it (0: none has).
    symbols
        How many letters it holds; ties go to the fewer.
    reach
        Its cost with what the rows still cost each other behind it: the order of the local queue.
    firm
        It cannot be made wider without cost.
    elastic
        It holds a piece of a cut letter, or an unsized letter.
    piece
        Its only tied piece, where the column is firm and that is all there is to know of its lengths.
    tied
        Its price depends on lengths in a way that `piece` does not tell.
    """

    options: tuple[Option, ...]
    state: State
    owed: bool
    cost: float
    omega: float
    width: float
    least: float
    symbols: int
    ahead: float
    reach: float
    firm: bool
    elastic: bool
    piece: Piece | None
    tied: bool


class Lattice:
    """The network of one group, read in one direction.

    Attributes
    ----------
    group
        The group, its words reversed if the lattice is read backward.
    pairs
        Bounds for what is ahead.
    guides
        If there are any, edges that leave them are no part of this network.
    weighed
        How many edges have been weighed.
    """

    def __init__(
        self,
        group: Group,
        check: Callable[[], None] | None = None,
        pairs: Hierarchy | None = None,
        guides: Sequence[Guide] = (),
    ) -> None:
        self.group = group
        self.check = check
        self.pairs = pairs or Hierarchy(group)
        self.guides = tuple(guides)
        self.total = sum(2 * len(band.letters) for band in group.bands)
        self.weighed = 0
        self._kept: dict[tuple[State, bool], tuple[float, list[Column], float]] = {}
        self._ahead: dict[Places, float] = {}

    @property
    def states(self) -> int:
        """How many states the automaton has that reads uncut letters: Figure 8 shows 4 × 6."""
        return prod(len(band.letters) + 1 for band in self.group.bands)

    def ahead(self, state: State) -> float:
        """What the rows still cost each other at least."""
        key = tuple([p >> 2 for p in state])
        found = self._ahead.get(key)
        if found is None:
            found = self._ahead[key] = self.pairs.ahead(state)
        return found

    def finished(self, state: State) -> bool:
        """Whether every head has read its word."""
        return all(p >> 2 == band.end >> 2 for p, band in zip(state, self.group.bands, strict=True))

    def columns(
        self,
        state: State,
        owed: bool,
        limit: float,
        observer: Observer | None = None,
        way: str = "",
        index: int = 0,
    ) -> tuple[list[Column], float]:
        """The edges that leave a node, with what is ahead behind them at most `limit`; the cheapest come first.

        Equal ones come in the order of their number of symbols, so that more columns are tried first.

        Returns
        -------
        The edges, and what any other costs at least with what is ahead behind it.
        """
        key = (state, owed)
        known = self._kept.get(key)
        if known is None or (known[0] < limit and limit + EPS >= known[2]):
            watch = None if observer is None else Watch(observer, way, index, self.group, state)
            weighing = Weighing(self.group, self.pairs, state, limit, self.check, watch, self.guides)
            made = weighing.elements()
            found: list[Column] = []
            beyond = weighing.beyond
            before = {} if known is None else {column.options: column for column in known[1]}
            for options, ahead in made:
                if self.guides and not all(guide.leads(options) for guide in self.guides):
                    continue
                column = before.get(options) or self._close(options, ahead, owed, watch)
                if column is None:
                    continue
                if column.reach <= limit + EPS:
                    found.append(column)
                else:
                    beyond = min(beyond, column.reach)
            self.weighed += len(made)
            found.sort(key=_rank)
            known = self._kept[key] = (limit, found, beyond)
        found, beyond = known[1], known[2]
        if not found or found[-1].reach <= limit + EPS:
            return found, beyond
        end = bisect_right(found, limit + EPS, key=_reach)
        return found[:end], min(beyond, found[end].reach)

    def _close(
        self, options: tuple[Option, ...], ahead: float, owed: bool, watch: Watch | None
    ) -> Column | None:
        """Weigh a column, unless a constraint forbids it."""
        group = self.group
        forbidden = broken(group, owed, options)
        if forbidden is not None:
            if watch is not None and forbidden in ("boundary", "C1", "C3"):
                watch.forbidden(options, forbidden)
            return None
        column = tally(group, options)
        filled, omega = column.filling < inf, column.omega
        cost = price(group, column, omega)
        firm = filled or not column.elastic
        pieces = [(b, o.letters) for b, o in enumerate(options) if o.tied] if column.elastic else []
        piece: Piece | None = None
        if firm and len(pieces) == 1 and len(pieces[0][1]) == 1:
            slack = max(0.0, group.tolerance - omega)
            piece = Piece(
                pieces[0][0],
                pieces[0][1][0],
                column.low,
                column.high,
                min(column.low, slack),
                slack,
                slope(group, column.empties, column.softs),
            )
        if watch is not None:
            watch.weighed(options, omega, cost)
        return Column(
            options,
            tuple([option.target for option in options]),
            not any(option.ends for option in options),
            cost,
            omega,
            column.high,
            column.low if filled else 0.0,
            sum(len(option.letters) for option in options),
            ahead,
            cost + ahead,
            firm,
            column.elastic,
            piece,
            not firm or (bool(pieces) and piece is None),
        )


def _reach(column: Column) -> float:
    return column.reach


def _rank(column: Column) -> tuple[float, int]:
    return column.reach, column.symbols


def mirrored(group: Group, check: Callable[[], None] | None) -> Group:
    """The group with its words reversed; the group itself where that changes nothing."""
    words = [_reversed(band) for band in group.bands]
    if all(_alike(band.letters, word) for band, word in zip(group.bands, words, strict=True)):
        return group
    return make_group(
        [words[b] for b in group.band_of],
        group.canvas,
        group.tolerance,
        group.objective,
        cuts=all(band.cuts for band in group.bands),
        free=frozenset().union(*(band.free for band in group.bands)),
        check=check,
    )


def _reversed(band: Band) -> tuple[Letter, ...]:
    return tuple(reversed(band.letters))


def _alike(a: Sequence[Letter], b: Sequence[Letter]) -> bool:
    """Whether two words are the same to an alignment: it does not matter which letters are mirrored."""
    return all(replace(x, mirrored=False) == replace(y, mirrored=False) for x, y in zip(a, b, strict=True))
