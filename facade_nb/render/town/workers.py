"""Work that goes on beside other work: on two processors a town is made in little more than half the time.

Shapely, SciPy and NumPy let other threads run while they compute. Each piece of work has its own data, so results are
the same with one thread, and with many.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import ParamSpec, Self, TypeVar

__all__ = ["THREADS", "Workers"]

THREADS = sys.platform != "emscripten"
"""Whether there are threads."""

_MOST = 4
"""Pieces of work that are under way at once."""

T = TypeVar("T")
P = ParamSpec("P")


class Workers:
    """Threads for pieces of work. Where there are none, each piece is done when its result is wanted.

    >>> with Workers() as workers:
    ...     total = workers.begin(sum, [1, 2, 3])
    ...     total()
    6
    """

    def __init__(self) -> None:
        self._pool = ThreadPoolExecutor(_MOST) if THREADS else None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        # Who stops a town does not wait for what is under way: it ends by itself, and nobody sees it.
        if self._pool is not None:
            self._pool.shutdown(wait=False, cancel_futures=True)

    def begin(self, work: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Callable[[], T]:
        """Begin a piece of work. What is returned waits for its result, or raises what the work has raised."""
        if self._pool is None:
            return cache(lambda: work(*args, **kwargs))
        return self._pool.submit(work, *args, **kwargs).result
