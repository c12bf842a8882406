"""What one call of `solve` asks: its searches of axes, by name of axis and tolerance."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ...design.model import AXES, Axis, Design
from ..analysis.systems import analyse, refuted
from ..budget import Clock
from ..model.objective import Objective
from ..model.problem import AxisProblem, axis_problem
from ..selection.axis import AxisSearch, Best
from ..trace import Recorder, stage
from ..words.enumeration import across
from ..words.instances import Range

__all__ = ["Found", "Run", "Unsolved"]

Found = dict[Axis, tuple[AxisSearch, Best]]
"""The search of each axis, with the best that it came to."""


class Unsolved(Exception):
    """An axis has no layout, or none was found in time; what it was that was searched, to be explained.

    Attributes
    ----------
    walk, best
        The search of the axis that is to blame, and what it came to.
    other
        The search of the other axis, where a counter ties them.
    """

    def __init__(self, walk: AxisSearch, best: Best, other: AxisSearch | None = None) -> None:
        super().__init__(walk.problem.axis)
        self.walk, self.best, self.other = walk, best, other


class Run:
    """One call of `solve`.

    Attributes
    ----------
    problems
        What each axis asks for.
    shared
        Names of the counters that stand on both axes, sorted. They tie them.
    trial
        A run that only looks whether an edit would help: nothing of it is kept for later calls.
    """

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
        self._analysed: set[Axis] = set()
        self._walks: list[AxisSearch] = []

    def close(self) -> None:
        """Let go of all that was searched, except by a trace, which is still to be read."""
        if self.trace is None:
            for walk in self._walks:
                walk.forget()
        self._walks.clear()

    def walk(self, axis: Axis, tolerance: float, check: Callable[[], None] | None = None) -> AxisSearch:
        """The search of an axis, its words enumerated.

        Parameters
        ----------
        tolerance
            A fraction of the canvas.
        check
            What is called now and then instead of the run's clock.

        Raises
        ------
        Unsolved
            Where pattern analysis proves that there is no layout.
        Stopped
            When the time is over, or somebody wants it to end.
        """
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
        self._walks.append(walk)
        self.clock.progress.at("words", axis)
        self._analyse(walk)
        with stage(self.trace, axis, "words"):
            walk.enumerate(self._across(axis))
        return walk

    def best(self, walk: AxisSearch, cap: float = float("inf")) -> Best:
        """The best of an axis, of cost `cap` at most, told to the trace."""
        with stage(self.trace, walk.problem.axis, "search"):
            best = walk.best(cap)
            self.clock.full = self.clock.full or best.full
            if self.trace is not None:
                self.trace.judged(walk)
        return best

    def _across(self, axis: Axis) -> dict[str, Range]:
        """Between which values of the shared counters the other axis has words."""
        if not self.shared:
            return {}
        other = self.problems["y" if axis == "x" else "x"]
        return across(other, self.shared, self.tolerances[-1], self.clock.check)

    def _analyse(self, walk: AxisSearch) -> None:
        """Pattern analysis (supplement 3.1), told to the trace; a contradiction that is a proof ends the search."""
        problem = walk.problem
        if problem.axis in self._analysed:
            return
        self._analysed.add(problem.axis)
        if self.trace is not None:
            with stage(self.trace, problem.axis, "analysis"):
                self.trace.analysed(problem.axis, analyse(problem, self.clock.check))
        if refuted(problem, self.clock.check) is not None:
            raise Unsolved(walk, Best())
