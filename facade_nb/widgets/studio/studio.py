"""The Studio: every part in one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from traitlets import Enum, Int

from ...design import Design
from .building import BuildingView
from .keeping import Keeper, kept_path, studio_name
from .model import FacadeModel
from .parts import FIRST

__all__ = ["Studio"]


class Studio(BuildingView):
    """Everything in one: façade, patterns, layers, symbols, counters, canvas, toolbar and status line.

    Parameters
    ----------
    model
        The shared model; or a design, of which a model is made.
    height
        Height of the façade and of the panel beside it, in pixels.
    view
        ``"elevation"``, ``"building"`` (3D), ``"both"``, ``"exploded"`` (the layers drawn apart) or ``"compare"``
        (two snapshots side by side).
    name
        Under which the design is kept beside the notebook while it is edited, so that it outlives the kernel. None: by
        the cell, where the studio has made its model itself; a model that was given is kept by name only. An empty name
        keeps nothing.
    """

    _shows = "studio"

    view = Enum(["elevation", "both", "building", "exploded", "compare"], "elevation").tag(sync=True)
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
