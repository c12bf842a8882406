"""What stands about in a town: where it stands, that it turns to whoever looks, that leaves are open; roofs' eaves."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import shapely

from facade_nb.render import Grammar
from facade_nb.render.pipeline import Viewpoint, choose_device, renderer_of
from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.pipeline.scene import Scene
from facade_nb.render.pipeline.vertices import VERTEX
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.town import Town
from facade_nb.render.town.mesh import build_mesh
from facade_nb.render.town.things import BIRCH, CHIMNEY, KINDS, LAMP, SPRUCE, Things

from .places import mixed_geojson
from .test_generated import polygons_of

TREES = (*range(BIRCH + 1), SPRUCE)


@pytest.fixture(scope="module", params=["generated", "real"])
def town(request: pytest.FixtureRequest) -> Town:
    return Town.generate(900, 4) if request.param == "generated" else Town.from_geojson(mixed_geojson(), 3)


def of(town: Town, *kinds: int) -> Things:
    return town.plan.things.take(np.isin(town.plan.things.kind, kinds))


def paved(town: Town, *names: str) -> shapely.STRtree:
    ground = town.plan.ground
    chosen = np.isin(ground.kind[ground.triangles[:, 0]], [ground.names.index(name) for name in names])
    return shapely.STRtree(shapely.polygons(ground.corners[ground.triangles[chosen]]))


def test_there_are_trees_lamps_and_chimneys(town: Town) -> None:
    count = np.bincount(town.plan.things.kind, minlength=len(KINDS))
    assert (count[list(TREES)] > 0).all() and count[CHIMNEY] > 0
    assert count[LAMP] > 0


def test_nothing_stands_in_a_house_or_on_a_road(town: Town) -> None:
    things = of(town, *TREES, LAMP)
    houses = shapely.STRtree(polygons_of(town.plan))
    points = shapely.points(things.at)
    room = np.where(things.kind == LAMP, 0.2, things.wide / 2)
    hit = houses.query(shapely.buffer(points, room), predicate="intersects")
    assert not hit.size, things.at[hit[0]]
    on = paved(town, "asphalt", "line").query(points, predicate="dwithin", distance=0.2)
    assert not on.size, things.at[on[0]]


def test_things_are_whole_millimetres_and_those_of_the_seed(town: Town) -> None:
    things = town.plan.things
    for name in ("at", "foot", "tall", "wide"):
        mm = getattr(things, name) * 1000
        assert np.abs(mm - np.rint(mm)).max() < 1e-6
    assert (things.tall > 1).all() and (things.wide > 0.3).all()
    if not len(town.plan.roads):
        again, other = (Town.generate(900, seed).plan.things for seed in (4, 5))
        assert (again.at == things.at).all() and (again.kind == things.kind).all()
        assert len(other) != len(things) or (other.at != things.at).any()


def test_chimneys_stand_on_ridges(town: Town) -> None:
    plan, chimneys = town.plan, of(town, CHIMNEY)
    tree = shapely.STRtree(polygons_of(plan))
    chimney, building = tree.query(shapely.points(chimneys.at), predicate="within")
    assert (np.unique(chimney) == np.arange(len(chimneys))).all()
    ridge = (plan.eaves + plan.rise)[building]
    foot, top = chimneys.foot[chimney], (chimneys.foot + chimneys.tall)[chimney]
    assert np.minimum(np.abs(foot + 0.85 - ridge), np.abs(top - 0.85 - ridge)).max() < 2e-3
    assert (top > ridge).all() and (foot > plan.eaves[building] - 1).all()


def test_things_take_little_memory() -> None:
    """About 10 MB of the 200 that 20,000 buildings may take."""
    town = Town.generate(2000, 1)
    bare = build_mesh(replace(town.plan, things=town.plan.things.take([])), town.styles, town.grammar)
    more = town.mesh.vertices.nbytes + town.mesh.indices.nbytes - bare.vertices.nbytes - bare.indices.nbytes
    assert 100 < more / len(town.plan) < 700


# Roofs


def test_roofs_hang_over_but_not_over_neighbours(town: Town) -> None:
    plan = town.plan
    houses = polygons_of(plan)
    corner = town.indices.reshape(-1, 3)
    owner = np.repeat(town.building_of.astype(np.int64), 3)
    vertex = corner.ravel()[owner < len(plan)]
    owner = owner[owner < len(plan)]
    at = shapely.points(town.vertices["position"][vertex][:, [0, 2]].astype(float) * (1, -1))
    out = shapely.distance(at, houses[owner])
    over = plan.over[owner]
    assert (out <= 3.0 * over + 5e-3).all()  # at corners further, for both eaves go on
    wide = np.zeros(len(plan))
    np.maximum.at(wide, owner, out)
    free = np.flatnonzero(plan.over > 0)
    assert (wide[free] > 0.6 * plan.over[free]).mean() > 0.7
    tree = shapely.STRtree(shapely.buffer(houses, -0.75))
    inside = tree.query(at[out > 0.01], predicate="within")
    assert len(inside[1]) <= 0.002 * (out > 0.01).sum()


SQUARE = {
    "type": "Polygon",
    "coordinates": [[[11.5, 49.9], [11.50016, 49.9], [11.50016, 49.90009], [11.5, 49.90009], [11.5, 49.9]]],
}
PIXELS = (96, 72)


def light_of(town: Town, place: Viewpoint, hour: float = 13.0) -> dict[str, np.ndarray]:
    looks = Looks(haze=0.0, relief=False, occlusion=False, smooth=False)
    with renderer_of(town.scene, choose_device()) as renderer:
        frame = Frame(renderer.scene, place.frustum(PIXELS), Daytime.at(hour), PIXELS, looks)
        return renderer.draw(frame, ["light", "facing"])


def test_eaves_throw_a_shadow_on_the_wall_below() -> None:
    town = Town.from_geojson(SQUARE, 1)
    plan = replace(town.plan, things=town.plan.things.take([]))
    with_, without = (
        replace(town, plan=own, mesh=build_mesh(own, town.styles, town.grammar))
        for own in (plan, replace(plan, over=np.zeros(1)))
    )
    assert plan.over[0] > 0
    west, south, east, _ = plan.bounds
    eaves = float(plan.eaves[0])
    x, z = (west + east) / 2, -south
    place = Viewpoint.towards((x, eaves - 1.0, z + 5.0), (x, eaves - 0.6, z), 26.0)
    one, other = (light_of(own, place) for own in (with_, without))
    wall = (one["facing"][..., 2] > 0.9) & (other["facing"][..., 2] > 0.9)
    assert wall.mean() > 0.4
    darker = one["light"][..., :3].sum(axis=2) < 0.75 * other["light"][..., :3].sum(axis=2)
    rows = np.flatnonzero(wall.any(axis=1))
    top, below = rows[2], rows[-3]
    assert darker[top][wall[top]].mean() > 0.6  # below the eaves it is dark
    assert darker[below][wall[below]].mean() < 0.2  # but not far below


# What turns


GRAMMAR = """
Crown -> Layer(Back, Leaves)
Back -> Mat(Color, 0, 0.1, 0.2, 0.1, 1)
Leaves -> Mat(Color, Fit:crown, 0, 0, 1, 1)
Whole -> Mat(Color, 0, 0.5, 0.4, 0.3, 1)
Ground -> Mat(Color, 0, 0.5, 0.5, 0.5, 1)
"""


def quads(*given: tuple[str, bool]) -> Scene:
    """Quads of 4 × 6 m that turn, their middles 5 m above the origin, above a floor."""
    grammar = Grammar.parse(GRAMMAR)
    places = dict(zip(grammar.encoding.names, grammar.encoding.positions, strict=True))
    made = np.zeros((len(given) + 1, 4), VERTEX)
    spots = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32)
    for k, (rule, upright) in enumerate(given):
        made[k]["position"] = (0, 5, 0)
        made[k]["size"] = (4, 6)
        made[k]["place"] = spots * (4, 6)
        made[k]["start"] = places[rule]
        made[k]["tangent"] = (0, 1 if upright else 0, 0)
    floor = made[-1]
    floor["place"], floor["size"], floor["start"] = spots * 40, (40, 40), places["Ground"]
    floor["position"] = np.stack([40 * spots[:, 0] - 20, 0 * spots[:, 0], 20 - 40 * spots[:, 1]], axis=1)
    floor["normal"], floor["tangent"] = (0, 1, 0), (1, 0, 0)
    corners = np.array([0, 1, 2, 0, 2, 3], np.uint32) + 4 * np.arange(len(made), dtype=np.uint32)[:, None]
    return Scene(made.reshape(-1), corners.reshape(-1), grammar)


@pytest.mark.parametrize("eye", [(20, 5, 0), (0, 5, 20), (-14, 5, -14), (12, 17, 12), (0.5, 30, 0)])
@pytest.mark.parametrize("upright", [True, False])
def test_it_is_as_wide_from_all_sides(eye: tuple[float, float, float], upright: bool) -> None:
    scene = quads(("Whole", upright))
    place = Viewpoint.towards(eye, (0, 5, 0), 40.0)
    with renderer_of(scene, choose_device()) as renderer:
        frame = Frame(scene, place.frustum(PIXELS), Daytime.at(13), PIXELS, Looks(smooth=False))
        drawn = renderer.draw(frame, ["facing", "place", "rule"])
    seen = (drawn["place"][..., 2:] == (4, 6)).all(axis=2)
    away = np.array(eye, float) - (0, 5, 0)
    far = float(np.linalg.norm(away))
    metre = PIXELS[0] / (2 * np.tan(np.radians(20))) / far
    rows, columns = np.flatnonzero(seen.any(axis=1)), np.flatnonzero(seen.any(axis=0))
    tall = 6 * (np.hypot(away[0], away[2]) / far if upright else 1.0)
    if tall * metre < 2:
        return  # from right above one sees nothing of what stands upright
    assert abs(columns[-1] - columns[0] + 1 - 4 * metre) < 0.16 * 4 * metre + 1.5
    assert abs(rows[-1] - rows[0] + 1 - tall * metre) < 0.25 * tall * metre + 1.5
    normal = drawn["facing"][seen][:, :3].mean(axis=0)
    towards = away * (1, 0, 1) if upright else away
    assert normal @ towards / np.linalg.norm(towards) > 0.98


def test_leaves_are_open_to_the_eye_and_to_the_sun() -> None:
    place = Viewpoint.towards((-4, 12, 16), (1, 1.5, -2), 75.0)
    shares, dark = [], []
    for given in ([], [("Crown", False)], [("Whole", False)]):
        scene = quads(*given)
        with renderer_of(scene, choose_device()) as renderer:
            frame = Frame(scene, place.frustum(PIXELS), Daytime.at(12.5), PIXELS, Looks(smooth=False))
            drawn = renderer.draw(frame, ["place", "color", "light"])
        seen = (drawn["place"][..., 2:] == (4, 6)).all(axis=2)
        assert (drawn["color"][seen][:, 3] > 0.99).all()  # what is seen is closed
        shares.append(int(seen.sum()))
        floor = (drawn["place"][..., 2:] == (40, 40)).all(axis=2)
        bright = drawn["light"][..., :3].sum(axis=2)
        dark.append(int((bright[floor] < 0.6 * bright[floor].max()).sum()))
    assert shares[0] == 0 and 0.35 * shares[2] < shares[1] < 0.9 * shares[2]
    assert dark[0] == 0 and 0.35 * dark[2] < dark[1] < 0.95 * dark[2]


def test_nothing_pops_or_flickers_on_a_walk() -> None:
    """From step to step of a few centimetres little changes in the whole picture, and nowhere all at once."""
    town = Town.generate(300, 2)
    trees = of(town, *range(BIRCH + 1)).at
    near = trees[np.argsort((trees * trees).sum(axis=1))[3]]
    looks = Looks(relief=False, occlusion=False)
    frames = []
    with renderer_of(town.scene, choose_device()) as renderer:
        for step in range(10):
            eye = (float(near[0]) + 26.0 - 0.04 * step, 1.7, float(-near[1]) + 9.0)
            place = Viewpoint.towards(eye, (float(near[0]), 3.0, float(-near[1])), 60.0)
            frame = Frame(town.scene, place.frustum((160, 120)), Daytime.at(15), (160, 120), looks)
            frames.append(renderer.draw(frame)["picture"][..., :3].astype(int))
    for before, after in pairwise(frames):
        change = np.abs(after - before).max(axis=2)
        assert change.mean() < 5.0
        blocks = (change > 70).reshape(15, 8, 20, 8).mean(axis=(1, 3))
        assert blocks.max() < 0.75
