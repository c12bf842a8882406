"""Limits of time and of everything else; the same answer twice; documents that come back as they went."""

from __future__ import annotations

import contextlib
import functools
import json
import re
import subprocess
import sys
import threading
import tracemalloc

import pytest

from facade_nb import Design, Layout, NoLayout, gallery, solve
from facade_nb.design import Counter, Symbol, edit, parse
from facade_nb.solver import Letter, Objective, align, tuning
from facade_nb.solver import budget as clock
from facade_nb.solver import solution as solving
from facade_nb.solver.analysis.systems import analyse
from facade_nb.solver.assembly.shapes import merge
from facade_nb.solver.budget import Clock, Stopped
from facade_nb.solver.cache import CACHE
from facade_nb.solver.model.problem import axis_problem
from facade_nb.solver.selection.axis import AxisSearch
from facade_nb.solver.words.instances import instances
from tests.bench import bench_anytime
from tests.known import TELLING
from tests.oracle.designs import design, make_design
from tests.oracle.nasty import NASTY, nasty

STOPPED = r"Stopped after \d+\.\d s(, while [^;]+)?; no layout yet\.$"
OUT_OF_TIME = r"Out of time after \d+\.\d s(, while [^;]+)?; no layout yet\. A longer time limit may find one"
SIX = "A^a B^b C^c D^d E^e F^f"
SIZES = {name: 0.3 + 0.07 * n for n, name in enumerate("ABCDEF")}


@pytest.fixture(autouse=True)
def nothing_kept() -> None:
    """Solved axes are kept between calls; here each call does its own work."""
    solving.forget()


class Stopper:
    """A `should_stop` that turns true after so many calls, and counts them."""

    def __init__(self, after: int) -> None:
        self.after, self.calls = after, 0

    def __call__(self) -> bool:
        self.calls += 1
        return self.calls > self.after


class TestShouldStop:
    def test_at_once(self) -> None:
        stop = Stopper(0)
        with pytest.raises(NoLayout) as caught:
            solve(gallery.load("terraced-house"), should_stop=stop, time_limit=None)
        assert re.match(STOPPED, str(caught.value))
        assert stop.calls <= 2

    def test_is_not_asked_again_for_long(self) -> None:
        """Whenever it turns true, the search ends after a few more calls."""
        for after in (1, 10, 100, 1000):
            stop = Stopper(after)
            with contextlib.suppress(NoLayout):
                solve(gallery.load("terraced-house"), should_stop=stop, time_limit=None)
            assert stop.calls <= after + 8

    @pytest.mark.parametrize("objective", [Objective(), Objective.paper()], ids=["default", "paper"])
    @pytest.mark.parametrize("seed", [3, 28, 40])
    def test_at_any_moment(self, seed: int, objective: Objective) -> None:
        """Also while it is found out why there is no layout: a layout, or `NoLayout`, and nothing else."""
        one = make_design(seed)
        after = 0
        while True:
            solving.forget()
            stop = Stopper(after)
            try:
                layout = solve(one, objective=objective, should_stop=stop, time_limit=None)
                assert layout.complete or stop.calls > after
            except NoLayout as error:
                assert str(error)
            if stop.calls <= after:
                break
            after += 1 if after < 30 else after // 5

    def test_what_was_found_until_then_is_marked(self) -> None:
        """Going through the moments in which it can be stopped, some give a layout that is not the last word."""
        one = gallery.load("residential-house")
        full = solve(one)
        seen = set()
        for after in range(0, 400, 4):
            solving.forget()
            try:
                layout = solve(one, should_stop=Stopper(after), time_limit=None)
            except NoLayout as error:
                assert re.match(STOPPED, str(error))
                continue
            seen.add(layout.complete)
            if not layout.complete:
                assert not (layout.x.proven and layout.y.proven)
                assert layout.x.cost + layout.y.cost >= full.x.cost + full.y.cost - 1e-9
                bounds = [axis.cost - axis.gap for axis in (layout.x, layout.y)]
                assert sum(bounds) <= full.x.cost + full.y.cost + 1e-6
        assert True in seen

    def test_never_asked_without_layers(self) -> None:
        stop = Stopper(0)
        assert solve(Design(), should_stop=stop).shapes == ()
        assert stop.calls == 0


class TestTimeLimit:
    def test_none_at_all(self) -> None:
        with pytest.raises(NoLayout, match=OUT_OF_TIME):
            solve(gallery.load("terraced-house"), time_limit=0.0)

    def test_what_it_was_at(self) -> None:
        """Stopped at any moment, the error names the stage, and what of."""
        patterns = {"a": "A^k", "b": "(AB)^l", "c": "B^m", "d": "(CD)^n A", "e": "(DBC)^o"}
        one = design({"A": 1.0, "B": 0.83, "C": 0.61, "D": 0.47}, patterns, list(patterns), 9.0)
        told: dict[str, set[str]] = {}
        for after in (*range(20), *range(20, 600, 29)):
            solving.forget()
            with pytest.raises(NoLayout) as caught:
                solve(one, should_stop=Stopper(after), time_limit=None)
            error = caught.value
            assert error.constraint == "stop" and error.axis == "x" and error.suggestions == ()
            assert re.match(STOPPED, str(error))
            told.setdefault(error.stage, set()).add(re.split(", while |;", str(error))[1])
        assert set(told) == {"words", "candidates", "alignment"}
        assert "listing the words of pattern 'a' on x" in told["words"]
        assert told["candidates"] == {"putting words together on x"}
        assert any(re.match(r"aligning candidate \d+.* on x, group 'g'$", text) for text in told["alignment"])

    def test_what_would_help(self) -> None:
        with pytest.raises(NoLayout) as caught:
            solve(NASTY["counters on both axes"], time_limit=0.0)
        error = caught.value
        assert error.constraint == "time" and error.counters == ("k", "l")
        assert str(error).endswith(
            "; no layout yet. A longer time limit may find one; so may a max for counters 'k', 'l'."
        )

    @pytest.mark.parametrize(
        "one", [*NASTY.values(), *map(nasty, range(8))], ids=[*NASTY, *map(str, range(8))]
    )
    def test_is_kept_at_every_stage(self, one: Design) -> None:
        """Ten times the limit at most, as the looks at the clock are counted."""
        began = clock.time.monotonic()
        try:
            solve(one, time_limit=0.2)
        except NoLayout as error:
            assert str(error)
        assert clock.time.monotonic() - began < 2.0

    def test_six_counters_and_no_layout(self) -> None:
        """Nothing of the lower row is opaque, and neither is anything of the upper one but Z, which is too small."""
        symbols = {name: {"size": size, "opaque": False} for name, size in SIZES.items()} | {"Z": 0.01}
        one = design(symbols, {"a": SIX, "z": f"{SIX} Z"}, ["a", "z"], 6.0)
        with pytest.raises(NoLayout) as caught:
            solve(one, time_limit=2.0)
        assert str(caught.value)

    def test_six_counters_in_two_orders(self) -> None:
        one = design(SIZES, {"a": SIX, "b": "F^a A^b B^c C^d D^e E^f"}, ["a", "b"], 6.0)
        layout = solve(one, time_limit=20.0)
        assert layout.x.gap >= 0.0 and layout.x.proven == (layout.x.gap == 0.0 and layout.complete)

    @pytest.mark.parametrize("text", ["e^k m; m := A^4", "A^4 ε^k"])
    def test_a_counter_of_nothing_with_a_bound_that_nobody_meant(self, text: str) -> None:
        one = design({"A": 1.0}, {"a": text, "w": "A^4"}, ["a", "w"], counters={"k": {"max": 10**9}})
        assert solve(one, time_limit=2.0).x.cost == pytest.approx(0.0, abs=1e-9)

    def test_many_alternatives(self) -> None:
        one = design({"A": 1.0, "B": 0.9}, {"a": "(A|B)" * 13}, ["a"], 12.0)
        try:
            layout = solve(one, time_limit=20.0)
        except NoLayout as error:
            pytest.fail(f"8192 words, one of which fits at once: {error}")
        assert layout.x.cost < 0.5

    def test_memory_is_bounded(self) -> None:
        """A million combinations of counters are not all kept."""
        tracemalloc.start()
        try:
            solve(design(SIZES, {"a": SIX}, ["a"], 6.0), time_limit=None)
            _, peak = tracemalloc.get_traced_memory()
        finally:
            tracemalloc.stop()
        assert peak < 200e6

    def test_the_process_does_not_grow(self) -> None:
        """Designs that would take gigabytes; each is given up when the process has grown by so much.

        The work is counted, in checks, and not timed; a look is taken at each of them.
        """
        code = """
import resource
from facade_nb import NoLayout, gallery, solve
from facade_nb.solver import tuning
from tests.oracle.designs import design
from tests.oracle.nasty import NASTY
solve(gallery.load("figure-7"))
rows = {"a": "A(BA)^k", "b": "A C^l"}
long = design({"A": 1.0, "B": 0.8, "C": 1.8}, rows, ["a", "b"], 1801.0)
names = ("words of thousands of letters", "1000 m, three counters", "alternatives and a counter")
tuning.MEMORY, tuning.MEMORY_LOOK = 20_000_000, 0.0
begin = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
ended = []
for one in (long, *(NASTY[name] for name in names), long):
    checks = iter(range(12_000))
    try:
        solve(one, time_limit=None, should_stop=lambda: next(checks, None) is None)
    except NoLayout as error:
        ended.append(error.constraint)
assert ended.count("memory") >= 2, ended
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - begin) // 1024)
"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        assert int(done.stdout) < 150

    def test_a_search_is_given_up_that_takes_too_much(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(tuning, "MEMORY", -1)
        monkeypatch.setattr(tuning, "MEMORY_LOOK", 0.0)
        with pytest.raises(
            NoLayout, match=r"^Out of memory after .* Larger letters or a smaller canvas would help"
        ) as caught:
            solve(NASTY["40 layers"], time_limit=5.0)
        assert caught.value.constraint == "memory"

    def test_solved_axes_kept_are_few(self) -> None:
        one = design({"A": 1.0}, {"a": "A^k"}, ["a"])
        for n in range(150):
            solve(edit.with_canvas(one, width=4.0 + n / 100))
        assert len(CACHE.answers) <= 64


class TestClock:
    @pytest.fixture
    def now(self, monkeypatch: pytest.MonkeyPatch) -> list[float]:
        """The time, to be set."""
        at = [0.0]
        monkeypatch.setattr(clock.time, "monotonic", lambda: at[0])
        return at

    def test_the_search_leaves_time_for_a_last_attempt(self, now: list[float]) -> None:
        own = Clock(10.0)
        now[0] = 8.4
        own.check()
        now[0] = 8.6
        with pytest.raises(Stopped):
            own.check()
        assert own.over and not own.asked
        own.extend()
        own.check()
        now[0] = 10.1
        with pytest.raises(Stopped):
            own.check()

    def test_the_first_axis_leaves_time_for_the_second(self, now: list[float]) -> None:
        own = Clock(10.0)
        own.allot(0.75)
        now[0] = 6.5
        with pytest.raises(Stopped):
            own.check()
        own.allot(1.0)
        own.check()

    def test_a_clock_within_another(self, now: list[float]) -> None:
        outer = Clock(10.0)
        inner = Clock(1.0, parent=outer)
        inner.check()
        now[0] = 1.0
        with pytest.raises(Stopped):
            inner.check()
        assert inner.over and not outer.over
        later = Clock(100.0, parent=outer)
        now[0] = 9.0
        with pytest.raises(Stopped):
            later.check()
        assert outer.over

    def test_merging_has_a_moment_more(self, now: list[float]) -> None:
        """A layout that was found in time is not lost for want of a tenth of a second."""
        own = Clock(10.0)
        now[0] = 10.05
        closing = own.closing()
        closing()
        now[0] = 10.3
        with pytest.raises(Stopped):
            closing()
        stopped = Clock(None, lambda: True)
        with pytest.raises(Stopped):
            stopped.check()
        stopped.closing()()  # it has been asked; what there is, is merged
        asked = Clock(None, lambda: now[0] > 11.0)
        closing = asked.closing()
        closing()
        now[0] = 12.0
        with pytest.raises(Stopped):
            closing()

    def test_stages_that_are_no_search_are_stopped_too(self) -> None:
        def check() -> None:
            raise Stopped

        one = gallery.load("qualifiers-a")
        layout = solve(one)
        with pytest.raises(Stopped):
            merge(one, layout.x, layout.y, check)
        with pytest.raises(Stopped):
            analyse(axis_problem(one, "x"), check)
        for counters in ("A^k", "(A|B)(A|B)", "(A^k B)^.2"):
            with pytest.raises(Stopped):
                instances(parse(counters), lambda name: Symbol(name, 1.0), Counter, 5.0, check)


class TestArguments:
    def test_search(self) -> None:
        with pytest.raises(ValueError, match=r"search: expected one of 'best', 'ida', .*, found 'bfs'"):
            solve(gallery.load("figure-7"), search="bfs")


class TestEmptyDesigns:
    @pytest.mark.parametrize("one", [Design(), gallery.steps("residential-house")[0]], ids=["new", "step 0"])
    def test_nothing_to_solve(self, one: Design) -> None:
        layout = solve(one)
        assert layout.shapes == () and layout.counters == {} and layout.complete
        assert layout.x.groups == {} and layout.x.proven and layout.x.cost == 0.0
        assert Layout.from_dict(json.loads(json.dumps(layout.to_dict()))) == layout

    def test_only_layers_that_are_not_visible(self) -> None:
        one = design({"A": 9.0}, {"a": "A"}, ["a"])
        hidden = edit.with_layer(one, "L0", visible=False)
        assert solve(hidden).shapes == ()

    def test_only_the_empty_word(self) -> None:
        """A layer that has no letter fills nothing: there is no layout, and no traceback."""
        with pytest.raises(NoLayout, match=r"'a'.* It has no letters yet: write some, or make the layers"):
            solve(design({}, {"a": "ε"}, ["a"]))


@pytest.mark.parametrize(
    "name", ["figure-7", "qualifiers-a", "qualifiers-b", "qualifiers-d", "residential-house"]
)
def test_both_searches_give_one_cost(name: str) -> None:
    one = gallery.load(name)
    ours, paper = solve(one, time_limit=None), solve(one, search="ida", time_limit=None)
    for axis in ("x", "y"):
        assert paper.along(axis).cost == pytest.approx(ours.along(axis).cost, abs=1e-6)  # type: ignore[arg-type]
        assert paper.along(axis).proven and ours.along(axis).proven  # type: ignore[arg-type]


@functools.cache
def fresh(name: str) -> Layout:
    """The layout of a design of the gallery, solved with nothing kept from before."""
    solving.forget()
    return solve(gallery.load(name), time_limit=None)


@pytest.mark.parametrize("name", TELLING)
class TestGallery:
    def test_there_and_back(self, name: str) -> None:
        """Dragging an edge and letting it go where it was leaves no mark; solved again, all is as it was."""
        one = gallery.load(name)
        before = fresh(name)
        solving.forget()
        try:
            solve(edit.with_canvas(one, width=one.canvas.width * 1.05), time_limit=5.0)
        except NoLayout as error:
            assert str(error)
        again = solve(one, time_limit=None)
        assert again == before
        assert again.to_dict() == before.to_dict()

    def test_documents(self, name: str) -> None:
        layout = fresh(name)
        text = json.dumps(layout.to_dict(), allow_nan=False)
        again = Layout.from_dict(json.loads(text))
        assert again == layout
        assert json.dumps(again.to_dict(), allow_nan=False) == text
        assert layout.to_dict()["format"] == "facade-nb/layout/1"


def test_a_layout_depends_on_one_axis_only_where_it_is_edited() -> None:
    """An edit of the height leaves what is across untouched."""
    one = gallery.load("qualifiers-a")
    assert solve(one).x == solve(edit.with_canvas(one, height=one.canvas.height * 1.02)).x


def test_an_alignment_that_takes_too_much_memory_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Words of placeholders under the paper's objective: where a piece stands costs nothing."""
    monkeypatch.setattr(tuning, "INSTANCE_BYTES", 2**25)
    rows = [
        [Letter(s, 1.0 + 0.1 * k, transparent=t) for k, s in enumerate(text)]
        for text, t in (("ABABABABABAB", False), ("CzCoCzCoCz", True), ("DfDfDfDfDf", True))
    ]
    refused: list[NoLayout] = []

    def run() -> None:  # a thread has a memory of its own
        try:
            align(rows, canvas=14.0, tolerance=7.0, search="best")
        except NoLayout as error:
            refused.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    assert "words of 12 and 10 and 10 letters takes more memory than it may" in str(refused[0])


@pytest.mark.parametrize("megabytes", [32, 44, 68, 74])
def test_memory_that_ends_in_the_middle_of_a_large_allocation(
    megabytes: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Then much of it may still be free; it is out of memory all the same, and no fault of the compiled code."""
    monkeypatch.setattr(tuning, "INSTANCE_BYTES", megabytes * 2**20)
    design = bench_anytime.stack(26, 1, 0.34)
    walk = AxisSearch(axis_problem(design, "x"), Objective(), 0.5 * design.canvas.width)
    walk.enumerate({})
    assert walk.stream is not None
    candidate = walk.stream.take()
    assert candidate is not None
    ended: list[BaseException] = []

    def run() -> None:  # a thread has a memory of its own
        try:
            walk.solve(walk.case(candidate))
        except BaseException as error:
            ended.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    assert [type(error) for error in ended] == [Stopped]
