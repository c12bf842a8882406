"""The player: one timeline over all events, each as a sentence, and the code of what is played."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from traitlets import Bool

from .captions import caption
from .sheet import table
from .timeline import STAGES, segments
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["PlayerView"]


class PlayerView(TraceView):
    """Play, pause, step, scrub, jump to a stage; all views of the trace follow.

    Parameters
    ----------
    code
        Whether the code of what is played is shown from the start.
    """

    _shows = "player"
    _needs = ("captions",)

    code = Bool(False).tag(sync=True)

    def __init__(self, source: Any, **traits: Any) -> None:
        super().__init__(source, **traits)
        if self.code:  # a saved page can't ask for it
            self.channel.provide(["code"])

    @property
    def frame(self) -> pd.DataFrame:
        """Seconds by stage: `Trace.timings`."""
        return self.model.trace.timings()

    def to_html(self) -> str:
        """A table of the stages, each with its last event as a sentence."""
        events = self.model.trace.events
        rows = [
            (
                own.axis or "x, y",
                STAGES[own.stage],
                str(own.last - own.first + 1),
                "" if own.seconds is None else f"{1000 * own.seconds:.3g} ms",
                caption(events[max(own.first, own.last - 1)]),
            )
            for own in segments(events)
        ]
        return table(
            f"Stages of {self.model.name}", ("axis", "stage", "events", "time", "near its end"), rows
        )
