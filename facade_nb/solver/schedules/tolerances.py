"""The paper's schedule: tolerances one after the other, at each one the first candidate that aligns (section 5)."""

from __future__ import annotations

import gc
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from ...design.model import AXES, Axis
from ..alignment.core.instances import start_afresh
from ..budget import Stopped
from ..model.objective import Objective
from ..selection.axis import AxisSearch, Best
from ..selection.warm_start import adopted
from ..trace import stage
from .run import Found, Run, Unsolved

__all__ = ["TOLERANCES", "by_tolerance"]


TOLERANCES = (0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5)
"""Fractions of the canvas; the paper's schedule, and, by its last, what the default objective works within."""


@dataclass(slots=True)
class _Cuts:
    """What was not searched to its end, so that no answer after it is sure to be the first."""

    undecided: bool = False
    left_out: bool = False


def _pairs(run: Run, walks: Mapping[Axis, AxisSearch]) -> Iterator[tuple[AxisSearch, AxisSearch]]:
    """Both axes with the shared counters held at each of their possible values, in lexicographic order."""
    possible = [
        sorted(set.intersection(*(_values_in(walks[axis], counter) for axis in AXES)))
        for counter in run.shared
    ]
    for combination in product(*possible):
        run.clock.check()
        values = dict(zip(run.shared, combination, strict=True))
        yield walks["x"].restricted(values), walks["y"].restricted(values)


def by_tolerance(run: Run, axes: Sequence[Axis] = AXES) -> Found:
    """The paper's schedule: the first candidate, in lexicographic order, that aligns at the least tolerance."""
    cuts = _Cuts()
    out: Found = {}
    walks: dict[Axis, AxisSearch] = {}
    for tolerance in run.tolerances:
        walks = {axis: run.walk(axis, tolerance) for axis in axes if axis not in out}
        if run.shared:
            for side_x, side_y in _pairs(run, walks):
                x = _first_aligned(run, cuts, side_x)
                y = _first_aligned(run, cuts, side_y) if x else None
                side_x.leave()
                side_y.leave()
                if x is not None and y is not None:
                    return {"x": (walks["x"], x), "y": (walks["y"], y)}
            continue
        for n, (axis, walk) in enumerate(walks.items()):
            if len(axes) > 1:
                run.clock.allot(0.75 if n < len(walks) - 1 else 1.0)
            found, over = _first_unless_over(run, cuts, walk)
            if over:  # here, where nothing is left of what may have used up the memory
                walk.forget()
                walk, found = _any_aligned(run, axis)
            if found is not None:
                out[axis] = (walk, found)
        if len(out) == len(axes):
            return out
    failed = next(axis for axis in axes if axis not in out)
    best = Best(complete=not cuts.undecided)
    raise Unsolved(walks[failed], best, walks["y"] if run.shared else None)


def _first_aligned(run: Run, cuts: _Cuts, walk: AxisSearch) -> Best | None:
    """The first candidate, in lexicographic order, that aligns and can be sized."""
    progress, axis = run.clock.progress, walk.problem.axis
    cuts.left_out = cuts.left_out or not walk.whole
    with stage(run.trace, axis, "search"):
        for n, candidate in enumerate(walk.in_order(), 1):
            progress.at("alignment", axis, candidate=n, of=n)
            case = walk.case(candidate)
            solved = walk.solve(case)
            if run.trace is not None:
                run.trace.tried(walk, case)
            cuts.undecided = cuts.undecided or any(own.cut for own in case.runs)
            if solved is not None:
                sure = not (cuts.left_out or cuts.undecided)  # of lesser tolerances too
                bound = solved.cost if sure else 0.0
                return Best(solved, bound, not cuts.undecided, whole=not cuts.left_out)
    return None


def _first_unless_over(run: Run, cuts: _Cuts, walk: AxisSearch) -> tuple[Best | None, bool]:
    """The same; and whether time or memory were over before."""
    try:
        return _first_aligned(run, cuts, walk), False
    except Stopped as stop:
        if stop.asked:
            raise
        return None, True


def _any_aligned(run: Run, axis: Axis) -> tuple[AxisSearch, Best | None]:
    """Any layout of an axis at the largest tolerance, for when the time is up.

    The default objective, which is not degenerate, finds one soon.
    """
    gc.collect()
    start_afresh()
    walk = run.walk(axis, run.tolerances[-1], run.clock.last_attempt())
    other = AxisSearch(walk.problem, Objective(), walk.tolerance, check=walk.check, found=walk.found)
    answer = other.best().solved
    solved = None if answer is None else adopted(walk, answer)
    if solved is None:
        raise Stopped
    return walk, Best(solved, 0.0, False)


def _values_in(walk: AxisSearch, counter: str) -> set[int]:
    """Values of a counter that every pattern it stands in has a word for."""
    sets = [
        {word.counters[counter] for word in walk.found[name].words}
        for name, pattern in walk.problem.patterns
        if counter in pattern.counters
    ]
    return set.intersection(*sets)
