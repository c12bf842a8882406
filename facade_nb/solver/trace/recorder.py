"""What the search calls where a trace was asked for.

Every hook of the solver is one call of a method here, which appends a tuple to a list. Events are made of these
notes when the trace is read (`telling`). All lists have an end: what does not fit is counted.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ...design.errors import NoLayout
    from ...design.model import Design
    from ..alignment.group import Group
    from ..alignment.observer import Partial
    from ..alignment.pricing import Priced
    from ..analysis.systems import Analysis
    from ..candidates.stream import Candidate
    from ..model.layout import AxisLayout, Layout
    from ..model.objective import Objective
    from ..model.problem import AxisProblem
    from ..selection.axis import AxisSearch, Case, Solved
    from ..words.instances import Instances
    from .trace import Trace

__all__ = ["Answer", "Judged", "Recorder", "Walk", "stage"]

STEPS = 10_000
"""So many steps are kept of one network."""
ENDS = 10_000
"""So many complete alignments of one network are known with their paths."""
ROOM = 60_000
"""So many steps are kept of all networks together while the search goes on."""
CANDIDATES = 4_000
"""So many candidates are kept."""
OTHERS = 3
"""So many networks of an axis are told besides those of the answer: the last ones that were opened. And those of so
many other candidates that were aligned: the cheapest."""

Places = tuple[int, ...]
_Letters = tuple[tuple[int, ...], ...]
_Border = tuple[tuple[int, int], ...]

_NOTHING: AbstractContextManager[None] = nullcontext()


def stage(recorder: Recorder | None, axis: str, name: str) -> AbstractContextManager[None]:
    """Note when a stage begins and how long it takes, if there is a recorder."""
    return _NOTHING if recorder is None else recorder.stage(axis, name)


class Walk:
    """What a search did in one network, step by step.

    Attributes
    ----------
    steps
        ``("limit", limit, bound)``, ``("node", path, bound)``, ``("edge", path, bound, dropped)`` with the longer path,
        ``("price", path, priced)``: as they happened. Of the paper's search, what it told as `Observer`, under the
        names of its methods.
    left
        How many more there were.
    taken
        Nodes taken up.
    ends
        Path and priced structure, by the structure's identity.
    """

    def __init__(
        self,
        recorder: Recorder,
        axis: str,
        number: int,
        names: Sequence[str],
        groups: Sequence[Group],
        search: str,
    ) -> None:
        self.axis, self.number, self.names, self.groups = axis, number, tuple(names), tuple(groups)
        self.search = search
        self.steps: list[tuple[Any, ...]] = []
        self.left = self.taken = self.ties = 0
        self.seconds = 0.0
        self.bound: float | None = None
        self.cut = False
        self.ends: dict[int, tuple[Partial, Priced]] = {}
        self._recorder = recorder

    def _note(self, *step: Any) -> None:
        if len(self.steps) < STEPS and self._recorder.has_room(self):
            self.steps.append(step)
        else:
            self.left += 1

    def limit(self, limit: float, bound: float) -> None:
        """The search goes on, up to this cost; it has been proven to cost at least `bound`."""
        self._note("limit", limit, bound)

    def node(self, path: Partial, bound: float) -> None:
        """A path is taken up."""
        self.taken += 1
        self._note("node", path, bound)

    def edge(self, path: Partial, bound: float, dropped: bool) -> None:
        """A path was made longer by a column: `path` is the longer one. `dropped`: one as good is known."""
        self._note("edge", path, bound, dropped)

    def price(self, path: Partial, priced: Priced | None) -> None:
        """A complete path was priced."""
        self._note("price", path, priced)
        if priced is not None and len(self.ends) < ENDS:
            self.ends[id(priced)] = (path, priced)

    # The paper's search tells these (`alignment.observer.Observer`).

    def deepened(self, limit: float, bound: float) -> None:
        """Begin a pass that follows nothing dearer. It goes over all that earlier ones did, which make room for it."""
        if len(self.steps) > STEPS // 2:
            kept = [step for step in self.steps if step[0] in ("limit", "prealigned", "merged")]
            self._recorder.give_back(len(self.steps) - len(kept))
            self.left += len(self.steps) - len(kept)
            self.steps = kept
        self._note("limit", limit, bound)

    def visited(self, way: str, group: int, places: Places, cost: float, bound: float) -> None:
        """Take a node up."""
        self.taken += 1
        self._note("visited", way, group, places, cost, bound)

    def traced(
        self, way: str, group: int, places: Places, words: tuple[int, int], lower: _Border, upper: _Border
    ) -> None:
        """Walk the borders of a tolerance region."""
        self._note("traced", way, group, places, words, lower, upper)

    def weighed(
        self,
        way: str,
        group: int,
        places: Places,
        column: _Letters,
        error: float,
        cost: float,
        after: Places,
    ) -> None:
        """Weigh an edge."""
        self._note("weighed", way, group, places, column, error, cost, after)

    def forbidden(self, way: str, group: int, places: Places, column: _Letters, constraint: str) -> None:
        """Leave an edge out."""
        self._note("forbidden", way, group, places, column, constraint)

    def pruned(
        self,
        way: str,
        group: int,
        places: Places,
        column: _Letters,
        after: Places,
        reason: str,
        cost: float,
        bound: float,
        against: float,
    ) -> None:
        """Do not follow an edge."""
        self._note("pruned", way, group, places, column, after, reason, cost, bound, against)

    def met(self, group: int, places: Places, cost: float, columns: int) -> None:
        """Join the walks from both ends."""
        self._note("met", group, places, cost, columns)

    def prealigned(self, nodes: tuple[tuple[int, tuple[Places, ...]], ...], cost: float) -> None:
        """Align the control words."""
        self._note("prealigned", nodes, cost)

    def merged(self, parts: tuple[tuple[int, tuple[int, ...], tuple[Places, ...]], ...], cost: float) -> None:
        """Align the words pair by pair, and the pairs with each other."""
        self._note("merged", parts, cost)

    @contextmanager
    def turn(self) -> Iterator[None]:
        """Add up the time that is spent in it."""
        begin = time.perf_counter()
        try:
            yield
        finally:
            self.seconds += time.perf_counter() - begin

    def known(self, bound: float, ties: int, cut: bool) -> None:
        """What is known after a turn."""
        self.bound, self.ties, self.cut = bound, ties, cut

    def forget(self) -> None:
        """Let go of the steps."""
        self.left += len(self.steps)
        self.steps, self.ends = [], {}


@dataclass(slots=True)
class Judged:
    """A candidate and what became of it; `done`: its networks were searched to the end."""

    candidate: Candidate
    tolerance: float
    floor: float
    networks: tuple[int, ...]
    unsizable: bool
    done: bool
    cost: float | None
    omega: float | None
    columns: int | None
    deviation: float | None


@dataclass(slots=True)
class Answer:
    """The answer of an axis; `paths`: per group, where its alignment was found, if that is known."""

    solved: Solved
    layout: AxisLayout
    complete: bool
    tolerance: float
    paths: tuple[tuple[Walk, Partial | None] | None, ...]


class Recorder:
    """The notes of one call of `solve`.

    Attributes
    ----------
    notes
        ``("begin", axis, stage, at)``, ``("end", axis, stage, seconds)``, ``("analysis", axis, analysis)``,
        ``("words", axis, problem, instances, tolerance)``, ``("candidate", axis, judged)``: as they happened.
    walks
        The networks by number.
    answers, layout, error
        What came of it.
    """

    def __init__(
        self, design: Design, objective: Objective, tolerances: Sequence[float], search: str
    ) -> None:
        self.design, self.objective, self.tolerances, self.search = (
            design,
            objective,
            tuple(tolerances),
            search,
        )
        self.notes: list[tuple[Any, ...]] = []
        self.walks: dict[int, Walk] = {}
        self.answers: dict[str, Answer] = {}
        self.layout: Layout | None = None
        self.error: NoLayout | None = None
        self.seconds = 0.0
        self.sized: dict[str, tuple[float, int]] = {}
        self.left: dict[str, int] = {}
        self._begin = time.perf_counter()
        self._kept = self._judged = 0

    @contextmanager
    def stage(self, axis: str, name: str) -> Iterator[None]:
        """Note when a stage begins and how long it takes, however it ends."""
        begin = time.perf_counter()
        self.notes.append(("begin", axis, name, begin - self._begin))
        try:
            yield
        finally:
            self.notes.append(("end", axis, name, time.perf_counter() - begin))

    @contextmanager
    def sizing(self, axis: str) -> Iterator[None]:
        """Add up the time that sizing takes."""
        begin = time.perf_counter()
        try:
            yield
        finally:
            seconds, times = self.sized.get(axis, (0.0, 0))
            self.sized[axis] = (seconds + time.perf_counter() - begin, times + 1)

    def analysed(self, axis: str, analysis: Analysis) -> None:
        """Pattern analysis is done."""
        self.notes.append(("analysis", axis, analysis))

    def words(self, problem: AxisProblem, found: Mapping[str, Instances], tolerance: float) -> None:
        """The words of all patterns are listed."""
        self.notes.append(("words", problem.axis, problem, dict(found), tolerance))

    def walk(self, axis: str, names: Sequence[str], groups: Sequence[Group], search: str) -> Walk:
        """A network is opened."""
        number = len(self.walks) + 1
        walk = self.walks[number] = Walk(self, axis, number, names, groups, search)
        return walk

    def has_room(self, own: Walk) -> bool:
        """Count one more step. Where there is no room, the oldest network that has led nowhere makes some."""
        if self._kept >= ROOM:
            old = next((w for w in self.walks.values() if w.steps and not w.ties and w is not own), None)
            if old is None:
                return False
            self.give_back(len(old.steps))
            old.forget()
        self._kept += 1
        return True

    def give_back(self, steps: int) -> None:
        """So many steps are not kept any more."""
        self._kept -= steps

    def judged(self, search: AxisSearch) -> None:
        """The candidates of a search have had their turns."""
        for case in search.cases:
            self.tried(search, case)

    def tried(self, search: AxisSearch, case: Case) -> None:
        """A candidate has had its turns."""
        axis, solved = search.problem.axis, case.solved
        if self._judged >= CANDIDATES:
            self.left[axis] = self.left.get(axis, 0) + 1
            return
        self._judged += 1
        own = Judged(
            case.candidate,
            search.tolerance,
            case.floor,
            tuple(run.log.number for run in case.runs if run.log is not None),
            case.unsizable,
            bool(case.runs) and all(run.done for run in case.runs),
            solved.cost if solved else None,
            _omega(solved) if solved else None,
            solved.columns if solved else None,
            solved.sized.deviation if solved else None,
        )
        self.notes.append(("candidate", axis, own))

    def answer(self, search: AxisSearch, solved: Solved, layout: AxisLayout, complete: bool) -> None:
        """The answer of an axis is known."""
        axis = search.problem.axis
        found: list[tuple[Walk, Partial | None] | None] = []
        for group, (priced, _) in zip(solved.groups, solved.parts, strict=True):
            own = [w for w in self.walks.values() if w.axis == axis and any(g is group for g in w.groups)]
            walk = next((w for w in own if id(priced) in w.ends), own[-1] if own else None)
            end = walk.ends.get(id(priced)) if walk else None
            found.append(None if walk is None else (walk, end[0] if end else None))
        self.answers[axis] = Answer(solved, layout, complete, search.tolerance, tuple(found))

    def finish(self, layout: Layout | None = None, error: NoLayout | None = None) -> None:
        """The call is over: keep what is told, and nothing that only the search needs."""
        self.layout, self.error = layout, error
        self.seconds = time.perf_counter() - self._begin
        told = {w.number for own in self.answers.values() for found in own.paths if found for w in found[:1]}
        for axis in ("x", "y"):
            told.update([w.number for w in self.walks.values() if w.axis == axis and w.steps][-OTHERS:])
            told.update(self._aligned(axis))
        for walk in self.walks.values():
            if walk.number not in told:
                walk.forget()

    def _aligned(self, axis: str) -> set[int]:
        """The networks of the cheapest candidates that were aligned, the best among them."""
        found = [
            (own.cost, own.networks)
            for kind, where, own, *_ in self.notes
            if kind == "candidate" and where == axis and own.cost is not None
        ]
        found.sort(key=lambda one: one[0])
        return {number for _, networks in found[: OTHERS + 1] for number in networks}

    def trace(self) -> Trace:
        """What is read of it all."""
        from .trace import Trace

        return Trace.of(self)


def _omega(solved: Solved) -> float:
    return sum(priced.omegas[k] for priced, k in solved.parts)
