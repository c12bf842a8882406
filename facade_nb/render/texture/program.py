"""Rules as the evaluators know them: each an operator with plain values, without names of parameters or namespaces."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from .operators import Kind, Operator

__all__ = ["Rule", "Source", "Value", "children", "tile_names"]


@dataclass(frozen=True, slots=True)
class Source:
    """Where a material takes its values from.

    Attributes
    ----------
    mode
        ``Fit`` (stretched over the scope), ``Rep`` (repeated over the façade), or empty for a constant.
    tile
        The tile's name; empty for a constant.
    """

    mode: str = ""
    tile: str = ""

    def __str__(self) -> str:
        return f"{self.mode}:{self.tile}" if self.mode else "0"


Value = float | int | Source
"""A parameter's value: rules by their index, Abs as -1 and Rel as 1, usages by their number, levels as int."""


@dataclass(frozen=True, slots=True)
class Rule:
    """One rule.

    Attributes
    ----------
    name
        As written; ``space.name`` in a namespace, ``name(a=1)`` for a copy with other arguments.
    operator
        What it does.
    fixed
        Values of `operator.fixed`.
    parts
        For each part, values of `operator.part`.
    """

    name: str
    operator: Operator
    fixed: tuple[Value, ...]
    parts: tuple[tuple[Value, ...], ...] = ()

    def value(self, name: str) -> Value:
        """The fixed parameter of that name."""
        return next(v for param, v in zip(self.operator.fixed, self.fixed, strict=True) if param.name == name)

    def targets(self) -> tuple[int, ...]:
        """The rules that it goes on with, in order: one for each part, or the fixed ones."""
        return tuple(
            int(value) for kind, value in self.values() if kind is Kind.RULE and not isinstance(value, Source)
        )

    def values(self) -> Iterator[tuple[Kind, Value]]:
        """Every value with its kind, in the order written."""
        for param, value in zip(self.operator.fixed, self.fixed, strict=True):
            yield param.kind, value
        for part in self.parts:
            for param, value in zip(self.operator.part, part, strict=True):
                yield param.kind, value


def children(rules: Sequence[Rule]) -> tuple[tuple[int, ...], ...]:
    """For every rule those that it may go on with, each once."""
    return tuple(tuple(dict.fromkeys(rule.targets())) for rule in rules)


def tile_names(rules: Sequence[Rule]) -> tuple[str, ...]:
    """The tiles that rules name, each once, in order."""
    sources = (value for rule in rules for _, value in rule.values() if isinstance(value, Source))
    return tuple(dict.fromkeys(source.tile for source in sources if source.tile))
