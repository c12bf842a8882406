"""The garbage collector kept back for a moment: a pass over all objects of a kernel takes 0.1 s, and can wait.

What refers to itself is all that it is needed for, so that memory grows by little in a moment.
"""

from __future__ import annotations

import gc
from threading import Lock

__all__ = ["hold", "release"]

_lock = Lock()
_holders: set[int] = set()


def hold(holder: object) -> None:
    """Begin no pass until this holder lets it go; one that has been switched off already is left alone."""
    with _lock:
        if gc.isenabled() or _holders:
            _holders.add(id(holder))
            gc.disable()


def release(holder: object) -> None:
    """Let it go; when nobody holds it any more it goes on by itself."""
    with _lock:
        if id(holder) in _holders:
            _holders.discard(id(holder))
            if not _holders:
                gc.enable()
