"""The solver's front door: a design in, a layout out (the paper's section 5; docs/problem.md)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

from ..design.errors import DesignError, NoLayout
from ..design.limits import range_faults
from ..design.model import AXES, Axis, Design
from . import tuning
from .alignment.core.instances import session
from .assembly.axes import axis_layout, axis_warnings, cut_warnings
from .assembly.shapes import find_holes, hole_warnings, merge
from .budget import Clock, Stopped
from .cache import CACHE
from .diagnosis.explanation import explain, ran_out
from .diagnosis.refusal import Blame
from .diagnosis.remedies import Tried
from .model.layout import AxisLayout, Layout, PlacedShape, Rect
from .model.objective import Objective
from .model.problem import AxisProblem
from .schedules.apart import apart, unless_known
from .schedules.run import Found, Run, Unsolved
from .schedules.tied import tied
from .schedules.tolerances import TOLERANCES, by_tolerance
from .selection.axis import AxisSearch, Best
from .selection.clusters import PLAINER
from .trace import Recorder, stage

__all__ = [
    "AxisAnswer",
    "compose",
    "forget",
    "solve",
    "solve_axis",
]

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
        with session(), _closing(Run(design, chosen, TOLERANCES, "best", clock, None)) as run:
            run.shared = []
            return _answer(run, axis, *_found(run, (axis,))[axis])
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
    with session() as compiled, _closing(Run(design, objective, tolerances, search, clock, log)) as run:
        layout = _assembled(run, _found(run, AXES))
        return replace(layout, warnings=(*layout.warnings, _SLOWLY)) if compiled.without else layout


@contextmanager
def _closing(run: Run) -> Iterator[Run]:
    """Let a run's searches go at its end; say so where the time or the memory was over before."""
    try:
        yield run
    except (Stopped, MemoryError) as stop:
        run.clock.full = run.clock.full or not isinstance(stop, Stopped) or stop.full
        raise ran_out(run.design, run.clock, list(run.problems.values())) from None
    finally:
        run.close()


def _found(run: Run, axes: Sequence[Axis]) -> Found:
    """The best of some axes; of both, where a counter ties them. Raises `NoLayout`, which explains why."""
    try:
        if run.shared:
            return unless_known(run, AXES, by_tolerance if run.objective.plain else tied)
        out: Found = {}
        for n, axis in enumerate(axes):
            run.clock.allot(0.75 if n < len(axes) - 1 else 1.0)
            out |= unless_known(run, (axis,), by_tolerance if run.objective.plain else apart)
        return out
    except Unsolved as none:
        raise _explained(run, none) from None


def _explained(run: Run, none: Unsolved) -> NoLayout:
    """Why there is no layout, and what would help; a trial does not ask."""
    if run.trial:
        return NoLayout("")
    end = run.clock.check.seconds + tuning.REMEDIES

    def works(design: Design, tolerance: float | None) -> Tried | None:
        left = end - run.clock.check.seconds
        if left <= 0:
            raise Stopped
        tolerances = run.tolerances if tolerance is None else (tolerance,)
        clock = Clock(None, parent=run.clock, most=min(left, tuning.REMEDY))
        other = Run(design, run.objective, tolerances, run.search, clock, None, trial=True)
        try:
            return _tried(other, AXES if none.other else (none.walk.problem.axis,))
        finally:
            other.close()

    return explain(
        Blame(run.design, none.walk, none.best, run.clock, run.tolerances, works, none.other, run.shared)
    )


def _tried(run: Run, axes: Sequence[Axis]) -> Tried | None:
    """What some axes come to; None where there is no layout, or none was found in time."""
    try:
        solved = _found(run, axes)
    except (NoLayout, Stopped):
        return None
    own = [best.solved for _, best in solved.values() if best.solved is not None]
    return Tried(
        {name: size for one in own for name, size in one.sized.sizes.items()},
        {name: value for one in own for name, value in one.candidate.counters.items()},
    )


def _assembled(run: Run, solved: Found) -> Layout:
    """The layout of both axes' best."""
    warnings: list[str] = []
    counters: dict[str, int] = {}
    axes: dict[Axis, AxisLayout] = {}
    complete = True
    for axis in AXES:
        own = _answer(run, axis, *solved[axis])
        counters.update(own.counters)
        axes[axis] = own.layout
        complete = complete and own.complete
        warnings += own.warnings
    with stage(run.trace, "", "merging"):
        shapes, holes, told = _merged(run, axes)
        warnings += told
    return Layout(
        run.design.name,
        run.design.canvas,
        dict(sorted(counters.items())),
        axes["x"],
        axes["y"],
        shapes,
        holes,
        tuple(warnings),
        complete,
        run.design,
    )


def _answer(run: Run, axis: Axis, walk: AxisSearch, best: Best) -> AxisAnswer:
    """What the best of an axis comes to, with what there is to say about it."""
    answer = best.solved
    assert answer is not None
    made = axis_layout(run.design, walk.problem, best, answer)
    warnings = list(axis_warnings(walk, answer))
    if not made.proven:
        warnings += cut_warnings(walk, best, run.clock)
    if run.trace is not None:
        run.trace.answer(walk, answer, made, best.complete)
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
    run: Run, axes: Mapping[Axis, AxisLayout]
) -> tuple[tuple[PlacedShape, ...], tuple[Rect, ...], list[str]]:
    """Shapes, holes, and what there is to say about these."""
    x, y = axes["x"], axes["y"]
    check = run.clock.closing()
    run.clock.progress.at("merging", "")
    try:
        shapes = merge(run.design, x, y, check)
    except Stopped:
        raise ran_out(run.design, run.clock, list(run.problems.values())) from None
    holes = find_holes(run.design.canvas, shapes)
    try:
        return shapes, holes, hole_warnings(run.design, x, y, holes, check)
    except Stopped:
        return (
            shapes,
            holes,
            [f"There are {len(holes)} holes; the time was over before they were explained."],
        )
