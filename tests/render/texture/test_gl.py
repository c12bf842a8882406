"""The GLSL evaluator against the NumPy one, pixel by pixel."""

from __future__ import annotations

import gc
import os
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image

from facade_nb.render import Grammar
from facade_nb.render.backends import BackendError
from facade_nb.render.texture import OPERATORS, Surface
from facade_nb.render.texture.evaluating import evaluate
from facade_nb.render.texture.facades import Facade
from facade_nb.render.texture.gl import EGL, OSMESA, GlPainter
from facade_nb.render.texture.painters import PAINTERS, choose_painter
from facade_nb.render.texture.picture import render_texture
from facade_nb.render.texture.question import Question
from facade_nb.render.texture.shaders import PROFILES, shader
from facade_nb.render.texture.steps import Chosen, Painted, Passed, Step
from facade_nb.render.texture.view import Looks, Sight
from facade_nb.render.tiles import TileSet

from ..rays import meet
from .brute import answer
from .figure_12 import FIGURE_12
from .grammars import grammar_texts, rays
from .stand_in import stand_in

SIZE = (7.0, 5.0)
POINTS = 3000
CLOSE = 2e-4
"""Of colours: far less than 8 bits show."""

Wrong = NDArray[np.bool_]
seeds = st.tuples(st.integers(-999, 999), st.integers(-999, 999)).map(lambda s: (s[0] / 8, s[1] / 10))


def looks(number: int, ray: tuple[float, float, float], count: int = POINTS) -> Looks:
    points = (np.random.Generator(np.random.PCG64(number)).random((count, 2)) * SIZE).astype(np.float32)
    return Looks(
        points,
        np.tile(np.array(ray, np.float32), (count, 1)),
        np.zeros(count, np.float32),
        0.0,
        np.ones(count, bool),
    )


def differing(found: Surface, wanted: Surface, close: float = CLOSE) -> Wrong:
    wrong: Wrong = found.rule != wanted.rule
    for a, b in zip(found[:3], wanted[:3], strict=True):
        wrong |= np.abs(a - b).max(axis=1) > close
    return wrong


@pytest.fixture(scope="module")
def seen() -> Iterator[Counter[str]]:
    """What has been compared; the share of pixels that differ is printed at the end."""
    counts: Counter[str] = Counter()
    yield counts
    share = counts["wrong"] / max(counts["pixels"], 1)
    print(f"\nGLSL and NumPy: {counts['wrong']} of {counts['pixels']} pixels differ ({share:.2e}),", end=" ")
    print(f"{counts['unsure']} of them near a boundary; {counts['grammars']} grammars")
    assert all(counts[name] > 10 for name in OPERATORS), counts


class TestEqual:
    @given(text=grammar_texts(rules=12), ray=rays(), seed=seeds, number=st.integers(0, 9))
    @settings(max_examples=150)
    def test_random_grammars(
        self,
        text: str,
        ray: tuple[float, float, float],
        seed: tuple[float, float],
        number: int,
        seen: Counter[str],
    ) -> None:
        """A pixel may differ only within 1e-4 m of a boundary, or with a corner that near to an edge of its step."""
        grammar = Grammar.parse(text, stand_in())
        asked, question = looks(number, ray), grammar.question(SIZE, seed)
        wanted = evaluate(question, asked.points, asked.rays)
        wrong = differing(OSMESA.paint_at(question, asked).surface, wanted)
        seen["pixels"] += POINTS
        seen["grammars"] += 1
        seen.update({rule.operator.name for rule in grammar.rules})
        for k in np.flatnonzero(wrong):
            point = tuple(asked.points[k].astype(float))
            margin = answer(grammar, stand_in(), point, SIZE, seed, ray=ray).margin
            seen["wrong"] += 1
            seen["unsure"] += margin < 1e-4
            assert margin < 1e-4, (point, margin)

    @pytest.mark.parametrize("name", list(OPERATORS))
    def test_each_operator(self, name: str) -> None:
        """With every part of it to be seen, on a grid whose pixels fall on boundaries."""
        operator_texts = {
            "RepeatX": "S -> RepeatX(0.7, T)",
            "RepeatY": "S -> RepeatY(0.7, T)",
            "SplitX": "S -> SplitX(Abs, 1, R, Rel, 1, T, Rel, 2, G, Abs, 2.3, B)",
            "SplitY": "S -> SplitY(Rel, 1, R, Abs, 4.9, T, Abs, 3, G)",
            "Rand": "S -> RepeatX(0.25, U)\nU -> RepeatY(0.25, V)\nV -> Rand(0, 0.2, R, 0.5, G, 0.3, B)",
            "RandUni": "S -> RepeatX(0.25, U)\nU -> RepeatY(0.25, V)\nV -> RandUni(0, R, G, B, H, T)",
            "RandStack": "S -> RepeatX(1, U)\nU -> RandStack(V)\nV -> RepeatX(0.25, W)\nW -> RandUni(1, R, G, B)",
            "Layer": "S -> Layer(T, H, H, N, M, H)",
            "Skip": "S -> Layer(R, G, B, T, U)\nU -> RepeatX(1, V)\nV -> RandUni(0, K, L, O, H)",
            "SkipMask": "S -> RepeatX(1, U)\nU -> Layer(R, T, H, V)\nV -> SkipMask(Fit:disc, 0, 1)",
            "Intrusion": "S -> RepeatX(1.5, U)\nU -> RepeatY(1.2, V)\nV -> Layer(X, Y)\n"
            "X -> Intrusion(2, T, N, R, W, B)\nW -> Intrusion(0.3, R, G, B, H, H)\nY -> Intrusion(2, N, N, N, M, M)",
            "Mat": "S -> Layer(T, M, N)",
            "MatAlpha": "S -> Layer(T, Q)\nQ -> MatAlpha(Color, Rep:wall1, 0, 0, 1, 1, Fit:disc, 0, 0, 1, 1)",
        }
        text = f"""{operator_texts[name]}
        T -> Mat(Color, Rep:window2, 0.25, 0.125, 0.5, -0.75)
        R -> Mat(Color, 0, 1, 0, 0, 1)
        G -> Mat(Color, 0, 0, 1, 0, 1)
        B -> Mat(Color, Fit:window1, 0, 0, 1, 0.5)
        H -> Mat(Color, 0, 1, 1, 0, 0.5)
        N -> Mat(Normal, Fit:window3, 1, 0, 0, 1)
        M -> Mat(Specular, Rep:window2, 0, 0, 2, 2)
        K -> Skip(0)
        L -> Skip(1)
        O -> Skip(2)
        """
        sight = Sight.from_eye((3, 2.5, 3), (3, 2.5), (6, 5), (240, 200), 90)
        question = Grammar.parse(text, stand_in()).question((6, 5), (1, 2))
        for view in (sight, Sight.flat((6, 5), (240, 200))):
            shot = OSMESA.paint(question, view)
            wanted = PAINTERS["cpu"].paint(question, view)
            assert differing(shot.surface, wanted.surface).mean() < 0.002
            alone = OSMESA.paint(question, view, color_only=True).surface
            assert np.array_equal(alone.color, shot.surface.color) and not alone.normal.any()
            assert np.array_equal(alone.rule, shot.surface.rule)
            assert (wanted.surface.color[:, 3] > 0).any() or view is not sight

    def test_what_a_skip_leaves_last_is_not_taken_for_a_layer_around_it(self) -> None:
        """Found by the test of random grammars: Bump was painted once more, in the place of S's first layer."""
        text = """S -> Layer(Gap, Inner)  Inner -> Layer(Bump, Gap, Gap, Gap)  Gap -> Skip(2)
        Bump -> Mat(Color, 0, 1, 0, 0, 0.5)"""
        question = Grammar.parse(text, stand_in()).question((6, 5))
        surface = OSMESA.paint(question, Sight.flat((6, 5), (12, 10))).surface
        assert surface.color[:, 3] == pytest.approx(np.full(120, 0.5), abs=1e-6)

    def test_figure_12_on_a_grid(self) -> None:
        question = Grammar.parse(FIGURE_12).question((12, 9), (1, 2))
        view = Sight.flat((12, 9), (400, 300))
        wrong = differing(OSMESA.paint(question, view).surface, PAINTERS["cpu"].paint(question, view).surface)
        assert wrong.sum() == 0

    def test_large_seeds(self) -> None:
        grammar = Grammar.parse(FIGURE_12, stand_in())
        for seed in ((1e12 + 0.3, -7e9), (2.0**31, 2.0**31 - 0.01)):
            question = grammar.question((12, 9), seed)
            asked = looks(1, (0, 0, -1))
            wanted = evaluate(question, asked.points, asked.rays)
            assert differing(OSMESA.paint_at(question, asked).surface, wanted).sum() == 0

    def test_a_grammar_of_32_bits(self) -> None:
        parts = ", ".join(f"Abs, {0.001 + k / 1e6}, {'AB'[k % 2]}" for k in range(2100))
        text = f"S -> SplitX({parts})\nA -> Mat(Color, 0, 1, 0, 0, 1)\nB -> Mat(Color, 0, 0, 1, 0, 1)"
        question = Grammar.parse(text).question((4, 4))
        assert question.texture.dtype == np.float32
        asked = looks(2, (0, 0, -1))
        wanted = evaluate(question, asked.points, asked.rays)
        assert (
            differing(OSMESA.paint_at(question, asked).surface, wanted).mean() < 0.02
        )  # boundaries are dense

    def test_deep_stacks(self) -> None:
        """As deep as is allowed: each layer adds its share of colour, each seed is found again."""
        layers = "\n".join(f"L{k} -> Layer(P{k}, L{k + 1})" for k in range(12))
        paints = "\n".join(
            f"P{k} -> Mat(Color, 0, {k / 12:.3f}, 0, {1 - k / 12:.3f}, 0.5)" for k in range(12)
        )
        pushes = "\n".join(
            f"T{k} -> SplitX(Abs, 0.3, C{k}, Rel, 1, U{k})\nU{k} -> RandStack(T{k + 1})" for k in range(12)
        )
        picks = "\n".join(f"C{k} -> RandUni({k}, P0, P3, P6, P9)" for k in range(13))
        text = f"S -> Layer(L0)\n{layers}\nL12 -> SplitY(Rel, 1, T0, Rel, 1, P11)\n{paints}\n{pushes}\n"
        text += f"T12 -> Layer(C12)\n{picks}"
        grammar = Grammar.parse(text)
        question = grammar.question(SIZE, (3, 5))
        assert question.stacks == (12, 12)
        asked = looks(3, (0, 0, -1))
        wanted = evaluate(question, asked.points, asked.rays)
        assert differing(OSMESA.paint_at(question, asked).surface, wanted).mean() < 0.001
        assert (wanted.color[:, 3] > 0.99).all()

    def test_recursion(self) -> None:
        text = "S -> SplitX(Rel, 1, R, Rel, 1, T)\nT -> SplitY(Rel, 1, G, Rel, 1, S)\n"
        text += "U -> SplitX(Abs, 0.001, R, Rel, 1, U)\n"
        text += "R -> Mat(Color, 0, 1, 0, 0, 1)\nG -> Mat(Color, 0, 0, 1, 0, 1)"
        grammar = Grammar.parse(text)
        asked = looks(4, (0, 0, -1))
        for start in ("S", "U"):
            question = grammar.question(SIZE, start=start)
            wanted = evaluate(question, asked.points, asked.rays)
            assert differing(OSMESA.paint_at(question, asked).surface, wanted).mean() < 0.002
        assert (wanted.rule == -1).any() and (wanted.rule >= 0).any()


def texels(grammar: Grammar, steps: tuple[Step, ...]) -> int:
    """How many texels a derivation reads: records, random numbers; of tiles their place, four texels, their kind."""
    count = 0
    for step in steps:
        count += len(step.records)
        fixed = grammar.rules[step.rule].fixed
        match step:
            case Chosen():
                count += 1
            case Passed(mask=mask):
                count += 6 if mask is not None else 0
            case Painted():
                sources = [value for value in fixed if hasattr(value, "tile")]
                count += sum(5 for source in sources if source.tile)
                count += sum(1 for source in sources[1:] if source.tile)
    return count


@given(grammar_texts(rules=12), rays(), st.integers(0, 9))
@settings(max_examples=60)
def test_no_texel_is_read_that_a_derivation_does_not_need(
    text: str, ray: tuple[float, float, float], number: int
) -> None:
    """So no record twice within an operator, and nothing below opaque colour."""
    grammar = Grammar.parse(text, stand_in())
    asked = looks(number, ray, 12)
    shot = OSMESA.paint_at(grammar.question(SIZE, (3, 4)), asked, count=True)
    assert shot.fetches is not None
    wanted = [
        texels(grammar, grammar.steps(tuple(p), SIZE, (3, 4), ray=ray)) for p in asked.points.astype(float)
    ]
    assert shot.fetches.tolist() == wanted


class TestSizesOfTiles:
    def test_as_numpy(self) -> None:
        text = "S -> SplitX(Rel, 1, A, Rel, 1, B)\nA -> Mat(Color, Rep:wall1, 0, 0, 1, 2)\n"
        text += "B -> RepeatY(0.5, C)\nC -> Mat(Color, Fit:window1, 0, 0, 1, 1)"
        question = Grammar.parse(text, stand_in()).question((6, 5))
        for pixels in ((24, 20), (90, 75), (300, 250)):
            sight = Sight.from_eye((1, 1, 2), (3, 2), (6, 5), pixels, 70)
            shots = [PAINTERS[name].paint(question, sight, mips=True) for name in ("osmesa", "cpu")]
            assert differing(shots[0].surface, shots[1].surface).mean() < 0.002
            inside = shots[1].margin < 1e8
            assert np.abs(shots[0].margin - shots[1].margin)[inside].max() < 0.01
            assert np.array_equal(shots[0].margin < 1e8, inside)

    @given(
        text=grammar_texts(rules=12),
        eye=st.tuples(
            st.floats(-4, 11, width=32), st.floats(0.25, 6, width=32), st.floats(0.25, 12, width=32)
        ),
        seed=seeds,
    )
    @settings(max_examples=60)
    def test_random_grammars_with_a_camera(
        self, text: str, eye: tuple[float, float, float], seed: tuple[float, float]
    ) -> None:
        """Also along the wall: the same rules and colours, and the same pixels are sampled again."""
        question = Grammar.parse(text, stand_in()).question(SIZE, seed)
        sight = Sight.from_eye(eye, (3.5, 2.5), SIZE, (40, 30), 60)
        found, wanted = (PAINTERS[name].paint(question, sight, mips=True) for name in ("osmesa", "cpu"))
        assert differing(found.surface, wanted.surface).sum() <= 2  # those on a boundary
        assert ((found.margin < 0.75) != (wanted.margin < 0.75)).sum() <= 2

    def test_far_away_a_tile_is_its_mean(self) -> None:
        question = Grammar.parse("S -> Mat(Color, Rep:wall1, 0, 0, 1, 1)", stand_in()).question((400, 400))
        shot = OSMESA.paint(question, Sight.flat((400, 400), (20, 20)), mips=True)
        mean = stand_in().image("wall1").astype(float).mean(axis=(0, 1)) / 255
        assert np.abs(shot.surface.color - mean).max() < 0.01

    @pytest.mark.parametrize("backend", ["osmesa", "cpu"])
    @pytest.mark.parametrize("source", ["Rep:{}, 0.3, 0.2, 1.5, -2.5", "Fit:{}, 0, 0, 1, 1"])
    @pytest.mark.parametrize("side", [32, 128])
    def test_neighbours_in_the_atlas_do_not_bleed(
        self, side: int, source: str, backend: str, tmp_path: Path
    ) -> None:
        """Plain red beside plain green: at every size of the tiles, also along the wall, each stays what it is."""
        plain = {"red": (255, 0, 0), "green": (0, 255, 0)}
        for name, colour in plain.items():
            Image.new("RGB", (side, side), colour).save(tmp_path / f"{name}.png")
        tiles = TileSet.from_folder(tmp_path, builtin=False, size=side)
        text = "S -> RepeatX(2, Two)\nTwo -> SplitX(Rel, 1, R, Rel, 1, G)\n"
        text += f"R -> Mat(Color, {source.format('red')})\nG -> Mat(Color, {source.format('green')})"
        size = (64.0, 40.0)
        grammar = Grammar.parse(text, tiles)
        question = grammar.question(size)
        left, bottom, width, height = question.atlas.table[:, 0].T
        assert (width == side).all() and (height == side).all()
        apart = sorted([abs(left[0] - left[1]), abs(bottom[0] - bottom[1])])
        assert apart == [0, side]  # one beside or upon the other, no gap between
        wanted = np.zeros((2, 4), np.float32)
        wanted[:, 3] = wanted[0, 0] = wanted[1, 1] = 1
        levels: set[int] = set()
        sights = [Sight.flat(size, (w, round(w / 1.6))) for w in (640, 320, 160, 80, 40, 16, 5)]
        sights += [Sight.from_eye((-1.0, 9.0, z), (60.0, 9.0), size, (160, 90), 60) for z in (0.05, 0.3, 2.0)]
        for sight in sights:
            shot = PAINTERS[backend].paint(question, sight, mips=True)
            seen = shot.surface.rule >= 0
            assert seen.any()
            part = (shot.surface.rule[seen] == grammar.index("G")).astype(int)
            assert np.abs(shot.surface.color[seen] - wanted[part]).max() < 1e-6
            texels = side * np.maximum(sight.looks().footprint, 1e-9) * (1.5 if "Rep" in source else 1)
            levels |= set(np.floor(np.log2(np.maximum(texels, 1))).astype(int).tolist())
        assert levels >= set(range(question.atlas.table.shape[1])), levels

    def test_one_program_serves_every_facade(self) -> None:
        """Size, start rule, seed and axes are inputs: façades that differ in all of them need no other shader."""
        text = f"{FIGURE_12}\nOther -> RepeatX(1.1, WindowMat)\nRoom -> RepeatX(2, Box)\n"
        text += "Box -> Intrusion(3, Wall1, Wall2, WindowMat2, Wall3, WindowMat3)"
        grammar = Grammar.parse(text, stand_in())
        OSMESA.paint_at(grammar.question((3, 3)), looks(0, (0, 0, -1), 9))
        programs = dict(OSMESA._programs)
        random = np.random.Generator(np.random.PCG64(3))
        seen: set[int] = set()
        for k, start in enumerate((None, "Other", "Room")):
            size, seed, angle = (4.5 + 3 * k, 9.25 - 2 * k), (k + 0.5, 0.3 * k), 0.7 * k - 0.4
            tangent = np.array([np.cos(angle), 0, -np.sin(angle)])
            normal = np.array([np.sin(angle), 0, np.cos(angle)])
            corner = random.uniform(-5, 5, 3)
            points = random.random((300, 2)) * size
            eye = corner + 3 * tangent + (0, 2, 0) + 5 * normal
            rays = corner + points[:, :1] * tangent + points[:, 1:] * (0, 1, 0) - eye
            facade = Facade(grammar, size, tuple(corner), tuple(tangent), seed=seed, start=start)
            hits = meet([facade], eye.astype(np.float32), rays.astype(np.float32))
            there = hits.facade == 0
            local = rays.astype(np.float32) @ facade.axes.T
            asked = Looks(hits.places, local, np.zeros(300, np.float32), 0.0, there)
            found = OSMESA.paint_at(grammar.question(size, seed, start), asked).surface.rule
            for point, ray, rule in zip(points[there], rays[there], found[there], strict=True):
                own = (float(ray @ tangent), float(ray[1]), float(ray @ normal))
                wanted = answer(grammar, stand_in(), tuple(point), size, seed, start, own)
                assert rule == wanted.rule or wanted.margin < 1e-4
            assert there.mean() > 0.99
            seen |= set(found.tolist())
        assert OSMESA._programs == programs
        assert len(seen) > 5


class TestBackends:
    @pytest.mark.parametrize("profile", list(PROFILES))
    @pytest.mark.parametrize("name", ["whole.vert", "points.frag"])
    @pytest.mark.parametrize("defines", [(), ("MIPS", "EDGES", "COLOR_ONLY", "COUNT_FETCHES")])
    def test_one_source_compiles_as_desktop_gl_and_webgl2(
        self, profile: str, name: str, defines: tuple[str, ...]
    ) -> None:
        assert shutil.which("glslangValidator"), "apt-get install glslang-tools"
        source = shader(name, profile, defines=defines)
        assert "#include" not in source
        done = subprocess.run(
            ["glslangValidator", "--stdin", "-S", name[-4:]], input=source, text=True, capture_output=True
        )
        assert done.returncode == 0, done.stdout

    def test_the_body_is_the_same(self) -> None:
        bodies = {shader("points.frag", profile)[len(head) :] for profile, head in PROFILES.items()}
        assert len(bodies) == 1

    def test_the_one_that_works_is_chosen(self) -> None:
        assert choose_painter().name in ("osmesa", "egl")
        assert choose_painter("cpu").available
        with pytest.raises(
            ValueError, match="expected one of osmesa, egl, cpu; found 'osmsa'; did you mean 'osmesa'"
        ):
            choose_painter("osmsa")

    def test_what_is_missing_is_told_with_the_command_that_helps(
        self, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        from facade_nb.render.texture import gl

        monkeypatch.setattr(gl, "find_osmesa", lambda: None)
        painter = GlPainter("osmesa", gl._no_osmesa, gl._make_osmesa, gl._INSTALL_OSMESA)
        assert (
            not painter.available and "apt-get install --no-install-recommends libosmesa6" in painter.why_not
        )
        monkeypatch.setitem(PAINTERS, "osmesa", painter)
        with pytest.raises(BackendError, match="libosmesa6"):
            choose_painter("osmesa")

        def refuse() -> None:
            raise RuntimeError("no driver")

        egl = GlPainter("egl", lambda: "", refuse, gl._INSTALL_EGL)
        assert (
            "can be made (no driver)" in egl.why_not and "recommends libegl1 libgl1-mesa-dri" in egl.why_not
        )
        monkeypatch.setitem(PAINTERS, "egl", egl)
        assert choose_painter().name == "cpu"

    def test_egl_agrees(self) -> None:
        """In a process of its own, where there is an EGL; where there is none it says so."""
        code = """
import numpy as np
from facade_nb.render import Grammar
from facade_nb.render.texture.painters import PAINTERS
from facade_nb.render.texture.view import Sight
from tests.render.texture.figure_12 import FIGURE_12
egl = PAINTERS["egl"]
print(egl.why_not)
if egl.available:
    question = Grammar.parse(FIGURE_12).question((12, 9), (1, 2))
    shots = [PAINTERS[name].paint(question, Sight.flat((12, 9), (200, 150))).surface for name in ("egl", "cpu")]
    print((shots[0].rule != shots[1].rule).sum(), np.abs(shots[0].color - shots[1].color).max() < 1e-3)
"""
        root = Path(__file__).parents[3]
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=root)
        assert done.returncode == 0, done.stderr
        assert done.stdout == "\n0 True\n" or done.stdout.startswith("egl: "), done.stdout
        assert done.stdout.startswith("egl: ") != EGL.available

    def test_renders_leak_nothing(self) -> None:
        grammar = Grammar.parse("S -> Mat(Color, Rep:wall1, 0, 0, 1, 1)", stand_in())

        def render(times: int) -> None:
            for k in range(times):
                render_texture(grammar, size=(12, 9), pixels=(192, 144), seed=(k, 0), backend="osmesa")

        def memory() -> int:
            gc.collect()
            return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        render(30)  # caches of the driver and of Python fill
        before, files = memory(), len(list(Path("/proc/self/fd").iterdir()))
        render(80)
        assert len(list(Path("/proc/self/fd").iterdir())) == files
        assert memory() - before < 4_000_000  # one texture of each render would be over 8 MB

    def test_threads(self) -> None:
        """One at a time, each with the context in its own thread."""
        from concurrent.futures import ThreadPoolExecutor

        question: Question = Grammar.parse(FIGURE_12, stand_in()).question((12, 9), (1, 2))
        sight = Sight.flat((12, 9), (80, 60))
        wanted = OSMESA.paint(question, sight).surface.rule
        with ThreadPoolExecutor(4) as pool:
            for shot in pool.map(lambda _: OSMESA.paint(question, sight), range(12)):
                assert (shot.surface.rule == wanted).all()
