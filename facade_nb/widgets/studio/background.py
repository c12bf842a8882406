"""Solving beside the event loop: one thread, and the latest design wins."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from ...design import Design, NoLayout
from ...solver import Layout, solve

__all__ = ["LatestSolver", "Outcome", "Solve"]

Solve = Callable[..., Layout]
"""What solves: ``solve(design, time_limit=…, should_stop=…) -> Layout``."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of one solve.

    Attributes
    ----------
    revision
        The number it was submitted under; an outcome counts only while no higher one has been submitted.
    layout
        The layout, or None where there is none.
    error
        `NoLayout` and other `FacadeError`s say why there is none; any other exception is a fault of ours.
    seconds
        How long the solve took.
    """

    revision: int
    design: Design
    layout: Layout | None
    error: Exception | None
    seconds: float


class LatestSolver:
    """Solves in one worker thread; a newer submission stops the solve under way.

    The thread lives only while there is something to solve, so an idle solver holds no resources.

    Parameters
    ----------
    deliver
        Called in the worker thread with every `Outcome`, also with those superseded meanwhile.
    solve
        The function that solves, by default `facade_nb.solve`.
    """

    def __init__(self, deliver: Callable[[Outcome], None], solve: Solve = solve) -> None:
        self._deliver = deliver
        self._solve = solve
        self._condition = threading.Condition()
        self._next: tuple[int, Design, float | None, bool] | None = None
        self._latest = 0
        self._ended = 0
        self._thread: threading.Thread | None = None

    def submit(
        self, revision: int, design: Design, time_limit: float | None = None, traced: bool = False
    ) -> None:
        """Solve `design` next; whatever was waiting is forgotten, whatever is running is told to stop.

        Parameters
        ----------
        revision
            A number higher than that of any submission before.
        time_limit
            Seconds after which the best layout found so far is taken.
        traced
            Whether the solver is to tell what it does.
        """
        with self._condition:
            self._latest = revision
            self._next = (revision, design, time_limit, traced)
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="facade_nb-solver", daemon=True)
                self._thread.start()

    def cancel(self, revision: int) -> None:
        """Stop the solve under way and forget the one that waits; outcomes below `revision` no longer count."""
        with self._condition:
            self._latest = revision
            self._next = None

    def stop(self) -> None:
        """End the solve under way; the best layout that it has found so far is delivered, and counts."""
        with self._condition:
            self._ended = self._latest

    def join(self, timeout: float | None = None) -> bool:
        """Wait until nothing is being solved; returns whether that came within `timeout` seconds."""
        with self._condition:
            return self._condition.wait_for(lambda: self._thread is None, timeout)

    def _work(self) -> None:
        while True:
            with self._condition:
                if self._next is None:
                    self._thread = None
                    self._condition.notify_all()
                    return
                revision, design, time_limit, traced = self._next
                self._next = None
            self._deliver(self._run(revision, design, time_limit, {"trace": True} if traced else {}))

    def _run(
        self, revision: int, design: Design, time_limit: float | None, more: Mapping[str, bool]
    ) -> Outcome:
        began = time.perf_counter()
        layout: Layout | None = None
        error: Exception | None = None
        try:
            layout = self._solve(
                design,
                time_limit=time_limit,
                should_stop=lambda: self._latest != revision or self._ended >= revision,
                **more,
            )
        except NoLayout as none:
            error = none
        except Exception as unexpected:  # the edge of the thread: it must reach the user, not die here
            error = unexpected
        return Outcome(revision, design, layout, error, time.perf_counter() - began)
