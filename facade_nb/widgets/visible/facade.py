"""The façade as the events build it, and as what is lit in other views lights up on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...design import DesignError
from ..parts import picture
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["FacadeView"]


class FacadeView(TraceView):
    """The elevation, shape by shape; letters as strips before there are shapes."""

    _shows = "facade"
    _needs = ("facade", "placing")

    @property
    def frame(self) -> pd.DataFrame:
        """Where every element of every row stands: `Trace.path`."""
        return self.model.trace.path()

    def to_html(self) -> str:
        """The elevation; empty where there is no layout."""
        try:
            return picture(self.model.trace.replay())
        except DesignError:
            return ""
