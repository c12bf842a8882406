"""Clocks for the solver that do not depend on the machine: a test's outcome is the same however busy it is."""

from __future__ import annotations

import random
from itertools import count

from facade_nb.solver import budget as clock

__all__ = ["Counted", "Jumping", "install"]

LOOK = 5e-4
"""Seconds that pass from one look at the clock to the next; about what they take in compiled code."""


class Counted:
    """What the solver takes for the module `time`: each look is a little later than the one before, by as much."""

    def __init__(self, look: float = LOOK) -> None:
        self._looks, self._look = count(), look

    def monotonic(self) -> float:
        """How often it was asked, in seconds."""
        return next(self._looks) * self._look


class Jumping:
    """A clock that now and then jumps ahead, as on a machine that is busy with other things."""

    def __init__(self, seed: int) -> None:
        self._random, self._now = random.Random(seed), 0.0

    def monotonic(self) -> float:
        """A little later than before, or much."""
        self._now += self._random.choice([1e-6] * 20 + [1e-3, 0.05, 2.0])
        return self._now

    perf_counter = monotonic


def install(look: float = LOOK) -> None:
    """Let the time that a solve may take be counted, for the rest of this process."""
    clock.time = Counted(look)  # type: ignore[assignment]
