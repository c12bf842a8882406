"""OSMesa and EGL in one process: each draws in its own context, whichever was made last and whichever drew before."""

from __future__ import annotations

import subprocess
import sys

import pytest

DRAW = """
import sys
import numpy as np
from facade_nb.render import Grammar
from facade_nb.render.pipeline.device import DEVICES
from facade_nb.render.pipeline.frame import Frame
from facade_nb.render.pipeline.renderer import Renderer
from facade_nb.render.pipeline.scene import Scene
from facade_nb.render.pipeline.viewpoint import Viewpoint
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.texture.facades import Facade
from facade_nb.render.texture.view import Sight

made = [DEVICES[name] for name in sys.argv[1:] if DEVICES[name].available]  # both are made before one draws
pixels, daytime = (48, 32), Daytime.at(11.0)
grammar = Grammar.parse("S -> RepeatX(1, Bay)\\nBay -> RandUni(0, Red, Blue)\\n"
                        "Red -> Mat(Color, 0, 1, 0, 0, 1)\\nBlue -> Mat(Color, 0, 0, 0, 1, 1)")
question, sight = grammar.question((12.0, 6.0)), Sight.flat((12.0, 6.0), pixels)
scene = Scene.of_facades([Facade(grammar, (12.0, 6.0))])
frame = Frame(scene, Viewpoint.towards((6.0, 2.0, 7.0), (6.0, 3.0, 0.0)).frustum(pixels), daytime, pixels)
wanted = pictures = None
renderers = {}
for turn in range(3):
    for device in made:
        if device.name not in renderers:
            renderers[device.name] = Renderer(scene, device)
        shot = device.paint(question, sight).surface.color
        drawn = renderers[device.name].draw(frame)["picture"].astype(int)
        with device.entered(), device.entered():
            assert device.renderer
        wanted, pictures = (shot, drawn) if wanted is None else (wanted, pictures)
        assert shot.std() > 0.1 and drawn.std() > 5
        assert np.abs(shot - wanted).max() < 1e-5, (device.name, turn)
        assert np.abs(drawn - pictures).max() <= 3, (device.name, turn)
"""


@pytest.mark.parametrize("names", [("osmesa", "egl"), ("egl", "osmesa")], ids="-".join)
def test_each_draws_in_its_own_context(names: tuple[str, ...]) -> None:
    subprocess.run([sys.executable, "-c", DRAW, *names], check=True)
