"""Many words, pair by pair (supplement 3.3): bounds for what is ahead of a node.

Leave all rows but two out of an alignment, and the columns that are empty then. What remains aligns the two,
and no column costs more than before. So the least cost of aligning what two words have left, found for each
pair of places by dynamic programming over their own small lattice, is a lower bound for any number of words.

Every word is paired with one of them, the *reference*, which is the one with the most solid letters. Under the
paper's objective the dearest pair is the bound. Where empty and loose letters count, the pairs are added up: E
and Λ are sums over rows, so each pair brings those of its own word and an equal part of the reference's; ω is
the largest difference in a column, hence at least the mean of the pairs' differences.

Constraints are left out and elastic elements cost nothing, which only lowers the bound.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from ..bands import Band
from ..elements import Position
from ..group import Group

__all__ = ["Hierarchy", "PairBound"]

_Move = tuple[int, float, float, bool]
"""Place after an element, its size (negative: elastic), what its joined letters cost, holds a soft letter."""


class PairBound:
    """Least cost of aligning the rests of the reference and of one other word, by their places.

    Parameters
    ----------
    by_empty, by_loose
        What a metre costs that a row leaves empty, or loose.
    part
        The part of ω and of the reference's own costs that this pair may count.
    plain
        Non-opaque letters count in ω like others (Eq. 9).
    """

    def __init__(
        self, reference: Band, other: Band, by_empty: float, by_loose: float, part: float, plain: bool
    ) -> None:
        self._bands = (reference, other)
        self._prices = (by_empty, by_loose, part)
        self._plain = plain
        self._moves: tuple[list[list[_Move]], list[list[_Move]]] | None = None
        self._rows: list[list[float] | None] = [None] * (2 * len(reference.letters) + 1)

    def row(self, place: int) -> list[float]:
        """The bounds with the reference at a place, by the place of the other; made from the end, as far as asked."""
        found = self._rows[place]
        if found is None:
            if self._moves is None:
                self._moves = (_moves(self._bands[0]), _moves(self._bands[1]))
            for p in range(len(self._rows) - 1, place - 1, -1):
                if self._rows[p] is None:
                    self._rows[p] = self._fill(p, *self._moves)
            found = self._rows[place]
            assert found is not None
        return found

    def _fill(self, p: int, moves_a: list[list[_Move]], moves_b: list[list[_Move]]) -> list[float]:
        check = self._bands[0].check
        if check is not None:
            check()
        by_empty, by_loose, part = self._prices
        last = len(moves_b) - 1
        row = [inf] * (last + 1)
        reach: list[tuple[float, float, float, list[float]]] = []
        for end, size, own, soft in moves_a[p]:
            after = row if end == p else self._rows[end]  # the middle of a cut letter leaves it where it is
            assert after is not None
            # a metre by which the reference is short
            up = part * by_loose if soft and not self._plain else part
            reach.append((size, own * by_loose * part, up, after))
        for q in range(last, -1, -1):
            best = 0.0 if q == last and p == len(self._rows) - 1 else inf
            moves = moves_b[q]
            growing = bool(moves) and moves[-1][1] >= 0  # later elements are longer
            for end, size, own, _ in moves:  # the reference is empty
                value = row[end] + own * by_loose + (by_empty * part * size if size > 0 else 0.0)
                best = min(best, value)
            for size_a, own_a, up, after in reach:
                if own_a >= best:
                    continue
                value = own_a + (by_empty * size_a if size_a > 0 else 0.0) + after[q]  # the other is empty
                best = min(best, value)
                for end, size, own, soft in moves:
                    value = own_a + own * by_loose
                    if size >= 0 and size_a >= 0:
                        over = size - size_a
                        if over > 0:
                            value += over * up
                            if growing and value >= best:
                                break
                        else:
                            value -= over * (by_loose if soft and not self._plain else part)
                    value += after[end]
                    best = min(best, value)
            row[q] = best
        return row


def _moves(band: Band) -> list[list[_Move]]:
    """Per place: the elements that may come next, ε left out."""
    out: list[list[_Move]] = []
    for place in range(2 * len(band.letters) + 1):
        i, mid = place >> 1, place & 1
        if mid and not band.letters[i].transparent:
            out.append([])  # such a letter is never cut
            continue
        found = [
            (o.target >> 2, -1.0 if o.size is None else o.size, o.loose, o.soft)
            for o in band.options(8 * i + 4 * mid)
            if not o.empty
        ]
        out.append(sorted(found, key=lambda move: (move[1] < 0, move[1])))
    return out


class Hierarchy:
    """The pairs of a group.

    Attributes
    ----------
    reference
        The word that all others are paired with.
    tables
        Per band its pair; None for the reference.
    added
        Pairs are added up; otherwise the dearest counts.
    """

    def __init__(self, group: Group) -> None:
        objective = group.objective
        self.added = not objective.plain
        self.reference = max(
            range(len(group.bands)), key=lambda b: (_solid(group.bands[b]), len(group.bands[b].letters))
        )
        part = 1.0 / max(1, len(group.bands) - 1) if self.added else 1.0
        self.tables: tuple[PairBound | None, ...] = tuple(
            None
            if b == self.reference
            else PairBound(
                group.bands[self.reference],
                band,
                objective.empty * group.share,
                objective.loose * group.share,
                part,
                objective.plain,
            )
            for b, band in enumerate(group.bands)
        )

    def ahead(self, state: Sequence[Position]) -> float:
        """What the rows still cost each other at least."""
        place = state[self.reference] >> 2
        parts = [
            table.row(place)[p >> 2] for table, p in zip(self.tables, state, strict=True) if table is not None
        ]
        if not parts:
            return 0.0
        return sum(parts) if self.added else max(parts)


def _solid(band: Band) -> tuple[int, int]:
    opaque = sum(not a.transparent and a.opaque for a in band.letters)
    return opaque, sum(not a.transparent for a in band.letters)
