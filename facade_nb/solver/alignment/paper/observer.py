"""What the alignment search tells whoever watches it: plain values, nothing of the search itself."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from ..columns import Group, Option, Position

__all__ = ["Observer", "Places", "Watch", "places_from_left"]

Places = tuple[int, ...]
"""Where the heads stand, one number a word: twice the letters read, and one more inside a cut letter."""


class Observer(Protocol):
    """Methods that the search calls as it goes; without an observer nothing is called, and nothing made for it.

    `way` is ``"forward"`` or ``"backward"``. Places are always counted from the left, and words are the distinct
    words of a group, topmost first. Letters are numbered from the left, too.
    """

    def deepened(self, limit: float) -> None:
        """Begin a pass that follows nothing dearer than `limit`."""

    def visited(self, way: str, group: int, places: Places, cost: float, bound: float) -> None:
        """Take a node up: what is laid costs at least `cost`, a whole alignment through it at least `bound`."""

    def traced(
        self,
        way: str,
        group: int,
        places: Places,
        words: tuple[int, int],
        lower: tuple[tuple[int, int], ...],
        upper: tuple[tuple[int, int], ...],
    ) -> None:
        """Walk the two borders of the tolerance region of two words from a node, in letters read from there."""

    def weighed(
        self,
        way: str,
        group: int,
        places: Places,
        column: tuple[tuple[int, ...], ...],
        error: float,
        cost: float,
        after: Places,
    ) -> None:
        """Weigh an edge: the letters of its column in each word, ω and what it costs at least; where it leads."""

    def forbidden(
        self, way: str, group: int, places: Places, column: tuple[tuple[int, ...], ...], constraint: str
    ) -> None:
        """Leave an edge out, by ``"C1"``, ``"C3"`` or ``"boundary"`` (no letter of any word begins or ends there)."""

    def met(self, group: int, places: Places, cost: float, columns: int) -> None:
        """Join the two walks at a node into an alignment."""

    def prealigned(self, nodes: tuple[tuple[int, tuple[Places, ...]], ...], cost: float) -> None:
        """Align the control words.

        Told are the nodes between their columns, by group, and J of what was found through them; infinite
        where nothing was.
        """

    def merged(self, parts: tuple[tuple[int, tuple[int, ...], tuple[Places, ...]], ...], cost: float) -> None:
        """Align the words pair by pair, and the pairs with each other.

        Told are the last parts to be merged, as group, words, and the nodes between the columns of these; and J
        as above.
        """


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

    def forbidden(self, options: Sequence[Option], constraint: str) -> None:
        """Tell of an edge that is none."""
        self._observer.forbidden(self._way, self._index, self._places, self._letters(options), constraint)


def places_from_left(group: Group, state: Sequence[Position], way: str) -> Places:
    """Where the heads stand, counted from the left whichever way they read."""
    if way == "forward":
        return tuple(p >> 2 for p in state)
    return tuple(2 * len(band.letters) - (p >> 2) for band, p in zip(group.bands, state, strict=True))
