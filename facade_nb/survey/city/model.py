"""What both formats say of a building: surfaces that stand, openings in them; and façades made of these, by plane."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["City", "Facade", "Hole", "Object", "Plane", "Surface", "facades"]

Points = NDArray[np.float64]
"""Corners in space, shape (n, 3), metres, z up."""

_LEAN = 0.5
"""A surface whose unit normal rises or falls by more is a roof or a floor, and no wall."""
_PARALLEL = 0.999
"""Walls whose normals have at least this scalar product, and that lie no further apart, metres, are one façade."""
_APART = 0.1
_LEAST = 1e-6
"""Metres: a shape no larger than this is none."""


@dataclass(slots=True)
class Hole:
    """A window or a door: its kind, name, polygons and place in the file."""

    kind: str
    name: str
    place: str
    polygons: list[Points] = field(default_factory=list)


@dataclass(slots=True)
class Surface:
    """A wall, or another surface with openings in it."""

    name: str
    place: str
    polygons: list[Points] = field(default_factory=list)
    holes: list[Hole] = field(default_factory=list)


@dataclass(slots=True)
class Object:
    """A building, or a part of one: its surfaces, and openings that are in none of them."""

    name: str
    surfaces: list[Surface] = field(default_factory=list)
    loose: list[Hole] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Facade:
    """The openings in one plane of a building.

    Attributes
    ----------
    name, others
        What it is called, and what else it answers to.
    width, height
        Of the walls, metres.
    openings
        As in `Survey`.
    faults
        What is wrong with it, with the place in the file.
    """

    name: str
    others: tuple[str, ...]
    width: float
    height: float
    openings: tuple[Mapping[str, Any], ...]
    faults: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class City:
    """The façades of a city model that have openings, by name."""

    facades: Mapping[str, Facade]
    title: str = ""

    def named(self, name: str) -> Facade | None:
        """The façade of a name; or the only one that answers to it."""
        if name in self.facades:
            return self.facades[name]
        found = [facade for facade in self.facades.values() if name in facade.others]
        return found[0] if len(found) == 1 else None


@dataclass(frozen=True, slots=True)
class Plane:
    """A plane that stands: a point of it, its normal, and what is right and up for who looks at it from outside."""

    origin: Points
    normal: Points
    right: Points
    up: Points

    @classmethod
    def of(cls, polygons: Iterable[Points]) -> Plane | None:
        """The plane of the largest of some polygons; None where they have no area, or lie flat."""
        best, origin = np.zeros(3), np.zeros(3)
        for corners in polygons:
            normal = _area(corners)
            if np.linalg.norm(normal) > np.linalg.norm(best):
                best, origin = normal, corners[0]
        size = float(np.linalg.norm(best))
        if size < _LEAST**2:
            return None
        normal = best / size
        if abs(normal[2]) > _LEAN:
            return None
        up = np.array([0.0, 0.0, 1.0]) - normal[2] * normal
        up /= np.linalg.norm(up)
        return cls(origin, normal, np.cross(up, normal), up)

    def places(self, corners: Points) -> Points:
        """Corners as they are seen: right and up, shape (n, 2)."""
        off = corners - self.origin
        return np.stack([off @ self.right, off @ self.up], axis=1)

    def off(self, other: Plane) -> float:
        """How far another plane is from being this one, whichever way it looks: by its turn first, then metres."""
        turn = 1 - abs(float(self.normal @ other.normal))
        return 1e3 * max(turn - (1 - _PARALLEL), 0.0) + abs(float((other.origin - self.origin) @ self.normal))

    def holds(self, other: Plane) -> bool:
        """Whether another plane is the same for a façade."""
        if float(self.normal @ other.normal) < _PARALLEL:
            return False
        return abs(float((other.origin - self.origin) @ self.normal)) <= _APART


def _area(corners: Points) -> Points:
    """Newell's normal of a polygon, as long as twice its area; counter-clockwise from outside."""
    near = corners - corners[0]
    normal: Points = np.cross(near, np.roll(near, -1, axis=0)).sum(axis=0)
    return normal


def facades(own: Object) -> list[Facade]:
    """The façades of a building that have openings, in the order of its walls."""
    walls: list[tuple[Plane, list[Surface]]] = []
    faults: list[str] = []
    for surface in _surfaces(own):
        plane = Plane.of(surface.polygons or [p for hole in surface.holes for p in hole.polygons])
        if plane is None:
            if surface.holes and not _flat(surface):
                faults.append(
                    f"{surface.place}: expected a surface with an area; its corners are on one line"
                )
            continue
        for known, members in walls:
            if known.holds(plane):
                members.append(surface)
                break
        else:
            walls.append((plane, [surface]))
    found = [_facade(own, plane, members) for plane, members in walls if any(s.holes for s in members)]
    if faults and not found:
        return [Facade(own.name, (), 0.0, 0.0, (), tuple(faults))]
    return _called(own, found, faults)


def _surfaces(own: Object) -> list[Surface]:
    """The surfaces, by plane; an opening that is in none is a surface by itself, of no extent but its own."""
    loose = (Surface("", hole.place, [], [hole]) for hole in own.loose)
    return [*(part for surface in own.surfaces for part in _by_plane(surface)), *loose]


def _by_plane(surface: Surface) -> list[Surface]:
    """A surface that goes around a corner, as one for each plane; an opening is in the plane that it lies in."""
    planes: list[tuple[Plane, Surface]] = []
    for corners in surface.polygons:
        plane = Plane.of([corners])
        if plane is None:
            continue
        part = next((part for known, part in planes if known.holds(plane)), None)
        if part is None:
            part = Surface(surface.name, surface.place)
            planes.append((plane, part))
        part.polygons.append(corners)
    if len(planes) < 2 or not surface.holes:
        return [surface]
    for hole in surface.holes:
        own = Plane.of(hole.polygons)
        near = [(known.off(own), k) for k, (known, _) in enumerate(planes)] if own is not None else []
        planes[min(near)[1] if near else 0][1].holes.append(hole)
    return [part for _, part in planes]


def _flat(surface: Surface) -> bool:
    """Whether a surface has an area, and lies: openings in a roof are none of a façade."""
    return any(np.linalg.norm(_area(corners)) >= _LEAST**2 for corners in surface.polygons)


def _facade(own: Object, plane: Plane, members: Sequence[Surface]) -> Facade:
    holes = [hole for surface in members for hole in surface.holes]
    corners = [plane.places(p) for surface in members for p in surface.polygons]
    faults: list[str] = []
    rects: list[tuple[Hole, Points, Points]] = []
    for hole in holes:
        if not hole.polygons:
            continue  # told where it was read
        seen = np.concatenate([plane.places(p) for p in hole.polygons])
        low, high = seen.min(axis=0), seen.max(axis=0)
        if (high - low).min() < _LEAST:
            faults.append(
                f"{hole.place}: expected an opening with an extent in the plane of its wall, found none"
            )
            continue
        corners.append(seen)
        rects.append((hole, low, high))
    names = tuple(dict.fromkeys(surface.name for surface in members if surface.name and surface.holes))
    if not corners:
        return Facade("", names, 0.0, 0.0, (), tuple(faults))
    every = np.concatenate(corners)
    low, high = every.min(axis=0), every.max(axis=0)
    openings = tuple(
        {
            "kind": hole.kind,
            "rect": [round(float(v), 4) for v in (*(start - low), *(end - low))],
            **({"name": hole.name} if hole.name else {}),
        }
        for hole, start, end in rects
    )
    width, height = (round(float(v), 4) for v in high - low)
    return Facade("", names, width, height, openings, tuple(faults))


def _called(own: Object, found: Sequence[Facade], faults: Sequence[str]) -> list[Facade]:
    """Façades with names: that of the building where it has one façade, else those of walls, or numbers."""
    named = []
    firsts = [facade.others[0] for facade in found if facade.others]
    for number, facade in enumerate(found, 1):
        numbered = f"{own.name}/{number}"
        alone = bool(facade.others) and firsts.count(facade.others[0]) == 1  # a wall around a corner is two
        first = own.name if len(found) == 1 else facade.others[0] if alone else numbered
        others = tuple(dict.fromkeys(o for o in (numbered, *facade.others) if o != first))
        told = (*faults, *facade.faults)
        named.append(Facade(first, others, facade.width, facade.height, facade.openings, told))
    return named
