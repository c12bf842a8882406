"""Signals that come while compiled code runs: their handlers are called once it is over.

Python calls a handler wherever it comes to run Python again, and that is the callback by which compiled code asks
whether to go on. What a handler raises there (a KeyboardInterrupt, say) would leave the callback without a result, and
bring the process down.
"""

from __future__ import annotations

import _signal  # type: ignore[import-not-found]  # what `signal` wraps: that makes enumerations of every number, which takes ten times as long
import signal
import threading
from collections.abc import Callable
from types import FrameType, TracebackType

__all__ = ["Deferred"]

_NAMES = ("SIGALRM", "SIGTERM", "SIGUSR1", "SIGUSR2", "SIGHUP", "SIGBREAK", "SIGINT")
_SIGNALS = tuple(int(getattr(signal, name)) for name in _NAMES if hasattr(signal, name))

_Handler = Callable[[int, FrameType | None], object]


class Deferred:
    """A context in which the handlers of signals wait; to be used again and again, but not within itself.

    Attributes
    ----------
    came
        Signals that have come.
    """

    def __init__(self) -> None:
        self.came: list[int] = []
        self._held: list[tuple[int, _Handler]] = []

    def __enter__(self) -> None:
        if threading.get_ident() != threading.main_thread().ident:
            return  # handlers run in the main thread only
        for number in _SIGNALS:
            handler = _signal.getsignal(number)
            if callable(handler):
                _signal.signal(number, self._note)
                self._held.append((number, handler))

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if not self._held:
            return
        held, self._held = dict(self._held), []
        for number, handler in held.items():
            _signal.signal(number, handler)
        came, self.came = self.came, []
        for own in came:
            held[own](own, None)

    def _note(self, number: int, frame: FrameType | None) -> None:
        self.came.append(number)
