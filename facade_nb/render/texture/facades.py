"""Façades in space: rectangles that carry a grammar, and which of them a ray meets first."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..daylight import floats
from .grammar import Grammar

__all__ = ["Facade", "Hits", "box", "meet", "sees", "stretches"]

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
        (a, b, c), (d, e, f) = self.right, self.up
        return floats([self.right, self.up, (b * f - c * e, c * d - a * f, a * e - b * d)])


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
    """The first façade that rays (n, 3) from an eye (3,) meet from its front; `beyond`: farther away than (n,).

    Rays are looked at in stretches, each with those façades alone that it may meet: neighbours should stand together.
    """
    count = len(rays)
    found = np.full(count, -1, np.int32)
    nearest = np.full(count, np.inf, np.float32)
    places = np.zeros((count, 2), np.float32)
    fronts = [k for k, one in enumerate(facades) if _before(one, eye) > 0]
    pyramids = np.array([_pyramid(facades[k], eye) for k in fronts], np.float64).reshape(-1, 4, 3)
    for part in stretches(count):
        own = rays[part]
        middle, half = _bounds(own)
        may = (pyramids @ middle + np.abs(pyramids) @ half >= -1e-6).all(axis=1)
        limit = None if beyond is None else beyond[part]
        for k in np.flatnonzero(may):
            _meet_one(facades, fronts[k], eye, own, limit, found[part], nearest[part], places[part])
    return Hits(found, nearest, places)


def _meet_one(
    facades: Sequence[Facade],
    index: int,
    eye: Floats,
    rays: Floats,
    beyond: Floats | None,
    found: NDArray[np.int32],
    nearest: Floats,
    places: Floats,
) -> None:
    """Note where rays meet a façade nearer than what they have met so far."""
    facade = facades[index]
    axes = facade.axes
    from_corner = np.asarray(eye, np.float32) - floats(facade.origin)
    into = rays @ axes[2]
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.where(into < 0, -_before(facade, eye) / into, np.inf)
    near = np.flatnonzero((t < nearest) if beyond is None else (t < nearest) & (t > beyond))
    x = from_corner @ axes[0] + t[near] * (rays[near] @ axes[0])
    y = from_corner @ axes[1] + t[near] * (rays[near] @ axes[1])
    inside = (x >= 0) & (x < facade.size[0]) & (y >= 0) & (y < facade.size[1])
    hit = near[inside]
    found[hit], nearest[hit] = index, t[hit]
    places[hit, 0], places[hit, 1] = x[inside], y[inside]


def _before(facade: Facade, eye: Floats) -> float:
    """How far the eye is in front of a façade, metres."""
    return float((np.asarray(eye, np.float32) - floats(facade.origin)) @ facade.axes[2])


def _pyramid(facade: Facade, eye: Floats) -> NDArray[np.float64]:
    """Inward normals (4, 3) of the planes through an eye and the edges of a façade."""
    right, up, _ = facade.axes.astype(np.float64)
    foot = np.array(facade.origin, np.float64) - np.asarray(eye, np.float64)
    wide, tall = right * facade.size[0], up * facade.size[1]
    corners = np.array([foot, foot + wide, foot + wide + tall, foot + tall])
    normals = np.cross(corners, np.roll(corners, -1, axis=0))
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    inward: NDArray[np.float64] = normals * np.sign(normals @ corners.mean(axis=0))[:, None]
    return inward


def sees(
    facades: Sequence[Facade], points: Floats, towards: Floats, skip: NDArray[np.int32] | None = None
) -> NDArray[np.bool_]:
    """Whether nothing stands between points (n, 3) and a light in a direction (3,); `skip`: each point's own façade.

    As `meet`, it looks at stretches of points, and at the façades that may shade them.
    """
    free = np.ones(len(points), bool)
    casting = [k for k, one in enumerate(facades) if abs(float(towards @ one.axes[2])) >= 1e-6]
    if not casting:
        return free
    slopes, starts = (np.stack(v) for v in zip(*(_cast(facades[k], towards) for k in casting), strict=True))
    sizes = np.array([facades[k].size for k in casting])
    for part in stretches(len(points)):
        own, open_ = points[part], free[part]
        middle, half = _bounds(own)
        # The way to each façade's plane, and where on it, for all points between their bounds.
        least, most = (slopes @ middle + starts + sign * (np.abs(slopes) @ half) for sign in (-1, 1))
        may = (most > (1e-3, -1e-3, -1e-3)).all(axis=1) & (least[:, 1:] < sizes + 1e-3).all(axis=1)
        for k in np.flatnonzero(may):
            t, x, y = (own @ slopes[k].T.astype(np.float32) + starts[k].astype(np.float32)).T
            blocked = (t > 1e-3) & (x > 0) & (x < sizes[k, 0]) & (y > 0) & (y < sizes[k, 1])
            if skip is not None:
                blocked &= skip[part] != casting[k]
            open_ &= ~blocked
    return free


def _cast(facade: Facade, towards: Floats) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """How far a point is from a façade's plane towards a light, and where on it (x, y): slopes (3, 3), starts (3,)."""
    right, up, out = facade.axes.astype(np.float64)
    light = towards.astype(np.float64)
    away = -out / (light @ out)
    slopes = np.stack([away, right + away * (light @ right), up + away * (light @ up)])
    return slopes, -slopes @ np.array(facade.origin, np.float64)


STRETCH = 4096
"""How many neighbours are looked at together."""


def stretches(count: int) -> Iterator[slice]:
    """Consecutive parts of `count` points."""
    for first in range(0, count, STRETCH):
        yield slice(first, min(first + STRETCH, count))


def _bounds(values: Floats) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Middle and half size (3,) of the box around values (n, 3)."""
    low, high = values.min(axis=0).astype(np.float64), values.max(axis=0).astype(np.float64)
    return (low + high) / 2, (high - low) / 2


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
        Of all of them: what the first scope chooses, such as the wall, is one choice for the house.
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
        found.append(
            Facade(grammar, (wide, height), _vector(corner), _vector(along), _vector(up), seed, sides[k])
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
