"""The picture that a notebook carries of a live view that somebody waits for: it follows, when all is at rest.

The picture takes longer than all else in the cell. So the view is shown at once, after an output of the cell that has
words only, and that becomes the picture by its display id. The page hides that output while the view lives there.
"""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable
from html import escape
from secrets import token_hex
from typing import Any

__all__ = ["Following", "awaited"]

REST = 1.5
"""Seconds without a question of the page after which the picture is drawn: it holds the kernel up."""


def awaited() -> bool:
    """Whether somebody waits for the cell that runs: a front end that can be asked for input says so."""
    shell: Any = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    parent: Any = getattr(getattr(shell, "kernel", None), "get_parent", dict)()
    return bool((parent or {}).get("content", {}).get("allow_stdin"))


class Following:
    """Outputs that become a picture when nothing is asked for a while.

    Parameters
    ----------
    draw
        The picture, as HTML; empty where none can be drawn: the words stay.
    """

    def __init__(self, draw: Callable[[], str]) -> None:
        self._draw = draw
        self._outputs: list[tuple[str, str]] = []
        self._loop: asyncio.AbstractEventLoop | None = None
        self._timer: asyncio.TimerHandle | None = None

    def promise(self, told: str, name: str) -> bool:
        """Begin an output with words; whether there is a loop that brings the picture.

        Parameters
        ----------
        told
            What the picture will show.
        name
            Of the class by which the page finds the output.
        """
        try:
            self._loop = asyncio.get_running_loop()
        except RuntimeError:
            return False
        output = (token_hex(16), name)
        self._outputs.append(output)
        _publish(output, f"<p>{escape(told)}</p>")
        self.wait()
        return True

    def wait(self) -> None:
        """Something was asked, in whatever thread: the picture waits until all is at rest again."""
        if self._loop is not None and self._outputs:
            self._loop.call_soon_threadsafe(self._begin)

    def drop(self) -> None:
        """Bring no picture."""
        self._outputs = []

    def _begin(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._timer = asyncio.get_running_loop().call_later(REST, self._bring)

    def _bring(self) -> None:
        self._timer = None
        outputs, self._outputs = self._outputs, []
        if outputs and (picture := self._draw()):
            for output in outputs:
                _publish(output, picture, update=True)


def _publish(output: tuple[str, str], content: str, *, update: bool = False) -> None:
    """Make an output of the cell, or change it: its display id, and the class by which the page finds it."""
    from IPython.display import publish_display_data

    display_id, name = output
    data = {"text/html": f'<div class="{name}">{content}</div>'}
    publish_display_data(data, transient={"display_id": display_id}, update=update)
