"""Frames of solids, as OSMesa draws them, for tests that hold the browser's to them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.pipeline.renderer import renderer_of
from facade_nb.render.pipeline.solids import Solids, solids_of
from facade_nb.render.pipeline.viewpoint import Viewpoint
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.texture.gl import OSMESA

from ..render.houses import house

__all__ = ["PLACE", "drawn", "frame_of", "solids"]

PLACE = Viewpoint((11.0, 3.0, 11.0), -36.0, -4.0, 50.0)
"""A little to the right of the house, and above the ground."""


def solids() -> Solids:
    """The house of the tests."""
    return solids_of(house())


def frame_of(
    own: Solids,
    pixels: tuple[int, int],
    hour: float = 10.0,
    place: Viewpoint = PLACE,
    looks: Looks | None = None,
) -> Frame:
    """A frame of it, as a view draws it that moves."""
    return Frame(own.scene, place.frustum(pixels), Daytime.at(hour), pixels, looks or Looks(relief=False))


def drawn(frame: Frame) -> NDArray[np.uint8]:
    """What OSMesa draws: (h, w, 3), row 0 at the top."""
    with renderer_of(frame.scene, OSMESA) as renderer:
        return np.ascontiguousarray(renderer.draw(frame)["picture"][..., :3])
