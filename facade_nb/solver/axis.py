"""One axis: from its words to the best candidate, aligned and sized (SPEC 3, *Which candidate*)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from heapq import heappop, heappush
from itertools import islice, product
from math import inf

from ..design.model import Counter, Symbol
from .candidates import Candidate, CandidateStream, candidates, rows_of
from .columns import EPS, Group, lone_unsized, make_group
from .events import CandidateJudged, Trace, WordJudged
from .ida import search_ida
from .letters import Word
from .objective import Objective
from .pricing import Priced
from .problem import AxisProblem
from .search import BestFirst, Stopped, plunge
from .sizing import Sized, size_axis
from .words import Instances, instances

__all__ = ["AxisSearch", "Solved"]

_TIES = 4
_NODES = 1_000_000
_TOLD = 2000
"""So many candidates that were never taken up are told in a trace."""
_STEP = 0.004
"""How far above its lower bound a candidate goes first, as a fraction of the canvas."""
_GROWTH = 1.5
"""Each turn takes it so many times further."""


@dataclass(frozen=True, slots=True)
class Solved:
    """A candidate, aligned and sized.

    Attributes
    ----------
    cost, columns
        J and the number of columns, summed over groups.
    groups, parts
        The groups as they were aligned; per group the priced structure it is part of, and its number there.
    """

    candidate: Candidate
    groups: tuple[Group, ...]
    parts: tuple[tuple[Priced, int], ...]
    sized: Sized
    cost: float
    columns: int

    def beats(self, other: Solved | None) -> bool:
        """Least cost, then most columns, then least deviation."""
        if other is None or self.cost < other.cost - EPS:
            return True
        if self.cost > other.cost + EPS:
            return False
        if self.columns != other.columns:
            return self.columns > other.columns
        return self.sized.deviation < other.sized.deviation - EPS


@dataclass(slots=True)
class Best:
    """The best of some candidates: what was found, what is proven, and whether the search was cut short."""

    solved: Solved | None = None
    bound: float = inf
    complete: bool = True
    unsizable: bool = False

    @property
    def cost(self) -> float:
        """J of the best so far; infinite without one."""
        return inf if self.solved is None else self.solved.cost


class _Run:
    """The search of one cluster of groups, by either method, shared by all candidates that give it the same words."""

    def __init__(
        self,
        groups: Sequence[Group],
        method: str,
        nodes: int,
        check: Callable[[], None] | None,
        accept: Callable[[Priced], bool] | None,
    ) -> None:
        self.groups = groups
        self._ida = (
            (lambda limit: search_ida(groups, cap=limit, keep=_TIES, nodes=nodes, check=check, accept=accept))
            if (method == "ida")
            else None
        )
        self._first = BestFirst(groups, keep=_TIES, nodes=nodes, check=check, accept=accept)
        self._found = self._first.found
        self.done = self._first.done

    def advance(self, limit: float) -> None:
        """Find the optimum, if it costs no more than `limit`."""
        if self.done or limit < self._found.bound - EPS:
            return
        if self._ida is None:
            self._first.advance(limit)
            self.done = self._first.done
        else:
            self._found = self._ida(limit)
            self.done = bool(self._found.ties) or self._found.bound == inf or self._found.cut

    @property
    def ties(self) -> list[Priced]:
        """The optimal structures; empty where they are not known, or there are none."""
        return self._found.ties if self.done else []

    @property
    def floor(self) -> float:
        """Proven lower bound."""
        return self._found.bound

    @property
    def cut(self) -> bool:
        """It gave up."""
        return self._found.cut


@dataclass(slots=True)
class _Case:
    """A candidate being solved."""

    candidate: Candidate
    least: float
    groups: list[Group] = field(default_factory=list)
    clusters: list[list[int]] = field(default_factory=list)
    runs: list[_Run] = field(default_factory=list)
    solved: Solved | None = None
    unsizable: bool = False

    @property
    def floor(self) -> float:
        """Lower bound of its J."""
        return max(self.least, sum(run.floor for run in self.runs))


@dataclass(slots=True)
class AxisSearch:
    """The search on one axis at one tolerance, with what it has learnt so far."""

    problem: AxisProblem
    objective: Objective
    tolerance: float
    method: str = "best"
    check: Callable[[], None] | None = None
    trace: Trace | None = None
    extend: Callable[[], None] | None = None
    found: dict[str, Instances] = field(default_factory=dict)
    cases: list[_Case] = field(default_factory=list)
    runs: dict[object, _Run] = field(default_factory=dict)
    stream: CandidateStream | None = None

    def enumerate(self) -> None:
        """List the words that fit."""
        symbols = self.problem.symbol
        counters = dict(self.problem.counters)
        for name, pattern in self.problem.patterns:
            self.found[name] = instances(
                pattern,
                lambda s: symbols.get(s) or Symbol(s),
                lambda c: counters.get(c) or Counter(c),
                self.problem.canvas + self.tolerance,
                self.check,
                None if self.objective.plain else self.problem.canvas,
            )
            if self.trace is not None:
                self._tell_words(self.trace, name)
        self.stream = self._stream()

    def _stream(self) -> CandidateStream:
        return CandidateStream(self.problem, self.words(), self.tolerance, self.objective, self.check)

    def words(self) -> dict[str, Sequence[Word]]:
        """Words by pattern."""
        return {name: found.words for name, found in self.found.items()}

    def restricted(self, values: Mapping[str, int]) -> AxisSearch:
        """The same search with some counters held; what has been aligned is shared."""
        found = {
            name: replace(
                own,
                words=tuple(
                    w for w in own.words if all(values.get(c, v) == v for c, v in w.counters.items())
                ),
            )
            for name, own in self.found.items()
        }
        other = AxisSearch(
            self.problem,
            self.objective,
            self.tolerance,
            self.method,
            self.check,
            self.trace,
            self.extend,
            found,
            runs=self.runs,
        )
        other.stream = other._stream()
        return other

    @property
    def floor(self) -> float:
        """Lower bound of J over all candidates."""
        return (self.stream or self._stream()).bound

    def case(self, candidate: Candidate) -> _Case:
        """A candidate to be solved."""
        return _Case(candidate, candidate.bound)

    def forget(self) -> None:
        """Let go of what only searching needs, so that a kept answer is small."""
        for case in self.cases:
            for group in case.groups:
                group.edges.clear()
        self.cases.clear()
        self.runs.clear()
        self.stream = None

    def in_order(self) -> Iterator[Candidate]:
        """Candidates in lexicographic order, as the paper takes them."""
        return candidates(self.problem, self.words(), self.tolerance, self.objective, self.check)

    def _tell_words(self, trace: Trace, name: str) -> None:
        for word in self.found[name].words:
            trace.events.append(
                WordJudged(
                    self.problem.axis,
                    name,
                    str(word),
                    word.size,
                    dict(word.counters),
                    True,
                    "fits the canvas",
                )
            )

    def best(self, cap: float = inf) -> Best:
        """The best candidate; candidates take turns.

        The one with the least lower bound goes on a little and comes back into the queue with what it has then
        been proven to cost at least. So no time is spent on the dear alignments of one candidate while another
        may have a cheap one, and when the least lower bound is above the best answer, that is optimal.
        """
        best = Best()
        stream = self.stream or self._stream()
        queue: list[tuple[float, int]] = []
        steps: list[float] = []
        floor = 0.0
        try:
            while True:
                top = min(cap, best.cost)
                while stream.bound <= min(top, queue[0][0] if queue else inf) + EPS:
                    candidate = stream.take()
                    if candidate is None:
                        break
                    heappush(queue, (candidate.bound, len(self.cases)))
                    self.cases.append(self.case(candidate))
                    steps.append(_STEP * self.problem.canvas)
                floor = min(stream.bound, queue[0][0] if queue else inf)
                if not queue or queue[0][0] > top + EPS:
                    break
                if self.check is not None:
                    self.check()
                own, n = queue[0]
                limit = min(top, own + steps[n])
                steps[n] *= _GROWTH
                case = self.cases[n]
                solved = self.solve(case, limit)
                heappop(queue)
                best.unsizable = best.unsizable or case.unsizable
                best.complete = best.complete and not any(run.cut for run in case.runs)
                if solved is not None:
                    best.bound = min(best.bound, case.floor)
                    if solved.beats(best.solved):
                        best.solved = solved
                elif case.floor < inf and not all(run.done for run in case.runs):
                    # where the limit was the best answer's cost, nothing as good is left in this candidate
                    beyond = top + 2 * EPS if limit >= top else own
                    heappush(queue, (max(beyond, case.floor), n))
        except Stopped as stop:
            best.complete = False
            if stop.asked:
                best.bound = min(best.bound, floor)
                return best
        if best.solved is None and not best.complete:
            best.solved = self._hasty()
        best.bound = min(best.bound, floor, self._left_out())
        self._tell_fates(best)
        return best

    def _hasty(self) -> Solved | None:
        """Any layout of one of the likeliest candidates, for when the time is up and there is none yet."""
        best: Solved | None = None
        if self.extend is not None:
            self.extend()
        likely = sorted(self.cases, key=lambda case: case.floor)[:3]
        try:
            if not likely:
                stream = CandidateStream(
                    self.problem, self.words(), self.tolerance, self.objective, self.check
                )
                candidate = stream.take()
                likely = [] if candidate is None else [self.case(candidate)]
            for case in likely:
                if not case.runs:
                    self._open(case)
                parts = [plunge([case.groups[g] for g in cluster], self.check) for cluster in case.clusters]
                found = [[priced] for priced in parts if priced is not None]
                solved = self._size(case, found) if len(found) == len(parts) else None
                if solved is not None and solved.beats(best):
                    best = solved
        except Stopped:
            pass  # what was found until now is all there is
        return best

    def _left_out(self) -> float:
        """No candidate with a word that was left out, for there are too many, costs less than this."""
        bound = inf
        for _, names in self.problem.groups:
            weight = min(self.objective.empty, self.objective.loose) / len(set(names))
            left = min(self.found[name].left for name in names)
            bound = min(bound, min(self.objective.fit, weight) * left)
        return bound

    def _tell_fates(self, best: Best) -> None:
        if self.trace is None:
            return
        for case in self.cases:
            solved = case.solved
            fate = "bound"
            if solved is not None and best.solved is not None:
                tied = solved.cost <= best.solved.cost + EPS
                fate = "best" if solved is best.solved else "tied" if tied else "dearer"
            elif case.unsizable:
                fate = "no sizes"
            elif case.runs and all(run.done for run in case.runs):
                fate = "no alignment"
            self._tell(self.trace, case.candidate, fate, solved)
        stream = self.stream or self._stream()
        for _ in range(_TOLD):
            candidate = stream.take()
            if candidate is None:
                break
            self._tell(self.trace, candidate, "bound", None)

    def _tell(self, trace: Trace, candidate: Candidate, fate: str, solved: Solved | None) -> None:
        trace.events.append(
            CandidateJudged(
                self.problem.axis,
                {name: str(word) for name, word in candidate.words.items()},
                dict(candidate.counters),
                candidate.bound,
                fate,
                solved.cost if solved else None,
                solved.columns if solved else None,
                solved.sized.deviation if solved else None,
            )
        )

    def solve(self, case: _Case, limit: float = inf) -> Solved | None:
        """Align a candidate in all groups, each within what the others leave of the limit, and size it.

        None: there is nothing within the limit; `case.floor` says how much more is known.
        """
        if not case.runs:
            self._open(case)
        for run in case.runs:
            run.advance(limit - case.floor + run.floor)
            if not run.ties:
                return None
        if case.solved is None:
            case.solved = self._size(case, [run.ties for run in case.runs])
        if case.solved is None and not case.unsizable:
            case.unsizable = True
            case.clusters = [
                list(range(len(case.groups)))
            ]  # which structures fit each other is asked as they come
            case.runs = [self._run(case.groups, lambda priced: self._size(case, [[priced]]) is not None)]
            return self.solve(case, limit)
        return case.solved

    def _open(self, case: _Case) -> None:
        """Find the candidate's groups, and the searches that other candidates share with it."""
        case.groups, case.clusters = self._groups(case.candidate)
        for cluster in case.clusters:
            key = tuple(group.identity for group in (case.groups[g] for g in cluster))
            run = self.runs.get(key)
            if run is None:
                run = self.runs[key] = self._run([case.groups[g] for g in cluster], None)
            case.runs.append(run)
            for g, group in zip(cluster, run.groups, strict=True):
                case.groups[g] = group

    def _run(self, groups: Sequence[Group], accept: Callable[[Priced], bool] | None) -> _Run:
        nodes = _NODES if accept is None else _NODES // 50
        return _Run(groups, self.method, nodes, self.check, accept)

    def _groups(self, candidate: Candidate) -> tuple[list[Group], list[list[int]]]:
        """The groups of a candidate, and which of them share an unsized symbol and so are aligned together."""
        flat = iter(
            rows_of(self.problem, candidate.words, [n for _, names in self.problem.groups for n in names])
        )
        rows = [[next(flat) for _ in names] for _, names in self.problem.groups]
        unsized = [{a.symbol for row in own for a in row if a.size is None} for own in rows]
        clusters: list[list[int]] = []
        for g, symbols in enumerate(unsized):
            joined = [c for c in clusters if any(unsized[o] & symbols for o in c)]
            clusters = [c for c in clusters if c not in joined]
            clusters.append(sorted([g, *(o for c in joined for o in c)]))
        groups: list[Group] = [None] * len(rows)  # type: ignore[list-item]
        for cluster in clusters:
            free = lone_unsized(*(dict.fromkeys(rows[g]) for g in cluster))
            for g in cluster:
                groups[g] = make_group(
                    rows[g],
                    self.problem.canvas,
                    self.tolerance,
                    self.objective,
                    free=free,
                    check=self.check,
                )
        return groups, clusters

    def _size(self, case: _Case, ties: Sequence[Sequence[Priced]]) -> Solved | None:
        """Size every combination of equally good structures; the least deviation wins."""
        symbols = self.problem.symbol
        best: Solved | None = None
        for combination in islice(product(*ties), 2 * _TIES):
            parts: dict[int, tuple[Priced, int]] = {}
            for cluster, priced in zip(case.clusters, combination, strict=True):
                parts.update({g: (priced, k) for k, g in enumerate(cluster)})
            own = tuple(parts[g] for g in range(len(case.groups)))
            sized = size_axis(case.groups, own, self.problem.canvas, lambda s: symbols.get(s) or Symbol(s))
            if sized is None:
                continue
            solved = Solved(
                case.candidate,
                tuple(case.groups),
                own,
                sized,
                sum(p.cost for p in combination),
                sum(p.columns for p in combination),
            )
            if solved.beats(best):
                best = solved
        return best
