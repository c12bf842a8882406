"""Where one stands and looks, and paths from place to place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import atan2, cos, degrees, hypot, isfinite, radians, sin, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..camera import View
from ..texture.view import Sight

__all__ = ["CameraPath", "Frustum", "Viewpoint"]

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Frustum:
    """A camera ready to be drawn through.

    Attributes
    ----------
    eye
        Metres, in the world.
    right, up, ahead
        Unit vectors.
    window
        Left, bottom, right, top of the picture at unit distance.
    reach
        Nearest and farthest, metres.
    parallel
        Whether all rays run straight ahead, from the window's points, in place of coming from the eye.
    """

    eye: NDArray[np.float64]
    right: NDArray[np.float64]
    up: NDArray[np.float64]
    ahead: NDArray[np.float64]
    window: tuple[float, float, float, float]
    reach: tuple[float, float]
    parallel: bool = False

    @classmethod
    def of(cls, view: View) -> Frustum:
        """Of a camera with a shift lens."""
        return cls(view.eye, view.right, np.array([0.0, 1.0, 0.0]), view.ahead, view.window, view.reach)

    @classmethod
    def of_sight(cls, sight: Sight) -> Frustum:
        """Of a view of a façade whose lower left corner is the origin; of the part that it is of a whole."""
        step_x, step_y = map(float, sight.step)
        left, bottom = (
            a + b * c for a, b, c in zip(sight.window, sight.corner, (step_x, step_y), strict=False)
        )
        window = (left, bottom, left + sight.pixels[0] * step_x, bottom + sight.pixels[1] * step_y)
        up = np.array([0.0, 1.0, 0.0])
        right, ahead = np.array(sight.right, np.float64), np.array(sight.ahead, np.float64)
        if sight.eye is None:
            return cls(np.array([0.0, 0.0, 1.0]), right, up, ahead, window, (0.5, 2.0), True)
        near = 0.5 * sight.eye[2] / (1 + max(map(abs, window)))
        return cls(np.array(sight.eye, np.float64), right, up, ahead, window, (near, 1e9))

    @property
    def matrix(self) -> NDArray[np.float64]:
        """From the world to clip space (4, 4)."""
        view = np.eye(4)
        view[:3, :3] = np.stack([self.right, self.up, self.ahead])
        view[:3, 3] = -(view[:3, :3] * self.eye).sum(axis=1)
        l, b, r, t = self.window  # noqa: E741
        n, f = self.reach
        if self.parallel:
            lens = np.array(
                [
                    [2 / (r - l), 0, 0, -(r + l) / (r - l)],
                    [0, 2 / (t - b), 0, -(t + b) / (t - b)],
                    [0, 0, 2 / (f - n), -(f + n) / (f - n)],
                    [0, 0, 0, 1],
                ]
            )
        else:
            lens = np.array(
                [
                    [2 / (r - l), 0, -(r + l) / (r - l), 0],
                    [0, 2 / (t - b), -(t + b) / (t - b), 0],
                    [0, 0, (f + n) / (f - n), -2 * f * n / (f - n)],
                    [0, 0, 1, 0],
                ]
            )
        return np.asarray((lens[:, :, None] * view[None]).sum(axis=1))

    def crop(self, left: float, bottom: float, right: float, top: float) -> Frustum:
        """A part of the picture, in shares of its width and height from its lower left corner."""
        l, b, r, t = self.window  # noqa: E741
        window = (l + left * (r - l), b + bottom * (t - b), l + right * (r - l), b + top * (t - b))
        return replace(self, window=window)

    def planes(self) -> NDArray[np.float64]:
        """Left, right, lower, upper and near plane (5, 4): a point p is inside where n · p + d is above 0."""
        l, b, r, t = self.window  # noqa: E741
        normals = np.array(
            [
                self.right - l * self.ahead,
                r * self.ahead - self.right,
                self.up - b * self.ahead,
                t * self.ahead - self.up,
                self.ahead,
            ]
        )
        return np.column_stack([normals, -(normals * self.eye).sum(axis=1)])


@dataclass(frozen=True, slots=True)
class Viewpoint:
    """Where one stands, and which way one looks.

    Attributes
    ----------
    eye
        Metres: x east, y up, z south.
    yaw
        Degrees to the right of north.
    pitch
        Degrees above the horizon.
    angle
        Horizontal angle of view, degrees.
    """

    eye: Vector
    yaw: float = 0.0
    pitch: float = 0.0
    angle: float = 60.0

    def __post_init__(self) -> None:
        if not all(isfinite(value) and abs(value) <= 1e6 for value in self.eye):
            raise ValueError(f"eye: expected three numbers within ±1e6; found {self.eye}")
        if not (isfinite(self.yaw) and -90 < self.pitch < 90 and 0 < self.angle < 180):
            raise ValueError(
                f"yaw, pitch, angle: expected degrees, pitch between -90 and 90, angle between 0 and 180; "
                f"found {self.yaw}, {self.pitch}, {self.angle}"
            )

    @classmethod
    def towards(cls, eye: Vector, target: Vector, angle: float = 60.0) -> Viewpoint:
        """From an eye to a point."""
        x, y, z = (b - a for a, b in zip(eye, target, strict=True))
        return cls(eye, degrees(atan2(x, -z)), degrees(atan2(y, hypot(x, z))), angle)

    def frustum(self, pixels: tuple[int, int]) -> Frustum:
        """Seen through pixels as high as wide."""
        yaw, pitch = radians(self.yaw), radians(self.pitch)
        ahead = np.array([sin(yaw) * cos(pitch), sin(pitch), -cos(yaw) * cos(pitch)])
        right = np.array([cos(yaw), 0.0, sin(yaw)])
        up = np.array([-sin(yaw) * sin(pitch), cos(pitch), cos(yaw) * sin(pitch)])
        half = tan(radians(self.angle) / 2)
        tall = half * pixels[1] / pixels[0]
        near = min(max(0.06 * self.eye[1], 0.1), 4.0)
        return Frustum(
            np.array(self.eye, np.float64), right, up, ahead, (-half, -tall, half, tall), (near, 30_000.0)
        )


@dataclass(frozen=True)
class CameraPath:
    """A way through the scene: places and when one is there.

    Attributes
    ----------
    times
        Seconds, growing, the first 0.
    places
        A viewpoint for each.
    """

    times: tuple[float, ...]
    places: tuple[Viewpoint, ...]

    def __post_init__(self) -> None:
        if len(self.times) != len(self.places) or not self.times or self.times[0] != 0:
            raise ValueError("times: expected one for each place, the first 0")
        if any(b <= a for a, b in zip(self.times, self.times[1:], strict=False)):
            raise ValueError(f"times: expected growing ones; found {self.times}")

    @property
    def seconds(self) -> float:
        """How long it takes."""
        return self.times[-1]

    def at(self, time: float) -> Viewpoint:
        """Where one is at a time, on a smooth curve through the places that does not swing beyond any two of them."""
        places, times = self.places, self.times
        if len(places) == 1 or time <= 0:
            return places[0]
        if time >= times[-1]:
            return places[-1]
        k = max(i for i, own in enumerate(times) if own <= time)
        ends = (max(k - 1, 0), k, k + 1, min(k + 2, len(places) - 1))
        rows = [_row(places[i]) for i in ends]
        for before, after in pairwise(rows):
            after[3] = before[3] + (after[3] - before[3] + 180.0) % 360.0 - 180.0  # the shorter way around
        own_times = [times[i] for i in ends]
        values = [_between(own_times, [row[c] for row in rows], time) for c in range(6)]
        return Viewpoint((values[0], values[1], values[2]), values[3], values[4], values[5])

    def to_dict(self) -> list[dict[str, Any]]:
        """As JSON has it."""
        return [
            {"time": time, "eye": list(own.eye), "yaw": own.yaw, "pitch": own.pitch, "angle": own.angle}
            for time, own in zip(self.times, self.places, strict=True)
        ]

    @classmethod
    def from_dict(cls, rows: Sequence[dict[str, Any]]) -> CameraPath:
        """From what `to_dict` gives. Raises `ValueError` for anything else."""
        try:
            places = [
                Viewpoint(_three(row["eye"]), float(row["yaw"]), float(row["pitch"]), float(row["angle"]))
                for row in rows
            ]
            return cls(tuple(float(row["time"]) for row in rows), tuple(places))
        except (KeyError, TypeError) as error:
            raise ValueError(
                f"path: expected a list of time, eye, yaw, pitch and angle; {type(error).__name__}: {error}"
            ) from None


def _three(values: Any) -> Vector:
    x, y, z = (float(value) for value in values)
    return x, y, z


def _row(place: Viewpoint) -> list[float]:
    return [*place.eye, place.yaw, place.pitch, place.angle]


def _between(times: Sequence[float], values: Sequence[float], time: float) -> float:
    """A cubic between the middle two of four values, monotone where they are (Fritsch and Butland's slopes)."""
    step = times[2] - times[1]
    rise = (values[2] - values[1]) / step
    first = _slope(times[1] - times[0], step, values[1] - values[0], rise)
    last = _slope(times[3] - times[2], step, values[3] - values[2], rise)
    t = (time - times[1]) / step
    rest = 1 - t
    return (
        values[1] * rest * rest * (1 + 2 * t)
        + values[2] * t * t * (1 + 2 * rest)
        + step * t * rest * (first * rest - last * t)
    )


def _slope(beyond: float, step: float, change: float, rise: float) -> float:
    """At a place, from what lies beyond it: so many seconds, and so large a change."""
    if beyond <= 0:
        return 0.0  # an end: one starts and stops gently
    other = change / beyond
    if other * rise <= 0:
        return 0.0
    near, far = 2 * step + beyond, step + 2 * beyond
    return (near + far) / (near / other + far / rise)
