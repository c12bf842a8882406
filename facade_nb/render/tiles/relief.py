"""What follows from the height of a surface: normals, how much of an overcast sky is seen, relief."""

from __future__ import annotations

from math import cos, pi, sin
from typing import NamedTuple

import numpy as np

from .canvas import Canvas, Floats

__all__ = ["Relief", "normals", "relief_of", "sky_light"]

_DIRECTIONS = 8
_STEPS = (0.01, 0.022, 0.05, 0.11, 0.22)
"""How far one looks for what stands in the way, metres."""

_FINEST = 256
"""Pixels at most that light is worked out for: it is soft, so larger canvases take it from these."""

_LEAST = 0.008
"""Metres below which a relief is none: what is shallower, such as the grain of plaster, normals show as well."""

_THICK = 0.012
"""Metres that bars are thick at least, whatever lies behind them: what is open begins there."""

_SUNK = 0.005
"""Metres behind the plane of the wall: openings that are deeper lead through it."""


class Relief(NamedTuple):
    """The heights of a tile, for relief mapping (docs/texture.md).

    Attributes
    ----------
    heights
        (size, size) from 0, the deepest, to 1, the highest; row 0 at the top.
    depth
        Metres from the deepest to the highest.
    high
        How far the highest stands out of the wall, metres.
    goes_on
        Whether the tile goes on at its opposite edge, across and up: what stands beside it is then the same again.
    stands
        Whether it stands on a wall, so that one sees past it at its edges. A tile with openings that are deeper than
        the wall is set into it.
    """

    heights: Floats
    depth: float
    high: float
    goes_on: tuple[bool, bool] = (False, False)
    stands: bool = True


def relief_of(canvas: Canvas) -> Relief | None:
    """The relief of what is drawn; None where it is flat. Where the canvas is transparent, it is what lies there."""
    solid = canvas.height[canvas.alpha > 0.99]
    high = float(canvas.height.max())
    low = max(float(canvas.height.min()), float(solid.min()) - _THICK) if len(solid) else high
    if high - low < _LEAST:
        return None
    above = np.maximum(canvas.height - np.float32(low), 0)
    heights = (above * np.float32(1 / (high - low))).astype(np.float32)
    heights.setflags(write=False)
    open_ = (canvas.alpha < 0.5) & (canvas.height < -_SUNK)
    return Relief(heights, high - low, high, canvas.wrap, not open_.any())


def normals(canvas: Canvas) -> Floats:
    """Unit normals (h, w, 3): x right, y up, z out of the wall. Flat where the canvas is transparent."""
    height = np.where(canvas.alpha > 0, canvas.height, 0).astype(np.float32)
    padded = _padded(height, 1, canvas.wrap)
    across = (padded[1:-1, 2:] - padded[1:-1, :-2]) / np.float32(2 * canvas.dx)
    up = (padded[:-2, 1:-1] - padded[2:, 1:-1]) / np.float32(2 * canvas.dy)
    # A step of a millimetre over one pixel and one of a decimetre are both edges: neither may turn black or white.
    slope = np.hypot(across, up)
    tame = 1 / np.sqrt(1 + (slope / 0.85) ** 2)
    result = np.stack([-across * tame, -up * tame, np.ones_like(across)], axis=-1)
    return result / np.linalg.norm(result, axis=-1, keepdims=True)


def sky_light(canvas: Canvas) -> Floats:
    """Light (h, w) of an overcast sky, which is brighter above; 1 on a plain wall.

    For each of a few directions along the wall the horizon is found, that is, the steepest rise of the surface seen
    from the point within 0.22 m; the sky above the horizons lights the point. The farther away, the more the surface is
    blurred before one looks, so that shadows are as soft there as those of a cloudy day.
    """
    factor = max(1, canvas.size // _FINEST)
    size = canvas.size // factor
    surface = canvas.height.reshape(size, factor, size, factor).mean(axis=(1, 3))
    dx, dy = canvas.dx * factor, canvas.dy * factor
    horizons = np.zeros((_DIRECTIONS, size, size), np.float32)
    for step in _STEPS:
        far = (min(round(step / dx), size // 2), min(round(step / dy), size // 2))
        if max(far) < 1:
            continue
        pad = max(far)
        padded = _padded(_blurred(surface, (far[0] // 2, far[1] // 2), canvas.wrap), pad, canvas.wrap)
        for k in range(_DIRECTIONS):
            angle = 2 * pi * (k + 0.5) / _DIRECTIONS
            i, j = round(far[0] * cos(angle)), round(-far[1] * sin(angle))
            away = float(np.hypot(i * dx, j * dy))
            if away:
                other = padded[pad + j : pad + j + size, pad + i : pad + i + size]
                np.maximum(horizons[k], (other - surface) * np.float32(1 / away), out=horizons[k])
    light = np.zeros((size, size), np.float32)
    total = 0.0
    for k, horizon in enumerate(horizons):
        angle = 2 * pi * (k + 0.5) / _DIRECTIONS
        weight = 1 + 0.75 * sin(angle) - 0.2 * cos(angle)
        light += np.float32(weight) * (1 - horizon / np.sqrt(1 + horizon * horizon))
        total += weight
    return _enlarged(light / np.float32(total), factor, canvas.wrap)


def _enlarged(values: Floats, factor: int, wrap: tuple[bool, bool]) -> Floats:
    """Bilinear between the centres of the coarse pixels."""
    if factor == 1:
        return values
    padded = _padded(values, 1, wrap)
    size = values.shape[0]
    at = (np.arange(size * factor) + 0.5) / factor + 0.5
    first = np.floor(at).astype(int)
    share = (at - first).astype(np.float32)
    rows = padded[first] * (1 - share)[:, None] + padded[first + 1] * share[:, None]
    return rows[:, first] * (1 - share) + rows[:, first + 1] * share


def _blurred(values: Floats, reach: tuple[int, int], wrap: tuple[bool, bool]) -> Floats:
    """Means over boxes of 2 reach + 1 pixels, across and down."""
    for axis, by in ((1, reach[0]), (0, reach[1])):
        if by < 1:
            continue
        width = [(0, 0), (0, 0)]
        width[axis] = (by + 1, by)
        sums = np.cumsum(
            np.pad(values, width, mode="wrap" if wrap[1 - axis] else "edge"), axis=axis, dtype=np.float64
        )
        count = values.shape[axis]
        high, low = (
            np.take(sums, range(2 * by + 1, 2 * by + 1 + count), axis),
            np.take(sums, range(count), axis),
        )
        values = ((high - low) / (2 * by + 1)).astype(np.float32)
    return values


def _padded(values: Floats, by: int, wrap: tuple[bool, bool]) -> Floats:
    values = np.pad(values, ((by, by), (0, 0)), mode="wrap" if wrap[1] else "edge")
    return np.pad(values, ((0, 0), (by, by)), mode="wrap" if wrap[0] else "edge")
