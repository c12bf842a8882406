"""Another run of a traced solve: the same design searched with one thing changed, and what both did."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ...design import Design, NoLayout
from ...solver import Objective, Trace, solve
from ...solver.events import (
    PRUNED,
    AxisSolved,
    EdgeRefused,
    EdgeWeighed,
    LimitRaised,
    NetworkClosed,
    NodeTaken,
    TraceBegun,
)
from .networks import networks
from .timeline import begun, timeline

__all__ = ["CHANGES", "again", "counts", "run"]

Json = dict[str, Any]

CHANGES = {
    "heuristic": "without the heuristic: h = 0",
    "table": "without the table: no path is dropped for another",
    "paper": "the paper's search, deepening from both ends",
}
"""What can be changed; where the paper's search is looked at, the last is ours."""
_LIMIT = 2.0
"""Seconds that another run may take; one that is cut short has no J."""


def _asked(begun_with: TraceBegun, change: str) -> str:
    if change == "paper":
        return "best" if begun_with.search == "ida" else "ida"
    return f"no-{change}"


def again(trace: Trace, change: str) -> Trace:
    """The trace of the same design, searched otherwise."""
    asked = begun(trace)
    known = _runs.setdefault(id(trace), (trace, {}))[1]
    if change not in known:
        try:
            layout = solve(
                Design.from_dict(asked.design),
                objective=Objective(**asked.objective),
                tolerances=asked.tolerances,
                search=_asked(asked, change),
                trace=True,
                time_limit=_LIMIT,
            )
        except NoLayout as error:
            found = error.trace
        else:
            found = layout.trace
        assert found is not None
        known[change] = found
    while len(_runs) > 4:  # the oldest is let go
        del _runs[next(iter(_runs))]
    return known[change]


_runs: dict[int, tuple[Trace, dict[str, Trace]]] = {}
"""Other runs of the traces that were asked for last; each trace is held, so that its id stays its own."""


def counts(trace: Trace, axis: str) -> dict[str, float | int | None]:
    """What a search did on an axis, as far as the trace tells it."""
    own = [event for event in trace.events if event.axis == axis]
    refused = [event for event in own if isinstance(event, EdgeRefused)]
    solved = next((event for event in own if isinstance(event, AxisSolved)), None)
    dropped = sum(isinstance(event, EdgeWeighed) and event.fate != "open" for event in own)
    return {
        "nodes": sum(event.nodes for event in own if isinstance(event, NetworkClosed)),
        "told": sum(isinstance(event, NodeTaken) for event in own),
        "edges": sum(isinstance(event, EdgeWeighed) for event in own),
        "pruned": dropped + sum(event.constraint in PRUNED for event in refused),
        "passes": sum(isinstance(event, LimitRaised) for event in own),
        "J": solved.cost if solved is not None and solved.complete else None,
    }


def run(change: str) -> Callable[[Trace], Json]:
    """The piece of another run: its own timeline and networks, and what both runs did."""

    def made(trace: Trace) -> Json:
        other = again(trace, change)
        return {
            "timeline": timeline(other),
            "network": networks(other),
            "search": begun(other).search,
            "counts": {axis: [counts(trace, axis), counts(other, axis)] for axis in "xy"},
        }

    return made
