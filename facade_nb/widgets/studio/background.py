"""Solving beside the event loop: one thread, and the latest design wins."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from ...design import Design, FacadeError, NoLayout
from ...solver import Layout, solve
from ..shared.collecting import hold, release

__all__ = ["FIRST", "Known", "LatestSolver", "Outcome", "Solve"]

Known = Callable[..., Layout | None]
"""What tells at once what is known of a design: ``known(design, should_stop=…) -> Layout | None``."""

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
    proving
        Whether the search goes on: the layout is the best of its first moment, and what comes of it is told next.
    """

    revision: int
    design: Design
    layout: Layout | None
    error: Exception | None
    seconds: float
    proving: bool = False


FIRST = 0.06
"""Seconds after which an edit is shown as the search has it by then, while it goes on."""

QUICK = 0.01
"""Seconds of the processor: where searches take no longer, they are waited for; nothing is shown before their end."""

_SHOWN = 0.25
"""Seconds for which the search lets the first layout be drawn, at most, before it goes on."""

_REST = 0.06
"""Seconds for which it rests then: sending what was drawn, and painting it, have the processor and the lock to
themselves, and what is typed on meanwhile finds nothing under way."""


class LatestSolver:
    """Solves in one worker thread; a newer submission stops the solve under way.

    The thread lives only while there is something to solve, so an idle solver holds no resources.

    A search that takes long is begun twice: what it has after its first moment is delivered, and then it goes on to its
    end. What is delivered last is the same as without: of the first moment the search knows a bound, and no more.
    Where something is known of the design without a search, that is delivered first, and the search is begun once.

    Parameters
    ----------
    deliver
        Called in the worker thread with every `Outcome`, also with those superseded meanwhile.
    solve
        The function that solves, by default `facade_nb.solve`.
    known
        What tells at once what is known of an edited design, such as `facade_nb.solver.resized.resized`; None: nothing.
    quick
        Seconds of the processor: where the last two searches took no longer, the next one is waited for instead.
    """

    def __init__(
        self,
        deliver: Callable[[Outcome], None],
        solve: Solve = solve,
        known: Known | None = None,
        quick: float = QUICK,
    ) -> None:
        self._deliver = deliver
        self._solve = solve
        self._known = known
        self._quick = quick
        self._took: deque[float] = deque((0.0,), maxlen=2)
        self._condition = threading.Condition()
        self._next: tuple[int, Design, float | None, bool, float | None] | None = None
        self._latest = 0
        self._ended = 0
        self._shown = 0
        self._hurried = 0
        self._told = 0
        self._thread: threading.Thread | None = None

    def submit(
        self,
        revision: int,
        design: Design,
        time_limit: float | None = None,
        traced: bool = False,
        first: float | None = None,
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
        first
            Seconds after which the best layout found so far is delivered, while the search goes on; None: never.
        """
        with self._condition:
            self._latest = revision
            self._next = (revision, design, time_limit, traced, first)
            if first is not None:  # until it has been shown
                hold(self)
            self._condition.notify_all()
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="facade_nb-solver", daemon=True)
                self._thread.start()

    def cancel(self, revision: int) -> None:
        """Stop the solve under way and forget the one that waits; outcomes below `revision` no longer count."""
        with self._condition:
            self._latest = revision
            self._next = None
            self._condition.notify_all()

    def stop(self) -> None:
        """End the solve under way; the best layout that it has found so far is delivered, and counts."""
        with self._condition:
            self._ended = self._latest
            self._condition.notify_all()

    def go_on(self, revision: int) -> None:
        """What was delivered of a search that goes on has been shown."""
        with self._condition:
            self._shown = revision
            self._condition.notify_all()

    def glimpse(self, timeout: float) -> bool:
        """Wait until something has been delivered of the newest submission; whether that came within `timeout`."""
        with self._condition:
            return self._condition.wait_for(
                lambda: self._thread is None or self._told == self._latest, timeout
            )

    def join(self, timeout: float | None = None) -> bool:
        """Wait until nothing is being solved; returns whether that came within `timeout` seconds."""
        with self._condition:
            if timeout is None or timeout > _SHOWN:  # who waits for the end looks at nothing before
                self._shown = self._hurried = self._latest
                self._condition.notify_all()
            return self._condition.wait_for(lambda: self._thread is None, timeout)

    def _work(self) -> None:
        try:
            self._serve()
        except BaseException:  # who is told has failed: a later submission begins anew
            with self._condition:
                release(self)
                self._thread = None
                self._condition.notify_all()
            raise

    def _serve(self) -> None:
        """Solve what is submitted until nothing waits."""
        while True:
            with self._condition:
                if self._next is None:
                    release(self)
                    self._thread = None
                    self._condition.notify_all()
                    return
                revision, design, time_limit, traced, first = self._next
                self._next = None
            more = {"trace": True} if traced else {}
            begun: Outcome | None = None
            if first is not None and not traced and (time_limit is None or time_limit > first):
                begun = self._at_once(revision, design) or self._run(revision, design, first, more)
                if not self._goes_on(begun, first):
                    self._tell(begun)
                    continue
                if begun.layout is not None:
                    self._tell(replace(begun, proving=True))
                    self._let_show(revision)
            release(self)  # a search may take long
            self._tell(_together(begun, self._run(revision, design, time_limit, more)))

    def _tell(self, outcome: Outcome) -> None:
        self._deliver(outcome)
        with self._condition:
            self._told = outcome.revision
            self._condition.notify_all()

    def _at_once(self, revision: int, design: Design) -> Outcome | None:
        """What is known of a design before it is searched, where the search will take long."""
        if self._known is None or max(self._took) <= self._quick:
            return None
        began = time.perf_counter()
        try:
            layout = self._known(design, should_stop=lambda: self._superseded(revision))
        except FacadeError:  # the search will say what is wrong
            return None
        except Exception as unexpected:  # as in `_run`
            return Outcome(revision, design, None, unexpected, time.perf_counter() - began)
        return (
            None if layout is None else Outcome(revision, design, layout, None, time.perf_counter() - began)
        )

    def _superseded(self, revision: int) -> bool:
        return self._latest != revision or self._ended >= revision

    def _goes_on(self, begun: Outcome, first: float) -> bool:
        """Whether a search was cut short by the end of its first moment, and is still wanted."""
        if self._superseded(begun.revision):
            return False
        if begun.layout is not None:
            return not begun.layout.complete
        # Within half the moment no part of the search has come to its end: there is no layout.
        return isinstance(begun.error, NoLayout) and begun.seconds > first / 2

    def _let_show(self, revision: int) -> None:
        with self._condition:
            self._condition.wait_for(lambda: self._shown >= revision or self._superseded(revision), _SHOWN)
            self._condition.wait_for(lambda: self._hurried >= revision or self._superseded(revision), _REST)

    def _run(
        self, revision: int, design: Design, time_limit: float | None, more: Mapping[str, bool]
    ) -> Outcome:
        began, worked = time.perf_counter(), time.thread_time()
        layout: Layout | None = None
        error: Exception | None = None
        try:
            layout = self._solve(
                design,
                time_limit=time_limit,
                should_stop=lambda: self._superseded(revision),
                **more,
            )
        except NoLayout as none:
            error = none
        except Exception as unexpected:  # the edge of the thread: it must reach the user, not die here
            error = unexpected
        if layout is not None and layout.complete:
            self._took.append(time.thread_time() - worked)
        return Outcome(revision, design, layout, error, time.perf_counter() - began)


def _together(begun: Outcome | None, ended: Outcome) -> Outcome:
    """What became of a search begun twice: what it had at first, where it was stopped before it had as good."""
    if begun is None:
        return ended
    seconds = begun.seconds + ended.seconds
    if begun.layout is not None and (
        isinstance(ended.error, NoLayout)
        or (
            ended.layout is not None
            and not ended.layout.complete
            and _cost(begun.layout) < _cost(ended.layout)
        )
    ):
        return replace(begun, seconds=seconds)
    return replace(ended, seconds=seconds)


def _cost(layout: Layout) -> float:
    return layout.x.cost + layout.y.cost
