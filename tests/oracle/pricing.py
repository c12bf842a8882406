"""The least J, or Ω, of a fixed structure over the lengths of its pieces: exact, by linear programs.

The width of a column is the largest row in it. As a lower bound of the width this is linear, and mostly enough: every
term but the shortfall below the canvas makes a column as narrow as it can be. Where the widths of the linear program
come out larger than the rows allow, the columns are branched on: which row is the largest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from scipy.optimize import linprog

from .structures import Column, Group

__all__ = ["DEFAULT", "PAPER", "SLACK", "TIE", "Price", "Task", "Weights", "lower_bound", "positive", "price"]

SLACK = 1e-8
"""How far constraints may be missed."""
TIE = 1e-6
"""Costs this close are equal."""
STRICT = 1e-4
"""Pieces longer than this are positive."""


@dataclass(frozen=True, slots=True)
class Weights:
    """The objective: the weights of J, or the paper's Ω."""

    empty: float = 0.8
    loose: float = 0.25
    fit: float = 0.25
    paper: bool = False


PAPER = Weights(0.0, 0.0, 0.0, paper=True)
DEFAULT = Weights()


@dataclass(frozen=True, slots=True)
class Task:
    """What `align` is asked."""

    group: Group
    canvas: float
    tolerance: float
    weights: Weights
    cuts: bool


@dataclass(frozen=True, slots=True)
class Price:
    """The least cost of a structure; its Ω and W, and the free lengths, at one place where it is reached."""

    cost: float
    omega: float
    width: float
    lengths: dict[tuple[object, ...], float] = field(default_factory=dict)


@dataclass(slots=True)
class Sum:
    """A linear expression."""

    constant: float = 0.0
    terms: dict[int, float] = field(default_factory=dict)

    def add(self, other: Sum, factor: float = 1.0) -> Sum:
        """Return the sum of this and a multiple of another."""
        terms = dict(self.terms)
        for variable, weight in other.terms.items():
            terms[variable] = terms.get(variable, 0.0) + factor * weight
        return Sum(self.constant + factor * other.constant, terms)

    def at(self, values: np.ndarray) -> float:
        """Its value."""
        return self.constant + sum(
            weight * float(values[variable]) for variable, weight in self.terms.items()
        )


class Program:
    """The linear program of a structure, or of the first columns of one."""

    def __init__(self, task: Task, columns: Sequence[Column], complete: bool) -> None:
        self.task, self.columns = task, columns
        self.names: list[tuple[object, ...]] = []
        self.low: list[float] = []
        self.high: list[float | None] = []
        self.at_most: list[Sum] = []  # each ≤ 0
        self.equal: list[Sum] = []  # each = 0
        self.unsized: dict[str, Sum] = {}
        self.pieces: list[Sum] = []
        self.sizes: list[list[Sum | None]] = []
        self.widths: list[Sum] = []
        self.omegas: list[Sum] = []
        self.cost = Sum()
        self._lengths(complete)
        for number, column in enumerate(columns):
            self._column(number, column)
        self._canvas(complete)

    def variable(self, name: tuple[object, ...], low: float = 0.0, high: float | None = None) -> Sum:
        """A new variable."""
        self.names.append(name)
        self.low.append(low)
        self.high.append(high)
        return Sum(0.0, {len(self.names) - 1: 1.0})

    def size_of(self, word: int, index: int) -> Sum:
        """The size of a letter: given, or one free number for each unsized symbol."""
        letter = self.task.group.words[word][index]
        if letter.size is not None:
            return Sum(letter.size)
        if not letter.transparent:
            raise ValueError(
                f"solid letter {letter.symbol} without a size: unsized symbols are transparent (docs/documents.md)"
            )
        if letter.symbol not in self.unsized:
            self.unsized[letter.symbol] = self.variable(("size", letter.symbol))
            self.pieces.append(self.unsized[letter.symbol])
        return self.unsized[letter.symbol]

    def _lengths(self, complete: bool) -> None:
        words = self.task.group.words
        used = [Sum() for _ in words]
        cut: dict[tuple[int, int], Sum] = {}
        for number, column in enumerate(self.columns):
            line: list[Sum | None] = []
            for word, element in enumerate(column):
                size = Sum()
                for bit in element:
                    if bit.whole:
                        size = size.add(self.size_of(word, bit.index))
                    else:
                        piece = self.variable(("piece", word, bit.index, number))
                        self.pieces.append(piece)
                        cut[word, bit.index] = cut.get((word, bit.index), Sum()).add(piece)
                        size = size.add(piece)
                used[word] = used[word].add(size)
                line.append(size if element else None)
            self.sizes.append(line)
        for (word, index), total in cut.items():
            closed = any(bit.index == index and bit.ends for column in self.columns for bit in column[word])
            difference = total.add(self.size_of(word, index), -1.0)
            (self.equal if closed or complete else self.at_most).append(difference)
        self.rest: list[Sum] = []
        if not complete:
            for word, letters in enumerate(words):
                whole = Sum()
                for index in range(len(letters)):
                    whole = whole.add(self.size_of(word, index))
                self.rest.append(whole.add(used[word], -1.0))

    def _column(self, number: int, column: Column) -> None:
        group, weights = self.task.group, self.task.weights
        line = self.sizes[number]
        present = [word for word, size in enumerate(line) if size is not None]
        hangs = [
            word
            for word in present
            if any(not x.transparent and not x.opaque for x in group.letters(word, column[word]))
        ]
        counted = present if weights.paper else [word for word in present if word not in hangs] or present
        constant = all(not size.terms for size in line if size is not None)
        if constant:
            width = Sum(max(size.constant for size in line if size is not None))
            omega = width.add(Sum(min(line[word].constant for word in counted)), -1.0)  # type: ignore[union-attr]
            self.at_most.append(omega.add(Sum(self.task.tolerance + SLACK), -1.0))
        else:
            width = self.variable(("width", number))
            omega = self.variable(("omega", number), 0.0, self.task.tolerance + SLACK)
            for word in present:
                self.at_most.append(_some(line[word]).add(width, -1.0))
            for word in counted:
                self.at_most.append(width.add(_some(line[word]), -1.0).add(omega, -1.0))
        self.widths.append(width)
        self.omegas.append(omega)
        self.cost = self.cost.add(omega)
        if weights.paper:
            return
        empty_share = sum(group.share for size in line if size is None)
        self.cost = self.cost.add(width, weights.empty * empty_share)
        for word in present:
            letters = group.letters(word, column[word])
            if letters[0].transparent:
                continue
            neighbours = sum(min(_size(a.size), _size(b.size)) for a, b in pairwise(letters))
            self.cost = self.cost.add(Sum(neighbours), weights.loose * group.share)
            if word in hangs:
                self.cost = self.cost.add(width.add(_some(line[word]), -1.0), weights.loose * group.share)

    def _canvas(self, complete: bool) -> None:
        task = self.task
        total = Sum()
        for width in self.widths:
            total = total.add(width)
        self.total = total
        if complete:
            self.at_most.append(Sum(task.canvas - task.tolerance - SLACK).add(total, -1.0))
            totals = [total]
        else:
            totals = [total.add(rest) for rest in self.rest] or [total]
        for one in totals:
            self.at_most.append(one.add(Sum(task.canvas + task.tolerance + SLACK), -1.0))
        if task.weights.paper or not task.weights.fit:
            return
        if not any(one.terms for one in totals):
            miss = max(one.constant - task.canvas for one in totals)
            self.cost = self.cost.add(Sum(task.weights.fit * (abs(miss) if complete else max(0.0, miss))))
            return
        miss_by = self.variable(("miss",))
        for one in totals:
            self.at_most.append(one.add(Sum(task.canvas), -1.0).add(miss_by, -1.0))
        if complete:
            self.at_most.append(Sum(task.canvas).add(total, -1.0).add(miss_by, -1.0))
        self.cost = self.cost.add(miss_by, task.weights.fit)

    def solve(
        self, goal: Sum, at_most: Sequence[Sum] = (), equal: Sequence[Sum] = ()
    ) -> tuple[float, np.ndarray] | None:
        """The least value of `goal` and where it is reached; None where nothing satisfies the constraints."""
        upper, same = [*self.at_most, *at_most], [*self.equal, *equal]
        if any(not row.terms and row.constant > SLACK for row in upper):
            return None
        if any(not row.terms and abs(row.constant) > SLACK for row in same):
            return None
        count = len(self.names)
        if not count:
            return goal.constant, np.zeros(0)
        c = np.zeros(count)
        for variable, weight in goal.terms.items():
            c[variable] = weight
        a_ub, b_ub = _matrix(upper, count)
        a_eq, b_eq = _matrix(same, count)
        answer = linprog(
            c,
            A_ub=a_ub,
            b_ub=b_ub,
            A_eq=a_eq,
            b_eq=b_eq,
            bounds=list(zip(self.low, self.high, strict=True)),
            method="highs",
            options={"primal_feasibility_tolerance": 1e-9, "dual_feasibility_tolerance": 1e-9},
        )
        if answer.status == 2:
            return None
        if answer.status != 0:
            raise ArithmeticError(f"HiGHS gave up: {answer.message}")
        return goal.constant + float(answer.fun), np.asarray(answer.x)

    def solve_tight(
        self, goal: Sum, at_most: Sequence[Sum] = (), equal: Sequence[Sum] = ()
    ) -> tuple[float, np.ndarray] | None:
        """Like `solve`, with every column exactly as wide as its largest row."""
        answer = self.solve(goal, at_most, equal)
        if answer is None:
            return None
        slack = [
            width.at(answer[1]) - max(size.at(answer[1]) for size in line if size is not None)
            for width, line in zip(self.widths, self.sizes, strict=True)
        ]
        worst = int(np.argmax(slack)) if slack else 0
        if not slack or slack[worst] <= TIE:
            return answer
        found: tuple[float, np.ndarray] | None = None
        for size in self.sizes[worst]:
            if size is not None:
                tied = self.solve_tight(goal, at_most, [*equal, self.widths[worst].add(size, -1.0)])
                if tied is not None and (found is None or tied[0] < found[0]):
                    found = tied
        return found


def _some(size: Sum | None) -> Sum:
    assert size is not None
    return size


def _size(size: float | None) -> float:
    if size is None:
        raise ValueError("a solid letter needs a size")
    return size


def _matrix(rows: Sequence[Sum], count: int) -> tuple[np.ndarray | None, np.ndarray | None]:
    rows = [row for row in rows if row.terms]
    if not rows:
        return None, None
    matrix, right = np.zeros((len(rows), count)), np.zeros(len(rows))
    for number, row in enumerate(rows):
        right[number] = -row.constant
        for variable, weight in row.terms.items():
            matrix[number, variable] = weight
    return matrix, right


def price(task: Task, columns: Sequence[Column]) -> Price | None:
    """The least cost of a whole structure; None where no lengths keep to the tolerance."""
    program = Program(task, columns, complete=True)
    answer = program.solve_tight(program.cost)
    if answer is None:
        return None
    cost, values = answer
    lengths = {name: float(value) for name, value in zip(program.names, values, strict=True)}
    omega = sum(one.at(values) for one in program.omegas)
    return Price(cost, omega, program.total.at(values), lengths)


def lower_bound(task: Task, columns: Sequence[Column]) -> tuple[float, float | None] | None:
    """What the first columns of a structure cost at least, with the overshoot that what is left of the rows forces.

    Also their width where it does not depend on any free length, else None. None altogether where they break the
    tolerance.
    """
    program = Program(task, columns, complete=False)
    answer = program.solve(program.cost)
    if answer is None:
        return None
    return answer[0], None if program.names else program.total.constant


def positive(task: Task, columns: Sequence[Column], cost: float) -> bool:
    """Whether a structure reaches `cost` with every piece, and every unsized letter, longer than nothing."""
    program = Program(task, columns, complete=True)
    if not program.pieces:
        return True
    least = program.variable(("least",), 0.0, 1.0)
    rows = [least.add(piece, -1.0) for piece in program.pieces]
    rows.append(program.cost.add(Sum(cost + 10 * SLACK), -1.0))
    answer = program.solve_tight(Sum().add(least, -1.0), rows)
    return answer is not None and -answer[0] > STRICT
