"""All that the solver keeps between calls: one cache, with one `clear`.

What is kept never changes an answer; it only comes sooner. Each store has a limit of its own, and what was not asked
for the longest time goes first. Threads may share it.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Hashable
from threading import Lock
from typing import Any, Generic, TypeVar

__all__ = ["CACHE", "Cache", "Kept"]

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


class Cache:
    """What is kept, by what it is.

    The stores that can be large are weighed by bytes, 104 MB in all: a hub gives its users 1 to 2 GB.

    Attributes
    ----------
    answers
        Answers of an axis, or of both where a counter ties them, by all that they depend on (`solution`).
    earlier
        What was found last, with its problem, for problems that differ in sizes, bounds and canvas only, and for those
        with the same rows in their groups (`solution`).
    groups
        The best structures of a group and its bound, so that groups that an edit leaves alone are not searched again
        (`selection.axis`).
    words
        The words of a pattern, and how much is opaque in one of them at most (`words.enumeration`).
    ranges
        What patterns say of counters (`words.enumeration`); an entry is a few numbers.
    lengths
        How long words of a pattern are, by alternative (`words.instances`); weighed by the alternatives.
    """

    def __init__(self) -> None:
        self.answers: Kept[Any] = Kept(32_000_000)
        self.earlier: Kept[tuple[Any, Any]] = Kept(16_000_000)
        self.groups: Kept[Any] = Kept(24_000_000)
        self.words: Kept[Any] = Kept(32_000_000)
        self.ranges: Kept[dict[str, tuple[int, int]]] = Kept(1_000)
        self.lengths: Kept[Any] = Kept(20_000)

    def clear(self) -> None:
        """Let go of all."""
        for own in (self.answers, self.earlier, self.groups, self.words, self.ranges, self.lengths):
            own.clear()


CACHE = Cache()
"""The one of this process."""
