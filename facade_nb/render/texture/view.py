"""How a façade is looked at: straight on, or with a camera. Every pixel becomes a point and a ray."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..camera import Camera

__all__ = ["Looks", "Sight"]

Floats = NDArray[np.float32]

_FAR, _NEAR = 1e6, 1e-3
"""How far from the façade's corner an eye may be, and how near to its plane, metres."""


@dataclass(frozen=True, slots=True, eq=False)
class Looks:
    """What some pixels look at.

    Attributes
    ----------
    points
        (n, 2) float32 metres on the façade's plane.
    rays
        (n, 3) float32 from the eye to the points; None: straight on.
    footprint
        (n,) float32, how many metres a pixel covers there, across the line of sight.
    spread
        How much more it covers behind the façade, for each of the ray's lengths; 0 straight on.
    inside
        (n,) bool, whether the façade is there.
    """

    points: Floats
    rays: Floats | None
    footprint: Floats
    spread: float
    inside: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Sight:
    """A view of a façade whose lower left corner is the origin: x to the right, y up, z out of it.

    Attributes
    ----------
    size
        Width and height of the façade, metres.
    pixels
        Width and height of the picture.
    window
        Left, bottom, right, top of what the picture shows: metres on the façade, or with an eye, on a plane at unit
        distance from it.
    eye
        Where the eye is; None: infinitely far in front of the façade.
    right, ahead
        The camera's axes, where there is an eye. Its third axis is the vertical.
    whole
        Where this is a crop of a larger picture (see `crop`): that picture's pixels. The window is that of the whole.
    corner
        Column and row of the crop's lower left pixel in it, from its lower left corner.
    """

    size: tuple[float, float]
    pixels: tuple[int, int]
    window: tuple[float, float, float, float]
    eye: tuple[float, float, float] | None = None
    right: tuple[float, float, float] = (1.0, 0.0, 0.0)
    ahead: tuple[float, float, float] = (0.0, 0.0, -1.0)
    whole: tuple[int, int] | None = None
    corner: tuple[int, int] = (0, 0)

    @classmethod
    def flat(cls, size: tuple[float, float], pixels: tuple[int, int]) -> Sight:
        """Straight on, the façade filling the picture."""
        return cls(size, pixels, (0.0, 0.0, *size))

    @classmethod
    def through(cls, camera: Camera, size: tuple[float, float], pixels: tuple[int, int]) -> Sight:
        """With a camera that has the whole façade in the picture."""
        width, height = size
        corners = np.array([(0, 0, 0), (width, 0, 0), (0, height, 0), (width, height, 0)], np.float64)
        view = camera.look(corners, pixels)
        (ex, ey, ez), (rx, ry, rz), (ax, ay, az) = (map(float, v) for v in (view.eye, view.right, view.ahead))
        return cls(size, pixels, view.window, (ex, ey, ez), (rx, ry, rz), (ax, ay, az))

    @classmethod
    def from_eye(
        cls,
        eye: tuple[float, float, float],
        target: tuple[float, float],
        size: tuple[float, float],
        pixels: tuple[int, int],
        angle: float = 50.0,
    ) -> Sight:
        """From an eye, `angle` degrees wide, with the point `target` of the façade in the middle of the picture.

        The picture's plane stays upright, so vertical edges stay vertical.

        Raises
        ------
        ValueError
            If the eye is behind the façade or too far away, or the angle is not one that a camera can have.
        """
        if not all(abs(value) <= _FAR for value in (*eye, *target)):
            raise ValueError(f"eye, target: expected numbers within ±{_FAR:g}; found {eye}, {target}")
        if eye[2] < _NEAR:
            raise ValueError(
                f"eye: expected one in front of the façade, its z at least {_NEAR:g}; found {eye[2]:g}"
            )
        if not 0 < angle < 180:
            raise ValueError(f"angle: expected degrees between 0 and 180; found {angle:g}")
        x, z = target[0] - eye[0], -eye[2]
        reach = float(np.hypot(x, z))
        ahead = (x / reach, 0.0, z / reach)
        half = float(np.tan(np.radians(angle) / 2))
        tall = half * pixels[1] / pixels[0]
        up = (target[1] - eye[1]) / reach
        return cls(size, pixels, (-half, up - tall, half, up + tall), eye, (-ahead[2], 0.0, ahead[0]), ahead)

    def crop(self, left: int, top: int, width: int, height: int) -> Sight:
        """A part of the picture, in pixels from its upper left corner: each shows what it shows in the whole."""
        corner = (self.corner[0] + left, self.corner[1] + self.pixels[1] - top - height)
        return replace(self, pixels=(width, height), whole=self.whole or self.pixels, corner=corner)

    @property
    def step(self) -> tuple[np.float32, np.float32]:
        """What a pixel takes of the window, across and up."""
        left, bottom, right, top = (np.float32(v) for v in self.window)
        width, height = self.whole or self.pixels
        return (right - left) / np.float32(width), (top - bottom) / np.float32(height)

    def looks(self, chosen: NDArray[np.intp] | None = None, shift: tuple[float, float] = (0.5, 0.5)) -> Looks:
        """What pixels look at: all, or those of the numbers `chosen` (row by row from the top).

        `shift` is the place in each pixel, from its lower left corner, (0, 0), to its upper right one, (1, 1).
        """
        width, height = self.pixels
        number = np.arange(width * height) if chosen is None else chosen
        left, bottom = (np.float32(v) for v in self.window[:2])
        column = (self.corner[0] + number % width).astype(np.float32) + np.float32(shift[0])
        row = (self.corner[1] + height - 1 - number // width).astype(np.float32) + np.float32(shift[1])
        step_x, step_y = self.step
        u, v = left + column * step_x, bottom + row * step_y
        if self.eye is None:
            points, rays = np.stack([u, v], axis=1), None
            footprint = np.full(len(number), min(step_x, step_y), np.float32)
            spread = 0.0
            ahead = np.ones(len(number), bool)
        else:
            eye, across, forward = (np.array(a, np.float32) for a in (self.eye, self.right, self.ahead))
            rays = u[:, None] * across + forward
            rays[:, 1] += v
            ahead = rays[:, 2] < np.float32(-1e-6)
            reach = np.where(ahead, eye[2] / np.maximum(-rays[:, 2], np.float32(1e-6)), 0).astype(np.float32)
            points = eye[:2] + rays[:, :2] * reach[:, None]
            footprint = reach * min(step_x, step_y)
            spread = float(min(step_x, step_y))
        wide, tall = self.size
        inside = ahead & (points >= 0).all(axis=1) & (points[:, 0] <= wide) & (points[:, 1] <= tall)
        return Looks(points.astype(np.float32), rays, footprint.astype(np.float32), spread, inside)
