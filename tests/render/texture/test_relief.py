"""Relief mapping: known answers, silhouettes, shadows, fading, the two evaluators, the pipeline."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from facade_nb.cli import main
from facade_nb.render import Grammar
from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.pipeline.renderer import Renderer, renderer_of
from facade_nb.render.pipeline.scene import Scene
from facade_nb.render.pipeline.viewpoint import Viewpoint
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.texture.evaluating import evaluate
from facade_nb.render.texture.facades import Facade
from facade_nb.render.texture.gl import OSMESA
from facade_nb.render.texture.painters import PAINTERS
from facade_nb.render.texture.photograph import Photo, photograph
from facade_nb.render.texture.picture import texture_pixels
from facade_nb.render.texture.question import Question
from facade_nb.render.texture.shaders import PROFILES, shader
from facade_nb.render.texture.view import Looks as Points
from facade_nb.render.texture.view import Sight
from facade_nb.render.tiles import TileError, TileSet
from facade_nb.render.tiles.relief import Relief

SIDE = 64
DEPTH = 0.1
TEXEL = 1 / SIDE
Floats = NDArray[np.float32]


def _heights(kind: str) -> Floats:
    heights = np.zeros((SIDE, SIDE), np.float32)
    if kind == "top":
        heights[:] = 1
    elif kind != "floor":
        heights[:, : SIDE // 2] = 1
    return heights


class Tiles:
    """Tiles whose red says where on them one looks, from left to right, each with heights of its own."""

    names = ("flat", "top", "floor", "step", "around", "sunk", "proud")

    def mips(self, name: str) -> Sequence[Floats]:
        image = np.zeros((SIDE, SIDE, 4), np.float32)
        image[..., 0] = (np.arange(SIDE) + 0.5) / SIDE
        image[..., 3] = 1
        return (image,)

    def relief(self, name: str) -> Relief | None:
        if name == "flat":
            return None
        heights = _heights("top" if name == "proud" else name)
        high = 0.2 if name == "proud" else 0.0
        return Relief(heights, DEPTH, high, (name == "around", False), name != "sunk")


def asked(text: str, relief: bool = True, sun: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Question:
    return Grammar.parse(text, Tiles()).question((1.0, 1.0), relief=relief)._replace(sun=sun)


def fit(tile: str) -> str:
    return f"S -> Mat(Color, Fit:{tile}, 0, 0, 1, 1)"


def over_green(tile: str) -> str:
    return (
        f"S -> Layer(Green, T)\nGreen -> Mat(Color, 0, 0, 1, 0, 1)\nT -> Mat(Color, Fit:{tile}, 0, 0, 1, 1)"
    )


def at(
    question: Question, x: float, slope: float = 0.0, y: float = 0.5, footprint: float = 0.0
) -> tuple[float, float, float]:
    """Red, green and shade at a point that is seen along a ray, from both evaluators, which agree."""
    points, rays = np.array([[x, y]], np.float32), np.array([[slope, 0, -1]], np.float32)
    pixel, shade = np.array([footprint], np.float32), np.zeros(1, np.float32)
    found = evaluate(question, points, rays, pixel, shade=shade)
    shot = OSMESA.paint_at(question, Points(points, rays, pixel, 0.0, np.ones(1, bool)), mips=True)
    assert shot.shade is not None or not question.relief
    assert np.abs(shot.surface.color - found.color).max() < 1e-4
    assert shot.shade is None or abs(float(shot.shade[0] - shade[0])) < 1e-3
    return float(found.color[0, 0]), float(found.color[0, 1]), float(shade[0])


class TestKnownAnswers:
    """A step: the left half of a metre stands 0.1 m out, the right half is its foot."""

    @pytest.mark.parametrize(
        ("x", "slope", "seen"),
        [
            (0.3, 1.0, 0.3),  # on the upper half: where the ray comes in
            (0.6, 0.0, 0.6),  # straight on: nothing moves
            (0.6, 1.0, 0.7),  # on the foot: 0.1 m further along the ray
            (0.6, 2.0, 0.8),
            (0.8, -1.0, 0.7),
            (0.55, -1.0, 0.5),  # the ray meets the side of the step, half way down
            (0.58, -4.0, 0.5),
        ],
    )
    def test_where_the_ray_meets_a_step(self, x: float, slope: float, seen: float) -> None:
        assert at(asked(fit("step")), x, slope)[0] == pytest.approx(seen, abs=2 * TEXEL)

    def test_a_ray_along_the_wall_goes_no_further_than_six_times_the_depth(self) -> None:
        assert at(asked(fit("floor")), 0.2, 40.0)[0] == pytest.approx(0.8, abs=0.01)

    def test_a_repeated_tile_is_met_as_a_stretched_one(self) -> None:
        repeated = asked("S -> Mat(Color, Rep:step, 0, 0, 1, 1)")
        assert at(repeated, 0.6, 1.0)[0] == pytest.approx(0.7, abs=2 * TEXEL)
        doubled = asked("S -> Mat(Color, Rep:step, 0, 0, 2, 2)")  # half a metre a tile, as deep as before
        assert at(doubled, 0.3, 1.0)[0] == pytest.approx(0.8, abs=3 * TEXEL)

    def test_a_mirrored_part_is_met_where_it_is(self) -> None:
        mirrored = asked("S -> Mat(Color, Fit:step, 1, 0, 0, 1)")  # the foot is on the left
        assert at(mirrored, 0.2, 1.0)[0] == pytest.approx(0.7, abs=2 * TEXEL)
        assert at(mirrored, 0.45, 1.0)[0] == pytest.approx(0.5, abs=2 * TEXEL)

    def test_what_is_highest_or_flat_stays_to_the_bit(self) -> None:
        points = np.random.Generator(np.random.PCG64(1)).random((500, 2)).astype(np.float32)
        rays = np.tile(np.array([1.3, -0.7, -1], np.float32), (500, 1))
        for tile in ("flat", "top", "proud"):
            for text in (fit(tile), f"S -> Mat(Color, Rep:{tile}, 0.2, 0, 1.5, 2)", over_green(tile)):
                with_, without = (evaluate(asked(text, relief), points, rays) for relief in (True, False))
                assert all((a == b).all() for a, b in zip(with_, without, strict=True))


class TestSilhouettes:
    def test_past_an_edge_the_layer_below_is_seen(self) -> None:
        question = asked(over_green("step"))
        assert at(question, 0.95, 1.0)[:2] == (0.0, 1.0)
        assert at(question, 0.85, 1.0)[:2] == (pytest.approx(0.95, abs=2 * TEXEL), 0.0)

    def test_without_a_layer_below_there_is_no_hole(self) -> None:
        assert at(asked(fit("step")), 0.95, 1.0)[0] == pytest.approx(1, abs=TEXEL)
        lowest = asked("S -> Layer(T, Skip)\nT -> Mat(Color, Fit:step, 0, 0, 1, 1)\nSkip -> Skip(0)")
        assert at(lowest, 0.95, 1.0)[0] == pytest.approx(1, abs=TEXEL)

    def test_a_tile_that_goes_on_is_followed_by_itself(self) -> None:
        seen = at(asked(over_green("around")), 0.96, 1.0)
        assert seen[0] == pytest.approx(0, abs=2 * TEXEL)  # the side of the next step
        assert seen[1] == 0

    def test_a_tile_that_is_set_in_is_not_seen_past(self) -> None:
        seen = at(asked(over_green("sunk")), 0.95, 1.0)
        assert seen[:2] == (pytest.approx(1, abs=TEXEL), 0.0)

    def test_normals_go_where_the_colour_goes(self) -> None:
        text = over_green("step").replace("T)", "T, N)") + "\nN -> Mat(Normal, Fit:step, 0, 0, 1, 1)"
        points = np.array([[0.95, 0.5], [0.85, 0.5]], np.float32)
        rays = np.array([[1, 0, -1]] * 2, np.float32)
        found = evaluate(asked(text), points, rays)
        assert found.normal[0].tolist() == [0, 0, 0, 0]
        assert found.normal[1, 0] == found.color[1, 0]


class TestShadows:
    LEFT, RIGHT, BEHIND = (-1.0, 0.0, 1.0), (1.0, 0.0, 1.0), (-1.0, 0.0, -1.0)

    @pytest.mark.parametrize(("x", "shade"), [(0.3, 0.0), (0.54, 1.0), (0.57, 1.0), (0.64, 0.0), (0.8, 0.0)])
    def test_a_step_throws_a_shadow_as_long_as_it_is_high(self, x: float, shade: float) -> None:
        assert at(asked(fit("step"), sun=self.LEFT), x)[2] == pytest.approx(shade, abs=1e-3)

    def test_the_sun_on_the_other_side_throws_none(self) -> None:
        for sun in (self.RIGHT, self.BEHIND, (0.0, 0.0, 0.0)):
            assert at(asked(fit("step"), sun=sun), 0.54)[2] == 0

    def test_a_picture_at_an_hour_has_it(self) -> None:
        """At 8 the sun stands on the left and the foot of the step is darker; at 18 it stands on the right."""
        grammar = Grammar.parse("S -> Mat(Color, Fit:step, 0, 0, 1, 1)", Tiles())
        given = {"size": (1.0, 1.0), "pixels": (100, 4), "backend": "cpu", "antialias": "none"}
        found = {
            (hour, relief): texture_pixels(grammar, **given, hour=hour, relief=relief)[2, :, 0].astype(int)
            for hour in (8, 18)
            for relief in (False, True)
        }
        assert (found[18, True] == found[18, False]).all()
        darker = np.flatnonzero(found[8, True] < found[8, False] - 20)
        assert darker.min() in (49, 50, 51) and darker.max() > 60


class TestFading:
    def test_relief_fades_and_does_not_pop(self) -> None:
        """The foot is seen 0.1 m further on; less so by pixels of half its depth, not by those of its depth."""
        question = asked(fit("floor"))
        footprints = np.linspace(0, 0.15, 600, dtype=np.float32)
        points, rays = (
            np.tile(np.array(own, np.float32), (600, 1)) for own in ([0.4, 0.5], [1.0, 0.0, -1.0])
        )
        seen = evaluate(question, points, rays, footprints).color[:, 0]
        assert seen[footprints < 0.05] == pytest.approx(0.5, abs=2e-3)
        assert (seen[footprints >= 0.1] == seen[-1]).all() and seen[-1] == pytest.approx(0.4, abs=2e-3)
        assert np.abs(np.diff(seen)).max() < 2e-3
        assert (np.diff(seen) <= 1e-6).all()

    def test_shadows_fade_with_it(self) -> None:
        question = asked(fit("step"), sun=TestShadows.LEFT)
        shades = [at(question, 0.54, footprint=own)[2] for own in np.linspace(0.03, 0.062, 33)]
        assert shades[0] == 1 and shades[-1] == pytest.approx(0.76, abs=0.01)
        assert np.abs(np.diff(shades)).max() < 0.03
        assert at(question, 0.54, footprint=0.1)[2] == 0


TEXT = """
S -> Layer(Wall, WallN, Things, ThingsN, Glass)
Wall -> Mat(Color, Rep:rustic, 0, 0, 0.5, 0.625)
WallN -> Mat(Normal, Rep:rustic.normal, 0, 0, 0.5, 0.625)
Things -> SplitX(Abs, 1.2, Crown, Rel, 1, Bars, Abs, 1.3, Window, Abs, 0.5, Posts)
ThingsN -> SplitX(Abs, 1.2, CrownN, Rel, 1, Skip, Abs, 1.3, WindowN, Abs, 0.5, Skip)
Crown -> Mat(Color, Fit:cornice-bracketed, 0, 0, 1, 1)
CrownN -> Mat(Normal, Fit:cornice-bracketed.normal, 0, 0, 1, 1)
Bars -> Mat(Color, Fit:railing, 0, 0, 1, 1)
Posts -> MatAlpha(Color, Fit:balustrade, 0, 0, 0.5, 1, Fit:mask-arch, 0, 0, 1, 1)
Window -> Layer(Room, Frame)
Frame -> Mat(Color, Fit:frame-crowned, 0, 0, 1, 1)
WindowN -> Mat(Normal, Fit:frame-crowned.normal, 0, 0, 1, 1)
Room -> Intrusion(1.5, Brick, Brick, Brick, Brick, Skip)
Brick -> Mat(Color, Rep:tiles, 0, 0, 0.5, 0.5)
Glass -> MatAlpha(Specular, Fit:door.specular, 1, 0, 0, 1, 0, 0.5, 0.5, 0.5, 0.5)
Skip -> Skip(0)
"""
SIZE = (5.0, 1.8)
EYES = {
    "below": ((2.5, -0.5, 1.2), (2.5, 0.9)),
    "left": ((-0.4, 1.0, 1.0), (2.0, 0.9)),
    "near": ((3.9, 1.0, 0.25), (3.6, 0.9)),
}


@pytest.fixture(scope="module")
def shipped() -> Grammar:
    return Grammar.parse(TEXT)


class TestEvaluatorsAgree:
    @pytest.mark.parametrize("mips", [False, True])
    @pytest.mark.parametrize("view", list(EYES))
    def test_glsl_and_numpy(self, shipped: Grammar, view: str, mips: bool) -> None:
        sight = Sight.from_eye(*EYES[view], SIZE, (240, 180), 80)
        question = shipped.question(SIZE, relief=True)._replace(sun=(-0.5, 0.6, 0.62))
        here, there = (PAINTERS[name].paint(question, sight, mips=mips) for name in ("cpu", "osmesa"))
        assert here.shade is not None and there.shade is not None
        wrong = (here.surface.rule != there.surface.rule) | (np.abs(here.shade - there.shade) > 5e-3)
        for a, b in zip(here.surface[:3], there.surface[:3], strict=True):
            wrong |= np.abs(a - b).max(axis=1) > 2e-3
        print(f"\n{wrong.sum()} of {len(wrong)} pixels differ")
        assert wrong.mean() < 5e-4
        assert (here.shade > 0.5).any()
        if mips:
            assert ((here.margin < 0.75) == (there.margin < 0.75)).mean() > 0.999
        plain = OSMESA.paint(shipped.question(SIZE), sight, mips=mips).surface
        assert (np.abs(plain.color - there.surface.color).max(axis=1) > 0.05).mean() > 0.1

    def test_heights_in_the_atlas_change_nothing_where_relief_is_off(self, shipped: Grammar) -> None:
        sight = Sight.from_eye(*EYES["left"], SIZE, (160, 120), 80)
        plain, packed = shipped.question(SIZE), shipped.question(SIZE, relief=True)._replace(relief=False)
        assert len(packed.atlas.table) > len(plain.atlas.table)
        for name in ("cpu", "osmesa"):
            one, other = (
                PAINTERS[name].paint(own, sight, mips=True, **count(name)) for own in (plain, packed)
            )
            assert all((a == b).all() for a, b in zip(one.surface, other.surface, strict=True))
            assert one.fetches is None or (one.fetches == other.fetches).all()
            assert one.shade is None

    @pytest.mark.parametrize("profile", list(PROFILES))
    @pytest.mark.parametrize(
        ("name", "defines"),
        [
            ("points.frag", ("RELIEF",)),
            ("points.frag", ("MIPS", "EDGES", "COLOR_ONLY", "COUNT_FETCHES", "RELIEF")),
            ("grammar.frag", ("MIPS", "EDGES", "DEEP", "OUTLINE", "SAMPLES", "RELIEF")),
            ("grammar.frag", ("MIPS", "EDGES", "DEEP", "RELIEF")),
            ("light.frag", ()),
        ],
    )
    def test_it_compiles_as_desktop_gl_and_webgl2(
        self, profile: str, name: str, defines: tuple[str, ...]
    ) -> None:
        assert shutil.which("glslangValidator"), "apt-get install glslang-tools"
        done = subprocess.run(
            ["glslangValidator", "--stdin", "-S", "frag"],
            input=shader(name, profile, defines=defines),
            text=True,
            capture_output=True,
        )
        assert done.returncode == 0, done.stdout


def count(name: str) -> dict[str, bool]:
    return {"count": True} if name == "osmesa" else {}


# The pipeline -----------------------------------------------------------------------------------------------

PIXELS = (120, 90)


def drawn(renderer: Renderer, relief: bool, hour: float = 10.5, wanted: str = "toned") -> NDArray[np.generic]:
    frustum = Viewpoint.towards((0.6, 0.4, 1.0), (2.0, 1.0, 0.0), 70).frustum(PIXELS)
    frame = Frame(renderer.scene, frustum, Daytime.at(hour), PIXELS, Looks(relief=relief))
    return renderer.draw(frame, (wanted,))[wanted]


class TestPipeline:
    def test_off_is_as_if_there_were_none(self, shipped: Grammar) -> None:
        """Off, on, and off again in one renderer; off alone; with flat tiles on is as off."""
        scene = Scene.of_facades([Facade(shipped, SIZE)])
        with renderer_of(scene, OSMESA) as renderer:
            first, on, again = (drawn(renderer, relief) for relief in (False, True, False))
        with renderer_of(scene, OSMESA) as renderer:
            after = drawn(renderer, True), drawn(renderer, False)
        assert (first == again).all() and (first == after[1]).all() and (on == after[0]).all()
        assert (np.abs(on.astype(int) - first.astype(int)).max(axis=2) > 20).mean() > 0.1
        flat = Scene.of_facades([Facade(Grammar.parse(fit("top"), Tiles()), SIZE)])
        with renderer_of(flat, OSMESA) as renderer:
            assert (drawn(renderer, True) == drawn(renderer, False)).all()

    def test_what_stands_out_is_nearer(self) -> None:
        """Occlusion is told so: a surface 0.2 m before the wall, seen from 2 m."""
        scene = Scene.of_facades([Facade(Grammar.parse(fit("proud"), Tiles()), (3.0, 2.0))])
        frustum = Viewpoint((1.5, 1.0, 2.0)).frustum(PIXELS)
        with renderer_of(scene, OSMESA) as renderer:
            deep = {}
            for relief in (False, True):
                frame = Frame(scene, frustum, Daytime.at(12), PIXELS, Looks(relief=relief))
                deep[relief] = renderer.draw(frame, ("specular",))["specular"][45, 60, 3]
        assert deep[False] == pytest.approx(0.0, abs=1e-3)
        assert deep[True] == pytest.approx(-0.2, abs=1e-3)

    def test_the_sun_is_lost_where_relief_stands_before_it(self) -> None:
        scene = Scene.of_facades([Facade(Grammar.parse(fit("step"), Tiles()), (1.0, 1.0))])
        frustum = Viewpoint((0.5, 0.5, 0.5), angle=70).frustum(PIXELS)
        alpha = {}
        with renderer_of(scene, OSMESA) as renderer:
            for hour in (8.0, 18.0, 1.0):
                frame = Frame(scene, frustum, Daytime.at(hour), PIXELS, Looks(relief=True))
                alpha[hour] = renderer.draw(frame, ("color",))["color"][45, :, 3].astype(float)
        assert (alpha[8.0] > 2.5).sum() > 5
        assert set(alpha[18.0]) <= {0.0, 1.0} and set(alpha[1.0]) <= {0.0, 1.0}  # from the right; by night


# Tiles, pictures, commands ----------------------------------------------------------------------------------


class TestTiles:
    def test_tiles_that_ship(self) -> None:
        tiles = TileSet.builtin(64)
        cornice, frame = tiles.relief("cornice"), tiles.relief("frame-casement")
        assert cornice is not None and frame is not None
        assert cornice.depth == pytest.approx(0.35, abs=0.01) and cornice.high == pytest.approx(
            0.37, abs=0.01
        )
        assert cornice.goes_on == (True, False) and cornice.stands and not frame.stands
        assert cornice.heights.min() == 0 and cornice.heights.max() == 1
        companion = tiles.relief("cornice.normal")
        assert companion is not None and (companion.heights == cornice.heights).all()
        assert tiles.relief("plaster") is None and tiles.relief("sofa") is None
        with pytest.raises(TileError, match="did you mean 'cornice'"):
            tiles.relief("cornise")

    def test_pictures_have_the_heights_of_a_picture(self, tmp_path: Path) -> None:
        grey = np.repeat(np.arange(0, 256, 8, dtype=np.uint8)[None], 32, axis=0)
        Image.fromarray(np.full((32, 32, 3), 200, np.uint8)).save(tmp_path / "stucco.png")
        Image.fromarray(grey).save(tmp_path / "stucco.height.png")
        Image.fromarray(grey).save(tmp_path / "cornice.png")
        tiles = TileSet.from_folder(tmp_path)
        found = tiles.relief("stucco")
        assert found is not None and found.depth == 0.05 and found.high == 0
        assert found.heights[0, 0] < 0.05 < 0.9 < found.heights[0, -1]
        assert tiles.relief("cornice") is None  # another picture than that of the heights that ship

    def test_a_photograph_has_relief_where_it_is_asked_for(self) -> None:
        house = [Facade(Grammar.parse(TEXT), SIZE)]
        pictures = [photograph(house, Photo((60, 40), 9.5, samples=1, relief=own)) for own in (False, True)]
        assert (np.abs(pictures[0].astype(int) - pictures[1].astype(int)).max(axis=2) > 15).mean() > 0.02

    def test_the_command_has_it(self, tmp_path: Path) -> None:
        (tmp_path / "g.txt").write_text(TEXT, encoding="utf-8")
        given = [
            "render",
            str(tmp_path / "g.txt"),
            "--size",
            "5x1.8",
            "--pixels",
            "80x60",
            "--eye",
            "0.4,0.4,1",
        ]
        for name, flags in (("off", []), ("on", ["--relief"])):
            assert main([*given, *flags, "--out", str(tmp_path / f"{name}.png")]) == 0
        on, off = (np.asarray(Image.open(tmp_path / f"{name}.png")).astype(int) for name in ("on", "off"))
        assert (np.abs(on - off).max(axis=2) > 15).mean() > 0.05
