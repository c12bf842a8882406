"""Cornices, string courses, plinths, balustrades, railings, and what is set around windows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .canvas import Canvas, Floats, paint

__all__ = [
    "balusters",
    "column",
    "cornice",
    "pediment",
    "pilaster",
    "plinth",
    "quoins",
    "railing",
    "string_course",
    "window_surround",
]

Profile = Sequence[tuple[float, float]]
"""Points (share of the height from the bottom, metres before the wall) of a moulding, from the bottom up."""


def _moulding(canvas: Canvas, profile: Profile, stone: str, seed: int) -> Floats:
    """Run a moulding across the canvas; returns its height."""
    at = canvas.y[:, 0] / canvas.tall
    heights = np.interp(at, [p[0] for p in profile], [p[1] for p in profile])
    face = np.broadcast_to(heights[:, None], (canvas.size, canvas.size)).astype(np.float32)
    grain = canvas.noise(0.015, seed, 2)
    cloud = canvas.noise((0.4, 0.3), seed + 1, 2)
    colour = np.clip(paint(stone) * (1 + 0.012 * grain + 0.014 * cloud)[..., None], 0, 1)
    canvas.lay(canvas.full(), colour, height=face, gloss=0.08)
    return face


def _round(
    low: float, high: float, start: float, end: float, hollow: bool = False
) -> list[tuple[float, float]]:
    """A quarter round from (low, start) to (high, end): an ovolo, or a cavetto if `hollow`."""
    points = []
    for k in range(7):
        t = np.pi / 2 * k / 6
        rise, out = (1 - np.cos(t), np.sin(t)) if not hollow else (np.sin(t), 1 - np.cos(t))
        points.append((low + (high - low) * rise, start + (end - start) * out))
    return points


def cornice(
    canvas: Canvas, seed: int, *, stone: str = "#d8d0be", dentils: int = 0, brackets: int = 0
) -> None:
    """A main cornice: architrave, frieze, bed moulding, corona and cyma; with dentils or brackets if asked for."""
    profile = [
        (0.0, 0.02), (0.1, 0.02), (0.105, 0.035), (0.16, 0.035), *_round(0.16, 0.2, 0.035, 0.06),
        (0.21, 0.06), (0.212, 0.02),
        (0.47, 0.02), *_round(0.47, 0.52, 0.03, 0.07), (0.53, 0.07), (0.535, 0.09), (0.66, 0.09),
        *_round(0.66, 0.7, 0.1, 0.14),
        (0.705, 0.26), (0.83, 0.265), (0.835, 0.285), *_round(0.84, 0.95, 0.285, 0.36, hollow=True), (0.955, 0.37),
        (1.0, 0.37),
    ]  # fmt: skip
    _moulding(canvas, profile, stone, seed)
    for count, low, high, out, share in (
        (dentils, 0.545, 0.65, 0.14, 0.58),
        (brackets, 0.46, 0.7, 0.22, 0.42),
    ):
        if not count:
            continue
        pitch = canvas.width / count
        for k in range(count):
            left = (k + (1 - share) / 2) * pitch
            canvas.slab(
                left,
                low * canvas.tall,
                left + share * pitch,
                high * canvas.tall,
                stone,
                out,
                edge=0.008,
                fall=0.012,
                gloss=0.08,
            )
            if share < 0.5:  # a bracket ends in a drop
                canvas.slab(
                    left + 0.01,
                    (low - 0.06) * canvas.tall,
                    left + share * pitch - 0.01,
                    low * canvas.tall,
                    stone,
                    out - 0.09,
                    edge=0.012,
                    fall=0.02,
                )


def string_course(canvas: Canvas, seed: int, *, stone: str = "#d8d0be") -> None:
    """A string course between floors."""
    profile = [
        (0.0, 0.02), (0.28, 0.02), *_round(0.28, 0.42, 0.025, 0.06), (0.44, 0.06), (0.45, 0.085), (0.7, 0.085),
        *_round(0.7, 0.86, 0.09, 0.12, hollow=True), (0.87, 0.125), (1.0, 0.115),
    ]  # fmt: skip
    _moulding(canvas, profile, stone, seed)


def plinth(canvas: Canvas, seed: int, *, stone: str = "#a9a294") -> None:
    """The foot of a wall: large blocks with a weathered top."""
    canvas.lay(canvas.full(), stone)
    profile = [(0.0, 0.05), (0.84, 0.05), (0.86, 0.065), (0.93, 0.065), (1.0, 0.01)]
    face = _moulding(canvas, profile, stone, seed)
    half = canvas.width / 2
    off = np.abs((canvas.x + half / 2) % half - half / 2) + 0 * canvas.y
    joint = canvas.cover((off - 0.004).astype(np.float32)) * canvas.box(
        -1, 0, canvas.width + 1, 0.84 * canvas.tall
    )
    canvas.lay(joint, paint(stone) * 0.7, height=face - 0.01)
    canvas.shade(
        1
        - 0.1
        * np.clip(1 - canvas.y / (0.35 * canvas.tall), 0, 1)
        * (1 + 0.25 * canvas.noise(0.1, seed + 3, 3))
    )


_BALUSTER = ((0.0, 0.5), (0.07, 0.5), (0.075, 0.34), (0.12, 0.42), (0.15, 0.3), (0.2, 0.44), (0.32, 0.6), (0.42, 0.56),
             (0.58, 0.3), (0.74, 0.2), (0.8, 0.2), (0.83, 0.32), (0.86, 0.22), (0.9, 0.36), (0.925, 0.36),
             (0.93, 0.5), (1.0, 0.5))  # fmt: skip
"""Outline of a baluster: share of its height, and half its width in half pitches."""


def balusters(canvas: Canvas, seed: int, *, count: int = 5, stone: str = "#d8d0be") -> None:
    """A stone balustrade: plinth, turned balusters and coping; open between them."""
    h = canvas.tall
    low, high = 0.15 * h, 0.84 * h
    pitch = canvas.width / count
    along = np.clip((canvas.y[:, 0] - low) / (high - low), 0, 1)
    half = np.interp(along, [p[0] for p in _BALUSTER], [p[1] for p in _BALUSTER]) * pitch * 0.62
    off = np.abs((canvas.x % pitch) - pitch / 2)
    radius = half[:, None].astype(np.float32)
    distance = (off - radius).astype(np.float32)
    body = np.clip(0.5 - distance / canvas.dx, 0, 1).astype(np.float32) * canvas.box(
        -1, low, canvas.width + 1, high
    )
    round_ = np.sqrt(np.clip(1 - (off / np.maximum(radius, 1e-4)) ** 2, 0, 1))
    grain = 1 + 0.014 * canvas.noise(0.015, seed, 2)
    colour = np.clip(paint(stone) * (grain * (0.8 + 0.2 * round_))[..., None], 0, 1)
    canvas.height[:] = -0.1
    canvas.lay(body, colour, height=(0.09 * round_ - 0.04).astype(np.float32), gloss=0.08)
    canvas.slab(0 - 1, 0, canvas.width + 1, low, stone, 0.06, edge=0.015, fall=0.02, gloss=0.08)
    canvas.slab(0 - 1, high, canvas.width + 1, h, stone, 0.08, edge=0.02, fall=0.025, gloss=0.08)
    canvas.slab(0 - 1, high + 0.045, canvas.width + 1, h, stone, 0.1, edge=0.012, fall=0.015, gloss=0.08)
    canvas.shade(1 + 0.012 * canvas.noise(0.015, seed, 2))


_COLUMN = ((0.0, 0.5), (0.035, 0.5), (0.037, 0.44), (0.05, 0.47), (0.065, 0.44), (0.07, 0.4),
           (0.35, 0.405), (0.9, 0.335),
           (0.905, 0.36), (0.915, 0.335), (0.93, 0.34), (0.96, 0.44), (0.962, 0.5), (1.0, 0.5))  # fmt: skip
"""Outline of a column: share of its height, and half its width in widths."""


def column(canvas: Canvas, seed: int, *, stone: str = "#d6cebd") -> None:
    """A round column with base, swelling shaft and capital; transparent beside it."""
    half = np.interp(canvas.y[:, 0] / canvas.tall, [p[0] for p in _COLUMN], [p[1] for p in _COLUMN])
    radius = (half * canvas.width)[:, None].astype(np.float32)
    off = canvas.x - canvas.width / 2
    square = (canvas.y < 0.036 * canvas.tall) | (canvas.y > 0.961 * canvas.tall)
    round_ = np.where(square, 0.8, np.sqrt(np.clip(1 - (off / np.maximum(radius, 1e-4)) ** 2, 0, 1)))
    side = np.where(square, 0.0, off / np.maximum(radius, 1e-4))
    grain = 1 + 0.012 * canvas.noise(0.012, seed, 2)
    shade = (0.62 + 0.38 * round_ - 0.10 * side) * grain
    body = np.clip(0.5 - (np.abs(off) - radius) / canvas.dx, 0, 1).astype(np.float32)
    canvas.height[:] = -0.05
    colour = np.clip(paint(stone) * shade[..., None], 0, 1)
    canvas.lay(body, colour, height=(0.35 * canvas.width * round_ - 0.02).astype(np.float32), gloss=0.08)
    for y in (0.036, 0.961):
        line = canvas.box(0, y * canvas.tall - 0.006, canvas.width, y * canvas.tall + 0.006)
        canvas.lay(line * body, np.clip(colour * 0.75, 0, 1))


def pilaster(canvas: Canvas, seed: int, *, stone: str = "#d6cebd") -> None:
    """A flat pillar with a sunk field, base and capital."""
    w, h = canvas.width, canvas.tall
    canvas.lay(canvas.full(), stone, gloss=0.08)
    canvas.slab(0.06 * w, 0.06 * h, 0.94 * w, 0.92 * h, stone, 0.05, edge=0.008, fall=0.01)
    canvas.slab(0.2 * w, 0.1 * h, 0.8 * w, 0.88 * h, stone, 0.035, edge=0.012, fall=-0.01)
    for low, high, inset, out in ((0, 0.035, 0, 0.09), (0.035, 0.06, 0.03, 0.07), (0.9, 0.92, 0.03, 0.07),
                                  (0.92, 0.96, 0.02, 0.08), (0.96, 1, 0, 0.1)):  # fmt: skip
        canvas.slab(inset * w, low * h, (1 - inset) * w, high * h, stone, out, edge=0.008, fall=0.012)
    canvas.shade(1 + 0.012 * canvas.noise(0.012, seed, 2))


def railing(canvas: Canvas, seed: int, *, count: int = 8, iron: str = "#33363a", ornate: bool = True) -> None:
    """A wrought-iron railing, open between its bars."""
    w, h = canvas.width, canvas.tall
    pitch = w / count
    lows, highs = 0.1 * h, 0.93 * h
    canvas.height[:] = -0.03
    bar = 0.016
    for k in range(count):
        x = (k + 0.5) * pitch
        canvas.slab(x - bar / 2, lows, x + bar / 2, highs, iron, 0.008, edge=0.004, fall=0.006, gloss=0.45)
    if ornate:
        for k in range(count):  # rings between the bars above, and lyres below
            x = (k + 1) * pitch % w
            for shift in (-w, 0, w) if x < pitch else (0,):
                ring = np.abs(canvas.disc_distance(x + shift, 0.8 * h, pitch / 2 - bar)) - 0.006
                canvas.lay(canvas.cover(ring), iron, height=0.004, gloss=0.45)
                lower = np.abs(canvas.disc_distance(x + shift, 0.25 * h, pitch / 2 - bar)) - 0.006
                canvas.lay(canvas.cover(lower), iron, height=0.004, gloss=0.45)
        for y in (0.8 * h - pitch / 2, 0.25 * h + pitch / 2):
            canvas.slab(-1, y - 0.007, w + 1, y + 0.007, iron, 0.006, edge=0.003, fall=0.004, gloss=0.45)
    canvas.slab(-1, lows - 0.012, w + 1, lows + 0.012, iron, 0.012, edge=0.004, fall=0.006, gloss=0.45)
    canvas.slab(-1, highs - 0.015, w + 1, highs + 0.022, iron, 0.03, edge=0.012, fall=0.014, gloss=0.5)


def window_surround(canvas: Canvas, seed: int, *, stone: str = "#ded6c5") -> None:
    """A plain moulded surround with a sill, open in the middle: to be laid over a wall around any window."""
    w, h = canvas.width, canvas.tall
    band, foot = 0.12 * w, 0.09 * h
    for k, height in ((0.0, 0.04), (0.45, 0.025), (0.8, 0.012)):
        canvas.slab(
            0.02 + k * band,
            foot,
            w - 0.02 - k * band,
            h - 0.02 - k * band,
            stone,
            height,
            edge=0.008,
            fall=0.01,
            gloss=0.08,
        )
    canvas.slab(
        w / 2 - 0.07, h - 0.02 - 1.02 * band, w / 2 + 0.07, h, stone, 0.06, edge=0.01, fall=0.014, gloss=0.08
    )
    canvas.slab(0, foot - 0.07, w, foot, stone, 0.08, edge=0.01, fall=0.016, gloss=0.08)
    for x in (0.09 * w, w - 0.09 * w - 0.08):
        canvas.slab(x, 0, x + 0.08, foot - 0.07, stone, 0.05, edge=0.01, fall=0.02, gloss=0.08)
    canvas.shade(1 + 0.012 * canvas.noise(0.015, seed, 2))
    canvas.cut(canvas.box(band, foot, w - band, h - band), height=-0.05)


def pediment(canvas: Canvas, seed: int, *, stone: str = "#ded6c5") -> None:
    """A triangular pediment on brackets, to be laid above a window; transparent around it."""
    w, h = canvas.width, canvas.tall
    base = 0.3 * h
    field = canvas.polygon_distance([(0.06 * w, base), (0.94 * w, base), (w / 2, 0.93 * h)])
    canvas.lay(canvas.cover(field), stone, height=0.02, gloss=0.08)
    rise = np.arctan2(0.93 * h - base, 0.44 * w)
    for side in (-1, 1):
        along = np.abs(canvas.x - w / 2)
        down = (canvas.y - 0.97 * h) * np.cos(rise) + along * np.sin(rise)
        strip = np.maximum(
            np.abs(down) - 0.035, np.maximum(base - canvas.y - 0 * canvas.x, -side * (canvas.x - w / 2))
        )
        strip = np.maximum(strip, along - w / 2)
        face = 0.075 + 0.02 * np.clip(down / 0.01, -1, 1)
        canvas.lay(canvas.cover(strip.astype(np.float32)), stone, height=face.astype(np.float32), gloss=0.08)
    canvas.slab(0.0, base - 0.035, w, base + 0.035, stone, 0.1, edge=0.012, fall=0.02, gloss=0.08)
    canvas.slab(0.04 * w, base - 0.075, 0.96 * w, base - 0.03, stone, 0.06, edge=0.012, fall=0.02, gloss=0.08)
    for x in (0.08 * w, 0.92 * w - 0.1):
        for k, height in enumerate((0.075, 0.06, 0.045)):
            top = base - 0.07 - k * 0.09 * h
            canvas.slab(
                x + 0.006 * k,
                max(0.0, top - 0.1 * h),
                x + 0.1 - 0.006 * k,
                top,
                stone,
                height,
                edge=0.014,
                fall=0.02,
                gloss=0.08,
            )
    canvas.shade(1 + 0.012 * canvas.noise(0.015, seed, 2))


def quoins(canvas: Canvas, seed: int, *, stone: str = "#d3c8b2") -> None:
    """Corner stones, long and short in turn, that go on upwards; transparent beside the short ones."""
    w, h = canvas.width, canvas.tall
    rows = 4
    pitch = h / rows
    for row in range(rows):
        right = w if row % 2 == 0 else 0.66 * w
        tint = np.clip(paint(stone) * (1 + 0.03 * np.sin(3.1 * row + seed)), 0, 1)
        canvas.slab(
            0.0,
            row * pitch + 0.006,
            right - 0.006,
            (row + 1) * pitch - 0.006,
            tint,
            0.035,
            edge=0.018,
            fall=0.022,
            gloss=0.08,
        )
    canvas.shade(1 + 0.014 * canvas.noise(0.015, seed, 2) + 0.012 * canvas.noise(0.2, seed + 1, 2))
