"""Walls without courses: plaster, concrete, boards, sheet metal, panels."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .canvas import Canvas, paint, randoms, smooth

__all__ = ["boards", "concrete", "granite", "plaster", "seams"]


def plaster(canvas: Canvas, seed: int, colour: str, *, rough: float = 1.0) -> None:
    """Lime render, floated by hand: a fine grain, and slow clouds that no one sees until they are missing."""
    grain = canvas.noise(0.011, seed, 2)
    trowel = canvas.noise((0.22, 0.15), seed + 1, 3)
    cloud = canvas.noise(0.7, seed + 2, 2)
    tint = 1 + 0.010 * cloud + rough * (0.010 * trowel + 0.008 * grain)
    base = paint(colour) * tint[..., None]
    base[..., 2] *= 1 - 0.006 * cloud  # clouds are a little warmer where they are lighter
    height = rough * (0.00022 * grain + 0.0011 * trowel)
    canvas.lay(canvas.full(), np.clip(base, 0, 1), height=height.astype(np.float32), gloss=0.04)


def concrete(canvas: Canvas, seed: int, colour: str, *, columns: int = 2, rows: int = 2) -> None:
    """Fair-faced concrete: sheets of shuttering with their joints and tie holes, a few pores."""
    w, h = canvas.width / columns, canvas.tall / rows
    u, v = canvas.x % w, canvas.y % h
    sheet = (np.floor(canvas.x / w) + columns * np.floor(canvas.y / h)).astype(int)
    tint = randoms(seed + 3, rows * columns)[np.clip(sheet, 0, rows * columns - 1)] - 0.5
    cloud = canvas.noise((0.5, 0.6), seed, 4)
    grain = canvas.noise(0.01, seed + 1, 2)
    pores = smooth(2.35, 2.8, canvas.noise(0.02, seed + 2, 1)) * 0.5
    shade = 1 + 0.035 * tint + 0.02 * cloud + 0.012 * grain - 0.16 * pores
    canvas.lay(
        canvas.full(),
        np.clip(paint(colour) * shade[..., None], 0, 1),
        height=(-0.002 * pores).astype(np.float32),
        gloss=0.1,
    )
    joint = np.minimum(np.minimum(u, w - u), np.minimum(v, h - v))
    line = canvas.cover(joint - 0.003)
    canvas.lay(line, paint(colour) * 0.72, height=-0.006, alpha=0.8)
    ties = np.hypot(np.abs(u - w / 2) - w / 4, np.abs(v - h / 2) - h / 4)
    canvas.lay(canvas.cover(ties - 0.017), paint(colour) * 0.62, height=-0.02)


def granite(canvas: Canvas, seed: int, colour: str) -> None:
    """Granite slabs, two high and two wide, with their crystals."""
    w, h = canvas.width / 2, canvas.tall / 2
    crystals = canvas.noise(0.012, seed, 1)
    dark = smooth(0.9, 1.5, canvas.noise(0.014, seed + 1, 1))
    sheet = (np.floor(canvas.x / w) + 2 * np.floor(canvas.y / h)).astype(int)
    tint = randoms(seed + 2, 4)[np.clip(sheet, 0, 3)] - 0.5
    shade = 1 + 0.05 * tint + 0.05 * crystals - 0.16 * dark + 0.012 * canvas.noise(0.5, seed + 3, 3)
    canvas.lay(canvas.full(), np.clip(paint(colour) * shade[..., None], 0, 1), gloss=0.35)
    u, v = canvas.x % w, canvas.y % h
    joint = np.minimum(np.minimum(u, w - u), np.minimum(v, h - v))
    canvas.lay(canvas.cover(joint - 0.004), np.clip(paint(colour) * 0.6, 0, 1), height=-0.006)


def boards(
    canvas: Canvas,
    seed: int,
    woods: Sequence[str],
    count: int,
    *,
    upright: bool = True,
    gap: float = 0.006,
    round_: float = 0.004,
    gloss: float = 0.1,
    ends: int = 0,
    figure: float = 1.0,
) -> None:
    """Boards side by side, with their grain along them; `ends`: how many butt joints each has, as floor boards do."""
    along_size, across_size = (canvas.tall, canvas.width) if upright else (canvas.width, canvas.tall)
    across = canvas.x + 0 * canvas.y if upright else canvas.y + 0 * canvas.x
    along = canvas.y + 0 * canvas.x if upright else canvas.x + 0 * canvas.y
    board_width = across_size / count
    board = np.minimum((across / board_width).astype(int), count - 1)
    rim = np.minimum(across - board * board_width, (board + 1) * board_width - across)
    piece = board
    if ends:
        length = along_size / ends
        place = along + randoms(seed + 8, count)[board] * along_size
        row = np.floor(place / length).astype(int) % ends
        end = place % length
        rim = np.minimum(rim, np.minimum(end, length - end))
        piece = board * ends + row
    picks = randoms(seed + 2, count * max(ends, 1))
    tints = randoms(seed + 3, count * max(ends, 1))[piece] - 0.5
    table = np.stack([paint(wood) for wood in woods])
    colour = table[np.minimum((picks * len(woods)).astype(int), len(woods) - 1)][piece]
    cell = (board_width / 7, along_size / 3) if upright else (along_size / 3, board_width / 7)
    fine = (board_width / 26, along_size / 7) if upright else (along_size / 7, board_width / 26)
    rings = np.sin(5.0 * canvas.noise(cell, seed + 4, 2) + 9 * tints)
    fibre = canvas.noise(fine, seed + 5, 2)
    shade = 1 + 0.14 * tints + figure * (0.035 * rings + 0.03 * fibre)
    body = canvas.cover(gap / 2 - rim)
    canvas.lay(canvas.full(), table[0] * 0.42, height=-0.01)
    rounded = round_ * (1 - np.clip((rim - gap / 2) / max(2 * round_, 1e-4), 0, 1)) ** 2
    canvas.lay(
        body,
        np.clip(colour * shade[..., None], 0, 1),
        height=(0.0004 * fibre - rounded).astype(np.float32),
        gloss=gloss,
    )


def seams(canvas: Canvas, seed: int, metal: str, count: int) -> None:
    """Sheet metal with standing seams."""
    width = canvas.width / count
    sheet = np.minimum((canvas.x / width).astype(int), count - 1)
    tint = randoms(seed, count)[sheet] - 0.5
    cloud = canvas.noise((0.4, 0.9), seed + 1, 3)
    off = canvas.x - (sheet + 0.5) * width
    shade = 1 + 0.04 * tint + 0.018 * cloud + 0 * canvas.y
    buckle = 0.004 * np.cos(np.pi * off / width) * (1 + 0.2 * cloud)
    canvas.lay(
        canvas.full(),
        np.clip(paint(metal) * shade[..., None], 0, 1),
        height=(buckle + 0 * canvas.y).astype(np.float32),
        gloss=0.45,
    )
    rim = width / 2 - np.abs(off)
    canvas.lay(canvas.cover(rim - 0.008 + 0 * canvas.y), paint(metal) * 1.04, height=0.028, gloss=0.5)
