"""Runs: the same design searched twice, with one thing changed, nodes counted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from traitlets import Unicode

from .otherwise import CHANGES, again, counts
from .sheet import table
from .timeline import begun
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["RunsView"]


class RunsView(TraceView):
    """Two runs side by side: the one that is traced, and the same design with one thing changed.

    Parameters
    ----------
    change
        What is changed: ``heuristic``, ``table`` or ``paper``.
    """

    _shows = "runs"
    _needs = ("network",)

    change = Unicode("heuristic").tag(sync=True)

    def __init__(self, source: Any, **traits: Any) -> None:
        change = traits.get("change", "heuristic")
        if change not in CHANGES:
            raise ValueError(f"change: expected one of {', '.join(CHANGES)}, found {change!r}")
        super().__init__(source, **traits)
        self.channel.provide([f"run_{change}"])

    @property
    def frame(self) -> pd.DataFrame:
        """What each run did, a line for an axis and a change; the first of an axis is the traced one."""
        import pandas as pd

        return pd.DataFrame(self._rows())

    def to_html(self) -> str:
        """The counts as a table."""
        rows = [
            tuple(
                "" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)
                for value in own.values()
            )
            for own in self._rows()
        ]
        return table(
            f"Runs of {self.model.name}",
            ("axis", "search", "nodes", "told", "edges", "pruned", "passes", "J"),
            rows,
        )

    def _rows(self) -> list[dict[str, Any]]:
        trace = self.model.trace
        return [
            {"axis": axis, "search": begun(one).search, **counts(one, axis)}
            for axis in "xy"
            for one in (trace, again(trace, self.change))
        ]


def _text(value: str | float | None) -> str:
    return "" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)
