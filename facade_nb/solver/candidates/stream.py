"""Candidates: one word for each pattern under one value of each counter (the paper's 5.1, supplement 3.2)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush, heapreplace
from itertools import count
from math import inf

from ..model.letters import Word
from ..model.objective import Objective
from ..model.precision import EPS
from ..model.problem import AxisProblem
from .bounds import Chosen, Floors, GroupKey, LongEnough, Measured, measured

__all__ = ["Candidate", "CandidateStream", "candidates"]


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


_Entry = tuple[float, int, int, Chosen, dict[str, int], tuple[float, ...]]
"""Lower bound, minus how many patterns have a word, serial number, words, counters, and the bound of each group."""


class CandidateStream:
    """Candidates by growing lower bound, made only as far as they are asked for.

    Patterns are decided one after the other; what is decided bounds J from below (`Floors`), and the
    cheapest partial choice is taken further, so that of a million candidates only those are made that could
    be the best. What searches prove about the words of one group (`learn`) bounds all candidates with these.
    """

    def __init__(
        self,
        problem: AxisProblem,
        words: Mapping[str, Sequence[Word]],
        tolerance: float,
        objective: Objective,
        check: Callable[[], None] | None = None,
    ) -> None:
        self._check = check
        self._names = [name for name, _ in problem.patterns]
        self._given = [words[name] for name in self._names]
        self._words: list[_Words] = []
        self._long = LongEnough(problem, tolerance)
        self._floors = Floors(problem, tolerance, objective)
        self._serial = count()
        self._queue: list[_Entry] = []
        self._ready = self._learnt = False
        heappush(self._queue, (0.0, 0, next(self._serial), (), {}, (0.0,) * len(problem.groups)))

    @property
    def bound(self) -> float:
        """No candidate still to come costs less; infinite where none is."""
        if not self._ready:
            self._advance()
        return self._queue[0][0] if self._queue else inf

    def take(self) -> Candidate | None:
        """The next candidate, or None."""
        if self.bound == inf:
            return None
        self._ready = False
        bound, _, _, chosen, values, _ = heappop(self._queue)
        return _candidate(self._names, chosen, values, bound)

    def learn(self, key: GroupKey, floor: float) -> None:
        """No alignment of these words of a group costs less than `floor`."""
        if self._floors.learn(key, floor):
            self._learnt, self._ready = True, False

    def _advance(self) -> None:
        """Decide further patterns until the first in the queue is a candidate."""
        queue = self._queue
        while queue:
            if self._check is not None:
                self._check()
            bound, depth, serial, chosen, values, parts = queue[0]
            if self._learnt:
                parts = self._floors.now(parts, chosen)
                if sum(parts) > bound + EPS:
                    heapreplace(queue, (sum(parts), depth, serial, chosen, values, parts))
                    continue
            if -depth < len(self._names):
                heappop(queue)
                self._decide(bound, depth, chosen, values, parts)
            elif self._long.all(chosen):
                break
            else:
                heappop(queue)
        while queue and queue[0][0] == inf:
            queue.clear()
        self._ready = True

    def _decide(
        self, bound: float, depth: int, chosen: Chosen, values: dict[str, int], parts: tuple[float, ...]
    ) -> None:
        """Give the next pattern each of its words that agrees with what counters are already."""
        if -depth == len(self._words):
            self._words.append(_Words(self._given[-depth], values))
        for word, new in self._words[-depth].under(values):
            more = (*chosen, word)
            if not self._long.last(more):
                continue
            costs = self._floors.after(parts, more)
            least = max(bound, sum(costs))
            if least < inf:
                both = {**values, **new} if new else values
                heappush(self._queue, (least, depth - 1, next(self._serial), more, both, costs))


class _Words:
    """The words of a pattern by the values of those of its counters that patterns before it have as well."""

    def __init__(self, words: Sequence[Word], before: Mapping[str, int]) -> None:
        counters = words[0].counters if words else {}
        self._shared = [name for name in counters if name in before]
        self._by_values: dict[tuple[int, ...], list[tuple[Measured, dict[str, int]]]] = {}
        for word in words:
            key = tuple([word.counters[name] for name in self._shared])
            new = {name: value for name, value in word.counters.items() if name not in before}
            self._by_values.setdefault(key, []).append((measured(word), new))

    def under(self, values: Mapping[str, int]) -> Sequence[tuple[Measured, dict[str, int]]]:
        """Words that agree with some values; each with those of its other counters."""
        return self._by_values.get(tuple([values[name] for name in self._shared]), ())


def _agreed(values: dict[str, int], counters: Sequence[tuple[str, int]]) -> dict[str, int] | None:
    """Values of counters with some more; None where they contradict each other."""
    for counter, value in counters:
        if values.get(counter, value) != value:
            return None
    return {**values, **dict(counters)} if counters else values


def _candidate(names: Sequence[str], chosen: Chosen, values: dict[str, int], bound: float) -> Candidate:
    words = {name: own.word for name, own in zip(names, chosen, strict=True)}
    return Candidate(words, dict(values), bound)


def candidates(
    problem: AxisProblem,
    words: Mapping[str, Sequence[Word]],
    tolerance: float,
    objective: Objective,
    check: Callable[[], None] | None = None,
) -> Iterator[Candidate]:
    """Every candidate whose words keep Eq. 7, in lexicographic order, as the paper goes through them."""
    names = [name for name, _ in problem.patterns]
    own = [[measured(word) for word in words[name]] for name in names]
    long, bounds = LongEnough(problem, tolerance), Floors(problem, tolerance, objective)

    def descend(chosen: Chosen, values: dict[str, int]) -> Iterator[Candidate]:
        if check is not None:
            check()
        if len(chosen) == len(names):
            bound = bounds.of(chosen)
            if bound < inf and long.all(chosen):
                yield _candidate(names, chosen, values, bound)
            return
        for word in own[len(chosen)]:
            both = _agreed(values, word.counters)
            if both is not None and long.last((*chosen, word)):
                yield from descend((*chosen, word), both)

    return descend((), {})
