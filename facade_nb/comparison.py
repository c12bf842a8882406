"""How much there is to write: a design in layers beside a split grammar (the paper's section 6.1)."""

from __future__ import annotations

from dataclasses import dataclass

from .design.model import AXES, Design
from .render.splits import split_rules
from .solver import Layout, solve

__all__ = ["Complexity", "complexity"]


@dataclass(frozen=True, slots=True)
class Complexity:
    """What a person writes and keeps in mind.

    Attributes
    ----------
    rules
        Patterns that visible layers use.
    layers
        Visible layers.
    symbols, counters
        Symbols and counters that those patterns name, substituted symbols among them.
    split_rules
        Rules of the split grammar that draws the same rectangles (`facade_nb.render.split_grammar`).
    """

    rules: int
    layers: int
    symbols: int
    counters: int
    split_rules: int


def complexity(design: Design, layout: Layout | None = None) -> Complexity:
    """Count what a design is made of, beside the split grammar of its layout.

    Parameters
    ----------
    design
        The design.
    layout
        Its layout, where there is one already; None: it is solved.

    Raises
    ------
    DesignError, NoLayout
        As `solve` does.
    """
    layout = layout or solve(design)
    used = {layer.along(axis).pattern for layer in design.stack for axis in AXES}
    patterns = [design.patterns[name].parsed for name in sorted(used)]
    return Complexity(
        rules=len(used),
        layers=len(design.stack),
        symbols=len({name for pattern in patterns for name in (*pattern.symbols, *pattern.substituted)}),
        counters=len({counter for pattern in patterns for counter in pattern.counters}),
        split_rules=len(split_rules(layout)),
    )
