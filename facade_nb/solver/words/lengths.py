"""How long the words of a pattern are, before any of them is spelled out.

A counter never stands inside another one, so that a word's size is a sum: what stands in it anyway, and for each
counter what its counts add. A count adds nothing at 0, something at 1, and from then on the same for each copy more, in
every reflection mode; likewise downwards from -1. So each count is spelled out four times, and all else is arithmetic.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from ...design.errors import DesignError
from ...design.modes import shared
from ...design.pattern import Alt, Concat, Count, Empty, Mirror, Node, Pattern, Sym
from ...design.tree import spellings

__all__ = ["TOO_MANY", "Growth", "Measure", "Way", "measure"]


TOO_MANY = 1e18
"""Letters, and metres, of a word that would have more letters than there may be."""


class Growth(NamedTuple):
    """What a counter adds to a word: by its first copy and by each further one, at positive and negative values."""

    first: float = 0.0
    more: float = 0.0
    back_first: float = 0.0
    back_more: float = 0.0
    letters: float = 0
    letters_more: float = 0
    back_letters: float = 0
    back_letters_more: float = 0

    def size(self, value: int) -> float:
        """Metres at a value of the counter."""
        if value > 0:
            return self.first + (value - 1) * self.more
        return self.back_first + (-value - 1) * self.back_more if value else 0.0

    def at_least(self, value: int) -> float:
        """Metres at a value of the counter, or at least so many where the word has too many letters to be measured."""
        if self.length(value) < TOO_MANY:
            return self.size(value)
        first, letters = (self.first, self.letters) if value > 0 else (self.back_first, self.back_letters)
        return 0.9 * abs(value) * first if letters < TOO_MANY else 0.0

    def length(self, value: int) -> float:
        """Letters at a value of the counter."""
        if value > 0:
            return self.letters + (value - 1) * self.letters_more
        return self.back_letters + (-value - 1) * self.back_letters_more if value else 0

    def plus(self, other: Growth, times: int = 1) -> Growth:
        """Both together."""
        return Growth(*(a + times * b for a, b in zip(self, other, strict=True)))


@dataclass(frozen=True, slots=True)
class Measure:
    """Size of a word in metres and in letters with all counters at 0, and what each counter adds.

    `open`: an unsized symbol may stand in it, which `size` counts as nothing.
    """

    size: float = 0.0
    letters: int = 0
    growth: Mapping[str, Growth] = field(default_factory=dict)
    open: bool = False

    def at(self, values: Mapping[str, int]) -> float:
        """Metres for values of the counters."""
        return self.size + sum(own.size(values[name]) for name, own in self.growth.items())

    def times(self, n: int) -> Measure:
        """So many of it."""
        growth = {name: Growth().plus(own, n) for name, own in self.growth.items()}
        return Measure(n * self.size, n * self.letters, growth, self.open)


class Way(NamedTuple):
    """One choice of a pattern's alternatives: a pattern without any, and its measure."""

    pattern: Pattern
    measure: Measure


class _Nested(Exception):
    """Which letter is shared by a reflection depends on a counter."""


def measure(
    pattern: Pattern, size: Callable[[str], float | None], check: Callable[[], None] | None = None
) -> list[Way] | None:
    """Measure every choice of a pattern's alternatives, in lexicographic order.

    None: sizes are no such sum, because which letter a reflection shares depends on a counter.

    Raises
    ------
    DesignError
        Where a word without counters would have too many letters, or there are too many choices.
    """
    found: list[Way] = []
    known: dict[tuple[tuple[str, Node], ...], _Measurer] = {}
    try:
        for way in pattern.ways():
            if check is not None:
                check()
            measurer = known.get(way.substitutions)
            if measurer is None:
                plain = _Measurer(size, {})
                contents = {name: plain.of(content) for name, content in way.substitutions}
                measurer = known[way.substitutions] = _Measurer(size, contents)
            found.append(Way(way, measurer.of(way.control)))
    except _Nested:
        return None
    return found


class _Measurer:
    """Measures trees without alternatives; what is measured once is kept."""

    def __init__(self, size: Callable[[str], float | None], contents: Mapping[str, Measure]) -> None:
        self._size, self._contents = size, contents
        self._known: dict[Node, Measure] = {}

    def of(self, node: Node) -> Measure:
        found = self._known.get(node)
        if found is None:
            found = self._known[node] = self._of(node)
        return found

    def _of(self, node: Node) -> Measure:
        match node:
            case Sym(name=name):
                if name in self._contents:
                    return self._contents[name]
                own = self._size(name)
                return Measure(own or 0.0, 1, {}, own is None)
            case Empty():
                return Measure()
            case Concat(parts=parts):
                return _sum([self.of(part) for part in parts])
            case Mirror(body=body):
                return self.of(body)
            case Count(value=str()):
                return self._named(node)
            case Count(body=body, mode=mode, value=int() as times):
                own_body = self.of(body)
                if not own_body.growth:
                    size, letters = self._spelled(node, {})
                    return Measure(size, int(letters), {}, own_body.open)
                if shared(mode, 2):
                    raise _Nested
                return own_body.times(2 * times if mode else times)
            case Alt() | Count():
                raise AssertionError(node)

    def _named(self, node: Count) -> Measure:
        """A count by a counter, at 1, 2, -1 and -2."""
        name = str(node.value)
        (one, n), (two, m), (back, k), (twice, h) = (self._spelled(node, {name: v}) for v in (1, 2, -1, -2))
        growth = Growth(one, two - one, back, twice - back, n, m - n, k, h - k)
        return Measure(0.0, 0, {name: growth}, self.of(node.body).open)

    def _spelled(self, node: Count, values: Mapping[str, int]) -> tuple[float, float]:
        """Metres and letters of a count."""
        try:
            word = spellings(node, values)[0]
        except DesignError:
            if not values:
                raise
            return TOO_MANY, TOO_MANY
        tally: dict[str, int] = {}
        for symbol, _ in word:
            tally[symbol] = tally.get(symbol, 0) + 1
        parts = [(self.of(Sym(symbol)), n) for symbol, n in tally.items()]
        if any(part.growth for part, _ in parts):
            raise _Nested
        return sum(part.size * n for part, n in parts), sum(part.letters * n for part, n in parts)


def _sum(parts: Sequence[Measure]) -> Measure:
    growth: dict[str, Growth] = {}
    for part in parts:
        for name, own in part.growth.items():
            growth[name] = growth.get(name, Growth()).plus(own)
    return Measure(
        sum(part.size for part in parts),
        sum(part.letters for part in parts),
        growth,
        any(part.open for part in parts),
    )
