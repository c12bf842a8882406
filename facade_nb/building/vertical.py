"""The names and the parts of the heights: all designs as one along y, and each design's part of the answer."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from ..design.model import Canvas, Counter, Design, Layer, LayerAxis, PatternDef, Symbol
from ..design.pattern import Pattern
from ..design.text import counter_fault, symbol_fault
from ..design.tree import Alt, Concat, Count, Mirror, Node, Sym
from ..solver.model.layout import AxisLayout, GroupLayout, PlacedLetter, RowLayout
from ..solver.solution import AxisAnswer
from .model import Building

__all__ = ["SPINES", "Joint", "names_up", "spine_of"]

SPINES = "heights"
"""The group in which the spines of all designs are aligned."""

_DEFAULT = "default"
_NEAR = 1e-6


def names_up(design: Design) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The symbols and the counters that a design has along y."""
    patterns = [design.patterns[layer.y.pattern].parsed for layer in design.stack]
    symbols = dict.fromkeys(name for own in patterns for name in own.symbols + own.substituted)
    counters = dict.fromkeys(name for own in patterns for name in own.counters)
    return tuple(symbols), tuple(counters)


def spine_of(design: Design, alone: AxisLayout, *, named: bool = False) -> Layer | None:
    """The layer whose row fills a wall from bottom to top, as the design is solved alone; None: there is none.

    It is the lowest one of group ``default``, else of the bottom layer's group. With `named` it has to be ``default``.
    """
    if not design.stack:
        return None
    names = [layer.y.group for layer in design.stack]
    group = _DEFAULT if _DEFAULT in names or named else names[-1]
    for layer in reversed(design.stack):
        if layer.y.group != group:
            continue
        row = alone.row(layer.name)
        solid = all(design.symbol(a.symbol).opaque and not a.transparent for a in row.letters)
        if solid and row.columns and all(row.columns):
            return layer
    return None


@dataclass(frozen=True)
class Joint:
    """The designs of a building under names with which they can stand side by side."""

    building: Building

    @cached_property
    def designs(self) -> tuple[str, ...]:
        """Those in use that have something to show, in the order of the building's designs."""
        building = self.building
        used = {name for name in building.walls if name is not None}
        used |= {corner.design for corner in building.corners.values()}
        return tuple(name for name, design in building.designs.items() if name in used and design.stack)

    def is_wall(self, key: str) -> bool:
        """Whether a design is a whole façade somewhere; that of quoins alone shares heights only where it says so."""
        building = self.building
        return key in building.walls or any(
            own.design == key and own.kind == "chamfer" for own in building.corners.values()
        )

    def own(self, key: str) -> Design:
        """A design under its joint names. What it is across plays no part."""
        design, names = self.building.designs[key], self.names(key)
        symbols = {"across": Symbol("across", 1.0)}
        counters: dict[str, Counter] = {}
        patterns = {"across": PatternDef("across", "<across>")}
        own_symbols, own_counters = names_up(design)
        for name in own_symbols:
            symbols[names.symbol(name)] = replace(design.symbol(name), name=names.symbol(name))
        for name in own_counters:
            counters[names.counter(name)] = replace(design.counter(name), name=names.counter(name))
        layers: list[Layer] = []
        for layer in reversed(design.stack):
            pattern = names.tagged(layer.y.pattern)
            text = str(_renamed(design.patterns[layer.y.pattern].parsed, names))
            patterns[pattern] = PatternDef(pattern, text)
            axis = LayerAxis(pattern, names.tagged(layer.y.group))
            layers.append(Layer(names.tagged(layer.name), LayerAxis("across"), axis))
        canvas = Canvas(1.0, self.building.height)
        return Design(design.name, canvas, symbols, counters, patterns, tuple(layers))

    @cached_property
    def everything(self) -> Design:
        """All designs as one, without a group of spines."""
        return self.all({})

    def all(self, spines: Mapping[str, Layer]) -> Design:
        """All designs as one, with a group of spines, topmost that of the last design."""
        made = [self.own(key) for key in self.designs]
        rows = [
            Layer(f"spine of {key}", LayerAxis("across"), LayerAxis(self.tagged(key, spine), SPINES))
            for key, spine in spines.items()
        ]
        return Design(
            self.building.name,
            Canvas(1.0, self.building.height),
            {name: own for design in made for name, own in design.symbols.items()},
            {name: own for design in made for name, own in design.counters.items()},
            {name: own for design in made for name, own in design.patterns.items()},
            (*rows, *(layer for design in made for layer in design.layers)),
        )

    def counter(self, key: str, name: str) -> str:
        """The joint name of a design's counter."""
        return self.names(key).counter(name)

    def tagged(self, key: str, spine: Layer) -> str:
        """The joint name of a spine's pattern."""
        return self.names(key).tagged(spine.y.pattern)

    def names(self, key: str) -> _Names:
        """What the names of a design become."""
        own = key
        if symbol_fault(f"A of {own}") or counter_fault(f"k of {own}"):
            own = f"design{1 + list(self.building.designs).index(key)}"
        return _Names(own, frozenset(self.building.shared))

    def part(self, key: str, answer: AxisAnswer) -> AxisAnswer:
        """A design's part of the answer, under its own names."""
        design, names = self.building.designs[key], self.names(key)
        symbols, counters = names_up(design)
        back = {names.symbol(name): name for name in symbols}
        made = answer.layout
        shared = made.groups[SPINES].columns if SPINES in made.groups else ()
        groups: dict[str, GroupLayout] = {}
        for group in dict.fromkeys(layer.y.group for layer in design.stack):
            own = made.groups[names.tagged(group)]
            layers = [layer for layer in design.stack if layer.y.group == group]
            groups[group] = replace(
                own,
                columns=tuple(_snapped(stop, shared) for stop in own.columns),
                rows=tuple(
                    _row(row, layer, back, shared) for row, layer in zip(own.rows, layers, strict=True)
                ),
            )
        sizes = {back[name]: size for name, size in made.sizes.items() if name in back}
        layout = AxisLayout(made.cost, made.gap, made.deviation, made.proven, sizes, groups)
        values = {name: answer.counters.get(names.counter(name)) for name in counters}
        known = {name: value for name, value in values.items() if value is not None}
        return AxisAnswer(layout, known, answer.columns, (), answer.complete)


@dataclass(frozen=True, slots=True)
class _Names:
    """What a design's names are among those of others."""

    key: str
    shared: frozenset[str]

    def symbol(self, name: str) -> str:
        return name if name in self.shared else f"{name} of {self.key}"

    counter = symbol

    def tagged(self, name: str) -> str:
        """Of a pattern, a layer or a group."""
        return f"{name} of {self.key}"


def _row(row: RowLayout, layer: Layer, back: Mapping[str, str], shared: tuple[float, ...]) -> RowLayout:
    def own(letter: PlacedLetter) -> PlacedLetter:
        start, end = _snapped(letter.start, shared), _snapped(letter.end, shared)
        return replace(letter, symbol=back[letter.symbol], start=start, end=end)

    columns = tuple(tuple(map(own, element)) for element in row.columns)
    return RowLayout(layer.name, layer.y.pattern, columns)


def _snapped(value: float, shared: tuple[float, ...]) -> float:
    """A boundary, where it is a shared one to the last digit."""
    k = bisect_left(shared, value - _NEAR)
    return shared[k] if k < len(shared) and shared[k] <= value + _NEAR else value


def _renamed(pattern: Pattern, names: _Names) -> Pattern:
    """A pattern with other names in it."""
    return Pattern(
        _node(pattern.control, names),
        tuple((names.symbol(name), _node(content, names)) for name, content in pattern.substitutions),
    )


def _node(node: Node, names: _Names) -> Node:
    match node:
        case Sym(name):
            return Sym(names.symbol(name))
        case Concat(parts):
            return Concat(tuple(_node(part, names) for part in parts))
        case Alt(options):
            return Alt(tuple(_node(option, names) for option in options))
        case Mirror(body):
            return Mirror(_node(body, names))
        case Count(body, mode, negative, value):
            return Count(
                _node(body, names), mode, negative, names.counter(value) if isinstance(value, str) else value
            )
    return node
