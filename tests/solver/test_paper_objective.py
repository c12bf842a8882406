"""`solve(design, objective=Objective.paper())`: growing tolerances, candidates in lexicographic order."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest

from facade_nb import Design, Layout, NoLayout, gallery, solve
from facade_nb.solver import Letter, Objective, align
from facade_nb.solver.alignment.group import make_group
from facade_nb.solver.schedules.tolerances import TOLERANCES
from tests.bench.designs import LARGE
from tests.known import TELLING
from tests.oracle import PAPER, best
from tests.oracle.designs import design, make_design
from tests.oracle.solving import aligned_words, choices, group_rows


def by_paper(one: Design, **options: Any) -> Layout:
    return solve(one, objective=Objective.paper(), time_limit=None, **options)


def word(layout: Layout, layer: str) -> str:
    """Symbols of a row."""
    return "".join(letter.symbol for letter in layout.x.row(layer).letters)


def test_the_schedule_is_the_specs() -> None:
    assert TOLERANCES == (0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5)


class TestTolerances:
    """A^k, |A| = 1, on canvases that k metres miss by less and less."""

    @pytest.mark.parametrize(
        ("width", "copies"),
        [
            (4.0, 4),  # exact
            (4.04, 4),  # 0.01: up to 0.0404 m
            (4.06, 4),
            (3.9, 4),
            (3.6, 4),  # 0.2: 2.88 to 4.32 m; both 3 and 4 fit: 3 comes first, but see the next test
            (2.5, 2),
        ],
    )
    def test_the_first_that_fits_at_the_least_tolerance(self, width: float, copies: int) -> None:
        limits = [t * width for t in TOLERANCES]
        least = next(t for t in limits if any(abs(k - width) <= t + 1e-9 for k in range(20)))
        first = next(k for k in range(20) if abs(k - width) <= least + 1e-9)
        layout = by_paper(design({"A": 1.0}, {"a": "A^k"}, ["a"], width))
        assert layout.counters["k"] == first

    def test_lexicographic_order_decides_within_a_tolerance(self) -> None:
        """At 0.2 of 2.5 m both 2 and 3 copies fit, as well: 2 comes first."""
        assert by_paper(design({"A": 1.0}, {"a": "A^k"}, ["a"], 2.5)).counters == {"k": 2}

    def test_alternatives_in_the_order_of_the_text(self) -> None:
        symbols = {"A": 1.0, "B": 1.02}
        one = design(symbols, {"a": "B^4 | A^4"}, ["a"], 4.2)
        assert word(by_paper(one), "L0") == "BBBB"  # both fit at 0.05, and B comes first
        assert word(by_paper(design(symbols, {"a": "A^4 | B^4"}, ["a"], 4.2)), "L0") == "AAAA"

    def test_the_uppermost_pattern_comes_first(self) -> None:
        """At tolerance 0 only the pairs of equal length align: (1, 2) before (2, 1)."""
        one = design({"A": 1.0, "B": 1.0}, {"a": "A^k B^l", "b": "A^l B^k"}, ["a", "b"], 3.0)
        layout = by_paper(one)
        assert layout.counters == {"k": 0, "l": 3}

    def test_given_ones(self) -> None:
        one = design({"A": 1.0}, {"a": "A^k"}, ["a"], 3.6)
        assert by_paper(one, tolerances=(0.5,)).counters == {"k": 2}
        with pytest.raises(NoLayout):
            by_paper(one, tolerances=(0.0, 0.01))

    @pytest.mark.parametrize("wrong", [(), (0.5, 0.1), (-0.1,), (0.0, 1.5), (float("nan"),)])
    def test_wrong_ones(self, wrong: tuple[float, ...]) -> None:
        with pytest.raises(
            ValueError, match="tolerances: expected growing fractions of the canvas from 0 to 1"
        ):
            by_paper(design({"A": 1.0}, {"a": "A^k"}, ["a"]), tolerances=wrong)

    def test_axes_have_their_own(self) -> None:
        """Across fits exactly, up only at 0.2: across keeps its exact fit."""
        layout = by_paper(
            design({"A": 1.0, "B": 0.85}, {"a": "A^k", "b": "B^2"}, [("a", "g", "b")], 4.0, 2.0)
        )
        assert layout.counters == {"k": 4} and layout.x.cost == 0.0

    def test_counters_on_both_axes_need_one_tolerance(self) -> None:
        layout = by_paper(design({"A": 1.0, "B": 1.5}, {"a": "A^k", "b": "B^k"}, [("a", "g", "b")], 4.0, 4.5))
        assert layout.counters == {"k": 4} or layout.counters == {"k": 3}
        fits = [
            t
            for t in TOLERANCES
            if any(abs(k - 4) <= 4 * t and abs(1.5 * k - 4.5) <= 4.5 * t for k in range(9))
        ]
        first = next(k for k in range(9) if abs(k - 4) <= 4 * fits[0] and abs(1.5 * k - 4.5) <= 4.5 * fits[0])
        assert layout.counters == {"k": first}


def first_by_hand(one: Design) -> tuple[dict[str, int], float] | None:
    """Values of the counters and Ω of the first candidate of the x axis that aligns in all groups, by the oracle."""
    canvas = one.canvas.width
    for tolerance in TOLERANCES:
        for choice in choices(one, "x", tolerance * canvas):
            words = aligned_words(choice)
            total = 0.0
            for rows in group_rows(one, "x").values():
                found = best([words[p] for _, p in rows], canvas, tolerance * canvas, PAPER, limit=4000)
                if found is None:
                    break
                total += found.cost
            else:
                return dict(choice.counters), total
    return None


HANDMADE = [
    design({"A": 1.0, "B": 0.5}, {"a": "A^k", "b": "B^l"}, ["a", "b"], 3.0),
    design({"A": 1.0, "B": 0.5}, {"a": "A(BA)^k", "b": "(AB)^l"}, ["a", "b"], 3.2),
    design({"A": 2.0, "B": 1.3}, {"a": "A^k B^l", "b": "A^l"}, [("a", "g"), ("b", "f")], 5.0),
    design(
        {"A": 1.4, "B": 1.0, "C": {"size": 1.1, "opaque": False}},
        {"c": "C^k", "a": "A(BA)^l"},
        ["c", "a"],
        3.8,
    ),
    design({"A": 1.0, "B": 0.7}, {"a": "(A|B)^k", "b": "BA^l"}, ["a", "b"], 2.9),
]


@pytest.mark.parametrize("number", range(len(HANDMADE)))
def test_against_the_words_of_the_spec(number: int) -> None:
    one = HANDMADE[number]
    expected = first_by_hand(one)
    assert expected is not None
    layout = by_paper(one)
    counters, omega = expected
    assert layout.counters == counters
    assert layout.x.cost == pytest.approx(omega, abs=1e-6)
    assert sum(group.error for group in layout.x.groups.values()) == pytest.approx(omega, abs=1e-6)


@pytest.mark.parametrize("seed", range(20))
def test_columns_keep_within_a_tolerance_of_the_schedule(seed: int) -> None:
    """W within the tolerance of the canvas, and each ω_j within it: at sizes as preferred."""
    one = make_design(seed)
    try:
        layout = by_paper(one)
    except NoLayout as error:
        assert str(error)
        return
    assert layout.x.cost <= 0.5 * one.canvas.width * sum(len(g.columns) for g in layout.x.groups.values())
    for group in layout.x.groups.values():
        widths, omegas = [], []
        for j in range(len(group.columns) - 1):
            cells = [row.columns[j] for row in group.rows if row.columns[j]]
            sizes = [one.symbol(a.symbol).size for cell in cells for a in cell]
            if None in sizes or any(a.transparent for cell in cells for a in cell):
                widths = []
                break  # pieces and unsized letters have no preferred size
            totals = [sum(one.symbol(a.symbol).size or 0.0 for a in cell) for cell in cells]
            widths.append(max(totals))
            omegas.append(max(totals) - min(totals))
        if widths:
            assert abs(sum(widths) - one.canvas.width) <= 0.5 * one.canvas.width + 1e-6
            assert max(omegas) <= 0.5 * one.canvas.width + 1e-6
            assert sum(omegas) == pytest.approx(group.error, abs=1e-6)


def test_alignment_of_the_chosen_candidate_is_the_papers() -> None:
    """The columns are those that `align` gives for the same words."""
    layout = by_paper(design({"A": 1.0, "B": 0.5}, {"a": "A(BA)^k", "b": "(AB)^l"}, ["a", "b"], 3.2))
    rows = [
        [Letter(a.symbol, {"A": 1.0, "B": 0.5}[a.symbol]) for a in layout.x.row(n).letters]
        for n in ("L0", "L1")
    ]
    widths = [t * 3.2 for t in TOLERANCES]
    found = next(f for f in (align(rows, canvas=3.2, tolerance=t) for t in widths) if f is not None)
    assert found.error == pytest.approx(layout.x.cost)
    assert len(found.columns) == len(layout.x.groups["g"].columns) - 1


def test_most_columns_break_ties() -> None:
    layout = by_paper(design({"A": 1.0, "B": 1.0}, {"a": "AAAA", "b": "BBBB"}, ["a", "b"]))
    assert [b - a for a, b in pairwise(layout.x.groups["g"].columns)] == [pytest.approx(1.0)] * 4


@pytest.mark.parametrize("name", ["figure-7", "qualifiers-a", "residential-house"])
def test_gallery(name: str) -> None:
    one = gallery.load(name)
    layout = by_paper(one)
    assert layout.complete and layout.shapes


class TestLargeDesigns:
    """Where the objective is degenerate there may be no time to prove anything, but there is a layout."""

    @pytest.mark.parametrize("name", [name for name in LARGE if name in TELLING])
    def test_there_is_a_layout(self, name: str) -> None:
        layout = solve(gallery.load(name), objective=Objective.paper(), time_limit=2.0)
        assert layout.shapes
        for axis, canvas in ((layout.x, layout.canvas.width), (layout.y, layout.canvas.height)):
            assert axis.proven or not layout.complete
            assert sum(group.error for group in axis.groups.values()) == pytest.approx(axis.cost)
            for group in axis.groups.values():
                # every ω is within the largest tolerance, half the canvas
                assert group.error <= 0.5 * canvas * (len(group.columns) - 1) + 1e-9

    def test_the_papers_slowest_figure_is_proven(self) -> None:
        layout = by_paper(gallery.load("apartment-house"))
        assert layout.complete and layout.x.proven and layout.y.proven
        assert layout.x.cost == pytest.approx(5.3)

    def test_time_is_over_during_either_search(self) -> None:
        """The last attempt takes what the default objective finds, and says that it is not proven."""
        one = gallery.load("residential-house")
        quick = solve(one, objective=Objective.paper(), search="ida", time_limit=2.0)
        assert not quick.complete and not quick.x.proven
        assert quick.y.cost == pytest.approx(0.0)


class TestNonOpaqueLetters:
    """Behind a letter that is not opaque stands one that is, and every row counts in ω."""

    def test_what_they_ask_for_is_known_beforehand(self) -> None:
        soft = (
            Letter("C", 0.75, opaque=False),
            Letter("z", 1.0, transparent=True),
            Letter("C", 0.75, opaque=False),
        )
        hard = (Letter("A", 1.0), Letter("B", 1.6))
        group = make_group([soft, hard], 2.6, 1.3, Objective.paper())
        band = group.bands[0]
        assert band.gap_rest == pytest.approx([0.5, 0.25, 0.25, 0.0])
        assert group.bands[1].gap_rest == [0.0, 0.0, 0.0]

    def test_what_is_beyond_the_tolerance_cannot_be_aligned(self) -> None:
        rows = [(Letter("C", 0.75, opaque=False),), (Letter("A", 1.0),)]
        assert make_group(rows, 1.0, 0.2, Objective.paper()).bands[0].gap_rest == [float("inf"), 0.0]
        assert make_group(rows, 1.0, 0.25, Objective.paper()).bands[0].gap_rest == pytest.approx([0.25, 0.0])
