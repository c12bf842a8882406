"""The wire between the shared moment of some views and the browser: pieces of the trace, the position, the picks."""

from __future__ import annotations

import traceback
from collections.abc import Iterable
from typing import Any

from traitlets import Bytes, Int, List, Unicode

from ... import gallery
from ..shared.bundled import Message, ModelWire
from .chunks import CHUNKS, chunk
from .model import TraceModel

__all__ = ["TraceChannel"]

_FIRST = ("timeline", "captions")
"""What the frame of every view reads."""
_ASKED = ("position", "picked", "lesson")
"""What the page may change."""
_SHARED = ("position", "picked", "stale")
"""What it is told as it changes; a lesson comes with its trace."""


def _piece() -> Bytes:
    return Bytes().tag(sync=True)


class TraceChannel(ModelWire):
    """One trace model's line to the browser. Get it by `TraceChannel.of`: there is one for each.

    The pieces are traits, so that a reload of the page and a saved notebook have those that were needed. One is made
    when a view needs it, which Python knows when the view is made, and else the browser asks for it.
    """

    front = "solver"

    # One trait for each of `CHUNKS`.
    timeline = _piece()
    captions = _piece()
    code = _piece()
    facade = _piece()
    placing = _piece()
    words = _piece()
    analysis = _piece()
    candidates = _piece()
    network = _piece()
    alignment = _piece()
    sizing = _piece()
    run_heuristic = _piece()
    run_table = _piece()
    run_paper = _piece()

    serial = Int(help="Goes up when the pieces are those of another trace.").tag(sync=True)
    position = Int(-1).tag(sync=True)
    picked = List(Unicode()).tag(sync=True)
    lesson = Unicode(help="Name of the lesson that is shown; empty: the source is.").tag(sync=True)
    about = Unicode(help="What to look at in the lesson.").tag(sync=True)
    lessons = List(List(Unicode()), help="Names and titles of all lessons.").tag(sync=True)
    stale = Unicode(help="Why what is shown is not the present design.").tag(sync=True)

    def __init__(self, model: TraceModel) -> None:
        self._provided: dict[str, None] = {}
        notes = [gallery.lesson_note(name) for name in gallery.lessons()]
        super().__init__(
            model,
            position=model.position,
            picked=model.picked,
            lessons=[[note.name, note.title] for note in notes],
            stale=model.stale,
        )
        self._tell_lesson()
        self.provide(_FIRST)
        model.observe(self._on_trace, "trace")
        model.observe(self._on_moment, _SHARED)
        self.observe(self._on_page, _ASKED)

    def close(self) -> None:
        """Close the wire; the model lives on."""
        if self.comm is not None:
            self.model.unobserve(self._on_trace, "trace")
            self.model.unobserve(self._on_moment, _SHARED)
        super().close()

    def provide(self, names: Iterable[str]) -> None:
        """Have pieces of the trace in the traits."""
        for name in names:
            if name not in self._provided and self._fill(name):
                self._provided[name] = None

    def _fill(self, name: str) -> bool:
        try:
            setattr(self, name, chunk(self.model.trace, name))
        except Exception:  # the edge to the browser: it is shown there, not lost in a log
            self.trouble = traceback.format_exc()
            return False
        return True

    def _refill(self) -> None:
        with self.hold_sync():
            for name in self._provided:
                self._fill(name)

    def _empty(self) -> None:
        for name in self._provided:
            setattr(self, name, b"")

    def _answer(self, message: Message) -> None:
        if message.get("op") == "provide":
            self.provide(name for name in message.get("names", ()) if name in CHUNKS)

    def _on_trace(self, _: Any) -> None:
        with self.hold_sync():
            self.trouble = ""
            if not self._asleep:
                self._refill()
            self._tell_lesson()
            self.serial += 1
            self.position, self.picked = self.model.position, self.model.picked

    def _tell_lesson(self) -> None:
        self.lesson = self.model.lesson
        self.about = gallery.lesson_note(self.lesson).look if self.lesson else ""

    def _on_moment(self, change: Any) -> None:
        setattr(self, change["name"], change["new"])

    def _on_page(self, change: Any) -> None:
        setattr(self.model, change["name"], change["new"])
