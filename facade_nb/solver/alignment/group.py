"""Groups: the rows of an alignment group, gathered into bands and ready to be aligned."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from .. import tuning
from ..model.letters import Letter
from ..model.objective import Objective
from .bands import Band
from .elements import Option, Position
from .pairs import PairTable, choose_reference

__all__ = ["Group", "lone_unsized", "make_group", "unsizable"]


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
    """Per band: what a metre that it falls short of W costs at least (see `reference.shortfall`)."""
    tall: bool = False
    """So many rigid bands that `skeleton` bounds what they cost."""
    reference: int | None = None
    """The band that `pairs` compares with every other."""
    pairs: tuple[PairTable | None, ...] = ()
    """Per band: what it and the reference cost each other; None for the reference itself."""
    identity: object = None
    """Groups with the same identity are aligned and sized alike."""

    def forget(self) -> None:
        """Let go of what can be made again: elements that no structure has taken."""
        for band in self.bands:
            band.forget()

    @property
    def by_empty(self) -> float:
        """What a metre of a column costs that is empty in one band."""
        return self.objective.empty * self.share

    @property
    def by_loose(self) -> float:
        """What a metre costs that one band has loose."""
        return self.objective.loose * self.share

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
        Called now and then; may raise `budget.Stopped`.
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
    reference = choose_reference(bands) if 1 < len(bands) <= tuning.PAIRED else None
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
        tall=not objective.plain and rigid >= tuning.TALL,
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
