"""Code: the function that is played, its current line, and the values of its variables."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from .code import places
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["CodeView"]


class CodeView(TraceView):
    """The function that does what the present event tells: the reference search, or the paper's."""

    _shows = "code"
    _needs = ("code",)

    @property
    def frame(self) -> pd.DataFrame:
        """For each event the function, the line in it (0: the whole function) and the values of its variables."""
        import pandas as pd

        return pd.DataFrame(places(self.model.trace), columns=["function", "line", "values"])

    def to_html(self) -> str:
        """Where the present event comes from."""
        told = list(places(self.model.trace))
        function, line, values = told[self.model.position]
        return f"<p><code>{escape(function)}</code>, line {line}</p><pre>{escape(values)}</pre>"
