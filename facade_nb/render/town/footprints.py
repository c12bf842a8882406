"""Footprints as they are made: groups of the same number of corners, gathered into flat arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, millimetres
from .rings import Ints, areas, offsets_of, take_rings

__all__ = ["DISTRICTS", "District", "Footprints", "Group", "gather"]


class District:
    """What a block is built up with."""

    MARKET, OLD, INNER, ROWS, DETACHED, SLABS, INDUSTRY, PARK = range(8)


DISTRICTS = ("market", "old", "inner", "rows", "detached", "slabs", "industry", "park")
"""Their names."""


@dataclass(frozen=True, slots=True, eq=False)
class Group:
    """Footprints (m, k, 2) of k corners each, counter-clockwise, and the roles of their edges (m, k).

    Attributes
    ----------
    block, line
        (m,) the block, and the edge of a block along which they stand.
    district
        (m,) of the block.
    street
        (m,) kind of the widest street that they face.
    corner
        (m,) whether they turn a corner.
    """

    corners: Floats
    role: NDArray[np.uint8]
    block: Ints
    line: Ints
    district: Ints
    street: Ints
    corner: NDArray[np.bool_]

    def take(self, chosen: NDArray[np.bool_] | NDArray[np.integer]) -> Group:
        """Some of them."""
        return Group(*(getattr(self, name)[chosen] for name in self.__slots__))

    def polygons(self) -> NDArray[np.object_]:
        """As shapely's polygons."""
        return np.asarray(shapely.polygons(self.corners), object)


@dataclass(frozen=True, slots=True, eq=False)
class Footprints:
    """Footprints in flat arrays; attributes as of `Group`, `offsets` (b + 1,) of their corners."""

    offsets: Ints
    corners: Floats
    role: NDArray[np.uint8]
    block: Ints
    district: Ints
    street: Ints
    corner: NDArray[np.bool_]

    def take(self, chosen: Ints) -> Footprints:
        """Some of them, in the order of `chosen`."""
        index, offsets = take_rings(self.offsets, chosen)
        own = (getattr(self, name)[chosen] for name in ("block", "district", "street", "corner"))
        return Footprints(offsets, self.corners[index], self.role[index], *own)


def gather(groups: Sequence[Group]) -> Footprints:
    """All footprints of some groups, block by block along its edges."""
    groups = [group for group in groups if len(group.block)]
    counts = np.concatenate([np.full(len(group.block), group.corners.shape[1]) for group in groups])
    corners = np.concatenate([millimetres(group.corners.reshape(-1, 2)) for group in groups])
    role = np.concatenate([group.role.ravel() for group in groups])
    block, line, district, street, corner = (
        np.concatenate([getattr(group, name) for group in groups])
        for name in ("block", "line", "district", "street", "corner")
    )
    every = Footprints(offsets_of(counts), corners, role, block, district, street, corner)
    order = np.lexsort((np.arange(len(block)), line, block))
    return every.take(order[areas(corners, every.offsets)[order] > 4.0])
