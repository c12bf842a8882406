"""Code: the function that is played, its current line, and the values of its variables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .code import places
from .sheet import table
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
        function, line, values = list(places(self.model.trace))[self.model.position]
        rows = [tuple(pair.split(" = ", 1)) for pair in values.splitlines()]
        where = f"{function}, line {line}" if line else function
        return table(f"Code of what is played: {where}", ("variable", "value"), rows)
