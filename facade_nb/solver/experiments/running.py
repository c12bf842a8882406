"""Two runs of one case or design, and the comparison with the best there is."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf
from typing import Any

from ...design.errors import NoLayout
from ...design.model import AXES, Design
from ..alignment.core.instances import session
from ..alignment.core.search import search_best
from ..alignment.found import Found
from ..alignment.group import Group
from ..alignment.paper.deepening import Ends
from ..alignment.pricing import Structure
from ..alignment.single import alignment_of
from ..effort import Stopped
from ..model.objective import Objective
from ..model.problem import axis_problem
from ..schedules.tolerances import TOLERANCES
from ..solution import solve
from .axes import AxisRun, layout_of, run_axis
from .cases import Case
from .deepening import Deepened, OwnSide, deepen
from .functions import ExperimentError, Functions
from .outcome import Counterexample, Experiment, Run
from .views import Choice

__all__ = ["compared", "experiment"]

Checked = Callable[[], None]

_LEAST = 1e-6
"""What is less is no difference, metres."""


def experiment(
    case: Case | Design,
    *,
    heuristic: Callable[..., Any] | None = None,
    column_error: Callable[..., Any] | None = None,
    constraint: Callable[..., Any] | None = None,
    tie_break: Callable[..., Any] | None = None,
    next_limit: Callable[..., Any] | None = None,
    bound: Callable[..., Any] | None = None,
    candidate_order: Callable[..., Any] | None = None,
    objective: Objective | None = None,
    table: bool = True,
    tolerances: Sequence[float] = TOLERANCES,
    nodes: int = 20_000,
    time_limit: float = 30.0,
) -> Experiment:
    """Run the paper's search twice, as it is and with your functions in it, and say what that has changed.

    Parameters
    ----------
    case
        Words to be aligned (`Case`), or a design.
    heuristic
        Of a `Node`: metres that are still to come. Exact as long as it never says more than the truth.
    column_error
        Of a `Column`: metres by which its elements disagree, in the place of Eq. 9.
    constraint
        Of a `Column`: whether it is allowed, beside C1 to C4.
    tie_break
        Of a `Column`: a number, or a tuple of numbers; of columns with the same f, the least is followed first.
    next_limit
        Of a `Pass` that found nothing: the limit of the next one.
    bound
        Of a `Choice`: metres that a candidate costs at least. Dearer ones than the best so far are not aligned.
    candidate_order
        Of a `Choice`: a number, or a tuple of numbers; the least is aligned first.
    objective
        Yours; the other run has `Objective()`, or the paper's where yours is plain.
    table
        Whether your run keeps a table of visited nodes.
    nodes, time_limit
        Each search gives up after so many nodes; all after so many seconds.

    Raises
    ------
    ExperimentError
        If one of the functions raises, or returns what cannot be used. It names the function and the line.
    """
    functions = Functions(heuristic, column_error, constraint, tie_break, next_limit, bound, candidate_order)
    if not isinstance(case, (Case, Design)):
        raise TypeError(f"experiment: expected a Case or a Design, found {type(case).__name__}")
    return compared(case, functions, objective, table, tuple(tolerances), nodes, time_limit)


def compared(
    case: Case | Design,
    functions: Functions,
    objective: Objective | None,
    table: bool = True,
    tolerances: Sequence[float] = TOLERANCES,
    nodes: int = 20_000,
    time_limit: float = 30.0,
) -> Experiment:
    """See `experiment`."""
    end = time.monotonic() + time_limit

    def check() -> None:
        if time.monotonic() > end:
            raise Stopped

    mine = objective or Objective()
    usual = Objective.paper() if mine.plain else Objective()
    changed = functions.changed
    if mine != usual:
        changed = (*changed, f"objective = {mine}")
    if not table:
        changed = (*changed, "no table of visited nodes")
    if isinstance(case, Case):
        for role in ("bound", "candidate_order"):
            if getattr(functions, role) is not None:
                raise ExperimentError(
                    f"{role} is asked about the candidates of a design; words alone have none"
                )
        out = _of_words(case, functions, mine, usual, table, nodes, check)
    else:
        if not case.stack:
            raise ExperimentError(
                f"{case.name or 'this design'} has no layers, so there is nothing to search"
            )
        out = _of_design(case, functions, mine, usual, table, tolerances, nodes, check)
    return replace(out, changed=changed)


def _of_words(
    case: Case,
    functions: Functions,
    mine: Objective,
    usual: Objective,
    table: bool,
    nodes: int,
    check: Checked,
) -> Experiment:
    yours_at, ours_at = case.group(mine), case.group(usual)
    yours = deepen([yours_at], functions, table=table, nodes=nodes, check=check)
    ours = deepen([ours_at], Functions(), nodes=nodes, check=check)
    truth = _truth([yours_at], functions, nodes, check)
    best = truth.best.cost if truth.best is not None else inf
    run = _run_of(yours_at, yours)
    exact = None if truth.cut or yours.found.cut else run.cost <= best + _LEAST
    counter = None
    if truth.best is not None and exact is not None:
        reason = _overestimate([yours_at], functions, truth.best.structure, best)
        if reason or not exact:
            better = str(alignment_of(yours_at, truth.best, 0))
            counter = Counterexample(str(case), run.cost, best, run.answer, better, reason)
    known = -inf if truth.cut else best
    return Experiment(str(case), (), (_run_of(ours_at, ours),), (run,), (known,), exact, counter)


def _run_of(group: Group, done: Deepened) -> Run:
    best = done.found.best
    alignment = None if best is None else replace(alignment_of(group, best, 0), cost=best.cost)
    return Run(
        "",
        done.nodes,
        tuple(done.passes),
        inf if best is None else best.cost,
        "none" if alignment is None else str(alignment),
        done.found.cut,
        visits=tuple(done.visits),
        alignment=alignment,
    )


def _truth(groups: Sequence[Group], functions: Functions, nodes: int, check: Checked) -> Found:
    """The best there is: by another search; with columns of the learner's, by this one without a heuristic."""
    if not functions.own_columns:
        try:
            with session():
                return search_best(groups, nodes=100 * nodes, check=check)
        except Stopped:
            return Found(cut=True)
    return deepen(groups, _without_bounds(functions), nodes=5 * nodes, check=check).found


def _nothing(_: object) -> float:
    return 0.0


def _without_bounds(functions: Functions) -> Functions:
    return Functions(
        heuristic=_nothing,
        column_error=functions.column_error,
        constraint=functions.constraint,
        bound=_nothing,
    )


def _overestimate(groups: Sequence[Group], functions: Functions, structure: Structure, best: float) -> str:
    """The first node on the way to the best alignment of which too much is said; empty: none."""
    if functions.heuristic is None and functions.column_error is None:
        return ""
    side = OwnSide(Ends(groups, None).forward.lattices, functions)
    half = side.root()
    who = "your heuristic" if functions.heuristic is not None else "the product's heuristic, made for Eq. 9,"
    for n, columns in enumerate(structure):
        for column in columns:
            if half.bound > best + _LEAST:
                h = half.bound - half.cost
                return (
                    f"At {side.node(half)} g is {half.cost:.3f} m and {who} says h = {h:.3f} m, "
                    f"so f = {half.bound:.3f} m; but a whole alignment through it costs {best:.3f} m."
                )
            wanted = [(option.letters, option.target >> 2) for option in column]
            edge = next(
                (
                    own
                    for own in side.own[n].edges(half.state, half.owed)
                    if [(option.letters, option.target >> 2) for option in own.options] == wanted
                ),
                None,
            )
            child = None if edge is None else side._extend(half, edge)
            if child is None:
                return ""
            half = child
    return ""


def _of_design(
    design: Design,
    functions: Functions,
    mine: Objective,
    usual: Objective,
    table: bool,
    tolerances: Sequence[float],
    nodes: int,
    check: Checked,
) -> Experiment:
    used = [{name for name, _ in axis_problem(design, axis).counters} for axis in AXES]
    held: dict[str, int] = {}
    layout = None
    try:
        layout = solve(design, objective=mine, tolerances=tolerances)
        held = {name: layout.counters[name] for name in used[0] & used[1]}
    except NoLayout:
        pass
    yours: list[AxisRun] = []
    ours: list[AxisRun] = []
    best: list[float] = []
    exact: bool | None = True
    counter: Counterexample | None = None
    own = Functions()
    for axis in AXES:
        try:
            ours.append(run_axis(design, axis, own, usual, tolerances, held=held, nodes=nodes, check=check))
            run = run_axis(
                design, axis, functions, mine, tolerances, held=held, table=table, nodes=nodes, check=check
            )
            yours.append(run)
            known = ours[-1]
            if functions.own_columns or mine != usual:
                known = run_axis(
                    design,
                    axis,
                    _without_bounds(functions) if functions.own_columns else own,
                    mine,
                    tolerances,
                    held=held,
                    nodes=5 * nodes,
                    check=check,
                )
        except Stopped:
            raise ExperimentError(
                f"{axis}: this design takes longer than the time limit; experiments are made on small ones"
            ) from None
        value = known.cost
        if not functions.own_columns and layout is not None and layout.complete:
            value = layout.along(axis).cost
        sure = not (run.cut or known.cut)
        best.append(value if sure else -inf)
        fine = run.cost <= value + _LEAST
        exact = (None if not sure or exact is None else exact and fine) if exact is not False else False
        reason = _why(run, known, functions) if sure and not mine.plain else ""
        if sure and counter is None and (reason or not fine):
            counter = Counterexample(
                f"{design.name}, {axis}", run.cost, value, run.answer, known.answer, reason
            )
    return Experiment(
        design.name,
        (),
        tuple(map(_told, ours)),
        tuple(map(_told, yours)),
        tuple(best),
        exact,
        counter,
        layout_of(design, yours),
        mine.plain,
    )


def _told(run: AxisRun) -> Run:
    return Run(
        run.axis,
        run.nodes,
        tuple(limit for own in run.searches for limit in own.passes),
        run.cost,
        run.answer,
        run.cut,
        run.candidates,
        run.tried,
        tuple(visit for own in run.searches for visit in own.visits),
    )


def _why(run: AxisRun, known: AxisRun, functions: Functions) -> str:
    """Of what candidate, or of what node on the way to the best alignment, too much was said."""
    solved = known.solved
    if solved is None:
        return ""
    asked = functions.asked("bound")
    if asked is not None:
        candidate = solved.candidate
        choice = Choice(
            run.axis, candidate.words, candidate.counters, run.walk.problem.canvas, candidate.bound
        )
        said = asked.metres(choice)
        if said > known.cost + _LEAST:
            return (
                f"Your bound says that the candidate {choice} costs {said:.3f} m at least; "
                f"but it costs {known.cost:.3f} m."
            )
    seen: set[int] = set()
    for priced, _ in solved.parts:
        if id(priced) in seen:
            continue
        seen.add(id(priced))
        together = [g for g, (own, _) in zip(solved.groups, solved.parts, strict=True) if own is priced]
        reason = _overestimate(together, functions, priced.structure, priced.cost)
        if reason:
            return reason
    return ""
