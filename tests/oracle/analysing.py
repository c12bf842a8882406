"""Small designs for pattern analysis: one layer a pattern."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from facade_nb import Design
from facade_nb.solver.analysis.systems import Analysis, Equation, analyse
from facade_nb.solver.model.problem import axis_problem

__all__ = ["analysed", "between", "stacked", "texts"]


def stacked(
    patterns: Mapping[str, str],
    sizes: Mapping[str, Any],
    counters: Mapping[str, Any] | None = None,
    groups: Mapping[str, str] | None = None,
    canvas: float = 10.0,
) -> Design:
    """One layer a pattern, listed topmost first; every pattern in a group of its own unless said."""
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": "test",
            "canvas": {"width": canvas, "height": 1.0},
            "symbols": {
                "Y": {"size": 1.0},
                **{n: s if isinstance(s, dict) else {"size": s} for n, s in sizes.items()},
            },
            "counters": dict(counters or {}),
            "patterns": {**patterns, "Y": "Y"},
            "layers": [
                {
                    "name": name,
                    "x": {"pattern": name, "group": (groups or {}).get(name, name)},
                    "y": {"pattern": "Y"},
                }
                for name in reversed(patterns)
            ],
        }
    )


def analysed(*args: Any, **named: Any) -> Analysis:
    return analyse(axis_problem(stacked(*args, **named), "x"))


def between(analysis: Analysis, p: str, q: str, symbol: str = "") -> Equation:
    return next(e for e in analysis.equations if e.patterns == (p, q) and e.symbol == symbol)


def texts(shown: Any) -> list[str]:
    return [part.text for part in shown]
