"""Antialiasing of split boundaries, against 89 samples a pixel."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from facade_nb.render import Grammar
from facade_nb.render.texture.antialias import ANTIALIAS, smoothed
from facade_nb.render.texture.painters import PAINTERS
from facade_nb.render.texture.question import Question
from facade_nb.render.texture.shot import Shot
from facade_nb.render.texture.view import Sight

from .stand_in import stand_in

Floats = NDArray[np.float32]
CPU = PAINTERS["cpu"]
COLOURS = "R -> Mat(Color, 0, 1, 0, 0, 1)\nG -> Mat(Color, 0, 0, 1, 0, 1)\nB -> Mat(Color, 0, 0, 0, 1, 1)\n"

SCENES = {
    "splits": "S -> RepeatX(0.37, T)\nT -> RepeatY(0.41, U)\nU -> SplitX(Rel, 1, R, Rel, 2, V)\n"
    "V -> SplitY(Abs, 0.13, G, Rel, 1, B)",
    "thin bars": "S -> RepeatX(0.5, T)\nT -> SplitX(Rel, 1, R, Abs, 0.013, G, Rel, 1, R)",
    "layers": "S -> Layer(B, U)\nU -> RepeatX(0.7, T)\nT -> SplitX(Abs, 0.2, V, Rel, 1, R)\nV -> Skip(0)",
    "a mask": "S -> RepeatX(1.3, T)\nT -> Layer(G, R, V)\nV -> SkipMask(Fit:disc, 0, 1)",
    "rooms": "S -> RepeatX(1.5, T)\nT -> RepeatY(1.5, U)\nU -> Intrusion(1, R, V, R, G, B)\n"
    "V -> SplitX(Rel, 1, G, Rel, 1, B)",
}  # fmt: skip
SIGHTS = {
    "flat": Sight.flat((5, 4), (75, 60)),
    "camera": Sight.from_eye((1, 1.5, 2.5), (2.5, 2), (5, 4), (75, 60), 90),
}


def question(text: str) -> Question:
    return Grammar.parse(f"{text}\n{COLOURS}", stand_in()).question((5, 4))


def truth(asked: Question, sight: Sight) -> Floats:
    """The mean of 89 samples in each pixel, no two of which have an x or a y in common (a Fibonacci lattice)."""
    shifts = [((n + 0.5) / 89, (n * 55 % 89 + 0.5) / 89) for n in range(89)]
    colors = [CPU.paint_at(asked, sight.looks(None, at)).surface.color for at in shifts]
    mean: Floats = np.mean(colors, axis=0, dtype=np.float32)
    return mean


@functools.cache
def truth_of(scene: str, sight: str) -> Floats:
    """Of a scene; each backend is held to the same."""
    return truth(question(SCENES[scene]), SIGHTS[sight])


def error(found: Floats, wanted: Floats) -> float:
    return float(np.sqrt(np.mean((found - wanted) ** 2)))


@pytest.mark.parametrize(("backend", "sight"), [("cpu", "flat"), ("cpu", "camera"), ("osmesa", "camera")])
@pytest.mark.parametrize("scene", list(SCENES))
def test_boundaries_are_as_smooth_as_with_16_samples(scene: str, sight: str, backend: str) -> None:
    asked, view, painter = question(SCENES[scene]), SIGHTS[sight], PAINTERS[backend]
    wanted = truth_of(scene, sight)
    errors = {how: error(smoothed(painter, asked, view, how), wanted) for how in ANTIALIAS}
    assert errors["none"] > 0.02
    assert errors["adaptive"] < errors["none"] / 2
    assert errors["adaptive"] < errors["supersample"] * 1.25 + 0.002


def test_only_pixels_near_a_boundary_are_sampled_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """A wall with one boundary, at x = 2.51 m: one column of pixels, and those at the wall's ends."""
    from facade_nb.render.texture import antialias

    asked, sight, numbers = question("S -> SplitX(Abs, 2.51, R, Rel, 1, G)"), SIGHTS["flat"], []
    real = antialias._mean

    def spy(*given: Any) -> Shot:
        numbers.append(given[3])
        return real(*given)

    monkeypatch.setattr(antialias, "_mean", spy)
    color = smoothed(CPU, asked, sight).reshape(60, 75, 4)
    assert set((numbers[0] % 75).tolist()) == {0, 37, 74}
    share = (2.51 - 37 / 15) * 15
    assert color[:, 37, 0] == pytest.approx(share, abs=1 / 32)
    assert (color[:, :37, 0] == 1).all() and (color[:, 38:, 1] == 1).all()


def test_the_outline_of_the_facade_is_smooth() -> None:
    asked = question("S -> Layer(R)")
    alpha = smoothed(CPU, asked, Sight.from_eye((1, 1.5, 2.5), (-0.5, 2), (5, 4), (75, 60), 90))[:, 3]
    assert ((alpha > 0.1) & (alpha < 0.9)).sum() > 20


def test_tiles_far_away_do_not_alias() -> None:
    """A wall of tiles much smaller than a pixel: one sample gives noise, a smaller size of the tile its mean."""
    asked, sight = question("S -> Mat(Color, Rep:wall1, 0, 0, 30, 30)"), SIGHTS["flat"]
    wanted = truth(asked, sight)
    assert error(smoothed(CPU, asked, sight), wanted) < 0.2 * error(
        smoothed(CPU, asked, sight, "none"), wanted
    )


@pytest.mark.parametrize("backend", ["cpu", "osmesa"])
@pytest.mark.parametrize(
    "material", ["Rep:wall1, 0, 0, 3, 3", "Rep:wall1, 0, 0, 1, 9", "Fit:wall1, 0, 0, 1, 1"]
)
def test_tiles_seen_along_the_wall_do_not_alias(material: str, backend: str) -> None:
    """A pixel is a long ellipse there: a size of the tile that fits across it is too sharp along it."""
    asked = question(f"S -> RepeatX(0.4, T)\nT -> RepeatY(0.37, U)\nU -> Mat(Color, {material})")
    sight = Sight.from_eye((-1.5, 1.5, 0.3), (3.0, 2.0), (5, 4), (75, 60), 50)
    painter, wanted = PAINTERS[backend], truth(asked, sight)
    errors = {how: error(smoothed(painter, asked, sight, how), wanted) for how in ANTIALIAS}
    assert errors["none"] > 4 * errors["supersample"]
    assert errors["adaptive"] < 1.35 * errors["supersample"]
    assert error(painter.paint(asked, sight, mips=True).surface.color, wanted) < 0.65 * errors["none"]


def test_both_evaluators_take_the_same_size_of_a_tile_at_whole_texels_a_pixel() -> None:
    """There a rounding would decide for the next size."""
    for texels in (1, 2, 4, 8):
        asked, sight = (
            question(f"S -> Mat(Color, Rep:wall1, 0, 0, {texels / 16}, {texels / 16})"),
            Sight.flat((5, 4), (80, 64)),
        )
        shots = [PAINTERS[one].paint(asked, sight, mips=True) for one in ("cpu", "osmesa")]
        assert np.abs(shots[0].surface.color - shots[1].surface.color).max() < 2e-4
        assert np.array_equal(shots[0].margin, shots[1].margin)


def test_an_unknown_kind() -> None:
    with pytest.raises(
        ValueError, match="expected one of none, adaptive, supersample; found 'adaptiv'; did you mean"
    ):
        smoothed(CPU, question("S -> Layer(R)"), SIGHTS["flat"], "adaptiv")
