"""What stands out of a wall throws a shadow on the tiles below it, as far as the sun says."""

from __future__ import annotations

import numpy as np
import pytest

from facade_nb.render import Grammar
from facade_nb.render.pipeline import Scene, Viewpoint, choose_device, renderer_of
from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.texture.facades import Facade

PIXELS = (180, 240)
FOOT, BAND = 2.0, 0.2
GRAMMAR = """
Wall -> SplitY(Abs, 2, Plain, Abs, 0.2, Band, Rel, 1, Plain)
Plain -> Mat(Color, 0, 0.7, 0.7, 0.7, 1)
Band -> RepeatX(1.2, Piece)
Piece -> Layer(Colour, Bumps)
Colour -> Mat(Color, Fit:cornice, 0, 0, 1, 1)
Bumps -> Mat(Normal, Fit:cornice.normal, 0, 0, 1, 1)
Bare -> Mat(Color, 0, 0.7, 0.7, 0.7, 1)
"""
OUT = 0.37
"""How far the tile stands out of its wall, metres."""


def lit(rule: str, daytime: Daytime) -> np.ndarray:
    """Brightness (h,) of the rows of a wall that is seen straight on, its height from 0 to 4 m."""
    grammar = Grammar.parse(GRAMMAR)
    scene = Scene.of_facades([Facade(grammar, (6.0, 4.0), start=rule)])
    place = Viewpoint.towards((3.0, 2.0, 12.0), (3.0, 2.0, 0.0), 14.0)
    looks = Looks(haze=0.0, occlusion=False, smooth=False)
    with renderer_of(scene, choose_device()) as renderer:
        drawn = renderer.draw(Frame(scene, place.frustum(PIXELS), daytime, PIXELS, looks), ["light"])
    return np.asarray(drawn["light"][..., :3].sum(axis=2).mean(axis=1))


@pytest.mark.parametrize("hour", [11.0, 13.0, 15.5])
def test_a_cornice_throws_a_shadow_as_long_as_the_sun_is_high(hour: float) -> None:
    daytime = Daytime.at(hour)
    _, up, out = daytime.towards
    share = lit("Wall", daytime) / lit("Bare", daytime)
    half = 12.0 * np.tan(np.radians(7.0)) * PIXELS[1] / PIXELS[0]
    height = 2.0 + half * (1 - (2 * np.arange(PIXELS[1]) + 1) / PIXELS[1])
    end = FOOT + BAND - OUT * up / out  # of the shadow of its upper edge
    dark = (height > end + 0.12) & (height < FOOT - 0.06)
    bright = (height < end - 0.05) & (height > 0.3)
    assert dark.sum() > 3 and bright.sum() > 20
    assert share[dark].max() < 0.6, share[dark]
    assert share[bright].min() > 0.97
    above = height > FOOT + BAND + 0.1
    assert share[above].min() > 0.97  # the sun does not shine from below
