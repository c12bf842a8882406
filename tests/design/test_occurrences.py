"""Which place of a pattern's text each letter of a word comes from."""

from __future__ import annotations

import pytest

from facade_nb.design import parse
from facade_nb.design.occurrences import occurrences
from facade_nb.design.pattern import Glyph


def written(word: tuple[Glyph, ...]) -> list[tuple[str, bool, bool]]:
    return [(glyph.symbol, glyph.mirrored, glyph.origin is not None) for glyph in word]


@pytest.mark.parametrize(
    ("text", "counters", "places"),
    [
        ("A(BA)^k", {"k": 2}, (0, 2, 3, 2, 3)),
        ("A(BA)^k", {"k": 0}, (0,)),
        ("yBmAm^-1By; m := (AB)^k", {"k": 1}, (0, 1, 18, 19, 3, 19, 18, 8, 9)),
        ("(EkG)^~2", {}, (1, 2, 3, 3, 2, 1, 1, 2, 3, 3, 2, 1)),
        ("(EkG)^@2", {}, (1, 2, 3, 2, 1, 2, 3, 2, 1)),
        ("c e c\nc := <front door>", {}, (11, 2, 11)),
        ("(AB)^-1", {}, (2, 1)),
    ],
)
def test_each_letter_knows_its_place(text: str, counters: dict[str, int], places: tuple[int, ...]) -> None:
    pattern = parse(text)
    (word,) = pattern.words(counters)
    assert occurrences(pattern, counters, written(word)) == places
    for glyph, place in zip(word, places, strict=True):
        assert text[place:].lstrip("<").startswith(glyph.symbol)


def test_equal_symbols_in_other_alternatives_are_told_apart() -> None:
    pattern = parse("A(BC|CB)A")
    first, second = pattern.words({})
    assert occurrences(pattern, {}, written(first)) == (0, 2, 3, 8)
    assert occurrences(pattern, {}, written(second)) == (0, 5, 6, 8)


def test_texts_that_mean_the_same_have_their_own_places() -> None:
    for text, places in (("AB", (0, 1)), ("A  B", (0, 3)), ("AB", (0, 1))):
        pattern = parse(text)
        assert occurrences(pattern, {}, [("A", False, False), ("B", False, False)]) == places


def test_a_word_that_the_pattern_does_not_write_has_no_places() -> None:
    pattern = parse("A(BA)^k")
    assert occurrences(pattern, {"k": 1}, [("A", False, False)]) is None
    assert occurrences(pattern, {}, [("A", False, False)]) is None
    many = parse("(A|B)" * 10)
    assert occurrences(many, {}, [("A", False, False)] * 10) is None
