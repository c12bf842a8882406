"""A façade alone in the pipeline, against the same picture in NumPy: straight on or not, lit or not."""

from __future__ import annotations

import numpy as np
import pytest

from facade_nb import gallery
from facade_nb.render import Grammar
from facade_nb.render.pipeline.device import choose_device
from facade_nb.render.texture.picture import MAX_SIDE, texture_pixels
from facade_nb.render.texture.view import Sight
from facade_nb.render.tiles import TileSet

SIZE, PIXELS = (9.0, 8.0), (72, 64)
SIGHTS = {"flat": None, "camera": Sight.from_eye((2.0, 1.7, 5.0), (6.0, 4.0), SIZE, PIXELS, 70)}


@pytest.fixture(scope="module")
def grammar() -> Grammar:
    return Grammar.parse(gallery.grammar("figure-10"), TileSet.builtin(64))


@pytest.mark.parametrize("sight", list(SIGHTS))
@pytest.mark.parametrize(
    ("antialias", "hour", "relief"),
    [
        ("none", None, False),
        ("adaptive", None, False),
        ("adaptive", None, True),
        ("supersample", 9.5, False),
        ("adaptive", 9.5, True),
        ("adaptive", 21.0, False),
    ],
)
def test_a_facade_alone_is_that_of_numpy(
    grammar: Grammar, sight: str, antialias: str, hour: float | None, relief: bool
) -> None:
    given = {"size": SIZE, "pixels": PIXELS, "seed": (3.7, -1e9), "camera": SIGHTS[sight], "hour": hour}
    here, there = (
        texture_pixels(grammar, **given, antialias=antialias, relief=relief, backend=name).astype(int)
        for name in ("cpu", choose_device().name)
    )
    seen = np.maximum(here[..., 3:], there[..., 3:]) > 12  # elsewhere a colour means nothing
    apart = (np.abs(here - there) * seen).max(axis=2)
    assert (apart <= 3).mean() > 0.99 and apart.mean() < 0.6
    assert np.abs(here[..., 3] - there[..., 3]).max() <= 20
    assert here[..., :3].std() > 15


def test_its_outline_is_smooth_and_as_bright_as_inside() -> None:
    plain = Grammar.parse("S -> Mat(Color, 0, 0.6, 0.6, 0.6, 1)")
    sight = Sight.from_eye((1, 1.5, 2.5), (-0.5, 2), (5, 4), (75, 60), 90)
    for hour in (None, 12.0):
        image = texture_pixels(
            plain, size=(5, 4), pixels=(75, 60), camera=sight, hour=hour, backend=choose_device().name
        ).astype(int)
        alpha = image[..., 3]
        rim = (alpha > 25) & (alpha < 230)
        assert rim.sum() > 20 and set(np.unique(alpha).tolist()) >= {0, 255}
        inside = image[alpha == 255][:, 0]
        assert image[rim][:, 0].min() >= inside.min() - 4 and image[rim][:, 0].max() <= inside.max() + 4


def test_a_large_picture_is_drawn_in_parts() -> None:
    bars = Grammar.parse(
        "S -> RepeatX(1, T)  T -> SplitX(Rel, 1, A, Rel, 1, B)"
        "  A -> Mat(Color, 0, 1, 0, 0, 1)  B -> Mat(Color, 0, 0, 0, 1, 1)"
    )
    image = texture_pixels(bars, size=(64, 1), pixels=(16384, 64), backend=choose_device().name)
    assert MAX_SIDE > 16384 and (image == image[:1]).all()
    wanted = np.where((np.arange(16384) + 0.5) / 256 % 1 < 0.5, 255, 0)
    assert (image[0, :, 0] == wanted).all() and (image[0, :, 2] == 255 - wanted).all()
