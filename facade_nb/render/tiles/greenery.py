"""What stands in streets and gardens: trees with gaps between their leaves, street lamps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .canvas import Canvas, Floats, Values, paint, randoms, smooth

__all__ = ["crown", "post_lamp", "spruce"]

Bunches = tuple[Floats, Floats, Floats, Floats]
"""Middles, radii and heights of bunches of leaves, metres."""


def crown(
    canvas: Canvas,
    seed: int,
    tones: Sequence[str],
    *,
    bunch: float = 0.5,
    airy: float = 0.0,
    trunk: float = 0.0,
) -> None:
    """The crown of a tree, round: bunches of leaves on a ball, gaps at its rim.

    Parameters
    ----------
    tones
        From the shade to the light.
    bunch
        Radius of a bunch, metres.
    airy
        How far gaps reach in from the rim, 0 to 1.
    trunk
        How high its trunk is, which then is seen too, metres.
    """
    w, h = canvas.width, canvas.tall - trunk
    count = int(3.4 * w * h / (bunch * bunch))
    x, y, far, size = randoms(seed, 4, count)
    out = np.sqrt(far) * (0.93 - 0.1 * airy)
    angle = 2 * x - 1, 2 * y - 1
    span = np.maximum(np.hypot(*angle), 1e-3)
    # Bunches stand where a ray from the middle leaves the crown, whose outline swells and shrinks a little.
    swell = 1 - 0.13 * (1 + np.sin(5.0 * np.arctan2(angle[1], angle[0]) + seed)) / 2
    reach = out * swell
    px = w / 2 + reach * angle[0] / span * (w / 2 - bunch)
    py = trunk + h / 2 + reach * angle[1] / span * (h / 2 - bunch)
    ball = np.sqrt(np.maximum(1 - out * out, 0))
    radius = bunch * (0.6 + 0.6 * size)
    if trunk:
        canvas.slab(w / 2 - 0.1, 0, w / 2 + 0.1, trunk + h / 2, "#5a5047", 0.02, edge=0.08, fall=0.08)
    _bunches(canvas, seed, tones, (px, py, radius, 0.42 * min(w, h) * ball), airy)


def spruce(canvas: Canvas, seed: int, tones: Sequence[str]) -> None:
    """A spruce as a whole: whorls of hanging twigs, wider towards its foot."""
    w, h = canvas.width, canvas.tall
    count = 620
    x, y, size = randoms(seed, 3, count)
    up = 1 - np.sqrt(y * 0.985)  # more of them below
    whorl = 0.86 + 0.14 * np.cos(2 * np.pi * up * 11)
    half = (1 - up) ** 0.9 * (w / 2 - 0.22) * whorl
    side = 2 * x - 1
    px = w / 2 + side * half
    py = 0.35 + up * (h - 0.6) - 0.18 * np.abs(side)
    radius = (0.13 + 0.16 * size) * (0.65 + 0.5 * (1 - up))
    height = half * np.sqrt(np.maximum(1 - side * side, 0))
    canvas.slab(w / 2 - 0.11, 0, w / 2 + 0.11, 0.7, "#4a3b2e", 0.02)
    _bunches(canvas, seed, tones, (px, py, radius.astype(np.float32), height), 0.25)


def _bunches(canvas: Canvas, seed: int, tones: Sequence[str], bunches: Bunches, airy: float) -> None:
    """Bunches over each other, what stands out most on top."""
    table = np.stack([paint(tone) for tone in tones])
    leaf = canvas.noise(0.075, seed + 1, 2)
    edge = canvas.noise(0.15, seed + 2, 2)
    tall = np.full((canvas.size, canvas.size), -1e9, np.float32)
    tone = np.zeros_like(tall)
    picks = randoms(seed + 3, len(bunches[0]))
    for px, py, radius, height, pick in zip(*(v.tolist() for v in (*bunches, picks)), strict=True):
        rows = slice(
            max(int((canvas.tall - py - 1.5 * radius) / canvas.dy), 0),
            max(int((canvas.tall - py + 1.5 * radius) / canvas.dy) + 1, 0),
        )
        columns = slice(
            max(int((px - 1.5 * radius) / canvas.dx), 0), max(int((px + 1.5 * radius) / canvas.dx) + 1, 0)
        )
        x, y = canvas.x[:, columns], canvas.y[rows]
        away = np.hypot(x - px, y - py) / radius + 0.2 * edge[rows, columns] + 0.17 * leaf[rows, columns]
        stands = height + radius * np.sqrt(np.maximum(1 - away * away, 0)) + 0.05 * leaf[rows, columns]
        on = (away < 1) & (stands > tall[rows, columns])
        tall[rows, columns][on] = stands[on]
        tone[rows, columns][on] = (0.25 + 0.5 * pick + 0.45 * (1 - away * away))[on]
    seen = tall > -1e8
    gaps = canvas.noise(0.3, seed + 4, 2) + 0.6 * leaf
    low = float(bunches[1].min() - bunches[2].max())
    rim = np.hypot(canvas.x / canvas.width * 2 - 1, (canvas.y - low) / (canvas.tall - low) * 2 - 1)
    seen &= gaps > -2.6 + 1.7 * airy + 1.5 * smooth(0.45, 1.0, rim) - 0.6
    _leafy(canvas, seen.astype(np.float32), tone + 0.17 * leaf - 0.08 * edge, tall, table)


def _leafy(canvas: Canvas, cover: Floats, tone: Values, tall: Values, table: Floats) -> None:
    """Lay leaves; where there are none their colour goes on, so that smaller sizes do not darken at the gaps."""
    at = np.clip(tone, 0, 1) * (len(table) - 1)
    low = np.minimum(at.astype(int), len(table) - 2)
    colour = table[low] + (table[low + 1] - table[low]) * (at - low)[..., None]
    canvas.colour[canvas.alpha == 0] = np.mean(table, axis=0)
    canvas.lay(cover, colour, height=np.maximum(tall, 0).astype(np.float32), gloss=0.05)


def post_lamp(canvas: Canvas, seed: int) -> None:
    """A street lamp: a post with a foot and a ring, a lantern with panes that the grammar lights."""
    w, h = canvas.width, canvas.tall
    middle, iron = w / 2, "#2b2f30"

    def rod(bottom: float, top: float, half: float) -> None:
        across = np.clip(1 - ((canvas.x - middle) / half) ** 2, 0, 1)
        face: Values = (0.5 * half * np.sqrt(across) + 0 * canvas.y).astype(np.float32)
        canvas.lay(canvas.box(middle - half, bottom, middle + half, top), iron, height=face, gloss=0.3)

    rod(0, 0.75, 0.085)
    rod(0.75, 0.82, 0.11)
    rod(0.82, h - 0.72, 0.05)
    rod(h - 1.02, h - 0.96, 0.09)

    def shape(a: float, b: float, low: float, high: float) -> list[tuple[float, float]]:
        return [(middle - a, low), (middle + a, low), (middle + b, high), (middle - b, high)]

    canvas.lay(canvas.cover(canvas.polygon_distance(shape(0.15, 0.25, h - 0.72, h - 0.2))), iron, gloss=0.3)
    for left in (True, False):
        pane = [
            (middle + (0.012 if not left else -0.012), h - 0.68),
            (middle + (0.125 if not left else -0.125), h - 0.68),
            (middle + (0.215 if not left else -0.215), h - 0.235),
            (middle + (0.012 if not left else -0.012), h - 0.235),
        ]
        canvas.lay(canvas.cover(canvas.polygon_distance(pane)), "#d9d3bd", gloss=0.6)
    canvas.lay(canvas.cover(canvas.polygon_distance(shape(0.28, 0.09, h - 0.2, h - 0.05))), iron, gloss=0.3)
    rod(h - 0.06, h, 0.03)
