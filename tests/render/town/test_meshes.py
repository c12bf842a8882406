"""The mesh of a town: surfaces closed and outward, façade coordinates that agree, chunks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from facade_nb.render.pipeline import VERTEX
from facade_nb.render.pipeline.vertices import SEEDS, turning
from facade_nb.render.town import Town
from facade_nb.render.town.cornices import CORNICES
from facade_nb.render.town.mesh import CELL, NOBODY, build_mesh
from facade_nb.render.town.plan import FLAT, GABLE, HIP, MANSARD, PARTY, SHED

from .meshes import free_edges, triangles_of, volumes
from .places import mixed_geojson


@pytest.fixture(scope="module", params=["generated", "real"])
def town(request: pytest.FixtureRequest) -> Town:
    return Town.generate(700, 5) if request.param == "generated" else Town.from_geojson(mixed_geojson(), 3)


@pytest.fixture(scope="module")
def bare(town: Town) -> Town:
    """The town with every wall down to the ground, also between neighbours, and with roofs that end at the walls."""
    plan = replace(town.plan, covered=np.zeros(len(town.plan.covered)), over=np.zeros(len(town.plan)))
    return replace(town, plan=plan, mesh=build_mesh(plan, town.styles, town.grammar))


def test_a_vertex_has_68_bytes(town: Town) -> None:
    assert VERTEX.itemsize == 68 and town.vertices.dtype == VERTEX
    assert town.indices.dtype == np.uint32 and town.indices.max() < len(town.vertices)
    for name in VERTEX.names or ():
        assert np.isfinite(town.vertices[name]).all()


def test_each_building_is_closed_but_for_its_foot(bare: Town) -> None:
    chosen = np.unique(np.linspace(0, len(bare.plan) - 1, 140).astype(int)).tolist()
    for building in chosen:
        triangles = triangles_of(bare, building)
        for a, b in free_edges(triangles):
            assert a[1] == b[1] == 0, (building, bare.plan.roof[building], a, b)


def test_each_building_encloses_what_is_above_its_footprint(bare: Town) -> None:
    """Measured along each axis: a wall that is turned, missing or twice would show in one of them."""
    areas = bare.buildings["area"].to_numpy()
    for building in range(len(bare.plan)):
        measured = volumes(triangles_of(bare, building))
        low = areas[building] * (bare.plan.eaves[building] - 0.46)
        high = areas[building] * (bare.plan.eaves[building] + bare.plan.rise[building])
        assert np.ptp(measured) <= 0.02 + 2e-4 * high, (building, bare.plan.roof[building], measured)
        assert low <= measured[1] <= high + 0.1, (building, bare.plan.roof[building])


def test_all_roofs_are_met() -> None:
    """So that the tests above see each of them."""
    kinds = {
        kind
        for town in (Town.generate(700, 5), Town.from_geojson(mixed_geojson(), 3))
        for kind in town.plan.roof.tolist()
    }
    assert kinds == {FLAT, GABLE, HIP, MANSARD, SHED}


def test_only_what_a_neighbour_covers_is_left_away(town: Town, bare: Town) -> None:
    """Between neighbours the higher one shows its wall from the lower one's eaves on, with its courses as elsewhere."""
    plan = town.plan
    building, following = plan.building, plan.following
    assert (plan.covered[plan.role != PARTY] == 0).all()
    assert (plan.covered <= plan.eaves[building] + 1e-9).all()
    party = np.flatnonzero(plan.role == PARTY)
    assert len(party)
    height = town.vertices["position"][:, 1]
    for edge in party[:: max(1, len(party) // 60)].tolist():
        a, b = plan.corners[edge], plan.corners[following[edge]]
        eaves = plan.eaves[building[edge]]
        on = np.zeros(len(height), bool)
        for x, y in (a, b):
            position = town.vertices["position"].astype(float)
            on |= (np.abs(position[:, 0] - x) < 2e-3) & (np.abs(position[:, 2] + y) < 2e-3)
        size = town.vertices["size"]
        span = float(np.hypot(*(b - a)))
        normal = np.array([b[1] - a[1], 0, b[0] - a[0]]) / span
        own = on & (np.abs(size - (span, eaves)) < 2e-3).all(axis=1)
        own &= (town.vertices["normal"] @ normal) > 0.999
        if eaves - plan.covered[edge] < 0.005:
            assert not own.any()
        else:
            low = height[own].min()
            assert low == pytest.approx(plan.covered[edge], abs=1e-3)
            assert town.vertices["place"][own][:, 1].min() == pytest.approx(low, abs=1e-3)
    alike = build_mesh(replace(plan, over=np.zeros(len(plan))), town.styles, town.grammar)
    assert len(bare.indices) > len(alike.indices)


def still(town: Town) -> tuple[np.ndarray, np.ndarray]:
    """Corners (t, 3, 3) of the triangles that do not turn to whoever looks, and the vertex (t,) that tells of each."""
    corner = town.vertices[town.indices.reshape(-1, 3)]
    chosen = (corner["normal"][:, 2] != 0).any(axis=1)
    return corner["position"][chosen].astype(float), corner[chosen, 2]


def test_normals_stand_on_triangles_and_tangents_lie_in_them(town: Town) -> None:
    """Those that are there twice, to be seen from behind, have the normal of the front."""
    p, told = still(town)
    normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    size = np.linalg.norm(normal, axis=1)
    good = size > 1e-2
    normal, told = normal[good] / size[good][:, None], told[good]
    place = p[good].mean(axis=1).round(3)
    behind = np.einsum("ij,ij->i", normal, told["normal"]) < 0
    assert 0 < behind.sum() < len(behind) / 2
    fronts = set(map(tuple, place[~behind].tolist()))
    assert all(tuple(middle) in fronts for middle in place[behind].tolist())
    normal[behind] *= -1
    assert np.einsum("ij,ij->i", normal, told["normal"]).min() > 0.999
    assert np.abs(np.einsum("ij,ij->i", normal, told["tangent"])).max() < 0.05
    for name in ("normal", "tangent"):
        assert np.abs(np.linalg.norm(told[name].astype(float), axis=1) - 1).max() < 1e-5


def test_places_are_metres_on_the_face(town: Town) -> None:
    """A triangle's last vertex tells its place; from there all of it lies on its façade."""
    p, told = still(town)
    up = np.cross(told["normal"].astype(float), told["tangent"].astype(float))
    way = p - p[:, 2:]
    for axis, along in enumerate((told["tangent"].astype(float), up)):
        place = told["place"][:, axis, None] + np.einsum("ijk,ik->ij", way, along)
        assert place.min() > -6e-3 and (place - told["size"][:, axis, None]).max() < 6e-3
    place, size = town.vertices["place"], town.vertices["size"]
    assert (place >= 0).all() and (place <= size + 1e-3).all() and (size > 0).all()


def test_walls_meet_at_corners(town: Town) -> None:
    """A wall ends where its façade does, where the next begins; all walls of a building share height and seed."""
    upright = np.abs(town.vertices["normal"][:, 1]) < 1e-6
    corner = town.indices.reshape(-1, 3)
    owner = np.full(len(town.vertices), -1, np.int64)
    owner[corner[:, 0]] = town.building_of
    for k in (1, 2):
        owner[corner[:, k]] = town.building_of
    walls = upright & (owner != NOBODY) & (np.abs(town.vertices["size"][:, 1] - _eaves(town, owner)) < 1e-4)
    walls &= np.abs(town.vertices["position"][:, 1] - town.vertices["place"][:, 1]) < 1e-3
    assert walls.sum() > 4 * len(town.plan)
    place, size = town.vertices["place"][walls], town.vertices["size"][walls]
    ends = (np.abs(place[:, 0]) < 1e-3) | (np.abs(place[:, 0] - size[:, 0]) < 1e-3)
    assert ends.all()
    own = (owner != NOBODY) & (owner >= 0)
    assert (town.vertices["seed"][own] == town.plan.seed[owner[own]] / 64).all()


def _eaves(town: Town, owner: np.ndarray) -> np.ndarray:
    own = np.where((owner == NOBODY) | (owner < 0), 0, owner)
    return town.plan.eaves[own]


def test_seeds_are_steps_that_a_float_holds(town: Town) -> None:
    assert (town.plan.seed >= 0).all() and (town.plan.seed < SEEDS).all()
    steps = town.vertices["seed"].astype(np.float64) * 64
    assert (steps == np.rint(steps)).all()


def test_chunks_part_the_mesh(town: Town) -> None:
    chunks = town.chunks
    assert chunks["first"][0] == 0 and (chunks["count"] % 3 == 0).all() and (chunks["count"] > 0).all()
    assert (np.cumsum(chunks["count"])[:-1] == chunks["first"][1:]).all()
    assert chunks["count"].sum() == len(town.indices) == 3 * len(town.building_of)
    for chunk in chunks:
        own = town.vertices[town.indices[chunk["first"] : chunk["first"] + chunk["count"]]]
        turns = turning(own)
        # What turns may reach as far to each side as its diagonal is long.
        reach = np.where(turns, np.linalg.norm(own["size"], axis=1) / 2, 0)[:, None]
        low, high = own["position"] - reach, own["position"] + reach
        assert (low.min(axis=0) >= chunk["low"]).all() and (high.max(axis=0) <= chunk["high"]).all()
        assert (chunk["high"] - chunk["low"] <= high.max(axis=0) - low.min(axis=0) + 8).all()
    building = town.building_of
    assert set(building.tolist()) == {*range(len(town.plan)), int(NOBODY)}
    # What turns has chunks of its own, the last.
    last = town.scene.turning
    assert last.any() and (np.diff(last.astype(int)) >= 0).all()
    of_triangle = np.repeat(last, chunks["count"] // 3)
    assert (of_triangle == turning(town.vertices[town.indices.reshape(-1, 3)[:, 0]])).all()
    # A building lies in one chunk, and its middle in that chunk's cell.
    of = np.repeat(np.arange(len(chunks)), chunks["count"] // 3)
    for one in range(0, len(town.plan), 7):
        (chunk,) = set(of[building == one].tolist())
        assert (chunks["high"][chunk] - chunks["low"][chunk])[0] > 0
    assert CELL == 120


def test_stats_count_what_the_card_gets(town: Town) -> None:
    stats = town.stats()
    sizes = stats["bytes"]
    assert list(stats) == ["buildings", "facades", "vertices", "grammars", "rules", "bytes"]
    assert list(sizes) == ["vertices", "grammars", "tiles", "noise", "images", "total"]
    assert stats["buildings"] == len(town.plan) == len(town.buildings)
    assert sizes["vertices"] == 68 * len(town.vertices) + 4 * len(town.indices)
    assert sizes["noise"] == 256 * 256 * 4
    assert sizes["total"] == sum(value for name, value in sizes.items() if name != "total")
    assert stats["rules"] == len(town.grammar.rules)


def test_starts_are_rules_of_the_style(town: Town) -> None:
    places = dict(zip(town.grammar.encoding.positions, town.grammar.encoding.names, strict=True))
    corner = town.indices.reshape(-1, 3)[:, 2]
    for vertex, building in zip(corner[::37].tolist(), town.building_of[::37].tolist(), strict=True):
        rule = places[tuple(int(v) for v in town.vertices["start"][vertex])]
        if building != NOBODY:
            assert rule in {*town.styles[town.plan.style[building]].starts.values(), *CORNICES}


def test_the_ground_lies_level_and_does_not_overlap(town: Town) -> None:
    ground = town.plan.ground
    a, b, c = (ground.corners[ground.triangles[:, k]] for k in range(3))
    area = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    assert (area > 0).all()
    rim = shapely.union_all([shapely.Polygon(ring) for ring in np.stack([a, b, c], axis=1)], grid_size=0.001)
    assert rim.area == pytest.approx(float(area.sum()), rel=1e-6)
    assert sum(shapely.Polygon(ring).area for ring in rim.interiors) < 1e-3 * len(area)  # and there is no gap
    assert (ground.kind[ground.triangles] == ground.kind[ground.triangles[:, :1]]).all()
