"""What the stage asks for: beginnings, exports, Python, snapshots, limits, remedies, views."""

from __future__ import annotations

import base64
import json
import threading
from io import BytesIO
from typing import Any
from zipfile import ZipFile

import pytest

from facade_nb import Design, Layout, gallery, solve
from facade_nb.render import Grammar
from facade_nb.widgets import FacadeModel
from facade_nb.widgets.studio import beginnings
from facade_nb.widgets.studio.channel import Channel
from facade_nb.widgets.studio.exports import EXPORTS, export
from facade_nb.widgets.studio.facts import remedies
from facade_nb.widgets.studio.python_code import python_of

from ..houses import house


class Line:
    """A channel whose answers are kept."""

    def __init__(self, model: FacadeModel | None = None) -> None:
        self.model = model or FacadeModel(house())
        self.channel = Channel.of(self.model)
        self.replies: list[dict[str, Any]] = []
        self.channel.send = self.replies.append
        self.seq = 0

    def ask(self, op: str, **arguments: Any) -> dict[str, Any]:
        """Ask, and take what is answered."""
        self.seq += 1
        message = {"op": op, "client": "me", "seq": self.seq, **arguments}
        self.channel._handle_custom_msg(json.loads(json.dumps(message)), [])
        assert self.channel.trouble == ""
        return self.replies.pop() if self.replies else {}


@pytest.mark.parametrize("name", gallery.names())
def test_python_makes_the_design_that_it_was_copied_from(name: str) -> None:
    space: dict[str, Any] = {}
    code = python_of(gallery.load(name))
    exec(compile(code.replace("layout = solve(design)", ""), name, "exec"), space)
    assert space["design"] == gallery.load(name)
    assert "layout = solve(design)" in code


def test_copied_python_runs_as_it_is() -> None:
    line = Line()
    reply = line.ask("python")
    space: dict[str, Any] = {}
    exec(reply["text"], space)
    assert isinstance(space["layout"], Layout)
    assert space["layout"].shapes == line.model.layout.shapes  # type: ignore[union-attr]


@pytest.mark.parametrize("key", [key for key in EXPORTS if key != "png"])
def test_every_format_is_written(key: str) -> None:
    model = FacadeModel(house())
    file = export(model, key)
    data = base64.b64decode(file["text"]) if file["binary"] else file["text"].encode()
    assert file["name"].endswith(EXPORTS[key].suffix)
    assert model.layout is not None
    if key in ("svg", "dimensions", "layers"):
        assert data.startswith(b"<svg")
        assert (b'class="dimensions"' in data) == (key == "dimensions")
    elif key == "glb":
        assert data[:4] == b"glTF"
    elif key == "obj":
        with ZipFile(BytesIO(data)) as archive:
            obj, mtl = archive.namelist()
            assert obj.endswith(".obj") and mtl.endswith(".mtl")
            assert f"mtllib {mtl}" in archive.read(obj).decode()
    elif key == "dxf":
        assert b"AC1024" in data
    elif key == "pdf":
        assert data.startswith(b"%PDF")
    elif key == "cityjson":
        assert json.loads(data)["type"] == "CityJSON"
    elif key == "schedule":
        assert data.startswith(b"mark,kind,")
    elif key == "design":
        assert Design.from_json(data.decode()) == model.design
    elif key == "layout":
        assert Layout.from_dict(json.loads(data)).shapes == model.layout.shapes
    elif key == "grammar":
        assert Grammar.parse(data.decode())
    else:
        assert data.startswith(b"from facade_nb import")


def test_a_picture_is_written(monkeypatch: pytest.MonkeyPatch) -> None:
    assert b64_of(FacadeModel(Design()), "png", monkeypatch) == b"picture"


def b64_of(model: FacadeModel, key: str, monkeypatch: pytest.MonkeyPatch) -> bytes:
    one = EXPORTS[key]
    quick = {**EXPORTS, key: type(one)(one.title, one.suffix, one.media, lambda _: b"picture")}
    monkeypatch.setattr("facade_nb.widgets.studio.exports.EXPORTS", quick)
    return base64.b64decode(Line(model).ask("export", key=key)["text"])


def test_without_a_layout_what_needs_one_is_refused_and_the_rest_is_written() -> None:
    model = FacadeModel(Design())
    model.layout = None
    line = Line(model)
    assert line.ask("export", key="svg")["kind"] == "refused"
    assert Design.from_json(line.ask("export", key="design")["text"]) == Design()


def test_the_document_is_in_the_page_for_when_the_kernel_goes() -> None:
    line = Line()
    line.ask("set", path=["canvas", "width"], value="9")
    assert Design.from_json(line.channel.document) == line.model.design
    assert line.model.design.canvas.width == 9


def test_a_new_canvas_has_a_pattern_to_type_over() -> None:
    line = Line()
    before = line.model.design
    reply = line.ask("new", width="12", height="9,5")
    assert reply["kind"] == "begun"
    assert reply["pattern"] in line.model.design.patterns
    assert (line.model.design.canvas.width, line.model.design.canvas.height) == (12, 9.5)
    line.ask("undo")
    assert line.model.design == before
    assert line.ask("new", width="wide", height="9")["kind"] == "refused"
    assert line.model.design == before


def test_a_typed_pattern_is_a_facade_at_once() -> None:
    line = Line(FacadeModel(Design()))
    assert line.ask("begin", text="A(FA)^n", width="8", height="6")["kind"] == "begun"
    layout = line.model.layout
    assert layout is not None and len(layout.shapes) > 3 and not line.model.message
    assert line.model.design.canvas.width == 8
    reply = line.ask("begin", text="A(BA^k")
    assert reply["kind"] == "unbegun"
    assert reply["faults"][0]["column"] is not None


def test_a_survey_is_offered_only_where_its_data_are(monkeypatch: pytest.MonkeyPatch, tmp_path: Any) -> None:
    document = {"facades": [{"building": "7", "openings": [{"kind": "window", "rect": [0, 1, 2, 3]}]}]}
    (tmp_path / "ingolstadt.json").write_text(json.dumps(document))
    monkeypatch.setenv("FACADE_NB_DATA", str(tmp_path))
    beginnings.surveyed.cache_clear()
    try:
        line = Line(FacadeModel(Design()))
        assert line.channel.menus["surveyed"] == ["7"]
        assert line.ask("survey", building="7")["kind"] == "opened"
        assert line.channel.survey["building"] == "7"
        assert len(line.channel.survey["openings"]) == 1
        assert line.model.design.canvas.width == 4
        monkeypatch.setenv("FACADE_NB_DATA", str(tmp_path / "nowhere"))
        beginnings.surveyed.cache_clear()
        assert Line(FacadeModel(Design())).channel.menus["surveyed"] == []
        assert line.ask("survey", building="7")["kind"] == "refused"
    finally:
        beginnings.surveyed.cache_clear()


def test_thumbnails_are_made_once() -> None:
    line = Line()
    beginnings.thumbnail.cache_clear()
    reply = line.ask("thumbnail", name="figure-8")
    assert reply["kind"] == "thumbnail" and reply["svg"].startswith("<svg")
    assert line.ask("thumbnail", name="figure-8")["svg"] == reply["svg"]
    assert beginnings.thumbnail.cache_info().misses == 1


def test_a_design_that_was_opened_is_one_step_of_undo() -> None:
    line = Line()
    line.ask("set", path=["canvas", "width"], value="9")
    mine = line.model.design
    assert line.ask("gallery", name="bookshop") == {
        "kind": "opened",
        "name": "bookshop",
        "client": "me",
        "seq": 2,
    }
    text = gallery.load("figure-7").to_json()
    assert line.ask("open", name="f.json", text=text)["kind"] == "opened"
    line.ask("undo")
    line.ask("undo")
    assert line.model.design == mine


def test_snapshots_stay_as_they_were_and_can_be_brought_back() -> None:
    line = Line()
    first = line.model.design
    assert "1" in line.ask("snapshot")["text"]
    assert "same" in line.ask("snapshot")["text"]
    line.ask("set", path=["canvas", "width"], value="9")
    line.ask("snapshot")
    one, two = line.channel.snapshots
    assert (one["canvas"]["width"], two["canvas"]["width"]) == (first.canvas.width, 9)
    assert one["svg"] != two["svg"] and one["facts"]
    assert line.ask("bring-back", number=1)["kind"] == "opened"
    assert line.model.design == first
    line.ask("undo")
    assert line.model.design.canvas.width == 9
    line.ask("forget", number=1)
    assert [own["number"] for own in line.channel.snapshots] == [2]


def test_what_is_not_looked_at_is_not_made() -> None:
    line = Line()
    assert (line.channel.marks, line.channel.naive, line.channel.exploded) == ({}, {}, "")
    for what in ("marks", "naive", "exploded"):
        line.ask("want", what=what, on=True)
    layout = line.model.layout
    assert layout is not None
    assert line.channel.marks["x"][0]["columns"][-1] == layout.canvas.width
    assert len(line.channel.naive["shapes"]) == len(layout.shapes)
    assert line.channel.exploded.count("data-shape") == len(layout.shapes)
    line.ask("set", path=["canvas", "width"], value="9")
    assert line.channel.marks["x"][0]["columns"][-1] == 9
    line.channel._receive(line.channel, {"op": "view", "here": True, "client": "other"}, [])
    line.channel._receive(line.channel, {"op": "view", "here": False, "client": "me"}, [])
    line.channel.publish()
    assert (line.channel.marks, line.channel.naive, line.channel.exploded) == ({}, {}, "")


def test_the_figures_add_up() -> None:
    line = Line()
    layout = line.model.layout
    assert layout is not None
    for facts in line.channel.stage["facts"]:
        solved = layout.along(facts["axis"])
        assert facts["cost"] == pytest.approx(solved.cost, abs=1e-4)
        parts = sum(metres * price for metres, price in facts["terms"].values())
        assert facts["error"] + parts == pytest.approx(solved.cost, abs=5e-4)
        assert facts["proven"] == solved.proven


def test_a_solve_that_is_cancelled_gives_the_best_so_far() -> None:
    begun, seen = threading.Event(), []

    def slowly(design: Design, **more: Any) -> Layout:
        layout = solve(design)
        begun.set()
        while not more["should_stop"]():
            seen.append(1)
            threading.Event().wait(0.001)
        return layout

    model = FacadeModel.__new__(FacadeModel)

    def stop() -> None:
        begun.wait()
        model.stop()

    stopper = threading.Thread(target=stop)
    stopper.start()
    model.__init__(house(), solve=slowly)  # type: ignore[misc]  # without a loop it returns when the solve has ended
    stopper.join()
    assert model.layout is not None and not model.busy


def test_a_limit_holds_for_all_solves_from_then_on() -> None:
    limits: list[float | None] = []

    def noted(design: Design, *, time_limit: float | None, **_: Any) -> Layout:
        limits.append(time_limit)
        return solve(design)

    line = Line(FacadeModel(house(), solve=noted))
    line.ask("limit", seconds="2,5")
    line.ask("set", path=["canvas", "width"], value="9")
    assert limits[1:] == [2.5, 2.5]
    assert line.channel.stage["limit"] == 2.5
    for wrong in ("soon", "0", "-1", "nan"):
        assert line.ask("limit", seconds=wrong)["kind"] == "refused", wrong


def walled(patterns: dict[str, Any], *, masked: bool = False) -> Design:
    """A wall of 4 by 2 m, with columns that push it aside where there is a pattern `c`."""
    layers: list[dict[str, Any]] = [{"name": "wall", "x": {"pattern": "a"}, "y": {"pattern": "p"}}]
    if "c" in patterns:
        y = {"pattern": "p", "mask": ["Q"]} if masked else {"pattern": "p"}
        layers.append({"name": "columns", "x": {"pattern": "c"}, "y": y})
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "canvas": {"width": 7.0 if masked else 4.0, "height": 2.0},
            "symbols": {name: {"size": 2.0 if name == "B" else 1.0} for name in "ABCPQ"},
            "patterns": {"p": "PQ", **patterns},
            "layers": layers,
        }
    )


@pytest.mark.parametrize(
    ("design", "text"),
    [
        (walled({"a": {"text": "ABA", "hidden": ["B"]}}), "show B in pattern a"),
        (walled({"a": "ABA B", "c": "e d e; d := C"}, masked=True), "show P in layer columns"),
        (walled({"a": "ABA", "c": "e^k m; m := B"}), "let k be at most 1"),
    ],
)
def test_a_warning_is_fixed_by_one_press(design: Design, text: str) -> None:
    line = Line(FacadeModel(design))
    assert line.model.layout is not None
    before = line.model.layout.warnings
    [remedy] = [one for one in line.channel.stage["remedies"] if one["text"] == text]
    line.ask("remedy", **remedy)
    assert before[remedy["warning"]] not in line.model.layout.warnings
    line.ask("undo")
    assert line.model.design == design


@pytest.mark.parametrize("reason", ["the time was over", "it was stopped"])
def test_a_search_that_was_cut_short_can_go_on_longer(reason: str) -> None:
    line = Line()
    model = line.model
    object.__setattr__(
        model.layout,
        "warnings",
        (f"The search on x was cut short, as {reason}: there may be a better layout.",),
    )
    (remedy,) = remedies(model)
    line.ask("remedy", warning=0, text=remedy.text)
    assert model.time_limit == 60.0
