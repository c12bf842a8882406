"""Light on what a grammar gives, at any hour: sun and sky outside, daylight and lamps in rooms.

A grammar says all that light needs to know in its three channels, so one grammar serves every hour:

- A **normal** of length 1 is out of doors: sun and sky fall on it. Where nothing is said it is the façade's own.
- A normal of length 0, ``Mat(Normal, 0, 0.5, 0.5, 0.5, 1)``, is a surface in a room, where neither comes. It has the
  light that has come in through the window by day, and as much lamp light, of the colour of its **specular** value, as
  the hour asks for. What lies in between is mixed: a pane that mirrors a third of the sky has a normal with an alpha of
  a third. What a pane adds to the specular value is taken off the lamp.
- Out of doors the specular value is the strength of the sun's highlight.

Colours are composited as stored (sRGB); light is worked out in linear values. ``glsl/texture/light.glsl`` is the same,
for the light pass of the pipeline.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, radians, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..developing import floats, linear

__all__ = ["Colour", "Daytime", "light"]

Floats = NDArray[np.float32]
Colour = tuple[float, float, float]

_LANTERN: Colour = (1.0, 0.77, 0.52)  # the colour of street lamps, linear

_DAWN, _DUSK = 5.5, 20.5
_STEEPEST = 54.0
_SWING = 82.0
_LAMP, _STREET = 1.15, 0.26


@dataclass(frozen=True, slots=True)
class Daytime:
    """The light of an hour, on a façade that looks south.

    Attributes
    ----------
    hour
        0 to 24.
    towards
        Unit vector towards the sun: x to the right, y up, z out of the façade.
    sun, sky, ground
        Light of the sun, of the sky, and what the ground throws back; linear.
    indoors
        Daylight in rooms.
    lamps
        Lamp light in rooms where specular is 1; street lamps are a part of it.
    zenith, horizon
        The sky as it is seen, linear.
    exposure
        Of the picture.
    afterglow
        What a low sun, or one that has just set, adds to the sky on its side, at the horizon; linear.
    """

    hour: float
    towards: Colour
    sun: Colour
    sky: Colour
    ground: Colour
    indoors: Colour
    lamps: float
    zenith: Colour
    horizon: Colour
    exposure: float
    afterglow: Colour = (0.0, 0.0, 0.0)

    @classmethod
    def at(cls, hour: float) -> Daytime:
        """The light at an hour, 0 to 24: the sun rises to the left, stands before the façade at 13, sets to the right.

        Raises
        ------
        ValueError
            For an hour beyond that.
        """
        if not 0 <= hour <= 24:
            raise ValueError(f"hour: expected 0 to 24; found {hour!r}")
        day = (hour - _DAWN) / (_DUSK - _DAWN)
        night_share = (hour - _DUSK) % 24 / (24 - _DUSK + _DAWN)
        height = sin(pi * day) if 0 <= day <= 1 else -sin(pi * night_share)
        elevation = radians(max(_STEEPEST * height, 3.0))
        turn = radians(-_SWING + 2 * _SWING * min(max(day, 0.0), 1.0))
        towards = (cos(elevation) * sin(turn), sin(elevation), cos(elevation) * cos(turn))
        up = _step(-0.03, 0.28, height)  # how much of the day there is
        warm = _step(0.05, 0.75, height)  # how far the sun is from yellow
        night = 1 - _step(-0.14, 0.12, height)
        sun = _mix((2.9, 1.45, 0.62), (3.0, 2.74, 2.36), warm)
        sky = _mix((0.62, 0.52, 0.58), (0.50, 0.66, 0.92), warm)
        sky = _mix(_mix(sky, (0.52, 0.50, 0.62), 1 - up), (0.045, 0.068, 0.135), night)
        zenith = _mix(_mix((0.11, 0.23, 0.56), (0.27, 0.56, 1.20), warm), (0.0045, 0.011, 0.035), night)
        horizon = _mix(_mix((0.60, 0.60, 0.74), (1.02, 1.28, 1.52), warm), (0.030, 0.040, 0.075), night)
        return cls(
            hour,
            towards,
            _scaled(sun, up),
            sky,
            _scaled(_mix((0.36, 0.30, 0.24), (0.44, 0.42, 0.38), warm), 0.9 * up),
            _mix(_scaled((0.41, 0.43, 0.45), up), (0.012, 0.016, 0.028), night),
            _step(0.35, -0.02, height),
            zenith,
            horizon,
            0.62 + 0.9 * night + 0.26 * (1 - warm) * up,
            _scaled(
                _mix((0.62, 0.17, 0.09), (0.85, 0.36, 0.02), up), (1 - warm) * _step(-0.42, 0.02, height)
            ),
        )

    def uniforms(self) -> dict[str, float | tuple[float, ...]]:
        """What the passes of the pipeline are given, for a façade that looks south."""
        return {
            "towards": self.towards,
            "sun": self.sun,
            "sky": self.sky,
            "ground": self.ground,
            "indoors": self.indoors,
            "lamps": (_LAMP * self.lamps, _STREET * self.lamps),
            "zenith": self.zenith,
            "horizon": self.horizon,
            "exposure": self.exposure,
            "afterglow": self.afterglow,
        }

    def backdrop(self, rays: Floats) -> Floats:
        """The sky (n, 3), linear, that is seen along directions (n, 3)."""
        length = np.sqrt(_dots(rays, rays))
        rise = np.clip(rays[:, 1] / length, 0, 1)[:, None] ** 0.7
        low, high = floats(self.horizon), floats(self.zenith)
        seen = low + (high - low) * rise
        ahead = (rays @ floats(self.towards) / length)[:, None]
        glow = np.clip(ahead, 0, 1) ** 24
        low_down = np.clip(1 - 2.2 * rays[:, 1:2] / length[:, None], 0, 1)
        side = (0.5 + 0.5 * ahead) * low_down
        return (seen + side**3 * floats(self.afterglow) + 0.16 * glow * floats(self.sun)).astype(np.float32)


_PART = 1 << 14


def light(
    color: Floats,
    normal: Floats,
    specular: Floats,
    rays: Floats,
    daytime: Daytime,
    shadow: Floats,
    heights: Floats,
    axes: Floats | None = None,
) -> Floats:
    """Light (n, 3), linear, that comes from n points of a façade.

    Parameters
    ----------
    color, normal, specular
        (n, 4) as `Surface` has them: multiplied by alpha.
    rays
        (n, 3) directions from the eye, in the façade's frame.
    daytime
        The hour.
    shadow
        (n,) how much of the sun is seen, 0 to 1.
    heights
        (n,) metres above the ground.
    axes
        (3, 3) the façade's right, up and outward axes in the world, as rows; None: it looks south.
    """
    turned = np.eye(3, dtype=np.float32) if axes is None else axes
    lit = np.empty((len(color), 3), np.float32)
    parts = (color, normal, specular, rays, shadow, heights)
    for first in range(0, len(color), _PART):
        own = slice(first, first + _PART)
        lit[own] = _light(daytime, turned, *[part[own] for part in parts])
    return lit


def _light(
    daytime: Daytime,
    turned: Floats,
    color: Floats,
    normal: Floats,
    specular: Floats,
    rays: Floats,
    shadow: Floats,
    heights: Floats,
) -> Floats:
    """As `light`, of few enough points that what is calculated on the way stays in the processor's cache."""
    local = normal[:, :3] + (1 - normal[:, 3:]) * floats([0.5, 0.5, 1.0])
    vector = 2 * local - 1
    length = np.sqrt(_dots(vector, vector))
    outside = np.clip(length, 0, 1)
    unit = (vector / np.maximum(length, 1e-4)[:, None]) @ turned
    towards = floats(daytime.towards)
    facing = np.clip(unit @ towards, 0, 1) * shadow
    up = unit[:, 1]
    low = np.exp(-np.maximum(heights, 0) / 3.0)  # streets are darker than eaves, and have lamps
    sky = (0.62 + 0.38 * up) * (1 - 0.28 * low)
    outdoors = (
        facing[:, None] * floats(daytime.sun)
        + sky[:, None] * floats(daytime.sky)
        + ((0.5 - 0.5 * up) + 0.35 * low)[:, None] * floats(daytime.ground)
        + (daytime.lamps * _STREET * np.exp(-np.maximum(heights - 2.5, 0) / 4.5))[:, None] * floats(_LANTERN)
    )
    lamp = np.clip(specular[:, :3] - outside[:, None], 0, 1) * np.float32(daytime.lamps * _LAMP)
    albedo = linear(np.clip(color[:, :3], 0, 1))
    share = outside[:, None]
    lit: Floats = albedo * (share * outdoors + (1 - share) * floats(daytime.indoors) + lamp)
    if not any(daytime.sun):
        return lit
    view = rays / np.maximum(np.sqrt(_dots(rays, rays)), 1e-6)[:, None] @ turned
    half = towards - view
    half /= np.maximum(np.sqrt(_dots(half, half)), 1e-6)[:, None]
    shine = _sixtieth(np.clip(_dots(unit, half), 0, 1)) * shadow * outside
    result: Floats = lit + (0.5 * shine)[:, None] * specular[:, :3] * floats(daytime.sun)
    return result


def _dots(a: NDArray[Any], b: NDArray[Any]) -> Floats:
    """Products of rows (n,)."""
    found: Floats = np.einsum("ij,ij->i", a, b)
    return found


def _sixtieth(x: NDArray[Any]) -> Any:
    """The 60th power: 4 + 8 + 16 + 32."""
    fourth = x * x * x * x
    eighth = fourth * fourth
    sixteenth = eighth * eighth
    return fourth * eighth * sixteenth * (sixteenth * sixteenth)


def _step(low: float, high: float, value: float) -> float:
    t = min(max((value - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def _mix(a: Colour, b: Colour, share: float) -> Colour:
    return tuple(p + (q - p) * share for p, q in zip(a, b, strict=True))  # type: ignore[return-value]


def _scaled(colour: Colour, by: float) -> Colour:
    return (colour[0] * by, colour[1] * by, colour[2] * by)
