"""The best alignment by exhaustive search: branch and bound over columns, best bound first, nothing clever."""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count

from facade_nb.solver.model.letters import Letter

from .pricing import DEFAULT, TIE, Task, Weights, lower_bound, positive, price
from .structures import Column, Group, State, finished, next_columns

__all__ = ["Best", "TooBig", "best"]


class TooBig(Exception):
    """The search looked at more partial structures than allowed."""


@dataclass(frozen=True, slots=True)
class Best:
    """The optimum.

    Attributes
    ----------
    cost
        Least J, or Ω under the paper's objective, over all structures and lengths of pieces ≥ 0.
    columns
        Most columns among the structures that reach it.
    strict_columns
        Most columns among those that reach it with every piece longer than nothing; None: there is none.
    structure
        One with `strict_columns`, else with `columns`, columns; an element for each distinct word.
    """

    cost: float
    columns: int
    strict_columns: int | None
    structure: tuple[Column, ...]


def _events(group: Group, states: tuple[State, ...]) -> int:
    """How many letters have yet to start, and to end: each boundary between columns needs one of these."""
    left = 0
    for word, (index, begun) in zip(group.words, states, strict=True):
        left += 2 * (len(word) - index) - begun
    return left


def best(
    rows: Sequence[Sequence[Letter]],
    canvas: float = 12.0,
    tolerance: float = 0.0,
    weights: Weights = DEFAULT,
    cuts: bool = True,
    limit: int | None = None,
) -> Best | None:
    """The least cost, then the most columns; None where nothing fits.

    The bound of a partial structure is the least cost of its columns by themselves (`lower_bound`). Two partial
    structures without free lengths that stop at the same letters, with the same rows empty in the last column and the
    same width, have the same futures: the one that costs more, or as much with no more columns, is dropped.

    Raises
    ------
    TooBig
        More than `limit` partial structures were looked at.
    """
    group = Group.of(rows)
    task = Task(group, canvas, tolerance, weights, cuts)
    tick = count()
    heap: list[tuple[float, int, int, bool, tuple[Column, ...], tuple[State, ...]]] = []
    heapq.heappush(heap, (0.0, 0, next(tick), False, (), tuple((0, False) for _ in group.words)))
    seen: dict[tuple[object, ...], list[tuple[float, int]]] = {}
    found: Best | None = None
    looked = 0
    while heap:
        bound, _, _, weighed, columns, states = heapq.heappop(heap)
        if found is not None:
            if bound > found.cost + TIE:
                break
            if len(columns) + _events(group, states) + 1 <= (found.strict_columns or 0):
                continue
        whole = finished(group, states)
        if not weighed:
            looked += 1
            if limit is not None and looked > limit:
                raise TooBig(f"more than {limit} partial structures")
            answer = _weigh(task, columns, states, whole, seen)
            if answer is not None:
                key = max(bound, round(answer, 7))
                heapq.heappush(heap, (key, -len(columns), next(tick), True, columns, states))
        elif whole:
            found = _better(task, found, columns)
        else:
            last = columns[-1] if columns else None
            for column, after in next_columns(group, states, last, cuts):
                heapq.heappush(heap, (bound, -len(columns) - 1, next(tick), False, (*columns, column), after))
    return found


def _weigh(
    task: Task,
    columns: tuple[Column, ...],
    states: tuple[State, ...],
    whole: bool,
    seen: dict[tuple[object, ...], list[tuple[float, int]]],
) -> float | None:
    if whole:
        answer = price(task, columns)
        return None if answer is None else answer.cost
    bound = lower_bound(task, columns)
    if bound is None:
        return None
    cost, width = bound
    if width is not None and columns:
        # The overshoot is part of the cost, and the same for equal states and widths.
        key = (states, tuple(bool(element) for element in columns[-1]), round(width, 9))
        known = seen.setdefault(key, [])
        if any(other <= cost + 1e-12 and number >= len(columns) for other, number in known):
            return None
        known.append((cost, len(columns)))
    return cost


def _better(task: Task, found: Best | None, columns: tuple[Column, ...]) -> Best:
    if found is None:
        answer = price(task, columns)
        assert answer is not None
        strict = len(columns) if positive(task, columns, answer.cost) else None
        return Best(answer.cost, len(columns), strict, columns)
    most = max(found.columns, len(columns))
    if len(columns) > (found.strict_columns or 0) and positive(task, columns, found.cost):
        return Best(found.cost, most, len(columns), columns)
    if found.strict_columns is None and len(columns) > found.columns:
        return Best(found.cost, most, None, columns)
    return Best(found.cost, most, found.strict_columns, found.structure)
