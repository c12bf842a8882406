"""The parts as widgets: what they carry, and what shows where no front end runs."""

from __future__ import annotations

import json
import re
from base64 import b64decode

import numpy as np
import pytest

from facade_nb import widgets
from facade_nb.widgets import FacadeModel, MassingView, Part, Studio, layout_mesh
from facade_nb.widgets.shared.bundled import AS_RUN
from facade_nb.widgets.studio.massing import Massing

from ..houses import house

PARTS = [
    cls
    for name in widgets.__all__
    if isinstance(cls := getattr(widgets, name), type) and issubclass(cls, Part)
]


@pytest.mark.parametrize("cls", [cls for cls in PARTS if cls is not Part], ids=lambda cls: cls.__name__)
def test_every_part_is_small_and_shares_the_channel(cls: type[Part]) -> None:
    model = FacadeModel(house())
    part = cls(model)
    assert part.model is model
    state = part.get_state()
    assert state["channel"] == f"IPY_MODEL_{part.channel.model_id}"
    assert sum(len(json.dumps(value, default=str)) for value in state.values()) < 2500
    assert repr(part) == f"{cls.__name__}('Test house')"


def test_a_part_makes_a_model_of_a_design() -> None:
    assert Studio(house()).model.design == house()


def test_parts_with_a_facade_carry_a_picture() -> None:
    bundle, _ = Studio(house())._repr_mimebundle_()
    picture = re.fullmatch(
        r'<figure><img alt="Elevation of Test house" src="data:image/svg\+xml;base64,(.*?)">(.*)</figure>',
        bundle["text/html"],
    )
    assert picture is not None
    assert picture[2] == f"<figcaption><small>{AS_RUN}</small></figcaption>"
    assert b64decode(picture[1]).startswith(b"<svg")
    bundle, _ = widgets.PatternEditor(house())._repr_mimebundle_()
    assert "text/html" not in bundle


def test_the_3d_view_is_made_when_a_view_asks_and_closed_with_the_last() -> None:
    view = MassingView(house())
    assert view.renderer is None
    view._handle_custom_msg({"op": "renderer", "client": "one", "here": True}, [])
    first = view.renderer
    assert first is not None
    view._handle_custom_msg({"op": "renderer", "client": "two", "here": True}, [])
    view._handle_custom_msg({"op": "renderer", "client": "one", "here": False}, [])
    assert view.renderer is first
    view._handle_custom_msg({"op": "renderer", "client": "two", "here": False}, [])
    assert view.renderer is None
    assert first.comm is None


def test_closing_the_view_closes_the_3d_picture() -> None:
    view = MassingView(house())
    view._handle_custom_msg({"op": "renderer", "client": "one", "here": True}, [])
    renderer = view.renderer
    view.close()
    assert renderer.comm is None


def test_the_mesh_is_updated_in_place() -> None:
    model = FacadeModel(house())
    massing = Massing(model)
    geometry = massing.mesh.geometry
    position = geometry.attributes["position"]
    before = position.array.copy()
    model.enter(("canvas", "width"), 6.5)
    assert massing.mesh.geometry is geometry
    assert position.array.shape == before.shape
    assert not np.array_equal(position.array, before)
    right = position.array[:, 0].max()
    assert right == pytest.approx(6.5, abs=0.2)
    massing.close()


def test_a_mesh_that_is_outgrown_is_replaced_and_closed() -> None:
    model = FacadeModel(house())
    massing = Massing(model)
    outgrown = massing.mesh.geometry
    model.enter(("canvas", "width"), 60.0)
    assert massing.mesh.geometry is not outgrown
    assert outgrown.comm is None
    massing.close()


def test_what_is_not_seen_is_not_updated() -> None:
    model = FacadeModel(house())
    massing = Massing(model)
    massing.show(False)
    before = massing.mesh.geometry.attributes["position"].array.copy()
    model.enter(("canvas", "width"), 6.5)
    assert np.array_equal(massing.mesh.geometry.attributes["position"].array, before)
    massing.show(True)
    assert not np.array_equal(massing.mesh.geometry.attributes["position"].array, before)
    massing.close()


def test_a_click_in_3d_selects_the_shape_of_the_triangle_and_tints_it() -> None:
    model = FacadeModel(house())
    massing = Massing(model)
    colours = massing.mesh.geometry.attributes["color"].array.copy()
    face = int(np.flatnonzero(massing._shapes == 3)[0])
    massing._picker.set_state({"object": f"IPY_MODEL_{massing.mesh.model_id}", "faceIndex": face})
    assert model.selection.shape == 3
    changed = (
        np.any(massing.mesh.geometry.attributes["color"].array != colours, axis=1).reshape(-1, 3).all(axis=1)
    )
    assert np.array_equal(np.flatnonzero(changed), np.flatnonzero(massing._shapes == 3))
    massing._picker.set_state({"object": None, "faceIndex": None})
    assert model.selection.shape is None
    massing.close()


def test_the_camera_keeps_its_direction_when_the_canvas_changes() -> None:
    model = FacadeModel(house())
    massing = Massing(model)
    direction = np.subtract(massing._camera.position, massing._orbit.target)
    model.enter(("canvas", "width"), 12.0)
    after = np.subtract(massing._camera.position, massing._orbit.target)
    assert np.allclose(direction / np.linalg.norm(direction), after / np.linalg.norm(after))
    assert massing._orbit.target == pytest.approx((6.0, 1.5, 0.0))
    assert np.linalg.norm(after) > np.linalg.norm(direction)
    massing.close()


def test_a_layout_is_a_pythreejs_mesh() -> None:
    layout = FacadeModel(house()).layout
    assert layout is not None
    mesh = layout_mesh(layout)
    massing = Massing(FacadeModel(house()))
    count = 3 * len(massing._shapes)
    for name in ("position", "normal", "color"):
        own = mesh.geometry.attributes[name].array
        assert np.array_equal(own, massing.mesh.geometry.attributes[name].array[:count])
    massing.close()


def test_a_closed_3d_view_no_longer_follows() -> None:
    model = FacadeModel(house())
    massing = Massing(model)
    massing.close()
    before = massing.mesh.geometry.attributes["position"].array.copy()
    model.enter(("canvas", "width"), 6.5)
    assert np.array_equal(massing.mesh.geometry.attributes["position"].array, before)
