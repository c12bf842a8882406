"""What a column may hold, and what it costs: C1 to C4, ω, E and Λ (the paper's 5.2 and Eq. 9; docs/solver.md).

This is the one place in Python where they stand. The reference search, the paper's search, prices and traces all ask
here. The compiled search, the sweeps over whole arrays and the browser's drag say the same in their own ways; tests
hold each of them to this.

The constraints, numbered as in docs/solver.md:

- C1: where a row is empty, or has a letter that is neither transparent nor opaque, some row has opaque letters only;
- C2: a row of a column is all transparent, or not at all;
- C3: above a solid unoccludable letter stand only ε and letters that are transparent or opaque;
- C4: no column is empty beside a solid attached letter that ends or begins an element.

C2 and C4 are about one row and the column before, so they decide which elements a word may put into a column. C1 and C3
are about all rows of a column.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf
from typing import Literal, NamedTuple, Protocol

from ..model.letters import Letter
from ..model.objective import Objective
from ..model.precision import EPS
from .elements import Option, Position

__all__ = [
    "Broken",
    "Rows",
    "Tally",
    "after_empty",
    "after_solid",
    "alike",
    "broken",
    "fills",
    "may_be_empty",
    "may_begin_solid",
    "needy",
    "occluded",
    "price",
    "slope",
    "tally",
    "unbacked",
]

Broken = Literal["empty", "boundary", "C1", "C3", "omega"]
"""Why a column may not be: no row has a letter in it, its first boundary is nobody's, a constraint, the tolerance."""


class Rows(Protocol):
    """What the rules ask about a group (`group.Group`)."""

    @property
    def objective(self) -> Objective:
        """What is minimised."""

    @property
    def tolerance(self) -> float:
        """μ, metres."""

    @property
    def waived(self) -> bool:
        """No letter of the group is opaque, so C1 does not apply."""

    @property
    def guards(self) -> tuple[tuple[int, ...], ...]:
        """Per band: the bands with a row above one of its rows."""

    @property
    def by_empty(self) -> float:
        """What a metre of a column costs that is empty in one band."""

    @property
    def by_loose(self) -> float:
        """What a metre costs that one band has loose."""


# C2 and C4: which elements a word may put into a column


def alike(first: Letter, letter: Letter) -> bool:
    """Whether two neighbours may share an element: both transparent, or neither (C2)."""
    return first.transparent == letter.transparent


def may_be_empty(position: Position) -> bool:
    """Whether the next column may be empty in this row: not behind an attached letter (C4)."""
    return not position & 1


def may_begin_solid(position: Position) -> bool:
    """Whether a solid letter may come next: not an attached one beside an empty column (C4)."""
    return not position & 2


def after_empty(word: Sequence[Letter], position: Position) -> Position:
    """Where a word stands after an empty element."""
    i, mid = position >> 3, position & 4
    held = i < len(word) and not mid and word[i].attached and not word[i].transparent
    return 8 * i + mid + (2 if held else 0)


def after_solid(word: Sequence[Letter], j: int) -> Position:
    """Where a word stands after an element that ends with its whole letter j."""
    return 8 * (j + 1) + (1 if word[j].attached and not word[j].transparent else 0)


# ω, E and Λ: what a column costs


class Tally(NamedTuple):
    """What the elements of a column, or of some of its rows, come to.

    Attributes
    ----------
    high
        The largest size, metres: the column's width. Of an elastic element its whole sized letters count.
    filling
        The least size among rows that have to fill the column; infinite where there is none.
    least
        The least size of all rows; infinite where none has a size.
    empties
        Number of empty rows.
    loose
        Σ over rows of what their neighbouring letters share (`Option.loose`), metres.
    softs, soft_sizes
        Number of rows with a letter that is not opaque, and the sum of their sizes.
    elastic
        Some row has no fixed size.
    """

    high: float = 0.0
    filling: float = inf
    least: float = inf
    empties: int = 0
    loose: float = 0.0
    softs: int = 0
    soft_sizes: float = 0.0
    elastic: bool = False

    def plus(self, option: Option, plain: bool, size: float | None = None) -> Tally:
        """The same with one row more; `size` is that of an elastic element, once it is known."""
        high, filling, least, empties, loose, softs, soft_sizes, elastic = self
        if option.empty:
            return Tally(high, filling, least, empties + 1, loose, softs, soft_sizes, elastic)
        if size is None:
            size = option.size
        if size is None:
            own = option.least
            return Tally(own if own > high else high, filling, least, empties, loose, softs, soft_sizes, True)
        if option.soft:
            softs, soft_sizes = softs + 1, soft_sizes + size
        if size < filling and (plain or not option.soft):
            filling = size
        return Tally(
            size if size > high else high,
            filling,
            size if size < least else least,
            empties,
            loose + option.loose,
            softs,
            soft_sizes,
            elastic,
        )

    def joined(self, other: Tally) -> Tally:
        """Of the rows of both."""
        return Tally(
            max(self.high, other.high),
            min(self.filling, other.filling),
            min(self.least, other.least),
            self.empties + other.empties,
            self.loose + other.loose,
            self.softs + other.softs,
            self.soft_sizes + other.soft_sizes,
            self.elastic or other.elastic,
        )

    @property
    def low(self) -> float:
        """The least size that counts in ω.

        Rows with a letter that is not opaque need not fill the column, so they count only where no other row does. An
        elastic row is as wide as the column.
        """
        if self.filling < inf:
            return self.filling
        return self.high if self.elastic or self.least == inf else self.least

    @property
    def omega(self) -> float:
        """ω of a whole column (Eq. 9, and its variant for rows that are not opaque), metres."""
        low = self.low
        return self.high - low if self.high > low else 0.0

    @property
    def omega_so_far(self) -> float:
        """What ω is at least, whatever rows come yet."""
        return self.high - self.filling if self.filling < inf else 0.0


def tally(group: Rows, column: Sequence[Option | None], sizes: Sequence[float | None] | None = None) -> Tally:
    """What a column comes to; None stands for a row that is not chosen yet.

    Parameters
    ----------
    sizes
        Per band: the size of its element, metres, where an elastic one has got one.
    """
    plain = group.objective.plain
    # `Tally.plus` row by row, without a tally of each: columns are weighed by the hundred thousand
    high, loose, soft_sizes = 0.0, 0.0, 0.0
    filling = least = inf
    empties = softs = 0
    elastic = False
    for b, option in enumerate(column):
        if option is None:
            continue
        if option.empty:
            empties += 1
            continue
        size = option.size if sizes is None or sizes[b] is None else sizes[b]
        if size is None:
            elastic = True
            high = max(high, option.least)
            continue
        if option.soft:
            softs += 1
            soft_sizes += size
        if size < filling and (plain or not option.soft):
            filling = size
        if size > high:
            high = size
        if size < least:
            least = size
        loose += option.loose
    return Tally(high, filling, least, empties, loose, softs, soft_sizes, elastic)


def price(group: Rows, column: Tally, omega: float) -> float:
    """ω + empty·E + loose·Λ of a column, metres."""
    return (
        omega
        + group.by_empty * column.empties * column.high
        + group.by_loose * (column.loose + column.softs * column.high - column.soft_sizes)
    )


def slope(group: Rows, empties: int, softs: int) -> float:
    """How fast the price of a column grows with its width, where its other rows keep their sizes."""
    return 1.0 + group.by_empty * empties + group.by_loose * softs


def fills(group: Rows, option: Option) -> bool:
    """Whether a row counts in ω, whatever the others are: it has to fill its column."""
    return group.objective.plain or not option.soft


# C1, C3 and boundaries: what all rows of a column say together


def needy(option: Option) -> bool:
    """Whether an element asks for another row with opaque letters only (C1)."""
    return option.empty or option.soft


def unbacked(group: Rows, column: Sequence[Option]) -> bool:
    """Whether C1 forbids a column: some row asks for another one that is all opaque, and there is none."""
    return (
        not group.waived
        and any(option.empty or option.soft for option in column)
        and not any(option.opaque for option in column)
    )


def occluded(group: Rows, column: Sequence[Option | None]) -> Iterator[tuple[int, int]]:
    """Pairs of bands for which C3 forbids a column: an unoccludable letter, and one above it that is not opaque."""
    for b, option in enumerate(column):
        if option is not None and option.guarded:
            for above in group.guards[b]:
                other = column[above]
                if other is not None and other.soft:
                    yield b, above


def broken(group: Rows, owed: bool, column: Sequence[Option], omega: float | None = None) -> Broken | None:
    """The first rule that a whole column breaks; None where it breaks none.

    Parameters
    ----------
    owed
        No letter ended at the boundary before the column, so that one has to begin there.
    omega
        ω of the column, metres, where the caller knows it already.
    """
    if all(option.empty for option in column):
        return "empty"
    if owed and not any(option.begins for option in column):
        return "boundary"
    if unbacked(group, column):
        return "C1"
    if next(occluded(group, column), None) is not None:
        return "C3"
    if (tally(group, column).omega if omega is None else omega) > group.tolerance + EPS:
        return "omega"
    return None
