"""Plans: from a user's designs to the fields of a building."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..design.errors import DesignError, Fault, nearest
from ..design.model import Design
from .model import Building, Corner, Point, Walls

__all__ = ["built", "row"]


def built(
    kind: type[Building],
    plan: Sequence[Point],
    names: Sequence[str],
    walls: Walls,
    height: float | None,
    rest: Mapping[str, Any],
) -> Building:
    """A building over a plan whose walls have names."""
    return _made(kind, plan, _each(walls, names), height, rest)


def row(
    kind: type[Building],
    houses: Sequence[tuple[float, Design]],
    depth: float,
    back: Walls,
    height: float | None,
    rest: Mapping[str, Any],
) -> Building:
    """Houses side by side, whose ends are blind."""
    if not houses:
        raise DesignError(Fault("houses", "expected at least one house, as (width, design); found none"))
    for k, house in enumerate(houses):
        if not (isinstance(house, tuple) and len(house) == 2 and isinstance(house[1], Design)):
            raise DesignError(Fault(f"houses[{k}]", f"expected (width, design); found {house!r}"))
    stops = [0.0]
    for width, _ in houses:
        stops.append(stops[-1] + width)
    behind = _each(back, [f"house {k + 1}" for k in range(len(houses))])
    plan = [*((x, 0.0) for x in stops), *((x, depth) for x in reversed(stops))]
    walls = [*(design for _, design in houses), None, *reversed(behind), None]
    return _made(kind, plan, walls, height, rest)


def _each(walls: Walls, names: Sequence[str]) -> list[Design | None]:
    """A design, or None, for each wall."""
    if walls is None or isinstance(walls, Design):
        return [walls] * len(names)
    if isinstance(walls, Mapping):
        for name in walls:
            if name not in names:
                raise DesignError(
                    Fault(
                        "walls",
                        f"expected names among {', '.join(names)}; found {name!r}{nearest(str(name), names)}",
                    )
                )
        found = [walls.get(name) for name in names]
    else:
        found = list(walls)
        if len(found) != len(names):
            raise DesignError(
                Fault("walls", f"expected {len(names)}: {', '.join(names)}; found {len(found)}")
            )
    for name, own in zip(names, found, strict=True):
        if own is not None and not isinstance(own, Design):
            raise DesignError(Fault(f"walls: {name}", f"expected a Design or None; found {own!r}"))
    return found


def _made(
    kind: type[Building],
    plan: Sequence[Point],
    walls: Sequence[Design | None],
    height: float | None,
    rest: Mapping[str, Any],
) -> Building:
    """The building, its designs named by their names; equal designs are one."""
    names: dict[str, Design] = {}

    def name_of(design: Design) -> str:
        for name, own in names.items():
            if own == design:
                return name
        base = design.name.strip() or "design"
        name, number = base, 1
        while name in names:
            number += 1
            name = f"{base} {number}"
        names[name] = design
        return name

    keys = tuple(None if own is None else name_of(own) for own in walls)
    fields = dict(rest)
    corners = {
        number: _corner(own, f"corners.{number}", name_of)
        for number, own in fields.pop("corners", {}).items()
    }
    if height is None:
        height = max((own.canvas.height for own in walls if own is not None), default=3.0)
    whole = tuple((float(x), float(y)) for x, y in plan)
    return kind(height=float(height), plan=whole, walls=keys, designs=names, corners=corners, **fields)


def _corner(given: Any, place: str, name_of: Callable[[Design], str]) -> Corner:
    """A corner given as it is, or as (kind, design) or (kind, design, width)."""
    if isinstance(given, Corner):
        return given
    match given:
        case (kind, Design() as design):
            return Corner(kind, name_of(design))
        case (kind, Design() as design, width):
            return Corner(kind, name_of(design), width)
    raise DesignError(
        Fault(place, f"expected a Corner, (kind, design) or (kind, design, width); found {given!r}")
    )
