"""Fronts of furniture, plants and lamps, transparent around them: they stand on the lower edge of their scope."""

from __future__ import annotations

import numpy as np

from .canvas import Canvas, Floats, paint, randoms
from .joinery import field_panel

__all__ = [
    "bed",
    "bookcase",
    "ceiling_lamp",
    "cupboard",
    "desk",
    "floor_lamp",
    "pendant",
    "plant",
    "sofa",
    "table",
]


def _shadow(canvas: Canvas, left: float, right: float, high: float = 0.05) -> None:
    """The dark line where a piece of furniture meets the floor."""
    canvas.lay(canvas.box(left, 0.0, right, high), "#1d1814", alpha=0.75)


def _cushion(
    canvas: Canvas,
    box: tuple[float, float, float, float],
    colour: str,
    seed: int,
    height: float,
    radius: float = 0.06,
) -> None:
    distance = canvas.box_distance(*box, radius)
    puff = np.sqrt(np.clip(-distance / 0.11, 0, 1))
    weave = canvas.noise(0.014, seed, 2)
    cloth = np.clip(paint(colour) * (0.86 + 0.16 * puff + 0.012 * weave)[..., None], 0, 1)
    canvas.lay(canvas.cover(distance), cloth, height=(height + 0.06 * puff).astype(np.float32), gloss=0.06)


def sofa(canvas: Canvas, seed: int, *, colour: str = "#74806f", pillow: str = "#c9a66b") -> None:
    """A sofa for three with two loose pillows."""
    w, h = canvas.width, canvas.tall
    _shadow(canvas, 0.06, w - 0.06)
    for x in (0.08, w - 0.13):
        canvas.slab(x, 0.0, x + 0.05, 0.12, "#3b2c20", 0.0, edge=0.006, fall=0.01)
    _cushion(canvas, (0.1, 0.3, w - 0.1, h - 0.02), colour, seed, 0.0, 0.1)
    canvas.lay(canvas.box(0.05, 0.1, w - 0.05, 0.3), np.clip(paint(colour) * 0.82, 0, 1), height=0.08)
    span = (w - 0.36) / 3
    for k in range(3):
        left = 0.18 + k * span
        _cushion(canvas, (left + 0.004, 0.43, left + span - 0.004, h - 0.07), colour, seed + k, 0.05, 0.07)
    for k in range(3):
        left = 0.18 + k * span
        _cushion(canvas, (left + 0.003, 0.28, left + span - 0.003, 0.46), colour, seed + 5 + k, 0.12, 0.05)
    for box, tone in (((0.26, 0.42, 0.62, 0.72), pillow), ((w - 0.6, 0.42, w - 0.26, 0.7), "#d9d0bd")):
        _cushion(canvas, box, tone, seed + 9, 0.16, 0.08)
    for left in (0.0, w - 0.2):
        _cushion(canvas, (left, 0.08, left + 0.2, 0.62), colour, seed + 12, 0.16, 0.08)


def table(canvas: Canvas, seed: int, *, wood: str = "#7a5a3d") -> None:
    """A table, four chairs pushed under it, a bowl on top."""
    w, h = canvas.width, canvas.tall
    top = 0.74 / 1.05 * h
    for x in (0.12, 0.4, 0.6, 0.88):  # chairs behind and before
        left = x * w - 0.2
        for side in (left, left + 0.37):
            canvas.slab(side, 0, side + 0.032, h * 0.84, "#4a3728", -0.05, edge=0.006, fall=0.01, gloss=0.2)
        for y in (0.5, 0.6, 0.7, 0.79):
            canvas.slab(
                left, y * h, left + 0.4, y * h + 0.03, "#4f3b2b", -0.04, edge=0.006, fall=0.01, gloss=0.2
            )
        canvas.slab(
            left - 0.01,
            0.43 * h,
            left + 0.41,
            0.43 * h + 0.04,
            "#59432f",
            -0.02,
            edge=0.008,
            fall=0.01,
            gloss=0.2,
        )
    for x in (0.1, w - 0.17):
        canvas.slab(
            x, 0, x + 0.07, top, np.clip(paint(wood) * 0.85, 0, 1), 0.04, edge=0.01, fall=0.012, gloss=0.25
        )
    canvas.slab(
        0.06,
        top - 0.1,
        w - 0.06,
        top,
        np.clip(paint(wood) * 0.9, 0, 1),
        0.06,
        edge=0.008,
        fall=0.01,
        gloss=0.25,
    )
    canvas.slab(0.0, top - 0.02, w, top + 0.025, wood, 0.1, edge=0.01, fall=0.012, gloss=0.4)
    bowl = np.maximum(canvas.disc_distance(w / 2, top + 0.18, 0.17), canvas.y - top - 0.12 + 0 * canvas.x)
    canvas.lay(canvas.cover(bowl), "#5f7f86", height=0.02, gloss=0.6)
    for x, r, tone in ((-0.07, 0.05, "#b7642f"), (0.03, 0.055, "#c98a2e"), (0.1, 0.045, "#a8442f")):
        fruit = np.maximum(
            canvas.disc_distance(w / 2 + x, top + 0.14, r), top + 0.118 - canvas.y + 0 * canvas.x
        )
        canvas.lay(canvas.cover(fruit), tone, gloss=0.3)


def bookcase(canvas: Canvas, seed: int, *, wood: str = "#8a6a48") -> None:
    """A case of shelves with books, boxes and a vase."""
    w, h = canvas.width, canvas.tall
    canvas.slab(0, 0, w, h, wood, 0.02, edge=0.008, fall=0.01, gloss=0.2)
    rows = 5
    pitch = (h - 0.12) / rows
    tones = np.stack(
        [
            paint(c)
            for c in ("#7d3a32", "#3f5a5e", "#b89a62", "#4b4a57", "#c8bda4", "#5c6b4e", "#2f3b46", "#a85f45")
        ]
    )
    for row in range(rows):
        bottom = 0.09 + row * pitch
        canvas.lay(canvas.box(0.03, bottom, w - 0.03, bottom + pitch - 0.03), "#4a3827", height=-0.2)
        x = 0.05
        values = randoms(seed + row, 80)
        limit = w - 0.05 - 0.3 * float(values[0])
        k = 1
        while x < limit - 0.05:
            thick, tall = (
                0.022 + 0.03 * float(values[k]),
                (0.58 + 0.36 * float(values[k + 1])) * (pitch - 0.03),
            )
            tone = tones[int(values[k + 2] * 7.99)]
            canvas.slab(x, bottom, min(x + thick, limit), bottom + tall, tone, -0.04, edge=0.008, fall=0.02)
            x += thick + 0.002
            k = (k + 3) % 76
    canvas.slab(-0.0, h - 0.035, w, h, wood, 0.04, edge=0.008, fall=0.01, gloss=0.2)


def cupboard(canvas: Canvas, seed: int, *, paint_: str = "#8c958d") -> None:
    """A painted wardrobe with two doors and a drawer."""
    w, h = canvas.width, canvas.tall
    _shadow(canvas, 0.03, w - 0.03, 0.1)
    canvas.slab(0.02, 0.07, w - 0.02, h - 0.06, paint_, 0.02, edge=0.008, fall=0.01, gloss=0.25)
    for k in range(2):
        left, right = 0.05 + k * (w / 2 - 0.05), w / 2 - 0.005 + k * (w / 2 - 0.05) + 0.01
        canvas.slab(left, 0.36, right - 0.01, h - 0.1, paint_, 0.035, edge=0.004, fall=0.006, gloss=0.25)
        field_panel(canvas, (left + 0.07, 0.45, right - 0.08, h - 0.2), paint_, 0.035)
        knob = canvas.disc_distance(w / 2 + (0.04 if k else -0.04), 1.05, 0.017)
        canvas.lay(canvas.cover(knob), "#b99d62", height=0.07, gloss=0.8)
    canvas.slab(0.05, 0.11, w - 0.05, 0.33, paint_, 0.035, edge=0.004, fall=0.006, gloss=0.25)
    for x in (0.3 * w, 0.7 * w):
        canvas.lay(canvas.cover(canvas.disc_distance(x, 0.22, 0.017)), "#b99d62", height=0.07, gloss=0.8)
    canvas.slab(0.0, h - 0.07, w, h, paint_, 0.06, edge=0.015, fall=0.025, gloss=0.25)


def desk(canvas: Canvas, seed: int) -> None:
    """A desk with a screen and a lamp, a chair before it."""
    w = canvas.width
    top = 0.73
    for x in (0.03, w - 0.07):
        canvas.slab(x, 0, x + 0.04, top, "#44484a", 0.0, edge=0.006, fall=0.01, gloss=0.4)
    canvas.slab(w - 0.5, 0.12, w - 0.08, top, "#cfccc4", 0.02, edge=0.006, fall=0.008, gloss=0.2)
    for y in (0.3, 0.48):
        canvas.lay(canvas.box(w - 0.5, y + 0.02, w - 0.08, y + 0.028), "#8d8a83", height=0.0)
    canvas.slab(0.0, top, w, top + 0.035, "#a98a64", 0.06, edge=0.008, fall=0.01, gloss=0.3)
    canvas.slab(0.46, top + 0.035, 0.52, top + 0.14, "#3a3d3f", 0.0)
    canvas.slab(0.2, top + 0.11, 0.8, top + 0.46, "#2b2e30", 0.02, edge=0.006, fall=0.006, gloss=0.5)
    screen = canvas.box(0.215, top + 0.125, 0.785, top + 0.445)
    glow = np.clip(
        paint("#8fb2c4") * (0.85 + 0.3 * (canvas.y - top))[..., None] * np.ones_like(canvas.colour), 0, 1
    )
    canvas.lay(screen, glow, gloss=0.7)
    arm = canvas.line_distance([(w - 0.25, top + 0.03), (w - 0.34, top + 0.3), (w - 0.2, top + 0.46)], 0.014)
    canvas.lay(canvas.cover(arm), "#6f6a5f", height=0.02, gloss=0.6)
    shade = canvas.polygon_distance(
        [(w - 0.26, top + 0.45), (w - 0.14, top + 0.5), (w - 0.1, top + 0.4), (w - 0.24, top + 0.36)]
    )
    canvas.lay(canvas.cover(shade), "#c9a24e", height=0.04, gloss=0.4)
    _cushion(canvas, (0.3, 0.5, 0.74, 0.98), "#4d5659", seed, 0.12, 0.08)
    _cushion(canvas, (0.27, 0.38, 0.77, 0.48), "#4d5659", seed + 1, 0.14, 0.04)
    canvas.slab(0.5, 0.08, 0.54, 0.38, "#2f3234", 0.1, edge=0.006, fall=0.01, gloss=0.5)
    canvas.slab(0.3, 0.0, 0.74, 0.07, "#2f3234", 0.1, edge=0.02, fall=0.02, gloss=0.5)


def bed(canvas: Canvas, seed: int, *, wood: str = "#8a6e52", cover: str = "#8fa0a6") -> None:
    """A bed seen from its foot, with two pillows."""
    w, h = canvas.width, canvas.tall
    _shadow(canvas, 0.03, w - 0.03)
    canvas.slab(0.0, 0.1, w, h - 0.03, wood, -0.04, edge=0.012, fall=0.014, gloss=0.25)
    for box in ((0.12, 0.5, w / 2 - 0.03, 0.82), (w / 2 + 0.03, 0.5, w - 0.12, 0.82)):
        _cushion(canvas, box, "#ece8df", seed, 0.02, 0.1)
    _cushion(canvas, (0.03, 0.2, w - 0.03, 0.66), cover, seed + 3, 0.06, 0.1)
    _cushion(canvas, (0.03, 0.5, w - 0.03, 0.68), "#e6e1d5", seed + 4, 0.08, 0.08)
    canvas.slab(0.0, 0.06, w, 0.34, wood, 0.14, edge=0.012, fall=0.014, gloss=0.25)
    for x in (0.0, w - 0.07):
        canvas.slab(x, 0, x + 0.07, 0.42, wood, 0.16, edge=0.012, fall=0.014, gloss=0.25)


def plant(canvas: Canvas, seed: int) -> None:
    """A rubber plant in a pot."""
    w, h = canvas.width, canvas.tall
    middle = w / 2
    canvas.lay(
        canvas.cover(
            canvas.line_distance([(middle, 0.3), (middle - 0.02, 0.6 * h), (middle + 0.03, 0.85 * h)], 0.022)
        ),
        "#5a4a36",
    )
    values = randoms(seed, 200)
    greens = ("#3f5a3c", "#4b6a45", "#36503a", "#587a4e", "#62824f")
    count = 46
    for k in range(count):
        at = 0.32 + 0.62 * (k / count) ** 0.9
        turn = (k * 2.39996) % (2 * np.pi)
        out = np.cos(turn)
        length = (0.14 + 0.1 * float(values[k])) * w
        x0, y0 = middle + 0.02 * out, at * h
        tip_x = x0 + out * (length + 0.12 * w)
        tip_y = y0 + (0.1 + 0.1 * float(values[k + 60])) * h * (0.4 if abs(out) > 0.6 else 0.75)
        axis = np.array([tip_x - x0, tip_y - y0])
        size = float(np.hypot(*axis))
        ux, uy = axis / size
        along = (canvas.x - x0) * ux + (canvas.y - y0) * uy
        across = np.abs(-(canvas.x - x0) * uy + (canvas.y - y0) * ux)
        t = np.clip(along / size, 0, 1)
        half = 0.26 * size * np.sin(np.pi * t**0.8) * (1 - 0.35 * t)
        body = np.where((along > 0) & (along < size), across - half, 1.0).astype(np.float32)
        tone = paint(greens[int(values[k + 120] * 4.99)]) * (0.78 + 0.34 * k / count)
        rib = 1 + 0.25 * np.exp(-((across / 0.006) ** 2))
        cover = np.clip(0.5 - body / max(canvas.dx, canvas.dy), 0, 1)
        canvas.lay(
            cover.astype(np.float32),
            np.clip(tone * (rib * (0.85 + 0.3 * t))[..., None], 0, 1),
            height=float(0.02 * np.sin(turn)),
            gloss=0.3,
        )
    pot = canvas.polygon_distance(
        [(middle - 0.15, 0.0), (middle + 0.15, 0.0), (middle + 0.2, 0.32), (middle - 0.2, 0.32)]
    )
    round_ = np.sqrt(np.clip(1 - ((canvas.x - middle) / 0.21) ** 2, 0, 1)) + 0 * canvas.y
    canvas.lay(
        canvas.cover(pot), np.clip(paint("#cfc5b4") * (0.6 + 0.4 * round_)[..., None], 0, 1), gloss=0.3
    )


def _glow(canvas: Canvas, x: float, y: float, reach: float, strength: float) -> Floats:
    r = np.hypot(canvas.x - x, canvas.y - y) / reach
    return (strength * np.exp(-3.0 * r * r) * np.clip(1 - r, 0, 1)).astype(np.float32)


def pendant(canvas: Canvas, seed: int, *, shade: str = "#e9dcc0") -> None:
    """A lamp with a cloth shade hanging from the upper edge."""
    w, h = canvas.width, canvas.tall
    canvas.lay(canvas.box(w / 2 - 0.006, 0.4 * h, w / 2 + 0.006, h), "#3a3632")
    body = canvas.polygon_distance(
        [(0.1 * w, 0.1 * h), (0.9 * w, 0.1 * h), (0.68 * w, 0.42 * h), (0.32 * w, 0.42 * h)]
    )
    warm = 0.84 + 0.16 * np.exp(
        -(((canvas.y - 0.2 * h) / (0.2 * h)) ** 2) - ((canvas.x - w / 2) / (0.32 * w)) ** 2
    )
    canvas.lay(canvas.cover(body), np.clip(paint(shade) * warm[..., None], 0, 1), gloss=0.1)
    canvas.lay(canvas.box(0.1 * w, 0.085 * h, 0.9 * w, 0.105 * h), "#fff6dd")


def floor_lamp(canvas: Canvas, seed: int, *, shade: str = "#e6d6b4") -> None:
    """A standard lamp."""
    w, h = canvas.width, canvas.tall
    canvas.slab(
        w / 2 - 0.012, 0.02, w / 2 + 0.012, 0.78 * h, "#6b5a3c", 0.0, edge=0.006, fall=0.01, gloss=0.6
    )
    canvas.slab(w / 2 - 0.13, 0.0, w / 2 + 0.13, 0.03, "#6b5a3c", 0.0, edge=0.01, fall=0.01, gloss=0.6)
    body = canvas.polygon_distance(
        [(0.08 * w, 0.76 * h), (0.92 * w, 0.76 * h), (0.74 * w, 0.98 * h), (0.26 * w, 0.98 * h)]
    )
    warm = 0.82 + 0.18 * np.exp(
        -(((canvas.y - 0.85 * h) / (0.1 * h)) ** 2) - ((canvas.x - w / 2) / (0.36 * w)) ** 2
    )
    canvas.lay(canvas.cover(body), np.clip(paint(shade) * warm[..., None], 0, 1), gloss=0.1)


def ceiling_lamp(canvas: Canvas, seed: int) -> None:
    """A round lamp on the ceiling, seen from below, with its light around it."""
    w, h = canvas.width, canvas.tall
    canvas.lay(_glow(canvas, w / 2, h / 2, 0.5 * w, 0.55), "#fff1cf")
    disc = canvas.disc_distance(w / 2, h / 2, 0.17 * w)
    canvas.lay(canvas.cover(disc), "#fffaf0", gloss=0.3)
    canvas.lay(canvas.cover(np.abs(disc) - 0.007), "#b9a98a")
