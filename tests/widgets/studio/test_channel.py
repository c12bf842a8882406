"""The wire: what a front end is sent for what it sends."""

from __future__ import annotations

import asyncio
import json
import math
import threading
from collections.abc import Callable
from typing import Any

import pytest
from ipywidgets import Widget

from facade_nb import Design, Layout, solve
from facade_nb.widgets import FacadeModel, PatternEditor, Studio
from facade_nb.widgets.studio import channel
from facade_nb.widgets.studio.channel import Channel
from facade_nb.widgets.studio.fields import apply
from facade_nb.widgets.studio.wire import describe_design, layers_from_top

from ..houses import house


class Line:
    """A channel with a recorder in place of the comm: what would go to the browser, message by message."""

    def __init__(self, model: FacadeModel | None = None) -> None:
        self.model = model or FacadeModel(house())
        self.channel = Channel.of(self.model)
        self.updates: list[dict[str, Any]] = []
        self.replies: list[dict[str, Any]] = []
        self.channel.send_state = self._record  # type: ignore[method-assign]
        self.channel.send = self.replies.append  # type: ignore[method-assign, assignment]
        self.seq = 0

    def _record(self, key: Any = None) -> None:
        keys = {key} if isinstance(key, str) else set(self.channel.keys if key is None else key)
        self.updates.append({name: getattr(self.channel, name) for name in keys})

    def ask(self, op: str, **arguments: Any) -> None:
        self.seq += 1
        message = {"op": op, "client": "me", "seq": self.seq, **arguments}
        self.channel._handle_custom_msg(json.loads(json.dumps(message)), [])

    def set(self, path: str, value: Any) -> None:
        self.ask("set", path=path.split("/"), value=value)


def test_a_keystroke_is_answered_by_the_picture_and_then_by_all_else_that_changed() -> None:
    line = Line()
    line.set("patterns/Bx/text", "A(BA)^2")
    picture, update = line.updates
    assert set(picture) == {"status", "svg"}
    assert set(update) == {"design", "document", "stage", "letters", "ack"}
    assert update["ack"] == {"client": "me", "seq": 1}
    assert picture["svg"].count("data-shape") == len(line.model.layout.shapes)
    assert next(p for p in update["design"]["patterns"] if p["name"] == "Bx")["text"] == "A(BA)^2"


def test_a_fault_is_sent_without_the_picture() -> None:
    line = Line()
    line.set("patterns/Bx/text", "A(BA^2")
    (update,) = line.updates
    assert set(update) == {"drafts", "status", "ack"}
    (draft,) = update["drafts"]
    assert draft["faults"][0]["column"] == 2
    assert update["status"]["stale"]


def test_what_would_help_is_offered_and_done() -> None:
    line = Line()
    line.set("symbols/A/size", 9)
    status = line.channel.status
    assert status["message"] and status["suggestions"]
    (text, *_) = status["suggestions"]
    assert text in status["message"]
    line.ask("take", text=text)
    assert line.channel.status["suggestions"] == []
    assert line.channel.status["message"] == ""
    assert line.model.layout is not None and not line.model.stale
    line.ask("undo")
    assert line.channel.status["message"]


def test_what_is_no_longer_suggested_changes_nothing() -> None:
    line = Line()
    before = line.model.design
    line.ask("take", text="a width of 1 km")
    assert line.model.design == before


def test_a_slow_solve_does_not_keep_the_fields_waiting() -> None:
    gate = threading.Event()

    def slow(design: Design, *, should_stop: Callable[[], bool], **_: object) -> Layout:
        while not gate.wait(0.002) and not should_stop():
            pass
        return solve(design)

    async def session() -> Line:
        model = FacadeModel(house(), solve=slow)
        line = Line(model)
        line.set("canvas/width", "7")
        assert line.updates == []
        while not line.updates:
            await asyncio.sleep(0.001)
        assert line.updates[0]["ack"]["seq"] == 1
        assert line.updates[0]["status"]["busy"]
        assert "svg" not in line.updates[0]
        gate.set()
        while model.busy:
            await asyncio.sleep(0.005)
        return line

    line = asyncio.run(session())
    assert len(line.updates) == 3
    assert not line.updates[1]["status"]["busy"]
    assert "svg" in line.updates[1]


def test_each_of_two_views_is_answered_however_slow_the_solve(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(channel, "_PATIENCE", 60.0)
    gate = threading.Event()

    def slow(design: Design, *, should_stop: Callable[[], bool], **_: object) -> Layout:
        while not gate.wait(0.002) and not should_stop():
            pass
        return solve(design)

    async def session() -> list[dict[str, Any]]:
        model = FacadeModel(house(), solve=slow)
        line = Line(model)
        line.ask("set", path=["canvas", "width"], value="7", client="one")
        line.ask("set", path=["canvas", "height"], value="5", client="two")
        gate.set()
        while model.busy:
            await asyncio.sleep(0.005)
        return [update["ack"] for update in line.updates if "ack" in update]

    assert asyncio.run(session()) == [{"client": "one", "seq": 1}, {"client": "two", "seq": 2}]


def test_a_quick_solve_in_an_event_loop_is_the_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(channel, "_PATIENCE", 60.0)  # what is quick depends on the machine

    async def session() -> Line:
        model = FacadeModel(house())
        model.wait()
        line = Line(model)
        line.set("canvas/width", "6.4")
        while len(line.updates) < 2:
            await asyncio.sleep(0.001)
        for _ in range(20):  # whatever else there may be to send
            await asyncio.sleep(0.001)
        return line

    picture, update = asyncio.run(session()).updates
    assert set(picture) == {"svg", "status"}
    assert {"ack", "design"} <= set(update)
    assert not picture["status"]["busy"]


def test_edits_from_python_are_sent_too() -> None:
    line = Line()
    line.model.enter(("canvas", "width"), 7.0)
    assert line.updates[-1]["design"]["canvas"]["width"] == 7.0


def test_there_is_one_channel_per_model_and_one_bundle_in_it() -> None:
    model = FacadeModel(house())
    parts = [PatternEditor(model), Studio(model)]
    assert parts[0].channel is parts[1].channel is Channel.of(model)
    closed = Channel.of(model)
    closed.close()
    assert Channel.of(model) is not closed


def test_the_state_survives_a_round_trip() -> None:
    line = Line()
    line.set("patterns/Bx/text", "A(B")
    line.ask("select", shape=2)
    state = line.channel.get_state()
    assert [state.pop(name) for name in ("works", "mesh")] == [b"", b""]  # nobody looks at the building
    text = json.dumps(state, allow_nan=False)
    other = Channel.of(FacadeModel())
    other.set_state({key: value for key, value in json.loads(text).items() if not key.startswith("_")})
    assert other.get_state() == {**state, "works": b"", "mesh": b""}


def test_every_part_keeps_its_state_in_a_round_trip() -> None:
    studio = Studio(house(), view="both", height=480)
    other = Studio(house())
    other.set_state({key: studio.get_state()[key] for key in ("view", "height", "part")})
    assert (other.view, other.height, other.part) == ("both", 480, "studio")


def test_operations_edit_the_design_and_can_be_undone() -> None:
    line = Line()
    start = line.model.design
    line.ask("add", kind="symbol")
    assert line.model.design.symbols["D"].size == 1.0
    line.ask("add", kind="pattern")
    assert line.model.design.patterns["P1"].text == "ε"
    line.ask("add", kind="layer")
    assert line.model.design.layers[-1].name == "layer 1"
    line.ask("rename", kind="layer", name="layer 1", to="third")
    line.ask("rename", kind="pattern", name="By", to="floors")
    assert [layer.y.pattern for layer in line.model.design.layers] == ["floors"] * 3
    assert line.model.design.layers[-1].x.pattern == "P1"
    line.ask("move", name="third", to=2)
    assert [layer.name for layer in line.model.design.layers] == ["third", "base", "columns"]
    line.ask("remove", kind="layer", name="third")
    line.ask("remove", kind="pattern", name="P1")
    line.ask("remove", kind="symbol", name="D")
    assert [layer.name for layer in line.model.design.layers] == ["base", "columns"]
    assert set(line.model.design.symbols) == set(start.symbols)
    assert {reply["kind"] for reply in line.replies} == {"added", "renamed"}
    while line.model.can_undo:
        line.ask("undo")
    assert line.model.design == start


def test_moving_a_layer_respects_depths() -> None:
    design = apply(house(), ("layers", "columns", "visible"), True)
    document = design.to_dict()
    document["layers"][1]["depth"] = 5
    line = Line(FacadeModel(Design.from_dict(document)))
    line.ask("move", name="base", to=0)
    assert [layer.name for layer in layers_from_top(line.model.design)] == ["base", "columns"]
    line.ask("move", name="base", to=1)
    assert [layer.name for layer in layers_from_top(line.model.design)] == ["columns", "base"]


def test_a_refused_operation_is_answered_with_its_faults() -> None:
    line = Line()
    line.ask("remove", kind="symbol", name="A")
    (reply,) = line.replies
    assert (reply["kind"], reply["client"], reply["seq"]) == ("refused", "me", 1)
    assert "A" in reply["faults"][0]["message"]
    assert line.updates[-1]["ack"]["seq"] == 1
    assert line.model.design == house()


def test_masks_go_with_the_pattern_they_were_made_for() -> None:
    line = Line()
    line.set("layers/columns/y/pattern", "Bx")
    assert line.model.drafts == {}
    assert line.model.design.layers[1].y.mask is None


def test_opening_tells_faults_and_loses_nothing() -> None:
    line = Line()
    line.set("patterns/Bx/text", "A(B")
    for text, found in (
        ("{}", "format"),
        ("[1]", "object"),
        ("/etc/passwd", "JSON"),
        ('{"canvas": 3}', "canvas"),
    ):
        line.ask("open", name="x.json", text=text)
        reply = line.replies[-1]
        assert (reply["kind"], reply["name"]) == ("faults", "x.json")
        assert found in json.dumps(reply["faults"])
        assert line.model.drafts
    line.ask("open", name="house.json", text=house().to_json())
    assert line.replies[-1]["kind"] == "opened"
    assert line.model.drafts == {}
    line.ask("undo")
    assert line.model.drafts


def test_saving_sends_the_document() -> None:
    line = Line()
    line.ask("save")
    (reply,) = line.replies
    assert (reply["kind"], reply["name"]) == ("file", "test-house.json")
    assert Design.from_json(reply["text"]) == house()


def test_what_came_by_itself_is_told_as_new_until_it_is_touched() -> None:
    line = Line()
    line.set("patterns/Bx/text", "A(BA)^kZ^n")
    assert line.model.drafts == {}
    design = line.updates[-1]["design"]
    assert [symbol["name"] for symbol in design["symbols"] if symbol["fresh"]] == ["Z"]
    assert [counter["name"] for counter in design["counters"] if counter["fresh"]] == ["n"]
    line.set("symbols/Z/attached", True)
    line.set("counters/n/max", "2")
    design = line.channel.design
    assert not any(own["fresh"] for own in design["symbols"] + design["counters"])


def test_a_fault_of_ours_is_shown_and_the_next_message_works() -> None:
    line = Line()
    line.ask("no such operation")
    assert "KeyError" in line.channel.trouble
    assert line.updates[-1]["ack"]["seq"] == 1
    line.set("canvas/width", "7")
    assert line.channel.trouble == ""
    assert line.model.design.canvas.width == 7.0


def test_an_unknown_material_keeps_the_last_picture_and_says_so() -> None:
    line = Line()
    svg = line.channel.svg
    line.set("layers/base/shapes/A P/material", "marzipan")
    assert "marzipan" in line.channel.status["message"]
    assert line.channel.svg == svg
    line.set("layers/base/shapes/A P/material", "stone")
    assert line.channel.status["message"] == ""
    assert line.channel.svg != svg


def test_the_theme_redraws_the_elevation() -> None:
    line = Line()
    svg = line.channel.svg
    line.ask("theme", theme="dark")
    assert [set(update) & {"svg", "ack"} for update in line.updates[-2:]] == [{"svg"}, {"ack"}]
    assert line.channel.svg != svg


def test_the_description_is_plain_json_without_nan() -> None:
    model = FacadeModel(house())
    text = json.dumps(describe_design(model), allow_nan=False)
    symbols = {symbol["name"]: symbol for symbol in json.loads(text)["symbols"]}
    assert symbols["A"]["solved"] == {"x": round(model.layout.x.sizes["A"], 4)}
    assert symbols["e"]["size"] is None
    assert symbols["P"]["axes"] == "y"
    assert all(math.isfinite(value) for symbol in symbols.values() for value in symbol["solved"].values())


def test_a_channel_that_nobody_looks_at_is_small_and_wakes_for_the_next_view() -> None:
    line = Line()
    awake = line.channel.front_end.module
    for client, here in (("one", True), ("two", True), ("one", False)):
        line.channel._handle_custom_msg({"op": "view", "client": client, "here": here}, [])
    assert line.channel.svg != ""
    line.channel._handle_custom_msg({"op": "view", "client": "two", "here": False}, [])
    assert len(json.dumps(line.channel.get_state(), default=repr)) < 10_000
    line.model.enter(("canvas", "width"), 7.0)
    assert line.channel.svg == ""
    line.channel._handle_custom_msg({"op": "wake"}, [])
    assert line.channel.front_end.module == awake != ""
    assert line.channel.design["canvas"]["width"] == 7.0
    assert line.channel.svg.startswith("<svg")


def test_a_closed_channel_no_longer_follows() -> None:
    line = Line()
    line.channel.close()
    line.updates.clear()
    line.model.enter(("canvas", "width"), 7.0)
    assert line.updates == []


def test_all_channels_share_one_bundle_which_goes_with_the_last_view() -> None:
    Widget.close_all()
    one, two = Line(), Line()
    code = one.channel.front_end
    assert two.channel.front_end is code
    for line in (one, two):
        line.channel._handle_custom_msg({"op": "view", "client": "a", "here": True}, [])
    one.channel._handle_custom_msg({"op": "view", "client": "a", "here": False}, [])
    assert code.module
    two.channel._handle_custom_msg({"op": "view", "client": "a", "here": False}, [])
    assert code.module == code.css == ""
    one.channel.wake()
    assert code.module
    one.channel.close()
    assert code.module == ""


def test_after_a_gap_all_is_told_again_and_which_messages_have_come() -> None:
    line = Line()
    line.set("patterns/Bx/text", "A(BA)^2")
    line.set("canvas/width", "7")
    line.updates.clear()
    line.channel._handle_custom_msg({"op": "ping", "client": "other"}, [])
    assert (line.updates, line.replies) == ([], [])  # that it could be sent is all that is asked
    line.channel._handle_custom_msg({"op": "ping", "client": "other", "renew": True}, [])
    (update,) = line.updates
    assert update["design"]["canvas"]["width"] == 7
    assert update["ack"] == {"client": "me", "seq": 2}
    assert line.replies == [{"kind": "pong", "heard": {"me": 2}}]


def test_a_wire_that_its_host_has_closed_is_made_anew() -> None:
    """As marimo does with those of a cell that is run again: it closes the comm, and the widget does not hear of it."""
    model = FacadeModel(house())
    first = Studio(model)
    wire, code = first.channel, first.channel.front_end
    wire.comm._closed = code.comm._closed = True
    second = Studio(model)
    assert second.channel is not wire
    assert second.channel.front_end is not code
    assert second.channel.front_end.module
    model.enter(("canvas", "width"), 7.0)
    assert second.channel.design["canvas"]["width"] == 7.0
