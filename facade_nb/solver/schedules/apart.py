"""One axis by itself, and what is known of it from before."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from math import inf

from ...design.model import Axis
from .. import tuning
from ..budget import Stopped
from ..cache import CACHE
from ..model.precision import EPS
from ..selection.axis import AxisSearch, Best
from ..selection.warm_start import adopted, upper_bound
from .kept import kept_as, last_as, spelled_as
from .run import Found, Run, Unsolved

__all__ = ["apart", "unless_known"]


def unless_known(run: Run, axes: Sequence[Axis], find: Callable[[Run, Sequence[Axis]], Found]) -> Found:
    """Search axes unless they are the same as when they were last asked for."""
    if run.trace is not None:
        return find(run, axes)
    problems = tuple(run.problems[axis] for axis in axes)
    key = kept_as(problems, run.objective, run.tolerances, run.search)
    known: Found | None = CACHE.answers.get(key)
    if known is None:
        known = find(run, axes)
        if not run.trial:
            weight = 0.0
            for walk, best in known.values():
                walk.forget()
                for group in best.solved.groups if best.solved else ():
                    group.forget()
                weight += best.solved.weight if best.solved else 0.0
            if all(best.complete for _, best in known.values()):
                CACHE.answers.put(key, known, max(tuning.ANSWER_BYTES, weight))
    return known


def apart(run: Run, axes: Sequence[Axis]) -> Found:
    """The best of one axis; raises `Unsolved` where there is none."""
    (axis,) = axes
    walk = run.walk(axis, run.tolerances[-1])
    best = _from_before(run, walk)
    if best.solved is None:
        raise Unsolved(walk, best)
    return {axis: (walk, best)}


def _from_before(run: Run, walk: AxisSearch) -> Best:
    """The best of one axis, helped by what was found for the same patterns before some edit."""
    if run.trace is not None or run.search != "best":
        return run.best(walk)
    problem = walk.problem
    key = spelled_as(problem, run.objective)
    kept = CACHE.earlier.get(key)
    before = None if kept is None else kept[1]
    cap = inf
    with suppress(Stopped):  # then there is no time for the search either, which knows what to do
        cap = inf if before is None else upper_bound(walk, before)
    best = run.best(walk, cap)
    if best.cost > cap + EPS and best.complete:  # where symbols cannot be sized all together
        walk.start_over()
        best = run.best(walk)
    if before is not None and not best.complete:
        with suppress(Stopped):  # the time is up, but perhaps for this
            other = adopted(walk, before)
            best.solved = other if other is not None and other.beats(best.solved) else best.solved
    if best.solved is not None and not run.trial:
        weight = max(tuning.ANSWER_BYTES / 2, best.solved.weight)
        CACHE.earlier.put(key, (problem, best.solved), weight)
        CACHE.earlier.put(last_as(problem, run.objective), (problem, best.solved), weight)
    return best
