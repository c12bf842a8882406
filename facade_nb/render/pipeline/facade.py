"""A façade alone, straight on or through a camera, before nothing: one rectangle in the pipeline."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..texture.daytime import Daytime
from ..texture.facades import Facade
from ..texture.gl import GlPainter
from ..texture.grammar import Grammar
from ..texture.view import Sight
from .frame import Frame, Looks
from .passes import BARE, FACADE
from .renderer import renderer_of
from .scene import Scene
from .viewpoint import Frustum

__all__ = ["alone", "colours"]

_NOON = Daytime.at(12)


def alone(
    grammar: Grammar,
    size: tuple[float, float],
    seed: tuple[float, float] = (0.0, 0.0),
    start: str | None = None,
) -> Scene:
    """One façade. Its rectangle goes on beyond its ends: pixels whose middle is past them may show some of it, too."""
    scene = Scene.of_facades([Facade(grammar, size, seed=seed, start=start)])
    vertices = scene.vertices.copy()
    rim = max(size)
    vertices["place"] += np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], np.float32) * rim
    vertices["position"][:, :2] = vertices["place"]
    return replace(scene, vertices=vertices)


def colours(
    painter: GlPainter,
    scene: Scene,
    parts: Iterable[Sight],
    antialias: str = "adaptive",
    daytime: Daytime | None = None,
    relief: bool = False,
) -> Iterator[NDArray[np.float32]]:
    """Colours (h, w, 4), not multiplied by alpha, of views of a façade alone, each in turn.

    `daytime`: the hour in whose light it stands; None: colours as the grammar gives them.
    """
    looks = Looks(
        relief=relief,
        lit=daytime is not None,
        samples=antialias != "none",
        everywhere=antialias == "supersample",
        haze=0.0,
    )
    with renderer_of(scene, painter, passes=BARE if antialias == "none" else FACADE) as renderer:
        for sight in parts:
            frame = Frame(scene, Frustum.of_sight(sight), daytime or _NOON, sight.pixels, looks)
            drawn = renderer.draw(frame, ("color", "toned") if daytime else ("color",))
            color = drawn["color"].astype(np.float32)
            alpha = color[..., 3:].clip(0, 1)
            shown = drawn["toned"][..., :3] / np.float32(255) if daytime else color[..., :3]
            yield np.concatenate([shown if daytime else shown / alpha.clip(1e-6), alpha], axis=2)
