"""One at a time: a cell edits a model in one thread, while the front end's messages may come in another.

JupyterLab answers the messages of widgets in a thread of their own while a cell runs. A change that is made from what
there was before must not overlap with another one: one of them would be lost.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from threading import RLock
from typing import Any, Concatenate, ParamSpec, TypeVar

__all__ = ["Turns", "by_turns"]

Own = TypeVar("Own", bound="Turns")
P = ParamSpec("P")
R = TypeVar("R")


class Turns:
    """What has a `turn`: who holds it is alone with it."""

    turn: Any
    after: float | None
    """In a turn `by_hand`: seconds since the same hand entered something before, where that is known."""

    def __new__(cls, *_: Any, **__: Any) -> Any:
        """Make one with its turn: before anything of it can be asked for."""
        own = super().__new__(cls)
        own.turn = RLock()
        own.after = None
        return own

    @contextmanager
    def by_hand(self, after: object) -> Iterator[None]:
        """A turn in which something is done by hand.

        Parameters
        ----------
        after
            Seconds since the same hand entered something before, by its own clock. What is no number is left out.
        """
        with self.turn:
            self.after = float(after) if isinstance(after, (int, float)) else None
            try:
                yield
            finally:
                self.after = None


def by_turns(method: Callable[Concatenate[Own, P], R]) -> Callable[Concatenate[Own, P], R]:
    """A method that waits for its turn."""

    @wraps(method)
    def own(self: Own, *arguments: P.args, **named: P.kwargs) -> R:
        with self.turn:
            return method(self, *arguments, **named)

    return own
