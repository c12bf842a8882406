"""How words are measured, counted and chosen before they are spelled out; and that none is lost that matters."""

from __future__ import annotations

import random
from importlib import import_module
from itertools import product
from math import inf
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb.design import Counter, DesignError, Pattern, Symbol, parse
from facade_nb.design.model import AXES
from facade_nb.design.pattern import Concat, Count, Sym
from facade_nb.solver import Objective, tuning
from facade_nb.solver.cache import CACHE
from facade_nb.solver.candidates.stream import candidates
from facade_nb.solver.model.problem import axis_problem
from facade_nb.solver.words import instances as listing
from facade_nb.solver.words.counter_values import Sums
from facade_nb.solver.words.enumeration import axis_words
from facade_nb.solver.words.instances import instances, next_longer, ranges
from facade_nb.solver.words.lengths import measure
from tests.oracle.designs import make_design
from tests.oracle.nasty import NASTY

words: Any = import_module("facade_nb.solver.words.enumeration").words

SIZES = {"A": 1.0, "B": 0.7, "C": 0.35}
TEXTS = [
    "A^k", "A(BA)^k C", "(AB)^-k", "(ABC)^~k B^l", "(ABC)^|k", "(ABC)^.k", "(ABC)^:k A", "(ABC)^@k", "A^@k",
    "(AB)^@l A^k", "((AB)^k)'", "(A^k B)^3", "(A^k B)^~2", "(A|BC)^k", "A^k|B^l", "(A|ε)B^k(C|BB)", "e m f; m := A^k B",
    "m^k n; m := AB; n := C|A^2",
    "m e m'; m := (AB)^:k", "(m e)^2; m := A^l", "A ε^k", "e^k m; m := A", "u m^@k; m := ABC",
]  # fmt: skip


def size(symbol: str) -> float | None:
    return SIZES.get(symbol)


def symbol(name: str) -> Symbol:
    return Symbol(name, SIZES.get(name))


class TestMeasures:
    @pytest.mark.parametrize("text", TEXTS)
    def test_as_long_as_the_words_themselves(self, text: str) -> None:
        pattern = parse(text)
        ways = measure(pattern, size)
        assert ways is not None
        for values in product(range(-3, 5), repeat=len(pattern.counters)):
            at = dict(zip(pattern.counters, values, strict=True))
            spelled = [tuple(way.pattern.spell(at)) for way in ways]
            for way, word in zip(ways, spelled, strict=True):
                assert way.measure.at(at) == pytest.approx(sum(SIZES.get(s, 0.0) for s, *_ in word))
                growth = way.measure.growth
                assert way.measure.letters + sum(g.length(at[c]) for c, g in growth.items()) == len(word)
                assert way.measure.open or all(s in SIZES for s, *_ in word)
            # and together they are the words of the pattern, in its order
            listed = [
                tuple((g.symbol, g.mirrored, g.transparent, g.origin) for g in w) for w in pattern.words(at)
            ]
            assert list(dict.fromkeys(tuple(f[:3] for f in w) for w in spelled)) == [
                tuple(f[:3] for f in w) for w in listed
            ]
            assert {tuple(w) for w in listed} <= set(spelled)

    @pytest.mark.parametrize("text", ["(A^k B)^.2", "(B A^k)^:2", "(A^k B^l)^@3"])
    def test_not_where_a_counter_says_which_letter_is_shared(self, text: str) -> None:
        assert measure(parse(text), size) is None
        found = instances(parse(text), symbol, Counter, 5.0)
        for word in found.words:
            assert word.size <= 5.0 + 1e-9
        expected = {
            (values, tuple(glyphs))
            for values in product(range(8), repeat=len(parse(text).counters))
            for glyphs in parse(text).words(dict(zip(parse(text).counters, values, strict=True)))
            if sum(SIZES[g.symbol] for g in glyphs) <= 5.0 + 1e-9
        }
        assert len(found.words) == len(expected)


tables = st.lists(
    st.lists(st.sampled_from([0.0, 0.3, 0.35, 0.9, 1.0, 1.1, 2.5]), min_size=1, max_size=6, unique=True),
    min_size=1,
    max_size=4,
)


class TestSums:
    @staticmethod
    def brute(given: list[list[float]]) -> list[float]:
        return [sum(own) for own in product(*given)]

    @pytest.fixture(params=[0, 10**9], ids=["grid", "few"], autouse=True)
    def few(self, request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
        """With and without knowing dead ends."""
        monkeypatch.setattr(tuning, "SUM_FEW", request.param)

    @settings(max_examples=60, deadline=None)
    @given(tables, st.floats(0.0, 4.0), st.floats(0.0, 2.0))
    def test_between_two_sizes(self, own: list[list[float]], low: float, width: float) -> None:
        sums = Sums({f"n{i}": list(enumerate(t)) for i, t in enumerate(own)}, 10.0)
        found, complete = sums.within(low, low + width)
        assert complete
        wanted = sorted(s for s in self.brute(own) if low - 1e-9 <= s <= low + width + 1e-9)
        assert sorted(s for s, _ in found) == pytest.approx(wanted)
        for total, values in found:
            assert total == pytest.approx(sum(t[values[f"n{i}"]] for i, t in enumerate(own)))

    @settings(max_examples=80, deadline=None)
    @given(tables, st.floats(0.5, 6.0), st.integers(1, 12))
    def test_the_nearest(self, own: list[list[float]], canvas: float, most: int) -> None:
        """What is left out is no nearer than is said."""
        sums = Sums({f"n{i}": list(enumerate(t)) for i, t in enumerate(own)}, 10.0)
        found, left = sums.nearest(canvas, -inf, most)
        rest = self.brute(own)
        for total, _ in found:
            rest.remove(min(rest, key=lambda s: abs(s - total)))
        assert all(abs(s - canvas) >= left - 1e-6 for s in rest if s <= 10.0)
        assert len(found) <= max(most, 4 * most)
        assert found

    def test_some_of_too_many(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """A hundred thousand ways to make 30 m: those taken differ in all counters, and are the same every time."""
        monkeypatch.setattr(tuning, "SUM_FEW", 0)
        own = {name: [(n, n * 0.5) for n in range(60)] for name in "abcd"}
        sums = Sums(own, 45.0)
        found, left = sums.nearest(30.0, 15.0, 200)
        assert left == 0.0 and 100 <= len(found) <= 200
        assert all(abs(total - 30.0) <= 0.5 for total, _ in found)
        for name in "abc":
            assert len({values[name] for _, values in found}) > 20
        assert found == Sums(own, 45.0).nearest(30.0, 15.0, 200)[0]


class TestInstances:
    def test_those_nearest_to_the_canvas_are_kept(self, monkeypatch: pytest.MonkeyPatch) -> None:
        pattern = parse("A^k B^l C^m")
        every = instances(pattern, symbol, Counter, 12.0)
        assert every.left == inf
        monkeypatch.setattr(tuning, "MAX_WORDS", 50)
        few = instances(pattern, symbol, Counter, 12.0, canvas=8.0)
        assert 12 <= len(few.words) <= 50 < len(every.words)
        kept = {tuple(w.counters.values()) for w in few.words}
        assert kept <= {tuple(w.counters.values()) for w in every.words}
        assert few.left < inf
        for word in every.words:
            assert tuple(word.counters.values()) in kept or abs(word.size - 8.0) >= few.left - 1e-6
        order = [tuple(w.counters.values()) for w in few.words]
        assert order == sorted(order)

    def test_letters_are_bounded(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(tuning, "MAX_LETTERS_IN_ALL", 100)
        found = instances(parse("A^k"), symbol, Counter, 30.0, canvas=20.0)
        assert [len(w) for w in found.words] == [18, 19, 20, 21, 22] and found.left == pytest.approx(3.0)

    def test_words_of_too_many_letters_are_left_out(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(listing, "MAX_SPELLED", 10)
        found = instances(parse("A^k"), symbol, Counter, 30.0, canvas=20.0)
        assert max(map(len, found.words)) == 10 and found.clipped == ("k",)
        found = instances(parse("A^k B^l"), symbol, Counter, 30.0, canvas=20.0)
        assert max(map(len, found.words)) == 10 and found.clipped == ("k", "l")

    def test_only_those_that_are_long_enough(self) -> None:
        found = instances(parse("A^k"), symbol, Counter, 8.0, low=5.0)
        assert [w.size for w in found.words] == [5.0, 6.0, 7.0, 8.0]
        found = instances(parse("e m; m := A^k"), symbol, Counter, 8.0, low=5.0)
        assert len(found.words) == 9  # the unsized letter takes what is left

    def test_only_values_that_others_have(self) -> None:
        found = instances(parse("A^k"), symbol, Counter, 8.0, common={"k": (3, 5)})
        assert [w.counters["k"] for w in found.words] == [3, 4, 5]
        found = instances(parse("A^k|B"), symbol, Counter, 8.0, common={"k": (0, 40)})
        assert max(w.counters["k"] for w in found.words if w.size == 0.7) == 40

    def test_ranges(self) -> None:
        assert ranges(parse("A^k B^l"), symbol, Counter, 3.0) == {"k": (0, 3), "l": (0, 4)}
        assert ranges(parse("A^k|B"), symbol, Counter, 3.0) == {}
        assert ranges(parse("e^k m; m := A^l"), symbol, Counter, 3.0) == {"l": (0, 3)}
        bounded = ranges(parse("A^k"), symbol, lambda name: Counter(name, -2, 9), 3.0)
        assert bounded == {"k": (-2, 3)}


class TestNextLonger:
    """The shortest word beyond a limit, against all words."""

    @pytest.mark.parametrize(
        "text",
        [
            "A^k",
            "(AB)^k",
            "(ABA)^@k",
            "A^kB^m",
            "A(BC)^kB^m",
            "A^k|B^m",
            "B|AC|ABC",
            "C(A|B)^kA^m",
            "x m; m := (BC)^k|A",
            "(A^k)^.2B",
        ],
    )
    @pytest.mark.parametrize("bounds", [(0, None), (-2, 1), (1, 3), (2, 2)])
    def test_it_is_the_next_of_all(self, text: str, bounds: tuple[int, int | None]) -> None:
        sizes = {"A": 1.0, "B": 1.7, "C": 3.1}

        def symbol(name: str) -> Symbol:
            return Symbol(name, sizes.get(name))

        def counter(name: str) -> Counter:
            return Counter(name, *bounds)

        pattern = parse(text)
        low, high = bounds[0], 14 if bounds[1] is None else bounds[1]
        lengths = {
            round(sum(sizes.get(g.symbol, 0.0) for g in word), 9)
            for values in product(range(low, high + 1), repeat=len(pattern.counters))
            for word in pattern.words(dict(zip(pattern.counters, values, strict=True)))
        }
        for limit in (0.5, 2.05, 4.0, 7.3):
            beyond = sorted(own for own in lengths if own > limit + 1e-6)
            word, more = next_longer(pattern, symbol, counter, limit, limit)
            assert (None if word is None else round(word.size, 9)) == (beyond[0] if beyond else None)
            assert more == (len(beyond) > 1)


class TestOfAnAxis:
    @pytest.mark.parametrize("seed", range(40))
    def test_no_candidate_is_lost(self, seed: int) -> None:
        """What other patterns say of counters, and Eq. 7, only leave out words that make no candidate."""
        one = make_design(seed)
        for axis in AXES:
            problem = axis_problem(one, axis)
            tolerance = random.Random(seed).choice([0.1, 0.5]) * problem.canvas
            symbols, counters = problem.symbol, dict(problem.counters)
            every = {
                name: instances(
                    p, symbols.__getitem__, counters.__getitem__, problem.canvas + tolerance
                ).words
                for name, p in problem.patterns
            }
            CACHE.clear()
            few = {name: own.words for name, own in axis_words(problem, tolerance).items()}
            assert all(len(few[name]) <= len(every[name]) for name in few)

            def shown(chosen: Any) -> list[tuple[str, ...]]:
                found = candidates(problem, chosen, tolerance, Objective())  # noqa: B023
                return [(str(sorted(c.counters.items())), *(str(w) for w in c.words.values())) for c in found]

            assert shown(few) == shown(every)

    def test_a_word_of_too_many_letters_has_a_place(self) -> None:
        one = make_design(0)
        problem = axis_problem(one, "x")
        name, _ = problem.patterns[0]
        half = Count(Sym("A"), "", False, 15_000)
        long = Pattern(Concat((half, half)))  # no text is read as such a pattern
        patterns = tuple((n, long if n == name else p) for n, p in problem.patterns)
        symbols = tuple({**dict(problem.symbols), "A": Symbol("A", 0.1)}.items())
        broken = type(problem)(
            problem.axis, problem.canvas, problem.groups, patterns, symbols, problem.counters
        )
        with pytest.raises(DesignError, match=f"patterns.{name}: a word would have 30,000 letters"):
            axis_words(broken, 1.0)

    @pytest.mark.parametrize(
        "name", ["1000 m, three counters", "six patterns of six counters", "alternatives and a counter"]
    )
    def test_of_what_nobody_could_list(self, name: str) -> None:
        problem = axis_problem(NASTY[name], "x")
        CACHE.clear()
        for own in axis_words(problem, 0.5 * problem.canvas).values():
            assert own.words and own.left < inf
            assert sum(map(len, own.words)) <= 400_000

    def test_every_word_on_a_large_canvas(self) -> None:
        """Not so for `words`, which lists all there are."""
        found = words("A^k B^l", {"A": 1.0, "B": 0.9}, 300.0, 0.5)
        wanted = [
            (k, n) for k in range(302) for n in range(336) if 299.5 - 1e-9 <= k + 0.9 * n <= 300.5 + 1e-9
        ]
        assert [(w.counters["k"], w.counters["l"]) for w in found] == wanted
