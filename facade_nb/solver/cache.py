"""Answers that are kept for the next time they are asked for."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Hashable
from threading import Lock
from typing import Generic, TypeVar

__all__ = ["Kept"]

_Value = TypeVar("_Value")


class Kept(Generic[_Value]):
    """The answers that were asked for last, up to a total weight. Threads may share it.

    What can be large is weighed by the bytes that it takes, about.

    Attributes
    ----------
    hits, misses
        How often an answer was there, and how often not, since the last `clear`.
    """

    def __init__(self, most: float) -> None:
        self._most = most
        self._weight = 0.0
        self._lock = Lock()
        self._known: OrderedDict[Hashable, tuple[_Value, float]] = OrderedDict()
        self.hits = self.misses = 0

    def __len__(self) -> int:
        return len(self._known)

    def get(self, key: Hashable) -> _Value | None:
        """The answer kept under a key, or None."""
        with self._lock:
            found = self._known.get(key)
            if found is None:
                self.misses += 1
                return None
            self.hits += 1
            self._known.move_to_end(key)
            return found[0]

    def put(self, key: Hashable, value: _Value, weight: float = 1.0) -> None:
        """Keep an answer; what was not asked for the longest time goes. What weighs more than all may is not kept."""
        if weight > self._most:
            return
        with self._lock:
            before = self._known.pop(key, None)
            self._weight += weight - (before[1] if before else 0.0)
            self._known[key] = (value, weight)
            while self._weight > self._most:
                _, (_, gone) = self._known.popitem(last=False)
                self._weight -= gone

    def clear(self) -> None:
        """Let go of all."""
        with self._lock:
            self._known.clear()
            self._weight = 0.0
            self.hits = self.misses = 0
