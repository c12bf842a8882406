"""One node's edges, told to an observer as plain values."""

from __future__ import annotations

from collections.abc import Sequence

from ..elements import Option, Position
from ..group import Group
from ..observer import Observer, Places

__all__ = ["Watch", "places_from_left"]


class Watch:
    """Tells an observer of one node's edges; its methods are those of `Observer`, less what is the same for all."""

    def __init__(
        self, observer: Observer, way: str, index: int, group: Group, state: Sequence[Position]
    ) -> None:
        self._observer, self._way, self._index = observer, way, index
        self._group, self._bands = group, group.bands
        self._places = places_from_left(group, state, way)

    def _letters(self, options: Sequence[Option]) -> tuple[tuple[int, ...], ...]:
        if self._way == "forward":
            return tuple(option.letters for option in options)
        return tuple(
            tuple(len(band.letters) - 1 - i for i in reversed(option.letters))
            for band, option in zip(self._bands, options, strict=True)
        )

    def traced(
        self,
        words: tuple[int, int],
        lower: tuple[tuple[int, int], ...],
        upper: tuple[tuple[int, int], ...],
    ) -> None:
        """Tell of a tolerance region."""
        self._observer.traced(self._way, self._index, self._places, words, lower, upper)

    def weighed(self, options: Sequence[Option], error: float, cost: float) -> None:
        """Tell of an edge."""
        after = places_from_left(self._group, [option.target for option in options], self._way)
        self._observer.weighed(
            self._way, self._index, self._places, self._letters(options), error, cost, after
        )

    def pruned(
        self, options: Sequence[Option], reason: str, cost: float, bound: float, against: float
    ) -> None:
        """Tell of an edge that is not followed."""
        after = places_from_left(self._group, [option.target for option in options], self._way)
        self._observer.pruned(
            self._way, self._index, self._places, self._letters(options), after, reason, cost, bound, against
        )

    def forbidden(self, options: Sequence[Option], constraint: str) -> None:
        """Tell of an edge that is none."""
        self._observer.forbidden(self._way, self._index, self._places, self._letters(options), constraint)


def places_from_left(group: Group, state: Sequence[Position], way: str) -> Places:
    """Where the heads stand, counted from the left whichever way they read."""
    if way == "forward":
        return tuple(p >> 2 for p in state)
    return tuple(2 * len(band.letters) - (p >> 2) for band, p in zip(group.bands, state, strict=True))
