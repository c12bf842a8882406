"""The least J of a small design by exhaustive search, and whether a structure can be sized (docs/problem.md).

Patterns and their words are the package's (`facade_nb.design`, tested on its own); which words make a candidate, what
a candidate costs, and which sizes an alignment allows are worked out here from docs/problem.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product
from math import inf

import numpy as np
from scipy.optimize import linprog

from facade_nb.design import Design, Glyph, Pattern
from facade_nb.design.model import Axis
from facade_nb.solver.model.layout import AxisLayout, GroupLayout, PlacedLetter
from facade_nb.solver.model.letters import Letter

from .alignment import Best, TooBig, best
from .pricing import DEFAULT, SLACK, TIE, Price, Task, price
from .structures import Bit, Column, Element, Group, enumerate_structures

__all__ = [
    "Answer",
    "Choice",
    "aligned_words",
    "choices",
    "counters_of",
    "group_rows",
    "least_of_both",
    "price_of_layout",
    "sizable",
    "solve_axis",
    "structure_of",
]

LEAST = 0.5
"""The share of the canvas that tolerance is at most: the last of the default tolerances."""
STRUCTURES = 4000
"""How many structures of a group are looked at where the best one cannot be sized."""

Rows = tuple[tuple[Letter, ...], ...]
_Word = tuple[Letter, ...]


@dataclass(frozen=True, slots=True)
class Choice:
    """A candidate: a word for each pattern under one value of each counter."""

    words: Mapping[str, _Word]
    counters: Mapping[str, int]


@dataclass(frozen=True, slots=True)
class Answer:
    """What exhaustive search knows of an axis.

    Attributes
    ----------
    counters
        The counters in use.
    costs
        Least J of the candidates that can be aligned and sized, by the values of the counters.
    """

    counters: tuple[str, ...]
    costs: Mapping[tuple[int, ...], float]

    @property
    def least(self) -> float:
        """Over all values of the counters; infinite: there is no layout."""
        return min(self.costs.values(), default=inf)

    def of(self, values: Mapping[str, int]) -> float:
        """The least J for these values."""
        return self.costs[tuple(values[name] for name in self.counters)]


def least_of_both(answers: Mapping[Axis, Answer]) -> float:
    """The least J of both axes together, the counters that stand on both having one value."""
    x, y = answers["x"], answers["y"]
    tied = [name for name in x.counters if name in y.counters]

    def by_tied(answer: Answer) -> dict[tuple[int, ...], float]:
        least: dict[tuple[int, ...], float] = {}
        for values, cost in answer.costs.items():
            key = tuple(dict(zip(answer.counters, values, strict=True))[name] for name in tied)
            least[key] = min(cost, least.get(key, inf))
        return least

    across, up = by_tied(x), by_tied(y)
    return min((across[key] + up[key] for key in across.keys() & up.keys()), default=inf)


def _letter(design: Design, glyph: Glyph) -> Letter:
    own = design.symbol(glyph.symbol)
    clear = glyph.transparent or own.transparent
    return Letter(
        glyph.symbol,
        own.size,
        transparent=clear,
        opaque=own.opaque and not clear,
        attached=own.attached,
        unoccludable=own.unoccludable,
        mirrored=glyph.mirrored,
        origin=glyph.origin,
    )


def group_rows(design: Design, axis: Axis) -> dict[str, list[tuple[str, str]]]:
    """Layer and pattern of each row, topmost first, by group."""
    groups: dict[str, list[tuple[str, str]]] = {}
    for layer in design.stack:
        own = layer.along(axis)
        groups.setdefault(own.group, []).append((layer.name, own.pattern))
    return groups


def counters_of(design: Design, axis: Axis) -> tuple[str, ...]:
    """Counters in use on an axis."""
    rows = (row for own in group_rows(design, axis).values() for row in own)
    return tuple(dict.fromkeys(c for _, name in rows for c in design.patterns[name].parsed.counters))


def _size(word: Sequence[Letter]) -> float:
    return sum(letter.size or 0.0 for letter in word)


def _values(design: Design, name: str, limit: float) -> Sequence[int]:
    """Every value that could matter: beyond it, words of letters no smaller than the smallest are too long."""
    counter = design.counter(name)
    if counter.value is not None:
        return [counter.value]
    smallest = min(symbol.size for symbol in design.symbols.values() if symbol.size is not None)
    most = int(limit / smallest) + 1
    return range(max(counter.min, -most), (most if counter.max is None else min(counter.max, most)) + 1)


def choices(design: Design, axis: Axis, tolerance: float) -> Iterator[Choice]:
    """Every candidate: all values of all counters, all words of all patterns that keep Eq. 7."""
    groups = group_rows(design, axis)
    used = dict.fromkeys(pattern for rows in groups.values() for _, pattern in rows)
    names = counters_of(design, axis)
    patterns: dict[str, Pattern] = {name: design.patterns[name].parsed for name in used}
    canvas = design.canvas.along(axis)
    # The words of a pattern depend on its own counters alone; they are made once for each of their values.
    known: dict[tuple[str, tuple[int, ...]], list[_Word]] = {}

    def words(name: str, values: Mapping[str, int]) -> list[_Word]:
        key = (name, tuple(values[counter] for counter in patterns[name].counters))
        if key not in known:
            made = [tuple(_letter(design, g) for g in word) for word in patterns[name].words(values)]
            known[key] = [word for word in made if _size(word) <= canvas + tolerance + SLACK]
        return known[key]

    for combination in product(*(_values(design, name, canvas + tolerance) for name in names)):
        values = dict(zip(names, combination, strict=True))
        for chosen in product(*(words(name, values) for name in patterns)):
            choice = Choice(dict(zip(patterns, chosen, strict=True)), values)
            if all(
                _fits(choice, [pattern for _, pattern in rows], canvas, tolerance) for rows in groups.values()
            ):
                yield choice


def _fits(choice: Choice, rows: Sequence[str], canvas: float, tolerance: float) -> bool:
    """Eq. 7 for each pattern of a group, at its topmost row."""
    for place, pattern in enumerate(rows):
        word = choice.words[pattern]
        if pattern in rows[:place] or any(letter.size is None for letter in word):
            continue
        above = set(rows[:place])
        room = sum(letter.size or 0.0 for name in above for letter in choice.words[name] if letter.opaque)
        if _size(word) < canvas - tolerance - room - SLACK:
            return False
    return True


def aligned_words(choice: Choice) -> dict[str, _Word]:
    """The words, in which a symbol that is substituted elsewhere and has no size has that of its content."""
    extent: dict[str, float] = {}
    for word in choice.words.values():
        for symbol in {letter.origin[0] for letter in word if letter.origin is not None}:
            first = min(letter.origin[1] for letter in word if letter.origin and letter.origin[0] == symbol)
            extent.setdefault(
                symbol, sum(letter.size or 0.0 for letter in word if letter.origin == (symbol, first))
            )
    return {
        name: tuple(
            Letter(
                a.symbol,
                extent[a.symbol],
                a.transparent,
                a.opaque,
                a.attached,
                a.unoccludable,
                a.mirrored,
                a.origin,
            )
            if a.size is None and a.symbol in extent
            else a
            for a in word
        )
        for name, word in choice.words.items()
    }


@cache
def _best(rows: Rows, canvas: float, tolerance: float, limit: int) -> Best | None:
    return best(rows, canvas, tolerance, DEFAULT, True, limit=limit)


def solve_axis(design: Design, axis: Axis, limit: int = 1500) -> Answer:
    """The least J of an axis, over all candidates.

    Unsized symbols must not be shared by groups: each group is aligned by itself.

    Raises
    ------
    TooBig
        Some group has too many partial structures, or too many structures where the best cannot be sized.
    """
    canvas = design.canvas.along(axis)
    tolerance = LEAST * canvas
    groups = group_rows(design, axis)
    costs: dict[tuple[int, ...], float] = {}
    for number, choice in enumerate(choices(design, axis, tolerance)):
        if number >= limit:
            raise TooBig(f"more than {limit} candidates")
        words = aligned_words(choice)
        rows = [tuple(words[pattern] for _, pattern in own) for own in groups.values()]
        found = [_best(own, canvas, tolerance, limit) for own in rows]
        key = tuple(choice.counters.values())
        alignable = [one for one in found if one is not None]
        if len(alignable) < len(rows):
            continue
        known = costs.get(key, inf)
        cost = sum(one.cost for one in alignable)
        if cost >= known - TIE:
            continue
        parts = [(Group.of(own), one.structure) for own, one in zip(rows, alignable, strict=True)]
        if not sizable(design, parts, canvas):
            cost = _next_best(design, rows, canvas, tolerance, known)
        costs[key] = min(known, cost)
    return Answer(counters_of(design, axis), {key: cost for key, cost in costs.items() if cost < inf})


def _next_best(design: Design, rows: Sequence[Rows], canvas: float, tolerance: float, known: float) -> float:
    """The least J of the structures that can be sized, below what is known, from the list of them all."""
    lists: list[list[tuple[float, tuple[Column, ...]]]] = []
    for own in rows:
        group = Group.of(own)
        task = Task(group, canvas, tolerance, DEFAULT, True)
        priced: list[tuple[float, tuple[Column, ...]]] = []
        for number, structure in enumerate(enumerate_structures(own, True)):
            if number >= STRUCTURES:
                raise TooBig(f"more than {STRUCTURES} structures")
            answer = price(task, structure)
            if answer is not None:
                priced.append((answer.cost, structure))
        lists.append(sorted(priced, key=lambda item: item[0]))
    combinations = sorted(product(*lists), key=lambda items: sum(cost for cost, _ in items))
    for items in combinations:
        cost = sum(cost for cost, _ in items)
        if cost >= known - TIE:
            break
        parts = [(Group.of(own), item[1]) for own, item in zip(rows, items, strict=True)]
        if sizable(design, parts, canvas):
            return cost
    return inf


def sizable(
    design: Design, parts: Sequence[tuple[Group, Sequence[Column]]], canvas: float, least: float = 1e-3
) -> bool:
    """Whether some sizes satisfy docs/problem.md, *Sizing*, for the structures of all groups together.

    A linear programme makes the least length as large as it can be; it must come out above `least`, or below it by a
    tenth: in between it is a matter of taste what is positive, and we raise `ArithmeticError`.
    """
    names: dict[object, int] = {"least": 0}
    equal: list[tuple[dict[int, float], float]] = []
    at_most: list[tuple[dict[int, float], float]] = []
    bounds: dict[int, tuple[float, float | None]] = {0: (0.0, 1.0)}

    def variable(name: object) -> int:
        return names.setdefault(name, len(names))

    def positive(name: object) -> int:
        place = variable(name)
        at_most.append(({0: 1.0, place: -1.0}, 0.0))
        return place

    def size(symbol: str) -> int:
        place = positive(("size", symbol))
        own = design.symbol(symbol)
        bounds[place] = (own.min or 0.0, own.max)
        return place

    extents: dict[object, dict[int, float]] = {}
    for g, (group, columns) in enumerate(parts):
        whole: dict[int, float] = {}
        for word, letters in enumerate(group.words):
            pieces: dict[int, dict[int, float]] = {}
            for j, column in enumerate(columns):
                element = column[word]
                width = positive(("width", g, j))
                whole[width] = 1.0
                if not element:
                    continue
                row: dict[int, float] = {width: -1.0}
                soft = any(
                    not letters[bit.index].opaque and not letters[bit.index].transparent for bit in element
                )
                if soft:
                    for side in _open_sides(design, [letters[bit.index] for bit in element]):
                        row[variable(("gap", g, word, j, side))] = 1.0
                    sides = [
                        variable(("gap", g, word, j, side))
                        for side in (0, 1)
                        if ("gap", g, word, j, side) in names
                    ]
                    if len(sides) == 2:
                        equal.append(({sides[0]: 1.0, sides[1]: -1.0}, 0.0))
                for place, bit in enumerate(element):
                    letter = letters[bit.index]
                    if bit.whole:
                        length = size(letter.symbol)
                    else:
                        length = positive(("piece", g, word, bit.index, j))
                        pieces.setdefault(bit.index, {})[length] = 1.0
                    row[length] = row.get(length, 0.0) + 1.0
                    if letter.origin is not None:
                        total = extents.setdefault((g, word, letter.origin), {})
                        total[length] = total.get(length, 0.0) + 1.0
                        # Gaps beside a content belong to its extent.
                        for side, at_edge in ((0, place == 0), (1, place == len(element) - 1)):
                            gap = names.get(("gap", g, word, j, side))
                            if at_edge and gap is not None:
                                total[gap] = total.get(gap, 0.0) + 1.0
                equal.append((row, 0.0))
            for index, total in pieces.items():
                place = size(letters[index].symbol)
                equal.append(({**total, place: total.get(place, 0.0) - 1.0}, 0.0))
        equal.append((whole, canvas))
    for (_, _, origin), total in extents.items():  # type: ignore[misc]
        place = names.get(("size", origin[0]))
        if place is not None:
            equal.append(({**total, place: total.get(place, 0.0) - 1.0}, 0.0))
    cost = np.zeros(len(names))
    cost[0] = -1.0
    answer = linprog(
        cost,
        A_ub=_dense(at_most, len(names)),
        b_ub=[right for _, right in at_most],
        A_eq=_dense(equal, len(names)),
        b_eq=[right for _, right in equal],
        bounds=[bounds.get(place, (0.0, None)) for place in range(len(names))],
        method="highs",
    )
    if answer.status == 2:
        return False
    if answer.status != 0:
        raise ArithmeticError(f"HiGHS gave up: {answer.message}")
    if 0.1 * least < -answer.fun < least:
        raise ArithmeticError(f"the least length, {-answer.fun:g}, is neither positive nor nothing")
    return bool(-answer.fun >= least)


def _open_sides(design: Design, letters: Sequence[Letter]) -> tuple[int, ...]:
    """Where a gap may open beside an element with a non-opaque letter: 0 before it, 1 behind it."""
    soft = next(letter for letter in letters if not letter.opaque)
    placement = design.symbol(soft.symbol).placement
    if placement == "center":
        return (0, 1)
    return (1,) if (placement == "left") != soft.mirrored else (0,)


def _dense(rows: Sequence[tuple[dict[int, float], float]], count: int) -> np.ndarray:
    matrix = np.zeros((len(rows), count))
    for number, (terms, _) in enumerate(rows):
        for place, factor in terms.items():
            matrix[number, place] = factor
    return matrix


def structure_of(cells: Sequence[Sequence[PlacedLetter]], sizes: Mapping[str, float]) -> tuple[Element, ...]:
    """Which letters, and pieces of letters, stand in the columns of a solved row: pieces add up to their symbol's size.

    Raises
    ------
    ValueError
        A letter, or the pieces of one, do not have the size of their symbol.
    """
    index, used = 0, 0.0
    elements: list[Element] = []
    for cell in cells:
        bits: list[Bit] = []
        for letter in cell:
            if used == 0.0:
                begins = True
            else:
                begins = False
                if bits:
                    raise ValueError(f"a piece of {letter.symbol} stands behind another letter of its column")
            used += letter.end - letter.start
            wanted = sizes[letter.symbol]
            if used > wanted + 1e-6 or (used < wanted - 1e-6 and not letter.transparent):
                raise ValueError(f"{letter.symbol} measures {used:g}, its symbol {wanted:g}")
            ends = used > wanted - 1e-6
            bits.append(Bit(index, begins, ends))
            if ends:
                index, used = index + 1, 0.0
        elements.append(tuple(bits))
    if used:
        raise ValueError("a cut letter does not end")
    return tuple(elements)


def price_of_layout(
    design: Design, axis: Axis, solved: AxisLayout, counters: Mapping[str, int]
) -> tuple[float, list[tuple[Group, tuple[Column, ...]]]]:
    """The J of the structures that a layout shows, with the sizes free again; and those structures.

    Raises
    ------
    ValueError
        The rows of the layout are no words of their patterns under its counters, or cannot be priced.
    """
    canvas = design.canvas.along(axis)
    names = {pattern for rows in group_rows(design, axis).values() for _, pattern in rows}
    possible = {
        name: [
            tuple(_letter(design, g) for g in word) for word in design.patterns[name].parsed.words(counters)
        ]
        for name in names
    }
    words: dict[str, _Word] = {}
    for own in solved.groups.values():
        for row in own.rows:
            words[row.pattern] = _word_of(own, row.columns, solved.sizes, possible[row.pattern])
    aligned = aligned_words(Choice(words, counters))
    cost = 0.0
    parts: list[tuple[Group, tuple[Column, ...]]] = []
    for own in solved.groups.values():
        group = Group.of([aligned[row.pattern] for row in own.rows])
        by_word: dict[int, tuple[Element, ...]] = {}
        for row, word in zip(own.rows, group.word_of, strict=True):
            if by_word.setdefault(word, structure_of(row.columns, solved.sizes)) != structure_of(
                row.columns, solved.sizes
            ):
                raise ValueError("rows with one word are cut in different ways")
        elements = [by_word[word] for word in range(len(group.words))]
        columns = tuple(zip(*elements, strict=True))
        answer: Price | None = price(Task(group, canvas, LEAST * canvas, DEFAULT, True), columns)
        if answer is None:
            raise ValueError("the structure breaks the tolerance")
        cost += answer.cost
        parts.append((group, columns))
    return cost, parts


def _word_of(
    group: GroupLayout,
    cells: Sequence[Sequence[PlacedLetter]],
    sizes: Mapping[str, float],
    possible: Sequence[_Word],
) -> _Word:
    placed = [letter for cell in cells for letter in cell]
    first: dict[int, PlacedLetter] = {}
    for letter, bit in zip(placed, (b for e in structure_of(cells, sizes) for b in e), strict=True):
        first.setdefault(bit.index, letter)
    spelled = [(a.symbol, a.mirrored, a.transparent) for a in first.values()]
    for word in possible:
        if [(a.symbol, a.mirrored, a.transparent) for a in word] == spelled:
            return word
    raise ValueError(f"no word of the pattern is spelled {' '.join(symbol for symbol, _, _ in spelled)}")
