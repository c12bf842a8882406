"""Views whose notebooks carry a static form, and the wires that answer what is entered in them."""

from __future__ import annotations

import traceback
from base64 import b64encode
from collections.abc import Iterator
from contextlib import contextmanager
from html import escape
from typing import Any, ClassVar

from anywidget import AnyWidget
from ipywidgets import Widget, widget_serialization
from traitlets import Bytes, Dict, Instance, TraitError, Unicode

from ...design.errors import DesignError
from .bundled import Message, ModelWire, as_run, bundle

__all__ = ["EditedWire", "PartView", "check_side", "picture_html"]


PNG = b"\x89PNG"
"""How such a file begins."""


class PartView(AnyWidget):
    """A widget of one kilobyte: it names the channel and the part to show."""

    _esm = bundle("loader.js")
    _shows: ClassVar[str] = ""

    channel = Instance(Widget).tag(sync=True, **widget_serialization)
    part = Unicode().tag(sync=True)

    def to_html(self) -> str:
        """The static form, for pages where no widget can run; empty where there is none."""
        return ""

    def _repr_mimebundle_(self, **options: Any) -> tuple[dict[str, Any], dict[str, Any]] | None:
        """The live view and, for pages where none can run, the static form, marked as of the cell's run."""
        self.channel.wake()
        made = super()._repr_mimebundle_(**options)
        if made is not None:
            static = self._carried()
            if static:
                made[0]["text/html"] = as_run(static)
        return made

    def _carried(self) -> str:
        """The static form that goes out with the view; empty where there is none, or where it comes later."""
        return self.to_html()


class EditedWire(ModelWire):
    """A wire to views in which things are entered: each is answered, and faults are told in a sentence."""

    ack = Dict(help="Client and number of the last value that was taken.").tag(sync=True)
    still = Bytes(help="A picture, for a page that cannot draw.").tag(sync=True)

    def __init__(self, model: Any, **traits: Any) -> None:
        self._stills = False  # whether a page needs the still picture to follow
        super().__init__(model, **traits)

    def close(self) -> None:
        """Close the wire; the model lives on."""
        if self.comm is not None:
            self.model.unobserve(self._on_model)
        super().close()

    def draw_still(self) -> bytes:
        """The still picture, drawn now: see `still`."""
        self.still = self._drawn()
        return bytes(self.still)

    def _drawn(self) -> bytes:
        raise NotImplementedError

    def _on_model(self, change: Any) -> None:
        raise NotImplementedError

    @contextmanager
    def _telling(self) -> Iterator[None]:
        """Tell what goes wrong in the block where it is seen: at the edge to the browser it would be lost in a log."""
        try:
            yield
        except (TraitError, DesignError, ValueError, IndexError) as error:
            self.trouble = str(error)
        except Exception:
            self.trouble = traceback.format_exc()

    @contextmanager
    def _taking(self, message: Message) -> Iterator[None]:
        """Answer what is entered, what is refused too: the page then shows what the model has."""
        self.trouble = ""
        try:
            yield
        finally:
            self.ack = {"client": message["client"], "seq": message["seq"]}

    def _follow_with_stills(self) -> None:
        """A page cannot draw: it gets the picture now, and after each change."""
        self._stills = True
        self.draw_still()


def check_side(side: int) -> int:
    """A number of pixels.

    Raises
    ------
    ValueError
        If it is none.
    """
    if isinstance(side, bool) or not isinstance(side, int) or side < 1:
        raise ValueError(f"side: expected a whole number of pixels from 1; found {side!r}")
    return side


def picture_html(told: str, data: bytes) -> str:
    """A picture as HTML, with what it shows in words; empty if there is none."""
    if not data:
        return ""
    kind = "png" if data.startswith(PNG) else "jpeg"
    source = b64encode(data).decode("ascii")
    return f'<img alt="{escape(told)}" src="data:image/{kind};base64,{source}">'
