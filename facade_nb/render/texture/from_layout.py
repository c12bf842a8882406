"""From a solved layout to a texture grammar that draws the same façade.

Each layer of the layout becomes a layer of the grammar: its rows by SplitY, the shapes of a row by SplitX, and Skip(0)
where it has nothing. A shape becomes a rule, by its geometry and material: a wall a repeated tile, a window a room, a
curtain, glass and a frame. A material ``rule:Name`` is the rule of that name in a grammar that is given along.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...design.errors import DesignError, Fault, GrammarError, nearest
from ...solver.model.layout import Layout, PlacedShape
from ..geometry import DEFAULT_GEOMETRY, Geometry, find_geometry
from ..materials import RULE, find_material
from ..meshfile import is_file
from ..ruled import library_of
from ..tiles import CATALOGUE
from .atlas import Tiles
from .compiling import compile_text
from .grammar import Grammar
from .shape_rules import LIBRARY, RECIPES, colour, needed, parts, repeats, words

__all__ = ["LayoutGrammar", "grammar_of"]

_NOTHING = 1e-4
"""A shape, or a gap between shapes, that is smaller than this is none, metres."""


@dataclass(frozen=True, slots=True)
class LayoutGrammar:
    """A layout as a texture grammar.

    Attributes
    ----------
    text
        The grammar; `S` draws the façade.
    rules
        For each shape of the layout, the rule that draws it; empty for one too small to be drawn.
    size
        Width and height of the façade, metres.
    """

    text: str = field(repr=False)
    rules: tuple[str, ...] = field(repr=False)
    size: tuple[float, float]

    def grammar(self, tiles: Tiles | None = None) -> Grammar:
        """The grammar, read; raises as `Grammar.parse` does."""
        return Grammar.parse(self.text, tiles)


def grammar_of(
    layout: Layout, library: str = "", *, detail: bool = True, each: bool = False
) -> LayoutGrammar:
    """Compile a layout into a grammar.

    Parameters
    ----------
    layout
        A solved layout.
    library
        A texture grammar. A shape whose material is ``rule:Name`` is drawn by its rule of that name, in the
        rectangle of the shape. It may not define `S`. Nothing: that of the layout's design.
    detail
        Whether windows, doors, columns and the like are drawn with tiles and rooms; otherwise every shape is a
        rectangle of its material.
    each
        Whether every shape has a rule of its own, so that the rule seen at a pixel tells the shape. If not,
        equal shapes share a rule.

    Raises
    ------
    DesignError
        With a fault for every shape whose geometry or material is unknown, or whose rule the library does not have.
    GrammarError
        For a library that cannot be read.
    """
    return _Writer(layout, library or library_of(layout), detail=detail, each=each).written()


@dataclass(frozen=True, slots=True)
class _Piece:
    """A rule on an interval of an axis."""

    low: float
    high: float
    rule: str


class _Writer:
    def __init__(self, layout: Layout, library: str, *, detail: bool, each: bool) -> None:
        self.layout, self.library, self.detail, self.each = layout, library, detail, each
        self.known = _rules_of(library)
        spaces = {name.partition(".")[0] for name in self.known if "." in name}
        self.space = next(
            name for name in ("facade", *(f"facade{k}" for k in range(2, 99))) if name not in spaces
        )
        self.names: dict[object, str] = {}
        self.taken = {*self.known, *parts()}
        self.lines: list[str] = []
        self.used: set[str] = {"Open"}
        self.faults: dict[str, Fault] = {}

    def written(self) -> LayoutGrammar:
        rules = [self._shape(index, shape) for index, shape in enumerate(self.layout.shapes)]
        if "S" in self.known:
            self.faults["S"] = Fault("library", "expected a grammar without a rule 'S': that is the façade's")
        if self.faults:
            raise DesignError(self.faults.values())
        layers: list[str] = []
        for name in dict.fromkeys(shape.layer for shape in self.layout.shapes):
            own = [
                (s, rule)
                for s, rule in zip(self.layout.shapes, rules, strict=True)
                if s.layer == name and rule
            ]
            for flat in _stacks(own):
                layers += self._layer(name, flat)
        width, height = self.layout.canvas.width, self.layout.canvas.height
        title = re.sub(r"\s+", " ", self.layout.name) or "a layout"
        start = f"S -> Layer({', '.join(map(self._told, layers))})" if layers else "S -> Skip(0)"
        wanted = needed(self.used)
        body = [*self.lines, *(line for name, line in parts().items() if name in wanted)]
        for name in sorted(wanted.intersection(self.known)):  # ours steps aside for the library's
            other = self._free(f"own_{name}")
            body = [re.sub(rf"(?<![:@\w.-]){name}\b", other, line) for line in body]
        body = [line.replace(LIBRARY, "") for line in body]
        inside = "\n".join(f"  {line}" for line in body)
        text = f"# {title}, {width:g} by {height:g} m, compiled from its layout.\n{start}\n"
        if layers:
            text += f"\nnamespace {self.space} {{\n{inside}\n}}\n"
        if self.library.strip():
            text += f"\n# The grammar that the layout's materials name.\n{self.library.rstrip()}\n"
        return LayoutGrammar(text, tuple(self._told(rule) for rule in rules), (width, height))

    def _told(self, rule: str) -> str:
        """A rule's name as the grammar has it."""
        if not rule or rule in self.known:
            return rule
        return rule.removeprefix(LIBRARY) if rule.startswith(LIBRARY) else f"{self.space}.{rule}"

    # Layers -----------------------------------------------------------------------------------------------

    def _layer(self, name: str, shapes: Sequence[tuple[PlacedShape, str]]) -> Iterator[str]:
        """The grammar layers of a layer: one, unless its rows overlap."""
        rows: dict[tuple[float, float], list[_Piece]] = {}
        for shape, rule in shapes:
            left, bottom, right, top = shape.rect
            rows.setdefault((round(bottom, 6), round(top, 6)), []).append(_Piece(left, right, rule))
        pieces = [
            _Piece(bottom, top, self._split("X", f"{name}_row", lane, self.layout.canvas.width))
            for (bottom, top), row in rows.items()
            for lane in _lanes(row)
        ]
        for lane in _lanes(pieces):
            yield self._split("Y", name, lane, self.layout.canvas.height)

    def _split(self, axis: str, name: str, pieces: Sequence[_Piece], size: float) -> str:
        """A rule that lays pieces along an axis, with nothing in the gaps; the piece itself if it fills the whole."""
        parts = list(_filled(pieces, size))
        if len(parts) == 1:
            return parts[0][1]
        words = ", ".join(f"Abs, {length:.6g}, {rule}" for length, rule in _rounded(parts))
        return self._rule(name, f"Split{axis}({words})")

    def _rule(self, name: str, body: str, key: object = None) -> str:
        """The name of a rule with that body, written where it is new."""
        key = body if key is None else (key, body)
        if key not in self.names:
            self.names[key] = self._free(name)
            self.lines.append(f"{self.names[key]} -> {body}")
            self.used.update(words(body))
        return self.names[key]

    def _free(self, name: str) -> str:
        """A name like that one which nothing else has."""
        clean = re.sub(r"\W+", "_", name).strip("_")
        clean = clean if clean and not clean[0].isdigit() else f"n{clean}"
        k, free = 1, clean
        while free in self.taken:
            k, free = k + 1, f"{clean}_{k + 1}"
        self.taken.add(free)
        return free

    # Shapes -----------------------------------------------------------------------------------------------

    def _shape(self, index: int, shape: PlacedShape) -> str:
        left, bottom, right, top = shape.rect
        place = f'shapes["{shape.x} {shape.y}"] in layer {shape.layer!r}'
        try:
            geometry = find_geometry(
                DEFAULT_GEOMETRY if is_file(shape.geometry) else shape.geometry, f"{place}: geometry"
            )
            if shape.material.startswith(RULE):
                return self._named(shape.material.removeprefix(RULE), f"{place}: material")
            find_material(shape.material, f"{place}: material")
        except DesignError as error:
            self.faults.update((str(fault), fault) for fault in error.faults)
            return ""
        if min(right - left, top - bottom) < _NOTHING:
            return ""
        body = self._plain(geometry, shape) if not self.detail else self._detailed(geometry, shape)
        return self._rule(f"{shape.layer}_{shape.x}_{shape.y}", body, index if self.each else shape.layer)

    def _named(self, name: str, place: str) -> str:
        if name not in self.known:
            raise DesignError(
                Fault(
                    place, f"there is no rule {name!r} in the grammar given along{nearest(name, self.known)}"
                )
            )
        return name if "." in name else f"{LIBRARY}{name}"

    def _plain(self, geometry: Geometry, shape: PlacedShape) -> str:
        red, green, blue = colour(
            "glass"
            if "glass" in geometry.slots and geometry.full
            else geometry.material("body", shape.material)
        )
        return f"Mat(Color, 0, {red}, {green}, {blue}, 1)"

    def _detailed(self, geometry: Geometry, shape: PlacedShape) -> str:
        width, height = shape.rect[2] - shape.rect[0], shape.rect[3] - shape.rect[1]
        material = geometry.material("body", shape.material)
        recipe = RECIPES.get(geometry.name) if min(width, height) >= geometry.least else None
        body = recipe(self, shape, material, width, height) if recipe else self._wall(material)
        if shape.offset < -0.02 and geometry.full and recipe is not None:
            inner = self._rule(f"{shape.layer}_{shape.x}_{shape.y}_inner", body)
            side = self._wall_rule("plaster")
            return f"Intrusion({-shape.offset:.4g}, {side}, {inner}, {side}, {side}, {side})"
        return body

    def wall(self, material: str) -> str:
        """A rule, of its own, for a surface of a material."""
        return self._wall_rule(material)

    def rule(self, name: str, body: str) -> str:
        """A rule with that body, which others may share."""
        return self._rule(name, body)

    def _wall_rule(self, material: str) -> str:
        return self._rule(f"wall_{material}", self._wall(material))

    def _wall(self, material: str) -> str:
        """A repeated tile where one has the material's name, else its colour."""
        recipe = CATALOGUE.get(material)
        if recipe is None or recipe.tiling != "xy":
            red, green, blue = colour(material)
            return f"Mat(Color, 0, {red}, {green}, {blue}, 1)"
        across, up = repeats(material)
        color = self._rule(f"color_{material}", f"Mat(Color, Rep:{material}, 0, 0, {across}, {up})")
        relief = self._rule(f"relief_{material}", f"Mat(Normal, Rep:{material}.normal, 0, 0, {across}, {up})")
        return f"Layer({color}, {relief})"


# Intervals --------------------------------------------------------------------------------------------------


def _stacks(shapes: Sequence[tuple[PlacedShape, str]]) -> list[list[tuple[PlacedShape, str]]]:
    """Shapes in lists of which none covers another, in the order in which they are painted.

    The shapes of a solved layer do not overlap; those of a layout that was made otherwise may.
    """
    stacks: list[list[tuple[PlacedShape, str]]] = [[]]
    for shape, rule in shapes:
        if any(_overlap(shape, other) for other, _ in stacks[-1]):
            stacks.append([])
        stacks[-1].append((shape, rule))
    return stacks


def _overlap(one: PlacedShape, other: PlacedShape) -> bool:
    a, b = one.rect, other.rect
    return min(a[2], b[2]) - max(a[0], b[0]) > _NOTHING and min(a[3], b[3]) - max(a[1], b[1]) > _NOTHING


def _lanes(pieces: Sequence[_Piece]) -> list[list[_Piece]]:
    """Pieces in as few lists as possible, of which no two overlap, each in order."""
    lanes: list[list[_Piece]] = []
    for piece in sorted(pieces, key=lambda p: (p.low, p.high)):
        for lane in lanes:
            if lane[-1].high <= piece.low + _NOTHING:
                lane.append(piece)
                break
        else:
            lanes.append([piece])
    return lanes


def _filled(pieces: Sequence[_Piece], size: float) -> Iterator[tuple[float, str]]:
    """Where each part ends, and its rule: pieces and the gaps between them."""
    at = 0.0
    for piece in pieces:
        if piece.low > at + _NOTHING:
            yield piece.low, "Open"
        at = min(piece.high, size)
        yield at, piece.rule
    if at < size - _NOTHING:
        yield size, "Open"


def _rounded(parts: Sequence[tuple[float, str]]) -> Iterator[tuple[float, str]]:
    """Lengths as 16-bit floats hold them, each chosen so that what came before is made good: errors do not add up."""
    at = 0.0
    for end, rule in parts:
        length = float(np.float16(max(end - at, 1e-3)))
        yield length, rule
        at += length


def _rules_of(library: str) -> tuple[str, ...]:
    """Names of the rules of a grammar. Raises `GrammarError` with all its faults."""
    if not library.strip():
        return ()
    compiled = compile_text(library)
    if compiled.faults:
        raise GrammarError(fault for _, fault in compiled.faults)
    return tuple(rule.name for rule in compiled.rules)
