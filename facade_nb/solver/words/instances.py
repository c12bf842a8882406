"""From one pattern to its words that can fit the canvas (the paper's 5.1, Eq. 7)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from math import inf
from typing import Any

from ...design.errors import DesignError
from ...design.limits import nearest_zero
from ...design.model import Counter, Symbol
from ...design.pattern import Pattern
from ...design.tree import MAX_LETTERS, Concat, Count, Node, check_room, concatenation, spellings, walk
from .. import tuning
from ..cache import CACHE
from ..model.letters import Letter, Word
from ..model.precision import EPS
from .counter_values import Sums
from .lengths import TOO_MANY, Growth, Way, measure

__all__ = [
    "MAX_SPELLED",
    "Instances",
    "Range",
    "instances",
    "next_longer",
    "ranges",
]


MAX_SPELLED = MAX_LETTERS
"""Most letters of a word that a counter makes long."""


_WAY = ""
"""In tables of counters: the choice of alternatives. No counter has that name."""

SymbolOf = Callable[[str], Symbol]
CounterOf = Callable[[str], Counter]
Check = Callable[[], None]
Range = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Instances:
    """The words of a pattern that are within limits.

    Attributes
    ----------
    words
        In lexicographic order of counter values, then of alternatives.
    shortest
        The shortest word of the pattern, whether or not it is within the limit.
    endless
        Counters that repeat nothing with a size, cut off at `tuning.MAX_COPIES`.
    left
        Words that were left out, as there are too many, or as they have too many letters, miss the canvas by at least
        so many metres; one with an unsized letter, which takes what is left, may miss it by nothing.
    clipped
        Counters that would go on, if a word could have more letters than `MAX_SPELLED`.
    """

    words: tuple[Word, ...]
    shortest: Word
    endless: tuple[str, ...] = ()
    left: float = inf
    clipped: tuple[str, ...] = ()


def instances(
    pattern: Pattern,
    symbol: SymbolOf,
    counter: CounterOf,
    limit: float,
    check: Check | None = None,
    canvas: float | None = None,
    low: float = -inf,
    common: Mapping[str, Range] | None = None,
) -> Instances:
    """Every word of a pattern whose sized letters measure at most `limit` metres, and at least `low`.

    Counters are tried outwards from the value nearest to 0; a longer count never makes a word shorter, so
    that each direction ends where the shortest word has become too long. Words are measured before they are spelled
    out (`measures`).

    Parameters
    ----------
    canvas
        With it, where there are more words than `tuning.MAX_WORDS` (or their letters are too many), those nearest to it
        are kept.
    low
        Does not hold for words with an unsized letter, which takes what is left.
    common
        Values of counters beyond which other patterns have no word (`ranges`).
    """
    ways = _measured(pattern, symbol, check)
    speller = _Speller(symbol)
    if ways is None:
        return _one_by_one(pattern, speller, counter, limit, low, check, canvas is not None)
    zero = {name: nearest_zero(counter(name)) for name in pattern.counters}
    shortest = min(ways, key=lambda way: way.measure.at(zero))
    letters = inf if canvas is None else MAX_SPELLED
    kinds = [_Kind(own, zero, counter, limit, common or {}, letters, check) for own in _alike(ways).values()]
    few = len(pattern.counters) <= 2
    chosen: list[tuple[float, tuple[int, ...], int]] = []
    left = inf
    for kind in kinds:
        for name in kind.tables:
            kind.go_on(name, [other.tables[name][-1][0] for other in kinds if other.tables[name]])
        least = -inf if kind.open else low
        sums = Sums(kind.tables, limit + 1e-7, check)
        if canvas is None:
            found, _ = sums.within(least - EPS, limit + 1e-7)
        else:
            found, missed = sums.nearest(
                canvas, least - EPS, tuning.MAX_WORDS_OF_FEW if few else tuning.MAX_WORDS
            )
            left = min(left, _by(missed, kind.open), _by(max(0.0, kind.missed - canvas), kind.open))
        chosen += [
            (size, tuple(values[name] for name in pattern.counters), values[_WAY]) for size, values in found
        ]
    if canvas is not None:
        chosen, missed = _few_letters(chosen, canvas, ways, pattern.counters)
        left = min(left, missed)
    free = set.intersection(*(kind.endless for kind in kinds))
    refused: list[tuple[float, int]] = []
    chosen.sort(key=lambda own: own[1:])
    words = tuple(
        _spelled(
            chosen, ways, pattern.counters, speller, limit, check, None if canvas is None else refused.append
        )
    )
    if canvas is None:
        left = 0.0 if any(kind.missed < inf for kind in kinds) else inf
    else:
        for size, way in refused:
            left = min(left, _by(abs(size - canvas), ways[way].measure.open))
    return Instances(
        words,
        speller.word(shortest.pattern, zero),
        tuple(sorted(free)),
        left,
        tuple(sorted(set().union(*(kind.clipped for kind in kinds)))),
    )


def next_longer(
    pattern: Pattern,
    symbol: SymbolOf,
    counter: CounterOf,
    limit: float,
    canvas: float,
    check: Check | None = None,
) -> tuple[Word | None, bool]:
    """The shortest word of a pattern that is longer than a limit, and whether there are longer ones still.

    Unsized letters count as nothing. Words of more letters than `MAX_SPELLED` are not looked at.
    """
    ways = _measured(pattern, symbol, check)
    speller = _Speller(symbol)

    def reaches(beyond: float) -> Iterator[float]:
        if ways is None:
            return _reaches_spelled(pattern, speller, counter, beyond, check)
        return _reaches(ways, counter, beyond)

    for reach in reaches(limit):
        found = instances(pattern, symbol, counter, reach, check, canvas)
        longer = [word for word in found.words if word.size > limit + EPS]
        if longer:
            word = min(longer, key=lambda own: own.size)
            further = next(reaches(word.size), None)
            return word, further is not None or any(own.size > word.size + EPS for own in longer)
    return None, False


def _reaches(ways: Sequence[Way], counter: CounterOf, limit: float) -> Iterator[float]:
    """Sizes beyond a limit up to which there is a word longer than that, if there is any."""
    sizes: list[float] = []
    for own in (way.measure for way in ways):
        grown = {name: [0.0, 0.0] for name in own.growth}  # at the value nearest to 0, and at the end
        for name, growth in own.growth.items():
            bounds = counter(name)
            zero = nearest_zero(bounds)
            ends = [bounds.value] * 2 if bounds.value is not None else [bounds.min, bounds.max]
            far = [
                inf if end is None and growth.more > 0 else growth.size(zero if end is None else end)
                for end in ends
            ]
            grown[name] = [growth.size(zero), max(far)]
        least = own.size + sum(low for low, _ in grown.values())
        total = own.size + sum(high for _, high in grown.values())
        if least > limit + EPS:
            sizes.append(least)
        elif total > limit + EPS:
            # one copy more of anything leads beyond the limit at the latest from just below it
            step = max(max(g.first, g.more, g.back_first, g.back_more) for g in own.growth.values())
            sizes.append(limit + step)
    if sizes:
        yield min(sizes) + 2.0 * EPS
        yield max(sizes) + 2.0 * EPS


def _reaches_spelled(
    pattern: Pattern, speller: _Speller, counter: CounterOf, limit: float, check: Check | None
) -> Iterator[float]:
    """The same for a pattern that cannot be measured beforehand: counters go on one by one, and all to their ends."""
    bounds = {name: counter(name) for name in pattern.counters}
    zero = {name: nearest_zero(own) for name, own in bounds.items()}
    ends = {
        name: own.max if own.max is not None and own.value is None else zero[name]
        for name, own in bounds.items()
    }
    tried = [zero]
    if all(abs(value) <= tuning.MAX_COPIES for value in ends.values()):
        tried.append(ends)
    for name, own in bounds.items():
        for step in (1, -1):
            value = zero[name] + step
            for _ in range(MAX_SPELLED):
                if not _inside(own, value):
                    break
                if check is not None:
                    check()
                try:
                    sizes = [word.size for word in speller.words(pattern, {**zero, name: value})]
                except DesignError:  # words that are too long to be spelled
                    break
                if max(sizes) > limit + EPS or (abs(value) > tuning.MAX_COPIES and max(sizes) <= EPS):
                    tried.append({**zero, name: value})
                    break
                value += step
    found = [word.size for values in tried for word in speller.words(pattern, values)]
    longer = [size for size in found if size > limit + EPS]
    if longer:
        yield min(longer) + 2.0 * EPS
        yield max(longer) + 2.0 * EPS


def _by(missed: float, is_open: bool) -> float:
    """By how much words that were left out miss the canvas, where their sized letters do by so much."""
    return 0.0 if is_open and missed < inf else missed


def ranges(
    pattern: Pattern, symbol: SymbolOf, counter: CounterOf, limit: float, check: Check | None = None
) -> dict[str, Range]:
    """Between which values of its counters a pattern has words within the limit, for counters that repeat something
    with a size whatever alternatives are chosen.
    """
    ways = _measured(pattern, symbol, check)
    if ways is None:
        return {}
    zero = {name: nearest_zero(counter(name)) for name in pattern.counters}
    kinds = [_Kind(own, zero, counter, limit, {}, MAX_SPELLED, check) for own in _alike(ways).values()]
    found: dict[str, Range] = {}
    for name in pattern.counters:
        tables = [kind.tables[name] for kind in kinds if kind.tables[name]]
        if tables and not any(name in kind.free for kind in kinds):
            values = [value for table in tables for value, _ in table]
            values += [value for kind in kinds for value in kind.cut_at.get(name, ())]
            found[name] = min(values), max(values)
    return found


def _measured(pattern: Pattern, symbol: SymbolOf, check: Check | None) -> list[Way] | None:
    """What `measure` says, kept for the next time the sizes are the same."""
    key = (pattern, tuple(symbol(name).size for name in pattern.symbols))
    known: tuple[list[Way] | None] | None = CACHE.lengths.get(key)
    if known is None:
        known = (measure(pattern, lambda name: symbol(name).size, check),)
        CACHE.lengths.put(key, known, len(known[0] or ()) + 1)
    return known[0]


def _alike(ways: Sequence[Way]) -> dict[object, list[tuple[int, Way]]]:
    """Choices of alternatives, with their numbers, by what the counters add to them."""
    found: dict[object, list[tuple[int, Way]]] = {}
    for n, way in enumerate(ways):
        key = (way.measure.open, tuple(sorted(way.measure.growth.items())))
        found.setdefault(key, []).append((n, way))
    return found


class _Kind:
    """Choices of alternatives to which the counters add the same.

    Attributes
    ----------
    tables
        Per counter: its values, each with the metres that it adds; and the choices with theirs.
    free
        Counters that add nothing in some direction that is open to them.
    endless
        Those of them that were cut off.
    clipped
        Counters at which a word would have too many letters.
    cut_at
        Per counter: its first values that were left out.
    missed
        The least size of a word that was left out therefore, metres.
    """

    def __init__(
        self,
        ways: Sequence[tuple[int, Way]],
        zero: Mapping[str, int],
        counter: CounterOf,
        limit: float,
        common: Mapping[str, Range],
        most: float,
        check: Check | None,
    ) -> None:
        self.open = ways[0][1].measure.open
        self.free: set[str] = set()
        self.endless: set[str] = set()
        self.clipped: set[str] = set()
        self.cut_at: dict[str, list[int]] = {}
        self.missed = inf
        self._zero, self._counter, self._common = zero, counter, common
        growth = ways[0][1].measure.growth
        self._growth = {name: growth.get(name, Growth()) for name in zero}
        own = {name: self._growth[name].size(value) for name, value in zero.items()}
        letters = {name: self._growth[name].length(value) for name, value in zero.items()}
        least = min(way.measure.size for _, way in ways) + sum(own.values())
        fewest = min(way.measure.letters for _, way in ways) + sum(letters.values())
        self.tables: dict[str, list[tuple[int, float]]] = {
            name: self._values(
                name,
                limit - least + own[name],
                max(0.0, most - fewest) + letters[name],
                least - own[name],
                check,
            )
            for name in zero
        }
        self.tables[_WAY] = [(n, way.measure.size) for n, way in ways]
        if least > limit + EPS:
            self.tables = {name: [] for name in self.tables}
            self.missed = inf

    def _values(
        self, name: str, room: float, letters: float, others: float, check: Check | None
    ) -> list[tuple[int, float]]:
        """The values of a counter that leave room, in order; the rest of the shortest word measures `others`."""
        bounds, growth, zero = self._counter(name), self._growth[name], self._zero[name]
        low, high = self._common.get(name, (-inf, inf))
        found: list[tuple[int, float]] = []
        for step in (1, -1):
            value = zero if step == 1 else zero - 1
            end = bounds.max if step == 1 else bounds.min
            free = self._still(growth, zero, step)
            while _inside(bounds, value) and (size := growth.at_least(value)) <= room + EPS:
                if check is not None:
                    check()
                if name in self._common and (value > high if step == 1 else value < low):
                    break  # nor have others words there
                if growth.length(value) > letters:
                    self.clipped.add(name)
                    self.cut_at.setdefault(name, []).append(value)
                    self.missed = min(self.missed, others + size)
                    break
                if growth.length(value) >= TOO_MANY:
                    check_room(MAX_LETTERS + 1)
                if free:
                    self.free.add(name)
                    far = end is None or abs(end - value) > tuning.MAX_COPIES
                    if name not in self._common and abs(value - zero) >= tuning.MAX_COPIES and far:
                        self.endless.add(name)
                        if growth.length(value) > growth.length(zero):
                            self.missed = -inf
                        break
                if low <= value <= high:
                    found.append((value, growth.size(value)))
                value += step
        return sorted(found)

    @staticmethod
    def _still(growth: Growth, zero: int, step: int) -> bool:
        """Whether going on from a value in a direction adds no metre."""
        return growth.size(zero + 2 * step) <= growth.size(zero) if zero * step >= 0 else False

    def go_on(self, name: str, tops: Sequence[int]) -> None:
        """A counter that was cut off here goes as far as it does under other alternatives."""
        table = self.tables[name]
        if name in self.endless and table and name != _WAY:
            top, size = table[-1]
            table += [(value, size) for value in range(top + 1, max(tops) + 1)]


def _few_letters(
    chosen: list[tuple[float, tuple[int, ...], int]], canvas: float, ways: Sequence[Way], names: Sequence[str]
) -> tuple[list[tuple[float, tuple[int, ...], int]], float]:
    """Those nearest to the canvas, as many as may have letters; by how much one that is left out misses it."""
    total = 0.0
    chosen.sort(key=lambda own: abs(own[0] - canvas))
    kept: list[tuple[float, tuple[int, ...], int]] = []
    left, full = inf, False
    for one in chosen:
        size, values, way = one
        own = ways[way].measure
        added = zip(names, values, strict=True)
        letters = own.letters + sum(g.length(v) for name, v in added if (g := own.growth.get(name)))
        long = letters > max(MAX_SPELLED, own.letters)
        full = full or (not long and bool(kept) and total + letters > tuning.MAX_LETTERS_IN_ALL)
        if long or full:
            left = min(left, _by(abs(size - canvas), own.open))
        else:
            kept.append(one)
            total += letters
    return kept, left


def _spelled(
    chosen: Sequence[tuple[float, tuple[int, ...], int]],
    ways: Sequence[Way],
    names: Sequence[str],
    speller: _Speller,
    limit: float,
    check: Check | None,
    refused: Callable[[tuple[float, int]], None] | None,
) -> Iterator[Word]:
    """The words of values and choices, equal ones once; size and choice of those with too many letters go elsewhere."""
    last: tuple[int, ...] | None = None
    seen: set[tuple[tuple[str, bool, bool], ...]] = set()
    for size, values, way in chosen:
        if check is not None:
            check()
        if values != last:
            last, seen = values, set()
        try:
            word = speller.word(ways[way].pattern, dict(zip(names, values, strict=True)))
        except DesignError:  # what stands in it and is replaced by nothing counts while it is made
            if refused is None:
                raise
            refused((size, way))
            continue
        if size > limit - 1e-6 and word.size > limit + EPS:
            continue  # sums of floats are not the same in every order
        if len(ways) > 1:
            key = tuple((a.symbol, a.mirrored, a.transparent) for a in word.letters)
            if key in seen:
                continue
            seen.add(key)
        yield word


class _Speller:
    """Spells words out; letters that are alike are one object, and parts of words are spelled once."""

    def __init__(self, symbol: SymbolOf) -> None:
        self._letters = _Letters(symbol)
        self._parts: dict[Node, tuple[tuple[Node, tuple[str, ...]], ...]] = {}
        self._spelled: dict[tuple[int, tuple[int, ...]], tuple[Letter, ...]] = {}

    def word(self, way: Pattern, values: Mapping[str, int]) -> Word:
        """The word of a pattern without alternatives."""
        if way.substitutions or not values:
            return Word(tuple(map(self._letters.__getitem__, way.spell(values))), dict(values))
        parts = self._parts.get(way.control)
        if parts is None:
            parts = self._parts[way.control] = _parts(way.control)
        return Word(tuple(chain.from_iterable(self._part(*own, values) for own in parts)), dict(values))

    def _part(self, node: Node, counters: tuple[str, ...], values: Mapping[str, int]) -> tuple[Letter, ...]:
        key = (id(node), tuple([values[name] for name in counters]))  # nodes of `_parts` stay as they are
        found = self._spelled.get(key)
        if found is None:
            found = tuple(map(self._letters.__getitem__, spellings(node, values)[0]))
            self._spelled[key] = found
        return found

    def words(self, pattern: Pattern, values: Mapping[str, int]) -> list[Word]:
        """All words of a pattern for some values."""
        return [
            Word(
                tuple(self._letters[g.symbol, g.mirrored, g.transparent, g.origin] for g in glyphs),
                dict(values),
            )
            for glyphs in pattern.words(values)
        ]


def _parts(control: Node) -> tuple[tuple[Node, tuple[str, ...]], ...]:
    """What is concatenated, each part with its counters; what has none is one part with its neighbours."""
    found: list[tuple[Node, tuple[str, ...]]] = []
    for part in control.parts if isinstance(control, Concat) else (control,):
        counts = (node.value for node in walk(part) if isinstance(node, Count))
        counters = tuple(dict.fromkeys(value for value in counts if isinstance(value, str)))
        if found and not counters and not found[-1][1]:
            found[-1] = (concatenation([found[-1][0], part]), ())
        else:
            found.append((part, counters))
    return tuple(found)


class _Letters(dict[tuple[object, ...], Letter]):
    """The letter of each glyph, by its fields, or by the first two of them."""

    def __init__(self, symbol: SymbolOf) -> None:
        super().__init__()
        self._symbol = symbol

    def __missing__(self, fields: Any) -> Letter:
        name, mirrored, clear, origin = fields if len(fields) == 4 else (*fields, False, None)
        own = self._symbol(name)
        transparent = clear or own.transparent
        made = self[fields] = Letter(
            name,
            own.size,
            transparent=transparent,
            opaque=own.opaque and not transparent,
            attached=own.attached,
            unoccludable=own.unoccludable,
            mirrored=mirrored,
            origin=origin,
        )
        return made


def _one_by_one(
    pattern: Pattern,
    speller: _Speller,
    counter: CounterOf,
    limit: float,
    low: float,
    check: Check | None,
    bounded: bool,
) -> Instances:
    """Words of a pattern that cannot be measured beforehand, by spelling all of them out.

    Where the number of letters is `bounded`, what has more is left out; else it is refused.
    """
    names = pattern.counters
    zero = {name: nearest_zero(counter(name)) for name in names}
    endless: set[str] = set()
    clipped: set[str] = set()
    found: list[Word] = []

    def fitting(name: str, values: Mapping[str, int]) -> list[int]:
        bounds, rest = counter(name), {other: zero[other] for other in names if other not in values}
        fits: list[int] = []
        for step in (1, -1):
            value = zero[name] if step == 1 else zero[name] - 1
            before: list[float] = []
            still = 0
            while _inside(bounds, value):
                if check is not None:
                    check()
                try:
                    sizes = sorted(w.size for w in speller.words(pattern, {**rest, **values, name: value}))
                except DesignError:
                    if not bounded or value == zero[name]:
                        raise
                    clipped.add(name)
                    break
                inside = [size for size in sizes if size <= limit + EPS]
                if not inside:
                    break
                still = still + 1 if inside == before else 0
                end = bounds.max if step == 1 else bounds.min
                if still >= tuning.MAX_COPIES and (end is None or abs(end - value) > tuning.MAX_COPIES):
                    endless.add(name)
                    break
                fits.append(value)
                before = inside
                value += step
        return sorted(fits)

    def descend(k: int, values: dict[str, int]) -> None:
        if k < len(names):
            for value in fitting(names[k], values):
                descend(k + 1, {**values, names[k]: value})
            return
        for word in speller.words(pattern, values):
            is_open = any(letter.size is None for letter in word.letters)
            if word.size <= limit + EPS and (is_open or word.size >= low - EPS):
                found.append(word)

    shortest = min(speller.words(pattern, zero), key=lambda word: word.size)
    if shortest.size <= limit + EPS:
        descend(0, {})
    left = 0.0 if endless or clipped else inf
    return Instances(tuple(found), shortest, tuple(sorted(endless)), left, tuple(sorted(clipped)))


def _inside(bounds: Counter, value: int) -> bool:
    if bounds.value is not None:
        return value == bounds.value
    return bounds.min <= value and (bounds.max is None or value <= bounds.max)
