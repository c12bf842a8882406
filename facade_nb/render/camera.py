"""Cameras: a view camera with a shift lens, whose verticals stay upright as in architectural photographs."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin, tan

import numpy as np
from numpy.typing import NDArray

__all__ = ["Camera", "View"]


@dataclass(frozen=True, slots=True)
class Camera:
    """Where one stands.

    Attributes
    ----------
    azimuth
        Degrees to the right of the façade's middle; negative: to the left.
    height
        Of the eye above the ground, metres; None: half the building's, at least 1.7 m.
    angle
        Horizontal angle of view, degrees.
    fill
        Share of the picture's width, or height, that the building takes.
    """

    azimuth: float = 27.0
    height: float | None = None
    angle: float = 36.0
    fill: float = 0.84

    def look(self, points: NDArray[np.float64], size: tuple[int, int]) -> View:
        """The view in which all `points` (n, 3) lie inside a picture of `size` (width, height)."""
        yaw = radians(self.azimuth)
        right = np.array([cos(yaw), 0.0, -sin(yaw)])
        ahead = np.array([-sin(yaw), 0.0, -cos(yaw)])
        low, high = points.min(axis=0), points.max(axis=0)
        aim = (low + high) / 2
        eye_height = self.height if self.height is not None else max(1.7, 0.5 * (high[1] - low[1]))
        spread = 2 * tan(radians(self.angle) / 2)
        aspect = size[1] / size[0]

        def measure(distance: float) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
            eye = aim - ahead * distance
            eye[1] = eye_height
            offset = points - eye
            depth = offset @ ahead
            return eye, offset @ right / depth, offset[:, 1] / depth

        near = float(np.max(-(points - aim) @ ahead)) + 0.2
        far = near + 60 * float(np.linalg.norm(high - low)) + 10
        for _ in range(60):
            middle = (near + far) / 2
            _, u, v = measure(middle)
            if max(np.ptp(u), np.ptp(v) / aspect) > self.fill * spread:
                near = middle
            else:
                far = middle
        eye, u, v = measure(far)
        centre = (u.max() + u.min()) / 2
        tall = spread * aspect
        bottom = v.min() - 0.44 * (tall - np.ptp(v))
        depth = (points - eye) @ ahead
        return View(
            eye=eye,
            right=right,
            ahead=ahead,
            window=(centre - spread / 2, bottom, centre + spread / 2, bottom + tall),
            reach=(0.5 * float(depth.min()), 2.0 * float(depth.max())),
        )


@dataclass(frozen=True, slots=True, eq=False)
class View:
    """A camera that has found its place: eye, axes, and the window (left, bottom, right, top) at unit distance."""

    eye: NDArray[np.float64]
    right: NDArray[np.float64]
    ahead: NDArray[np.float64]
    window: tuple[float, float, float, float]
    reach: tuple[float, float]
