"""Why there is no layout: each kind of `NoLayout`, its text and what it points at."""

from __future__ import annotations

from dataclasses import replace

import pytest
from IPython.core.interactiveshell import InteractiveShell

from facade_nb import Design, DesignError, NoLayout, solve
from facade_nb.design import Canvas, Suggestion, Symbol, edit
from facade_nb.solver import Objective, tuning
from facade_nb.solver.assembly import shapes as merging
from facade_nb.solver.budget import Stopped
from facade_nb.solver.model.problem import axis_problem
from facade_nb.solver.selection.axis import AxisSearch
from tests.oracle.designs import design, make_design


@pytest.fixture(autouse=True)
def plenty_of_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """What would help is looked for until it is found, however busy the machine is."""
    monkeypatch.setattr(tuning, "REMEDIES", 6.0)
    monkeypatch.setattr(tuning, "REMEDY", 2.0)
    monkeypatch.setattr(tuning, "ASIDE", 2.0)


def refused(one: Design, **options: object) -> NoLayout:
    """The reason why a design has no layout."""
    with pytest.raises(NoLayout) as caught:
        solve(one, **options)  # type: ignore[arg-type]
    return caught.value


CLEAR = {"size": 4.0, "opaque": False}


class TestWords:
    def test_shortest_word_too_long(self) -> None:
        error = refused(
            design({"A": 1.0, "B": 2.0}, {"wall": "A(BA)^k"}, ["wall"], counters={"k": {"min": 3}})
        )
        assert str(error) == (
            "Pattern 'wall': its shortest word, A B A B A B A, measures 10 m, and the canvas is 4 m wide. "
            "It would work with counter 'k' from 1 on, or with a width of 10 m."
        )
        assert (error.axis, error.patterns, error.counters) == ("x", ("wall",), ("k",))
        assert (error.constraint, error.group, error.layers) == ("canvas", "g", ("L0",))

    def test_and_up(self) -> None:
        error = refused(design({"A": 4.0, "P": 5.0}, {"a": "A", "floors": "P"}, [("a", "g", "floors")]))
        assert "Pattern 'floors': its shortest word, P, measures 5 m, and the canvas is 2 m high." in str(
            error
        )
        assert str(error).endswith("It would work with a height of 5 m, or with 'P' of 2 m.")
        assert [(s.path, s.value) for s in error.suggestions] == [
            (("canvas", "height"), 5.0), (("symbols", "P", "size"), 2.0),
        ]  # fmt: skip
        assert error.axis == "y"

    def test_very_long_words_are_cut_short(self) -> None:
        error = refused(design({"A": 1.0}, {"a": "A^100"}, ["a"]))
        assert "…" in str(error) and len(str(error)) < 250

    def test_longest_word_too_short(self) -> None:
        one = design({"A": 0.5}, {"wall": "A^k"}, ["wall"], counters={"k": {"max": 3}})
        error = refused(one)
        assert str(error) == (
            "Pattern 'wall': its longest word, A A A, measures 1.5 m and cannot fill the canvas, which is 4 m wide. "
            "It would work with counter 'k' up to 4, or with a width of 1.5 m."
        )
        assert (error.axis, error.patterns, error.counters) == ("x", ("wall",), ("k",))

    def test_longest_word_too_short_without_a_counter(self) -> None:
        error = refused(design({"A": 0.5}, {"wall": "AA"}, ["wall"]))
        assert "cannot fill the canvas" in str(error) and "Counter" not in str(error)
        assert error.counters == ()

    @pytest.mark.parametrize(
        ("text", "canvas", "counters", "told"),
        [
            (
                "(bgr)^k",
                5.0,
                {},
                "its words measure 0 m or 15 m or more, and the canvas is 5 m wide. Nearest are ε and b g r.",
            ),
            ("(bgr)^k", 5.0, {"max": 1}, "its words measure 0 m or 15 m, and"),
            ("(bgr)^-k", 5.0, {}, "its words measure 0 m or 15 m or more, and"),
            ("(bgr)^k", 5.0, {"min": -2, "max": 0}, "its words measure 0 m or 15 m or more, and"),
            ("(bgr)^@k", 5.0, {}, "its words measure 0 m or 25 m or more, and"),
            ("(bgr)^k|A", 5.0, {}, "its words measure at most 1 m or 15 m or more, and"),
            (
                "A|B",
                4.0,
                {},
                "its words measure 1 m or 10 m, and the canvas is 4 m wide. Nearest are A and B.",
            ),
            ("A|AA|B", 5.5, {}, "its words measure at most 2 m or 10 m, and"),
            ("A^k|B", 5.0, {"max": 2}, "its words measure at most 2 m or 10 m, and"),
            ("A(bgr)^k(BB)^m", 8.0, {}, "its words measure 1 m or 16 m or more, and"),
            (
                "()",
                5.0,
                {},
                "its longest word, ε, measures 0 m and cannot fill the canvas, which is 5 m wide.",
            ),
            ("A^k", 5.0, {"max": 2}, "its longest word, A A, measures 2 m and cannot fill the canvas"),
        ],
    )
    def test_words_that_are_too_short_or_too_long(
        self, text: str, canvas: float, counters: dict[str, int], told: str
    ) -> None:
        sizes = {"b": 5.0, "g": 5.0, "r": 5.0, "A": 1.0, "B": 10.0}
        error = refused(design(sizes, {"wall": text}, ["wall"], canvas, counters={"k": counters}))
        assert str(error).startswith(f"Pattern 'wall': {told}")
        assert (error.constraint, error.patterns) == ("canvas", ("wall",))

    def test_a_width_of_either_length_is_proposed(self) -> None:
        error = refused(
            design({"A": 1.0, "B": 10.0}, {"wall": "A|B"}, ["wall"], 8.0, counters={}), tolerances=(0.0,)
        )
        assert error.suggestions[0].path == ("canvas", "width") and error.suggestions[0].value == 10.0

    def test_what_the_message_proposes_works(self) -> None:
        assert solve(design({"A": 1.0, "B": 2.0}, {"w": "A(BA)^3"}, ["w"], width=10.0)).x.cost == 0.0
        assert solve(design({"A": 0.5}, {"w": "A^3"}, ["w"], width=1.5)).x.cost == 0.0


class TestCounters:
    def test_shared_by_patterns(self) -> None:
        """a fits with k of 2 to 6, b with 20 to 60."""
        error = refused(design({"A": 1.0, "B": 0.1}, {"a": "A^k", "b": "B^k"}, [("a", "g"), ("b", "f")]))
        assert str(error).startswith(
            "Patterns 'a', 'b' share counter 'k', and no value of it fits all of them: 'a' fits with 2 … 6, 'b' fits "
            "with 20 … 60. It would work with 'A' of 0."
        )
        assert error.constraint == "counters"
        assert error.counters == ("k",) and set(error.patterns) == {"a", "b"} and error.axis == "x"

    def test_on_both_axes(self) -> None:
        error = refused(design({"A": 1.0, "P": 1.0}, {"a": "A^k", "p": "P^k"}, [("a", "g", "p")], 10.0, 2.0))
        assert str(error).startswith(
            "Counter 'k' is used both across and up, and no value fits both: across it can be 5, 6, 7, 8, 9, "
            "10, 11, 12, …, up 1, 2, 3. It would work with a height of 3."
        )
        assert error.counters == ("k",)

    def test_on_both_axes_though_something_else_is_to_blame(self) -> None:
        """Values of k fit both ways; that B is unoccludable behind P, which is not opaque, is the reason."""
        symbols = {"A": 1.0, "C": {"size": 1.0, "opaque": False}, "B": {"size": 1.0, "unoccludable": True}}
        one = design(
            symbols, {"c": "C^k", "b": "B^k", "a": "A^k"}, [("c", "g", "a"), ("b", "g", "a")], 3.0, 3.0
        )
        error = refused(one)
        assert "no value of it fits both" not in str(error)
        assert error.symbols in {("B",), ("C",)}


class TestConstraints:
    def test_unoccludable(self) -> None:
        error = refused(
            design({"C": CLEAR, "B": {"size": 4.0, "unoccludable": True}}, {"c": "C", "b": "B"}, ["c", "b"])
        )
        text = str(error)
        assert error.axis == "x"
        # Either would do: B that may be covered, or C that is opaque.
        assert error.symbols in {("B",), ("C",)}
        assert "across" in text and "It would work with" in text

    def test_unoccludable_alone(self) -> None:
        """C of the top row must not be opaque for other reasons: making it so does not help, freeing B does."""
        symbols = {
            "C": CLEAR,
            "D": {"size": 4.0, "opaque": False},
            "B": {"size": 4.0, "unoccludable": True},
        }
        error = refused(design(symbols, {"c": "C", "d": "D", "b": "B"}, ["c", "d", "b"]))
        assert str(error) == (
            "'B' is unoccludable, and nothing that is not opaque may stand before it: every alignment across breaks "
            "that. It would work with 'B' not unoccludable."
        )
        assert error.symbols == ("B",)

    def test_attached(self) -> None:
        """C and A can stand side by side, or in one column; the latter is too wide for their sizes."""
        symbols = {"C": {"size": 2.0, "max": 2.2}, "A": {"size": 2.0, "max": 2.2}}
        assert len(solve(design(symbols, {"c": "C", "a": "A"}, ["c", "a"])).x.groups["g"].columns) == 3
        symbols["A"] = {**symbols["A"], "attached": True}
        error = refused(design(symbols, {"c": "C", "a": "A"}, ["c", "a"]))
        assert str(error) == (
            "'A' is attached, and no gap may open beside it: every alignment across breaks that. "
            "It would work with 'A' not attached."
        )
        assert error.symbols == ("A",)

    def test_not_opaque(self) -> None:
        """Behind C there is only B, which is not opaque either."""
        clear = {"size": 2.0, "opaque": False}
        error = refused(design({"C": clear, "D": 2.0, "B": clear}, {"c": "CD", "b": "B"}, ["c", "b"]))
        assert str(error) == (
            "'C' is not opaque, and something opaque must stand behind it: every alignment across breaks that. "
            "It would work with 'C' opaque, or with 'B' opaque."
        )
        assert error.symbols == ("C",)

    def test_nothing_in_particular(self) -> None:
        """No tolerance, no cut, no qualifier: the rows just do not meet."""
        one = design({"A": 4.0, "B": 3.0}, {"a": "A", "b": "B"}, ["a", "b"])
        error = refused(one, objective=Objective.paper(), tolerances=(0.0,))
        assert str(error).startswith("No alignment of 'a', 'b' across keeps within the canvas of 4 m") or str(
            error
        ).startswith("Pattern 'b': its longest word")

    def test_sizes(self) -> None:
        one = design({"A": {"size": 1.9, "max": 1.95}}, {"wall": "AA"}, ["wall"])
        error = refused(one)
        assert str(error) == (
            "A A of pattern 'wall' measures at most 3.9 m, by the max of 'A', and the canvas is 4 m wide. "
            "It would work with 'A' up to 2 m, or with a width of 3.9 m."
        )
        assert error.symbols == ("A",) and error.axis == "x"
        wider = Design.from_dict(
            one.to_dict() | {"symbols": {**one.to_dict()["symbols"], "A": {"size": 1.9, "max": 2.0}}}
        )
        assert solve(wider).x.sizes["A"] == pytest.approx(2.0)

    def test_patterns_that_can_never_be_of_one_length(self) -> None:
        """|A| would have to be 2 m, and 2 m less half of |B|."""
        one = design({"A": 1.8, "B": 0.8}, {"a": "ABA", "b": "AA"}, [("a", "g"), ("b", "f")])
        error = refused(one)
        assert error.axis == "x" and set(error.patterns) == {"a", "b"}
        assert "'a'" in str(error) and "'b'" in str(error)


class TestMore:
    """Reasons that are rarer, each with all that a view can point at."""

    def test_no_room_for_an_unsized_symbol(self) -> None:
        error = refused(design({"A": {"size": 4.0, "min": 4.0}}, {"a": "eme; m := A", "w": "A"}, ["a", "w"]))
        assert str(error) == (
            "There is no room for 'e' of pattern 'a' across: it would have to be of no length. Without it there is an "
            "alignment."
        )
        assert (error.constraint, error.symbols, error.patterns, error.layers) == (
            "room",
            ("e",),
            ("a",),
            ("L0",),
        )

    def test_letters_too_small_for_the_canvas(self) -> None:
        error = refused(design({"A": 0.001}, {"a": "A^k"}, ["a"], 1000.0), time_limit=None)
        assert str(error).startswith(
            "Pattern 'a' would need words of more than 20,000 letters to fill the canvas, which is 1000 m wide; "
            "no word may have more."
        )
        assert (error.constraint, error.symbols, error.counters) == ("letters", ("A",), ("k",))

    def test_a_tolerance(self) -> None:
        one = design({"A": 1.0, "B": 0.9}, {"a": "A^4", "b": "BBBB"}, ["a", "b"])
        error = refused(one, objective=Objective.paper(), tolerances=(0.0, 0.01))
        assert "within" in str(error) and "It would work with a tolerance of 0.05 times the canvas" in str(
            error
        )
        assert error.constraint == "tolerance"
        assert error.suggestion == Suggestion(
            "a tolerance of 0.05 times the canvas", ("tolerances",), (0.0, 0.01, 0.05)
        )
        assert solve(one, objective=Objective.paper(), tolerances=(0.0, 0.01, 0.05)).x.groups
        with pytest.raises(ValueError, match="tolerances"):
            edit.take(one, error.suggestion)

    def test_no_word_of_that_size(self) -> None:
        """Three of A are too short at this tolerance, and four too long."""
        one = design({"A": 1.3}, {"a": "A^k"}, ["a"], 4.5)
        error = refused(one, objective=Objective.paper(), tolerances=(0.1,))
        assert str(error) == (
            "Pattern 'a': its words measure at most 3.9 m or 5.2 m or more, and the canvas is 4.5 m wide. Nearest are "
            "A A A and A A A A. It would work with a width of 3.9 m, or with 'A' of 1.5 m."
        )

    def test_too_long_or_too_short(self) -> None:
        """A B of two lengths, neither of which is near enough, and both nearer than what is between."""
        one = design({"A": 1.0, "B": 1.2, "Z": 0.1}, {"a": "B^k", "z": "Z^3"}, ["z", "a"], 3.0)
        error = refused(one, objective=Objective.paper(), tolerances=(0.02,))
        assert error.axis == "x" and error.suggestions

    def test_the_group_that_cannot_be_aligned(self) -> None:
        clear = {"size": 2.0, "opaque": False}
        one = design(
            {"C": clear, "D": clear, "O": 0.01, "A": 1.0},
            {"c": "C", "d": "O D", "a": "A^k"},
            [("a", "g"), ("c", "f"), ("d", "f")],
        )
        error = refused(one)
        assert (error.constraint, error.group, error.layers, error.symbols) == ("C1", "f", ("L1",), ("C",))

    def test_counters_that_pattern_analysis_finds_at_odds(self) -> None:
        one = design(
            {"A": 2.0},
            {"a": "A^k", "b": "A^l A"},
            [("a", "g"), ("b", "f")],
            counters={"k": {"value": 2}, "l": {"value": 2}},
        )
        error = refused(one)
        assert error.constraint == "analysis" and set(error.patterns) == {"a", "b"}
        assert str(error).endswith("It would work with counter 'k' at 3, or with counter 'l' at 1.")

    def test_a_counter_far_off(self) -> None:
        """The largest value with which the word is no longer than the canvas and half as much."""
        error = refused(design({"A": 1.0}, {"a": "A^k"}, ["a"], counters={"k": {"value": 90}}))
        assert error.counters == ("k",) and "It would work with counter 'k' at 6, or with" in str(error)

    def test_one_size_for_all_letters_of_a_symbol(self) -> None:
        """A^k is no longer than 2 |A|, and AAB would have to be of the same length."""
        one = design(
            {"A": 2.0, "B": 1.5},
            {"a": "A^k", "b": "A A B"},
            [("a", "g"), ("b", "f")],
            8.0,
            counters={"k": {"max": 2}},
        )
        error = refused(one)
        assert error.constraint == "sizes" and "'A', 'B' must each have one size everywhere" in str(error)
        assert str(error).endswith("It would work with counter 'k' up to 3.")

    def test_bounds_of_several_symbols(self) -> None:
        one = design(
            {"A": {"size": 1.9, "max": 1.95}, "B": {"size": 1.0, "max": 1.0}}, {"a": "ABA"}, ["a"], 6.0
        )
        error = refused(one)
        assert error.symbols == ("A", "B")
        assert str(error).endswith("It would work with 'A' up to 2.5 m, or with 'B' up to 2.1 m.")

    def test_too_many_shapes(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(merging, "MAX_SHAPES", 10)
        error = refused(design({"A": 1.0, "P": 0.5}, {"a": "A^4", "p": "P^4"}, [("a", "g", "p")]))
        assert "Layer 'L0' has 4 by 4 cells; a layer may have 10 shapes at most" in str(error)
        assert (error.constraint, error.layers, error.patterns) == ("shapes", ("L0",), ("a", "p"))

    @pytest.mark.parametrize("seed", range(30))
    def test_what_is_suggested_works(self, seed: int) -> None:
        """Whatever is named has been tried: with it, what is to blame is no longer so."""
        one = make_design(seed)
        try:
            solve(one)
        except NoLayout as error:
            assert len(error.suggestions) <= 2
            assert error.suggestions or seed in (4, 11)  # nothing simple would help
            assert ("It would work with" in str(error)) == bool(error.suggestions)
            for suggestion in error.suggestions:
                assert suggestion.text in str(error)
                try:
                    solve(edit.take(one, suggestion))
                except NoLayout as other:  # the other axis has no layout either
                    assert error.axis and other.axis and other.axis != error.axis

    def test_nothing_is_tried_after_the_time_is_over(self) -> None:
        """An explanation, without what would help."""
        for stop in range(0, 200, 3):
            calls = iter(range(10**6))
            try:
                solve(make_design(0), should_stop=lambda: next(calls) > stop, time_limit=None)  # noqa: B023
            except NoLayout as error:
                assert str(error)

    def test_a_search_that_takes_over_may_be_stopped(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """Where structures do not fit each other one search takes the place of several; till it is made these stay."""
        one = design({"A": 1.0, "B": 1.5}, {"a": "A^k", "b": "B^l"}, [("a", "g"), ("b", "h")])
        walk = AxisSearch(axis_problem(one, "x"), Objective(), 2.0)
        walk.enumerate()
        case = walk.case(next(walk.in_order()))
        walk.open(case)
        assert len(case.runs) == len(case.clusters) == 2

        def stopped(*_: object) -> None:
            raise Stopped

        monkeypatch.setattr(AxisSearch, "size", lambda *_: None)
        monkeypatch.setattr(walk.searches, "run", stopped)
        with pytest.raises(Stopped):
            walk.solve(case)
        assert len(case.runs) == len(case.clusters) == 2

    def test_a_suggestion_is_plain_data(self) -> None:
        error = refused(design({"A": 1.0}, {"a": "A^9"}, ["a"]))
        assert [
            edit.take(design({"A": 1.0}, {"a": "A^9"}, ["a"]), s).canvas.width for s in error.suggestions[:1]
        ] == [9.0]
        with pytest.raises(ValueError, match=r"expected a field of a design, found 'layers\.0'"):
            edit.take(Design(), Suggestion("", ("layers", "0"), 1))


class TestDisplay:
    @staticmethod
    def shown(code: str, monkeypatch: pytest.MonkeyPatch) -> str:
        """What a notebook shows for a cell that fails."""
        shell = InteractiveShell.instance()
        lines: list[str] = []
        monkeypatch.setattr(shell, "_showtraceback", lambda _type, _value, stb: lines.extend(stb))
        shell.push({"solve": solve, "Design": Design, "design": design})
        assert shell.run_cell(code).error_in_exec is not None
        return "\n".join(lines)

    def test_no_traceback_in_ipython(self, monkeypatch: pytest.MonkeyPatch) -> None:
        shown = self.shown("solve(design({'A': 9.0}, {'wall': 'A'}, ['wall']))", monkeypatch)
        assert shown.startswith("NoLayout: Pattern 'wall': its shortest word, A, measures 9 m")
        assert "Traceback" not in shown and "solving.py" not in shown

    def test_nor_for_a_faulty_design(self, monkeypatch: pytest.MonkeyPatch) -> None:
        shown = self.shown("Design.from_dict({'format': 'facade-nb/design/1', 'symbols': 3})", monkeypatch)
        assert shown.startswith("DesignError: symbols: expected") and "Traceback" not in shown

    def test_text_of_the_error_is_its_message(self) -> None:
        error = refused(design({"A": 9.0}, {"wall": "A"}, ["wall"]))
        assert str(error) == error.message
        assert error._render_traceback_() == [f"NoLayout: {error.message}"]

    @pytest.mark.parametrize("size", [1e-308, 1e308])
    def test_sizes_beyond_what_can_be_computed(self, size: float) -> None:
        """A design that was made, not read, is checked before it is solved."""
        one = design({"A": 1.0}, {"wall": "A^k"}, ["wall"])
        for broken, place in [
            (replace(one, canvas=Canvas(size, 2.0)), "canvas.width"),
            (replace(one, symbols={**one.symbols, "A": Symbol("A", size)}), "symbols.A.size"),
        ]:
            with pytest.raises(
                DesignError, match=rf"{place}: expected a length from 0.000001 to 1,000,000 m, found"
            ):
                solve(broken)

    @pytest.mark.parametrize(
        ("width", "size"), [(1e6, 1e-6), (1e-6, 1e6), (1e6, 1e6), (1e-6, 1e-6), (1e6, 3.0)]
    )
    def test_sizes_at_the_ends_of_what_can_be(self, width: float, size: float) -> None:
        for text in ("A^k", "A", "A|AA", "A^kA^m"):
            one = design({"A": size}, {"wall": text}, ["wall"], width)
            try:
                assert solve(one, time_limit=None).x.groups["g"].columns
            except NoLayout as error:
                assert str(error).startswith("Pattern 'wall'") and len(str(error)) < 400

    def test_names_of_megabytes(self) -> None:
        name = "x" * 1_000_000
        error = refused(design({"A": 9.0}, {name: "A"}, [name]))
        assert str(error).startswith("Pattern 'xxx") and len(str(error)) < 300

    def test_words_that_cannot_be_listed(self) -> None:
        """A count of thousands is the design's fault, and told as one when it is read."""
        with pytest.raises(DesignError, match=r"counters\.k\.value: .*a word would have 100,000,000 letters"):
            design({"A": 1.0}, {"wall": "A^k"}, ["wall"], counters={"k": {"value": 10**8}})
