"""Words of a pattern that fit the canvas: the paper's Figure 7 and Eq. 7, counters, bounds, unsized letters."""

from __future__ import annotations

from itertools import product
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb import DesignError, solve
from facade_nb.design import PatternError, parse
from facade_nb.solver import words
from tests.oracle.designs import design

FIGURE_7: dict[str, Any] = {"canvas": 10, "tolerance": 1, "counters": {"s": (1, None), "t": (1, None)}}


class TestFigure7:
    first = words("eb^se; b := B", {"B": 3}, unsized_step=1.0, **FIGURE_7)
    second = words("A^sC^tA^s", {"A": 2, "C": 1.3}, unsized_step=1.0, **FIGURE_7)

    def test_first_pattern(self) -> None:
        found = {(str(w), w.counters["s"], w.letters[0].size, round(w.size, 9)) for w in self.first}
        assert found == {
            ("e B e", 1, 4.0, 11.0),
            ("e B e", 1, 3.0, 9.0),
            ("e B B e", 2, 2.0, 10.0),
            ("e B B B e", 3, 1.0, 11.0),
        }
        assert len(self.first) == 4

    def test_second_pattern(self) -> None:
        found = {(str(w), w.counters["s"], w.counters["t"], round(w.size, 9)) for w in self.second}
        assert found == {
            ("A C C C C C A", 1, 5, 10.5),
            ("A C C C C A", 1, 4, 9.2),
            ("A A C C A A", 2, 2, 10.6),
            ("A A C A A", 2, 1, 9.3),
        }
        assert len(self.second) == 4

    def test_six_candidates(self) -> None:
        pairs = [(a, b) for a, b in product(self.first, self.second) if a.counters["s"] == b.counters["s"]]
        assert sorted((b.counters["s"], b.counters["t"], a.letters[0].size) for a, b in pairs) == [
            (1, 4, 3.0), (1, 4, 4.0), (1, 5, 3.0), (1, 5, 4.0), (2, 1, 2.0), (2, 2, 2.0),
        ]  # fmt: skip

    def test_letters(self) -> None:
        """Placeholders are transparent and carry the sampled size; contents are solid."""
        word = next(w for w in self.first if len(w) == 4)
        assert [(a.symbol, a.size, a.transparent, a.opaque) for a in word.letters] == [
            ("e", 2.0, True, False), ("B", 3, False, True), ("B", 3, False, True), ("e", 2.0, True, False),
        ]  # fmt: skip


class TestUnsizedLetters:
    def test_without_a_step_a_word_is_listed_once(self) -> None:
        found = words("eb^se; b := B", {"B": 3}, **FIGURE_7)
        assert [(str(w), w.size) for w in found] == [("e B e", 3.0), ("e B B e", 6.0), ("e B B B e", 9.0)]
        assert all(w.letters[0].size is None for w in found)

    def test_several_symbols_are_sampled_apart(self) -> None:
        found = words("emf; m := B", {"B": 3}, canvas=6, tolerance=0, unsized_step=1.0)
        assert [(w.letters[0].size, w.letters[2].size) for w in found] == [(1.0, 2.0), (2.0, 1.0)]

    def test_one_size_for_all_letters_of_a_symbol(self) -> None:
        found = words("eme; m := B", {"B": 3}, canvas=6, tolerance=1, unsized_step=0.5)
        assert [(w.letters[0].size, w.size) for w in found] == [(1.0, 5.0), (1.5, 6.0), (2.0, 7.0)]

    def test_no_room_for_the_least_sample(self) -> None:
        assert words("eme; m := B", {"B": 3}, canvas=4, tolerance=0.5, unsized_step=1.0) == []


class TestCounters:
    def test_run_from_0_and_are_not_bounded_above(self) -> None:
        found = words("A(BA)^k", {"A": 1, "B": 0.8}, canvas=6, tolerance=6)
        assert [w.counters["k"] for w in found] == [0, 1, 2, 3, 4, 5, 6]
        assert found[0].size == 1.0 and found[-1].size == pytest.approx(11.8)

    def test_bounds(self) -> None:
        found = words("A^k", {"A": 1}, canvas=4, tolerance=4, counters={"k": (2, 5)})
        assert [w.counters["k"] for w in found] == [2, 3, 4, 5]

    def test_tolerance_is_met_exactly(self) -> None:
        assert [w.size for w in words("A^k", {"A": 0.1}, canvas=0.3, tolerance=0)] == [pytest.approx(0.3)]

    def test_negative_values_mirror(self) -> None:
        found = words("(AB)^k", {"A": 1, "B": 2}, canvas=3, tolerance=3, counters={"k": (-2, None)})
        assert [str(w) for w in found] == ["B' A' B' A'", "B' A'", "ε", "A B", "A B A B"]

    def test_only_negative_values(self) -> None:
        found = words("A^k B", {"A": 1, "B": 2}, canvas=4, tolerance=1, counters={"k": (-5, -1)})
        assert [str(w) for w in found] == ["A' A' A' B", "A' A' B", "A' B"]

    def test_several_counters_in_lexicographic_order(self) -> None:
        found = words("A^k B^l", {"A": 1, "B": 2}, canvas=4, tolerance=0)
        assert [(w.counters["k"], w.counters["l"]) for w in found] == [(0, 2), (2, 1), (4, 0)]

    def test_the_size_of_a_reflected_count(self) -> None:
        """A pivot letter is shared, so that the word is shorter than twice its base."""
        found = words("(ABC)^.k", {"A": 1, "B": 1, "C": 1}, canvas=10, tolerance=0)
        assert [str(w) for w in found] == ["A B C B' A' A B C B' A'"]

    def test_letters_without_a_size_do_not_go_on_for_ever(self) -> None:
        found = words("e^k m; m := A", {"A": 1}, canvas=1, tolerance=0)
        assert [w.counters["k"] for w in found] == list(range(len(found)))
        assert 4 <= len(found) <= 100

    def test_nor_up_to_a_bound_that_nobody_meant(self) -> None:
        found = words("e^k m; m := A", {"A": 1}, canvas=1, tolerance=0, counters={"k": (0, 10**9)})
        assert 4 <= len(found) <= 100

    def test_nor_does_the_empty_word(self) -> None:
        found = words("A ε^k", {"A": 1}, canvas=1, tolerance=0, counters={"k": (0, 10**9)})
        assert {str(w) for w in found} == {"A"}

    def test_a_design_is_told_of_endless_counters(self) -> None:
        one = design({"A": 4.0}, {"a": "e^k m; m := A", "w": "A"}, ["a", "w"])
        told = [w for w in solve(one).warnings if "'k'" in w]
        assert len(told) == 1 and "repeats nothing that has a size" in told[0]

    def test_alternatives_of_different_length(self) -> None:
        found = words("(A|BB)^k", {"A": 1, "B": 1}, canvas=4, tolerance=0)
        assert {str(w) for w in found} == {"A A A A", "B B B B"}

    def test_a_counter_of_one_alternative_is_not_endless(self) -> None:
        """That W stays as short as it is does not end the repetition beside it."""
        found = words("A(BA)^k | W", {"A": 0.1, "B": 0.1, "W": 0.3}, canvas=4.1, tolerance=0)
        assert [str(w) for w in found] == [" ".join(["A", "B"] * 20 + ["A"])]


TEXTS = st.sampled_from(
    ["A^k", "A(BA)^k", "(A|B)^k B^l", "A^k B^-l", "(AB)^~k A", "(AB)^@k B^l", "em^k; m := A|BB", "(ABA)^:k"]
)


@settings(max_examples=40)
@given(
    text=TEXTS,
    a=st.sampled_from([0.4, 1.0, 1.7]),
    b=st.sampled_from([0.5, 1.0, 2.3]),
    canvas=st.sampled_from([2.0, 3.4, 5.0]),
    tolerance=st.sampled_from([0.0, 0.5, 1.0]),
    low=st.integers(-3, 2),
)
def test_every_word_that_fits_and_no_other(
    text: str, a: float, b: float, canvas: float, tolerance: float, low: int
) -> None:
    """Against all values of the counters up to 15, which is more than fit."""
    pattern = parse(text)
    sizes = {"A": a, "B": b}
    names = pattern.counters
    bounds = dict.fromkeys(names, (low, None))
    expected = set()
    for values in product(range(low, 16), repeat=len(names)):
        counters = dict(zip(names, values, strict=True))
        for glyphs in pattern.words(counters):
            size = sum(sizes.get(g.symbol, 0.0) for g in glyphs)
            open_ended = any(g.symbol not in sizes for g in glyphs)
            if size <= canvas + tolerance + 1e-9 and (open_ended or size >= canvas - tolerance - 1e-9):
                expected.add((values, tuple((g.symbol, g.mirrored, g.transparent) for g in glyphs)))
    found = [
        (tuple(w.counters[n] for n in names), tuple((x.symbol, x.mirrored, x.transparent) for x in w.letters))
        for w in words(text, sizes, canvas, tolerance, counters=bounds)
    ]
    assert set(found) == expected
    assert len(found) == len(set(found))
    assert [values for values, _ in found] == sorted(values for values, _ in found)


class TestFaults:
    def test_a_solid_letter_without_a_size(self) -> None:
        with pytest.raises(
            DesignError, match=r"symbol 'b' stands for itself and needs a size; did you mean 'B'\?"
        ):
            words("Ab", {"A": 1, "B": 2}, canvas=4, tolerance=0)

    @pytest.mark.parametrize("value", [1e-308, 1e308, 10**400, "1", True])
    def test_numbers_beyond_what_can_be_computed(self, value: Any) -> None:
        for call in (
            lambda: words("A", {"A": value}, canvas=4, tolerance=0),
            lambda: words("A", {"A": 1}, canvas=4, tolerance=0, unsized_step=value),
        ):
            with pytest.raises(DesignError, match=r"sizes lie between 0\.000001 and 1,000,000"):
                call()
        if value != 1e-308:
            with pytest.raises(
                DesignError, match="canvas: expected metres, 0 or more, at most 1,000,000, found"
            ):
                words("A", {"A": 1}, canvas=value, tolerance=0)

    @pytest.mark.parametrize("size", [0, -1.0, float("nan"), float("inf")])
    def test_sizes_out_of_range(self, size: float) -> None:
        with pytest.raises(DesignError, match=r"sizes\.A: expected a positive size in metres, found"):
            words("A", {"A": size}, canvas=4, tolerance=0)

    def test_a_step_that_makes_millions_of_words(self) -> None:
        with pytest.raises(
            DesignError, match="unsized_step: expected a larger step: 3,000,000 samples of 'e'"
        ):
            words("e m; m := A", {"A": 1}, canvas=4, tolerance=0, unsized_step=1e-6)

    @pytest.mark.parametrize("step", [0, -0.5, float("nan"), float("inf")])
    def test_steps_out_of_range(self, step: float) -> None:
        with pytest.raises(DesignError, match="unsized_step: expected a positive length in metres"):
            words("em; m := A", {"A": 1}, canvas=4, tolerance=0, unsized_step=step)

    def test_bounds_that_contradict_each_other(self) -> None:
        with pytest.raises(DesignError, match=r"counters\.k: expected min ≤ max, found 3 and 2"):
            words("A^k", {"A": 1}, canvas=4, tolerance=0, counters={"k": (3, 2)})

    def test_all_faults_at_once(self) -> None:
        with pytest.raises(DesignError) as caught:
            words("ABC", {"A": -1}, canvas=4, tolerance=0, unsized_step=0)
        assert len(caught.value.faults) == 4

    def test_a_faulty_text(self) -> None:
        with pytest.raises(PatternError, match="line 1, column 3"):
            words("A(", {"A": 1}, canvas=4, tolerance=0)

    def test_words_too_long_to_be_meant(self) -> None:
        with pytest.raises(DesignError, match="letters; at most"):
            words("A^k", {"A": 1}, canvas=4, tolerance=0, counters={"k": (10**9, None)})
