"""What a building has to be: every fault is told with its place."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot, isfinite, pi

from ..design.errors import DesignError, Fault, nearest
from ..design.limits import MOST_LENGTH
from .faces import cut, turn, width_of
from .model import ROOFS, TREATMENTS, Building

__all__ = ["LEAST_WALL", "check"]

LEAST_WALL = 0.1
"""No wall is shorter, metres."""


def check(building: Building) -> None:
    """Raise `DesignError` with all that is wrong with a building."""
    faults = list(_plan(building))
    if not faults:
        faults += [*_designs(building), *_corners(building), *_shared(building)]
    faults += _roof(building)
    if faults:
        raise DesignError(faults)


def _plan(building: Building) -> Iterator[Fault]:
    plan, count = building.plan, len(building.plan)
    if not 0 < building.height <= MOST_LENGTH:
        yield Fault("height", f"expected a number greater than 0; found {building.height!r}")
    if count < 3:
        yield Fault("plan", f"expected at least 3 corners; found {count}")
        return
    if len(building.walls) != count:
        yield Fault(
            "walls", f"expected {count}, one from each corner to the next; found {len(building.walls)}"
        )
    if not all(isfinite(value) and abs(value) <= MOST_LENGTH for corner in plan for value in corner):
        yield Fault("plan", f"expected corners as east and north in metres; found {plan!r}")
        return
    short = False
    for k in range(count):
        (x, y), (u, v) = plan[k], plan[(k + 1) % count]
        if hypot(u - x, v - y) < LEAST_WALL:
            short = True
            yield Fault(
                f"plan[{k}]",
                f"expected walls of at least {LEAST_WALL:g} m; wall {k + 1} is {hypot(u - x, v - y):.3g} m long",
            )
    if short:
        return
    import shapely

    ring = shapely.Polygon(plan)
    if not ring.is_valid:
        yield Fault("plan", f"expected walls that do not cross: {shapely.is_valid_reason(ring)}")
    elif not ring.exterior.is_ccw:
        yield Fault("plan", "expected corners counter-clockwise, seen from above; these run clockwise")


def _designs(building: Building) -> Iterator[Fault]:
    known = building.designs
    for k, name in enumerate(building.walls):
        if name is not None and name not in known:
            yield Fault(f"walls[{k}]", _unknown(name, building))
    for number, corner in building.corners.items():
        if corner.design not in known:
            yield Fault(f"corners.{number}.design", _unknown(corner.design, building))


def _unknown(name: object, building: Building) -> str:
    hint = nearest(str(name), building.designs) or f"; known are {', '.join(building.designs) or 'none'}"
    return f"expected the name of a design; found {name!r}{hint}"


def _corners(building: Building) -> Iterator[Fault]:
    plan, count = building.plan, len(building.plan)
    for number, corner in building.corners.items():
        place = f"corners.{number}"
        if not (isinstance(number, int) and 0 <= number < count):
            yield Fault(place, f"expected the number of a corner, 0 to {count - 1}; found {number!r}")
            continue
        if corner.kind not in TREATMENTS:
            hint = nearest(str(corner.kind), TREATMENTS)
            yield Fault(
                f"{place}.kind", f"expected one of {', '.join(TREATMENTS)}; found {corner.kind!r}{hint}"
            )
            continue
        if corner.design not in building.designs:
            continue
        if not 0 < width_of(building, corner) <= MOST_LENGTH:
            yield Fault(f"{place}.width", f"expected a number greater than 0; found {corner.width!r}")
            continue
        angle = turn(plan[number - 1], plan[number], plan[(number + 1) % count])
        if corner.kind == "chamfer" and not 0.01 < angle < 0.95 * pi:
            yield Fault(f"{place}.kind", "expected an outer corner to cut off; this one is none")
        if corner.kind == "chamfer":
            for wall in ((number - 1) % count, number):
                if building.walls[wall] is None:
                    yield Fault(
                        f"{place}.kind",
                        f"expected façades on both sides of a chamfer; wall {wall + 1} is blind, as a party wall is",
                    )
    for k in range(count):
        following = (k + 1) % count
        if any(
            n in building.corners and building.corners[n].design not in building.designs
            for n in (k, following)
        ):
            continue
        (x, y), (u, v) = plan[k], plan[following]
        left = hypot(u - x, v - y) - cut(building, k) - cut(building, following)
        quoins = sum(
            width_of(building, own) / 2
            for n in (k, following)
            if (own := building.corners.get(n)) is not None and own.kind == "quoins"
        )
        if left < LEAST_WALL or left < quoins:
            yield Fault(
                f"walls[{k}]",
                f"expected room for the corners on both sides; {max(left, 0):.3g} m are left between chamfers, "
                f"and quoins take {quoins:.3g} m",
            )


def _shared(building: Building) -> Iterator[Fault]:
    """A shared name means the same in every design that declares it."""
    for name in building.shared:
        for section in ("symbols", "counters"):
            owners = [
                (key, getattr(own, section)[name])
                for key, own in building.designs.items()
                if name in getattr(own, section)
            ]
            for key, value in owners[1:]:
                if value != owners[0][1]:
                    yield Fault(
                        "shared",
                        f"expected {name!r} to be the same in all {section}; "
                        f"designs {owners[0][0]!r} and {key!r} differ",
                    )
        if not any(_has(own, name) for own in building.designs.values()):
            yield Fault("shared", f"expected a symbol or a counter along y of some design; found {name!r}")


def _has(design: object, name: str) -> bool:
    from .vertical import names_up

    return any(name in own for own in names_up(design))  # type: ignore[arg-type]


def _roof(building: Building) -> Iterator[Fault]:
    from ..render.materials import find_material

    roof = building.roof
    if roof.kind not in ROOFS:
        hint = nearest(str(roof.kind), ROOFS)
        yield Fault("roof.kind", f"expected one of {', '.join(ROOFS)}; found {roof.kind!r}{hint}")
    for name, value in (("rise", roof.rise), ("overhang", roof.overhang)):
        if value is not None and not 0 <= value <= MOST_LENGTH:
            yield Fault(f"roof.{name}", f"expected a number from 0; found {value!r}")
    for place, name in (("roof.material", roof.material), ("material", building.material)):
        try:
            find_material(name, place)
        except DesignError as error:
            yield from error.faults
