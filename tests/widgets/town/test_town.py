"""The town's model, its wire and what the browser is told, without a browser."""

from __future__ import annotations

import asyncio
import json
import zlib
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import IPython
import numpy as np
import pytest
from IPython import display
from traitlets import TraitError

from facade_nb import gallery
from facade_nb.render import Grammar
from facade_nb.render.pipeline.scene import Scene
from facade_nb.render.pipeline.viewpoint import CameraPath, Viewpoint
from facade_nb.render.texture.facades import Facade
from facade_nb.render.tiles import tileset
from facade_nb.render.tiles.drawn import Drawn
from facade_nb.render.town import Town
from facade_nb.widgets import PipelineView, TownModel, TownView
from facade_nb.widgets.town import following
from facade_nb.widgets.town.channel import TownChannel
from facade_nb.widgets.town.packet import blobs_of, needs_of
from facade_nb.widgets.town.tiles import tiles_piece

from .frames import PATH, made

ROOF = "Roof -> RandUni(0, Tiles, OldTiles, Slates, Tiles, OldTiles)"


@pytest.fixture(scope="module")
def town() -> Town:
    return Town.generate(60, seed=1)


@pytest.fixture
def model(town: Town) -> TownModel:
    return TownModel(town)


def test_the_browsers_numbers_are_pythons() -> None:
    told, found = json.loads(PATH.read_text("utf-8")), json.loads(json.dumps(made()))
    assert told.keys() == found.keys()
    for a, b in zip(_leaves(told), _leaves(found), strict=True):
        assert a == pytest.approx(b, rel=1e-9, abs=1e-9)


def _leaves(value: Any) -> list[Any]:
    if isinstance(value, dict):
        return [leaf for own in value.values() for leaf in _leaves(own)]
    if isinstance(value, list):
        return [leaf for own in value for leaf in _leaves(own)]
    return [value]


def test_views_stand_outside_and_see_something(model: TownModel) -> None:
    assert list(model.views) == ["distance", "street", "close-up"]
    assert model.viewpoint == model.views["distance"]
    assert model.views["street"].eye[1] == model.views["close-up"].eye[1] == 1.7
    with pytest.raises(ValueError, match="street"):
        model.look("stret")


def test_blocks_are_the_bytes(model: TownModel) -> None:
    blobs = blobs_of(model)
    for blob in blobs.values():
        size = blob.block or len(blob.content)
        parts = [zlib.decompress(blob.deflated(k)) for k in range(-(-len(blob.content) // size))]
        assert b"".join(parts) == bytes(blob.content)
    assert bytes(blobs["vertices"].content) == model.vertices.tobytes()


def test_a_chunk_needs_the_blocks_that_its_triangles_name() -> None:
    model = TownModel(Town.generate(2000, seed=2))
    offsets, numbers = needs_of(model)
    chunks = model.source.chunks
    assert len(offsets) == len(chunks) + 1
    for k, (first, count) in enumerate(zip(chunks["first"], chunks["count"], strict=True)):
        blocks = set((model.source.indices[first : first + count] // 4096).tolist())
        assert set(numbers[offsets[k] : offsets[k + 1]].tolist()) == blocks


def test_a_grammar_that_is_edited_moves_the_vertices_to_where_their_rules_are(model: TownModel) -> None:
    before = model.vertices.copy()
    model.edit("detached")
    text = model.text
    model.enter(text.replace(ROOF, "Extra -> Skip(0)\n  " + ROOF.replace("Slates", "Extra")))
    assert model.faults == ()
    assert model.vertices is not model.source.vertices
    names = model.grammar.encoding.names
    places = dict(zip(map(tuple, model.grammar.encoding.positions), names, strict=True))
    old = dict(
        zip(
            map(tuple, model.source.grammar.encoding.positions),
            model.source.grammar.encoding.names,
            strict=True,
        )
    )
    for was, now in zip(before["start"][::37], model.vertices["start"][::37], strict=True):
        assert places[tuple(map(int, now))] == old[tuple(map(int, was))]
    for name in before.dtype.names or ():
        if name != "start":
            assert np.array_equal(before[name], model.vertices[name])
    model.undo()
    assert model.text == text
    assert np.array_equal(before["start"], model.vertices["start"])


@pytest.mark.parametrize(
    ("edit", "line", "says"),
    [
        (lambda text: text.replace(ROOF, "Roof -> RandUni(0, Nothing)"), 13, "Nothing"),
        (lambda text: text.replace(ROOF, "Roof -> RandUni(0, Tiles"), 13, "not closed"),
        (lambda text: text + "\nbad ->", None, "name"),
    ],
)
def test_a_fault_is_told_in_the_part_and_the_town_stays(
    model: TownModel, edit: Any, line: int | None, says: str
) -> None:
    model.edit("detached")
    grammar, text = model.grammar, edit(model.text)
    model.enter(text)
    assert model.text == text
    assert model.grammar is grammar
    assert says in model.faults[0].message
    assert model.faults[0].line == (line or len(text.split("\n")))


def test_a_rule_that_walls_begin_with_must_stay(model: TownModel) -> None:
    model.edit("detached")
    model.enter(model.text.replace(ROOF, ROOF.replace("Roof ", "Rooff ")))
    assert any("detached.Roof" in fault.message for fault in model.faults)


def test_another_style_changes_one_building(model: TownModel, town: Town) -> None:
    before = model.vertices.copy()
    model.restyle(3, "slab")
    first, end = model.vertices_of(3)
    changed = np.flatnonzero((model.vertices["start"] != before["start"]).any(axis=1))
    assert len(changed)
    assert first <= changed.min() <= changed.max() < end
    own = town.indices.reshape(-1, 3)[town.building_of == 3]
    assert set(changed) <= set(own.ravel().tolist())
    names = dict(zip(map(tuple, model.grammar.encoding.positions), model.grammar.encoding.names, strict=True))
    assert all(names[tuple(map(int, at))].startswith("slab.") for at in model.vertices["start"][changed])
    model.restyle(3, "half-timbered")
    model.restyle(3, town.styles[int(town.plan.style[3])].name)
    assert model.restyled == ()
    assert np.array_equal(model.vertices["start"], before["start"])
    assert np.array_equal(town.vertices["start"], before["start"])  # the town itself is nobody's to change


@pytest.mark.parametrize(("building", "style"), [(60, "slab"), (-1, "slab"), (0, "slob"), (0, 99)])
def test_what_there_is_not_is_refused(model: TownModel, building: int, style: Any) -> None:
    with pytest.raises((IndexError, ValueError), match="expected"):
        model.restyle(building, style)
    assert model.restyled == ()


def test_values_out_of_range_are_refused(model: TownModel) -> None:
    for name, value in (("hour", 25.0), ("chosen", 60)):
        with pytest.raises(TraitError, match="expected"):
            setattr(model, name, value)
    with pytest.raises(TraitError, match="half-timbered"):
        model.edit("half-timberd")


def test_the_wire(town: Town) -> None:
    view = TownView(town, "street", hour=20.0)
    wire, model, sent = view.channel, view.model, []
    wire.send = lambda content, buffers=None: sent.append((content, buffers))  # type: ignore[method-assign]
    assert isinstance(wire, TownChannel)
    assert len(wire.head) > 10_000
    ask = {"op": "blocks", "name": "vertices", "version": 0, "blocks": [0], "client": "me"}
    wire._receive(wire, ask, [])
    assert sent[0][0]["blocks"] == [0]
    assert zlib.decompress(sent[0][1][0]) == model.vertices.tobytes()[: 4096 * 68]
    wire._receive(wire, {**ask, "version": 7}, [])
    assert len(sent) == 1  # what has been replaced is not sent
    for seq, (name, value) in enumerate(
        [
            ("viewpoint", [1.0, 2.0, 3.0, 4.0, 5.0, 60.0]),
            ("hour", 9.5),
            ("chosen", 7),
            ("restyled", [7, 1]),
            ("path", CameraPath((0.0, 1.0), (view.viewpoint, view.viewpoint)).to_dict()),
            ("hour", 99.0),
            ("chosen", 99),
            ("restyled", [99, 1]),
            ("path", [{"time": 0}]),
        ]
    ):
        wire._receive(wire, {"op": "set", "name": name, "value": value, "client": "me", "seq": seq}, [])
        assert wire.ack == {"client": "me", "seq": seq}
        assert ("expected" in wire.trouble) == (seq > 4), name
        assert "Traceback" not in wire.trouble
    assert view.viewpoint == Viewpoint((1.0, 2.0, 3.0), 4.0, 5.0)
    assert model.restyled == ((7, 1),)
    assert (wire.hour, wire.chosen) == (9.5, 7)
    patch = sent[-1]
    assert patch[0]["kind"] == "patch"
    first, end = model.vertices_of(7)
    assert patch[1] == [model.vertices[first:end].tobytes()]
    wire._receive(wire, {"op": "view", "client": "me", "here": True}, [])
    wire._receive(wire, {"op": "view", "client": "me", "here": False}, [])
    assert wire.head == b""


def test_tiles_are_sent_in_the_sizes_that_are_asked_for(town: Town) -> None:
    view = TownView(town)
    sent: list[Any] = []
    view.channel.send = lambda content, buffers=None: sent.append((content, buffers))
    tiles = town.grammar.tiles
    assert tiles is not None
    for above, upto in ((0, 32), (32, 256)):
        ask = {
            "op": "tiles",
            "names": ["brick", "no tile", "brick.normal"],
            "above": [above] * 3,
            "upto": upto,
        }
        view.channel._receive(view.channel, {**ask, "client": "me"}, [])
        told, data = sent[-1][0]["tiles"], zlib.decompress(sent[-1][1][0])
        assert [own["name"] for own in told] == [
            "brick",
            "brick.normal",
        ]  # what it does not name is passed over
        wanted = [
            (np.asarray(level)[::-1] * 255 + 0.5).astype(np.uint8).tobytes()
            for name in ("brick", "brick.normal")
            for level in tiles.mips(name)
            if above < len(level) <= upto
        ]
        assert data == b"".join(wanted)


def test_what_was_not_drawn_yet_comes_small_at_first(
    town: Town, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tileset, "_DRAWN", Drawn(tmp_path))
    tiles = town.grammar.tiles
    assert tiles is not None
    (told,), data = tiles_piece(tiles, ["brick"], [0], 32)
    assert told["draft"]
    assert told["sizes"][0] == [32, 32]
    assert len(data) == 4 * (1024 + 256 + 64 + 16 + 4 + 1)
    (told,), _ = tiles_piece(tiles, ["brick"], [0], 64)
    assert not told["draft"]
    assert told["sizes"][told["first"]] == [64, 64]
    (told,), _ = tiles_piece(tiles, ["brick"], [0], 32)
    assert not told["draft"]


def test_a_first_still_waits_for_no_tile(town: Town, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sizes: list[int] = []
    paint = tileset.TileSet._paint

    def noted(self: tileset.TileSet, name: str) -> Any:
        sizes.append(self.size)
        return paint(self, name)

    view = TownView(town)
    monkeypatch.setattr(tileset.TileSet, "_paint", noted)
    monkeypatch.setattr(tileset, "_DRAWN", Drawn(tmp_path))
    assert "<img" in view.to_html()
    assert set(sizes) == {32}
    assert len(sizes) == len(town.grammar.encoding.tiles)


def test_tiles_have_a_bound(town: Town) -> None:
    view = TownView(town, tile_megabytes=3)
    assert view.model.tile_megabytes == 3
    head = view.channel.head
    view.model.tile_megabytes = 5
    assert view.channel.head != head
    with pytest.raises(TraitError, match="tile_megabytes: expected 1 to 4096; found 0"):
        TownView(town, tile_megabytes=0)


def test_a_scene_of_facades_is_shown_too() -> None:
    grammar = gallery.grammar("figure-12")
    grammar = grammar if isinstance(grammar, Grammar) else Grammar.parse(grammar)
    view = PipelineView(Scene.of_facades([Facade(grammar, (14.0, 10.0))]))
    assert len(view.channel.head) > 5000
    assert "chunks" in repr(view)
    assert "<img" in view.to_html()


def test_the_static_form_is_small(town: Town) -> None:
    view = TownView(town)
    assert 5_000 < len(view.to_html()) < 150_000
    assert "60 buildings at 11:00" in view.to_html()
    assert repr(view) == "TownView(60 buildings)"


def test_where_somebody_waits_the_view_comes_first_and_the_picture_follows(
    town: Town, monkeypatch: pytest.MonkeyPatch
) -> None:
    view = TownView(town)
    told: list[tuple[dict[str, Any], dict[str, Any], bool]] = []

    def publish(data: dict[str, Any], **more: Any) -> None:
        told.append((data, more["transient"], more.get("update", False)))

    async def shown(asked: bool, rest: float) -> Any:
        message = {"content": {"allow_stdin": asked}}
        kernel = SimpleNamespace(get_parent=lambda: message)
        monkeypatch.setattr(IPython, "get_ipython", lambda: SimpleNamespace(kernel=kernel))
        monkeypatch.setattr(following, "REST", rest)
        made = view._repr_mimebundle_()
        assert made is not None
        if asked:
            view.channel._answer({"op": "blocks", "name": "none", "version": 0, "blocks": [], "client": "x"})
        for _ in range(10):  # turns of the loop, not time: the timer is due at once
            await asyncio.sleep(0)
        return made[0]

    monkeypatch.setattr(display, "publish_display_data", publish)
    kept = asyncio.run(shown(False, 0.0))  # nobody waits: the picture is in the output itself
    assert "<img" in kept["text/html"]
    assert told == []
    live = asyncio.run(shown(True, 0.0))
    assert "text/html" not in live
    (words, first, _), (picture, then, update) = told
    assert "A town of 60 buildings at 11:00" in words["text/html"]
    assert "<img" not in words["text/html"]
    assert picture["text/html"].count("<img") == 1
    assert f"fnb-follows-{view.channel.model_id}" in picture["text/html"]
    assert update
    assert first == then != {}
    assert kept["text/html"] in picture["text/html"]


def test_without_a_loop_the_picture_does_not_wait(town: Town, monkeypatch: pytest.MonkeyPatch) -> None:
    kernel = SimpleNamespace(get_parent=lambda: {"content": {"allow_stdin": True}})
    monkeypatch.setattr(IPython, "get_ipython", lambda: SimpleNamespace(kernel=kernel))
    made = TownView(town)._repr_mimebundle_()
    assert made is not None
    assert "<img" in made[0]["text/html"]


def test_what_is_no_town_is_refused() -> None:
    with pytest.raises(TypeError, match="expected a Town or a Scene"):
        TownModel("town")  # type: ignore[arg-type]
