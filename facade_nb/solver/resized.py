"""An edited design with the structure that it had before the edit: at once, and seldom much worse than the best.

A keystroke seldom changes which words stand in a façade and which letters share a column. With those given, only sizes
are left to be found, by least squares, and nothing has to be searched. What comes of it is a layout of the design like
any other: its words fit, its columns are aligned, its sizes keep their bounds. Whether there is a better one is for the
search to tell.
"""

from __future__ import annotations

from collections.abc import Callable

from ..design.errors import NoLayout
from ..design.limits import range_faults
from ..design.model import AXES, Axis, Design
from .alignment.core.instances import session
from .assembly.axes import axis_layout
from .budget import Clock, Stopped
from .cache import CACHE
from .model.layout import Layout
from .model.objective import Objective
from .model.problem import AxisProblem, axis_problem
from .schedules.kept import kept_as, last_as, spelled_as
from .schedules.tolerances import TOLERANCES
from .selection.axis import AxisSearch, Best
from .selection.warm_start import adopted, carried
from .solution import AxisAnswer, compose

__all__ = ["resized"]

_HINT = "It has the structure of the layout before the last edit; there may be a better one."


def resized(design: Design, *, should_stop: Callable[[], bool] | None = None) -> Layout | None:
    """The structure of the last answer, sized for the design as it is now.

    Parameters
    ----------
    design
        A valid design; what was solved before it, in this process, is known.
    should_stop
        A function that is called now and then. If it returns true, nothing comes of it.

    Returns
    -------
    Layout or None
        A layout that is not `complete`. None where that structure does not fit any more, where none is known, where
        both axes are known to their end, so that `solve` answers as soon, and where a counter ties the axes.
    """
    if range_faults(design) or not design.stack:
        return None
    clock = Clock(None, should_stop)
    try:
        with session():
            return _resized(design, clock)
    except (Stopped, MemoryError, NoLayout):
        return None
    finally:
        clock.close()


def _resized(design: Design, clock: Clock) -> Layout | None:
    objective = Objective()
    problems = {axis: axis_problem(design, axis) for axis in AXES}
    used = [{name for name, _ in problems[axis].counters} for axis in AXES]
    if used[0] & used[1]:
        return None
    known = {axis: CACHE.answers.get(kept_as((problems[axis],), objective)) for axis in AXES}
    if all(known.values()):
        return None
    answers: dict[Axis, AxisAnswer] = {}
    for axis, problem in problems.items():
        found = known[axis]
        best = found[axis][1] if found else _adopted(problem, objective, clock)
        if best is None:
            return None
        answers[axis] = _answer(design, problem, best)
    made = compose(design, answers["x"], answers["y"])
    return Layout(
        made.name,
        made.canvas,
        made.counters,
        made.x,
        made.y,
        made.shapes,
        made.holes,
        (_HINT,),
        False,
        design,
    )


def _adopted(problem: AxisProblem, objective: Objective, clock: Clock) -> Best | None:
    """What was found before on an axis, as it is with its problem of now; None: it cannot be."""
    # The patterns as they are written now, sized otherwise, come before others that stood in their place.
    found = [CACHE.earlier.get(key(problem, objective)) for key in (spelled_as, last_as)]
    before = {id(one[1]): one for one in found if one is not None}.values()
    if not before:
        return None
    tolerance = TOLERANCES[-1] * problem.canvas
    walk = AxisSearch(problem, objective, tolerance, check=clock.check, progress=clock.progress)
    solved = None
    for asked, answer in before:
        if (asked.patterns, asked.symbols, asked.counters) == (
            problem.patterns,
            problem.symbols,
            problem.counters,
        ):
            solved = carried(walk, answer, answer.candidate)  # on another canvas: every word is one still
        else:
            if not walk.found:
                walk.enumerate()
            solved = adopted(walk, answer, respelled=True)
        if solved is not None:
            break
    walk.forget()
    for group in solved.groups if solved else ():
        group.forget()
    # Of J nothing is known but that it is no less than nothing: the search tells more.
    return None if solved is None else Best(solved, 0.0, False)


def _answer(design: Design, problem: AxisProblem, best: Best) -> AxisAnswer:
    solved = best.solved
    assert solved is not None
    made = axis_layout(design, problem, best, solved)
    return AxisAnswer(made, dict(solved.candidate.counters), solved.columns, (), best.complete, problem, best)
