"""Parts: the few simple bodies that every geometry is put together from.

A part lives in the frame of its shape: x to the right and y up from the shape's lower left corner, z towards the
viewer from the shape's face, all in metres. The elevation draws parts and the mesh is built from them, so the two
agree. `slot` says which of the shape's materials a part has (see `geometry`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import chain

__all__ = [
    "Block",
    "Loft",
    "Moulding",
    "Part",
    "Point",
    "Polyhedron",
    "Prism",
    "Ring",
    "Spot",
    "Turned",
    "back",
    "flip",
    "front",
    "moved",
    "outline",
]

Point = tuple[float, float]
Spot = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Block:
    """A box from (x0, y0, z0) to (x1, y1, z1)."""

    x0: float
    y0: float
    x1: float
    y1: float
    z0: float
    z1: float
    slot: str = "body"


@dataclass(frozen=True, slots=True)
class Ring:
    """A rectangular frame of the given width inside the rectangle x0, y0, x1, y1."""

    x0: float
    y0: float
    x1: float
    y1: float
    width: float
    z0: float
    z1: float
    slot: str = "body"


@dataclass(frozen=True, slots=True)
class Prism:
    """A simple polygon (counter-clockwise as the viewer sees it) extruded from z0 to z1."""

    points: tuple[Point, ...]
    z0: float
    z1: float
    slot: str = "body"


@dataclass(frozen=True, slots=True)
class Moulding:
    """A profile extruded from x0 to x1: `profile` lists (y, z) of its front from bottom to top; z0 is its flat back."""

    x0: float
    x1: float
    profile: tuple[Point, ...]
    z0: float
    slot: str = "body"


@dataclass(frozen=True, slots=True)
class Turned:
    """A body of revolution about the vertical axis through (cx, cz): `profile` lists (y, radius), bottom to top."""

    cx: float
    cz: float
    profile: tuple[Point, ...]
    slot: str = "body"


@dataclass(frozen=True, slots=True)
class Loft:
    """The body between convex loops of equally many corners (x, y, z), from each to the next; its ends are plane.

    A `round` one stands for a body with curved sides, and is shaded so.
    """

    loops: tuple[tuple[Spot, ...], ...]
    slot: str = "body"
    round: bool = False

    @property
    def points(self) -> tuple[Spot, ...]:
        """The corners of all loops."""
        return tuple(chain.from_iterable(self.loops))

    @property
    def faces(self) -> tuple[tuple[int, ...], ...]:
        """Its ends and sides, as those of a polyhedron: a side whose corners lie in no plane counts as one."""
        n, last = len(self.loops[0]), (len(self.loops) - 1) * len(self.loops[0])
        found = [tuple(reversed(range(n))), tuple(range(last, last + n))]
        for k in range(0, last, n):
            found += [(k + i, k + (i + 1) % n, k + n + (i + 1) % n, k + n + i) for i in range(n)]
        return tuple(found) if self._rises() else tuple(face[::-1] for face in found)

    def _rises(self) -> bool:
        """Whether the first loop runs counter-clockwise as seen from the last."""
        first, last = self.loops[0], self.loops[-1]
        ahead = [sum(p[k] for p in last) - sum(p[k] for p in first) for k in range(3)]
        (a, b), total = first[:2], 0.0
        for c in first[2:]:
            u, v = ([q[k] - a[k] for k in range(3)] for q in (b, c))
            total += sum(ahead[k] * (u[k - 2] * v[k - 1] - u[k - 1] * v[k - 2]) for k in range(3))
            b = c
        return total > 0


@dataclass(frozen=True, slots=True)
class Polyhedron:
    """Any closed body with plane faces: `faces` index `points` (x, y, z), counter-clockwise seen from outside."""

    points: tuple[Spot, ...]
    faces: tuple[tuple[int, ...], ...]
    slot: str = "body"


Part = Block | Ring | Prism | Moulding | Turned | Loft | Polyhedron


def front(part: Part) -> float:
    """How far the part comes towards the viewer, in metres from the shape's face."""
    match part:
        case Moulding():
            return max(z for _, z in part.profile)
        case Turned():
            return part.cz + max(radius for _, radius in part.profile)
        case Loft() | Polyhedron():
            return max(z for _, _, z in part.points)
        case _:
            return part.z1


def back(part: Part) -> float:
    """How far the part goes back from the shape's face: its least z, in metres."""
    match part:
        case Turned():
            return part.cz - max(radius for _, radius in part.profile)
        case Loft() | Polyhedron():
            return min(z for _, _, z in part.points)
        case _:
            return part.z0


def outline(part: Part) -> tuple[Point, ...]:
    """The part's outline as the viewer sees it, counter-clockwise; of a polyhedron, its bounding rectangle."""
    match part:
        case Prism():
            return part.points
        case Turned():
            right = [(part.cx + radius, y) for y, radius in part.profile]
            left = [(part.cx - radius, y) for y, radius in reversed(part.profile)]
            return (*right, *left)
        case Moulding():
            ys = [y for y, _ in part.profile]
            x0, y0, x1, y1 = part.x0, min(ys), part.x1, max(ys)
        case Loft() | Polyhedron():
            xs, heights = [x for x, _, _ in part.points], [y for _, y, _ in part.points]
            x0, y0, x1, y1 = min(xs), min(heights), max(xs), max(heights)
        case _:
            x0, y0, x1, y1 = part.x0, part.y0, part.x1, part.y1
    return ((x0, y0), (x1, y0), (x1, y1), (x0, y1))


def flip(
    parts: tuple[Part, ...], width: float, height: float, mirrored: tuple[bool, bool]
) -> tuple[Part, ...]:
    """The parts of a shape mirrored left to right, upside down, or both."""
    if not any(mirrored):
        return parts
    return tuple(_flipped(parts, width, height, mirrored))


def _flipped(parts: tuple[Part, ...], w: float, h: float, mirrored: tuple[bool, bool]) -> Iterator[Part]:
    across, down = mirrored

    def at(x: float, y: float) -> Point:
        return (w - x if across else x, h - y if down else y)

    odd = across != down  # an odd number of reflections turns counter-clockwise into clockwise
    for part in parts:
        match part:
            case Block() | Ring():
                (xa, ya), (xb, yb) = at(part.x0, part.y0), at(part.x1, part.y1)
                yield replace(part, x0=min(xa, xb), y0=min(ya, yb), x1=max(xa, xb), y1=max(ya, yb))
            case Prism():
                moved = tuple(at(x, y) for x, y in part.points)
                yield replace(part, points=moved[::-1] if odd else moved)
            case Moulding():
                x0, x1 = (w - part.x1, w - part.x0) if across else (part.x0, part.x1)
                profile = tuple((h - y, z) for y, z in reversed(part.profile)) if down else part.profile
                yield replace(part, x0=x0, x1=x1, profile=profile)
            case Turned():
                profile = tuple((h - y, r) for y, r in reversed(part.profile)) if down else part.profile
                yield replace(part, cx=w - part.cx if across else part.cx, profile=profile)
            case Loft():
                loops = tuple(tuple((*at(x, y), z) for x, y, z in loop) for loop in part.loops)
                yield replace(part, loops=loops)
            case Polyhedron():
                points = tuple((*at(x, y), z) for x, y, z in part.points)
                yield replace(
                    part, points=points, faces=tuple(f[::-1] for f in part.faces) if odd else part.faces
                )


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
            case Loft():
                loops = tuple(tuple((px + x, py + y, pz + z) for px, py, pz in loop) for loop in part.loops)
                yield replace(part, loops=loops)
            case Polyhedron():
                yield replace(part, points=tuple((px + x, py + y, pz + z) for px, py, pz in part.points))
