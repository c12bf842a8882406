"""What two rows cost each other: lower bounds for alignments of many rows (the paper's pairwise hierarchy, 5.2).

Leave all rows but two out of an alignment, and the columns that are empty then: what remains aligns the two, and every
column costs no more than before. So the least cost of aligning the rests of two rows, found once for each pair of
positions by dynamic programming, bounds what any path has still to pay.

One row, the *reference*, is paired with every other, and the bounds are added up. That is allowed because E and Λ
are sums over rows: each other row brings its own, the reference's are divided among the pairs, and so is ω, which is a
maximum and thus at least the mean of what the pairs see of it. The constraints are left out, and elastic elements cost
nothing, which only makes the bound smaller.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from typing import TYPE_CHECKING

from ..model.objective import Objective

if TYPE_CHECKING:
    from .bands import Band
    from .elements import Position

__all__ = ["PairTable", "choose_reference"]

_Move = tuple[int, float, float, bool]
"""Next place, size (negative: elastic), price of letters that share the element, holds a soft letter."""


class PairTable:
    """Least cost of aligning the rests of the reference and one other word.

    Places are ``position >> 2``: twice the letter's index, and one more where that letter is cut and begun.

    Parameters
    ----------
    reference, other
        Two words.
    share
        A row's share in E and Λ.
    pairs
        Among how many pairs ω and the reference's own costs are divided.
    """

    def __init__(self, reference: Band, other: Band, objective: Objective, share: float, pairs: int) -> None:
        self._part = 1.0 / pairs
        self._empty, self._loose = objective.empty * share, objective.loose * share
        self._plain = objective.plain
        self._words = (reference, other)
        self._made: tuple[list[list[_Move]], list[list[_Move]]] | None = None
        self._rows: list[list[float] | None] = [None] * (2 * len(reference.letters) + 1)

    def at(self, reference: Position, other: Position) -> float:
        """The bound where the two words stand at these positions."""
        return self.row(reference)[other >> 2]

    def row(self, reference: Position) -> list[float]:
        """Bounds for all places of the other word. Works from the end, and only as far as it is asked to."""
        place = reference >> 2
        found = self._rows[place]
        if found is None:
            for p in range(len(self._rows) - 1, place - 1, -1):
                if self._rows[p] is None:
                    self._rows[p] = self._fill(p)
            found = self._rows[place]
            assert found is not None
        return found

    def _fill(self, p: int) -> list[float]:
        if self._made is None:
            self._made = (_moves(self._words[0], self._loose), _moves(self._words[1], self._loose))
        check = self._words[0].check
        if check is not None:
            check()
        moves_a, all_b = self._made[0][p], self._made[1]
        by_empty, by_loose, part, plain = self._empty, self._loose, self._part, self._plain
        last = len(all_b) - 1
        row = [inf] * (last + 1)
        reach = [
            (size, own * part, soft and not plain, self._rows[end] if end != p else None)
            for end, size, own, soft in moves_a
        ]
        for q in range(last, -1, -1):
            best = 0.0 if q == last and not reach else inf
            moves_b = all_b[q]
            solid = bool(moves_b) and not self._words[1].letters[q >> 1].transparent
            for end, size, own, _ in moves_b:  # the reference is empty
                if end != q:
                    value = row[end] + own + (by_empty * part * size if size > 0 else 0.0)
                    if value < best:
                        best = value
            for size_a, own_a, soft_a, after in reach:
                if own_a >= best:
                    break  # longer runs share more elements
                stays = after is None  # the reference's letter goes on
                rest = row if after is None else after
                if not stays:
                    value = own_a + rest[q] + (by_empty * size_a if size_a > 0 else 0.0)  # the other is empty
                    if value < best:
                        best = value
                up = part * (by_loose if soft_a else 1.0)  # a metre by which the reference is short
                for end, size, own, soft in moves_b:
                    if stays and end == q:
                        continue
                    value = own_a + own
                    if size >= 0 and size_a >= 0:
                        over = size - size_a
                        if over > 0:
                            value += over * up
                            if value >= best and solid:
                                break  # longer runs are dearer still
                        else:
                            value -= over * (by_loose if soft and not plain else part)
                    value += rest[end]
                    if value < best:
                        best = value
            row[q] = best
        return row


def _moves(band: Band, by_loose: float) -> list[list[_Move]]:
    """Per place: the elements that may come next, ε left out, one for each place it may lead to."""
    out: list[list[_Move]] = []
    for place in range(2 * len(band.letters) + 1):
        i, mid = place >> 1, place & 1
        if mid and not band.letters[i].transparent:
            out.append([])
            continue
        out.append(
            [
                (o.target >> 2, -1.0 if o.size is None else o.size, by_loose * o.loose, o.soft)
                for o in band.options(8 * i + 4 * mid)
                if not o.empty
            ]
        )
    return out


def choose_reference(bands: Sequence[Band]) -> int | None:
    """The longest band: of those without transparent letters, if there are any, and opaque ones first.

    Next to the longest one the pairs see what all the others lack. Where every band has transparent letters: the one
    with the most others.
    """
    rigid = [
        b for b, band in enumerate(bands) if band.letters and not any(a.transparent for a in band.letters)
    ]
    if rigid:
        return max(rigid, key=lambda b: (not bands[b].soft, bands[b].rest_min[0], len(bands[b].letters)))
    return max(
        range(len(bands)),
        key=lambda b: sum(not letter.transparent for letter in bands[b].letters),
        default=None,
    )
