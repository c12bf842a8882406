"""`solve` against exhaustive search over all candidates (`tests.oracle.solving`), and what couples groups and axes."""

from __future__ import annotations

from math import inf

import pytest

from facade_nb import Design, Layout, NoLayout, solve
from facade_nb.design.model import AXES
from facade_nb.solver import Letter
from tests.oracle import DEFAULT, best
from tests.oracle.designs import design, make_design
from tests.oracle.solving import counters_of, group_rows, least_of_both, price_of_layout, sizable, solve_axis

SEEDS = [
    0, 1, 2, 3, 7, 12, 15, 20, 24, 25, 26, 28, 30, 31, 35, 39, 40, 41, 42, 44, 45, 53, 58, 60, 72, 78,
    79, 88, 91, 94, 104, 106, 108, 112, 114, 115, 123, 124, 130, 131, 132, 136, 141, 144, 149, 150, 156,
    158, 162, 163, 167, 171, 174, 175, 180, 183, 188, 194, 203, 204, 206, 214, 220, 221, 223, 224, 234,
    238, 240, 242, 246, 253, 256, 258,
]  # fmt: skip
"""Designs that the oracle is quick with (see `tests.oracle.designs`), some of them without a layout."""


def compare(one: Design, search: str = "best") -> Layout | None:
    """Assert that `solve` finds what exhaustive search finds, and shows structures of just that cost."""
    answers = {axis: solve_axis(one, axis) for axis in AXES}
    least = least_of_both(answers)
    try:
        layout = solve(one, search=search, time_limit=None)
    except NoLayout as error:
        assert least == inf, error
        return None
    assert layout.complete and layout.x.proven and layout.y.proven
    assert layout.x.gap == layout.y.gap == 0.0
    assert layout.x.cost + layout.y.cost == pytest.approx(least, abs=1e-6)
    for axis in AXES:
        solved = layout.along(axis)
        assert answers[axis].of(layout.counters) == pytest.approx(solved.cost, abs=1e-6)
        cost, parts = price_of_layout(one, axis, solved, layout.counters)
        assert cost == pytest.approx(solved.cost, abs=1e-6)
        assert sizable(one, parts, one.canvas.along(axis))
    return layout


@pytest.mark.parametrize("seed", SEEDS)
def test_random_designs(seed: int) -> None:
    compare(make_design(seed))


@pytest.mark.parametrize("seed", SEEDS[::4])
def test_random_designs_by_the_papers_search(seed: int) -> None:
    compare(make_design(seed), "ida")


def test_the_random_designs_are_worth_it() -> None:
    """Enough of them have a layout, two groups, a counter on both axes, a substitution and a letter not opaque."""
    designs = [make_design(seed) for seed in SEEDS]
    assert sum(bool({*counters_of(one, "x")} & {*counters_of(one, "y")}) for one in designs) >= 15
    assert sum(len(group_rows(one, "x")) > 1 for one in designs) >= 10
    assert sum(any(":=" in p.text for p in one.patterns.values()) for one in designs) >= 20
    assert sum(any(not s.opaque for s in one.symbols.values()) for one in designs) >= 20


class TestCounters:
    def test_shared_by_patterns_of_one_axis(self) -> None:
        one = design({"A": 2.0, "B": 1.0}, {"a": "A^k", "b": "B^k B^l"}, ["a", "b"])
        layout = compare(one)
        assert layout is not None and layout.counters == {"k": 2, "l": 2}

    def test_shared_by_groups(self) -> None:
        """Alone the groups would take 4 and 2 copies."""
        one = design({"A": 1.0, "B": 2.0}, {"a": "A^k", "b": "B^k"}, [("a", "g"), ("b", "f")])
        layout = compare(one)
        assert layout is not None
        assert layout.x.cost == pytest.approx(0.5)  # 2 copies miss group g by 2 m, 3 both by 1 and 2 m
        assert layout.counters == {"k": 2}

    def test_on_both_axes(self) -> None:
        """Alone the axes would take 4 and 2 copies; any in between misses the two canvases by 2 m together."""
        layout = compare(design({"A": 1.0}, {"a": "A^k"}, [("a", "g", "a")]))
        assert layout is not None
        assert layout.x.cost + layout.y.cost == pytest.approx(0.5)

    def test_negative_values_mirror(self) -> None:
        one = design(
            {"A": 1.0, "B": 0.5}, {"a": "(AB)^k"}, ["a"], width=3.0, counters={"k": {"min": -4, "max": -1}}
        )
        layout = compare(one)
        assert layout is not None and layout.counters == {"k": -2}
        assert [(a.symbol, a.mirrored) for a in layout.x.row("L0").letters] == [("B", True), ("A", True)] * 2


class TestCandidates:
    def test_eq_7_holds_in_every_group_that_uses_the_pattern(self) -> None:
        """Of A and A^7, only the latter is long enough in group f: no opaque letter stands above it there."""
        one = design(
            {"A": 2.0, "B": {"size": 5.0, "opaque": False}, "C": 6.0},
            {"a": "A|A^7", "b": "B", "c": "C"},
            [("c", "g"), ("a", "g"), ("b", "g"), ("b", "f"), ("a", "f"), ("c", "f")],
            width=10.0,
        )
        layout = compare(one)
        assert layout is not None and len(layout.x.row("L1").letters) == 7

    def test_only_words_above_make_room(self) -> None:
        """A alone is too short; it may stand below an opaque word, not above it."""
        symbols, patterns = {"A": 1.0, "B": 4.0}, {"a": "A", "b": "B"}
        assert compare(design(symbols, patterns, ["b", "a"])) is not None
        assert compare(design(symbols, patterns, ["a", "b"])) is None

    def test_alternatives_are_weighed(self) -> None:
        one = design({"A": 1.0, "B": 1.2}, {"a": "A^3 | B^3", "b": "A^3"}, ["a", "b"], width=3.3)
        layout = compare(one)
        assert layout is not None and {a.symbol for a in layout.x.row("L0").letters} == {"A"}

    def test_a_group_without_an_alignment_ends_the_search(self) -> None:
        """Where one group of a candidate has no alignment, the candidate is dropped, though the other group has one."""
        one = design(
            {"A": 1.0, "B": {"size": 4.0, "opaque": False}, "C": {"size": 4.0, "unoccludable": True}},
            {"a": "A^4", "b": "B", "c": "C"},
            [("a", "g"), ("b", "f"), ("c", "f")],
        )
        assert compare(one) is None

    def test_sizes_of_two_groups_rule_out_what_each_would_choose(self) -> None:
        """Group g would put A A beside B (|B| = 2 |A|), group f A beside B: the next best that can be sized counts."""
        one = design(
            {"A": 1.0, "B": 2.0},
            {"a": "AA", "b": "B", "c": "A"},
            [("a", "g"), ("b", "g"), ("b", "f"), ("c", "f")],
            2.0,
        )
        compare(one)


class TestUnsizedSymbolsSharedByGroups:
    """They couple the groups: one size is best for their sum."""

    @staticmethod
    def made(width: float, middle: float) -> Design:
        return design(
            {"A": 1.0, "B": middle, "C": 2.0, "D": 1.0},
            {"m": "eme; m := A", "n": "ene; n := B", "a": "CAC", "b": "DBD"},
            [("m", "g"), ("a", "g"), ("n", "f"), ("b", "f")],
            width,
        )

    @pytest.mark.parametrize(("width", "middle"), [(6.0, 2.5), (5.0, 1.5)])
    def test_cost_is_the_least_over_all_sizes(self, width: float, middle: float) -> None:
        layout = solve(self.made(width, middle), time_limit=None)
        sizes = {"A": 1.0, "B": middle, "C": 2.0, "D": 1.0}
        letters = {name: Letter(name, size) for name, size in sizes.items()}

        def at(size: float) -> float:
            e = Letter("e", size, transparent=True)
            total = 0.0
            for inner, side in (("A", "C"), ("B", "D")):
                rows = [[e, letters[inner], e], [letters[side], letters[inner], letters[side]]]
                found = best(rows, width, 0.5 * width, DEFAULT)
                total += inf if found is None else found.cost
            return total

        # J is linear in the size between places where sums of sizes meet, all of which are quarters here.
        assert layout.x.cost == pytest.approx(min(at(0.25 * n) for n in range(2, 13)), abs=1e-6)
        assert layout.x.proven

    def test_one_solved_size(self) -> None:
        layout = solve(self.made(5.0, 1.5))
        for name in ("L0", "L2"):
            pieces = [a.size for a in layout.x.row(name).letters if a.symbol == "e"]
            assert sum(pieces) == pytest.approx(2 * layout.x.sizes["e"], abs=1e-8)


class TestSubstitutedHereAndStandingThere:
    def test_the_contents_size_counts_in_the_alignment(self) -> None:
        """|m| = 3 |B| = 1.5 leaves just A's 1 m of the canvas, below e."""
        one = design(
            {"A": 1.0, "B": 0.5, "C": 1.5, "D": 1.0},
            {"s": "me; m := BBB", "t": "mt; t := A", "c": "CD"},
            ["s", "t", "c"],
            width=2.5,
        )
        layout = compare(one)
        assert layout is not None and layout.x.cost == pytest.approx(0.25 * 1.0 / 3)  # B beside B beside B
        assert {name: round(size, 6) for name, size in layout.x.sizes.items()} == {
            "A": 1.0, "B": 0.5, "C": 1.5, "D": 1.0, "e": 1.0, "m": 1.5,
        }  # fmt: skip

    def test_across_groups(self) -> None:
        patterns = {"s": "me; m := B^k", "t": "mt; t := A"}
        one = design({"A": 1.0, "B": 0.5}, patterns, [("s", "g"), ("t", "f")], width=2.5)
        layout = compare(one)
        assert layout is not None and layout.x.proven
        assert layout.x.sizes["m"] == pytest.approx(layout.counters["k"] * layout.x.sizes["B"])

    def test_across_groups_that_contradict_each_other(self) -> None:
        """C alone fills the canvas in one group and must leave room for A in the other."""
        patterns = {"s": "me; m := B^k", "t": "mt; t := A", "c": "C"}
        layers = [("s", "g"), ("c", "g"), ("t", "f"), ("c", "f")]
        assert compare(design({"A": 1.0, "B": 0.5, "C": 2.5}, patterns, layers, width=2.5)) is None
