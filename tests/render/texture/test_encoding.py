"""The texture of Figure 3: every channel, the sums, the sizes, and the way back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings

from facade_nb.render import Grammar
from facade_nb.render.texture import OPERATORS, Rule, Source, decode, encode
from facade_nb.render.texture.operators import Kind

from .figure_12 import FIGURE_12
from .grammars import grammar_texts
from .stand_in import stand_in

REST = "\nA -> Skip(0)\nB -> Skip(1)\nC -> Skip(2)\nD -> Skip(3)\nE -> Skip(4)\n"


def first(text: str) -> tuple[list[list[float]], dict[str, tuple[int, int]]]:
    """Pixels of the first rule, and positions of A to E."""
    grammar = Grammar.parse(text + REST, stand_in())
    texture, rules = grammar.texture(), grammar.rules
    assert texture.dtype == np.float16
    positions = dict(zip((rule.name for rule in rules), grammar.encoding.positions, strict=True))
    assert positions["S"] == (0, 0)
    count = rules[0].operator.pixels(len(rules[0].parts))
    return texture[0, :count].tolist(), positions


def half(value: float) -> float:
    return float(np.float16(value))


class TestFigure3:
    """Codes and channels, as the figure prints them."""

    @pytest.mark.parametrize(("axis", "code"), [("X", 1), ("Y", 2)])
    def test_repeat(self, axis: str, code: int) -> None:
        pixels, at = first(f"S -> Repeat{axis}(1.3, B)")
        assert pixels == [[code, half(1.3), *at["B"]]]

    @pytest.mark.parametrize(("axis", "code"), [("X", 3), ("Y", 4)])
    def test_split(self, axis: str, code: int) -> None:
        pixels, at = first(f"S -> Split{axis}(Abs, 1.5, A, Rel, 2, B, Abs, 0.1, C, Rel, 0.5, D)")
        assert pixels == [
            [code, 4, 2.5, half(1.5 + half(0.1))],
            [-1.5, *at["A"], 0],
            [2, *at["B"], 0],
            [-half(0.1), *at["C"], 0],
            [0.5, *at["D"], 0],
        ]

    def test_rand(self) -> None:
        pixels, at = first("S -> Rand(2, 0.25, A, 0.5, B, 0.25, C)")
        assert pixels == [[5, 3, 2, 0], [0.25, *at["A"], 0], [0.75, *at["B"], 0], [1, *at["C"], 0]]

    def test_rand_uni(self) -> None:
        pixels, at = first("S -> RandUni(1, A, B, C)")
        assert pixels == [[6, 3, 1, 0], [*at["A"], *at["B"]], [*at["C"], 0, 0]]

    def test_rand_stack(self) -> None:
        pixels, at = first("S -> RandStack(D)")
        assert pixels == [[7, *at["D"], 0]]

    def test_layer(self) -> None:
        pixels, at = first("S -> Layer(E, A, B, C)")
        assert pixels == [[8, 4, 0, 0], [*at["E"], *at["A"]], [*at["B"], *at["C"]]]

    def test_skip(self) -> None:
        assert first("S -> Skip(7)")[0] == [[9, 7, 0, 0]]

    def test_skip_mask(self) -> None:
        assert first("S -> SkipMask(Fit:hole, 3, 1)")[0] == [[10, 1, 3, 1]]

    def test_intrusion(self) -> None:
        pixels, at = first("S -> Intrusion(2.5, A, B, C, D, E)")
        assert pixels == [[11, 2.5, *at["A"]], [*at["B"], *at["C"]], [*at["D"], *at["E"]]]

    def test_mat(self) -> None:
        assert first("S -> Mat(Color, 0, 0.5, 0.25, 1, 0)")[0] == [[12, 1, 0, 0], [0.5, 0.25, 1, 0]]
        assert first("S -> Mat(Specular, Rep:wall2, 0.5, 0, 2, 3)")[0] == [[12, 3, -1, 0], [0.5, 0, 2, 3]]

    def test_mat_alpha(self) -> None:
        pixels, _ = first("S -> MatAlpha(Normal, Rep:wall1, 1, 2, 3, 4, Fit:hole, 0, 0.25, 0.5, 1)")
        assert pixels == [[13, 2, -1, 2], [1, 2, 3, 4], [0, 0.25, 0.5, 1]]

    def test_every_operator_is_told_by_its_code(self) -> None:
        assert [operator.code for operator in OPERATORS.values()] == list(range(1, 14))


class TestSize:
    def test_figure_12(self) -> None:
        grammar = Grammar.parse(FIGURE_12, stand_in())
        assert grammar.report() == (
            "20 rules in 40 pixels, 320 bytes, of a texture of 8 × 6 with 4 channels of 16 bits"
        )
        assert grammar.texture().shape == (6, 8, 4)
        assert grammar.encoding.tiles == ("wall1", "wall2", "wall3", "window1", "window2", "window3")

    def test_a_rule_is_in_one_row(self) -> None:
        parts = ", ".join(f"Abs, {k}, A" for k in range(1, 40))
        grammar = Grammar.parse(f"S -> SplitX({parts})\nA -> Skip(0)\nB -> Skip(0)")
        assert grammar.texture().shape[1] == 64
        assert grammar.encoding.positions == ((0, 0), (40, 0), (41, 0))

    def test_a_larger_grammar_takes_32_bits_and_says_so(self) -> None:
        parts = ", ".join(["A"] * 2049)
        grammar = Grammar.parse(f"S -> RandUni(0, {parts})\nA -> Skip(0)")
        assert grammar.texture().dtype == np.float32
        assert "channels of 32 bits: it has whole numbers above 2048" in grammar.report()
        assert grammar.texture()[0, 0].tolist() == [6, 2049, 0, 0]
        assert decode(grammar.texture())[0].targets() == (1,) * 2049
        assert Grammar.parse("S -> Skip(3000)").texture().dtype == np.float32
        assert Grammar.parse("S -> Skip(2048)").texture().dtype == np.float16

    @pytest.mark.parametrize("policy", ["Abs", "Rel"])
    def test_sums_beyond_16_bits_take_32(self, policy: str) -> None:
        grammar = Grammar.parse(
            f"S -> SplitX({policy}, 40000, A, {policy}, 30000, B)\nA -> Skip(0)\nB -> Skip(0)"
        )
        assert grammar.texture().dtype == np.float32
        assert sorted(grammar.texture()[0, 0].tolist()) == [0, 2, 3, 70000]
        assert "sums above 65504" in grammar.report()

    def test_positions_are_exact_in_a_large_grammar(self) -> None:
        text = "\n".join(f"R{k} -> RandStack(R{k + 1})" for k in range(11))
        text += "\nR11 -> RandUni(0, " + ", ".join(f"M{k}" for k in range(5000)) + ")\n"
        text += "\n".join(f"M{k} -> Mat(Color, 0, {k % 9 / 8}, 0, 0, 1)" for k in range(5000))
        grammar = Grammar.parse(text)
        assert [rule.fixed for rule in decode(grammar.texture())] == [rule.fixed for rule in grammar.rules]
        assert max(grammar.texture().shape) <= 2501


def rounded(rule: Rule) -> Rule:
    """The rule with its sizes as 16 bits hold them, and without its weights."""

    def of(
        kinds: tuple[Kind, ...], values: tuple[float | int | Source, ...]
    ) -> tuple[float | int | Source, ...]:
        return tuple(
            value
            if isinstance(value, Source) or kind not in (Kind.SIZE, Kind.NUMBER, Kind.WEIGHT)
            else (0.0 if kind is Kind.WEIGHT else half(value))
            for kind, value in zip(kinds, values, strict=True)
        )

    fixed, part = (tuple(p.kind for p in params) for params in (rule.operator.fixed, rule.operator.part))
    return Rule(
        rule.name, rule.operator, of(fixed, rule.fixed), tuple(of(part, values) for values in rule.parts)
    )


@given(grammar_texts(rules=14))
@settings(max_examples=200)
def test_decoding_gives_the_grammar_back(text: str) -> None:
    grammar = Grammar.parse(text, stand_in())
    encoding = grammar.encoding
    found = decode(encoding.texture, encoding.names, encoding.tiles)
    assert [rounded(rule) for rule in found] == [rounded(rule) for rule in grammar.rules]
    for rule, original in zip(found, grammar.rules, strict=True):
        if rule.operator.name == "Rand":
            assert [part[0] for part in rule.parts] == pytest.approx(
                [part[0] for part in original.parts], abs=5e-4
            )
    again = encode(found)
    assert again.positions == encoding.positions and again.tiles == encoding.tiles
    assert again.texture.tobytes() == encoding.texture.tobytes()


def test_what_16_bits_hold_comes_back_as_it_was() -> None:
    text = "S -> Rand(1, 0.25, A, 0.75, B)\nA -> SplitY(Abs, 2.5, B, Rel, 0.125, B)\n"
    text += "B -> Mat(Color, Fit:hole, 0, 0, 1, 1)"
    grammar = Grammar.parse(text, stand_in())
    assert decode(grammar.texture(), grammar.encoding.names, grammar.encoding.tiles) == grammar.rules


def test_a_texture_that_holds_no_grammar_is_refused() -> None:
    with pytest.raises(ValueError, match="pixel 0, 0: expected an operator's code; found 99"):
        decode(np.full((1, 1, 4), 99, np.float16))
    with pytest.raises(ValueError, match="expected the position of a rule; found 5, 5"):
        decode(np.array([[[7, 5, 5, 0]]], np.float16))
