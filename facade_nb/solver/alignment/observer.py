"""What the alignment searches tell whoever watches them.

The searches know these protocols and nothing of what implements them (the recorder of a trace does). Without an
observer nothing is called, and nothing made for it.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager
from typing import Protocol

from .elements import Option
from .pricing import Priced

__all__ = ["NetworkObserver", "Observer", "Partial", "PathObserver", "Places"]

Places = tuple[int, ...]
"""Where the heads stand, one number a word: twice the letters read, and one more inside a cut letter."""


class Partial(Protocol):
    """What is read of a partial path (`reference.paths.Path`), and not before the trace is."""

    @property
    def group(self) -> int:
        """Which group of the network it is in."""

    @property
    def state(self) -> Sequence[int]:
        """Position of every band of that group; empty where it is complete."""

    @property
    def owed(self) -> bool:
        """No letter ended at its last boundary."""

    @property
    def cost(self) -> float:
        """J so far at least."""

    @property
    def width(self) -> float:
        """W so far in this group."""

    @property
    def columns(self) -> int:
        """How many it has, in all groups."""

    @property
    def column(self) -> Sequence[Option]:
        """Its newest column."""

    @property
    def parent(self) -> Partial | None:
        """The path without that column."""

    @property
    def dropped(self) -> bool:
        """A better one was found later."""


class PathObserver(Protocol):
    """What the best-first search tells, path by path."""

    def limit(self, limit: float, bound: float) -> None:
        """The search goes on, up to this cost; it has been proven to cost at least `bound`."""

    def node(self, path: Partial, bound: float) -> None:
        """A path is taken up."""

    def edge(self, path: Partial, bound: float, dropped: bool) -> None:
        """A path was made longer by a column: `path` is the longer one. `dropped`: one as good is known."""

    def price(self, path: Partial, priced: Priced | None) -> None:
        """A complete path was priced."""


class Observer(Protocol):
    """What the paper's search tells, node by node: plain values, nothing of the search itself.

    `way` is ``"forward"`` or ``"backward"``. Places are always counted from the left, and words are the distinct
    words of a group, topmost first. Letters are numbered from the left, too.
    """

    def deepened(self, limit: float, bound: float) -> None:
        """Begin a pass that follows nothing dearer than `limit`; the passes before it have proven J ≥ `bound`."""

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

    def pruned(
        self,
        way: str,
        group: int,
        places: Places,
        column: tuple[tuple[int, ...], ...],
        after: Places,
        reason: str,
        cost: float,
        bound: float,
        against: float,
    ) -> None:
        """Do not follow an edge that is permitted.

        `cost` is what is laid with it, `bound` what an alignment with it costs at least. Reasons: ``"bound"``: that is
        more than the limit of the pass; ``"known"``: another path has come to the same node for no more; ``"best"``:
        what is known already costs no more, and has as many columns; ``"length"``: so it is, or above the limit, once
        its pieces are longer than nothing. `against` is that limit, or that cost.
        """

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


class NetworkObserver(PathObserver, Observer, Protocol):
    """What is told of one network, whichever search goes through it."""

    @property
    def number(self) -> int:
        """The network's number in the trace."""

    def turn(self) -> AbstractContextManager[None]:
        """Add up the time that is spent in it."""

    def known(self, bound: float, ties: int, cut: bool) -> None:
        """What is known after a turn."""
