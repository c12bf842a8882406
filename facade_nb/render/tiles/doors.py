"""Doors, balcony doors, gates and shutters."""

from __future__ import annotations

import numpy as np

from .canvas import Canvas, paint
from .glazing import Pane, glaze
from .joinery import Wood, bars, boxed, field_panel, leaf, reveal, sill, surround
from .plain import boards

__all__ = ["balcony_door", "gate", "louvres", "modern_door", "panel_shutter", "panelled", "roller"]


def _grained(canvas: Canvas, colour: str, seed: int, strength: float) -> np.ndarray:
    fibre = canvas.noise((0.012, 0.35), seed, 2)
    rings = np.sin(4 * canvas.noise((0.05, 0.9), seed + 1, 2))
    return np.clip(paint(colour) * (1 + strength * (0.05 * fibre + 0.05 * rings))[..., None], 0, 1).astype(
        np.float32
    )


def panelled(
    canvas: Canvas,
    seed: int,
    *,
    wood: str = "#5a4232",
    stone: str = "#d3cbba",
    double: bool = True,
    fanlight: bool = True,
    glazed: bool = False,
    grain: float = 1.0,
) -> None:
    """A front door of frames and panels below a fanlight, in a stone surround with a step."""
    w, h = canvas.width, canvas.tall
    step, edge = 0.13, 0.09 * w
    canvas.lay(canvas.full(), stone, gloss=0.08)
    inner = (edge, step, w - edge, h - 0.11 * h)
    surround(canvas, (0.0, 0.0, w, inner[3] + edge), inner, stone, height=0.035, steps=3)
    canvas.slab(0.0, inner[3] + edge, w, h - 0.05, stone, 0.05, edge=0.012, fall=0.015, gloss=0.08)
    canvas.slab(0.0, h - 0.07, w, h, stone, 0.1, edge=0.015, fall=0.02, gloss=0.08)
    timber = _grained(canvas, wood, seed, grain)
    reveal(canvas, inner, "#857b6c", 0.16)
    canvas.lay(canvas.box(inner[0], inner[1], inner[2], inner[3]), timber, height=-0.13, gloss=0.3)
    top = inner[3] - (0.42 if fanlight else 0.03)
    if fanlight:
        light = (inner[0] + 0.045, top + 0.05, inner[2] - 0.045, inner[3] - 0.045)
        panes = bars(light, 3 if double else 1, 1, 0.03)
        glaze(canvas, panes, seed + 7, depth=-0.15, behind="dark")
        canvas.slab(inner[0], top - 0.02, inner[2], top + 0.05, wood, -0.1, edge=0.012, fall=0.014, gloss=0.3)
    count = 2 if double else 1
    span = (inner[2] - inner[0] - 0.05) / count
    for k in range(count):
        left = inner[0] + 0.025 + k * span
        right = left + span
        face = -0.12
        canvas.lay(canvas.box(left + 0.003, step, right - 0.003, top - 0.02), timber, height=face, gloss=0.3)
        stile = 0.1 if double else 0.12
        a, b = left + stile, right - stile
        tall = top - 0.02 - step
        rows = ((0.1, 0.29), (0.345, 0.47), (0.52, 0.94))
        for j, (low, high) in enumerate(rows):
            pane = (a, step + low * tall, b, step + high * tall)
            if glazed and j == 2:
                glaze(canvas, bars(pane, 1, 2, 0.022), seed + 11 + k, depth=-0.145, behind="half")
                continue
            field_panel(canvas, pane, timber, face)
            if not double and j != 1:  # a wide leaf has two panels side by side
                middle = (a + b) / 2
                canvas.lay(
                    canvas.box(middle - 0.05, pane[1], middle + 0.05, pane[3]), timber, height=face, gloss=0.3
                )
                for side in ((a, middle - 0.05), (middle + 0.05, b)):
                    field_panel(canvas, (side[0], pane[1], side[1], pane[3]), timber, face)
    if double:
        canvas.slab(
            w / 2 - 0.022, step, w / 2 + 0.022, top - 0.02, timber, -0.1, edge=0.008, fall=0.01, gloss=0.3
        )
    canvas.slab(inner[0], step, inner[2], step + 0.14, "#3b3632", -0.105, edge=0.006, fall=0.008, gloss=0.4)
    knob_x = w / 2 + 0.055 if double else inner[0] + 0.085
    knob_y = step + 1.0
    canvas.lay(
        canvas.box(knob_x - 0.02, knob_y - 0.1, knob_x + 0.02, knob_y + 0.08),
        "#a58a54",
        height=-0.112,
        gloss=0.8,
    )
    knob = canvas.disc_distance(knob_x, knob_y, 0.026)
    canvas.lay(
        canvas.cover(knob), "#c2a566", height=(-0.06 - 0.4 * (knob + 0.026)).astype(np.float32), gloss=0.9
    )
    canvas.slab(0, 0, w, step, "#bdb5a4", 0.12, edge=0.012, fall=0.02, gloss=0.1)


def balcony_door(
    canvas: Canvas, seed: int, behind: str | None, *, wood: str = "#efece4", stone: str = "#d3cbba"
) -> None:
    """Two glazed leaves to the floor with a panel at the foot, and a fanlight."""
    w, h = canvas.width, canvas.tall
    inner = (0.09 * w, 0.03, 0.91 * w, h - 0.06 * h)
    surround(canvas, (0.0, 0.0, w, h), inner, stone, height=0.035, steps=3)
    reveal(canvas, inner, "#b9b1a1", 0.11)
    box = boxed(canvas, inner, wood, -0.085, 0.03, foot=0.02)
    bar_y = box[3] - 0.23 * (box[3] - box[1])
    timber = Wood(wood, 0.052, 0.075, 0.024)
    panes: list[Pane] = []
    for left, right in ((box[0], w / 2), (w / 2, box[2])):
        low = box[1] + 0.42
        panes += leaf(
            canvas, (left, box[1], right, bar_y - 0.028), timber, -0.07, rail=low - box[1], columns=1, rows=2
        )
        field_panel(canvas, (left + 0.065, box[1] + 0.085, right - 0.065, low - 0.045), wood, -0.07)
        panes += leaf(canvas, (left, bar_y + 0.028, right, box[3]), timber, -0.07, rail=0.045)
    canvas.slab(box[0], bar_y - 0.035, box[2], bar_y + 0.035, wood, -0.05, edge=0.012, fall=0.012, gloss=0.35)
    canvas.slab(
        w / 2 - 0.03, box[1], w / 2 + 0.03, bar_y - 0.03, wood, -0.055, edge=0.01, fall=0.01, gloss=0.35
    )
    if behind is None:
        for pane in panes:
            canvas.cut(canvas.box(*pane), height=-0.16)
    else:
        glaze(canvas, panes, seed, depth=-0.11, behind=behind, within=box)
    sill(canvas, 0.05 * w, 0.95 * w, 0.03, stone, thick=0.03, out=0.02)


def modern_door(canvas: Canvas, seed: int, *, metal: str = "#3d4144", wood: str = "#8a6a4a") -> None:
    """A flush door of oak strips beside a tall pane, a long pull handle."""
    w, h = canvas.width, canvas.tall
    canvas.slab(0, 0, w, h, metal, 0.0, edge=0.004, fall=0.004, gloss=0.5)
    reveal(canvas, (0.03, 0.0, w - 0.03, h - 0.03), "#2f3335", 0.14)
    box = boxed(canvas, (0.03, 0.0, w - 0.03, h - 0.03), metal, -0.11, 0.04, gloss=0.5, foot=0.02)
    cut = box[0] + 0.7 * (box[2] - box[0])
    strips = Canvas(canvas.size, w, h, colour=wood)
    boards(strips, seed, ("#8d6d4d", "#866545", "#937353"), round(w / 0.075), gap=0.004, round_=0.002)
    leaf_box = canvas.box(box[0] + 0.004, box[1], cut, box[3] - 0.004)
    canvas.lay(leaf_box, strips.colour, height=(strips.height - 0.09).astype(np.float32), gloss=0.2)
    canvas.slab(cut, box[1], cut + 0.04, box[3], metal, -0.095, edge=0.004, fall=0.004, gloss=0.5)
    glaze(canvas, [(cut + 0.04, box[1] + 0.02, box[2], box[3])], seed, depth=-0.12, behind="dark")
    x = cut - 0.11
    canvas.slab(x - 0.014, 0.45, x + 0.014, h - 0.75, "#b9bcbc", -0.03, edge=0.01, fall=0.012, gloss=0.9)
    canvas.slab(0, 0, w, 0.03, "#77797a", 0.02, edge=0.005, fall=0.006, gloss=0.4)


def gate(canvas: Canvas, seed: int, *, wood: str = "#5d5140", stone: str = "#cfc4ad") -> None:
    """A carriage gate in a segmental stone arch; transparent above the arch."""
    w, h = canvas.width, canvas.tall
    band, rise = 0.2, 0.42
    spring = h - rise - 0.06
    outer = canvas.arch_distance(0.01, 0.0, w - 0.01, spring, rise + 0.04)
    inner = canvas.arch_distance(band, -0.1, w - band, spring - 0.2, rise - 0.06)
    fine = np.clip(paint(stone) * (1 + 0.015 * canvas.noise(0.02, seed, 2))[..., None], 0, 1)
    course = np.abs((canvas.y + 0.2) % 0.4 - 0.2) + 0 * canvas.x
    joint = canvas.cover((course - 0.004).astype(np.float32)) * (canvas.y < spring - 0.2)
    bevel = np.clip(-outer / 0.015, 0, 1) * np.clip(inner / 0.03, 0, 1)
    canvas.lay(
        canvas.cover(outer), fine, height=(0.04 * bevel - 0.008 * joint).astype(np.float32), gloss=0.08
    )
    canvas.shade(1 - 0.25 * joint)
    canvas.lay(canvas.cover(inner), "#6f6656", height=-0.2)
    timber = _grained(canvas, wood, seed, 1.0)
    body = canvas.cover(inner + 0.01)
    canvas.lay(body, timber, height=-0.17, gloss=0.25)
    for k in range(2):
        left = band + 0.02 + k * (w / 2 - band)
        right = left + w / 2 - band - 0.04
        for low, high in ((0.18, 0.72), (0.82, 1.22), (1.32, h)):
            inset = np.maximum(inner + 0.12, canvas.box_distance(left + 0.12, low, right - 0.12, high))
            inward = np.clip(-inset, 0, 1)
            height = (
                -0.17 - 0.02 * np.clip(inward / 0.015, 0, 1) + 0.02 * np.clip((inward - 0.02) / 0.045, 0, 1)
            )
            canvas.lay(canvas.cover(inset), timber, height=height.astype(np.float32), gloss=0.25)
    canvas.lay(canvas.box(w / 2 - 0.03, 0.02, w / 2 + 0.03, h) * body, timber, height=-0.145, gloss=0.25)
    for side in (-1, 1):
        ring = np.abs(canvas.disc_distance(w / 2 + side * 0.2, 1.27, 0.05)) - 0.009
        canvas.lay(canvas.cover(ring), "#2f2d2b", height=-0.14, gloss=0.6)
    canvas.lay(
        canvas.box(0.01, 0, w - 0.01, 0.28) * canvas.cover(-inner), np.clip(fine * 0.96, 0, 1), height=0.06
    )


def louvres(canvas: Canvas, seed: int, *, paint_: str = "#55695b", slats: int = 26) -> None:
    """One leaf of a louvred shutter: two fields of slanting slats."""
    w, h = canvas.width, canvas.tall
    canvas.slab(0, 0, w, h, paint_, 0.03, edge=0.006, fall=0.008, gloss=0.3)
    stile, rail = 0.06, 0.085
    middle = 0.52 * h
    for low, high in ((rail, middle - rail / 2), (middle + rail / 2, h - rail)):
        count = max(4, round(slats * (high - low) / h))
        pitch = (high - low) / count
        place = ((canvas.y - low) % pitch) / pitch + 0 * canvas.x
        height = 0.026 - 0.024 * place
        tint = 1 + 0.03 * np.sin(7.3 * np.floor((canvas.y - low) / pitch) + seed) + 0 * canvas.x
        colour = np.clip(paint(paint_) * tint[..., None], 0, 1)
        canvas.lay(
            canvas.box(stile, low, w - stile, high), colour, height=height.astype(np.float32), gloss=0.3
        )
    wear = canvas.noise((0.03, 0.3), seed, 3)
    canvas.shade(1 + 0.02 * wear)
    for y in (0.12 * h, 0.88 * h):
        canvas.slab(0.0, y - 0.02, 0.14, y + 0.02, "#2f3230", 0.036, edge=0.003, fall=0.004, gloss=0.5)


def panel_shutter(canvas: Canvas, seed: int, *, paint_: str = "#6d7f8a") -> None:
    """One leaf of a panelled shutter with a heart-free, plain field above and below."""
    w, h = canvas.width, canvas.tall
    canvas.slab(0, 0, w, h, paint_, 0.03, edge=0.006, fall=0.008, gloss=0.3)
    for low, high in ((0.08, 0.4), (0.46, 0.94)):
        field_panel(canvas, (0.07, low * h, w - 0.07, high * h), paint_, 0.03)
    canvas.shade(1 + 0.018 * canvas.noise((0.03, 0.3), seed, 3))
    for y in (0.12 * h, 0.88 * h):
        canvas.slab(0.0, y - 0.02, 0.14, y + 0.02, "#2f3230", 0.038, edge=0.003, fall=0.004, gloss=0.5)


def roller(canvas: Canvas, seed: int, *, colour: str = "#b6b3ab", pitch: float = 0.045) -> None:
    """A roller shutter let down: slats that go on upwards and sideways."""
    count = max(1, round(canvas.tall / pitch))
    place = canvas.y / canvas.tall * count % 1 + 0 * canvas.x
    height = 0.006 * np.sin(np.pi * place) - 0.006 * (place < 0.1)
    tint = (
        1
        + 0.012 * np.sin(5.7 * np.floor(canvas.y / canvas.tall * count) + seed)[..., None]
        + 0.012 * canvas.noise(0.3, seed, 2)[..., None]
    )
    canvas.lay(
        canvas.full(), np.clip(paint(colour) * tint, 0, 1), height=height.astype(np.float32), gloss=0.3
    )
    canvas.shade(1 - 0.35 * canvas.cover((np.abs(place - 0.04) * pitch - 0.003).astype(np.float32)))
