"""Chunks that are hidden behind others are not drawn, and no pixel tells."""

from __future__ import annotations

import numpy as np
import pytest

from facade_nb.render.pipeline import hidden as module
from facade_nb.render.pipeline.device import DEVICES
from facade_nb.render.pipeline.frame import Frame, in_view
from facade_nb.render.pipeline.hidden import hidden, nearest_first
from facade_nb.render.pipeline.passes import PASSES
from facade_nb.render.pipeline.renderer import renderer_of
from facade_nb.render.pipeline.scene import CHUNK
from facade_nb.render.pipeline.viewpoint import Viewpoint
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.town import Town

PIXELS = (640, 400)


def chunks(*boxes: tuple[tuple[float, float, float], tuple[float, float, float]]) -> np.ndarray:
    return np.array([(100 * k, 100, low, high) for k, (low, high) in enumerate(boxes)], CHUNK)


def test_what_is_behind_all_over_is_hidden() -> None:
    """The left half of the picture shows a wall 10 m away, the right half the sky."""
    matrix = Viewpoint((0.0, 0.0, 0.0), 0.0, 0.0, 60.0).frustum(PIXELS).matrix  # looks north: -z
    clip = matrix @ np.array([0.0, 0.0, -10.0, 1.0])
    depths = np.ones(PIXELS[::-1], np.float32)
    depths[:, :320] = 0.5 * clip[2] / clip[3] + 0.5
    asked = chunks(
        ((-6, -1, -30), (-4, 1, -20)),  # behind the wall
        ((-6, -1, -9), (-4, 1, -8)),  # before it
        ((-6, -1, -30), (-4, 1, -9)),  # begins before it
        ((4, -1, -30), (6, 1, -20)),  # beside it
        ((-6, -1, -30), (1, 1, -20)),  # it looks out at one side
        ((-6, -1, 5), (-4, 1, 9)),  # behind one's back
        ((-90, -1, -30), (-4, 1, -20)),  # reaches out of the picture
    )
    assert hidden(asked, matrix, depths).tolist() == [True, False, False, False, False, False, True]


def test_who_stands_above_sees_all(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_FIRST", 50)
    asked = chunks(*(((0.0, 0.0, -10.0 * k), (9.0, 12.0, -10.0 * k + 9.0)) for k in (3, 0, 1, 2)))
    first, rest = nearest_first(asked, np.array([4.0, 1.7, 8.0]))
    assert first.tolist() == [1, 2] and rest.tolist() == [0, 3]
    first, rest = nearest_first(asked, np.array([4.0, 40.0, 8.0]))
    assert first.tolist() == [0, 1, 2, 3] and rest.tolist() == []


def test_a_street_is_drawn_without_what_it_hides(monkeypatch: pytest.MonkeyPatch) -> None:
    """Walls, trees and depths are those of the whole mesh, to the last bit."""
    monkeypatch.setattr(module, "_FIRST", 2000)
    town = Town.generate(1000, 1)
    frame = Frame(town.scene, town.viewpoint("street").frustum(PIXELS), Daytime.at(14), PIXELS)
    wanted = ("place", "rule", "facing", "along", "depth")
    passes = [own for own in PASSES if own.name in ("G-buffer", "leaves")]
    with renderer_of(town.scene, DEVICES["osmesa"], passes=passes) as renderer:
        spared = renderer.draw(frame, wanted)
        left_out = town.scene.chunks["count"][renderer._hidden]
        renderer._software = False
        whole = renderer.draw(frame, wanted)
    for name in wanted:
        assert np.array_equal(spared[name], whole[name]), name
    assert (spared["facing"][..., 3] > 0).mean() > 0.5
    seen = town.scene.chunks["count"][in_view(town.scene, frame.frustum.matrix)]
    assert left_out.sum() > 0.1 * seen.sum()
