"""The widgets with a 3D view: the view alone, and the Studio, which has every part."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ipywidgets import Widget, widget_serialization
from traitlets import Enum, Instance, Int

from ...design import Design
from .keeping import Keeper, kept_path, studio_name
from .model import FacadeModel
from .parts import FIRST, Part

if TYPE_CHECKING:
    from .massing import Massing

__all__ = ["MassingView", "Studio"]


class MassingView(Part):
    """The 3D view: drag to orbit, scroll to zoom, click to pick a shape."""

    _shows = "massing"
    _pictured = True

    renderer = Instance(Widget, allow_none=True).tag(sync=True, **widget_serialization)

    def __init__(self, *args: Any, **traits: Any) -> None:
        self._massing: Massing | None = None
        self._views: set[str] = set()
        super().__init__(*args, **traits)
        self.on_msg(self._on_request)

    def close(self) -> None:
        """Close the view, its 3D picture with it."""
        self._dismantle()
        super().close()

    def _on_request(self, _: Widget, message: dict[str, Any], __: list[Any]) -> None:
        """Make the 3D picture when a view asks for it; close it when the last one has gone."""
        if message.get("op") != "renderer":
            return
        if message["here"]:
            self._views.add(message["client"])
            if self._massing is None:
                from .massing import Massing  # pythreejs takes a while to import, and many never look at 3D

                self._massing = Massing(self.model)
                self.renderer = self._massing.renderer
        else:
            self._views.discard(message["client"])
            if not self._views:
                self._dismantle()

    def _dismantle(self) -> None:
        if self._massing is not None:
            self.renderer = None
            self._massing.close()
            self._massing = None


class Studio(MassingView):
    """Everything in one: façade, patterns, layers, symbols, counters, canvas, toolbar and status line.

    Parameters
    ----------
    model
        The shared model; or a design, of which a model is made.
    height
        Height of the façade and of the panel beside it, in pixels.
    view
        ``"elevation"``, ``"massing"`` (3D), ``"both"``, ``"exploded"`` (the layers drawn apart) or ``"compare"``
        (two snapshots side by side).
    name
        Under which the design is kept beside the notebook while it is edited, so that it outlives the kernel. None: by
        the cell, where the studio has made its model itself; a model that was given is kept by name only. An empty name
        keeps nothing.
    """

    _shows = "studio"

    view = Enum(["elevation", "both", "massing", "exploded", "compare"], "elevation").tag(sync=True)
    height = Int(600).tag(sync=True)

    def __init__(
        self,
        model: FacadeModel | Design | str | Path | None = None,
        *,
        name: str | None = None,
        **traits: Any,
    ) -> None:
        super().__init__(model, **traits)
        self._keep(name, own=not isinstance(model, FacadeModel))
        self.observe(self._on_view, "view")

    def _keep(self, name: str | None, *, own: bool) -> None:
        """Keep the design beside the notebook, if it is this studio's to keep."""
        if self.channel.keeper is not None or name == "" or (name is None and not own):
            return
        place = studio_name()
        if name is not None:
            place = (place[0] if place else "designs", name)
        if place is not None:
            self.channel.keeper = Keeper(self.model, kept_path(*place), self.channel.tell_stage)
            self.model.wait(FIRST)
            self.channel.publish()

    def _on_view(self, _: object) -> None:
        if self._massing is not None:
            self._massing.show(self.view in ("massing", "both"))
