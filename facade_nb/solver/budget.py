"""The time that a call of `solve` may take, whether it is still wanted, and how far it has come."""

from __future__ import annotations

import ctypes
import gc
import os
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Literal

from . import tuning
from .effort import Effort, Stopped

__all__ = ["Clock", "Progress", "Stage", "Stopped"]

Stage = Literal["words", "analysis", "candidates", "alignment", "attempt", "explanation", "merging"]


_STATM = Path("/proc/self/statm")
_PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096

_DOING: dict[Stage, str] = {
    "words": "listing the words of",
    "analysis": "analysing patterns",
    "candidates": "putting words together",
    "alignment": "aligning",
    "attempt": "looking for any alignment",
    "explanation": "finding out why there is none",
    "merging": "merging both axes into shapes",
}


@dataclass(slots=True)
class Progress:
    """Where a call of `solve` stands: what it was at when it was stopped.

    Attributes
    ----------
    stage, axis
        Empty before the first stage, and where both axes take part.
    pattern, group
        Whose words are listed; what is aligned.
    candidate, of
        Number of the candidate that is aligned, from 1; how many have been made until then.
    """

    stage: Stage | Literal[""] = ""
    axis: str = ""
    pattern: str = ""
    group: str = ""
    candidate: int = 0
    of: int = 0

    def at(
        self, stage: Stage, axis: str, *, pattern: str = "", group: str = "", candidate: int = 0, of: int = 0
    ) -> None:
        """Note a new stage."""
        self.stage, self.axis, self.pattern, self.group = stage, axis, pattern, group
        self.candidate, self.of = candidate, of

    def __str__(self) -> str:
        """``while aligning candidate 12 of at least 40 on x, group 'g'``; empty before the first stage."""
        if not self.stage:
            return ""
        text = f"while {_DOING[self.stage]}"
        if self.candidate:
            text += f" candidate {self.candidate}"
            text += f" of at least {self.of}" if self.of > self.candidate else ""
        if self.pattern:
            text += f" pattern {self.pattern!r}"
        if self.axis:
            text += f" on {self.axis}"
        return text + (f", group {self.group!r}" if self.group else "")


class Clock:
    """The time that a search may take, and whether it is still wanted. The axes share it.

    Parameters
    ----------
    limit
        Seconds, or None.
    should_stop
        Asked at every check.
    parent
        Another clock that has to let it go on as well.
    most
        How much effort it may take (seconds, see `effort`), which does not depend on the time.

    Attributes
    ----------
    check
        Raises `Stopped` where the search has to end, and counts.
    progress
        How far the call has come.
    asked, over, full
        Whether it was asked to stop; whether at some check the time was over, or the process had grown by more than
        `tuning.MEMORY`.
    """

    def __init__(
        self,
        limit: float | None,
        should_stop: Callable[[], bool] | None = None,
        parent: Clock | None = None,
        most: float = inf,
    ) -> None:
        self._begin, self.limit, self._should_stop = time.monotonic(), limit, should_stop
        self._most = most
        self._within: Effort | None = None if parent is None else parent.check
        self.check: Effort = Effort(self._asked, within=self._within)
        self.progress = Progress()
        self.asked = self.over = self.full = False
        self._start, self._look = (_resident(), self._begin) if parent is None else (0, inf)
        self._size = self._start - min(_left.bytes, max(0, tuning.MEMORY // 2))
        self.allot(1.0)

    @property
    def seconds(self) -> float:
        """Since the call began."""
        return time.monotonic() - self._begin

    def allot(self, part: float) -> None:
        """From now on the search may go on until this part of the time has passed, less what a last attempt needs."""
        self._part = part
        self._until(0.85 * part)

    def extend(self) -> None:
        """Let the last attempt begin that follows a search without an answer: it has the rest of the part.

        And a little memory of its own, for that of the search may not be given back yet.
        """
        self._until(self._part)
        self._size = max(self._size, _resident() - tuning.MEMORY + tuning.MEMORY // 4)

    def _until(self, end: float) -> None:
        self._end, self.check.most = end, end * self._most

    def last_attempt(self) -> Callable[[], None]:
        """A check for what takes milliseconds, when the time is up and there is nothing yet: it has its own moment."""
        end = max(self.seconds, self._part * (self.limit or 0.0)) + tuning.LAST_ATTEMPT

        def check() -> None:
            if self._should_stop is not None and self._should_stop():
                self.asked = True
                raise Stopped(asked=True)
            if self.limit is not None and self.seconds > end:
                self.over = True
                raise Stopped

        return Effort(check, most=tuning.LAST_ATTEMPT, within=self._within) if self._most < inf else check

    def _asked(self) -> None:
        """Raise `Stopped` where the time is over, or the memory, or nobody wants an answer."""
        if self._should_stop is not None and self._should_stop():
            self.asked = True
            raise Stopped(asked=True)
        now = time.monotonic()
        if self.limit is not None and now - self._begin > self._end * self.limit:
            self.over = True
            raise Stopped
        if now > self._look:
            self._look = now + tuning.MEMORY_LOOK
            if _resident() - self._size > tuning.MEMORY:
                self.full = True
                raise Stopped(full=True)

    def close(self) -> None:
        """The call is over: what is still read of its words and networks, for a trace, may take as long as it likes."""
        if self._start:
            _left.note(self._start)
        self.limit, self._should_stop, self._look, self._most = None, None, inf, inf
        self.check.most = inf
        self._start = 0

    def closing(self) -> Callable[[], None]:
        """A check for what is done once the search is over: it has a moment more, whatever ended the search."""
        spent = self.asked or self.limit is None or self.seconds > self.limit
        end = (
            inf
            if self.limit is None and not self.asked
            else (self.seconds if spent else self.limit or 0.0) + tuning.MERGING_MOMENT
        )

        def check() -> None:
            if not self.asked and self._should_stop is not None and self._should_stop():
                self.asked = True
                raise Stopped(asked=True)
            if self.seconds > end:
                self.over = not self.asked
                raise Stopped

        return check


class _Left:
    """How much more memory the process has than it would have without the calls until now, about.

    Without it each call would count from where the last one has left off, and a hundred of them could take anything.
    """

    def __init__(self) -> None:
        self.bytes = 0

    def note(self, start: int) -> None:
        """A call is over that began at some size of the process."""
        left = self.bytes + _resident() - start
        if left > tuning.MEMORY // 4:
            _give_back()
            left = self.bytes + _resident() - start
        self.bytes = max(0, left)


_left = _Left()


def _give_back() -> None:
    """Have the system get back what is free."""
    gc.collect()
    with suppress(AttributeError, OSError, TypeError):  # only the C library of Linux has it
        ctypes.CDLL(None).malloc_trim(0)


def _resident() -> int:
    """Bytes of memory that the process has, or has had at most where only that can be told; 0 where nothing can."""
    try:
        return int(_STATM.read_bytes().split()[1]) * _PAGE
    except OSError:
        pass
    try:
        import resource
    except ImportError:  # Windows
        return 0
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most if sys.platform == "darwin" else most * 1024
