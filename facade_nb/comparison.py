"""How much there is to write: a design in layers beside a split grammar (the paper's section 6.1)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from .design.model import AXES, Design
from .render.split_edits import touched
from .render.splits import split_rules, split_tree
from .solver import Layout, solve

__all__ = ["Complexity", "Edits", "complexity", "edits"]


@dataclass(frozen=True, slots=True)
class Complexity:
    """What a person writes and keeps in mind.

    Attributes
    ----------
    rules
        Patterns that visible layers use.
    layers
        Visible layers.
    symbols
        Symbols that those patterns have as letters of their own; placeholders, which a substitution replaces or which
        stand for what is behind, are not counted.
    counters
        Counters that those patterns name.
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
    used = _used(design)
    patterns = [design.patterns[name].parsed for name in sorted(used)]
    return Complexity(
        rules=len(used),
        layers=len(design.stack),
        symbols=len({name for pattern in patterns for name in pattern.solids}),
        counters=len({counter for pattern in patterns for counter in pattern.counters}),
        split_rules=len(split_rules(layout)),
    )


@dataclass(frozen=True, slots=True)
class Edits:
    """What was written to come from one design to another.

    Attributes
    ----------
    patterns, layers
        How many of those that visible layers use, and of layers, are new, changed or gone.
    split_rules
        How many rules of the split grammar are.
    """

    patterns: int
    layers: int
    split_rules: int


def edits(before: Design, after: Design) -> Edits:
    """Count what one edits in layers, and in split rules, to come from one design to another.

    Rules of the two split grammars are paired from the axiom on, each with the one in its place. A rule is touched if
    it has no partner, or if its parts are not those of its partner; sizes and numbers of repetitions are not counted.

    Raises
    ------
    DesignError, NoLayout
        As `solve` does.
    """
    return Edits(
        patterns=_differing(*({name: d.patterns[name].text for name in _used(d)} for d in (before, after))),
        layers=_differing(*({layer.name: (layer.x, layer.y) for layer in d.layers} for d in (before, after))),
        split_rules=sum(map(len, touched(split_tree(solve(before)), split_tree(solve(after))))),
    )


def _used(design: Design) -> set[str]:
    """The patterns of visible layers."""
    return {layer.along(axis).pattern for layer in design.stack for axis in AXES}


def _differing(before: Mapping[str, object], after: Mapping[str, object]) -> int:
    return sum(before.get(name) != after.get(name) for name in {*before, *after})
