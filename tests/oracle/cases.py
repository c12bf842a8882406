"""Small random inputs of `align`, made to have ties, exact fits, equal rows and every qualifier."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol, TypeVar

from facade_nb.solver.model.letters import Letter

from .pricing import DEFAULT, PAPER, Weights

__all__ = ["Case", "Pick", "make_case"]

T = TypeVar("T")


class Pick(Protocol):
    """Choose one of several: `random.Random(n).choice`, or hypothesis."""

    def __call__(self, options: Sequence[T], /) -> T: ...


@dataclass(frozen=True, slots=True)
class Case:
    """What `align` is given."""

    rows: tuple[tuple[Letter, ...], ...]
    canvas: float
    tolerance: float
    weights: Weights
    cuts: bool

    def __str__(self) -> str:
        lines = []
        for row in self.rows:
            words = []
            for letter in row:
                marks = "t" * letter.transparent + "n" * (not letter.opaque and not letter.transparent)
                marks += "a" * letter.attached + "u" * letter.unoccludable
                words.append(f"{letter.symbol}{letter.size}{marks}")
            lines.append("[" + " ".join(words) + "]")
        goal = "paper" if self.weights.paper else f"{self.weights}"
        return f"{' '.join(lines)} canvas={self.canvas} tolerance={self.tolerance} cuts={self.cuts} {goal}"


LONGEST = {1: 5, 2: 5, 3: 4, 4: 3}
CUT_LETTERS = 7
"""Letters of the distinct words with something to cut: the oracle needs minutes for many more."""


def make_case(pick: Pick, unsized: bool = False) -> Case:
    """One input; with `unsized`, some transparent symbols have no size."""
    cuts = pick([True, True, False])
    grid = pick([True, True, False])
    sizes = [0.5, 1.0, 1.0, 2.0, 2.0, 3.0] if grid else [0.37, 0.8, 1.13, 1.4, 2.26, 3.05, 0.3, 1.93]
    alphabet: list[Letter] = []
    for symbol in "ABCDE"[: pick([2, 3, 4, 5])]:
        opaque = pick([True] * 6 + [False])
        attached, unoccludable = pick([False] * 5 + [True]), pick([False] * 5 + [True])
        alphabet.append(Letter(symbol, pick(sizes), False, opaque, attached, unoccludable))
    number = pick([1, 2, 2, 2, 3, 3, 4])
    rows: list[tuple[Letter, ...]] = []
    wall = pick([True, True, True, False])  # a last row that is solid and opaque, behind which nothing gapes
    for place in range(number):
        behind = wall and place == number - 1
        if rows and not behind and pick([False] * 4 + [True]):
            rows.append(pick(rows))
            continue
        row: list[Letter] = []
        shortest = pick([0] + [1] * 9) if number > 1 else 1
        for _ in range(pick(range(shortest, LONGEST[number] + 1))):
            letter = pick(alphabet)
            if behind:
                letter = replace(letter, opaque=True)
            elif pick([False, False, True]):
                letter = replace(letter, transparent=True, opaque=False, symbol=letter.symbol.lower())
                if unsized and letter.symbol in "ab" and (not row or row[-1].symbol != letter.symbol):
                    letter = replace(letter, size=None)
            row.append(letter)
        rows.append(tuple(row))
    if cuts and any(letter.transparent for row in rows for letter in row):
        while sum(map(len, set(rows))) > CUT_LETTERS:
            longest = max(rows, key=len)
            rows = [row[:-1] if row == longest else row for row in rows]
    totals = [sum(letter.size or 0.0 for letter in row) for row in rows]
    canvas = max(1.0, pick([*[max(totals)] * 5, min(totals), sum(totals) / 2, max(totals) + pick(sizes)]))
    canvas = round(canvas + pick([0.0, 0.0, 0.0, 0.25, -0.3]), 3)
    tolerance = round(pick([0.0, 0.1, 0.5, 1.0, canvas / 4, *[canvas / 2] * 4]), 3)
    weights = pick([PAPER, DEFAULT, DEFAULT, Weights(1.5, 0.1, 0.6), Weights(0.05, 1.0, 0.0)])
    return Case(tuple(rows), canvas, tolerance, weights, cuts)
