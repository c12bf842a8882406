"""Every column that might come next at a node, with its weight, or with the constraint that forbids it.

The search never looks at most of them: what its bounds or the constraints rule out is not made at all. Here each is
made and judged, one rule after the other, for views and lessons. It is the slow and
plain twin of `network`, which a test compares with it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ..alignment.bands import Band
from ..alignment.elements import Option
from ..alignment.group import Group
from ..alignment.rules import (
    after_empty,
    after_solid,
    alike,
    fills,
    may_be_empty,
    may_begin_solid,
    needy,
    occluded,
    price,
    tally,
    unbacked,
)
from ..model.precision import EPS

__all__ = ["Refusal", "Weight", "columns_at", "elements", "judge", "refusal", "weigh"]


@dataclass(frozen=True, slots=True)
class Weight:
    """What a column costs where elastic letters cost nothing: ω, ω + empty·E + loose·Λ, and its width."""

    omega: float
    cost: float
    width: float


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why a column may not come next: see `events.EdgeRefused`."""

    constraint: str
    bands: tuple[int, ...]
    letters: tuple[tuple[int, int], ...]
    text: str
    amount: float | None = None
    cost: float | None = None
    bound: float | None = None
    against: float | None = None


Column = tuple[Option, ...]
Partial = tuple[Option | None, ...]


def elements(group: Group, b: int, position: int) -> Iterator[tuple[Option, Refusal | None]]:
    """Every element that a band may put into the next column, and those that C2 or C4 keep from it."""
    band = group.bands[b]
    i, mid = position >> 3, position & 4
    word = band.letters
    if not may_be_empty(position):
        text = f"{word[i - 1]} is attached and ends its element, so {_row(band)} may not be empty next (C4)."
        refused = Refusal("C4", (b,), ((b, i - 1),), text)
        yield Option(after_empty(word, position), empty=True), refused
    for option in band.options(position):
        yield option, None
    if not may_begin_solid(position):
        text = f"{word[i]} is attached and begins its element, but {_row(band)} was empty before it (C4)."
        for option in band.options(position & ~2):
            if not option.empty:
                yield option, Refusal("C4", (b,), ((b, i),), text)
    for j in range(i, len(word)):
        run = range(i, j + 1)
        if all(alike(word[i], word[n]) for n in run):
            continue
        names = " ".join(str(word[n]) for n in run)
        text = f"{names} of {_row(band)} are partly transparent, partly not (C2)."
        refused = Refusal("C2", (b,), tuple((b, n) for n in run), text)
        sizes = [word[n].size for n in run]
        size = None if mid or None in sizes else sum(s for s in sizes if s is not None)
        if word[j].transparent and band.cuts:
            yield Option(8 * j + 4, size=None, begins=not mid, letters=tuple(run)), refused
        made = Option(after_solid(word, j), size=size, begins=not mid, ends=True, letters=tuple(run))
        yield made, refused


def weigh(group: Group, column: Sequence[Option | None]) -> Weight:
    """ω (Eq. 9, or its variant for non-opaque rows), cost and width of a column, or of some of its rows."""
    total = tally(group, column)
    return Weight(total.omega, price(group, total, total.omega), total.high)


def refusal(group: Group, owed: bool, column: Column) -> Refusal | None:
    """The first constraint that a column breaks, of those that do not depend on what came before; None: none.

    `owed`: no letter ended at the boundary before it.
    """
    everyone = tuple(range(len(column)))
    if all(option.empty for option in column):
        return Refusal("empty", everyone, (), "No row has a letter in it.")
    found = _omega(group, column) or _c3(group, column)
    if found is not None:
        return found
    if unbacked(group, column):
        asking = [b for b, option in enumerate(column) if needy(option)]
        soft = tuple(
            (b, i) for b in asking for i in column[b].letters if not group.bands[b].letters[i].opaque
        )
        names = ", ".join(str(group.bands[b].letters[i]) for b, i in soft)
        what = f"{names} is not opaque" if soft else f"{_row(group.bands[asking[0]])} is empty"
        return Refusal(
            "C1", tuple(asking), soft, f"{what}, and no row stands behind it with opaque letters (C1)."
        )
    if owed and not any(option.begins for option in column):
        return Refusal("boundary", everyone, (), "The boundary before it is no row's letter boundary.")
    return None


def _omega(group: Group, column: Partial) -> Refusal | None:
    weight = weigh(group, column)
    over = weight.omega - group.tolerance
    if over <= EPS:
        return None
    here = [(o, b) for b, o in enumerate(column) if o is not None and not o.empty]
    reach = [(o.least if o.size is None else o.size, b) for o, b in here]
    sized = [(o.size, b) for o, b in here if o.size is not None]
    firm = [(s, b) for s, b in sized if fills(group, _option(column, b))] or sized
    blamed = tuple(sorted({max(reach)[1], min(firm)[1]}))
    sides = " and ".join(_element(group.bands[b], _option(column, b)) for b in blamed)
    return Refusal(
        "omega",
        blamed,
        _letters(column, blamed),
        f"{sides} differ by {weight.omega:.3g} m, more than μ = {group.tolerance:.3g} m.",
        over,
    )


def _c3(group: Group, column: Partial) -> Refusal | None:
    for b, o in occluded(group, column):
        option, other = _option(column, b), _option(column, o)
        below = tuple((b, i) for i in option.letters if group.bands[b].letters[i].unoccludable)
        above = tuple((o, i) for i in other.letters if not group.bands[o].letters[i].opaque)
        text = (
            f"{_named(group, below)} is unoccludable, and {_named(group, above)} above it is not opaque (C3)."
        )
        return Refusal("C3", tuple(sorted({b, o})), (*above, *below), text)
    return None


def columns_at(
    group: Group, state: Sequence[int], owed: bool, *, whole: bool = False
) -> Iterator[tuple[Partial, Refusal | None]]:
    """Every column that might come next, each with what forbids it, if anything does.

    Rows are chosen one by one. What is forbidden by some rows alone comes once, with None for the others; with
    `whole` all rows are chosen nevertheless.
    """
    choices = [list(elements(group, b, position)) for b, position in enumerate(state)]
    n = len(choices)
    if not whole:
        for b, own in enumerate(choices):
            for option, refused in own:
                if refused is not None:
                    yield tuple(option if o == b else None for o in range(n)), refused

    def descend(chosen: list[Option], refused: Refusal | None) -> Iterator[tuple[Partial, Refusal | None]]:
        if len(chosen) == n:
            column = tuple(chosen)
            yield column, refused or refusal(group, owed, column)
            return
        for option, own in choices[len(chosen)]:
            if own is not None and not whole:
                continue
            more = [*chosen, option]
            if not whole and len(more) < n:
                partial = (*more, *(None for _ in range(n - len(more))))
                broken = _omega(group, partial) or _c3(group, partial)
                if broken is not None:
                    yield partial, broken
                    continue
            yield from descend(more, refused or own)

    yield from descend([], None)


def judge(group: Group, columns: Sequence[Sequence[Sequence[int]]]) -> list[tuple[Weight, Refusal | None]]:
    """Weight of each column of an alignment that somebody made up, and the first constraint that it breaks.

    Parameters
    ----------
    columns
        Per column, per band, the numbers of the letters in it, in order. A letter that stands in several columns is
        cut.

    Raises
    ------
    ValueError
        Where a word's letters are not all there in their order, or a letter is cut that may not be.
    """
    out: list[tuple[Weight, Refusal | None]] = []
    state: Sequence[int] = group.start
    owed = False
    for j, column in enumerate(columns):
        options: list[Option] = []
        broken: Refusal | None = None
        for b, letters in enumerate(column):
            later = next((own[b][0] for own in columns[j + 1 :] if own[b]), None)
            cut = bool(letters) and later == letters[-1]
            own = (
                (option, refused)
                for option, refused in elements(group, b, state[b])
                if option.letters == tuple(letters) and (not letters or bool(option.target & 4) == cut)
            )
            option, refused = next(own, (None, None))
            if option is None:
                raise ValueError(
                    f"column {j}: {_row(group.bands[b])} cannot have the letters {list(letters)} after "
                    f"{state[b] >> 3} have been read"
                )
            options.append(option)
            broken = broken or refused
        out.append((weigh(group, tuple(options)), broken or refusal(group, owed, tuple(options))))
        state = tuple(option.target for option in options)
        owed = not any(option.ends for option in options)
    if tuple(p >> 2 for p in state) != tuple(p >> 2 for p in group.goal):
        raise ValueError("the columns do not hold all letters of every word")
    return out


def _option(column: Partial, b: int) -> Option:
    option = column[b]
    assert option is not None
    return option


def _letters(column: Partial, bands: Sequence[int]) -> tuple[tuple[int, int], ...]:
    return tuple((b, i) for b in bands for i in _option(column, b).letters)


def _named(group: Group, letters: Sequence[tuple[int, int]]) -> str:
    return " ".join(str(group.bands[b].letters[i]) for b, i in letters)


def _element(band: Band, option: Option) -> str:
    size = f"at least {option.least:.3g} m" if option.size is None else f"{option.size:.3g} m"
    return " ".join(str(band.letters[i]) for i in option.letters) + f" ({size})"


def _row(band: Band) -> str:
    return f"row {band.top}"
