"""What a `NoLayout` is made of: what is known of a failed search, and how the blame is told."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from ...design.errors import NoLayout, Suggestion, listed
from ...design.model import Axis, Design
from ..budget import Clock, Stopped
from ..model.problem import AxisProblem
from ..selection.axis import AxisSearch, Best
from .remedies import Remedies, Works

__all__ = [
    "Blame",
    "canvas_of",
    "is_held",
    "layers_of",
    "names_of",
    "refuse",
    "remedies_of",
    "short",
    "tolerance",
]

_EXTENT: dict[Axis, str] = {"x": "wide", "y": "high"}


@dataclass(frozen=True, slots=True)
class Blame:
    """What is known of a failed search.

    Attributes
    ----------
    walk, best
        The axis that failed, and how its search ended.
    other, shared
        The other axis and the counters that stand on both, where they tie the two.
    tolerances
        Those that were tried, fractions of the canvas.
    works
        See `remedies.Works`; None where nothing is to be tried.
    """

    design: Design
    walk: AxisSearch
    best: Best
    clock: Clock
    tolerances: Sequence[float]
    works: Works | None = None
    other: AxisSearch | None = None
    shared: Sequence[str] = ()


def remedies_of(blame: Blame, axis: Axis) -> Remedies:
    """Tries what would help, on an axis."""
    return Remedies(blame.design, axis, blame.works or (lambda _design, _tolerance: None))


def refuse(
    blame: Blame,
    problem: AxisProblem,
    text: str,
    constraint: str,
    found: Iterable[Suggestion] = (),
    *,
    patterns: Sequence[str] = (),
    symbols: Sequence[str] = (),
    counters: Sequence[str] = (),
    most: int = 2,
) -> NoLayout:
    """The error, with the first changes that work; those that change one field alike are named once."""
    helpful: dict[tuple[str, ...], Suggestion] = {}
    try:
        for suggestion in found:
            helpful.setdefault(suggestion.path, suggestion)
            if len(helpful) == most:
                break
    except Stopped:
        pass  # what was found until now is what is named
    if helpful:
        text += " It would work with " + ", or with ".join(own.text for own in helpful.values()) + "."
    group = problem.groups[0][0] if len(problem.groups) == 1 else ""
    return NoLayout(
        text,
        problem.axis,
        patterns=tuple(patterns),
        symbols=tuple(symbols),
        counters=tuple(counters),
        group=group,
        layers=layers_of(blame.design, problem.axis, patterns, group),
        constraint=constraint,
        suggestions=tuple(helpful.values()),
    )


def layers_of(design: Design, axis: str, patterns: Sequence[str], group: str) -> tuple[str, ...]:
    """The visible layers, topmost first, that use one of the patterns, or are in the group if none is named."""
    if axis not in ("x", "y"):
        return ()
    own = [(layer.name, layer.x if axis == "x" else layer.y) for layer in design.stack]
    return tuple(name for name, on in own if (on.pattern in patterns if patterns else on.group == group))


def is_held(problem: AxisProblem, counter: str) -> bool:
    """Whether a counter is held back by a value or a bound."""
    own = dict(problem.counters).get(counter)
    return own is not None and (own.max is not None or own.value is not None or own.min > 0)


def tolerance(blame: Blame, helper: Remedies) -> Iterator[Suggestion]:
    """A larger tolerance, as an argument of `solve`."""
    now = max(blame.tolerances)
    for more in (0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5):
        if more > now:
            wider = (*blame.tolerances, more)
            found = helper.working(
                [Suggestion(f"a tolerance of {more:g} times the canvas", ("tolerances",), wider)]
            )
            if found:
                yield from found
                return


def names_of(names: Sequence[str]) -> str:
    """Names in quotes, with commas."""
    return listed(names)


def short(word: object) -> str:
    """A word, cut where it is too long for a sentence."""
    text = str(word)
    return text if len(text) <= 60 else text[:57] + "…"


def canvas_of(problem: AxisProblem) -> str:
    """``4 m wide``."""
    return f"{problem.canvas:.4g} m {_EXTENT[problem.axis]}"
