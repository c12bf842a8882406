"""Bands: the distinct words of a group, and the elements that each may put into the next column.

Equal words of a group are one `Band`, because they are cut alike. From its position a band may put nothing into a
column, a run of solid letters, or a run of transparent letters whose first and last may be pieces of cut ones. C2 and
C4 are about one row, so they are kept here: what they forbid is not made (`rules`).
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from math import inf

from ..model.letters import Letter
from ..model.precision import EPS
from . import rules
from .elements import Option, Position

__all__ = ["Band"]


class Band:
    """The rows of a group that have one word.

    `rest_min` and `rest_max` bound the total size still to come at each letter index, from sized letters
    alone and with unsized ones counted as unbounded; `soft_rest` and `gap_rest` what the non-opaque letters still to
    come cost at least (`back`, `fill`).
    """

    def __init__(
        self,
        letters: Sequence[Letter],
        rows: Sequence[int],
        *,
        cuts: bool,
        free: frozenset[str],
        origins: tuple[tuple[tuple[str, int] | None, ...], ...],
        check: Callable[[], None] | None = None,
    ) -> None:
        self.origins = origins
        self.check = check
        self.letters = tuple(letters)
        self.rows = tuple(rows)
        self.top, self.bottom = min(rows), max(rows)
        self.cuts = cuts
        self.free = free
        self.end: Position = 8 * len(self.letters)
        self.soft = any(not a.opaque and not a.transparent for a in self.letters)
        self.elastic = any(a.transparent and (cuts or a.size is None) for a in self.letters)
        self.tied = any(
            a.transparent and not self.is_free(a) and (cuts or a.size is None) for a in self.letters
        )
        self.rest_min = [0.0] * (len(self.letters) + 1)
        self.rest_max = [0.0] * (len(self.letters) + 1)
        for i in range(len(self.letters) - 1, -1, -1):
            size = self.letters[i].size
            self.rest_min[i] = self.rest_min[i + 1] + (0.0 if size is None else size)
            self.rest_max[i] = self.rest_max[i + 1] + (inf if size is None else size)
        self.soft_rest = [0.0] * (len(self.letters) + 1)
        self.gap_rest = [0.0] * (len(self.letters) + 1)
        self._unsized: dict[int, tuple[tuple[str, int], ...]] = {}
        self._options: dict[Position, tuple[Option, ...]] = {}
        self._single: dict[tuple[Position, int], Option] = {}

    def back(self, thinnest: float) -> None:
        """Fill `soft_rest`: least Σ (column − element) over the runs with non-opaque letters still to come.

        Behind a non-opaque letter stands something opaque (C1), which is no narrower than the thinnest
        opaque letter; however a run of solid letters is split into elements, the one with the letter falls
        short of that by at least what the whole rest of the run does.
        """
        run = 0.0
        after = 0.0  # what the runs behind this one cost
        soft = False
        for i in range(len(self.letters) - 1, -1, -1):
            letter = self.letters[i]
            if letter.transparent:
                after, run, soft = self.soft_rest[i + 1], 0.0, False
                self.soft_rest[i] = after
                continue
            run += letter.size or 0.0
            soft = soft or not letter.opaque
            self.soft_rest[i] = after + (max(0.0, thinnest - run) if soft else 0.0)

    def fill(self, backs: Sequence[float], tolerance: float) -> None:
        """Fill `gap_rest`: least Ω that the non-opaque letters still to come ask for where every row counts in ω.

        Behind an element with such a letter stands one of another band that is all opaque (C1), of one of these sizes,
        in order. Infinity: none is within the tolerance.
        """
        end = 0  # of the run of solid letters
        for i in range(len(self.letters) - 1, -1, -1):
            if self.letters[i].transparent:
                self.gap_rest[i], end = self.gap_rest[i + 1], i
                continue
            end = end if i + 1 < len(self.letters) and not self.letters[i + 1].transparent else i + 1
            size, soft, least = 0.0, False, inf
            for j in range(i, end):
                size += self.letters[j].size or 0.0
                soft = soft or not self.letters[j].opaque
                n = bisect_left(backs, size)
                gap = min((abs(size - back) for back in backs[max(0, n - 1) : n + 1]), default=0.0)
                if not soft or gap <= tolerance + EPS:
                    least = min(least, (gap if soft else 0.0) + self.gap_rest[j + 1])
            self.gap_rest[i] = least

    def backs(self) -> Iterator[float]:
        """Sizes of its elements that are all opaque."""
        for i in range(len(self.letters)):
            size = 0.0
            for letter in self.letters[i:]:
                if not letter.opaque:
                    break
                size += letter.size or 0.0
                yield size

    def is_free(self, letter: Letter) -> bool:
        """Whether nothing ties the letter's size."""
        return letter.size is None and letter.symbol in self.free

    def unsized_from(self, i: int) -> tuple[tuple[str, int], ...]:
        """Unsized symbols from letter i on, with how often they stand there."""
        found = self._unsized.get(i)
        if found is None:
            count: dict[str, int] = {}
            for letter in self.letters[i:]:
                if letter.size is None:
                    count[letter.symbol] = count.get(letter.symbol, 0) + 1
            found = self._unsized[i] = tuple(count.items())
        return found

    def at_least(self, position: Position) -> float:
        """Least total size of what is still to come."""
        i = position >> 3
        return self.rest_min[i + 1] if position & 4 else self.rest_min[i]

    def options(self, position: Position) -> tuple[Option, ...]:
        """Every element the band may put into the next column: ε first, then runs by length."""
        found = self._options.get(position)
        if found is None:
            if self.check is not None:
                self.check()
            single = self._single
            found = self._options[position] = tuple(
                [single.get((position, k), option) for k, option in enumerate(self._make(position))]
            )
        return found

    def option(self, position: Position, index: int) -> Option:
        """One of them, the same as in `options`, without making all the others that are longer."""
        found = self._options.get(position)
        if found is not None:
            return found[index]
        one = self._single.get((position, index))
        if one is None:
            one = self._single[position, index] = next(self._make(position, index))
        return one

    def forget(self) -> None:
        """Let go of the elements; they are made again where they are asked for."""
        self._options.clear()
        self._single.clear()

    def alike(self, position: Position, other: Option) -> Option | None:
        """The element here that has the same letters and ends at the same place as one of another band; or None."""
        if (
            not other.transparent and not other.empty
        ):  # a run of solid letters has its place among the elements
            k = len(other.letters) - 1 + rules.may_be_empty(position)
            made = self._options.get(position)
            if made is not None:
                one = made[k] if k < len(made) else None
            else:
                one = self._single.get((position, k)) or next(self._make(position, k), None)
            if one is not None and one.target == other.target and one.letters == other.letters:
                return one if made is not None else self._single.setdefault((position, k), one)
        for k, one in enumerate(self._make(position)):
            if one.target == other.target and one.letters == other.letters:
                return self.option(position, k)
        return None

    def _make(self, position: Position, first: int = 0) -> Iterator[Option]:
        """The elements, without the first so many."""
        i, mid = position >> 3, position & 4
        word, n = self.letters, len(self.letters)
        if rules.may_be_empty(position):
            if not first:
                yield Option(rules.after_empty(word, position), empty=True)
            first = max(0, first - 1)
        if i == n:
            return
        if word[i].transparent:
            yield from islice(self._transparent(i, bool(mid)), first, None)
        elif rules.may_begin_solid(position):
            yield from self._solid(i, first)

    def _solid(self, i: int, first: int) -> Iterator[Option]:
        word = self.letters
        before = word[i : i + first]
        sizes = [a.size or 0.0 for a in before]
        size, loose = sum(sizes), sum(map(min, sizes, sizes[1:]))
        soft, guarded = any(not a.opaque for a in before), any(a.unoccludable for a in before)
        for j in range(i + first, len(word)):
            letter = word[j]
            if not rules.alike(word[i], letter):
                return
            if self.check is not None and not (j - i + 1) & 255:
                self.check()
            own = letter.size or 0.0
            if j > i:
                loose += min(own, word[j - 1].size or 0.0)
            size += own
            soft = soft or not letter.opaque
            guarded = guarded or letter.unoccludable
            yield Option(
                rules.after_solid(word, j),
                size=size,
                least=size,
                loose=loose,
                soft=soft,
                opaque=not soft,
                guarded=guarded,
                begins=True,
                ends=True,
                letters=tuple(range(i, j + 1)),
            )

    def _transparent(self, i: int, mid: bool) -> Iterator[Option]:
        word = self.letters
        fixed: float | None = None if mid else 0.0
        least = 0.0
        tied = False
        for j in range(i, len(word)):
            letter = word[j]
            if not rules.alike(word[i], letter):
                return
            letters = tuple(range(i, j + 1))
            bound = not self.is_free(letter)
            if self.cuts:  # ends within letter j
                yield Option(
                    8 * j + 4,
                    transparent=True,
                    size=None,
                    begins=not mid,
                    letters=letters,
                    tied=tied or bound,
                    least=least,
                )
            whole = letter.size if (j > i or not mid) else None
            least += whole or 0.0
            fixed = None if fixed is None or whole is None else fixed + whole
            tied = tied or bound
            yield Option(
                8 * (j + 1),
                transparent=True,
                size=fixed,
                begins=not mid,
                ends=True,
                letters=letters,
                tied=tied and fixed is None,
                sized=letter.size,
                least=least,
            )
