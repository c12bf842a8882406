"""Partial alignments, and what the pieces of cut letters say about them."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from ...model.precision import EPS
from ..elements import Option, Position

__all__ = ["Edge", "Path", "Piece", "Range", "Span", "State", "Trailed", "gathered"]

State = tuple[Position, ...]

Piece = tuple[int, int, tuple[int, ...]]
"""Group, band, and the letters that share an element: most often one."""

_PRICE = 255
"""Stands where a piece has its group: not a piece, but what a metre more costs."""

Span = tuple[float, float, bool]
"""Of the pieces of a letter that are laid: least and greatest total size at no cost; one of them may have any length,
down to nothing."""

Range = tuple[tuple[Piece, ...], float, float, float, float]
"""Of the columns in which just these pieces stand: least and greatest total size of each at no cost, the price of
a metre more, which all of them may use (a metre less costs 1), and how much the tolerance on ω allows of both."""


@dataclass(slots=True, eq=False)
class Path:
    """A partial alignment: linked columns, the newest at the end.

    Attributes
    ----------
    group
        Which group it is in; the number of groups: it is complete.
    state
        Position of every band of that group.
    cost, width, columns
        Lower bound of J so far; W so far in this group; columns so far.
    firm
        No column so far could be widened without cost.
    owed
        No letter ended at the last boundary, so one must begin there.
    ranges
        The tied letters that have pieces in columns of which only a range of lengths matters.
    ahead
        What the rows still cost each other, by pairs.
    spans
        Per band: what the pieces of the letter it stands in have taken so far.
    pinched
        If all pieces are longer than nothing, its columns cost more than `cost`, by more than what a larger W gains.
    late
        If all pieces are longer than nothing, the whole costs more than its bound.
    learnt
        Unsized symbols that have stood as a whole: ``(symbol, least, greatest)`` size at no cost.
    made, step
        Its columns have been made up to this bound, where they are made a few at a time; how far to go next.
    trail
        The columns whose price depends on the lengths of pieces. Paths are compared only where it is the
        same.
    """

    group: int
    state: State
    cost: float
    width: float
    columns: int
    firm: bool = True
    owed: bool = False
    trail: tuple[object, ...] = ()
    parent: Path | None = None
    column: tuple[Option, ...] = ()
    ranges: tuple[Range, ...] = ()
    ahead: float = 0.0
    spans: tuple[Span, ...] = ()
    pinched: bool = False
    late: bool = False
    learnt: tuple[tuple[str, float, float], ...] = ()
    dropped: bool = False
    made: float = -inf
    step: float = 0.0


@dataclass(slots=True, eq=False)
class Edge:
    """A column that may come next.

    Attributes
    ----------
    cost, omega
        ω + empty·E + loose·Λ of its solid and whole letters; ω of them.
    width, least
        Largest size in it; least size of a row that has to fill it.
    rise
        By how much it makes the bound by pairs rise: `cost` + what is ahead after it − what was ahead before it.
    ahead
        What the rows still cost each other after it, by pairs.
    firm, owed, tied
        It cannot be widened without cost; no letter ends at its right edge; its price depends on the
        lengths of pieces.
    pieces, up
        The tied pieces, where their columns are comparable by their ranges; what a metre by which they widen
        the column costs.
    pinched
        It costs more if its pieces are longer than nothing, for one of them stands with letters that fill it.
    """

    column: tuple[Option, ...]
    state: State
    cost: float
    omega: float
    width: float
    least: float
    rise: float
    ahead: float
    firm: bool
    owed: bool
    tied: bool
    pieces: tuple[tuple[int, tuple[int, ...]], ...]
    up: float
    pinched: bool = False


def gathered(
    ranges: tuple[Range, ...], trail: tuple[object, ...], g: int, edge: Edge, tolerance: float
) -> tuple[Range, ...]:
    """Add the pieces of a column to what is known of their letters.

    Columns with the same pieces act as one: a metre that one of them needs more can be laid into the same column as
    what the others need more. A letter that is complete and within its range needs nothing, whatever the
    others need, and is forgotten.

    Of a column's pieces, those that want more want the largest of that, those that want less the largest of that, and
    both together no more than the tolerance has left beside ω. Sets of that shape add up to one of that shape, so
    that what columns allow adds up as well. A metre more is laid where it is cheapest; where the tolerance may bind
    (it is not infinite), only columns with the same price of it act as one.
    """
    key = tuple([(g, b, letters) for b, letters in edge.pieces])
    if tolerance < inf:
        key = (*key, (_PRICE, round(edge.up * 1e9), ()))
    found = {own[0]: own for own in ranges}
    _join(found, (key, edge.least, edge.width, edge.up, tolerance - edge.omega))
    for b, letters in edge.pieces:
        option = edge.column[b]
        if len(letters) == 1 and option.ends and option.sized is not None:
            _settle(found, trail, (g, b, letters), option.sized)
    return tuple([found[own] for own in sorted(found)])


def _join(found: dict[tuple[Piece, ...], Range], new: Range) -> None:
    old = found.get(new[0])
    if old is not None:
        new = (new[0], new[1] + old[1], new[2] + old[2], min(new[3], old[3]), new[4] + old[4])
    found[new[0]] = new


def _settle(
    found: dict[tuple[Piece, ...], Range], trail: tuple[object, ...], piece: Piece, size: float
) -> None:
    """Forget a complete letter, if no column needs to change for it and it has no other pieces."""
    g, b, (i,) = piece
    low = high = 0.0
    standing: list[Range] = []
    for entry in found.values():
        for other in entry[0]:
            if other == piece:
                standing.append(entry)
                low, high = low + entry[1], high + entry[2]
            elif other[0] == g and other[1] == b and i in other[2]:
                return
    if not low - EPS <= size <= high + EPS:
        return
    if any(isinstance(own, Trailed) and own.group == g and i in own.column[b].letters for own in trail):
        return
    for entry in standing:
        del found[entry[0]]
    for entry in standing:
        rest = tuple([other for other in entry[0] if other != piece])
        if any(other[0] != _PRICE for other in rest):
            _join(found, (rest, *entry[1:]))


@dataclass(frozen=True, slots=True)
class Trailed:
    """A column whose price depends on lengths in a way that only its own pieces can tell."""

    group: int
    column: tuple[Option, ...]
