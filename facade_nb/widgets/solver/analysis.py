"""Pattern analysis: trimmed pairs, their equations, both linear systems solved (supplement 3.1)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from ...solver.events import PairInconsistent, PatternsCompared, SystemReduced
from .sheet import table
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["AnalysisView"]


class AnalysisView(TraceView):
    """Every pair of patterns: common ends in grey, the equation that follows; contradictions in red."""

    _shows = "analysis"
    _needs = ("analysis",)

    @property
    def frame(self) -> pd.DataFrame:
        """The pairs as a table: `Trace.analysis`."""
        return self.model.trace.analysis()

    def to_html(self) -> str:
        """A table of the pairs, the common ends in brackets, and one of the solved systems."""
        trace = self.model.trace
        bad = {(e.axis, e.equation): e for e in trace.of_kind(PairInconsistent)}
        pairs = [
            (
                f"{e.axis} ({e.number + 1})",
                " and ".join(e.patterns) + (f", {e.symbol} and its content" if e.symbol else ""),
                _side(e, e.left),
                _side(e, e.right),
                e.text or e.note,
                e.strength if e.text else "",
                f"✕ {bad[e.axis, e.number].text}" if (e.axis, e.number) in bad else "",
            )
            for e in trace.of_kind(PatternsCompared)
        ]
        systems = [
            (
                f"{e.axis}: {'counters' if e.system == 'counters' else 'unsized symbols'}",
                "; ".join(str(row["text"]) for row in e.reduced) or "–",
                ", ".join(e.free) or "–",
            )
            for e in trace.of_kind(SystemReduced)
            if e.variables
        ]
        name = self.model.name
        return table(
            f"Pattern analysis of {name}",
            ("", "pair", "one", "other", "follows", "strength", "contradiction"),
            pairs,
        ) + table("The linear systems, solved", ("system", "rows", "free"), systems)


def _side(e: PatternsCompared, middle: Iterable[Mapping[str, Any]]) -> str:
    """One of the two lines, its common ends in brackets."""
    prefix, own, suffix = (
        " ".join(str(term["text"]) for term in terms) for terms in (e.prefix, middle, e.suffix)
    )
    ends = (f"[{prefix}]" if prefix else "", own or "ε", f"[{suffix}]" if suffix else "")
    return " ".join(filter(None, ends))
