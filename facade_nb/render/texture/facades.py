"""Façades in space: rectangles that carry a grammar, and which of them a ray meets first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..daylight import floats
from .grammar import Grammar

__all__ = ["Facade", "Hits", "box", "meet", "sees"]

Floats = NDArray[np.float32]
Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Facade:
    """A rectangle in space with a grammar on it. It is seen from its front.

    Attributes
    ----------
    grammar
        What is on it.
    size
        Width and height, metres.
    origin
        Its lower left corner, seen from the front.
    right, up
        Unit vectors along its width and its height.
    seed
        Of the façade.
    start
        The rule to begin with; None: S, else the first.
    """

    grammar: Grammar
    size: tuple[float, float]
    origin: Vector = (0.0, 0.0, 0.0)
    right: Vector = (1.0, 0.0, 0.0)
    up: Vector = (0.0, 1.0, 0.0)
    seed: tuple[float, float] = (0.0, 0.0)
    start: str | None = None

    @property
    def axes(self) -> Floats:
        """Right, up and outward, as rows (3, 3)."""
        right, up = floats(self.right), floats(self.up)
        return np.stack([right, up, np.cross(right, up)])


@dataclass(frozen=True, slots=True, eq=False)
class Hits:
    """What n rays meet.

    Attributes
    ----------
    facade
        (n,) which façade; -1: none.
    distance
        (n,) in lengths of the ray; infinite where there is none.
    places
        (n, 2) metres from the façade's lower left corner.
    """

    facade: NDArray[np.int32]
    distance: Floats
    places: Floats


def meet(facades: Sequence[Facade], eye: Floats, rays: Floats, beyond: Floats | None = None) -> Hits:
    """The first façade that rays (n, 3) from an eye (3,) meet from its front; `beyond`: farther away than (n,)."""
    count = len(rays)
    found = np.full(count, -1, np.int32)
    nearest = np.full(count, np.inf, np.float32)
    places = np.zeros((count, 2), np.float32)
    for index, facade in enumerate(facades):
        axes = facade.axes
        from_corner = np.asarray(eye, np.float32) - floats(facade.origin)
        before = float(from_corner @ axes[2])
        if before <= 0:
            continue
        into = rays @ axes[2]
        with np.errstate(divide="ignore", invalid="ignore"):
            t = np.where(into < 0, -before / into, np.inf)
        near = np.flatnonzero((t < nearest) if beyond is None else (t < nearest) & (t > beyond))
        x = from_corner @ axes[0] + t[near] * (rays[near] @ axes[0])
        y = from_corner @ axes[1] + t[near] * (rays[near] @ axes[1])
        inside = (x >= 0) & (x < facade.size[0]) & (y >= 0) & (y < facade.size[1])
        hit = near[inside]
        found[hit], nearest[hit] = index, t[hit]
        places[hit, 0], places[hit, 1] = x[inside], y[inside]
    return Hits(found, nearest, places)


def sees(
    facades: Sequence[Facade], points: Floats, towards: Floats, skip: NDArray[np.int32] | None = None
) -> NDArray[np.bool_]:
    """Whether nothing stands between points (n, 3) and a light in a direction (3,); `skip`: each point's own façade."""
    free = np.ones(len(points), bool)
    for index, facade in enumerate(facades):
        axes = facade.axes
        rise = float(towards @ axes[2])
        if abs(rise) < 1e-6:
            continue
        local = (points - floats(facade.origin)) @ axes.T
        t = -local[:, 2] / rise
        x, y = local[:, 0] + t * float(towards @ axes[0]), local[:, 1] + t * float(towards @ axes[1])
        blocked = (t > 1e-3) & (x > 0) & (x < facade.size[0]) & (y > 0) & (y < facade.size[1])
        if skip is not None:
            blocked &= skip != index
        free &= ~blocked
    return free


def box(
    grammar: Grammar,
    width: float,
    height: float,
    depth: float,
    *,
    at: tuple[float, float] = (0.0, 0.0),
    turn: float = 0.0,
    seed: tuple[float, float] = (0.0, 0.0),
    roof: float = 0.0,
    side: str | None = None,
    gable: str | None = None,
    cover: str | None = None,
) -> list[Facade]:
    """The four façades of a house, and a pitched roof whose ridge runs along the front.

    Parameters
    ----------
    grammar
        Of all of them.
    width, height, depth
        Metres.
    at
        Where the middle of its front stands, x and z.
    turn
        Degrees to the left, seen from above.
    seed
        Of the front; each further façade adds 17 m.
    roof
        Height of the ridge above the eaves; 0: none.
    side, gable, cover
        Start rules of the sides, of the gables (a rectangle around each; None: no gable) and of the roof.
    """
    angle = np.deg2rad(turn)
    right = np.array([np.cos(angle), 0.0, -np.sin(angle)])
    out = np.array([np.sin(angle), 0.0, np.cos(angle)])
    up = np.array([0.0, 1.0, 0.0])
    middle = np.array([at[0], 0.0, at[1]])
    left = middle - right * width / 2
    corners = (left, left + right * width, left + right * width - out * depth, left - out * depth)
    sides = {0: None, 1: side, 2: None, 3: side}
    found = []
    for k, (corner, along, wide) in enumerate(
        zip(corners, (right, -out, -right, out), (width, depth, width, depth), strict=True)
    ):
        shifted = (seed[0] + 17 * k, seed[1])
        found.append(
            Facade(grammar, (wide, height), _vector(corner), _vector(along), _vector(up), shifted, sides[k])
        )
        if gable is not None and roof > 0 and k % 2:
            foot = _vector(corner + up * height)
            found.append(Facade(grammar, (wide, roof), foot, _vector(along), _vector(up), seed, gable))
    if roof > 0:
        slope = float(np.hypot(roof, depth / 2))
        for corner, along, inward in ((corners[0], right, -out), (corners[2], -right, out)):
            rising = _vector((inward * depth / 2 + up * roof) / slope)
            foot = _vector(corner + up * height)
            found.append(Facade(grammar, (width, slope), foot, _vector(along), rising, seed, cover))
    return found


def _vector(values: NDArray[np.float64]) -> Vector:
    x, y, z = (float(value) for value in values)
    return x, y, z
