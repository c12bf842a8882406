"""What is about the houses of a real town: ground, things along streets and in gardens, cars, people."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats
from .chimneys import chimneys_of
from .forecourts import cars_before, forecourts_of, hedges_before
from .greenery import Sites, trees_of
from .plains import Asphalt, plain_of
from .plan import Plan
from .rings import Ints
from .roads import Roads
from .roadside import cars_along, lamps_along, people_along, trees_along
from .stages import Stages
from .workers import Workers

__all__ = ["Standing", "surrounded"]


@dataclass(frozen=True, slots=True, eq=False)
class Standing:
    """The houses of a real town, and what its ground and gardens follow from.

    Attributes
    ----------
    plan
        Without ground, and without all that stands on it.
    offsets, corners
        Outer rings of the footprints.
    houses
        Footprints with their courtyards, as polygons.
    gaps
        (n,) as of `gaps_of`, of each edge of the plan.
    roads
        Its streets.
    asphalt, sites
        Wait for what streets cover, and for where trees may stand.
    paved
        (b,) how wide what is paved about each house is, metres.
    gardens
        (b,) whether it stands in a garden.
    """

    plan: Plan
    offsets: Ints
    corners: Floats
    houses: NDArray[np.object_]
    gaps: Floats
    roads: Roads
    asphalt: Callable[[], Asphalt]
    sites: Callable[[], Sites]
    paved: Floats
    gardens: NDArray[np.bool_]


def surrounded(
    found: Standing, seed: int, stages: Stages, workers: Workers, laid: Callable[[Plan], object]
) -> Plan:
    """The whole plan. `laid` is called with it once its ground is there."""
    plan, roads = found.plan, found.roads
    stages.at(0.62, "ground")
    courts = forecourts_of(plan, found.gaps, roads, found.houses, seed)
    ways = courts.paved()
    ground = workers.begin(
        lambda: plain_of(found.offsets, found.corners, found.paved, roads, ways, found.asphalt())
    )
    # What needs no ground is chosen meanwhile.
    houses = shapely.STRtree(plan.outlines())
    lamps = lamps_along(plan, houses, courts, roads, seed)
    rows = trees_along(plan, houses, courts, roads, lamps, seed)
    cars = cars_before(plan, courts, seed) + cars_along(plan, houses, courts, roads, seed)
    chimneys = chimneys_of(plan, seed)
    plan = replace(plan, ground=ground(), roads=roads)
    laid(plan)
    stages.at(0.68, "trees")
    things = trees_of(found.sites(), plan.ground) + chimneys + rows + lamps
    stages.at(0.71, "street life")
    return replace(
        plan,
        things=things + people_along(plan, houses, courts, roads, cars, things, seed),
        cars=cars,
        hedges=hedges_before(plan, houses, courts, found.gardens, things, roads, seed),
    )
