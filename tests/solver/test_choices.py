"""The words that a pattern can make, with those beside them; and what a layout tells of its words and its J."""

from __future__ import annotations

import pytest

from facade_nb import gallery, solve
from facade_nb.design import Design
from facade_nb.design.edit import with_counter, with_pattern
from facade_nb.design.model import AXES
from facade_nb.solver import Layout
from facade_nb.solver.cache import CACHE
from facade_nb.solver.schedules.tolerances import TOLERANCES
from facade_nb.solver.words.neighbours import Choices, choices


def told(design: Design, pattern: str, layout: Layout | None = None, most: int = 4) -> Choices:
    found = {axis: layout.along(axis).words.get(pattern) for axis in AXES} if layout else {}
    chosen = {axis: word for axis, word in found.items() if word is not None}
    (own,) = choices(design, pattern, TOLERANCES[-1], most, chosen)
    return own


def test_words_are_kept_or_it_is_said_why_not() -> None:
    house = with_counter(gallery.load("residential-house"), "k", min=1, max=3)
    own = told(house, "Bx", solve(house))
    assert (own.axis, own.canvas, own.fits) == ("x", 6.0, 3)
    rows = [(len(one.word), one.reason, round(one.miss, 2), one.bound) for one in own.words]
    assert rows == [
        (1, "too short", 5.5, ""),
        (3, "fits", 3.8, ""),
        (5, "fits", 2.1, ""),
        (7, "fits", 0.4, ""),
        (9, "range", 1.3, "k ≤ 3"),
    ]


def test_the_last_word_that_fits_has_a_longer_one_beside_it() -> None:
    bookshop = gallery.load("bookshop")
    own = told(bookshop, "bays")
    assert own.fits > 4
    assert [one.reason for one in own.words] == ["fits"] * 4 + ["too long"]
    assert own.words[-1].word.size > own.high


def test_what_the_solve_found_is_shown_not_found_again() -> None:
    house = gallery.load("residential-house")
    layout = solve(house)
    before = CACHE.words.misses
    for pattern in house.patterns:
        own = told(house, pattern, layout, most=1)
        assert layout.along(own.axis).words[pattern] in [one.word for one in own.words]
    assert CACHE.words.misses == before


def test_a_pattern_without_a_word_that_fits_tells_the_shortest_one() -> None:
    house = with_pattern(gallery.load("residential-house"), "Bx", "A^40")
    own = told(house, "Bx")
    assert [(one.reason, own.fits) for one in own.words] == [("too long", 0)]


def test_a_pattern_that_no_visible_layer_uses_has_no_words_here() -> None:
    house = with_pattern(gallery.load("residential-house"), "spare", "AA")
    assert choices(house, "spare", 0.5, 4) == []


@pytest.mark.parametrize("name", ["residential-house", "bookshop", "apartment-house", "qualifiers-d"])
def test_the_terms_of_J_add_up_and_letters_know_their_words(name: str) -> None:
    for layout in (solve(gallery.load(name)), solve(gallery.load(name))):  # found, and known already
        for axis in AXES:
            solved = layout.along(axis)
            total = 0.0
            for group in solved.groups.values():
                terms = group.terms
                assert terms is not None
                price = terms.objective
                total += group.error + price.empty * terms.empty + price.loose * terms.loose
                total += price.fit * terms.miss
                for row in group.rows:
                    word = solved.words[row.pattern]
                    assert {one.index for one in row.letters} == set(range(len(word)))
                    assert all(one.symbol == word.letters[one.index].symbol for one in row.letters)
            assert total == pytest.approx(solved.cost, abs=1e-6)


def test_a_layout_that_was_read_has_neither() -> None:
    layout = solve(gallery.load("residential-house"))
    again = Layout.from_dict(layout.to_dict())
    assert again == layout
    assert again.x.words == {}
    assert all(group.terms is None for group in again.x.groups.values())
