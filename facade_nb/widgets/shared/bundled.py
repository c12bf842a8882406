"""What every wire to the browser does: carry the front end's code once, and put it away while nobody looks."""

from __future__ import annotations

import zlib
from base64 import b64encode
from functools import cache
from importlib.resources import files
from typing import Any, ClassVar, Self
from weakref import WeakKeyDictionary

from ipywidgets import Widget, widget_serialization
from traitlets import Instance, Unicode

__all__ = ["AS_RUN", "Bundled", "Code", "Message", "ModelWire", "as_run", "bundle", "packed"]

Message = dict[str, Any]


AS_RUN = "As this cell was run: what was changed later is not shown here."
"""What stands under a static picture: it is saved when its cell is run, and the view goes on without it."""


def as_run(static: str) -> str:
    """A static form that may become older than its model, marked as such."""
    return f"<figure>{static}<figcaption><small>{AS_RUN}</small></figcaption></figure>" if static else ""


@cache
def bundle(name: str) -> str:
    """The text of a file of the built front end."""
    return files("facade_nb.widgets").joinpath("static", name).read_text(encoding="utf-8")


def _is_open(widget: Widget | None) -> bool:
    """Whether a widget can still speak to the browser: marimo closes those of a cell that is run again."""
    return widget is not None and widget.comm is not None and not getattr(widget.comm, "_closed", False)


@cache
def packed(name: str) -> str:
    """A file of the front end as it travels, and as a notebook saves it: deflated, a third of its text."""
    return b64encode(zlib.compress(bundle(name).encode(), 9)).decode("ascii")


class Code(Widget):
    """The module and the style sheet of a bundle: one widget for all channels of a kernel. Get it by `Code.of`.

    They are `packed`; the loader has the texts of them. It is empty while none of them is looked at, so that running a
    cell again and again does not pile bundles up.
    """

    module = Unicode().tag(sync=True)
    css = Unicode().tag(sync=True)

    def __init__(self, front: str) -> None:
        self._front = front
        self._holders: set[int] = set()
        super().__init__()

    @classmethod
    def of(cls, front: str) -> Code:
        """The code of a bundle, made when first asked for, or anew if it was closed."""
        code = _codes.get(front)
        if code is None or not _is_open(code):
            code = _codes[front] = cls(front)
        return code

    def hold(self, holder: object) -> None:
        """Have the code in the traits, for this channel too."""
        self._holders.add(id(holder))
        if not self.module:
            with self.hold_sync():
                self.css = packed(f"{self._front}.css")
                self.module = packed(f"{self._front}.js")

    def release(self, holder: object) -> None:
        """Let go of it; when nobody holds it any more it is put away."""
        self._holders.discard(id(holder))
        if not self._holders:
            with self.hold_sync():
                self.module = self.css = ""


_codes: dict[str, Code] = {}


class Bundled(Widget):
    """A widget without a view that parts refer to, and that refers to their code.

    Every front end knows its class, so it needs no code of its own there. Each view says when it comes and goes; while
    there is none, the large traits are empty.
    """

    front = ""
    """Name of the bundle: ``studio`` for ``studio.js`` and ``studio.css``."""

    front_end = Instance(Widget).tag(sync=True, **widget_serialization)
    trouble = Unicode().tag(sync=True)

    def __init__(self, **traits: Any) -> None:
        self._asleep = False
        self._views: set[str] = set()
        self._heard: dict[str, int] = {}
        code = Code.of(self.front)
        code.hold(self)
        super().__init__(front_end=code, **traits)
        self.on_msg(self._receive)

    def wake(self) -> None:
        """Have all that a view needs in the traits, if it is not there already."""
        self.front_end.hold(self)
        if self._asleep:
            self._asleep = False
            self._refill()

    def _sleep(self) -> None:
        """Drop what is large while nobody looks."""
        self._asleep = True
        self.front_end.release(self)
        with self.hold_sync():
            self._empty()

    def close(self) -> None:
        """Close the wire; it may be closed already."""
        if self.comm is not None:
            self.front_end.release(self)
        super().close()

    def _refill(self) -> None:
        """Put the large traits back."""

    def _empty(self) -> None:
        """Empty the large traits; called with the sync held."""

    def _receive(self, _: Widget, message: Message, __: list[Any]) -> None:
        """Note that a view came or went; whatever else is asked, `_answer` it."""
        op, client = message.get("op"), message.get("client", "")
        if "seq" in message:
            self._heard[client] = message["seq"]
        if op == "wake":
            self.wake()
        elif op == "ping":
            if message.get("renew"):
                self._renew()
        elif op == "view":
            if message["here"]:
                self._views.add(client)
                self.wake()
            else:
                self._views.discard(client)
                self._heard.pop(client, None)
                if not self._views:
                    self._sleep()
        else:
            self._answer(message)

    def _renew(self) -> None:
        """After a gap in the connection: tell everything again, and which messages of the front end's have come."""
        self.send_state()
        self.send({"kind": "pong", "heard": self._heard})

    def _answer(self, message: Message) -> None:
        """Do what the front end asks for."""


class ModelWire(Bundled):
    """The wire between one model and the browser. Get it by `of`: there is one for each model."""

    _wires: ClassVar[WeakKeyDictionary[Any, Any]]

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        cls._wires = WeakKeyDictionary()

    @classmethod
    def of(cls, model: Any) -> Self:
        """The wire of a model, made when first asked for, or anew if it was closed."""
        wire: Self | None = cls._wires.get(model)
        if wire is None or not _is_open(wire):
            if wire is not None:
                wire.close()
            wire = cls._wires[model] = cls(model)
        return wire

    def __init__(self, model: Any, **traits: Any) -> None:
        self.model = model
        super().__init__(**traits)

    def _receive(self, _: Widget, message: Message, buffers: list[Any]) -> None:
        with self.model.by_hand(message.get("after")):
            super()._receive(_, message, buffers)
