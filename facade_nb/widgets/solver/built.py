"""The façade that the events build, as the other views light it up: its elevation, shape by shape."""

from __future__ import annotations

from typing import Any

from ...design import DesignError
from ...render import elevation_svg
from ...solver import Trace
from ...solver.events import HoleFound, ShapeMerged

__all__ = ["PREFIX", "built"]

PREFIX = "fnb-traced"
"""What the ids in the drawing begin with; each view in the browser puts its own in place of it."""


def built(trace: Trace) -> dict[str, Any]:
    """The elevation for both themes, and where in the trace each shape and hole comes; without a layout empty."""
    drawn = {"light": "", "dark": ""}
    try:
        layout = trace.replay()
        drawn = {
            theme: elevation_svg(layout, theme=theme, background=False, prefix=PREFIX) for theme in drawn
        }
    except (
        DesignError
    ):  # no layout, or a material that there is not: the boundaries can be shown all the same
        pass
    return {
        "svg": drawn,
        "shapes": [at for at, e in enumerate(trace.events) if isinstance(e, ShapeMerged)],
        "holes": [at for at, e in enumerate(trace.events) if isinstance(e, HoleFound)],
    }
