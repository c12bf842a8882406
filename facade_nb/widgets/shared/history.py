"""Undo and redo: snapshots of what is edited, with a run of keystrokes in one field kept as one step."""

from __future__ import annotations

import time
from collections.abc import Hashable, Sequence
from typing import Generic, TypeVar

from .turns import Turns, by_turns

__all__ = ["History", "Undoable"]

T = TypeVar("T")


class History(Generic[T]):
    """A line of states with a present one.

    Parameters
    ----------
    present
        The state to begin with.
    limit
        How many states are kept to go back to.
    pause
        Seconds after which the next keystroke in the same field begins a step of its own.
    """

    def __init__(self, present: T, *, limit: int = 200, pause: float = 1.0) -> None:
        self._past: list[T] = []
        self._future: list[T] = []
        self._present = present
        self._limit = limit
        self._pause = pause
        self._key: Hashable | None = None
        self._when = 0.0

    @property
    def present(self) -> T:
        """The state that holds now."""
        return self._present

    @property
    def can_undo(self) -> bool:
        """Whether there is a state to go back to."""
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        """Whether there is an undone state to go forward to."""
        return bool(self._future)

    @property
    def past(self) -> tuple[T, ...]:
        """The states to go back to, oldest first."""
        return tuple(self._past)

    @property
    def future(self) -> tuple[T, ...]:
        """The undone states to go forward to, the next one last."""
        return tuple(self._future)

    def resume(self, past: Sequence[T], present: T, future: Sequence[T]) -> None:
        """Go on from a line of states that was kept."""
        self._past, self._present, self._future = list(past)[-self._limit :], present, list(future)
        self._key = None

    def record(self, state: T, *, key: Hashable | None, now: float, after: float | None = None) -> None:
        """Make `state` the present one.

        Parameters
        ----------
        key
            What was edited. Records with one key, none of them later than `pause` after the one before, are one step;
            with None a record is always a step of its own.
        now
            Time of the record in seconds, by a clock that only goes forward.
        after
            Seconds from the edit before to this one, where it is known better than from the times of the records:
            what was typed in one go may arrive late, and piece by piece.
        """
        if state == self._present:
            return
        paused = now - self._when if after is None else after
        goes_on = key is not None and key == self._key and paused <= self._pause
        if not goes_on:
            self._past.append(self._present)
            del self._past[: -self._limit]
        self._future.clear()
        self._present, self._key, self._when = state, key, now

    def undo(self) -> T:
        """Go one step back; the state that holds then. Raises IndexError where there is none."""
        state = self._past.pop()
        self._future.append(self._present)
        self._present, self._key = state, None
        return state

    def redo(self) -> T:
        """Go one step forward again; the state that holds then. Raises IndexError where there is none."""
        state = self._future.pop()
        self._past.append(self._present)
        self._present, self._key = state, None
        return state


class Undoable(Turns, Generic[T]):
    """What a model has that keeps its states in `_history` and can `_restore` one."""

    _history: History[T]

    def _restore(self, state: T) -> None:
        """Make a state of the history the model's."""
        raise NotImplementedError

    def _note(self, state: T, key: Hashable | None) -> None:
        """Make a state the present one of the history. See `History.record` for the key."""
        self._history.record(state, key=key, now=time.monotonic(), after=self.after)

    @by_turns
    def undo(self) -> None:
        """Go back one step; does nothing where there is none."""
        if self._history.can_undo:
            self._restore(self._history.undo())

    @by_turns
    def redo(self) -> None:
        """Go forward again one step; does nothing where there is none."""
        if self._history.can_redo:
            self._restore(self._history.redo())

    @property
    def can_undo(self) -> bool:
        """Whether there is a step to undo."""
        return self._history.can_undo

    @property
    def can_redo(self) -> bool:
        """Whether there is an undone step to redo."""
        return self._history.can_redo
