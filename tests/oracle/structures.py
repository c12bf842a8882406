"""Every way to cut rows into columns, from the words of docs/problem.md alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

from facade_nb.solver.model.letters import Letter

__all__ = [
    "EMPTY",
    "Bit",
    "Column",
    "Element",
    "Group",
    "State",
    "column_faults",
    "enumerate_structures",
    "finished",
    "moves",
    "next_columns",
    "pair_faults",
]


@dataclass(frozen=True, slots=True)
class Bit:
    """A letter of a word, or a piece of it: whether the letter starts and whether it ends in this column."""

    index: int
    starts: bool
    ends: bool

    @property
    def whole(self) -> bool:
        """Not a piece."""
        return self.starts and self.ends


Element = tuple[Bit, ...]
Column = tuple[Element, ...]
"""One element for each distinct word of the group."""
State = tuple[int, bool]
"""The letter a word goes on with, and whether a piece of it stands already."""
EMPTY: Element = ()


@dataclass(frozen=True, slots=True)
class Group:
    """Rows, topmost first, and the distinct words among them: rows with the same word are cut alike."""

    rows: tuple[tuple[Letter, ...], ...]
    words: tuple[tuple[Letter, ...], ...]
    word_of: tuple[int, ...]

    @classmethod
    def of(cls, rows: Sequence[Sequence[Letter]]) -> Group:
        """The group of these rows."""
        tuples = tuple(tuple(row) for row in rows)
        words = tuple(dict.fromkeys(tuples))
        return cls(tuples, words, tuple(words.index(row) for row in tuples))

    @property
    def any_opaque(self) -> bool:
        """C1 is waived where this is false."""
        return any(letter.opaque for word in self.words for letter in word)

    @property
    def share(self) -> float:
        """Shares of the rows that have one word, summed: 1 / (distinct words)."""
        return 1.0 / len(self.words)

    def letters(self, word: int, element: Element) -> tuple[Letter, ...]:
        """The letters that an element of a word consists of."""
        return tuple(self.words[word][bit.index] for bit in element)


def moves(word: Sequence[Letter], state: State, cuts: bool) -> Iterator[tuple[Element, State]]:
    """Every element that the word can put into the next column, the empty one first (C2 holds in each)."""
    yield EMPTY, state
    first, begun = state
    element: Element = ()
    for index in range(first, len(word)):
        if word[index].transparent != word[first].transparent:
            return
        starts = index > first or not begun
        yield (*element, Bit(index, starts, True)), (index + 1, False)
        if cuts and word[index].transparent:
            yield (*element, Bit(index, starts, False)), (index, True)
        element = (*element, Bit(index, starts, True))


def column_faults(group: Group, column: Column) -> set[str]:
    """Which of C1 and C3 a column breaks, looking at each row."""
    cells = [group.letters(word, column[word]) for word in group.word_of]
    needs_cover = any(not cell for cell in cells) or any(
        not letter.transparent and not letter.opaque for cell in cells for letter in cell
    )
    covered = any(cell and all(letter.opaque for letter in cell) for cell in cells)
    faults = {"C1"} if needs_cover and not covered and group.any_opaque else set()
    for row, cell in enumerate(cells):
        if any(letter.unoccludable and not letter.transparent for letter in cell):
            above = [letter for other in cells[:row] for letter in other]
            if any(not letter.transparent and not letter.opaque for letter in above):
                faults.add("C3")
    return faults


def pair_faults(group: Group, left: Column, right: Column) -> set[str]:
    """C4, or that no letter ends in the left column or starts in the right one, where they meet."""
    faults: set[str] = set()
    if not any((a and a[-1].ends) or (b and b[0].starts) for a, b in zip(left, right, strict=True)):
        faults.add("letter boundary")
    for word, (a, b) in enumerate(zip(left, right, strict=True)):
        if a and not b:
            letter = group.words[word][a[-1].index]
        elif b and not a:
            letter = group.words[word][b[0].index]
        else:
            continue
        if letter.attached and not letter.transparent:
            faults.add("C4")
    return faults


def next_columns(
    group: Group, states: tuple[State, ...], last: Column | None, cuts: bool
) -> Iterator[tuple[Column, tuple[State, ...]]]:
    """Every column that may follow the column `last`, with the states after it."""
    options = [list(moves(word, state, cuts)) for word, state in zip(group.words, states, strict=True)]
    for combination in product(*options):
        column = tuple(element for element, _ in combination)
        if not any(column) or column_faults(group, column):
            continue
        if last is None or not pair_faults(group, last, column):
            yield column, tuple(state for _, state in combination)


def finished(group: Group, states: tuple[State, ...]) -> bool:
    """All words are used up."""
    return all(state == (len(word), False) for word, state in zip(group.words, states, strict=True))


def enumerate_structures(rows: Sequence[Sequence[Letter]], cuts: bool) -> Iterator[tuple[Column, ...]]:
    """Every sequence of columns that docs/problem.md allows, whatever it costs. Only for very small rows."""
    group = Group.of(rows)

    def extend(columns: tuple[Column, ...], states: tuple[State, ...]) -> Iterator[tuple[Column, ...]]:
        if finished(group, states):
            yield columns
            return
        last = columns[-1] if columns else None
        for column, after in next_columns(group, states, last, cuts):
            yield from extend((*columns, column), after)

    yield from extend((), tuple((0, False) for _ in group.words))
