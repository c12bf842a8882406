"""Pictures of layouts: light and shadow where geometry says, what they are asked for, and what they say of faults."""

from __future__ import annotations

import io
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from facade_nb.design.errors import DesignError
from facade_nb.design.model import Canvas
from facade_nb.render import build_scene, render_png
from facade_nb.render.backends import BackendError
from facade_nb.render.camera import Camera
from facade_nb.render.daylight import TIMES
from facade_nb.render.developing import developed
from facade_nb.render.picture import picture
from facade_nb.render.pipeline.device import DEVICES, choose_device
from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.pipeline.gathering import gathered
from facade_nb.render.pipeline.renderer import renderer_of
from facade_nb.render.pipeline.solids import solids_of
from facade_nb.render.pipeline.viewpoint import Frustum
from facade_nb.render.surroundings import building
from facade_nb.render.texture.daytime import light
from facade_nb.solver.model.layout import Layout, PlacedShape

from .houses import house

SMALL = {"size": (160, 100), "rays": 6, "samples": 1}
GREY = "#808080"
MORNING = TIMES["morning"]
RAYS = 48


def wall_with_box() -> Layout:
    """A wall, a box that stands 0.8 m out of it, and a pane."""
    wall = PlacedShape("wall", "A", "P", (0, 0, 6, 4), material=GREY)
    box = PlacedShape("box", "B", "Q", (2.5, 2, 3.5, 3), offset=0.8, material=GREY)
    return Layout("Box", Canvas(6, 4), shapes=(wall, box))


class Seen:
    """The buffers of a picture that is seen straight on, by places in the world."""

    def __init__(self, layout: Layout) -> None:
        looks = Looks(haze=0, relief=False, rays=RAYS)
        solids = solids_of(layout)
        size = (300, 200)
        view = Camera(azimuth=0, height=2, angle=20).look(np.array([(0, 0, 0), (6, 4, 0.0)]), size)
        self.frustum = replace(Frustum.of(view), reach=(0.4 * view.reach[0], 4000.0))
        passes, buffers = gathered(looks.rays, cut=True)
        with renderer_of(solids.scene, choose_device(), passes=passes, buffers=buffers) as renderer:
            frame = Frame(solids.scene, self.frustum, MORNING, size, looks)
            wanted = ("softened", "sunny", "light", "toned", "cut")
            self.buffers = {
                name: np.asarray(own, float) for name, own in renderer.draw(frame, wanted).items()
            }

    def at(self, name: str, *spot: float) -> NDArray[np.float64]:
        """A buffer where a point of the world is seen."""
        clip = self.frustum.matrix @ np.array([*spot, 1.0])
        buffer = self.buffers[name]
        height, width = buffer.shape[:2]
        column, row = (clip[0] / clip[3] + 1) / 2 * width, (1 - clip[1] / clip[3]) / 2 * height
        found: NDArray[np.float64] = buffer[int(row), int(column)]
        return found


@pytest.fixture(scope="module")
def seen() -> Iterator[Seen]:
    yield Seen(wall_with_box())


@pytest.fixture(scope="module")
def whole() -> bytes:
    return render_png(house(), **SMALL)


class TestLight:
    def test_a_shadow_ends_where_geometry_says(self, seen: Seen) -> None:
        """The sun stands at (-0.62, 0.62, 0.8): the box's lower edge throws its shadow 0.62 m down and to the right."""
        for x, y, sunny in (
            (3.6, 1.5, 0), (3.6, 1.43, 0), (3.6, 1.33, 1), (3.6, 1.2, 1),
            (4.04, 1.8, 0), (4.2, 1.8, 1), (3.2, 1.41, 0), (3.06, 1.41, 1), (1.0, 2.0, 1),
        ):  # fmt: skip
            assert seen.at("sunny", x, y, 0.0)[0] == pytest.approx(sunny, abs=0.1), (x, y)

    def test_an_open_wall_has_the_light_that_numpy_finds(self, seen: Seen) -> None:
        share = seen.at("softened", 0.7, 3.2, 0.0)[0]
        assert share > 0.97
        point = np.array([0.7, 3.2, 0.0])
        ray = (point - seen.frustum.eye)[None].astype(np.float32)
        color = np.array([[0x80, 0x80, 0x80, 255]], np.float32) / 255
        normal, shine = np.zeros((1, 4), np.float32), np.zeros((1, 4), np.float32)
        lit = light(color, normal, shine, ray, MORNING, np.ones(1, np.float32), np.array([3.2], np.float32))
        expected = developed(lit, MORNING.exposure)[0] * 255
        assert seen.at("toned", 0.7, 3.2, 0.0)[:3] == pytest.approx(expected, abs=9)  # and a little weather

    def test_a_shadowed_wall_has_that_of_the_sky_alone(self, seen: Seen) -> None:
        lit, dark = (seen.at("light", 3.7, y, 0.0)[:3] for y in (0.9, 1.6))
        assert dark.sum() < 0.5 * lit.sum()
        assert dark[2] / dark[0] > lit[2] / lit[0] + 0.1  # bluer
        assert dark.min() > 0.02  # not black

    def test_the_sky_is_hidden_under_what_stands_out(self, seen: Seen) -> None:
        open_, under, corner = (
            seen.at("softened", x, y, 0.0)[0] for x, y in ((0.6, 1.0), (3.0, 1.6), (3.0, 1.9))
        )
        assert open_ > under + 0.15 > corner + 0.2

    def test_the_ground_before_a_high_wall_sees_half_the_sky(self) -> None:
        """(1 + cos t) / 2, where t is how high the wall's top stands above the horizon."""
        wall = PlacedShape("wall", "A", "P", (-12, 0, 18, 6), material=GREY)
        own = Seen(Layout("Wall", Canvas(6, 4), shapes=(wall,)))
        for near in (0.6, 1.5):
            expected = (1 + near / np.hypot(near, 6)) / 2
            assert own.at("softened", 3.0, 0.0, near)[0] == pytest.approx(expected, abs=0.05), near

    def test_what_is_cut_out_keeps_the_shadow(self, seen: Seen) -> None:
        assert seen.at("cut", 1.0, 2.0, 0.0)[3] == 255
        assert seen.at("cut", 1.0, 9.0, 0.0)[3] == 0
        assert seen.at("cut", 3.0, 0.0, 1.5)[3] < 110


class TestPicture:
    def test_it_shows_something_and_is_written_whole(self, whole: bytes, tmp_path: Path) -> None:
        data = render_png(house(), tmp_path / "house.png", **SMALL)
        assert data == whole  # the same each time
        assert (tmp_path / "house.png").read_bytes() == data
        assert [p.name for p in tmp_path.iterdir()] == ["house.png"]
        image = Image.open(io.BytesIO(data))
        assert (image.size, image.mode) == ((160, 100), "RGB")
        pixels = np.asarray(image, float)
        assert pixels.std() > 20
        assert 90 < pixels.mean() < 220
        sky = pixels[:12].mean(axis=(0, 1))
        assert sky[2] > sky[0]  # blue
        edges = np.abs(np.diff(pixels.mean(axis=2), axis=1))
        assert (edges > 25).mean() > 0.02  # windows, columns and corners, not a blur

    def test_brick_is_redder_than_plaster(self) -> None:
        size, camera = (240, 150), Camera(azimuth=0, angle=20)
        pixels = picture(house(), size, camera, samples=1, rays=2).astype(float)
        canvas = [(0.0, 0.0, 0.0), (6.0, 4.3, 0.0)]
        view = camera.look(np.concatenate([canvas, building(house()).positions.reshape(-1, 3)]), size)

        def redness(x: float, y: float) -> float:
            spot = Frustum.of(view).matrix @ np.array([x, y, 0.0, 1.0])
            column = int((spot[0] / spot[3] + 1) / 2 * size[0])
            row = int((1 - spot[1] / spot[3]) / 2 * size[1])
            red, _, blue = pixels[row - 2 : row + 3, column - 2 : column + 3].mean(axis=(0, 1))
            return float(red / blue)

        assert redness(2.1, 0.8) > redness(2.1, 2.3) + 0.2

    def test_times_of_day_differ(self) -> None:
        small = {**SMALL, "rays": 2}
        means = {name: picture(house(), time_of_day=name, **small).mean(axis=(0, 1)) for name in TIMES}
        assert means["evening"][0] / means["evening"][2] > means["noon"][0] / means["noon"][2]
        assert means["overcast"].std() < means["evening"].std()

    def test_a_transparent_background_keeps_the_shadow(self, whole: bytes) -> None:
        pixels = picture(house(), background="transparent", **{**SMALL, "samples": 2})
        assert pixels.shape == (100, 160, 4)
        assert pixels[2, 2, 3] == 0
        alpha = pixels[..., 3]
        assert (alpha == 255).mean() > 0.15
        assert ((alpha > 40) & (alpha < 240)).mean() > 0.02
        solid = np.asarray(Image.open(io.BytesIO(whole)), int)
        inner = (alpha == 255) & (np.roll(alpha, 2, 0) == 255) & (np.roll(alpha, 2, 1) == 255)
        assert np.median(np.abs(pixels[..., :3].astype(int) - solid)[inner]) < 12  # the house is the same
        edge = (alpha > 100) & (alpha < 255) & (np.arange(100)[:, None] < 45)
        assert pixels[edge][:, :3].mean() < 235  # nothing of the sky is mixed into its outline

    def test_an_empty_canvas_is_a_blank_panel(self) -> None:
        pixels = picture(Layout("Nothing", Canvas(6, 3)), **SMALL).astype(float)
        assert pixels.std() > 3
        assert pixels[40:60, 70:90].mean() > 180

    def test_glass_shows_a_room_and_not_the_wall(self) -> None:
        """A pane differs from place to place, as a wall of one paint does not, and is darker."""
        window = PlacedShape("w", "A", "P", (0, 0, 2, 3), geometry="shop", material=GREY)
        panes = picture(Layout("Window", Canvas(2, 3), shapes=(window,)), (90, 120), rays=4, samples=1)
        plain = replace(window, geometry="box")
        wall = picture(Layout("Wall", Canvas(2, 3), shapes=(plain,)), (90, 120), rays=4, samples=1)
        middle = np.s_[40:80, 30:50]
        assert panes[middle].std() > 2 * wall[middle].std()
        assert panes[middle].mean() < wall[middle].mean()


class TestFaults:
    def test_wrong_arguments_are_named(self) -> None:
        with pytest.raises(
            ValueError, match="backend: expected one of osmesa, egl; found 'osmsa'; did you mean 'osmesa'"
        ):
            render_png(house(), backend="osmsa")
        with pytest.raises(ValueError, match="time_of_day: expected one of morning"):
            render_png(house(), time_of_day="night")
        with pytest.raises(ValueError, match="background: expected sky or transparent; found 'blue'"):
            render_png(house(), background="blue")
        for wrong in ({"size": (8, 8)}, {"rays": 0}, {"samples": 0}):
            with pytest.raises(ValueError, match="at least 16 pixels and at least 1 sample and ray"):
                render_png(house(), **wrong)  # type: ignore[arg-type]

    def test_a_folder_that_is_not_there_is_named(self, tmp_path: Path) -> None:
        with pytest.raises(DesignError, match="cannot write"):
            render_png(house(), tmp_path / "no" / "house.png", size=(32, 32), samples=1, rays=1)

    def test_what_is_missing_is_told_with_the_command_that_helps(
        self, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        for name in DEVICES:
            monkeypatch.setitem(
                DEVICES[name].__dict__, "why_not", f"{name}: none here; sudo apt-get install it"
            )
        with pytest.raises(BackendError) as told:
            render_png(house())
        assert all(f"{name}: none here; sudo apt-get install it" in str(told.value) for name in DEVICES)

    def test_drawing_an_elevation_needs_no_graphics_library(self) -> None:
        script = """
import sys
from facade_nb.render import build_scene, elevation_svg
from tests.render.houses import house
elevation_svg(house())
build_scene(house())
heavy = {"moderngl", "trimesh", "PIL", "scipy"} & set(sys.modules)
assert not heavy, heavy
"""
        root = Path(__file__).parents[2]
        done = subprocess.run([sys.executable, "-c", script], cwd=root, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr


class TestSurroundings:
    def test_verticals_stay_upright_and_everything_is_inside(self) -> None:
        points = building(house()).positions.reshape(-1, 3).astype(float)
        for azimuth in (-60, 0, 27, 75):
            for size in ((320, 200), (200, 320)):
                matrix = Frustum.of(Camera(azimuth=azimuth).look(points, size)).matrix
                clip = np.column_stack([points, np.ones(len(points))]) @ matrix.T
                spots = clip[:, :3] / clip[:, 3:]
                assert (np.abs(spots) <= 1).all()
                low, high = (matrix @ np.array([3.0, y, 0.0, 1.0]) for y in (0.0, 3.0))
                assert low[0] / low[3] == pytest.approx(high[0] / high[3])

    def test_the_body_closes_the_building(self) -> None:
        points = building(house()).positions.reshape(-1, 3)
        assert points[:, 2].min() < -4
        assert points[:, 2].max() < 1
        assert len(points) > len(build_scene(house()).triangles().positions) * 3

    def test_a_dormer_does_not_raise_the_body_into_the_roof(self) -> None:
        plain = house()
        roof = next(shape.rect for shape in plain.shapes if shape.kind == "roof")
        dormer = PlacedShape(
            "dormers", "M", "T", (2.0, roof[1] + 0.1, 3.0, roof[3] - 0.1), kind="window", geometry="window"
        )
        triangles = building(replace(plain, shapes=(*plain.shapes, dormer)))
        assert triangles.positions[triangles.shapes == -1][:, :, 1].max() <= roof[1] + 1e-5
        assert triangles.positions[triangles.shapes == len(plain.shapes)].size > 0  # it is there all the same
