"""The solver's front door: a design in, a layout out (the paper's section 5; docs/problem.md)."""

from __future__ import annotations

import gc
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from heapq import heappop, heappush
from itertools import product
from math import inf

from ..design.errors import DesignError, NoLayout
from ..design.limits import range_faults
from ..design.model import AXES, Axis, Design
from . import tuning
from .alignment.core.binding import Session, session, start_afresh
from .analysis.systems import analyse, refuted
from .assembly.axes import axis_layout, axis_warnings, cut_warnings
from .assembly.shapes import find_holes, hole_warnings, merge
from .budget import Clock, Stopped
from .cache import CACHE
from .diagnosis.explanation import explain, ran_out
from .diagnosis.refusal import Blame
from .diagnosis.remedies import Tried
from .model.layout import AxisLayout, Layout, PlacedShape, Rect
from .model.objective import Objective
from .model.precision import EPS
from .model.problem import AxisProblem, axis_problem
from .selection.axis import AxisSearch, Best
from .selection.clusters import PLAINER
from .selection.warm_start import adopted, upper_bound
from .trace import Recorder, stage
from .words.enumeration import across
from .words.instances import Range

__all__ = [
    "TOLERANCES",
    "AxisAnswer",
    "compose",
    "forget",
    "kept_as",
    "last_as",
    "solve",
    "solve_axis",
    "spelled_as",
]

TOLERANCES = (0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5)
"""Fractions of the canvas; the paper's schedule, and, by its last, what the default objective works within."""


_SLOWLY = (
    "There was no memory for the compiled search; the search in Python took its place, which takes longer and finds "
    "the same."
)


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
        What is minimised. The default, `Objective()`, finds the least J over all candidates.
        `Objective.paper()` follows the paper: it tries the tolerances one after the other, at each one the
        candidates in lexicographic order, and takes the first candidate that aligns in all groups.
    tolerances
        Fractions of the canvas, in growing order. The default objective uses the largest one only.
    search
        ``"best"``, or ``"ida"`` for the paper's search. Lessons also run the first one in Python without its bounds of
        what is to come, ``"no-heuristic"``, or without dropping paths that meet better ones, ``"no-table"``. All
        give a layout of the same cost.
    trace
        Record every stage as typed events in `Layout.trace`.
    time_limit
        Seconds, or None for no limit. When they are over, the best layout so far is returned, and its
        `complete` is False.
    should_stop
        A function that is called now and then. If it returns true, the search ends at once: with the best layout
        so far if every axis has come to one, else with `NoLayout`.

    Raises
    ------
    DesignError
        For a canvas without extent.
    NoLayout
        If there is no layout, or none was found in time. It says what is to blame.
    """
    if not isinstance(design, Design):
        raise TypeError(
            f"solve: expected a Design, found {type(design).__name__}; Design.from_dict reads a document"
        )
    faults = range_faults(design)
    if faults:
        raise DesignError(faults)
    if time_limit is not None and not time_limit >= 0:
        raise ValueError(f"time_limit: expected seconds, 0 or more, found {time_limit!r}")
    if not tolerances or any(not 0 <= t <= 1 for t in tolerances) or list(tolerances) != sorted(tolerances):
        raise ValueError(
            f"tolerances: expected growing fractions of the canvas from 0 to 1, found {tolerances!r}"
        )
    if search not in ("best", "ida", *PLAINER):
        known = ", ".join(repr(own) for own in ("best", "ida", *PLAINER))
        raise ValueError(f"search: expected one of {known}, found {search!r}")
    log = Recorder(design, objective or Objective(), tolerances, search) if trace else None
    clock = Clock(time_limit, should_stop)
    try:
        if design.stack:
            layout = _solved(design, objective or Objective(), tuple(tolerances), search, clock, log)
        else:
            layout = Layout(design.name, design.canvas, design=design)
    except NoLayout as error:
        if log is not None:
            log.finish(error=error)
            error.trace = log.trace()
        # an error that is kept, as the last one in a notebook is, does not keep the whole search
        error.__context__ = None
        raise error.with_traceback(None) from None
    finally:
        clock.close()
    if log is None:
        return layout
    log.finish(layout)
    return replace(layout, trace=log.trace())


@dataclass(frozen=True, slots=True)
class AxisAnswer:
    """One axis of a design, solved by itself.

    Attributes
    ----------
    layout
        Where its letters stand.
    columns
        Number of columns, summed over groups.
    problem, best
        What was asked, and what the search came to; None where nothing was.
    """

    layout: AxisLayout
    counters: Mapping[str, int] = field(default_factory=dict)
    columns: int = 0
    warnings: tuple[str, ...] = ()
    complete: bool = True
    problem: AxisProblem | None = field(default=None, repr=False)
    best: Best | None = field(default=None, repr=False)


def solve_axis(
    design: Design,
    axis: Axis,
    *,
    objective: Objective | None = None,
    time_limit: float | None = 10.0,
    should_stop: Callable[[], bool] | None = None,
) -> AxisAnswer:
    """Solve one axis of a design, whatever the other one is; `compose` makes a layout of two such answers.

    A counter that stands on both axes has the value that suits this one. What is raised is what `solve` raises.
    """
    clock = Clock(time_limit, should_stop)
    chosen = objective or Objective()
    try:
        with session():
            run = _Run(design, chosen, TOLERANCES, "best", clock, None)
            try:
                return run.answer(axis)
            except (Stopped, MemoryError) as stop:
                clock.full = clock.full or not isinstance(stop, Stopped) or stop.full
                raise ran_out(design, clock, list(run.problems.values())) from None
            finally:
                run.close()
    except NoLayout as error:
        error.__context__ = None
        raise error.with_traceback(None) from None
    finally:
        clock.close()


def compose(design: Design, x: AxisAnswer, y: AxisAnswer) -> Layout:
    """The layout of a design whose axes have been solved apart."""
    shapes = merge(design, x.layout, y.layout)
    holes = find_holes(design.canvas, shapes)
    told = hole_warnings(design, x.layout, y.layout, holes)
    return Layout(
        design.name,
        design.canvas,
        dict(sorted({**y.counters, **x.counters}.items())),
        x.layout,
        y.layout,
        shapes,
        holes,
        (*x.warnings, *y.warnings, *told),
        x.complete and y.complete,
        design,
    )


def forget() -> None:
    """Let go of all that is kept for what an edit leaves alone: answers of axes and groups, words of patterns."""
    CACHE.clear()


def _solved(
    design: Design,
    objective: Objective,
    tolerances: tuple[float, ...],
    search: str,
    clock: Clock,
    log: Recorder | None,
) -> Layout:
    """The layout. When it is there, or there is none, nothing is left of what was searched."""
    with session() as compiled:
        run = _Run(design, objective, tolerances, search, clock, log)
        try:
            return run.layout(compiled)
        except (Stopped, MemoryError) as stop:
            clock.full = clock.full or not isinstance(stop, Stopped) or stop.full
            raise ran_out(design, clock, list(run.problems.values())) from None
        finally:
            run.close()


class _Run:
    """One call of `solve`."""

    def __init__(
        self,
        design: Design,
        objective: Objective,
        tolerances: tuple[float, ...],
        search: str,
        clock: Clock,
        trace: Recorder | None,
        trial: bool = False,
    ) -> None:
        self.design, self.objective, self.tolerances = design, objective, tolerances
        self.search, self.trace = search, trace
        self.clock, self.trial = clock, trial
        self.problems: Mapping[Axis, AxisProblem] = {axis: axis_problem(design, axis) for axis in AXES}
        used = [{name for name, _ in self.problems[axis].counters} for axis in AXES]
        self.shared = sorted(used[0] & used[1])
        self.analysed: set[Axis] = set()
        self.walks: list[AxisSearch] = []
        self.undecided = self.left_out = False

    def layout(self, compiled: Session) -> Layout:
        layout = self._assemble(self._solved(AXES))
        if compiled.without:
            layout = replace(layout, warnings=(*layout.warnings, _SLOWLY))
        return layout

    def answer(self, axis: Axis) -> AxisAnswer:
        """One axis alone."""
        self.shared = []
        walk, best = self._solved((axis,))[axis]
        return self._answer(axis, walk, best)

    def close(self) -> None:
        """Let go of all that was searched, except by a trace, which is still to be read."""
        if self.trace is None:
            for walk in self.walks:
                walk.forget()
        self.walks.clear()

    def _solved(self, axes: Sequence[Axis]) -> dict[Axis, tuple[AxisSearch, Best]]:
        """The best of some axes; of both, where a counter ties them."""
        try:
            return self._found(axes)
        except Stopped as stop:
            self.clock.full = self.clock.full or stop.full
            raise ran_out(self.design, self.clock, list(self.problems.values())) from None

    def _found(self, axes: Sequence[Axis]) -> dict[Axis, tuple[AxisSearch, Best]]:
        if self.shared:
            return self._unless_known(AXES, self._by_tolerance if self.objective.plain else self._tied)
        out: dict[Axis, tuple[AxisSearch, Best]] = {}
        for n, axis in enumerate(axes):
            self.clock.allot(0.75 if n < len(axes) - 1 else 1.0)
            out |= self._unless_known((axis,), self._by_tolerance if self.objective.plain else self._axis)
        return out

    def _unless_known(
        self, axes: Sequence[Axis], find: Callable[[Sequence[Axis]], dict[Axis, tuple[AxisSearch, Best]]]
    ) -> dict[Axis, tuple[AxisSearch, Best]]:
        """Search axes unless they are the same as when they were last asked for."""
        if self.trace is not None:
            return find(axes)
        problems = tuple(self.problems[axis] for axis in axes)
        key = kept_as(problems, self.objective, self.tolerances, self.search)
        known: dict[Axis, tuple[AxisSearch, Best]] | None = CACHE.answers.get(key)
        if known is None:
            known = find(axes)
            if not self.trial:
                weight = 0.0
                for walk, best in known.values():
                    walk.forget()
                    for group in best.solved.groups if best.solved else ():
                        group.forget()
                    weight += best.solved.weight if best.solved else 0.0
                if all(best.complete for _, best in known.values()):
                    CACHE.answers.put(key, known, max(tuning.ANSWER_BYTES, weight))
        return known

    def _axis(self, axes: Sequence[Axis]) -> dict[Axis, tuple[AxisSearch, Best]]:
        """The best of one axis."""
        (axis,) = axes
        walk = self._walk(axis, self.tolerances[-1])
        best = self._from_before(walk)
        if best.solved is None:
            raise self._failure(walk, best)
        return {axis: (walk, best)}

    def _from_before(self, walk: AxisSearch) -> Best:
        """The best of one axis, helped by what was found for the same patterns before some edit."""
        if self.trace is not None or self.search != "best":
            return self._best(walk)
        problem = walk.problem
        key = spelled_as(problem, self.objective)
        kept = CACHE.earlier.get(key)
        before = None if kept is None else kept[1]
        cap = inf
        with suppress(Stopped):  # then there is no time for the search either, which knows what to do
            cap = inf if before is None else upper_bound(walk, before)
        best = self._best(walk, cap)
        if best.cost > cap + EPS and best.complete:  # where symbols cannot be sized all together
            walk.start_over()
            best = self._best(walk)
        if before is not None and not best.complete:
            with suppress(Stopped):  # the time is up, but perhaps for this
                other = adopted(walk, before)
                best.solved = other if other is not None and other.beats(best.solved) else best.solved
        if best.solved is not None and not self.trial:
            weight = max(tuning.ANSWER_BYTES / 2, best.solved.weight)
            CACHE.earlier.put(key, (problem, best.solved), weight)
            CACHE.earlier.put(last_as(problem, self.objective), (problem, best.solved), weight)
        return best

    def _best(self, walk: AxisSearch, cap: float = inf) -> Best:
        with stage(self.trace, walk.problem.axis, "search"):
            best = walk.best(cap)
            self.clock.full = self.clock.full or best.full
            if self.trace is not None:
                self.trace.judged(walk)
        return best

    def _walk(self, axis: Axis, tolerance: float, check: Callable[[], None] | None = None) -> AxisSearch:
        problem = self.problems[axis]
        walk = AxisSearch(
            problem,
            self.objective,
            tolerance * problem.canvas,
            self.search,
            self.clock.check if check is None else check,
            self.trace,
            self.clock.extend,
            self.clock.progress,
        )
        self.walks.append(walk)
        self.clock.progress.at("words", axis)
        self._analyse(walk)
        with stage(self.trace, axis, "words"):
            walk.enumerate(self._across(axis))
        return walk

    def _across(self, axis: Axis) -> dict[str, Range]:
        """Between which values of the shared counters the other axis has words."""
        if not self.shared:
            return {}
        other = self.problems["y" if axis == "x" else "x"]
        return across(other, self.shared, self.tolerances[-1], self.clock.check)

    def _failure(self, walk: AxisSearch, best: Best, other: AxisSearch | None = None) -> NoLayout:
        """Why there is no layout; a trial does not ask."""
        if self.trial:
            return NoLayout("")
        end = self.clock.check.seconds + tuning.REMEDIES

        def works(design: Design, tolerance: float | None) -> Tried | None:
            left = end - self.clock.check.seconds
            if left <= 0:
                raise Stopped
            tolerances = self.tolerances if tolerance is None else (tolerance,)
            clock = Clock(None, parent=self.clock, most=min(left, tuning.REMEDY))
            run = _Run(design, self.objective, tolerances, self.search, clock, None, trial=True)
            try:
                return run.tried(None if other else walk.problem.axis)
            finally:
                run.close()

        return explain(Blame(self.design, walk, best, self.clock, self.tolerances, works, other, self.shared))

    def tried(self, axis: Axis | None) -> Tried | None:
        """What an axis comes to, or both; None where there is no layout."""
        try:
            solved = self._solved(AXES if axis is None else (axis,))
        except NoLayout:
            return None
        own = [best.solved for _, best in solved.values() if best.solved is not None]
        return Tried(
            {name: size for one in own for name, size in one.sized.sizes.items()},
            {name: value for one in own for name, value in one.candidate.counters.items()},
        )

    def _analyse(self, walk: AxisSearch) -> None:
        """Pattern analysis (supplement 3.1), told to the trace; a contradiction that is a proof ends the search."""
        problem = walk.problem
        if problem.axis in self.analysed:
            return
        self.analysed.add(problem.axis)
        if self.trace is not None:
            with stage(self.trace, problem.axis, "analysis"):
                self.trace.analysed(problem.axis, analyse(problem, self.clock.check))
        if refuted(problem, self.clock.check) is not None:
            raise self._failure(walk, Best())

    def _tied(self, axes: Sequence[Axis] = AXES) -> dict[Axis, tuple[AxisSearch, Best]]:
        """Both axes together, where a counter ties them: least J of both, over the values of the shared counters."""
        walks = {axis: self._walk(axis, self.tolerances[-1]) for axis in axes}
        best: Mapping[Axis, Best] | None = None
        rank: _Rank = (inf, 0, inf, ())
        bound, complete = inf, True
        pairs = self._by_floor(walks)
        left = min(walk.left_out for walk in walks.values())
        while True:
            try:
                floor, side_x, side_y = next(pairs, (inf, None, None))
            except Stopped:
                complete, bound = False, 0.0
                break
            if floor > rank[0] + 1e-9 or side_x is None or side_y is None:
                bound = min(bound, floor)
                break
            x = self._best(side_x, rank[0] - side_y.floor)
            y = self._best(side_y, rank[0] - x.cost) if x.solved else Best(bound=side_y.floor)
            side_x.leave()
            side_y.leave()
            complete = complete and x.complete and y.complete
            bound = min(bound, x.bound + y.bound)
            if x.solved is not None and y.solved is not None:
                deviation = x.solved.sized.deviation + y.solved.sized.deviation
                values = tuple(x.solved.candidate.counters[name] for name in self.shared)
                columns = x.solved.columns + y.solved.columns
                own = (x.solved.cost + y.solved.cost, -columns, deviation, values)
                if _less(own, rank):
                    best, rank = {"x": x, "y": y}, own
            if not complete:
                bound = min(bound, floor)  # the others, which come later, cost no less
                break
        bound = min(bound, left)
        if best is None:
            raise self._failure(walks["x"], Best(complete=complete), walks["y"])
        gap = max(0.0, rank[0] - bound)
        for axis in AXES:
            own_best = best[axis]
            own_best.complete = complete
            own_best.bound = (own_best.solved.cost if own_best.solved else 0.0) - gap
        return {axis: (walks[axis], best[axis]) for axis in AXES}

    def _by_floor(self, walks: Mapping[Axis, AxisSearch]) -> Iterator[tuple[float, AxisSearch, AxisSearch]]:
        """Both axes with the shared counters held at values that both have, by growing lower bound of J."""
        streams = [walks[axis].restricted({}).stream for axis in AXES]
        across, up = streams
        assert across is not None and up is not None
        least = [across.bound, up.bound]
        floors: list[dict[tuple[int, ...], float]] = [
            {},
            {},
        ]  # of the first, and so the best, candidate with some values
        ahead: list[tuple[float, tuple[int, ...]]] = []
        while True:
            unseen = min(across.bound + least[1], least[0] + up.bound)
            if unseen == inf and not ahead:
                return
            if ahead and ahead[0][0] <= unseen:
                floor, values = heappop(ahead)
                held = dict(zip(self.shared, values, strict=True))
                yield floor, walks["x"].restricted(held), walks["y"].restricted(held)
                continue
            turn = 0 if across.bound + least[1] <= least[0] + up.bound else 1
            candidate = (across, up)[turn].take()
            assert candidate is not None
            values = tuple(candidate.counters[name] for name in self.shared)
            if values not in floors[turn]:
                floors[turn][values] = candidate.bound
                if values in floors[1 - turn]:
                    heappush(ahead, (floors[0][values] + floors[1][values], values))

    def _pairs(self, walks: Mapping[Axis, AxisSearch]) -> Iterator[tuple[AxisSearch, AxisSearch]]:
        """Both axes with the shared counters held at each of their possible values, in lexicographic order."""
        possible = [
            sorted(set.intersection(*(_values_in(walks[axis], counter) for axis in AXES)))
            for counter in self.shared
        ]
        for combination in product(*possible):
            self.clock.check()
            values = dict(zip(self.shared, combination, strict=True))
            yield walks["x"].restricted(values), walks["y"].restricted(values)

    def _by_tolerance(self, axes: Sequence[Axis] = AXES) -> dict[Axis, tuple[AxisSearch, Best]]:
        """The paper's schedule: the first candidate, in lexicographic order, that aligns at the least tolerance."""
        self.undecided = self.left_out = False
        out: dict[Axis, tuple[AxisSearch, Best]] = {}
        walks: dict[Axis, AxisSearch] = {}
        for tolerance in self.tolerances:
            walks = {axis: self._walk(axis, tolerance) for axis in axes if axis not in out}
            if self.shared:
                for side_x, side_y in self._pairs(walks):
                    x = self._first_aligned(side_x)
                    y = self._first_aligned(side_y) if x else None
                    side_x.leave()
                    side_y.leave()
                    if x is not None and y is not None:
                        return {"x": (walks["x"], x), "y": (walks["y"], y)}
                continue
            for n, (axis, walk) in enumerate(walks.items()):
                if len(axes) > 1:
                    self.clock.allot(0.75 if n < len(walks) - 1 else 1.0)
                found, over = self._first_unless_over(walk)
                if over:  # here, where nothing is left of what may have used up the memory
                    walk.forget()
                    walk, found = self._any_aligned(axis)
                if found is not None:
                    out[axis] = (walk, found)
            if len(out) == len(axes):
                return out
        failed = next(axis for axis in axes if axis not in out)
        best = Best(complete=not self.undecided)
        raise self._failure(walks[failed], best, walks["y"] if self.shared else None)

    def _first_aligned(self, walk: AxisSearch) -> Best | None:
        """The first candidate, in lexicographic order, that aligns and can be sized."""
        progress, axis = self.clock.progress, walk.problem.axis
        self.left_out = self.left_out or not walk.whole
        with stage(self.trace, axis, "search"):
            for n, candidate in enumerate(walk.in_order(), 1):
                progress.at("alignment", axis, candidate=n, of=n)
                case = walk.case(candidate)
                solved = walk.solve(case)
                if self.trace is not None:
                    self.trace.tried(walk, case)
                self.undecided = self.undecided or any(run.cut for run in case.runs)
                if solved is not None:
                    sure = not (self.left_out or self.undecided)  # of lesser tolerances too
                    bound = solved.cost if sure else 0.0
                    return Best(solved, bound, not self.undecided, whole=not self.left_out)
        return None

    def _first_unless_over(self, walk: AxisSearch) -> tuple[Best | None, bool]:
        """The same; and whether time or memory were over before."""
        try:
            return self._first_aligned(walk), False
        except Stopped as stop:
            if stop.asked:
                raise
            return None, True

    def _any_aligned(self, axis: Axis) -> tuple[AxisSearch, Best | None]:
        """Any layout of an axis at the largest tolerance, for when the time is up.

        The default objective, which is not degenerate, finds one soon.
        """
        gc.collect()
        start_afresh()
        walk = self._walk(axis, self.tolerances[-1], self.clock.last_attempt())
        other = AxisSearch(walk.problem, Objective(), walk.tolerance, check=walk.check, found=walk.found)
        answer = other.best().solved
        solved = None if answer is None else adopted(walk, answer)
        if solved is None:
            raise Stopped
        return walk, Best(solved, 0.0, False)

    def _assemble(self, solved: Mapping[Axis, tuple[AxisSearch, Best]]) -> Layout:
        warnings: list[str] = []
        counters: dict[str, int] = {}
        axes: dict[Axis, AxisLayout] = {}
        complete = True
        for axis in AXES:
            own = self._answer(axis, *solved[axis])
            counters.update(own.counters)
            axes[axis] = own.layout
            complete = complete and own.complete
            warnings += own.warnings
        with stage(self.trace, "", "merging"):
            shapes, holes, told = self._merged(axes)
            warnings += told
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
        )

    def _answer(self, axis: Axis, walk: AxisSearch, best: Best) -> AxisAnswer:
        """What the best of an axis comes to, with what there is to say about it."""
        answer = best.solved
        assert answer is not None
        made = axis_layout(self.design, walk.problem, best, answer)
        warnings = list(axis_warnings(walk, answer))
        if not made.proven:
            warnings += cut_warnings(walk, best, self.clock)
        if self.trace is not None:
            self.trace.answer(walk, answer, made, best.complete)
        return AxisAnswer(
            made,
            dict(answer.candidate.counters),
            answer.columns,
            tuple(warnings),
            best.complete,
            walk.problem,
            best,
        )

    def _merged(
        self, axes: Mapping[Axis, AxisLayout]
    ) -> tuple[tuple[PlacedShape, ...], tuple[Rect, ...], list[str]]:
        """Shapes, holes, and what there is to say about these."""
        x, y = axes["x"], axes["y"]
        check = self.clock.closing()
        self.clock.progress.at("merging", "")
        try:
            shapes = merge(self.design, x, y, check)
        except Stopped:
            raise ran_out(self.design, self.clock, list(self.problems.values())) from None
        holes = find_holes(self.design.canvas, shapes)
        try:
            return shapes, holes, hole_warnings(self.design, x, y, holes, check)
        except Stopped:
            return (
                shapes,
                holes,
                [f"There are {len(holes)} holes; the time was over before they were explained."],
            )


def kept_as(
    problems: tuple[AxisProblem, ...],
    objective: Objective,
    tolerances: tuple[float, ...] = TOLERANCES,
    search: str = "best",
) -> Hashable:
    """What a complete answer is kept under."""
    return problems, objective, tolerances, search


def spelled_as(problem: AxisProblem, objective: Objective) -> Hashable:
    """What the answer found last for the same patterns is kept under, whatever the sizes."""
    return problem.axis, problem.groups, problem.patterns, objective


def last_as(problem: AxisProblem, objective: Objective) -> Hashable:
    """What the answer found last on an axis is kept under, whatever has been edited but its groups' rows."""
    return problem.axis, problem.groups, objective


_Rank = tuple[float, int, float, tuple[int, ...]]
"""J, minus the columns, deviation, values of the shared counters."""


def _less(a: _Rank, b: _Rank) -> bool:
    """In this order; costs and deviations that are all but equal are equal."""
    if abs(a[0] - b[0]) > EPS:
        return a[0] < b[0]
    if a[1] != b[1]:
        return a[1] < b[1]
    if abs(a[2] - b[2]) > EPS:
        return a[2] < b[2]
    return a[3] < b[3]


def _values_in(walk: AxisSearch, counter: str) -> set[int]:
    """Values of a counter that every pattern it stands in has a word for."""
    sets = [
        {word.counters[counter] for word in walk.found[name].words}
        for name, pattern in walk.problem.patterns
        if counter in pattern.counters
    ]
    return set.intersection(*sets)
