"""Guides: nodes that leave little to search (prealigned control words, words merged pair by pair).

The exact search has no guides. Whatever is found along them is an alignment, though, found fast, and J of the best
can be no more: so that is the limit of the exact search, and what costs as much and has fewer columns is not
looked for. A guide may speak of some of the words only.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from ..elements import Option
from ..group import Group
from ..observer import Places

__all__ = ["Guide", "nodes_between"]


@dataclass(frozen=True, slots=True)
class Guide:
    """A chain of nodes of some words of a group, from the first node to the last, as the heads read.

    Attributes
    ----------
    bands, nodes
        The words, and where their heads stand.
    strict
        A path has to pass all of the nodes, and is free between them. Otherwise it may stop at these nodes
        alone, and need not stop at all of them.
    """

    group: int
    bands: tuple[int, ...]
    nodes: tuple[Places, ...]
    strict: bool
    _on: frozenset[Places] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_on", frozenset(self.nodes))

    def backward(self, groups: Sequence[Group]) -> Guide:
        """The same chain for heads that read from the right."""
        lengths = [2 * len(groups[self.group].bands[b].letters) for b in self.bands]
        nodes = tuple(
            tuple(n - p for n, p in zip(lengths, node, strict=True)) for node in reversed(self.nodes)
        )
        return Guide(len(groups) - 1 - self.group, self.bands, nodes, self.strict)

    def targets(self, places: Places) -> dict[int, frozenset[int]]:
        """Where each head may go from a node."""
        here = [places[b] for b in self.bands]
        ahead = [node for node in self.nodes if all(n >= p for n, p in zip(node, here, strict=True))]
        if not self.strict:
            return {b: frozenset(node[k] for node in ahead) for k, b in enumerate(self.bands)}
        following = next((node for node in ahead if list(node) != here), None)
        if following is None:
            return {b: frozenset((p,)) for b, p in zip(self.bands, here, strict=True)}
        return {b: frozenset(range(here[k], following[k] + 1)) for k, b in enumerate(self.bands)}

    def leads(self, options: Sequence[Option]) -> bool:
        """Whether a column whose heads go where they may ends at a node that is allowed."""
        return self.strict or tuple([options[b].target >> 2 for b in self.bands]) in self._on


def nodes_between(
    group: Group, bands: Sequence[int], columns: Sequence[Sequence[Option]]
) -> tuple[Places, ...]:
    """The nodes of an alignment of some bands of a group, from the first to the last."""
    nodes = dict.fromkeys(
        [
            tuple(0 for _ in bands),
            *(tuple(option.target >> 2 for option in column) for column in columns),
            tuple(2 * len(group.bands[b].letters) for b in bands),
        ]
    )
    return tuple(nodes)
