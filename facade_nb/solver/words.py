"""From patterns to words that can fit the canvas (the paper's 5.1, Eq. 7, Figure 7)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import floor, inf, prod
from numbers import Real

from ..design.errors import DesignError, Fault, nearest
from ..design.model import Counter, Symbol
from ..design.pattern import Glyph, Pattern, parse
from .columns import EPS
from .counting import nearest_values
from .letters import Letter, Word

__all__ = ["MAX_COPIES", "MAX_WORDS", "Instances", "instances", "words"]

MAX_COPIES = 16
"""A counter that repeats only letters without a size could go on for ever; it is tried up to this count."""

MAX_WORDS = 2000
"""A pattern with three counters or more is left with about so many words, those nearest to the canvas."""

SymbolOf = Callable[[str], Symbol]


@dataclass(frozen=True, slots=True)
class Instances:
    """The words of a pattern that are no longer than a limit.

    Attributes
    ----------
    words
        In lexicographic order of counter values, then of alternatives.
    shortest
        The shortest word of the pattern, whether or not it is within the limit.
    endless
        Counters that repeat nothing with a size, cut off at `MAX_COPIES`.
    left
        Words that were left out, as there are too many, miss the canvas by at least so many metres.
    """

    words: tuple[Word, ...]
    shortest: Word
    endless: tuple[str, ...] = ()
    left: float = inf


def instances(
    pattern: Pattern,
    symbol: SymbolOf,
    counter: Callable[[str], Counter],
    limit: float,
    check: Callable[[], None] | None = None,
    canvas: float | None = None,
) -> Instances:
    """Every word of a pattern whose sized letters measure at most `limit` metres.

    Counters are tried outwards from the value nearest to 0; a longer count never makes a word shorter, so
    that each direction ends where the shortest word has become too long. With `canvas`, a pattern of three counters or
    more that has more than `MAX_WORDS` words is left with those nearest to the canvas.
    """
    names = pattern.counters
    nearest_zero = {name: _nearest_zero(counter(name)) for name in names}
    endless: set[str] = set()
    letters: dict[tuple[Glyph, object], Letter] = {}

    def spell(values: Mapping[str, int]) -> list[Word]:
        made = []
        for glyphs in pattern.words(values):
            word = []
            for glyph in glyphs:
                key = (glyph, glyph.origin)  # where it comes from takes no part in a glyph's equality
                letter = letters.get(key)
                if letter is None:
                    letter = letters[key] = _letter(glyph, symbol)
                word.append(letter)
            made.append(Word(tuple(word), dict(values)))
        return made

    found: list[Word] = []

    def descend(k: int, values: dict[str, int]) -> None:
        if check is not None:
            check()
        if k == len(names):
            found.extend(word for word in spell(values) if word.size <= limit + EPS)
            return
        name = names[k]
        for value in _fitting(counter(name), name, values):
            descend(k + 1, {**values, name: value})

    def _fitting(bounds: Counter, name: str, values: Mapping[str, int]) -> list[int]:
        rest = {other: nearest_zero[other] for other in names if other not in values}
        fits: list[int] = []
        for direction in (1, -1):
            value = nearest_zero[name] if direction == 1 else nearest_zero[name] - 1
            previous: list[float] = []
            still = 0
            while _inside(bounds, value):
                if check is not None:
                    check()
                sizes = [word.size for word in spell({**rest, **values, name: value})]
                within = sorted(size for size in sizes if size <= limit + EPS)
                if not within:
                    break
                still = still + 1 if within == previous else 0
                if still >= MAX_COPIES and (bounds.max is None or bounds.max - value > MAX_COPIES):
                    if len(within) == len(
                        sizes
                    ):  # else some word has grown too long: what is left has no such count
                        endless.add(name)
                    break
                fits.append(value)
                previous = within
                value += direction
        return sorted(fits)

    shortest = min(spell(nearest_zero), key=lambda word: word.size)
    left = inf
    if shortest.size <= limit + EPS:
        many = _many(
            names, {name: _fitting(counter(name), name, {}) for name in names} if len(names) > 2 else {}
        )
        if canvas is None or not many or len(spell(nearest_zero)) > 1:
            descend(0, {})
        else:
            base = shortest.size
            added = {
                name: [(v, spell({**nearest_zero, name: v})[0].size - base) for v in values]
                for name, values in many.items()
            }
            chosen, left = nearest_values(added, base, canvas, limit, MAX_WORDS, check)
            for values in sorted(chosen, key=lambda own: [own[name] for name in names]):
                found += spell(values)
    return Instances(tuple(found), shortest, tuple(sorted(endless)), left)


def _many(names: Sequence[str], fits: Mapping[str, Sequence[int]]) -> Mapping[str, Sequence[int]]:
    """The counters' values, where there are more combinations than `MAX_WORDS`; else nothing."""
    return fits if fits and prod(len(fits[name]) for name in names) > MAX_WORDS else {}


def _letter(glyph: Glyph, symbol: SymbolOf) -> Letter:
    own = symbol(glyph.symbol)
    transparent = glyph.transparent or own.transparent
    return Letter(
        glyph.symbol,
        own.size,
        transparent=transparent,
        opaque=own.opaque and not transparent,
        attached=own.attached,
        unoccludable=own.unoccludable,
        mirrored=glyph.mirrored,
        origin=glyph.origin,
    )


def _inside(bounds: Counter, value: int) -> bool:
    if bounds.value is not None:
        return value == bounds.value
    return bounds.min <= value and (bounds.max is None or value <= bounds.max)


def _nearest_zero(bounds: Counter) -> int:
    if bounds.value is not None:
        return bounds.value
    if bounds.min > 0:
        return bounds.min
    return 0 if bounds.max is None else min(0, bounds.max)


def words(
    pattern: str,
    sizes: Mapping[str, float],
    canvas: float,
    tolerance: float,
    counters: Mapping[str, tuple[int, int | None]] | None = None,
    unsized_step: float | None = None,
) -> list[Word]:
    """Words of a pattern with canvas − tolerance ≤ Σ sizes ≤ canvas + tolerance (Eq. 7 for a pattern on its own).

    Parameters
    ----------
    pattern
        Pattern text.
    sizes
        Preferred sizes in metres. Symbols without one are unsized and may stand only as placeholders of a
        control pattern.
    canvas, tolerance
        Metres.
    counters
        Bounds ``(min, max)`` by name; default from 0 without an upper bound. Other names than the pattern's are let
        be, so that several patterns can be asked with the same bounds.
    unsized_step
        Sample unsized symbols at positive multiples of this many metres, as the paper's Figure 7 does.
        Without it a word with unsized letters is listed once, and kept where its sized letters leave them
        room.

    Returns
    -------
    Words in lexicographic order of counter values, alternatives, and sampled sizes.

    Raises
    ------
    PatternError
        For a faulty text.
    DesignError
        For a solid symbol without a size, or a size, bound or step that is out of range.
    """
    parsed = parse(pattern)
    faults = [
        Fault(f"sizes.{name}", f"expected a positive size in metres, found {size!r}")
        for name, size in sizes.items()
        if not _is_length(size) or size == 0
    ]
    faults += [
        Fault(what, f"expected metres, 0 or more, found {value!r}")
        for what, value in (("canvas", canvas), ("tolerance", tolerance))
        if not _is_length(value)
    ]
    faults += [
        Fault("pattern", f"symbol {name!r} stands for itself and needs a size{nearest(name, sizes)}")
        for name in parsed.symbols
        if name in parsed.solids and name not in sizes
    ]
    if unsized_step is not None and (not _is_length(unsized_step) or unsized_step == 0):
        faults.append(Fault("unsized_step", f"expected a positive length in metres, found {unsized_step!r}"))
    bounds: dict[str, Counter] = {}
    for name, given in (counters or {}).items():
        if not _is_range(given):
            faults.append(Fault(f"counters.{name}", f"expected (min, max), whole numbers, found {given!r}"))
        elif given[1] is not None and given[0] > given[1]:
            faults.append(Fault(f"counters.{name}", f"expected min ≤ max, found {given[0]} and {given[1]}"))
        else:
            bounds[name] = Counter(name, given[0], given[1])
    if faults:
        raise DesignError(faults)
    found = instances(
        parsed,
        lambda name: Symbol(name, sizes.get(name)),
        lambda name: bounds.get(name) or Counter(name),
        canvas + tolerance,
    )
    kept: list[Word] = []
    for word in found.words:
        unsized = list(dict.fromkeys(a.symbol for a in word.letters if a.size is None))
        if unsized and unsized_step is not None:
            sampled = _sample(word, unsized, unsized_step, canvas + tolerance)
            kept += [w for w in sampled if w.size >= canvas - tolerance - EPS]
        elif unsized or word.size >= canvas - tolerance - EPS:
            kept.append(word)
    return kept


def _is_length(value: object) -> bool:
    return not isinstance(value, bool) and isinstance(value, Real) and 0 <= float(value) < inf


def _is_range(value: object) -> bool:
    if not isinstance(value, Sequence) or len(value) != 2:
        return False
    low, high = value
    return isinstance(low, int) and (high is None or isinstance(high, int))


def _sample(word: Word, unsized: Sequence[str], step: float, limit: float) -> Iterator[Word]:
    most = max(0, floor((limit - word.size) / step + EPS))
    for multiples in product(range(1, most + 1), repeat=len(unsized)):
        size = dict(zip(unsized, (m * step for m in multiples), strict=True))
        letters = tuple(a if a.size is not None else replace(a, size=size[a.symbol]) for a in word.letters)
        made = replace(word, letters=letters)
        if made.size <= limit + EPS:
            yield made
