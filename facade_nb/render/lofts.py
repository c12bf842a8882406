"""Lofts that many recipes are made of: stones, beams, upright plans; and arcs."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, pi, sin

from .parts import Loft, Point, Spot

__all__ = ["arc", "beam", "inset", "lofted", "stone", "upright"]


def lofted(*loops: Sequence[Spot], slot: str = "body", round: bool = False) -> Loft:
    """The body between convex loops."""
    return Loft(tuple(map(tuple, loops)), slot, round)


def stone(
    x0: float, y0: float, x1: float, y1: float, z0: float, z1: float, bevel: float, slot: str = "body"
) -> Loft:
    """A block whose front edges are bevelled."""

    def loop(z: float, by: float) -> tuple[Spot, ...]:
        return ((x0 + by, y0 + by, z), (x1 - by, y0 + by, z), (x1 - by, y1 - by, z), (x0 + by, y1 - by, z))

    return lofted(loop(z0, 0.0), loop(z1 - bevel, 0.0), loop(z1, bevel), slot=slot)


def upright(
    plan: Sequence[Point], y0: float, y1: float, slot: str = "body", top: Sequence[Point] | None = None
) -> Loft:
    """A convex plan (x, z) from one height to another, where it may have become the plan `top`."""
    return lofted(
        [(x, y0, z) for x, z in plan], [(x, y1, z) for x, z in (plan if top is None else top)], slot=slot
    )


def inset(plan: Sequence[Point], about: Point, across: float, deep: float) -> tuple[Point, ...]:
    """A plan drawn in towards a place, by a factor in each direction."""
    cx, cz = about
    return tuple((cx + (x - cx) * across, cz + (z - cz) * deep) for x, z in plan)


def beam(start: Spot, end: Spot, thick: float, slot: str = "body", flat: str = "y") -> Loft:
    """A square bar from one place to another, its ends level (`flat` "y") or upright in the façade's plane ("z")."""
    half = thick / 2
    ways = ((-half, -half), (half, -half), (half, half), (-half, half))

    def loop(at: Spot) -> tuple[Spot, ...]:
        x, y, z = at
        return tuple((x + p, y, z + q) if flat == "y" else (x + p, y + q, z) for p, q in ways)

    return lofted(loop(start), loop(end), slot=slot)


def arc(cx: float, cy: float, rx: float, ry: float, steps: int = 20) -> tuple[Point, ...]:
    """Half an ellipse from its right end over the top to its left end."""
    return tuple((cx + rx * cos(pi * i / steps), cy + ry * sin(pi * i / steps)) for i in range(steps + 1))
