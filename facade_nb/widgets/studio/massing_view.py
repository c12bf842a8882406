"""The 3D view by pythreejs, for notebooks that build scenes of their own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ipywidgets import Widget, widget_serialization
from traitlets import Instance

from .parts import Part

if TYPE_CHECKING:
    import pythreejs

    from ...solver import Layout
    from .massing import Massing

__all__ = ["MassingView", "layout_mesh"]


class MassingView(Part):
    """The 3D view by pythreejs: drag to orbit, scroll to zoom, click to pick a shape.

    `renderer` is the pythreejs renderer, once the view is shown: its scene takes objects of your own.
    """

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


def layout_mesh(layout: Layout) -> pythreejs.Mesh:
    """Return a layout as a pythreejs mesh: the façade's plane is z = 0, its lower left corner the origin, metres.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material.
    """
    from .massing import layout_mesh as made

    return made(layout)
