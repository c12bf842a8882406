"""The designs that the benches make: distinct rows, consistent where they claim it, always the same."""

from __future__ import annotations

import pytest

from facade_nb import Design, gallery, solve
from facade_nb.solver.model.problem import axis_problem
from tests.bench.bench_anytime import stack
from tests.bench.bench_growth import by_counters, by_layers, by_letters
from tests.bench.designs import LARGE, words_of


def _lengths(design: Design) -> list[float]:
    """The width of each row of a design without counters."""
    rows = [design.patterns[name].parsed.words({})[0] for name in axis_problem(design, "x").groups[0][1]]
    return [sum(design.symbol(glyph.symbol).size or 0.0 for glyph in row) for row in rows]


@pytest.mark.parametrize("layers", [2, 12, 40])
def test_layers_are_distinct_and_consistent(layers: int) -> None:
    design = by_layers(layers)
    words = {design.patterns[layer.x.pattern].text for layer in design.layers}
    assert len(words) == len(design.layers) == layers
    assert _lengths(design) == pytest.approx([design.canvas.width] * layers)


@pytest.mark.parametrize("letters", [5, 40, 200])
def test_letters_are_as_many_as_asked_for(letters: int) -> None:
    design = by_letters(letters)
    longest = max(len(pattern.parsed.words({})[0]) for pattern in design.patterns.values())
    assert letters - 2 < longest <= letters
    assert _lengths(design) == pytest.approx([design.canvas.width] * len(design.layers))


@pytest.mark.parametrize("counters", [1, 8])
def test_counters_are_unbounded_and_fit_exactly_at_two(counters: int) -> None:
    design = by_counters(counters)
    names = {c for pattern in design.patterns.values() for c in pattern.parsed.counters}
    assert len(names) == counters and not design.counters
    for name in axis_problem(design, "x").groups[0][1]:
        (word,) = design.patterns[name].parsed.words(dict.fromkeys(names, 2))
        assert sum(design.symbol(g.symbol).size or 0.0 for g in word) == pytest.approx(design.canvas.width)


def test_stacks_do_not_agree_and_come_back_the_same() -> None:
    design = stack(8, 1)
    assert design == stack(8, 1) != stack(8, 2)
    assert len({round(length, 6) for length in _lengths(design)}) > 4


def test_the_words_of_an_answer_are_its_rows() -> None:
    layout = solve(gallery.load("apartment-house"))
    words = {w.name: w for w in words_of(gallery.load("apartment-house"), layout.counters)}
    assert words.keys() == {"x 1", "y 1"}  # the groups with more than one distinct word
    rows = [row.columns for row in layout.x.groups["1"].rows]
    for word, columns in zip(words["x 1"].rows, rows, strict=True):
        placed = dict.fromkeys(letter.symbol for column in columns for letter in column)
        assert dict.fromkeys(letter.symbol for letter in word) == placed


def test_the_large_designs_are_of_the_paper_s_sizes() -> None:
    layers = {name: len(gallery.load(name).layers) for name in LARGE}
    assert layers == {
        "terraced-house": 8, "teaser": 5, "bookshop": 12, "apartment-house": 4, "concert-hall": 26,
    }  # fmt: skip
