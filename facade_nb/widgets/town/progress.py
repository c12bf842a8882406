"""How far a town has come, shown under the cell that makes it."""

from __future__ import annotations

import time
from html import escape
from typing import Any

__all__ = ["TownProgress"]


class TownProgress:
    """A bar under the cell: ``Town.generate(20_000, progress=TownProgress())``. Outside notebooks it shows nothing.

    To stop, interrupt the kernel: the town is then not made.
    """

    def __init__(self) -> None:
        self._began = time.perf_counter()
        self._handle: Any = None

    def __call__(self, share: float, name: str) -> None:
        """Show the part that is done, from 0 to 1, and what comes next."""
        from IPython import get_ipython
        from IPython.display import HTML, display

        if getattr(get_ipython(), "kernel", None) is None:  # IPython in a terminal has none
            return
        shown = HTML(_html(share, name, time.perf_counter() - self._began))
        if self._handle is None:
            self._handle = display(shown, display_id=True)
        elif hasattr(self._handle, "update"):
            self._handle.update(shown)


def _html(share: float, name: str, seconds: float) -> str:
    if share >= 1:
        return f"<small>The town was made in {seconds:.1f} s.</small>"
    return (
        f'<label><progress max="1" value="{share:.3f}"></progress> '
        f"<small>{share:.0%}, {escape(name)} …</small></label>"
    )
