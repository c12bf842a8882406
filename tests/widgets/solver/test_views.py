"""The views of the solver on the Python side: pieces of a trace, the shared moment, the wire, the static forms."""

from __future__ import annotations

import json
import re
import struct
import zlib
from base64 import b64decode
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from facade_nb import DesignError, NoLayout, gallery, solve
from facade_nb import widgets as public
from facade_nb.design.edit import with_canvas
from facade_nb.solver import Trace
from facade_nb.solver.events import (
    AxisPosed,
    EdgeWeighed,
    Event,
    LimitRaised,
    NodeTaken,
    ShapeMerged,
    StructurePriced,
    WaysMet,
    WordJudged,
)
from facade_nb.widgets import FacadeModel, FacadeView, QualifiersView, TraceModel, TraceView, WordsView
from facade_nb.widgets.shared.bundled import AS_RUN
from facade_nb.widgets.shared.packing import pack
from facade_nb.widgets.solver import captions, chunks, code, timeline
from facade_nb.widgets.solver.channel import TraceChannel
from facade_nb.widgets.solver.sheet import spelled

from .pieces import TRACES

VIEWS = [
    cls
    for name in public.__all__
    if isinstance(cls := getattr(public, name), type) and issubclass(cls, TraceView) and cls is not TraceView
]
every_view = pytest.mark.parametrize("cls", VIEWS, ids=lambda cls: cls.__name__)


def unpack(data: bytes) -> Any:
    """What `packing.ts` does."""
    raw = zlib.decompress(data)
    (length,) = struct.unpack("<I", raw[:4])
    base = (4 + length + 7) // 8 * 8

    def array(value: dict[str, Any]) -> Any:
        if "$" not in value:
            return value
        kind, offset, size = value["$"]
        return np.frombuffer(raw, f"<{kind}", size, base + offset)

    return json.loads(raw[4 : 4 + length], object_hook=array)


@pytest.fixture(scope="module")
def trace() -> Trace:
    return solve(gallery.load("residential-house"), trace=True).trace


class TestPacking:
    def test_values_and_arrays_come_back(self) -> None:
        value = {
            "text": "ω ≤ μ",
            "list": [1, 2.5, None, {"deep": np.arange(5, dtype=np.int32)}],
            "bytes": np.array([1, 255], np.uint8),
            "real": np.array([0.1, -2.0]),
        }
        again = unpack(pack(value))
        assert again["text"] == value["text"]
        assert again["list"][:3] == [1, 2.5, None]
        assert again["list"][3]["deep"].tolist() == [0, 1, 2, 3, 4]
        assert again["bytes"].tolist() == [1, 255]
        assert again["real"].tolist() == [0.1, -2.0]

    def test_what_json_cannot_say_is_refused(self) -> None:
        with pytest.raises(ValueError, match="JSON compliant"):
            pack({"bad": float("nan")})
        with pytest.raises(TypeError, match="expected a flat array"):
            pack({"bad": np.zeros((2, 2))})
        with pytest.raises(TypeError, match="int64"):
            pack({"bad": np.arange(3)})


class TestTimeline:
    @pytest.mark.parametrize("name", TRACES)
    def test_every_event_is_in_one_stage(self, name: str) -> None:
        events = list(TRACES[name]().events)
        cuts = timeline.segments(events)
        assert [own.first for own in cuts] == [0, *(own.last + 1 for own in cuts[:-1])]
        assert cuts[-1].last == len(events) - 1
        assert all(own.stage in timeline.STAGES for own in cuts)
        for own in cuts:  # an event of an axis is in a stage of that axis, unless that has none
            told = [e for e in events[own.first : own.last + 1] if not isinstance(e, AxisPosed)]
            assert {e.axis for e in told} <= {own.axis, ""}

    def test_stages_come_in_the_papers_order(self, trace: Trace) -> None:
        assert [(own.axis, own.stage) for own in timeline.segments(trace.events)] == [
            *((axis, stage) for axis in "xy" for stage in [*timeline.STAGES][:-1]),
            ("", "merging"),
        ]

    @pytest.mark.parametrize("name", TRACES)
    def test_a_moment_leads_back_to_its_position(self, name: str) -> None:
        events = list(TRACES[name]().events)
        ends = [end for own in timeline.segments(events) for end in (own.first, own.last)]
        for position in (*ends, *range(0, len(events), 97)):
            assert timeline.locate(events, timeline.moment_of(events, position)) == position

    def test_a_moment_of_another_trace_leads_near(self, trace: Trace) -> None:
        cut = timeline.segments(trace.events)[1]
        assert timeline.locate(trace.events, "x/words+999") == cut.last
        assert timeline.locate(trace.events, "x/words.7+2") == cut.first + 2
        assert timeline.locate(trace.events, "x/words") == cut.first

    @pytest.mark.parametrize("moment", ["", "words", "x/words+two", "x/words.b+1"])
    def test_what_is_no_moment_is_refused(self, trace: Trace, moment: str) -> None:
        with pytest.raises(ValueError, match="expected a text such as 'x/words"):
            timeline.locate(trace.events, moment)

    def test_a_stage_that_is_not_there_is_named(self, trace: Trace) -> None:
        with pytest.raises(ValueError, match=r"no z/words; it has x/analysis, x/words"):
            timeline.locate(trace.events, "z/words+1")

    def test_the_piece_tells_kinds_and_colours(self, trace: Trace) -> None:
        told = unpack(chunks.chunk(trace, "timeline"))
        kinds = [told["kinds"][n] for n in told["kind"]]
        assert kinds == [type(e).__name__ for e in trace.events]
        hues = told["symbols"]
        assert {*"ABCDefHPQR"} <= {*hues}
        across = [hues[s] for s in "ABCDefH"]
        assert len({*across}) == len(across)


class TestPieces:
    def test_every_kind_of_event_has_a_caption(self) -> None:
        assert {*captions._SAY} == {*Event.registry.values()}

    @pytest.mark.parametrize("name", TRACES)
    def test_captions_are_sentences(self, name: str) -> None:
        told = captions.captions(TRACES[name]())["text"]
        assert all(text.strip() for text in told)
        assert not [text for text in told if "None" in text]

    def test_the_channel_has_a_trait_for_every_piece(self) -> None:
        state = TraceChannel.class_trait_names(sync=True)
        assert {*chunks.CHUNKS} <= {*state}

    def test_views_need_pieces_that_there_are(self) -> None:
        assert all({*cls._needs} <= {*chunks.CHUNKS} for cls in VIEWS)

    def test_events_keep_their_place_and_fields(self, trace: Trace) -> None:
        told = unpack(chunks.chunk(trace, "words"))["events"]
        judged = [own for own in told if own["event"] == "WordJudged"]
        assert [own["at"] for own in judged] == [
            at for at, e in enumerate(trace.events) if isinstance(e, WordJudged)
        ]
        first = trace.of_kind(WordJudged)[0]
        assert judged[0]["word"] == first.word
        assert judged[0]["letters"][0]["symbol"] == first.letters[0].symbol

    @pytest.mark.parametrize("name", ["residential-house", "figure-7-paper"])
    def test_code_is_shown_as_it_stands_in_the_file(self, name: str) -> None:
        told = code.code(TRACES[name]())
        for own in told["functions"].values():
            text = "".join(piece for piece, _ in own["tokens"])
            assert re.match(r"(@\w+.*\n)*def \w+\(", text)
            assert {kind for _, kind in own["tokens"]} <= {"", "k", "s", "c"}
        events = TRACES[name]().events
        assert len(told["function"]) == len(told["line"]) == len(told["value"]) == len(events)
        assert {*told["names"]} == {*told["functions"]}
        for n, line in enumerate(told["line"]):
            own = told["functions"][told["names"][told["function"][n]]]
            assert 0 <= line <= "".join(piece for piece, _ in own["tokens"]).count("\n") + 1
            assert own["file"].endswith(".py")

    def test_every_event_of_a_search_has_its_line_and_its_variables(self) -> None:
        """The reference search, and the paper's; each line is the one that its place begins with."""
        said: dict[str, set[str]] = {}
        for name in ("lesson-table", "lesson-deepening"):
            trace = TRACES[name]()
            told = code.code(trace)
            for n, event in enumerate(trace.events):
                if isinstance(event, (NodeTaken, WaysMet, StructurePriced, LimitRaised, EdgeWeighed)):
                    own = told["functions"][told["names"][told["function"][n]]]
                    text = "".join(piece for piece, _ in own["tokens"]).split("\n")[told["line"][n] - 1]
                    said.setdefault(type(event).__name__, set()).add(text.strip())
                    assert "=" in told["values"][told["value"][n]]
        assert said == {
            "LimitRaised": {"if not self.paused and not self._prepare(limit):", "meeting = Meeting("},
            "NodeTaken": {"self.log.node(item, bound)", "self.found.nodes += 1"},
            "EdgeWeighed": {"if not drops:", "columns, beyond = lattice.columns("},
            "StructurePriced": {"priced = price(self.network.groups, self.network.structure(item))"},
            "WaysMet": {"self.found.offer(priced, self.keep)"},
        }

    def test_the_facade_has_a_shape_for_each_event(self, trace: Trace) -> None:
        told = unpack(chunks.chunk(trace, "facade"))
        assert len(told["shapes"]) == len(trace.of_kind(ShapeMerged))
        for theme in ("light", "dark"):
            assert told["svg"][theme].count("data-shape=") == len(told["shapes"])

    def test_without_a_layout_the_facade_is_empty(self) -> None:
        assert unpack(chunks.chunk(TRACES["contradiction"](), "facade"))["svg"]["light"] == ""


class TestModel:
    def test_views_of_one_trace_share_a_moment(self, trace: Trace) -> None:
        words, facade = WordsView(trace), FacadeView(trace)
        assert words.model is facade.model
        assert words.channel is facade.channel
        words.model.moment = "x/words+3"
        assert facade.model.moment == "x/words+3"
        assert facade.channel.position == facade.model.position

    def test_what_a_view_is_made_of(self, trace: Trace) -> None:
        layout = solve(gallery.load("figure-7"), trace=True)
        assert WordsView(layout).model is TraceModel.of(layout.trace)
        assert WordsView(gallery.load("figure-7")).model.name == "Counting and sizing"
        assert WordsView(TraceModel.of(trace)).model is TraceModel.of(trace)
        assert WordsView(Trace.from_json(trace.to_json())).model.name == "Residential house"

    def test_a_failure_can_be_looked_at(self) -> None:
        with pytest.raises(NoLayout) as caught:
            solve(with_canvas(gallery.load("residential-house"), width=0.2), trace=True)
        assert WordsView(caught.value).model.trace is caught.value.trace

    def test_a_layout_without_a_trace_says_what_to_do(self) -> None:
        with pytest.raises(DesignError, match="trace=True"):
            WordsView(solve(gallery.load("figure-7")))

    def test_a_trace_that_is_not_whole_is_refused(self, trace: Trace) -> None:
        with pytest.raises(DesignError, match=r"events\[0\]: expected TraceBegun, found NoneType"):
            WordsView(Trace())
        with pytest.raises(DesignError, match="found AxisPosed"):
            WordsView(Trace(list(trace.events)[1:]))

    def test_a_view_can_begin_anywhere(self, trace: Trace) -> None:
        assert WordsView(trace, at="y/words+1").model.moment == "y/words+1"
        with pytest.raises(ValueError, match="it has x/analysis"):
            WordsView(trace, at="x/cutting")

    def test_a_live_model_is_followed(self) -> None:
        model = FacadeModel(gallery.load("residential-house"))
        assert model.trace is None  # nobody looks: the solver is spared it
        view = WordsView(model)
        assert view.model is WordsView(model).model
        before, serial = view.model.trace, view.channel.serial
        view.model.moment = "x/words+2"
        model.edit(lambda design: with_canvas(design, width=9.0))
        assert view.model.trace is not before
        assert view.model.moment == "x/words+2"
        assert view.channel.serial == serial + 1
        assert view.channel.position == view.model.position

    def test_a_live_model_without_a_layout_is_followed_too(self) -> None:
        model = FacadeModel(gallery.load("residential-house"))
        view = WordsView(model)
        model.enter(("counters", "k", "min"), 40)
        assert model.layout is not None
        assert model.stale
        assert unpack(view.channel.timeline)["failure"] == model.message


class TestChannel:
    def test_pieces_are_made_when_needed(self, trace: Trace) -> None:
        channel = TraceChannel(TraceModel(trace))
        filled = {name for name in chunks.CHUNKS if getattr(channel, name)}
        assert filled == {"timeline", "captions"}
        channel._handle_custom_msg({"op": "provide", "names": ["words", "nonsense"]}, [])
        assert unpack(channel.words) == unpack(chunks.chunk(trace, "words"))
        assert not channel.code
        assert channel.trouble == ""

    def test_what_is_large_is_put_away_while_nobody_looks(self, trace: Trace) -> None:
        view = WordsView(trace)
        channel = view.channel
        channel._handle_custom_msg({"op": "view", "client": "one", "here": True}, [])
        channel._handle_custom_msg({"op": "view", "client": "one", "here": False}, [])
        assert channel.words == channel.timeline == b""
        channel._handle_custom_msg({"op": "view", "client": "two", "here": True}, [])
        assert unpack(channel.words)["events"]
        assert channel.front_end.module

    def test_the_page_and_python_agree_on_the_moment(self, trace: Trace) -> None:
        view = WordsView(trace)
        view.channel.set_state({"position": 5, "picked": ["symbol:A"]})
        assert view.model.position == 5
        assert view.model.picked == ["symbol:A"]
        view.model.pick()
        view.model.position = -1
        assert view.channel.picked == []
        assert view.channel.position == -1

    def test_an_error_of_ours_is_shown(self, trace: Trace, monkeypatch: pytest.MonkeyPatch) -> None:
        channel = TraceChannel(TraceModel(trace))
        monkeypatch.setattr("facade_nb.widgets.solver.channel.chunk", lambda *_: 1 / 0)
        channel.provide(["words"])
        assert "ZeroDivisionError" in channel.trouble


class TestViews:
    @every_view
    def test_a_view_is_small_and_shares_the_channel(self, cls: type[TraceView], trace: Trace) -> None:
        view = cls(trace)
        state = view.get_state()
        assert state["channel"] == f"IPY_MODEL_{view.channel.model_id}"
        assert sum(len(json.dumps(value, default=str)) for value in state.values()) < 2500
        assert repr(view) == f"{cls.__name__}('Residential house')"

    @every_view
    def test_a_view_has_a_table_behind_it(self, cls: type[TraceView], trace: Trace) -> None:
        assert len(cls(trace).frame) > 0

    @every_view
    @pytest.mark.parametrize("name", TRACES)
    def test_a_view_has_a_static_form(self, cls: type[TraceView], name: str) -> None:
        source = TRACES[name]()
        view = cls(source)
        bundle, _ = view._repr_mimebundle_()
        static = bundle.get("text/html", "")
        if name != "contradiction":
            assert "<img " in static or "<table" in static
        for data in re.findall(r"base64,([^\"]*)", static):
            ElementTree.fromstring(b64decode(data))  # it is well-formed
        assert len(static) < 120_000

    @every_view
    def test_the_static_form_of_a_view_that_asks_is_folded_away(
        self, cls: type[TraceView], trace: Trace
    ) -> None:
        shown = cls(trace)._repr_mimebundle_()[0]["text/html"]
        folded = cls(trace, predict=True)._repr_mimebundle_()[0]["text/html"]
        assert "<details" not in shown
        within = re.fullmatch(r"<details><summary>The answer</summary>(.+)</details>", folded, re.S)
        assert within
        drawn = re.compile(r"base64,[^\"]*")  # an elevation has new ids each time
        assert drawn.sub("", within[1]) == drawn.sub("", shown)

    def test_a_static_form_that_may_grow_old_says_so(self, trace: Trace) -> None:
        """A model that is followed may be edited; a trace stays what it is."""
        assert AS_RUN not in WordsView(trace)._repr_mimebundle_()[0]["text/html"]
        assert AS_RUN in WordsView(gallery.load("figure-7"))._repr_mimebundle_()[0]["text/html"]

    def test_the_largest_design_has_static_forms_that_are_kept(self) -> None:
        trace = solve(gallery.load("bookshop"), trace=True).trace
        for cls in VIEWS:
            made = cls(trace)._repr_mimebundle_()
            static = made[0].get("text/html", "")
            assert "<img " in static or "<table" in static, cls.__name__

    def test_the_state_goes_there_and_back(self, trace: Trace) -> None:
        view = WordsView(trace, step=1.0, tolerance=0.5, predict=True)
        state = view.get_state()
        other = WordsView(trace)
        other.set_state({name: state[name] for name in ("step", "tolerance", "predict")})
        assert (other.step, other.tolerance, other.predict) == (1.0, 0.5, True)

    def test_text_of_the_user_is_never_markup(self) -> None:
        document = gallery.load("figure-7").to_dict()
        document["name"] = '"><script>alert(1)</script>'
        static = WordsView(json.dumps(document)).to_html()
        assert "<script" not in static


class TestWords:
    def test_the_static_form_draws_words_to_scale(self) -> None:
        static = WordsView(gallery.load("figure-7")).to_html()
        drawn = ElementTree.fromstring(b64decode(re.search(r'base64,([^"]*)', static)[1]))
        space = "{http://www.w3.org/2000/svg}"
        boxes = [own for own in drawn.iter(f"{space}rect") if re.match("[hg]", own.get("class", ""))]
        sized = [float(own.get("width")) for own in boxes if own.get("class", "").startswith("h")]
        parts = [2.0, *[1.3] * 5, 2.0]  # AC⁵A
        runs = [sized[n : n + 7] for n in range(len(sized) - 6)]
        assert any(np.allclose(run, np.multiply(parts, run[0] / 2.0), atol=0.02) for run in runs)
        texts = [own.text for own in drawn.iter(f"{space}text")]
        assert "AC⁵A" in texts
        assert "✓ fits" in texts

    def test_words_are_spelled_as_the_paper_does(self, trace: Trace) -> None:
        words = {spelled(e.letters) for e in trace.of_kind(WordJudged, "x")}
        assert {"A", "ABABA", "(AB)³A", "CeC", "fDf", "H"} <= words


def test_an_empty_canvas_can_be_looked_at() -> None:
    layout = solve(gallery.steps("residential-house")[0], trace=True)
    view = WordsView(layout)
    assert view.channel.trouble == ""
    assert view.model.moment == "both/merging+1"


class TestQualifiers:
    def test_figure_4_comes_out_as_printed(self) -> None:
        frame = QualifiersView().frame
        assert list(frame.told) == [
            "P covers D.",
            "P covers B.",
            "P stands between B and D.",
            "P stands between A and D.",
        ]
        assert list(frame.unoccludable) == ["", "D", "D", "D"]
        assert list(frame.attached) == ["", "", "", "B"]

    def test_a_switch_is_solved_and_told(self) -> None:
        view = QualifiersView()
        path = ["symbols", "D", "unoccludable"]
        view.channel._handle_custom_msg({"op": "set", "case": 0, "path": path, "value": True}, [])
        assert unpack(view.channel.cases)[0]["told"] == "P covers B."
        assert unpack(view.channel.cases)[0]["changed"]
        assert not unpack(view.channel.cases)[1]["changed"]
        view.channel._handle_custom_msg({"op": "reset", "case": 0}, [])
        assert unpack(view.channel.cases)[0]["told"] == "P covers D."

    def test_a_case_without_a_layout_says_why(self) -> None:
        view = QualifiersView()
        view.channel._handle_custom_msg(
            {"op": "set", "case": 1, "path": ["canvas", "width"], "value": "0.5"}, []
        )
        case = unpack(view.channel.cases)[1]
        assert case["message"] == view.models[1].message != ""
        assert case["letters"] == []
        assert view.frame.told[1] == case["message"]

    def test_own_designs_can_be_compared(self) -> None:
        view = QualifiersView([gallery.load("qualifiers-a"), gallery.load("qualifiers-c")])
        assert len(unpack(view.channel.cases)) == 2
        assert view.to_html().count("<img ") == 2

    def test_letters_stand_where_the_facade_has_them(self) -> None:
        view = QualifiersView()
        for case, model in zip(unpack(view.channel.cases), view.models, strict=True):
            posts = [own["start"] for own in case["letters"] if own["symbol"] == "P"]
            shapes = [shape.rect[0] for shape in model.layout.shapes if shape.x == "P"]
            assert posts == pytest.approx(shapes)


class TestTables:
    def test_the_analysis_is_a_table(self) -> None:
        frame = TRACES["supplement-3.1"]().analysis()
        assert list(frame.equation) == ["m + 2 = l"]
        assert (frame.prefix[0], frame.left[0], frame.right[0], frame.suffix[0]) == (
            "A^k",
            "C^{m+2}",
            "C^l",
            "A^k",
        )
        bad = TRACES["contradiction"]().analysis()
        assert "no whole numbers" in bad.inconsistent[0]


def test_the_example_of_the_docs_runs() -> None:
    page = Path(__file__).resolve().parents[3] / "docs" / "visible.md"
    [example] = re.findall(r"```python\n(.*?)```", page.read_text("utf-8"), re.S)
    names: dict[str, Any] = {}
    exec(compile(example, str(page), "exec"), names)
    assert names["words"].model.moment == "x/words+3"
    assert names["words"].step == 1.0


def test_the_docs_name_every_view_and_every_target() -> None:
    root = Path(__file__).resolve().parents[3]
    page = (root / "docs" / "visible.md").read_text("utf-8")
    assert [cls.__name__ for cls in (*VIEWS, QualifiersView) if f"`{cls.__name__}`" not in page] == []
    links = (root / "facade_nb" / "widgets" / "src" / "solver" / "links.ts").read_text("utf-8")
    kinds = re.findall(r'key\("([a-z]+)"', links)
    assert len(kinds) > 10
    assert [kind for kind in kinds if f"`{kind}:" not in page] == []
