"""Sizes and places: every constraint of docs/problem.md on the layout itself; and that no sizes are better."""

from __future__ import annotations

from collections import defaultdict
from itertools import pairwise
from math import sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import null_space
from scipy.optimize import linprog, minimize

from facade_nb import Design, Layout, NoLayout, gallery, solve
from facade_nb.design.model import AXES, Axis
from facade_nb.solver.events import SystemPosed, SystemSolved
from facade_nb.solver.model.layout import PlacedLetter
from facade_nb.solver.model.sizing import FREE, Solution
from facade_nb.solver.sizing.least_squares import least_squares
from tests.known import TELLING
from tests.oracle.designs import design, make_design
from tests.oracle.solving import structure_of

NEAR = 1e-7
"""Metres: how far the constraints may be missed."""
SEEDS = range(60)


def faults(one: Design, layout: Layout) -> list[str]:
    """What is wrong with the sizes and places of a layout."""
    return [f"{axis}: {fault}" for axis in AXES for fault in axis_faults(one, layout, axis)]


def axis_faults(one: Design, layout: Layout, axis: Axis) -> list[str]:
    solved, canvas = layout.along(axis), one.canvas.along(axis)
    found: list[str] = []

    def same(a: float, b: float, what: str) -> None:
        if abs(a - b) > NEAR:
            found.append(f"{what}: {a!r} and {b!r}")

    seen: set[str] = set()
    for name, group in solved.groups.items():
        edges = group.columns
        same(edges[0], 0.0, f"{name} starts at 0")
        same(edges[-1], canvas, f"{name} ends at the canvas")
        if any(b - a < 1e-9 for a, b in pairwise(edges)):
            found.append(f"{name}: columns {edges} do not grow")
        for row in group.rows:
            if len(row.columns) != len(edges) - 1:
                found.append(f"{row.layer}: {len(row.columns)} columns, not {len(edges) - 1}")
                continue
            found += _row_faults(one, row.layer, row.columns, edges)
            seen |= {letter.symbol for letter in row.letters}
            try:  # all letters of a symbol, and the pieces of each cut letter together, have its size
                structure_of(row.columns, solved.sizes)
            except (ValueError, KeyError) as error:
                found.append(f"{row.layer}: {error}")
    for symbol in seen:
        own, size = one.symbol(symbol), solved.sizes[symbol]
        if size < (own.min or 1e-9) - NEAR or (own.max is not None and size > own.max + NEAR):
            found.append(f"|{symbol}| = {size} is not within {own.min} and {own.max}")
    sized = [(solved.sizes[s], one.symbol(s).size) for s in seen]
    same(solved.deviation, sqrt(sum((z - p) ** 2 for z, p in sized if p is not None)), "deviation")
    if set(solved.sizes) != seen:
        found.append(f"sizes of {sorted(solved.sizes)}, letters of {sorted(seen)}")
    return found


def _row_faults(
    one: Design, layer: str, columns: tuple[tuple[PlacedLetter, ...], ...], edges: tuple[float, ...]
) -> list[str]:
    found: list[str] = []
    for cell, (left, right) in zip(columns, pairwise(edges), strict=True):
        if not cell:
            continue
        for a, b in pairwise(cell):
            if a.end != b.start:
                found.append(f"{layer}: {a.symbol} ends at {a.end}, {b.symbol} starts at {b.start}")
        if any(letter.end - letter.start < 1e-9 for letter in cell):
            found.append(f"{layer}: a letter or piece is not positive")
        before, behind = cell[0].start - left, right - cell[-1].end
        soft = next((a for a in cell if not a.transparent and not one.symbol(a.symbol).opaque), None)
        if soft is None:
            wanted = (0.0, 0.0)
        else:
            placement = one.symbol(soft.symbol).placement
            if soft.mirrored and placement != "center":
                placement = "left" if placement == "right" else "right"
            gap = before + behind
            wanted = {"center": (gap / 2, gap / 2), "left": (0.0, gap), "right": (gap, 0.0)}[placement]
        if abs(before - wanted[0]) > NEAR or abs(behind - wanted[1]) > NEAR or min(before, behind) < -NEAR:
            found.append(f"{layer}: gaps {before} and {behind} around {cell[0].symbol}, expected {wanted}")
    return found


@pytest.mark.parametrize("name", TELLING)
def test_gallery(name: str) -> None:
    one = gallery.load(name)
    assert faults(one, solve(one)) == []


def test_steps_of_the_house() -> None:
    for one in gallery.steps("residential-house"):
        assert faults(one, solve(one)) == []


@pytest.mark.parametrize("seed", SEEDS)
def test_random_designs(seed: int) -> None:
    one = make_design(seed)
    try:
        layout = solve(one)
    except NoLayout as error:
        assert str(error)
        return
    assert faults(one, layout) == []


def test_most_random_designs_have_sizes() -> None:
    """Else the test before says little."""
    solved = 0
    for seed in SEEDS:
        try:
            solved += bool(solve(make_design(seed)).x.sizes)
        except NoLayout:
            continue
    assert solved >= len(SEEDS) // 2


class TestByHand:
    def test_the_canvas_is_shared_out_by_least_squares(self) -> None:
        """2 |A| + |B| = 4.6 with 1 and 2 preferred: a correction of 0.6 along (2, 1)."""
        layout = solve(design({"A": 1.0, "B": 2.0}, {"a": "ABA"}, ["a"], 4.6))
        assert layout.x.sizes["A"] == pytest.approx(1.0 + 0.6 * 2 / 5)
        assert layout.x.sizes["B"] == pytest.approx(2.0 + 0.6 * 1 / 5)
        assert layout.x.deviation == pytest.approx(0.6 / sqrt(5))

    def test_bounds_bind(self) -> None:
        layout = solve(design({"A": {"size": 1.0, "max": 1.1}, "B": 2.0}, {"a": "ABA"}, ["a"], 4.6))
        assert layout.x.sizes == {"A": pytest.approx(1.1), "B": pytest.approx(2.4)}
        layout = solve(design({"A": 1.0, "B": {"size": 2.0, "min": 1.9}}, {"a": "ABA"}, ["a"], 3.4))
        assert layout.x.sizes == {"A": pytest.approx(0.75), "B": pytest.approx(1.9)}

    def test_one_size_across_groups(self) -> None:
        """Three A in group g and two A with a B in f: |A| = 4/3 in both."""
        layout = solve(design({"A": 1.3, "B": 1.4}, {"a": "AAA", "b": "ABA"}, [("a", "g"), ("b", "f")]))
        assert layout.x.sizes["A"] == pytest.approx(4 / 3) and layout.x.sizes["B"] == pytest.approx(4 / 3)

    @pytest.mark.parametrize(
        ("placement", "mirrored", "start"),
        [
            ("center", "", 0.5), ("center", "'", 0.5), ("left", "", 0.0), ("left", "'", 1.0), ("right", "", 1.0),
            ("right", "'", 0.0),
        ],
    )  # fmt: skip
    def test_placement_in_a_column_that_is_wider(self, placement: str, mirrored: str, start: float) -> None:
        clear = {"size": 3.0, "opaque": False, "placement": placement}
        layout = solve(design({"C": clear, "A": 4.0}, {"c": f"C{mirrored}", "a": "A"}, ["c", "a"]))
        (letter,) = layout.x.row("L0").letters
        assert letter.mirrored == bool(mirrored)
        assert (letter.start, letter.end) == (pytest.approx(start), pytest.approx(start + 3.0))
        assert layout.x.deviation == pytest.approx(0.0, abs=1e-9)

    def test_a_letter_too_large_for_its_column_shrinks(self) -> None:
        layout = solve(
            design({"C": {"size": 4.4, "opaque": False}, "A": 4.0}, {"c": "C", "a": "A"}, ["c", "a"])
        )
        assert layout.x.sizes["C"] == pytest.approx(4.0)

    def test_the_extent_of_a_content_is_the_size_of_the_letter(self) -> None:
        """m stands for A B A in one row, and is a letter of 2.4 m in another."""
        symbols = {"A": 0.6, "B": 1.0, "m": 2.4, "W": 0.9}
        layout = solve(design(symbols, {"s": "eme; m := ABA", "l": "WmW"}, ["s", "l"]))
        sizes = layout.x.sizes
        assert sizes["m"] == pytest.approx(2 * sizes["A"] + sizes["B"])
        solid = [a for a in layout.x.row("L0").letters if not a.transparent]
        standing = next(a for a in layout.x.row("L1").letters if a.symbol == "m")
        assert (solid[0].start, solid[-1].end) == (pytest.approx(standing.start), pytest.approx(standing.end))

    def test_unsized_letters_stay_near_their_size_in_the_alignment(self) -> None:
        """e and f share what A leaves; nothing else tells them apart, so that they come out as they were aligned."""
        layout = solve(
            design({"A": 2.0, "B": 1.0, "C": 1.0}, {"s": "emf; m := A", "w": "BAC"}, ["s", "w"], 4.4)
        )
        sizes = layout.x.sizes
        assert sizes["e"] == pytest.approx(sizes["B"]) and sizes["f"] == pytest.approx(sizes["C"])

    def test_pieces_of_a_cut_letter_add_up(self) -> None:
        """The transparent splits of the paper: f A f over C e C over A B A B A."""
        symbols = {"A": 2.0, "C": 2.0, "B": 3.0}
        patterns = {"f": "fmf; m := A", "c": "cec; c := C", "w": "ABABA"}
        layout = solve(design(symbols, patterns, ["f", "c", "w"], 12.0))
        pieces: defaultdict[str, list[float]] = defaultdict(list)
        for name in ("L0", "L1"):
            for letter in layout.x.row(name).letters:
                pieces[letter.symbol].append(letter.size)
        assert len(pieces["f"]) > 2
        assert sum(pieces["f"]) == pytest.approx(2 * layout.x.sizes["f"])
        assert sum(pieces["e"]) == pytest.approx(layout.x.sizes["e"])

    def test_bounds_that_contradict_each_other_name_their_symbols(self) -> None:
        one = design({"A": {"size": 1.9, "max": 1.95}, "B": 1.0}, {"a": "AA"}, ["a"])
        with pytest.raises(NoLayout, match=r"measures at most 3\.9 m, by the max of 'A'") as caught:
            solve(one)
        assert caught.value.symbols == ("A",) and caught.value.axis == "x"
        assert "'A'" in str(caught.value)


def feasible(rows: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray | None:
    """Some point of the polyhedron, by HiGHS; None: it is empty."""
    n = rows.shape[1]
    upper, lower = high[n:] < FREE, low[n:] > -FREE
    answer = linprog(
        np.zeros(n),
        A_ub=np.vstack([rows[upper], -rows[lower]]),
        b_ub=np.concatenate([high[n:][upper], -low[n:][lower]]),
        bounds=[
            (None if a <= -FREE else a, None if b >= FREE else b)
            for a, b in zip(low[:n], high[:n], strict=True)
        ],
    )
    assert answer.status in (0, 2), answer.message
    return None if answer.status == 2 else np.asarray(answer.x)


def slowly(
    weight: np.ndarray,
    target: np.ndarray,
    rows: np.ndarray,
    low: np.ndarray,
    high: np.ndarray,
    start: np.ndarray,
) -> float | None:
    """The least Σ weight·(x − target)² by SLSQP, from a feasible point, moving only where all equations hold on.

    None: SLSQP gave up.
    """
    everything = np.vstack([np.eye(start.size), rows])
    equal = low == high
    free = null_space(everything[equal]) if equal.any() else np.eye(start.size)
    if not free.shape[1]:
        return float(np.sum(weight * (start - target) ** 2))
    rest, at = everything[~equal] @ free, everything[~equal] @ start
    top, bottom = high[~equal] < FREE, low[~equal] > -FREE
    slopes = np.vstack([-rest[top], rest[bottom]])
    room = np.concatenate([high[~equal][top] - at[top], at[bottom] - low[~equal][bottom]])
    answer = minimize(
        lambda y: float(np.sum(weight * (start + free @ y - target) ** 2)),
        np.zeros(free.shape[1]),
        jac=lambda y: free.T @ (2 * weight * (start + free @ y - target)),
        method="SLSQP",
        constraints=[{"type": "ineq", "fun": lambda y: slopes @ y + room, "jac": lambda y: slopes}],
        options={"ftol": 1e-14, "maxiter": 1000},
    )
    return float(answer.fun) if answer.success else None


class TestOptimality:
    """The multipliers certify the answer: no solver is believed."""

    @staticmethod
    def residual(
        weight: np.ndarray,
        target: np.ndarray,
        rows: np.ndarray,
        low: np.ndarray,
        high: np.ndarray,
        found: Solution,
    ) -> float:
        """The worst violation of stationarity, feasibility, sign and complementarity."""
        x, lam = np.asarray(found.x), np.asarray(found.multipliers)
        at = np.concatenate([x, rows @ x])
        gradient = 2 * weight * (x - target) + lam[: x.size] + rows.T @ lam[x.size :]
        worst = float(np.abs(gradient).max(initial=0.0))
        worst = max(worst, float((at - high).max(initial=0.0)), float((low - at).max(initial=0.0)))
        pulled_up, pulled_down = np.maximum(lam, 0.0), np.maximum(-lam, 0.0)
        above, below = np.abs(np.minimum(high, FREE) - at), np.abs(at - np.maximum(low, -FREE))
        slack = np.where(pulled_up > 1e-12, np.minimum(above, 1e6) * np.minimum(pulled_up, 1.0), 0.0)
        slack += np.where(pulled_down > 1e-12, np.minimum(below, 1e6) * np.minimum(pulled_down, 1.0), 0.0)
        return max(worst, float(slack.max(initial=0.0)))

    @pytest.mark.parametrize("name", TELLING)
    def test_of_the_gallery(self, name: str) -> None:
        one = gallery.load(name)
        layout = solve(one, trace=True)
        systems, answers = layout.trace.of_kind(SystemPosed), layout.trace.of_kind(SystemSolved)
        assert [event.axis for event in systems] == [event.axis for event in answers] == ["x", "y"]
        for event, solved in zip(systems, answers, strict=True):
            symbols = [one.symbol(v[1:-1]) if v.startswith("|") else None for v in event.variables]
            weight = np.array([1.0 if s is not None and s.size is not None else 0.0 for s in symbols])
            target = np.array([(s.size or 0.0) if s is not None else 0.0 for s in symbols])
            answer = Solution(np.array(solved.solution), np.array(solved.multipliers), 0)
            arrays = (event.matrix, np.array(event.lower), np.array(event.upper))
            assert self.residual(weight, target, *arrays, answer) <= 1e-8
            assert solved.deviation == pytest.approx(
                sqrt(float(np.sum(weight * (answer.x - target) ** 2))), abs=1e-9
            )
            assert len(event.rows) == arrays[0].shape[0] and len(set(event.variables)) == len(event.variables)

    @given(st.integers(0, 10**6))
    def test_of_random_systems(self, seed: int) -> None:
        """With singular weights, repeated rows, equations and bounds that touch; against scipy."""
        random = np.random.default_rng(seed)
        n, m = int(random.integers(1, 7)), int(random.integers(0, 7))
        weight = random.choice([0.0, 1.0], size=n)
        target = random.choice([0.0, 0.5, 1.0, 2.0], size=n)
        rows = random.choice([-1.0, 0.0, 1.0], size=(m, n))
        rows = np.vstack([rows, rows[:1]]) if m and random.random() < 0.3 else rows  # a redundant row
        middle = random.choice([0.0, 1.0, 2.0, 3.0], size=n + len(rows))
        spread = random.choice([0.0, 0.0, 1.0, FREE], size=n + len(rows))
        spread[:n] = np.where(spread[:n] == 0.0, 2.0, spread[:n])
        low, high = (
            np.where(spread >= FREE, -FREE, middle - spread),
            np.where(spread >= FREE, FREE, middle + spread),
        )
        found = least_squares(weight, target, rows, low, high)
        start = feasible(rows, low, high)
        assert (found is None) == (start is None)
        if found is None or start is None:
            return
        assert self.residual(weight, target, rows, low, high, found) <= 1e-8
        slow = slowly(weight, target, rows, low, high, start)
        ours = float(np.sum(weight * (found.x - target) ** 2))
        assert slow is None or ours <= slow + 1e-6  # SLSQP may stop short; what has no residual is optimal

    def test_an_equation_twice_and_one_that_follows_from_others(self) -> None:
        rows = np.array([[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0], [1.0, 2.0, 1.0]])
        low = np.concatenate([np.zeros(3), [2.0, 2.0, 3.0, 5.0]])
        high = np.concatenate([np.full(3, FREE), [2.0, 2.0, 3.0, 5.0]])
        found = least_squares(np.ones(3), np.array([1.0, 1.0, 1.0]), rows, low, high)
        assert found is not None
        assert found.x == pytest.approx([2 / 3, 4 / 3, 5 / 3])

    def test_equations_that_contradict_each_other(self) -> None:
        rows = np.array([[1.0, 1.0], [1.0, 1.0]])
        low = np.array([0.0, 0.0, 2.0, 3.0])
        high = np.array([FREE, FREE, 2.0, 3.0])
        assert least_squares(np.ones(2), np.ones(2), rows, low, high) is None

    def test_a_layout_is_as_near_as_scipy_gets(self) -> None:
        """The whole system of a house, minimised again by scipy."""
        one = gallery.load("residential-house")
        layout = solve(one, trace=True)
        (event,) = layout.trace.of_kind(SystemPosed, "x")
        symbols = [one.symbol(v[1:-1]) if v.startswith("|") else None for v in event.variables]
        weight = np.array([1.0 if s is not None and s.size is not None else 0.0 for s in symbols])
        target = np.array([(s.size or 0.0) if s is not None else 0.0 for s in symbols])
        arrays = (event.matrix, np.array(event.lower), np.array(event.upper))
        start = feasible(*arrays)
        assert start is not None
        slow = slowly(weight, target, *arrays, start)
        assert slow is not None
        assert layout.x.deviation == pytest.approx(sqrt(max(0.0, slow)), abs=1e-5)


def test_system_rows_are_named() -> None:
    """A person can read the system: sizes, boundaries, and which letters each row speaks of."""
    layout = solve(design({"A": 1.0, "B": 2.0}, {"a": "ABA"}, ["a"], 4.6), trace=True)
    (event,) = layout.trace.of_kind(SystemPosed, "x")
    assert {"|A|", "|B|"} <= set(event.variables)
    assert all(event.rows) and any(row.endswith("= |B|") for row in event.rows)
