"""What stands before real houses: cars on paved places, hedges, lamps, people, nothing in anything else."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from facade_nb.render.town import Town
from facade_nb.render.town.things import LAMP, PERSON

from .places import box, collection, ell, feature
from .test_generated import polygons_of
from .test_things import paved


@pytest.fixture(scope="module")
def town() -> Town:
    """A village: houses, some with a wing, here and there wall to wall."""
    shapes = [
        feature(
            (ell if (i + j) % 4 == 0 else box)(
                27.0 * i + 3 * (j % 3), 31.0 * j, 13.0 if i % 3 else 27.0, 11.0
            )
        )
        for i in range(9)
        for j in range(8)
    ]
    return Town.from_geojson(collection(*shapes), 3)


def rectangles(town: Town) -> np.ndarray:
    """Under the cars."""
    cars = town.plan.cars
    ahead = cars.way * (cars.long / 2)[:, None]
    aside = np.column_stack([-cars.way[:, 1], cars.way[:, 0]]) * 0.86
    ring = [cars.at + a * ahead + b * aside for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return np.asarray(shapely.polygons(np.stack(ring, axis=1)))


def test_there_is_life(town: Town) -> None:
    plan = town.plan
    assert len(plan.cars) > 10 and len(plan.hedges) > 10
    assert (plan.things.kind >= PERSON).sum() > 4 and (plan.things.kind == LAMP).sum() > 4


def test_cars_stand_on_paved_places_and_on_nothing_else(town: Town) -> None:
    bodies = rectangles(town)
    off = shapely.area(
        shapely.difference(bodies, shapely.union_all(paved(town, "asphalt", "pavement", "court").geometries))
    )
    assert off.max() < 0.02
    one, other = shapely.STRtree(bodies).query(bodies, predicate="intersects")
    assert (one == other).all()
    assert not shapely.STRtree(polygons_of(town.plan)).query(bodies, predicate="dwithin", distance=0.3).size


def test_all_keep_clear_of_houses_trees_and_each_other(town: Town) -> None:
    plan = town.plan
    houses, bodies = shapely.STRtree(polygons_of(plan)), shapely.STRtree(rectangles(town))
    standing = plan.things.take((plan.things.foot == 0) & (plan.things.kind <= LAMP))
    people = shapely.points(plan.things.at[plan.things.kind >= PERSON])
    lamps = shapely.points(plan.things.at[plan.things.kind == LAMP])
    hedges = shapely.linestrings(np.stack([plan.hedges.start, plan.hedges.end], axis=1))
    for points, room in ((people, 0.4), (lamps, 0.6), (hedges, 0.6)):
        assert not houses.query(points, predicate="dwithin", distance=room).size
        assert not bodies.query(points, predicate="dwithin", distance=0.2).size
    stems = shapely.STRtree(shapely.points(standing.at))
    assert not stems.query(people, predicate="dwithin", distance=0.7).size
    assert not stems.query(hedges, predicate="dwithin", distance=0.7).size


def test_no_hedge_stands_before_a_door(town: Town) -> None:
    plan = town.plan
    edge = plan.entrance[plan.entrance >= 0]
    a, b = plan.corners[edge], plan.corners[plan.following[edge]]
    out = np.column_stack([(b - a)[:, 1], -(b - a)[:, 0]]) / np.hypot(*(b - a).T)[:, None]
    ways = shapely.linestrings(np.stack([(a + b) / 2, (a + b) / 2 + 4.0 * out], axis=1))
    hedges = shapely.linestrings(np.stack([plan.hedges.start, plan.hedges.end], axis=1))
    assert not shapely.STRtree(ways).query(hedges, predicate="dwithin", distance=0.5).size
    cars = rectangles(town)
    assert not shapely.STRtree(ways).query(cars, predicate="dwithin", distance=0.5).size
