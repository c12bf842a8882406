"""A whole design with a learner's functions: its candidates one after the other, on each axis (the paper's 5.1)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import islice
from math import inf

from ...design.model import Axis, Design
from ..alignment.core.instances import session
from ..alignment.group import Group
from ..alignment.single import alignment_of
from ..assembly.axes import axis_layout
from ..assembly.shapes import find_holes, merge
from ..candidates.stream import Candidate
from ..model.layout import Layout
from ..model.objective import Objective
from ..model.precision import EPS
from ..model.problem import axis_problem
from ..selection.axis import AxisSearch, Best, Solved
from .deepening import Deepened, deepen
from .functions import ExperimentError, Functions
from .views import Choice

__all__ = ["AxisRun", "layout_of", "run_axis"]

_CANDIDATES = 2000
"""An experiment goes through no more."""


@dataclass(slots=True)
class AxisRun:
    """What one axis came to.

    Attributes
    ----------
    tried
        Candidates that were aligned, of `candidates`.
    """

    axis: Axis
    walk: AxisSearch
    solved: Solved | None = None
    cut: bool = False
    candidates: int = 0
    tried: int = 0
    nodes: int = 0
    passes: int = 0
    searches: list[Deepened] = field(default_factory=list)

    @property
    def cost(self) -> float:
        """J of the answer, metres; infinite where there is none."""
        return inf if self.solved is None else self.solved.cost

    @property
    def answer(self) -> str:
        """Its alignments, group by group."""
        if self.solved is None:
            return "none"
        told = [
            str(alignment_of(group, priced, k))
            for group, (priced, k) in zip(self.solved.groups, self.solved.parts, strict=True)
        ]
        return "; ".join(told)


def run_axis(
    design: Design,
    axis: Axis,
    functions: Functions,
    objective: Objective,
    tolerances: Sequence[float],
    *,
    held: Mapping[str, int],
    table: bool = True,
    nodes: int = 20_000,
    check: Callable[[], None] | None = None,
) -> AxisRun:
    """The best candidate of an axis; or, under the paper's objective, the first one that aligns.

    Parameters
    ----------
    held
        Values of counters that the other axis has as well.
    """
    problem = axis_problem(design, axis)
    steps = tolerances if objective.plain else tolerances[-1:]
    run: AxisRun | None = None
    with session():
        for tolerance in steps:
            walk = AxisSearch(problem, objective, tolerance * problem.canvas, "ida", check)
            walk.enumerate()
            walk = walk.restricted(held) if held else walk
            before, run = run, AxisRun(axis, walk)
            if before is not None:
                run.candidates = before.candidates
                run.nodes, run.passes, run.tried, run.searches = (
                    before.nodes,
                    before.passes,
                    before.tried,
                    before.searches,
                )
            _go(run, functions, table, nodes, check)
            if run.solved is not None or run.cut:
                break
    assert run is not None
    return run


def _go(
    run: AxisRun, functions: Functions, table: bool, nodes: int, check: Callable[[], None] | None
) -> None:
    walk, plain = run.walk, run.walk.objective.plain
    bound, order = functions.asked("bound"), functions.asked("candidate_order")
    given = list(islice(walk.in_order(), _CANDIDATES + 1))
    if len(given) > _CANDIDATES:
        raise ExperimentError(
            f"{run.axis}: this design has more than {_CANDIDATES:,} candidates; experiments are made on small ones: "
            "set a counter, or take a smaller canvas"
        )
    listed: list[tuple[tuple[float, ...], int, float, Candidate]] = []
    for n, candidate in enumerate(given):
        choice = Choice(run.axis, candidate.words, candidate.counters, walk.problem.canvas, candidate.bound)
        least = candidate.bound if bound is None else bound.metres(choice)
        if functions.column_error is not None and bound is None:
            least = 0.0  # it is true of the product's errors alone
        key: tuple[float, ...] = () if plain else (least,)
        if order is not None and len(given) > 1:  # where there is no choice nobody is asked
            key = order.key(choice)
        listed.append((key, n, least, candidate))
    run.candidates += len(listed)
    for _, _, least, candidate in sorted(listed, key=lambda own: own[:2]):
        if least > run.cost + EPS:
            continue
        _try(run, candidate, functions, table, nodes, check)
        if run.cut or (plain and run.solved is not None):
            return


def _try(
    run: AxisRun,
    candidate: Candidate,
    functions: Functions,
    table: bool,
    nodes: int,
    check: Callable[[], None] | None,
) -> None:
    """Align a candidate, within what the best so far leaves, and size it."""
    walk = run.walk
    case = walk.case(candidate)
    walk.open(case)
    run.tried += 1
    ties = []
    for cluster in case.clusters:
        found = _deepen(run, [case.groups[g] for g in cluster], functions, table, nodes, check)
        if not found.found.ties:
            return
        ties.append(found.found.ties)
    solved = walk.size(case, ties)
    if solved is None and not run.cut:  # no sizes of symbols make these; others may do
        case.clusters = [list(range(len(case.groups)))]
        found = deepen(
            case.groups,
            functions,
            cap=run.cost,
            table=table,
            nodes=nodes,
            check=check,
            accept=lambda priced: walk.size(case, [[priced]]) is not None,
        )
        _count(run, found)
        solved = walk.size(case, [found.found.ties]) if found.found.ties else None
    if solved is not None and solved.beats(run.solved):
        run.solved = solved


def _deepen(
    run: AxisRun,
    groups: Sequence[Group],
    functions: Functions,
    table: bool,
    nodes: int,
    check: Callable[[], None] | None,
) -> Deepened:
    found = deepen(groups, functions, cap=run.cost, table=table, nodes=nodes, check=check)
    _count(run, found)
    return found


def _count(run: AxisRun, found: Deepened) -> None:
    run.nodes += found.nodes
    run.passes += len(found.passes)
    run.cut = run.cut or found.found.cut
    run.searches.append(found)


def layout_of(design: Design, runs: Sequence[AxisRun]) -> Layout | None:
    """The layout of both axes; None where one has none."""
    if any(run.solved is None for run in runs):
        return None
    axes = {
        run.axis: axis_layout(design, run.walk.problem, Best(run.solved, run.cost, not run.cut), run.solved)
        for run in runs
        if run.solved is not None
    }
    counters = {name: n for run in runs if run.solved for name, n in run.solved.candidate.counters.items()}
    shapes = merge(design, axes["x"], axes["y"])
    holes = find_holes(design.canvas, shapes)
    complete = not any(run.cut for run in runs)
    return Layout(
        design.name, design.canvas, counters, axes["x"], axes["y"], shapes, holes, (), complete, design
    )
