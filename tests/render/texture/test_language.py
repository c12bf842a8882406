"""The language: what is read as what, and every fault with its place."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb.design import DesignError
from facade_nb.design.errors import GrammarError
from facade_nb.render import Grammar
from facade_nb.render.texture import OPERATORS, Rule, Source

from .figure_12 import FIGURE_12
from .stand_in import stand_in


def rules(text: str) -> dict[str, Rule]:
    return {rule.name: rule for rule in Grammar.parse(text, stand_in()).rules}


def told(text: str) -> list[tuple[int | None, int | None, str]]:
    """Line, column and message of each fault."""
    with pytest.raises(GrammarError) as caught:
        Grammar.parse(text, stand_in())
    assert isinstance(caught.value, DesignError)
    for fault in caught.value.faults:
        lines = fault.excerpt.split("\n")
        assert len(lines) == 2 and lines[1].strip() == "^"
        assert lines[0] == text.split("\n")[(fault.line or 0) - 1]
        assert len(lines[1]) == fault.column
    return [(fault.line, fault.column, fault.message) for fault in caught.value.faults]


class TestRead:
    def test_figure_12_runs_as_printed_without_its_elisions(self) -> None:
        found = rules(FIGURE_12)
        assert list(found)[:3] == ["S", "Wall", "Wall1"]
        assert len(found) == 20
        assert found["WindowMat1"].value("m1") == Source("Fit", "window1")
        assert found["WindowTile"].operator is OPERATORS["SplitX"]

    @pytest.mark.parametrize("elision", ["...", ", ...", ":"])
    def test_elisions_are_named_where_they_are_left_in(self, elision: str) -> None:
        text = {
            "...": "S -> RandUni(0, ...)",
            ", ...": "S -> RandUni(0, A, ...)\nA -> Skip(0)",
            ":": "S -> Skip(0)\n:\nA -> Skip(0)",
        }[elision]
        ((_, _, message),) = told(text)
        assert "left out" in message or "found ':'" in message

    @pytest.mark.parametrize(
        "text",
        [
            "S->Layer(A,A);A->Skip(0)",
            "S → Layer(A, A,)\n\n;; A -> Skip ( 0 ) ;",
            "# head\nS -> Layer(A, // one\n  A # two\n)\nA -> Skip(0) // end",
            "S\n->\nLayer\n(\nA\n,\nA\n)\nA\r\n->\rSkip(0)",
        ],
    )
    def test_layout_is_free(self, text: str) -> None:
        found = rules(text)
        assert found["S"].targets() == (1, 1)
        assert found["A"].fixed == (0,)

    def test_constants(self) -> None:
        found = rules(
            "S -> SplitX(Abs, .5, C, Rel, 1e0, N)\nC -> Mat(Color, 0, 1, 1, 1, 1)\n"
            "N -> MatAlpha(Normal, Rep:wall1, -1, 0, 2, +2, Fit > hole, 0, 0, 1, 1)\nG -> Mat(Specular, 0, 0, 0, 0, 0)"
        )
        assert found["S"].parts == ((-1, 0.5, 1), (1, 1.0, 2))
        assert found["N"].fixed == (2, Source("Rep", "wall1"), -1, 0, 2, 2, Source("Fit", "hole"), 0, 0, 1, 1)
        assert [found[name].value("u") for name in "CNG"] == [1, 2, 3]

    def test_numbers_are_calculated(self) -> None:
        found = rules("a = 3\nb = a * (2 - .5) / 2\nS -> RepeatX(b - -a + 1, T)\nT -> Skip(a - 1)")
        assert found["S"].fixed == (6.25, 1)
        assert found["T"].fixed == (2,)

    def test_the_start_rule(self) -> None:
        assert Grammar.parse("A -> Skip(0)\nS -> Skip(1)").start == 1
        assert Grammar.parse("A -> Skip(0)\nT -> Skip(1)").start == 0

    def test_a_rule_may_be_called_as_an_operator_or_a_constant(self) -> None:
        assert rules("S -> Layer(Skip, Color)\nSkip -> Skip(0)\nColor -> Skip(1)")["S"].targets() == (1, 2)


class TestCopies:
    def test_a_rule_with_arguments_becomes_a_rule_for_each(self) -> None:
        text = """
            S -> RandUni(0, Tile(1), Tile(1.0), Tile(n = 2), Tile, Wide)
            Tile(n = 2, of = Blue) -> RepeatX(n, of)
            Wide -> RandUni(0, Tile(3, Red), Tile(of = Red))
            Blue -> Mat(Color, 0, 0, 0, 1, 1)
            Red -> Mat(Color, 0, 1, 0, 0, 1)
        """
        found = rules(text)
        names = ["S", "Tile", "Wide", "Blue", "Red", "Tile(n=1)", "Tile(n=3, of=Red)", "Tile(of=Red)"]
        assert list(found) == names
        assert [names[i] for i in found["S"].targets()] == ["Tile(n=1)", "Tile(n=1)", "Tile", "Tile", "Wide"]
        assert found["Tile(n=3, of=Red)"].fixed == (3, 4)

    def test_the_first_use_of_a_rule_without_defaults_stands_at_its_place(self) -> None:
        text = "S -> Layer(P(Fit:wall1), P(Rep:wall2))\nP(t) -> Mat(Color, t, 0, 0, 1, 1)\n"
        text += "Q(t) -> Skip(t)\nLast -> Skip(0)"
        assert list(rules(text)) == ["S", "P(t=Fit:wall1)", "Last", "P(t=Rep:wall2)"]

    def test_a_namespace_is_copied_with_other_settings(self) -> None:
        text = """
            glass = Fit:window1
            namespace office {
              width = 1.2
              half = width / 2
              S -> RepeatX(width * 2, Window)
              Window -> SplitX(Abs, half, Pane, Rel, 1, Gap)
              Pane -> Mat(Color, glass, 0, 0, 1, 1)
            }
            namespace bank = office(width = 2);
            S -> SplitY(Abs, 4, bank.S, Rel, 1, office.S)
            Gap -> Skip(0)
        """
        found = rules(text)
        assert list(found) == [
            "office.S", "office.Window", "office.Pane", "bank.S", "bank.Window", "bank.Pane", "S", "Gap",
        ]  # fmt: skip
        assert found["office.Window"].parts[0][1] == pytest.approx(0.6)
        assert found["bank.Window"].parts[0] == (-1, 1.0, 5)
        assert found["bank.S"].fixed == (4.0, 4)
        assert found["office.Window"].parts[1][2] == found["bank.Window"].parts[1][2] == 7

    def test_a_copy_of_a_copy_has_the_changes_of_both(self) -> None:
        text = """
            namespace a { w = 1  h = w * 2
              S -> RepeatX(w, B)
              B -> RepeatY(h, Gap) }
            namespace b = a(w = 5)
            namespace c = b(h = 7)
            namespace d = c
            Gap -> Skip(0)
        """
        found = rules(text)
        sizes = {name: (found[f"{name}.S"].fixed[0], found[f"{name}.B"].fixed[0]) for name in "abcd"}
        assert sizes == {"a": (1, 2), "b": (5, 10), "c": (5, 7), "d": (5, 7)}

    def test_a_setting_may_be_a_rule_and_a_constant(self) -> None:
        text = """
            namespace n { wall = Red  how = Abs
              S -> SplitX(how, 1, wall, Rel, 1, Blue) }
            namespace m = n(wall = Blue, how = Rel)
            S -> Layer(n.S, m.S)
            Red -> Skip(0)
            Blue -> Skip(1)
        """
        found = rules(text)
        names = list(found)
        assert [(s, names[i]) for s, _, i in found["m.S"].parts] == [(1, "Blue"), (1, "Blue")]
        assert [(s, names[i]) for s, _, i in found["n.S"].parts] == [(-1, "Red"), (1, "Blue")]


FAULTS = {
    "an unknown rule": (
        "S -> Layer(Wal)\nWall -> Skip(0)",
        1, 12, "there is no rule 'Wal'; did you mean 'Wall'?",
    ),
    "an unknown operator": (
        "S -> Splitx(Rel, 1, S)",
        1, 6, "there is no operator 'Splitx'; did you mean 'SplitX'?",
    ),
    "a rule as an operator": ("S -> Wall(1)\nWall -> Skip(0)", 1, 6, "'Wall' is a rule: write Layer(Wall)"),
    "an unknown tile": (
        "S -> Mat(Color, Fit:windw1, 0, 0, 1, 1)", 1, 17, "there is no tile 'windw1'; did you mean 'window1'?",
    ),
    "too few values": ("S -> RepeatX(2)", 1, 6, "RepeatX(v, R) takes 2 values; found 1"),
    "a part that is not whole": (
        "S -> Layer()\nA -> SplitX(Rel, 1)",
        1, 6, "takes one rule or more; found 0",
    ),
    "a wrong kind": (
        "S -> RepeatX(A, 2)\nA -> Skip(0)",
        1, 14, "expected a size in metres above 0 for v; found the rule 'A'",
    ),
    "a number for a rule": ("S -> RandStack(2)", 1, 16, "expected the name of a rule for R; found 2"),
    "a size of 0": (
        "S -> RepeatX(0, A)\nA -> Skip(0)",
        1, 14, "expected a size in metres above 0 for v; found 0",
    ),
    "half a level": ("S -> Skip(0.5)", 1, 11, "expected a whole number, 0 or more for l; found 0.5"),
    "a policy": (
        "S -> SplitX(Relative, 1, A)\nA -> Skip(0)",
        1, 13, "expected Abs or Rel; found 'Relative'; did you mean 'Rel'?",
    ),
    "a usage": ("S -> Mat(Colour, 0, 1, 1, 1, 1)", 1, 10, "found 'Colour'; did you mean 'Color'?"),
    "a repeated mask": ("S -> SkipMask(Rep:hole, 0, 1)", 1, 15, "expected Fit:tile for m; found 'Rep:hole'"),
    "a source": ("S -> Mat(Color, 1, 1, 1, 1, 1)", 1, 17, "expected 0, Fit:tile or Rep:tile for m1; found 1"),
    "a bright colour": (
        "S -> Mat(Color, 0, 2, 1, 1, 1)",
        1, 20, "expected a number from 0 to 1 for the constant; found 2",
    ),
    "an empty part": ("S -> Mat(Color, Fit:hole, 0, 0, 0, 1)", 1, 27, "a part that is not empty"),
    "a scale of 0": (
        "S -> Mat(Color, Rep:hole, 0, 0, 0, 1)",
        1, 33, "expected repeats per metre other than 0",
    ),
    "probabilities": (
        "S -> Rand(0, .5, A, .4, A)\nA -> Skip(0)",
        1, 6, "expected probabilities that add up to 1; found 0.9",
    ),
    "endless repetition": (
        "S -> RepeatX(2, S)",
        1, 6, "comes back to itself without its scope getting smaller: S → S",
    ),
    "an endless absolute split": (
        "S -> SplitX(Abs, 1, T, Rel, 1, A)\nT -> Layer(S)\nA -> Skip(0)", 1, 6, "getting smaller: S → T → S",
    ),
    "endless layers": ("A -> Skip(0)\nS -> Layer(A, S)", 2, 6, "comes back to itself"),
    "rooms in rooms": (
        "S -> SplitX(Rel, 1, A, Rel, 1, I)\nI -> Intrusion(1, S, A, A, A, A)\nA -> Skip(0)",
        2, 6, "Intrusion operators then stand inside each other without end",
    ),
    "a growing seed stack": (
        "S -> SplitX(Rel, 1, A, Rel, 1, T)\nT -> RandStack(S)\nA -> Skip(0)", 2, 6, "RandStack operators then stand",
    ),
    "no rule": ("# nothing", 1, 1, "expected at least one rule"),
    "the same name": ("S -> Skip(0)\nS -> Skip(1)", 2, 1, "'S' is defined already, on line 1"),
    "an open parenthesis": ("S -> Skip(0\nT -> Skip(0)", 1, 10, "this '(' is not closed"),
    "no operator": ("S -> Wall\nWall -> Skip(0)", 1, 10, "expected '('; found the next rule, 'Wall'"),
    "quotation marks": ("S -> Mat(Color, 'wall1', 0, 0, 1, 1)", 1, 17, "names stand without quotation marks"),
    "an unknown parameter": ("S -> Layer(A(m = 1))\nA(n = 1) -> Skip(n)", 1, 14, "has no parameter 'm'"),
    "a parameter without value": (
        "S -> Layer(A)\nA(n) -> Skip(n)",
        1, 12, "needs a value for its parameter 'n'",
    ),
    "too many arguments": (
        "S -> Layer(A(1))\nA -> Skip(0)",
        1, 14, "the rule 'A' has no parameters; found 1",
    ),
    "copies without end": (
        "S -> Layer(A(1))\nA(n) -> RepeatX(n, A(n + 1))",
        2, 20, "makes copies of itself without end",
    ),
    "an unknown namespace": ("S -> Layer(a.S)", 1, 12, "there is no namespace 'a'"),
    "a copy of nothing": (
        "namespace b = a(x = 1)\nS -> Skip(0)",
        1, 15, "expected a namespace that stands above; found 'a'",
    ),
    "an unknown setting": (
        "namespace a { w = 1\n S -> Skip(w) }\nnamespace b = a(v = 1)", 3, 17, "the namespace 'a' has no setting 'v'",
    ),
    "a setting of itself": ("a = b\nb = a\nS -> Skip(0)", 1, 5, "needs itself"),
    "values for a setting": ("w = 1\nS -> Layer(w(2))", 2, 12, "'w' is a setting: it takes no values"),
    "a division by 0": ("S -> Skip(1 / 0)", 1, 15, "expected a divisor other than 0"),
    "a number too large": (
        "S -> RepeatX(1e9, A)\nA -> Skip(0)",
        1, 14, "a number that 16 bits can hold, at most 65504",
    ),
}  # fmt: skip


class TestFaults:
    @pytest.mark.parametrize("case", FAULTS)
    def test_has_its_place(self, case: str) -> None:
        text, line, column, message = FAULTS[case]
        found = [fault for fault in told(text) if message in fault[2]]
        assert [(fault[0], fault[1]) for fault in found][:1] == [(line, column)], told(text)

    @pytest.mark.parametrize("text", ["a = 1 / 0\nS -> Skip(a)", "namespace n { w = 1 / 0\n S -> Skip(w) }"])
    def test_a_setting_at_fault_is_one_fault(self, text: str) -> None:
        assert [message for _, _, message in told(text)] == ["expected a divisor other than 0"]

    def test_all_are_told_at_once(self) -> None:
        texts = [text for text, *_ in FAULTS.values() if text.startswith("S ->") and "\n" not in text]
        whole = "\n".join(text.replace("S ->", f"R{k} ->", 1) for k, text in enumerate(texts))
        lines = {line for line, _, _ in told(whole)}
        assert len(texts) > 10
        assert lines == set(range(1, len(texts) + 1))

    def test_stacks_deeper_than_the_shaders(self) -> None:
        nested = "\n".join(f"R{k} -> Layer(A, R{k + 1})" for k in range(13))
        ((line, _, message),) = told(f"{nested}\nR13 -> Skip(0)\nA -> Skip(0)")
        assert (line, message) == (14, "13 Layer operators inside each other lead here: expected at most 12")
        seeds = "\n".join(f"R{k} -> RandStack(R{k + 1})" for k in range(13))
        assert "13 RandStack operators" in told(f"{seeds}\nR13 -> Skip(0)")[0][2]
        rooms = "\n".join(f"R{k} -> Intrusion(1, A, A, R{k + 1}, A, A)" for k in range(7))
        assert "7 Intrusion operators" in told(f"{rooms}\nR7 -> Skip(0)\nA -> Skip(0)")[0][2]

    def test_more_steps_than_a_pixel_may_take(self) -> None:
        deep = "\n".join(f"R{k} -> Layer(R{k + 1}, R{k + 1}, R{k + 1})" for k in range(7))
        assert "steps from here: expected at most 1024" in told(f"{deep}\nR7 -> Skip(0)")[0][2]

    def test_recursion_that_shrinks_its_scope_is_fine(self) -> None:
        text = "S -> SplitX(Rel, 1, A, Rel, 1, T)\nT -> SplitY(Abs, 1, A, Abs, 1, S)\nA -> Skip(0)"
        assert len(rules(text)) == 3

    @pytest.mark.parametrize(
        "text", ["S -> Skip(" + "(" * 5000, "S -> Skip(" + "-" * 5001 + "1)", "\0", "S -> Skip(0)\ud800"]
    )
    def test_nonsense_is_no_traceback(self, text: str) -> None:
        with pytest.raises(GrammarError):
            Grammar.parse(text)

    def test_a_text_of_another_kind(self) -> None:
        """Reading stops after a while."""
        with pytest.raises(GrammarError) as caught:
            Grammar.parse("\n".join(f"rule{k} -> = {k} this is prose, not a grammar" for k in range(3000)))
        assert 1 <= len(caught.value.faults) <= 50

    def test_an_unknown_start_rule(self) -> None:
        with pytest.raises(DesignError, match="there is no rule 'Wal'; did you mean 'Wall'"):
            Grammar.parse("Wall -> Skip(0)").evaluate([(0, 0)], (1, 1), start="Wal")


@given(st.data())
@settings(max_examples=60)
def test_a_text_with_slips_is_read_or_refused(data: st.DataObject) -> None:
    """Pieces are cut out, doubled, or replaced: never anything but a grammar or faults with their place."""
    text = (
        FIGURE_12
        + "namespace a { w = 1\n T(n = w) -> RepeatX(n, Skip) }\nnamespace b = a(w = 2)\nU -> RandUni(0, a.T, b.T(3))\n"
    )
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(text)))
        cut = data.draw(st.integers(0, 12))
        piece = data.draw(
            st.one_of(
                st.sampled_from(
                    ["(", ")", "->", ",", "{", "}", "=", "S", "T(", "1e999", "/", "\\", "é", "\t", "-"]
                ),
                st.text(max_size=3),
            )
        )
        text = text[:at] + piece + text[at + cut :]
    try:
        grammar = Grammar.parse(text, stand_in())
    except GrammarError as error:
        assert all(fault.line and fault.column and fault.excerpt for fault in error.faults)
    else:
        assert grammar.evaluate([(1, 1)], (3, 3)).rule.shape == (1,)
