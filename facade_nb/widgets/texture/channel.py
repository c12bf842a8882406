"""The wire between a texture model and the browser: the grammar in pieces, what is typed, the pixel looked into."""

from __future__ import annotations

from typing import Any

from traitlets import Bool, Bytes, Dict, Float, List, Unicode

from ..shared.bundled import Message
from ..shared.pictured import EditedWire
from ..studio.wire import describe_faults
from .model import TextureModel
from .packet import derivation, light_piece, scene_piece, tiles_piece
from .still import still

__all__ = ["TextureChannel"]

_PLAIN = ("size", "seed", "hour", "lit")
_SEEN = ("grammar", *_PLAIN)


def _same_all(model: TextureModel) -> dict[str, Any]:
    return {
        "text": model.text,
        "faults": describe_faults(model.faults),
        "size": list(model.size),
        "seed": list(model.seed),
        "hour": model.hour,
        "lit": model.lit,
        "point": list(model.point or ()),
        "ray": list(model.ray or ()),
        "steps": derivation(model.derivation, model.places),
        "can_undo": model.can_undo,
        "can_redo": model.can_redo,
    }


class TextureChannel(EditedWire):
    """One texture model's line to the browser. Get it by `TextureChannel.of`: there is one for each."""

    front = "texture"

    text = Unicode().tag(sync=True)
    faults = List(Dict()).tag(sync=True)
    scene = Bytes().tag(sync=True)
    tiles = Bytes().tag(sync=True)
    light = Bytes().tag(sync=True)
    size = List(Float()).tag(sync=True)
    seed = List(Float()).tag(sync=True)
    hour = Float().tag(sync=True)
    lit = Bool().tag(sync=True)
    point = List(Float()).tag(sync=True)
    ray = List(Float()).tag(sync=True)
    steps = List(Dict()).tag(sync=True)
    can_undo = Bool().tag(sync=True)
    can_redo = Bool().tag(sync=True)

    def __init__(self, model: TextureModel) -> None:
        self._tiles: tuple[str, ...] | None = None
        self._side = 0  # of the tiles that are sent, at most; 0: as they are
        super().__init__(model, **_same_all(model))
        self._refill()
        model.observe(self._on_model)

    def _drawn(self) -> bytes:
        return still(self.model)

    def _refill(self) -> None:
        grammar = self.model.grammar
        self.light = light_piece()
        if grammar is None:
            return
        with self._telling():
            if self._tiles != grammar.encoding.tiles:
                self.tiles = tiles_piece(grammar, self._side)
                self._tiles = grammar.encoding.tiles
            self.scene = scene_piece(grammar)

    def keep(self, side: int) -> None:
        """Send, and save, no tile with a longer side."""
        self._side = side
        self._tiles = None
        self.wake()
        self._refill()

    def _empty(self) -> None:
        self._tiles = None
        self._stills = False
        self.scene = self.tiles = self.light = self.still = b""

    def _on_model(self, change: Any) -> None:
        with self.hold_sync():
            if change["name"] == "grammar" and not self._asleep:
                self._refill()
            for name, value in _same_all(self.model).items():
                setattr(self, name, value)
            if self._stills and change["name"] in _SEEN:
                self.draw_still()

    def _answer(self, message: Message) -> None:
        op = message.get("op")
        with self._telling(), self.hold_sync():
            if op in ("set", "undo", "redo"):
                with self._taking(message):
                    self._edit(op, message)
            elif op == "pick":
                self.model.pick(message["point"], message.get("ray"))
            elif op == "still":
                self._follow_with_stills()

    def _edit(self, op: str, message: Message) -> None:
        if op == "undo":
            self.model.undo()
        elif op == "redo":
            self.model.redo()
        elif message["name"] == "text":
            self.model.enter(str(message["value"]))
        elif message["name"] in _PLAIN:
            value = message["value"]
            self.model.adjust(message["name"], tuple(value) if isinstance(value, list) else value)
