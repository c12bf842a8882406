"""`search_ida`, the paper's alignment search, as a whole: known answers, exactness, and what an observer is told."""

from __future__ import annotations

import doctest
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from facade_nb.solver import Letter, Objective, align
from facade_nb.solver.alignment.core.search import search_best
from facade_nb.solver.alignment.found import Found
from facade_nb.solver.alignment.group import Group, make_group
from facade_nb.solver.alignment.paper.ida import search_ida
from facade_nb.solver.alignment.pricing import Priced
from facade_nb.solver.budget import Stopped
from tests.oracle import Case
from tests.solver.ida_cases import case_group, group_of, letters, random_case


def columns_of(group: Group, found: Found) -> list[str]:
    """The columns of an alignment, as "C/A"; a cut letter stands in each column it spans."""
    assert found.best is not None
    return [
        "/".join(
            "".join(group.bands[b].letters[i].symbol for i in column[b].letters) or "ε" for b in group.band_of
        )
        for column in found.best.structure[0]
    ]


class TestKnownAnswers:
    """The paper's figures."""

    ROWS = ("C:2 e:8 C:2", "A:2 B:3 A:2 B:3 A:2")

    def test_figure_8_without_cuts(self) -> None:
        group = group_of(self.ROWS, cuts=False)
        found = search_ida([group])
        assert found.best is not None and found.best.omega == 0.0
        assert columns_of(group, found) == ["C/A", "e/BAB", "C/A"]

    def test_figure_8_with_cuts(self) -> None:
        group = group_of(self.ROWS)
        found = search_ida([group])
        assert found.best is not None and found.best.omega == pytest.approx(0.0, abs=1e-9)
        assert columns_of(group, found) == ["C/A", "e/B", "e/A", "e/B", "C/A"]

    def test_transparent_splits(self) -> None:
        rows = ("f:5 A:2 f:5", *self.ROWS)
        assert search_ida([group_of(rows, tolerance=4.0, cuts=False)]).best is None
        group = group_of(rows)
        found = search_ida([group])
        assert columns_of(group, found) == ["f/C/A", "f/e/B", "A/e/A", "f/e/B", "f/C/A"]
        assert found.best is not None
        widths = [max(sum(own) for own in column) for column in found.best.pieces[0]]
        assert widths == pytest.approx([2, 3, 2, 3, 2])

    def test_opaque_symbols_make_space(self) -> None:
        """Supplement 3.2."""
        group = group_of(("I:1 B°:4 I:1 B°:4 I:1", "A:4 A:4"), tolerance=1.0)
        found = search_ida([group])
        assert columns_of(group, found) == ["I/ε", "B/A", "I/ε", "B/A", "I/ε"]
        assert found.best is not None and found.best.omega == 0.0 and found.best.widths == (11.0,)


SEEDS = range(3000, 3060)


class TestExactness:
    def test_like_best_first(self) -> None:
        """The same cost, properness and number of columns as the other search, which knows nothing of this one."""
        found_any = 0
        for seed in SEEDS:
            case = random_case(seed)
            if not any(case.rows):
                continue
            expected = search_best([case_group(case)], nodes=3000)
            if expected.cut:
                continue
            found = search_ida([case_group(case)])
            assert (found.best is None) == (expected.best is None), case
            if found.best is None or expected.best is None:
                assert found.bound == float("inf")
                continue
            found_any += 1
            assert found.best.cost == pytest.approx(expected.best.cost, abs=1e-7), case
            assert found.best.proper == expected.best.proper, case
            if found.best.proper:
                assert found.best.columns == expected.best.columns, case
            assert found.bound == pytest.approx(found.best.cost)
        assert found_any > len(SEEDS) / 3

    def test_good_alignments_first_or_not(self) -> None:
        """Prealigning and merging are heuristics; the answer does not depend on them."""
        for seed in SEEDS[:12]:
            case = random_case(seed)
            if not any(case.rows):
                continue
            late, soon = search_ida([case_group(case)]), search_ida([case_group(case)], patience=0)
            assert (late.best is None) == (soon.best is None), case
            if late.best is not None and soon.best is not None:
                assert soon.best.cost == pytest.approx(late.best.cost, abs=1e-7), case
                assert (soon.best.proper, soon.best.columns) == (late.best.proper, late.best.columns), case

    def test_from_the_other_end(self) -> None:
        """Nothing depends on the direction of reading."""
        for seed in SEEDS[:16]:
            case = random_case(seed)
            if not any(case.rows):
                continue
            turned = Case(
                tuple(tuple(reversed(row)) for row in case.rows),
                case.canvas,
                case.tolerance,
                case.weights,
                case.cuts,
            )
            one, other = search_ida([case_group(case)]).best, search_ida([case_group(turned)]).best
            assert (one is None) == (other is None), case
            if one is not None and other is not None:
                assert one.cost == pytest.approx(other.cost, abs=1e-7), case
                assert one.columns == other.columns, case

    def test_groups_that_share_an_unsized_symbol(self) -> None:
        """They are read one after the other on one path; both ends agree on one size."""
        free: frozenset[str] = frozenset()

        def groups() -> list[Group]:
            return [
                make_group([letters(row) for row in rows], 6.0, 2.0, Objective(), free=free)
                for rows in (("u B:2", "A:1 A:2 B:2"), ("B:2 u", "B:1.5 C:4"))
            ]

        found, expected = search_ida(groups()), search_best(groups())
        assert found.best is not None and expected.best is not None
        assert found.best.cost == pytest.approx(expected.best.cost, abs=1e-7)
        assert found.best.columns == expected.best.columns
        assert set(found.best.unsized) == {"u"}


@pytest.mark.parametrize(
    ("rows", "canvas", "tolerance", "objective", "cost", "columns"),
    [
        (("b:.5 b:.5", "a:.5 b:.5", "a:.5", "a:.5 b:.5"), 1.0, 0.5, Objective(1.5, 0.1, 0.6), 0.25, 4),
        (("A°:.5 b:.5", "a:.5", "b:.5 b:.5", "A°:.5 A°:.5"), 1.0, 1.0, Objective(0.05, 1.0, 0.0), 0.00625, 2),
    ],
)
def test_many_ways_to_cut_at_one_cost(
    rows: tuple[str, ...], canvas: float, tolerance: float, objective: Objective, cost: float, columns: int
) -> None:
    """Words of placeholders alone: without linear programmes on the way these take hundreds of thousands of nodes."""
    found = search_ida([group_of(rows, canvas, tolerance, objective)])
    assert found.best is not None and found.best.proper
    assert found.best.cost == pytest.approx(cost) and found.best.columns == columns
    assert found.nodes < 8000


class TestArguments:
    GROUP = ("C:2 C:1 C:2", "A:1.5 B:1 A:2.6")

    def group(self) -> Group:
        return group_of(self.GROUP, 5.0, 2.0, Objective())

    def test_cap(self) -> None:
        """Below the optimum nothing is found, and the cap is proven; taken further, the same group gives it."""
        group = self.group()
        best = search_ida([group]).best
        assert best is not None
        group = self.group()
        low = search_ida([group], cap=0.5 * best.cost)
        assert low.best is None and not low.cut and 0.5 * best.cost <= low.bound <= best.cost + 1e-9
        again = search_ida([group], cap=best.cost)
        assert again.best is not None and again.best.cost == pytest.approx(best.cost)

    def test_keep(self) -> None:
        """Equally good structures, and none twice."""
        group = group_of(("A:1 A:1", "B:1"), 2.0, 1.0, Objective())
        many = search_ida([group], keep=8).ties
        assert len(many) == 2
        assert len({tuple(tuple(id(o) for o in column) for column in p.structure[0]) for p in many}) == 2
        assert len(search_ida([group], keep=1).ties) == 1

    def test_nodes(self) -> None:
        """Out of nodes it says so, with a bound that holds."""
        rows = ("A:1 A:1.2 A:1.4 " * 3, "B:1.1 B:1.3 " * 4)
        found = search_ida([group_of(rows, 11.0, 2.0, Objective())], nodes=5)
        best = search_ida([group_of(rows, 11.0, 2.0, Objective())]).best
        assert best is not None
        assert found.cut and found.bound <= best.cost + 1e-9

    def test_accept(self) -> None:
        """What is not accepted is passed over for the next best."""
        best = search_ida([self.group()]).best
        assert best is not None

        def other(priced: Priced) -> bool:
            return priced.cost > best.cost + 1e-6

        second, expected = search_ida([self.group()], accept=other), search_best([self.group()], accept=other)
        assert second.best is not None and expected.best is not None
        assert second.best.cost == pytest.approx(expected.best.cost) and second.best.cost > best.cost

    def test_check_may_stop_it(self) -> None:
        def stop() -> None:
            raise Stopped

        with pytest.raises(Stopped):
            search_ida(
                [group_of(("A:1 " * 12, "B:1.1 " * 11, "C:1.2 " * 10), 12.0, 6.0, Objective())], check=stop
            )

    def test_a_word_without_letters_at_all(self) -> None:
        assert search_ida([make_group([(), ()], 0.0, 1.0, Objective())]).best is None


@dataclass
class Notes:
    """An observer that writes everything down."""

    limits: list[float] = field(default_factory=list)
    proven: list[float] = field(default_factory=list)
    pruned_by: list[tuple[str, float, float, float]] = field(default_factory=list)
    nodes: list[tuple[str, tuple[int, ...], float, float]] = field(default_factory=list)
    regions: dict[tuple[str, tuple[int, ...]], object] = field(default_factory=dict)
    edges: list[tuple[str, tuple[int, ...], tuple[tuple[int, ...], ...], float]] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)
    joints: list[tuple[tuple[int, ...], float]] = field(default_factory=list)
    control: list[tuple[object, float]] = field(default_factory=list)
    pairs: list[tuple[object, float]] = field(default_factory=list)

    def deepened(self, limit: float, bound: float) -> None:
        self.limits.append(limit)
        self.proven.append(bound)

    def visited(self, way: str, group: int, places: tuple[int, ...], cost: float, bound: float) -> None:
        self.nodes.append((way, places, cost, bound))

    def traced(
        self, way: str, group: int, places: tuple[int, ...], words: object, lower: object, upper: object
    ) -> None:
        self.regions[way, places] = (words, lower, upper)

    def weighed(
        self,
        way: str,
        group: int,
        places: tuple[int, ...],
        column: tuple[tuple[int, ...], ...],
        error: float,
        cost: float,
        after: tuple[int, ...],
    ) -> None:
        self.edges.append((way, places, column, error))

    def forbidden(
        self,
        way: str,
        group: int,
        places: tuple[int, ...],
        column: tuple[tuple[int, ...], ...],
        constraint: str,
    ) -> None:
        self.faults.append(constraint)

    def pruned(
        self,
        way: str,
        group: int,
        places: tuple[int, ...],
        column: tuple[tuple[int, ...], ...],
        after: tuple[int, ...],
        reason: str,
        cost: float,
        bound: float,
        against: float,
    ) -> None:
        self.pruned_by.append((reason, cost, bound, against))

    def met(self, group: int, places: tuple[int, ...], cost: float, columns: int) -> None:
        self.joints.append((places, cost))

    def prealigned(self, nodes: object, cost: float) -> None:
        self.control.append((nodes, cost))

    def merged(self, parts: object, cost: float) -> None:
        self.pairs.append((parts, cost))


class TestObserver:
    ROWS = ("C:2 e:8 C:2", "A:2 B:3.5 A:2 B:3 A:1.8")

    def test_what_it_is_told(self) -> None:
        notes = Notes()
        group = group_of(self.ROWS, 12.0, 1.0, Objective(), cuts=False)
        found = search_ida([group], observer=notes)
        assert found.best is not None
        assert notes.limits == sorted(notes.limits) and notes.limits[0] < found.best.cost <= notes.limits[-1]
        assert all(
            a <= b for a, b in zip(notes.proven, notes.limits, strict=True)
        ) and notes.proven == sorted(notes.proven)
        for reason, cost, bound, against in notes.pruned_by:
            assert (cost >= against - 1e-9) if reason == "known" else (bound >= against - 1e-9)
        assert {way for way, *_ in notes.nodes} == {"forward", "backward"}
        assert len(notes.nodes) == found.nodes
        # forward beyond the middle by one edge at most, backward never
        total = 6 + 10
        for way, places, cost, bound in notes.nodes:
            assert cost <= bound + 1e-9
            if way == "backward":
                assert 2 * sum(places) >= total
        taken_up = {places for way, places, *_ in notes.nodes if way == "forward"}
        assert any(2 * sum(places) < total for places in taken_up)
        assert not any(way == "forward" and 2 * sum(places) >= total for way, places, *_ in notes.edges)
        assert notes.joints[-1][1] == pytest.approx(found.best.cost)
        assert min(cost for _, cost in notes.joints) == pytest.approx(found.best.cost)
        # an edge is weighed only from a node that was taken up, and errs by what it says
        taken = {(way, places) for way, places, *_ in notes.nodes} | {
            ("forward", (0, 0)),
            ("backward", (6, 10)),
        }
        for way, places, column, error in notes.edges:
            assert (way, places) in taken
            sizes = [
                sum(group.bands[b].letters[i].size or 0.0 for i in own) for b, own in enumerate(column) if own
            ]
            assert error == pytest.approx(max(sizes) - min(sizes))
            assert error <= group.tolerance + 1e-9
        assert len(notes.edges) == len(set(notes.edges)), "an edge was weighed twice"

    def test_it_changes_nothing(self) -> None:
        for seed in SEEDS[:12]:
            case = random_case(seed)
            if any(case.rows):
                watched, alone = (
                    search_ida([case_group(case)], observer=Notes()),
                    search_ida([case_group(case)]),
                )
                assert watched.nodes == alone.nodes and watched.bound == alone.bound

    def test_prealigning_and_merging(self) -> None:
        """f d f with d := A B A over two solid words: the control words meet at the ends of the content."""
        notes = Notes()
        content = [Letter(s, size, origin=("d", 0)) for s, size in (("A", 2.0), ("B", 3.0), ("A", 2.0))]
        f = Letter("f", 2.5, transparent=True)
        rows = [(f, *content, f), letters("C:2.5 D:7 C:2.5"), letters("E:2.4 F:7 E:2.6")]
        group = make_group(rows, 12.0, 2.0, Objective())
        found = search_ida([group], observer=notes, patience=0)
        assert found.best is not None
        ((nodes, cost),) = notes.control
        assert cost >= found.best.cost - 1e-9
        ((_, chain),) = nodes  # type: ignore[misc,attr-defined]
        passed = {(place[0], place[1]) for place in chain}
        assert {(2, 2), (8, 4)} <= passed, "no gate at the ends of d"
        ((parts, merged),) = notes.pairs
        assert parts and merged >= found.best.cost - 1e-9


def test_the_page_about_it() -> None:
    """The examples of docs/alignment-search.md."""
    page = Path(__file__).parents[2] / "docs" / "alignment-search.md"
    outcome = doctest.testfile(
        str(page), module_relative=False, encoding="utf-8", optionflags=doctest.REPORT_NDIFF
    )
    assert outcome.attempted > 20 and outcome.failed == 0


def test_align_uses_it() -> None:
    """`align` takes this search unless told otherwise (its docstring)."""
    found = align([letters("C:2 e:8 C:2"), letters("A:2 B:3 A:2 B:3 A:2")], cuts=False)
    assert found is not None and str(found) == "C/A | e/B A B | C/A"
