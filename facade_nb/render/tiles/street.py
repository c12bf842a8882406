"""What a street is made of beside its houses: asphalt, paving, gravel, grass; and signs, awnings and goods of shops."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from .canvas import Canvas, Floats, paint, randoms, smooth
from .masonry import Units, courses

__all__ = ["asphalt", "awning", "goods", "grass", "gravel", "paving", "sign"]


def asphalt(canvas: Canvas, seed: int, colour: str = "#6f7072") -> None:
    """Rolled asphalt: dark binder with the tips of lighter stones."""
    grain = canvas.noise(0.016, seed, 2)
    tips = smooth(0.9, 1.9, canvas.noise(0.02, seed + 1, 1))
    shade = 1 + 0.045 * grain + 0.16 * tips
    height = (0.0012 * grain + 0.002 * tips).astype(np.float32)
    canvas.lay(canvas.full(), np.clip(paint(colour) * shade[..., None], 0, 1), height=height, gloss=0.12)


def gravel(canvas: Canvas, seed: int, stones: Sequence[str]) -> None:
    """Round gravel, raked: stones of a few centimetres in several colours."""
    table = np.stack([paint(stone) for stone in stones])
    rounds = canvas.noise(0.045, seed, 1)
    fine = canvas.noise(0.02, seed + 1, 2)
    pick = smooth(-1.6, 1.6, canvas.noise(0.05, seed + 2, 1)) * (len(stones) - 1)
    low = np.minimum(pick.astype(int), len(stones) - 2)
    colour = table[low] + (table[low + 1] - table[low]) * (pick - low)[..., None]
    shade = 1 + 0.10 * np.clip(rounds, -1.5, 1.5) + 0.06 * fine
    height = (0.008 * np.clip(rounds, -1.2, 1.2) + 0.003 * fine).astype(np.float32)
    canvas.lay(canvas.full(), np.clip(colour * shade[..., None], 0, 1), height=height, gloss=0.08)


def grass(canvas: Canvas, seed: int, blades: Sequence[str]) -> None:
    """Mown grass: tufts of a hand's breadth, and blades."""
    dark, light = (paint(blade) for blade in blades)
    tuft = canvas.noise(0.13, seed, 2)
    blade = canvas.noise((0.014, 0.03), seed + 1, 2)
    share = smooth(-1.9, 1.9, 0.55 * tuft + 0.75 * blade)[..., None]
    height = (0.010 * tuft + 0.006 * blade).astype(np.float32)
    canvas.lay(canvas.full(), dark + (light - dark) * share, height=height, gloss=0.03)


def paving(canvas: Canvas, seed: int, stone: str, rows: int = 5, columns: int = 4) -> None:
    """Concrete flags in broken bond."""
    pitch, width = canvas.tall / rows, canvas.width / columns
    shifts = [0.0, 0.5, 0.25, 0.75, 0.4]
    cuts = [(np.arange(columns) + shifts[row % 5]) * width % canvas.width for row in range(rows)]
    units: Units = courses(canvas, [pitch] * rows, cuts)
    tints = units.blended(np.repeat(0.9 + 0.2 * randoms(seed, units.count)[:, None], 3, axis=1), 4)
    grain = canvas.noise(0.014, seed + 1, 2)
    shade = units.pick(tints) * (1 + 0.02 * grain)[..., None]
    body = canvas.cover(units.distance(0.012, 0.008))
    canvas.lay(canvas.full(), paint(stone) * 0.62, height=-0.006)
    canvas.lay(
        body, np.clip(paint(stone) * shade, 0, 1), height=(0.0006 * grain).astype(np.float32), gloss=0.1
    )


def awning(canvas: Canvas, seed: int, *, stripes: int = 12) -> None:
    """A canvas awning seen from the street: stripes, sagging between its arms, with a scalloped valance."""
    w, h = canvas.width, canvas.tall
    valance = 0.24 * h
    stripe = np.floor(canvas.x / w * stripes).astype(int) % 2 + 0 * canvas.y.astype(int)
    table = np.stack([paint("#e9e4d8"), paint("#cfc9bb")])
    fold = 0.02 * np.sin(2 * np.pi * canvas.x / w * 3) + 0 * canvas.y
    colour = table[stripe] * (1 + 0.015 * canvas.noise((0.02, 0.3), seed, 2))[..., None]
    slope = np.clip((h - canvas.y) / (h - valance), 0, 1)
    canvas.lay(
        canvas.box(0, valance, w, h),
        np.clip(colour, 0, 1),
        height=(0.05 + 0.5 * slope + fold) * 0.3,
        gloss=0.1,
    )
    scallop = w / stripes
    drop = valance * (0.35 + 0.28 * np.abs(canvas.x / scallop % 1 * 2 - 1) ** 2)
    hem = canvas.cover((drop - canvas.y).astype(np.float32)) * canvas.box(0, 0, w, valance)
    canvas.lay(hem, np.clip(colour * 0.9, 0, 1), height=0.16, gloss=0.1)


def goods(canvas: Canvas, seed: int) -> None:
    """Two displays of a shop: below, books and boxes on a board; above, crates of fruit and jars."""
    w, h = canvas.width, canvas.tall
    half = h / 2
    tones = ["#8c4a3f", "#c0a15b", "#4f6b75", "#d9d2c0", "#6c7d56", "#a96e3f", "#3f4650"]
    picks, wide, high = (randoms(seed + k, 40) for k in range(3))
    x = 0.02
    for k in range(40):  # books and boxes
        width, tall = 0.05 + 0.09 * wide[k], half * (0.3 + 0.55 * high[k])
        if x + width > w - 0.02:
            break
        canvas.slab(
            x, 0.03, x + width, tall, tones[int(picks[k] * 7) % 7], 0.03, edge=0.008, fall=0.012, gloss=0.3
        )
        x += width + (0.012 if wide[k] > 0.3 else 0.09)
    canvas.slab(0, 0, w, 0.035, "#6b5338", 0.06, edge=0.006, fall=0.01, gloss=0.3)
    fruit = ["#b5533a", "#c8963c", "#7d8a45", "#b9703a"]
    count = 4
    for k in range(count):  # crates
        left, right = k * w / count + 0.02, (k + 1) * w / count - 0.02
        tone = fruit[k % 4]
        for j in range(26):
            a, b = randoms(seed + 100 + 31 * k + j, 2)
            spot = canvas.disc_distance(
                left + 0.05 + float(a) * (right - left - 0.1), half + 0.2 + float(b) * 0.14, 0.042
            )
            canvas.lay(
                canvas.cover(spot), np.clip(paint(tone) * (0.85 + 0.3 * float(b)), 0, 1),
                height=(0.05 - 0.03 * np.clip(1 + spot / 0.042, 0, 1)).astype(np.float32), gloss=0.4,
            )  # fmt: skip
        for j in range(3):
            y = half + 0.005 + j * 0.075
            canvas.slab(left, y, right, y + 0.062, "#a5835a", 0.08, edge=0.005, fall=0.008, gloss=0.1)


_LETTERS: Mapping[str, Sequence[Sequence[tuple[float, float]]]] = MappingProxyType({
    "A": [[(0, 0), (0.35, 1), (0.7, 0)], [(0.12, 0.35), (0.58, 0.35)]],
    "B": [[(0, 0), (0, 1), (0.4, 1), (0.55, 0.88), (0.55, 0.65), (0.4, 0.53), (0, 0.53)],
          [(0.4, 0.53), (0.62, 0.4), (0.62, 0.14), (0.45, 0), (0, 0)]],
    "C": [[(0.68, 0.82), (0.5, 1), (0.2, 1), (0, 0.75), (0, 0.25), (0.2, 0), (0.5, 0), (0.68, 0.18)]],
    "D": [[(0, 0), (0, 1), (0.4, 1), (0.65, 0.75), (0.65, 0.25), (0.4, 0), (0, 0)]],
    "E": [[(0.55, 0), (0, 0), (0, 1), (0.55, 1)], [(0, 0.52), (0.45, 0.52)]],
    "F": [[(0, 0), (0, 1), (0.55, 1)], [(0, 0.52), (0.45, 0.52)]],
    "G": [[(0.68, 0.82), (0.5, 1), (0.2, 1), (0, 0.75), (0, 0.25), (0.2, 0), (0.5, 0), (0.68, 0.18),
           (0.68, 0.45), (0.42, 0.45)]],
    "H": [[(0, 0), (0, 1)], [(0.6, 0), (0.6, 1)], [(0, 0.5), (0.6, 0.5)]],
    "I": [[(0, 0), (0, 1)]],
    "K": [[(0, 0), (0, 1)], [(0.6, 1), (0, 0.42)], [(0.2, 0.62), (0.62, 0)]],
    "L": [[(0, 1), (0, 0), (0.5, 0)]],
    "M": [[(0, 0), (0, 1), (0.4, 0.3), (0.8, 1), (0.8, 0)]],
    "N": [[(0, 0), (0, 1), (0.62, 0), (0.62, 1)]],
    "O": [[(0.2, 0), (0, 0.25), (0, 0.75), (0.2, 1), (0.5, 1), (0.7, 0.75), (0.7, 0.25), (0.5, 0), (0.2, 0)]],
    "R": [[(0, 0), (0, 1), (0.4, 1), (0.57, 0.86), (0.57, 0.62), (0.4, 0.48), (0, 0.48)], [(0.35, 0.48), (0.62, 0)]],
    "S": [[(0.58, 0.84), (0.42, 1), (0.16, 1), (0, 0.85), (0, 0.64), (0.6, 0.36), (0.6, 0.15), (0.44, 0), (0.14, 0),
           (0, 0.16)]],
    "T": [[(0.3, 0), (0.3, 1)], [(0, 1), (0.6, 1)]],
    "U": [[(0, 1), (0, 0.22), (0.18, 0), (0.46, 0), (0.64, 0.22), (0.64, 1)]],
    "W": [[(0, 1), (0.22, 0), (0.45, 0.75), (0.68, 0), (0.9, 1)]],
})  # fmt: skip
"""Strokes of capitals, one unit high."""


def sign(canvas: Canvas, seed: int, words: Sequence[str]) -> None:
    """Letters for the board of a shop, a word on each of some rows: a grammar paints them by their mask."""
    pitch = canvas.tall / len(words)
    for row, word in enumerate(words):
        high = 0.52 * pitch
        widths = [max((x for stroke in _LETTERS[c] for x, _ in stroke), default=0.0) * high for c in word]
        gap = 0.34 * high
        x = (canvas.width - sum(widths) - gap * (len(word) - 1)) / 2
        y = canvas.tall - (row + 1) * pitch + 0.24 * pitch
        for letter, width in zip(word, widths, strict=True):
            for stroke in _LETTERS[letter]:
                line: Floats = canvas.line_distance(
                    [(x + a * high, y + b * high) for a, b in stroke], 0.17 * high
                )
                canvas.lay(canvas.cover(line), "#e8dcb8", height=0.03, gloss=0.4)
            x += width + gap
