"""One axis: from its words to the best candidate, aligned and sized (SPEC 3, *Which candidate*)."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from heapq import heappop, heappush
from itertools import islice, product
from math import inf

from ..design.model import Symbol
from .candidates import Candidate, CandidateStream, candidates, inputs_of, rows_of
from .clock import Progress
from .columns import EPS, Group, lone_unsized, make_group
from .compiled import CompiledDives, CompiledSearch, best_first, dives, start_afresh
from .dive import Dives
from .ida import search_ida
from .instances import Instances, Range
from .keeping import Kept
from .letters import Letter, Word
from .objective import Objective
from .pricing import Priced
from .problem import AxisProblem
from .search import BestFirst, Found, Stopped
from .sizing import Sized, size_axis
from .sweeping import can_sweep, sweeps
from .tracing import Recorder, Walk, sizing
from .words import axis_words

__all__ = ["AxisSearch", "Best", "Solved", "forget_groups"]

_TIES = 4
_NODES = 1_000_000
_STEP = 0.004
"""How far above its lower bound a candidate goes first, as a fraction of the canvas."""
_GROWTH = 1.5
"""Each turn takes it so many times further."""
_TURN = 150
"""After so many paths a search gives way to those of other candidates."""
_SLOW = 0.03
"""A search that takes more seconds than this is helped by sweeps."""
_LONG = 3_000
"""A search of more paths than this is a long one, and dives help it."""

_kept: Kept[tuple[list[Priced], float]] = Kept(512)
"""What has been found for groups, so that those that an edit leaves alone are not searched again."""


def forget_groups() -> None:
    """Let go of all that is kept for unchanged groups."""
    _kept.clear()


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
        """Least cost, then most columns, then least deviation, then the first by counters and words."""
        if other is None or self.cost < other.cost - EPS:
            return True
        if self.cost > other.cost + EPS:
            return False
        if self.columns != other.columns:
            return self.columns > other.columns
        if abs(self.sized.deviation - other.sized.deviation) > EPS or self.candidate is other.candidate:
            return self.sized.deviation < other.sized.deviation - EPS
        return self.candidate.rank < other.candidate.rank


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
    """The search of one cluster of groups, by either method, shared by all candidates that give it the same words.

    Among structures that are equally good, which come first depends on the limits that a search went through. So
    it goes through the same ones every time, each further from its lower bound by `_GROWTH`. Where the best answer
    so far allows less than the next of them it goes no further than that; if it ends there with more answers than
    are kept, the search is repeated in steps. That makes an answer the same whatever was searched before.

    A search that takes long is helped by sweeps, where there are no wildcards, and by dives, which take as long again.
    """

    def __init__(
        self,
        groups: Sequence[Group],
        method: str,
        nodes: int,
        check: Callable[[], None] | None,
        accept: Callable[[Priced], bool] | None,
        log: Walk | None = None,
        known: tuple[list[Priced], float] | None = None,
        fits: Callable[[Priced], bool] | None = None,
    ) -> None:
        self.groups, self.log, self._fits = groups, log, fits
        self._options = (method, nodes, check, accept)
        self._dives: Dives | CompiledDives | None = None
        self._sweeps = sweeps(groups[0], check) if accept is None and can_sweep(groups) else None
        self._swept: Priced | None = None
        self._spent = self._dived = 0.0
        self._again = False
        if known is None:
            self._begin()
        else:
            self._found, self.done = Found(*known), True

    def _begin(self) -> None:
        method, nodes, check, accept = self._options
        self._first: BestFirst | CompiledSearch | None = best_first(
            self.groups, keep=_TIES, nodes=nodes, check=check, accept=accept, log=self.log, turn=_TURN
        )
        self._ida = method == "ida"
        self._found, self.done = self._first.found, self._first.done
        self._base = self._found.bound
        self._step = _STEP * max((group.canvas for group in self.groups), default=1.0)
        self._stepwise = True
        self._goal: float | None = None

    def advance(self, limit: float, top: float = inf) -> None:
        """Find the optimum, if it costs no more than `limit`; nothing above `top` is of any use."""
        if self.done or limit < self._found.bound - EPS:
            return
        begin = time.perf_counter()
        if self.log is None:
            self._go_on(limit, top)
        else:
            with self.log.turn():
                self._go_on(limit, top)
            self.log.known(self.floor, len(self.ties), self.cut)
        self._spent += time.perf_counter() - begin
        self._tidy()

    def _tidy(self) -> None:
        if self.done:
            self._first = self._dives = None  # they take much memory

    @property
    def long(self) -> bool:
        """The search has taken long."""
        slow = self._sweeps is not None and self._spent > _SLOW
        return not self.done and (slow or self._found.nodes >= _LONG)

    def dive(self, *, at_once: bool = False) -> None:
        """Look for some alignment as long as the search has taken; or, `at_once`, until there is one."""
        _, _, check, accept = self._options
        if self.done or accept is not None:
            return
        if self._sweeps is not None:
            for priced in self._sweeps:
                if self._fits is None or self._fits(priced):
                    self._swept = priced
            self._sweeps = None
        if self._found.nodes < _LONG and self._swept is not None:
            return
        if self._dives is None:
            self._dives = dives(self.groups, self.floor, check, self._fits)
            if self._swept is not None:
                self._dives.offer(self._swept)
        begin, before = time.perf_counter(), self._dived
        while not self._dives.done and (self._dived <= self._spent or (at_once and self._dives.best is None)):
            self._dives.dive()
            self._dived = before + time.perf_counter() - begin

    def give_up(self) -> None:
        """Let go of the search, but not of what it has found."""
        if not self.done:
            self._first = self._dives = None

    @property
    def known(self) -> list[Priced]:
        """The optimal structures; else the best so far."""
        best = self._swept if self._dives is None else self._dives.best
        return self.ties or ([best] if best is not None else [])

    def _go_on(self, limit: float, top: float) -> None:
        if self._ida and limit == inf:  # it deepens by itself, from the start in every step
            self._go_to(inf)
        while not self.done:
            if self._goal is None:
                rung = self._base + self._step
                if rung > top and not self._again:
                    self._stepwise, self._goal = False, limit
                else:
                    self._step, self._goal = self._step * _GROWTH, rung
            goal = self._goal
            self._go_to(goal)
            if self.paused:
                return
            self._goal = None
            if goal >= limit:
                break
        if self.done and not self._stepwise and len(self._found.ties) >= _TIES:
            self._again = True
            self._begin()
            self._go_on(limit, top)
        elif self.done and not self._ida:
            self._found.ties.sort(key=_in_order)

    @property
    def paused(self) -> bool:
        """It has not come to the end of what it was asked for."""
        return not self.done and self._first is not None and self._first.paused

    def _go_to(self, limit: float) -> None:
        if not self._ida:
            assert self._first is not None, "a search that was given up is not gone on with"
            self._first.advance(limit)
            self.done = self._first.done
        else:
            _, nodes, check, accept = self._options
            self._found = search_ida(
                self.groups,
                cap=limit,
                keep=_TIES,
                nodes=nodes,
                check=check,
                accept=accept,
                observer=self.log,
            )
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
    dived: bool = False

    @property
    def floor(self) -> float:
        """Lower bound of its J."""
        return max(self.least, sum(run.floor for run in self.runs))


class _Rows:
    """The rows of a group, and the words they were made of (which keeps those, and so their identities, alive)."""

    __slots__ = ("letters", "unsized", "words")

    def __init__(self, letters: list[tuple[Letter, ...]], words: tuple[Word, ...]) -> None:
        self.letters, self.words = letters, words
        self.unsized = {letter.symbol for row in letters for letter in row if letter.size is None}


@dataclass(slots=True)
class AxisSearch:
    """The search on one axis at one tolerance, with what it has learnt so far."""

    problem: AxisProblem
    objective: Objective
    tolerance: float
    method: str = "best"
    check: Callable[[], None] | None = None
    trace: Recorder | None = None
    extend: Callable[[], None] | None = None
    progress: Progress = field(default_factory=Progress)
    found: dict[str, Instances] = field(default_factory=dict)
    cases: list[_Case] = field(default_factory=list)
    runs: dict[object, _Run] = field(default_factory=dict)
    rows: dict[object, _Rows] = field(default_factory=dict)
    by_words: dict[object, _Run] = field(default_factory=dict)
    inputs: list[tuple[str, ...]] | None = None
    stream: CandidateStream | None = None

    def enumerate(self, across: Mapping[str, Range] | None = None) -> None:
        """List the words that fit; `across` is what the other axis says of counters."""
        self.found.update(axis_words(self.problem, self.tolerance, self.progress, self.check, across))
        if self.trace is not None:
            self.trace.words(self.problem, self.found, self.tolerance)
        self.progress.at("candidates", self.problem.axis)
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
            self.progress,
            found,
            runs=self.runs,
            rows=self.rows,
            by_words=self.by_words,
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
        """Let go of what only searching needs, so that a kept answer is small, and keep what groups have in common."""
        for key, run in self.runs.items():
            if run.done and not run.cut:
                _kept.put(self._known_as(key), (run.ties, run.floor))
        for case in self.cases:
            for group in case.groups:
                group.edges.clear()
        self.cases.clear()
        self.runs.clear()
        self.rows.clear()
        self.by_words.clear()
        self.stream = None

    def in_order(self) -> Iterator[Candidate]:
        """Candidates in lexicographic order, as the paper takes them."""
        return candidates(self.problem, self.words(), self.tolerance, self.objective, self.check)

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
        floor, dived = 0.0, False
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
                self.progress.at("alignment", self.problem.axis, candidate=n + 1, of=len(self.cases))
                solved = self._turn(case, limit, top)
                heappop(queue)
                best.unsizable = best.unsizable or case.unsizable
                best.complete = best.complete and not any(run.cut for run in case.runs)
                if solved is not None:
                    best.bound = min(best.bound, case.floor)
                    # what a dive came upon is no better than others that cost the same
                    if solved.beats(best.solved) or (dived and solved.cost <= best.cost + EPS):
                        best.solved, dived = solved, False
                elif case.floor < inf and not all(run.done for run in case.runs):
                    # where the limit was the best answer's cost, nothing as good is left in this candidate
                    paused = any(run.paused for run in case.runs)
                    beyond = top + 2 * EPS if limit >= top and not paused else own
                    heappush(queue, (max(beyond, case.floor), n))
                    improved = self._dive(case, best.cost)
                    if improved is not None:
                        best.solved, dived = improved, True
        except Stopped as stop:
            best.complete = False
            if stop.asked:
                best.bound = min(best.bound, floor)
                return best
        if best.solved is None and not best.complete:
            best.solved = self._hasty()
        best.bound = min(best.bound, floor, self._left_out())
        return best

    def _hasty(self) -> Solved | None:
        """Any layout of one of the likeliest candidates, for when the time is up and there is none yet."""
        best: Solved | None = None
        if self.extend is not None:
            self.extend()
        likely = sorted(self.cases, key=lambda case: case.floor)[:3]
        if start_afresh():
            for case in self.cases:
                for run in case.runs:
                    run.give_up()
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
                solved = self._dive(case, inf if best is None else best.cost, at_once=True)
                if solved is not None:
                    best = solved
        except Stopped:
            pass  # what was found until now is all there is
        return best

    def _dive(self, case: _Case, cost: float, *, at_once: bool = False) -> Solved | None:
        """A layout of the candidate that costs less than `cost`, by structures that may not be the best."""
        if not at_once and not any(run.long for run in case.runs):
            return None
        before = sum(known[0].cost for run in case.runs if (known := run.known))
        for run in case.runs:
            run.dive(at_once=at_once or not run.long)
        found = [run.known for run in case.runs]
        if not all(found):
            return None
        total = sum(known[0].cost for known in found)
        if total >= cost - EPS or (total >= before - EPS and case.dived):
            return None
        case.dived = True
        return self._size(case, found)

    def _left_out(self) -> float:
        """No candidate with a word that was left out, for there are too many, costs less than this."""
        bound = inf
        for _, names in self.problem.groups:
            weight = min(self.objective.empty, self.objective.loose) / len(set(names))
            left = min(self.found[name].left for name in names)
            bound = min(bound, min(self.objective.fit, weight) * left)
        return bound

    def solve(self, case: _Case) -> Solved | None:
        """Align a candidate in all groups and size it; None: it cannot be done."""
        solved = self._turn(case)
        while solved is None and any(run.paused for run in case.runs):
            solved = self._turn(case)
        return solved

    def _turn(self, case: _Case, limit: float = inf, top: float = inf) -> Solved | None:
        """Align a candidate in all groups, each within what the others leave of the limit, and size it.

        A little more than the limit may be looked at, but nothing that costs more than `top`.

        None: there is nothing within the limit; `case.floor` says how much more is known.
        """
        if not case.runs:
            self._open(case)
        for run, cluster in zip(case.runs, case.clusters, strict=True):
            self.progress.group = self.problem.groups[cluster[0]][0]
            others = case.floor - run.floor
            run.advance(limit - others, top - others)
            if not run.ties:
                return None
        if case.solved is None:
            case.solved = self._size(case, [run.ties for run in case.runs])
        if case.solved is None and not case.unsizable:
            case.unsizable = True
            case.clusters = [
                list(range(len(case.groups)))
            ]  # which structures fit each other is asked as they come
            own = range(len(case.groups))
            case.runs = [self._run(case.groups, lambda priced: self._size(case, [[priced]]) is not None, own)]
            return self._turn(case, limit, top)
        return case.solved

    def _open(self, case: _Case) -> None:
        """Find the candidate's groups, and the searches that other candidates share with it."""
        rows, keys, clusters = self._rows(case.candidate)
        groups: list[Group | None] = [None] * len(rows)
        runs: list[_Run] = []
        for cluster in clusters:
            run = self._same_words(rows, cluster, tuple(keys[g] for g in cluster))
            runs.append(run)
            for g, group in zip(cluster, run.groups, strict=True):
                groups[g] = group
        case.clusters, case.groups = clusters, [group for group in groups if group is not None]
        case.runs = runs  # all of them or none: the clock may have stopped this before

    def _same_words(self, rows: Sequence[_Rows], cluster: Sequence[int], words: object) -> _Run:
        """The search of a cluster: the one that there is for the same words, or others with the same letters."""
        run = self.by_words.get(words)
        if run is None:
            free = lone_unsized(*(dict.fromkeys(rows[g].letters) for g in cluster))
            groups = [
                make_group(
                    rows[g].letters,
                    self.problem.canvas,
                    self.tolerance,
                    self.objective,
                    free=free,
                    check=self.check,
                )
                for g in cluster
            ]
            key = tuple(group.identity for group in groups)
            run = self.runs.get(key)
            if run is None:
                known = _kept.get(self._known_as(key)) if self.trace is None else None
                run = self.runs[key] = self._run(groups, None, cluster, known)
            self.by_words[words] = run
        return run

    def _run(
        self,
        groups: Sequence[Group],
        accept: Callable[[Priced], bool] | None,
        cluster: Iterable[int],
        known: tuple[list[Priced], float] | None = None,
    ) -> _Run:
        nodes = _NODES if accept is None else _NODES // 50
        log = None
        if self.trace is not None:
            names = [self.problem.groups[g][0] for g in cluster]
            log = self.trace.walk(self.problem.axis, names, groups, self.method)

        def fits(priced: Priced) -> bool:
            parts = tuple((priced, k) for k in range(len(groups)))
            return size_axis(groups, parts, self.problem.canvas, self._symbol) is not None

        return _Run(groups, self.method, nodes, self.check, accept, log, known, fits)

    def _symbol(self, name: str) -> Symbol:
        return self.problem.symbol.get(name) or Symbol(name)

    def _known_as(self, key: object) -> object:
        return key, self.problem.canvas, self.tolerance, self.objective, self.method

    def _rows(self, candidate: Candidate) -> tuple[list[_Rows], list[object], list[list[int]]]:
        """The rows of each group, what they depend on, and which groups are aligned together.

        Those are that share an unsized symbol.
        """
        if self.inputs is None:
            self.inputs = inputs_of(self.problem)
        rows: list[_Rows] = []
        keys: list[object] = []
        for g, (names, (_, standing)) in enumerate(zip(self.inputs, self.problem.groups, strict=True)):
            words = tuple(candidate.words[name] for name in names)
            key = (g, *map(id, words))
            own = self.rows.get(key)
            if own is None:
                own = self.rows[key] = _Rows(rows_of(self.problem, candidate.words, standing), words)
            rows.append(own)
            keys.append(key)
        clusters: list[list[int]] = []
        for g, one in enumerate(rows):
            joined = [c for c in clusters if any(rows[o].unsized & one.unsized for o in c)]
            clusters = [c for c in clusters if c not in joined]
            clusters.append(sorted([g, *(o for c in joined for o in c)]))
        return rows, keys, clusters

    def _size(self, case: _Case, ties: Sequence[Sequence[Priced]]) -> Solved | None:
        """Size every combination of equally good structures; the least deviation wins."""
        best: Solved | None = None
        for combination in islice(product(*ties), 2 * _TIES):
            parts: dict[int, tuple[Priced, int]] = {}
            for cluster, priced in zip(case.clusters, combination, strict=True):
                parts.update({g: (priced, k) for k, g in enumerate(cluster)})
            own = tuple(parts[g] for g in range(len(case.groups)))
            with sizing(self.trace, self.problem.axis):
                sized = size_axis(case.groups, own, self.problem.canvas, self._symbol)
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


def _in_order(priced: Priced) -> tuple[tuple[tuple[tuple[int, ...], ...], ...], ...]:
    """Equally good structures have an order of their own."""
    return tuple(
        tuple(tuple(option.letters for option in column) for column in columns)
        for columns in priced.structure
    )
