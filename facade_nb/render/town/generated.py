"""The plan of a town that is made from a seed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .chance import length
from .characters import of_districts
from .chimneys import chimneys_of
from .districts import settle
from .finishing import finish, pairs_of, walls_of
from .fitting import single_fronts
from .greenery import sites_of, trees_of
from .grounds import ground_of
from .kerbs import along_kerbs
from .neighbours import cut_walls
from .plan import Plan
from .rings import after, ring_numbers
from .roles import STREET
from .stages import Stages
from .street_life import cars_of, hedges_of, people_of
from .styles import Style

__all__ = ["generate_plan"]

_TREES = 0.5
"""Trees in gardens and yards for each house, at the most."""


def generate_plan(buildings: int, seed: int, styles: Sequence[Style], stages: Stages | None = None) -> Plan:
    """A town of exactly so many buildings. The same seed gives the same plan, on every processor."""
    stages = stages or Stages()
    stages.at(0.0, "streets")
    footprints, cells, district = settle(buildings, seed)
    order = np.lexsort((np.arange(len(district)), cells.reach))
    cell = order[footprints.block]
    stages.at(0.3, "neighbours")
    count = len(footprints.block)
    cut = cut_walls(footprints.offsets, footprints.corners, ring_numbers(footprints.offsets))
    walls = walls_of(cut, np.arange(count), np.zeros(count, bool), footprints.role)
    pairs = pairs_of(walls)
    span = length(cut.corners[after(cut.offsets)] - cut.corners)
    front = single_fronts(walls.role == STREET, span, ring_numbers(cut.offsets), count)
    characters = of_districts(
        footprints.district,
        footprints.block,
        cells.reach[cell],
        footprints.street,
        footprints.corner,
        front,
        pairs,
        styles,
        seed,
    )
    stages.at(0.45, "ground")
    built = np.unique(cell)
    ground = ground_of(cells, district, built)
    stages.at(0.5, "roofs")
    plan = finish(walls, pairs, characters, styles, ground, seed, stages=stages)
    stages.at(0.68, "trees")
    trees = trees_of(sites_of(plan.corners, plan.outlines(), seed, _TREES), ground)
    things = trees + chimneys_of(plan, seed) + along_kerbs(cells, built, seed)
    stages.at(0.71, "street life")
    people = people_of(plan, cells, built, things, seed)
    return replace(
        plan,
        things=things + people,
        cars=cars_of(cells, built, count, seed),
        hedges=hedges_of(plan, cells, district, built, things, seed),
    )
