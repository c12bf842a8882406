"""From footprints and their characters to a plan: neighbours' walls, roofs, seeds, doors, for every source alike."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, length
from .looks import choose_seeds
from .neighbours import Cut
from .plan import GABLE, HIP, OUTBUILDING, SHED, Ground, Plan
from .rings import Ints, after, offsets_of, ring_numbers, take_rings
from .roles import PARTY, STREET
from .roof_kinds import choose_roofs
from .stages import Stages
from .styles import Style

__all__ = ["Characters", "Pairs", "Walls", "finish", "pairs_of", "walls_of"]


@dataclass(frozen=True, slots=True, eq=False)
class Walls:
    """The walls of all buildings once neighbours are known.

    Attributes
    ----------
    rings, ring_of, holes, cut
        As of `Plan`, and as `cut_walls` has found them.
    role
        (n,) of each edge.
    base
        Offsets of the outer rings' true corners, and which corners these are.
    base_role
        Their roles: PARTY where a neighbour stands along the greater part.
    """

    ring_of: Ints
    holes: NDArray[np.bool_]
    cut: Cut
    role: NDArray[np.uint8]
    base: tuple[Ints, Ints]
    base_role: NDArray[np.uint8]


@dataclass(frozen=True, slots=True, eq=False)
class Characters:
    """Attributes of buildings (b,), as of `Plan`."""

    style: NDArray[np.int32]
    storeys: NDArray[np.int32]
    eaves: Floats
    kind: NDArray[np.uint8]
    shop: NDArray[np.bool_]


def walls_of(cut: Cut, ring_of: Ints, holes: NDArray[np.bool_], role: NDArray[np.uint8]) -> Walls:
    """Roles of walls that were cut, from those (n,) that they had before."""
    own = role[cut.source].copy()
    own[cut.wall] = PARTY
    spans = length(cut.corners[after(cut.offsets)] - cut.corners)
    count = len(role)
    whole = np.zeros(count)
    shared = np.zeros(count)
    np.add.at(whole, cut.source, np.round(spans, 3))
    np.add.at(shared, cut.source, np.round(np.where(own == PARTY, spans, 0), 3))
    old = np.where(shared > 0.5 * whole, PARTY, role).astype(np.uint8)
    true = np.flatnonzero(~cut.added)
    counts = np.bincount(ring_numbers(cut.offsets)[true], minlength=len(ring_of))
    outer = np.flatnonzero(~holes)
    index, offsets = take_rings(offsets_of(counts), outer)
    return Walls(ring_of, holes, cut, own, (offsets, true[index]), old[index])


@dataclass(frozen=True, slots=True, eq=False)
class Pairs:
    """Pairs (m, 2) of buildings: those that stand wall to wall, and those that are seen together."""

    beside: Ints
    near: Ints


def pairs_of(walls: Walls) -> Pairs:
    """Who stands beside whom."""
    cut = walls.cut
    building = np.asarray(walls.ring_of)[ring_numbers(cut.offsets)]
    beside = np.stack([building[cut.wall], cut.neighbour], axis=1)
    offsets, index = walls.base
    near = _near(cut.corners[index], offsets, walls, building)
    return Pairs(np.unique(np.sort(beside, axis=1), axis=0).reshape(-1, 2), near)


def finish(
    walls: Walls,
    pairs: Pairs,
    characters: Characters,
    styles: Sequence[Style],
    ground: Ground,
    seed: int,
    given: Ints | None = None,
    tops: Floats | None = None,
    left_out: Mapping[str, int] | None = None,
    stages: Stages | None = None,
) -> Plan:
    """A plan.

    Parameters
    ----------
    given
        (b,) kinds of roofs that are known; -1: none.
    tops
        (b,) height of the ridge where it is known, else 0: the walls are so much lower as the roof is high.
    """
    cut = walls.cut
    offsets, index = walls.base
    outer = cut.corners[index]
    holed = np.bincount(walls.ring_of[walls.holes], minlength=len(characters.style)) > 0
    roofs = choose_roofs(
        outer, offsets, walls.base_role, holed, characters.style, styles, seed, given, large=1500.0
    )
    eaves, rise = characters.eaves, roofs.rise
    if tops is not None:
        known = tops > 0
        rise = np.where(known, np.round(np.minimum(rise, 0.45 * tops), 2), rise)
        eaves = np.round(np.where(known, tops - rise, eaves), 3)
        storeys = characters.storeys.copy()
        for k in np.flatnonzero(known).tolist():
            storeys[k] = styles[characters.style[k]].fit(float(eaves[k]))
        characters = replace(characters, storeys=storeys)
    building = np.asarray(walls.ring_of)[ring_numbers(cut.offsets)]
    covered = np.zeros(len(building))
    np.maximum.at(covered, cut.wall, eaves[cut.neighbour])
    covered = np.minimum(covered, eaves[building])
    entrance = _entrances(cut, walls.role, building, characters, styles)
    entrance[characters.kind == OUTBUILDING] = -1
    if stages is not None:
        stages.at(0.6, "seeds")
    seeds = choose_seeds(characters.style, styles, pairs.near, pairs.beside, seed)
    return Plan(
        cut.corners,
        cut.offsets,
        walls.ring_of,
        walls.holes,
        cut.added,
        walls.role,
        covered,
        entrance,
        eaves,
        rise,
        characters.storeys,
        roofs.kind,
        roofs.eave,
        roofs.run,
        characters.style,
        seeds,
        characters.kind,
        characters.shop,
        ground,
        _over(characters, roofs.kind, styles),
        dict(left_out or {}),
    )


_OVER: Mapping[str, float] = {"detached": 0.5, "half-timbered": 0.4, "brickworks": 0.25}
"""How far roofs of some styles hang over, metres."""

_CORNICES: Mapping[str, float] = {"gruenderzeit": 0.45, "slab": 0.1, "brickworks": 0.2, "detached": 0.25}
"""How far cornices of flat roofs and mansards stand out, metres."""


def _over(characters: Characters, kind: NDArray[np.uint8], styles: Sequence[Style]) -> Floats:
    """How far roofs hang over, metres: those with a slope, those of sheds less; and cornices of the others."""
    over = np.array([_OVER.get(one.name, 0.35) for one in styles])[characters.style]
    over = np.where(characters.kind == OUTBUILDING, 0.2, over)
    out = np.array([_CORNICES.get(one.name, 0.3) for one in styles])[characters.style]
    out = np.where(characters.kind == OUTBUILDING, 0.06, out)
    return np.where(np.isin(kind, (GABLE, HIP, SHED)), over, out)


def _entrances(
    cut: Cut, role: NDArray[np.uint8], building: Ints, characters: Characters, styles: Sequence[Style]
) -> NDArray[np.int32]:
    """The edge with the door: where a corner is cut off, else the widest on the street, else the widest free one."""
    following = after(cut.offsets)
    span = np.round(length(cut.corners[following] - cut.corners), 3)
    least = np.array([one.least for one in styles])[characters.style][building]
    street = role == STREET
    preceding = np.empty_like(following)
    preceding[following] = np.arange(len(following))
    cut_off = street & street[following] & street[preceding] & (span < 6)
    faces_street = np.zeros(len(characters.style), bool)
    np.logical_or.at(faces_street, building, street)
    fits = (span >= np.maximum(least, 1.5)) & np.where(faces_street[building], street, role != PARTY)
    some = np.flatnonzero(fits)
    # Free walls: beside before behind. Equal ones: the first.
    order = some[np.lexsort((some, -span[some], role[some], ~cut_off[some], building[some]))]
    owner = building[order]
    best = order[np.append(True, owner[1:] != owner[:-1])] if len(order) else order
    entrance = np.full(len(characters.style), -1, np.int32)
    entrance[building[best]] = best
    return entrance


def _near(outer: Floats, offsets: Ints, walls: Walls, building: Ints) -> Ints:
    """Pairs of buildings that are seen together: a few metres apart, or across the street."""
    polygons = np.asarray(shapely.polygons(shapely.linearrings(outer, indices=ring_numbers(offsets))), object)
    tree = shapely.STRtree(polygons)
    one, other = tree.query(polygons, predicate="dwithin", distance=9.0)
    cut = walls.cut
    edge = np.flatnonzero(walls.role == STREET)
    start, end = cut.corners[edge], cut.corners[after(cut.offsets)[edge]]
    way = end - start
    out = np.stack([way[:, 1], -way[:, 0]], axis=1) / np.maximum(length(way), 1e-9)[:, None]
    middle = (start + end) / 2
    rays = shapely.linestrings(np.stack([middle + 0.2 * out, middle + 36.0 * out], axis=1))
    ray, hit = tree.query(rays, predicate="intersects")
    apart = np.round(shapely.distance(shapely.points(middle[ray]), polygons[hit]), 3)
    apart[building[edge[ray]] == hit] = np.inf
    order = np.lexsort((hit, apart, ray))
    ray, hit, apart = ray[order], hit[order], apart[order]
    first = np.append(True, ray[1:] != ray[:-1]) if len(ray) else np.zeros(0, bool)
    first &= np.isfinite(apart)
    pairs = np.concatenate(
        [np.stack([one, other], axis=1), np.stack([building[edge[ray[first]]], hit[first]], axis=1)]
    )
    pairs = np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1)
    return np.unique(pairs, axis=0).reshape(-1, 2)
