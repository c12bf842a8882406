"""The plan of a town that is made from a seed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .characters import of_districts
from .districts import settle
from .finishing import finish, walls_of
from .grounds import ground_of
from .neighbours import cut_walls
from .plan import Plan
from .rings import ring_numbers
from .styles import Style

__all__ = ["generate_plan"]


def generate_plan(buildings: int, seed: int, styles: Sequence[Style]) -> Plan:
    """A town of exactly so many buildings. The same seed gives the same plan, on every processor."""
    footprints, cells, district = settle(buildings, seed)
    order = np.lexsort((np.arange(len(district)), cells.reach))
    cell = order[footprints.block]
    characters = of_districts(
        footprints.district,
        footprints.block,
        cells.reach[cell],
        footprints.street,
        footprints.corner,
        styles,
        seed,
    )
    count = len(footprints.block)
    cut = cut_walls(footprints.offsets, footprints.corners, ring_numbers(footprints.offsets))
    walls = walls_of(cut, np.arange(count), np.zeros(count, bool), footprints.role)
    ground = ground_of(cells, district, np.unique(cell))
    return finish(walls, characters, styles, ground, seed)
