"""The design: everything a person edits, frozen.

All lengths are metres. Mappings are never changed after a design is made; an edit makes a new design
(`dataclasses.replace`, or the helpers of `facade_nb.design.edit`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

from .mimebundle import bundle_of
from .pattern import Pattern, parse

if TYPE_CHECKING:
    from pathlib import Path

__all__ = [
    "AXES",
    "Axis",
    "Canvas",
    "Counter",
    "Design",
    "Layer",
    "LayerAxis",
    "PatternDef",
    "Placement",
    "Shape",
    "Symbol",
    "Variant",
]

Axis = Literal["x", "y"]
Placement = Literal["center", "left", "right"]
AXES: tuple[Axis, Axis] = ("x", "y")


@dataclass(frozen=True, slots=True)
class Canvas:
    """The rectangle to fill; `width` and `height` are positive."""

    width: float = 6.0
    height: float = 3.0

    def along(self, axis: Axis) -> float:
        """Extent along an axis."""
        return self.width if axis == "x" else self.height


@dataclass(frozen=True, slots=True)
class Symbol:
    """An abstract 1D element. `size` is its preferred size; None: unsized (stands only in control patterns)."""

    name: str
    size: float | None = None
    opaque: bool = True
    attached: bool = False
    unoccludable: bool = False
    transparent: bool = False
    placement: Placement = "center"
    min: float | None = None
    max: float | None = None


@dataclass(frozen=True, slots=True)
class Counter:
    """How often a counted base repeats: between `min` and `max` (None: unbounded), or exactly `value`."""

    name: str
    min: int = 0
    max: int | None = None
    value: int | None = None


@dataclass(frozen=True, slots=True)
class Shape:
    """What a pair of symbols looks like. A field that is None is inherited from the next less exact key."""

    kind: str | None = None
    geometry: str | None = None
    material: str | None = None
    offset: float | None = None
    thickness: float | None = None
    visible: bool | None = None
    variants: tuple[Variant, ...] | None = None


@dataclass(frozen=True, slots=True)
class Variant:
    """One of several looks of a shape. Each instance takes one of them, with a chance in proportion to `weight`."""

    shape: Shape
    weight: float = 1.0


@dataclass(frozen=True, slots=True)
class PatternDef:
    """A named pattern: its text, the symbols it hides, and its own shapes (keyed ``"X Y"``)."""

    name: str
    text: str
    hidden: tuple[str, ...] = ()
    shapes: Mapping[str, Shape] = field(default_factory=dict)

    @property
    def parsed(self) -> Pattern:
        """The text, parsed (cached by text)."""
        return parse(self.text)


@dataclass(frozen=True, slots=True)
class LayerAxis:
    """One axis of a layer: the pattern's name, the alignment group, and the symbols that stay visible (None: all)."""

    pattern: str
    group: str = "default"
    mask: tuple[str, ...] | None = None


@dataclass(frozen=True, slots=True)
class Layer:
    """The outer product of two patterns. `depth` orders the stack; equal depths keep list order."""

    name: str
    x: LayerAxis
    y: LayerAxis
    depth: float = 0
    visible: bool = True
    shapes: Mapping[str, Shape] = field(default_factory=dict)

    def along(self, axis: Axis) -> LayerAxis:
        """The axis named ``"x"`` or ``"y"``."""
        return self.x if axis == "x" else self.y


@dataclass(frozen=True, slots=True)
class Design:
    """A canvas, symbols, counters, patterns, shapes and a stack of layers (listed bottom first).

    `seed` chooses among the variants of shapes. `grammar` is the text of a texture grammar: a shape whose material is
    ``rule:Name`` is drawn by its rule of that name.
    """

    name: str = "Untitled"
    canvas: Canvas = field(default_factory=Canvas)
    symbols: Mapping[str, Symbol] = field(default_factory=dict)
    counters: Mapping[str, Counter] = field(default_factory=dict)
    patterns: Mapping[str, PatternDef] = field(default_factory=dict)
    layers: tuple[Layer, ...] = ()
    shapes: Mapping[str, Shape] = field(default_factory=dict)
    seed: int = 0
    grammar: str = ""

    def symbol(self, name: str) -> Symbol:
        """The symbol of that name; an undeclared one is unsized."""
        return self.symbols.get(name) or Symbol(name)

    def counter(self, name: str) -> Counter:
        """The counter of that name; an undeclared one runs from 0."""
        return self.counters.get(name) or Counter(name)

    @property
    def stack(self) -> tuple[Layer, ...]:
        """The visible layers, topmost first."""
        shown = [layer for layer in self.layers if layer.visible]
        return tuple(sorted(shown, key=lambda layer: layer.depth)[::-1])

    @classmethod
    def from_dict(cls, document: Mapping[str, Any]) -> Design:
        """Read a design document (docs/documents.md). Raises `DesignError` with every fault in it."""
        from .document import read

        return read(document)

    @classmethod
    def from_json(cls, source: str | Path) -> Design:
        """Read a design from JSON text or from a file's path. Raises `DesignError`, also for a missing file."""
        from .document import read_json

        return read_json(source)

    def to_dict(self) -> dict[str, Any]:
        """The design document; reading it gives an equal design."""
        from .document import write

        return write(self)

    def to_json(self, path: str | Path | None = None, *, indent: int | None = 2) -> str:
        """The document as JSON text; with `path` it is also written there, atomically."""
        from .document import write_json

        return write_json(self, path, indent=indent)

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        """In a notebook a design shows itself as the elevation of its layout."""
        return bundle_of(self)
