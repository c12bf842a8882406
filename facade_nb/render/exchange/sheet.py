"""The sheet: A3 landscape, the largest common scale at which a drawing fits on it, and where everything stands."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

from ...solver.model.layout import Layout
from .chains import FIRST, PITCH, chains, scales
from .linework import Linework

__all__ = ["MARGIN", "PAPER", "ROW", "TITLE", "Sheet", "Table", "lay_out", "scale_of"]

PAPER = (420.0, 297.0)
"""Width and height, millimetres."""

MARGIN = 7.5
"""From the edge of the paper to the frame."""

TITLE = (118.0, 26.0)
"""The title block, in the lower right corner."""

ROW = 3.3
"""Height of a row of the schedule."""

Bounds = tuple[float, float, float, float] | None

_GAP = 4.0
_HEAD = 2
"""Rows of the schedule that its heading takes."""

_LARGEST_STRIP = 120.0
"""Height that a schedule below the drawing takes at most."""


@dataclass(frozen=True, slots=True)
class Table:
    """Where the schedule stands: left and top, columns side by side, rows in each; `left_out` have no room."""

    left: float
    top: float
    columns: int
    rows: int
    left_out: int = 0


@dataclass(frozen=True, slots=True)
class Sheet:
    """Where everything stands on paper, in millimetres from its lower left corner.

    `origin` is where the façade's lower left corner lies, `scale` as in 1:50.
    """

    scale: int
    origin: tuple[float, float]
    table: Table


def scale_of(layout: Layout, lines: Linework) -> int:
    """The largest scale at which the drawing with its dimensions fits on the sheet, were there nothing else."""
    inner = PAPER[0] - 2 * MARGIN, PAPER[1] - 2 * MARGIN
    for scale in scales():
        width, height = _extent(layout, lines.bounds, scale)
        if width <= inner[0] and height <= inner[1]:
            return scale
    return scales()[-1]


def lay_out(
    layout: Layout, bounds: Bounds, rows: int, wide: float, *, foot: float = 0.0, largest: int = 1
) -> Sheet:
    """The largest scale at which all fits, the schedule of `rows` rows, each `wide`, on the right or below.

    The common scales are tried first, then 1:500, 1:1000 and so on. A schedule too long for any place is cut.

    Parameters
    ----------
    bounds
        Of the drawing: left, bottom, right, top, metres; None: there is nothing.
    foot
        What is written below the dimensions, millimetres.
    largest
        No larger scale is taken: 100 for 1:100.
    """
    inner = PAPER[0] - 2 * MARGIN, PAPER[1] - 2 * MARGIN
    for scale in scales():
        if scale < largest:
            continue
        size = _extent(layout, bounds, scale, foot)
        found = _beside(inner, size, rows, wide) or _below(inner, size, rows, wide)
        if found is None and size[0] <= inner[0] / 2 and size[1] <= inner[1]:
            found = _cut(inner, rows, wide)
        if found is not None:
            table, (room_width, room_height), below = found
            left, bottom = _reach(layout, bounds, scale, foot)
            x = MARGIN + (room_width - size[0]) / 2 + left
            y = MARGIN + below + (room_height - size[1]) / 2 + bottom
            return Sheet(scale, (x, y), table)
    raise AssertionError("scales without an end")


_Found = tuple[Table, tuple[float, float], float]


def _beside(inner: tuple[float, float], size: tuple[float, float], rows: int, wide: float) -> _Found | None:
    """The schedule in one or two columns to the right, above the title block."""
    most = int((inner[1] - TITLE[1] - _GAP) / ROW) - _HEAD
    for columns in (1, 2):
        column = max(columns * wide + (columns - 1) * _GAP, TITLE[0])
        room = inner[0] - column - _GAP
        if rows <= columns * most and size[0] <= room and size[1] <= inner[1]:
            left = MARGIN + inner[0] - column
            return Table(left, MARGIN + inner[1], columns, ceil(rows / columns)), (room, inner[1]), 0.0
    return None


def _below(inner: tuple[float, float], size: tuple[float, float], rows: int, wide: float) -> _Found | None:
    """The schedule in as many columns as there is room for to the left of the title block."""
    columns = int((inner[0] - TITLE[0]) / (wide + _GAP))
    if columns < 1:
        return None
    each = max(ceil(rows / columns), int(TITLE[1] / ROW) - _HEAD)  # no columns of few rows
    columns = max(1, ceil(rows / each))
    strip = max(TITLE[1], (each + _HEAD) * ROW)
    if strip > _LARGEST_STRIP or size[0] > inner[0] or size[1] + strip > inner[1]:
        return None
    return Table(MARGIN, MARGIN + strip, columns, each), (inner[0], inner[1] - strip), strip


def _cut(inner: tuple[float, float], rows: int, wide: float) -> _Found:
    """As much of the schedule as the right half of the sheet holds."""
    most = int((inner[1] - TITLE[1] - _GAP) / ROW) - _HEAD
    columns = max(1, int((inner[0] / 2) / (wide + _GAP)))
    column = max(columns * (wide + _GAP), TITLE[0])
    kept = min(rows, columns * most - 1)
    table = Table(MARGIN + inner[0] - column, MARGIN + inner[1], columns, most, rows - kept)
    return table, (inner[0] / 2, inner[1]), 0.0


def _reach(layout: Layout, bounds: Bounds, scale: int, foot: float) -> tuple[float, float]:
    """Millimetres from the left end and the foot of the drawing, with its dimensions, to the façade's corner."""
    left, bottom, _, _ = bounds or (0.0, 0.0, 0.0, 0.0)
    found = []
    for axis, low in (("x", bottom), ("y", left)):
        count = len(chains(layout, "x" if axis == "x" else "y"))
        found.append(-min(low, 0.0) * 1000 / scale + FIRST + PITCH * (count - 1) + 3.0)
    return found[1], found[0] + foot


def _extent(layout: Layout, bounds: Bounds, scale: int, foot: float = 0.0) -> tuple[float, float]:
    """Width and height of the drawing with its dimensions, millimetres on paper."""
    _, _, right, top = bounds or (0.0, 0.0, 0.0, 0.0)
    left, bottom = _reach(layout, bounds, scale, foot)
    canvas = layout.canvas
    return (
        left + max(right, canvas.width) * 1000 / scale + 1.5,
        bottom + max(top, canvas.height) * 1000 / scale + 1.5,
    )
