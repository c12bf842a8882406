"""One axis: from its words to the best candidate, aligned and sized (SPEC 3, *Which candidate*)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import islice, product
from math import inf

from ..design.model import Counter, Symbol
from .candidates import Candidate, candidates, rows_of
from .columns import EPS, Group, lone_unsized, make_group
from .events import CandidateJudged, Trace, WordJudged
from .ida import search_ida
from .letters import Word
from .objective import Objective
from .pricing import Priced
from .problem import AxisProblem
from .search import Found, Stopped, search
from .sizing import Sized, size_axis
from .words import Instances, instances

__all__ = ["AxisSearch", "Solved"]

_TIES = 4


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


@dataclass(slots=True)
class AxisSearch:
    """The search on one axis at one tolerance, with what it has learnt so far."""

    problem: AxisProblem
    objective: Objective
    tolerance: float
    method: str = "best"
    check: Callable[[], None] | None = None
    trace: Trace | None = None
    found: dict[str, Instances] = field(default_factory=dict)
    candidates: list[Candidate] = field(default_factory=list)

    def enumerate(self) -> None:
        """List words and candidates."""
        symbols = self.problem.symbol
        counters = dict(self.problem.counters)
        for name, pattern in self.problem.patterns:
            self.found[name] = instances(
                pattern,
                lambda s: symbols.get(s) or Symbol(s),
                lambda c: counters.get(c) or Counter(c),
                self.problem.canvas + self.tolerance,
                self.check,
            )
            if self.trace is not None:
                self._tell_words(self.trace, name)
        words = {name: found.words for name, found in self.found.items()}
        self.candidates = list(candidates(self.problem, words, self.tolerance, self.objective, self.check))

    def _tell_words(self, trace: Trace, name: str) -> None:
        for word in self.found[name].words:
            trace.events.append(
                WordJudged(self.problem.axis, name, str(word), word.size, dict(word.counters), True, "fits the canvas")
            )

    def best(self, among: Iterable[Candidate] | None = None, cap: float = inf) -> Best:
        """The best candidate: lower bounds first, and no candidate whose bound is worse than what is known."""
        order = sorted(self.candidates if among is None else among, key=lambda c: c.bound)
        best = Best()
        for n, candidate in enumerate(order):
            known = min(cap, best.solved.cost if best.solved else inf)
            if candidate.bound > known + EPS:
                best.bound = min(best.bound, candidate.bound)
                self._tell(candidate, "bound", None)
                continue
            try:
                solved, bound, whole, unsizable = self.solve(candidate, known)
            except Stopped:
                best.complete = False
                best.bound = min(best.bound, *(c.bound for c in order[n:]))
                break
            best.bound = min(best.bound, bound)
            best.complete = best.complete and whole
            best.unsizable = best.unsizable or unsizable
            if solved is not None and solved.beats(best.solved):
                best.solved = solved
                self._tell(candidate, "best", solved)
            else:
                fate = "dearer" if solved or bound > known else ("no sizes" if unsizable else "no alignment")
                self._tell(candidate, fate, solved)
        return best

    def _tell(self, candidate: Candidate, fate: str, solved: Solved | None) -> None:
        if self.trace is None:
            return
        self.trace.events.append(
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

    def solve(self, candidate: Candidate, cap: float = inf) -> tuple[Solved | None, float, bool, bool]:
        """Align a candidate in all groups and size it.

        Returns (the answer or None, lower bound of the candidate's J, whether that is all there is to know, whether
        alignments were found that no sizes fit).
        """
        groups, clusters = self._groups(candidate)
        founds: list[Found] = []
        bounds = [0.0] * len(clusters)
        total = 0.0
        for c, cluster in enumerate(clusters):
            found = self._search([groups[g] for g in cluster], cap - total, None)
            bounds[c] = found.bound
            if not found.ties:
                return None, max(candidate.bound, total + found.bound), not found.cut, False
            founds.append(found)
            total += found.ties[0].cost
        solved = self._size(candidate, groups, clusters, [found.ties for found in founds])
        if solved is None and len(clusters) == 1:
            again = self._search(
                groups, cap, lambda p: self._size(candidate, groups, clusters, [[p]]) is not None
            )
            solved = self._size(candidate, groups, clusters, [again.ties]) if again.ties else None
            return solved, again.bound, not again.cut, True
        whole = not any(found.cut for found in founds)
        return solved, sum(bounds), whole and solved is not None, solved is None

    def _search(self, groups: Sequence[Group], cap: float, accept: Callable[[Priced], bool] | None) -> Found:
        run = search_ida if self.method == "ida" else search
        return run(groups, cap=cap, keep=_TIES, check=self.check, accept=accept)

    def _groups(self, candidate: Candidate) -> tuple[list[Group], list[list[int]]]:
        """The groups of a candidate, and which of them share an unsized symbol and so are aligned together."""
        rows = rows_of(self.problem, candidate.words)
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
                groups[g] = make_group(rows[g], self.problem.canvas, self.tolerance, self.objective, free=free)
        return groups, clusters

    def _size(
        self,
        candidate: Candidate,
        groups: Sequence[Group],
        clusters: Sequence[Sequence[int]],
        ties: Sequence[Sequence[Priced]],
    ) -> Solved | None:
        """Size every combination of equally good structures; the least deviation wins."""
        symbols = self.problem.symbol
        best: Solved | None = None
        for combination in islice(product(*ties), 2 * _TIES):
            parts: dict[int, tuple[Priced, int]] = {}
            for cluster, priced in zip(clusters, combination, strict=True):
                parts.update({g: (priced, k) for k, g in enumerate(cluster)})
            own = tuple(parts[g] for g in range(len(groups)))
            sized = size_axis(groups, own, self.problem.canvas, lambda s: symbols.get(s) or Symbol(s))
            if sized is None:
                continue
            solved = Solved(
                candidate,
                tuple(groups),
                own,
                sized,
                sum(p.cost for p in combination),
                sum(p.columns for p in combination),
            )
            if solved.beats(best):
                best = solved
        return best

    def words(self) -> Mapping[str, Sequence[Word]]:
        """Words by pattern."""
        return {name: found.words for name, found in self.found.items()}
