"""The wire between a drawn survey and the browser."""

from __future__ import annotations

from typing import Any

from traitlets import Bool, Bytes, Dict

from ..shared.bundled import Message
from ..shared.pictured import EditedWire
from .model import Drawn, SurveyModel

__all__ = ["SurveyChannel"]


class SurveyChannel(EditedWire):
    """One line to the browser for a `SurveyModel`. Get it by `SurveyChannel.of`.

    A photograph that is opened in the page stays there: only one that Python was given travels, to the page.
    """

    front = "survey"

    drawn = Dict().tag(sync=True)
    photo = Bytes(help="The photograph, as the file has it.").tag(sync=True)
    can_undo = Bool().tag(sync=True)
    can_redo = Bool().tag(sync=True)

    def __init__(self, model: SurveyModel) -> None:
        self._photo = b""
        super().__init__(model, **_state(model))
        model.observe(self._on_model, "version")

    def show(self, photo: bytes) -> None:
        """Have the page show a photograph."""
        self._photo = photo
        if not self._asleep:
            self.photo = photo

    def _refill(self) -> None:
        self.photo = self._photo

    def _empty(self) -> None:
        self.photo = b""

    def _on_model(self, _: Any) -> None:
        with self.hold_sync():
            for name, value in _state(self.model).items():
                setattr(self, name, value)

    def _answer(self, message: Message) -> None:
        op = message.get("op")
        with self._telling(), self.hold_sync():
            if op in ("set", "undo", "redo", "open", "scale"):
                with self._taking(message):
                    self._edit(str(op), message)

    def _edit(self, op: str, message: Message) -> None:
        if op in ("undo", "redo"):
            getattr(self.model, op)()
        elif op == "open":
            self.model.open(str(message["text"]))
        elif op == "scale":
            self.model.scale(str(message["axis"]), float(message["length"]), float(message["known"]))
        else:
            value = message["value"]
            self.model.draw(Drawn.of(value), key=value.get("key"))


def _state(model: SurveyModel) -> dict[str, Any]:
    return {"drawn": model.drawn.told(), "can_undo": model.can_undo, "can_redo": model.can_redo}
