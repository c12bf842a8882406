"""Events of the alignment decision network (the paper's 5.2)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from .base import Event
from .choices import LetterNote

__all__ = [
    "PRUNED",
    "BandNote",
    "ColumnNote",
    "ControlsAligned",
    "EdgeRefused",
    "EdgeWeighed",
    "LimitRaised",
    "NetworkClosed",
    "NetworkOpened",
    "NodeTaken",
    "PairsMerged",
    "PathChosen",
    "RegionTraced",
    "StructurePriced",
    "WaysMet",
]


PRUNED = ("bound", "known", "best", "length")
"""Why a permitted column is not followed: what `EdgeRefused` has as `constraint` where no constraint is against it."""


@dataclass(frozen=True, slots=True)
class BandNote:
    """A distinct word of a group, and the rows (0 is the top) that have it."""

    letters: tuple[LetterNote, ...]
    rows: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class NetworkOpened(Event):
    """The alignment decision network of groups that are aligned together; most have one group.

    `names` are the groups it was first needed for, `bands` their distinct words. Other groups and candidates with
    the same words share it.
    """

    network: int
    names: tuple[str, ...]
    bands: tuple[tuple[BandNote, ...], ...]
    canvas: float
    tolerance: float
    search: str


@dataclass(frozen=True, slots=True)
class LimitRaised(Event):
    """The search goes on, up to this cost (the threshold of iterative deepening; a candidate's turn).

    `bound` is what has been proven before: no alignment costs less.
    """

    network: int
    limit: float | None
    bound: float | None = None


@dataclass(frozen=True, slots=True)
class NodeTaken(Event):
    """A node is taken up, to look at the columns that may come next.

    Attributes
    ----------
    group, places
        Which group of the network it is in, and where each band stands there. The number of groups: all are aligned.
    cost, bound
        J so far at least; J of any alignment that goes through it at least.
    way
        ``forward``, or ``backward`` where a search walks from both ends.
    path, width, columns
        Number of the partial path that has come here, its W and its columns so far: of the best-first search, where
        several paths may come to one node. A path has the number of the edge that made it; one without columns
        begins each pass.
    """

    network: int
    group: int
    places: tuple[int, ...]
    cost: float
    bound: float
    way: str = "forward"
    path: int | None = None
    width: float | None = None
    columns: int | None = None


@dataclass(frozen=True, slots=True)
class EdgeWeighed(Event):
    """A column that may come next.

    Attributes
    ----------
    group, places, after
        The node it leaves, and the places it leads to, where that is told.
    column
        Per band, the letters in it.
    omega, cost, width
        Its ω; by how much J so far rises with it; its width: all where elastic letters cost nothing.
    bound
        J of any alignment that goes on so at least.
    fate
        ``open``: it waits for its turn; ``dropped``: a path known at its end is as good; ``overtaken``: a better
        one came later.
    path, parent
        Numbers of the longer path and of the one that it was made from (see `NodeTaken`).
    rival
        Number of the path that makes it needless, where it was dropped or overtaken.
    """

    network: int
    group: int
    places: tuple[int, ...]
    column: tuple[tuple[int, ...], ...]
    omega: float
    cost: float
    after: tuple[int, ...] | None = None
    width: float | None = None
    bound: float | None = None
    fate: str = "open"
    way: str = "forward"
    path: int | None = None
    parent: int | None = None
    rival: int | None = None


@dataclass(frozen=True, slots=True)
class EdgeRefused(Event):
    """A column that may not come next (forbidden), or that need not be looked at (pruned).

    Attributes
    ----------
    group, places
        The node it would leave.
    column, after
        Per band, the letters in it and the place after it; None for a band that need not be looked at: the
        column is refused whatever stands there.
    constraint
        ``C1`` to ``C4``, ``omega`` (ω > μ), ``width`` (W beyond canvas ± μ), ``empty`` (no row has a letter in it),
        ``boundary`` (no row's letter begins or ends there): these forbid it. It is pruned by ``bound`` (what an
        alignment with it costs at least is above the limit), ``known`` (another path has come to the same node for
        no more), ``best`` (no better than what is known, not even by its columns), or ``length`` (too dear once its
        pieces are longer than nothing).
    bands, letters
        Who is to blame: bands, and letters as ``(band, letter)``.
    amount
        By how much, in metres, where it is a matter of metres.
    text
        A sentence.
    parent
        Number of the path that it would make longer (see `NodeTaken`).
    cost, bound, against
        Where it is pruned: J so far with it, J of any alignment with it at least, and what that was held against: the
        limit, J so far of the other path, or J of the best that is known.
    """

    network: int
    group: int
    places: tuple[int, ...]
    column: tuple[tuple[int, ...] | None, ...]
    constraint: str
    after: tuple[int | None, ...] | None = None
    bands: tuple[int, ...] = ()
    letters: tuple[tuple[int, int], ...] = ()
    amount: float | None = None
    text: str = ""
    way: str = "forward"
    parent: int | None = None
    cost: float | None = None
    bound: float | None = None
    against: float | None = None


@dataclass(frozen=True, slots=True)
class RegionTraced(Event):
    """The paper's search traces the tolerance region of two words from a node (supplement 3.3, its Figure 6).

    `words` are two bands; `lower` and `upper` the nodes that the pointers along its two borders pass, as letters
    read of each from there: inside, the totals of both differ by at most μ.
    """

    network: int
    group: int
    places: tuple[int, ...]
    words: tuple[int, int]
    lower: tuple[tuple[int, int], ...]
    upper: tuple[tuple[int, int], ...]
    way: str = "forward"


@dataclass(frozen=True, slots=True)
class WaysMet(Event):
    """The walks from both ends meet at a node, which makes an alignment of that cost and so many columns."""

    network: int
    group: int
    places: tuple[int, ...]
    cost: float
    columns: int


@dataclass(frozen=True, slots=True)
class ControlsAligned(Event):
    """The control words are aligned first (supplement 3.3).

    `nodes` are those between their columns: by group, the places of each. `cost` is J of what was found through
    them; None: nothing was.
    """

    network: int
    nodes: tuple[tuple[int, tuple[tuple[int, ...], ...]], ...]
    cost: float | None


@dataclass(frozen=True, slots=True)
class PairsMerged(Event):
    """The words are aligned pair by pair, and the pairs with each other (the paper's pairwise hierarchy).

    `parts` are the last to be merged: group, bands, and the nodes between the columns of these. `cost` is J of what
    was found through them; None: nothing was.
    """

    network: int
    parts: tuple[tuple[int, tuple[int, ...], tuple[tuple[int, ...], ...]], ...]
    cost: float | None


@dataclass(frozen=True, slots=True)
class StructurePriced(Event):
    """A complete path, priced exactly by a linear programme; without a cost where no sizes keep the tolerances.

    `proper`: every piece is longer than nothing. `unsized` are the sizes of unsized symbols that make it cheapest.
    """

    network: int
    path: int | None
    cost: float | None
    omega: float | None
    columns: int
    proper: bool
    widths: tuple[float, ...] = ()
    unsized: Mapping[str, float] | None = None


@dataclass(frozen=True, slots=True)
class NetworkClosed(Event):
    """What came of a network: nodes taken up, seconds, the proven lower bound, equally good structures found.

    `cut`: the search of it gave up. No `bound`: there is no alignment.
    """

    network: int
    nodes: int
    seconds: float
    bound: float | None
    ties: int
    cut: bool


@dataclass(frozen=True, slots=True)
class ColumnNote:
    """A column of an alignment: per band, its letters, the place after it, the sizes of letters or pieces; width, ω."""

    letters: tuple[tuple[int, ...], ...]
    after: tuple[int, ...]
    sizes: tuple[tuple[float, ...], ...]
    width: float
    omega: float


@dataclass(frozen=True, slots=True)
class PathChosen(Event):
    """The alignment of a group, as it goes into the layout.

    `network` and `nodes` say where it was found: the numbers of the paths from the first to the last; None and
    empty where a network was not told, or the alignment was made in haste.
    """

    group: str
    bands: tuple[BandNote, ...]
    columns: tuple[ColumnNote, ...]
    error: float
    width: float
    network: int | None = None
    nodes: tuple[int, ...] = ()
