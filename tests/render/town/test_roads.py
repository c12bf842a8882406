"""Streets among real buildings: where they run, what they keep away from, and that each door has one."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

from facade_nb.render.town import Town
from facade_nb.render.town.passages import passages_of, runs_of
from facade_nb.render.town.roads import LANE, MAIN, STREET

from .places import box, collection, feature, place
from .test_generated import polygons_of

ROWS = [box(20.0 * i, y, 12.0, 10.0) for y in (0.0, 28.0, 64.0, 92.0) for i in range(8)]
"""Two times two rows: 18 m from row to row of a pair, and 26 m from pair to pair."""


def village(*others: Any) -> dict[str, Any]:
    return collection(*(feature(shape) for shape in ROWS), feature(box(45.0, 49.0, 5.0, 4.0)), *others)


@pytest.fixture(scope="module")
def town() -> Town:
    return Town.from_geojson(village(), 3)


def laid(town: Town, *kinds: str) -> Any:
    """What is of some kinds, as one."""
    ground = town.plan.ground
    wanted = np.isin(ground.kind[ground.triangles[:, 0]], [ground.names.index(kind) for kind in kinds])
    return shapely.union_all(shapely.polygons(ground.corners[ground.triangles[wanted]]), grid_size=0.001)


def test_pieces_follow_each_other_whichever_way_they_were_noted() -> None:
    links = np.array(
        [[-1, 2], [1, 5], [-1, 3], [7, 6], [-1, -1]]
    )  # 0 → 1 → 2 backwards; a ring of one; alone
    links[3] = [7, 6]
    assert runs_of(links) == [[(0, 0), (1, 0), (2, 1)], [(4, 0)], [(3, 0)]]


def test_between_two_walls_one_goes_in_the_middle() -> None:
    corners = np.array([*box(0, 0, 40, 8), *box(0, 20, 40, 8)], float)
    passages = passages_of(np.array([0, 4, 8]), corners)
    inner = passages.points[(passages.points[:, 0] > 2) & (passages.points[:, 0] < 38)]
    assert len(inner) and np.abs(inner[:, 1] - 14.0).max() < 0.01
    assert passages.room.max() == pytest.approx(6.0, abs=0.01)


def test_a_street_runs_between_rows_and_none_behind_them(town: Town) -> None:
    lines = town.plan.roads.lines()[town.plan.roads.kind < LANE]
    outline = polygons_of(town.plan)
    low, high = np.array(shapely.total_bounds(outline)).reshape(2, 2)
    for y, there in ((19.0, True), (51.0, False), (83.0, True)):
        across = shapely.LineString([(low[0] + 15, low[1] + y), (high[0] - 15, low[1] + y)])
        along = shapely.length(shapely.intersection(shapely.buffer(across, 3.0), lines)).sum()
        assert bool(along > 0.9 * across.length) is there


def test_no_street_comes_near_a_house(town: Town) -> None:
    houses = shapely.STRtree(polygons_of(town.plan))
    assert not houses.query(laid(town, "asphalt"), predicate="dwithin", distance=0.3).size
    assert not houses.query(town.plan.roads.lines(), predicate="dwithin", distance=0.3).size


def test_from_each_door_one_comes_to_a_street_with_dry_feet(town: Town) -> None:
    plan = town.plan
    edge = plan.entrance[plan.entrance >= 0]
    assert len(edge) == len(ROWS)
    a, b = plan.corners[edge], plan.corners[plan.following[edge]]
    way = (b - a) / np.hypot(*(b - a).T)[:, None]
    step = shapely.points((a + b) / 2 + 0.4 * np.column_stack([way[:, 1], -way[:, 0]]))
    parts = shapely.get_parts(shapely.buffer(laid(town, "asphalt", "pavement", "court"), 0.02))
    streets = parts[shapely.intersects(parts, laid(town, "asphalt"))]
    assert len(streets) == 1
    assert shapely.intersects(streets[0], step).all()


def test_doors_look_at_streets(town: Town) -> None:
    y = town.plan.corners[town.plan.entrance[town.plan.entrance >= 0], 1]
    rows = np.sort(y - town.plan.corners[:, 1].min()).reshape(4, 8)
    assert np.allclose(rows, np.array([10, 28, 74, 92])[:, None], atol=0.5)


def test_the_same_input_gives_the_same_bytes(town: Town) -> None:
    again = Town.from_geojson(village(), 3)
    assert again.plan.roads.points.tobytes() == town.plan.roads.points.tobytes()
    assert again.vertices.tobytes() == town.vertices.tobytes()
    mm = again.plan.roads.points * 1000
    assert np.abs(mm - np.rint(mm)).max() < 1e-6


def test_streets_that_are_told_are_taken_as_they_are() -> None:
    def street(kind: str, *points: tuple[float, float]) -> dict[str, Any]:
        line = {"type": "LineString", "coordinates": [place(x, y) for x, y in points]}
        return {"type": "Feature", "properties": {"highway": kind}, "geometry": line}

    told = (
        street("primary", (-20.0, 51.0), (180.0, 51.0)),
        street("residential", (-10.0, 5.0), (170.0, 5.0)),  # through the houses of a row
        street("proposed", (-10.0, 19.0), (170.0, 19.0)),
    )
    town = Town.from_geojson(village(*told), 3)
    kinds, lines = town.plan.roads.kind, town.plan.roads.lines()
    assert set(kinds.tolist()) == {MAIN, STREET}
    assert shapely.length(lines[kinds == MAIN]).sum() == pytest.approx(
        201.0 - 5.6, abs=0.6
    )  # a shed stands in it
    assert not shapely.STRtree(polygons_of(town.plan)).query(lines, predicate="dwithin", distance=0.25).size
    assert "not a polygon" not in town.left_out
