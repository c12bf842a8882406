"""The façade as a building, in the light of an hour."""

from __future__ import annotations

from math import atan2, cos, degrees, hypot, radians, sin, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray
from traitlets import Bytes, Float, List, TraitError, validate

from ...render.pipeline.solids import solids_of
from ...render.pipeline.viewpoint import Viewpoint
from .parts import Part

__all__ = ["ANGLE", "BuildingView"]

ANGLE = 36.0
"""Width of the view, degrees."""

_FILLS = 0.86
_LOWEST = 0.25
_FIRST = (24.0, 0.0)
"""What `orbit.ts` has, too: the share of the view that is filled, metres above the ground, turn and rise at first."""


def _bytes(value: Any, _: object) -> bytes:
    """What a browser has sent: it comes as a view of a message."""
    return bytes(value or b"")


class BuildingView(Part):
    """The façade as a building, drawn in the browser: orbit, zoom, pan, any hour; a click picks a shape.

    Parameters
    ----------
    model
        The shared model; or a design, of which a model is made.

    Attributes
    ----------
    turn, rise
        Where the eye stands, degrees to the right of and above the point looked at.
    distance
        From the eye to that point, metres; 0: as far as the building fills the view.
    target
        That point, metres: across, up, out of the façade; empty: the middle of the building.
    hour
        Of the day, 0 to 24.
    still
        The last picture that was drawn in a browser, as JPEG: what a saved notebook shows.
    """

    _shows = "building"
    _pictured = True

    turn = Float(_FIRST[0]).tag(sync=True)
    rise = Float(_FIRST[1]).tag(sync=True)
    distance = Float(0.0).tag(sync=True)
    target = List(Float()).tag(sync=True)
    hour = Float(10.0).tag(sync=True)
    still = Bytes().tag(sync=True, from_json=_bytes)

    @validate("hour")
    def _check_hour(self, proposal: Any) -> Any:
        if not 0 <= proposal["value"] <= 24:
            raise TraitError(f"hour: expected 0 to 24; found {proposal['value']}")
        return proposal["value"]

    @validate("rise")
    def _check_rise(self, proposal: Any) -> Any:
        if not -89 <= proposal["value"] <= 89:
            raise TraitError(f"rise: expected -89 to 89 degrees; found {proposal['value']}")
        return proposal["value"]

    @validate("target")
    def _check_target(self, proposal: Any) -> Any:
        if len(proposal["value"]) not in (0, 3):
            raise TraitError(f"target: expected three numbers, or none; found {proposal['value']}")
        return proposal["value"]

    def viewpoint(self, pixels: tuple[int, int]) -> Viewpoint:
        """Where one stands for a picture of so many pixels, as the browser has it.

        Raises
        ------
        ValueError
            Before there is a layout.
        """
        layout = self.model.layout
        if layout is None:
            raise ValueError("there is no layout yet, and so no building to look at")
        whole = self.model.whole
        solids = whole.solids(layout) if whole else None
        box = (solids or solids_of(layout, ground=False)).box
        target = np.array(self.target) if self.target else box.mean(axis=0)
        out = _outward(self.turn, self.rise)
        x, y, z = target + (self.distance or _distance(box, pixels[0] / pixels[1])) * out
        lowest = min(_LOWEST, max(0.02, target[1]))
        rise = self.rise
        if y < lowest:
            y = lowest
            rise = degrees(atan2(y - target[1], hypot(x - target[0], z - target[2])))
        return Viewpoint((float(x), float(y), float(z)), -self.turn, -rise, ANGLE)


def _outward(turn: float, rise: float) -> NDArray[np.float64]:
    """Unit vector from what is looked at to the eye."""
    t, r = radians(turn), radians(rise)
    return np.array([sin(t) * cos(r), sin(r), cos(t) * cos(r)])


def _distance(box: NDArray[np.float64], aspect: float) -> float:
    """From how far a box fills a view that is `aspect` times as wide as high."""
    turn, rise = (radians(value) for value in _FIRST)
    right = np.array([cos(turn), 0.0, -sin(turn)])
    up = np.array([-sin(turn) * sin(rise), cos(rise), -cos(turn) * sin(rise)])
    corners = np.array([[box[i, 0], box[j, 1], box[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    off = corners - box.mean(axis=0)
    wide = _FILLS * tan(radians(ANGLE) / 2)
    needed = np.maximum(abs(off @ right), abs(off @ up) * aspect) / wide
    return max(0.5, float((needed + off @ _outward(*_FIRST)).max()))
