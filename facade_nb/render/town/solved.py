"""Façades that are solved, not written: designs of the gallery as rules of the town's grammar.

A front is the solved layout at a canvas of about the lot's width, turned into rules by `grammar_of`; its sizes become
shares, so that it may be stretched by a few per cent. All other walls of such a house have the materials of the front's
edge, band by band, and windows at the heights of the front's, far enough from the corners that no room is seen twice.

The text that comes of it ships (``gallery.town("solved")``), so that no process solves to draw a town; a test
solves afresh and compares. After a change run ``scripts/fronts.py``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from ... import gallery
from ...solver import solve
from ...solver.model.layout import Layout, PlacedShape
from ..texture.from_layout import LayoutGrammar, grammar_of
from ..texture.shape_rules import parts

__all__ = ["SOLVED", "Solved", "solve_text", "solved_text"]

STRETCH = 0.05
"""A front may be so much wider or narrower, higher or lower than its canvas, as a share."""

_AWAY = 4.0
"""Metres from a corner within which other walls have no window: rooms of the front are 3.8 m deep."""


@dataclass(frozen=True, slots=True)
class Solved:
    """A design of the gallery at a width, and what the town needs to know before it is solved.

    Attributes
    ----------
    design
        Its name.
    width, height
        Of the canvas, metres.
    storeys
        How many it shows.
    ground, top
        Metres below the first floor, and above the last one's ceiling.
    """

    design: str
    width: float
    height: float
    storeys: int
    ground: float
    top: float

    @property
    def name(self) -> str:
        """Of the style."""
        return f"{self.design}-{self.width:g}"

    @property
    def storey(self) -> float:
        """Height of each storey above the ground floor, on average."""
        return (self.height - self.ground - self.top) / (self.storeys - 1)

    @property
    def space(self) -> str:
        """Of its namespace."""
        return re.sub(r"\W", "_", self.name)


SOLVED = (
    Solved("apartment-house", 16.0, 10.0, 3, 3.5, 0.3),
    Solved("apartment-house", 21.0, 10.0, 3, 3.5, 0.3),
    Solved("apartment-house", 27.0, 10.0, 3, 3.5, 0.3),
    Solved("bookshop", 19.6, 22.6, 6, 4.6, 0.6),
    Solved("terraced-house", 13.0, 18.6, 6, 3.7, 0.4),
    Solved("terraced-house", 15.5, 18.6, 6, 3.7, 0.4),
    Solved("terraced-house", 18.0, 18.6, 6, 3.7, 0.4),
)
"""Widths at which a design is solved to a proven optimum in less than a second."""


def solved_text() -> str:
    """All of them as namespaces, and one that they share for what they are put together from, as shipped."""
    return gallery.town("solved")


def solve_text() -> str:
    """The same, solved now."""
    known = parts()
    shared = "\n".join(f"  {line}" for line in known.values())
    return "\n\n".join([f"namespace parts {{\n{shared}\n}}", *(_text(solved) for solved in SOLVED)]) + "\n"


def _text(solved: Solved) -> str:
    design = gallery.load(solved.design)
    layout = solve(replace(design, canvas=replace(design.canvas, width=solved.width)))
    compiled = grammar_of(layout)
    lines = [*_front(solved.space, compiled), *_walls(solved, layout, compiled)]
    body = "\n".join(f"  {line}" for line in lines)
    title = f"# {layout.name}, solved for {solved.width:g} by {solved.height:g} m."
    return f"{title}\nnamespace {solved.space} {{\n{body}\n}}"


def _front(space: str, compiled: LayoutGrammar) -> Iterator[str]:
    """The rules of a layout, in shares; those that all layouts have are in a namespace of their own."""
    known = parts()
    start, _, rest = compiled.text.split("\n", 1)[1].partition("\n\nnamespace facade {\n")
    yield start.replace("S -> ", "Front -> ").replace("facade.", "")
    for line in rest.partition("\n}")[0].splitlines():
        name, arrow, rule = line.strip().partition(" -> ")
        if not arrow or name.partition("(")[0] in known:
            continue
        if rule.startswith("Split") and ", Rel, " not in rule and "(Rel, " not in rule:
            rule = rule.replace("Abs, ", "Rel, ")
        rule = rule.replace(
            "Layer(Room, Glass, Fitted(Fit:frame-shop", "Layer(Shop(0.9), Glass, Fitted(Fit:frame-shop"
        )
        yield f"{name} -> {_qualified(rule)}"


def _qualified(rule: str) -> str:
    """A rule with the names of what all layouts are put together from in their namespace."""
    known = parts()

    def told(match: re.Match[str]) -> str:
        return f"parts.{match[0]}" if match[0] in known else match[0]

    return re.sub(r"(?<![:@\w.-])[^\W\d]\w*(?![\w-])", told, rule)


def _walls(solved: Solved, layout: Layout, compiled: LayoutGrammar) -> Iterator[str]:
    """Rules for the other walls: the front's bands, and windows at the heights of the front's."""
    bands = ", ".join(f"Rel, {high:.4g}, {rule}" for high, rule in _bands(solved, layout, compiled))
    yield f"Bands -> SplitY({bands})"
    shape, rule = _window(solved, layout, compiled)
    rows = sorted(
        {(round(s.rect[1], 2), round(s.rect[3], 2)) for s in layout.shapes if _is_window(s, solved)}
    )
    cuts: list[str] = []
    at = 0.0
    for low, high in rows:
        if low < at + 0.3:
            continue
        cuts += [f"Rel, {low - at:.4g}, Open", f"Rel, {high - low:.4g}, WindowRow"]
        at = high
    if solved.height - at > 0.01:
        cuts.append(f"Rel, {solved.height - at:.4g}, Open")
    wide = min(shape.rect[2] - shape.rect[0], 1.4)
    yield f"WindowRows -> SplitY({', '.join(cuts)})"
    yield f"WindowRow -> SplitX(Abs, {_AWAY:g}, Open, Rel, 1, WindowBays, Abs, {_AWAY:g}, Open)"
    yield "WindowBays -> RepeatX(3.2, WindowBay)"
    yield f"WindowBay -> SplitX(Rel, 1, Open, Abs, {wide:.4g}, {rule}, Rel, 1, Open)"
    yield "Street -> Layer(Bands, WindowRows)"
    yield "Plain -> Layer(Bands)"
    yield "Party -> Layer(FireBrick)"
    yield f"Roof -> Layer({'Slates' if solved.design == 'bookshop' else 'Zinc'})"
    yield "Flat -> Layer(Gravel)"


def _is_window(shape: PlacedShape, solved: Solved) -> bool:
    return shape.geometry in ("window", "french-window") and shape.rect[1] > 0.9 * solved.ground


def _window(solved: Solved, layout: Layout, compiled: LayoutGrammar) -> tuple[PlacedShape, str]:
    """The window farthest to the left, above the ground floor, and its rule."""
    shape, rule = min(
        (
            pair
            for pair in zip(layout.shapes, compiled.rules, strict=True)
            if _is_window(pair[0], solved) and pair[0].geometry == "window"
        ),
        key=lambda pair: (pair[0].rect[0], pair[0].rect[1]),
    )
    return shape, rule.removeprefix("facade.")


def _bands(
    solved: Solved, layout: Layout, compiled: LayoutGrammar, at: float = 0.03
) -> Sequence[tuple[float, str]]:
    """Heights and rules of the walls at the left edge of the front, from the foot up."""
    there = [
        (shape.rect[1], shape.rect[3], rule.removeprefix("facade."))
        for shape, rule in zip(layout.shapes, compiled.rules, strict=True)
        if shape.rect[0] <= at < shape.rect[2]
        and shape.geometry in ("box", "ledge", "cornice", "pitched")
        and rule
    ]
    edges = sorted({0.0, solved.height, *(y for low, high, _ in there for y in (low, high))})
    bands: list[tuple[float, str]] = []
    for low, high in pairwise(edges):
        rule = next((r for a, b, r in reversed(there) if a <= (low + high) / 2 < b), "Concrete")
        if high - low < 1e-3:
            continue
        if bands and bands[-1][1] == rule:
            bands[-1] = (bands[-1][0] + high - low, rule)
        else:
            bands.append((high - low, rule))
    return bands
