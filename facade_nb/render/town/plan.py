"""The plan of a town: footprints with what stands on them, as flat arrays. x runs east and y north, metres."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .chance import Floats
from .rings import Ints, after, polygons_of, ring_numbers
from .roads import NO_ROADS, Roads
from .roles import COURT, PARTY, ROLES, SIDE, STREET
from .street_life import NO_CARS, NO_HEDGES, Cars, Hedges
from .things import NOTHING, Things

__all__ = [
    "COURT",
    "FLAT",
    "GABLE",
    "HIP",
    "INDUSTRIAL",
    "KINDS",
    "MANSARD",
    "OUTBUILDING",
    "PARTY",
    "PUBLIC",
    "RESIDENTIAL",
    "ROLES",
    "ROOFS",
    "SHED",
    "SHOP",
    "SIDE",
    "STREET",
    "Ground",
    "Plan",
]

FLAT, GABLE, HIP, MANSARD, SHED = range(5)
"""Kinds of roofs."""

ROOFS = ("flat", "gable", "hip", "mansard", "shed")
"""Their names."""

RESIDENTIAL, SHOP, INDUSTRIAL, PUBLIC, OUTBUILDING = range(5)
"""What a building is for."""

KINDS = ("residential", "shop", "industrial", "public", "outbuilding")
"""Their names."""


@dataclass(frozen=True, slots=True, eq=False)
class Ground:
    """The ground in triangles that do not overlap.

    Attributes
    ----------
    corners
        (v, 2) metres.
    triangles
        (t, 3) of them, counter-clockwise seen from above.
    kind
        (v,) index into `names`. All corners of a triangle are of one kind.
    piece
        (v,) which piece of ground a corner belongs to; pieces share no corners.
    along
        (v,) whether a piece is a strip of four corners that lies along a street: it begins with the edge on the
        street's side.
    names
        Asphalt, pavement, court, grass, the line in the middle of a street, fields around.
    """

    corners: Floats
    triangles: Ints
    kind: NDArray[np.uint8]
    piece: Ints
    along: NDArray[np.bool_]
    names: tuple[str, ...] = ("asphalt", "pavement", "court", "grass", "line", "field")


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """Buildings as flat arrays: b buildings, r rings, n corners.

    Attributes
    ----------
    corners
        (n, 2), whole millimetres. Edge i goes from corner i to the next one of its ring; outside is on its right.
    rings
        (r + 1,) the corners of ring k are those from ``rings[k]`` to below ``rings[k + 1]``. Outer rings are
        counter-clockwise, courtyards clockwise.
    ring_of
        (r,) building of each ring; a building's outer ring is its first.
    holes
        (r,) whether a ring is a courtyard.
    added
        (n,) corners at which a wall is cut because a neighbour's begins or ends there; the wall goes straight on.
    role
        (n,) of each edge: STREET, SIDE, COURT, PARTY.
    covered
        (n,) how high a neighbour covers an edge, metres; 0 where none does.
    entrance
        (b,) the edge with the door; -1: none.
    eaves, rise
        (b,) height of the walls, and of the roof above them, metres.
    storeys
        (b,)
    roof
        (b,) its kind: FLAT, GABLE, HIP, MANSARD, SHED.
    eave
        (b,) the edge along which a gable or shed roof has its eaves, as its number among the true corners of the outer
        ring; -1 where the roof needs none.
    run
        (b,) how far in from the walls a hipped roof without such an edge ends at the most, metres; else 0.
    style
        (b,) index into the styles.
    seed
        (b, 2) steps of 1/64 m, from 0 to below 2²⁰.
    kind
        (b,) what it is for: index into `KINDS`.
    shop
        (b,) whether there is a shop on the ground floor.
    ground
        What is between and under the buildings.
    left_out
        Why footprints were left out, and how many.
    over
        (b,) how far the roof hangs over walls that no neighbour touches, metres.
    things
        Trees, lamps, people and what else turns to whoever looks.
    cars, hedges
        What else stands in streets and before gardens.
    roads
        Streets of a real town.
    """

    corners: Floats
    rings: Ints
    ring_of: Ints
    holes: NDArray[np.bool_]
    added: NDArray[np.bool_]
    role: NDArray[np.uint8]
    covered: Floats
    entrance: NDArray[np.int32]
    eaves: Floats
    rise: Floats
    storeys: NDArray[np.int32]
    roof: NDArray[np.uint8]
    eave: NDArray[np.int32]
    run: Floats
    style: NDArray[np.int32]
    seed: NDArray[np.int32]
    kind: NDArray[np.uint8]
    shop: NDArray[np.bool_]
    ground: Ground
    over: Floats
    left_out: Mapping[str, int] = field(default_factory=dict)
    things: Things = NOTHING
    cars: Cars = NO_CARS
    hedges: Hedges = NO_HEDGES
    roads: Roads = NO_ROADS

    def __len__(self) -> int:
        return len(self.eaves)

    @property
    def following(self) -> Ints:
        """(n,) the next corner in the ring of each."""
        return after(self.rings)

    @property
    def building(self) -> Ints:
        """(n,) the building of each corner."""
        return np.asarray(self.ring_of)[ring_numbers(self.rings)]

    def outlines(self) -> NDArray[np.object_]:
        """Footprints without their courtyards, as shapely's polygons."""
        return polygons_of(self.rings, self.corners, ~self.holes)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """West, south, east and north ends of what is built, metres."""
        low, high = self.corners.min(axis=0), self.corners.max(axis=0)
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])
