"""The solver's front door: a design in, a layout out (SPEC 3; the paper's section 5)."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from math import inf
from threading import Lock

from ..design.errors import DesignError, Fault, NoLayout
from ..design.model import AXES, Axis, Design
from .analysis import AnalysisDone, analyse
from .axis import AxisSearch, Best, Solved
from .events import StageEnded, SystemSolved, Trace
from .failure import explain
from .layout import AxisLayout, GroupLayout, Layout, PlacedLetter, RowLayout
from .merging import find_holes, hole_warnings, merge
from .objective import Objective
from .problem import AxisProblem, axis_problem
from .search import Stopped

__all__ = ["TOLERANCES", "forget", "solve"]

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
        tolerances one after the other, candidates in lexicographic order, the first that aligns in all
        groups.
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
    DesignError
        For a canvas without extent.
    NoLayout
        Where there is none, or none was found in time; says what is to blame.
    """
    if not isinstance(design, Design):
        raise TypeError(
            f"solve: expected a Design, found {type(design).__name__}; Design.from_dict reads a document"
        )
    for axis in AXES:
        if not 0 < design.canvas.along(axis) < inf:
            field = "width" if axis == "x" else "height"
            found = design.canvas.along(axis)
            raise DesignError(
                Fault(f"canvas.{field}", f"expected a positive number of metres, found {found!r}")
            )
    if time_limit is not None and not time_limit >= 0:
        raise ValueError(f"time_limit: expected seconds, 0 or more, found {time_limit!r}")
    if not tolerances or any(not 0 <= t <= 1 for t in tolerances) or list(tolerances) != sorted(tolerances):
        raise ValueError(
            f"tolerances: expected growing fractions of the canvas from 0 to 1, found {tolerances!r}"
        )
    if search not in ("best", "ida"):
        raise ValueError(f"search: expected 'best' or 'ida', found {search!r}")
    log = Trace() if trace else None
    if not design.stack:
        return Layout(design.name, design.canvas, design=design, trace=log)
    clock = _Clock(time_limit, should_stop)
    run = _Run(design, objective or Objective(), tuple(tolerances), search, clock, log)
    return run.layout()


def forget() -> None:
    """Let go of all answers that are kept for unchanged axes."""
    with _lock:
        _cache.clear()


class _Clock:
    """The time that a search may take, and whether it is still wanted. The axes share it: x has three quarters."""

    def __init__(self, limit: float | None, should_stop: Callable[[], bool] | None) -> None:
        self._begin, self._limit, self._should_stop = time.monotonic(), limit, should_stop
        self.allot(1.0)

    def allot(self, part: float) -> None:
        """From now on the search may go on until this part of the time has passed, less what a last attempt needs."""
        self._part = part
        self._end = 0.85 * part

    def extend(self) -> None:
        """Let the last attempt begin that follows a search without an answer: it has the rest of the part."""
        self._end = self._part

    def check(self) -> None:
        """Raise `Stopped` where the search has to end."""
        if self._should_stop is not None and self._should_stop():
            raise Stopped(asked=True)
        if self._limit is not None and time.monotonic() > self._begin + self._end * self._limit:
            raise Stopped


class _Run:
    """One call of `solve`."""

    def __init__(
        self,
        design: Design,
        objective: Objective,
        tolerances: tuple[float, ...],
        search: str,
        clock: _Clock,
        trace: Trace | None,
    ) -> None:
        self.design, self.objective, self.tolerances = design, objective, tolerances
        self.search, self.trace = search, trace
        self.clock = clock
        self.problems: Mapping[Axis, AxisProblem] = {axis: axis_problem(design, axis) for axis in AXES}
        used = [{name for name, _ in self.problems[axis].counters} for axis in AXES]
        self.shared = sorted(used[0] & used[1])
        self.analysed: set[Axis] = set()

    def layout(self) -> Layout:
        solved: dict[Axis, tuple[AxisSearch, Best]]
        if self.objective.plain:
            solved = self._by_tolerance()
        elif self.shared:
            solved = self._tied()
        else:
            solved = {}
            for axis, part in zip(AXES, (0.75, 1.0), strict=True):
                self.clock.allot(part)
                solved[axis] = self._axis(axis, self.tolerances[-1])
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
            walk.forget()
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
            problem,
            self.objective,
            tolerance * problem.canvas,
            self.search,
            self.clock.check,
            self.trace,
            self.clock.extend,
        )
        self._analyse(problem)
        try:
            walk.enumerate()
        except Stopped:
            raise NoLayout("The search was stopped before any layout was found.", axis) from None
        return walk

    def _analyse(self, problem: AxisProblem) -> None:
        """Pattern analysis (supplement 3.1): report its systems, and stop where they prove that nothing fits."""
        if self.trace is None:
            return
        if problem.axis not in self.analysed:
            self.analysed.add(problem.axis)
            self.trace.events.append(AnalysisDone(problem.axis, analyse(problem).to_dict()))

    def _tied(self) -> dict[Axis, tuple[AxisSearch, Best]]:
        """Both axes together, where a counter ties them: least J of both, over the values of the shared counters."""
        walks = {axis: self._walk(axis, self.tolerances[-1]) for axis in AXES}
        pairs = self._pairs(walks)
        best: Mapping[Axis, Best] | None = None
        rank = (inf, 0, inf)
        bound, complete = inf, True
        try:
            floors = [(sum(side.floor for side in pair), n) for n, pair in enumerate(pairs)]
        except Stopped:
            raise NoLayout("The search was stopped before any layout was found.") from None
        for floor, n in sorted(floors):
            if floor > rank[0] + 1e-9 or floor == inf:
                bound = min(bound, floor)
                break
            side_x, side_y = pairs[n]
            x = side_x.best(rank[0] - side_y.floor)
            y = side_y.best(rank[0] - x.cost) if x.solved else Best(bound=side_y.floor)
            complete = complete and x.complete and y.complete
            bound = min(bound, x.bound + y.bound)
            if x.solved is not None and y.solved is not None:
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

    def _pairs(self, walks: Mapping[Axis, AxisSearch]) -> list[tuple[AxisSearch, AxisSearch]]:
        """Both axes with the shared counters held at each of their possible values, in lexicographic order."""
        possible = [
            sorted(set.intersection(*(_values_in(walks[axis], counter) for axis in AXES)))
            for counter in self.shared
        ]
        pairs: list[tuple[AxisSearch, AxisSearch]] = []
        for combination in product(*possible):
            values = dict(zip(self.shared, combination, strict=True))
            pairs.append((walks["x"].restricted(values), walks["y"].restricted(values)))
        return pairs

    def _by_tolerance(self) -> dict[Axis, tuple[AxisSearch, Best]]:
        """The paper's schedule: the first candidate, in lexicographic order, that aligns at the least tolerance."""
        out: dict[Axis, tuple[AxisSearch, Best]] = {}
        walks: dict[Axis, AxisSearch] = {}
        for tolerance in self.tolerances:
            walks = {axis: self._walk(axis, tolerance) for axis in AXES if axis not in out}
            if self.shared:
                for side_x, side_y in self._pairs(walks):
                    x = _first_aligned(side_x)
                    y = _first_aligned(side_y) if x else None
                    if x is not None and y is not None:
                        return {"x": (walks["x"], x), "y": (walks["y"], y)}
                continue
            for axis, walk in walks.items():
                found = _first_aligned(walk)
                if found is not None:
                    out[axis] = (walk, found)
            if len(out) == len(AXES):
                return out
        failed = next(axis for axis in AXES if axis not in out)
        other = walks["y"] if self.shared else None
        raise explain(self.design, walks[failed], Best(), other=other, shared=self.shared)

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


def _values_in(walk: AxisSearch, counter: str) -> set[int]:
    """Values of a counter that every pattern it stands in has a word for."""
    sets = [
        {word.counters[counter] for word in walk.found[name].words}
        for name, pattern in walk.problem.patterns
        if counter in pattern.counters
    ]
    return set.intersection(*sets)


def _first_aligned(walk: AxisSearch) -> Best | None:
    """The first candidate, in lexicographic order, that aligns and can be sized."""
    try:
        for candidate in walk.in_order():
            solved = walk.solve(walk.case(candidate))
            if solved is not None:
                return Best(solved, solved.cost)
    except Stopped:
        raise NoLayout("The search was stopped before any layout was found.", walk.problem.axis) from None
    return None


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
