"""How a command ends: its exit status and its last words, whatever it is that ends it.

Signals that ask a process to end (SIGINT, SIGTERM, SIGHUP) let it clear up; its status is then 128 and the signal's
number, as shells have it. A signal that was to be ignored, as `nohup` asks, stays ignored.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

from .design.errors import DesignError, NoLayout
from .design.files import NotWritten, remove_scratch

__all__ = ["ended", "say"]

_SIGNALS = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, name)
)
_CLOSED_PIPE = 128 + 13  # as of a process that SIGPIPE ends


class _Signalled(BaseException):
    """A signal that asks the process to end."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


def ended(command: Callable[[], int]) -> int:
    """Run a command; returns its exit status."""
    try:
        with _heeding_signals():
            try:
                return command()
            finally:
                remove_scratch()
    except NotWritten as error:
        say(error)
        return _CLOSED_PIPE if error.closed else 1
    except DesignError as error:
        say(error)
        return 2
    except NoLayout as error:
        say(f"No layout: {error}")
        return 3
    except KeyboardInterrupt:  # where another has a hand in it: not the main thread, a notebook
        say("Stopped.")
        return 128 + signal.SIGINT
    except _Signalled as error:
        say("Stopped.")
        return 128 + error.number


def say(text: object) -> None:
    """Print a message to stderr, if that is possible."""
    if sys.stderr is None:
        return
    try:
        print(text, file=sys.stderr, flush=True)
    except (OSError, ValueError):  # drop what it holds, or Python would try again at its end, and fail
        with suppress(OSError, ValueError):
            null = os.open(os.devnull, os.O_WRONLY)
            os.dup2(null, sys.stderr.fileno())
            os.close(null)


@contextmanager
def _heeding_signals() -> Iterator[None]:
    """Raise `_Signalled` for the first signal that asks to end; those after it do not disturb the clearing up."""
    before: dict[int, Any] = {}

    def heed(number: int, frame: FrameType | None) -> None:
        for other in before:
            signal.signal(other, signal.SIG_IGN)
        raise _Signalled(number)

    try:
        if threading.current_thread() is threading.main_thread():
            for number in _SIGNALS:
                handler = signal.getsignal(number)
                if handler in (signal.SIG_DFL, signal.default_int_handler):
                    before[number] = handler
                    signal.signal(number, heed)
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
