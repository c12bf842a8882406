"""What one axis of a design asks of the solver: nothing but what the answer depends on.

Two designs with equal problems have equal answers on that axis, which is what lets an edit of one axis
leave the other alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...design.model import Axis, Counter, Design, Symbol
from ...design.pattern import Pattern

__all__ = ["AxisProblem", "axis_problem"]


@dataclass(frozen=True, slots=True)
class AxisProblem:
    """One axis, ready to be solved; hashable.

    Attributes
    ----------
    canvas
        Extent in metres.
    groups
        ``(name, pattern names by row)``, rows topmost first.
    patterns, symbols, counters
        Those in use, by name, in order of first use from the top of the stack.
    """

    axis: Axis
    canvas: float
    groups: tuple[tuple[str, tuple[str, ...]], ...]
    patterns: tuple[tuple[str, Pattern], ...]
    symbols: tuple[tuple[str, Symbol], ...]
    counters: tuple[tuple[str, Counter], ...]

    @property
    def pattern(self) -> Mapping[str, Pattern]:
        """Patterns by name."""
        return dict(self.patterns)

    @property
    def symbol(self) -> Mapping[str, Symbol]:
        """Symbols by name."""
        return dict(self.symbols)


def axis_problem(design: Design, axis: Axis) -> AxisProblem:
    """Extract what an axis depends on."""
    groups: dict[str, list[str]] = {}
    for layer in design.stack:
        own = layer.along(axis)
        groups.setdefault(own.group, []).append(own.pattern)
    order = dict.fromkeys(name for rows in groups.values() for name in rows)
    patterns = {name: design.patterns[name].parsed for name in order}
    symbols = dict.fromkeys(s for p in patterns.values() for s in p.symbols)
    counters = dict.fromkeys(c for p in patterns.values() for c in p.counters)
    return AxisProblem(
        axis,
        design.canvas.along(axis),
        tuple((name, tuple(rows)) for name, rows in groups.items()),
        tuple(patterns.items()),
        tuple((name, design.symbol(name)) for name in symbols),
        tuple((name, design.counter(name)) for name in counters),
    )
