"""Sun and sky at the times of day by which pictures of layouts are asked for. Colours are linear."""

from __future__ import annotations

from collections.abc import Mapping
from math import hypot
from types import MappingProxyType

from ..design.errors import nearest
from .texture.daytime import Colour, Daytime

__all__ = ["TIMES", "find_daylight"]


def _time(
    hour: float, sun: Colour, colour: Colour, sky: Colour, zenith: Colour, horizon: Colour, exposure: float
) -> Daytime:
    """The light of a sun in that direction; what the ground throws back, and what comes into rooms, follows from it."""
    x, y, z = (part / hypot(*sun) for part in sun)
    ground = tuple(0.14 * (y * a + b) for a, b in zip(colour, sky, strict=True))
    indoors = tuple(0.045 * a + 0.10 * b for a, b in zip(colour, sky, strict=True))
    return Daytime(hour, (x, y, z), colour, sky, ground, indoors, 0.0, zenith, horizon, exposure)  # type: ignore[arg-type]


TIMES: Mapping[str, Daytime] = MappingProxyType(
    {
        "morning": _time(9.5, (-0.62, 0.62, 0.8), (3.3, 2.9, 2.35), (0.60, 0.68, 0.86),
                         (0.12, 0.46, 1.30), (1.45, 1.72, 1.95), 0.84),
        "noon": _time(12.5, (-0.3, 1.0, 0.7), (3.5, 3.3, 3.0), (0.58, 0.70, 0.92),
                      (0.08, 0.38, 1.30), (1.30, 1.65, 2.00), 0.82),
        "evening": _time(17.5, (-0.95, 0.36, 0.7), (4.0, 2.55, 1.35), (0.60, 0.58, 0.68),
                         (0.24, 0.44, 1.00), (1.95, 1.46, 1.14), 0.82),
        "overcast": _time(12.0, (-0.3, 1.0, 0.6), (0.5, 0.5, 0.5), (1.25, 1.27, 1.32),
                          (0.90, 0.95, 1.02), (1.40, 1.42, 1.45), 0.95),
    }
)  # fmt: skip
"""The times of day by name; the first is the default."""


def find_daylight(name: str) -> Daytime:
    """The light of that time. Raises ValueError for an unknown one."""
    if name not in TIMES:
        raise ValueError(
            f"time_of_day: expected one of {', '.join(TIMES)}; found {name!r}{nearest(name, TIMES)}"
        )
    return TIMES[name]
