"""Street lamps throw pools of light on the ground, at night, and nothing else that turns does."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from facade_nb.render import Grammar
from facade_nb.render.developing import developed
from facade_nb.render.pipeline import Scene, Viewpoint, choose_device, renderer_of
from facade_nb.render.pipeline.device import DEVICES
from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.pipeline.scene import CHUNK
from facade_nb.render.pipeline.vertices import VERTEX
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.town import Town
from facade_nb.render.town.chance import direction
from facade_nb.render.town.lamplight import DIRECTIONS, FREE, REACH, packed, unpacked
from facade_nb.render.town.things import LAMP

PIXELS = (96, 72)
SPOTS = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32)
GRAMMAR = """
Ground -> Mat(Color, 0, 0.5, 0.5, 0.5, 1)
Post -> Mat(Color, 0, 0.1, 0.1, 0.1, 1)
"""


def scene(size: tuple[float, float], walls: np.ndarray | None = None, east: float = 0.0) -> Scene:
    """A floor of 80 m, and what turns in its middle, or east of that; how far it is from there to walls, in steps."""
    grammar = Grammar.parse(GRAMMAR)
    places = dict(zip(grammar.encoding.names, grammar.encoding.positions, strict=True))
    made = np.zeros((2, 4), VERTEX)
    floor, post = made
    floor["place"], floor["size"], floor["start"] = SPOTS * 80, (80, 80), places["Ground"]
    floor["position"] = np.stack([80 * SPOTS[:, 0] - 40, 0 * SPOTS[:, 0], 40 - 80 * SPOTS[:, 1]], axis=1)
    floor["normal"], floor["tangent"] = (0, 1, 0), (1, 0, 0)
    post["place"], post["size"], post["start"] = SPOTS * size, size, places["Post"]
    post["position"], post["tangent"] = (east, size[1] / 2, 0), (0, 1, 0)
    post["normal"] = 0 if walls is None else packed(walls[None])[0]
    corners = np.array([0, 1, 2, 0, 2, 3], np.uint32) + 4 * np.arange(2, dtype=np.uint32)[:, None]
    chunks = np.zeros(2, CHUNK)
    chunks["first"], chunks["count"] = (0, 6), 6
    chunks["low"] = (-40, 0, -40), (east - 5, 0, -5)
    chunks["high"] = (40, 0, 40), (east + 5, 5, 5)
    return Scene(made.reshape(-1), corners.reshape(-1), grammar, chunks)


def lit(size: tuple[float, float], hour: float, eye: tuple[float, float, float]) -> np.ndarray:
    """How bright the floor is below what turns, and 17 m from there."""
    own = scene(size)
    found = []
    for x in (1.0, 17.0):
        place = Viewpoint.towards(eye, (x, 0.0, 1.0), 4.0)
        looks = Looks(haze=0.0, occlusion=False, smooth=False, shadow=False)
        with renderer_of(own, choose_device()) as renderer:
            drawn = renderer.draw(
                Frame(own, place.frustum(PIXELS), Daytime.at(hour), PIXELS, looks), ["light"]
            )
        found.append(float(drawn["light"][PIXELS[1] // 2, PIXELS[0] // 2, :3].sum()))
    return np.array(found)


@pytest.mark.parametrize("eye", [(4.0, 1.7, 9.0), (20.0, 30.0, 40.0)])
def test_it_is_bright_below_a_lamp_at_night(eye: tuple[float, float, float]) -> None:
    (night, dark), (day, also) = (lit((0.8, 4.4), hour, eye) for hour in (23.0, 13.0))
    assert night > 1.8 * dark > 0
    assert abs(day - also) < 0.02 * day  # by day lamps are out
    plain = lit((0.7, 1.8), 23.0, eye)
    assert abs(plain[0] - plain[1]) < 0.02 * plain[1]


def test_its_light_does_not_go_through_walls() -> None:
    """A wall 3 m east of a lamp: the floor is lit as before on this side, and behind it as if the lamp were far."""
    angle = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    walls = np.ceil(FREE * 3 / REACH / np.maximum(np.cos(angle), 0.01)).clip(1, FREE).astype(int)
    looks = Looks(haze=0.0, occlusion=False, smooth=False, shadow=False)
    found = []
    for own in (scene((0.8, 4.4)), scene((0.8, 4.4), walls), scene((0.8, 4.4), east=300.0)):
        frame = Frame(
            own, Viewpoint((0, 30.0, 0.1), 0.0, -89.9, 60.0).frustum(PIXELS), Daytime.at(23.0), PIXELS, looks
        )
        with renderer_of(own, choose_device()) as renderer:
            found.append(renderer.draw(frame, ["light"])["light"][PIXELS[1] // 2 + 6, :, :3].sum(axis=1))
    x = (np.arange(PIXELS[0]) + 0.5 - PIXELS[0] / 2) * (60 * np.tan(np.pi / 6) / PIXELS[0])
    free, walled, dark = found
    assert np.allclose(free[x < 2.9], walled[x < 2.9], rtol=0.01)
    assert (walled < 0.9 * free)[x > 5.5].all() and (np.diff(walled[x > 5.5]) <= 0).all()
    assert np.allclose(walled[x > 16], dark[x > 16], rtol=0.1) and (free > 3 * dark)[x > 16].all()


def test_ground_far_from_lamps_is_dark() -> None:
    """Less and less light comes from further away, and at last none. The map moves with the eye, its light does not."""
    looks = Looks(haze=0.0, occlusion=False, smooth=False, shadow=False)
    found = {}
    for apart in (15.0, 30.0, 60.0, 300.0):
        own = scene((0.8, 4.4), east=apart)
        place = Viewpoint((0.0, 30.0, 0.1), 0.0, -89.9, 4.0)
        frame = Frame(
            own, place.frustum(PIXELS), replace(Daytime.at(23.0), sky=(0.0, 0.0, 0.0)), PIXELS, looks
        )
        pictures = []
        for device in (each for each in DEVICES.values() if each.available):
            with renderer_of(own, device) as renderer:
                pictures.append(renderer.draw(frame, ["light"])["light"][..., :3].astype(float))
        assert all(np.abs(one - pictures[0]).max() < 2e-3 for one in pictures)
        found[apart] = float(pictures[0].sum(axis=2).mean())
    assert found[15.0] > 1.5 * found[30.0] > 6 * found[60.0] >= 0 == found[300.0]
    moved = scene((0.8, 4.4), east=1500.0)
    moved.vertices["position"][:4] += np.float32((1485, 0, 0))
    moved.chunks["low"][0, 0] += 1485
    moved.chunks["high"][0, 0] += 1485
    place = Viewpoint((1485.0, 30.0, 0.1), 0.0, -89.9, 4.0)
    frame = Frame(moved, place.frustum(PIXELS), replace(Daytime.at(23.0), sky=(0.0, 0.0, 0.0)), PIXELS, looks)
    with renderer_of(moved, choose_device()) as renderer:
        light = renderer.draw(frame, ["light"])["light"][..., :3].astype(float)
    assert abs(light.sum(axis=2).mean() / found[15.0] - 1) < 0.1


def test_light_far_away_does_not_jump_where_the_map_moves() -> None:
    """The map moves by 256 m where the eye passes 128 m: lamps 1.6 to 1.8 km away are as bright as before."""
    looks = Looks(haze=0.0, occlusion=False, smooth=False, shadow=False)
    daytime = replace(Daytime.at(23.0), sky=(0.0, 0.0, 0.0))
    for far in (1600.0, 1700.0, 1800.0):
        own = scene((0.8, 4.4), east=far + 10)
        own.vertices["position"][:4] += np.float32((far, 0, 0))
        own.chunks["low"][0, 0] += far
        own.chunks["high"][0, 0] += far
        found = []
        with renderer_of(own, choose_device()) as renderer:
            for x in (127.9, 128.1):
                frustum = Viewpoint.towards((x, 400.0, 0.1), (far, 0.0, 0.0), 2.0).frustum(PIXELS)
                drawn = renderer.draw(Frame(own, frustum, daytime, PIXELS, looks), ["light"])["light"]
                found.append(float(drawn[PIXELS[1] // 2, PIXELS[0] // 2, :3].sum()))
        assert found[0] > 0
        assert found[1] == pytest.approx(found[0], rel=0.01)


def test_an_evenings_sky_has_no_bands() -> None:
    """Over any 8 × 8 pixels the mean is what was drawn, not the nearest of 256 steps."""
    own = scene((0.7, 4.4))
    place = Viewpoint((0.0, 30.0, 0.1), 20.0, 30.0, 6.0)
    looks = Looks(smooth=False)
    with renderer_of(own, choose_device()) as renderer:
        drawn = renderer.draw(
            Frame(own, place.frustum(PIXELS), Daytime.at(21.5), PIXELS, looks), ["air", "toned"]
        )
    daytime = Daytime.at(21.5)
    true = 255 * developed(drawn["air"][..., :3].astype(np.float32), daytime.exposure)
    shown = drawn["toned"][..., :3].astype(float)

    def means(values: np.ndarray) -> np.ndarray:
        return values.reshape(PIXELS[1] // 8, 8, PIXELS[0] // 8, 8, 3).mean(axis=(1, 3))

    assert np.abs(shown - true).max() < 1.1
    assert np.abs(means(shown) - means(true)).max() < 0.2 < np.abs(means(np.rint(true)) - means(true)).max()


def test_a_lamp_knows_the_walls_around_it() -> None:
    town = Town.generate(400, 3)
    plan, things = town.plan, town.plan.things
    own = town.vertices[(np.abs(town.vertices["size"] - (0.8, 4.4)) < 1e-3).all(axis=1)]
    at, first = np.unique(own["position"][:, [0, 2]] * (1, -1), axis=0, return_index=True)
    steps = unpacked(own["normal"][first])
    assert len(at) == (things.kind == LAMP).sum() and (steps < FREE).any(axis=1).sum() > 0.7 * len(at)
    high = np.flatnonzero(plan.eaves[plan.building] >= 4.0)
    walls = shapely.union_all(
        shapely.linestrings(np.stack([plan.corners[high], plan.corners[plan.following[high]]], axis=1))
    )
    ways = direction(np.arange(DIRECTIONS) / DIRECTIONS)
    for spot, found in list(zip(at, steps, strict=True))[::9]:
        rays = shapely.linestrings(np.stack([np.tile(spot, (DIRECTIONS, 1)), spot + REACH * ways], axis=1))
        hits = shapely.intersection(rays, walls)
        far = np.where(shapely.is_empty(hits), REACH, shapely.distance(shapely.points(spot), hits))
        assert (np.abs(found * REACH / FREE - far - REACH / FREE / 2) <= REACH / FREE / 2 + 1e-3)[
            far < REACH
        ].all()
        assert (found[far == REACH] == FREE).all()


def test_nothing_but_lamps_has_their_size() -> None:
    town = Town.generate(400, 3)
    things = town.plan.things
    alike = (things.wide == 0.8) & (things.tall == 4.4)
    assert alike.any() and (alike == (things.kind == LAMP)).all()
