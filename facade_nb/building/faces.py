"""Faces: what stands around a building, wall by wall and cut corner by cut corner, as one walks around it."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, pi

from .model import Building, Corner, Point

__all__ = ["Face", "faces", "turn"]


@dataclass(frozen=True, slots=True)
class Face:
    """One façade in plan.

    Attributes
    ----------
    name
        ``wall 1`` or ``corner 1``, numbered from 1.
    design
        The name of its design; None: blind.
    start, end
        Where its left and its right end stand in plan, seen from outside.
    turns
        By how much the way around the building turns at both ends, radians: positive at an outer corner.
    quoins
        The quoins at both ends, each with the number of its corner.
    """

    name: str
    design: str | None
    start: Point
    end: Point
    turns: tuple[float, float] = (0.0, 0.0)
    quoins: tuple[tuple[int, Corner] | None, tuple[int, Corner] | None] = (None, None)

    @property
    def length(self) -> float:
        """Metres."""
        return hypot(self.end[0] - self.start[0], self.end[1] - self.start[1])

    @property
    def way(self) -> Point:
        """The unit vector from its left end to its right one, in plan."""
        return (self.end[0] - self.start[0]) / self.length, (self.end[1] - self.start[1]) / self.length


def turn(before: Point, at: Point, after: Point) -> float:
    """By how much a way turns at a point, radians; to the left is positive."""
    a, b = (at[0] - before[0], at[1] - before[1]), (after[0] - at[0], after[1] - at[1])
    angle = atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])
    return 0.0 if abs(angle) < 1e-9 else angle


def width_of(building: Building, corner: Corner) -> float:
    """How wide a corner's treatment is, metres."""
    return corner.width if corner.width is not None else building.designs[corner.design].canvas.width


def cut(building: Building, number: int) -> float:
    """How much a chamfer takes off each of the two walls at a corner, metres; 0 where there is none."""
    corner = building.corners.get(number)
    if corner is None or corner.kind != "chamfer":
        return 0.0
    plan, count = building.plan, len(building.plan)
    angle = turn(plan[number - 1], plan[number], plan[(number + 1) % count])
    return width_of(building, corner) / (2 * max(cos(angle / 2), 1e-6)) if angle < pi else 0.0


def faces(building: Building) -> tuple[Face, ...]:
    """All of them, from wall 1 on; a cut corner comes before the wall that begins at it."""
    plan, count = building.plan, len(building.plan)
    found: list[tuple[str, str | None, Point, Point, int | None, int | None]] = []
    for k in range(count):
        corner, following = building.corners.get(k), (k + 1) % count
        a, b = plan[k], plan[following]
        long = hypot(b[0] - a[0], b[1] - a[1])
        way = (b[0] - a[0]) / long, (b[1] - a[1]) / long
        near, far = cut(building, k), long - cut(building, following)
        start = (a[0] + way[0] * near, a[1] + way[1] * near)
        end = (a[0] + way[0] * far, a[1] + way[1] * far) if far < long else b
        if corner is not None and corner.kind == "chamfer":
            c = plan[k - 1]
            back = hypot(c[0] - a[0], c[1] - a[1])
            foot = (a[0] + (c[0] - a[0]) / back * near, a[1] + (c[1] - a[1]) / back * near)
            found.append((f"corner {k + 1}", corner.design, foot, start, None, None))
        found.append((f"wall {k + 1}", building.walls[k], start, end, k, following))
    made = []
    for n, (name, design, start, end, first, last) in enumerate(found):
        before, after = found[n - 1], found[(n + 1) % len(found)]
        turns = turn(before[2], start, end), turn(start, end, after[3])
        made.append(
            Face(name, design, start, end, turns, (_quoins(building, first), _quoins(building, last)))
        )
    return tuple(made)


def _quoins(building: Building, number: int | None) -> tuple[int, Corner] | None:
    corner = None if number is None else building.corners.get(number)
    return (number, corner) if number is not None and corner is not None and corner.kind == "quoins" else None
