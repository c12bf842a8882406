"""The compiled search does what the one in Python does: step by step, not only in the end."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable, Sequence
from math import inf
from threading import Thread

import pytest

from facade_nb import gallery, solve
from facade_nb.design.errors import NoLayout
from facade_nb.design.model import Design
from facade_nb.solver import Letter, tuning
from facade_nb.solver import solution as solving
from facade_nb.solver.alignment import group as grouping
from facade_nb.solver.alignment.core import instances as compiled
from facade_nb.solver.alignment.core.binding import CompiledDives, CompiledSearch, best_first
from facade_nb.solver.alignment.core.instances import available
from facade_nb.solver.alignment.group import Group
from facade_nb.solver.alignment.pricing import Priced
from facade_nb.solver.alignment.reference.best_first import BestFirst
from facade_nb.solver.alignment.reference.dives import Dives
from facade_nb.solver.budget import Stopped
from facade_nb.solver.model.objective import Objective
from tests.known import TELLING
from tests.oracle.designs import make_design
from tests.solver.ida_cases import case_group, group_of, random_case
from tests.solver.test_tall import stack

TOO_MANY = 3_000


def spelled(found: Sequence[Priced]) -> list[object]:
    """Structures by their letters, with what they cost."""
    return [
        (
            round(priced.cost, 9),
            priced.proper,
            tuple(tuple(tuple(o.letters for o in column) for column in own) for own in priced.structure),
        )
        for priced in found
    ]


def both(
    make: Callable[[], Sequence[Group]],
    accept: Callable[[Priced], bool] | None = None,
    turn: float = inf,
) -> None:
    """Advance both searches through the same limits, and look at all that can be seen of them after each."""
    slow = BestFirst(make(), keep=4, nodes=TOO_MANY, accept=accept, turn=turn)
    fast = CompiledSearch(make(), keep=4, nodes=TOO_MANY, accept=accept, turn=turn)
    step = 0.01 * max(group.canvas for group in slow.network.groups)
    limit = slow.found.bound + step
    for _ in range(5_000):
        assert fast.done == slow.done
        assert fast.found.bound == pytest.approx(slow.found.bound, abs=1e-9)
        assert fast.found.nodes == slow.found.nodes
        assert fast.found.cut == slow.found.cut
        assert spelled(fast.found.ties) == spelled(slow.found.ties)
        if slow.done:
            return
        slow.advance(limit)
        fast.advance(limit)
        assert fast.paused == slow.paused
        if not slow.paused:
            step *= 1.6
            limit = max(limit, slow.found.bound) + step
    raise AssertionError("no end")


def test_is_there() -> None:
    """The packages that are tested with have it; what follows says nothing otherwise."""
    assert available()


def test_without_wasmtime_the_other_search_is_used(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "wasmtime", None)  # as if it were not installed
    available.cache_clear()
    try:
        assert not available()
        assert isinstance(best_first([case_group(random_case(1))]), BestFirst)
        solving.forget()
        assert solve(gallery.load("residential-house")).x.proven
    finally:
        available.cache_clear()


class TestSearch:
    @pytest.mark.parametrize("seed", range(300))
    def test_random(self, seed: int) -> None:
        both(lambda: [case_group(random_case(seed))])

    @pytest.mark.parametrize("seed", range(40))
    def test_tall(self, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(tuning, "TALL", 1)
        both(lambda: [case_group(random_case(1000 + seed))])

    @pytest.mark.parametrize("seed", range(40))
    def test_taking_turns_and_refusing(self, seed: int) -> None:
        """With an `accept`, which may look at anything, and in turns of a few paths."""
        both(lambda: [case_group(random_case(2000 + seed))], lambda priced: priced.columns % 2 == 0, 5)

    @pytest.mark.parametrize("seed", [*range(19), 20])  # 19 takes as long as all others
    def test_groups_that_share_a_symbol(self, seed: int) -> None:
        def make() -> Sequence[Group]:
            free = frozenset[str]()
            rows = [random_case(3000 + 2 * seed + 1).rows, random_case(3000 + 2 * seed + 2).rows]
            case = random_case(3000 + 2 * seed + 1)
            group = case_group(case)
            return [
                grouping.make_group(own, group.canvas, group.tolerance, group.objective, free=free)
                for own in rows
            ]

        both(make)

    def test_many_rows(self) -> None:
        rows, canvas = stack(12, 9, 5, jitter=0.02)
        both(
            lambda: [grouping.make_group(rows, canvas, 0.5 * canvas, Objective())],
            turn=40,
        )

    def test_a_word_of_many_letters(self) -> None:
        both(lambda: [group_of(["A:1 " * 90, "B:2 " * 45], canvas=90.0, tolerance=3.0)])


class TestDives:
    @pytest.mark.parametrize("seed", range(30))
    def test_random(self, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
        if seed % 2:
            monkeypatch.setattr(tuning, "TALL", 1)
        case = random_case(4000 + seed)
        slow, fast = Dives([case_group(case)], 0.0), CompiledDives([case_group(case)], 0.0)
        for _ in range(60):
            assert fast.done == slow.done
            if slow.done:
                break
            assert fast.dive() == slow.dive()
            assert spelled([fast.best] if fast.best else []) == spelled([slow.best] if slow.best else [])

    def test_structures_that_will_not_do_are_passed_over(self) -> None:
        rows, canvas = stack(7, 6, 5)
        group = grouping.make_group(rows, canvas, 0.5 * canvas, Objective())
        dives = CompiledDives([group], 0.0, accept=lambda priced: priced.columns < 3)
        while not dives.done and dives.best is None:
            dives.dive()
        assert dives.best is not None and dives.best.columns < 3


class TestDesigns:
    @staticmethod
    def answer(design: Design) -> object:
        solving.forget()
        try:
            layout = solve(design, time_limit=None)
        except NoLayout as none:
            return none.axis, none.constraint, none.symbols, none.patterns, none.counters  # advice takes time
        assert layout.complete
        return layout.to_dict()

    def compare(self, design: Design, monkeypatch: pytest.MonkeyPatch) -> None:
        fast = self.answer(design)
        monkeypatch.setattr(compiled, "available", lambda: False)
        slow = self.answer(design)
        monkeypatch.undo()
        solving.forget()
        assert fast == slow

    @pytest.mark.parametrize("name", TELLING)
    def test_gallery(self, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
        self.compare(gallery.load(name), monkeypatch)

    @pytest.mark.parametrize("seed", range(30))
    def test_random(self, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
        self.compare(make_design(seed), monkeypatch)


class TestControl:
    @staticmethod
    def hard() -> Group:
        rows, canvas = stack(9, 12, 3, jitter=0.15)
        return grouping.make_group(rows, canvas, 0.5 * canvas, Objective())

    def test_stops_when_asked(self) -> None:
        """What `check` raises comes out, whatever it is; the search stays usable."""
        calls = 0

        def check() -> None:
            nonlocal calls
            calls += 1
            if calls == 3:
                raise KeyboardInterrupt
            if calls == 6:
                raise Stopped(asked=True)

        search = CompiledSearch([self.hard()], check=check)
        with pytest.raises(KeyboardInterrupt):
            search.advance(inf)
        with pytest.raises(Stopped) as stopped:
            search.advance(inf)
        assert stopped.value.asked
        assert search.found.nodes > 0 and not search.done

    def test_solving_while_asked(self) -> None:
        """A `should_stop` may solve something itself."""
        design = gallery.load("residential-house")
        inside = []

        def should_stop() -> bool:
            if not inside:
                inside.append(solve(gallery.load("figure-7")).x.cost)
            return False

        solving.forget()
        expected = solve(design).to_dict()
        solving.forget()
        assert solve(gallery.load("bookshop"), should_stop=should_stop).complete
        assert solve(design, should_stop=should_stop).to_dict() == expected
        assert len(inside) == 1

    def test_lets_go_of_what_is_no_longer_needed(self) -> None:
        core = compiled.instance()
        gc.collect()
        core._bury()
        before = set(core._alive)
        for seed in range(20):
            search = best_first([case_group(random_case(seed))])
            search.advance(0.5)
        del search
        assert core._alive - before
        gc.collect()
        core._bury()
        assert not core._alive - before

    def test_an_instance_that_has_grown_is_replaced(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(tuning, "LARGE_INSTANCE", 0)
        seen = []

        def look() -> None:  # in a thread of its own, where nothing is left of other tests
            seen.append(compiled.instance())
            search = best_first([case_group(random_case(1))])
            seen.append(compiled.instance())
            del search
            gc.collect()
            seen.append(compiled.instance())

        thread = Thread(target=look)
        thread.start()
        thread.join()
        assert seen[2] is not seen[0]

    def test_a_trace_is_made_by_the_other(self) -> None:
        layout = solve(gallery.load("residential-house"), trace=True)
        solving.forget()
        assert layout.trace is not None
        assert solve(gallery.load("residential-house")) == layout

    def test_a_thread_that_ends_leaves_nothing(self) -> None:
        seen = []

        def work() -> None:
            best_first([case_group(random_case(3))]).advance(0.5)
            seen.append(compiled.ref(compiled.instance()))

        thread = Thread(target=work)
        thread.start()
        thread.join()
        gc.collect()
        assert seen[0]() is None

    def test_what_takes_too_much_memory_makes_room_for_a_last_attempt(
        self, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(tuning, "LARGE_INSTANCE", 0)
        search = best_first([self.hard()])
        core = compiled.instance()
        assert compiled.start_afresh()
        assert compiled.instance() is not core
        with pytest.raises(Stopped) as stopped:
            search.advance(inf)  # what was there until then is gone, at once
        assert stopped.value.full


class TestUnsizable:
    """Columns that no sizes can make, because one element holds more than another that fills the same column."""

    @pytest.mark.parametrize(
        ("rows", "expected"),
        [
            (["A:1 B:1", "A:1"], True),
            (["A:1 B:1", "B:1 A:1"], False),
            (["A:1 B:1", "A:1 C:1"], False),
            (["A:1 B:1", "A°:1"], False),  # need not fill
            (["A°:1 B:1", "A:1"], True),
            (["a:1", "a"], False),
        ],
    )
    def test_whole_letters(self, rows: list[str], expected: bool) -> None:
        group = group_of(rows, tolerance=12.0)
        column = [band.options(0)[-1] for band in group.bands]
        assert [len(option.letters) for option in column] == [len(band.letters) for band in group.bands]
        assert grouping.unsizable(group, column) == expected

    def test_a_piece_is_shorter_than_its_letter(self) -> None:
        group = grouping.make_group(
            [(Letter("G", 3.0, transparent=True),), (Letter("G", 3.0),)], 3.0, 3.0, Objective()
        )
        part, whole = group.bands[0].options(0)[1:]
        solid = group.bands[1].options(0)[1]
        assert grouping.unsizable(group, (part, solid))
        assert not grouping.unsizable(group, (whole, solid))

    @pytest.mark.parametrize("seed", range(40))
    def test_dives_of_both_kinds_leave_them_out(self, seed: int) -> None:
        case = random_case(5000 + seed)
        found = []
        for kind in (Dives, CompiledDives):
            dives = kind([case_group(case)], 0.0, accept=lambda _: True)
            for _ in range(30):
                if dives.done:
                    break
                dives.dive()
            best = dives.best
            found.append(spelled([best] if best else []))
            if best is not None:
                assert not any(
                    grouping.unsizable(dives_group, c)
                    for dives_group, own in zip([case_group(case)], best.structure, strict=True)
                    for c in own
                )
        assert found[0] == found[1]
