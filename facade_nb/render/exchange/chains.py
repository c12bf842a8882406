"""Dimensions: chains of boundaries and totals, how they are written, and where their texts stand without colliding."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from ...design.model import Axis
from ...solver.model.layout import Layout
from ..measured import LEAST, Chain, ranges, within

__all__ = [
    "FIRST",
    "PITCH",
    "SCALES",
    "TEXT",
    "UNITS",
    "Units",
    "chains",
    "check_units",
    "label",
    "levels",
    "offset",
    "scales",
    "width",
]

Units = Literal["m", "ft"]
UNITS: tuple[Units, ...] = ("m", "ft")
"""Metres with two decimals; feet and inches to the eighth of an inch."""

SCALES = (20, 50, 100, 200)
"""The scales of drawings, largest first."""

TEXT = 1.8
"""Height of a dimension's text on paper, millimetres."""

FIRST, PITCH = 7.0, 9.5
"""Millimetres on paper from the façade to the first chain, and from one chain to the next."""

ROWS = 0.8
"""Millimetres between two rows of a chain's texts: as much as letters reach below their line, and a little air."""

_MOST = 3
"""Chains of boundaries along an axis, before the total."""


def check_units(units: str) -> Units:
    """The units, if there are such. Raises ValueError otherwise."""
    for known in UNITS:
        if units == known:
            return known
    raise ValueError(f"units: expected 'm' (metres) or 'ft' (feet and inches); found {units!r}")


def scales() -> Sequence[int]:
    """The scales to try, largest first: the common ones, then 1:500, 1:1000, 1:2000, 1:5000 and so on."""
    return (*SCALES, *(n * 10**k for k in range(2, 9) for n in (5, 10, 20)))


def chains(layout: Layout, axis: Axis) -> tuple[Chain, ...]:
    """The chains along an axis, nearest the façade first; the last is the total.

    Each alignment group has one, its boundaries of columns; those with most boundaries come first. A layout without
    groups has a chain of its shapes' boundaries. Gaps between the walls of a building are measured in none: there each
    wall has a total of its own.
    """
    size = layout.canvas.width if axis == "x" else layout.canvas.height
    walls = ranges(layout, axis)
    found = [group.columns for group in layout.along(axis).groups.values()]
    if not found:
        low = 0 if axis == "x" else 1
        found = [tuple(shape.rect[k] for shape in layout.shapes for k in (low, low + 2))]
    distinct: dict[Chain, None] = {}
    for stops in found:
        kept = [0.0]
        for stop in sorted(stops):
            if stop - kept[-1] >= LEAST and size - stop >= LEAST:
                kept.append(stop)
        chain = within(walls, [round(stop, 4) for stop in (*kept, size)])
        if chain != within(walls, (0.0, size)):
            distinct.setdefault(chain)
    return (*sorted(distinct, key=lambda chain: -len(chain))[:_MOST], walls)


def label(length: float, units: Units) -> str:
    """A length as it is written: ``1.20``, or ``3'-11 1/4"``."""
    if units == "m":
        return f"{length:.2f}"
    eighths = round(length / 0.0254 * 8)
    feet, rest = divmod(eighths, 96)
    inches, part = divmod(rest, 8)
    fraction = {0: "", 1: "1/8", 2: "1/4", 3: "3/8", 4: "1/2", 5: "5/8", 6: "3/4", 7: "7/8"}[part]
    whole = str(inches) if inches or not fraction else ""
    text = f'{" ".join(word for word in (whole, fraction) if word)}"'
    return f"{feet}'-{text if whole else f'0 {text}'}" if feet else text


def levels(chain: Chain, scale: float, units: Units) -> tuple[int | None, ...]:
    """The row of each text of a chain: 0 where it fits between its ends, else 1 or 2; None: there is no room.

    Texts of a row never touch one another (`offset` has where the rows lie). `scale` is as in 1:50.
    """
    ends = {1: -1e9, 2: -1e9}
    found: list[int | None] = []
    for a, b in chain:
        wide = width(label(b - a, units)) + 0.8
        start, end = (1000 * stop / scale for stop in (a, b))
        if wide <= end - start:
            found.append(0)
            continue
        left = (start + end - wide) / 2
        level = next((k for k in ends if left >= ends[k]), None)
        found.append(level)
        if level is not None:
            ends[level] = left + wide
    return tuple(found)


def offset(axis: Axis, level: int) -> float:
    """How far the middle of a text lies from its chain's line, millimetres; towards the façade it is negative.

    Along x a text of level 0 stands between line and façade; along y, written upwards, on the other side of the line.
    """
    if axis == "x":
        return 1.4 + TEXT / 2 + (level - 1) * (TEXT + ROWS) if level else -(0.5 + TEXT / 2)
    return 0.5 + TEXT / 2 + level * (TEXT + ROWS)


def width(text: str, height: float = TEXT) -> float:
    """How wide a text is on paper at most, millimetres, in the fonts that programs put in the place of Arial."""
    return sum(0.5 if c in ".'-\" /" else 0.88 for c in text) * height
