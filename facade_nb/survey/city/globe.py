"""Coordinates in degrees, as some cities publish them, laid flat around each building."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from .model import Object, Points

__all__ = ["Globe", "in_degrees"]

_DEGREES = re.compile(
    r"(?<!\d)(4326|4979|4258|4937|4269|6318|6319|4612|6668|6697|7423|4617|4283|7844)(?!\d)|CRS84"
)
"""Codes of EPSG: WGS 84, ETRS89, NAD83, JGD, GDA, alone or with a height, and OGC's own name."""

_AXIS, _SQUARED = 6378137.0, 0.00669438
"""Of the ellipsoid: half its long axis, metres, and its eccentricity squared; that of GRS 80 and WGS 84."""


def in_degrees(name: str) -> bool:
    """Whether the name of a coordinate system says that it is in degrees."""
    return bool(_DEGREES.search(name))


@dataclass(frozen=True, slots=True)
class Globe:
    """Which of the first two coordinates is the latitude."""

    latitude: int

    @classmethod
    def of(cls, name: str) -> Globe | None:
        """By the name of a coordinate system; None where that leaves the order open, as ``EPSG:4326`` does."""
        if "CRS84" in name:
            return cls(1)
        return cls(0) if name.startswith(("urn:ogc:def:crs", "http")) else None

    def flatten(self, own: Object) -> None:
        """A building's corners in metres, east and north of its first one. On that scale the earth is flat."""
        holes = [*own.loose, *(hole for surface in own.surfaces for hole in surface.holes)]
        lists = [*(one.polygons for one in own.surfaces), *(one.polygons for one in holes)]
        first = next((corners[0] for polygons in lists for corners in polygons), None)
        if first is None:
            return
        for polygons in lists:
            polygons[:] = [self._flat(corners, first) for corners in polygons]

    def _flat(self, corners: Points, first: Points) -> Points:
        latitude = np.radians(first[self.latitude])
        bent = 1 - _SQUARED * np.sin(latitude) ** 2
        off = np.radians(corners - first)
        north = off[:, self.latitude] * _AXIS * (1 - _SQUARED) / bent**1.5
        east = off[:, 1 - self.latitude] * _AXIS / bent**0.5 * np.cos(latitude)
        flat: Points = np.stack([east, north, corners[:, 2]], axis=1)
        return flat
