"""Bodies with plane faces that many recipes are made of: lofts, stones, beams, upright prisms; and moving parts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from math import cos, pi, sin

from .parts import Block, Moulding, Part, Point, Polyhedron, Prism, Ring, Turned

__all__ = ["arc", "beam", "inset", "lofted", "moved", "stone", "upright"]

Spot = tuple[float, float, float]


def lofted(*loops: Sequence[Spot], slot: str = "body") -> Polyhedron:
    """The body between convex loops of equally many corners, the first and the last closed by plane faces.

    Corresponding sides of loops next to each other lie in one plane.
    """
    n, last = len(loops[0]), (len(loops) - 1) * len(loops[0])
    points = tuple(spot for loop in loops for spot in loop)
    faces = [tuple(reversed(range(n))), tuple(range(last, last + n))]
    for k in range(0, last, n):
        faces += [(k + i, k + (i + 1) % n, k + n + (i + 1) % n, k + n + i) for i in range(n)]
    if _volume(points, faces) < 0:
        faces = [face[::-1] for face in faces]
    return Polyhedron(points, tuple(faces), slot)


def _volume(points: Sequence[Spot], faces: Iterable[Sequence[int]]) -> float:
    """Six times the volume; positive where faces are counter-clockwise seen from outside."""
    ox, oy, oz = points[0]
    total = 0.0
    for face in faces:
        a = points[face[0]]
        for j in range(1, len(face) - 1):
            b, c = points[face[j]], points[face[j + 1]]
            ax, ay, az = a[0] - ox, a[1] - oy, a[2] - oz
            bx, by, bz = b[0] - ox, b[1] - oy, b[2] - oz
            cx, cy, cz = c[0] - ox, c[1] - oy, c[2] - oz
            total += ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)
    return total


def stone(
    x0: float, y0: float, x1: float, y1: float, z0: float, z1: float, bevel: float, slot: str = "body"
) -> Polyhedron:
    """A block whose front edges are bevelled."""

    def loop(z: float, by: float) -> tuple[Spot, ...]:
        return ((x0 + by, y0 + by, z), (x1 - by, y0 + by, z), (x1 - by, y1 - by, z), (x0 + by, y1 - by, z))

    return lofted(loop(z0, 0.0), loop(z1 - bevel, 0.0), loop(z1, bevel), slot=slot)


def upright(
    plan: Sequence[Point], y0: float, y1: float, slot: str = "body", top: Sequence[Point] | None = None
) -> Polyhedron:
    """A convex plan (x, z) from one height to another, where it may have become the plan `top`."""
    return lofted(
        [(x, y0, z) for x, z in plan], [(x, y1, z) for x, z in (plan if top is None else top)], slot=slot
    )


def inset(plan: Sequence[Point], about: Point, across: float, deep: float) -> tuple[Point, ...]:
    """A plan drawn in towards a place, by a factor in each direction."""
    cx, cz = about
    return tuple((cx + (x - cx) * across, cz + (z - cz) * deep) for x, z in plan)


def beam(start: Spot, end: Spot, thick: float, slot: str = "body", flat: str = "y") -> Polyhedron:
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


def moved(parts: Iterable[Part], x: float, y: float, z: float) -> Iterator[Part]:
    """Parts moved by so many metres."""
    for part in parts:
        match part:
            case Block() | Ring():
                yield replace(
                    part, x0=part.x0 + x, y0=part.y0 + y, x1=part.x1 + x, y1=part.y1 + y,
                    z0=part.z0 + z, z1=part.z1 + z,
                )  # fmt: skip
            case Prism():
                points = tuple((px + x, py + y) for px, py in part.points)
                yield replace(part, points=points, z0=part.z0 + z, z1=part.z1 + z)
            case Moulding():
                profile = tuple((py + y, pz + z) for py, pz in part.profile)
                yield replace(part, x0=part.x0 + x, x1=part.x1 + x, profile=profile, z0=part.z0 + z)
            case Turned():
                profile = tuple((py + y, r) for py, r in part.profile)
                yield replace(part, cx=part.cx + x, cz=part.cz + z, profile=profile)
            case Polyhedron():
                yield replace(part, points=tuple((px + x, py + y, pz + z) for px, py, pz in part.points))
