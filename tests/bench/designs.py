"""What the benches of the solver are run on: designs of the paper's sizes, and the words of their answers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from facade_nb import Design, Layout, NoLayout, gallery, solve
from facade_nb.design.model import AXES, Axis
from facade_nb.solver import Letter
from facade_nb.solver.model.problem import axis_problem

__all__ = ["LARGE", "Words", "harder", "line_of", "others", "solved", "words_of"]

LARGE: Mapping[str, float] = {
    "terraced-house": 50.0,
    "teaser": 50.0,
    "bookshop": 50.0,
    "apartment-house": 50.0,
    "concert-hall": 100.0,
}
"""The designs of the paper's sizes, with the milliseconds that a cold solve may take."""


def harder() -> dict[str, Design]:
    """Three of the large designs with more wildcards: rows of transparent letters where the gallery has masks."""
    folder = Path(__file__).resolve().parent / "hard"
    return {f"{path.stem} (harder)": Design.from_json(path) for path in sorted(folder.glob("*.json"))}


def others() -> list[str]:
    """The other designs of the gallery."""
    return [name for name in gallery.names() if name not in LARGE]


def solved(design: Design, time_limit: float) -> Layout | None:
    """The layout, or None where there is none in time."""
    try:
        return solve(design, time_limit=time_limit)
    except NoLayout:
        return None


@dataclass(frozen=True, slots=True)
class Words:
    """The words of one alignment group under the counters of an answer, topmost first; distances in metres."""

    name: str
    rows: tuple[tuple[Letter, ...], ...]
    canvas: float
    tolerance: float

    @property
    def distinct(self) -> list[int]:
        """Lengths of the distinct words."""
        return [len(word) for word in dict.fromkeys(self.rows)]


def words_of(design: Design, counters: Mapping[str, int], within: float = 0.5) -> Iterator[Words]:
    """The groups of both axes that have more than one distinct word, `within` being a fraction of the canvas."""
    for axis in AXES:
        problem = axis_problem(design, axis)
        for group, patterns in problem.groups:
            rows = tuple(_word(design, pattern, counters, axis) for pattern in patterns)
            if len(set(rows)) > 1:
                name = f"{axis} {group}"
                yield Words(name, rows, problem.canvas, within * problem.canvas)


def _word(design: Design, name: str, counters: Mapping[str, int], axis: Axis) -> tuple[Letter, ...]:
    pattern = design.patterns[name].parsed
    found = pattern.words({counter: counters[counter] for counter in pattern.counters})
    if len(found) > 1:
        raise ValueError(f"{name} on {axis} has alternatives: its word is not known from its counters")
    letters = []
    for glyph in found[0]:
        symbol = design.symbol(glyph.symbol)
        letters.append(
            Letter(
                glyph.symbol,
                symbol.size,
                glyph.transparent,
                symbol.opaque,
                symbol.attached,
                symbol.unoccludable,
                glyph.mirrored,
            )
        )
    return tuple(letters)


def line_of(cells: Sequence[tuple[str, int]]) -> str:
    """A line of a table: each cell with its width, negative ones to the left."""
    return "  ".join(
        f"{text:<{-width}}" if width < 0 else f"{text:>{width}}" for text, width in cells
    ).rstrip()
