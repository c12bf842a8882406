"""The whole page: the player above, the façade and the events beside the views."""

from __future__ import annotations

from typing import TYPE_CHECKING

from traitlets import Bool, Int, List, Unicode

from .facade import drawn
from .player import PlayerView
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["SolverView"]


class SolverView(TraceView):
    """All views of a solve on one page; the view of the stage that is played comes by itself.

    Parameters
    ----------
    views
        Names of the views that stay on the page: ``facade``, ``player`` (the events), ``analysis``, ``words``,
        ``candidates``, and the others of docs/visible.md.
    follow
        Whether the view of the stage that is played is shown beside them.
    height
        Height of the columns in pixels; what is longer scrolls within them.
    code
        Whether the events begin with the code of what is played.
    """

    _shows = "solver"
    _needs = ("facade", "placing", "sizing", "alignment", "analysis", "words", "candidates")

    views = List(Unicode(), ["facade", "player"]).tag(sync=True)
    follow = Bool(True).tag(sync=True)
    height = Int(820).tag(sync=True)
    code = Bool(False).tag(sync=True)

    @property
    def frame(self) -> pd.DataFrame:
        """Seconds by stage: `Trace.timings`."""
        return self.model.trace.timings()

    def to_html(self) -> str:
        """The elevation where there is a layout, and the table of the stages."""
        return drawn(self.model.trace) + PlayerView(self.model).to_html()
