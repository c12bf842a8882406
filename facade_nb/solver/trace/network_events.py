"""What a search did in a network, told: nodes, edges, what was refused, prices (the paper's 5.2)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isfinite
from typing import Any

from ..alignment.bands import Band
from ..alignment.elements import Option
from ..alignment.group import Group
from ..alignment.observer import Partial
from ..alignment.pricing import Priced
from ..alignment.reference.network import Network
from ..alignment.reference.shortfall import ahead
from ..alignment.rules import tally
from ..events import (
    BandNote,
    ColumnNote,
    ControlsAligned,
    EdgeRefused,
    EdgeWeighed,
    Event,
    LeftOut,
    LetterNote,
    LimitRaised,
    NetworkClosed,
    NetworkOpened,
    NodeTaken,
    PairsMerged,
    RegionTraced,
    StructurePriced,
    WaysMet,
)
from ..model.letters import Letter
from ..model.precision import EPS
from .recorder import Walk
from .weights import Refusal, columns_at, refusal, weigh

__all__ = ["Walked", "band_notes", "column_note", "letter_note"]

NODES = 300
"""At so many nodes the columns that were refused are told:"""
REFUSED = 40
"""so many of each constraint,"""
LOOKED = 1_000
"""and so many columns looked at;"""
BUDGET = 30_000
"""so many in a whole network."""


_PRUNED = {
    "": "No alignment that keeps the tolerance begins like that.",
    "bound": "An alignment with it costs at least {bound:.3g} m; the limit is {against:.3g} m.",
    "known": "It costs {cost:.3g} m so far; a path that costs {against:.3g} m has come to the same node.",
    "length": "With pieces that are longer than nothing it costs more than the {against:.3g} m that are allowed.",
    "best": "An alignment with it costs at least {bound:.3g} m; the best so far costs {against:.3g} m.",
}
"""Why an edge that is permitted was not followed: by the reason."""


def letter_note(letter: Letter) -> LetterNote:
    """A letter, as events have it."""
    return LetterNote(
        letter.symbol,
        letter.size,
        letter.transparent,
        letter.opaque,
        letter.attached,
        letter.unoccludable,
        letter.mirrored,
        letter.origin,
    )


def band_notes(group: Group) -> tuple[BandNote, ...]:
    """The distinct words of a group."""
    return tuple(BandNote(tuple(map(letter_note, band.letters)), band.rows) for band in group.bands)


def column_note(group: Group, column: Sequence[Option], sizes: Sequence[Sequence[float]]) -> ColumnNote:
    """A column of a priced structure."""
    total = tally(group, column, [sum(own) for own in sizes])
    return ColumnNote(
        tuple(option.letters for option in column),
        _places([option.target for option in column]),
        tuple(map(tuple, sizes)),
        total.high,
        total.omega,
    )


class Walked:
    """A walk, with a number for each path: in the order in which they came up, those of `end` in any case."""

    def __init__(self, walk: Walk, end: Partial | None) -> None:
        self.walk = walk
        self._number: dict[int, int] = {}
        self._left = self._looked = 0
        self._later: list[float] | None = None
        self._alike: dict[object, list[Partial]] | None = None
        self._paths: list[Partial] = []  # holds on to them, so that an identity stays one
        for kind, *own in walk.steps:
            if kind in ("node", "edge", "price"):
                self._name(own[0])
        self._told = len(self._paths)
        for path in _chain(end):
            self._name(path)

    def _name(self, path: Partial) -> int:
        number = self._number.setdefault(id(path), len(self._number))
        if number == len(self._paths):
            self._paths.append(path)
        return number

    def chain(self, end: Partial) -> tuple[int, ...]:
        """Numbers of the paths that lead to one, itself at the end."""
        return tuple(self._number[id(path)] for path in _chain(end))

    def events(self) -> Iterator[Event]:
        """The network, from its opening to its closing."""
        walk = self.walk
        axis, network, groups = walk.axis, walk.number, walk.groups
        bands = tuple(map(band_notes, groups))
        yield NetworkOpened(
            axis, network, walk.names, bands, groups[0].canvas, groups[0].tolerance, walk.search
        )
        made, seen = self._made(), set[object]()
        limit: float | None = None
        for kind, *own in walk.steps:
            if kind == "limit":
                limit, proven = (value if isfinite(value) else None for value in own)
                yield LimitRaised(axis, network, limit, proven)
            elif kind == "node":
                yield self._node(*own)
                path: Partial = own[0]
                node = (path.group, path.state, path.owed)
                if path.group < len(groups) and node not in seen:
                    seen.add(node)
                    if len(seen) <= NODES:
                        yield from self._refused(path, made.get(self._number[id(path)], set()), limit)
                    else:
                        self._left += 1
            elif kind == "edge":
                yield self._edge(*own)
            elif kind == "price":
                yield self._price(*own)
            else:
                yield _observed(walk, kind, own)
        if walk.left:
            yield LeftOut(axis, f"steps in network {network}", walk.left)
        for late in self._paths[self._told :]:
            if late.parent is not None:
                yield self._edge(late, None, False)
        if self._left:
            yield LeftOut(axis, f"refused edges in network {network}", self._left)
        bound = walk.bound
        yield NetworkClosed(
            axis,
            network,
            walk.taken,
            walk.seconds,
            bound if bound is not None and isfinite(bound) else None,
            walk.ties,
            walk.cut,
        )

    def _node(self, path: Partial, bound: float) -> NodeTaken:
        return NodeTaken(
            self.walk.axis,
            self.walk.number,
            path.group,
            _places(path.state),
            path.cost,
            bound,
            path=self._number[id(path)],
            width=path.width,
            columns=path.columns,
        )

    def _edge(self, path: Partial, bound: float | None, dropped: bool) -> EdgeWeighed:
        parent = path.parent
        assert parent is not None
        weight = weigh(self.walk.groups[parent.group], path.column)
        return EdgeWeighed(
            self.walk.axis,
            self.walk.number,
            parent.group,
            _places(parent.state),
            tuple(option.letters for option in path.column),
            weight.omega,
            path.cost - parent.cost,
            _places([option.target for option in path.column]),
            weight.width,
            bound,
            "dropped" if dropped else "overtaken" if path.dropped else "open",
            path=self._number[id(path)],
            parent=self._name(parent),
            rival=self._rival(path, dropped),
        )

    def _rival(self, path: Partial, dropped: bool) -> int | None:
        """The path to the same node that makes this one needless: the cheapest known before, or one that came later."""
        if not (dropped or path.dropped):
            return None
        if self._alike is None:
            self._alike = {}
            for own in self._paths[: self._told]:
                self._alike.setdefault((own.group, tuple(own.state), own.owed), []).append(own)
        number = self._number[id(path)]
        others = [
            own
            for own in self._alike.get((path.group, tuple(path.state), path.owed), [])
            if (self._number[id(own)] < number) == dropped
            and own is not path
            and own.cost <= path.cost + EPS
            and own.width <= path.width + EPS
        ]
        best = min(others, key=lambda own: (own.dropped, own.cost, -own.columns), default=None)
        return None if best is None else self._number[id(best)]

    def _price(self, path: Partial, priced: Priced | None) -> StructurePriced:
        axis, network, number = self.walk.axis, self.walk.number, self._number[id(path)]
        if priced is None:
            return StructurePriced(axis, network, number, None, None, path.columns, False)
        return StructurePriced(
            axis,
            network,
            number,
            priced.cost,
            priced.omega,
            priced.columns,
            priced.proper,
            priced.widths,
            dict(priced.unsized),
        )

    def _made(self) -> dict[int, set[object]]:
        """Per path: the columns that it was made longer by."""
        made: dict[int, set[object]] = {}
        for path in self._paths:
            if path.parent is not None:
                key = tuple((option.letters, option.target) for option in path.column)
                made.setdefault(self._number[id(path.parent)], set()).add(key)
        return made

    def _refused(self, path: Partial, made: set[object], limit: float | None) -> Iterator[EdgeRefused]:
        """At a node: the columns that were not made, each with what forbids it, or why they were pruned."""
        group = self.walk.groups[path.group]
        count: dict[str, int] = {}
        for looked, (column, refused) in enumerate(columns_at(group, path.state, path.owed)):
            if looked >= LOOKED or self._looked >= BUDGET:
                self._left += 1
                return
            self._looked += 1
            if refused is None:
                if tuple((o.letters, o.target) for o in column if o is not None) in made:
                    continue
                if min(count.get("width", 0), count.get("bound", 0)) >= REFUSED:
                    self._left += 1  # whichever of the two it is, it is one too many
                    continue
                refused = self._too_dear(path, [option for option in column if option is not None], limit)
            count[refused.constraint] = count.get(refused.constraint, 0) + 1
            if count[refused.constraint] > REFUSED:
                self._left += 1
                continue
            yield EdgeRefused(
                self.walk.axis,
                self.walk.number,
                path.group,
                _places(path.state),
                tuple(None if option is None else option.letters for option in column),
                refused.constraint,
                tuple(None if option is None else option.target >> 2 for option in column),
                refused.bands,
                refused.letters,
                refused.amount,
                refused.text,
                parent=self._number[id(path)],
                cost=refused.cost,
                bound=refused.bound,
                against=refused.against,
            )

    def _too_dear(self, path: Partial, column: Sequence[Option], limit: float | None) -> Refusal:
        """Why a column was not made that keeps all constraints: by W, or by its cost.

        The search does not make what, with all that rows two by two still cost each other, is above its limit.
        """
        group = self.walk.groups[path.group]
        everyone = tuple(range(len(column)))
        weight = weigh(group, column)
        width = path.width + weight.width
        over = width + max(b.at_least(o.target) for b, o in zip(group.bands, column, strict=True))
        over -= group.canvas + group.tolerance
        if over > EPS:
            return Refusal("width", everyone, (), f"W would be {over:.3g} m more than canvas + μ.", over)
        last = all(o.target >> 2 == band.end >> 2 for o, band in zip(column, group.bands, strict=True))
        under = group.canvas - group.tolerance - width
        if last and group.stiff and under > EPS:
            return Refusal("width", everyone, (), f"W would be {under:.3g} m less than canvas − μ.", under)
        if self._later is None:
            self._later = Network(self.walk.groups).later
        cost = path.cost + weight.cost
        bound = cost
        if self.walk.search != "no-heuristic":
            bound += ahead(group, tuple(o.target for o in column)) + self._later[path.group + 1]
        text = "An alignment with it costs more than the search had to look at."
        if limit is None or bound <= limit + EPS:
            return Refusal("bound", (), (), text)
        text = f"An alignment with it costs at least {bound:.3g} m; the limit is {limit:.3g} m."
        return Refusal("bound", (), (), text, bound - limit, cost, bound, limit)


def _observed(walk: Walk, kind: str, own: Sequence[Any]) -> Event:
    """What the paper's search told as `paper.observer.Observer`."""
    axis, network = walk.axis, walk.number
    if kind == "met":
        group, places, cost, columns = own
        return WaysMet(axis, network, group, places, cost, columns)
    if kind in ("prealigned", "merged"):
        nodes, cost = own
        kind_of = ControlsAligned if kind == "prealigned" else PairsMerged
        return kind_of(axis, network, nodes, cost if isfinite(cost) else None)
    way, group, places, *rest = own
    if kind == "visited":
        cost, bound = rest
        return NodeTaken(axis, network, group, places, cost, bound, way=way)
    if kind == "traced":
        words, lower, upper = rest
        return RegionTraced(axis, network, group, places, words, lower, upper, way=way)
    if kind == "weighed":
        column, error, cost, after = rest
        return EdgeWeighed(axis, network, group, places, column, error, cost, after, way=way)
    if kind == "pruned":
        column, after, reason, cost, bound, against = rest
        return EdgeRefused(
            axis,
            network,
            group,
            places,
            column,
            reason,
            after,
            text=_PRUNED[reason if isfinite(bound) else ""].format(cost=cost, bound=bound, against=against),
            way=way,
            cost=cost,
            bound=bound if isfinite(bound) else None,
            against=against if isfinite(against) else None,
        )
    column, constraint = rest
    options = [_option(band, letters) for band, letters in zip(walk.groups[group].bands, column, strict=True)]
    why = refusal(walk.groups[group], constraint == "boundary", tuple(options))
    if why is None or why.constraint != constraint:  # which pieces they were is not told
        return EdgeRefused(axis, network, group, places, column, constraint, way=way)
    return EdgeRefused(
        axis,
        network,
        group,
        places,
        column,
        constraint,
        None,
        why.bands,
        why.letters,
        why.amount,
        why.text,
        way,
    )


def _option(band: Band, letters: tuple[int, ...]) -> Option:
    """An element with these letters; of a letter that may be cut, its rest and no more."""
    if not letters:
        return Option(0, empty=True)
    place = 8 * letters[0]
    if band.letters[letters[0]].transparent and band.cuts:
        place += 4
    return next(option for option in band.options(place) if option.letters == letters)


def _places(state: Sequence[int]) -> tuple[int, ...]:
    return tuple(position >> 2 for position in state)


def _chain(end: Partial | None) -> list[Partial]:
    out: list[Partial] = []
    while end is not None:
        out.append(end)
        end = end.parent
    return out[::-1]
