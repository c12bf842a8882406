"""The parts: widgets of one kilobyte that show a piece of a model (see docs/widgets.md)."""

from __future__ import annotations

from base64 import b64encode
from html import escape
from pathlib import Path
from typing import Any

from anywidget import AnyWidget
from ipywidgets import Widget, widget_serialization
from traitlets import Instance, Unicode

from ...design import Design, DesignError
from ...render import elevation_svg
from ...solver import Layout
from ..shared.bundled import as_run, bundle
from .channel import Channel
from .model import FacadeModel

__all__ = [
    "CanvasEditor",
    "CounterEditor",
    "ElevationView",
    "LayerEditor",
    "Part",
    "PatternEditor",
    "ShapeEditor",
    "SymbolEditor",
    "Toolbar",
    "picture",
]

_PICTURE_LIMIT = 120_000
"""Bytes of SVG up to which a saved notebook carries the static picture."""


FIRST = 2.0
"""Seconds that a new part waits for the layout, so that it appears complete; a longer solve goes on behind it."""


class Part(AnyWidget):
    """A view of one part of a model; each subclass shows another part.

    Parameters
    ----------
    model
        The shared model; or a design, of which a model is made.

    Attributes
    ----------
    model
        The shared model. Give it to other parts, and all of them show the same design.
    """

    _esm = bundle("loader.js")
    _shows = ""
    _pictured = False

    channel = Instance(Widget).tag(sync=True, **widget_serialization)
    part = Unicode().tag(sync=True)

    def __init__(self, model: FacadeModel | Design | str | Path | None = None, **traits: Any) -> None:
        self.model = model if isinstance(model, FacadeModel) else FacadeModel(model)
        self.model.wait(FIRST)
        super().__init__(channel=Channel.of(self.model), part=self._shows, **traits)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.model.design.name!r})"

    def _repr_mimebundle_(self, **options: Any) -> tuple[dict[str, Any], dict[str, Any]] | None:
        """The live view and, for pages where none can run, a picture, which says that it is of the cell's run.

        The picture is an image in HTML, since JupyterLab shows no SVG in a notebook that is not trusted yet.
        """
        self.channel.wake()
        made = super()._repr_mimebundle_(**options)
        if made is not None and self._pictured and (drawn := picture(self.model.layout)):
            made[0]["text/html"] = as_run(drawn)
        return made


def picture(layout: Layout | None) -> str:
    """The elevation as an image in HTML; empty if there is none, or none of a reasonable size."""
    if layout is None:
        return ""
    try:
        drawn = elevation_svg(layout, ids=False, holes=True).encode()
    except DesignError:  # a material that there is not: the live view says so
        return ""
    data = b64encode(drawn).decode("ascii")
    alt = escape(f"Elevation of {layout.name}")
    return f'<img alt="{alt}" src="data:image/svg+xml;base64,{data}">' if len(drawn) <= _PICTURE_LIMIT else ""


class ElevationView(Part):
    """The elevation: click a shape to pick it, drag the right or the top edge to resize the canvas."""

    _shows = "elevation"
    _pictured = True


class PatternEditor(Part):
    """The patterns' names and texts; faults stand under their field, with a caret at the place."""

    _shows = "patterns"


class SymbolEditor(Part):
    """The table of symbols: preferred and solved size, bounds, qualifiers, placement."""

    _shows = "symbols"


class CounterEditor(Part):
    """The table of counters: bounds, a fixed value, and the value solved."""

    _shows = "counters"


class LayerEditor(Part):
    """The stack, topmost first: order, visibility, and each axis's pattern, group and mask."""

    _shows = "layers"


class ShapeEditor(Part):
    """The table of pairs of the picked layer, and the looks of the pair that is picked, at every level."""

    _shows = "shapes"


class CanvasEditor(Part):
    """The name, width and height of the façade."""

    _shows = "canvas"


class Toolbar(Part):
    """Undo, redo, open, save and the gallery."""

    _shows = "toolbar"
