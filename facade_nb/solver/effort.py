"""How much a search has done, in seconds of a usual machine: counted, not measured.

What a search tries next, what helps it, and when it gives up trying what would help, depends on how long something
has taken. If a clock told that, two runs of one design would differ, in their traces if not in their answers, and on a
busy machine more than elsewhere. So the places at which the time limit is looked at count what they stand for, and the
compiled search says how much it has done. Only the caller's own time limit is told by the clock (`budget`).
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf

from . import tuning

__all__ = ["Effort", "Stopped", "spend"]


class Stopped(Exception):
    """The time is up; or there is no more memory, `full`; or, `asked`, the caller wants no answer any more."""

    def __init__(self, asked: bool = False, full: bool = False) -> None:
        super().__init__()
        self.asked, self.full = asked, full


class Effort:
    """A check that counts: what is handed to searches as their `check`.

    Parameters
    ----------
    check
        What is asked whether to go on; where that is an `Effort` as well, it counts what is done here.
    within
        Another one that counts it, and is asked too.
    call
        Seconds that each call stands for.
    most
        After so many seconds it raises `Stopped`.

    Attributes
    ----------
    seconds
        Until now.
    """

    __slots__ = ("_above", "_ask", "_call", "most", "seconds")

    def __init__(
        self,
        check: Callable[[], None] | None = None,
        call: float = tuning.CALL,
        most: float = inf,
        within: Effort | None = None,
    ) -> None:
        self._above = check if isinstance(check, Effort) else within
        self._ask = None if isinstance(check, Effort) else check
        self._call, self.most, self.seconds = call, most, 0.0

    def __call__(self) -> None:
        """Count a call, and ask."""
        own: Effort | None = self  # loops, for this is called more often than anything else
        while own is not None:
            own.seconds += self._call
            own = own._above
        self.look()

    def add(self, seconds: float) -> None:
        """Count what was done without a call."""
        own: Effort | None = self
        while own is not None:
            own.seconds += seconds
            own = own._above

    def look(self) -> None:
        """Ask whether to go on, and count nothing."""
        own: Effort | None = self
        while own is not None:
            if own.seconds > own.most:
                raise Stopped
            if own._ask is not None:
                own._ask()
            own = own._above

    @property
    def left(self) -> float:
        """So much may still be done."""
        own = self.most - self.seconds
        return own if self._above is None else min(own, self._above.left)


def spend(check: Callable[[], None] | None, seconds: float) -> None:
    """Count what was done, if somebody counts."""
    if isinstance(check, Effort):
        check.add(seconds)
