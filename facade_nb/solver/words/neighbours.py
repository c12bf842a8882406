"""Words beside those that fit: a counter one step further, an alternative that is too long; and why they are not kept.

The listing keeps what Eq. 7 of the paper may allow. Views and lessons tell what it left out, too: for that the
pattern is spelled again, at a few values of its counters only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from heapq import nsmallest
from math import inf
from typing import Literal

from ...design.errors import DesignError
from ...design.model import AXES, Axis, Counter, Design, Symbol
from ...design.pattern import Pattern
from ..model.letters import Letter, Word
from ..model.precision import EPS
from ..model.problem import AxisProblem, axis_problem
from .enumeration import across, axis_words
from .instances import Instances

__all__ = ["Choice", "Choices", "Reason", "Values", "choices", "pushes", "spelled", "steps"]

Values = tuple[tuple[str, int], ...]
"""Values of a pattern's counters, sorted by name."""

Reason = Literal["fits", "too long", "too short", "range", "left out", "no partner"]
"""What became of a word. ``range``: a counter would have to be beyond its bounds; ``left out``: there are too many;
``no partner``: with that value of a counter another pattern has no word."""


@dataclass(frozen=True, slots=True)
class Choice:
    """A word that a pattern can make.

    Attributes
    ----------
    miss
        By how many metres its sized letters miss the canvas; 0 where a letter without a size takes what is left.
    bound
        For ``range``: the bound that forbids it, such as ``k ≤ 3``; for ``no partner``: the counters.
    """

    word: Word
    reason: Reason
    miss: float
    bound: str = ""


@dataclass(frozen=True, slots=True)
class Choices:
    """A few of the words that a pattern can make on an axis, by growing size.

    Attributes
    ----------
    canvas, low, high
        Metres: the canvas, and between which sizes words are kept.
    fits
        How many words are kept in all.
    """

    axis: Axis
    canvas: float
    low: float
    high: float
    words: tuple[Choice, ...]
    fits: int


def choices(
    design: Design,
    name: str,
    tolerance: float,
    most: int,
    chosen: Mapping[Axis, Word] | None = None,
    check: Callable[[], None] | None = None,
) -> list[Choices]:
    """A few words of a pattern on each axis where a visible layer uses it: the nearest to the canvas, and others.

    The words are those that a solve lists: after a solve they are not listed again.

    Parameters
    ----------
    design
        What is, or was, solved.
    name
        The pattern.
    tolerance
        The largest tolerance of the solve, as a fraction of the canvas.
    most
        How many words that fit are told.
    chosen
        Words that are among them in any case.
    """
    problems: dict[Axis, AxisProblem] = {axis: axis_problem(design, axis) for axis in AXES}
    out = []
    for axis, problem in problems.items():
        if name not in problem.pattern or problem.canvas <= 0:
            continue
        other = problems["y" if axis == "x" else "x"]
        shared = {c for c, _ in problem.counters} & {c for c, _ in other.counters}
        bounds = across(other, shared, tolerance, check) if shared else {}
        found = axis_words(problem, tolerance * problem.canvas, check=check, across=bounds)
        low = problem.canvas * (1 - tolerance) - pushes(problem, found)[name]
        own = chosen.get(axis) if chosen else None
        out.append(_few(problem, name, found[name], low, tolerance, most, own))
    return out


def _few(
    problem: AxisProblem,
    name: str,
    found: Instances,
    low: float,
    tolerance: float,
    most: int,
    chosen: Word | None,
) -> Choices:
    canvas = problem.canvas
    high = canvas * (1 + tolerance)
    pattern = problem.pattern[name]

    def miss(word: Word) -> float:
        return max(0.0, word.size - canvas) if _open(word) else abs(word.size - canvas)

    kept = [word for word in found.words if _fits(word, low, high)]
    best = nsmallest(most, kept, key=miss)
    if chosen is not None and chosen not in best:
        best = [chosen, *best[: most - 1]]
    told = [Choice(word, "fits", miss(word)) for word in best]
    known = {_key(word) for word in found.words}
    listed = {_key(word) for word in best}
    # Beside them: the nearest of each kind.
    nearest: dict[Reason, Choice] = {}
    bounds = {own: dict(problem.counters).get(own) or Counter(own) for own in pattern.counters}
    start = [*best, max(kept, key=lambda word: word.size)] if kept else [found.shortest]
    for values, bound in steps([_values(word) for word in start], bounds):
        if bound and any(value < 0 for _, value in values):
            continue  # mirrored copies, which hardly anybody means
        try:
            words = spelled(pattern, dict(values), problem.symbol)
        except DesignError:  # more letters than a word may have
            continue
        for word in words:
            if _key(word) in listed or (not bound and _key(word) in known and _fits(word, low, high)):
                continue
            own = _judged(word, bound, low, high, found.left < inf, miss(word))
            before = nearest.get(own.reason)
            if before is None or own.miss < before.miss - EPS:
                nearest[own.reason] = own
    told += nearest.values()
    told.sort(key=lambda own: (own.word.size, len(own.word)))
    return Choices(problem.axis, canvas, low, high, tuple(told), len(kept))


def _judged(word: Word, bound: str, low: float, high: float, some_left: bool, miss: float) -> Choice:
    if word.size > high + EPS:
        return Choice(word, "too long", miss)
    if not _fits(word, low, high):
        return Choice(word, "too short", miss)
    if bound:
        return Choice(word, "range", miss, bound)
    return Choice(word, "left out" if some_left else "no partner", miss, ", ".join(word.counters))


def _fits(word: Word, low: float, high: float) -> bool:
    """Whether Eq. 7 allows a word."""
    return word.size <= high + EPS and (_open(word) or word.size >= low - EPS)


def _open(word: Word) -> bool:
    """Whether it has a letter without a size, which takes what is left."""
    return any(letter.size is None for letter in word.letters)


def _values(word: Word) -> Values:
    return tuple(sorted(word.counters.items()))


def _key(word: Word) -> tuple[Values, tuple[Letter, ...]]:
    return _values(word), word.letters


def pushes(problem: AxisProblem, found: Mapping[str, Instances]) -> dict[str, float]:
    """Per pattern: at most so many metres of opaque letters stand above it, in the group where that is least."""
    opaque = {
        name: max((sum(a.size or 0.0 for a in w.letters if a.opaque) for w in own.words), default=0.0)
        for name, own in found.items()
    }
    least: dict[str, float] = {}
    for _, rows in problem.groups:
        above = 0.0
        for name in dict.fromkeys(rows):
            least[name] = min(least.get(name, above), above)
            above += opaque[name]
    return least


def steps(values: Iterable[Values], bounds: Mapping[str, Counter]) -> Iterator[tuple[Values, str]]:
    """These values of counters, then those with one counter a step further, each once, and the bound that it breaks."""
    given = dict.fromkeys(values)
    seen: dict[Values, str] = dict.fromkeys(given, "")
    for each in given:
        for n, (name, value) in enumerate(each):
            for other in (value - 1, value + 1):
                seen.setdefault((*each[:n], (name, other), *each[n + 1 :]), _broken(bounds[name], other))
    yield from seen.items()


def _broken(counter: Counter, value: int) -> str:
    """The bound that a value of a counter breaks; empty if it breaks none."""
    if counter.value is not None:
        return "" if value == counter.value else f"{counter.name} = {counter.value}"
    if value < counter.min:
        return f"{counter.name} ≥ {counter.min}"
    return f"{counter.name} ≤ {counter.max}" if counter.max is not None and value > counter.max else ""


def spelled(pattern: Pattern, values: Mapping[str, int], symbols: Mapping[str, Symbol]) -> list[Word]:
    """The words of a pattern for these counters. Raises `DesignError` if one has too many letters."""
    out: list[Word] = []
    for glyphs in pattern.words(values):
        letters: list[Letter] = []
        for glyph in glyphs:
            own = symbols.get(glyph.symbol) or Symbol(glyph.symbol)
            transparent = glyph.transparent or own.transparent
            letters.append(
                Letter(
                    glyph.symbol,
                    own.size,
                    transparent=transparent,
                    opaque=own.opaque and not transparent,
                    attached=own.attached,
                    unoccludable=own.unoccludable,
                    mirrored=glyph.mirrored,
                    origin=glyph.origin,
                )
            )
        out.append(Word(tuple(letters), dict(values)))
    return out
