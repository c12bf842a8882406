"""Whether a given alignment keeps to docs/problem.md, and what it costs: plain arithmetic on its columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, product
from typing import Protocol

from facade_nb.solver.model.letters import Letter

from .pricing import DEFAULT, Price, Weights
from .structures import Bit, Column, Element, Group, column_faults, pair_faults

__all__ = ["Aligned", "Drawn", "check", "drawn", "measure"]

NEAR = 1e-6
Cells = tuple[tuple[Letter, ...], ...]


class Aligned(Protocol):
    """What `align` returns."""

    @property
    def error(self) -> float: ...
    @property
    def cost(self) -> float: ...
    @property
    def columns(self) -> Sequence[Sequence[Sequence[Letter]]]: ...


@dataclass(frozen=True, slots=True)
class Drawn:
    """An alignment of the oracle's own, to be checked like any other."""

    error: float
    cost: float
    columns: tuple[Cells, ...]


@dataclass(frozen=True, slots=True)
class Measure:
    """Ω, J (Ω under the paper's objective) and W of an alignment, and its worst column."""

    omega: float
    cost: float
    width: float
    worst: float


def measure(group: Group, columns: Sequence[Cells], canvas: float, weights: Weights) -> Measure:
    """Ω, J and W from the sizes in the columns (docs/problem.md)."""
    rows_with = [group.word_of.count(word) for word in group.word_of]
    shares = [1.0 / len(group.words) / number for number in rows_with]
    omega = empty = loose = total = worst = 0.0
    for cells in columns:
        sizes = [sum(letter.size or 0.0 for letter in cell) for cell in cells]
        present = [row for row, cell in enumerate(cells) if cell]
        hangs = {row for row in present if any(not x.transparent and not x.opaque for x in cells[row])}
        width = max(sizes[row] for row in present)
        least = min(sizes[row] for row in present)
        if not weights.paper and set(present) - hangs:
            least = min(sizes[row] for row in present if row not in hangs)
        omega += width - least
        worst = max(worst, width - least)
        total += width
        for row, cell in enumerate(cells):
            if not cell:
                empty += width * shares[row]
            elif not cell[0].transparent:
                beside = sum(min(a.size or 0.0, b.size or 0.0) for a, b in pairwise(cell))
                loose += shares[row] * (beside + (width - sizes[row] if row in hangs else 0.0))
    cost = omega
    if not weights.paper:
        cost += weights.fit * abs(total - canvas) + weights.empty * empty + weights.loose * loose
    return Measure(omega, cost, total, worst)


def readings(
    word: Sequence[Letter], cells: Cells, cuts: bool
) -> Iterator[tuple[tuple[Element, ...], dict[str, float]]]:
    """Every way to read a row's cells as its word: elements, and the size of each unsized symbol.

    There is more than one only where pieces have no length, or sizes are free.
    """

    def same(letter: Letter, piece: Letter) -> bool:
        return replace(piece, size=letter.size) == letter

    def read(
        column: int,
        place: int,
        index: int,
        used: float | None,
        element: Element,
        done: tuple[Element, ...],
        free: dict[str, float],
    ) -> Iterator[tuple[tuple[Element, ...], dict[str, float]]]:
        # used: what pieces of letter `index` so far measure; None: it has not begun.
        if column == len(cells):
            if index == len(word) and used is None:
                yield done, free
            return
        cell = cells[column]
        if place == len(cell):
            yield from read(column + 1, 0, index, used, (), (*done, element), free)
            return
        if index == len(word):
            return
        letter, size = word[index], cell[place].size
        if size is None or not same(letter, cell[place]):
            return
        so_far = (used or 0.0) + size
        wanted = letter.size if letter.size is not None else free.get(letter.symbol, so_far)
        may_cut = cuts and letter.transparent
        if abs(so_far - wanted) <= NEAR and (used is None or may_cut):
            bit = Bit(index, used is None, True)
            found = free if letter.size is not None else {**free, letter.symbol: wanted}
            yield from read(column, place + 1, index + 1, None, (*element, bit), done, found)
        if may_cut and place == len(cell) - 1:
            bit = Bit(index, used is None, False)
            yield from read(column + 1, 0, index, so_far, (), (*done, (*element, bit)), free)

    yield from read(0, 0, 0, None, (), (), {})


def check(
    alignment: Aligned,
    rows: Sequence[Sequence[Letter]],
    canvas: float = 12.0,
    tolerance: float = 0.0,
    weights: Weights = DEFAULT,
    cuts: bool = True,
) -> list[str]:
    """Return what is wrong with an alignment, in words; nothing if it is right (though maybe not the best)."""
    group = Group.of(rows)
    columns = tuple(tuple(tuple(cell) for cell in column) for column in alignment.columns)
    if any(len(column) != len(rows) for column in columns):
        return ["a column has not one cell for each row"]
    faults: list[str] = []
    for number, column in enumerate(columns):
        if not any(column):
            faults.append(f"column {number} is empty in all rows")
        if any(len({letter.transparent for letter in cell}) > 1 for cell in column):
            faults.append(f"C2: column {number} mixes transparent and solid letters")
        if any(letter.size is None or letter.size < -NEAR for cell in column for letter in cell):
            faults.append(f"column {number} has a letter of no or negative size")
    if faults:
        return faults
    of_word: list[list[tuple[tuple[Element, ...], dict[str, float]]]] = []
    for word, letters in enumerate(group.words):
        alike = {
            tuple(column[row] for column in columns) for row, its in enumerate(group.word_of) if its == word
        }
        if len(alike) > 1:
            return [f"rows with the word {' '.join(map(str, letters))} are cut in different ways"]
        of_word.append(list(readings(letters, alike.pop(), cuts)))
        if not of_word[-1]:
            return [f"the cells of a row do not add up to its word {' '.join(map(str, letters))}"]
    broken = [_broken(group, choice) for choice in product(*of_word)]
    if all(broken):
        faults.append(f"broken: {', '.join(sorted(broken[0]))}")
    got = measure(group, columns, canvas, weights)
    if got.worst > tolerance + NEAR:
        faults.append(f"a column has error {got.worst:g} > {tolerance:g}")
    if abs(got.width - canvas) > tolerance + NEAR:
        faults.append(f"the width {got.width:g} misses the canvas {canvas:g} by more than {tolerance:g}")
    if abs(got.omega - alignment.error) > NEAR:
        faults.append(f"error is {alignment.error:g}, its columns make {got.omega:g}")
    if abs(got.cost - alignment.cost) > NEAR:
        faults.append(f"cost is {alignment.cost:g}, its columns make {got.cost:g}")
    return faults


def _broken(group: Group, choice: Sequence[tuple[tuple[Element, ...], dict[str, float]]]) -> set[str]:
    faults: set[str] = set()
    sizes: dict[str, float] = {}
    for _, free in choice:
        for symbol, size in free.items():
            if abs(sizes.setdefault(symbol, size) - size) > NEAR:
                faults.add(f"one size of {symbol}")
    columns: list[Column] = list(zip(*(elements for elements, _ in choice), strict=True))
    for column in columns:
        faults |= column_faults(group, column)
    for left, right in pairwise(columns):
        faults |= pair_faults(group, left, right)
    return faults


def drawn(group: Group, structure: Sequence[Column], answer: Price) -> Drawn:
    """A priced structure as an alignment."""
    columns: list[Cells] = []
    for number, column in enumerate(structure):
        cells: list[tuple[Letter, ...]] = []
        for word, element in enumerate(column):
            letters: list[Letter] = []
            for bit in element:
                letter = group.words[word][bit.index]
                if not bit.whole:
                    letter = replace(letter, size=answer.lengths["piece", word, bit.index, number])
                elif letter.size is None:
                    letter = replace(letter, size=answer.lengths["size", letter.symbol])
                letters.append(letter)
            cells.append(tuple(letters))
        columns.append(tuple(cells[word] for word in group.word_of))
    return Drawn(answer.omega, answer.cost, tuple(columns))
