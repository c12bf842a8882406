"""Who and what is in the streets: where they stand; cars and hedges are closed, cornices too; what they take."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from facade_nb.render.town import Town
from facade_nb.render.town.cornices import CORNICES
from facade_nb.render.town.mesh import build_mesh
from facade_nb.render.town.plan import FLAT, MANSARD
from facade_nb.render.town.solids import RULES
from facade_nb.render.town.street_life import NO_CARS, NO_HEDGES
from facade_nb.render.town.things import LAMP, PERSON

from .meshes import free_edges
from .test_generated import polygons_of
from .test_things import paved


@pytest.fixture(scope="module")
def town() -> Town:
    return Town.generate(900, 4)


@pytest.fixture(scope="module")
def bodies(town: Town) -> np.ndarray:
    """Rectangles on the ground under the cars."""
    cars = town.plan.cars
    ahead = cars.way * (cars.long / 2)[:, None]
    aside = np.column_stack([-cars.way[:, 1], cars.way[:, 0]]) * 0.86
    ring = [cars.at + a * ahead + b * aside for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return np.asarray(shapely.polygons(np.stack(ring, axis=1)))


def test_there_is_life(town: Town) -> None:
    plan = town.plan
    assert len(plan.cars) > 60 and len(plan.hedges) > 60 and (plan.things.kind >= PERSON).sum() > 60
    assert len(set(plan.cars.kind.tolist())) == 4 and len(np.unique(plan.cars.seed, axis=0)) > 60


def test_cars_stand_on_the_carriageway_and_on_nothing_else(town: Town, bodies: np.ndarray) -> None:
    asphalt = shapely.union_all(paved(town, "asphalt", "line").geometries)
    off = shapely.area(shapely.difference(bodies, asphalt))
    assert off.max() < 0.02, town.plan.cars.at[off.argmax()]
    one, other = shapely.STRtree(bodies).query(bodies, predicate="intersects")
    assert (one == other).all()
    assert not shapely.STRtree(polygons_of(town.plan)).query(bodies, predicate="dwithin", distance=0.9).size


def test_people_keep_clear_of_houses_trees_and_roads(town: Town) -> None:
    things = town.plan.things
    people, others = (
        things.take(things.kind >= PERSON),
        things.take((things.kind <= LAMP) & (things.foot == 0)),
    )
    points = shapely.points(people.at)
    assert not shapely.STRtree(polygons_of(town.plan)).query(points, predicate="dwithin", distance=0.4).size
    assert (
        not shapely.STRtree(shapely.points(others.at)).query(points, predicate="dwithin", distance=0.7).size
    )
    assert not paved(town, "asphalt", "line").query(points, predicate="dwithin", distance=0.3).size
    on = paved(town, "pavement").query(points, predicate="intersects")[0]
    assert (np.unique(on) == np.arange(len(points))).all()
    assert (people.tall > 1.4).all() and (people.tall < 2).all()


def test_hedges_are_in_nobodys_way(town: Town) -> None:
    plan, hedges = town.plan, town.plan.hedges
    lines = shapely.linestrings(np.stack([hedges.start, hedges.end], axis=1))
    bodies = shapely.buffer(lines, 0.25, cap_style="flat")
    assert not shapely.STRtree(polygons_of(plan)).query(bodies, predicate="dwithin", distance=0.4).size
    assert not paved(town, "asphalt", "line", "pavement").query(shapely.buffer(bodies, -0.01)).size or (
        shapely.area(
            shapely.intersection(bodies, shapely.union_all(paved(town, "pavement", "asphalt").geometries))
        ).max()
        < 0.02
    )
    one, other = shapely.STRtree(bodies).query(bodies, predicate="intersects")
    assert (one == other).all()
    door = plan.entrance[plan.entrance >= 0]
    a, b = plan.corners[door], plan.corners[plan.following[door]]
    way = (b - a) / np.linalg.norm(b - a, axis=1)[:, None]
    out = np.column_stack([way[:, 1], -way[:, 0]])
    paths = shapely.linestrings(np.stack([(a + b) / 2, (a + b) / 2 + 8 * out], axis=1))
    assert not shapely.STRtree(bodies).query(paths, predicate="intersects").size


def test_the_same_seed_gives_the_same_life(town: Town) -> None:
    again, other = (Town.generate(900, seed).plan for seed in (4, 5))
    for own in ("cars", "hedges"):
        for name in getattr(town.plan, own).__slots__:
            assert (getattr(getattr(town.plan, own), name) == getattr(getattr(again, own), name)).all()
    assert len(other.cars) != len(again.cars) or (other.cars.at != again.cars.at).any()
    for held in (town.plan.cars.at, town.plan.cars.long, town.plan.hedges.start, town.plan.hedges.tall):
        assert np.abs(held * 1000 - np.rint(held * 1000)).max() < 1e-6


def triangles_that_begin(town: Town, *rules: str) -> tuple[np.ndarray, np.ndarray]:
    """Positions (t, 3, 3) of the triangles whose rule is one of some, and the building of each."""
    places = dict(zip(town.grammar.encoding.names, town.grammar.encoding.positions, strict=True))
    corner = town.vertices[town.indices.reshape(-1, 3)]
    wanted = np.array([places[rule] for rule in rules])
    chosen = (corner["start"][:, 2, None] == wanted).all(axis=2).any(axis=1)
    return corner["position"][chosen].astype(float), town.building_of[chosen]


def test_cars_and_hedges_are_closed_but_for_their_foot(town: Town) -> None:
    triangles, _ = triangles_that_begin(town, *RULES)
    assert len(triangles) > 20 * len(town.plan.cars) + 9 * len(town.plan.hedges)
    middles = [*town.plan.cars.at[:12], *((town.plan.hedges.start + town.plan.hedges.end) / 2)[:12]]
    reach = [2.6] * 12 + [4.0] * 12
    at = triangles.mean(axis=1)[:, [0, 2]] * (1, -1)
    closed = 0
    for middle, far in zip(middles, reach, strict=True):
        own = triangles[np.hypot(*(at - middle).T) < far]
        edges = free_edges(own, near=0.002)
        # Under a car one sees the street: its sill is free, and so are wheels below it.
        assert all(max(a[1], b[1]) <= 200 for a, b in edges), (middle, edges)
        closed += len(edges) >= 4
    assert closed == 24


def test_lamps_are_lit_of_cars_on_their_way_and_of_no_others(town: Town) -> None:
    cars, wheels = town.plan.cars, 4
    for lit, own in ((True, cars.moves), (False, ~cars.moves)):
        rules = [f"car.{name}{'Lit' if lit else ''}" for name in ("Lamp", "Tail", "Nose", "Stern")]
        triangles, _ = triangles_that_begin(town, *rules)
        assert own.sum() > 0 and len(triangles) == own.sum() * (4 + 2 * 2)
        near = (
            np.abs(triangles.mean(axis=1)[:, None, [0, 2]] * (1, -1) - cars.at[own]).max(axis=2).min(axis=1)
        )
        assert near.max() < 2.6
    treads, _ = triangles_that_begin(town, "car.Tread")
    assert len(treads) == 3 * wheels * len(cars) and treads[..., 1].min() < 0.01


def test_wheels_are_round_below_the_sill(town: Town) -> None:
    treads, _ = triangles_that_begin(town, "car.Tread")
    own = treads.reshape(len(treads) // 3, 9, 3) if len(treads) % 3 == 0 else treads
    middle = (own.min(axis=1) + own.max(axis=1)) / 2
    for corners, at in zip(own[:40], middle[:40], strict=True):
        out = np.hypot(np.hypot(*(corners - at)[:, [0, 2]].T), corners[:, 1] - 0.33)
        assert out.max() < 0.335 and corners[:, 1].min() < 0.01


def test_cornices_are_closed_and_end_at_walls(town: Town) -> None:
    plan, houses = town.plan, polygons_of(town.plan)
    triangles, building = triangles_that_begin(town, *CORNICES)
    assert np.isin(plan.roof[building], (FLAT, MANSARD)).all()
    some = np.unique(building)
    assert len(some) > 20
    for one in some[:: max(1, len(some) // 30)].tolist():
        own = triangles[building == one]
        out = shapely.distance(shapely.points(own[..., [0, 2]] * (1, -1)), houses[one])
        assert 0.9 * plan.over[one] < out.max() < 2.6 * plan.over[one]
        line = shapely.boundary(houses[one])
        for a, b in free_edges(own, near=0.002):  # only where they meet their wall
            on = shapely.distance(shapely.points([(p[0] / 1000, -p[2] / 1000) for p in (a, b)]), line)
            assert on.max() < 3e-3, (one, a, b)


def test_what_it_takes(town: Town) -> None:
    """About 18 MB of the 200 that 20,000 buildings may take."""
    plan = replace(
        town.plan,
        cars=NO_CARS,
        hedges=NO_HEDGES,
        things=town.plan.things.take(town.plan.things.kind < PERSON),
    )
    bare = build_mesh(plan, town.styles, town.grammar)
    more = town.vertices.nbytes + town.indices.nbytes - bare.vertices.nbytes - bare.indices.nbytes
    assert 200 < more / len(plan) < 1200
