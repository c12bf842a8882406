"""Sweeps: what they find is an alignment, and a good one; nothing is proven by them."""

from __future__ import annotations

import random

import pytest

from facade_nb import solve
from facade_nb.design import edit
from facade_nb.design.model import Symbol
from facade_nb.solver import Letter, Objective, align, tuning
from facade_nb.solver import solution as solving
from facade_nb.solver.alignment.core.binding import CompiledDives
from facade_nb.solver.alignment.core.search import search_best as search
from facade_nb.solver.alignment.group import Group, make_group
from facade_nb.solver.alignment.heuristic.local_search import can_sweep, mended, sweeps
from facade_nb.solver.alignment.pricing import Priced
from facade_nb.solver.alignment.reference.dives import Dives
from facade_nb.solver.alignment.single import alignment_of
from facade_nb.solver.budget import Stopped
from facade_nb.solver.model.problem import axis_problem
from facade_nb.solver.selection.axis import AxisSearch
from facade_nb.solver.sizing.system import size_axis, strain
from tests.bench import bench_anytime
from tests.bench.designs import harder
from tests.oracle import check, make_case
from tests.solver.ida_cases import case_group, group_of, letters, random_case
from tests.solver.test_align_oracle import objective
from tests.solver.test_tall import stack


def rigid(seed: int) -> tuple[list[tuple[Letter, ...]], float]:
    """Two to four short rows with every qualifier, and a canvas that some of them fill."""
    draw = random.Random(seed)
    letters = [
        Letter(
            symbol,
            draw.choice([0.5, 1.0, 1.5, 2.0]),
            opaque=draw.random() < 0.75,
            attached=draw.random() < 0.15,
            unoccludable=draw.random() < 0.15,
        )
        for symbol in "ABCD"
    ]
    rows = [tuple(draw.choice(letters) for _ in range(draw.randint(1, 5))) for _ in range(draw.randint(2, 4))]
    return rows, max(sum(a.size or 0.0 for a in row) for row in rows)


def group(rows: list[tuple[Letter, ...]], canvas: float) -> Group:
    return make_group(rows, canvas, 0.5 * canvas, Objective())


class TestWhatIsFound:
    @pytest.mark.parametrize("seed", range(150))
    def test_is_an_alignment_and_no_better_than_the_best(self, seed: int) -> None:
        own = group(*rigid(seed))
        if not can_sweep([own]):
            assert len(own.bands) == 1
            return
        best = search([own]).best
        costs = []
        for priced in sweeps([own]):
            assert best is not None and priced.cost >= best.cost - 1e-9
            costs.append(priced.cost)
            self.check_columns(own, priced)
        assert costs == sorted(costs, reverse=True)

    @staticmethod
    def check_columns(own: Group, priced: Priced) -> None:
        """Every band's letters come once each, in order, in columns that keep C1, C3 and C4 as the options say."""
        (columns,) = priced.structure
        for b, band in enumerate(own.bands):
            assert [i for column in columns for i in column[b].letters] == list(range(len(band.letters)))
            position = 0
            for column in columns:
                assert column[b] in band.options(position)  # C4
                position = column[b].target
        for column in columns:
            needy = any(option.empty or option.soft for option in column)
            assert own.waived or not needy or any(option.opaque for option in column)  # C1
            for b, option in enumerate(column):
                assert not (option.guarded and any(column[o].soft for o in own.guards[b]))  # C3

    def test_mostly_the_best(self) -> None:
        """On 60 stacks of sizes that do not agree: all but always the optimum, never far from it."""
        exact, worst = 0, 1.0
        for seed in range(60):
            rows, canvas = stack(3, 9, seed, jitter=0.05)
            own = group(rows, canvas)
            best = search([own]).best
            found = list(sweeps([own]))
            assert best is not None and found
            ratio = found[-1].cost / best.cost if best.cost > 0 else 1.0
            exact += ratio <= 1.0 + 1e-9
            worst = max(worst, ratio)
        assert exact >= 57 and worst < 1.02, (exact, worst)

    def test_rows_that_agree(self) -> None:
        rows, canvas = stack(40, 9, 1)
        expected = align(rows, canvas, 0.5 * canvas, Objective(), search="best")
        assert expected is not None
        assert list(sweeps([group(rows, canvas)]))[-1].cost == pytest.approx(expected.cost, abs=1e-9)


class TestPlaceholders:
    """Rows with letters that are cut, sized or not, and shared or not."""

    def test_is_an_alignment_and_no_better_than_the_best(self) -> None:
        found = best = as_good = 0
        for seed in range(300):
            case = make_case(random.Random(seed).choice, unsized=bool(seed % 2))
            if not any(case.rows):
                continue
            weights = objective(case.weights)
            own = make_group(case.rows, case.canvas, case.tolerance, weights, cuts=case.cuts)
            if not can_sweep([own]) or own.stiff:
                continue
            swept, exact = list(sweeps([own])), search([own], nodes=20_000)
            if exact.cut:
                continue
            best += exact.best is not None
            for priced in swept:
                shown = alignment_of(own, priced, 0)
                assert check(shown, case.rows, case.canvas, case.tolerance, case.weights, case.cuts) == [], (
                    case
                )
                assert exact.best is not None and priced.cost >= exact.best.cost - 1e-9, case
            if swept and exact.best is not None:
                found += 1
                as_good += swept[-1].cost <= exact.best.cost + 1e-6
        assert found >= 0.5 * best and as_good >= 0.5 * found, (best, found, as_good)

    def test_an_insertion_finds_its_place(self) -> None:
        """The door goes where it lines up with the bays of the wall, whatever is beside it."""
        own = group_of(["A:1 B:2 A:1 B:2 A:1 B:2 A:1", "e D:2 f"], 10.0, 5.0, Objective())
        found = list(sweeps([own]))[-1]
        exact = search([own]).best
        assert exact is not None and found.cost == pytest.approx(exact.cost, abs=1e-9)

    def test_groups_that_share_a_placeholder(self) -> None:
        """What it is long in one of them it is long in the other."""
        first, second = (
            make_group([letters(row) for row in rows], 7.0, 3.5, Objective(), free=frozenset())
            for rows in (["A:2 B:3 A:2", "v B:3 v"], ["v C:2.8 v"])
        )
        assert can_sweep([first, second])
        found = list(sweeps([first, second]))[-1]
        exact = search([first, second]).best
        assert exact is not None and found.cost == pytest.approx(exact.cost, abs=1e-9)
        assert found.unsized["v"] == pytest.approx(exact.unsized["v"], abs=0.11)

    def test_what_cannot_be_sized_is_mended(self) -> None:
        """The alignment is not given up: columns are joined, or letters moved, until all have a length."""
        rows = [
            "u D:1.99 A:0.79 v",
            "F:1.99 G:0.82 H:1.23 G:0.82 H:1.23 F:1.99 G:0.82 H:1.23 G:0.82 H:1.23",
            "I:0.81 J:1.18 K:2 K:2 I:0.81 J:1.18 I:0.81 J:1.18 I:0.81 J:1.18",
            "e L:2.03 e",
        ]
        words = [letters(row) for row in rows]
        own = make_group(words, 12.5, 6.25, Objective(), free=frozenset("uv"))
        symbols = {letter.symbol: Symbol(letter.symbol, letter.size) for word in words for letter in word}

        def strained(priced: Priced) -> float:
            if size_axis([own], ((priced, 0),), 12.5, symbols.__getitem__) is not None:
                return 0.0
            left = strain([own], ((priced, 0),), 12.5, symbols.__getitem__)
            assert left > 0.0
            return left

        assert all(strained(priced) > 0.0 for priced in sweeps([own]))
        found = mended([own], strained)
        assert found is not None
        sized = size_axis([own], ((found, 0),), 12.5, symbols.__getitem__)
        assert sized is not None and min(sized.sizes.values()) > 0.0

    def test_a_stack_with_insertions_has_a_layout(self) -> None:
        """26 layers with placeholders that several rows share: no exhaustive search comes to an end."""
        design = harder()["concert-hall (harder)"]
        for counter, value in (("m", 4), ("k", 3)):
            design = edit.with_counter(design, counter, value=value)
        walk = AxisSearch(axis_problem(design, "x"), Objective(), 0.5 * design.canvas.width)
        walk.enumerate({})
        assert walk.stream is not None
        candidate = walk.stream.take()
        assert candidate is not None
        solved = walk.soon.hasty(walk, None)
        assert solved is not None
        assert solved.cost < 2.5


class TestWhere:
    def test_not_one_word_nor_the_papers_objective_nor_nothing_solid(self) -> None:
        assert can_sweep([group_of(["A:2 B:1", "A:3"], objective=Objective())])
        assert not can_sweep([group_of(["A:2 B:1", "A:3"], objective=Objective.paper())])
        assert can_sweep([group_of(["A:2 B:1", "e A:3"], objective=Objective())])
        assert not can_sweep([group_of(["A:2 B:1", "A:2 B:1"], objective=Objective())])
        assert not can_sweep([group_of(["e", "f"], objective=Objective())])

    @pytest.mark.parametrize("seed", range(60))
    def test_never_in_the_way_of_random_groups(self, seed: int) -> None:
        own = case_group(random_case(seed))
        if can_sweep([own]):
            assert all(priced.cost >= 0 for priced in sweeps([own]))

    def test_stops_when_asked(self) -> None:
        calls = 0

        def count() -> None:
            nonlocal calls
            calls += 1
            if calls == 5:
                raise Stopped(asked=True)

        rows, canvas = stack(12, 9, 3, jitter=0.05)
        with pytest.raises(Stopped):
            list(sweeps([group(rows, canvas)], count))
        assert calls == 5


class TestAnytime:
    def test_there_is_a_layout_where_exhaustive_search_cannot_go(
        self, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """The clock of the tests counts looks, not seconds: it ends long before the search comes to any alignment."""
        design = bench_anytime.stack(16, 1)
        monkeypatch.setattr(tuning, "SLOW", 0.0)
        solving.forget()
        layout = solve(design, time_limit=1.0)
        assert not layout.x.proven and layout.x.gap > 0.5
        assert layout.x.cost < 3.5  # the best known is 3.3347

    @pytest.mark.parametrize("kind", [Dives, CompiledDives])
    def test_dives_look_only_for_what_is_better(self, kind: type[Dives] | type[CompiledDives]) -> None:
        rows, canvas = stack(7, 6, 5, jitter=0.03)
        own = group(rows, canvas)
        best = search([group(rows, canvas)]).best
        assert best is not None
        dives = kind([own], 0.0)
        dives.offer(best)
        for _ in range(200):
            if dives.done:
                break
            assert not dives.dive()
        assert dives.best is best
