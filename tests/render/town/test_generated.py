"""Towns from a seed: exactly as many buildings, the same everywhere, roles that geometry confirms."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys

import numpy as np
import pytest
import shapely

from facade_nb.design.errors import DesignError
from facade_nb.render.texture import Grammar
from facade_nb.render.town import Town, TownStopped
from facade_nb.render.town.districts import settle
from facade_nb.render.town.looks import looks_of
from facade_nb.render.town.plan import COURT, OUTBUILDING, PARTY, SIDE, STREET, Plan

from .places import mixed_geojson


def digest(town: Town) -> str:
    return hashlib.sha256(town.vertices.tobytes() + town.indices.tobytes()).hexdigest()


@pytest.fixture(scope="module")
def town() -> Town:
    return Town.generate(900, 11)


@pytest.fixture(scope="module", params=["generated", "real"])
def plan(request: pytest.FixtureRequest, town: Town) -> Plan:
    return town.plan if request.param == "generated" else Town.from_geojson(mixed_geojson(), 2).plan


def polygons_of(plan: Plan) -> np.ndarray:
    rings = [plan.corners[a:b] for a, b in zip(plan.rings[:-1], plan.rings[1:], strict=True)]
    found: list[list[np.ndarray]] = [[] for _ in range(len(plan))]
    for number, ring in zip(plan.ring_of.tolist(), rings, strict=True):
        found[number].append(ring)
    return np.array([shapely.Polygon(own[0], own[1:]) for own in found], object)


@pytest.mark.parametrize("buildings", [1, 2, 3, 10, 59, 60, 61, 299, 1000, 4001])
def test_there_are_exactly_as_many_buildings(buildings: int) -> None:
    for seed in (1, 2):
        footprints, _, _ = settle(buildings, seed)
        assert len(footprints.block) == buildings
    if buildings < 100:
        assert len(Town.generate(buildings, 3).buildings) == buildings


@pytest.mark.parametrize("buildings", [0, -1, 100_001, 2.5, True, "many", None, float("nan")])
def test_a_number_of_buildings_that_cannot_be(buildings: object) -> None:
    with pytest.raises(DesignError, match="buildings: expected a whole number from 1 to 100,000; found"):
        Town.generate(buildings)  # type: ignore[arg-type]
    with pytest.raises(DesignError, match="seed: expected a whole number from 0"):
        Town.generate(3, -1)


def test_the_same_seed_gives_the_same_town(town: Town) -> None:
    assert digest(Town.generate(900, 11)) == digest(town)
    assert digest(Town.generate(900, 12)) != digest(town)


def test_the_same_town_on_other_processors(town: Town) -> None:
    """NumPy's matrix products and its exp, sin and the like differ in the last bit between these."""
    code = (
        "import hashlib; from facade_nb.render.town import Town; from tests.render.town.places import mixed_geojson\n"
        "for t in (Town.generate(900, 11), Town.from_geojson(mixed_geojson(), 2)):\n"
        "    print(hashlib.sha256(t.vertices.tobytes() + t.indices.tobytes()).hexdigest())"
    )
    real = digest(Town.from_geojson(mixed_geojson(), 2))
    features = "AVX2 FMA3 AVX512F AVX512CD AVX512_SKX AVX512_CLX AVX512_CNL AVX512_ICL AVX512_SPR"
    for kernel, without in (("Haswell", features), ("SkylakeX", "")):
        told = {"OPENBLAS_CORETYPE": kernel, "NPY_DISABLE_CPU_FEATURES": without, "PYTHONWARNINGS": "ignore"}
        answer = subprocess.run(
            [sys.executable, "-c", code], env=os.environ | told, capture_output=True, text=True
        )
        assert answer.stdout.split() == [digest(town), real], answer.stderr


def test_corners_are_whole_millimetres(plan: Plan) -> None:
    assert (plan.corners == np.rint(plan.corners * 1000) / 1000).all()
    assert (plan.corners[plan.following] != plan.corners).any(axis=1).all()


def test_footprints_do_not_overlap(town: Town) -> None:
    polygons = polygons_of(town.plan)
    assert shapely.is_valid(polygons).all()
    one, other = shapely.STRtree(polygons).query(polygons, predicate="intersects")
    apart = one < other
    shared = shapely.area(shapely.intersection(polygons[one[apart]], polygons[other[apart]]))
    assert shared.max() < 0.05


def test_outer_rings_turn_left_and_courtyards_right(plan: Plan) -> None:
    for k, hole in enumerate(plan.holes.tolist()):
        ring = shapely.LinearRing(plan.corners[plan.rings[k] : plan.rings[k + 1]])
        assert ring.is_ccw != hole
    assert len(plan.rings) - 1 == len(plan.ring_of)


def test_walls_between_neighbours_are_those_that_stand_together(plan: Plan) -> None:
    """By force: at a quarter, a half and three quarters of every wall, is another building right before it?"""
    polygons = polygons_of(plan)
    tree = shapely.STRtree(polygons)
    start, end = plan.corners, plan.corners[plan.following]
    way = end - start
    span = np.hypot(way[:, 0], way[:, 1])
    out = np.stack([way[:, 1], -way[:, 0]], axis=1) / span[:, None]
    building = plan.building
    inside = np.zeros((3, len(span)), bool)
    for row, share in enumerate((0.25, 0.5, 0.75)):
        probes = shapely.points(start + way * share + 0.12 * out)
        probe, hit = tree.query(probes, predicate="within")
        inside[row, probe[hit != building[probe]]] = True
    party = plan.role == PARTY
    long = span > 0.6
    assert (inside.all(axis=0) == party)[long].all()
    assert (~inside.any(axis=0) == ~party)[long].all()
    assert party.sum() > 20


def test_a_covered_wall_is_as_high_as_the_neighbour(plan: Plan) -> None:
    polygons = polygons_of(plan)
    tree = shapely.STRtree(polygons)
    start, end = plan.corners, plan.corners[plan.following]
    way = end - start
    out = np.stack([way[:, 1], -way[:, 0]], axis=1) / np.hypot(way[:, 0], way[:, 1])[:, None]
    building = plan.building
    party = np.flatnonzero(plan.role == PARTY)
    probe, hit = tree.query(shapely.points(((start + end) / 2 + 0.12 * out)[party]), predicate="within")
    highest = np.zeros(len(party))
    other = hit != building[party[probe]]
    np.maximum.at(highest, probe[other], plan.eaves[hit[other]])
    assert np.allclose(plan.covered[party], np.minimum(highest, plan.eaves[building[party]]))


def test_doors_are_on_the_street(plan: Plan, town: Town) -> None:
    building = plan.building
    narrow = np.array([style.least for style in town.styles])[plan.style]
    span = np.hypot(*(plan.corners[plan.following] - plan.corners).T)
    for one, edge in enumerate(plan.entrance.tolist()):
        own = building == one
        street = own & (plan.role == STREET)
        if edge < 0:
            wide = street & (span >= max(narrow[one], 1.5))
            assert plan.kind[one] == OUTBUILDING or not wide.any()
            continue
        assert own[edge] and span[edge] >= narrow[one] and plan.covered[edge] == 0
        assert plan.role[edge] == (STREET if street.any() else min(plan.role[own]))
    assert (plan.entrance >= 0).mean() > 0.8


def test_the_street_is_before_streets_walls_and_not_before_others(town: Town) -> None:
    """By force: straight out of a wall on the street there is a street before there is a house."""
    plan = town.plan
    ground = plan.ground
    asphalt = shapely.union_all(
        shapely.polygons(ground.corners[ground.triangles[ground.kind[ground.triangles[:, 0]] == 0]]),
        grid_size=0.001,
    )
    shapely.prepare(asphalt)
    polygons = polygons_of(plan)
    tree = shapely.STRtree(polygons)
    start, end = plan.corners, plan.corners[plan.following]
    way = end - start
    out = np.stack([way[:, 1], -way[:, 0]], axis=1) / np.hypot(way[:, 0], way[:, 1])[:, None]
    middle = (start + end) / 2
    first = shapely.points(middle + 0.1 * out)
    rays = shapely.linestrings(np.stack([middle + 0.1 * out, middle + 12 * out], axis=1))
    ray, hit = tree.query(rays, predicate="intersects")
    blocked = np.full(len(rays), 100.0)
    np.minimum.at(blocked, ray, shapely.distance(first[ray], shapely.intersection(rays[ray], polygons[hit])))
    paved = shapely.distance(first, shapely.intersection(rays, asphalt))
    sees = np.nan_to_num(paved, nan=1000.0) < blocked
    dense = np.isin(plan.building, np.flatnonzero(np.isin(plan.style, [0, 2, 5])))
    street = plan.role == STREET
    assert sees[street & dense].mean() > 0.97
    assert sees[(plan.role == COURT) & dense].mean() < 0.12  # the last block is not all built up
    assert (plan.role == SIDE).any()


def test_houses_fall_off_towards_the_edge() -> None:
    buildings = Town.generate(3000, 4).buildings
    away = np.hypot(buildings["x"], buildings["z"])
    homes = buildings["kind"].isin(["residential", "shop"])
    ranks = away[homes].rank(pct=True)
    inner, outer = buildings[homes][ranks < 0.2], buildings[homes][ranks > 0.8]
    assert inner["height"].mean() > 1.5 * outer["height"].mean()
    assert inner["shop"].mean() > 0.1 > outer["shop"].mean()


def test_storeys_are_those_that_the_grammar_makes(town: Town) -> None:
    for style, storeys, eaves in zip(town.plan.style, town.plan.storeys, town.plan.eaves, strict=True):
        one = town.styles[style]
        assert one.fit(float(eaves)) == storeys
        assert one.storeys[0] <= storeys <= one.storeys[1]


def test_no_neighbours_are_alike(plan: Plan, town: Town) -> None:
    """Neither wall to wall nor, but for a few, across the street or beside."""
    looks = looks_of(plan.seed, np.array([style.looks for style in town.styles])[plan.style])
    polygons = polygons_of(plan)
    one, other = shapely.STRtree(polygons).query(polygons, predicate="dwithin", distance=0.08)
    touching = one < other
    alike = (plan.style[one] == plan.style[other]) & (looks[one] == looks[other])
    building = plan.building
    walls = {(min(a, b), max(a, b)) for a, b in _wall_pairs(plan, polygons, building)}
    assert len(walls) > 10
    for a, b in walls:
        assert (plan.style[a], looks[a]) != (plan.style[b], looks[b])
    assert alike[touching].mean() < 0.02
    one, other = shapely.STRtree(polygons).query(polygons, predicate="dwithin", distance=8.5)
    near = one < other
    alike = (plan.style[one] == plan.style[other]) & (looks[one] == looks[other])
    assert alike[near].mean() < 0.02


def _wall_pairs(plan: Plan, polygons: np.ndarray, building: np.ndarray) -> list[tuple[int, int]]:
    start, end = plan.corners, plan.corners[plan.following]
    way = end - start
    out = np.stack([way[:, 1], -way[:, 0]], axis=1) / np.hypot(way[:, 0], way[:, 1])[:, None]
    party = np.flatnonzero(plan.role == PARTY)
    probe, hit = shapely.STRtree(polygons).query(
        shapely.points(((start + end) / 2 + 0.12 * out)[party]), predicate="within"
    )
    return [
        (int(building[party[p]]), int(h)) for p, h in zip(probe, hit, strict=True) if building[party[p]] != h
    ]


def test_a_look_is_what_the_first_choice_gives() -> None:
    names = [f"R{k}" for k in range(7)]
    text = f"S -> RandUni(0, {', '.join(names)})\n" + "\n".join(
        f"{name} -> Mat(Color, 0, {k / 10}, 0, 0, 1)" for k, name in enumerate(names)
    )
    grammar = Grammar.parse(text)
    seeds = np.random.default_rng(1).integers(0, 1 << 20, (60, 2), dtype=np.int32)
    looks = looks_of(seeds, np.full(60, 7))
    assert len(set(looks.tolist())) == 7
    for (x, y), look in zip(seeds.tolist(), looks.tolist(), strict=True):
        surface = grammar.evaluate([(1.0, 1.0)], (12, 9), (x / 64, y / 64))
        assert surface.rule.tolist() == [1 + look]


def test_progress_is_told_and_a_town_can_be_stopped() -> None:
    told: list[tuple[float, str]] = []
    Town.generate(40, 1, progress=lambda share, name: told.append((share, name)))
    shares = [share for share, _ in told]
    assert shares == sorted(shares) and shares[0] == 0 and shares[-1] == 1 and len(told) >= 6
    for calls in range(len(told) - 1):
        asked = iter([False] * calls + [True])
        with pytest.raises(TownStopped, match=f"stopped before its {told[calls][1]}"):
            Town.generate(40, 1, should_stop=lambda asked=asked: next(asked))  # type: ignore[misc]
    real: list[str] = []
    Town.from_geojson(mixed_geojson(), progress=lambda share, name: real.append(name))
    assert real[0] == "footprints" and real[-1] == ""


def test_solved_fronts_stand_where_they_fit_and_never_twice_in_sight(plan: Plan, town: Town) -> None:
    solved = np.array([style.widths is not None for style in town.styles])[plan.style]
    span = np.hypot(*(plan.corners[plan.following] - plan.corners).T)
    building = plan.building
    for one in np.flatnonzero(solved).tolist():
        street = np.flatnonzero((building == one) & (plan.role == STREET))
        assert len(street) == 1 and plan.entrance[one] == street[0]
        assert town.styles[plan.style[one]].suits(float(span[street[0]]), float(plan.eaves[one]))
    polygons = polygons_of(plan)
    a, b = shapely.STRtree(polygons).query(polygons, predicate="dwithin", distance=8.5)
    assert not (solved[a] & (plan.style[a] == plan.style[b]) & (a != b)).any()


def test_there_are_solved_fronts_in_the_town(town: Town) -> None:
    solved = np.array([style.widths is not None for style in town.styles])
    assert solved[town.plan.style].sum() > 2
