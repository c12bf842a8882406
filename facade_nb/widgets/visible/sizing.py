"""Sizing: the least-squares system, its objective and its forces (the paper's 5.3, the supplement's Figure 7)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...solver.events import SystemPosed, SystemSolved
from .sheet import table
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["SizingView"]

_ROWS = 120
_TINY = 1e-6


class SizingView(TraceView):
    """The system as a matrix with an equation on every line, the active set, multipliers as forces."""

    _shows = "sizing"
    _needs = ("sizing", "alignment")

    @property
    def frame(self) -> pd.DataFrame:
        """Bounds and rows of the system with their multipliers: `Trace.equations`."""
        return self.model.trace.equations()

    def to_html(self) -> str:
        """Tables: preferred and solved sizes, and the rows of the system."""
        trace, name = self.model.trace, self.model.name
        solved = {e.axis: e for e in trace.of_kind(SystemSolved)}
        sizes, rows = [], []
        for posed in trace.of_kind(SystemPosed):
            answer = solved.get(posed.axis)
            sizes += _sizes(posed, answer)
            rows += _rows(posed, answer)
        left = len(rows) - _ROWS
        shown = rows[:_ROWS] + ([("", f"… {left} more", "", "")] if left > 0 else [])
        head = ("axis", "symbol", "preferred", "solved", "squared")
        return table(f"Sizes of {name}", head, sizes) + table(
            f"The least-squares system of {name}", ("axis", "row", "kind", "multiplier"), shown
        )


def _sizes(posed: SystemPosed, answer: SystemSolved | None) -> list[tuple[str, ...]]:
    out: list[tuple[str, ...]] = []
    for v, meaning in enumerate(posed.meaning):
        if meaning.kind != "size":
            continue
        value = answer.placed[v] if answer else posed.target[v]
        counts = posed.weight[v] > 0
        squared = f"{(value - posed.target[v]) ** 2:.2g}" if counts and answer else ""
        wanted = f"{posed.target[v]:.4g}" if counts else "free"
        out.append((posed.axis, meaning.symbol, wanted, f"{value:.4g}" if answer else "", squared))
    return out


def _rows(posed: SystemPosed, answer: SystemSolved | None) -> list[tuple[str, ...]]:
    out: list[tuple[str, ...]] = []
    n = len(posed.variables)
    for r, row in enumerate(posed.rows):
        force = answer.multipliers[n + r] if answer else 0.0
        kind = "=" if posed.lower[n + r] == posed.upper[n + r] else "≤"
        out.append((posed.axis, row, kind, f"{force:.3g}" if abs(force) > _TINY else "0" if answer else ""))
    return out
