"""Bounds: where one cuts something off, the answer says so, and what is proven no bound has touched."""

from __future__ import annotations

import functools
import warnings
from collections.abc import Iterator
from types import ModuleType

import pytest

from facade_nb import Design, Layout, NoLayout, solve
from facade_nb.design import Counter, Symbol, parse
from facade_nb.design.tree import MAX_LETTERS
from facade_nb.solver import Letter, Objective, align, tuning, words
from facade_nb.solver import solution as solving
from facade_nb.solver.alignment import single as alignment
from facade_nb.solver.alignment.core.search import search_best as search
from facade_nb.solver.alignment.group import make_group
from facade_nb.solver.alignment.lone import lone
from facade_nb.solver.words import instances
from tests.oracle.designs import design, make_design

PLAIN = Objective.paper()

BOUNDS: dict[str, list[tuple[ModuleType, str, int]]] = {
    "words": [(tuning, "MAX_WORDS_OF_FEW", 3), (tuning, "MAX_WORDS", 3)],
    "words on a grid": [(tuning, "MAX_WORDS_OF_FEW", 3), (tuning, "MAX_WORDS", 3), (tuning, "SUM_FEW", 0)],
    "letters in all": [(tuning, "MAX_LETTERS_IN_ALL", 9)],
    "letters of a word": [(instances, "MAX_SPELLED", 3)],
    "copies of what has no size": [(tuning, "MAX_COPIES", 1)],
    "paths": [(tuning, "PATHS", 6)],
}


@pytest.fixture(autouse=True)
def nothing_kept() -> Iterator[None]:
    solving.forget()
    yield
    solving.forget()


def answer(one: Design, objective: Objective) -> Layout | NoLayout:
    solving.forget()
    try:
        return solve(one, objective=objective, time_limit=None)
    except NoLayout as none:
        return none


@functools.cache
def whole(seed: int, paper: bool) -> Layout | NoLayout:
    """The answer for a random design, without any bound that is lowered here."""
    return answer(make_design(seed), PLAIN if paper else Objective())


class TestAnyDesign:
    @pytest.mark.parametrize("objective", [Objective(), PLAIN], ids=["default", "paper"])
    @pytest.mark.parametrize("bound", BOUNDS)
    def test_never_proven_and_worse(
        self, bound: str, objective: Objective, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        touched = 0
        for seed in range(5 if objective.plain else 0, 12):  # the paper's objective takes long to be proven
            one = make_design(seed)
            full = whole(seed, objective.plain)
            with monkeypatch.context() as lower:
                for module, name, value in BOUNDS[bound]:
                    lower.setattr(module, name, value)
                cut = answer(one, objective)
            if isinstance(cut, NoLayout):
                told = cut.constraint in ("letters", "time", "memory") or "left out" in str(cut)
                assert told or isinstance(full, NoLayout)
                touched += told
                continue
            assert isinstance(full, Layout)
            for along in ("x", "y"):
                less, more = full.along(along), cut.along(along)  # type: ignore[arg-type]
                if more.proven:
                    assert more.gap == 0.0
                    if not objective.plain or full.counters == cut.counters:
                        assert more.cost == pytest.approx(less.cost, abs=1e-6)
                else:
                    touched += 1
                    assert any(f" on {along}" in text for text in cut.warnings)
            if not objective.plain:  # what is told of the two axes together holds of the best there is
                least = full.x.cost + full.y.cost
                assert cut.x.cost - cut.x.gap + cut.y.cost - cut.y.gap <= least + 1e-6
        assert touched or bound in ("copies of what has no size", "paths")

    def test_paths_that_are_cut_are_told(self, monkeypatch: pytest.MonkeyPatch) -> None:
        one = design({"A": 1.0, "B": 0.8, "C": 0.7}, {"a": "A(BA)^3", "b": "C^7"}, ["a", "b"], 6.0)
        full = answer(one, Objective())
        monkeypatch.setattr(tuning, "PATHS", 2)
        cut = answer(one, Objective())
        assert isinstance(full, Layout) and isinstance(cut, Layout)
        assert full.x.proven and not cut.x.proven and not cut.complete
        assert cut.x.cost - cut.x.gap <= full.x.cost + 1e-9 and cut.x.gap > 0
        assert any("too many alignments" in text for text in cut.warnings)


class TestLongWords:
    @pytest.mark.parametrize(
        ("symbols", "text", "width", "k"),
        [
            ({"T": 0.02}, "T^k", 41.0, 2050),
            ({"A": 1.0, "B": 0.8}, "A(BA)^k", 1801.0, 1000),
            ({"T": 0.01}, "T^k", 200.0, 20_000),
            ({"A": 0.1, "B": 0.08}, "(AB)^~k", 540.0, 1500),
        ],
    )
    def test_fit_exactly(self, symbols: dict[str, float], text: str, width: float, k: int) -> None:
        layout = solve(design(symbols, {"a": text}, ["a"], width), time_limit=None)
        assert layout.counters["k"] == k
        assert layout.x.proven and layout.x.cost == pytest.approx(0.0, abs=1e-6) and layout.warnings == ()
        for name, size in symbols.items():
            assert layout.x.sizes[name] == pytest.approx(size, abs=1e-9)
        ends = layout.x.groups["g"].columns
        assert ends[0] == 0.0 and ends[-1] == width and list(ends) == sorted(ends)

    def test_longer_ones_are_told(self) -> None:
        layout = solve(design({"T": 0.01}, {"a": "T^k"}, ["a"], 210.0), time_limit=None)
        assert layout.counters["k"] == MAX_LETTERS and layout.complete
        assert not layout.x.proven and layout.x.gap == pytest.approx(layout.x.cost) and layout.x.cost > 1.0
        (told,) = layout.warnings
        assert told.startswith("Pattern 'a' on x: words of more than 20,000 letters were left out")

    def test_what_a_bound_cannot_matter_to_is_proven(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """Words of more letters are longer than the canvas by more than the answer costs."""
        monkeypatch.setattr(instances, "MAX_SPELLED", 6)
        layout = solve(design({"A": 1.0}, {"a": "A^k"}, ["a"], 5.1))
        assert layout.counters["k"] == 5 and layout.x.proven and layout.warnings == ()

    def test_in_rows_that_differ(self) -> None:
        """Sized by their symbols alone, as small ones are by all their bounds."""
        rows = {"a": "A(BA)^30", "b": "(AC)^30 A"}
        one = design({"A": 1.0, "B": 0.8, "C": {"size": 0.7, "max": 0.78}}, rows, ["a", "b"], 55.0)
        small = solve(one, time_limit=None)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(tuning, "LONG_AXIS", 0)
            solving.forget()
            long = solve(one, time_limit=None)
        assert long.x.sizes == pytest.approx(small.x.sizes, abs=1e-7)
        assert long.x.deviation == pytest.approx(small.x.deviation, abs=1e-7)
        assert long.x.groups["g"].columns == pytest.approx(small.x.groups["g"].columns, abs=1e-6)
        for ours, theirs in zip(long.x.groups["g"].rows, small.x.groups["g"].rows, strict=True):
            assert [[p.symbol for p in own] for own in ours.columns] == [
                [p.symbol for p in own] for own in theirs.columns
            ]
            ours_at = [(p.start, p.end) for own in ours.columns for p in own]
            theirs_at = [(p.start, p.end) for own in theirs.columns for p in own]
            assert [x for own in ours_at for x in own] == pytest.approx(
                [x for own in theirs_at for x in own], abs=1e-6
            )

    @pytest.mark.parametrize("seed", range(20))
    def test_any_random_design_is_sized_alike(self, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
        one = make_design(seed)
        small = whole(seed, paper=False)
        monkeypatch.setattr(tuning, "LONG_AXIS", 0)
        long = answer(one, Objective())
        assert isinstance(long, Layout) == isinstance(small, Layout)
        if isinstance(long, Layout) and isinstance(small, Layout):
            for along in ("x", "y"):
                ours, theirs = long.along(along), small.along(along)  # type: ignore[arg-type]
                assert ours.sizes == pytest.approx(theirs.sizes, abs=1e-6)
                assert ours.cost == pytest.approx(theirs.cost, abs=1e-9)

    @pytest.mark.parametrize("flags", [{}, {"attached": True}, {"opaque": False}, {"unoccludable": True}])
    @pytest.mark.parametrize("canvas", [3.0, 3.4, 9.0])
    @pytest.mark.parametrize("objective", [Objective(), PLAIN], ids=["default", "paper"])
    def test_alone_is_aligned_as_any_search_does(
        self, flags: dict[str, bool], canvas: float, objective: Objective
    ) -> None:
        letters = [Letter("A", 1.0, **flags), Letter("B", 0.7), Letter("A", 1.0, **flags), Letter("B", 0.7)]
        for row in (letters, [a for a in letters if a.symbol == "A"]):
            group = make_group([row, row], canvas, 0.5 * canvas, objective)
            ours, theirs = lone([group]), search([group], keep=4)
            if ours is None:
                continue
            assert len(ours.ties) == len(theirs.ties)
            if ours.best is not None and theirs.best is not None:
                assert ours.best.cost == pytest.approx(theirs.best.cost, abs=1e-9)
                assert [o.letters for (o,) in ours.best.structure[0]] == [
                    o.letters for (o,) in theirs.best.structure[0]
                ]


class TestInstances:
    @staticmethod
    def of(text: str, canvas: float, **sizes: float) -> instances.Instances:
        return instances.instances(
            parse(text), lambda name: Symbol(name, sizes.get(name)), Counter, 1.5 * canvas, canvas=canvas
        )

    def test_a_word_with_an_unsized_letter_may_miss_the_canvas_by_nothing(
        self, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        assert self.of("A^k e m; m := A", 10.0, A=1.0).left == float("inf")
        monkeypatch.setattr(tuning, "MAX_WORDS_OF_FEW", 4)
        assert self.of("A^k", 10.0, A=1.0).left > 1.0
        assert self.of("A^k e m; m := A", 10.0, A=1.0).left == 0.0

    def test_what_a_counter_of_nothing_repeats(self) -> None:
        assert self.of("e^k m; m := A", 4.0, A=1.0).left == 0.0  # the seventeenth e is another word
        assert self.of("A ε^k", 4.0, A=1.0).left == float("inf")  # ε is not

    def test_a_counter_that_others_bound_from_below(self) -> None:
        """It is not given up before it comes to where the others have words."""
        found = instances.instances(
            parse("e^k m; m := A"),
            lambda n: Symbol(n, {"A": 1.0}.get(n)),
            Counter,
            6.0,
            canvas=4.0,
            common={"k": (20, 22)},
        )
        assert [word.counters["k"] for word in found.words] == [20, 21, 22] and found.endless == ()

    def test_counters_whose_first_copies_are_too_long(self) -> None:
        """One copy has 15,000 letters, two have more than there may be."""
        found = self.of("(A^15000)^k B", 40.0, A=0.001, B=10.0)
        assert found.clipped == ("k",) and found.left == 0.0
        assert self.of("(A^15000)^k B", 11.0, A=0.001, B=10.0).left == float("inf")

    def test_ranges_do_not_hide_what_is_left_out(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """The counter stands in two patterns; the words of one have too many letters from some value on."""
        one = design({"A": 0.5, "B": 1.0}, {"a": "(AA)^k", "b": "B^k"}, ["a", "b"], 6.0)
        assert solve(one).x.proven
        monkeypatch.setattr(instances, "MAX_SPELLED", 8)
        solving.forget()
        layout = solve(one)
        assert layout.counters["k"] == 4 and not layout.x.proven
        assert any("'a' on x: words of more than" in text for text in layout.warnings)

    def test_a_reflection_refused_for_its_letters_is_no_error(self) -> None:
        """m stands in the word until it is replaced by nothing."""
        found = self.of("(Am)^k; m := ε", 12.0, A=0.001)
        assert found.left == pytest.approx(0.0, abs=0.1)
        found = self.of("A^.k", 12.0, A=0.001)  # a mirrored copy shares its only letter
        assert any(len(word) == 12_000 for word in found.words)


def test_values_of_some_candidates_only_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    one = design({"A": 1.0, "P": 0.5}, {"a": "A^k", "u": "P^k"}, [("a", "g", "u", "g")], 4.0, 9.0)
    with pytest.raises(NoLayout, match="and no value fits both: across it can be 2, 3, 4, 5, 6, up"):
        solve(one)
    monkeypatch.setattr(tuning, "COMPARED", 1)
    with pytest.raises(
        NoLayout, match="no value fits both, as far as the first 1 candidates say: across it can be 2"
    ):
        solve(one)


class TestLists:
    def test_words_that_are_cut_off_are_told(self) -> None:
        with pytest.warns(
            UserWarning, match="'k' repeats nothing that has a size; it was tried up to 16 only"
        ):
            words("e^k m; m := A", {"A": 1.0}, canvas=4, tolerance=0)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            words("e^k m; m := A", {"A": 1.0}, canvas=4, tolerance=0, counters={"k": (0, 5)})
            words("A ε^k", {"A": 1.0}, canvas=1, tolerance=0)

    def test_an_alignment_that_is_the_best_so_far_says_so(self, monkeypatch: pytest.MonkeyPatch) -> None:
        rows = [[Letter("A", 1.0), Letter("B", 0.7)] * 3, [Letter("C", 0.9)] * 6]
        full = align(rows, 5.2, 2.0, PLAIN, "best")
        assert full is not None and full.proven and full.gap == 0.0
        cut: list[alignment.Alignment] = []
        for n in range(1, 80):
            monkeypatch.setattr(tuning, "ALIGN_TURNS", {"best": (n, n, n), "ida": (n, n, n)})
            for method in alignment.SEARCHES:
                try:
                    one = align(rows, 5.2, 2.0, PLAIN, method)
                except NoLayout as none:
                    assert none.constraint == "memory"
                    continue
                assert one is not None and (not one.proven or one.cost == pytest.approx(full.cost, abs=1e-9))
                cut += [] if one.proven else [one]
        assert cut
        assert all(one.cost - one.gap <= full.cost + 1e-9 for one in cut)
