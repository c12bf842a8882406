"""Photographs of façades: seen through a camera, lit by sun, sky and lamps, on the ground and under the sky.

They are pictures of the pipeline (docs/pipeline.md): the façades are its scene, with the ground that they stand on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...design.files import write_atomically
from ..camera import Camera
from ..pipeline.device import choose_device
from ..pipeline.frame import Looks
from ..pipeline.passes import THROUGH, seen_through
from ..pipeline.renderer import renderer_of
from ..pipeline.stills import still
from ..pipeline.street import street
from ..pipeline.viewpoint import Frustum
from .daytime import Daytime
from .facades import Facade
from .grammar import Grammar
from .picture import texture_pixels

__all__ = ["STANDPOINT", "Photo", "flat", "photograph", "photographs", "save_picture"]

_FAR = 4000.0
"""How far one sees, metres."""

_HAZE, _CLEAR = 700.0, 12.0
"""After so many metres, at least, and so many times the way to the subject, a third is left of what is seen."""

_SHARP = 6.0
"""Half the side of the fine map of shadows, metres, at least."""

STANDPOINT = Camera(azimuth=18.0, angle=40.0, fill=0.86)
"""A little to the right of the middle."""


@dataclass(frozen=True, slots=True)
class Photo:
    """How a photograph is taken.

    Attributes
    ----------
    pixels
        Width and height.
    hour
        Of the day, 0 to 24.
    camera
        Where to stand.
    frame
        Left, bottom, right, top on the first façade, metres, that the picture shows; None: all façades.
    samples
        Each pixel is the mean of `samples` × `samples` points.
    backend
        Who draws: ``osmesa`` or ``egl``; None: the best that works here.
    relief
        Whether tiles that have heights are seen with them (docs/texture.md, "Relief").
    """

    pixels: tuple[int, int] = (1024, 768)
    hour: float = 10.0
    camera: Camera = STANDPOINT
    frame: tuple[float, float, float, float] | None = None
    samples: int = 2
    backend: str | None = None
    relief: bool = False


def photograph(facades: Sequence[Facade], photo: Photo = Photo()) -> NDArray[np.uint8]:
    """Take a photograph: (h, w, 3) uint8.

    Raises
    ------
    ValueError
        For no façade, an hour beyond 0 to 24, a size without pixels, no sample, or an unknown backend.
    BackendError
        For a backend that does not work here; its text says what would help.
    """
    return photographs(facades, photo, (photo.hour,))[0]


def photographs(facades: Sequence[Facade], photo: Photo, hours: Sequence[float]) -> list[NDArray[np.uint8]]:
    """The same photograph at several hours.

    Raises as `photograph` does.
    """
    if not facades:
        raise ValueError("expected at least one façade")
    if min(photo.pixels) < 1 or photo.samples < 1:
        raise ValueError(f"expected at least one pixel and sample; found {photo.pixels}, {photo.samples}")
    daytimes = [Daytime.at(hour) for hour in hours]
    aimed = _aimed(facades, photo)
    view = photo.camera.look(aimed, photo.pixels)
    frustum = replace(Frustum.of(view), reach=(0.4 * view.reach[0], _FAR))
    apart = float(np.linalg.norm(aimed.mean(axis=0) - view.eye))
    looks = Looks(haze=max(_HAZE, _CLEAR * apart), relief=photo.relief, near=max(apart / 0.7, _SHARP))
    passes, buffers = seen_through(THROUGH)
    scene = street(facades)
    with renderer_of(scene, choose_device(photo.backend), passes=passes, buffers=buffers) as renderer:
        return [still(renderer, frustum, daytime, photo.pixels, looks, photo.samples) for daytime in daytimes]


def flat(
    grammar: Grammar,
    size: tuple[float, float],
    pixels: tuple[int, int],
    *,
    seed: tuple[float, float] = (0.0, 0.0),
    start: str | None = None,
    hour: float | None = None,
) -> NDArray[np.uint8]:
    """A façade seen straight on, filling the picture, on white: (h, w, 3) uint8; parameters as of `texture_pixels`."""
    image = texture_pixels(
        grammar, size=size, pixels=pixels, seed=seed, start=start, backend="cpu", hour=hour
    )
    alpha = image[..., 3:] / np.float32(255)
    return (image[..., :3] * alpha + np.float32(245) * (1 - alpha) + np.float32(0.5)).astype(np.uint8)


def save_picture(pixels: NDArray[np.uint8], path: str | Path, quality: int = 88) -> None:
    """Write pixels (h, w, 3) as a picture, atomically: JPEG where the name ends in ``.jpg``, else PNG.

    Parameters
    ----------
    quality
        Of a JPEG. A smooth sky has bands, as wide as JPEG's blocks, below 95.

    Raises
    ------
    DesignError
        For a file that cannot be written.
    """
    from PIL import Image

    stream = BytesIO()
    if str(path).lower().endswith((".jpg", ".jpeg")):
        Image.fromarray(pixels).save(stream, "JPEG", quality=quality, optimize=True, progressive=True)
    else:
        Image.fromarray(pixels).save(stream, "PNG")
    write_atomically(path, stream.getvalue())


def _aimed(facades: Sequence[Facade], photo: Photo) -> NDArray[np.float64]:
    """The points that the camera brings into the picture."""
    if photo.frame is not None:
        left, bottom, right, top = photo.frame
        return np.array([_world(facades[0], x, y) for x in (left, right) for y in (bottom, top)])
    return np.array([_world(f, x, y) for f in facades for x in (0, f.size[0]) for y in (0, f.size[1])])


def _world(facade: Facade, x: float, y: float) -> NDArray[np.float64]:
    return np.array(facade.origin) + x * np.array(facade.right) + y * np.array(facade.up)
