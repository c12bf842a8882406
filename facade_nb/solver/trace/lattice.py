"""The alignment decision network of a group as a whole (the paper's Figure 8), made on demand and within bounds.

For one or two words every node and every edge is listed, also those that no search would ever look at: an edge has
its weight, or the constraint that forbids it. For more words that would be too many: there, what the search walked
and refused is gathered from the events, and any two of the words can be looked at as a pair.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, fields
from math import inf
from typing import TYPE_CHECKING, Any

from ...design.errors import DesignError, Fault, nearest
from ..alignment.group import Group, make_group
from ..events import (
    BandNote,
    CandidateJudged,
    EdgeRefused,
    EdgeWeighed,
    LetterNote,
    NetworkOpened,
    NodeTaken,
    PathChosen,
    TraceBegun,
)
from ..model.letters import Letter
from ..model.objective import Objective
from ..model.precision import EPS
from .network_events import band_notes
from .tables import rest_of
from .weights import columns_at, weigh

if TYPE_CHECKING:
    import pandas as pd

    from .trace import Trace

__all__ = ["Lattice", "LatticeEdge", "LatticeNode", "lattice_of", "traced_group", "traced_lattice"]

NODES = 10_000
"""So many nodes are listed,"""
EDGES = 100_000
"""and so many edges."""


@dataclass(frozen=True, slots=True)
class LatticeNode:
    """A node: where each word stands, and what is still to come of it.

    Attributes
    ----------
    places
        Per word: twice the letters read, and one more inside a cut letter.
    position, owed
        What the constraints ask of the column before (`elements.Position`); whether no letter ended there. Nodes
        with equal places differ in these only.
    reachable, alive
        Whether permitted edges lead to it from the first node, and from it to the last.
    least
        Least W with which it is reached; None: it is not.
    """

    number: int
    places: tuple[int, ...]
    rests: tuple[str, ...]
    position: tuple[int, ...]
    owed: bool
    reachable: bool
    alive: bool
    least: float | None


@dataclass(frozen=True, slots=True)
class LatticeEdge:
    """An edge: the letters of a column, its weight, and what forbids it (None: nothing); see `events.EdgeRefused`."""

    source: int
    target: int
    column: tuple[tuple[int, ...] | None, ...]
    omega: float | None
    cost: float | None
    width: float | None
    constraint: str | None = None
    bands: tuple[int, ...] = ()
    letters: tuple[tuple[int, int], ...] = ()
    text: str = ""


@dataclass(frozen=True, slots=True)
class Lattice:
    """Nodes and edges; `bands` are the words; `left_out`: so many nodes and edges at least were not listed."""

    bands: tuple[BandNote, ...]
    nodes: tuple[LatticeNode, ...]
    edges: tuple[LatticeEdge, ...]
    left_out: int = 0

    def node_frame(self) -> pd.DataFrame:
        """The nodes as a table, with the fields of `LatticeNode` as columns."""
        return _frame(self.nodes, LatticeNode)

    def edge_frame(self) -> pd.DataFrame:
        """The edges as a table, with the fields of `LatticeEdge` as columns."""
        return _frame(self.edges, LatticeEdge)


def _frame(items: Sequence[object], cls: Any) -> pd.DataFrame:
    import pandas as pd

    names = [f.name for f in fields(cls)]
    return pd.DataFrame([[getattr(item, name) for name in names] for item in items], columns=names)


def lattice_of(group: Group, nodes: int = NODES, edges: int = EDGES) -> Lattice:
    """Every node and edge of the network of one or two words.

    Raises
    ------
    ValueError
        For more words.
    """
    if len(group.bands) > 2:
        raise ValueError(f"lattice_of: expected one or two different words, found {len(group.bands)}")
    start = (group.start, False)
    number = {start: 0}
    queue = deque([start])
    found: list[LatticeEdge] = []
    left = 0
    while queue:
        node = queue.popleft()
        for column, refused in columns_at(group, *node, whole=True):
            options = [option for option in column if option is not None]
            target = (
                tuple(option.target for option in options),
                not any(option.ends for option in options),
            )
            if refused is not None and refused.constraint == "empty":
                continue  # an edge from a node to itself
            if target not in number:
                if len(number) >= nodes:
                    left += 1
                    continue
                number[target] = len(number)
                queue.append(target)
            if len(found) >= edges:
                left += 1
                continue
            weight = weigh(group, column)
            found.append(
                LatticeEdge(
                    number[node],
                    number[target],
                    tuple(option.letters for option in options),
                    weight.omega,
                    weight.cost,
                    weight.width,
                    None if refused is None else refused.constraint,
                    () if refused is None else refused.bands,
                    () if refused is None else refused.letters,
                    "" if refused is None else refused.text,
                )
            )
    states = list(number)
    # an edge only ever leads to places further on, or to the same ones with a boundary owed
    found.sort(key=lambda e: (_order(states[e.source]), e.source))
    least = _least(group, states, found)
    found = [_too_wide(group, states, least, edge) for edge in found]
    least = _least(group, states, found)
    alive = _alive(group, states, found)
    bands = band_notes(group)
    listed = tuple(
        LatticeNode(
            n,
            places := tuple(p >> 2 for p in state),
            tuple(rest_of(band, place) for band, place in zip(bands, places, strict=True)),
            state,
            owed,
            least[n] < inf,
            alive[n],
            least[n] if least[n] < inf else None,
        )
        for n, (state, owed) in enumerate(states)
    )
    return Lattice(bands, listed, tuple(found), left)


_State = tuple[tuple[int, ...], bool]


def _order(node: _State) -> tuple[int, bool]:
    return sum(p >> 2 for p in node[0]), node[1]


def _least(group: Group, states: Sequence[_State], edges: Sequence[LatticeEdge]) -> list[float]:
    """Per node: the least W of a path of permitted edges to it."""
    least = [inf] * len(states)
    least[0] = 0.0
    for edge in edges:
        if edge.constraint is None and edge.width is not None:
            least[edge.target] = min(least[edge.target], least[edge.source] + edge.width)
    return least


def _too_wide(
    group: Group, states: Sequence[_State], least: Sequence[float], edge: LatticeEdge
) -> LatticeEdge:
    """Forbid an edge with which W must become larger than canvas + μ."""
    if edge.constraint is not None or edge.width is None or least[edge.source] == inf:
        return edge
    state, _ = states[edge.target]
    rest = max(band.at_least(p) for band, p in zip(group.bands, state, strict=True))
    over = least[edge.source] + edge.width + rest - group.canvas - group.tolerance
    if over <= EPS:
        return edge
    return LatticeEdge(
        edge.source,
        edge.target,
        edge.column,
        edge.omega,
        edge.cost,
        edge.width,
        "width",
        tuple(range(len(group.bands))),
        (),
        f"W becomes {over:.3g} m larger than canvas + μ at least.",
    )


def _alive(group: Group, states: Sequence[_State], edges: Sequence[LatticeEdge]) -> list[bool]:
    goal = tuple(p >> 2 for p in group.goal)
    alive = [tuple(p >> 2 for p in state) == goal for state, _ in states]
    for edge in reversed(edges):
        if edge.constraint is None and alive[edge.target]:
            alive[edge.source] = True
    return alive


def traced_lattice(trace: Trace, axis: str, name: str, bands: tuple[int, int] | None = None) -> Lattice:
    """The network of a group of a trace.

    Parameters
    ----------
    bands
        Two of its different words, by number, to be looked at as a pair. None: all; for more than two the nodes
        and edges are those that the search walked and refused.

    Raises
    ------
    DesignError
        For a group that the trace has no alignment of.
    """
    own = _path(trace, axis, name)
    if bands is None and len(own.bands) > 2:
        return _walked(trace, own)
    return lattice_of(traced_group(trace, axis, name, bands))


def traced_group(trace: Trace, axis: str, name: str, bands: Sequence[int] | None = None) -> Group:
    """The group of a trace that was aligned, or some of its words, ready to be aligned again."""
    own = _path(trace, axis, name)
    chosen = own.bands if bands is None else [own.bands[b] for b in bands]
    rows = {i: band.letters for band in chosen for i in band.rows}
    begun = trace.of_kind(TraceBegun)[0]
    best = next(e for e in trace.of_kind(CandidateJudged, axis) if e.fate == "best")
    canvas = begun.design["canvas"]["width" if axis == "x" else "height"]
    letters = [[_letter(note) for note in rows[i]] for i in sorted(rows)]
    return make_group(letters, canvas, best.tolerance, Objective(**begun.objective))


def _path(trace: Trace, axis: str, name: str) -> PathChosen:
    paths = {e.group: e for e in trace.of_kind(PathChosen, axis)}
    if name not in paths:
        place = f"axis {axis!r}"
        raise DesignError(Fault(place, f"expected an aligned group, found {name!r}{nearest(name, paths)}"))
    return paths[name]


def _letter(note: LetterNote) -> Letter:
    return Letter(**{f.name: getattr(note, f.name) for f in fields(note)})


def _walked(trace: Trace, own: PathChosen) -> Lattice:
    """Nodes and edges that the search walked and refused."""
    opened = [
        (e.network, g)
        for e in trace.of_kind(NetworkOpened, own.axis)
        for g, bands in enumerate(e.bands)
        if e.network == own.network and bands == own.bands
    ]
    network, g = opened[0] if opened else (None, 0)
    number: dict[tuple[int, ...], int] = {}
    reached = {tuple(0 for _ in own.bands)}
    least: dict[tuple[int, ...], float] = {}
    found: list[LatticeEdge] = []

    def at(places: tuple[int, ...]) -> int:
        return number.setdefault(places, len(number))

    for e in trace.events:
        if e.axis != own.axis:
            continue
        if isinstance(e, NodeTaken) and (e.network, e.group) == (network, g):
            at(e.places)
            reached.add(e.places)
            if e.width is not None:
                least[e.places] = min(least.get(e.places, inf), e.width)
        elif isinstance(e, EdgeWeighed) and (e.network, e.group) == (network, g) and e.after is not None:
            found.append(LatticeEdge(at(e.places), at(e.after), e.column, e.omega, e.cost, e.width, None))
            reached.add(e.after)
        elif isinstance(e, EdgeRefused) and (e.network, e.group) == (network, g):
            after = tuple(
                p if a is None else a
                for a, p in zip(e.after or (None,) * len(e.places), e.places, strict=True)
            )
            found.append(
                LatticeEdge(
                    at(e.places),
                    at(after),
                    e.column,
                    None,
                    None,
                    None,
                    e.constraint,
                    e.bands,
                    e.letters,
                    e.text,
                )
            )
    chosen = {tuple(0 for _ in own.bands), *(column.after for column in own.columns)}
    nodes = tuple(
        LatticeNode(
            n,
            places,
            tuple(rest_of(band, place) for band, place in zip(own.bands, places, strict=True)),
            tuple(4 * place for place in places),
            False,
            places in reached,
            places in chosen,
            least.get(places),
        )
        for places, n in number.items()
    )
    return Lattice(own.bands, nodes, tuple(dict.fromkeys(found)))
