"""Random numbers, directions and a smooth field that are the same on every processor.

Only + - * / and square roots are used: their results are fixed to the last bit, unlike those of sin, exp or a matrix
product.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Floats", "chance", "direction", "field", "length", "millimetres", "pick"]

Floats = NDArray[np.floating[Any]]


def chance(seed: int, *purpose: int) -> np.random.Generator:
    """A stream of random numbers of its own for a seed and a purpose."""
    return np.random.Generator(np.random.PCG64([seed, *purpose]))


def millimetres(values: Floats) -> Floats:
    """Metres, rounded to whole millimetres. There is no minus zero."""
    return np.rint(np.asarray(values, np.float64) * 1000) / 1000 + 0.0


def length(vectors: Floats) -> Floats:
    """Length of vectors (…, 2)."""
    return np.sqrt(vectors[..., 0] * vectors[..., 0] + vectors[..., 1] * vectors[..., 1])


def direction(turns: Floats | float) -> Floats:
    """Unit vectors (…, 2) at so many turns, counter-clockwise from east.

    Angles are true at quarters of a turn, and within half a degree elsewhere.
    """
    turns = np.asarray(turns, np.float64)
    quarters = 4 * (turns - np.floor(turns))
    quadrant = np.floor(quarters)
    f = quarters - quadrant
    t = f * (0.785398 + 0.214602 * f * f)  # about the tangent of half the angle; 1 at its end
    x, y = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    cases = [quadrant == 0, quadrant == 1, quadrant == 2]
    return np.stack([np.select(cases, [x, -y, -x], y), np.select(cases, [y, x, -y], -x)], axis=-1)


def field(points: Floats, seed: int, wave: float) -> Floats:
    """A smooth field of vectors (n, 2) within -1 to 1 at points (n, 2): random at knots that are `wave` apart."""
    at = np.asarray(points, np.float64) / wave + 1024.5
    cell = np.floor(at).astype(np.int64)
    f = at - cell
    s = f * f * f * (f * (f * 6 - 15) + 10)
    knots = [[_knots(cell[:, 0] + i, cell[:, 1] + j, seed) for i in (0, 1)] for j in (0, 1)]
    low, high = (row[0] + (row[1] - row[0]) * s[:, :1] for row in knots)
    return np.asarray(low + (high - low) * s[:, 1:])


def _knots(x: NDArray[np.int64], y: NDArray[np.int64], seed: int) -> Floats:
    """Two numbers within -1 to 1 for each knot."""
    mixed = x.astype(np.uint64) * np.uint64(0x9E3779B97F4A7C15) ^ y.astype(np.uint64) * np.uint64(
        0xC2B2AE3D27D4EB4F
    )
    mixed = mixed ^ np.uint64((seed * 0x165667B19E3779F9 + 0x27D4EB2F165667C5) % 2**64)
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB), (31, 1)):
        mixed = (mixed ^ (mixed >> np.uint64(shift))) * np.uint64(factor)
    halves = np.stack([mixed >> np.uint64(32), mixed & np.uint64(0xFFFFFFFF)], axis=1)
    return halves.astype(np.float64) / 2**31 - 1


def pick(random: Floats, weights: Floats) -> NDArray[np.intp]:
    """Which of the columns of weights (n, k) or (k,) random numbers (n,) from 0 to below 1 choose."""
    weights = np.asarray(weights, np.float64)
    bounds = np.cumsum(np.broadcast_to(weights, (len(random), weights.shape[-1])), axis=1)
    chosen: NDArray[np.intp] = (np.asarray(random)[:, None] * bounds[:, -1:] >= bounds).sum(axis=1)
    return np.minimum(chosen, weights.shape[-1] - 1)
