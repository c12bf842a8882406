"""The alignment of given words as a mixed-integer programme: what the solver's own search is measured against.

Exact (docs/problem.md), and nothing here is of the solver's search. Every column that the
constraints and the tolerance allow is made beforehand: it is an arc between two states of the words, and an alignment
is a path. Where every letter has its size the price of an arc is a number, and the relaxation is the shortest-path
polytope, cut by nothing but the canvas. Where letters are cut, or have no size, each arc has lengths of its own, which
are zero unless the arc is used: for each arc the convex hull.

`milp_reference` has a second formulation, for more words than this one can take.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import pairwise, product
from math import inf

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import csr_array

from facade_nb.solver.model.letters import Letter
from tests.oracle.pricing import Weights
from tests.oracle.structures import Group, moves

__all__ = [
    "Answer",
    "Part",
    "Place",
    "Programme",
    "Task",
    "TooLarge",
    "Words",
    "meet_canvas",
    "minus",
    "pose_paths",
    "tie_lengths",
]

NEAR = 1e-9
Place = tuple[int, bool, int]
"""The letter a word goes on with, whether a piece of it stands already, and what C4 forbids next."""
HELD, BARRED = 1, 2
"""C4: the next element may not be empty; the next letter may not begin."""


class TooLarge(Exception):
    """There are more columns than asked for."""


@dataclass(frozen=True, slots=True)
class Task:
    """Words to be aligned, topmost first, and how; columns that alone cost more than `cutoff` are left out."""

    rows: tuple[tuple[Letter, ...], ...]
    canvas: float
    tolerance: float
    weights: Weights
    cuts: bool = True
    cutoff: float = inf

    @property
    def widest(self) -> float:
        """No length is more than this."""
        return self.canvas + self.tolerance


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """What a word puts into a column.

    `size` is that of its whole letters with a size; `elastic` are those of its letters whose length is open, and
    `whole` those that could have been cut and are not.
    """

    after: Place
    empty: bool = True
    soft: bool = False
    opaque: bool = False
    guarded: bool = False
    begins: bool = False
    ends: bool = False
    size: float = 0.0
    loose: float = 0.0
    elastic: tuple[int, ...] = ()
    whole: tuple[int, ...] = ()


@dataclass(slots=True)
class Answer:
    """What HiGHS says: least cost found, what it has proven to be the least, and the time it took."""

    cost: float
    bound: float
    proven: bool
    feasible: bool
    seconds: float
    inflated: bool = False


class Words:
    """The distinct words of a task and what each may put into a column."""

    def __init__(self, task: Task) -> None:
        self.task, self.group = task, Group.of(task.rows)
        self.words = self.group.words
        self.share = self.group.share
        self.waived = not self.group.any_opaque
        word_of = self.group.word_of
        self.above = [
            {word_of[i] for i in range(max(k for k, w in enumerate(word_of) if w == b))}
            for b in range(len(self.words))
        ]
        self.parts = lru_cache(maxsize=None)(self._parts)

    @property
    def start(self) -> tuple[Place, ...]:
        """Where the words begin."""
        return tuple((0, False, 0) for _ in self.words)

    def done(self, b: int, place: Place) -> bool:
        """Whether a word is used up."""
        return place[:2] == (len(self.words[b]), False)

    def _parts(self, b: int, place: Place) -> tuple[Part, ...]:
        return tuple(self._make(b, place))

    def _make(self, b: int, place: Place) -> Iterator[Part]:
        word, (index, begun, flag) = self.words[b], place
        for element, (i, mid) in moves(word, (index, begun), self.task.cuts):
            if not element:
                if flag != HELD:
                    ahead = i < len(word) and not mid and word[i].attached and not word[i].transparent
                    yield Part((i, mid, BARRED if ahead else 0))
                continue
            letters = [word[bit.index] for bit in element]
            if flag == BARRED:
                continue
            solid = not letters[0].transparent
            open_ended = tuple(
                bit.index for bit, x in zip(element, letters, strict=True) if x.size is None or not bit.whole
            )
            soft = solid and any(not x.opaque for x in letters)
            part = Part(
                after=(i, mid, HELD if solid and letters[-1].attached else 0),
                empty=False,
                soft=soft,
                opaque=solid and not soft,
                guarded=solid and any(x.unoccludable for x in letters),
                begins=element[0].starts,
                ends=element[-1].ends,
                size=sum(
                    x.size or 0.0
                    for bit, x in zip(element, letters, strict=True)
                    if bit.index not in open_ended
                ),
                loose=sum(min(x.size or 0.0, y.size or 0.0) for x, y in pairwise(letters)) if solid else 0.0,
                elastic=open_ended,
                whole=() if solid else tuple(bit.index for bit in element if bit.index not in open_ended),
            )
            if not (part.guarded and part.soft and b in self.above[b]):
                yield part

    def rest(self, parts: Sequence[Part]) -> list[int]:
        """The words that count for the least size of a column."""
        present = [b for b, part in enumerate(parts) if not part.empty]
        if self.task.weights.paper:
            return present
        return [b for b in present if not parts[b].soft] or present

    def allowed(self, parts: Sequence[Part]) -> bool:
        """C1, C3 and the tolerance."""
        if all(part.empty for part in parts):
            return False
        gapes = any(part.empty or part.soft for part in parts)
        if gapes and not self.waived and not any(part.opaque for part in parts):
            return False
        for b, part in enumerate(parts):
            if part.guarded and any(parts[a].soft for a in self.above[b]):
                return False
        high = max(part.size for part in parts if not part.empty)
        low = min((parts[b].size for b in self.rest(parts) if not parts[b].elastic), default=inf)
        return high - low <= min(self.task.tolerance, self.task.cutoff) + 1e-8

    def open_letters(self) -> Iterator[tuple[int, int]]:
        """Word and index of every letter whose length may be open."""
        for b, word in enumerate(self.words):
            for k, letter in enumerate(word):
                if letter.size is None or (letter.transparent and self.task.cuts):
                    yield b, k


@dataclass(slots=True)
class Programme:
    """A mixed-integer programme, built row by row."""

    build: float = 0.0
    cost: list[float] = field(default_factory=list)
    low: list[float] = field(default_factory=list)
    high: list[float] = field(default_factory=list)
    whole: list[bool] = field(default_factory=list)
    rows: list[tuple[dict[int, float], float, float]] = field(default_factory=list)
    widths: list[tuple[int, list[dict[int, float]]]] = field(default_factory=list)
    """Widths that are variables, each with the sizes that it is to be the largest of."""

    def number(self, cost: float = 0.0, high: float = inf, whole: bool = False) -> int:
        """A new variable ≥ 0."""
        self.cost.append(cost)
        self.low.append(0.0)
        self.high.append(high)
        self.whole.append(whole)
        return len(self.cost) - 1

    def add(self, row: dict[int, float], low: float = -inf, high: float = 0.0) -> None:
        """A new constraint, ``low ≤ row ≤ high``."""
        self.rows.append((row, low, high))

    @property
    def size(self) -> tuple[int, int, int]:
        """Numbers of variables, of those that are whole numbers, and of constraints."""
        return len(self.cost), sum(self.whole), len(self.rows)

    def solve(self, time_limit: float) -> Answer:
        """Give it to HiGHS; where a width is more than its largest row (only the canvas can ask for it), once more."""
        if not self.cost:  # no column is allowed
            return Answer(inf, inf, True, False, 0.0)
        answer, x = self._solve(time_limit)
        if x is not None and self._inflated(x):
            largest = max(self.high[v] for v, _ in self.widths)
            for width, sizes in self.widths:
                chosen = [self.number(0.0, 1.0, True) for _ in sizes]
                self.add(dict.fromkeys(chosen, 1.0), 1.0, 1.0)
                for one, size in zip(chosen, sizes, strict=True):
                    self.add(minus({width: 1.0, one: largest}, size), high=largest)
            first = answer.seconds
            answer, _ = self._solve(time_limit)
            answer.seconds, answer.inflated = answer.seconds + first, True
        return answer

    def _inflated(self, x: np.ndarray) -> bool:
        return any(
            x[width] > max(sum(c * x[v] for v, c in size.items()) for size in sizes) + 1e-6
            for width, sizes in self.widths
        )

    def _solve(self, time_limit: float) -> tuple[Answer, np.ndarray | None]:
        count = [len(row) for row, _, _ in self.rows]
        columns = np.fromiter((v for row, _, _ in self.rows for v in row), dtype=np.int64, count=sum(count))
        values = np.fromiter((c for row, _, _ in self.rows for c in row.values()), float, count=sum(count))
        starts = np.concatenate(([0], np.cumsum(count)))
        matrix = csr_array((values, columns, starts), shape=(len(self.rows), len(self.cost)))
        low, high = (np.array([row[end] for row in self.rows]) for end in (1, 2))
        begin = time.perf_counter()
        result = milp(
            np.array(self.cost),
            integrality=np.array(self.whole, dtype=int),
            bounds=Bounds(np.array(self.low), np.array(self.high)),
            constraints=LinearConstraint(matrix, low, high),
            options={"time_limit": time_limit, "mip_rel_gap": 1e-9},
        )
        seconds = time.perf_counter() - begin
        bound = getattr(result, "mip_dual_bound", None)
        answer = Answer(
            inf if result.x is None else float(result.fun),
            -inf if bound is None else float(bound),
            result.status == 0,
            result.status != 2,
            seconds,
        )
        return answer, result.x


def minus(row: dict[int, float], other: dict[int, float]) -> dict[int, float]:
    out = dict(row)
    for v, c in other.items():
        out[v] = out.get(v, 0.0) - c
    return out


def pose_paths(task: Task, most: int = 200_000) -> Programme:
    """The formulation by paths.

    Raises
    ------
    TooLarge
        There are more than `most` columns.
    """
    begin = time.perf_counter()
    words = Words(task)
    arcs = _useful(words, list(_arcs(words, most)))
    programme = Programme()
    flow: dict[object, dict[int, float]] = {}
    lengths: dict[tuple[int, int], dict[int, float]] = {}
    total: dict[int, float] = {}
    for source, target, parts in arcs:
        arc = programme.number(0.0, 1.0, True)
        out, into = flow.setdefault(source, {}), flow.setdefault(target, {})
        out[arc] = out.get(arc, 0.0) + 1.0
        into[arc] = into.get(arc, 0.0) - 1.0
        _price_arc(programme, words, arc, parts, lengths, total)
    source_row = flow.pop(_SOURCE, {})
    programme.add(source_row, 1.0, 1.0)
    flow.pop(_SINK, None)
    for row in flow.values():
        programme.add(row, 0.0, 0.0)
    tie_lengths(programme, words, lengths)
    meet_canvas(programme, task, total)
    programme.build = time.perf_counter() - begin
    return programme


_SOURCE, _SINK = "source", "sink"
_Arc = tuple[object, object, tuple[Part, ...]]


def _arcs(words: Words, most: int) -> Iterator[_Arc]:
    """Every allowed column from every state that can be reached."""
    start = (words.start, True)
    todo, known = [start], {start}
    made = 0
    while todo:
        node = todo.pop()
        places, ended = node
        for parts in product(*(words.parts(b, place) for b, place in enumerate(places))):
            if not (ended or any(part.begins for part in parts)) or not words.allowed(parts):
                continue
            made += 1
            if made > most:
                raise TooLarge(f"more than {most} columns")
            after = tuple(part.after for part in parts)
            if all(words.done(b, place) for b, place in enumerate(after)):
                yield _SOURCE if node == start else node, _SINK, parts
            target = (after, any(part.ends for part in parts))
            if target not in known:
                known.add(target)
                todo.append(target)
            yield _SOURCE if node == start else node, target, parts


def _useful(words: Words, arcs: list[_Arc]) -> list[_Arc]:
    """The arcs that lie on a path to the end, no wider than the canvas and the tolerance."""
    rests = [
        [sum(letter.size or 0.0 for letter in word[i:]) for i in range(len(word) + 1)] for word in words.words
    ]
    back: dict[object, list[int]] = {}
    for n, (_, target, _) in enumerate(arcs):
        back.setdefault(target, []).append(n)
    useful: set[int] = set()
    todo: list[object] = [_SINK]
    seen: set[object] = {_SINK}
    while todo:
        for n in back.get(todo.pop(), ()):
            source, target, parts = arcs[n]
            if target != _SINK and _too_wide(words, target, parts, rests):
                continue
            useful.add(n)
            if source not in seen:
                seen.add(source)
                todo.append(source)
    return [arc for n, arc in enumerate(arcs) if n in useful]


def _too_wide(words: Words, target: object, parts: tuple[Part, ...], rests: list[list[float]]) -> bool:
    """Whether a column and what must still follow it cannot keep to the canvas."""
    places: tuple[Place, ...] = target[0]  # type: ignore[index]
    width = max(part.size for part in parts)
    left = max(rests[b][place[0] + place[1]] for b, place in enumerate(places))
    return width + left > words.task.widest + 1e-8


def _price_arc(
    programme: Programme,
    words: Words,
    arc: int,
    parts: tuple[Part, ...],
    lengths: dict[tuple[int, int], dict[int, float]],
    total: dict[int, float],
) -> None:
    task, weights, share = words.task, words.task.weights, words.share
    present = [b for b, part in enumerate(parts) if not part.empty]
    softs = [] if weights.paper else [b for b in present if parts[b].soft]
    empty = 0.0 if weights.paper else weights.empty * share * (len(parts) - len(present))
    loose = 0.0 if weights.paper else weights.loose * share
    rest = words.rest(parts)
    for b in present:
        for k in parts[b].whole:
            lengths.setdefault((b, k), {})[arc] = words.words[b][k].size or 0.0
    programme.cost[arc] = loose * sum(parts[b].loose for b in present)
    if not any(parts[b].elastic for b in present):
        width = max(parts[b].size for b in present)
        omega = width - min(parts[b].size for b in rest)
        programme.cost[arc] += omega + empty * width + loose * sum(width - parts[b].size for b in softs)
        total[arc] = width
        return
    high = programme.number(1.0 + empty + loose * len(softs), task.widest)
    low = programme.number(-1.0, task.widest)
    programme.cost[arc] -= loose * sum(parts[b].size for b in softs)
    total[high] = 1.0
    sizes: list[dict[int, float]] = []
    for b in present:
        size = {arc: parts[b].size} if parts[b].size else {}
        for k in parts[b].elastic:
            most = words.words[b][k].size or task.widest
            own = programme.number(0.0, most)
            programme.add({own: 1.0, arc: -most})
            size[own] = 1.0
            lengths.setdefault((b, k), {})[own] = 1.0
        sizes.append(size)
        programme.add(minus(size, {high: 1.0}))
        if b in rest:
            programme.add(minus({low: 1.0}, size))
    programme.widths.append((high, sizes))
    programme.add({high: 1.0, low: -1.0, arc: -task.tolerance})
    programme.add({high: 1.0, arc: -task.widest})


def tie_lengths(programme: Programme, words: Words, lengths: dict[tuple[int, int], dict[int, float]]) -> None:
    """The pieces of a letter add up to its size; letters of an unsized symbol have one size."""
    shared: dict[str, int] = {}
    for b, k in words.open_letters():
        letter, row = words.words[b][k], lengths.get((b, k), {})
        if letter.size is not None:
            programme.add(row, letter.size, letter.size)
        else:
            if letter.symbol not in shared:
                shared[letter.symbol] = programme.number(0.0, words.task.widest)
            programme.add(minus(row, {shared[letter.symbol]: 1.0}), 0.0, 0.0)


def meet_canvas(programme: Programme, task: Task, total: dict[int, float]) -> None:
    """W keeps to the canvas, and misses it at a price."""
    programme.add(total, task.canvas - task.tolerance - 1e-8, task.canvas + task.tolerance + 1e-8)
    if task.weights.fit and not task.weights.paper:
        miss = programme.number(task.weights.fit)
        programme.add(minus(total, {miss: 1.0}), high=task.canvas)
        programme.add({**{v: -c for v, c in total.items()}, miss: -1.0}, high=-task.canvas)
