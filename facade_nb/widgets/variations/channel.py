"""The wire between variants and the browser: rows as they are solved, pictures as they come into sight."""

from __future__ import annotations

import asyncio
import json
import zlib
from collections.abc import Iterable
from typing import Any

from traitlets import Bytes, Dict, List, Unicode

from ...design import Design
from ...variations.sheet import picture_at
from ..shared.bundled import Message
from ..shared.pictured import EditedWire
from .model import VariationsModel

__all__ = ["VariationsChannel", "shown"]

_ACROSS, _UP = 132.0, 96.0
"""Pixels that the widest and the highest of the pictures take."""
_KEPT = 150_000
"""Bytes of pictures that are kept in the widget, for pages without a kernel."""
_PAUSE = 0.1
"""Seconds between two tellings of how far it has come, and more where there are many rows."""
_EACH = 0.0005


class VariationsChannel(EditedWire):
    """One line to the browser for a `VariationsModel`. Get it by `VariationsChannel.of`."""

    front = "variations"

    name = Unicode().tag(sync=True)
    columns = List(Unicode()).tag(sync=True)
    rows = List(Dict()).tag(sync=True)
    state = Dict().tag(sync=True)
    pictures = Bytes(help="Deflated JSON: theme, and the drawing of each row.").tag(sync=True)

    def __init__(self, model: VariationsModel) -> None:
        self._theme = "light"
        self._svgs: dict[tuple[int, str], str] = {}
        self._later: asyncio.TimerHandle | None = None
        super().__init__(model, columns=list(model.variants.columns), name=_name(model))
        self.publish()
        model.observe(self._on_model, "version")

    def close(self) -> None:
        """Close the wire, and stop what is being solved."""
        self._forget_timer()
        self.model.stop()
        super().close()

    def publish(self) -> None:
        """Tell what there is now."""
        self._forget_timer()
        with self._telling(), self.hold_sync():
            self.rows = [shown(self.model, k) for k in range(len(self.model.variants))]
            self.state = {"running": self.model.running, "opened": self.model.opened}
            self.trouble = self.model.trouble
            if not self.model.running and not self._asleep:
                self._keep()

    def _refill(self) -> None:
        self.publish()

    def _empty(self) -> None:
        self._svgs.clear()
        self.pictures = b""

    def _on_model(self, _: Any) -> None:
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:
            self.publish()
            return
        if not self.model.running:
            self.publish()
        elif self._later is None:
            pause = max(_PAUSE, _EACH * len(self.model.variants))
            self._later = loop.call_later(pause, self.publish)

    def _forget_timer(self) -> None:
        if self._later is not None:
            self._later.cancel()
            self._later = None

    def _keep(self) -> None:
        """Have as many pictures in the widget as there is room for, the first ones first."""
        kept: dict[int, str] = {}
        packed, size = b"", 0
        for k in sorted(self.model.answers):
            kept[k] = self._picture(k, self._theme)
            size += len(kept[k])
            if size > 20 * _KEPT:  # they deflate to about a tenth
                break
            more = _packed(self._theme, kept)
            if len(more) > _KEPT:
                break
            packed = more
        self.pictures = packed

    def _picture(self, row: int, theme: str) -> str:
        if (row, theme) not in self._svgs:
            answer = self.model.answers.get(row)
            if answer is None:
                return ""
            drawn, *_ = picture_at(answer.layout, self._scale(), theme, "v")  # each is a document of its own
            self._svgs[row, theme] = drawn
        return self._svgs[row, theme]

    def _scale(self) -> float:
        """Pixels a metre, the same for all, so that sizes can be compared."""
        canvases = [own.canvas for own in self.model.variants.designs if isinstance(own, Design)]
        widest = max((canvas.width for canvas in canvases), default=1.0)
        highest = max((canvas.height for canvas in canvases), default=1.0)
        return min(_ACROSS / widest, _UP / highest)

    def _answer(self, message: Message) -> None:
        op = message.get("op")
        with self._telling():
            if op == "pictures":
                self._send_pictures(message["rows"], str(message["theme"]), message["client"])
                return
            self.trouble = ""
            if op == "open":
                self.model.open(int(message["row"]))
            elif op == "run":
                self.model.run()
            elif op == "stop":
                self.model.stop()
            elif op in ("undo", "redo"):
                getattr(self.model.facade, op)()

    def _send_pictures(self, rows: Iterable[int], theme: str, client: str) -> None:
        self._theme = "dark" if theme == "dark" else "light"
        drawn = {row: self._picture(row, self._theme) for row in rows}
        self.send({"kind": "pictures", "client": client}, buffers=[_packed(self._theme, drawn)])


def _packed(theme: str, drawn: dict[int, str]) -> bytes:
    return zlib.compress(json.dumps({"theme": theme, "drawn": drawn}).encode(), 6)


def _name(model: VariationsModel) -> str:
    return next((own.name for own in model.variants.designs if isinstance(own, Design)), "")


def shown(model: VariationsModel, row: int) -> dict[str, Any]:
    """A row as the browser shows it."""
    answer = model.answers.get(row)
    found: dict[str, Any] = {
        "values": list(model.variants.values[row]),
        "opens": isinstance(model.variants.designs[row], Design),
        "state": "waiting" if answer is None else "done" if answer.layout else "error",
    }
    if answer is None:
        return found
    found |= {"error": answer.error, "seconds": round(answer.seconds, 4)}
    if answer.layout is not None:
        layout = answer.layout
        found |= {
            "windows": sum(shape.kind == "window" for shape in layout.shapes),
            "shapes": len(layout.shapes),
            "cost": [layout.x.cost, layout.y.cost],
            "proven": layout.x.proven and layout.y.proven,
        }
    return found
