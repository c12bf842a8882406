"""What a trace makes on demand: the whole lattice with what forbids each edge, active-set steps, dropped words."""

from __future__ import annotations

import random
from itertools import pairwise
from math import inf, isclose

import numpy as np
import pytest

from facade_nb import DesignError, gallery, solve
from facade_nb.solver import Letter, Objective, Trace, align
from facade_nb.solver.alignment.group import make_group
from facade_nb.solver.events import EdgeWeighed, LeftOut, PathChosen, WordJudged
from facade_nb.solver.model.sizing import FREE
from facade_nb.solver.sizing.least_squares import least_squares
from facade_nb.solver.trace.active_set import steps
from facade_nb.solver.trace.lattice import Lattice, LatticeEdge, lattice_of
from facade_nb.solver.trace.weights import judge
from tests.oracle.designs import design

A, B, C = Letter("A", 2.0), Letter("B", 3.0), Letter("C", 2.0)
E = Letter("e", 8.0, transparent=True)
PAPER = Objective.paper()


def lattice(
    rows: list[list[Letter]],
    canvas: float = 12.0,
    tolerance: float = 12.0,
    objective: Objective = PAPER,
    cuts: bool = True,
    **most: int,
) -> Lattice:
    return lattice_of(make_group(rows, canvas, tolerance, objective, cuts=cuts), **most)


def find(
    found: Lattice, column: tuple[tuple[int, ...], ...], rests: tuple[str, ...] | None = None
) -> LatticeEdge:
    """The edge with these letters, from the node where this is still to come."""
    edges = [
        e
        for e in found.edges
        if e.column == column and (rests is None or found.nodes[e.source].rests == rests)
    ]
    assert len(edges) == 1, edges
    return edges[0]


class TestLattice:
    def test_figure_8(self) -> None:
        """The network of (CeC, ABABA) has 4 × 6 nodes, and one path of three edges without an error."""
        found = lattice([[C, E, C], [A, B, A, B, A]], tolerance=0.0, cuts=False)
        assert {node.rests for node in found.nodes} == {
            (x, y)
            for x in ("C e C", "e C", "C", "ε")
            for y in ("A B A B A", "B A B A", "A B A", "B A", "A", "ε")
        }
        assert len(found.nodes) == 24
        free = [e for e in found.edges if e.constraint is None and found.nodes[e.source].reachable]
        path = [e for e in free if found.nodes[e.target].alive]
        assert [(e.column, e.omega) for e in path] == [
            (((0,), (0,)), 0.0), (((1,), (1, 2, 3)), 0.0), (((2,), (4,)), 0.0),
        ]  # fmt: skip
        assert find(found, ((0,), (0, 1)), ("C e C", "A B A B A")).constraint == "omega"

    def test_edges_are_all_columns(self) -> None:
        """From a node where both words have n letters left lead (n + 1)² − 1 edges."""
        found = lattice([[A] * 3, [B] * 3], objective=Objective(), canvas=9.0)
        out = [e for e in found.edges if e.source == 0]
        assert len(out) == 15 and len(found.nodes) == 16
        assert len(found.edges) == sum((i + 1) * (j + 1) - 1 for i in range(4) for j in range(4))

    @pytest.mark.parametrize(
        ("rows", "column", "constraint", "blamed", "text"),
        [
            ([[Letter("D", 1.0, opaque=False)], [A]], ((0,), ()), "C1", ((0, 0),), "D is not opaque, and no row"),
            ([[C, E], [A]], ((0, 1), ()), "C2", ((0, 0), (0, 1)), "C e of row 0 are partly transparent"),
            ([[Letter("P", 1.0, opaque=False)], [Letter("D", 1.0, unoccludable=True)]], ((0,), (0,)), "C3",
             ((0, 0), (1, 0)), "D is unoccludable, and P above it is not opaque"),
            ([[A], [B]], ((0,), (0,)), "omega", ((0, 0), (1, 0)), "A (2 m) and B (3 m) differ by 1 m, more than μ"),
            ([[A], [A, A, A, A]], ((), (0,)), None, (), ""),
        ],
    )  # fmt: skip
    def test_each_constraint_names_who_is_to_blame(
        self,
        rows: list[list[Letter]],
        column: tuple[tuple[int, ...], ...],
        constraint: str | None,
        blamed: tuple[tuple[int, int], ...],
        text: str,
    ) -> None:
        found = lattice(rows, canvas=8.0, tolerance=0.5 if constraint in ("omega", None) else 8.0)
        edge = next(e for e in found.edges if e.column == column and e.source == 0)
        assert (edge.constraint, edge.letters) == (constraint, blamed)
        assert text in edge.text

    def test_attached_letters(self) -> None:
        """C4, on both sides of the letter."""
        tied = Letter("B", 1.0, attached=True)
        found = lattice([[tied], [A, A]], canvas=4.0, tolerance=4.0)
        before = [e for e in found.edges if e.constraint == "C4" and e.column[0] == (0,)]
        after = [e for e in found.edges if e.constraint == "C4" and e.column[0] == ()]
        assert before and after
        assert {e.text for e in before} == {
            "B is attached and begins its element, but row 0 was empty before it (C4)."
        }
        assert {e.text for e in after} == {
            "B is attached and ends its element, so row 0 may not be empty next (C4)."
        }

    def test_width_and_boundary(self) -> None:
        found = lattice([[A, A], [B, B]], canvas=6.0, tolerance=1.0)
        wide = [e for e in found.edges if e.constraint == "width"]
        assert wide and all("m larger than canvas + μ" in e.text for e in wide)
        assert not any(found.nodes[e.target].alive and e.constraint is None for e in wide)
        twice = lattice([[E, C], [Letter("f", 8.0, transparent=True), C]], objective=Objective())
        edges = [e for e in twice.edges if e.constraint == "boundary"]
        assert edges and all(twice.nodes[e.source].owed for e in edges)
        assert all(rest[0] == "…" for e in edges for rest in twice.nodes[e.source].rests)

    @pytest.mark.parametrize("objective", [Objective(), PAPER], ids=["default", "paper"])
    def test_its_cheapest_path_is_the_alignment(self, objective: Objective) -> None:
        """Solid words: what the search finds among the edges it makes is the best path among all permitted ones."""
        aligned = 0
        for seed in range(60):
            rows, canvas, tolerance = random_rows(seed)
            best = align(rows, canvas, tolerance, objective, search="best")
            found = lattice(rows, canvas, tolerance, objective)
            least = cheapest(found, canvas, tolerance, objective)
            assert (best is None) == (least == inf), seed
            if best is not None:
                assert least == pytest.approx(best.cost, abs=1e-9), seed
                aligned += 1
        assert aligned > 15

    def test_where_an_alignment_is_there_is_a_path(self) -> None:
        """With cut letters the edges are a lower bound, where W may be what it likes."""
        objective = Objective(fit=0.0)
        for seed in range(40):
            rows, canvas, tolerance = random_rows(seed)
            rows[0] = [Letter("e", 1.0, transparent=True), *rows[0], Letter("f", None, transparent=True)]
            best = align(rows, canvas, tolerance, objective, search="best")
            least = cheapest(lattice(rows, canvas, tolerance, objective), canvas, inf, objective)
            assert best is None or least <= best.cost + 1e-9, seed

    def test_it_has_an_end(self) -> None:
        found = lattice([[A, B] * 6, [B, A] * 6], canvas=30.0, nodes=20, edges=50)
        assert (len(found.nodes), len(found.edges)) == (20, 50) and found.left_out > 0
        with pytest.raises(ValueError, match="one or two different words, found 3"):
            lattice([[A], [B], [C, C]])


def random_rows(seed: int) -> tuple[list[list[Letter]], float, float]:
    pick = random.Random(seed)
    symbols = [
        Letter(
            name,
            pick.choice([0.5, 1.0, 1.3, 2.0]),
            opaque=pick.random() < 0.75,
            attached=pick.random() < 0.25,
            unoccludable=pick.random() < 0.25,
        )
        for name in "ABCD"
    ]
    rows = [[pick.choice(symbols) for _ in range(pick.randint(1, 4))] for _ in range(2)]
    return rows, pick.choice([2.0, 3.0, 4.0]), pick.choice([0.3, 0.8, 2.0])


def cheapest(found: Lattice, canvas: float, tolerance: float, objective: Objective) -> float:
    """Least J of a path of permitted edges: every cost and width that can be reached, node by node."""
    reached: dict[int, dict[float, float]] = {0: {0.0: 0.0}}
    for edge in found.edges:  # they come in an order in which all that leads to a node comes first
        if edge.constraint is None and edge.cost is not None and edge.width is not None:
            for width, cost in reached.get(edge.source, {}).items():
                into = reached.setdefault(edge.target, {})
                total = round(width + edge.width, 9)
                into[total] = min(into.get(total, inf), cost + edge.cost)
    ends = [n.number for n in found.nodes if set(n.rests) == {"ε"}]
    return min(
        (
            cost + objective.fit * abs(width - canvas)
            for n in ends
            for width, cost in reached.get(n, {}).items()
            if abs(width - canvas) <= tolerance + 1e-9
        ),
        default=inf,
    )


@pytest.fixture(scope="module")
def trace() -> Trace:
    """Of the residential house, written and read."""
    return Trace.from_json(
        solve(gallery.load("residential-house"), trace=True, time_limit=None).trace.to_json()
    )


class TestOfATrace:
    def test_more_words_are_told_as_walked(self, trace: Trace) -> None:
        found = trace.lattice("x", "default")
        (path,) = [e for e in trace.of_kind(PathChosen, "x") if e.group == "default"]
        assert len(found.bands) == 3
        weighed = {
            (e.places, e.after, e.column)
            for e in trace.of_kind(EdgeWeighed, "x")
            if e.network == path.network
        }
        told = {
            (found.nodes[e.source].places, found.nodes[e.target].places, e.column)
            for e in found.edges
            if e.constraint is None
        }
        assert told == weighed
        on_path = [node.places for node in found.nodes if node.alive]
        assert set(on_path) == {(0, 0, 0), *(column.after for column in path.columns)}

    def test_a_pair_of_them(self, trace: Trace) -> None:
        """Columns of the alignment, seen by two of its words, are permitted edges of their lattice."""
        found = trace.lattice("x", "default", bands=(1, 2))
        assert [len(band.letters) for band in found.bands] == [3, 7]
        assert found.nodes[0].rests == ("C e C", "A B A B A B A")
        assert any(node.alive and node.rests == ("ε", "ε") for node in found.nodes)
        assert len(found.node_frame()) == len(found.nodes) and len(found.edge_frame()) == len(found.edges)
        assert set(found.edge_frame().constraint.dropna()) >= {"C2"}

    def test_an_unknown_group(self, trace: Trace) -> None:
        with pytest.raises(DesignError, match="found 'defalt'; did you mean 'default'"):
            trace.lattice("x", "defalt")


class TestJudge:
    """Alignments that somebody makes up."""

    def test_the_chosen_one(self, trace: Trace) -> None:
        for path in trace.of_kind(PathChosen):
            told = trace.judge(path.axis, path.group, [column.letters for column in path.columns])
            assert [refused for _, refused in told] == [None] * len(path.columns)
            for (weight, _), column in zip(told, path.columns, strict=True):
                assert weight.omega <= column.omega + 1e-9 and weight.width <= column.width + 1e-9

    def test_what_breaks(self) -> None:
        group = make_group([[C, E, C], [A, B, A, B, A]], 12.0, 0.5, PAPER)
        made = [((0,), (0,)), ((1,), (1, 2)), ((1,), (3,)), ((2,), (4,))]
        assert [(w.omega, r) for w, r in judge(group, made)] == [(0.0, None)] * 4
        moved = [((0,), (0, 1)), ((1,), (2,)), ((1,), (3,)), ((2,), (4,))]
        assert [r and r.constraint for _, r in judge(group, moved)] == ["omega", None, None, None]
        assert judge(group, moved)[0][0].omega == 3.0
        mixed = [((0, 1), (0, 1)), ((1,), (2, 3)), ((), ()), ((2,), (4,))]
        assert [r and r.constraint for _, r in judge(group, mixed)] == ["C2", None, "empty", None]
        held = make_group([[Letter("B", 3.0, attached=True)], [A, B]], 5.0, 5.0, PAPER)
        told = judge(held, [((), (0,)), ((0,), (1,))])
        assert [r and r.constraint for _, r in told] == [None, "C4"]

    @pytest.mark.parametrize(
        ("columns", "told"),
        [
            (
                [((0,), (1,)), ((), (0,))],
                r"column 0: row 1 cannot have the letters \[1\] after 0 have been read",
            ),
            ([((0,), (0,)), ((0,), (1,))], "column 0: row 0 cannot have"),
            ([((0,), (0,))], "do not hold all letters"),
        ],
    )
    def test_what_is_no_alignment(self, columns: list[tuple[tuple[int, ...], ...]], told: str) -> None:
        with pytest.raises(ValueError, match=told):
            judge(make_group([[A], [B, A]], 5.0, 5.0, PAPER), columns)


class TestActiveSet:
    def test_one_by_one(self) -> None:
        """Three sizes that are to be 1, 1 and 4, in 5 metres, the last at most 3.2."""
        rows = np.array([[1.0, 1.0, 1.0]])
        lower, upper = np.array([0.0, 0.0, 0.0, 5.0]), np.array([FREE, FREE, 3.2, 5.0])
        run = steps(np.ones(3), np.array([1.0, 1.0, 4.0]), rows, lower, upper)
        assert [(step.entered, step.left) for step in run.steps] == [((3,), ()), ((2,), ())]
        assert run.steps[0].x == pytest.approx([2 / 3, 2 / 3, 11 / 3])
        assert run.steps[0].violation == pytest.approx(11 / 3 - 3.2)
        assert run.x == pytest.approx([0.9, 0.9, 3.2]) and run.complete

    def test_what_enters_may_leave(self) -> None:
        rows = np.array([[1.0, 1.0], [1.0, 0.2]])
        lower, upper = np.full(4, -FREE), np.array([FREE, FREE, 1.0, 0.9])
        run = steps(np.ones(2), np.array([2.0, 1.0]), rows, lower, upper)
        answer = least_squares(np.ones(2), np.array([2.0, 1.0]), rows, lower, upper)
        assert answer is not None and run.x == pytest.approx(answer.x)

    def test_random_systems(self) -> None:
        """It ends where the QP code ends; the objective only grows, as constraints are taken up one by one."""
        left = 0
        for seed in range(150):
            pick = np.random.default_rng(seed)
            n, m = int(pick.integers(2, 7)), int(pick.integers(1, 9))
            weight, target = pick.choice([0.5, 1.0, 2.0], size=n), pick.normal(size=n) * 2
            rows, middle = pick.choice([-1.0, 0.0, 1.0, 0.3], size=(m, n)), pick.normal(size=n + m)
            spread = pick.choice([0.0, 0.5, 1.0, FREE], size=n + m, p=[0.1, 0.3, 0.4, 0.2])
            lower = np.where(spread >= FREE, -FREE, middle - spread)
            upper = np.where(spread >= FREE, FREE, middle + spread)
            answer = least_squares(weight, target, rows, lower, upper)
            run = steps(weight, target, rows, lower, upper)
            assert run.complete == (answer is not None), seed
            if answer is not None:
                assert run.x == pytest.approx(answer.x, abs=1e-6), seed
                values = [step.objective for step in run.steps]
                assert all(a <= b + 1e-9 for a, b in pairwise(values)), seed
                left += sum(len(step.left) for step in run.steps)
        assert left > 5

    def test_singular_weights(self) -> None:
        """What no weight holds stays where it would like to be, as far as it may."""
        rows = np.array([[1.0, 1.0, -1.0]])
        lower, upper = np.array([0.0, 0.0, 0.0, 0.0]), np.array([FREE, FREE, 2.0, 0.0])
        args = (np.array([1.0, 1.0, 0.0]), np.array([2.0, 1.0, 0.5]), rows, lower, upper)
        answer = least_squares(*args)
        run = steps(*args)
        assert answer is not None and run.x == pytest.approx(answer.x, abs=1e-7)
        assert run.steps[-1].entered == (2,) and run.steps[-1].x == pytest.approx(run.x)


class TestWords:
    def test_figure_7(self) -> None:
        """Both bounds of Eq. 7, and words on either side of them, finite in number."""
        trace = solve(gallery.load("figure-7"), trace=True, time_limit=None).trace
        told = trace.of_kind(WordJudged, "x")
        reasons = {e.reason for e in told}
        assert {"fits", "too long"} <= reasons <= {"fits", "too long", "no partner"} and len(told) < 200
        for event in told:
            assert event.kept == (event.reason == "fits")
            assert event.size == pytest.approx(sum(letter.size or 0.0 for letter in event.letters))
            unsized = any(letter.size is None for letter in event.letters)
            assert (event.low is None) == unsized
            low = -inf if event.low is None else event.low
            fits = low - 1e-9 <= event.size <= event.high + 1e-9
            assert event.kept == (fits and event.reason != "no partner")
        longest = max(told, key=lambda e: e.size)
        assert longest.size < 2 * longest.high

    def test_what_stands_above_lowers_the_bound(self) -> None:
        one = design({"A": 1.0, "B": 0.5}, {"top": "A^k", "low": "B^l"}, ["top", "low"], 4.0)
        trace = solve(one, trace=True, tolerances=(0.25,), time_limit=None).trace
        bounds = {e.pattern: (e.low, e.high) for e in trace.of_kind(WordJudged, "x")}
        assert bounds == {"top": (3.0, 5.0), "low": (pytest.approx(-2.0), 5.0)}
        sizes = {e.size: e.reason for e in trace.of_kind(WordJudged, "x") if e.pattern == "top"}
        assert (sizes[3.0], sizes[5.0], sizes[6.0], sizes[2.0]) == ("fits", "fits", "too long", "too short")

    def test_alternatives(self) -> None:
        one = design(
            {"A": 1.0, "B": 2.0, "C": 1.0}, {"a": "(A|B(C|A))C^k", "b": "mt; m := A|B"}, ["b", "a"], 4.0
        )
        trace = solve(one, trace=True, time_limit=None).trace
        told = {e.word: e.choices for e in trace.of_kind(WordJudged, "x") if e.counters.get("k", 0) == 0}
        assert told["A"] == ("A",) and told["B C"] == ("B(C|A)", "C") and told["B A"] == ("B(C|A)", "A")
        assert told["A t"] == ("A",) and told["B t"] == ("B",)

    def test_many(self, monkeypatch: pytest.MonkeyPatch) -> None:
        from facade_nb.solver.trace import word_events as spelled

        monkeypatch.setattr(spelled, "WORDS", 3)
        monkeypatch.setattr(spelled, "DROPPED", 2)
        monkeypatch.setattr(spelled, "UNTRIED", 1)
        one = design({"A": 1.0, "B": 0.5}, {"a": "A^kB^l"}, ["a"], 4.0)
        trace = solve(one, trace=True, time_limit=None).trace
        assert [e.kept for e in trace.of_kind(WordJudged, "x") if e.pattern == "a"].count(True) == 3
        assert {e.what for e in trace.of_kind(LeftOut, "x")} >= {"words of a", "candidates"}


def test_costs_of_edges_add_up() -> None:
    """Where nothing is elastic, J of the chosen path is the sum of its edges."""
    one = design({"A": 1.0, "B": 0.9, "C": 0.4}, {"a": "A^k", "b": "(BC)^l"}, ["a", "b"], 5.1)
    layout = solve(one, trace=True, time_limit=None)
    (path,) = layout.trace.of_kind(PathChosen, "x")
    edges = {e.path: e for e in layout.trace.of_kind(EdgeWeighed, "x") if e.network == path.network}
    steps_taken = [edges[n] for n in path.nodes[1:]]
    assert isclose(sum(e.cost for e in steps_taken), layout.x.cost, abs_tol=1e-9)
    assert isclose(sum(e.omega for e in steps_taken), path.error, abs_tol=1e-9)
    assert [e.omega for e in steps_taken] == pytest.approx([column.omega for column in path.columns])
