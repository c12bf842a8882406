"""`solve` against exhaustive search over all candidates (`tests.oracle.solving`), and what couples groups and axes."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import Any

import pytest

from facade_nb import Design, Layout, NoLayout, solve
from facade_nb.design.model import AXES
from facade_nb.solver import Letter
from tests.oracle import DEFAULT, best
from tests.oracle.designs import make_design
from tests.oracle.solving import least_of_both, price_of_layout, sizable, solve_axis

SEEDS = [0]
"""Designs that the oracle is quick with (see `tests.oracle.designs`), some of them without a layout."""


def design(
    symbols: dict[str, Any],
    patterns: dict[str, str],
    layers: list[tuple[str, str, str]],
    canvas: tuple[float, float],
    counters: dict[str, Any] | None = None,
) -> Design:
    """Layers are listed from the top: pattern and group across, pattern up."""
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "canvas": {"width": canvas[0], "height": canvas[1]},
            "symbols": {
                name: {"size": own} if isinstance(own, float) else own for name, own in symbols.items()
            },
            "counters": counters or {},
            "patterns": patterns,
            "layers": [
                {"name": f"L{n}", "x": {"pattern": x, "group": group}, "y": {"pattern": y}}
                for n, (x, group, y) in reversed(list(enumerate(layers)))
            ],
        }
    )


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


@pytest.mark.parametrize("seed", SEEDS[::8])
def test_random_designs_by_the_papers_search(seed: int) -> None:
    compare(make_design(seed), "ida")


def test_the_random_designs_are_worth_it() -> None:
    """Enough of them have a layout, two groups, a counter on both axes, a substitution and a loose letter."""
    designs = [make_design(seed) for seed in SEEDS]
    counters = [
        [
            {c for name in names for c in one.patterns[name].parsed.counters}
            for names in zip(*_patterns(one), strict=True)
        ]
        for one in designs
    ]
    assert sum(bool(x & y) for x, y in counters) >= 10
    assert sum(len({layer.x.group for layer in one.stack}) > 1 for one in designs) >= 10
    assert sum(any(":=" in p.text for p in one.patterns.values()) for one in designs) >= 15
    assert sum(any(not s.opaque for s in one.symbols.values()) for one in designs) >= 15
    solved = 0
    for one in designs:
        try:
            solved += bool(solve(one).shapes)
        except NoLayout:
            continue
    assert solved >= len(designs) // 2


def _patterns(one: Design) -> list[tuple[str, str]]:
    return [(layer.x.pattern, layer.y.pattern) for layer in one.stack]


H = {"H": 2.0}
"""One symbol that fills the height, so that only the width is at stake."""


class TestCounters:
    def test_shared_by_patterns_of_one_axis(self) -> None:
        one = design(
            {"A": 2.0, "B": 1.0} | H,
            {"a": "A^k", "b": "B^k B^l", "h": "H"},
            [("a", "g", "h"), ("b", "g", "h")],
            (4.0, 2.0),
        )
        layout = compare(one)
        assert layout is not None and layout.counters == {"k": 2, "l": 2}

    def test_shared_by_groups(self) -> None:
        """Alone the groups would take 4 and 2 copies."""
        one = design(
            {"A": 1.0, "B": 2.0} | H,
            {"a": "A^k", "b": "B^k", "h": "H"},
            [("a", "g", "h"), ("b", "f", "h")],
            (4.0, 2.0),
        )
        layout = compare(one)
        assert layout is not None and layout.counters == {"k": 2}
        assert layout.x.cost == pytest.approx(0.25 * 2.0)

    def test_on_both_axes(self) -> None:
        """Alone the axes would take 4 and 2 copies; 3 misses either canvas by a metre."""
        one = design({"A": 1.0}, {"a": "A^k"}, [("a", "g", "a")], (4.0, 2.0))
        layout = compare(one)
        assert layout is not None and layout.counters["k"] in (2, 3, 4)
        assert layout.x.cost + layout.y.cost == pytest.approx(0.5)

    def test_negative_values_mirror(self) -> None:
        one = design(
            {"A": 1.0, "B": 0.5} | H,
            {"a": "(AB)^k", "h": "H"},
            [("a", "g", "h")],
            (3.0, 2.0),
            {"k": {"min": -4, "max": -1}},
        )
        layout = compare(one)
        assert layout is not None and layout.counters == {"k": -2}
        assert [(a.symbol, a.mirrored) for a in layout.x.row("L0").letters] == [("B", True), ("A", True)] * 2


class TestCandidates:
    def test_eq_7_holds_in_every_group_that_uses_the_pattern(self) -> None:
        """Of A and A^7, only the latter is long enough in group f: no opaque letter stands above it there."""
        one = design(
            {"A": 2.0, "B": {"size": 5.0, "opaque": False}, "C": 6.0} | H,
            {"a": "A|A^7", "b": "B", "c": "C", "h": "H"},
            [
                ("c", "g", "h"),
                ("a", "g", "h"),
                ("b", "g", "h"),
                ("b", "f", "h"),
                ("a", "f", "h"),
                ("c", "f", "h"),
            ],
            (10.0, 2.0),
        )
        layout = compare(one)
        assert layout is not None and len(layout.x.row("L1").letters) == 7

    def test_only_words_above_make_room(self) -> None:
        """A alone is too short; it may stand below an opaque word, not above it."""
        parts = {"A": 1.0, "B": 4.0} | H, {"a": "A", "b": "B", "h": "H"}
        below = design(*parts, [("b", "g", "h"), ("a", "g", "h")], (4.0, 2.0))
        assert compare(below) is not None
        assert compare(design(*parts, [("a", "g", "h"), ("b", "g", "h")], (4.0, 2.0))) is None

    def test_alternatives_are_weighed(self) -> None:
        one = design(
            {"A": 1.0, "B": 1.2} | H,
            {"a": "A^3 | B^3", "b": "A^3", "h": "H"},
            [("a", "g", "h"), ("b", "g", "h")],
            (3.3, 2.0),
        )
        layout = compare(one)
        assert layout is not None and {a.symbol for a in layout.x.row("L0").letters} == {"A"}


class TestUnsizedSymbolsSharedByGroups:
    """They couple the groups: one size is best for their sum."""

    @pytest.mark.parametrize(("canvas", "wide"), [(6.0, 1.0), (6.0, 2.5), (5.0, 1.5)])
    def test_cost_is_the_least_over_all_sizes(self, canvas: float, wide: float) -> None:
        patterns = {"m": "eme; m := A", "n": "ene; n := B", "a": "CAC", "b": "DBD", "h": "H"}
        one = design(
            {"A": 1.0, "B": wide, "C": 2.0, "D": 1.0} | H,
            patterns,
            [("m", "g", "h"), ("a", "g", "h"), ("n", "f", "h"), ("b", "f", "h")],
            (canvas, 2.0),
        )
        layout = solve(one, time_limit=None)
        letters = {
            name: Letter(name, size) for name, size in {"A": 1.0, "B": wide, "C": 2.0, "D": 1.0}.items()
        }
        clear = Letter("e", None, transparent=True)

        def at(size: float) -> float:
            total = 0.0
            for middle, side in (("A", "C"), ("B", "D")):
                e = replace(clear, size=size)
                rows = [[e, letters[middle], e], [letters[side], letters[middle], letters[side]]]
                found = best(rows, canvas, 0.5 * canvas, DEFAULT)
                total += inf if found is None else found.cost
            return total

        # J is linear in the size between places where sums of sizes meet, all of which are quarters here.
        assert layout.x.cost == pytest.approx(min(at(0.25 * n) for n in range(1, 17)), abs=1e-6)
        assert layout.x.proven

    def test_one_solved_size(self) -> None:
        one = design(
            {"A": 1.0, "B": 2.5, "C": 2.0, "D": 1.0} | H,
            {"m": "eme; m := A", "n": "ene; n := B", "a": "CAC", "b": "DBD", "h": "H"},
            [("m", "g", "h"), ("a", "g", "h"), ("n", "f", "h"), ("b", "f", "h")],
            (5.0, 2.0),
        )
        layout = solve(one)
        for name in ("L0", "L2"):
            pieces = [a.size for a in layout.x.row(name).letters if a.symbol == "e"]
            assert sum(pieces) == pytest.approx(2 * layout.x.sizes["e"], abs=1e-8)


class TestSubstitutedHereAndStandingThere:
    def test_the_contents_size_counts_in_the_alignment(self) -> None:
        """|m| = 3 |B| = 1.5 makes room for just one A beside it."""
        one = design(
            {"A": 1.0, "B": 0.5, "C": 2.5} | H,
            {"s": "me; m := BBB", "t": "mt; t := A", "c": "C", "h": "H"},
            [("s", "g", "h"), ("t", "g", "h"), ("c", "g", "h")],
            (2.5, 2.0),
        )
        layout = compare(one)
        assert layout is not None
        assert layout.x.sizes["m"] == pytest.approx(1.5)
        assert layout.x.sizes["A"] == pytest.approx(1.0)

    def test_across_groups(self) -> None:
        one = design(
            {"A": 1.0, "B": 0.5, "C": 2.5} | H,
            {"s": "me; m := B^k", "t": "mt; t := A", "c": "C", "h": "H"},
            [("s", "g", "h"), ("c", "g", "h"), ("t", "f", "h"), ("c", "f", "h")],
            (2.5, 2.0),
        )
        layout = compare(one)
        assert layout is not None and layout.x.proven
        assert layout.x.sizes["m"] == pytest.approx(layout.counters["k"] * layout.x.sizes["B"])
