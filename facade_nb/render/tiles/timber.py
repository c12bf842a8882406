"""Timber frames: hewn beams and the braces between them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .canvas import Canvas, Floats, paint

__all__ = ["beam", "brace"]


def beam(canvas: Canvas, seed: int, wood: str, *, upright: bool = True) -> None:
    """A hewn oak beam seen from near: long fibres, cracks along them, the marks of the axe."""
    fibre = canvas.noise((0.02, 0.5) if upright else (0.5, 0.02), seed, 3)
    crack = canvas.noise((0.035, 1.0) if upright else (1.0, 0.035), seed + 1, 1)
    hewn = canvas.noise((0.2, 0.14) if upright else (0.14, 0.2), seed + 2, 1)
    dark = np.clip((np.abs(crack) < 0.07) * 1.0, 0, 1)
    shade = 1 + 0.10 * fibre + 0.05 * hewn - 0.35 * dark
    height = (0.002 * fibre + 0.003 * hewn - 0.004 * dark).astype(np.float32)
    canvas.lay(canvas.full(), np.clip(paint(wood) * shade[..., None], 0, 1), height=height, gloss=0.06)


def brace(
    canvas: Canvas, seed: int, lines: Sequence[Sequence[tuple[float, float]]], wood: str, wide: float
) -> None:
    """Beams from point to point (shares of the canvas), open beside them."""
    w, h = canvas.width, canvas.tall
    grain = canvas.noise((0.05, 0.09), seed, 3)
    for line in lines:
        distance: Floats = canvas.line_distance([(x * w, y * h) for x, y in line], wide)
        edge = np.clip(-distance / 0.015, 0, 1)
        colour = np.clip(paint(wood) * (1 + 0.07 * grain)[..., None], 0, 1)
        canvas.lay(
            canvas.cover(distance), colour, height=(0.012 + 0.008 * edge).astype(np.float32), gloss=0.06
        )
