"""What the passes draw, against the grammar's NumPy evaluator, its light, and brute force."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from facade_nb import gallery
from facade_nb.render import Grammar
from facade_nb.render.developing import developed
from facade_nb.render.pipeline import stills
from facade_nb.render.pipeline.device import DEVICES, choose_device
from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.pipeline.passes import BUFFERS, PASSES
from facade_nb.render.pipeline.renderer import Renderer, renderer_of
from facade_nb.render.pipeline.scene import Scene
from facade_nb.render.pipeline.stills import buffers_of, still
from facade_nb.render.pipeline.viewpoint import Viewpoint
from facade_nb.render.texture.daytime import Daytime, light
from facade_nb.render.texture.evaluating import evaluate
from facade_nb.render.texture.facades import Facade, box

from ..rays import meet, sees

PIXELS = (160, 120)
NOON = Daytime.at(13)
CLEAR = Looks(haze=0.0, relief=False)
GROUND = "Ground -> Mat(Color, 0, 0.5, 0.5, 0.5, 1)\n"


@pytest.fixture(scope="module")
def street() -> list[Facade]:
    """Houses of figure 10 on the ground."""
    grammar = Grammar.parse(gallery.grammar("figure-10") + "\n" + GROUND)
    found: list[Facade] = []
    for k in range(3):
        at = (k * 13.0 - 13.0, -2.0 * (k % 2))
        found += box(
            grammar, 11, 13 + k, 9, at=at, turn=12.0 * k, seed=(7.0 * k, 3.25), side="Side", roof=0.0
        )
    found += box(grammar, 8, 12, 6, at=(-24.0, 16.0), side="Side", roof=0.0)  # not seen, but its shadow is
    ground = Facade(
        grammar, (120.0, 120.0), (-60.0, 0.0, 60.0), (1.0, 0.0, 0.0), (0.0, 0.0, -1.0), start="Ground"
    )
    return [*found, ground]


@pytest.fixture(scope="module")
def renderer(street: list[Facade]) -> Iterator[Renderer]:
    with renderer_of(Scene.of_facades(street), choose_device()) as own:
        yield own


PLACE = Viewpoint.towards((9.0, 1.7, 17.0), (-2.0, 5.0, 0.0), 62.0)


def frame(renderer: Renderer, daytime: Daytime = NOON, looks: Looks = CLEAR) -> Frame:
    return Frame(renderer.scene, PLACE.frustum(PIXELS), daytime, PIXELS, looks)


@pytest.fixture(scope="module")
def drawn(renderer: Renderer) -> dict[str, np.ndarray]:
    return renderer.draw(frame(renderer), [own.name for own in BUFFERS])


@pytest.fixture(scope="module")
def rays(renderer: Renderer) -> np.ndarray:
    """Of unit depth, through the middles of pixels (n, 3), row by row from the top."""
    frustum = PLACE.frustum(PIXELS)
    left, bottom, right, top = frustum.window
    u = left + (np.arange(PIXELS[0]) + 0.5) / PIXELS[0] * (right - left)
    v = top - (np.arange(PIXELS[1]) + 0.5) / PIXELS[1] * (top - bottom)
    found = u[None, :, None] * frustum.right + v[:, None, None] * frustum.up + frustum.ahead
    return np.asarray(found.reshape(-1, 3), np.float32)


def test_the_g_buffer_holds_what_rays_meet(
    street: list[Facade], drawn: dict[str, np.ndarray], rays: np.ndarray
) -> None:
    hits = meet(street, np.array(PLACE.eye, np.float32), rays)
    facing, place = (drawn[name].reshape(-1, 4) for name in ("facing", "place"))
    assert ((facing[:, 3] > 0) == (hits.facade >= 0)).mean() > 0.999
    both = (facing[:, 3] > 0) & (hits.facade >= 0)
    assert both.mean() > 0.6
    normals = np.array([own.axes[2] for own in street])
    same = both & (np.abs(facing[:, :3] - normals[hits.facade]).max(axis=1) < 1e-4)
    assert same.sum() > 0.995 * both.sum()
    far = np.abs(facing[same, 3] - hits.distance[same]) / hits.distance[same]
    assert np.median(far) < 1e-5 and np.percentile(far, 99) < 1e-3
    assert np.percentile(np.abs(place[same, :2] - hits.places[same]), 99) < 5e-3
    sizes = np.array([own.size for own in street], np.float32)
    assert (place[same, 2:] == sizes[hits.facade[same]]).mean() > 0.999


def test_the_grammar_is_that_of_numpy(
    street: list[Facade], drawn: dict[str, np.ndarray], rays: np.ndarray
) -> None:
    """At the places of the G-buffer, façade by façade."""
    facing, place, rule = (drawn[name].reshape(-1, 4) for name in ("facing", "place", "rule"))
    frustum = PLACE.frustum(PIXELS)
    spread = float(frustum.window[2] - frustum.window[0]) / PIXELS[0]
    wrong = seen = 0
    for own in street:
        axes = own.axes
        mine = (np.abs(facing[:, :3] - axes[2]).max(axis=1) < 1e-4) & (
            place[:, 2:] == np.array(own.size, np.float32)
        ).all(axis=1)
        mine &= (rule[:, 2:] == np.array(own.seed, np.float32)).all(axis=1) & (facing[:, 3] > 0)
        if not mine.any():
            continue
        question = own.grammar.question(own.size, own.seed, own.start)
        found = evaluate(
            question, place[mine, :2], rays[mine] @ axes.T, facing[mine, 3] * np.float32(spread), spread
        )
        colour = drawn["color"].reshape(-1, 4)[mine].astype(np.float32)
        wrong += int((np.abs(colour - found.color).max(axis=1) > 4e-3).sum())
        local = 2 * (found.normal[:, :3] + (1 - found.normal[:, 3:]) * np.float32([0.5, 0.5, 1.0])) - 1
        normal = drawn["normal"].reshape(-1, 4)[mine, :3].astype(np.float32)
        wrong += int((np.abs(normal - local @ axes).max(axis=1) > 8e-3).sum())
        seen += int(mine.sum())
    assert seen > 8000 and wrong < 0.004 * seen


def test_rooms_are_deep(drawn: dict[str, np.ndarray]) -> None:
    facing, normal, specular = (
        drawn[name].reshape(-1, 4).astype(np.float32) for name in ("facing", "normal", "specular")
    )
    on = facing[:, 3] > 0
    behind = specular[on, 3]
    rooms = np.linalg.norm(normal[on, :3], axis=1) < 0.2
    assert rooms.sum() > 60 and np.median(behind[rooms]) > 0.5
    assert np.abs(behind[~rooms]).min() < 1e-3 and (behind > -1e-3 * facing[on, 3]).all()


def test_light_without_shadows_is_that_of_numpy(renderer: Renderer, rays: np.ndarray) -> None:
    for hour in (9.0, 13.0, 20.2, 23.0):
        daytime = Daytime.at(hour)
        looks = Looks(shadow=False, occlusion=False, haze=0.0, relief=False)
        own = renderer.draw(
            frame(renderer, daytime, looks), ("color", "normal", "specular", "facing", "light")
        )
        flat = {name: values.reshape(-1, 4).astype(np.float32) for name, values in own.items()}
        on = flat["facing"][:, 3] > 0
        points = np.array(PLACE.eye, np.float32) + flat["facing"][on, 3:] * rays[on]
        normal = np.concatenate(
            [flat["normal"][on, :3] / 2 + 0.5, np.ones((int(on.sum()), 1), np.float32)], axis=1
        )
        wanted = light(
            flat["color"][on],
            normal,
            flat["specular"][on],
            rays[on],
            daytime,
            np.ones(int(on.sum()), np.float32),
            points[:, 1],
        )
        assert np.abs(flat["light"][on, :3] - wanted).max() < 6e-3


def test_shadows_are_where_the_sun_is_not_seen(
    street: list[Facade], renderer: Renderer, drawn: dict[str, np.ndarray], rays: np.ndarray
) -> None:
    """On the ground, against rays to the sun, but for pixels at the rim of a shadow."""
    facing, morning = drawn["facing"].reshape(-1, 4), Daytime.at(8.0)
    sums = []
    for shadow in (True, False):
        lit = renderer.draw(
            frame(renderer, morning, Looks(shadow=shadow, haze=0.0, relief=False)), ("light",)
        )["light"]
        sums.append(lit.reshape(-1, 4)[:, :3].astype(np.float32).sum(axis=1))
    part = sums[0] / np.maximum(sums[1], 1e-3)
    ground = facing[:, 1] > 0.99
    points = (np.array(PLACE.eye, np.float32) + facing[:, 3:] * rays)[ground]
    towards = np.array(morning.towards, np.float32)
    skip = np.full(len(points), len(street) - 1, np.int32)
    sunny = sees(street, points, towards, skip)
    sure = np.ones(len(points), bool)
    for way in ((0.2, 0, 0), (-0.2, 0, 0), (0, 0, 0.2), (0, 0, -0.2)):
        sure &= sees(street, points + np.array(way, np.float32), towards, skip) == sunny
    shaded = part[ground] < 0.8
    assert 0.05 < (~sunny).mean() < 0.95
    assert (shaded[sure] == ~sunny[sure]).mean() > 0.995


@pytest.mark.parametrize("turn", [60.0, 75.0])
def test_eaves_shade_a_wall_along_which_the_sun_shines_as_far_down_as_they_do(turn: float) -> None:
    """A slab stands out of a wall by 0.4 m; the sun comes along the wall, so that its shadow is much longer."""
    grammar, c, s = Grammar.parse(GROUND), np.cos(np.radians(turn)), np.sin(np.radians(turn))
    out, up, right = np.array([-s, 0.0, c]), (0.0, 1.0, 0.0), (c, 0.0, s)
    start = np.array([-20 * c, 0.0, -20 * s])
    wall = Facade(grammar, (40.0, 8.0), tuple(start), right, up, start="Ground")
    under = tuple(start + (0.0, 8.0, 0.0) + 0.4 * out)
    slab = Facade(grammar, (40.0, 0.4), under, right, tuple(-out), start="Ground")
    ground = Facade(
        grammar, (160.0, 160.0), (-80.0, 0.0, 80.0), (1.0, 0.0, 0.0), (0.0, 0.0, -1.0), start="Ground"
    )
    place = Viewpoint((float(9 * out[0]), 1.7, float(9 * out[2])), turn, 12.0, 20.0)
    pixels = (40, 240)
    with renderer_of(Scene.of_facades([wall, slab, ground]), choose_device()) as own:
        seen = Frame(
            own.scene, place.frustum(pixels), NOON, pixels, Looks(haze=0.0, relief=False, occlusion=False)
        )
        found = own.draw(seen, ("light", "place", "facing"))
    on = np.abs(found["facing"][:, 20, :3] @ out - 1) < 0.01
    lit, high = found["light"][on, 20, 0].astype(float), found["place"][on, 20, 1]
    dark = lit < (lit.min() + lit.max()) / 2
    assert high.min() < 4.5 and high.max() > 7.9
    longest = 0.4 * NOON.towards[1] / float(np.array(NOON.towards) @ out)
    assert 8.0 - high[dark].min() == pytest.approx(longest, abs=0.15 * longest)


def test_occlusion_darkens_corners_and_leaves_the_open(drawn: dict[str, np.ndarray]) -> None:
    """The ground at a wall's foot is darker than in the middle of the street."""
    open_ = drawn["softened"][..., 0].astype(np.float32)
    facing = drawn["facing"][1::2, ::2]
    ground, wall = facing[..., 1] > 0.99, (np.abs(facing[..., 1]) < 0.01) & (facing[..., 3] > 0)
    foot = ground[1:] & wall[:-1]
    at_foot = open_[1:][foot]
    rows = np.arange(open_.shape[0])[:, None] * np.ones_like(open_)
    far = open_[ground & (rows > rows.max() - 6)]
    assert len(at_foot) > 20 and at_foot.mean() < far.mean() - 0.08 and far.mean() > 0.9
    assert (open_ >= 0).all() and (open_ <= 1).all()


def test_air_takes_what_is_far(renderer: Renderer) -> None:
    clear, hazy = (
        renderer.draw(frame(renderer, looks=Looks(haze=haze, relief=False)), ("air", "facing", "light"))
        for haze in (0.0, 60.0)
    )
    facing = clear["facing"][..., 3]
    on = facing > 0
    assert np.abs(clear["air"][on, :3].astype(np.float32) - clear["light"][on, :3]).max() < 2e-2
    moved = np.abs(hazy["air"].astype(np.float32) - clear["air"])[..., :3].sum(axis=2)
    assert moved[on & (facing > 30)].mean() > 2 * moved[on & (facing < 14)].mean()


@pytest.mark.parametrize("hour", [13.0, 20.6])
def test_the_sky_is_that_of_photographs(renderer: Renderer, hour: float) -> None:
    """Also on the sun's side at dusk; clouds are before it, but for the haze above the horizon."""
    daytime, place = Daytime.at(hour), Viewpoint((0.0, 30.0, 0.0), 75.0, 8.0, 80.0)
    seen = Frame(renderer.scene, place.frustum(PIXELS), daytime, PIXELS, CLEAR)
    found = renderer.draw(seen, ("air", "facing"))
    x0, y0, x1, y1 = place.frustum(PIXELS).window
    x, y = (
        low + (high - low) * (np.arange(n) + 0.5) / n
        for low, high, n in zip((x0, y0), (x1, y1), PIXELS, strict=True)
    )
    frustum = place.frustum(PIXELS)
    rays = (frustum.ahead + y[::-1, None, None] * frustum.up + x[:, None] * frustum.right).reshape(-1, 3)
    sky = found["facing"].reshape(-1, 4)[:, 3] <= 0
    rise = (rays[:, 1] / np.linalg.norm(rays, axis=1))[sky]
    wanted = daytime.backdrop(rays[sky].astype(np.float32))
    apart = np.abs(found["air"].reshape(-1, 4)[sky, :3] - wanted)
    hazy = (rise > 0) & (rise < 0.03)
    assert hazy.sum() > 300 and apart[hazy].max() < 4e-3
    assert apart[rise > 0].max() < 0.5 * wanted.max()


def test_tone_is_that_of_photographs(drawn: dict[str, np.ndarray]) -> None:
    air = drawn["air"].reshape(-1, 4)[:, :3].astype(np.float32)
    wanted = np.clip(developed(air, NOON.exposure), 0, 1) * 255
    assert np.abs(drawn["toned"].reshape(-1, 4)[:, :3] - wanted).max() <= 1.01


def test_edges_are_smoothed_and_nothing_else(renderer: Renderer, drawn: dict[str, np.ndarray]) -> None:
    truth = still(
        renderer, PLACE.frustum(PIXELS), NOON, PIXELS, Looks(haze=0.0, smooth=False, relief=False), samples=4
    )
    rough, smooth = (drawn[name][..., :3].astype(np.float64) for name in ("toned", "picture"))
    facing = drawn["facing"]
    apart = np.zeros(facing.shape[:2], bool)
    apart[:, 1:] |= np.abs(facing[:, 1:, :3] - facing[:, :-1, :3]).max(axis=2) > 0.1
    apart[1:] |= np.abs(facing[1:, :, :3] - facing[:-1, :, :3]).max(axis=2) > 0.1
    before, after = (np.abs(own - truth)[apart].mean() for own in (rough, smooth))
    assert after < 0.9 * before
    inside = drawn["normal"][..., 3] > 2.0
    assert (rough == smooth).all(axis=2)[inside & ~apart].mean() > 0.97


def test_a_large_still_is_made_of_pieces(renderer: Renderer, monkeypatch: pytest.MonkeyPatch) -> None:
    frustum, size = PLACE.frustum((300, 200)), (300, 200)
    whole = still(renderer, frustum, NOON, size)
    monkeypatch.setattr(stills, "_PIECE", 150)
    told: list[float] = []
    parts = still(renderer, frustum, NOON, size, tell=told.append)
    assert len(told) > 4 and told[-1] == 1
    apart = np.abs(whole.astype(int) - parts).max(axis=2)
    assert (apart > 3).mean() < 0.01 and apart.mean() < 0.2


def test_the_same_twice_and_in_another_process(renderer: Renderer) -> None:
    first, second = (still(renderer, PLACE.frustum(PIXELS), NOON, PIXELS) for _ in range(2))
    assert (first == second).all()


def test_shadows_follow_the_hour(renderer: Renderer) -> None:
    """A map of shadows is drawn again where its matrix has changed, and only there."""
    pictures = [still(renderer, PLACE.frustum(PIXELS), Daytime.at(hour), PIXELS) for hour in (9.0, 17.0, 9.0)]
    assert (pictures[0] != pictures[1]).any() and (pictures[0] == pictures[2]).all()


def test_every_buffer_can_be_looked_at(renderer: Renderer) -> None:
    found = buffers_of(renderer, PLACE.frustum(PIXELS), NOON, PIXELS)
    assert set(found) == {own.name for own in BUFFERS} - {"lamp_map"}  # there are no lamps
    for name, values in found.items():
        assert values.dtype == np.uint8 and values.shape[2] == 3, name
        assert values.std() > 1, name


def test_the_picture_does_not_hang_on_what_images_held_before(
    street: list[Facade], drawn: dict[str, np.ndarray]
) -> None:
    """Images that no longer need be emptied hold no numbers here."""
    with renderer_of(Scene.of_facades(street), choose_device()) as fresh, fresh.painter.entered():
        fresh.draw(frame(fresh))
        for name, image in fresh._images.items():
            if fresh.buffers[name].kind != "depth":
                image.write(b"\xff" * len(image.read(alignment=1)), alignment=1)
        assert np.isnan(fresh._read("place")).all()
        assert (fresh.draw(frame(fresh))["picture"] == drawn["picture"]).all()
        assert np.isnan(fresh._read("place")).any()


def test_a_pass_can_be_another(street: list[Facade]) -> None:
    """Passes are data: without antialiasing what is toned is the picture."""
    passes = [own for own in PASSES if own.name != "edges"]
    with renderer_of(Scene.of_facades(street), choose_device(), passes=passes) as own:
        pixels = own.draw(frame(own), ("toned", "picture"))
        assert set(pixels) == {"toned"} and pixels["toned"].std() > 1


def test_it_gives_back_what_it_holds(street: list[Facade]) -> None:
    with renderer_of(Scene.of_facades(street), choose_device()) as own:
        own.draw(frame(own))
        own.draw(replace(frame(own), pixels=(80, 60)))
        held = [*own._images.values(), *own._held.values(), *own._targets.values()]
        assert len(held) > 25 and all(type(one.mglo).__name__ != "InvalidObject" for one in held)
    assert all(type(one.mglo).__name__ == "InvalidObject" for one in held)


def test_too_large_is_told(renderer: Renderer) -> None:
    with pytest.raises(ValueError, match=r"pixels: expected from 1 to \d+ across and up; found \(90000, 2\)"):
        renderer.draw(replace(frame(renderer), pixels=(90000, 2)))


DRAW = """
import sys
import numpy as np
from tests.render.pipeline.test_renderer import PLACE, NOON, PIXELS
from facade_nb import gallery
from facade_nb.render.pipeline.device import DEVICES
from facade_nb.render.pipeline.renderer import renderer_of
from facade_nb.render.pipeline.scene import Scene
from facade_nb.render.pipeline.stills import still
from facade_nb.render.texture.facades import box
from facade_nb.render import Grammar
grammar = Grammar.parse(gallery.grammar("figure-10"))
scene = Scene.of_facades(box(grammar, 11, 13, 9, roof=3, side="Side", gable=None, cover="Roof"))
with renderer_of(scene, DEVICES[sys.argv[1]]) as own:
    np.save(sys.argv[2], still(own, PLACE.frustum(PIXELS), NOON, PIXELS))
"""


def test_osmesa_and_egl_draw_the_same(tmp_path: Any) -> None:
    pictures = []
    for name, device in DEVICES.items():
        if device.available:
            file = tmp_path / f"{name}.npy"
            subprocess.run([sys.executable, "-c", DRAW, name, str(file)], check=True)
            pictures.append(np.load(file).astype(int))
    assert len(pictures) >= 1 and pictures[0].std() > 10
    for other in pictures[1:]:
        apart = np.abs(pictures[0] - other).max(axis=2)
        assert apart.mean() < 0.5 and (apart > 3).mean() < 0.005
