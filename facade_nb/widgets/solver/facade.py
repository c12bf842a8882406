"""The façade as the events build it, and as what is lit in other views lights up on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...design import DesignError
from ...solver import Layout, Trace
from ..studio.parts import picture
from .forces import forced
from .sheet import MUTED, Sheet
from .timeline import timeline
from .view import LARGEST, TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["FacadeView", "drawn"]


_SIMPLE = (
    "Its full drawing is too large for a saved page: here are its shapes, in the colours of their symbols."
)


class FacadeView(TraceView):
    """The elevation, shape by shape; letters as strips before there are shapes."""

    _shows = "facade"
    _needs = ("facade", "placing", "sizing", "alignment")

    @property
    def frame(self) -> pd.DataFrame:
        """Where every element of every row stands: `Trace.path`."""
        return self.model.trace.path()

    def to_html(self) -> str:
        """The elevation, one that is too large as rectangles, and the forces on it; empty where there is no layout."""
        trace = self.model.trace
        picture = drawn(trace)
        if not picture:
            return ""
        forces = forced(trace, trace.replay())
        return picture + forces if len((picture + forces).encode()) <= LARGEST else picture


def drawn(trace: Trace) -> str:
    """The static form of the façade that the events build."""
    try:
        layout = trace.replay()
    except DesignError:
        return ""
    return picture(layout) or _outlined(layout, timeline(trace)["symbols"])


def _outlined(layout: Layout, hues: dict[str, int]) -> str:
    """Every shape as a rectangle in the colour of its horizontal symbol, layer by layer."""
    width, height = layout.canvas.width, layout.canvas.height
    scale = min(860 / width, 620 / height)
    sheet = Sheet(width * scale + 20)
    top = sheet.height
    made: dict[tuple[str, int], list[tuple[float, float, float, float]]] = {}
    for shape in layout.shapes:
        left, bottom, right, upper = shape.rect
        rect = (
            10 + left * scale,
            top + (height - upper) * scale,
            (right - left) * scale,
            (upper - bottom) * scale,
        )
        made.setdefault((shape.layer, hues.get(shape.x, 0)), []).append(rect)
    for (_, hue), rects in made.items():
        sheet.boxes(rects, hue)
    sheet.height = top + height * scale + 16
    sheet.text(
        10,
        sheet.height,
        _SIMPLE,
        fill=MUTED,
        size=11,
    )
    sheet.height += 8
    return sheet.image(f"Elevation of {layout.name}")
