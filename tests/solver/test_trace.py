"""The trace as a whole: complete, lazy, written and read, replayed; and the tables made of it."""

from __future__ import annotations

import doctest
import json
import pickle
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from facade_nb import Design, DesignError, Layout, NoLayout, gallery, solve
from facade_nb.cli import main
from facade_nb.solver import Objective, Trace
from facade_nb.solver.budget import Clock, Stopped
from facade_nb.solver.events import (
    PRUNED,
    ActiveSetStep,
    AxisSolved,
    BoundariesPlaced,
    CandidateJudged,
    EdgeRefused,
    EdgeWeighed,
    Event,
    LeftOut,
    LetterPlaced,
    LimitRaised,
    NetworkOpened,
    NodeTaken,
    NoLayoutFound,
    PathChosen,
    PatternsCompared,
    RegionTraced,
    ShapeHidden,
    ShapeMerged,
    StageBegun,
    StageEnded,
    StructurePriced,
    SystemPosed,
    SystemReduced,
    SystemSolved,
    WaysMet,
    WordJudged,
)
from facade_nb.solver.trace import Recorder, Walk, recorder
from tests.known import TELLING
from tests.oracle.designs import design, make_design

HOUSE = "residential-house"
CONSTRAINTS = {"C1", "C2", "C3", "C4", "omega", "width", "empty", "boundary", *PRUNED}
QUICK = ["residential-house", "apartment-house", "figure-7", "qualifiers-b", "ingolstadt-4018215"]


def traced(one: Design, **options: Any) -> Layout:
    return solve(one, trace=True, **options)


@pytest.fixture(scope="module")
def layouts() -> dict[str, Layout]:
    """Quick gallery designs, solved with a trace, once for all tests that only read."""
    return {name: traced(gallery.load(name), time_limit=None) for name in QUICK}


def again(trace: Trace) -> Trace:
    """The trace after it was written and read."""
    return Trace.from_json(trace.to_json())


class TestReplay:
    @pytest.mark.parametrize("name", TELLING)
    @pytest.mark.parametrize("objective", [Objective(), Objective.paper()], ids=["default", "paper"])
    def test_gallery(self, name: str, objective: Objective) -> None:
        """The events alone, written and read, make an equal layout, whatever there is of one by then."""
        check_replay(gallery.load(name), objective, 0.25)

    @pytest.mark.parametrize("search", ["best", "ida"])
    @pytest.mark.parametrize("objective", [Objective(), Objective.paper()], ids=["default", "paper"])
    def test_random_designs(self, search: str, objective: Objective) -> None:
        first = 100 * (search == "ida") + 1000 * objective.plain
        seeds = range(first, first + 12)
        assert sum(check_replay(make_design(seed), objective, 0.3, search=search) for seed in seeds) > 3

    def test_steps_of_the_house(self) -> None:
        """Also without layers, and with only some."""
        steps = gallery.steps(HOUSE)
        assert check_replay(steps[0], Objective(), None) and check_replay(steps[5], Objective(), None)

    @pytest.mark.parametrize(
        "kind",
        [PathChosen, SystemPosed, SystemSolved, AxisSolved, CandidateJudged],
        ids=lambda kind: kind.__name__,
    )
    def test_every_stage_is_needed(self, layouts: dict[str, Layout], kind: type[Event]) -> None:
        """No event holds the layout: without those of one stage it cannot be made."""
        rest = [event for event in layouts[HOUSE].trace.events if not isinstance(event, kind)]
        with pytest.raises(DesignError, match=f"expected a {kind.__name__} of"):
            Trace(rest).replay()

    def test_no_layout(self) -> None:
        """The trace is in the error, and ends with why."""
        with pytest.raises(NoLayout) as caught:
            traced(design({"A": 3.0}, {"a": "AA"}, ["a"], 4.0), tolerances=(0.1,), time_limit=None)
        trace = again(caught.value.trace)
        (told,) = trace.of_kind(NoLayoutFound)
        assert (told.message, told.patterns) == (str(caught.value), caught.value.patterns)
        assert [e.reason for e in trace.of_kind(WordJudged, "x") if e.pattern == "a"] == ["too long"]
        with pytest.raises(DesignError, match="this trace tells of no layout: "):
            trace.replay()

    def test_it_reads_what_it_is_told(self, layouts: dict[str, Layout]) -> None:
        """A boundary that is told to be elsewhere is replayed elsewhere; a shape left out is not there."""
        document = layouts[HOUSE].trace.to_dict()
        for event in document["events"]:
            if event["event"] == "SystemSolved" and event["axis"] == "x":
                event["placed"] = [value * 0.5 for value in event["placed"]]
        shapes = [event for event in document["events"] if event["event"] == "ShapeMerged"]
        document["events"].remove(shapes[0])
        moved = Trace.from_dict(document).replay()
        assert moved.x.groups["default"].columns[-1] == pytest.approx(3.0)
        assert len(moved.shapes) == len(shapes) - 1


def test_a_trace_can_be_read_long_after() -> None:
    """What was to stop the solve does not stop who reads of it: events are made when they are read."""
    over = False
    layout = solve(gallery.load("apartment-house"), trace=True, should_stop=lambda: over)
    over = True
    assert layout.trace is not None
    assert again(layout.trace).replay() == layout
    clock = Clock(0.0, lambda: True)
    with pytest.raises(Stopped):
        clock.check()
    clock.close()
    clock.check()  # bands ask it when their elements are looked at for the first time


def check_replay(one: Design, objective: Objective, limit: float | None, search: str = "best") -> bool:
    """Whether there is a layout; then its trace replays to it."""
    try:
        layout = traced(one, objective=objective, time_limit=limit, search=search)
    except NoLayout:
        return False
    assert again(layout.trace).replay().to_dict() == layout.to_dict()
    return True


class TestLazy:
    @pytest.fixture
    def no_events(self, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
        """Whoever makes an event fails."""
        for kind in Event.registry.values():
            monkeypatch.setattr(kind, "__init__", refuse)
        yield

    @pytest.mark.parametrize("search", ["best", "ida"])
    def test_nothing_is_noted_without_a_trace(
        self, search: str, no_events: None, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        for kind in (Recorder, Walk):
            for name in [n for n, own in vars(kind).items() if callable(own)]:
                monkeypatch.setattr(kind, name, refuse)
        assert solve(gallery.load("qualifiers-b"), search=search, time_limit=None).trace is None

    @pytest.mark.parametrize("search", ["best", "ida"])
    def test_events_are_made_when_they_are_read(self, search: str, no_events: None) -> None:
        layout = traced(gallery.load("qualifiers-b"), search=search, time_limit=None)
        with pytest.raises(AssertionError, match="was made"):
            _ = layout.trace.events[0]

    def test_no_further_than_they_are_read(self, layouts: dict[str, Layout]) -> None:
        source = list(layouts[HOUSE].trace.events)
        made: list[Event] = []

        def make() -> Iterator[Event]:
            for event in source:
                made.append(event)
                yield event

        events = Trace(make()).events
        assert events[2] == source[2] and len(made) == 3
        assert events[1:5] == source[1:5] and len(made) == 5
        assert events[-1] == source[-1] and len(events) == len(source) == len(made)
        assert list(events) == list(events) == source  # reading twice makes nothing twice
        assert len(made) == len(source)
        with pytest.raises(IndexError):
            _ = events[len(source)]

    def test_a_copy_has_the_events(self) -> None:
        layout = traced(gallery.load("qualifiers-a"), time_limit=None)
        copied = pickle.loads(pickle.dumps(layout))
        assert copied == layout and list(copied.trace.events) == list(layout.trace.events)

    def test_read_by_several_threads(self) -> None:
        layout = traced(gallery.load("qualifiers-a"), time_limit=None)
        with ThreadPoolExecutor(4) as pool:
            read = list(pool.map(lambda _: list(layout.trace.events), range(4)))
        assert all(own == read[0] for own in read) and len(read[0]) > 100


def refuse(*_: object, **__: object) -> None:
    raise AssertionError("an event or a note was made")


class TestBounds:
    def test_what_does_not_fit_is_counted(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """The chosen path is told even where the steps that led to it are not."""
        monkeypatch.setattr(recorder, "STEPS", 5)
        monkeypatch.setattr(recorder, "CANDIDATES", 1)
        layout = traced(gallery.load("apartment-house"), time_limit=None)
        left = {event.what: event.count for event in layout.trace.of_kind(LeftOut)}
        assert any(what.startswith("steps in network") for what in left) and left["candidates"] > 0
        check_paths(layout.trace)
        assert again(layout.trace).replay().to_dict() == layout.to_dict()

    def test_of_deepening_the_last_passes_are_told(self, monkeypatch: pytest.MonkeyPatch) -> None:
        one = gallery.load("qualifiers-b")
        whole = traced(one, search="ida", time_limit=None).trace
        (path,) = whole.of_kind(PathChosen, "x")
        limits = [e.limit for e in whole.of_kind(LimitRaised, "x") if e.network == path.network]
        monkeypatch.setattr(recorder, "STEPS", 150)
        short = traced(one, search="ida", time_limit=None).trace
        own = [e for e in short.events if e.axis == "x" and getattr(e, "network", None) == path.network]
        assert [e.limit for e in own if isinstance(e, LimitRaised)] == limits
        last = max(n for n, e in enumerate(own) if isinstance(e, LimitRaised))
        assert any(isinstance(e, NodeTaken) for e in own[last:])
        assert [e for e in short.of_kind(LeftOut, "x") if e.what.startswith("steps in network")]

    def test_room_is_made_by_what_led_nowhere(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(recorder, "ROOM", 300)
        layout = traced(gallery.load("apartment-house"), time_limit=None)
        check_paths(layout.trace)
        steps = Counter(
            e.network for e in layout.trace.events if isinstance(e, (NodeTaken, EdgeWeighed, StructurePriced))
        )
        assert sum(steps.values()) <= 300 + 60


class TestComplete:
    @pytest.mark.parametrize("name", QUICK)
    def test_stages(self, name: str, layouts: dict[str, Layout]) -> None:
        """Every stage that begins ends, they nest, and each axis has all of them."""
        trace = layouts[name].trace
        open_stages: list[tuple[str, str]] = []
        seen = []
        for event in trace.events:
            if isinstance(event, StageBegun):
                open_stages.append((event.axis, event.stage))
                assert event.at >= 0
            elif isinstance(event, StageEnded):
                assert open_stages.pop() == (event.axis, event.stage)
                assert event.seconds >= 0
                seen.append((event.axis, event.stage))
        assert not open_stages
        assert seen == [
            *((axis, stage) for axis in "xy" for stage in ("analysis", "words", "search", "sizing")),
            ("", "merging"),
        ]

    @pytest.mark.parametrize("name", QUICK)
    def test_paths(self, name: str, layouts: dict[str, Layout]) -> None:
        trace = layouts[name].trace
        check_paths(trace)
        for axis in "xy":
            solved = layouts[name].along(axis).groups  # type: ignore[arg-type]
            paths = trace.of_kind(PathChosen, axis)
            assert [path.group for path in paths] == list(solved)
            for path in paths:
                assert (
                    path.error
                    == solved[path.group].error
                    == pytest.approx(sum(c.omega for c in path.columns))
                )
                assert path.width == pytest.approx(sum(column.width for column in path.columns))

    @pytest.mark.parametrize("name", QUICK)
    def test_edges_agree_with_the_constraints(self, name: str, layouts: dict[str, Layout]) -> None:
        """No column that the search made is one that a constraint forbids, and the other way about.

        What was made comes from the search; what is refused from `tracing.weighing`, which knows nothing of it.
        """
        trace = layouts[name].trace
        made: dict[tuple[str, int, int | None], list[EdgeWeighed]] = {}
        for edge in trace.of_kind(EdgeWeighed):
            made.setdefault((edge.axis, edge.network, edge.parent), []).append(edge)
        refused = trace.of_kind(EdgeRefused)
        assert {"bound", "empty"} <= {event.constraint for event in refused} <= CONSTRAINTS
        for event in refused:
            assert event.text.endswith(".")
            for edge in made.get((event.axis, event.network, event.parent), ()):
                same = zip(event.column, event.after or (), edge.column, edge.after or (), strict=True)
                assert not all(a is None or (a, p) == (b, q) for a, p, b, q in same)

    def test_candidates(self, layouts: dict[str, Layout]) -> None:
        layout = layouts["apartment-house"]
        for axis in ("x", "y"):
            told = layout.trace.of_kind(CandidateJudged, axis)
            (best,) = [event for event in told if event.fate == "best"]
            solved = layout.along(axis)  # type: ignore[arg-type]
            assert (best.cost, best.deviation) == (solved.cost, solved.deviation)
            assert best.omega == pytest.approx(sum(group.error for group in solved.groups.values()))
            assert best.networks and [event.number for event in told] == list(range(len(told)))
            for event in told:
                assert event.bound <= (event.cost if event.cost is not None else best.cost) + 1e-9 or (
                    event.fate == "bound"
                )
                if event.fate in ("tied", "dearer"):
                    assert (event.cost > best.cost + 1e-9) == (event.fate == "dearer")  # type: ignore[operator]
            assert len({tuple(event.words.items()) for event in told}) == len(told)

    def test_letters_and_shapes(self, layouts: dict[str, Layout]) -> None:
        """Every letter of the layout is placed, and each pair of letters of a layer makes a shape or says why not."""
        layout = layouts["apartment-house"]
        trace = layout.trace
        for axis in ("x", "y"):
            placed = trace.of_kind(LetterPlaced, axis)
            own = layout.along(axis)  # type: ignore[arg-type]
            rows = [row for group in own.groups.values() for row in group.rows]
            told = [(e.layer, e.column, e.symbol, e.start, e.end) for e in placed]
            assert told == [
                (row.layer, j, letter.symbol, letter.start, letter.end)
                for row in rows
                for j, element in enumerate(row.columns)
                for letter in element
            ]
            assert [e.boundaries for e in trace.of_kind(BoundariesPlaced, axis)] == [
                group.columns for group in own.groups.values()
            ]
        shown = Counter(e.layer for e in trace.of_kind(ShapeMerged))
        hidden = Counter(e.layer for e in trace.of_kind(ShapeHidden))
        for layer in {row.layer for row in rows}:
            cells = len(layout.x.row(layer).letters) * len(layout.y.row(layer).letters)
            assert shown[layer] + hidden[layer] == cells
        whys = {e.why for e in trace.of_kind(ShapeHidden)}
        assert {"transparent", "behind"} <= whys
        for event in trace.of_kind(ShapeHidden):
            if event.why == "behind":
                left, bottom, right, top = event.rect
                assert event.by != event.layer
                assert any(
                    s.layer == event.by
                    and s.rect[0] <= left + 1e-6 and s.rect[1] <= bottom + 1e-6
                    and s.rect[2] >= right - 1e-6 and s.rect[3] >= top - 1e-6
                    for s in trace.of_kind(ShapeMerged)
                )  # fmt: skip

    def test_analysis(self, layouts: dict[str, Layout]) -> None:
        trace = layouts[HOUSE].trace
        (compared,) = [e for e in trace.of_kind(PatternsCompared, "x") if set(e.patterns) == {"Cx", "Bx"}]
        assert compared.text.startswith("|e| = ")
        assert [e.system for e in trace.of_kind(SystemReduced)] == ["counters", "unsized"] * 2

    def test_active_set(self, layouts: dict[str, Layout]) -> None:
        """Our own steps end where the QP code does."""
        for layout in layouts.values():
            for axis in ("x", "y"):
                (posed,), (solved,) = (
                    layout.trace.of_kind(kind, axis) for kind in (SystemPosed, SystemSolved)
                )
                for number, answer in ((1, solved.solution), (2, solved.placed)):
                    steps = [e for e in layout.trace.of_kind(ActiveSetStep, axis) if e.round == number]
                    assert steps[0].step == 0 and steps[-1].violation <= 1e-8
                    for n, name in enumerate(posed.variables):
                        if number == 2 or posed.weight[n] > 0:
                            assert steps[-1].values[n] == pytest.approx(answer[n], abs=2e-6), name

    def test_a_network_of_several_groups(self) -> None:
        """Groups that share an unsized symbol are walked one after the other, on one path."""
        one = design(
            {"A": 1.0, "B": 1.5, "C": 0.5}, {"a": "eme; m := A", "b": "BCB", "c": "mem; m := A", "d": "BBC"},
            [("a", "g"), ("b", "g"), ("c", "h"), ("d", "h")],
        )  # fmt: skip
        layout = traced(one, time_limit=None)
        (network,) = layout.trace.of_kind(NetworkOpened, "x")[:1]
        assert network.names == ("g", "h")
        check_paths(layout.trace)
        assert {e.group for e in layout.trace.of_kind(NodeTaken, "x")} >= {0, 1}
        assert again(layout.trace).replay().to_dict() == layout.to_dict()


def check_paths(trace: Trace) -> None:
    """Each chosen path is a chain of weighed edges from the first node to the last, column by column."""
    edges = {(e.axis, e.network, e.path): e for e in trace.of_kind(EdgeWeighed)}
    chosen: dict[tuple[str, int | None], list[PathChosen]] = {}
    for path in trace.of_kind(PathChosen):
        chosen.setdefault((path.axis, path.network), []).append(path)
    assert chosen
    for (axis, network), paths in chosen.items():
        assert network is not None and len({path.nodes for path in paths}) == 1
        steps = [edges[axis, network, end] for _, end in pairwise(paths[0].nodes)]
        assert [step.parent for step in steps] == list(paths[0].nodes[:-1])
        by_group: dict[int, list[EdgeWeighed]] = {}
        for step in steps:
            by_group.setdefault(step.group, []).append(step)
        told = [[(step.column, step.after) for step in own] for _, own in sorted(by_group.items())]
        # groups with equal words share a network; its path is then theirs all
        for path in paths:
            assert [(column.letters, column.after) for column in path.columns] in told


class TestPaperSearch:
    """What the paper's search tells by itself, as it goes."""

    @pytest.fixture(scope="class")
    @classmethod
    def trace(cls) -> Trace:
        return again(traced(gallery.load("qualifiers-b"), search="ida", time_limit=None).trace)

    def test_columns_of_the_path_are_marked(self, trace: Trace) -> None:
        """As far as they were weighed: where words read alike from both ends, one half stands for the other."""
        edges = trace.edges()
        (path,) = trace.of_kind(PathChosen, "x")
        own = edges[(edges.axis == "x") & (edges.network == path.network) & edges.chosen]
        ends = {frozenset([a, b]) for a, b in zip(own.places, own.after, strict=True)}
        places = [tuple(0 for _ in path.bands), *(column.after for column in path.columns)]
        assert ends and ends <= {frozenset(pair) for pair in pairwise(places)}

    def test_the_ways_meet_on_the_path(self, trace: Trace) -> None:
        (path,) = trace.of_kind(PathChosen, "x")
        met = [e for e in trace.of_kind(WaysMet, "x") if e.network == path.network]
        assert any(e.places in {column.after for column in path.columns} for e in met)
        assert {e.way for e in trace.of_kind(NodeTaken, "x")} <= {"forward", "backward"}

    def test_regions_and_refusals(self, trace: Trace) -> None:
        """The pointer along a border reads one letter at a time; who is to blame is said of what it leaves out."""
        regions = trace.of_kind(RegionTraced, "x")
        assert regions
        for e in regions:
            for border in (e.lower, e.upper):
                assert all((c - a) + (d - b) == 1 for (a, b), (c, d) in pairwise(border))
        refused = trace.of_kind(EdgeRefused, "x")
        assert {e.constraint for e in refused} <= CONSTRAINTS
        assert all(e.text.endswith(".") and (e.bands or e.constraint in PRUNED) for e in refused)


class TestDocument:
    @pytest.mark.parametrize("name", QUICK)
    def test_round_trip(self, name: str, layouts: dict[str, Layout]) -> None:
        trace = layouts[name].trace
        text = trace.to_json()
        assert list(Trace.from_json(text).events) == list(trace.events)
        assert json.loads(text, parse_constant=pytest.fail) == json.loads(json.dumps(trace.to_dict()))

    def test_file(self, tmp_path: Path) -> None:
        """The command line writes what can be read and replayed."""
        source, target, out = tmp_path / "house.json", tmp_path / "trace.json", tmp_path / "layout.json"
        source.write_text(gallery.load(HOUSE).to_json(), "utf-8")
        assert main(["solve", str(source), "--trace", str(target), "--out", str(out)]) == 0
        layout = Trace.from_json(target).replay()
        assert layout.to_dict() == json.loads(out.read_text("utf-8"))

    @pytest.mark.parametrize(
        ("break_it", "told"),
        [
            (lambda d: d.update(format="facade/1"), "format: expected 'facade-nb/trace/1', found 'facade/1'"),
            (lambda d: d.pop("events"), "events: expected a list, found NoneType"),
            (lambda d: d["events"].insert(0, 3), "events[0]: expected an event, found 3"),
            (lambda d: d["events"][1].update(event="AxisPosd"),
             "events[1].event: expected a kind of event, found 'AxisPosd'; did you mean 'AxisPosed'?"),
            (lambda d: d["events"][1].update(canvas="6"), "events[1].canvas: expected a number, found '6'"),
            (lambda d: d["events"][1].update(canvas=True), "events[1].canvas: expected a number, found True"),
            (lambda d: d["events"][1].pop("canvas"), "events[1].canvas: expected a value, found none"),
            (lambda d: d["events"][1].update(canvass=1), "events[1].canvass: no such field; did you mean 'canvas'?"),
            (lambda d: d["events"][1]["groups"][0].update(layers=["a", 1]),
             "events[1].groups[0].layers[1]: expected a text, found 1"),
            (lambda d: d["events"][1].update(groups={}), "events[1].groups: expected a list, found {}"),
        ],
    )  # fmt: skip
    def test_faults(self, layouts: dict[str, Layout], break_it: Callable[[Any], Any], told: str) -> None:
        document = layouts[HOUSE].trace.to_dict()
        break_it(document)
        with pytest.raises(DesignError) as caught:
            Trace.from_json(json.dumps(document))
        assert str(caught.value).startswith(told)

    @pytest.mark.parametrize(
        ("text", "told"),
        [
            ('{"format": \n nope}', "line 2, column 2: expected JSON"),
            ("[]", "expected a trace document, found list"),
            ('{"format": NaN}', "expected a number, found NaN"),
        ],
    )
    def test_texts(self, text: str, told: str) -> None:
        with pytest.raises(DesignError) as caught:
            Trace.from_json(text)
        assert told in str(caught.value)

    def test_a_missing_file(self, tmp_path: Path) -> None:
        with pytest.raises(DesignError, match="cannot be read: No such file"):
            Trace.from_json(tmp_path / "none.json")


class TestTables:
    def test_lines(self, layouts: dict[str, Layout]) -> None:
        """A line for each event; names are those that a person reads."""
        trace = layouts[HOUSE].trace
        assert len(trace.words()) == len(trace.of_kind(WordJudged))
        assert len(trace.nodes()) == len(trace.of_kind(NodeTaken))
        assert len(trace.edges()) == len(trace.of_kind(EdgeWeighed)) + len(trace.of_kind(EdgeRefused))
        candidates = trace.candidates()
        best = candidates[(candidates.fate == "best") & (candidates.axis == "x")].iloc[0]
        assert (best["word.Cx"], best["counter.k"]) == ("C e C", layouts[HOUSE].counters["k"])
        words = trace.words()
        assert set(words[words.pattern == "Bx"]["counter.k"]) >= {0, 1, 2, 3}
        first = trace.nodes().iloc[-1]
        assert all(isinstance(rest, str) for rest in first.rests)
        edges = trace.edges()
        path = trace.path()
        chosen = edges[(edges.chosen) & (edges.axis == "x")]
        columns = (
            path[(path.axis == "x") & (path.group == "default")].groupby("column").element.apply("/".join)
        )
        assert list(chosen.column)[-len(columns) :] == list(columns)
        assert path[path.axis == "x"].end.max() == layouts[HOUSE].canvas.width

    def test_equations(self, layouts: dict[str, Layout]) -> None:
        """Values keep the bounds, and the multipliers balance the objective's gradient."""
        trace = layouts["apartment-house"].trace
        table = trace.equations()
        assert (table.value >= table.lower - 1e-7).all() and (table.value <= table.upper + 1e-7).all()
        assert set(table.kind) == {"bound", "equation", "inequality"}
        width = table[(table.axis == "x") & (table.name == "|A|")].iloc[0]
        assert width.placed == layouts["apartment-house"].x.sizes["A"]
        named = table[table.name.str.endswith("= |B|") & (table.axis == "x")].iloc[0]
        assert "|B|" in named.terms and " − " in named.terms

    def test_steps_and_times(self, layouts: dict[str, Layout]) -> None:
        trace = layouts[HOUSE].trace
        steps = trace.active_set()
        assert set(steps["round"]) == {1, 2} and "0:0" in steps.entered.iloc[0]
        times = trace.timings()
        assert {"analysis", "words", "search", "sizing", "merging"} <= set(times.stage)
        networks = times[times.stage.str.startswith("network") & (times.axis == "x")].seconds.sum()
        assert networks <= times[(times.axis == "x") & (times.stage == "search")].seconds.iloc[0]

    def test_of_nothing(self) -> None:
        """An empty canvas has tables without lines, with the same columns."""
        trace = traced(gallery.steps(HOUSE)[0]).trace
        for name in ("words", "candidates", "nodes", "edges", "path", "equations", "active_set", "timings"):
            table = getattr(trace, name)()
            assert len(table) == 0 and "axis" in table.columns

    def test_what_is_not_needed_to_solve_is_not_loaded(self) -> None:
        code = (
            "import sys; sys.modules['pandas'] = None\n"
            "from facade_nb import gallery, solve\n"
            "solve(gallery.load('qualifiers-a'))\n"
            "assert 'facade_nb.solver.events' not in sys.modules\n"
            "trace = solve(gallery.load('residential-house'), trace=True).trace\n"
            "trace.to_json(); trace.replay(); trace.lattice('x', 'default')\n"
        )
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr


class TestDocumentation:
    PAGE = Path(__file__).parents[2] / "docs" / "trace.md"

    def test_examples(self) -> None:
        flags = doctest.REPORT_NDIFF | doctest.NORMALIZE_WHITESPACE
        outcome = doctest.testfile(str(self.PAGE), module_relative=False, encoding="utf-8", optionflags=flags)
        assert outcome.failed == 0 and outcome.attempted > 12

    def test_every_event_with_every_field(self) -> None:
        lines = self.PAGE.read_text("utf-8").splitlines()
        for name, kind in Event.registry.items():
            (line,) = [own for own in lines if own.startswith(f"| `{name}` |")]
            told = re.sub(r"\([^)]*\)", "", line.split("|")[2])
            assert [own.strip() for own in told.split(",")] == [
                f.name for f in fields(kind) if f.name != "axis"
            ]

    def test_every_table_with_every_column(self, layouts: dict[str, Layout]) -> None:
        lines = self.PAGE.read_text("utf-8").splitlines()
        for name in ("words", "candidates", "nodes", "edges", "path", "equations", "active_set", "timings"):
            (line,) = [own for own in lines if own.startswith(f"| `{name}()` |")]
            told = [own.strip() for own in line.split("|")[2].split(", and ")[0].split(",")]
            table = getattr(layouts[HOUSE].trace, name)()
            assert [own for own in table.columns if "." not in own] == told
