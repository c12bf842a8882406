"""Longitude and latitude to metres about a place: the transverse Mercator projection with that place's meridian.

Within 20 km of the place, ways from it are true to two centimetres, but for the projection's own scale. Sines and
cosines are summed up here: those of the processor's library differ in the last bit from machine to machine.
"""

from __future__ import annotations

import numpy as np

from .chance import Floats

__all__ = ["to_metres"]

_AXIS, _FLATTENING = 6378137.0, 1 / 298.257223563  # WGS 84
_EE = _FLATTENING * (2 - _FLATTENING)
_DEGREE = 3.141592653589793 / 180


def to_metres(places: Floats, centre: tuple[float, float]) -> Floats:
    """East and north (n, 2) in metres of longitudes and latitudes (n, 2) in degrees, about such a centre."""
    turned = (places[:, 0] - centre[0] + 540) % 360 - 180
    away = (places[:, 1] - centre[1]) * _DEGREE
    lon = turned * _DEGREE
    sin0, cos0 = (float(v[0]) for v in _sine_cosine(np.array([centre[1] * _DEGREE])))

    def at(delta: Floats) -> tuple[Floats, Floats]:
        s, c = _sine_cosine(delta)
        return sin0 * c + cos0 * s, cos0 * c - sin0 * s

    # The meridian's arc, by Gauss' rule with three knots.
    arc = np.zeros(len(away))
    for knot, weight in ((-0.7745966692414834, 5 / 18), (0.0, 8 / 18), (0.7745966692414834, 5 / 18)):
        s, _ = at(away * ((1 + knot) / 2))
        w = 1 - _EE * s * s
        arc = arc + weight * _AXIS * (1 - _EE) / (w * np.sqrt(w))
    s, c = at(away)
    across = _AXIS / np.sqrt(1 - _EE * s * s)
    c = np.maximum(c, 1e-9)
    t2, n2 = s * s / (c * c), _EE / (1 - _EE) * c * c
    a = lon * c
    a2 = a * a
    east = across * a * (1 + a2 / 6 * (1 - t2 + n2 + a2 / 20 * (5 - 18 * t2 + t2 * t2)))
    north = away * arc + across * s * c * lon * lon / 2 * (1 + a2 / 12 * (5 - t2 + 9 * n2))
    return np.stack([east, north], axis=1)


def _sine_cosine(angle: Floats) -> tuple[Floats, Floats]:
    """By their series, up to a right angle."""
    square = angle * angle
    sine, cosine = np.zeros(len(angle)), np.zeros(len(angle))
    for k in range(13, -1, -1):
        cosine = 1 - cosine * square / ((2 * k + 1) * (2 * k + 2))
        sine = 1 - sine * square / ((2 * k + 2) * (2 * k + 3))
    return angle * sine, cosine
