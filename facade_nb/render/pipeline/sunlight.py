"""What the sun sees: two parallel views of the scene, a fine one around the camera and a coarse one of all."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from math import cos, hypot, pi, sin, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .passes import SHADOW
from .viewpoint import Frustum

__all__ = ["MAPS", "Sunlight", "from_above", "skylight", "sunlight"]

_NEAR, _RISE, _MOST = 60.0, 1.6, 700.0
"""Half the side of the fine map, metres: for an eye on the ground, more for each metre above that, at most."""

_STANDS = 2.0
"""Up to that height an eye is on the ground, metres."""

_FAR, _WIDER = 3000.0, 10.0
"""Half the side of the coarse map, metres, at most; and so many times that of the fine one it is."""

_ABOVE, _EACH = 2048.0, 256.0
"""Half the side of the map of street lamps, and by how much it moves with the eye, metres: whole texels."""

_PAD = 0.1
"""Metres around what a view of all of it shows."""

MAPS = {
    "near": _NEAR, "rise": _RISE, "stands": _STANDS, "most": _MOST, "far": _FAR, "wider": _WIDER, "above": _ABOVE,
    "each": _EACH,
}  # fmt: skip
"""The same, for who draws the maps elsewhere."""


@dataclass(frozen=True, slots=True, eq=False)
class Sunlight:
    """The two views.

    Attributes
    ----------
    near, far
        From the world to their clip spaces (4, 4).
    texels
        Metres that a texel of each covers.
    """

    near: NDArray[np.float64]
    far: NDArray[np.float64]
    texels: tuple[float, float]


def sunlight(
    towards: tuple[float, float, float], frustum: Frustum, box: NDArray[np.float64], near: float = 0.0
) -> Sunlight:
    """The views for a direction towards the sun, a camera, and a scene's box (2, 3).

    `near`: half the side of the fine one, metres; 0: as the height of the camera asks for.
    """
    ahead = -np.array(towards, np.float64)
    right = np.array([-ahead[2], 0.0, ahead[0]]) / max(hypot(ahead[0], ahead[2]), 1e-9)
    up = np.cross(right, ahead)
    axes = np.stack([right, up, ahead])
    low, high = box
    middle = (low + high) / 2
    whole = float(np.sqrt(((high - low) ** 2).sum())) / 2 + 1.0
    half = min(near or _stepped(_NEAR + _RISE * max(float(frustum.eye[1]) - _STANDS, 0.0)), _MOST, whole)
    level = frustum.ahead * (1.0, 0.0, 1.0)
    spot = frustum.eye + level * (0.7 * half)
    spot[1] = 0.0
    spot = np.clip(spot, low, high)
    all_of_it = min(whole, _FAR if near else min(_FAR, _WIDER * half))
    centre = middle if all_of_it == whole else np.clip(frustum.eye * (1.0, 0.0, 1.0), low, high)
    return Sunlight(
        _parallel(axes, spot, half, box),
        _parallel(axes, centre, all_of_it, box),
        (2 * half / SHADOW, 2 * all_of_it / SHADOW),
    )


def _stepped(wanted: float) -> float:
    """A fine map that is so large at least. It grows in steps: within one, shadows do not swim as one rises."""
    half = _NEAR
    while half < min(wanted, _MOST):
        half *= sqrt(2.0)
    return half


def from_above(frustum: Frustum) -> NDArray[np.float64]:
    """The view (4, 4) of street lamps around the eye: east is right, north up. What it shows has no depth."""
    x, z = (np.round(float(frustum.eye[k]) / _EACH) * _EACH / _ABOVE for k in (0, 2))
    matrix = np.zeros((4, 4))
    matrix[0, 0], matrix[0, 3] = 1 / _ABOVE, -x
    matrix[1, 2], matrix[1, 3] = -1 / _ABOVE, z
    matrix[3, 3] = 1.0
    return matrix


def skylight(towards: tuple[float, float, float], box: NDArray[np.float64], rays: int) -> dict[str, Any]:
    """Views (4, 4) of a whole box: from the sun, and from so many directions of the sky, even over the half sphere.

    Returns
    -------
    dict
        ``sun_whole``, ``sky_0`` and so on, and ``rays``.
    """
    corners = np.array(list(product(*box.T)))
    found: dict[str, Any] = {"rays": float(rays), "sun_whole": _whole(np.array(towards), corners)}
    for k in range(rays):
        height, angle = (k + 0.5) / rays, k * pi * (3 - sqrt(5))
        flat = sqrt(1 - height**2)
        way = np.array([flat * cos(angle), height, flat * sin(angle)])
        found[f"sky_{k}"] = _whole(way, corners)
    return found


def _whole(towards: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """A parallel view (4, 4) of all `points` (n, 3), with a little around, from the direction of a light."""
    ahead = -towards
    helper = np.array([0.0, 1.0, 0.0]) if abs(ahead[1]) < 0.95 else np.array([1.0, 0.0, 0.0])
    right = np.cross(ahead, helper)
    right /= np.sqrt((right * right).sum())
    axes = np.stack([right, np.cross(right, ahead), ahead])
    spots = (points[:, None] * axes).sum(axis=2)
    low, high = spots.min(axis=0) - _PAD, spots.max(axis=0) + _PAD
    matrix = np.eye(4)
    matrix[:3, :3] = 2 * axes / (high - low)[:, None]
    matrix[:3, 3] = -(high + low) / (high - low)
    return matrix


def _parallel(
    axes: NDArray[np.float64], spot: NDArray[np.float64], half: float, box: NDArray[np.float64]
) -> NDArray[np.float64]:
    """A parallel view around a spot, on whole texels, so that shadows do not swim as the camera moves."""
    corners = np.array([[box[i, 0], box[j, 1], box[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    depth = (corners * axes[2]).sum(axis=1)
    texel = 2 * half / SHADOW
    x, y = (np.round(float((axes[k] * spot).sum()) / texel) * texel for k in (0, 1))
    near, far = depth.min() - 1.0, depth.max() + 1.0
    matrix = np.eye(4)
    matrix[0, :3], matrix[1, :3], matrix[2, :3] = axes[0] / half, axes[1] / half, 2 * axes[2] / (far - near)
    matrix[0, 3], matrix[1, 3], matrix[2, 3] = -x / half, -y / half, -(far + near) / (far - near)
    return matrix
