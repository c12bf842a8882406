"""What a design is made of, as a diagram: canvas, layers, patterns, symbols and counters, and what uses what."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from html import escape
from itertools import chain

from ..design.model import AXES, Counter, Design, Layer, PatternDef, Shape, Symbol
from .annotate import FONT
from .style import Style, find_style, num

__all__ = ["outline_svg"]

_LINE, _PAD, _GAP, _HEAD = 14.0, 7.0, 9.0, 64.0
_LEFT = (12.0, 262.0, 556.0)
"""Where the columns begin: layers, patterns, symbols with counters under them. Pixels."""
_WIDE = (170.0, 214.0, 180.0)


@dataclass(slots=True)
class _Box:
    """A thing with its fields, one to a line; `name` begins the first."""

    kind: str
    name: str
    lines: list[str]
    column: int
    y: float = 0.0

    @property
    def key(self) -> tuple[str, str]:
        return self.kind, self.name

    @property
    def said(self) -> tuple[str, ...]:
        return self.kind, self.name, *self.lines

    @property
    def height(self) -> float:
        return _LINE * len(self.lines) + 2 * _PAD

    @property
    def left(self) -> tuple[float, float]:
        return _LEFT[self.column], self.y + self.height / 2

    @property
    def right(self) -> tuple[float, float]:
        return _LEFT[self.column] + _WIDE[self.column], self.y + self.height / 2


def outline_svg(design: Design, before: Design | None = None, *, theme: str = "light") -> str:
    """Draw what a design is made of, as Figure 2 of the layer paper does for all designs.

    Layers stand on the left, the topmost first, each joined to its two patterns; patterns to the symbols and counters
    that their texts name. Each box lists the fields that are not as they are by themselves. What nothing uses is
    pale.

    Parameters
    ----------
    design
        Any design, with or without a layout.
    before
        The design before an edit: what is new or has changed is filled, also what nothing used before.
    theme
        ``light`` or ``dark``.

    Raises
    ------
    ValueError
        For an unknown theme.
    """
    style = find_style(theme)
    parts = _Parts(design)
    known = set() if before is None else _Parts(before).said
    columns = ([*parts.layers.values()], [*parts.patterns.values()], [*parts.symbols.values()])
    counters = [*parts.counters.values()]
    ends = [_stacked(column, _HEAD) for column in columns]
    below = ends[2] + 26
    height = max(*ends, _stacked(counters, below) if counters else 0)
    colours = {"x": style.second, "y": style.accent, "": style.faint}
    titles = zip(("Layers", "Patterns", "Symbols"), columns, _LEFT, strict=True)
    heads = [(title, len(column), (left, _HEAD - 12)) for title, column, left in titles]
    if counters:
        heads.append(("Counters", len(counters), (_LEFT[2], below - 12)))
    size = f"Canvas of {design.canvas.width:g} × {design.canvas.height:g} m"
    body = [_word(size, (_LEFT[0], 24), style, bold=True)]
    body += (_join(one, two, colours[axis]) for one, two, axis in parts.joins)
    body += (_word(f"{title}, {many}", at, style, bold=True) for title, many, at in heads)
    for box in chain(*columns, counters):
        used = box.key in parts.used
        body.append(_drawn(box, style, used, used and before is not None and box.said not in known))
    w, h = num(_LEFT[-1] + _WIDE[-1] + 12), num(height + 10)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}" role="img" '
        f'aria-label="{escape(f"What {design.name} is made of")}" style="max-width:100%;height:auto">'
        f'<rect width="100%" height="100%" fill="{style.paper}"/>{"".join(body)}</svg>'
    )


class _Parts:
    """The boxes of a design by name, and what uses what."""

    def __init__(self, design: Design) -> None:
        order = sorted(design.layers, key=lambda layer: layer.depth, reverse=True)
        named = {name: _named(design, name) for name in design.patterns}
        self.layers = {layer.name: _Box("layer", layer.name, _layer(layer), 0) for layer in order}
        self.patterns = {
            name: _Box("pattern", name, _pattern(own), 1) for name, own in design.patterns.items()
        }
        self.symbols = {
            name: _Box("symbol", name, _symbol(design.symbol(name)), 2)
            for name in _first(named, 0, design.symbols)
        }
        self.counters = {
            name: _Box("counter", name, _counter(design.counter(name)), 2)
            for name in _first(named, 1, design.counters)
        }
        self.joins: list[tuple[_Box, _Box, str]] = []
        """What uses what, and along which axis."""
        for layer in order:
            for axis in AXES:
                self.joins.append((self.layers[layer.name], self.patterns[layer.along(axis).pattern], axis))
        for name, (letters, counts) in named.items():
            self.joins += ((self.patterns[name], self.symbols[letter], "") for letter in letters)
            self.joins += ((self.patterns[name], self.counters[count], "") for count in counts)
        self.used = {box.key for box in self.layers.values()}
        """What the layers use, by way of patterns."""
        for one, two, _ in self.joins:
            if one.key in self.used:
                self.used.add(two.key)

    @property
    def said(self) -> set[tuple[str, ...]]:
        """All that is said of what is used."""
        every = chain(
            self.layers.values(), self.patterns.values(), self.symbols.values(), self.counters.values()
        )
        return {box.said for box in every if box.key in self.used}


def _pattern(own: PatternDef) -> list[str]:
    return ["", *_folded(own.text), *_listed("hidden", own.hidden), *_shapes(own.shapes.values())]


def _named(design: Design, name: str) -> tuple[list[str], list[str]]:
    """The symbols and counters that a pattern's text names, each once."""
    text = design.patterns[name].parsed
    return sorted(text.symbols), sorted(text.counters)


def _first(named: dict[str, tuple[list[str], list[str]]], which: int, every: Iterable[str]) -> Iterable[str]:
    """Names in the order in which patterns name them, so that few lines cross; then those that none does."""
    met = (name for both in named.values() for name in both[which])
    return dict.fromkeys([*met, *every])


def _layer(layer: Layer) -> list[str]:
    lines = _beside(layer.name, f"depth {layer.depth:g}") + ([] if layer.visible else ["not shown"])
    for axis in AXES:
        own = layer.along(axis)
        group = "" if own.group == "default" else f", group {own.group}"
        lines += _folded(f"{axis}: {own.pattern}{group}", 25)
        if own.mask is not None:
            lines += _folded(f"{axis} mask {', '.join(own.mask) or 'nothing'}", 25)
    return [*lines, *_shapes(layer.shapes.values())]


def _symbol(symbol: Symbol) -> list[str]:
    size = "takes what is left" if symbol.size is None else f"{symbol.size:g} m"
    if symbol.min is not None or symbol.max is not None:
        low, high = symbol.min or 0.0, symbol.max
        size += f", {low:g} to {high:g} m" if high is not None else f", at least {low:g} m"
    words = [
        *(["transparent"] if symbol.transparent else []),
        *([] if symbol.opaque else ["not opaque"]),
        *(["attached"] if symbol.attached else []),
        *(["unoccludable"] if symbol.unoccludable else []),
        *([f"placed {symbol.placement}"] if symbol.placement != "center" else []),
    ]
    return [*_beside(symbol.name, size), *(_folded(", ".join(words), 27) if words else [])]


def _counter(counter: Counter) -> list[str]:
    if counter.value is not None:
        return _beside(counter.name, f"fixed at {counter.value}")
    above = "or more" if counter.max is None else f"to {counter.max}"
    return _beside(counter.name, f"{counter.min} {above}")


def _beside(name: str, text: str) -> list[str]:
    """A text beside a name where there is room for it, else under it."""
    return [text] if len(name) + len(text) <= 21 else ["", text]


def _shapes(shapes: Iterable[Shape]) -> list[str]:
    count = len(list(shapes))
    return [f"{count} shape{'s' if count > 1 else ''}"] if count else []


def _listed(what: str, names: Iterable[str]) -> list[str]:
    found = ", ".join(names)
    return _folded(f"{what} {found}") if found else []


def _folded(text: str, room: int = 32) -> list[str]:
    """A text in lines of so many letters, broken at spaces where there are some."""
    lines: list[str] = []
    while len(text) > room:
        at = text.rfind(" ", 1, room + 1)
        at = at if at > 0 else room
        lines.append(text[:at])
        text = text[at:].lstrip()
    return [*lines, text]


def _stacked(column: list[_Box], y: float) -> float:
    """Give each box its place under the one before; where the last one ends."""
    for box in column:
        box.y = y
        y += box.height + _GAP
    return y


def _text(style: Style) -> str:
    return style.ink if style.name == "light" else "#d9dde2"


def _join(one: _Box, two: _Box, colour: str) -> str:
    (x0, y0), (x1, y1) = one.right, two.left
    bend = 0.5 * (x1 - x0)
    return (
        f'<path d="M{num(x0)} {num(y0)}C{num(x0 + bend)} {num(y0)} {num(x1 - bend)} {num(y1)} {num(x1)} {num(y1)}" '
        f'fill="none" stroke="{colour}" stroke-width="1.1" stroke-opacity=".75"/>'
    )


def _word(text: str, at: tuple[float, float], style: Style, *, bold: bool = False) -> str:
    weight = ' font-weight="600"' if bold else ""
    return (
        f'<text {FONT} font-size="{12 if bold else 11}"{weight} x="{num(at[0])}" y="{num(at[1])}" '
        f'fill="{_text(style)}">{escape(text)}</text>'
    )


def _drawn(box: _Box, style: Style, used: bool, fresh: bool) -> str:
    left, top = _LEFT[box.column] + 9, box.y + _PAD + 10.5
    beside = 12 + 7.5 * len(box.name)
    name = box.name if len(box.name) <= 20 else f"{box.name[:19]}…"
    lines = [_word(name, (left, top), style, bold=True)]
    for k, line in enumerate(box.lines):
        lines.append(_word(line, (left + (0 if k else beside), top + _LINE * k), style))
    pale = "" if used else ' opacity=".55"'
    place = (
        f'x="{num(_LEFT[box.column])}" y="{num(box.y)}" width="{num(_WIDE[box.column])}" '
        f'height="{num(box.height)}" rx="3"'
    )
    tint = f'<rect class="new" {place} fill="{style.accent}" fill-opacity=".22"/>' if fresh else ""
    line = style.accent if fresh else style.faint
    return f'<g{pale}><rect {place} fill="{style.paper}" stroke="{line}"/>{tint}{"".join(lines)}</g>'
