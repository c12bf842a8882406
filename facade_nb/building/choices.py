"""Which words the spines of a building have: all ways to choose, those that may cost least first."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import count

from ..solver.solution import AxisAnswer
from .cuts import Ways

__all__ = ["Case", "Choices", "Option"]


@dataclass(frozen=True, slots=True)
class Option:
    """Counter values of one design's spine, and what the design costs with them at least."""

    values: tuple[tuple[str, int], ...]
    floor: float


@dataclass(frozen=True, slots=True)
class Case:
    """One option of every design, and what is known of them together.

    Attributes
    ----------
    answers
        Of the designs, once they are solved with these values.
    ways
        To align their spines, once they are asked for.
    """

    options: tuple[Option, ...]
    answers: tuple[AxisAnswer, ...] = ()
    ways: Ways | None = None

    @property
    def cost(self) -> float:
        """What the designs cost."""
        return sum(own.layout.cost for own in self.answers)

    @property
    def floor(self) -> float:
        """What all costs at least."""
        least = sum(own.layout.cost - own.layout.gap for own in self.answers)
        return least if self.ways is None else least + self.ways.floor

    def values(self, held: Mapping[str, int]) -> dict[str, int] | None:
        """The values of all options, and those that are held; None where they contradict each other."""
        found = dict(held)
        for option in self.options:
            for name, value in option.values:
                if found.setdefault(name, value) != value:
                    return None
        return found


@dataclass
class Choices:
    """Cases by what they cost at least. A case comes back when more is known of it."""

    options: Sequence[Sequence[Option]]
    _ahead: list[tuple[float, int, tuple[int, ...], Case | None]] = field(default_factory=list, init=False)
    _ticks: Iterator[int] = field(default_factory=count, init=False)

    def __post_init__(self) -> None:
        start = (0,) * len(self.options)
        self._seen = {start}
        floor = sum(own[0].floor for own in self.options)
        self._ahead.append((floor, next(self._ticks), start, None))

    @property
    def floor(self) -> float:
        """No case that is left costs less; infinite without any."""
        return self._ahead[0][0] if self._ahead else float("inf")

    def take(self) -> Case:
        """The case that may cost least."""
        floor, _, at, case = heappop(self._ahead)
        if case is not None:
            return case
        for n, k in enumerate(at):
            following = (*at[:n], k + 1, *at[n + 1 :])
            if k + 1 < len(self.options[n]) and following not in self._seen:
                self._seen.add(following)
                more = floor - self.options[n][k].floor + self.options[n][k + 1].floor
                heappush(self._ahead, (more, next(self._ticks), following, None))
        return Case(tuple(own[k] for own, k in zip(self.options, at, strict=True)))

    def back(self, case: Case) -> None:
        """Put a case back, of which more is known now."""
        heappush(self._ahead, (case.floor, next(self._ticks), (), case))
