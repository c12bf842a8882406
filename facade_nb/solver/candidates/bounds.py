"""What words cost at least, from their sizes alone, before anything is aligned (5.1, Eq. 7, supplement 3.2).

The lower bound of Eq. 7 is canvas − μ − Σ of the opaque letters of the patterns above in the same group,
because opaque letters above may push the words below aside; unsized letters take whatever is left.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

from ..model.letters import Letter, Word
from ..model.objective import Objective
from ..model.precision import EPS
from ..model.problem import AxisProblem

__all__ = ["Chosen", "Floors", "GroupKey", "LongEnough", "Measured", "inputs_of", "measured", "rows_of"]

GroupKey = tuple[int, ...]
"""A group's number, and the identities of the words that its rows depend on."""


@dataclass(frozen=True, slots=True, eq=False)
class Measured:
    """What bounds ask of a word.

    Attributes
    ----------
    word, identity
        The word, kept so that no other one can have its identity.
    counters
        Their values in it.
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
    identity: int
    counters: tuple[tuple[str, int], ...]
    size: float
    opaque: float
    waiting: tuple[tuple[str, int], ...]
    soft: bool
    contents: tuple[tuple[str, float], ...]


Chosen = tuple[Measured, ...]
"""Words for the first patterns of a problem, in its order."""


def measured(word: Word) -> Measured:
    """Measure a word."""
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
    counters, waits = tuple(word.counters.items()), tuple(waiting.items())
    return Measured(word, id(word), counters, size, opaque, waits, soft, tuple(contents.items()))


class Floors:
    """Lower bounds of J for words chosen so far, kept for each group and the words that it depends on.

    A group whose rows are only partly decided is bounded by those that are: more rows make no column
    cheaper. The number of distinct words, which a row's share depends on, is not known then; it is at most
    the number of patterns.
    """

    def __init__(self, problem: AxisProblem, tolerance: float, objective: Objective) -> None:
        self._canvas, self._tolerance, self._objective = problem.canvas, tolerance, objective
        number = {name: n for n, (name, _) in enumerate(problem.patterns)}
        self._rows = [tuple(dict.fromkeys([number[name] for name in rows])) for _, rows in problem.groups]
        self._inputs = [tuple([number[name] for name in names]) for names in inputs_of(problem)]
        self._givers = [
            [n for n, (_, pattern) in enumerate(problem.patterns) if pattern.substitutions and n in inputs]
            for inputs in self._inputs
        ]
        self._groups = [
            [g for g, inputs in enumerate(self._inputs) if n in inputs] for n in range(len(problem.patterns))
        ]
        self._known: dict[GroupKey, float] = {}

    def of(self, chosen: Chosen) -> float:
        """Sum over the groups."""
        return sum([self._group(g, chosen) for g in range(len(self._inputs))])

    def after(self, before: tuple[float, ...], chosen: Chosen) -> tuple[float, ...]:
        """Per group, from what it was before the last pattern was given its word."""
        costs = list(before)
        for g in self._groups[len(chosen) - 1]:
            costs[g] = self._group(g, chosen)
        return tuple(costs)

    def now(self, before: tuple[float, ...], chosen: Chosen) -> tuple[float, ...]:
        """Per group, with what has been learnt since."""
        known = self._known
        return tuple([max(own, known.get(self._key(g, chosen), own)) for g, own in enumerate(before)])

    def learn(self, key: GroupKey, floor: float) -> bool:
        """Take in what a search has proven about all words of a group; whether that is news."""
        news = floor > self._known.get(key, -inf) + EPS
        if news:
            self._known[key] = floor
        return news

    def _key(self, g: int, chosen: Chosen) -> GroupKey:
        """Under what a group is known."""
        n = len(chosen)
        return (g, *[chosen[i].identity if i < n else 0 for i in self._inputs[g]])

    def _group(self, g: int, chosen: Chosen) -> float:
        key = self._key(g, chosen)
        bound = self._known.get(key)
        if bound is None:
            bound = self._known[key] = self._least(g, chosen)
        return bound

    def _least(self, g: int, chosen: Chosen) -> float:
        contents: dict[str, float] = {}
        for n in self._givers[g]:
            if n < len(chosen):
                contents = {**dict(chosen[n].contents), **contents}
        numbers = self._rows[g]
        rows = [chosen[n] for n in numbers if n < len(chosen)]
        distinct: list[Measured] = []
        for row in rows:
            for other in distinct:
                # cheaper than hashing all their letters
                if row.size == other.size and row.word.letters == other.word.letters:
                    break
            else:
                distinct.append(row)
        most = len(numbers) if len(rows) < len(numbers) else len(distinct)
        objective, totals = self._objective, []
        softly = objective.empty if objective.plain else min(objective.empty, objective.loose)
        for row in distinct:
            size = least = row.size
            for symbol, n in row.waiting:
                content = contents.get(symbol)
                if content is None:
                    size = inf
                else:
                    size, least = size + n * content, least + n * content
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

    def __init__(self, problem: AxisProblem, tolerance: float) -> None:
        self._least, self._groups = problem.canvas - tolerance - EPS, len(problem.groups)
        number = {name: n for n, (name, _) in enumerate(problem.patterns)}
        # Per pattern, per group that uses it: the patterns whose topmost row is above its own topmost row.
        self._above: list[list[list[int]]] = [[] for _ in number]
        for _, rows in problem.groups:
            order = [number[name] for name in dict.fromkeys(rows)]
            for i, n in enumerate(order):
                self._above[n].append(order[:i])

    def last(self, chosen: Chosen) -> bool:
        """Whether the last word is, next to the others."""
        return self._one(len(chosen) - 1, chosen)

    def all(self, chosen: Chosen) -> bool:
        """Once more, for patterns that were chosen before some that stand above them in another group."""
        return self._groups == 1 or all(self._one(n, chosen) for n in range(len(chosen)))

    def _one(self, n: int, chosen: Chosen) -> bool:
        own = chosen[n]
        if own.waiting or own.size >= self._least:
            return True
        for above in self._above[n]:
            if any(p >= len(chosen) for p in above):
                continue  # not chosen yet: another group may use the patterns in another order
            if own.size < self._least - sum([chosen[p].opaque for p in above]):
                return False
        return True


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
            extent = {**dict(measured(words[name]).contents), **extent}
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
