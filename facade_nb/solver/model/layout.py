"""The layout: where every letter stands and which shapes that makes (docs/documents.md). y grows upwards."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ...design.mimebundle import bundle_of
from ...design.model import Axis, Canvas, Design
from .letters import Word
from .objective import Objective

if TYPE_CHECKING:
    from .sizing import Sizing

__all__ = ["AxisLayout", "GroupLayout", "Layout", "PlacedLetter", "PlacedShape", "Rect", "RowLayout", "Terms"]

Rect = tuple[float, float, float, float]
"""Left, bottom, right, top, in metres."""


@dataclass(frozen=True, slots=True)
class PlacedLetter:
    """A letter, or a piece of a cut one, with its interval in metres.

    `index` tells which letter of the row's word it is, from 0; −1 in a layout that was read from a document.
    """

    symbol: str
    start: float
    end: float
    mirrored: bool = False
    transparent: bool = False
    index: int = field(default=-1, compare=False)

    @property
    def size(self) -> float:
        """Length of the interval."""
        return self.end - self.start


@dataclass(frozen=True, slots=True)
class RowLayout:
    """One layer's word in a group: per column the letters that stand in it (an empty tuple: ε)."""

    layer: str
    pattern: str
    columns: tuple[tuple[PlacedLetter, ...], ...]

    @property
    def letters(self) -> tuple[PlacedLetter, ...]:
        """All letters and pieces, in order."""
        return tuple(letter for element in self.columns for letter in element)


@dataclass(frozen=True, slots=True)
class Terms:
    """What J is made of beside Ω, metres (docs/problem.md); J takes each times its price in `objective`.

    Attributes
    ----------
    empty
        E: column that rows leave empty.
    loose
        Λ: letters that share an element, or do not fill their column.
    miss
        |W − canvas|: by how much the columns miss the canvas.
    """

    empty: float
    loose: float
    miss: float
    objective: Objective


@dataclass(frozen=True, slots=True)
class GroupLayout:
    """One alignment group: Ω of its alignment, every column boundary (0 first, canvas last), rows topmost first.

    `terms` has the rest of its J; None in a layout that was read from a document.
    """

    error: float
    columns: tuple[float, ...]
    rows: tuple[RowLayout, ...]
    terms: Terms | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True)
class AxisLayout:
    """The solved axis.

    Attributes
    ----------
    cost
        J summed over groups (Ω under the paper's objective).
    gap
        Cost minus the proven lower bound; 0 where `proven`.
    deviation
        Square root of the sizing objective, metres.
    sizes
        Solved size of each symbol in use.
    sizing
        The least-squares problem with its multipliers: which constraint pulls where. None in a layout that was read
        from a document.
    words
        The word of each pattern, with its counters. Empty in a layout that was read from a document.
    """

    cost: float = 0.0
    gap: float = 0.0
    deviation: float = 0.0
    proven: bool = True
    sizes: Mapping[str, float] = field(default_factory=dict)
    groups: Mapping[str, GroupLayout] = field(default_factory=dict)
    sizing: Sizing | None = field(default=None, compare=False, repr=False)
    words: Mapping[str, Word] = field(default_factory=dict, compare=False, repr=False)

    def row(self, layer: str) -> RowLayout:
        """The row of a layer. Raises KeyError for a layer that took no part."""
        for group in self.groups.values():
            for row in group.rows:
                if row.layer == layer:
                    return row
        raise KeyError(layer)


@dataclass(frozen=True, slots=True)
class PlacedShape:
    """A visible cell of a layer: the symbols it comes from, its rectangle and its looks, all resolved.

    `number` tells which instances of the two symbols they are in the layer's words, each from 1, from the left and from
    below: in keys of shapes ``"B[2] Q[1]"``.
    """

    layer: str
    x: str
    y: str
    rect: Rect
    mirrored: tuple[bool, bool] = (False, False)
    kind: str = "wall"
    geometry: str = "box"
    material: str = "card"
    offset: float = 0.0
    thickness: float = 0.2
    number: tuple[int, int] = (1, 1)


@dataclass(frozen=True, slots=True, repr=False)
class Layout:
    """A solved façade.

    Attributes
    ----------
    shapes
        Visible shapes in painting order: the bottom layer comes first.
    holes
        Rectangles of the canvas that no visible shape covers.
    warnings
        What a designer should know, in sentences.
    complete
        False if a limit or a stop cut the search short. The layout is then the best one found until that
        moment.
    trace
        The recorded events, if `solve` was asked for them; else None.
    """

    name: str
    canvas: Canvas
    counters: Mapping[str, int] = field(default_factory=dict)
    x: AxisLayout = field(default_factory=AxisLayout)
    y: AxisLayout = field(default_factory=AxisLayout)
    shapes: tuple[PlacedShape, ...] = ()
    holes: tuple[Rect, ...] = ()
    warnings: tuple[str, ...] = ()
    complete: bool = True
    design: Design | None = field(default=None, compare=False, repr=False)
    trace: Any = field(default=None, compare=False, repr=False)

    def along(self, axis: Axis) -> AxisLayout:
        """The axis named ``"x"`` or ``"y"``."""
        return self.x if axis == "x" else self.y

    def to_dict(self) -> dict[str, Any]:
        """The layout document (docs/documents.md)."""
        return {
            "format": "facade-nb/layout/1",
            "name": self.name,
            "canvas": {"width": self.canvas.width, "height": self.canvas.height},
            "counters": dict(self.counters),
            "x": _axis_dict(self.x),
            "y": _axis_dict(self.y),
            "shapes": [_shape_dict(shape) for shape in self.shapes],
            "holes": [list(hole) for hole in self.holes],
            "warnings": list(self.warnings),
            "complete": self.complete,
        }

    @classmethod
    def from_dict(cls, document: Mapping[str, Any]) -> Layout:
        """Read what `to_dict` wrote."""
        return cls(
            name=document["name"],
            canvas=Canvas(document["canvas"]["width"], document["canvas"]["height"]),
            counters=dict(document["counters"]),
            x=_read_axis(document["x"]),
            y=_read_axis(document["y"]),
            shapes=tuple(_read_shape(shape) for shape in document["shapes"]),
            holes=tuple(_rect(hole) for hole in document.get("holes", ())),
            warnings=tuple(document.get("warnings", ())),
            complete=document.get("complete", True),
        )

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        """In a notebook a layout shows itself as its elevation."""
        return bundle_of(self)

    def __repr__(self) -> str:
        counters = "".join(f", {name} = {value}" for name, value in self.counters.items())
        state = "" if self.complete else ", not complete"
        return (
            f"<Layout {self.name!r}: {self.canvas.width:g} × {self.canvas.height:g} m, "
            f"{len(self.shapes)} shapes{counters}{state}>"
        )


def _axis_dict(axis: AxisLayout) -> dict[str, Any]:
    return {
        "cost": axis.cost,
        "gap": axis.gap,
        "deviation": axis.deviation,
        "proven": axis.proven,
        "sizes": dict(axis.sizes),
        "groups": {
            name: {
                "error": group.error,
                "columns": list(group.columns),
                "rows": [
                    {
                        "layer": row.layer,
                        "pattern": row.pattern,
                        "columns": [
                            [
                                {
                                    "symbol": letter.symbol,
                                    "start": letter.start,
                                    "end": letter.end,
                                    "mirrored": letter.mirrored,
                                    "transparent": letter.transparent,
                                }
                                for letter in element
                            ]
                            for element in row.columns
                        ],
                    }
                    for row in group.rows
                ],
            }
            for name, group in axis.groups.items()
        },
    }


def _shape_dict(shape: PlacedShape) -> dict[str, Any]:
    return {
        "layer": shape.layer,
        "x": shape.x,
        "y": shape.y,
        "rect": list(shape.rect),
        "mirrored": list(shape.mirrored),
        "kind": shape.kind,
        "geometry": shape.geometry,
        "material": shape.material,
        "offset": shape.offset,
        "thickness": shape.thickness,
        "number": list(shape.number),
    }


def _read_axis(document: Mapping[str, Any]) -> AxisLayout:
    return AxisLayout(
        cost=document["cost"],
        gap=document["gap"],
        deviation=document["deviation"],
        proven=document["proven"],
        sizes=dict(document["sizes"]),
        groups={
            name: GroupLayout(
                error=group["error"],
                columns=tuple(group["columns"]),
                rows=tuple(
                    RowLayout(
                        row["layer"],
                        row["pattern"],
                        tuple(
                            tuple(PlacedLetter(**letter) for letter in element) for element in row["columns"]
                        ),
                    )
                    for row in group["rows"]
                ),
            )
            for name, group in document["groups"].items()
        },
    )


def _read_shape(document: Mapping[str, Any]) -> PlacedShape:
    fields = dict(document)
    fields["rect"] = _rect(fields["rect"])
    fields["mirrored"] = (bool(fields["mirrored"][0]), bool(fields["mirrored"][1]))
    if "number" in fields:
        fields["number"] = (int(fields["number"][0]), int(fields["number"][1]))
    return PlacedShape(**fields)


def _rect(values: Any) -> Rect:
    left, bottom, right, top = values
    return (left, bottom, right, top)
