"""What each block is built up with, and all footprints of a generated town."""

from __future__ import annotations

import numpy as np

from .chance import chance, direction, field
from .footprints import District, Footprints, gather
from .loose import halls, houses, rows, slabs
from .perimeter import Blocks, blunted, perimeter
from .rings import Ints, offsets_of, ring_numbers
from .solid import sliced
from .streets import Cells, lay_out

__all__ = ["DENSE", "settle"]

DENSE = 0.5
"""The part of the town's radius that is built up around blocks."""

_AREA = 600.0
"""Square metres of town for each building, about."""


def settle(count: int, seed: int) -> tuple[Footprints, Cells, Ints]:
    """Streets and exactly so many footprints, from the market outwards, and the district of each cell.

    The town is made a little larger until there are enough; what lies furthest out is left out.
    """
    radius = round(float(np.sqrt(_AREA * max(count, 3) / np.pi)) + 12.0, 1)
    while True:
        cells = lay_out(radius, seed, DENSE)
        district = _districts(cells, count, seed)
        found = _build(cells, district, seed)
        if len(found.block) >= count:
            return found.take(np.arange(count)), cells, district
        radius = round(radius * 1.12, 1)


def _districts(cells: Cells, count: int, seed: int) -> Ints:
    """The district of each cell."""
    random = chance(seed, 10)
    chances = random.random(len(cells.reach))
    reach = cells.reach
    away = np.sqrt(cells.centres[:, 0] ** 2 + cells.centres[:, 1] ** 2)
    patch = field(cells.centres, seed + 5, 420.0)
    district = np.full(len(reach), District.DETACHED)
    middle = reach < 0.74 + 0.05 * patch[:, 1]
    slab = middle & (patch[:, 0] > 0.22) & (cells.sizes > 6500) & (count > 400)
    district[middle] = District.ROWS
    district[slab] = District.SLABS
    # The quarter of industry lies to one side, outside the dense part, as far as the edge.
    side = direction(round(float(random.random()), 6))
    towards = (cells.centres[:, 0] * side[0] + cells.centres[:, 1] * side[1]) / np.maximum(away, 1.0)
    works = (towards > 0.93 + 0.03 * patch[:, 1]) & (reach > 0.56) & (reach < 0.97) & (count > 250)
    district[works] = District.INDUSTRY
    if count >= 60:
        inner = reach < DENSE + 0.06 * patch[:, 1]
        district[inner] = District.INNER
        district[inner & (away < min(0.21 * cells.radius, 340.0))] = District.OLD
        green = inner & (chances < 0.035) & (cells.sizes > 2000)
        district[green] = District.PARK
        district[0] = District.MARKET
    district[cells.sizes < 350] = District.PARK
    return district


def _build(cells: Cells, district: Ints, seed: int) -> Footprints:
    """The footprints of all blocks, block by block from the market outwards."""
    order = np.lexsort((np.arange(len(district)), cells.reach))
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    rings = ring_numbers(cells.offsets)
    firm = cells.firm
    counts = np.bincount(rings, weights=firm, minlength=len(district)).astype(np.int64)
    every = Blocks(offsets_of(counts), cells.blocks[firm], cells.street[firm], district, rank)
    every = every.take(np.flatnonzero((cells.sizes > 0) & (district != District.PARK)))
    groups, narrow = perimeter(blunted(every.where(District.OLD, District.INNER)), seed)
    found, narrow = sliced(narrow, seed)
    groups += found
    rest = np.where(np.isin(narrow.district, (District.OLD, District.INNER)), District.ROWS, narrow.district)
    narrow = Blocks(narrow.offsets, narrow.corners, narrow.street, rest, narrow.rank)
    for build, blocks in (
        (rows, every.where(District.ROWS)),
        (rows, narrow),
        (houses, every.where(District.DETACHED)),
        (slabs, every.where(District.SLABS)),
        (halls, every.where(District.INDUSTRY)),
    ):
        if len(blocks.rank):
            groups += build(blocks, seed)
    return gather(groups)
