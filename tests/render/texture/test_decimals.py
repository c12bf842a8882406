"""What fits by the decimals that were written fits: repeats, splits, and both inside each other."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb.render import Grammar
from facade_nb.render.texture.dividing import half_step, repeated
from facade_nb.render.texture.evaluating import evaluate
from facade_nb.render.texture.gl import OSMESA
from facade_nb.render.texture.steps import Divided
from facade_nb.render.texture.view import Looks

PAINTS = "".join(
    f"\n{name} -> Mat(Color, 0, {k % 2}, {k // 2 % 2}, {k // 4}, 1)" for k, name in enumerate("ABCDE")
)
COUNTS = np.arange(1, 61)
ZERO = np.zeros(1, np.float32)


def decimals(digits: int) -> np.ndarray[tuple[int], np.dtype[np.int_]]:
    """Sizes from the smallest decimal to 10 m, in units of the last digit; of thousandths one in seven, to 4 m."""
    return np.arange(1, 4000, 7) if digits == 3 else np.arange(1, 10 * 10**digits)


def divided(text: str, point: float, size: float, axis: int = 0) -> list[tuple[int, int, float, float]]:
    """Part, number of parts, and both ends, of each division on the way of a point."""
    return divisions(Grammar.parse(text + PAINTS), point, size, axis)


def divisions(
    grammar: Grammar, point: float, size: float, axis: int = 0
) -> list[tuple[int, int, float, float]]:
    where, extent = ((point, 0.5), (size, 1.0)) if axis == 0 else ((0.5, point), (1.0, size))
    steps = [step for step in grammar.steps(where, extent) if isinstance(step, Divided)]
    return [(step.part, step.count, step.low, step.high) for step in steps]


@pytest.mark.parametrize("bits", [16, 32])
@pytest.mark.parametrize("digits", [1, 2, 3])
class TestDecimals:
    """As the texture holds them, times 1 to 60."""

    def test_as_many_as_fit(self, digits: int, bits: int) -> None:
        for units in decimals(digits):
            held = float(np.dtype(f"f{bits // 8}").type(units / 10**digits))
            sizes = (units * COUNTS / 10**digits).astype(np.float32)
            assert (repeated(0 * sizes, sizes, ZERO, held, bits) == COUNTS).all(), (units, digits)

    def test_one_more_as_soon_as_half_a_step_does_not_explain_it(self, digits: int, bits: int) -> None:
        for units in decimals(digits):
            held = np.full(1, units / 10**digits, f"f{bits // 8}").astype(np.float32)
            largest = (held + half_step(held, bits)).astype(np.float64)
            sizes = (np.maximum(COUNTS * largest, COUNTS * units / 10**digits) * (1 + 2e-6)).astype(
                np.float32
            )
            told = COUNTS * (largest - held) < 0.4 * held  # else another number explains it as well
            assert (repeated(0 * sizes, sizes, ZERO, float(held[0]), bits) == COUNTS + 1)[told].all()


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize(
    ("v", "size", "count"),
    [
        (3.2, 16, 5),
        (2.2, 6.6, 3),
        (2.6, 18.2, 7),
        (3.1, 24.8, 8),
        (1.1, 3.3, 3),
        (3.2, 16.1, 6),
        (0.1, 6, 60),
    ],
)
def test_repeats(axis: int, v: float, size: float, count: int) -> None:
    text = f"S -> Repeat{'XY'[axis]}({v}, A)"
    assert divided(text, size / 3, size, axis)[0][1] == count


class TestSplits:
    @pytest.mark.parametrize(
        ("text", "size", "ends"),
        [
            ("Abs, 1.1, A, Rel, 1, B, Abs, 2.2, C", 3.3, [1.1, 1.1, 3.3]),
            ("Abs, 1.1, A, Abs, 2.2, B, Rel, 1, C", 3.3, [1.1, 3.3, 3.3]),
            ("Rel, 1, A, Abs, 1.1, B, Abs, 2.2, C", 3.3, [0, 1.1, 3.3]),
            ("Abs, 20, A, Abs, 0.005, B", 20.005, [20, 20.005]),
            ("Abs, 20, A, Abs, 0.005, B, Rel, 1, C", 20.005, [20, 20.005, 20.005]),
            ("Abs, 3.3, A, Abs, 3.3, B, Abs, 3.3, C", 6.6, [3.3, 6.6, 6.6]),
            ("Abs, 3.4, A, Abs, 3.4, B, Abs, 3.4, C", 6.8, [3.4, 6.8, 6.8]),
            ("Abs, 1.1, A, Rel, 1, B, Abs, 2.2, C", 3.31, [1.1, 1.11, 3.31]),
            ("Abs, 3.3, A, Abs, 3.3, B, Abs, 3.3, C", 6.62, [3.3, 6.6, 6.62]),
            ("Abs, 3.3, A, Abs, 3.3, B", 6.7, [3.3, 6.7]),
        ],
    )
    def test_no_sliver_and_no_part_lost(self, text: str, size: float, ends: list[float]) -> None:
        """Every part is where it was meant to be, but for what 16 bits round; one that is empty is never seen."""
        starts = [0.0, *ends[:-1]]
        grammar = Grammar.parse(f"S -> SplitX({text}){PAINTS}")
        x = np.linspace(
            0, size, 2001, dtype=np.float32
        )  # a sliver is wider than what stands between two of these
        rules = grammar.evaluate(np.stack([x, 0 * x + 0.5], axis=1), (size, 1)).rule - 1
        assert set(rules.tolist()) == {k for k in range(len(ends)) if ends[k] - starts[k] > 1e-9}
        for k in set(rules.tolist()):
            within = x[rules == k]
            for at in (within[0], within[len(within) // 2], within[-1]):
                ((part, _, low, high),) = divisions(grammar, float(at), size)
                assert part == k
                assert low == pytest.approx(starts[part], abs=0.0041 if size < 8 else 0.02)
                assert high == pytest.approx(ends[part], abs=0.0041 if size < 8 else 0.02)

    @given(st.data())
    @settings(max_examples=50, deadline=None)
    def test_absolutes_that_add_up(self, data: st.DataObject) -> None:
        """The last part is whole, relative ones between them are empty, wherever they stand."""
        digits = data.draw(st.sampled_from([1, 2, 3]))
        units = data.draw(st.lists(st.integers(10**digits // 10, 9 * 10**digits), min_size=1, max_size=9))
        words = [f"Abs, {n / 10**digits}, A" for n in units]
        for _ in range(data.draw(st.integers(0, 2))):
            words.insert(data.draw(st.integers(0, len(words))), "Rel, 1, B")
        size = sum(units) / 10**digits
        grammar = Grammar.parse(f"S -> SplitX({', '.join(words)}){PAINTS}")
        x = np.concatenate(
            [np.linspace(0, size, 499), np.nextafter(np.float32(size), 0, dtype=np.float32)[None]]
        )
        surface = grammar.evaluate(np.stack([x, 0 * x + 0.5], axis=1), (size, 1))
        assert (surface.rule == 1).all()
        (last,) = (s for s in grammar.steps((size, 0.5), (size, 1)) if isinstance(s, Divided))
        wanted = units[-1] / 10**digits
        assert last.high - last.low == pytest.approx(wanted, rel=2e-3, abs=1e-4)


@st.composite
def towers(draw: st.DrawFn) -> tuple[str, Fraction, Fraction, int]:
    """Divisions inside each other, on decimals; the last one repeats what fits exactly so often.

    Text, size of the façade, a point in the part that is repeated, and how often.
    """
    digits = draw(st.sampled_from([1, 2]))
    unit = Fraction(1, 10**digits)
    tens = st.integers(10**digits // 5, 4 * 10**digits).map(lambda n: n * unit)
    v, count = draw(tens), draw(st.integers(1, 30))
    size = inside = v * count
    at = size / 2
    lines = [f"R0 -> RepeatX({float(v)}, A)"]
    for level in range(1, draw(st.integers(1, 3)) + 1):
        kind = draw(st.sampled_from(["absolute", "rest", "between", "last", "relative", "repeat"]))
        near, far = draw(tens), draw(tens)
        below = f"R{level - 1}"
        if kind == "absolute":
            body, size = (
                f"SplitX(Abs, {float(near)}, B, Abs, {float(size)}, {below}, Rel, 1, C)",
                near + size + far,
            )
            at += near
        elif kind == "rest":
            body, size, at = f"SplitX(Abs, {float(near)}, B, Rel, 1, {below})", near + size, at + near
        elif kind == "between":
            body = f"SplitX(Abs, {float(near)}, B, Rel, 0.7, {below}, Abs, {float(far)}, C)"
            size, at = near + size + far, at + near
        elif kind == "last":
            body = f"SplitX(Abs, {float(near)}, B, Abs, {float(size)}, {below})"
            size, at = near + size, at + near
        elif kind == "relative":
            body = f"SplitX(Rel, {float(near)}, B, Rel, {float(size)}, {below}, Rel, {float(far)}, C)"
            size, at = near + size + far, at + near
        else:
            times = draw(st.integers(1, 3))
            body, size = f"RepeatX({float(size)}, {below})", size * times
        lines.append(f"R{level} -> {body}")
    lines.append(f"S -> Layer(R{len(lines) - 1})")
    assert inside > 0
    return "\n".join(lines), size, at, count


@given(towers())
@settings(max_examples=80, deadline=None)
def test_repeats_inside_splits(tower: tuple[str, Fraction, Fraction, int]) -> None:
    text, size, at, count = tower
    assert divided(text, float(at), float(size))[-1][1] == count, text


def test_a_size_that_is_truly_larger_inside_a_split() -> None:
    """0.9 and 1.2 leave 16.1, which is six times 3.2, not five."""
    text = "S -> SplitX(Abs, 0.9, A, Rel, 1, M, Abs, 1.2, A)\nM -> RepeatX(3.2, B)"
    assert divided(text, 9, 0.9 + 16 + 1.2)[-1][1] == 5
    assert divided(text, 9, 0.9 + 16.1 + 1.2)[-1][1] == 6
    text = "S -> SplitX(Abs, 16.2, M, Rel, 1, A)\nM -> RepeatX(2.3, B)"
    assert divided(text, 9, 20)[-1][1] == 8
    assert divided(text.replace("16.2", "16.1"), 9, 20)[-1][1] == 7


class TestInGlsl:
    """The shader makes the same parts: each is painted by chance, so that another number of them is seen."""

    PART = "\nT -> RandUni(0, A, B, C, D)" + PAINTS

    def same(self, text: str, size: float) -> None:
        grammar = Grammar.parse(text + self.PART)
        x = (np.arange(6000, dtype=np.float32) + 0.5) * np.float32(size / 6000)
        points = np.stack([x, 0 * x + 0.5], axis=1)
        question = grammar.question((size, 1), (3, 4))
        margin = np.zeros(len(x), np.float32)
        wanted = evaluate(question, points, footprint=np.full(len(x), 1e-4, np.float32), margin=margin).rule
        looks = Looks(points, None, np.zeros(len(x), np.float32), 0.0, np.ones(len(x), bool))
        found = OSMESA.paint_at(question, looks).surface.rule
        assert (found == wanted)[margin > 1].all(), (text, size)

    @pytest.mark.parametrize("wide", [False, True])
    def test_repeats(self, wide: bool) -> None:
        more = "\nW -> Skip(3000)" if wide else ""  # a level that takes 32 bits
        for v, count in [(3.2, 5), (2.2, 3), (2.6, 7), (3.1, 8), (1.1, 3), (0.7, 60), (0.1, 49), (9.99, 37)]:
            for size in (v * count, v * count * 1.01):
                self.same(f"S -> RepeatX({v}, T){more}", size)

    @pytest.mark.parametrize(
        ("text", "size"),
        [
            ("Abs, 1.1, T, Rel, 1, T, Abs, 2.2, T", 3.3),
            ("Abs, 1.1, T, Abs, 2.2, T, Rel, 1, T", 3.3),
            ("Abs, 3.3, T, Abs, 3.3, T, Abs, 3.3, T", 6.6),
            ("Abs, 20, T, Abs, 0.005, T, Rel, 1, T", 20.005),
            ("Abs, 0.9, T, Rel, 1, R, Abs, 1.2, T", 18.1),
            ("Rel, 0.3, R, Rel, 1.6, R, Rel, 0.1, T", 20),
            ("Abs, 6.4, R, Abs, 9.6, R", 16),
        ],
    )
    def test_splits(self, text: str, size: float) -> None:
        self.same(f"S -> SplitX({text})\nR -> RepeatX(3.2, T)", size)

    @given(towers())
    @settings(max_examples=25, deadline=None)
    def test_repeats_inside_splits(self, tower: tuple[str, Fraction, Fraction, int]) -> None:
        text, size, _, _ = tower
        self.same(text.replace(", A)", ", T)"), float(size))
