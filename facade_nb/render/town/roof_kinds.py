"""Which roof a house has: what its style likes, as far as its footprint and its neighbours let it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .chance import Floats, chance, length, pick
from .plan import FLAT, GABLE, HIP, MANSARD, ROOFS, SHED
from .rings import Ints, after, areas, ring_numbers, take_rings
from .roles import PARTY, STREET
from .roofing import room_of
from .shapes import Strips, find_strips
from .skeletons import shrink
from .styles import Style

__all__ = ["Roofs", "choose_roofs"]

_SLOPES: Mapping[str, float] = {
    "half-timbered": 1.15,
    "gruenderzeit": 0.8,
    "brickworks": 0.4,
    "detached": 0.8,
}
"""Rise over run of the roofs of some styles."""


@dataclass(frozen=True, slots=True, eq=False)
class Roofs:
    """Roofs of buildings (b,): kind, rise, the edge of the eaves, and run, as of `Plan`."""

    kind: NDArray[np.uint8]
    rise: Floats
    eave: NDArray[np.int32]
    run: Floats


def choose_roofs(
    corners: Floats,
    offsets: Ints,
    role: NDArray[np.uint8],
    holed: NDArray[np.bool_],
    style: NDArray[np.int32],
    styles: Sequence[Style],
    seed: int,
    given: Ints | None = None,
    large: float = 1e9,
) -> Roofs:
    """A roof for each outer ring.

    Parameters
    ----------
    corners, offsets
        Outer rings without corners that were added.
    role
        Of their edges: PARTY where a neighbour stands along the greater part.
    holed
        (b,) whether there is a courtyard: the roof is flat then.
    given
        (b,) the kind that is known; -1: none.
    large
        Buildings of a greater area (square metres) have a flat roof, or a shed one in industry.
    """
    count = len(offsets) - 1
    random = chance(seed, 21)
    table = np.array([[dict(one.roofs).get(name, 0.0) for name in ROOFS] for one in styles])
    wanted = pick(random.random(count), table[style])
    size = areas(corners, offsets)
    wanted = np.where((size > large) & (wanted != SHED), FLAT, wanted)
    if given is not None:
        wanted = np.where(given >= 0, given, wanted)
    wanted = np.where(holed, FLAT, wanted)
    slope = np.array([_SLOPES.get(one.name, 0.75) for one in styles])[style] * (
        0.88 + 0.24 * random.random(count)
    )
    turned = random.random(count)
    eave, width = _along(corners, offsets, role, turned, style, styles)
    party = _any(role == PARTY, offsets)
    strip = eave >= 0
    room = room_of(corners, offsets)
    kind = wanted.copy()
    pitched = np.isin(wanted, (GABLE, SHED))
    kind = np.where(pitched & ~strip, np.where(party | (room < 1.4), FLAT, HIP), kind)
    kind = np.where((wanted == HIP) & (party | (room < 1.4)), np.where(strip, GABLE, FLAT), kind)
    kind = np.where((wanted == MANSARD) & ~strip & (party | (room < 2.2)), FLAT, kind)
    eave = np.where(np.isin(kind, (GABLE, SHED, HIP)) | (kind == MANSARD) & (eave >= 0), eave, -1)
    eave = np.where((kind == MANSARD) & ~party, -1, eave)
    kind = np.where((kind == MANSARD) & (eave < 0) & (room < 2.2), FLAT, kind)
    half = np.where(eave >= 0, width / 2, np.maximum(room, 0))
    # Hips without a strip rise as far as they can, up to 7 m.
    run = np.where((kind == HIP) & (eave < 0), np.round(7.0 / slope, 2), 0.0)
    own = np.flatnonzero(run > 0)
    if len(own):
        index, rings = take_rings(offsets, own)
        half[own] = shrink(corners[index], rings, run[own]).far
    rise = np.select(
        [kind == GABLE, kind == HIP, kind == MANSARD, kind == SHED],
        [np.minimum(slope * half, 7.5), slope * half, np.full(count, 3.4), np.minimum(0.5 * half, 2.4)],
        0.0,
    )
    return Roofs(kind.astype(np.uint8), np.round(rise, 2), eave.astype(np.int32), run)


def _any(flags: NDArray[np.bool_], offsets: Ints) -> NDArray[np.bool_]:
    found = np.zeros(len(offsets) - 1, bool)
    np.logical_or.at(found, ring_numbers(offsets), flags)
    return found


def _along(
    corners: Floats,
    offsets: Ints,
    role: NDArray[np.uint8],
    turned: Floats,
    style: NDArray[np.int32],
    styles: Sequence[Style],
) -> tuple[Ints, Floats]:
    """The edge with the eaves of each strip (-1: no strip), and the strip's width.

    Eaves run along the street between neighbours, else along the longer side. Half-timbered houses often show a gable.
    """
    count = len(offsets) - 1
    eave, width = np.full(count, -1), np.zeros(count)
    party = role == PARTY
    span = length(corners[after(offsets)] - corners)
    old = np.array([one.name == "half-timbered" for one in styles])[style]
    best = np.full(count, -np.inf)
    for strips in find_strips(corners, offsets):
        if not len(strips.building):
            continue
        b = strips.building
        ends = _ends(strips)
        sides = strips.front[:, :-1]
        worth = np.round(span[sides].sum(axis=1), 1)
        worth += 1000.0 * (party[ends].sum(axis=1) - party[sides].any(axis=1) - _rear_party(strips, party))
        worth += (
            np.where((turned[b] < 0.5) & old[b] & (len(strips.front[0]) == 2), -1.0, 1.0)
            * 500.0
            * (role[sides] == STREET).any(axis=1)
            * _joined(party, ends, sides)
        )
        better = worth > best[b]
        chosen = b[better]
        best[chosen], eave[chosen], width[chosen] = worth[better], strips.eave[better], strips.width[better]
    return eave, width


def _ends(strips: Strips) -> Ints:
    """The edges (s, 2) at both ends of strips: from the front's last corner, and from the rear's first."""
    return np.stack([strips.front[:, -1], strips.rear[:, 0]], axis=1)


def _rear_party(strips: Strips, party: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Whether a neighbour stands along the rear."""
    return np.asarray(party[strips.rear[:, 1:]].any(axis=1))


def _joined(party: NDArray[np.bool_], ends: Ints, sides: Ints) -> NDArray[np.bool_]:
    """Whether a neighbour stands against an end or a side."""
    return np.asarray(party[ends].any(axis=1) | party[sides].any(axis=1))
