"""Roofs that hang over: their planes go on beyond the walls, along the eaves and at gables."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .chance import Floats, length, millimetres

__all__ = ["Hang", "lowered", "overhung"]

_MOST = 0.3
"""No plane goes on by a greater part of itself."""

_STUB = 0.3
"""Along a shorter edge a roof has no eaves of its own, metres."""


@dataclass(frozen=True, slots=True, eq=False)
class Hang:
    """How far strips hang over, metres; 0 where a neighbour stands.

    Attributes
    ----------
    front, rear
        (s, arms) along the two chains.
    ends
        (s, 2) beyond the first and the last station.
    """

    front: Floats
    rear: Floats
    ends: Floats


def overhung(points: Floats, arm: int, hang: Hang) -> tuple[Floats, np.ndarray]:
    """The cross-sections (s, 2, j, 3) at both stations of an arm, longer where the roof hangs over, and where it does.

    Parameters
    ----------
    points
        (s, m, j, 3) of all stations.
    """
    wide = points[:, arm : arm + 2].copy()
    last = points.shape[1] - 2
    for over, lower, upper in ((hang.front, 0, 1), (hang.rear, -1, -2)):
        shares = [_shares(points, k, over, lower, upper) for k in range(last + 1)]
        for side in (0, 1):
            own, there = shares[arm][:, side], arm - 1 + 2 * side
            if 0 <= there <= last:  # both arms that meet there end in one point, if both hang over
                other = shares[there][:, 1 - side]
                own = np.where((own > 0) & (other > 0), (own + other) / 2, own)
            wide[:, side, lower] += (points[:, arm + side, lower] - points[:, arm + side, upper]) * own[
                :, None
            ]
    for side, end in ((0, 0), (1, last)):
        if arm == end:
            way = wide[:, side] - wide[:, 1 - side]
            span = length(way[..., :2])
            far = np.where(
                span > 2 * _STUB, np.minimum(hang.ends[:, side, None] / np.maximum(span, 0.1), _MOST), 0
            )
            wide[:, side] += way * far[..., None]
    both = (hang.front[:, arm] > 0) | (hang.rear[:, arm] > 0) | (hang.ends > 0).any(axis=1)
    # What does not hang over stays as it is: it meets the walls.
    return np.where(wide == points[:, arm : arm + 2], wide, millimetres(wide)), both


def _shares(points: Floats, arm: int, over: Floats, lower: int, upper: int) -> Floats:
    """By what part of itself the lowest plane of an arm goes on at its stations (s, 2): so far it hangs over."""
    foot, end = points[:, arm, lower, :2], points[:, arm + 1, lower, :2]
    way = end - foot
    span = length(way)
    unit = way / np.maximum(span, 1e-9)[:, None]
    shares = []
    for station in (arm, arm + 1):
        up = points[:, station, upper, :2] - foot
        deep = np.abs(unit[:, 0] * up[:, 1] - unit[:, 1] * up[:, 0])
        shares.append(np.where((span > _STUB) & (deep > _STUB), over[:, arm] / np.maximum(deep, 0.1), 0))
    return np.minimum(np.stack(shares, axis=1), _MOST)


def lowered(feet: Floats, tops: Floats, over: Floats) -> Floats:
    """Corners (s, m, 3) of eaves, further out along the lines that come down to them from the ridge.

    Parameters
    ----------
    over
        (s,) metres, across the eaves.
    """
    found = feet.copy()
    arms = feet.shape[1] - 1
    for k in range(feet.shape[1]):
        i = min(k, arms - 1)
        way = feet[:, i + 1, :2] - feet[:, i, :2]
        if arms > 1 and k > 0:
            before = feet[:, k, :2] - feet[:, k - 1, :2]
            way = np.where((length(way) > length(before))[:, None], way, before)
        up = tops[:, k, :2] - feet[:, k, :2]
        deep = np.abs(way[:, 0] * up[:, 1] - way[:, 1] * up[:, 0]) / np.maximum(length(way), 1e-9)
        share = np.where(deep > _STUB, np.minimum(over / np.maximum(deep, 0.1), _MOST), 0)
        found[:, k] += (feet[:, k] - tops[:, k]) * share[:, None]
    return np.where(found == feet, found, millimetres(found))
