"""What pieces of cut letters have cost so far, before a linear programme knows their lengths.

Where a column is held by whole letters and has one piece of a letter whose size is given, the piece may be
between two lengths at no cost (`lattice.Piece`), and pays for every metre beyond. A letter cut over several such
columns adds up: F(y), the least cost of the pieces being y metres long together, is again convex, zero from Σ low
to Σ high, with slope −1 before and the cheapest columns' prices after, as far as the tolerance goes.

A `Stretch` is that function. When the letter ends, its size decides what is paid, exactly. Where an unsized
symbol stands several times, its letters have one size y, and the sum of their functions has a least value. Pieces
that share a column with others are left to the linear programme: their stretch is *mixed*.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from math import inf

from ...model.precision import EPS
from ..bands import Band
from ..group import Group
from .decision_network import Column, Piece

__all__ = ["Stretch", "excess", "ledger_bound", "merged", "with_column"]


@dataclass(frozen=True, slots=True)
class Stretch:
    """F of one letter.

    Attributes
    ----------
    group, band, letter
        Whose it is.
    low, high
        F is zero between them.
    down
        How far below `low` it reaches.
    ups
        What a metre above `high` costs and how far that goes, cheapest first.
    ended
        The letter is complete.
    mixed
        Some pieces stand in columns of which more has to be known.
    """

    group: int
    band: int
    letter: int
    low: float = 0.0
    high: float = 0.0
    down: float = 0.0
    ups: tuple[tuple[float, float], ...] = ()
    ended: bool = False
    mixed: bool = False

    @property
    def reach(self) -> float:
        """Greatest length within the tolerance."""
        return self.high + sum(length for _, length in self.ups)

    def with_piece(self, piece: Piece, ended: bool) -> Stretch:
        """One more piece."""
        return replace(
            self,
            low=self.low + piece.low,
            high=self.high + piece.high,
            down=self.down + piece.down,
            ups=_ups([*self.ups, (piece.price, piece.up)]),
            ended=ended,
        )

    def covers(self, other: Stretch) -> bool:
        """Whether F is nowhere above the other's."""
        return (
            self.low <= other.low + EPS
            and self.high >= other.high - EPS
            and self.low - self.down <= other.low - other.down + EPS
            and self.reach >= other.reach - EPS
            and (
                not self.ups
                or not other.ups
                or self.ups[-1][0] <= other.ups[0][0] + EPS
                or self.ups == other.ups
            )
        )


def _ups(ups: Iterable[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
    gathered: dict[float, float] = {}
    for price, length in ups:
        if length > 0:
            gathered[price] = gathered.get(price, 0.0) + length
    return tuple(sorted(gathered.items()))


def merged(a: Stretch, b: Stretch) -> Stretch:
    """F of a letter of which part was read from either side."""
    return Stretch(
        a.group,
        a.band,
        a.letter,
        a.low + b.low,
        a.high + b.high,
        a.down + b.down,
        _ups([*a.ups, *b.ups]),
        True,
        a.mixed or b.mixed,
    )


def excess(stretch: Stretch, size: float, gain: float = 0.0) -> tuple[float, float]:
    """F(size), and by how much the pieces widen their columns; infinite beyond the tolerance.

    `gain`: what a metre of that may save elsewhere.
    """
    if size < stretch.low - EPS:
        lack = stretch.low - size
        return (lack, 0.0) if lack <= stretch.down + EPS else (inf, 0.0)
    over = size - stretch.high
    if over <= EPS:
        return 0.0, 0.0
    cost = 0.0
    left = over
    for price, length in stretch.ups:
        taken = min(left, length)
        cost += (price - gain) * taken
        left -= taken
    return (cost, over) if left <= EPS else (inf, 0.0)


def with_column(
    ledger: tuple[Stretch, ...], g: int, bands: Sequence[Band], column: Column
) -> tuple[tuple[Stretch, ...], float, float, bool] | None:
    """Enter a column's tied pieces.

    Returns
    -------
    The ledger, what its letters that have just ended cost beyond their column, by how much that widens them, and
    whether one was closed that way; None where a letter cannot have its size.
    """
    own = {(s.group, s.band, s.letter): s for s in ledger}
    cost = wider = 0.0
    closed = False
    if column.piece is not None:
        piece = column.piece
        key = (g, piece.band, piece.letter)
        option = column.options[piece.band]
        stretch = own.get(key, Stretch(*key)).with_piece(piece, option.ends)
        size = bands[piece.band].letters[piece.letter].size
        if size is not None and not stretch.mixed:
            if option.ends:
                cost, wider = excess(stretch, size)
                closed = True
                own.pop(key, None)
            elif stretch.low - stretch.down > size + EPS:
                cost = inf
            if cost == inf:
                return None
        if not closed:
            own[key] = stretch
    else:
        for b, option in enumerate(column.options):
            if option.tied:
                for i in option.letters:
                    ended = i != option.letters[-1] or option.ends
                    letter = bands[b].letters[i]
                    whole = (i != option.letters[0] or option.begins) and ended
                    if letter.size is not None and whole:
                        continue  # its size is given
                    own[g, b, i] = replace(own.get((g, b, i), Stretch(g, b, i)), mixed=True, ended=ended)
    return tuple(own[key] for key in sorted(own)), cost, wider, closed


def ledger_bound(ledger: Iterable[Stretch], groups: Sequence[Group]) -> float:
    """What letters that have not been closed cost at least, beyond their columns.

    A letter in hand may be as long as it is; it cannot become shorter. Letters of one unsized symbol are equally
    long; as they make columns wider, W may come nearer to the canvas, which is charged as it was without that.
    """
    total = 0.0
    symbols: dict[str, list[Stretch]] = {}
    for stretch in ledger:
        if stretch.mixed:
            continue
        letter = groups[stretch.group].bands[stretch.band].letters[stretch.letter]
        if letter.size is None:
            symbols.setdefault(letter.symbol, []).append(stretch)
        else:
            total += max(0.0, stretch.low - letter.size)
    for own in symbols.values():
        if len(own) > 1:
            total += _common(own, max(groups[s.group].objective.fit for s in own))
    return total


def _common(own: Sequence[Stretch], gain: float) -> float:
    """Least sum of F at one common length; of a letter that has not ended, only its lower side counts."""
    best = inf
    turns: set[float] = set()
    for s in own:
        turns.update((s.low, s.low - s.down))
        if s.ended:
            turns.update(accumulate((length for _, length in s.ups), initial=s.high))
    for y in turns:
        cost = 0.0
        for s in own:
            cost += excess(s, y, gain)[0] if s.ended or y < s.low else 0.0
        best = min(best, cost)
    return best
