"""The solver's front door: a design in, a layout out (SPEC 3; the paper's section 5)."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping, Sequence
from math import inf
from threading import Lock

from ..design.errors import NoLayout
from ..design.model import AXES, Axis, Design
from .axis import AxisSearch, Best, Solved
from .candidates import Candidate
from .events import StageEnded, SystemSolved, Trace
from .failure import explain
from .layout import AxisLayout, GroupLayout, Layout, PlacedLetter, RowLayout
from .merging import find_holes, hole_warnings, merge
from .objective import Objective
from .problem import AxisProblem, axis_problem
from .search import Stopped

__all__ = ["TOLERANCES", "solve"]

TOLERANCES = (0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5)
"""Fractions of the canvas; the paper's schedule, and, by its last, what the default objective works within."""

_KEEP = 64
_cache: OrderedDict[object, tuple[AxisSearch, Best]] = OrderedDict()
_lock = Lock()


def solve(
    design: Design,
    *,
    objective: Objective | None = None,
    tolerances: Sequence[float] = TOLERANCES,
    search: str = "best",
    trace: bool = False,
    time_limit: float | None = 10.0,
    should_stop: Callable[[], bool] | None = None,
) -> Layout:
    """Solve a design.

    Parameters
    ----------
    design
        A valid design; without layers its layout is empty.
    objective
        Default `Objective()`: the least J over all candidates. `Objective.paper()` follows the paper:
        tolerances one after
        the other, candidates in lexicographic order, the first that aligns in all groups.
    tolerances
        Fractions of the canvas, growing; the default objective uses the largest alone.
    search
        ``"best"`` or ``"ida"``, the paper's; both give the same value.
    trace
        Record every stage as typed events in `Layout.trace`.
    time_limit
        Seconds, or None. When they are over, the best layout so far is returned, marked not `complete`.
    should_stop
        Asked now and then; true ends the search as the time limit does.

    Raises
    ------
    NoLayout
        Where there is none, or none was found in time; says what is to blame.
    """
    if not tolerances or any(not 0 <= t <= 1 for t in tolerances) or list(tolerances) != sorted(tolerances):
        raise ValueError(
            f"tolerances: expected growing fractions of the canvas from 0 to 1, found {tolerances!r}"
        )
    if search not in ("best", "ida"):
        raise ValueError(f"search: expected 'best' or 'ida', found {search!r}")
    log = Trace() if trace else None
    if not design.stack:
        return Layout(design.name, design.canvas, design=design, trace=log)
    check = _stopper(time_limit, should_stop)
    run = _Run(design, objective or Objective(), tuple(tolerances), search, check, log)
    return run.layout()


def _stopper(time_limit: float | None, should_stop: Callable[[], bool] | None) -> Callable[[], None] | None:
    if time_limit is None and should_stop is None:
        return None
    end = inf if time_limit is None else time.monotonic() + time_limit

    def check() -> None:
        if time.monotonic() > end or (should_stop is not None and should_stop()):
            raise Stopped

    return check


class _Run:
    """One call of `solve`."""

    def __init__(
        self,
        design: Design,
        objective: Objective,
        tolerances: tuple[float, ...],
        search: str,
        check: Callable[[], None] | None,
        trace: Trace | None,
    ) -> None:
        self.design, self.objective, self.tolerances = design, objective, tolerances
        self.search, self.check, self.trace = search, check, trace
        self.problems: Mapping[Axis, AxisProblem] = {axis: axis_problem(design, axis) for axis in AXES}
        used = [{name for name, _ in self.problems[axis].counters} for axis in AXES]
        self.shared = sorted(used[0] & used[1])

    def layout(self) -> Layout:
        if self.objective.plain:
            solved = self._by_tolerance()
        elif self.shared:
            solved = self._tied()
        else:
            solved = {axis: self._axis(axis, self.tolerances[-1]) for axis in AXES}
        return self._assemble(solved)

    def _axis(self, axis: Axis, tolerance: float) -> tuple[AxisSearch, Best]:
        """The best of one axis; an axis that has not changed since it was last asked for is not searched again."""
        problem = self.problems[axis]
        key = (problem, self.objective, tolerance, self.search)
        if self.trace is None:
            with _lock:
                known = _cache.get(key)
                if known is not None:
                    _cache.move_to_end(key)
                    return known
        begin = time.perf_counter()
        walk = self._walk(axis, tolerance)
        best = walk.best()
        if best.solved is None:
            raise explain(self.design, walk, best)
        if best.complete and self.trace is None:
            with _lock:
                _cache[key] = (walk, best)
                while len(_cache) > _KEEP:
                    _cache.popitem(last=False)
        if self.trace is not None:
            self.trace.events.append(StageEnded(axis, "axis", time.perf_counter() - begin))
        return walk, best

    def _walk(self, axis: Axis, tolerance: float) -> AxisSearch:
        problem = self.problems[axis]
        walk = AxisSearch(
            problem, self.objective, tolerance * problem.canvas, self.search, self.check, self.trace
        )
        try:
            walk.enumerate()
        except Stopped:
            raise NoLayout("The search was stopped before any layout was found.", axis) from None
        return walk

    def _tied(self) -> Mapping[Axis, tuple[AxisSearch, Best]]:
        """Both axes together, where a counter ties them: least J of both, over the values of the shared counters."""
        walks = {axis: self._walk(axis, self.tolerances[-1]) for axis in AXES}
        lots = {axis: self._lots(walks[axis].candidates) for axis in AXES}
        common = [values for values in lots["x"] if values in lots["y"]]
        if not common:
            raise explain(self.design, walks["x"], Best(), other=walks["y"], shared=self.shared)

        def floor(values: tuple[int, ...]) -> float:
            return sum(min(c.bound for c in lots[axis][values]) for axis in AXES)

        best: Mapping[Axis, Best] | None = None
        rank = (inf, 0, inf)
        bound, complete = inf, True
        for values in sorted(common, key=floor):
            if floor(values) > rank[0] + 1e-9:
                bound = min(bound, floor(values))
                break
            cap = rank[0]
            x = walks["x"].best(lots["x"][values], cap)
            y = walks["y"].best(lots["y"][values], cap) if x.solved else Best()
            complete = complete and x.complete and y.complete
            bound = min(bound, x.bound + (y.bound if x.solved else min(c.bound for c in lots["y"][values])))
            if x.solved is None or y.solved is None:
                if not complete:
                    break
                continue
            deviation = x.solved.sized.deviation + y.solved.sized.deviation
            own = (x.solved.cost + y.solved.cost, -x.solved.columns - y.solved.columns, deviation)
            if _less(own, rank):
                best, rank = {"x": x, "y": y}, own
            if not complete:
                break
        if best is None:
            raise explain(
                self.design, walks["x"], Best(complete=complete), other=walks["y"], shared=self.shared
            )
        gap = max(0.0, rank[0] - bound)
        for axis in AXES:
            own_best = best[axis]
            own_best.complete = complete
            own_best.bound = (own_best.solved.cost if own_best.solved else 0.0) - gap
        return {axis: (walks[axis], best[axis]) for axis in AXES}

    def _lots(self, candidates: Sequence[Candidate]) -> dict[tuple[int, ...], list[Candidate]]:
        lots: dict[tuple[int, ...], list[Candidate]] = {}
        for candidate in candidates:
            lots.setdefault(tuple(candidate.counters[c] for c in self.shared), []).append(candidate)
        return lots

    def _by_tolerance(self) -> Mapping[Axis, tuple[AxisSearch, Best]]:
        """The paper's schedule: the first candidate, in lexicographic order, that aligns at the least tolerance."""
        out: dict[Axis, tuple[AxisSearch, Best]] = {}
        walks: dict[Axis, AxisSearch] = {}
        for tolerance in self.tolerances:
            walks = {axis: self._walk(axis, tolerance) for axis in AXES if axis not in out}
            if self.shared:
                pair = self._first_pair(walks)
                if pair is not None:
                    return pair
                continue
            for axis, walk in walks.items():
                found = next(_aligned(walk, walk.candidates), None)
                if found is not None:
                    out[axis] = (walk, found)
            if len(out) == len(AXES):
                return out
        failed = next(axis for axis in AXES if axis not in out)
        other = walks["y"] if self.shared else None
        raise explain(self.design, walks[failed], Best(), other=other, shared=self.shared)

    def _first_pair(self, walks: Mapping[Axis, AxisSearch]) -> Mapping[Axis, tuple[AxisSearch, Best]] | None:
        lots = {axis: self._lots(walks[axis].candidates) for axis in AXES}
        for values, candidates in lots["x"].items():
            if values in lots["y"]:
                x = next(_aligned(walks["x"], candidates), None)
                y = next(_aligned(walks["y"], lots["y"][values]), None) if x else None
                if x is not None and y is not None:
                    return {"x": (walks["x"], x), "y": (walks["y"], y)}
        return None

    def _assemble(self, solved: Mapping[Axis, tuple[AxisSearch, Best]]) -> Layout:
        warnings: list[str] = []
        counters: dict[str, int] = {}
        axes: dict[Axis, AxisLayout] = {}
        complete = True
        for axis in AXES:
            walk, best = solved[axis]
            answer = best.solved
            if answer is None:
                raise explain(self.design, walk, best)
            counters.update(answer.candidate.counters)
            axes[axis] = _axis_layout(self.design, walk.problem, best, answer)
            complete = complete and best.complete
            warnings += _warnings(walk, answer)
            if self.trace is not None:
                self.trace.events.append(_system_event(axis, answer))
        shapes = merge(self.design, axes["x"], axes["y"])
        holes = find_holes(self.design.canvas, shapes)
        warnings += hole_warnings(self.design, axes["x"], axes["y"], holes)
        return Layout(
            self.design.name,
            self.design.canvas,
            dict(sorted(counters.items())),
            axes["x"],
            axes["y"],
            shapes,
            holes,
            tuple(warnings),
            complete,
            self.design,
            self.trace,
        )


def _less(a: tuple[float, int, float], b: tuple[float, int, float]) -> bool:
    if abs(a[0] - b[0]) > 1e-9:
        return a[0] < b[0]
    return a[1:] < b[1:]


def _aligned(walk: AxisSearch, candidates: Sequence[Candidate]) -> Iterator[Best]:
    """Candidates that align and can be sized, in the given order."""
    for candidate in candidates:
        try:
            solved = walk.solve(candidate)
        except Stopped:
            raise NoLayout("The search was stopped before any layout was found.", walk.problem.axis) from None
        if solved is not None:
            yield Best(solved, solved.cost)


def _axis_layout(design: Design, problem: AxisProblem, best: Best, answer: Solved) -> AxisLayout:
    layers: dict[str, list[str]] = {}
    for layer in design.stack:
        layers.setdefault(layer.along(problem.axis).group, []).append(layer.name)
    groups: dict[str, GroupLayout] = {}
    for g, (name, patterns) in enumerate(problem.groups):
        group, (priced, k) = answer.groups[g], answer.parts[g]
        structure, placement = priced.structure[k], answer.sized.placements[g]
        rows: list[RowLayout] = []
        for i, pattern in enumerate(patterns):
            b = group.band_of[i]
            word = group.bands[b].letters
            columns = tuple(
                tuple(
                    PlacedLetter(word[n].symbol, s, t, word[n].mirrored, word[n].transparent)
                    for n, (s, t) in zip(column[b].letters, placed[b], strict=True)
                )
                for column, placed in zip(structure, placement, strict=True)
            )
            rows.append(RowLayout(layers[name][i], pattern, columns))
        groups[name] = GroupLayout(priced.omegas[k], answer.sized.boundaries[g], tuple(rows))
    gap = max(0.0, answer.cost - best.bound) if best.bound < inf else 0.0
    proven = best.complete and gap <= 1e-6
    return AxisLayout(
        answer.cost, 0.0 if proven else gap, answer.sized.deviation, proven, dict(answer.sized.sizes), groups
    )


def _warnings(walk: AxisSearch, answer: Solved) -> Iterator[str]:
    for (name, _), group in zip(walk.problem.groups, answer.groups, strict=True):
        if group.waived and any(band.soft for band in group.bands):
            yield (
                f"No symbol of group {name!r} on {walk.problem.axis} is opaque, so nothing need stand behind its "
                "non-opaque letters."
            )
    for name, found in walk.found.items():
        for counter in found.endless:
            yield (
                f"Counter {counter!r} in pattern {name!r} repeats nothing that has a size; "
                f"it was tried up to {answer.candidate.counters.get(counter, 0)} only."
            )


def _system_event(axis: Axis, answer: Solved) -> SystemSolved:
    system, solution = answer.sized.system, answer.sized.solution
    return SystemSolved(
        axis,
        system.variables,
        system.rows,
        tuple(tuple(row) for row in system.matrix.tolist()),
        tuple(system.lower.tolist()),
        tuple(system.upper.tolist()),
        tuple(solution.x.tolist()),
        tuple(solution.multipliers.tolist()),
        answer.sized.deviation,
    )
