"""Candidates: one word for each pattern under one value of each counter (the paper's 5.1, Eq. 7, supplement 3.2).

The lower bound of Eq. 7 is canvas − μ − Σ of the opaque letters of the patterns above in the same group,
because opaque letters above may push the words below aside; unsized letters take whatever is left.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from heapq import heappop, heappush
from itertools import count
from math import inf

from .columns import EPS
from .letters import Letter, Word
from .objective import Objective
from .problem import AxisProblem

__all__ = ["Candidate", "CandidateStream", "candidates", "inputs_of", "lower_bound", "rows_of"]


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """Words by pattern name, and the counters' values they share.

    `bound` is a lower bound of J over all groups, from the sizes of the words alone.
    """

    words: Mapping[str, Word]
    counters: Mapping[str, int]
    bound: float = 0.0

    @property
    def rank(self) -> tuple[tuple[int, ...], tuple[str, ...]]:
        """By what candidates that are equally good are told apart."""
        return tuple(self.counters[name] for name in sorted(self.counters)), tuple(
            map(str, self.words.values())
        )


_Entry = tuple[float, int, int, dict[str, Word], dict[str, int], tuple[float, ...]]
"""Lower bound, minus how many patterns have a word, serial number, words, counters, and the bound of each group."""


class CandidateStream:
    """Candidates by growing lower bound, made only as far as they are asked for.

    Patterns are decided one after the other; what is decided bounds J from below (`_Bounds`), and the
    cheapest partial choice is taken further, so that of a million candidates only those are made that could
    be the best.
    """

    def __init__(
        self,
        problem: AxisProblem,
        words: Mapping[str, Sequence[Word]],
        tolerance: float,
        objective: Objective,
        check: Callable[[], None] | None = None,
    ) -> None:
        self._words, self._check = words, check
        self._names = [name for name, _ in problem.patterns]
        self._long = _LongEnough(problem, tolerance)
        self._bounds = _Bounds(problem, tolerance, objective)
        self._serial = count()
        self._queue: list[_Entry] = []
        heappush(self._queue, (0.0, 0, next(self._serial), {}, {}, (0.0,) * len(problem.groups)))
        self._ahead: Candidate | None = None

    @property
    def bound(self) -> float:
        """No candidate still to come costs less; infinite where none is."""
        if self._ahead is None:
            self._ahead = self._next()
        return inf if self._ahead is None else self._ahead.bound

    def take(self) -> Candidate | None:
        """The next candidate, or None."""
        candidate = self._ahead or self._next()
        self._ahead = None
        return candidate

    def _next(self) -> Candidate | None:
        while self._queue:
            if self._check is not None:
                self._check()
            bound, depth, _, chosen, values, parts = heappop(self._queue)
            if -depth == len(self._names):
                if self._long.all(chosen):
                    return Candidate(chosen, values, bound)
                continue
            name = self._names[-depth]
            for word in self._words[name]:
                if any(values.get(counter, value) != value for counter, value in word.counters.items()):
                    continue
                more = {**chosen, name: word}
                if not self._long(name, more):
                    continue
                costs = self._bounds.after(parts, more, name)
                least = sum(costs)
                if least < inf:
                    entry = (
                        max(bound, least),
                        depth - 1,
                        next(self._serial),
                        more,
                        {**values, **word.counters},
                        costs,
                    )
                    heappush(self._queue, entry)
        return None


def candidates(
    problem: AxisProblem,
    words: Mapping[str, Sequence[Word]],
    tolerance: float,
    objective: Objective,
    check: Callable[[], None] | None = None,
) -> Iterator[Candidate]:
    """Every candidate whose words keep Eq. 7, in lexicographic order, as the paper goes through them."""
    names = [name for name, _ in problem.patterns]
    long = _LongEnough(problem, tolerance)
    bounds = _Bounds(problem, tolerance, objective)

    def descend(k: int, chosen: dict[str, Word], values: dict[str, int]) -> Iterator[Candidate]:
        if check is not None:
            check()
        if k == len(names):
            bound = bounds.of(chosen)
            if bound < inf and long.all(chosen):
                yield Candidate(dict(chosen), dict(values), bound)
            return
        name = names[k]
        for word in words[name]:
            if any(values.get(counter, value) != value for counter, value in word.counters.items()):
                continue
            chosen[name] = word
            if long(name, chosen):
                yield from descend(k + 1, chosen, {**values, **word.counters})
        chosen.pop(name, None)

    return descend(0, {}, {})


class _Bounds:
    """Lower bounds of J for words chosen so far, kept for each group and the words that it depends on.

    A group whose rows are only partly decided is bounded by those that are: more rows make no column
    cheaper. The number of distinct words, which a row's share depends on, is not known then; it is at most
    the number of patterns.
    """

    def __init__(self, problem: AxisProblem, tolerance: float, objective: Objective) -> None:
        self._problem, self._tolerance, self._objective = problem, tolerance, objective
        self._rows = [tuple(dict.fromkeys(rows)) for _, rows in problem.groups]
        self._inputs = inputs_of(problem)
        self._known: dict[tuple[int, ...], float] = {}

    def of(self, words: Mapping[str, Word]) -> float:
        """Sum over the groups."""
        return sum(self._group(g, words) for g in range(len(self._inputs)))

    def after(self, before: tuple[float, ...], words: Mapping[str, Word], name: str) -> tuple[float, ...]:
        """Per group, from what it was before a pattern was given its word."""
        costs = list(before)
        for g, names in enumerate(self._inputs):
            if name in names:
                costs[g] = self._group(g, words)
        return tuple(costs)

    def _group(self, g: int, words: Mapping[str, Word]) -> float:
        key = (g, *[id(words.get(name)) for name in self._inputs[g]])
        bound = self._known.get(key)
        if bound is None:
            rows = [name for name in self._rows[g] if name in words]
            most = len(self._rows[g]) if len(rows) < len(self._rows[g]) else None
            letters = rows_of(self._problem, words, rows)
            bound = lower_bound(letters, self._problem.canvas, self._tolerance, self._objective, most)
            self._known[key] = bound
        return bound


def inputs_of(problem: AxisProblem) -> list[tuple[str, ...]]:
    """Per group: the patterns on whose words its rows depend, its own and those that give its symbols a size."""
    patterns = problem.pattern
    out: list[tuple[str, ...]] = []
    for _, rows in problem.groups:
        standing = {symbol for name in rows for symbol in patterns[name].placeholders}
        givers = [name for name, pattern in problem.patterns if standing & set(pattern.substituted)]
        out.append(tuple(dict.fromkeys([*rows, *givers])))
    return out


class _LongEnough:
    """Eq. 7: whether a word is long enough next to those above it; unsized letters take whatever is left."""

    def __init__(self, problem: AxisProblem, tolerance: float) -> None:
        self._least, self._groups = problem.canvas - tolerance - EPS, len(problem.groups)
        # Per pattern, per group that uses it: the patterns whose topmost row is above its own topmost row.
        self._above: dict[str, list[list[str]]] = {name: [] for name, _ in problem.patterns}
        for _, rows in problem.groups:
            order = list(dict.fromkeys(rows))
            for i, name in enumerate(order):
                self._above[name].append(order[:i])
        self._sizes: dict[int, tuple[float, float, Word]] = {}

    def __call__(self, name: str, chosen: Mapping[str, Word]) -> bool:
        size = self._measured(chosen[name])[0]
        if size >= self._least:
            return True
        for patterns in self._above[name]:
            if any(p not in chosen for p in patterns):
                continue  # not chosen yet: another group may use the patterns in another order
            if size < self._least - sum([self._measured(chosen[p])[1] for p in patterns]):
                return False
        return True

    def all(self, chosen: Mapping[str, Word]) -> bool:
        """Once more, for patterns that were chosen before some that stand above them in another group."""
        return self._groups == 1 or all(self(name, chosen) for name in chosen)

    def _measured(self, word: Word) -> tuple[float, float, Word]:
        """The size of the word, infinite where a letter is unsized, and of its opaque letters."""
        found = self._sizes.get(id(word))
        if found is None:
            open_ended = any(letter.size is None for letter in word.letters)
            opaque = sum([letter.size or 0.0 for letter in word.letters if letter.opaque])
            # kept with its measures, so that no other can have its identity
            found = self._sizes[id(word)] = (inf if open_ended else word.size, opaque, word)
        return found


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
            total: dict[tuple[str, int], float] = {}
            for letter in words[name].letters:
                if letter.origin is not None:
                    total[letter.origin] = total.get(letter.origin, 0.0) + (letter.size or 0.0)
            for (symbol, _), size in total.items():
                extent.setdefault(symbol, size)
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


def lower_bound(
    rows: Sequence[Sequence[Letter]],
    canvas: float,
    tolerance: float,
    objective: Objective,
    most: int | None = None,
) -> float:
    """J of a group is at least this, whatever the alignment (`network.shortfall`). Infinity: no fit.

    `most` is the number of distinct words there may be in the end, where `rows` are not all.
    """
    if not rows:
        return 0.0
    distinct: list[tuple[float, Sequence[Letter]]] = []
    for row in rows:
        size = sum([a.size or 0.0 for a in row])
        # cheaper than hashing all their letters
        if not any(size == known and row == other for known, other in distinct):
            distinct.append((size, row))
    totals: list[tuple[float, float]] = []
    longest = 0.0
    for size, word in distinct:
        longest = max(longest, size)
        open_ended = any(a.size is None for a in word)
        soft = not objective.plain and any(not a.opaque and not a.transparent for a in word)
        weight = (min(objective.empty, objective.loose) if soft else objective.empty) / (
            most or len(distinct)
        )
        totals.append((inf if open_ended else size, weight))
    if longest > canvas + tolerance + EPS:
        return inf
    scale = max(1.0, sum(weight for _, weight in totals))

    def cost(width: float) -> float:
        over = width - canvas
        return (
            objective.fit * abs(over)
            + sum(weight * max(0.0, width - size) for size, weight in totals) / scale
        )

    breaks = [longest]
    if longest < canvas:
        breaks += [canvas, *(size for size, _ in totals if longest < size < canvas)]
    return min(cost(width) for width in breaks)
