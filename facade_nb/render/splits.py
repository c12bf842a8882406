"""A layout as a split grammar: the layer-less description that the layer paper compares with (section 6.1, Figure 9).

Each rule is a line, ``Name --> …``, in the manner of CGA shape grammars with the compound subdivision rule, a split
with repetitions:

- ``split(x) { 1.2 : A | { 0.9 : B | 0.3 : C }*4 | 1.2 : A }`` cuts the scope from left to right, ``split(y)`` from
  below; a part has a size in metres and a rule or a shape, ``*4`` repeats what is in braces;
- ``A B C`` draws one after the other into the same scope, the last on top: where layers overlap, no cut separates them;
- ``"layer/X Y"`` is a shape that fills its scope, and ``-`` is empty.

The rule `Facade` is the first. Rules that draw the same are one rule.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

from ..solver.model.layout import Layout, PlacedShape

__all__ = [
    "AXIOM",
    "Node",
    "Shape",
    "Split",
    "Stack",
    "children",
    "rules_of",
    "split_grammar",
    "split_rules",
    "split_tree",
]

AXIOM = "Facade"
SAME = 1e-6
"""Metres by which boundaries may differ and still be one: much above the solver's precision, much below a joint."""


@dataclass(frozen=True, slots=True)
class Shape:
    """A shape that fills its scope."""

    name: str


@dataclass(frozen=True, slots=True)
class Stack:
    """What is drawn into one scope, the last on top."""

    nodes: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Split:
    """Parts of a scope from the left, or from below, with their sizes in metres."""

    axis: Literal["x", "y"]
    parts: tuple[tuple[float, Node], ...]


Node = Shape | Stack | Split | None
"""What a scope is filled with; None: nothing."""


@dataclass(frozen=True, slots=True)
class _Item:
    """A shape between boundaries: numbers of left, bottom, right, top."""

    box: tuple[int, int, int, int]
    layer: str
    shape: Shape


def split_grammar(layout: Layout) -> str:
    """The text of split rules that draw the shapes of a layout.

    Splits go as far as cuts from edge to edge do; where shapes of several layers overlap, what lies deeper is drawn
    first. A sequence that repeats is written once, and rules that draw the same are one.

    Parameters
    ----------
    layout
        Any layout; its shapes are drawn in their order.

    Returns
    -------
    str
        A rule in each line. It is empty for a layout without shapes.
    """
    return "".join(f"{name} --> {text}\n" for name, text in split_rules(layout))


def split_rules(layout: Layout) -> list[tuple[str, str]]:
    """Name and right side of each rule of `split_grammar`, the axiom first."""
    root = split_tree(layout)
    return [] if root is None else _Writing(root).rules


def split_tree(layout: Layout) -> Node:
    """What the axiom becomes; equal nodes are one rule."""
    across = _boundaries([layout.canvas.width, *(v for s in layout.shapes for v in s.rect[::2])])
    up = _boundaries([layout.canvas.height, *(v for s in layout.shapes for v in s.rect[1::2])])
    items = [_item(shape, across, up) for shape in layout.shapes]
    whole = (0, 0, len(across) - 1, len(up) - 1)
    return _Derivation(across, up).derive(whole, [item for item in items if item])


def _boundaries(values: Sequence[float]) -> list[float]:
    """The different values in growing order, from 0; those that are nearly equal are one."""
    found = [0.0]
    for value in sorted(values):
        if value > found[-1] + SAME:
            found.append(value)
    return found


def _number(values: list[float], value: float) -> int:
    return min(max(bisect_left(values, value - SAME), 0), len(values) - 1)


def _item(shape: PlacedShape, across: list[float], up: list[float]) -> _Item | None:
    left, bottom, right, top = shape.rect
    box = (_number(across, left), _number(up, bottom), _number(across, right), _number(up, top))
    if box[0] == box[2] or box[1] == box[3]:
        return None
    marks = ("'" if shape.mirrored[0] else "", "'" if shape.mirrored[1] else "")
    return _Item(box, shape.layer, Shape(f"{shape.layer}/{shape.x}{marks[0]} {shape.y}{marks[1]}"))


class _Derivation:
    """Cuts scopes until each is one shape, a stack, or empty."""

    def __init__(self, across: list[float], up: list[float]) -> None:
        self.places = (across, up)

    def derive(self, scope: tuple[int, int, int, int], items: Sequence[_Item]) -> Node:
        if not items:
            return None
        full = [item.box == scope for item in items]
        if len(items) == 1 and full[0]:
            return items[0].shape
        if full[0]:
            return _stacked(items[0].shape, self.derive(scope, items[1:]))
        if any(full):  # what lies over it and what lies under it are not cut together
            at = full.index(True)
            return _stacked(self.derive(scope, items[:at]), self.derive(scope, items[at:]))
        # Floors first, as one reads a façade; then bays.
        for axis in (1, 0):
            cuts = _cuts(scope, items, axis)
            if len(cuts) > 2:
                return self._split(scope, items, axis, cuts)
        first = items[0].layer
        under = [item for item in items if item.layer == first]
        at = len(under) if len(under) < len(items) and items[: len(under)] == under else 1
        return _stacked(self.derive(scope, items[:at]), self.derive(scope, items[at:]))

    def _split(
        self, scope: tuple[int, int, int, int], items: Sequence[_Item], axis: int, cuts: list[int]
    ) -> Node:
        parts: list[tuple[float, Node]] = []
        for start, end in pairwise(cuts):
            own = list(scope)
            own[axis], own[axis + 2] = start, end
            inside = [item for item in items if start <= item.box[axis] and item.box[axis + 2] <= end]
            size = self.places[axis][end] - self.places[axis][start]
            parts.append((_rounded(size), self.derive((own[0], own[1], own[2], own[3]), inside)))
        return Split("y" if axis else "x", tuple(parts))


def _rounded(size: float) -> float:
    """To the micrometre. A last bit decides nothing: it is rounded away before halves are."""
    return round(round(size, 9), 6)


def _cuts(scope: tuple[int, int, int, int], items: Sequence[_Item], axis: int) -> list[int]:
    """The boundaries of a scope along an axis that cross no item, its own two among them."""
    edges = sorted(
        {scope[axis], scope[axis + 2], *(v for i in items for v in (i.box[axis], i.box[axis + 2]))}
    )
    spans = sorted((item.box[axis], item.box[axis + 2]) for item in items)
    cuts, reach, k = [], scope[axis], 0
    for edge in edges:
        while k < len(spans) and spans[k][0] < edge:
            reach = max(reach, spans[k][1])
            k += 1
        if reach <= edge:
            cuts.append(edge)
    return cuts


def _stacked(*nodes: Node) -> Node:
    """One over the other, without empty ones and without stacks in stacks."""
    flat: list[Node] = []
    for node in nodes:
        flat += node.nodes if isinstance(node, Stack) else [] if node is None else [node]
    return flat[0] if len(flat) == 1 else Stack(tuple(flat))


class _Writing:
    """Gives each different split and stack a name, in the order in which they are met."""

    def __init__(self, root: Node) -> None:
        nodes = rules_of(root)
        self.names = {node: f"R{k}" if k else AXIOM for k, node in enumerate(nodes)}
        self.rules = [(name, self._text(node)) for node, name in self.names.items()]

    def _name(self, node: Node) -> str:
        if node is None:
            return "-"
        return f'"{node.name}"' if isinstance(node, Shape) else self.names[node]

    def _text(self, node: Node) -> str:
        if isinstance(node, Split):
            words = [f"{size:.6f}".rstrip("0").rstrip(".") + f" : {self._name(n)}" for size, n in node.parts]
            return f"split({node.axis}) {{ {' | '.join(repeated(words))} }}"
        if isinstance(node, Stack):
            return " ".join(self._name(child) for child in node.nodes)
        return self._name(node)


def rules_of(root: Node) -> list[Node]:
    """The different nodes that are rules, in the order in which they are met."""
    found: dict[Node, None] = {root: None}
    waiting = [root]
    for node in waiting:
        for child in children(node):
            if isinstance(child, Split | Stack) and child not in found:
                found[child] = None
                waiting.append(child)
    return list(found)


def children(node: Node) -> Iterator[Node]:
    """What a node is made of."""
    if isinstance(node, Split):
        yield from (child for _, child in node.parts)
    elif isinstance(node, Stack):
        yield from node.nodes


def repeated(words: Sequence[str]) -> list[str]:
    """The parts of a split, what repeats in braces: at each place what covers most, of the fewest parts."""
    found: list[str] = []
    at = 0
    while at < len(words):
        best = (0, 0, 0)  # parts saved, minus the period, the period
        for period in range(1, (len(words) - at) // 2 + 1):
            count = 1
            unit = words[at : at + period]
            while words[at + count * period : at + (count + 1) * period] == unit:
                count += 1
            best = max(best, ((count - 1) * period, -period, period))
        saved, _, period = best
        if saved == 0:
            found.append(words[at])
            at += 1
        else:
            inner = " | ".join(repeated(words[at : at + period]))
            found.append(f"{{ {inner} }}*{saved // period + 1}")
            at += saved + period
    return found
