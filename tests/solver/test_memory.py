"""What a call takes and leaves: instances, addresses, what is kept; nothing waits for the garbage collector."""

from __future__ import annotations

import gc
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from threading import Thread
from typing import Any
from weakref import WeakSet

import pytest

from facade_nb import NoLayout, gallery, solve
from facade_nb.design import edit
from facade_nb.solver import Letter, Objective, align, tuning
from facade_nb.solver import budget as clock
from facade_nb.solver import solution as solving
from facade_nb.solver.alignment.core import instances as compiled
from facade_nb.solver.alignment.core.binding import CompiledSearch
from facade_nb.solver.alignment.group import Group, make_group
from facade_nb.solver.budget import Clock, Stopped
from facade_nb.solver.cache import CACHE, Kept
from facade_nb.solver.selection import clusters as running
from tests.oracle.designs import design


@pytest.fixture(autouse=True)
def nothing_kept() -> Iterator[None]:
    solving.forget()
    yield
    solving.forget()


@pytest.fixture
def searches(monkeypatch: pytest.MonkeyPatch) -> Iterator[WeakSet[running.GroupSearch]]:
    """The searches of groups that there are, with the garbage collector switched off; and instances are watched."""
    found: WeakSet[running.GroupSearch] = WeakSet()
    begin = running.GroupSearch.__init__

    def made(self: running.GroupSearch, *arguments: Any, **options: Any) -> None:
        begin(self, *arguments, **options)
        found.add(self)

    monkeypatch.setattr(running.GroupSearch, "__init__", made)
    gc.collect()
    gc.disable()
    yield found
    gc.enable()


def left() -> list[object]:
    """Instances that are not closed."""
    return [core for core in compiled._cores if not core.closed]


class TestNothingIsLeft:
    def test_of_a_layout(self, searches: WeakSet[running.GroupSearch]) -> None:
        before = len(left())
        layout = solve(gallery.load("teaser"))
        assert layout.x.proven and len(left()) == before
        assert len(searches) == 0

    def test_of_none(self, searches: WeakSet[running.GroupSearch]) -> None:
        """Nor by an error that somebody keeps, as a notebook keeps the last one."""
        before, kept = len(left()), []
        one = design({"A": 1.0, "B": {"size": 0.9, "opaque": False}}, {"a": "A^4", "b": "B^4"}, ["b", "a"])
        for impossible in (edit.with_canvas(one, width=0.2), edit.with_symbol(one, "A", max=0.3)):
            with pytest.raises(NoLayout) as caught:
                solve(impossible)
            kept.append(caught.value)
            assert len(left()) == before and len(searches) == 0
        assert all(error.__context__ is None and error.__cause__ is None for error in kept)

    @pytest.mark.parametrize("objective", [Objective(), Objective.paper()], ids=["default", "paper"])
    def test_of_what_was_stopped(self, objective: Objective, searches: WeakSet[running.GroupSearch]) -> None:
        before = len(left())
        for after in (1, 5, 20, 60, 150):
            calls = 0

            def stop(after: int = after) -> bool:
                nonlocal calls
                calls += 1
                return calls > after

            solving.forget()
            with suppress(NoLayout):
                solve(gallery.load("bookshop"), objective=objective, should_stop=stop, time_limit=None)
            assert len(left()) == before and len(searches) == 0

    def test_of_counters_that_tie_both_axes(self, searches: WeakSet[running.GroupSearch]) -> None:
        before = len(left())
        one = design({"A": 1.0, "P": 0.5}, {"a": "A^k", "u": "P^k"}, [("a", "g", "u", "g")])
        assert solve(one).counters == {"k": 4}
        assert len(left()) == before and len(searches) == 0

    def test_of_what_raises(self, searches: WeakSet[running.GroupSearch]) -> None:
        def stop() -> bool:
            raise KeyboardInterrupt

        before = len(left())
        with pytest.raises(KeyboardInterrupt):
            solve(gallery.load("bookshop"), should_stop=stop)
        assert len(left()) == before

    def test_of_an_alignment(self) -> None:
        before = len(left())
        rows = [[Letter("A", 1.0)] * 4, [Letter("B", 1.3)] * 3]
        assert align(rows, 4.0, 2.0, Objective(), "best") is not None
        assert len(left()) == before

    def test_of_threads(self) -> None:
        """Each edit in a widget is solved in a thread of its own, and several studios at once."""
        before = len(left())
        seen: list[int] = []

        def work() -> None:
            solve(gallery.load("residential-house"))
            seen.append(len(left()))

        threads = [Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert len(seen) == 4 and max(seen) <= before + 3 and len(left()) == before

    def test_a_search_whose_instance_is_gone_comes_to_an_end(self) -> None:
        rows = [[Letter("A", 1.0)] * 4, [Letter("B", 1.3)] * 3]
        with compiled.session():
            group = compiled_group(rows)
            run = CompiledSearch([group])
        with pytest.raises(Stopped) as stopped:
            run.advance(100.0)
        assert stopped.value.full


def compiled_group(rows: list[list[Letter]]) -> Group:
    return make_group(rows, 4.0, 2.0, Objective())


LIMITED = """
import random, resource
from facade_nb import gallery
from facade_nb.design import edit
from facade_nb.widgets.studio.model import FacadeModel
resource.setrlimit(resource.RLIMIT_AS, (1_500_000_000, 1_500_000_000))
model = FacadeModel(gallery.load("figure-7"))
draw = random.Random(3)
for n in range(40):
    names = [name for name, own in model.design.symbols.items() if own.size]
    name = draw.choice(names)
    size = model.design.symbols[name].size
    model.edit(edit.with_symbol(model.design, name, size=round(size * draw.uniform(0.8, 1.25), 2)))
    assert model.trouble is None, model.trouble
    assert not any("Python" in text for text in (model.layout.warnings if model.layout else ()))
print("done")
"""


class TestAddresses:
    def test_edits_with_few(self) -> None:
        """Before, each edit reserved 4 GB."""
        done = subprocess.run([sys.executable, "-c", LIMITED], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        assert done.stdout.endswith("done\n")

    def test_none_at_all(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """The search in Python finds the same, and the layout says that it took its place."""
        one = gallery.load("residential-house")
        expected = solve(one)
        solving.forget()
        tried = []

        def none(self: object) -> None:
            import wasmtime

            tried.append(self)
            raise wasmtime.WasmtimeError("mmap failed to reserve 0x20000000 bytes: Cannot allocate memory")

        compiled._local.sessions[0].close()  # what other tests have left could be used again
        monkeypatch.setattr(compiled._Instance, "__init__", none)
        monkeypatch.setattr(compiled, "_idle", [])
        without = solve(one)
        (told,) = set(without.warnings) - set(expected.warnings)
        assert told.startswith(
            "There was no memory for the compiled search; the search in Python took its place"
        )
        assert replace(without, warnings=expected.warnings) == expected
        assert len(tried) == 2  # once, and once more when what nobody needs was let go of; not for each group
        rows = [[Letter("A", 1.0)] * 4, [Letter("B", 1.3)] * 3]
        assert align(rows, 4.0, 2.0, Objective(), "best") is not None

    def test_memory_that_python_does_not_get(self, monkeypatch: pytest.MonkeyPatch) -> None:
        def starve(*_: object, **__: object) -> None:
            raise MemoryError

        monkeypatch.setattr("facade_nb.solver.selection.axis.AxisSearch.open", starve)
        with pytest.raises(NoLayout, match=r"^Out of memory after") as caught:
            solve(gallery.load("figure-7"))
        assert caught.value.constraint == "memory"


class TestIdle:
    """An instance goes on to the next call, if it is small: its pages need not be got again."""

    @pytest.fixture
    def made(self, monkeypatch: pytest.MonkeyPatch) -> list[compiled._Instance]:
        found: list[compiled._Instance] = []
        begin = compiled._Instance.__init__

        def watched(self: compiled._Instance) -> None:
            begin(self)
            found.append(self)

        compiled._local.sessions[0].close()
        monkeypatch.setattr(compiled._Instance, "__init__", watched)
        monkeypatch.setattr(compiled, "_idle", [])
        return found

    def test_is_used_again_and_the_answer_is_the_same(self, made: list[compiled._Instance]) -> None:
        answers = []
        for _ in range(3):
            solving.forget()
            answers.append(solve(gallery.load("teaser")))
        assert len(made) == 1 and compiled._idle == made
        assert answers[0] == answers[1] == answers[2]

    def test_never_more_than_one(self, made: list[compiled._Instance]) -> None:
        with compiled.session() as outer:
            outer.get()
            solve(gallery.load("residential-house"))
        assert len(made) == 2 and len(compiled._idle) == 1

    def test_a_large_one_is_let_go_of(
        self, made: list[compiled._Instance], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(tuning, "IDLE_INSTANCE", 0)
        solve(gallery.load("residential-house"))
        assert len(made) == 1 and compiled._idle == []


class TestWhatEarlierCallsLeave:
    @pytest.fixture
    def size(self, monkeypatch: pytest.MonkeyPatch) -> list[int]:
        """The size of the process, to be set; nothing is left of other tests."""
        own = [100_000_000]
        monkeypatch.setattr(clock, "_resident", lambda: own[0])
        monkeypatch.setattr(clock, "_left", clock._Left())
        monkeypatch.setattr(clock, "_give_back", lambda: None)
        monkeypatch.setattr(tuning, "MEMORY_LOOK", -1.0)
        return own

    @staticmethod
    def grows_by(size: list[int], step: int = 10_000_000) -> int:
        """By how much the process may grow in a call; it keeps all that."""
        begin, one = size[0], Clock(None)
        with suppress(Stopped):
            while size[0] < begin + 10 * tuning.MEMORY:
                size[0] += step
                one.check()
        one.close()
        return size[0] - begin

    def test_counts(self, size: list[int]) -> None:
        assert self.grows_by(size) == pytest.approx(tuning.MEMORY, abs=2e7)
        assert self.grows_by(size) == pytest.approx(tuning.MEMORY / 2, abs=2e7)  # never less than a half

    def test_what_the_system_gets_back_does_not(
        self, size: list[int], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        def give_back() -> None:
            size[0] = 100_000_000

        monkeypatch.setattr(clock, "_give_back", give_back)
        for _ in range(3):
            self.grows_by(size)
            assert size[0] == 100_000_000
        assert clock._left.bytes == 0

    def test_what_others_take_does_not(self, size: list[int]) -> None:
        """A table that the notebook reads between two calls."""
        size[0] += 10**9
        assert self.grows_by(size) == pytest.approx(tuning.MEMORY, abs=2e7)


class TestKept:
    @pytest.fixture
    def caches(self) -> dict[str, Kept[Any]]:
        return {
            "answers": CACHE.answers,
            "before": CACHE.earlier,
            "groups": CACHE.groups,
            "words": CACHE.words,
        }

    def test_is_weighed_by_what_it_takes(self, caches: dict[str, Kept[Any]]) -> None:
        """Of answers with words of thousands of letters fewer are kept than of small ones."""
        small = design({"A": 1.0}, {"a": "A^k"}, ["a"])
        solve(small)
        few = caches["groups"]._weight
        solving.forget()
        solve(design({"A": 0.01}, {"a": "A^k"}, ["a"], 100.0), time_limit=None)
        assert caches["groups"]._weight > 100 * few
        assert caches["words"]._weight > 100_000

    def test_never_more_than_a_hundred_megabytes(self, caches: dict[str, Kept[Any]]) -> None:
        assert sum(own._most for own in caches.values()) <= 110e6

    def test_answers_keep_no_words(self) -> None:
        solve(gallery.load("teaser"))
        for known, _ in CACHE.answers._known.values():
            for walk, best in known.values():
                assert all(found.words == () for found in walk.found.values())
                assert not walk.searches.runs and not walk.cases
                assert best.solved is not None
                assert all(not band._options for group in best.solved.groups for band in group.bands)

    def test_the_same_answer_from_there(self) -> None:
        one = gallery.load("teaser")
        assert solve(one) == solve(one)
