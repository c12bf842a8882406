"""Photographs: which façade is met, what shades what, and what light does at which hour."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely

from facade_nb.cli import main
from facade_nb.design.errors import DesignError
from facade_nb.gallery import grammar
from facade_nb.render.camera import Camera
from facade_nb.render.developing import developed
from facade_nb.render.pipeline.device import DEVICES, choose_device
from facade_nb.render.pipeline.frame import Frame
from facade_nb.render.pipeline.frame import Looks as PipelineLooks
from facade_nb.render.pipeline.renderer import renderer_of
from facade_nb.render.pipeline.scene import Scene
from facade_nb.render.pipeline.street import KERB, PAVEMENT, ground
from facade_nb.render.pipeline.viewpoint import Viewpoint
from facade_nb.render.texture import Grammar
from facade_nb.render.texture.daytime import Daytime, light
from facade_nb.render.texture.facades import Facade, box
from facade_nb.render.texture.photograph import Photo, flat, photograph, photographs, save_picture
from facade_nb.render.texture.picture import texture_pixels
from facade_nb.render.tiles import TileSet
from scripts.docs.exhibits import EXHIBITS, exhibit, layout_exhibit

PLAIN = Grammar.parse(
    "S -> Mat(Color, 0, 0.5, 0.5, 0.5, 1)  Red -> Mat(Color, 0, 1, 0, 0, 1)  Veil -> Mat(Color, 0, 0, 0, 1, 0.25)"
)


def test_a_transparent_facade_shows_what_is_behind() -> None:
    behind = Facade(PLAIN, (4.0, 4.0), (0.0, 0.0, -1.0), start="Red")
    before = Facade(PLAIN, (4.0, 4.0), (0.0, 0.0, 0.0), start="Veil")
    photo = Photo((16, 16), 12.0, Camera(azimuth=0, height=2, fill=1.0), (1.5, 1.5, 2.5, 2.5), samples=1)
    alone = photograph([behind], photo)[8, 8].astype(float)
    both = photograph([before, behind], photo)[8, 8].astype(float)
    swapped = photograph([behind, before], photo)[8, 8].astype(float)
    assert alone[0] > 150
    assert 0.35 * alone[0] < both[0] < 0.9 * alone[0]  # a veil, and its shadow
    assert both[2] > alone[2]
    assert both == pytest.approx(swapped)


@pytest.mark.parametrize("hour", [0, 3, 6, 9, 12, 15, 18, 21, 24])
def test_the_light_of_an_hour_is_light(hour: float) -> None:
    daytime = Daytime.at(hour)
    assert np.linalg.norm(daytime.towards) == pytest.approx(1)
    for colour in (
        daytime.sun,
        daytime.sky,
        daytime.ground,
        daytime.indoors,
        daytime.zenith,
        daytime.horizon,
        daytime.afterglow,
    ):
        assert min(colour) >= 0
    assert 0 <= daytime.lamps <= 1


def test_a_sun_that_has_set_leaves_light_on_its_side_of_the_sky() -> None:
    dusk = Daytime.at(20.75)
    side = np.array([dusk.towards[0], 0.0, dusk.towards[2]], np.float32)
    to, opposite, above = dusk.backdrop(np.array([side, -side, (0, 1, 0)], np.float32))
    assert to[0] > 2 * to[2] > 2 * opposite[2] and opposite[2] > opposite[0] and above[2] > 1.5 * above[0]
    assert sum(Daytime.at(24).afterglow) == 0 == sum(Daytime.at(13).afterglow)


def test_the_day_goes_as_days_go() -> None:
    morning, noon, evening, night = map(Daytime.at, (8.0, 13.0, 18.0, 23.5))
    assert morning.towards[0] < -0.3 and evening.towards[0] > 0.3 and abs(noon.towards[0]) < 0.01
    assert noon.towards[1] > morning.towards[1]
    assert noon.lamps == 0 and night.lamps == 1
    assert sum(night.sun) == 0 and sum(noon.sun) > 5
    hours = np.linspace(0, 24, 481)
    for name in ("sky", "indoors", "exposure", "lamps"):  # nothing jumps, also not over midnight
        values = np.array([np.mean(getattr(Daytime.at(h), name)) for h in hours])
        assert np.abs(np.diff(values)).max() < 0.1
        assert values[0] == pytest.approx(values[-1], abs=1e-6)
    with pytest.raises(ValueError, match="hour: expected 0 to 24; found 25"):
        Daytime.at(25)


def _lit(
    hour: float, *, normal: tuple[float, ...] = (0, 0, 0, 0), specular: tuple[float, ...] = (0, 0, 0, 0)
) -> np.ndarray:
    one = np.ones(1, np.float32)
    color = np.float32([[0.5, 0.5, 0.5, 1]])
    ahead = np.float32([[0, 0, -1]])
    return light(color, np.float32([normal]), np.float32([specular]), ahead, Daytime.at(hour), one, 3 * one)[
        0
    ]


def test_a_room_has_no_sun_and_its_lamp_burns_at_night() -> None:
    indoors = (0.5, 0.5, 0.5, 1)
    assert _lit(12.0, normal=indoors).mean() < 0.4 * _lit(12.0).mean()
    dark, lamp = _lit(23.0, normal=indoors), _lit(23.0, normal=indoors, specular=(1, 0.7, 0.4, 1))
    assert lamp.mean() > 10 * dark.mean()
    assert lamp[0] > lamp[1] > lamp[2]
    assert _lit(13.0, normal=indoors, specular=(1, 0.7, 0.4, 1)) == pytest.approx(_lit(13.0, normal=indoors))


def test_a_pane_is_no_lamp() -> None:
    """Glass that mirrors a third, before a dark room: its own specular value must not light the room."""
    pane = (0.5, 0.5, 1.0)
    normal = (*(np.float32(pane) / 3 + np.float32([0.5, 0.5, 0.5]) * 2 / 3), 1)
    assert _lit(23.0, normal=normal, specular=(1 / 3, 1 / 3, 1 / 3, 1 / 3)) == pytest.approx(
        _lit(23.0, normal=normal), rel=1e-4
    )


def test_normals_turn_towards_the_sun() -> None:
    left, right = (0.2, 0.5, 0.9, 1), (0.8, 0.5, 0.9, 1)
    assert _lit(8.5, normal=left).mean() > 1.3 * _lit(8.5, normal=right).mean()
    assert _lit(17.5, normal=right).mean() > 1.3 * _lit(17.5, normal=left).mean()


@pytest.mark.parametrize("seed", [(0.0, 0.0), (31.7, 5.3), (-23.1, 47.9)])
def test_all_walls_of_a_house_are_of_one_kind(seed: tuple[float, float]) -> None:
    """The first choice belongs to the corner and the seed: front, sides, gables and back make the same one."""
    chance = Grammar.parse(
        "S -> RandUni(0, A, B, C, D)  Side -> RandUni(0, A, B, C, D)  Gable -> RandUni(0, A, B, C, D)\n"
        + "  ".join(f"{name} -> Mat(Color, 0, {k / 4}, 0, 0, 1)" for k, name in enumerate("ABCD"))
    )
    house = box(chance, 6, 5, 4, seed=seed, roof=2, side="Side", gable="Gable")
    walls = [one for one in house if one.start in (None, "Side", "Gable")]
    assert len(walls) == 8  # two of them the roof, which has no rule of its own here
    kinds = {
        one.grammar.rules[
            one.grammar.evaluate([(0.5, 0.5)], one.size, seed=one.seed, start=one.start).rule[0]
        ].name
        for one in walls
    }
    assert len(kinds) == 1


def test_a_flat_picture_is_what_the_grammar_says(tmp_path: Path) -> None:
    grammar = Grammar.parse(
        "S -> SplitX(Rel, 1, A, Rel, 1, B)  A -> Mat(Color, 0, 1, 0, 0, 1)  B -> Mat(Color, 0, 0, 0, 1, 1)"
    )
    pixels = flat(grammar, (2, 1), (8, 4))
    assert pixels.shape == (4, 8, 3)
    assert (pixels[:, :4] == (255, 0, 0)).all() and (pixels[:, 4:] == (0, 0, 255)).all()
    for name, head in (("a.png", b"\x89PNG"), ("a.jpg", b"\xff\xd8")):
        save_picture(pixels, tmp_path / name)
        assert (tmp_path / name).read_bytes().startswith(head)


def test_photographs_at_several_hours_are_those_of_each_hour() -> None:
    houses = box(Grammar.parse(grammar("figure-10"), TileSet.builtin(64)), 10, 9, 5, seed=(4.6, 2.1), roof=2)
    photo = Photo((100, 80), 9.5, samples=1)
    pictures = photographs(houses, photo, (9.5, 19.8, 23.0))
    assert len({picture.tobytes() for picture in pictures}) == 3
    for hour, picture in zip((9.5, 19.8, 23.0), pictures, strict=True):
        assert np.array_equal(picture, photograph(houses, replace(photo, hour=hour)))


TAKE = """
import sys
import numpy as np
from facade_nb.gallery import grammar
from facade_nb.render import Grammar
from facade_nb.render.texture.facades import Facade
from facade_nb.render.texture.photograph import Photo, photograph
house = [Facade(Grammar.parse(grammar("figure-10")), (10.0, 9.0), seed=(4.6, 2.1))]
np.save(sys.argv[2], photograph(house, Photo((120, 90), 19.5, samples=1, backend=sys.argv[1])))
"""


def test_every_backend_takes_the_same_photograph(tmp_path: Path) -> None:
    pictures = []
    for name in [name for name, device in DEVICES.items() if device.available]:
        file = tmp_path / f"{name}.npy"  # each in a process of its own, as `backends` has it
        subprocess.run([sys.executable, "-c", TAKE, name, str(file)], check=True)
        pictures.append(np.load(file).astype(int))
    assert len(pictures) >= 1 and pictures[0].std() > 10
    for other in pictures[1:]:
        assert (np.abs(pictures[0] - other).max(axis=2) <= 3).mean() > 0.995
    with pytest.raises(ValueError, match="backend: expected one of osmesa, egl; found 'osmes'; did you mean"):
        photograph([Facade(PLAIN, (1.0, 1.0))], Photo(backend="osmes"))


def test_a_picture_at_an_hour_is_lit(tmp_path: Path) -> None:
    """`hour` lights what `texture_pixels` gives without it; alpha stays, and so does what is not there."""
    house = Grammar.parse(grammar("figure-8"), TileSet.builtin(64))
    given = {"size": (4.0, 4.0), "pixels": (40, 40), "backend": "cpu"}
    day, night = (texture_pixels(house, **given, hour=hour).astype(int) for hour in (10.5, 23.0))
    wall, room = (slice(2, 8), slice(2, 38)), (slice(16, 26), slice(17, 19))
    assert day[wall][..., :3].mean() > 2.5 * night[wall][..., :3].mean()
    assert night[room][..., :3].mean() > 1.5 * night[wall][..., :3].mean()  # the lamp is lit
    plain = texture_pixels(house, **given, antialias="none", hour=10.5)
    points = np.array([[(i + 0.5) / 10, 4 - (j + 0.5) / 10] for j in range(40) for i in range(40)])
    surface = house.evaluate(points, (4, 4))
    ahead, ones = np.tile(np.float32([0, 0, -1]), (1600, 1)), np.ones(1600, np.float32)
    lit = light(*surface[:3], ahead, Daytime.at(10.5), ones, points[:, 1].astype(np.float32))
    expected = developed(lit, Daytime.at(10.5).exposure).reshape(40, 40, 3) * 255
    assert np.abs(plain[..., :3] - expected).max() <= 1
    half = Grammar.parse(
        "S -> SplitX(Rel, 1, Grey, Rel, 1, Out)  Grey -> Mat(Color, 0, 0.5, 0.5, 0.5, 1)  Out -> Skip(0)"
    )
    picture = texture_pixels(half, size=(2, 1), pixels=(8, 4), backend="cpu", hour=12)
    assert (picture[:, :4, 3] == 255).all() and (picture[:, 4:, 3] == 0).all()
    file = tmp_path / "g.txt"
    file.write_text(grammar("figure-8"))
    words = f"render {file} --size 4x4 --pixels 40x40 --backend cpu --hour 23 --out {tmp_path / 'n.png'}"
    assert main(words.split()) == 0
    with pytest.raises(SystemExit):
        main(f"{words} --hour 25".split())


@pytest.mark.parametrize("name", EXHIBITS)
def test_every_exhibit_is_drawn(name: str) -> None:
    assert exhibit(name, samples=1, scale=0.06).std() > 15


def test_an_exhibit_is_the_same_each_time() -> None:
    first, second = (exhibit("figure-12", samples=1, scale=0.06) for _ in range(2))
    assert (first == second).all()


def test_a_layout_is_exhibited_by_its_grammar() -> None:
    picture = layout_exhibit("residential-house", samples=1, scale=0.1)
    assert picture.std() > 15
    half = picture.shape[1] // 2
    assert picture[:, :half].mean() > 1.4 * picture[:, half:].mean()  # day and night


def test_faults_are_told() -> None:
    with pytest.raises(DesignError, match=r"found 'figure-2'; did you mean 'figure-12'\?"):
        exhibit("figure-2")
    with pytest.raises(ValueError, match="expected at least one façade"):
        photograph([])
    with pytest.raises(ValueError, match=r"expected at least one pixel and sample; found \(0, 4\), 2"):
        photograph([Facade(PLAIN, (1.0, 1.0))], Photo(pixels=(0, 4)))


def test_houses_have_a_pavement_and_a_facade_alone_a_square() -> None:
    """Which ground lies at some distances before a wall; and that all of it is covered once."""
    house = box(PLAIN, 20, 6, 8)
    for facades, wanted in (
        (house, {1.5: "Slabs", PAVEMENT + KERB / 2: "Kerb", 6.0: "Road"}),
        (house[:1], {1.5: "Slabs", 3.2: "Slabs", 6.0: "Slabs"}),
    ):
        parts = ground(facades, (0.0, 0.0))
        area = 0.0
        for name, (corners, triangles) in parts.items():
            shapes = [shapely.Polygon(corners[own]) for own in triangles]
            area += sum(own.area for own in shapes)
            for reach, kind in wanted.items():
                inside = sum(own.contains(shapely.Point(0.3, reach)) for own in shapes)
                assert inside == (kind == name), (reach, name)
            assert all(not own.exterior.is_ccw for own in shapes)  # seen from above, where south is down
        assert area == pytest.approx(3000.0**2, rel=1e-9)


def test_facades_of_several_grammars_and_any_seeds_stand_side_by_side() -> None:
    """Rules as NumPy has them, where tiles of one name are two pictures and seeds are large, broken and negative."""
    text = "S -> RepeatX(0.5, T)  T -> RandUni(0, A, B)  A -> Mat(Color, 0, 1, 0, 0, 1)  "
    text += "Tile -> Mat(Color, Fit:brick, 0, 0, 1, 1)"
    one = Grammar.parse(f"{text}  B -> Mat(Color, 0, 0, 1, 0, 1)", TileSet.builtin(64))
    other = Grammar.parse(f"B -> Mat(Color, 0, 0, 0, 1, 1)  {text}", TileSet.builtin(32))
    facades = [
        Facade(one, (8.0, 4.0), (-9.0, 0.0, 0.0), seed=(1e12 + 0.3, -7.7)),
        Facade(other, (8.0, 4.0), (1.0, 0.0, 0.0), seed=(-23.1, 5.003)),
        Facade(one, (3.0, 4.0), (10.0, 0.0, 0.0), start="Tile"),
        Facade(other, (3.0, 4.0), (-13.0, 0.0, 0.0), start="Tile"),
    ]
    scene = Scene.of_facades(facades)
    place = Viewpoint.towards((0.0, 2.0, 12.0), (0.5, 2.0, 0.0), 95.0)
    pixels = (160, 40)
    with renderer_of(scene, choose_device()) as renderer:
        looks = PipelineLooks(relief=False, haze=0.0)
        drawn = renderer.draw(
            Frame(scene, place.frustum(pixels), Daytime.at(12), pixels, looks), ("color", "place", "rule")
        )
    at, rule, color = (drawn[name].reshape(-1, 4) for name in ("place", "rule", "color"))
    checked = 0
    for k, facade in enumerate(facades):
        mine = (rule == [*scene.vertices[4 * k]["start"], *scene.vertices[4 * k]["seed"]]).all(axis=1)
        mine &= at[:, 2] > 0
        found = facade.grammar.evaluate(at[mine, :2], facade.size, facade.seed, facade.start)
        apart = np.abs(color[mine].astype(float) - found.color).max(axis=1)
        if facade.start is None:
            assert (apart < 1e-3).mean() > 0.99 and found.color[:, :3].std() > 0.3
        else:  # in another size of the tile
            assert np.abs(color[mine].astype(float).mean(axis=0) - found.color.mean(axis=0)).max() < 0.05
        checked += int(mine.sum())
    assert checked > 1500
    assert sorted(scene.grammar.atlas().table[:, 0, 2].tolist()) == [32, 64]  # both pictures are there


def test_what_is_seen_through_is_as_far_as_it_is() -> None:
    """Three veils in a row before a wall; through the fourth one nothing more is seen but sky."""
    photo = Photo((16, 16), 21.0, Camera(azimuth=0, height=2, fill=1.0), (1.5, 1.5, 2.5, 2.5), samples=1)
    veils = [Facade(PLAIN, (4.0, 4.0), (0.0, 0.0, -0.3 * k), start="Veil") for k in range(4)]
    wall = Facade(PLAIN, (4.0, 4.0), (0.0, 0.0, -2.0), start="Red")
    reds = [photograph([*veils[:k], wall], photo)[8, 8].astype(int) for k in range(5)]
    assert all(a[0] > b[0] + 2 and a[2] < b[2] for a, b in pairwise(reds[:4]))
    assert reds[4][0] < reds[3][0] / 2
