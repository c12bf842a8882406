"""The paper's Figure 3: the layers put on each other as they are, their words side by side at preferred sizes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from typing import Literal

from ..design.model import AXES, Axis
from ..solver.assembly.shapes import find_holes, merge
from ..solver.model.layout import GroupLayout, Layout, PlacedLetter, PlacedShape, Rect

__all__ = ["Behind", "Flaw", "FlawKind", "Naive", "naive_layout"]

_NEAR = 0.01
"""Metres that nobody sees."""

FlawKind = Literal["beyond", "hole", "intrinsic", "misalignment", "occlusion", "placement", "short", "sizing"]

Span = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Flaw:
    """Something that is wrong without the alignment: what, where, and in a sentence why."""

    kind: FlawKind
    rect: Rect
    text: str


@dataclass(frozen=True, slots=True)
class Behind:
    """A shape that the layout leaves away, because it is wholly behind another; side by side it may be seen.

    Attributes
    ----------
    before
        How many of the layout's shapes lie below it.
    shape
        The shape where it stands in the layout.
    rect
        Where it would stand without the alignment.
    """

    before: int
    shape: PlacedShape
    rect: Rect


@dataclass(frozen=True, slots=True)
class Naive:
    """A layout as it would be without the alignment.

    Attributes
    ----------
    shapes
        Where each of the layout's shapes would stand, in the same order.
    flaws
        What is wrong with that.
    behind
        Shapes that the layout leaves away, bottom first; none where the layout was read from a document, for that
        does not hold them.
    """

    shapes: tuple[Rect, ...]
    flaws: tuple[Flaw, ...]
    behind: tuple[Behind, ...] = ()

    def stacked(self, layout: Layout) -> tuple[PlacedShape, ...]:
        """All shapes where they would stand, bottom first."""
        moved = [replace(own, rect=rect) for own, rect in zip(layout.shapes, self.shapes, strict=True)]
        for own in reversed(self.behind):
            moved.insert(own.before, replace(own.shape, rect=own.rect))
        return tuple(moved)


def naive_layout(layout: Layout) -> Naive:
    """Lay the layout's words side by side at their preferred sizes, and say what is wrong with that.

    Each word begins at the left, or at the foot. A letter without a preferred size has the one that was solved. The
    flaws are those of the paper's section 3.5, which its Figure 3 marks:

    - ``misalignment``: what meets in the layout lies apart in two layers (extrinsic misalignment);
    - ``intrinsic``: so do letters of two layers that have the same pattern;
    - ``sizing``: an instance of a symbol is not as large as the others, as the canvas's end cuts it or it has no size
      of its own;
    - ``placement``: instances of a symbol stand now so, now so to what they meet, or to each other;
    - ``occlusion``: a symbol that must not be covered is, or a window or a door as a whole;
    - ``hole``: no shape covers a place;
    - ``beyond``, ``short``: a word ends beyond the canvas, or leaves some of it empty.

    What is as wrong in the layout itself is no flaw here.
    """
    lines = {axis: _Line(layout, axis) for axis in AXES}
    shapes = tuple(_naive_rect(shape, lines) for shape in layout.shapes)
    behind = tuple(Behind(before, shape, _naive_rect(shape, lines)) for before, shape in _left_away(layout))
    naive = Naive(shapes, (), behind)
    flaws = chain(
        _misaligned(layout, lines),
        _apart(layout, lines),
        _uneven(layout, lines),
        _unspaced(layout, lines),
        _sized(layout, lines),
        _occluded(layout, shapes),
        _bare(layout, naive.stacked(layout)),
        _beyond(layout, lines),
        _short(layout, lines),
    )
    return replace(naive, flaws=tuple(flaws))


def _left_away(layout: Layout) -> Iterator[tuple[int, PlacedShape]]:
    """The shapes that are wholly behind others, each after so many of the layout's own."""
    if layout.design is None:
        return
    own = {_cell(shape) for shape in layout.shapes}
    before = 0
    for shape in merge(layout.design, layout.x, layout.y, behind=True):
        if _cell(shape) in own:
            before += 1
        else:
            yield before, shape


def _cell(shape: PlacedShape) -> tuple[str, str, str, tuple[int, int]]:
    return shape.layer, shape.x, shape.y, shape.number


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


def _apart(layout: Layout, lines: Mapping[Axis, _Line]) -> Iterator[Flaw]:
    """Letters of layers with the same pattern that stand at one place in the layout, and would not."""
    if layout.design is None:
        return
    pattern = {
        (layer.name, axis): layer.along(axis).pattern for layer in layout.design.stack for axis in AXES
    }
    for axis in AXES:
        first: dict[str, tuple[str, list[tuple[PlacedLetter, Span]]]] = {}
        for layer, spans in lines[axis].spans.items():
            other, there = first.setdefault(pattern[layer, axis], (layer, spans))
            for (own, span), (letter, place) in zip(spans, there, strict=False):
                same = own.symbol == letter.symbol and abs(own.start - letter.start) <= 1e-6
                if same and not own.transparent and abs(span[0] - place[0]) > _NEAR:
                    text = (
                        f"{own.symbol} on {axis} begins at {span[0]:.2f} m in {layer!r} and at {place[0]:.2f} m in "
                        f"{other!r}, though both have the pattern {pattern[layer, axis]!r}"
                    )
                    yield Flaw("intrinsic", _band(layout, axis, *sorted((span[0], place[0]))), text)


def _unspaced(layout: Layout, lines: Mapping[Axis, _Line]) -> Iterator[Flaw]:
    """Neighbours of one symbol that are as far from each other as the first two are in the layout, and would not be."""
    for axis in AXES:
        for layer, spans in lines[axis].spans.items():
            last: dict[str, tuple[PlacedLetter, Span]] = {}
            usual: dict[str, tuple[float, float]] = {}
            for letter, span in spans:
                if letter.transparent:
                    continue
                if letter.symbol in last:
                    before, place = last[letter.symbol]
                    solved, naive = letter.start - before.end, span[0] - place[1]
                    first = usual.setdefault(letter.symbol, (solved, naive))
                    if abs(solved - first[0]) <= _NEAR < abs(naive - first[1]):
                        text = (
                            f"Neighbours {letter.symbol} of {layer!r} on {axis} are {naive:.2f} m apart, and the first "
                            f"two {first[1]:.2f} m"
                        )
                        yield Flaw("placement", _band(layout, axis, place[1], span[0]), text)
                last[letter.symbol] = letter, span


def _sized(layout: Layout, lines: Mapping[Axis, _Line]) -> Iterator[Flaw]:
    """Instances of a symbol, of all layers, that are not as large within the canvas as the largest one is."""
    for axis, end in _ends(layout):
        seen: dict[str, list[tuple[str, PlacedLetter, Span]]] = {}
        for layer, spans in lines[axis].spans.items():
            for letter, (start, stop) in spans:
                if not letter.transparent and start + _NEAR < end:
                    seen.setdefault(letter.symbol, []).append((layer, letter, (start, min(stop, end))))
        for symbol, places in seen.items():
            _, most, (low, high) = max(places, key=lambda one: one[2][1] - one[2][0])
            for layer, letter, (start, stop) in places:
                differs = high - low - (stop - start) > _NEAR
                if differs and abs(letter.size - most.size) <= _NEAR:
                    where = " at the canvas's end" if stop == end else ""
                    text = (
                        f"{symbol} of {layer!r} on {axis} is {stop - start:.2f} m{where}, "
                        f"and {high - low:.2f} m elsewhere"
                    )
                    yield Flaw("sizing", _band(layout, axis, start, stop), text)


def _ends(layout: Layout) -> tuple[tuple[Axis, float], tuple[Axis, float]]:
    return ("x", layout.canvas.width), ("y", layout.canvas.height)


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
    """Shapes of symbols that must not be covered, and would be; windows and doors that would be as a whole."""
    design = layout.design
    if design is None:
        return
    told: set[Rect] = set()
    for i, below in enumerate(layout.shapes):
        guarded = design.symbol(below.x).unoccludable or design.symbol(below.y).unoccludable
        if not guarded and below.kind not in ("window", "door"):
            continue
        for j in range(i + 1, len(layout.shapes)):
            above = layout.shapes[j]
            if above.layer == below.layer:
                continue
            common = _common(shapes[i], shapes[j])
            whole = common is not None and all(
                abs(a - b) <= _NEAR for a, b in zip(common, shapes[i], strict=True)
            )
            if common is None or common in told or not (guarded or whole):
                continue
            if _common(below.rect, above.rect) is None:
                told.add(common)
                yield Flaw(
                    "occlusion",
                    common,
                    f"{above.x} {above.y} of {above.layer!r} covers {below.x} {below.y} of {below.layer!r}",
                )


def _bare(layout: Layout, shapes: Iterable[PlacedShape]) -> Iterator[Flaw]:
    """Places of the canvas without a shape, which have one in the layout."""
    canvas = layout.canvas
    placed = []
    for shape in shapes:
        inside = _common(shape.rect, (0.0, 0.0, canvas.width, canvas.height))
        if inside is not None:
            placed.append(replace(shape, rect=inside))
    own = set(layout.holes)
    for hole in find_holes(canvas, placed):
        if hole not in own and min(hole[2] - hole[0], hole[3] - hole[1]) > _NEAR:
            yield Flaw("hole", hole, "Nothing covers this place")


def _beyond(layout: Layout, lines: Mapping[Axis, _Line]) -> Iterator[Flaw]:
    """Words that end beyond the canvas."""
    for axis, size in _ends(layout):
        for layer, end in lines[axis].ends.items():
            if end > size + _NEAR:
                text = f"The word of {layer!r} on {axis} ends {end - size:.2f} m too far"
                yield Flaw("beyond", _band(layout, axis, size, end), text)


def _short(layout: Layout, lines: Mapping[Axis, _Line]) -> Iterator[Flaw]:
    """Words that end before the canvas does, but for what is empty in the layout too."""
    for axis, size in _ends(layout):
        for layer, end in lines[axis].ends.items():
            spans = lines[axis].spans[layer]
            reach = max((letter.end for letter, _ in spans), default=0.0)
            if end < size - _NEAR and reach >= size - _NEAR:
                text = f"The word of {layer!r} on {axis} leaves {size - end:.2f} m of the canvas empty"
                yield Flaw("short", _band(layout, axis, end, size), text)


def _band(layout: Layout, axis: Axis, low: float, high: float) -> Rect:
    """A strip across the whole façade."""
    if axis == "x":
        return low, 0.0, high, layout.canvas.height
    return 0.0, low, layout.canvas.width, high


def _common(a: Rect, b: Rect) -> Rect | None:
    """What two rectangles have in common, if one can see it."""
    left, bottom, right, top = max(a[0], b[0]), max(a[1], b[1]), min(a[2], b[2]), min(a[3], b[3])
    return (left, bottom, right, top) if right - left > _NEAR and top - bottom > _NEAR else None
