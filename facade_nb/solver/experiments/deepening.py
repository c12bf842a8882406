"""The paper's search with a learner's functions in it: iterative deepening, one way, from the first node to the last.

The network, the constraints, the prices, the table of visited nodes and the walk are those of `alignment.paper`. The
learner's may be the heuristic, the error of a column, a constraint on columns, the order of equal edges, and the next
limit. It walks one way and knows no alignment beforehand, so that nothing but these decides what it looks at.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from math import inf

from .. import tuning
from ..alignment.elements import Option
from ..alignment.found import Found
from ..alignment.group import Group
from ..alignment.paper.bidirectional import Meeting
from ..alignment.paper.decision_network import Column as Edge
from ..alignment.paper.decision_network import Lattice, State
from ..alignment.paper.deepening import Ends
from ..alignment.paper.halves import Half, Side
from ..alignment.pricing import Priced, Structure
from ..alignment.rules import tally
from ..effort import Stopped
from ..model.precision import EPS
from .functions import Asked, Functions
from .views import Column, Node, Pass, Visit, spelled

__all__ = ["Deepened", "OwnSide", "deepen"]

_TOLD = 5000
"""So many visits are kept."""


@dataclass(slots=True)
class Deepened:
    """What a search came to.

    Attributes
    ----------
    found
        The best structures; `found.cut` says that it gave up before its end.
    passes
        The limit of each pass.
    visits
        The nodes in order, the first ones of very many.
    """

    found: Found
    passes: list[float] = field(default_factory=list)
    visits: list[Visit] = field(default_factory=list)

    @property
    def nodes(self) -> int:
        """Taken up, in all passes."""
        return self.found.nodes


class _OwnLattice(Lattice):
    """The network of a group: every edge that leaves a node, with the learner's column error and constraint."""

    def __init__(self, like: Lattice, error: Asked | None, constraint: Asked | None) -> None:
        super().__init__(like.group, like.check, like.pairs)
        self._error, self._constraint = error, constraint
        self._own: dict[tuple[State, bool], list[Edge]] = {}
        self._views: dict[int, Column] = {}
        self.shifts: dict[tuple[Option, ...], float] = {}
        """By how much the learner's error of a column differs from the product's, metres."""

    def edges(self, state: State, owed: bool) -> list[Edge]:
        """All that keep the constraints and the tolerance."""
        own = self._own.get((state, owed))
        if own is None:
            every = self.columns(state, owed, inf)[0]
            own = self._own[state, owed] = [self._priced(edge) for edge in every if self._allowed(edge)]
        return own

    def _allowed(self, edge: Edge) -> bool:
        return self._constraint is None or self._constraint.truth(self.view(edge))

    def view(self, edge: Edge) -> Column:
        """A column as the learner sees it."""
        view = self._views.get(id(edge))
        if view is None:
            letters = [
                tuple([band.letters[i] for i in option.letters])
                for band, option in zip(self.group.bands, edge.options, strict=True)
            ]
            sizes = [o.size for o in edge.options if o.size is not None and not o.empty]
            omega = tally(self.group, edge.options).omega
            view = self._views[id(edge)] = Column(tuple(letters), tuple(sizes), omega, edge.width)
        return view

    def _priced(self, edge: Edge) -> Edge:
        if self._error is None or not any(o.size is not None and not o.empty for o in edge.options):
            return edge
        shift = self._error.metres(self.view(edge), most=1e9) - edge.omega
        self.shifts[edge.options] = shift
        return replace(edge, cost=edge.cost + shift)


class OwnSide(Side):
    """The walk of the learner: its heuristic, and its order of equal edges."""

    def __init__(self, lattices: Sequence[Lattice], functions: Functions) -> None:
        self._heuristic, self._tie = functions.asked("heuristic"), functions.asked("tie_break")
        error, constraint = functions.asked("column_error"), functions.asked("constraint")
        self.own = [_OwnLattice(lattice, error, constraint) for lattice in lattices]
        super().__init__("forward", self.own)

    def _least(self, half: Half) -> float:
        if self._heuristic is None:
            return super()._least(half)
        return self._heuristic.metres(self.node(half))

    def node(self, half: Half) -> Node:
        """A node as the learner sees it."""
        group = self.groups[half.group]
        rests = tuple([band.letters[p >> 3 :] for band, p in zip(group.bands, half.state, strict=True)])
        sizes = tuple(
            [
                sum([letter.size or 0.0 for letter in rest if not letter.transparent or not band.cuts])
                for band, rest in zip(group.bands, rests, strict=True)
            ]
        )
        return Node(
            rests,
            sizes,
            half.cost,
            half.width,
            half.columns,
            group.canvas,
            group.tolerance,
            group.objective.fit,
            lambda: super(OwnSide, self)._least(half),
        )

    def onward(self, half: Half, limit: float) -> Iterable[Half]:
        """Longer by one column, by f and then by the tie-break; none whose f exceeds the limit."""
        lattice = self.own[half.group]
        children: list[tuple[int, tuple[float, ...], int, Half]] = []
        for n, edge in enumerate(lattice.edges(half.state, half.owed)):
            child = self._extend(half, edge)
            if child is None or child.bound == inf:
                continue
            if child.bound > limit + EPS:
                self.beyond = min(self.beyond, child.bound)
                continue
            tie = (float(edge.symbols),) if self._tie is None else self._tie.key(lattice.view(edge))
            children.append((round(child.bound * 1e8), tie, n, child))
        children.sort(key=lambda own: own[:3])
        return [child for *_, child in children]

    def shift(self, structure: Structure) -> float:
        """What the learner's column error adds to J of a whole alignment."""
        return sum(
            lattice.shifts.get(column, 0.0)
            for lattice, columns in zip(self.own, structure, strict=True)
            for column in columns
        )


class _OwnMeeting(Meeting):
    """A pass. No programme looks ahead, for it would know of the product's errors alone."""

    forward: OwnSide

    def _beyond(self, side: Side, half: Half) -> str:
        return ""

    def _priced(self, structure: Structure) -> Priced | None:
        priced = super()._priced(structure)
        return None if priced is None else replace(priced, cost=priced.cost + self.forward.shift(structure))


class _Diary:
    """Keeps the visits of a pass."""

    def __init__(self, groups: Sequence[Group], into: list[Visit], number: int) -> None:
        self._groups, self._into, self._number = groups, into, number

    def visited(self, way: str, group: int, places: Sequence[int], cost: float, bound: float) -> None:
        if len(self._into) < _TOLD:
            at = self._groups[group].bands if group < len(self._groups) else ()
            rests = (
                [spelled(band.letters[p >> 1 :]) for band, p in zip(at, places, strict=True)]
                if at
                else ["end"]
            )
            self._into.append(
                Visit(self._number, f"({', '.join(rests)})", cost, max(0.0, bound - cost), bound)
            )

    def __getattr__(self, name: str) -> Callable[..., None]:
        return lambda *what: None


def deepen(
    groups: Sequence[Group],
    functions: Functions,
    *,
    cap: float = inf,
    table: bool = True,
    nodes: int = 20_000,
    check: Callable[[], None] | None = None,
    accept: Callable[[Priced], bool] | None = None,
) -> Deepened:
    """Pass after pass, until one finds an alignment.

    Parameters
    ----------
    cap
        Nothing dearer is of any use.
    table
        Whether paths are dropped for others that lead to the same node.
    nodes
        It gives up after so many.
    accept
        See `core.search.search_best`.
    """
    found = Found()
    out = Deepened(found)
    taken = accept
    if not table:
        taken = accept or (lambda priced: True)
    try:
        ends = Ends(groups, check)
        side = OwnSide(ends.forward.lattices, functions)
        ask = functions.asked("next_limit")
        first = limit = side.later[0]
        step = 0.01 * max(group.canvas for group in groups)
        while limit < inf and limit <= cap + EPS:
            out.passes.append(limit)
            side.beyond = ends.backward.beyond = inf
            before, found.ties = found.nodes, []
            meeting = _OwnMeeting(
                side,
                ends.backward,
                limit,
                found,
                nodes=nodes,
                check=check,
                accept=taken,
                alone=True,
                observer=_Diary(groups, out.visits, len(out.passes)),
            )
            meeting.run()
            beyond = min(side.beyond, ends.backward.beyond)
            if found.ties or found.cut or beyond == inf:
                break
            usual = max(beyond, first + step)
            step *= tuning.LIMIT_GROWTH
            told = Pass(len(out.passes), limit, beyond, first, found.nodes - before, usual)
            limit = usual if ask is None else max(ask.metres(told), limit + EPS)
            limit = min(limit, cap) if out.passes[-1] < cap - EPS else limit
    except Stopped:
        found.cut = True
    return out
