"""The solver's trace: notes taken while it works, and the events that they make when somebody reads them.

- `recorder`: what the search calls; tuples in lists
- `narration`: from notes to events (`facade_nb.solver.events`)
- `trace`: the sequence of events, as document and as DataFrames (`codec`, `tables`)
- `replay`: from events to the layout
- `lattice`: the network of a group as a whole, with what forbids each edge
- `active_set`: the steps of an active-set method
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .recorder import Recorder, Walk, stage

if TYPE_CHECKING:
    from .trace import Events, Trace

__all__ = ["Events", "Recorder", "Trace", "Walk", "stage"]


def __getattr__(name: str) -> object:
    """What only reads a trace is loaded when it is asked for, so that importing the solver stays quick."""
    if name in ("Events", "Trace"):
        from . import trace

        return getattr(trace, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
