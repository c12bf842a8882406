"""The columns of an alignment: what may stand in one, and what it costs (SPEC 3, *Columns*; the paper's 5.2).

A group of an axis has rows; equal words are one `Band`, because they are cut alike. A column takes from
each band an *element*: nothing, a run of solid letters, or a run of transparent letters whose first and
last may be pieces of cut ones. An `Option` is such an element as seen from the band's position, with
everything the constraints and the cost ask about it computed once; a column is a tuple of options, one a
band.

Constraints, by the numbers of SPEC 3:

- C1  an empty row, or a letter that is neither transparent nor opaque, needs a row all opaque in the column;
- C2  a row of a column is all transparent or all not (options are made that way);
- C3  above a solid unoccludable letter only ε, transparent or opaque letters;
- C4  no ε next to a solid attached letter that ends or begins an element.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice
from math import inf
from typing import Any

from ..model.letters import Letter
from ..model.objective import Objective
from .pairs import PairTable, choose_reference

__all__ = ["EPS", "Band", "Group", "Option", "Position", "lone_unsized", "make_group", "unsizable"]

EPS = 1e-9
"""Costs and sizes closer than this are equal."""

_TALL = 6
"""From so many rigid bands on, a group's columns are looked for by their skeleton."""
_PAIRED = 12
"""With more bands than this, pairs say too little for what they take to be compared."""

Position = int
"""Where a band stands: ``8·i + 4·mid + 2·gap + held``: the next letter i; `mid`: letter i is cut and its rest
is still to come; `gap`: the column before was empty here and letter i is attached, so it may not begin the
next (C4); `held`: the last element ended with an attached letter, so the next column may not be empty here
(C4)."""


@dataclass(slots=True, eq=False)
class Option:
    """One element a band may put into a column. Never changed, but made too often to be checked for that.

    Attributes
    ----------
    target
        The band's position after the column.
    empty, transparent
        Kind of the element; neither: solid.
    size
        Its size in metres; None: elastic (it holds a piece of a cut letter, or an unsized letter).
    least
        The size of its whole sized letters; of an elastic element, less than its size.
    loose
        Σ over neighbouring solid letters of the smaller size, metres.
    soft
        Solid, with a letter that is not opaque.
    opaque
        Solid, with every letter opaque.
    guarded
        Holds a solid unoccludable letter.
    begins, ends
        A letter starts at its left edge; a letter ends at its right edge.
    letters
        Indices into the band's word of the letters, or pieces, in it.
    tied
        Elastic, and some piece in it answers to an equation (a fixed size, or a size shared with other
        letters).
    sized
        The size of the letter that ends a transparent element, where it has one.
    """

    target: Position
    empty: bool = False
    transparent: bool = False
    size: float | None = 0.0
    loose: float = 0.0
    soft: bool = False
    opaque: bool = False
    guarded: bool = False
    begins: bool = False
    ends: bool = False
    letters: tuple[int, ...] = ()
    tied: bool = False
    sized: float | None = None
    least: float = 0.0


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
        for k, one in enumerate(self._make(position)):
            if one.target == other.target and one.letters == other.letters:
                return self.option(position, k)
        return None

    def _make(self, position: Position, first: int = 0) -> Iterator[Option]:
        """The elements, without the first so many."""
        i, mid, gap, held = position >> 3, position & 4, position & 2, position & 1
        word, n = self.letters, len(self.letters)
        if not held:  # C4, behind
            ahead = i < n and not mid and word[i].attached and not word[i].transparent
            if not first:
                yield Option(8 * i + mid + (2 if ahead else 0), empty=True)
            first = max(0, first - 1)
        if i == n:
            return
        if word[i].transparent:
            yield from islice(self._transparent(i, bool(mid)), first, None)
        elif not gap:  # C4, before
            yield from self._solid(i, first)

    def _solid(self, i: int, first: int) -> Iterator[Option]:
        word = self.letters
        before = word[i : i + first]
        sizes = [a.size or 0.0 for a in before]
        size, loose = sum(sizes), sum(map(min, sizes, sizes[1:]))
        soft, guarded = any(not a.opaque for a in before), any(a.unoccludable for a in before)
        for j in range(i + first, len(word)):
            letter = word[j]
            if letter.transparent:
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
                8 * (j + 1) + (1 if letter.attached else 0),
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
            if not letter.transparent:
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


@dataclass(frozen=True, eq=False)
class Group:
    """An alignment group of an axis, ready to be aligned.

    Attributes
    ----------
    bands
        Distinct words, topmost first.
    rows
        Number of rows; `band_of[i]` is the band of row i.
    share
        A band's share in E and Λ: one over the number of distinct words.
    waived
        No letter of the group is opaque, so C1 does not apply.
    stiff
        No band is elastic: every column's cost is a number.
    tied
        Some band has pieces that answer to an equation.
    """

    bands: tuple[Band, ...]
    band_of: tuple[int, ...]
    canvas: float
    tolerance: float
    objective: Objective
    share: float
    waived: bool
    stiff: bool
    tied: bool
    under: float
    """What a metre of W below the canvas costs at least, where columns can be widened that hold no rigid band."""
    guards: tuple[tuple[int, ...], ...]
    """Per band: the bands with a row above one of its rows (C3), itself among them where it has several rows."""
    weights: tuple[float, ...]
    """Per band: what a metre that it falls short of W costs at least (see `network.shortfall`)."""
    tall: bool = False
    """So many rigid bands that `skeleton` bounds what they cost."""
    reference: int | None = None
    """The band that `pairs` compares with every other."""
    pairs: tuple[PairTable | None, ...] = ()
    """Per band: what it and the reference cost each other; None for the reference itself."""
    identity: object = None
    """Groups with the same identity are aligned and sized alike."""
    edges: dict[Any, Any] = field(default_factory=dict)
    """Edges of the network already made, by node (see `network.edges`)."""

    def forget(self) -> None:
        """Let go of what can be made again: edges, and elements that no structure has taken."""
        self.edges.clear()
        for band in self.bands:
            band.forget()

    @property
    def start(self) -> tuple[Position, ...]:
        """Positions before the first column."""
        return (0,) * len(self.bands)

    @property
    def goal(self) -> tuple[Position, ...]:
        """Positions after the last column, without the marks of C4."""
        return tuple(band.end for band in self.bands)


class _Identity:
    """What tells groups apart; hashed once, for it has all their letters."""

    __slots__ = ("_hash", "_of")

    def __init__(self, of: object) -> None:
        self._of, self._hash = of, hash(of)

    def __eq__(self, other: object) -> bool:
        return self is other or (isinstance(other, _Identity) and self._of == other._of)

    def __hash__(self) -> int:
        return self._hash


def make_group(
    rows: Sequence[Sequence[Letter]],
    canvas: float,
    tolerance: float,
    objective: Objective,
    *,
    cuts: bool = True,
    free: frozenset[str] | None = None,
    check: Callable[[], None] | None = None,
) -> Group:
    """Gather equal words and prepare the bands.

    Parameters
    ----------
    rows
        Words, topmost first.
    free
        Unsized symbols that stand once in all that is aligned together: nothing ties their size. None:
        counted here.
    check
        Called now and then; may raise `search.Stopped`.
    """
    words: dict[tuple[Letter, ...], list[int]] = {}
    for index, row in enumerate(rows):
        words.setdefault(tuple(row), []).append(index)
    origins = [
        tuple(dict.fromkeys(tuple(letter.origin for letter in rows[i]) for i in own))
        for own in words.values()
    ]
    if free is None:
        free = lone_unsized(words)
    bands = tuple(
        Band(word, indices, cuts=cuts, free=free, origins=own, check=check)
        for (word, indices), own in zip(words.items(), origins, strict=True)
    )
    band_of = [0] * len(rows)
    for b, band in enumerate(bands):
        for i in band.rows:
            band_of[i] = b
    share = 1.0 / max(1, len(bands))
    solids = [a.size or 0.0 for band in bands for a in band.letters if a.opaque]
    if solids and not objective.plain:
        for band in bands:
            band.back(min(solids))
    if solids and objective.plain:
        for band in bands:
            if band.soft:
                others = (other for other in bands if other is not band)
                band.fill(sorted({size for other in others for size in other.backs()}), tolerance)
    reference = choose_reference(bands) if 1 < len(bands) <= _PAIRED else None
    rigid = sum(not any(letter.transparent for letter in band.letters) for band in bands)
    weights = [
        (min(objective.empty, objective.loose) if band.soft and not objective.plain else objective.empty)
        * share
        for band in bands
    ]
    total = sum(weights)
    if total > 1.0:
        weights = [w / total for w in weights]
    return Group(
        bands=bands,
        band_of=tuple(band_of),
        canvas=canvas,
        tolerance=tolerance,
        objective=objective,
        share=share,
        waived=not any(letter.opaque for band in bands for letter in band.letters),
        stiff=not any(band.elastic for band in bands),
        tied=any(band.tied for band in bands),
        under=min(
            objective.fit, objective.empty * share * sum(not band.elastic and not band.soft for band in bands)
        ),
        guards=tuple(tuple(o for o, other in enumerate(bands) if other.top < band.bottom) for band in bands),
        weights=tuple(weights),
        tall=not objective.plain and rigid >= _TALL,
        reference=reference,
        pairs=()
        if reference is None
        else tuple(
            None if b == reference else PairTable(bands[reference], band, objective, share, len(bands) - 1)
            for b, band in enumerate(bands)
        ),
        identity=_Identity(
            (
                tuple(band.letters for band in bands),
                tuple(band.origins for band in bands),
                tuple(band_of),
                free,
            )
        ),
    )


def unsizable(group: Group, column: Sequence[Option]) -> bool:
    """Whether no sizes of the symbols can make such a column, for one element of it holds more than another.

    Every symbol has one size, more than nothing, and so has every piece. A row without non-opaque letters fills its
    column; if the letters that it has at most are all among those that another row has as a whole, and either has more
    than that, they cannot be equally wide. The objective allows it; sizing does not.
    """
    for a, filling in enumerate(column):
        if filling.empty or filling.soft:
            continue
        most = [group.bands[a].letters[i].symbol for i in filling.letters]
        cut = filling.transparent and not (filling.begins and filling.ends)
        for b, other in enumerate(column):
            if a == b or other.empty:
                continue
            parts = other.transparent and not (other.begins and other.ends)
            whole = list(other.letters)
            if other.transparent and not other.begins:
                whole = whole[1:]
            if other.transparent and not other.ends:
                whole = whole[:-1]
            if len(most) > len(whole) or not (cut or parts or len(most) < len(whole)):
                continue
            least = [group.bands[b].letters[i].symbol for i in whole]
            if all(most.count(symbol) <= least.count(symbol) for symbol in most):
                return True
    return False


def lone_unsized(*words: Iterable[tuple[Letter, ...]]) -> frozenset[str]:
    """Unsized symbols with a single letter in the given distinct words."""
    count: dict[str, int] = {}
    for batch in words:
        for word in batch:
            for letter in word:
                if letter.size is None:
                    count[letter.symbol] = count.get(letter.symbol, 0) + 1
    return frozenset(symbol for symbol, n in count.items() if n == 1)
