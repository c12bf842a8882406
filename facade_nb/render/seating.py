"""Where what stands in a roof is seated: on the slope at its foot, back to where the roof covers it, no higher."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import floor, inf

import numpy as np
from numpy.typing import NDArray

__all__ = ["FOOT", "LEAST", "Slope", "room_up", "seat"]

Floats = NDArray[np.float64]

LEAST = 0.3
"""Metres: an opening that has less room in a roof is left out."""

FOOT = 1e-3
"""Metres above its foot from which a dormer must be covered: below it stands the wall."""

_INTO = 0.05
"""How far it goes on into the roof behind the place where that covers it, metres."""

_STEPS = 24
"""Halvings in the search for the height that has room: to well below a millimetre."""


@dataclass(frozen=True, slots=True, eq=False)
class Slope:
    """A roof as one sees it from the front.

    Attributes
    ----------
    triangles
        (t, 3, 3) of the roof, x right, y up, z towards the viewer; the façade's plane is z = 0.
    near
        What of it is nearer than that is no slope that this façade's dormers stand in, metres.
    eaves
        Where walls end, metres up: below that nothing stands in the roof, though it hangs over.
    """

    triangles: Floats
    near: float = inf
    eaves: float = -inf

    @property
    def foot(self) -> float:
        """Where it begins, metres up."""
        return max(self.eaves, float(self.triangles[..., 1].min(initial=inf)))

    def depths(self, points: Floats) -> Floats:
        """Z of the roof (n,) behind places of the façade (n, 2), the nearest; NaN where there is none."""
        flat = self.triangles[:, :, :2]
        a, ab, ac = flat[:, 0], flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
        size = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
        lying = np.abs(size) > 1e-9
        a, ab, ac, size, z = a[lying], ab[lying], ac[lying], size[lying], self.triangles[lying, :, 2]
        off = points[:, None] - a
        u = (off[..., 0] * ac[:, 1] - off[..., 1] * ac[:, 0]) / size
        v = (ab[:, 0] * off[..., 1] - ab[:, 1] * off[..., 0]) / size
        depth = z[:, 0] + u * (z[:, 1] - z[:, 0]) + v * (z[:, 2] - z[:, 0])
        within = (u >= -1e-6) & (v >= -1e-6) & (u + v <= 1 + 1e-6) & (depth <= self.near)
        found = np.where(within, depth, -inf).max(axis=1, initial=-inf)
        return np.where(np.isfinite(found), found, np.nan)

    def covers(self, points: Floats) -> bool:
        """Whether all places above its foot have the roof behind them."""
        above = points[points[:, 1] > self.foot + FOOT]
        return not np.isnan(self.depths(above)).any()


def room_up(slope: Slope, height: float, outline: Callable[[float], Floats]) -> float:
    """How high something may be that the roof is to cover, at most `height`; 0: it has no room.

    Parameters
    ----------
    outline
        The places (n, 2) that it takes at some height.
    """
    if slope.covers(outline(height)):
        return height
    low, high = 0.0, height
    for _ in range(_STEPS):
        middle = (low + high) / 2
        low, high = (middle, high) if slope.covers(outline(middle)) else (low, middle)
    return floor(1000 * low) / 1000 if low >= LEAST else 0.0


def seat(slope: Slope, outline: Floats) -> tuple[float | None, float]:
    """Where a dormer's face stands on the slope, None where its foot is below that, and how far back it goes, z."""
    foot = outline[:, 1].min()
    face = (
        None
        if foot <= slope.foot - FOOT
        else float(np.nanmax(slope.depths(outline[outline[:, 1] < foot + FOOT])))
    )
    return face, float(np.nanmin(slope.depths(outline))) - _INTO
