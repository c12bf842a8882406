"""What every wire to the browser does: carry the front end's code once, and put it away while nobody looks."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from typing import Any

from ipywidgets import Widget
from traitlets import Unicode

__all__ = ["Bundled", "Message", "bundle"]

Message = dict[str, Any]


@cache
def bundle(name: str) -> str:
    """The text of a file of the built front end."""
    return files(__package__).joinpath("static", name).read_text(encoding="utf-8")


class Bundled(Widget):
    """A widget without a view that parts refer to; it holds their module and style sheet, once for all of them.

    Every front end knows its class, so it needs no code of its own there. Each view says when it comes and goes; while
    there is none, the large traits are empty, so that running a cell again and again does not pile them up.
    """

    front = ""
    """Name of the bundle: ``studio`` for ``studio.js`` and ``studio.css``."""

    module = Unicode().tag(sync=True)
    css = Unicode().tag(sync=True)
    trouble = Unicode().tag(sync=True)

    def __init__(self, **traits: Any) -> None:
        self._asleep = False
        self._views: set[str] = set()
        super().__init__(module=bundle(f"{self.front}.js"), css=bundle(f"{self.front}.css"), **traits)
        self.on_msg(self._receive)

    def wake(self) -> None:
        """Have all that a view needs in the traits, if it is not there already."""
        self.module, self.css = bundle(f"{self.front}.js"), bundle(f"{self.front}.css")
        if self._asleep:
            self._asleep = False
            self._refill()

    def _sleep(self) -> None:
        """Drop what is large while nobody looks."""
        self._asleep = True
        with self.hold_sync():
            self.module = self.css = ""
            self._empty()

    def _refill(self) -> None:
        """Put the large traits back."""

    def _empty(self) -> None:
        """Empty the large traits; called with the sync held."""

    def _receive(self, _: Widget, message: Message, __: list[Any]) -> None:
        """Note that a view came or went; whatever else is asked, `_answer` it."""
        op = message.get("op")
        if op == "wake":
            self.wake()
        elif op == "view":
            if message["here"]:
                self._views.add(message["client"])
                self.wake()
            else:
                self._views.discard(message["client"])
                if not self._views:
                    self._sleep()
        else:
            self._answer(message)

    def _answer(self, message: Message) -> None:
        """Do what the front end asks for."""
