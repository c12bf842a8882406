"""A building with another plan, other corners or another wall's design: what an editor of buildings changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Literal

from ..design.model import Design
from .model import Building, Corner, Point, Treatment
from .treatments import chamfer, quoins

__all__ = ["PLANS", "PlanKind", "plan_of", "reshaped", "treated", "walled"]

PlanKind = Literal["rectangle", "ell", "row", "other"]
PLANS: tuple[PlanKind, ...] = ("rectangle", "ell", "row")

_NEAR = 1e-6
_ROLES = {
    "rectangle": ("front", "right", "back", "left"),
    "ell": ("front", "right", "yard", "wing", "back", "left"),
}


def plan_of(building: Building) -> tuple[PlanKind, dict[str, float]]:
    """Which plan a building has, and the lengths that make it, metres: those that `reshaped` takes."""
    x0, y0 = building.plan[0]
    plan = [(x - x0, y - y0) for x, y in building.plan]
    for kind in PLANS:
        lengths = _lengths(kind, plan)
        if lengths is not None and min(lengths.values()) > 0 and _alike(plan, _plan(kind, lengths)):
            return kind, lengths
    return "other", {}


def reshaped(building: Building, kind: PlanKind, lengths: Mapping[str, float]) -> Building:
    """The building over another plan.

    Walls keep their designs: the front, the back and both sides are found again. A yard has the design of the back, a
    house that is added to a row that of the last one.

    Parameters
    ----------
    lengths
        ``width`` and ``depth``; of an L ``deep`` and ``wide``, its arms, too; of a row ``house 1``, ``house 2`` and so
        on in place of the width, all of them or none. What is left out is as it is now, or a guess.

    Raises
    ------
    DesignError
        With all that is wrong with the building that would come out.
    """
    before, known = plan_of(building)
    rows = kind == "row" and any(name.startswith("house ") for name in lengths)
    kept = {name: value for name, value in known.items() if not (rows and name.startswith("house "))}
    full = _completed(kind, {**kept, **lengths})
    plan = _plan(kind, full)
    old = dict(zip(_roles(before, building.plan), building.walls, strict=True))
    roles = _roles(kind, plan)
    walls = tuple(_design(role, old) for role in roles)
    corners = {
        number: corner
        for role, corner in _corners(building, before).items()
        if (number := _number(role, roles)) is not None
    }
    x0, y0 = building.plan[0]
    return replace(building, plan=tuple((x + x0, y + y0) for x, y in plan), walls=walls, corners=corners)


def walled(building: Building, wall: int, design: str | None) -> Building:
    """The building with another design on a wall, by its number from 0; None: blind. Raises `DesignError`."""
    walls = list(building.walls)
    walls[wall] = design
    return replace(building, walls=tuple(walls))


def treated(building: Building, number: int, kind: Treatment | None, width: float | None = None) -> Building:
    """The building with quoins or a chamfer at a corner, by its number from 0, or with neither.

    A treatment of that kind that there is at another corner is used again; else one is made. Raises `DesignError`.
    """
    corners = {k: own for k, own in building.corners.items() if k != number}
    if kind is None:
        return replace(building, corners=corners)
    designs = dict(building.designs)
    now = building.corners.get(number)
    alike = [own for own in (now, *corners.values()) if own is not None and own.kind == kind]
    key = alike[0].design if alike else _added(designs, quoins() if kind == "quoins" else chamfer())
    wide = width if width is not None else (alike[0].width if alike else None)
    return replace(building, designs=designs, corners={**corners, number: Corner(kind, key, wide)})


def _added(designs: dict[str, Design], design: Design) -> str:
    """Add a design under a name that is free; one that is there already is used again."""
    for name, own in designs.items():
        if own == design:
            return name
    names = (design.name, *(f"{design.name} {k}" for k in range(2, len(designs) + 3)))
    name = next(name for name in names if name not in designs)
    designs[name] = design
    return name


def _lengths(kind: PlanKind, plan: Sequence[Point]) -> dict[str, float] | None:
    """The lengths that a plan of that kind would have; None where it has another number of corners."""
    count = len(plan)
    if kind == "rectangle" and count == 4:
        return {"width": plan[1][0], "depth": plan[2][1]}
    if kind == "ell" and count == 6:
        return {"width": plan[1][0], "depth": plan[4][1], "deep": plan[2][1], "wide": plan[3][0]}
    if kind == "row" and count >= 6 and count % 2 == 0:
        half = count // 2
        wide = {f"house {k}": plan[k][0] - plan[k - 1][0] for k in range(1, half)}
        return {**wide, "depth": plan[half][1]}
    return None


def _completed(kind: PlanKind, given: Mapping[str, float]) -> dict[str, float]:
    """The lengths of a plan of that kind, from those of another."""
    houses = {name: value for name, value in given.items() if name.startswith("house ")}
    depth = given.get("depth", 8.0)
    width = given["width"] if "width" in given else sum(houses.values()) or 10.0
    if kind == "row":
        return {**(houses or {"house 1": width / 2, "house 2": width / 2}), "depth": depth}
    if kind == "ell":
        return {
            "width": width,
            "depth": depth,
            "deep": given.get("deep", depth / 2),
            "wide": given.get("wide", width / 2),
        }
    return {"width": width, "depth": depth}


def _plan(kind: PlanKind, of: Mapping[str, float]) -> tuple[Point, ...]:
    """Corners, the first one at the origin."""
    depth = of["depth"]
    if kind == "ell":
        wide, deep = of["wide"], of["deep"]
        width = of["width"]
        return ((0.0, 0.0), (width, 0.0), (width, deep), (wide, deep), (wide, depth), (0.0, depth))
    if kind == "row":
        stops = [0.0]
        for k in range(1, len(of)):
            stops.append(stops[-1] + of[f"house {k}"])
        return (*((x, 0.0) for x in stops), *((x, depth) for x in reversed(stops)))
    return ((0.0, 0.0), (of["width"], 0.0), (of["width"], depth), (0.0, depth))


def _alike(a: Sequence[Point], b: Sequence[Point]) -> bool:
    return len(a) == len(b) and all(
        abs(p - q) < _NEAR for one, other in zip(a, b, strict=True) for p, q in zip(one, other, strict=True)
    )


def _roles(kind: PlanKind, plan: Sequence[Point]) -> tuple[str, ...]:
    """What each wall is."""
    if kind in _ROLES:
        return _ROLES[kind]
    if kind == "row":
        houses = len(plan) // 2 - 1
        backs = (f"back {k}" for k in range(houses, 0, -1))
        return (*(f"house {k}" for k in range(1, houses + 1)), "right", *backs, "left")
    return ("front", *(f"side {k}" for k in range(1, len(plan))))


def _design(role: str, old: Mapping[str, str | None]) -> str | None:
    """The design of a wall: of the one it was, else of one of its kind."""
    if role in old:
        return old[role]
    if role in ("yard", "wing"):
        role = "back"
    stem, _, number = role.partition(" ")
    named = {"front": "house 1", "house": "front", "back": "back 1"}
    if number:  # a house that is added is as the last one
        last = [name for name in old if name.startswith(f"{stem} ")]
        known = max(last, key=lambda name: int(name.split()[1])) if last else named.get(stem, "")
        return old.get(known, old.get(stem))
    return old.get(role, old.get(named.get(role, ""), None))


def _corners(building: Building, kind: PlanKind) -> dict[tuple[str, str], Corner]:
    """The corners that are treated, by the walls before and after."""
    roles = _roles(kind, building.plan)
    return {(roles[number - 1], roles[number]): corner for number, corner in building.corners.items()}


def _number(role: tuple[str, str], roles: Sequence[str]) -> int | None:
    """The corner between two walls, where there is one; the front of a row is its first or last house."""
    pairs = [(roles[number - 1], roles[number]) for number in range(len(roles))]
    if role in pairs:
        return pairs.index(role)
    plain = [(_plain(before), _plain(after)) for before, after in pairs]
    wanted = (_plain(role[0]), _plain(role[1]))
    return plain.index(wanted) if wanted in plain else None


def _plain(role: str) -> str:
    stem = role.split(maxsplit=1)[0]
    return "front" if stem == "house" else stem
