"""The wire between one model and the browser: its state in traits, the front end's messages, the answers."""

from __future__ import annotations

import asyncio
import traceback
from collections.abc import Callable
from typing import Any

from traitlets import Dict, List, Unicode

from ... import gallery
from ...design import DesignError, Fault
from ...render import GEOMETRIES, MATERIALS
from ...render.elevation import elevation_pieces
from ...render.scene import build_scene, drawing_faults
from ...solver import Layout
from ..shared.bundled import Message
from .commands import COMMANDS
from .model import FacadeModel
from .requests import REQUESTS
from .scenery import Scenery
from .wire import describe_design, describe_drafts, describe_faults, describe_selection, describe_status
from .words import describe_modes

__all__ = ["Channel"]

_MOMENT = 0.025
"""Seconds that the event loop stands still at most for a layout that is almost there."""

_PATIENCE = 0.08
"""Seconds that an answer waits for the layout, so that both fit in one message.

The front end has one message under way, so this is also how long a solve is left alone while a person types on.
"""


class Channel(Scenery):
    """One model's line to the browser. Get it by `Channel.of`: there is one per model."""

    front = "studio"

    gallery = List().tag(sync=True)
    catalogue = Dict().tag(sync=True)
    design = Dict().tag(sync=True)
    status = Dict().tag(sync=True)
    drafts = List().tag(sync=True)
    selection = Dict().tag(sync=True)
    svg = Unicode().tag(sync=True)
    theme = Unicode("light").tag(sync=True)
    ack = Dict().tag(sync=True)

    def __init__(self, model: FacadeModel) -> None:
        self._drawn: tuple[Layout | None, str] | None = None
        self._faults: tuple[Fault, ...] = ()
        self._answering = False
        self._answered: dict[str, Any] = {}
        self._failure = ""
        self._later: asyncio.TimerHandle | None = None
        super().__init__(
            model,
            gallery=list(gallery.names()),
            catalogue={
                "geometries": list(GEOMETRIES),
                "parameters": {
                    name: [[own.name, own.hint, *own.words] for own in geometry.parameters]
                    for name, geometry in GEOMETRIES.items()
                    if geometry.parameters
                },
                "materials": list(MATERIALS),
                "swatches": {name: material.fill for name, material in MATERIALS.items()},
                "modes": describe_modes(),
            },
        )
        self.publish()
        model.observe(self._on_version, "version")

    def _refill(self) -> None:
        self._drawn = None
        self.publish()

    def _empty(self) -> None:
        self._forget_timer()
        self.svg = ""
        self._empty_extras()
        self._drop_mesh()

    def close(self) -> None:
        """Close the wire; the model lives on."""
        if self.comm is not None:
            self.model.unobserve(self._on_version, "version")
            self._forget_timer()
            self._forget_words()
            if self.keeper is not None:
                self.keeper.close()
        super().close()

    def publish(self) -> None:
        """Send all that has changed: in one message, or, where there is another picture, that first and the rest after.

        What is told of the design is made, sent and read while the picture is on its way to the screen.
        """
        self._forget_timer()
        with self.hold_sync():
            drawn = self._attempt(self._show)
            if not drawn:
                self._tell()
        if drawn:
            with self.hold_sync():
                self._tell()

    def _attempt(self, work: Callable[[], bool]) -> bool:
        try:
            return work()
        except Exception:  # as in `_receive`: it is shown, and the fields are answered all the same
            self._failure = traceback.format_exc()
            return False

    def _show(self) -> bool:
        """Bring the picture up to date, and what lies over it; whether it is another one."""
        layout, before = self.model.layout, self.svg
        refused = ""
        if self._drawn is None or not _same(self._drawn[0], layout) or self._drawn[1] != self.theme:
            try:
                self.svg = "" if layout is None else self._draw(layout)
                self._drawn = (layout, self.theme)
            except DesignError as error:  # a material that there is not: the last good picture stays
                refused, self._faults = str(error), () if layout is None else drawing_faults(layout)
        status = describe_status(self.model, self._faults)
        if refused:
            status |= {"stale": True, "message": refused}
        self.status = status
        self.drafts = describe_drafts(self.model)
        self.selection = describe_selection(self.model)
        self._describe_overlays(self.theme)
        return self.svg != before

    def _tell(self) -> None:
        """Bring all else up to date."""
        self._attempt(self._describe)
        self.trouble = self._failure
        self.ack = self._answered

    def _describe(self) -> bool:
        self.design = describe_design(self.model)
        self._describe_extras(self.theme)
        self._describe_scenery()
        return True

    def _draw(self, layout: Layout) -> str:
        """The elevation, a piece a line: views compare the lines, and change those that differ."""
        prefix = (
            f"f{self.model_id}"  # known to the browser, which gives each of its views a prefix of its own
        )
        scene = build_scene(layout)
        self._faults = scene.faults
        pieces = elevation_pieces(
            layout, theme=self.theme, holes=True, background=False, prefix=prefix, scene=scene
        )
        return "\n".join(piece.replace("\n", "&#10;") for piece in pieces)

    def _on_version(self, _: object) -> None:
        if not self._answering and not self._asleep:
            self._publish_soon()

    def _publish_soon(self) -> None:
        """Publish now, or, where the layout may come at any moment, together with it."""
        if not self.model.busy or self.model.proving:
            self.publish()
        elif self._later is None:
            self._later = asyncio.get_running_loop().call_later(_PATIENCE, self.publish)

    def _forget_timer(self) -> None:
        if self._later is not None:
            self._later.cancel()
            self._later = None

    def _answer(self, message: Message) -> None:
        """Carry out what the front end asks for; whatever happens, it is answered."""
        if (
            message.get("op") == "tiles"
        ):  # of no consequence for the design, and of no place in the line of edits
            self._answer_tiles(message)
            return
        tag = {"client": message.get("client", ""), "seq": message.get("seq", 0)}
        reply: dict[str, Any] | None = None
        self._answering = True
        try:
            if message["op"] == "theme":
                self.theme = "dark" if message["theme"] == "dark" else "light"
            elif message["op"] in REQUESTS:
                reply = REQUESTS[message["op"]](self, message)
            else:
                reply = COMMANDS[message["op"]](self.model, message)
            self._failure = ""
        except DesignError as error:
            reply = {"kind": "refused", "faults": describe_faults(error.faults)}
        except Exception:  # the edge to the browser: shown under the widget, not lost in a log
            self._failure = traceback.format_exc()
        # Most designs are solved in a moment. Waiting it out here, without the interpreter's lock, spares the two
        # threads from passing it back and forth, and the event loop a turn.
        self.model.glimpse(_MOMENT)
        self._answering = False
        if self._later is not None and self._answered.get("client") != tag["client"]:
            self.publish()  # the answer to another view, which waits for it
        self._answered = tag
        self._publish_soon()
        self.model.go_on()
        if reply is not None:
            self.send({**reply, **tag})


def _same(before: Layout | None, layout: Layout | None) -> bool:
    """Whether two layouts look the same, such as the best of a search's first moment and what was proven to be best."""
    if before is None or layout is None or before is layout:
        return before is layout
    return (
        before.design is layout.design
        and before.canvas == layout.canvas
        and before.shapes == layout.shapes
        and before.holes == layout.holes
    )
