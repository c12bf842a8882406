"""Sampling, mipmaps and upload: against loops that follow the formula, and against Pillow."""

from __future__ import annotations

from math import floor

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from facade_nb.render.tiles import TileSet
from facade_nb.render.tiles.images import bled, coverage, mipmaps

TILES = TileSet.builtin(64)
COORDINATE = st.floats(-3, 3, allow_nan=False, width=32)


def _by_the_formula(picture: np.ndarray, u: float, v: float, clamp: bool) -> np.ndarray:
    n = picture.shape[0]
    x, y = np.float32(u) * np.float32(n) - np.float32(0.5), np.float32(v) * np.float32(n) - np.float32(0.5)
    i, j = floor(x), floor(y)
    a, b = x - i, y - j

    def texel(column: int, row: int) -> np.ndarray:
        if clamp:
            column, row = min(max(column, 0), n - 1), min(max(row, 0), n - 1)
        return picture[n - 1 - row % n, column % n]  # rows are kept from the top, and counted from the bottom

    return (1 - b) * ((1 - a) * texel(i, j) + a * texel(i + 1, j)) + b * (
        (1 - a) * texel(i, j + 1) + a * texel(i + 1, j + 1)
    )


@given(st.lists(st.tuples(COORDINATE, COORDINATE), min_size=1, max_size=20), st.booleans())
@settings(max_examples=40, deadline=None)
def test_samples_follow_the_formula(points: list[tuple[float, float]], clamp: bool) -> None:
    u, v = np.array(points, np.float32).T
    found = TILES.sample("window1", u, v, clamp=clamp)
    expected = [_by_the_formula(TILES.color("window1"), *point, clamp) for point in points]
    assert np.abs(found - expected).max() < 1e-5


def test_the_origin_is_the_lower_left_corner() -> None:
    size = TILES.size
    middle = (np.arange(size) + 0.5) / size
    for row in (0, 5, size - 1):
        found = TILES.sample("door", middle, np.full(size, middle[row]))
        assert np.abs(found - TILES.color("door")[size - 1 - row]).max() < 1e-5


def test_clamped_samples_do_not_reach_the_opposite_edge() -> None:
    """The upper edge of `mask-rect` turned white: below, only what repeats sees it."""
    picture = np.array(TILES.color("mask-rect"))
    picture[0] = 1
    tiles = TileSet({"mine": picture}, 64)
    u, v = np.array([0.5], np.float32), np.array([0.0], np.float32)
    assert tiles.sample("mine", u, v)[0, 0] == pytest.approx(0.5)
    assert tiles.sample("mine", u, v, clamp=True)[0, 0] == 0


def test_mipmaps_of_opaque_tiles_are_means() -> None:
    levels = TILES.mips("brick")
    assert [level.shape[0] for level in levels] == [64, 32, 16, 8, 4, 2, 1]
    image = Image.fromarray((TILES.color("brick") * 255 + 0.5).astype(np.uint8)[..., :3])
    for level in levels[1:]:
        small = np.asarray(image.resize(level.shape[:2], Image.Resampling.BOX), float) / 255
        assert np.abs(level[..., :3] - small).max() <= 1.01 / 255


def test_colours_weigh_as_much_as_they_are_opaque() -> None:
    picture = np.zeros((2, 2, 4), np.float32)
    picture[0, 0] = (1, 0, 0, 1)
    picture[0, 1] = (0, 1, 0, 0.5)
    picture[1] = (0, 0, 1, 0)
    (mean,) = mipmaps(picture)[1].reshape(-1, 4)
    assert mean == pytest.approx([2 / 3, 1 / 3, 0, 0.375], abs=0.5 / 255)


def test_a_railing_keeps_its_colour_and_its_weight_from_afar() -> None:
    levels = TILES.mips("railing-plain")
    base = levels[0]
    colour = (base[..., :3] * base[..., 3:]).sum(axis=(0, 1)) / base[..., 3].sum()
    for level in levels[1:]:
        seen = (level[..., :3] * level[..., 3:]).sum(axis=(0, 1)) / level[..., 3].sum()
        assert np.abs(seen - colour).max() < 0.01
        assert abs(level[..., 3].mean() - base[..., 3].mean()) < 0.01


@pytest.mark.parametrize("shape", ["rect", "arch", "segment", "pointed", "round"])
def test_masks_keep_their_coverage(shape: str) -> None:
    levels = TileSet.builtin(256).mips(f"mask-{shape}")
    share = coverage(levels[0])
    for level in levels[1:-3]:
        step = 1.0 / level.shape[0]  # a mask is symmetric: pixels of one value come in pairs
        assert abs(coverage(level) - share) <= 1.5 * step
    plain = mipmaps(levels[0], "color")
    assert [coverage(level) for level in levels[1:]] != [
        coverage(level) for level in plain[1:]
    ] or shape == "rect"


def test_normals_stay_of_length_one() -> None:
    for level in TILES.mips("ashlar.normal"):
        assert np.abs(np.linalg.norm(2 * level[..., :3] - 1, axis=-1) - 1).max() < 0.02


def test_transparent_pixels_take_the_colour_of_their_neighbours() -> None:
    picture = np.zeros((8, 8, 4), np.float32)
    picture[2:4, 2:4] = (0.8, 0.4, 0.2, 1.0)
    filled = bled(picture)
    assert np.abs(filled[..., :3] - np.float32([0.8, 0.4, 0.2])).max() < 1e-3
    assert np.array_equal(filled[..., 3], picture[..., 3])
    assert (
        TILES.color("railing")[TILES.color("railing")[..., 3] == 0][:, :3].max() < 0.5
    )  # iron, not black or white


def test_the_array_is_what_samples_are_made_of() -> None:
    names = ["brick", "window1", "mask-arch"]
    levels = TILES.array(names=names)
    assert [level.shape for level in levels] == [(3, n, n, 4) for n in (64, 32, 16, 8, 4, 2, 1)]
    assert {level.dtype for level in levels} == {np.dtype(np.uint8)}
    for layer, name in enumerate(names):
        for level, picture in zip(levels, TILES.mips(name), strict=True):
            assert np.array_equal(level[layer].astype(np.float32) / np.float32(255), picture[::-1])
    assert TILES.array(levels=1, names=names)[0].shape == (3, 64, 64, 4)
    assert len(TILES.array(levels=3, names=["brick"])) == 3
