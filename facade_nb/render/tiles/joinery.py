"""What carpenters and masons make of openings: frames, leaves, bars, surrounds, sills. Sizes in metres."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .canvas import Canvas, Colour, Floats, paint
from .glazing import Pane

__all__ = ["Wood", "bars", "boxed", "field_panel", "leaf", "reveal", "sill", "surround"]


@dataclass(frozen=True, slots=True)
class Wood:
    """Sections of a window's members: `stile` and `rail` (bottom rail) of a leaf, its glazing `bar`, and its colour."""

    colour: str
    stile: float = 0.05
    rail: float = 0.07
    bar: float = 0.024
    gloss: float = 0.35


def boxed(
    canvas: Canvas,
    pane: Pane,
    colour: str,
    height: float,
    thick: float,
    *,
    gloss: float = 0.35,
    foot: float | None = None,
) -> Pane:
    """Draw a frame of four members inside a rectangle and return what it leaves open."""
    left, bottom, right, top = pane
    canvas.slab(left, bottom, right, top, colour, height, edge=0.006, fall=0.006, gloss=gloss)
    return left + thick, bottom + (thick if foot is None else foot), right - thick, top - thick


def bars(
    pane: Pane, columns: int, rows: int, bar: float, widths: Sequence[float] | None = None
) -> list[Pane]:
    """The panes that glazing bars divide a rectangle into; from the bottom left, row by row."""
    left, bottom, right, top = pane
    free_w = (right - left - bar * (columns - 1)) / columns
    free_h = (top - bottom - bar * (rows - 1)) / rows
    return [
        (
            left + i * (free_w + bar),
            bottom + j * (free_h + bar),
            left + i * (free_w + bar) + free_w,
            bottom + j * (free_h + bar) + free_h,
        )
        for j in range(rows)
        for i in range(columns)
    ]


def leaf(
    canvas: Canvas,
    pane: Pane,
    wood: Wood,
    height: float,
    *,
    columns: int = 1,
    rows: int = 1,
    rail: float | None = None,
) -> list[Pane]:
    """Draw a leaf with its glazing bars and return its panes, still to be glazed."""
    left, bottom, right, top = pane
    canvas.slab(left, bottom, right, top, wood.colour, height, edge=0.005, fall=0.006, gloss=wood.gloss)
    inner = (
        left + wood.stile,
        bottom + (wood.rail if rail is None else rail),
        right - wood.stile,
        top - wood.stile,
    )
    panes = bars(inner, columns, rows, wood.bar)
    putty = 0.009
    if columns * rows > 1:  # bars are thinner than stiles
        canvas.lay(canvas.box(*inner), wood.colour, height=height - 0.008)
    for p in panes:
        mould = canvas.box(p[0] - putty, p[1] - putty, p[2] + putty, p[3] + putty)
        depth = np.clip(
            -canvas.box_distance(p[0] - putty, p[1] - putty, p[2] + putty, p[3] + putty) / putty, 0, 1
        )
        canvas.lay(mould, wood.colour, height=np.minimum(canvas.height, height - 0.006 - 0.012 * depth))
    return panes


def reveal(canvas: Canvas, pane: Pane, colour: str, depth: float) -> None:
    """Sink an opening into the wall: what the frame does not fill is reveal."""
    canvas.lay(canvas.box(*pane), colour, height=-depth, gloss=0.05)


def sill(
    canvas: Canvas,
    left: float,
    right: float,
    top: float,
    colour: str,
    *,
    thick: float = 0.06,
    out: float = 0.06,
) -> None:
    """Draw a window sill whose upper edge is at `top`."""
    canvas.slab(left, top - thick, right, top, colour, out, edge=0.008, fall=0.01, gloss=0.12)


def surround(
    canvas: Canvas, outer: Pane, inner: Pane, colour: str, *, height: float = 0.03, steps: int = 2
) -> None:
    """Draw a moulded surround: fasciae that step out towards its outer edge.

    It is open at the bottom if the two rectangles meet there.
    """
    for k in range(steps):
        share = k / steps
        left, bottom, right, top = (o + (i - o) * share for o, i in zip(outer, inner, strict=True))
        canvas.slab(
            left, bottom, right, top, colour, height * (1 - 0.55 * share), edge=0.007, fall=0.008, gloss=0.08
        )
    fine = paint(colour) * (1 + 0.008 * canvas.noise(0.02, 5, 2))[..., None]
    ring: Floats = np.clip(canvas.box(*outer) - canvas.box(*inner), 0, 1)
    canvas.lay(ring, np.clip(fine, 0, 1))


def field_panel(
    canvas: Canvas,
    pane: Pane,
    colour: Colour,
    height: float,
    *,
    raised: bool = True,
    gloss: float = 0.3,
) -> None:
    """Draw a panel: a sunk groove, and in it a field raised by a bevel."""
    left, bottom, right, top = pane
    inward = np.clip(-canvas.box_distance(left, bottom, right, top), 0, 1)
    groove = np.clip(inward / 0.01, 0, 1) * -0.014
    field = np.clip((inward - 0.014) / 0.03, 0, 1) * 0.012 if raised else 0.0
    canvas.lay(
        canvas.box(left, bottom, right, top),
        colour,
        height=(height + groove + field).astype(np.float32),
        gloss=gloss,
    )
