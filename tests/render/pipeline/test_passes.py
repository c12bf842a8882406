"""The passes as data, cameras, culling, what the sun sees."""

from __future__ import annotations

import random
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facade_nb.render import Grammar
from facade_nb.render.camera import Camera
from facade_nb.render.pipeline.frame import visible
from facade_nb.render.pipeline.gathering import gathered
from facade_nb.render.pipeline.passes import (
    BARE,
    BUFFERS,
    FACADE,
    PAGE,
    PASSES,
    SHADOW,
    Buffer,
    Pass,
    arranged,
    emptied,
    seen_through,
    used,
    without,
)
from facade_nb.render.pipeline.scene import CHUNK, Scene
from facade_nb.render.pipeline.sunlight import sunlight
from facade_nb.render.pipeline.vertices import VERTEX
from facade_nb.render.pipeline.viewpoint import CameraPath, Frustum, Viewpoint
from facade_nb.render.texture.shaders import shader


class TestPasses:
    def test_the_pipeline_is_in_order(self) -> None:
        assert arranged() == PASSES
        assert {name for own in PASSES for name in own.writes} == {own.name for own in BUFFERS}

    @pytest.mark.parametrize(
        ("change", "message"),
        [
            ({"reads": ("picture",)}, "it reads 'picture', which no pass before it writes"),
            ({"reads": ("colour",)}, "there is no buffer 'colour'; did you mean 'color'?"),
            ({"writes": ("soften",)}, "there is no buffer 'soften'; did you mean 'softened'?"),
            ({"reads": ("light", "air")}, "it reads 'air', which it writes itself"),
        ],
    )
    def test_what_cannot_run_is_told(self, change: dict[str, tuple[str, ...]], message: str) -> None:
        passes = [replace(own, **change) if own.name == "air" else own for own in PASSES]  # type: ignore[arg-type]
        with pytest.raises(ValueError) as caught:
            arranged(passes)
        assert message in str(caught.value) and str(caught.value).startswith("pass 'air'")

    def test_one_can_be_left_out_where_nobody_needs_it(self) -> None:
        assert [own.name for own in without(["edges"])] == [own.name for own in PASSES[:-1]]
        with pytest.raises(
            ValueError, match="pass 'occlusion': it reads 'specular', which no pass before it writes"
        ):
            without(["grammar"])
        with pytest.raises(ValueError, match=r"there is no pass 'edge'; did you mean 'edges'\?"):
            without(["edge"])

    def test_one_can_be_added(self) -> None:
        sepia = Pass("sepia", "tone.frag", ("air",), ("brown",), "Brown.")
        assert arranged([*PASSES, sepia], [*BUFFERS, Buffer("brown", 4, "f1", "Brown.")])[-1] is sepia

    def test_the_page_has_them(self) -> None:
        page = (Path(__file__).parents[3] / "docs" / "pipeline.md").read_text()
        for own in PASSES:
            cells = [", ".join(f"`{name}`" for name in names) for names in (own.reads, own.writes)]
            row = f"| {own.name} | {cells[0]} | {cells[1]} | {own.tells} |".replace("|  |", "| |")
            assert row in page

    def test_what_is_read_where_nothing_was_drawn_is_emptied_first(self) -> None:
        by_name = {own.name: own for own in PASSES}
        day = [own for own in PASSES if own.when != "lamps"]
        assert emptied(by_name["G-buffer"], day) == {"facing"}
        assert emptied(by_name["grammar"], day) == {"normal", "specular"}
        assert emptied(by_name["grammar"], PASSES) == {"color", "normal", "specular"}  # pools of light ask it
        assert emptied(by_name["light"], day) == emptied(by_name["air"], day) == set()
        assert emptied(by_name["air"], [own for own in day if not own.sky]) == {"air"}
        assert emptied(by_name["G-buffer"], day, ("place", "along")) == {"place", "facing", "along"}
        assert emptied(by_name["shadow near"], day) == {"shadow_near"}

    def test_sizes_of_buffers(self) -> None:
        sizes = {own.name: own.size((101, 60)) for own in BUFFERS}
        assert sizes["color"] == (101, 60) and sizes["softened"] == (51, 30)
        assert sizes["shadow_far"] == sizes["shadow_near"] == (SHADOW, SHADOW)

    @pytest.mark.parametrize("profile", ["core", "es"])
    def test_shaders_compile_for_desktops_and_browsers(self, profile: str) -> None:
        """Those of every list of passes, with what each defines, and with all its options."""
        assert shutil.which("glslangValidator"), "apt-get install glslang-tools"
        every = (
            *PASSES,
            *FACADE,
            *BARE,
            *PAGE,
            *seen_through(2)[0],
            *gathered(2, cut=True)[0],
            *seen_through(1, *gathered(1))[0],
        )
        sources = {shader(own.vertex, profile): "vert" for own in every}
        for own in every:
            options = tuple(name.upper() for name in own.options if name != "color_only")
            for defines in (own.defines, (*own.defines, *options), (*own.defines, "SEEDS")):
                if own.fragment == "grammar.frag" or defines == own.defines:
                    sources[shader(own.fragment, profile, defines=tuple(dict.fromkeys(defines)))] = "frag"
        assert len(sources) > 20
        for source, kind in sources.items():
            told = subprocess.run(
                ["glslangValidator", "--stdin", "-S", kind], input=source, text=True, capture_output=True
            )
            assert told.returncode == 0, told.stdout

    def test_what_is_seen_through_writes_images_of_its_own(self) -> None:
        passes, buffers = seen_through(2)
        assert arranged(passes, buffers) == passes
        assert [own.name for own in passes if own.name in {one.name for one in PASSES}] == [
            own.name for own in PASSES
        ]
        behind = [own for own in passes if "BEHIND" in own.defines]
        assert len(behind) == 6 and all(own.after or own.draws == "mesh" for own in behind)
        written = {name for own in behind if not own.under for name in own.writes}
        assert written and not written & {own.name for own in BUFFERS}
        assert {own.name for own in used(FACADE)} == {
            *("place", "rule", "facing", "along", "depth", "color", "normal", "specular", "light", "toned")
        }


class TestViewpoint:
    def test_looks_where_it_is_told(self) -> None:
        place = Viewpoint.towards((1.0, 2.0, 3.0), (4.0, 2.0, -1.0))
        assert place.pitch == 0 and place.yaw == pytest.approx(np.degrees(np.arctan2(3, 4)))
        frustum = place.frustum((400, 300))
        clip = frustum.matrix @ (4.0, 2.0, -1.0, 1.0)
        assert clip[:2] / clip[3] == pytest.approx((0, 0)) and clip[3] == pytest.approx(5.0)

    def test_its_axes_are_a_right_angled_frame(self) -> None:
        frustum = Viewpoint((0.0, 5.0, 0.0), 137.0, -31.0).frustum((64, 48))
        axes = np.stack([frustum.right, frustum.up, -frustum.ahead])
        assert axes @ axes.T == pytest.approx(np.eye(3)) and np.linalg.det(axes) == pytest.approx(1)
        assert frustum.right[1] == 0

    def test_north_is_away_from_us(self) -> None:
        assert Viewpoint((0.0, 1.0, 0.0)).frustum((10, 10)).ahead == pytest.approx((0, 0, -1))
        assert Viewpoint((0.0, 1.0, 0.0), 90.0).frustum((10, 10)).ahead == pytest.approx((1, 0, 0))

    def test_a_crop_shows_what_the_whole_shows_there(self) -> None:
        whole = Viewpoint((3.0, 2.0, 9.0), 20.0, 5.0).frustum((800, 600))
        part = whole.crop(0.25, 0.5, 0.75, 1.0)
        a, b = whole.matrix @ (4.0, 3.0, -8.0, 1.0), part.matrix @ (4.0, 3.0, -8.0, 1.0)
        assert b[0] / b[3] == pytest.approx(2 * a[0] / a[3]) and b[1] / b[3] == pytest.approx(
            4 * (a[1] / a[3] / 2 - 0.25)
        )

    def test_a_shift_lens_is_one_as_well(self) -> None:
        view = Camera(azimuth=20.0, height=3.0).look(np.array([[0.0, 0, 0], [9.0, 12.0, 0]]), (640, 480))
        matrix = Frustum.of(view).matrix
        middle = view.eye + 7.0 * view.ahead + 7.0 * np.mean(view.window[::2]) * view.right
        low, high = (matrix @ (middle[0], middle[1] + up, middle[2], 1.0) for up in (0.0, 5.0))
        assert low[0] / low[3] == pytest.approx(0) and high[0] / high[3] == pytest.approx(0)  # upright
        assert low[3] == pytest.approx(7.0) and view.window[1] + view.window[3] != pytest.approx(0)

    @pytest.mark.parametrize(
        "given", [{"pitch": 90.0}, {"angle": 180.0}, {"eye": (0.0, float("nan"), 0.0)}, {"yaw": float("inf")}]
    )
    def test_what_it_cannot_be_is_told(self, given: dict[str, object]) -> None:
        with pytest.raises(ValueError, match="expected"):
            Viewpoint(**{"eye": (0.0, 1.0, 0.0), **given})  # type: ignore[arg-type]


class TestPath:
    PATH = CameraPath(
        (0.0, 2.0, 3.0),
        tuple(Viewpoint((float(k), 1.7, 0.0), yaw) for k, yaw in enumerate((350.0, 10.0, 20.0))),
    )

    def test_goes_through_its_places(self) -> None:
        for time, place in zip(self.PATH.times, self.PATH.places, strict=True):
            own = self.PATH.at(time)
            assert own.eye == pytest.approx(place.eye) and (own.yaw - place.yaw) % 360 == pytest.approx(
                0, abs=1e-9
            )
        assert self.PATH.at(-1) == self.PATH.places[0] and self.PATH.at(99) == self.PATH.places[-1]

    def test_turns_the_shorter_way(self) -> None:
        assert 350 < self.PATH.at(0.5).yaw < 362

    def test_has_no_jumps(self) -> None:
        eyes = np.array([self.PATH.at(t).eye for t in np.linspace(0, 3, 3001)])
        assert np.abs(np.diff(eyes, axis=0)).max() < 3e-3

    def test_does_not_swing_beyond_its_places(self) -> None:
        """Who walks and then rises does not dive into the ground first."""
        heights = (1.65, 1.65, 3.0, 63.0, 63.0)
        path = CameraPath(
            (0.0, 6.0, 12.0, 13.0, 20.0), tuple(Viewpoint((9.0 * k, y, 0.0)) for k, y in enumerate(heights))
        )
        eyes = np.array([path.at(t).eye for t in np.linspace(0, 20, 999)])
        assert (np.diff(eyes, axis=0) >= -1e-12).all() and eyes[:300, 1] == pytest.approx(1.65)

    def test_is_data(self) -> None:
        assert CameraPath.from_dict(self.PATH.to_dict()) == self.PATH

    @pytest.mark.parametrize(
        "rows", [[], [{"time": 0}], 7, [{"time": 1, "eye": [0, 1, 0], "yaw": 0, "pitch": 0, "angle": 60}]]
    )
    def test_what_is_none_is_told(self, rows: object) -> None:
        with pytest.raises(ValueError, match="expected"):
            CameraPath.from_dict(rows)  # type: ignore[arg-type]


def scene(number: int, count: int = 40) -> Scene:
    """Triangles in chunks, anywhere."""
    draw = np.random.Generator(np.random.PCG64(number))
    vertices = np.zeros(3 * count, VERTEX)
    spots = draw.uniform(-200, 200, (count, 1, 3)) + draw.uniform(-15, 15, (count, 3, 3))
    vertices["position"] = spots.reshape(-1, 3)
    vertices["normal"] = (0, 0, 1)
    chunks = np.zeros(count, CHUNK)
    chunks["first"], chunks["count"] = 3 * np.arange(count), 3
    position = vertices["position"].reshape(count, 3, 3)
    chunks["low"], chunks["high"] = position.min(axis=1), position.max(axis=1)
    grammar = Grammar.parse("S -> Mat(Color, 0, 1, 0, 0, 1)")
    return Scene(vertices, np.arange(3 * count, dtype=np.uint32), grammar, chunks)


class TestVisible:
    @pytest.mark.parametrize("number", range(12))
    def test_nothing_that_is_seen_is_left_out(self, number: int) -> None:
        own, draw = scene(number), random.Random(number)
        place = Viewpoint(
            (draw.uniform(-99, 99), draw.uniform(1, 60), draw.uniform(-99, 99)),
            draw.uniform(0, 360),
            draw.uniform(-40, 20),
        )
        matrix = place.frustum((320, 200)).matrix
        drawn = {i for first, count in visible(own, matrix) for i in range(first, first + count)}
        position = own.vertices["position"].astype(np.float64)
        clip = np.column_stack([position, np.ones(len(position))]) @ matrix.T
        seen = (np.abs(clip[:, :2]) <= clip[:, 3:]).all(axis=1) & (clip[:, 2] >= -clip[:, 3])
        assert set(np.flatnonzero(seen).tolist()) <= drawn
        assert len(drawn) < len(position)  # and not all is drawn

    def test_neighbours_are_drawn_together(self) -> None:
        own = scene(1)
        everything = np.diag([1e-3, 1e-3, 1e-3, 1.0])
        assert visible(own, everything) == [(0, len(own.indices))]
        assert visible(own, everything, turning=True) == []

    def test_what_turns_is_drawn_by_passes_of_its_own(self) -> None:
        own = scene(2)
        own.vertices["normal"][60:75] = 0
        everything = np.diag([1e-3, 1e-3, 1e-3, 1.0])
        assert visible(own, everything) == [(0, len(own.indices))]
        assert visible(own, everything, turning=False) == [(0, 60), (75, len(own.indices) - 75)]
        assert visible(own, everything, turning=True) == [(60, 15)]


class TestSunlight:
    @pytest.mark.parametrize("towards", [(0.3, 0.8, 0.52), (-0.99, 0.05, 0.1), (0.0, 1.0, 0.0)])
    def test_maps_hold_what_they_are_for(self, towards: tuple[float, float, float]) -> None:
        way = np.array(towards) / np.linalg.norm(towards)
        box = np.array([[-300.0, 0, -200], [300.0, 30, 250]])
        frustum = Viewpoint((10.0, 1.7, 20.0), 40.0).frustum((64, 48))
        sun = sunlight(tuple(way), frustum, box)  # type: ignore[arg-type]
        corners = np.array(
            [[box[i, 0], box[j, 1], box[k, 2], 1] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
        )
        assert np.abs(corners @ sun.far.T).max() <= 1 + 1e-9
        near = sun.near @ [*(frustum.eye + 20 * frustum.ahead), 1.0]
        assert np.abs(near[:3]).max() < 1
        for matrix in (
            sun.near,
            sun.far,
        ):  # along a ray of the sun only depth changes, and what is nearer it is nearer
            a, b = matrix @ [0, 0, 0, 1], matrix @ [*(-5 * way), 1]
            assert a[:2] == pytest.approx(b[:2]) and a[2] < b[2]

    def test_shadows_do_not_swim(self) -> None:
        """A little step of the camera moves the map by whole texels."""
        box = np.array([[-300.0, 0, -200], [300.0, 30, 250]])
        steps = []
        for x in np.linspace(10, 11, 7):
            frustum = Viewpoint((x, 1.7, 20.0)).frustum((64, 48))
            steps.append((sunlight((0.36, 0.8, 0.48), frustum, box).near @ [0, 0, 0, 1])[:2] * SHADOW / 2)
        moved = np.array(steps) - steps[0]
        assert moved == pytest.approx(np.round(moved), abs=1e-6) and np.abs(moved).max() > 3


class TestScene:
    def test_a_mesh_that_is_none_is_told(self) -> None:
        own = scene(0)
        with pytest.raises(ValueError, match="vertices: expected an array of VERTEX"):
            Scene(np.zeros(3), own.indices, own.grammar)
        with pytest.raises(ValueError, match="indices: expected numbers below 3; found 7"):
            Scene(own.vertices[:3], np.array([0, 1, 7], np.uint32), own.grammar)
        with pytest.raises(ValueError, match=r"indices: expected \(3 t,\) uint32"):
            Scene(own.vertices, np.array([0, 1], np.uint32), own.grammar)

    def test_a_vertex_takes_68_bytes(self) -> None:
        assert VERTEX.itemsize == 68
