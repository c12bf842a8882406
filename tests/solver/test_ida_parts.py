"""The parts of the paper's alignment search, each by itself (`facade_nb.solver.alignment.paper`)."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import accumulate, pairwise, product

import pytest

from facade_nb.solver import Letter, Objective
from facade_nb.solver.alignment.core.search import search_best
from facade_nb.solver.alignment.elements import Option
from facade_nb.solver.alignment.group import Group, make_group
from facade_nb.solver.alignment.paper.decision_network import Lattice, mirrored
from facade_nb.solver.alignment.paper.deepening import Deepening, Ends
from facade_nb.solver.alignment.paper.guides import Guide, nodes_between
from facade_nb.solver.alignment.paper.halves import Half, Side
from facade_nb.solver.alignment.paper.hierarchy import Hierarchy
from facade_nb.solver.alignment.paper.pieces import Stretch, excess, ledger_bound
from facade_nb.solver.alignment.paper.prealignment import control_group, control_guides, control_word
from facade_nb.solver.alignment.paper.relaxation import Relaxation
from facade_nb.solver.alignment.paper.tolerance_region import trace
from facade_nb.solver.alignment.paper.transposition import Transpositions
from facade_nb.solver.alignment.paper.word_pairs import merged_guides
from facade_nb.solver.alignment.pricing import Priced, Structure
from facade_nb.solver.model.precision import EPS
from tests.solver.ida_cases import PAPER, case_group, group_of, letters, random_case


def some_groups(count: int, first: int = 7000) -> Iterator[Group]:
    for seed in range(first, first + count):
        case = random_case(seed)
        if any(case.rows):
            yield case_group(case)


class TestTracing:
    """Supplement 3.3 and its Figure 6."""

    def test_figure_8(self) -> None:
        """From the first node of (CeC, ABABA): Ce errs by 0 with ABAB, C with A, all with all."""
        totals = [0.0, 2.0, 10.0, 12.0], [0.0, 2.0, 5.0, 7.0, 10.0, 12.0]
        region = trace(*totals, 1.0, keep=True)
        inside = [(i, j) for i in range(4) for j in range(region.first[i], region.last[i] + 1)]
        assert inside == [(0, 0), (1, 1), (2, 4), (3, 5)]
        assert region.lower[:4] == ((0, 0), (0, 1), (1, 1), (1, 2))
        assert region.upper[:4] == ((0, 0), (1, 0), (1, 1), (2, 1))

    @pytest.mark.parametrize("seed", range(40))
    def test_all_pairs_within_the_tolerance_and_no_other(self, seed: int) -> None:
        rng = random.Random(seed)
        a, b = (
            [0.0, *accumulate(rng.choice([0.3, 0.8, 1.0, 2.0, 2.6]) for _ in range(rng.randrange(9)))]
            for _ in range(2)
        )
        mu = rng.choice([0.0, 0.1, 0.5, 1.0, 3.0])
        region = trace(a, b, mu, keep=True)
        for i, j in product(range(len(a)), range(len(b))):
            assert (region.first[i] <= j <= region.last[i]) == (abs(a[i] - b[j]) <= mu + EPS), (i, j)
        for walk in (region.lower, region.upper):
            steps = [(k - i, m - j) for (i, j), (k, m) in pairwise(walk)]
            assert set(steps) <= {(0, 1), (1, 0)}, "one letter of one word at a time"
            assert len(walk) <= len(a) + len(b) - 1


class TestHierarchy:
    def test_two_words_are_bounded_by_what_they_cost(self) -> None:
        """Where no constraint matters and W is the canvas, the pair's bound is the optimum itself."""
        group = group_of(("A:2 B:1.5 C:2.2", "D:1.9 E:3.9"), 5.9, 3.0, Objective())
        best = search_best([group]).best
        assert best is not None and best.cost == pytest.approx(0.1 + 0.2 + 0.25 / 2 * 1.5)
        assert Hierarchy(group).ahead(group.start) == pytest.approx(best.cost)

    def test_no_alignment_costs_less(self) -> None:
        told = 0
        for group in some_groups(60):
            found = search_best([group], nodes=2000)
            if found.best is None or found.cut:
                continue
            ahead = Hierarchy(group).ahead(group.start)
            assert ahead <= found.best.cost + 1e-9
            told += ahead > 0.3 * found.best.cost > 0.0
        assert told > 5, "a bound that says nothing"


class TestWeighing:
    @pytest.mark.parametrize("first", [7200, 7300])
    def test_edges_are_those_that_the_constraints_and_the_limit_leave(self, first: int) -> None:
        """Against all products of elements, from nodes reached at random."""
        rng = random.Random(first)
        for group in some_groups(30, first):
            lattice = Lattice(group)
            state, owed = group.start, False
            for _ in range(3):
                if any(not band.options(p) for band, p in zip(group.bands, state, strict=True)):
                    break
                columns, beyond = lattice.columns(state, owed, 1e9)
                choices = [band.options(p) for band, p in zip(group.bands, state, strict=True)]
                expected = {options for options in product(*choices) if _allowed(group, options, owed)}
                assert {column.options for column in columns} == expected
                assert beyond == float("inf")
                reaches = [column.reach for column in columns]
                assert reaches == sorted(reaches)
                if not columns:
                    break
                limit = rng.choice(reaches) - rng.choice([0.0, 1e-3])
                some, beyond = Lattice(group).columns(state, owed, limit)
                assert {c.options for c in some} == {c.options for c in columns if c.reach <= limit + EPS}
                rest = [reach for reach in reaches if reach > limit + EPS]
                assert beyond <= min(rest, default=float("inf")) + EPS and beyond > limit
                chosen = rng.choice(columns)
                state, owed = chosen.state, chosen.owed

    def test_whoever_is_not_opaque_need_not_fill_the_column(self) -> None:
        """The reference's A B is 3 m shorter than C, at a tolerance of 1 m."""
        group = group_of(("A:1 B°:1 D:1", "C:5"), 5.0, 1.0, Objective())
        assert Hierarchy(group).reference == 0
        columns, _ = Lattice(group).columns(group.start, False, 1e9)
        beside = {column.options[0].letters for column in columns if column.options[1].letters}
        assert beside == {(), (0, 1), (0, 1, 2)}
        plain = replace(group, objective=PAPER)
        columns, _ = Lattice(plain).columns(plain.start, False, 1e9)
        assert {column.options[0].letters for column in columns if column.options[1].letters} == {()}

    def test_ties_go_to_fewer_symbols(self) -> None:
        group = group_of(("A:1 A:1", "B:1 B:1"), 2.0, 1.0)
        columns, _ = Lattice(group).columns(group.start, False, 0.0)
        assert [column.symbols for column in columns[:4]] == sorted(column.symbols for column in columns[:4])
        assert columns[0].cost == columns[-1].cost == 0.0

    def test_few_pairs_are_weighed(self) -> None:
        """Of two words of forty letters, a narrow band along the diagonal: not 1,600 elements a node."""
        group = group_of(("A:1 " * 40, "B:1.02 " * 40), 40.0, 0.9)
        lattice = Lattice(group)
        columns, _ = lattice.columns(group.start, False, 0.9)
        assert lattice.weighed < 200
        assert max(len(c.options[0].letters) for c in columns) == 40


def _allowed(group: Group, options: Sequence[Option], owed: bool) -> bool:
    """The constraints on one column, word for word (docs/problem.md)."""
    present = [o for o in options if not o.empty]
    if not present or (owed and not any(o.begins for o in present)):
        return False
    if not group.waived and len(present) < len(options) and not any(o.opaque for o in present):
        return False  # C1
    if not group.waived and any(o.soft for o in present) and not any(o.opaque for o in present):
        return False
    for below, lower in enumerate(group.band_of):
        for higher in group.band_of[:below]:
            if options[lower].guarded and options[higher].soft:
                return False  # C3
    sized = [o for o in present if o.size is not None]
    filling = [o for o in sized if group.objective.plain or not o.soft]
    if not filling and len(sized) == len(present):
        filling = sized
    largest = max((o.least if o.size is None else o.size for o in present), default=0.0)
    least = min((o.size or 0.0 for o in filling), default=largest)
    return max(0.0, largest - least) <= group.tolerance + EPS


class TestMirror:
    def test_palindromes_are_their_own_mirror_image(self) -> None:
        group = group_of(("f A:2 f", "C:1 e C:1"), 6.0, 1.0)
        assert mirrored(group, None) is group
        ends = Ends([group], None)
        assert ends.forward.lattices[0] is ends.backward.lattices[0]

    def test_mirrored_letters_count_as_alike(self) -> None:
        one = Letter("A", 2.0)
        group = make_group([(one, Letter("B", 1.0), replace(one, mirrored=True))], 5.0, 0.0, PAPER)
        assert mirrored(group, None) is group

    def test_the_others_are_reversed(self) -> None:
        group = group_of(("A:2 B:1", "A:2 B:1", "C:3"), 3.0, 0.0)
        other = mirrored(group, None)
        assert [str(a) for a in other.bands[0].letters] == ["B", "A"]
        assert other.band_of == group.band_of


def walk_along(side: Side, structure: Structure) -> Iterator[Half]:
    """The partial alignments of a whole one, in the order of reading forward."""
    half = side.root()
    yield half
    for columns in structure:
        for options in columns:
            (half,) = [
                child
                for child in side.onward(half, 1e9)
                if child.column is not None and child.column.options == options
            ]
            yield half


def optima(count: int, first: int) -> Iterator[tuple[Group, Priced]]:
    for group in some_groups(count, first):
        found = search_best([group], nodes=1500)
        if found.best is not None and not found.cut:
            yield group, found.best


class TestBounds:
    def test_admissible_along_every_optimum(self) -> None:
        """No partial alignment is said to cost more than the optimum that begins like it."""
        tight = programmes = 0
        for group, best in optima(70, 7400):
            side = Ends([group], None).forward
            for half in walk_along(side, best.structure):
                assert half.bound <= best.cost + 1e-7
                tight += half.bound >= best.cost - 1e-7
                if half.trail:
                    programmes += 1
                    relaxed = Relaxation(side, half)
                    assert relaxed.value <= best.cost + 1e-7
                    if best.proper:
                        assert relaxed.positive() <= best.cost + 1e-5
        assert tight > 60 and programmes > 5

    def test_programme_knows_of_lengths(self) -> None:
        """f, and the beginning of g, beside A: f alone is 1 m longer, which column and programme know alike."""
        group = group_of(("f:2 g:1", "A:1 B:2"), 3.0, 2.0, Objective())
        side = Ends([group], None).forward
        (child,) = [
            half
            for half in side.onward(side.root(), 1e9)
            if half.column is not None
            and [o.letters for o in half.column.options] == [(0, 1), (0,)]
            and not half.column.options[0].ends
        ]
        assert child.column is not None and child.column.cost == 1.0
        assert Relaxation(side, child).value >= 1.0

    def test_stretch(self) -> None:
        """F of two pieces, between 1 and 2 m and between 0.5 and 1 m; tolerance 0.3 m."""
        stretch = Stretch(0, 0, 0, low=1.5, high=3.0, down=0.6, ups=((1.0, 0.3), (1.2, 0.3)))
        assert excess(stretch, 2.0) == (0.0, 0.0)
        assert excess(stretch, 1.2) == (pytest.approx(0.3), 0.0)
        assert excess(stretch, 3.5) == (pytest.approx(0.3 + 0.2 * 1.2), pytest.approx(0.5))
        assert excess(stretch, 3.7)[0] == excess(stretch, 0.8)[0] == float("inf")

    def test_pieces_may_be_shorter_than_is_free_of_cost(self) -> None:
        """f, of 1 m, over A and B of 1.5 m: half a metre off, within the tolerance; without it, impossible."""
        for tolerance, possible in ((1.0, True), (0.2, False)):
            side = Ends([group_of(("f:1 g:1", "A:1 B:.5 C:.5"), 2.0, tolerance)], None).forward
            half = side.root()
            found = True
            for own in ((0,), (1,)):
                steps = [
                    child
                    for child in side.onward(half, 1e9)
                    if child.column is not None
                    and [o.letters for o in child.column.options] == [(0,), own]
                    and not child.column.options[0].ends
                ]
                found = bool(steps)
                half = steps[0] if steps else half
            assert found == possible

    def test_letters_of_one_unsized_symbol(self) -> None:
        """One is at most 1 m long at no cost, the other at least 1.4 m."""
        group = group_of(("u A:1 u", "B:1 C:1 D:1.4"), 4.0, 1.0)
        ledger = [
            Stretch(0, 0, 0, low=1.0, high=1.0, down=1.0, ups=((1.0, 1.0),), ended=True),
            Stretch(0, 0, 2, low=1.4, high=1.4, down=1.0, ups=((1.0, 1.0),), ended=True),
        ]
        assert ledger_bound(ledger, [group]) == pytest.approx(0.4)


class TestTranspositions:
    def test_dearer_paths_to_a_node_are_dropped(self) -> None:
        """A and B in one column or in two: the same node, as cheap, more columns."""
        group = group_of(("A:1 B:1 C:1", "D:1 E:1 F:1"), 3.0, 1.0, Objective())
        side = Ends([group], None).forward
        halves = {len(h.laid()): h for h in walk_two(side)}
        table = Transpositions(side, 8)
        assert halves[1].state == halves[2].state and halves[1].cost > halves[2].cost
        assert not table.drops(halves[1])
        assert not table.drops(halves[2])
        assert halves[1].dropped, "the better one came later"
        assert table.drops(replace_half(halves[1]))

    def test_a_wider_path_replaces_no_narrower_one(self) -> None:
        """W of the narrower one may fit the canvas where that of the wider does not."""
        side = Ends([group_of(("A:1 B:1", "C:1 D:1"), 3.0, 1.0)], None).forward
        state = (8, 8)
        wide, narrow = Half(0, state, width=2.0, columns=2), Half(0, state, width=1.0, columns=1, cost=0.5)
        table = Transpositions(side, 8)
        assert not table.drops(wide)
        assert not table.drops(narrow) and not wide.dropped
        assert table.drops(Half(0, state, width=2.0, columns=2, cost=1.0))

    def test_fewer_nodes_and_the_same_answer(self) -> None:
        """`accept` keeps the table from being used, as it may look at anything."""
        rows = ("A:1.4 " + "B:1 A:1.4 " * 6, "E:1.3 " + "F:1.1 E:1.3 " * 6, "G:2.5 " * 6)
        group = group_of(rows, 15.8, 1.58)
        one, other = Deepening(Ends([group], None)), Deepening(Ends([group], None), accept=lambda _: True)
        one.go(20_000)
        other.go(20_000)
        assert one.found.best is not None and other.found.best is not None
        assert one.found.best.cost == pytest.approx(other.found.best.cost)
        assert one.found.best.columns == other.found.best.columns
        assert one.found.nodes < 0.7 * other.found.nodes


def walk_two(side: Side) -> Iterator[Half]:
    """(AB, DE) as one column and as two."""
    for half in side.onward(side.root(), 1e9):
        taken = [o.letters for o in half.column.options] if half.column else []
        if taken == [(0, 1), (0, 1)]:
            yield half
        if taken == [(0,), (0,)]:
            for child in side.onward(half, 1e9):
                if child.column is not None and [o.letters for o in child.column.options] == [(1,), (1,)]:
                    yield child


def replace_half(half: Half) -> Half:
    return replace(half, dropped=False)


class TestPrealigning:
    CONTENT = tuple(Letter(s, size, origin=("d", 0)) for s, size in (("A", 2.0), ("B", 3.0), ("A", 2.0)))
    F = Letter("f", 2.5, transparent=True)

    def test_control_word(self) -> None:
        group = make_group([(self.F, *self.CONTENT, self.F)], 12.0, 1.0, PAPER)
        word = control_word(group.bands[0])
        assert [(a.symbol, a.size) for a in word.letters] == [("f", 2.5), ("d", 7.0), ("f", 2.5)]
        assert word.begins == (0, 1, 4, 5)

    def test_nothing_substituted(self) -> None:
        assert control_group(group_of(("A:1 B:1", "f C:2"), 2.0, 0.0)) is None

    def test_one_control_word_of_two_layers(self) -> None:
        """Two contents of one length in one control pattern: one control word."""
        other = tuple(Letter("E", 3.5, origin=("d", 0)) for _ in range(2))
        group = make_group([(self.F, *self.CONTENT, self.F), (self.F, *other, self.F)], 12.0, 1.0, PAPER)
        control = control_group(group)
        assert len(group.bands) == 2 and control is not None and len(control.bands) == 1

    def test_guides_lead_through_the_control_columns(self) -> None:
        rows = [(self.F, *self.CONTENT, self.F), letters("C:2.5 D:7 C:2.5")]
        group = make_group(rows, 12.0, 1.0, Objective())
        control = control_group(group)
        assert control is not None
        aligned = search_best([control]).best
        assert aligned is not None
        (guide,) = control_guides([group], [control], aligned.structure)
        assert guide.nodes == ((0, 0), (2, 2), (8, 4), (10, 6)) and guide.strict
        search = Deepening(Ends([group], None, [guide]))
        search.go(1000)
        best = search.found.best
        assert best is not None
        nodes = nodes_between(group, (0, 1), best.structure[0])
        assert set(guide.nodes) <= set(nodes)


class TestMerging:
    def test_pairs_are_joined_as_they_are(self) -> None:
        """Four words in pairs: every node of the result is a node of both pairs."""
        group = group_of(("A:1 B:2 C:1", "D:1.1 E:1.9 F:1", "G:3 H:1", "I:2.9 J:1"), 4.0, 2.0, Objective())

        def align(part: Group, guides: Sequence[Guide]) -> Structure | None:
            search = Deepening(Ends([part], None, guides))
            search.go(10_000)
            return None if search.found.best is None else search.found.best.structure

        guides = merged_guides(0, group, align)
        assert [guide.bands for guide in guides] == [(0, 1), (2, 3)]
        assert guides[0].nodes == ((0, 0), (2, 2), (4, 4), (6, 6))
        search = Deepening(Ends([group], None, guides))
        search.go(10_000)
        best = search.found.best
        assert best is not None
        for guide in guides:
            assert set(nodes_between(group, range(4), best.structure[0])) <= {
                node
                for node in product(range(7), range(7), range(5), range(5))
                if tuple(node[b] for b in guide.bands) in guide.nodes
            }
        exact = search_best([group]).best
        assert exact is not None and best.cost >= exact.cost - 1e-9

    def test_good_enough_to_bound_many_words(self) -> None:
        """Five words of seventeen letters: merging finds the optimum, which best-first search confirms."""
        k = 8
        rows = (
            "A:1.4 " + "B:1 A:1.4 " * k,
            "E:1.3 " + "F:1.1 E:1.3 " * k,
            "G:2.5 " * k,
            "H:1.25 K:1.2 " * k,
            "M:1.15 " * (2 * k),
        )
        group = group_of(rows, 20.6, 2.06, Objective())

        def align(part: Group, guides: Sequence[Guide]) -> Structure | None:
            search = Deepening(Ends([part], None, guides), alone=True, keep=1)
            search.go(300)
            best = search.result().best
            return None if best is None else best.structure

        search = Deepening(Ends([group], None, merged_guides(0, group, align)), alone=True, keep=1)
        search.go(300)
        merged, exact = search.result().best, search_best([group]).best
        assert merged is not None and exact is not None
        assert merged.cost == pytest.approx(exact.cost)


class TestGuides:
    def test_backward(self) -> None:
        """Counted from the right, in the other order, in the other group."""
        groups = [group_of(("A:1 B:1", "C:1"), 2.0, 0.0), group_of(("D:1",), 2.0, 0.0)]
        guide = Guide(0, (0, 1), ((0, 0), (2, 1), (4, 2)), strict=True)
        assert guide.backward(groups) == Guide(1, (0, 1), ((0, 0), (2, 1), (4, 2)), strict=True)
        assert Guide(0, (0,), ((0,), (1,), (4,)), False).backward(groups).nodes == ((0,), (3,), (4,))
