"""What words cost at least, from their sizes alone, before anything is aligned (the paper's 5.1, Eq. 7, supplement 3.2).

The lower bound of Eq. 7 is canvas − μ − Σ of the opaque letters of the patterns above in the same group,
because opaque letters above may push the words below aside; unsized letters take whatever is left.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

from .columns import EPS
from .letters import Letter, Word
from .objective import Objective
from .problem import AxisProblem

__all__ = ["Floors", "GroupKey", "LongEnough", "Measures", "inputs_of", "rows_of"]

GroupKey = tuple[int, ...]
"""A group's number, and the identities of the words that its rows depend on."""


@dataclass(frozen=True, slots=True, eq=False)
class Measured:
    """What bounds ask of a word.

    Attributes
    ----------
    word
        Kept, so that no other one can have its identity.
    size, opaque
        Of its sized letters, and of its opaque ones, metres.
    waiting
        Unsized symbols, with how often each stands in it.
    soft
        Has a solid letter that is not opaque.
    contents
        Substituted symbols, with the size of the first instance of each.
    """

    word: Word
    size: float
    opaque: float
    waiting: tuple[tuple[str, int], ...]
    soft: bool
    contents: tuple[tuple[str, float], ...]


class Measures:
    """Words are measured once."""

    def __init__(self) -> None:
        self._known: dict[int, Measured] = {}

    def __call__(self, word: Word) -> Measured:
        found = self._known.get(id(word))
        if found is None:
            found = self._known[id(word)] = _measured(word)
        return found


def _measured(word: Word) -> Measured:
    size = opaque = 0.0
    soft = False
    waiting: dict[str, int] = {}
    instances: dict[tuple[str, int], float] = {}
    for letter in word.letters:
        own = letter.size
        if own is None:
            waiting[letter.symbol] = waiting.get(letter.symbol, 0) + 1
        else:
            size += own
            if letter.opaque:
                opaque += own
        soft = soft or not (letter.opaque or letter.transparent)
        if letter.origin is not None:
            instances[letter.origin] = instances.get(letter.origin, 0.0) + (own or 0.0)
    contents: dict[str, float] = {}
    for (symbol, _), extent in instances.items():
        contents.setdefault(symbol, extent)
    return Measured(word, size, opaque, tuple(waiting.items()), soft, tuple(contents.items()))


class Floors:
    """Lower bounds of J for words chosen so far, kept for each group and the words that it depends on.

    A group whose rows are only partly decided is bounded by those that are: more rows make no column
    cheaper. The number of distinct words, which a row's share depends on, is not known then; it is at most
    the number of patterns.
    """

    def __init__(
        self, problem: AxisProblem, tolerance: float, objective: Objective, measures: Measures
    ) -> None:
        self._canvas, self._tolerance, self._objective = problem.canvas, tolerance, objective
        self._measures = measures
        self._rows = [tuple(dict.fromkeys(rows)) for _, rows in problem.groups]
        self._inputs = inputs_of(problem)
        self._givers = [
            [name for name, pattern in problem.patterns if pattern.substitutions and name in names]
            for names in self._inputs
        ]
        self._groups = {
            name: [g for g, names in enumerate(self._inputs) if name in names] for name, _ in problem.patterns
        }
        self._known: dict[GroupKey, float] = {}

    def of(self, words: Mapping[str, Word]) -> float:
        """Sum over the groups."""
        return sum(self._group(g, words) for g in range(len(self._inputs)))

    def after(self, before: tuple[float, ...], words: Mapping[str, Word], name: str) -> tuple[float, ...]:
        """Per group, from what it was before a pattern was given its word."""
        costs = list(before)
        for g in self._groups[name]:
            costs[g] = self._group(g, words)
        return tuple(costs)

    def now(self, before: tuple[float, ...], words: Mapping[str, Word]) -> tuple[float, ...]:
        """Per group, with what has been learnt since."""
        known = self._known
        return tuple([max(own, known.get(self.key(g, words), own)) for g, own in enumerate(before)])

    def learn(self, key: GroupKey, floor: float) -> bool:
        """Take in what a search has proven about all words of a group; whether that is news."""
        news = floor > self._known.get(key, -inf) + EPS
        if news:
            self._known[key] = floor
        return news

    def key(self, g: int, words: Mapping[str, Word]) -> GroupKey:
        """Under what a group is known; a word that is still to be chosen has the identity of None."""
        return (g, *[id(words.get(name)) for name in self._inputs[g]])

    def _group(self, g: int, words: Mapping[str, Word]) -> float:
        key = self.key(g, words)
        bound = self._known.get(key)
        if bound is None:
            bound = self._known[key] = self._least(g, words)
        return bound

    def _least(self, g: int, words: Mapping[str, Word]) -> float:
        contents: dict[str, float] = {}
        for name in self._givers[g]:
            if name in words:
                contents = {**dict(self._measures(words[name]).contents), **contents}
        names = self._rows[g]
        rows = [self._measures(words[name]) for name in names if name in words]
        distinct: list[Measured] = []
        for row in rows:
            # cheaper than hashing all their letters
            if not any(row.size == o.size and row.word.letters == o.word.letters for o in distinct):
                distinct.append(row)
        most = len(names) if len(rows) < len(names) else len(distinct)
        objective, totals = self._objective, []
        softly = objective.empty if objective.plain else min(objective.empty, objective.loose)
        for row in distinct:
            least = row.size
            for symbol, n in row.waiting:
                least += n * contents.get(symbol, 0.0)
            size = least if all(symbol in contents for symbol, _ in row.waiting) else inf
            totals.append((size, least, (softly if row.soft else objective.empty) / most))
        return self._cheapest(totals)

    def _cheapest(self, totals: Sequence[tuple[float, float, float]]) -> float:
        """J of rows with these sizes (greatest, least) and weights is at least this, whatever the alignment.

        See `shortfall`. Infinity: they do not fit.
        """
        canvas, fit = self._canvas, self._objective.fit
        longest = scale = 0.0
        breaks = []
        for size, least, weight in totals:
            scale += weight
            if least > longest:
                longest = least
            if size < canvas:
                breaks.append(size)
        if longest > canvas + self._tolerance + EPS:
            return inf
        scale = max(1.0, scale)
        best = inf
        for width in (longest, *([canvas, *breaks] if longest < canvas else ())):
            if width < longest:
                continue
            short = 0.0
            for size, _, weight in totals:
                if size < width:
                    short += weight * (width - size)
            value = fit * abs(width - canvas) + short / scale
            if value < best:
                best = value
        return best


def inputs_of(problem: AxisProblem) -> list[tuple[str, ...]]:
    """Per group: the patterns on whose words its rows depend, its own and those that give its symbols a size."""
    patterns = problem.pattern
    out: list[tuple[str, ...]] = []
    for _, rows in problem.groups:
        standing = {symbol for name in rows for symbol in patterns[name].placeholders}
        givers = [name for name, pattern in problem.patterns if standing & set(pattern.substituted)]
        out.append(tuple(dict.fromkeys([*rows, *givers])))
    return out


class LongEnough:
    """Eq. 7: whether a word is long enough next to those above it; unsized letters take whatever is left."""

    def __init__(self, problem: AxisProblem, tolerance: float, measures: Measures) -> None:
        self._least, self._groups = problem.canvas - tolerance - EPS, len(problem.groups)
        self._measures = measures
        # Per pattern, per group that uses it: the patterns whose topmost row is above its own topmost row.
        self._above: dict[str, list[list[str]]] = {name: [] for name, _ in problem.patterns}
        for _, rows in problem.groups:
            order = list(dict.fromkeys(rows))
            for i, name in enumerate(order):
                self._above[name].append(order[:i])

    def __call__(self, name: str, chosen: Mapping[str, Word]) -> bool:
        own = self._measures(chosen[name])
        if own.waiting or own.size >= self._least:
            return True
        for patterns in self._above[name]:
            if any(p not in chosen for p in patterns):
                continue  # not chosen yet: another group may use the patterns in another order
            if own.size < self._least - sum([self._measures(chosen[p]).opaque for p in patterns]):
                return False
        return True

    def all(self, chosen: Mapping[str, Word]) -> bool:
        """Once more, for patterns that were chosen before some that stand above them in another group."""
        return self._groups == 1 or all(self(name, chosen) for name in chosen)


def rows_of(
    problem: AxisProblem, words: Mapping[str, Word], names: Sequence[str]
) -> list[tuple[Letter, ...]]:
    """The words of some patterns, ready to be aligned.

    An unsized symbol that is substituted in one pattern and left standing in another gets the size of its
    content, so that both fill the same part of the canvas (supplement 2.2).
    """
    extent: dict[str, float] = {}
    for name, pattern in problem.patterns:
        if pattern.substitutions and name in words:
            extent = {**dict(_measured(words[name]).contents), **extent}
    made: dict[str, tuple[Letter, ...]] = {}
    for name in names:
        if name not in made:
            letters = words[name].letters
            if extent and any(a.size is None and a.symbol in extent for a in letters):
                letters = tuple(
                    replace(a, size=extent[a.symbol]) if a.size is None and a.symbol in extent else a
                    for a in letters
                )
            made[name] = letters
    return [made[name] for name in names]
