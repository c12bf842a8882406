"""The façade as a building: what its view is sent, and when."""

from __future__ import annotations

import json
import subprocess
import sys
import zlib
from typing import Any

import numpy as np
import pytest
from traitlets import TraitError

from facade_nb.render.pipeline.solids import solids_of
from facade_nb.render.pipeline.vertices import VERTEX
from facade_nb.widgets import BuildingView, FacadeModel
from facade_nb.widgets.studio.channel import Channel

from ..houses import house

_TYPES = {"u1": np.uint8, "i4": np.int32, "f4": np.float32}


def unpacked(data: bytes) -> Any:
    """What `pack` has packed, as the browser reads it."""
    raw = zlib.decompress(data)
    length = int.from_bytes(raw[:4], "little")
    base = -(-(4 + length) // 8) * 8

    def array(own: dict[str, Any]) -> Any:
        if set(own) != {"$"}:
            return own
        name, at, count = own["$"]
        return np.frombuffer(raw, _TYPES[name], count, base + at)

    return json.loads(raw[4 : 4 + length], object_hook=array)


class Line:
    """A channel, and what it sends."""

    def __init__(self) -> None:
        self.model = FacadeModel(house())
        self.channel = Channel(self.model)
        self.sent: list[tuple[dict[str, Any], list[bytes]]] = []
        self.channel.send = lambda content, buffers=None: self.sent.append((content, buffers))  # type: ignore[method-assign, assignment, misc]
        self.ask("view", here=True)

    def ask(self, op: str, **arguments: Any) -> None:
        self.channel._handle_custom_msg({"op": op, "client": "me", "seq": 1, **arguments}, [])

    def look(self, on: bool = True) -> None:
        self.ask("want", what="building", on=on)


def test_a_mesh_is_made_while_somebody_looks() -> None:
    line = Line()
    assert (line.channel.mesh, line.channel.works) == (b"", b"")
    line.look()
    assert line.channel.mesh
    assert line.channel.works
    line.look(False)
    assert (line.channel.mesh, line.channel.works) == (b"", b"")
    line.model.enter(("canvas", "width"), "7")
    assert line.channel.mesh == b""
    line.look()
    assert unpacked(line.channel.mesh)["canvas"] == [7.0, 3.0]
    line.ask("view", here=False)  # nobody is there any more
    assert (line.channel.mesh, line.channel.works) == (b"", b"")


def test_the_browser_has_every_vertex_as_the_pipeline_has_it() -> None:
    line = Line()
    line.look()
    told = unpacked(line.channel.mesh)
    layout = line.model.layout
    assert layout is not None
    solids = solids_of(layout)
    own = told["varying"].reshape(len(told["facet"]), -1)
    rest = told["facets"].reshape(-1, VERTEX.itemsize // 4 - own.shape[1])[told["facet"]]
    flat = np.ascontiguousarray(np.concatenate([own, rest], axis=1))
    assert np.array_equal(flat.reshape(-1).view(VERTEX), solids.scene.vertices)
    assert np.array_equal(told["indices"], solids.scene.indices)
    assert np.array_equal(told["shapes"], solids.shapes)
    placed = [[told["names"][k] for k in row] for row in told["placed"].reshape(-1, 3)]
    assert placed == [[shape.layer, shape.x, shape.y] for shape in layout.shapes]
    assert len(told["facets"]) // 12 < 0.7 * len(solids.scene.indices) / 3  # what is flat is told once


def test_an_edit_sends_the_mesh_alone_and_another_material_what_draws_it() -> None:
    line = Line()
    line.look()
    works, mesh = line.channel.works, line.channel.mesh
    line.model.enter(("canvas", "width"), "7")
    assert line.channel.works is works
    assert line.channel.mesh != mesh
    line.ask("set", path=["shapes", "* *", "material"], value="sandstone")
    assert line.channel.works != works
    assert unpacked(line.channel.works)["tiles"] != unpacked(works)["tiles"]


def test_a_selection_makes_no_mesh() -> None:
    line = Line()
    line.look()
    mesh = line.channel.mesh
    line.ask("select", shape=2)
    assert line.channel.mesh is mesh


def test_an_unknown_material_leaves_the_last_good_picture() -> None:
    line = Line()
    line.look()
    mesh = line.channel.mesh
    line.model.edit(lambda design: house().from_dict(_with_material(design.to_dict(), "no such")))
    line.channel.publish()
    assert line.channel.mesh is mesh
    assert line.channel.trouble == ""
    line.model.undo()
    assert line.channel.mesh


def _with_material(document: dict[str, Any], name: str) -> dict[str, Any]:
    document["shapes"]["* *"]["material"] = name
    return document


def test_tiles_come_in_the_sizes_that_are_asked_for() -> None:
    line = Line()
    line.look()
    ack = line.channel.ack
    names = unpacked(line.channel.works)["tiles"]
    brick = next(name for name in names if name == "brick")
    line.ask("tiles", names=[brick, "no such"], above=[32, 0], upto=64)
    content, buffers = line.sent[-1]
    assert (content["kind"], content["client"]) == ("tiles", "me")
    (told,) = content["tiles"]
    pixels = sum(w * h for w, h in told["sizes"][told["first"] : told["end"]])
    assert len(zlib.decompress(buffers[0])) == 4 * pixels
    assert line.channel.ack is ack  # an edit that is under way is answered by its own number


def test_nothing_is_sent_of_tiles_that_nobody_looks_at() -> None:
    line = Line()
    line.ask("tiles", names=["brick"], above=[0], upto=64)
    assert line.sent == []


def test_an_empty_canvas_has_a_mesh() -> None:
    line = Line()
    line.look()
    line.model.edit(lambda design: type(design)("Nothing"))
    told = unpacked(line.channel.mesh)
    assert len(told["placed"]) == 0
    assert len(told["indices"]) == 3 * len(told["shapes"])


@pytest.mark.parametrize(("name", "value"), [("hour", 25.0), ("rise", 90.0), ("target", [1.0])])
def test_a_view_refuses_what_cannot_be(name: str, value: Any) -> None:
    view = BuildingView(house())
    before = getattr(view, name)
    with pytest.raises(TraitError, match=name):
        setattr(view, name, value)
    assert getattr(view, name) == before


def test_a_view_keeps_the_picture_that_the_browser_sends() -> None:
    view = BuildingView(house())
    view.set_state({"still": memoryview(b"a picture")})
    assert view.still == b"a picture"


def test_a_camera_in_python_stands_where_the_browser_has_it() -> None:
    view = BuildingView(house(), turn=30.0, rise=10.0, distance=12.0, target=[3.0, 2.0, 0.0])
    place = view.viewpoint((300, 200))
    assert np.hypot(np.hypot(place.eye[0] - 3, place.eye[1] - 2), place.eye[2]) == pytest.approx(12)
    assert (place.yaw, place.pitch) == (-30.0, -10.0)
    low = BuildingView(house(), rise=-15.0, distance=40.0).viewpoint((300, 200))
    assert low.eye[1] > 0


def test_a_studio_knows_nothing_of_pythreejs_and_scipy() -> None:
    code = (
        "import sys; from facade_nb import gallery; from facade_nb.widgets import MassingView, Studio;"
        "Studio(gallery.load('residential-house'), name='', view='both');"
        "sys.exit(bool({'pythreejs', 'scipy'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
