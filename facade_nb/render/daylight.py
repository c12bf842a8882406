"""Sun and sky at a few times of the day. Colours are linear RGB."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from ..design.errors import nearest

__all__ = ["TIMES", "Daylight", "find_daylight", "floats"]

Colour = tuple[float, float, float]


def floats(values: object) -> NDArray[np.float32]:
    """An array of single precision."""
    return np.asarray(values, np.float32)


@dataclass(frozen=True, slots=True)
class Daylight:
    """The light of one time of day.

    Attributes
    ----------
    sun
        Direction towards the sun: x right, y up, z towards the viewer.
    sun_colour
        Of its light, with its strength.
    zenith, horizon
        Of the sky as it lights the scene and shows in glass.
    backdrop
        Of the sky behind the building, at the top and at the horizon, as shown (sRGB 0 to 1).
    exposure
        Of the picture.
    """

    sun: Colour
    sun_colour: Colour
    zenith: Colour
    horizon: Colour
    backdrop: tuple[Colour, Colour]
    exposure: float = 1.0

    @property
    def towards(self) -> NDArray[np.float64]:
        """Unit vector towards the sun."""
        vector = np.array(self.sun)
        return vector / np.linalg.norm(vector)

    def sky(self, up: NDArray[np.float32]) -> NDArray[np.float32]:
        """Radiance (n, 3) of the sky at sines of elevation `up` (n,), 0 at the horizon to 1 overhead."""
        share = np.clip(up, 0, 1)[:, None] ** 0.5
        low, high = floats(self.horizon), floats(self.zenith)
        return low + (high - low) * share


TIMES: Mapping[str, Daylight] = MappingProxyType(
    {
        "morning": Daylight(
            (-0.62, 0.62, 0.8), (3.3, 2.9, 2.35), (0.36, 0.52, 0.84), (0.86, 0.88, 0.9),
            ((0.60, 0.735, 0.87), (0.925, 0.935, 0.925)), 0.92,
        ),
        "noon": Daylight(
            (-0.3, 1.0, 0.7), (3.5, 3.3, 3.0), (0.34, 0.52, 0.9), (0.85, 0.9, 0.95),
            ((0.50, 0.69, 0.88), (0.91, 0.94, 0.95)), 0.9,
        ),
        "evening": Daylight(
            (-0.95, 0.36, 0.7), (4.0, 2.55, 1.35), (0.34, 0.42, 0.7), (1.0, 0.78, 0.6),
            ((0.56, 0.64, 0.80), (0.985, 0.88, 0.775)), 0.92,
        ),
        "overcast": Daylight(
            (-0.3, 1.0, 0.6), (0.5, 0.5, 0.5), (1.0, 1.03, 1.08), (0.85, 0.86, 0.88),
            ((0.80, 0.83, 0.86), (0.93, 0.935, 0.94)), 1.0,
        ),
    }
)  # fmt: skip
"""The times of day by name; the first is the default."""


def find_daylight(name: str) -> Daylight:
    """The light of that time. Raises ValueError for an unknown one."""
    if name not in TIMES:
        raise ValueError(
            f"time_of_day: expected one of {', '.join(TIMES)}; found {name!r}{nearest(name, TIMES)}"
        )
    return TIMES[name]
