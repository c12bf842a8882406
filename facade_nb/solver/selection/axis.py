"""One axis: from its words to the best candidate, aligned and sized (docs/problem.md, *Which candidate*)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from heapq import heappop, heappush, heapreplace
from itertools import islice, product
from math import inf

from .. import tuning
from ..alignment.group import Group
from ..alignment.pricing import Priced
from ..budget import Progress, Stopped
from ..candidates.bounds import GroupKey
from ..candidates.stream import Candidate, CandidateStream, candidates
from ..effort import Effort
from ..model.letters import Word
from ..model.objective import Objective
from ..model.precision import EPS
from ..model.problem import AxisProblem
from ..sizing.system import Sized, size_axis
from ..words.enumeration import axis_words
from ..words.instances import Instances, Range
from .anytime import Anytime
from .clusters import GroupSearch
from .observer import AxisObserver, sizing
from .searches import Searches, Setting, weight_of

__all__ = ["AxisSearch", "Best", "Case", "Solved"]


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

    @property
    def weight(self) -> float:
        """Bytes that it takes, about."""
        system = self.sized.system
        letters = sum(len(band.letters) for group in self.groups for band in group.bands)
        return (
            tuning.LETTER_BYTES * letters
            + sum({id(priced): weight_of(priced) for priced, _ in self.parts}.values())
            + system.matrix.nbytes
            + 200 * len(system.lower)
        )

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
    full: bool = False
    """It was cut short for want of memory."""
    whole: bool = True
    """No word was left out; else nothing is proven of the first candidate that aligns, in lexicographic order."""

    @property
    def cost(self) -> float:
        """J of the best so far; infinite without one."""
        return inf if self.solved is None else self.solved.cost


@dataclass(slots=True)
class Case:
    """A candidate being solved."""

    candidate: Candidate
    least: float
    groups: list[Group] = field(default_factory=list)
    clusters: list[list[int]] = field(default_factory=list)
    keys: list[GroupKey] = field(default_factory=list)
    runs: list[GroupSearch] = field(default_factory=list)
    solved: Solved | None = None
    unsizable: bool = False
    dived: float = inf

    @property
    def floor(self) -> float:
        """Lower bound of its J."""
        return max(self.least, sum(run.floor for run in self.runs))


class AxisSearch:
    """The search on one axis at one tolerance.

    Attributes
    ----------
    setting
        What is asked for; never changed.
    searches
        The searches of groups, which candidates share; so do searches with some counters held (`restricted`).
    found
        The words of each pattern, once they are listed (`enumerate`).
    cases
        The candidates that have been taken up, by `best`.
    stream
        Where the next ones come from.
    """

    __slots__ = ("cases", "found", "searches", "setting", "soon", "stream")

    def __init__(
        self,
        problem: AxisProblem,
        objective: Objective,
        tolerance: float,
        method: str = "best",
        check: Callable[[], None] | None = None,
        trace: AxisObserver | None = None,
        extend: Callable[[], None] | None = None,
        progress: Progress | None = None,
        found: Mapping[str, Instances] | None = None,
    ) -> None:
        effort = check if isinstance(check, Effort) else Effort(check)
        self.setting = Setting(
            problem, objective, tolerance, method, effort, trace, extend, progress or Progress()
        )
        self.searches = Searches(self.setting)
        self.found = dict(found or {})
        self.cases: list[Case] = []
        self.stream: CandidateStream | None = None
        self.soon = Anytime()

    @property
    def problem(self) -> AxisProblem:
        """What the axis asks."""
        return self.setting.problem

    @property
    def objective(self) -> Objective:
        """What is minimised."""
        return self.setting.objective

    @property
    def tolerance(self) -> float:
        """μ, metres."""
        return self.setting.tolerance

    @property
    def method(self) -> str:
        """``"best"`` or ``"ida"``."""
        return self.setting.method

    @property
    def check(self) -> Effort:
        """Called now and then; counts what is done."""
        return self.setting.check

    @property
    def trace(self) -> AxisObserver | None:
        """Who watches."""
        return self.setting.trace

    @property
    def progress(self) -> Progress:
        """How far the call has come."""
        return self.setting.progress

    def enumerate(self, across: Mapping[str, Range] | None = None) -> None:
        """List the words that fit; `across` is what the other axis says of counters."""
        self.found.update(axis_words(self.problem, self.tolerance, self.progress, self.check, across))
        if self.trace is not None:
            self.trace.words(self.problem, self.found, self.tolerance)
        self.progress.at("candidates", self.problem.axis)
        self.stream = self.fresh_stream()

    def fresh_stream(self) -> CandidateStream:
        """All candidates, by growing lower bound."""
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
        other = AxisSearch.__new__(AxisSearch)
        other.setting, other.searches, other.found = self.setting, self.searches, found
        other.cases, other.soon = [], Anytime()
        other.stream = other.fresh_stream()
        return other

    @property
    def floor(self) -> float:
        """Lower bound of J over all candidates."""
        return (self.stream or self.fresh_stream()).bound

    def case(self, candidate: Candidate) -> Case:
        """A candidate to be solved."""
        return Case(candidate, candidate.bound)

    def start_over(self) -> None:
        """Be ready to go through all candidates once more; what has been learnt of their groups stays."""
        self.stream = self.fresh_stream()
        self.cases.clear()

    def forget(self) -> None:
        """Let go of what only searching needs, so that a kept answer is small, and keep what groups have in common."""
        self.searches.keep()
        self.leave()
        self.searches.clear()
        # of the words, what is said about them is enough
        self.found.update({name: replace(own, words=()) for name, own in self.found.items()})

    def leave(self) -> None:
        """Let go of its candidates, so that nothing refers to itself and waits for the garbage collector."""
        for group in {id(own): own for case in self.cases for own in case.groups}.values():
            group.forget()
        for case in self.cases:
            case.runs.clear()
        self.cases.clear()
        self.soon.forget()
        self.soon = Anytime()
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
        stream = self.stream = self.stream or self.fresh_stream()
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
                    steps.append(tuning.FIRST_STEP * self.problem.canvas)
                floor = min(stream.bound, queue[0][0] if queue else inf)
                if not queue or queue[0][0] > top + EPS:
                    break
                if self.check is not None:
                    self.check()
                own, n = queue[0]
                if (
                    own + EPS < self.cases[n].floor < inf
                ):  # what it shares with others has become known meanwhile
                    heapreplace(queue, (self.cases[n].floor, n))
                    continue
                limit = min(top, own + steps[n])
                if self.method == "ida" and len(queue) == 1 and stream.bound == inf:
                    limit = top  # nobody else has a turn: it deepens by itself, and does not begin anew in every step
                steps[n] *= tuning.STEP_GROWTH
                case = self.cases[n]
                self.progress.at("alignment", self.problem.axis, candidate=n + 1, of=len(self.cases))
                solved = self._turn(case, limit, top)
                heappop(queue)
                best.unsizable = best.unsizable or case.unsizable
                if any(run.cut for run in case.runs):
                    best.complete = False
                    best.bound = min(best.bound, case.floor)
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
                    improved = self.soon.dive(self, case, best.cost) or self.soon.around(self, best.cost)
                    if improved is not None:
                        best.solved, dived = improved, True
        except Stopped as stop:
            best.complete = False
            if stop.asked:
                best.bound = min(best.bound, floor)
                return best
            best.full = stop.full
        except MemoryError:
            best.complete, best.full = False, True
        if not best.complete:
            best.solved = self.soon.hasty(self, best.solved)
        best.bound = min(best.bound, floor, self.left_out)
        return best

    @property
    def whole(self) -> bool:
        """No word was left out."""
        return all(found.left == inf for found in self.found.values())

    @property
    def left_out(self) -> float:
        """No candidate with a word that was left out, for there are too many, costs less than this."""
        bound = inf
        for _, names in self.problem.groups:
            weight = min(self.objective.empty, self.objective.loose) / len(set(names))
            left = min(self.found[name].left for name in names)
            bound = min(bound, min(self.objective.fit, weight) * left)
        return bound

    def solve(self, case: Case) -> Solved | None:
        """Align a candidate in all groups and size it; None: it cannot be done."""
        solved = self._turn(case)
        while solved is None and any(run.paused for run in case.runs):
            solved = self._turn(case)
        return solved

    def _turn(self, case: Case, limit: float = inf, top: float = inf) -> Solved | None:
        """Align a candidate in all groups, each within what the others leave of the limit, and size it.

        A little more than the limit may be looked at, but nothing that costs more than `top`.

        None: there is nothing within the limit; `case.floor` says how much more is known.
        """
        if not case.runs:
            self.open(case)
        for run, cluster in zip(case.runs, case.clusters, strict=True):
            self.progress.group = self.problem.groups[cluster[0]][0]
            others = case.floor - run.floor
            run.advance(limit - others, top - others)
            self._tell(case)
            if not run.ties:
                return None
        if case.solved is None:
            case.solved = self.size(case, [run.ties for run in case.runs])
        if case.solved is None and not case.unsizable:
            case.unsizable = True
            # Which structures fit each other is asked as they come. The clock may stop the making of this search: until
            # it is there, the case keeps those that it has.
            own = range(len(case.groups))
            runs = [
                self.searches.run(case.groups, lambda priced: self.size(case, [[priced]]) is not None, own)
            ]
            case.clusters, case.runs = [list(own)], runs
            return self._turn(case, limit, top)
        return case.solved

    def open(self, case: Case) -> None:
        """Find the candidate's groups, and the searches that other candidates share with it."""
        clusters, keys, runs = self.searches.of(case.candidate)
        groups: dict[int, Group] = {}
        for cluster, run in zip(clusters, runs, strict=True):
            groups.update(zip(cluster, run.groups, strict=True))
        case.clusters, case.groups = clusters, [groups[g] for g in range(len(groups))]
        case.keys = keys
        case.runs = runs  # all of them or none: the clock may have stopped this before
        self._tell(case)

    def _tell(self, case: Case) -> None:
        """Let the stream know what has been proven about words that other candidates have as well."""
        if self.stream is not None:
            for run, cluster in zip(case.runs, case.clusters, strict=True):
                if len(cluster) == 1:
                    self.stream.learn(case.keys[cluster[0]], run.floor)

    def size(self, case: Case, ties: Sequence[Sequence[Priced]]) -> Solved | None:
        """Size every combination of equally good structures; the least deviation wins."""
        best: Solved | None = None
        for combination in islice(product(*ties), 2 * tuning.TIES):
            parts: dict[int, tuple[Priced, int]] = {}
            for cluster, priced in zip(case.clusters, combination, strict=True):
                parts.update({g: (priced, k) for k, g in enumerate(cluster)})
            own = tuple(parts[g] for g in range(len(case.groups)))
            with sizing(self.trace, self.problem.axis):
                sized = size_axis(case.groups, own, self.problem.canvas, self.setting.symbol)
            self.check.add(tuning.SIZED)
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
