"""Candidates: one word of each pattern under one value of each counter, and the fate of each (the paper's 5.1)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...solver.events import CandidateJudged
from .sheet import table
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["CandidatesView"]

_ROWS = 25
"""So many candidates of an axis are in the static form."""


class CandidatesView(TraceView):
    """The candidates as a table that sorts and filters; the one that is chosen is marked in the other views."""

    _shows = "candidates"
    _needs = ("candidates",)

    @property
    def frame(self) -> pd.DataFrame:
        """The candidates as a table: `Trace.candidates`."""
        return self.model.trace.candidates()

    def to_html(self) -> str:
        """A table for each axis, the cheapest candidates first."""
        return "".join(
            self._table(axis, told)
            for axis in "xy"
            if (told := self.model.trace.of_kind(CandidateJudged, axis))
        )

    def _table(self, axis: str, told: list[CandidateJudged]) -> str:
        counters = list(dict.fromkeys(name for e in told for name in e.counters))
        patterns = list(told[0].words)
        best = sorted(told, key=lambda e: (e.cost is None, e.cost or e.proven, e.number))[:_ROWS]
        rows = [
            (
                str(e.number),
                e.fate,
                *(str(e.counters.get(name, "")) for name in counters),
                *(_number(value) for value in (e.cost, e.omega)),
                "" if e.columns is None else str(e.columns),
                *(_number(value) for value in (e.deviation, e.proven, e.tolerance)),
                *(e.words[name].replace(" ", "") or "ε" for name in patterns),
            )
            for e in best
        ]
        more = f", {len(told) - len(best)} more" if len(told) > len(best) else ""
        head = ("#", "fate", *counters, "J", "Ω", "columns", "deviation", "J ≥", "μ", *patterns)
        return table(f"Candidates of {self.model.name}, {axis}{more}", head, rows)


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.3f}"
