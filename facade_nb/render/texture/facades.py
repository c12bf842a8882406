"""Façades in space: rectangles that carry a grammar."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..developing import floats
from .grammar import Grammar

__all__ = ["Facade", "box"]

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
