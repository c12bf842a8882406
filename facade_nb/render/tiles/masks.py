"""Masks for `SkipMask`: white where a hole is to be cut, black where the wall stays."""

from __future__ import annotations

import numpy as np

from .canvas import Canvas, Floats, smooth

__all__ = ["clouds", "fade", "mask"]


def fade(canvas: Canvas, axis: str) -> None:
    """Draw a slow change from black to white: ``up``, or to the ``right``; it fades light in rooms."""
    share = canvas.y / canvas.tall if axis == "up" else canvas.x / canvas.width
    grey = np.broadcast_to(1 - (1 - share) ** 1.8, (canvas.size, canvas.size)).astype(np.float32)
    canvas.lay(canvas.full(), np.repeat(grey[..., None], 3, axis=-1))


def clouds(canvas: Canvas, seed: int) -> None:
    """Draw soft patches: where a wall is weathered, or where one of two walls shows."""
    patches = 0.8 * canvas.noise((1.2, 1.5), seed, 3) + 0.35 * canvas.noise((0.5, 0.4), seed + 1, 3)
    grey = smooth(-1.5, 1.5, patches)
    canvas.lay(canvas.full(), np.repeat(grey[..., None], 3, axis=-1))


def mask(canvas: Canvas, shape: str) -> None:
    """Draw a mask: ``rect``, ``arch``, ``segment`` (a flat arc), ``pointed`` (Gothic), ``round`` or ``gable``."""
    w, h = canvas.width, canvas.tall
    edge, foot = 0.14 * w, 0.1 * h
    distance: Floats
    if shape == "rect":
        distance = canvas.box_distance(edge, foot, w - edge, h - foot)
    elif shape == "arch":
        edge = 0.055 * w  # within the stones of `frame-arch`
        distance = canvas.arch_distance(edge, 0.03 * h, w - edge, 0.98 * h - w / 2 + 0.012)
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
    elif shape == "gable":
        distance = canvas.polygon_distance([(0.0, 0.0), (w, 0.0), (w / 2, h)])
    else:
        distance = canvas.disc_distance(w / 2, h / 2, min(w, h) / 2 - 0.1 * w)
    canvas.lay(canvas.full(), "#000000")
    canvas.lay(canvas.cover(distance), "#ffffff")
