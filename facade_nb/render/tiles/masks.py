"""Masks for `SkipMask`: white where a hole is to be cut, black where the wall stays."""

from __future__ import annotations

import numpy as np

from .canvas import Canvas, Floats

__all__ = ["mask"]


def mask(canvas: Canvas, shape: str) -> None:
    """Draw a mask: ``rect``, ``arch`` (round head), ``segment`` (flat arc), ``pointed`` (Gothic) or ``round``."""
    w, h = canvas.width, canvas.tall
    edge, foot = 0.14 * w, 0.1 * h
    distance: Floats
    if shape == "rect":
        distance = canvas.box_distance(edge, foot, w - edge, h - foot)
    elif shape == "arch":
        distance = canvas.arch_distance(edge, foot, w - edge, h - foot - (w / 2 - edge))
    elif shape == "segment":
        distance = canvas.arch_distance(edge, foot, w - edge, h - foot - 0.13 * w, 0.13 * w)
    elif shape == "pointed":
        half, spring = w / 2 - edge, 0.5 * h
        radius = 1.5 * half  # each side is an arc about a point beyond the middle
        sides = np.maximum(
            canvas.disc_distance(edge + radius, spring, radius),
            canvas.disc_distance(w - edge - radius, spring, radius),
        )
        body = np.maximum(np.abs(canvas.x - w / 2) - half, foot - canvas.y)
        distance = np.where(canvas.y > spring, sides, body).astype(np.float32)
    else:
        distance = canvas.disc_distance(w / 2, h / 2, min(w, h) / 2 - 0.1 * w)
    canvas.lay(canvas.full(), "#000000")
    canvas.lay(canvas.cover(distance), "#ffffff")
