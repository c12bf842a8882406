"""`check`: whether functions keep the search exact, tried on many small cases."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from html import escape
from typing import Any

from ...design.model import Design
from ..model.objective import Objective
from .cases import Case, houses, small_cases
from .functions import Functions
from .outcome import Counterexample, Experiment
from .running import compared

__all__ = ["Verdict", "check"]


@dataclass(frozen=True, slots=True)
class Verdict:
    """What `check` says.

    Attributes
    ----------
    right, wrong, unknown
        In how many cases the answer was the best, was not, and was not known.
    worse
        The first wrong answer; None: there was none.
    overestimate
        The first node or candidate of which too much was said; None: none was seen.
    nodes, usual
        Nodes taken up in all cases: yours, and ours.
    """

    changed: tuple[str, ...]
    right: int
    wrong: int
    unknown: int
    worse: Counterexample | None
    overestimate: Counterexample | None
    nodes: int
    usual: int

    @property
    def exact(self) -> bool:
        """No wrong answer, and no bound that says too much."""
        return self.worse is None and self.overestimate is None and not self.unknown

    def __str__(self) -> str:
        total = self.right + self.wrong + self.unknown
        lines = [f"{'; '.join(self.changed) or 'nothing changed'}"]
        lines.append(
            f"The best answer in {self.right} of {total} small cases, with {self.nodes:,} nodes (ours: {self.usual:,})."
        )
        if self.unknown:
            lines.append(f"In {self.unknown} the search gave up.")
        if self.worse is not None:
            lines += ["Not exact. The smallest case that shows it:", str(self.worse)]
        elif self.overestimate is not None:
            lines += ["Right so far, but not safe: more is said than the truth.", str(self.overestimate)]
        elif not self.unknown:
            lines.append("No counterexample found. (That is no proof; a proof is yours to make.)")
        return "\n".join(lines)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return f"<pre>{escape(str(self))}</pre>"


def check(
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
    cases: int | Iterable[Case | Design] = 60,
    seed: int = 1,
) -> Verdict:
    """Try functions on many small cases, and show the first in which the answer is not the best.

    Parameters
    ----------
    heuristic, column_error, constraint, tie_break, next_limit, bound, candidate_order, objective, table
        As in `experiment`.
    cases
        How many random ones, the smallest first (or the cases themselves). What is asked of candidates is tried on
        designs of one tiny house.
    seed
        Another number gives other cases.
    """
    functions = Functions(heuristic, column_error, constraint, tie_break, next_limit, bound, candidate_order)
    own: Iterable[Case | Design]
    if not isinstance(cases, int):
        own = cases
    elif bound is not None or candidate_order is not None:
        own = houses()
    else:
        own = small_cases(cases, seed)
    done: list[Experiment] = [compared(case, functions, objective, table, time_limit=20.0) for case in own]
    worse = next((e.counterexample for e in done if e.exact is False), None)
    over = next(
        (e.counterexample for e in done if e.counterexample is not None and e.counterexample.reason), None
    )
    return Verdict(
        done[0].changed if done else (),
        sum(e.exact is True for e in done),
        sum(e.exact is False for e in done),
        sum(e.exact is None for e in done),
        worse,
        over,
        sum(e.nodes for e in done),
        sum(run.nodes for e in done for run in e.ours),
    )
