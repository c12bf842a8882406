"""The paper's Figure 3: the layers put on each other as they are, their words side by side at preferred sizes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Literal

from ..design.model import AXES, Axis
from ..solver.assembly.shapes import find_holes
from ..solver.model.layout import GroupLayout, Layout, PlacedLetter, PlacedShape, Rect

__all__ = ["Flaw", "FlawKind", "Naive", "naive_layout"]

_NEAR = 0.01
"""Metres that nobody sees."""

FlawKind = Literal["beyond", "hole", "misalignment", "occlusion", "placement", "sizing"]

Span = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Flaw:
    """Something that is wrong without the alignment: what, where, and in a sentence why."""

    kind: FlawKind
    rect: Rect
    text: str


@dataclass(frozen=True, slots=True)
class Naive:
    """A layout as it would be without the alignment.

    Attributes
    ----------
    shapes
        Where each of the layout's shapes would stand, in the same order.
    flaws
        What is wrong with that.
    """

    shapes: tuple[Rect, ...]
    flaws: tuple[Flaw, ...]


def naive_layout(layout: Layout) -> Naive:
    """Lay the layout's words side by side at their preferred sizes, and say what is wrong with that.

    Each word begins at the left, or at the foot. A letter without a preferred size has the one that was solved. The
    flaws are those of the paper's Figure 3: boundaries that do not meet, instances of a symbol that stand now so, now
    so to what they meet in the layout (inconsistent placement), instances that the canvas's end cuts (inconsistent
    sizing), symbols that must not be covered and are, places that no shape covers, and words that end beyond the
    canvas. What is as wrong in the layout itself is no flaw here.
    """
    lines = {axis: _Line(layout, axis) for axis in AXES}
    shapes = tuple(_naive_rect(shape, lines) for shape in layout.shapes)
    flaws = chain(
        _misaligned(layout, lines),
        _uneven(layout, lines),
        _cut(layout, lines),
        _occluded(layout, shapes),
        _bare(layout, shapes),
        _beyond(layout, lines),
    )
    return Naive(shapes, tuple(flaws))


class _Line:
    """The words of one axis: where the n-th letter of a symbol would stand in each layer's word, and boundaries."""

    def __init__(self, layout: Layout, axis: Axis) -> None:
        self.letters: dict[tuple[str, str, int], Span] = {}
        self.ends: dict[str, float] = {}
        self.spans: dict[str, list[tuple[PlacedLetter, Span]]] = {}
        solved = layout.along(axis)
        for group in solved.groups.values():
            for row in group.rows:
                self._lay(layout, row.layer, list(_whole(row.letters, solved.sizes)), solved.sizes)

    def _lay(
        self, layout: Layout, layer: str, letters: Sequence[PlacedLetter], solved: Mapping[str, float]
    ) -> None:
        at, seen = 0.0, dict[str, int]()
        spans = self.spans[layer] = []
        for letter in letters:
            size = layout.design.symbol(letter.symbol).size if layout.design is not None else None
            span = (at, at + (solved.get(letter.symbol, letter.size) if size is None else size))
            spans.append((letter, span))
            if not letter.transparent:
                number = seen[letter.symbol] = seen.get(letter.symbol, 0) + 1
                self.letters[layer, letter.symbol, number] = span
            at = span[1]
        self.ends[layer] = at


def _whole(letters: Iterable[PlacedLetter], sizes: Mapping[str, float]) -> Iterator[PlacedLetter]:
    """Letters as they were before a transparent one was cut in pieces."""
    held: PlacedLetter | None = None
    for letter in letters:
        if held is not None and held.symbol == letter.symbol and letter.transparent:
            held = PlacedLetter(held.symbol, held.start, letter.end, held.mirrored, True)
        else:
            if held is not None:
                yield held
            held = letter
        if not held.transparent or held.size >= sizes.get(held.symbol, 0.0) - _NEAR:
            yield held
            held = None
    if held is not None:
        yield held


def _naive_rect(shape: PlacedShape, lines: Mapping[Axis, _Line]) -> Rect:
    left, bottom, right, top = shape.rect
    across = lines["x"].letters.get((shape.layer, shape.x, shape.number[0]), (left, right))
    up = lines["y"].letters.get((shape.layer, shape.y, shape.number[1]), (bottom, top))
    return across[0], up[0], across[1], up[1]


def _misaligned(layout: Layout, lines: Mapping[Axis, _Line]) -> Iterator[Flaw]:
    """Boundaries that letters of several rows share in the layout, and that would lie apart."""
    for axis in AXES:
        for name, group in layout.along(axis).groups.items():
            for stop, places in _stops(group, lines[axis]).items():
                low, high = min(places), max(places)
                if high - low > _NEAR:
                    text = f"Group {name!r} on {axis}: what meets at {stop:.2f} m is {high - low:.2f} m apart"
                    yield Flaw("misalignment", _band(layout, axis, low, high), text)


def _uneven(layout: Layout, lines: Mapping[Axis, _Line]) -> Iterator[Flaw]:
    """Instances of a symbol that would not all stand alike to the letters that they begin with in the layout."""
    told: set[Rect] = set()
    for axis in AXES:
        line = lines[axis]
        for group in layout.along(axis).groups.values():
            for row in group.rows:
                for other in group.rows:
                    for flaw in _uneven_to(layout, axis, line, row.layer, other.layer):
                        if flaw.rect not in told:  # several layers may have the same letter there
                            told.add(flaw.rect)
                            yield flaw


def _uneven_to(layout: Layout, axis: Axis, line: _Line, layer: str, other: str) -> Iterator[Flaw]:
    """Instances of one layer's symbols, by where a letter of another layer's that they meet would begin."""
    first: dict[str, float] = {}
    starts = [(letter.start, span[0]) for letter, span in line.spans[other]]
    for letter, span in line.spans[layer]:
        if letter.transparent:
            continue
        met = next((naive for solved, naive in starts if abs(solved - letter.start) <= 1e-6), None)
        if met is None:
            continue
        off = span[0] - met
        usual = first.setdefault(letter.symbol, off)
        if abs(off - usual) > _NEAR:
            text = (
                f"{letter.symbol} of {layer!r} on {axis} begins {off:+.2f} m from a letter of {other!r} that it "
                f"meets in the layout, and the first one {usual:+.2f} m"
            )
            yield Flaw("placement", _band(layout, axis, *span), text)


def _cut(layout: Layout, lines: Mapping[Axis, _Line]) -> Iterator[Flaw]:
    """Instances that the canvas's end would cut, of symbols that are whole elsewhere."""
    for axis, end in (("x", layout.canvas.width), ("y", layout.canvas.height)):
        own: Axis = "x" if axis == "x" else "y"
        for layer, spans in lines[own].spans.items():
            whole = {letter.symbol for letter, (_, stop) in spans if stop <= end + _NEAR}
            for letter, (start, stop) in spans:
                if letter.transparent or letter.symbol not in whole or not start + _NEAR < end < stop - _NEAR:
                    continue
                text = (
                    f"{letter.symbol} of {layer!r} on {axis} is {end - start:.2f} m at the canvas's end, "
                    f"and {stop - start:.2f} m elsewhere"
                )
                yield Flaw("sizing", _band(layout, own, start, end), text)


def _stops(group: GroupLayout, line: _Line) -> Mapping[float, list[float]]:
    """For each inner boundary of the layout's columns: where each row that has a letter begin there would have it."""
    found: dict[float, list[float]] = {stop: [] for stop in group.columns[1:-1]}
    for row in group.rows:
        for letter, (start, _) in line.spans[row.layer]:
            near = min(found, key=lambda stop: abs(stop - letter.start), default=None)
            if near is not None and abs(near - letter.start) <= 1e-6:
                found[near].append(start)
    return {stop: places for stop, places in found.items() if len(places) > 1}


def _occluded(layout: Layout, shapes: Sequence[Rect]) -> Iterator[Flaw]:
    """Shapes of symbols that must not be covered, and would be."""
    design = layout.design
    if design is None:
        return
    told: set[Rect] = set()
    for i, below in enumerate(layout.shapes):
        if not (design.symbol(below.x).unoccludable or design.symbol(below.y).unoccludable):
            continue
        for j in range(i + 1, len(layout.shapes)):
            above = layout.shapes[j]
            if above.layer == below.layer:
                continue
            common = _common(shapes[i], shapes[j])
            if common is not None and common not in told and _common(below.rect, above.rect) is None:
                told.add(common)
                yield Flaw(
                    "occlusion",
                    common,
                    f"{above.x} {above.y} of {above.layer!r} covers {below.x} {below.y} of {below.layer!r}",
                )


def _bare(layout: Layout, shapes: Sequence[Rect]) -> Iterator[Flaw]:
    """Places of the canvas without a shape, which have one in the layout."""
    canvas = layout.canvas
    placed = []
    for shape, rect in zip(layout.shapes, shapes, strict=True):
        inside = _common(rect, (0.0, 0.0, canvas.width, canvas.height))
        if inside is not None:
            placed.append(PlacedShape(shape.layer, shape.x, shape.y, inside))
    own = set(layout.holes)
    for hole in find_holes(canvas, placed):
        if hole not in own and min(hole[2] - hole[0], hole[3] - hole[1]) > _NEAR:
            yield Flaw("hole", hole, "Nothing covers this place")


def _beyond(layout: Layout, lines: Mapping[Axis, _Line]) -> Iterator[Flaw]:
    """Words that end beyond the canvas."""
    for axis, size in (("x", layout.canvas.width), ("y", layout.canvas.height)):
        line = lines["x" if axis == "x" else "y"]
        for layer, end in line.ends.items():
            if end > size + _NEAR:
                rect = _band(layout, "x" if axis == "x" else "y", size, end)
                yield Flaw("beyond", rect, f"The word of {layer!r} on {axis} ends {end - size:.2f} m too far")


def _band(layout: Layout, axis: Axis, low: float, high: float) -> Rect:
    """A strip across the whole façade."""
    if axis == "x":
        return low, 0.0, high, layout.canvas.height
    return 0.0, low, layout.canvas.width, high


def _common(a: Rect, b: Rect) -> Rect | None:
    """What two rectangles have in common, if one can see it."""
    left, bottom, right, top = max(a[0], b[0]), max(a[1], b[1]), min(a[2], b[2]), min(a[3], b[3])
    return (left, bottom, right, top) if right - left > _NEAR and top - bottom > _NEAR else None
