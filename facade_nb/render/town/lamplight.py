"""How far the light of street lamps comes before it meets a wall, in some directions around each.

Walls are high, so that is told from above. What a lamp's vertices carry of it stands in the place of their normal, for
what turns to whoever looks has none (`pipeline.vertices`, ``pools.vert``).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, direction
from .rings import Ints

if TYPE_CHECKING:
    from .plan import Plan

__all__ = ["DIRECTIONS", "FREE", "packed", "reaches", "unpacked"]

REACH = 13.0
"""Metres from a lantern to where its light ends, as ``pools.vert`` has it."""

DIRECTIONS, FREE = 15, 15
"""So many directions there are, counter-clockwise from east; and so many steps is the whole reach, in 4 bits."""

_LIT = 4.0
"""Walls that are not as high stand below the light, metres."""

_STEP = 1 << 22
_EACH = 5


def reaches(plan: Plan, at: Floats) -> Ints:
    """How many steps light comes from points (l, 2) in each direction (l, `DIRECTIONS`), rounded up."""
    found = np.full((len(at), DIRECTIONS), FREE, np.int64)
    high = np.flatnonzero(plan.eaves[plan.building] >= _LIT)
    if not len(at) or not len(high):
        return found
    foot, way = plan.corners[high], plan.corners[plan.following[high]] - plan.corners[high]
    tree = shapely.STRtree(shapely.linestrings(np.stack([foot, foot + way], axis=1)))
    lamp, wall = tree.query(shapely.points(at), predicate="dwithin", distance=REACH)
    away, way = foot[wall] - at[lamp], way[wall]
    for k, (x, y) in enumerate(direction(np.arange(DIRECTIONS) / DIRECTIONS).tolist()):
        # Where the ray (x, y) meets the line from `away` along `way`.
        across = x * way[:, 1] - y * way[:, 0]
        level = np.abs(across) < 1e-9
        across = np.where(level, 1.0, across)
        far = (away[:, 0] * way[:, 1] - away[:, 1] * way[:, 0]) / across
        part = (away[:, 0] * y - away[:, 1] * x) / across
        met = ~level & (far > 0) & (part >= -1e-6) & (part <= 1 + 1e-6)
        step = np.ceil(np.round(far[met] * FREE / REACH, 4)).astype(np.int64)
        np.minimum.at(found[:, k], lamp[met], np.clip(step, 1, FREE))
    return found


def packed(steps: Ints) -> NDArray[np.float64]:
    """As three numbers (l, 3) below 1/4 that a float32 holds exactly: zeros where there are no walls."""
    parts = FREE - steps.reshape(len(steps), 3, _EACH)
    return np.asarray((parts << (4 * np.arange(_EACH))).sum(axis=2) / _STEP)


def unpacked(numbers: NDArray[np.floating]) -> Ints:
    """What `packed` has packed (…, 3)."""
    whole = np.rint(np.asarray(numbers, np.float64) * _STEP).astype(np.int64)
    parts = (whole[..., None] >> (4 * np.arange(_EACH))) & 15
    return FREE - parts.reshape(*whole.shape[:-1], DIRECTIONS)
