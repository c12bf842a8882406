"""Candidates: one word for each pattern under one value of each counter (the paper's 5.1, Eq. 7, supplement 3.2)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

from .columns import EPS
from .letters import Letter, Word
from .objective import Objective
from .problem import AxisProblem

__all__ = ["Candidate", "candidates", "lower_bound", "rows_of"]


@dataclass(frozen=True, slots=True)
class Candidate:
    """Words by pattern name, and the counters' values they share.

    `bound` is a lower bound of J over all groups, from the sizes of the words alone.
    """

    words: Mapping[str, Word]
    counters: Mapping[str, int]
    bound: float = 0.0


def candidates(
    problem: AxisProblem,
    words: Mapping[str, Sequence[Word]],
    tolerance: float,
    objective: Objective,
    check: Callable[[], None] | None = None,
) -> Iterator[Candidate]:
    """Every candidate whose words keep Eq. 7, in lexicographic order.

    The lower bound of Eq. 7 is canvas − μ − Σ of the opaque letters of the patterns above in the same group,
    because opaque
    letters above may push the words below aside; unsized letters take whatever is left.
    """
    names = [name for name, _ in problem.patterns]
    above = _above(problem)
    bounds = _Bounds(problem, tolerance, objective)

    def descend(k: int, chosen: dict[str, Word], values: dict[str, int]) -> Iterator[Candidate]:
        if check is not None:
            check()
        if k == len(names):
            bound = bounds.of(chosen)
            if bound < inf:
                yield Candidate(dict(chosen), dict(values), bound)
            return
        name = names[k]
        for word in words[name]:
            if any(values.get(counter, value) != value for counter, value in word.counters.items()):
                continue
            chosen[name] = word
            if not _long_enough(problem, name, chosen, above[name], tolerance):
                continue
            yield from descend(k + 1, chosen, {**values, **word.counters})
        chosen.pop(name, None)

    yield from descend(0, {}, {})


class _Bounds:
    """Lower bounds of J, kept for each group and the words that it depends on."""

    def __init__(self, problem: AxisProblem, tolerance: float, objective: Objective) -> None:
        self._problem, self._tolerance, self._objective = problem, tolerance, objective
        substituted = {name: pattern.substituted for name, pattern in problem.patterns}
        patterns = problem.pattern
        self._inputs: list[tuple[str, ...]] = []
        for _, rows in problem.groups:
            standing = {symbol for name in rows for symbol in patterns[name].placeholders}
            givers = [name for name, symbols in substituted.items() if standing & set(symbols)]
            self._inputs.append(tuple(dict.fromkeys([*rows, *givers])))
        self._known: dict[tuple[int, ...], float] = {}

    def of(self, words: Mapping[str, Word]) -> float:
        """Sum over the groups."""
        total = 0.0
        for g, names in enumerate(self._inputs):
            key = (g, *(id(words[name]) for name in names))
            bound = self._known.get(key)
            if bound is None:
                rows = rows_of(self._problem, words, g)[0]
                bound = lower_bound(rows, self._problem.canvas, self._tolerance, self._objective)
                self._known[key] = bound
            total += bound
            if total == inf:
                break
        return total


def _above(problem: AxisProblem) -> dict[str, list[list[str]]]:
    """Per pattern, per group that uses it: the patterns whose topmost row is above its own topmost row."""
    above: dict[str, list[list[str]]] = {name: [] for name, _ in problem.patterns}
    for _, rows in problem.groups:
        order = list(dict.fromkeys(rows))
        for i, name in enumerate(order):
            above[name].append(order[:i])
    return above


def _long_enough(
    problem: AxisProblem,
    name: str,
    chosen: Mapping[str, Word],
    above: Sequence[Sequence[str]],
    tolerance: float,
) -> bool:
    word = chosen[name]
    if any(letter.size is None for letter in word.letters):
        return True
    for patterns in above:
        if any(p not in chosen for p in patterns):
            continue  # not chosen yet: another group may use the patterns in another order
        room = sum(a.size or 0.0 for p in patterns for a in chosen[p].letters if a.opaque)
        if word.size < problem.canvas - tolerance - room - EPS:
            return False
    return True


def rows_of(
    problem: AxisProblem, words: Mapping[str, Word], only: int | None = None
) -> list[list[tuple[Letter, ...]]]:
    """The rows of every group (or of the one numbered `only`), topmost first.

    An unsized symbol that is substituted in one pattern and left standing in another gets the size of its
    content, so
    that both fill the same part of the canvas (supplement 2.2).
    """
    extent: dict[str, float] = {}
    for name, _ in problem.patterns:
        total: dict[tuple[str, int], float] = {}
        for letter in words[name].letters:
            if letter.origin is not None:
                total[letter.origin] = total.get(letter.origin, 0.0) + (letter.size or 0.0)
        for (symbol, _), size in total.items():
            extent.setdefault(symbol, size)
    groups = problem.groups if only is None else problem.groups[only : only + 1]
    made: dict[str, tuple[Letter, ...]] = {}
    for name in dict.fromkeys(name for _, rows in groups for name in rows):
        letters = words[name].letters
        if extent and any(a.size is None and a.symbol in extent for a in letters):
            letters = tuple(
                replace(a, size=extent[a.symbol]) if a.size is None and a.symbol in extent else a
                for a in letters
            )
        made[name] = letters
    return [[made[name] for name in rows] for _, rows in groups]


def lower_bound(
    rows: Sequence[Sequence[Letter]], canvas: float, tolerance: float, objective: Objective
) -> float:
    """J of a group is at least this, whatever the alignment (`network.shortfall`). Infinity: no fit."""
    distinct = list(dict.fromkeys(tuple(row) for row in rows))
    totals: list[tuple[float, float]] = []
    longest = 0.0
    for word in distinct:
        size = sum(a.size or 0.0 for a in word)
        longest = max(longest, size)
        open_ended = any(a.size is None for a in word)
        soft = not objective.plain and any(not a.opaque and not a.transparent for a in word)
        weight = (min(objective.empty, objective.loose) if soft else objective.empty) / len(distinct)
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
