"""The NumPy evaluator against one made from docs/texture.md and the paper alone, and against known answers."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb.design.errors import GrammarError
from facade_nb.render.texture import Grammar
from facade_nb.render.texture.steps import Painted

from .brute import answer
from .grammars import grammar_texts, rays
from .stand_in import stand_in

SIZE = (7.0, 5.0)
MARGIN = 2e-4


def points(count: int, size: tuple[float, float] = SIZE, seed: int = 1) -> np.ndarray:
    return np.random.Generator(np.random.PCG64(seed)).random((count, 2)) * size


@given(grammar_texts(), rays(), st.tuples(st.integers(-999, 999), st.integers(-999, 999)), st.integers(0, 9))
@settings(max_examples=120)
def test_as_the_brute_force_evaluator(
    text: str, ray: tuple[float, float, float], steps: tuple[int, int], number: int
) -> None:
    tiles, seed = stand_in(), (steps[0] / 8, steps[1] / 10)
    grammar = Grammar.parse(text, tiles)
    asked = points(60, seed=number)
    surface = grammar.evaluate(asked, SIZE, seed, rays=np.tile(ray, (len(asked), 1)))
    for k, point in enumerate(asked.astype(np.float32).astype(float)):
        wanted = answer(grammar, tiles, tuple(point), SIZE, seed, ray=ray)
        if wanted.margin < MARGIN:
            continue
        assert surface.rule[k] == wanted.rule
        for array, usage in zip(surface, "cns", strict=False):
            assert np.abs(array[k] - wanted.totals[usage]).max() < 3e-3


def rule_at(
    text: str, *at: tuple[float, float], size: tuple[float, float] = (6, 3), **options: object
) -> list[str]:
    """Names of the rules seen at points; ``-`` for none. K, R, G, B are colours, H half-transparent red."""
    grammar = Grammar.parse(text + COLOURS, stand_in())
    names = [rule.name for rule in grammar.rules]
    found = grammar.evaluate(np.array(at), size, **options)  # type: ignore[arg-type]
    return [names[i] if i >= 0 else "-" for i in found.rule]


def color_at(text: str, at: tuple[float, float] = (1, 1)) -> list[float]:
    return Grammar.parse(text + COLOURS, stand_in()).evaluate([at], (6, 3)).color[0].tolist()


COLOURS = """
K -> Mat(Color, 0, 0, 0, 0, 1)
R -> Mat(Color, 0, 1, 0, 0, 1)
G -> Mat(Color, 0, 0, 1, 0, 1)
B -> Mat(Color, 0, 0, 0, 1, 1)
H -> Mat(Color, 0, 1, 0, 0, 0.5)
N -> Mat(Normal, 0, 1, 0.5, 0.5, 1)
Skip -> Skip(0)
"""
ROW = [(x, 1.0) for x in (0.5, 1.5, 2.5, 3.5, 4.5, 5.5)]


class TestSplit:
    def test_equation_1(self) -> None:
        assert rule_at("S -> SplitX(Rel, 1, R, Abs, 2, G, Rel, 3, B)", *ROW) == ["R", "G", "G", "B", "B", "B"]

    def test_along_y_the_first_part_is_at_the_bottom(self) -> None:
        assert rule_at("S -> SplitY(Abs, 1, R, Rel, 1, G)", (1, 0.5), (1, 1.5)) == ["R", "G"]

    def test_parts_that_do_not_fit_are_clamped_from_the_end(self) -> None:
        text = "S -> SplitX(Rel, 1, K, Abs, 4, R, Rel, 1, K, Abs, 4, G, Abs, 1, B)"
        assert rule_at(text, *ROW) == ["R", "R", "R", "R", "G", "G"]

    def test_what_absolute_parts_leave_belongs_to_the_last(self) -> None:
        assert rule_at("S -> SplitX(Abs, 1, R, Abs, 2, G)", *ROW) == ["R", "G", "G", "G", "G", "G"]

    def test_the_far_edge_belongs_to_the_last_part_that_is_there(self) -> None:
        assert rule_at("S -> SplitX(Abs, 6, R, Abs, 1, G)", (0, 0), (6, 3)) == ["R", "R"]
        assert rule_at("S -> SplitX(Abs, 2, R, Rel, 1, G)", (2, 1), (6, 3)) == ["G", "G"]


class TestRepeat:
    @pytest.mark.parametrize(
        ("size", "count"),
        [(2.0, 3), (2.5, 3), (1.9, 4), (7.0, 1), (6.0, 1), (5.999, 1), (5.995, 2), (0.5, 12)],
    )
    def test_as_many_parts_as_it_says(self, size: float, count: int) -> None:
        text = f"S -> RepeatX({size}, T)\nT -> SplitX(Rel, 1, R, Rel, 1, G)"
        x = (np.arange(600) + 0.5) / 100
        names = rule_at(text, *[(v, 1) for v in x])
        assert sum(a != b for a, b in itertools.pairwise(names)) == 2 * count - 1
        assert names.count("R") == pytest.approx(300, abs=count)

    def test_the_rounding_of_16_bits_makes_no_sliver(self) -> None:
        """1.4 is 1.4004 in 16 bits and 0.7 is 0.7002, 2.8 is 2.8008; 1.3 is 1.2998: without slack one part too many."""
        text = "S -> RepeatX(1.3, T)\nT -> SplitX(Rel, 1, R, Rel, 1, G)"
        names = rule_at(text, *[(v, 1) for v in (np.arange(520) + 0.5) / 100], size=(5.2, 3))
        assert sum(a != b for a, b in itertools.pairwise(names)) == 7


class TestLayers:
    def test_equations_2_and_3(self) -> None:
        assert color_at("S -> Layer(B, H)") == pytest.approx([0.5, 0, 0.5, 1])
        assert color_at("S -> Layer(B, H, H)") == pytest.approx([0.75, 0, 0.25, 1])
        assert color_at("S -> Layer(H, G)") == pytest.approx([0, 1, 0, 1])
        assert color_at("S -> Layer(H)") == pytest.approx([0.5, 0, 0, 0.5])

    def test_normal_and_specular_have_an_alpha_of_their_own(self) -> None:
        grammar = Grammar.parse("S -> Layer(B, N, M)\nM -> Mat(Normal, 0, 0, 1, 0.5, 0.25)" + COLOURS)
        surface = grammar.evaluate([(1, 1)], (6, 3))
        assert surface.color[0].tolist() == [0, 0, 1, 1]
        assert surface.normal[0].tolist() == pytest.approx([0.75, 0.625, 0.5, 1])
        assert surface.specular[0].tolist() == [0, 0, 0, 0]

    def test_nothing_is_gathered_below_opaque_colour(self) -> None:
        surface = Grammar.parse("S -> Layer(N, B)" + COLOURS).evaluate([(1, 1)], (6, 3))
        assert surface.normal[0].tolist() == [0, 0, 0, 0]

    @pytest.mark.parametrize(
        ("text", "seen"),
        [
            ("S -> Layer(R, G, A)\nA -> Skip(0)", "G"),
            ("S -> Layer(R, G, A)\nA -> Skip(1)", "R"),
            ("S -> Layer(R, G, A)\nA -> Skip(2)", "-"),
            ("S -> Layer(K, R, G, A)\nA -> Layer(B, B, C)\nC -> Skip(1)", "B"),
            ("S -> Layer(K, R, G, A)\nA -> Layer(B, B, C)\nC -> Skip(2)", "G"),
            ("S -> Layer(K, R, G, A)\nA -> Layer(B, B, C)\nC -> Skip(3)", "R"),
            ("S -> Layer(K, R, G, A)\nA -> Layer(B, C)\nC -> Layer(B, D)\nD -> Skip(3)", "R"),
            ("S -> Layer(R, A)\nA -> Layer(Skip, Skip)", "R"),
            ("S -> Skip(3)", "-"),
        ],
    )
    def test_skip(self, text: str, seen: str) -> None:
        assert rule_at(text, (1, 1)) == [seen]

    def test_a_mask(self) -> None:
        """``hole`` is white in columns 3 to 9 of 12 from the left, rows 2 to 8 from the top."""
        text = "S -> Layer(R, G, M)\nM -> SkipMask(Fit:hole, 0, 1)"
        assert rule_at(text, (3, 1.7), (0.5, 1.7), (5.5, 1.7), (3, 0.2), (3, 2.9)) == [
            "R",
            "G",
            "G",
            "G",
            "G",
        ]
        assert rule_at(text, (1.51, 1.7), (1.49, 1.7), (4.99, 1.7), (5.01, 1.7)) == ["R", "G", "R", "G"]

    def test_the_mask_of_a_tile_with_alpha_is_its_alpha(self) -> None:
        assert rule_at("S -> Layer(R, G, M)\nM -> SkipMask(Fit:disc, 0, 1)", (3, 1.5), (0.2, 0.2)) == [
            "R",
            "G",
        ]
        assert color_at("S -> MatAlpha(Color, 0, 1, 1, 1, 0.5, Fit:disc, 0, 0, 1, 1)", (3, 1.5))[3] == 0.5
        assert color_at("S -> MatAlpha(Color, 0, 1, 1, 1, 0.5, 0, 1, 1, 1, 0.5)")[3] == 0.25


class TestChance:
    def test_the_random_number_is_that_of_the_corner(self) -> None:
        """The same corner, reached in other ways, has the same number; elsewhere others come."""
        choice = "C -> RandUni(0, R, G, B)"
        one = rule_at(f"S -> RepeatX(1, C)\n{choice}", *ROW)
        other = rule_at(
            f"S -> SplitX(Abs, 1, C, Abs, 1, C, Abs, 1, C, Rel, 1, T)\nT -> RepeatX(1, C)\n{choice}", *ROW
        )
        assert one == other and len(set(one)) > 1

    def test_frequencies(self) -> None:
        text = "S -> RepeatX(0.125, Y)\nY -> RepeatY(0.125, C)\nC -> Rand(0, 0.5, R, 0.2, G, 0.3, B)"
        x, y = np.meshgrid((np.arange(160) + 0.5) / 8, (np.arange(160) + 0.5) / 8)
        names = rule_at(text, *np.stack([x.ravel(), y.ravel()], 1), size=(20, 20), seed=(5.5, 17))
        for name, share in (("R", 0.5), ("G", 0.2), ("B", 0.3)):
            assert names.count(name) / len(names) == pytest.approx(share, abs=0.01)

    def test_it_does_not_repeat_every_four_metres(self) -> None:
        """The noise texture has 256 texels at 1/64 m."""
        names = rule_at(
            "S -> RepeatX(4, C)\nC -> RandUni(0, R, G)", *[(4 * k + 1, 1) for k in range(40)], size=(160, 3)
        )
        assert 10 < names.count("R") < 30

    def test_groups(self) -> None:
        """Figure 6: with l = 1 a floor agrees, with l = 2 the house does, with l = 0 nothing does."""
        text = """
        S -> RandStack(House)
        House -> RepeatY(0.5, Floor)
        Floor -> RandStack(Row)
        Row -> RepeatX(0.5, C)
        C -> RandUni({}, R, G, B, K)
        """
        at = [(x / 2 + 0.2, y / 2 + 0.2) for y in range(6) for x in range(12)]
        rows = {level: np.array(rule_at(text.format(level), *at)).reshape(6, 12) for level in (0, 1, 2)}
        assert len(set(rows[2].ravel())) == 1
        assert all(len(set(row)) == 1 for row in rows[1]) and len(set(rows[1][:, 0])) > 1
        assert all(len(set(row)) > 1 for row in rows[0])

    def test_a_seed_moves_the_corner(self) -> None:
        """With seed s, a façade looks as the part of a larger one from s on does."""
        text = "S -> RepeatX(1, Y)\nY -> RepeatY(1, C)\nC -> RandUni(0, R, G, B, K)"
        at = [(x + 0.5, y + 0.5) for x in range(6) for y in range(3)]
        moved = rule_at(text, *at, seed=(4, 2))
        assert moved == rule_at(text, *[(x + 4, y + 2) for x, y in at], size=(10, 5))
        assert moved != rule_at(text, *at)

    def test_a_large_seed_costs_no_precision(self) -> None:
        text = "S -> RepeatX(0.046875, C)\nC -> RandUni(0, R, G, B, K)"  # three steps each
        at = [(0.046875 * (k + 0.5), 1) for k in range(128)]
        for seed in ((2.0**30 + 0.25, -(2.0**33)), (123456789.015625, 5e12)):
            assert len(set(rule_at(text, *at, seed=seed))) == 4
            assert rule_at(text, *at, seed=seed) == rule_at(text, *at, seed=(seed[0] + 2.0**26, seed[1]))

    def test_layers_differ_by_the_seed(self) -> None:
        """Layer i looks up at the corner plus (1 + i) seeds."""
        text = "S -> Layer({}, C)\nC -> RepeatX(1, D)\nD -> RandUni(0, R, G, B, K)"
        alone = "S -> RepeatX(1, D)\nD -> RandUni(0, R, G, B, K)"
        assert rule_at(text.format("K"), *ROW, seed=(1, 3)) == rule_at(alone, *ROW, seed=(3, 9))
        assert rule_at(
            "S -> Layer(C)\nC -> RepeatX(1, D)\nD -> RandUni(0, R, G, B, K)", *ROW, seed=(1, 3)
        ) == rule_at(alone, *ROW, seed=(2, 6))

    def test_a_stack_that_is_too_short_gives_its_oldest_corner(self) -> None:
        text = "S -> RandStack(T)\nT -> RepeatX(1, C)\nC -> RandUni({}, R, G, B, K)"
        assert rule_at(text.format(3), *ROW) == rule_at(text.format(1), *ROW)
        assert rule_at("S -> RepeatX(1, C)\nC -> RandUni(2, R, G, B, K)", *ROW) == rule_at(
            "S -> RepeatX(1, C)\nC -> RandUni(0, R, G, B, K)", *ROW
        )


class TestMaterials:
    def test_a_repeated_tile_meets_itself_without_a_seam(self) -> None:
        """Two scopes show the same as one: the tile is anchored at the façade's corner."""
        paint = "P -> Mat(Color, Rep:wall2, 0.25, 0.5, 0.7, 1.3)"
        at = points(50)
        one = Grammar.parse(f"S -> Layer(P)\n{paint}", stand_in()).evaluate(at, SIZE)
        two = Grammar.parse(f"S -> RepeatX(0.9, T)\nT -> SplitY(Rel, 1, P, Rel, 2, P)\n{paint}", stand_in())
        assert np.abs(one.color - two.evaluate(at, SIZE).color).max() < 1e-5

    def test_repeats_per_metre(self) -> None:
        paint = Grammar.parse("S -> Mat(Color, Rep:wall3, 0.125, 0, 0.5, 2)", stand_in())
        texel = stand_in().image("wall3").astype(float) / 255
        u, v = 2.5 / 8, 1.5 / 8  # the middle of column 2, row 1 from below; the offset is one column
        found = paint.evaluate(
            [((u - 0.125) / 0.5, v / 2), ((u - 0.125 + 3) / 0.5, (v + 2) / 2)], (20, 20)
        ).color
        assert np.abs(found - texel[6, 2]).max() < 1e-5

    def test_a_part_of_a_tile(self) -> None:
        paint = Grammar.parse("S -> Mat(Color, Fit:wall3, 0.5, 0.25, 1, 0.75)", stand_in())
        texel = stand_in().image("wall3").astype(float) / 255
        found = paint.evaluate([(6 * 0.125, 3 * 0.125), (6 * 0.875, 3 * 0.875)], (6, 3)).color
        assert np.abs(found - [texel[5, 4], texel[2, 7]]).max() < 1e-5


class TestRecursion:
    def test_it_ends(self) -> None:
        """A scope that is halved ends where 32 bits cannot halve it; one that loses a little ends with its room."""
        halves = "S -> SplitX(Rel, 1, R, Rel, 1, T)\nT -> SplitX(Rel, 1, G, Rel, 1, S)"
        assert rule_at(halves, (1, 1), (4, 1), (5, 1)) == ["R", "G", "R"]
        assert rule_at(halves, (6, 1))[0] in ("R", "G", "-")
        steps = "S -> SplitX(Abs, 0.25, R, Abs, 0.25, G, Rel, 1, S)"
        assert rule_at(steps, (0.2, 1), (0.3, 1), (5.6, 1), (5.9, 1)) == ["R", "G", "R", "G"]

    def test_points_that_recursion_parts_are_joined_again(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """Else each of the 2000 points would soon be a batch of its own, for 40 steps and more."""
        from facade_nb.render.texture.evaluating import _Run

        counted = []
        real = _Run._count
        monkeypatch.setattr(_Run, "_count", lambda run, batch: counted.append(1) or real(run, batch))
        text = "S -> SplitX(Rel, 1, T, Rel, 1, U)\nT -> SplitY(Rel, 1, S, Rel, 1, S)\nU -> SplitY(Rel, 1, S, Rel, 1, V)"
        text += "\nV -> RandStack(W)\nW -> RandUni(1, R, G)"
        places = points(2000)
        found = Grammar.parse(f"{text}\n{COLOURS}", stand_in()).evaluate(places, SIZE, (1, 2))
        assert len(counted) < 3000
        for k in range(0, 2000, 97):
            alone = Grammar.parse(f"{text}\n{COLOURS}", stand_in()).evaluate(places[k : k + 1], SIZE, (1, 2))
            assert alone.rule[0] == found.rule[k]
        assert len(set(found.rule.tolist())) > 1

    def test_steps_are_bounded(self) -> None:
        tiny = "S -> SplitX(Abs, 0.001, R, Rel, 1, S)"
        assert rule_at(tiny, (0.5, 1), (5, 1)) == ["R", "-"]


class TestSteps:
    TEXT = """
    S -> Layer(R, Windows)
    Windows -> RandStack(Floor)
    Floor -> RepeatX(2, Tile)
    Tile -> SplitX(Rel, 1, Skip, Abs, 1, Pane, Rel, 1, Skip)
    Pane -> RandUni(1, Room, Room)
    Room -> Intrusion(1, R, N, R, R, R)
    """

    def test_a_derivation(self) -> None:
        grammar = Grammar.parse(self.TEXT + COLOURS, stand_in())
        steps = grammar.steps((3, 1), (6, 3), seed=(1, 0), ray=(0, 0, -1))
        assert [(type(s).__name__, s.name) for s in steps] == [
            ("Layered", "S"), ("Stacked", "Windows"), ("Divided", "Floor"), ("Divided", "Tile"), ("Chosen", "Pane"),
            ("Entered", "Room"), ("Painted", "N"), ("Layered", "S"), ("Painted", "R"),
        ]  # fmt: skip
        layered, stacked, floor, tile, chosen, entered, painted, again, below = steps
        assert layered.layer == 2 and again.layer == 1 and again.records == ()  # type: ignore[attr-defined]
        assert layered.records == ((0, 0), (1, 0))
        assert stacked.corner == (3 * 64, 0) and stacked.layers == ((0, 2),)  # type: ignore[attr-defined]
        assert floor.scope == (0, 0, 6, 3) and floor.seeds == ((192, 0),)
        assert (floor.part, floor.count, floor.low, floor.high) == (1, 3, 2, 4)  # type: ignore[attr-defined]
        assert tile.scope == (2, 0, 4, 3) and (tile.part, tile.low, tile.high) == (1, 2.5, 3.5)  # type: ignore[attr-defined]
        place = grammar.encoding.positions[3]
        assert tile.records == tuple((place[0] + k, place[1]) for k in range(3))
        assert chosen.corner == (192, 0) and 0 <= chosen.random < 1  # type: ignore[attr-defined]
        assert (entered.face, entered.depth) == ("back", 1)  # type: ignore[attr-defined]
        assert painted.faces == ("back",) and painted.scope == (2.5, 0, 3.5, 3) and painted.usage == "Normal"  # type: ignore[attr-defined]
        assert below.scope == (0, 0, 6, 3) and below.total == (1, 0, 0, 1)  # type: ignore[attr-defined]

    @given(grammar_texts(), rays(), st.integers(0, 50))
    @settings(max_examples=60)
    def test_a_point_alone_and_among_others(
        self, text: str, ray: tuple[float, float, float], number: int
    ) -> None:
        """Its steps end in what `evaluate` gives, and read only what is there."""
        grammar = Grammar.parse(text, stand_in())
        at = points(30, seed=number)
        surface = grammar.evaluate(at, SIZE, (3, 4), rays=np.tile(ray, (30, 1)))
        height, width = grammar.texture().shape[:2]
        for k in range(3):
            steps = grammar.steps(tuple(at[k]), SIZE, (3, 4), ray=ray)
            paints = [s for s in steps if isinstance(s, Painted) and s.usage == "Color"]
            assert tuple(surface.color[k]) == (paints[-1].total if paints else (0, 0, 0, 0))
            seen = next((s.rule for s in paints if s.value[3] > 0), -1)
            assert surface.rule[k] == seen
            assert all(0 <= x < width and 0 <= y < height for s in steps for x, y in s.records)
            assert all(len(set(s.records)) == len(s.records) for s in steps)


class TestArguments:
    def test_shapes_and_numbers(self) -> None:
        grammar = Grammar.parse("S -> Skip(0)")
        for points_, rays_ in (
            ([1, 2], None),
            ([[1, 2, 3]], None),
            ([[1, np.nan]], None),
            ([[1, 2]], [[0, 0, -1]] * 2),
        ):
            with pytest.raises(ValueError, match="expected"):
                grammar.evaluate(points_, (1, 1), rays=rays_)
        for size in ((0, 1), (1, -1), (np.inf, 1)):
            with pytest.raises(ValueError, match="size: expected"):
                grammar.evaluate([[0, 0]], size)

    def test_no_points(self) -> None:
        surface = Grammar.parse("S -> Skip(0)").evaluate(np.zeros((0, 2)), (1, 1))
        assert surface.color.shape == (0, 4) and surface.rule.shape == (0,)

    def test_other_tiles(self) -> None:
        grammar = Grammar.parse("S -> Mat(Color, Fit:wall1, 0, 0, 1, 1)")
        assert (
            grammar.evaluate([(1, 1)], (2, 2), tiles=stand_in()).color
            != grammar.evaluate([(1, 1)], (2, 2)).color
        ).any()

        class Few:
            names = ("wall",)

            def mips(self, name: str) -> list[np.ndarray]:
                raise AssertionError(name)

        with pytest.raises(
            GrammarError, match="line 1, column 17: there is no tile 'wall1'; did you mean 'wall'"
        ):
            grammar.evaluate([(1, 1)], (2, 2), tiles=Few())
