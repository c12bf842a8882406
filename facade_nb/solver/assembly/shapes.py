"""From two solved axes to shapes: the outer product of each layer, what hides what, and holes (docs/problem.md)."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product

import numpy as np

from ...design.errors import NoLayout
from ...design.model import AXES, Axis, Canvas, Design, Layer, Shape
from ..model.layout import AxisLayout, PlacedLetter, PlacedShape, Rect
from .looks import Instance, Looks, instances, written

__all__ = ["find_holes", "hole_warnings", "merge"]

_Drawn = tuple[str, str, str, float, float]
"""Kind, geometry, material, offset, thickness."""

MAX_SHAPES = 250_000
"""Most shapes of one layer."""

_NEAR = 1e-6


def merge(
    design: Design,
    x: AxisLayout,
    y: AxisLayout,
    check: Callable[[], None] | None = None,
    *,
    behind: bool = False,
) -> tuple[PlacedShape, ...]:
    """Visible shapes, bottom layer first; with `behind`, those wholly behind others too.

    Letters that are transparent, masked out by the layer or hidden by their pattern make no shape; nor do
    shapes that are not `visible`, nor those wholly behind a visible shape both of whose symbols are opaque.

    Raises
    ------
    NoLayout
        Where there would be more than `MAX_SHAPES`.
    """
    layers: list[list[PlacedShape]] = []
    fronts: list[_Front] = []
    known = written(design)
    for layer in design.stack:  # topmost first, so that what covers is known before what is covered
        own: list[PlacedShape] = []
        looks = Looks(design, layer, known)
        cells = (list(_shown(design, layer, "x", x)), list(_shown(design, layer, "y", y)))
        columns, floors = ([letter for letter, _ in line] for line in cells)
        sorts, rises = ([looks.sort(own) for _, own in line] for line in cells)
        front = _Front(columns, floors)
        before = [(f, f.across(columns), f.up(floors)) for f in fronts]
        opaque = {a.symbol for a in (*columns, *floors) if design.symbol(a.symbol).opaque}
        across_it = [
            (i, a.symbol, a.start, a.end, a.mirrored, number, a.symbol in opaque)
            for i, (a, (_, number, _)) in enumerate(cells[0])
        ]
        rows: dict[
            int, list[tuple[int, str, float, float, bool, int, bool, _Drawn]]
        ] = {}  # by sort: the cells that are drawn
        for j, (v, (_, level, _)) in enumerate(cells[1]):
            if check is not None:
                check()
            if len(own) > MAX_SHAPES:
                raise _too_many(layer, columns, floors)
            hiding = [
                (f.solid, across, up[j]) for f, across, up in before if up[j] is not None and not behind
            ]
            row = rows.get(rises[j])
            if row is None:
                row = rows[rises[j]] = [
                    (*one, _drawn(look))
                    for one, sort in zip(across_it, sorts, strict=True)
                    if (look := looks.of(sort, rises[j])).visible
                ]
            up_symbol, low, high, turned, solid_up = v.symbol, v.start, v.end, v.mirrored, v.symbol in opaque
            for i, symbol, left, right, mirrored, number, solid_across, drawn in row:
                for solid, across, k in hiding:
                    if (across[i], k) in solid:
                        break
                else:
                    own.append(
                        PlacedShape(
                            layer.name,
                            symbol,
                            up_symbol,
                            (left, low, right, high),
                            (mirrored, turned),
                            *drawn,
                            (number, level),
                        )
                    )
                    if solid_across and solid_up:
                        front.solid.add((i, j))
        fronts.append(front)
        layers.append(own)
    return tuple(shape for own in reversed(layers) for shape in own)


def _too_many(layer: Layer, columns: Sequence[PlacedLetter], floors: Sequence[PlacedLetter]) -> NoLayout:
    return NoLayout(
        f"Layer {layer.name!r} has {len(columns):,} by {len(floors):,} cells; a layer may have {MAX_SHAPES:,} shapes "
        "at most. Larger letters, or a smaller canvas, would do.",
        patterns=(layer.x.pattern, layer.y.pattern),
        layers=(layer.name,),
        constraint="shapes",
    )


class _Front:
    """A layer in front of others: which of its cells hide what is wholly behind them."""

    def __init__(self, columns: Sequence[PlacedLetter], floors: Sequence[PlacedLetter]) -> None:
        self._columns, self._floors = _Row(columns), _Row(floors)
        self.solid: set[tuple[int | None, int | None]] = set()

    def across(self, letters: Sequence[PlacedLetter]) -> list[int | None]:
        """Per letter: the column of this layer that it is wholly behind."""
        return self._columns.holders(letters)

    def up(self, letters: Sequence[PlacedLetter]) -> list[int | None]:
        """Per letter: the same of rows of cells."""
        return self._floors.holders(letters)


class _Row:
    """Where the letters of a row begin and end."""

    def __init__(self, letters: Sequence[PlacedLetter]) -> None:
        self._starts = [a.start - _NEAR for a in letters]
        self._ends = [a.end + _NEAR for a in letters]

    def holders(self, letters: Sequence[PlacedLetter]) -> list[int | None]:
        """Letters of a row do not overlap, so that only the last one that begins before can hold another."""
        starts, ends = self._starts, self._ends
        found: list[int | None] = []
        for letter in letters:
            end = letter.end
            n = bisect_right(starts, letter.start) - 1
            while n > 0 and ends[n] < end and ends[n - 1] >= end:
                n -= 1  # it begins a little before the next one does
            found.append(n if n >= 0 and ends[n] >= end else None)
        return found


def _drawn(look: Shape) -> _Drawn:
    """What a shape has of its look."""
    return (
        look.kind or "wall",
        look.geometry or "box",
        look.material or "card",
        look.offset or 0.0,
        0.0 if look.thickness is None else look.thickness,
    )


def _shown(
    design: Design, layer: Layer, axis: Axis, solved: AxisLayout
) -> Iterator[tuple[PlacedLetter, Instance]]:
    own = layer.along(axis)
    hidden = design.patterns[own.pattern].hidden
    for letter, instance in instances(solved, layer):
        if letter.symbol not in hidden and (own.mask is None or letter.symbol in own.mask):
            yield letter, instance


def find_holes(canvas: Canvas, shapes: Sequence[PlacedShape]) -> tuple[Rect, ...]:
    """Rectangles of the canvas that no shape covers: a partition into as tall, then as wide, pieces as come."""
    rects = {shape.rect for shape in shapes}
    across = {value: 0 for rect in rects for value in rect[::2]}
    up = {value: 0 for rect in rects for value in rect[1::2]}
    xs = _cuts([0.0, canvas.width, *across], canvas.width)
    ys = _cuts([0.0, canvas.height, *up], canvas.height)
    nx, ny = len(xs) - 1, len(ys) - 1
    grid = np.ones((nx, ny), dtype=bool)
    across = {value: _index(xs, value) for value in across}
    up = {value: _index(ys, value) for value in up}
    for left, bottom, right, top in rects:
        grid[across[left] : across[right], up[bottom] : up[top]] = False
    if not grid.any():
        return ()
    bare = grid.tolist()
    holes: list[Rect] = []
    open_runs: dict[tuple[int, int], int] = {}
    for i in range(nx + 1):
        runs = set(_runs(bare[i])) if i < nx else set()
        for run in [r for r in open_runs if r not in runs]:
            holes.append((xs[open_runs.pop(run)], ys[run[0]], xs[i], ys[run[1]]))
        for run in runs:
            open_runs.setdefault(run, i)
    return tuple(sorted(holes))


def _cuts(values: Sequence[float], size: float) -> list[float]:
    out: list[float] = []
    for value in sorted(values):
        if -_NEAR <= value <= size + _NEAR and (not out or value > out[-1] + _NEAR):
            out.append(value)
    return out


def _index(values: Sequence[float], value: float) -> int:
    return min(bisect_left(values, value - _NEAR), len(values) - 1)


def _runs(column: Sequence[bool]) -> Iterator[tuple[int, int]]:
    start: int | None = None
    for j, bare in enumerate([*column, False]):
        if bare and start is None:
            start = j
        elif not bare and start is not None:
            yield (start, j)
            start = None


def hole_warnings(
    design: Design,
    x: AxisLayout,
    y: AxisLayout,
    holes: Sequence[Rect],
    check: Callable[[], None] | None = None,
) -> list[str]:
    """A sentence for each letter that is itself not to be seen in a hole; one that pushed others aside comes first."""
    told: dict[str, None] = {}
    axes: Mapping[Axis, AxisLayout] = {"x": x, "y": y}
    for hole in holes:
        if check is not None:
            check()
        where = f"{hole[0]:.2f} to {hole[2]:.2f} m across, {hole[1]:.2f} to {hole[3]:.2f} m up"
        culprit = next(_hidden(design, axes, hole), None)
        if culprit is None:
            told[f"Nothing covers the canvas at {where}."] = None
        else:
            told[f"A hole at {where}: {culprit}."] = None
    return list(told)


def _hidden(design: Design, axes: Mapping[Axis, AxisLayout], hole: Rect) -> Iterator[str]:
    """The solid letters that stand in a hole, each with what hides it there.

    Those that pushed letters of their group aside come first, from the top; then the others, from the bottom.
    """
    idle: list[str] = []
    for layer in design.stack:
        looks = Looks(design, layer)
        across = _standing(axes["x"], layer, hole[0], hole[2])
        up = _standing(axes["y"], layer, hole[1], hole[3])
        own: list[str] = []
        for (h, column), (v, floor) in product(across, up):
            pushed = _pushes(design, axes["x"], layer, h, hole[0], hole[2]) or _pushes(
                design, axes["y"], layer, v, hole[1], hole[3]
            )
            stands = f"{h.symbol} {v.symbol} of layer {layer.name!r} stands there"
            for reason in _reasons(
                design, layer, h, v, looks.of(looks.sort(column), looks.sort(floor)).visible
            ):
                if pushed:
                    yield f"{stands} and pushed the others aside, but {reason}"
                else:
                    own.append(f"{stands}, but {reason}")
        idle[:0] = own
    yield from idle


def _reasons(
    design: Design, layer: Layer, h: PlacedLetter, v: PlacedLetter, visible: bool | None
) -> Iterator[str]:
    """What hides a shape."""
    for axis, letter in zip(AXES, (h, v), strict=True):
        own = layer.along(axis)
        if own.mask is not None and letter.symbol not in own.mask:
            yield f"its {axis} mask hides {letter.symbol}"
        elif letter.symbol in design.patterns[own.pattern].hidden:
            yield f"pattern {own.pattern!r} hides {letter.symbol}"
    if not visible:
        yield "it is not visible"


def _pushes(
    design: Design, solved: AxisLayout, layer: Layer, letter: PlacedLetter, low: float, high: float
) -> bool:
    """Whether another row of the group is empty where an opaque letter stands, within an interval.

    Only rows of one group are aligned, so a letter moves nothing of another group.
    """
    low, high = max(low, letter.start), min(high, letter.end)
    if not design.symbol(letter.symbol).opaque:
        return False
    for group in solved.groups.values():
        if any(row.layer == layer.name for row in group.rows):
            for row in group.rows:
                if row.layer != layer.name:
                    filled = sum(max(0.0, min(a.end, high) - max(a.start, low)) for a in row.letters)
                    if filled < high - low - _NEAR:
                        return True
    return False


def _standing(
    solved: AxisLayout, layer: Layer, low: float, high: float
) -> list[tuple[PlacedLetter, Instance]]:
    """Solid letters of a layer that reach into an interval, those with most of it first."""
    found = [(min(a.end, high) - max(a.start, low), a, own) for a, own in instances(solved, layer)]
    return [(a, own) for reach, a, own in sorted(found, key=lambda one: -one[0]) if reach > _NEAR]
