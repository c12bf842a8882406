"""What shaders are told of one picture, the same names here and in the browser."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..texture.daytime import Daytime
from .scene import Scene
from .sunlight import from_above, skylight, sunlight
from .viewpoint import Frustum

__all__ = ["Frame", "Looks", "in_view", "runs_of", "visible"]


@dataclass(frozen=True, slots=True)
class Looks:
    """What is drawn beside the façades.

    Attributes
    ----------
    shadow, occlusion, smooth
        Whether there are shadows of the sun, ambient occlusion, antialiasing of edges.
    haze
        Metres after which a third is left of what is seen; 0: none.
    reach
        How far occlusion looks, metres.
    relief
        Whether tiles that have heights are seen with them (docs/texture.md, "Relief").
    lit
        Whether the light of the hour falls on it; else colours are as the grammar gives them.
    samples
        Whether pixels near a split, or a façade's end, are the mean of 16 points.
    everywhere
        Whether those far from any are, too.
    near
        Half the side of the fine map of shadows, metres; 0: as the height of the camera asks for.
    rays
        From how many directions the light of the sky is gathered, by passes that do (`gathering`).
    """

    shadow: bool = True
    occlusion: bool = True
    smooth: bool = True
    haze: float = 2600.0
    reach: float = 2.2
    relief: bool = True
    lit: bool = True
    samples: bool = False
    everywhere: bool = False
    near: float = 0.0
    rays: int = 0

    @property
    def color_only(self) -> bool:
        """Whether normals and specular values are passed over."""
        return not self.lit


@dataclass(frozen=True, eq=False)
class Frame:
    """One picture: scene, camera, hour, size."""

    scene: Scene
    frustum: Frustum
    daytime: Daytime
    pixels: tuple[int, int]
    looks: Looks = field(default=Looks())

    def runs(self, when: str) -> bool:
        """Whether a pass that asks for this runs."""
        if when == "shadow":
            return self.looks.shadow and any(self.daytime.sun)
        if when == "lamps":
            return self.daytime.lamps > 0 and self.looks.lit and self.scene.has_lamps
        return bool(not when or getattr(self.looks, when))

    def uniforms(self) -> dict[str, Any]:
        """Values of all shaders; matrices (4, 4) among them, one for each way to look at the mesh."""
        frustum, looks = self.frustum, self.looks
        left, bottom, right, top = frustum.window
        scene = self.scene
        sun = sunlight(
            self.daytime.towards, frustum, scene.box if scene.sunny is None else scene.sunny, looks.near
        )
        gathered = skylight(self.daytime.towards, scene.solid_box, looks.rays) if looks.rays else {}
        shades = (float(self.runs("shadow")), float(self.runs("occlusion")))
        return {
            **self.daytime.uniforms(),
            **gathered,
            "camera": frustum.matrix,
            "sun_near": sun.near,
            "sun_far": sun.far,
            "sun_texel": sun.texels,
            "above": from_above(frustum),
            "eye": tuple(map(float, frustum.eye)),
            "across": tuple(map(float, frustum.right)),
            "upward": tuple(map(float, frustum.up)),
            "forward": tuple(map(float, frustum.ahead)),
            "window": (left, bottom, (right - left) / self.pixels[0], (top - bottom) / self.pixels[1]),
            "haze": looks.haze,
            "reach": looks.reach,
            "parallel": float(frustum.parallel),
            "shades": shades,
        }


def in_view(scene: Scene, through: NDArray[np.float64], turning: bool | None = None) -> NDArray[np.bool_]:
    """Which chunks, (c,), may be seen through a matrix to clip space.

    Parameters
    ----------
    turning
        Whether those that turn to whoever looks are meant, or the others; None: all.
    """
    chunks = scene.chunks
    if not len(chunks):
        return np.zeros(0, bool)
    low, high = (chunks[name].astype(np.float64) for name in ("low", "high"))
    planes = np.concatenate([through[3] + through[:3], through[3] - through[:3]])[[0, 1, 2, 3, 4]]
    normals, offsets = planes[:, :3], planes[:, 3]
    farthest = np.where(normals[:, None] > 0, high[None], low[None])
    inside = ((farthest * normals[:, None]).sum(axis=2) + offsets[:, None] >= 0).all(axis=0)
    if turning is not None:
        inside &= scene.turning == turning
    return np.asarray(inside)


def visible(scene: Scene, through: NDArray[np.float64], turning: bool | None = None) -> list[tuple[int, int]]:
    """Runs (first index, count) of these chunks."""
    return runs_of(scene.chunks[in_view(scene, through, turning)])


def runs_of(chunks: np.ndarray) -> list[tuple[int, int]]:
    """Runs (first index, count) of some chunks: those that lie side by side are one."""
    runs: list[tuple[int, int]] = []
    for first, count in zip(chunks["first"].tolist(), chunks["count"].tolist(), strict=True):
        if runs and runs[-1][0] + runs[-1][1] == first:
            runs[-1] = (runs[-1][0], runs[-1][1] + count)
        else:
            runs.append((first, count))
    return runs
