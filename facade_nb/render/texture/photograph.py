"""Photographs of façades: seen through a camera, lit by sun, sky and lamps, on the ground and under the sky.

This is the paper's pipeline in NumPy (texture paper, 4): first what the camera meets at each pixel, then the grammar
there, then light. All that the grammar is asked comes from the façade that was met: size, start rule, seed, axes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...design.files import write_atomically
from ..camera import Camera, View
from ..daylight import floats
from ..developing import binned, developed
from ..surfaces import linear
from .daytime import STREET_LAMP, Daytime, light
from .evaluating import OPAQUE
from .facades import Facade, Hits, meet, sees, stretches
from .grammar import Grammar
from .painters import choose_painter
from .picture import texture_pixels
from .shot import Painter
from .view import Looks

__all__ = ["STANDPOINT", "Photo", "flat", "photograph", "photographs", "save_picture"]

Floats = NDArray[np.float32]


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
        Who evaluates grammars: ``cpu``, ``osmesa`` or ``egl``, which is faster where there is a graphics card.
    relief
        Whether tiles that have heights are seen with them (docs/texture.md, "Relief").
    """

    pixels: tuple[int, int] = (1024, 768)
    hour: float = 10.0
    camera: Camera = STANDPOINT
    frame: tuple[float, float, float, float] | None = None
    samples: int = 2
    backend: str = "cpu"
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
    """The same photograph at several hours: what the camera meets, and the grammar there, is looked for once.

    Raises as `photograph` does.
    """
    if not facades:
        raise ValueError("expected at least one façade")
    if min(photo.pixels) < 1 or photo.samples < 1:
        raise ValueError(f"expected at least one pixel and sample; found {photo.pixels}, {photo.samples}")
    daytimes = [Daytime.at(hour) for hour in hours]
    large = (photo.pixels[0] * photo.samples, photo.pixels[1] * photo.samples)
    view = photo.camera.look(_aimed(facades, photo), large)
    order = _blocks(large)
    rays = view.rays(large).reshape(-1, 3)[order]
    painter = choose_painter(photo.backend)
    pictures = []
    found = _seen(facades, view, rays, daytimes, large, painter, photo.relief)
    for daytime, seen in zip(daytimes, found, strict=True):
        picture = np.empty_like(rays)
        picture[order] = developed(seen, daytime.exposure)
        small = binned(picture.reshape(large[1], large[0], 3), photo.samples)
        pictures.append((np.clip(small, 0, 1) * 255 + 0.5).astype(np.uint8))
    return pictures


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


def save_picture(pixels: NDArray[np.uint8], path: str | Path) -> None:
    """Write pixels (h, w, 3) as a picture, atomically: JPEG where the name ends in ``.jpg``, else PNG.

    Raises
    ------
    DesignError
        For a file that cannot be written.
    """
    from PIL import Image

    stream = BytesIO()
    if str(path).lower().endswith((".jpg", ".jpeg")):
        Image.fromarray(pixels).save(stream, "JPEG", quality=88, optimize=True, progressive=True)
    else:
        Image.fromarray(pixels).save(stream, "PNG")
    write_atomically(path, stream.getvalue())


def _blocks(pixels: tuple[int, int], side: int = 64) -> NDArray[np.intp]:
    """Pixels block by block, so that those that stand together are near each other in the picture."""
    width, height = pixels
    column, row = np.arange(width) // side, np.arange(height) // side
    block = (row[:, None] * (width // side + 1) + column).ravel().astype(np.int32)
    return np.argsort(block, kind="stable")


def _aimed(facades: Sequence[Facade], photo: Photo) -> NDArray[np.float64]:
    """The points that the camera brings into the picture."""
    if photo.frame is not None:
        left, bottom, right, top = photo.frame
        return np.array([_world(facades[0], x, y) for x in (left, right) for y in (bottom, top)])
    return np.array([_world(f, x, y) for f in facades for x in (0, f.size[0]) for y in (0, f.size[1])])


def _world(facade: Facade, x: float, y: float) -> NDArray[np.float64]:
    return np.array(facade.origin) + x * np.array(facade.right) + y * np.array(facade.up)


_FOOT = 9.0
"""Metres from a wall beyond which it no longer darkens the ground (by less than one of 255)."""

_PAVEMENT, _KERB = 3.2, 0.16
"""Width of the pavement and of its kerb, metres."""

_THROUGH = 4
"""How many façades, one behind the other, are looked through where they are transparent."""


def _seen(
    facades: Sequence[Facade],
    view: View,
    rays: Floats,
    daytimes: Sequence[Daytime],
    pixels: tuple[int, int],
    painter: Painter,
    relief: bool,
) -> list[Floats]:
    """Light (n, 3) that comes along rays, at each hour."""
    eye = view.eye.astype(np.float32)
    spread = float(view.window[2] - view.window[0]) / pixels[0]  # of a pixel, at unit distance
    seen = [np.zeros((len(rays), 3), np.float32) for _ in daytimes]
    clear = np.ones(len(rays), np.float32)  # how much of what lies further back is seen
    at = np.arange(len(rays))
    before: Floats | None = None
    for _ in range(_THROUGH):
        hits = meet(facades, eye, rays[at], before)
        behind = hits.facade < 0
        for daytime, light_ in zip(daytimes, seen, strict=True):
            back = _backdrop(facades, eye, rays[at[behind]], daytime)
            light_[at[behind]] += clear[at[behind], None] * back
        for index, facade in enumerate(facades):
            own = np.flatnonzero(hits.facade == index)
            if len(own):
                lights, alpha = _facade_light(
                    facades, index, facade, eye, rays[at[own]], hits, own, daytimes, spread, painter, relief
                )
                for light_, more_light in zip(seen, lights, strict=True):
                    light_[at[own]] += clear[at[own], None] * more_light
                clear[at[own]] *= 1 - alpha
        more = ~behind & (clear[at] > 1e-3)
        at, before = at[more], hits.distance[more] * np.float32(1 + 1e-5)
        if not len(at):
            break
    return seen


def _facade_light(
    facades: Sequence[Facade],
    index: int,
    facade: Facade,
    eye: Floats,
    rays: Floats,
    hits: Hits,
    own: NDArray[np.intp],
    daytimes: Sequence[Daytime],
    spread: float,
    painter: Painter,
    relief: bool,
) -> tuple[list[Floats], Floats]:
    """Light (n, 3), multiplied by alpha, at each hour, and alpha (n,) of what rays meet on one façade."""
    axes = facade.axes
    local = rays @ axes.T
    distance = hits.distance[own]
    question = facade.grammar.question(facade.size, facade.seed, facade.start, relief=relief)
    # A pixel covers this much across the ray; how much of a tile that is, seen slantwise, the evaluator finds.
    everywhere = np.ones(len(own), bool)
    looks = Looks(
        np.ascontiguousarray(hits.places[own]), local, distance * np.float32(spread), spread, everywhere
    )
    shot = painter.paint_at(question, looks, mips=True)
    surface = shot.surface
    points = eye + distance[:, None] * rays
    skip = np.full(len(own), index, np.int32)
    lit = []
    for daytime in daytimes:
        free = sees(facades, points, floats(daytime.towards), skip).astype(np.float32)
        if relief and any(daytime.sun):
            x, y, z = map(float, axes @ floats(daytime.towards))
            shaded = painter.paint_at(
                question._replace(sun=(x, y, z)), looks, mips=True, color_only=True
            ).shade
            free *= 1 if shaded is None else 1 - shaded
        lit.append(light(*surface[:3], local, daytime, free, points[:, 1], axes))
    alpha: Floats = np.where(surface.color[:, 3] > OPAQUE, 1, surface.color[:, 3])
    return lit, alpha


def _backdrop(facades: Sequence[Facade], eye: Floats, rays: Floats, daytime: Daytime) -> Floats:
    """Light (n, 3) of ground and sky."""
    seen = daytime.backdrop(rays)
    _add_ground(seen, facades, eye, rays, daytime)
    return seen


def _add_ground(seen: Floats, facades: Sequence[Facade], eye: Floats, rays: Floats, daytime: Daytime) -> None:
    """The ground, fading into the haze: slabs; before houses a pavement of them, a kerb, and asphalt beyond."""
    down = np.minimum(rays[:, 1], np.float32(-1e-6))
    distance = np.where(rays[:, 1] < 0, -eye[1] / down, np.inf).astype(np.float32)
    at = np.flatnonzero(distance < 4000)
    if not len(at):
        return
    points = eye + distance[at, None] * rays[at]
    free = sees(facades, points, floats(daytime.towards)).astype(np.float32)
    close, away = _close(facades, points)
    blur = distance[at] * 0.002
    if len(facades) == 1:
        away = np.zeros_like(away)  # a façade alone stands on a square
    paved = _step_down(away, _PAVEMENT, blur)[:, None]
    kerb = _step_down(away, _PAVEMENT + _KERB, blur)[:, None] - paved
    slabs = _slabs(points, blur)[:, None]
    albedo = slabs * paved * linear(floats([0.60, 0.585, 0.56])) + kerb * linear(floats([0.68, 0.67, 0.65]))
    albedo += (1 - paved - kerb) * linear(floats([0.44, 0.44, 0.45]))
    lamp = daytime.lamps * 0.10 * floats(STREET_LAMP)
    sun = (daytime.towards[1] * free)[:, None] * floats(daytime.sun)
    lit = albedo * (sun + close[:, None] * (0.9 * floats(daytime.sky) + lamp))
    haze = np.clip((distance[at] - 40) / 400, 0, 1)[:, None] ** 0.7
    seen[at] = lit + (floats(daytime.horizon) - lit) * haze


def _close(facades: Sequence[Facade], points: Floats) -> tuple[Floats, Floats]:
    """What walls do to ground points (n, 3): how much of the sky they leave, and how far the nearest one is, metres.

    The foot of a wall takes some sky from the ground before it. Walls beyond `_FOOT` are infinitely far.
    """
    close = np.ones(len(points), np.float32)
    nearest = np.full(len(points), np.inf, np.float32)
    walls = [one for one in facades if one.up[1] > 0.99 and one.origin[1] < 0.5]
    middles = np.array([_world(one, one.size[0] / 2, 0) for one in walls]).reshape(-1, 3)
    reach = np.array([one.size[0] / 2 for one in walls]) + _FOOT
    for part in stretches(len(points)):
        own = points[part]
        low, high = own.min(axis=0), own.max(axis=0)
        apart = np.maximum(np.maximum(low - middles, middles - high), 0)
        for k in np.flatnonzero(np.hypot(apart[:, 0], apart[:, 2]) < reach):
            local = (own - floats(walls[k].origin)) @ walls[k].axes.T
            aside = np.maximum(np.maximum(-local[:, 0], local[:, 0] - walls[k].size[0]), 0)
            away = np.hypot(aside, local[:, 2])
            nearest[part] = np.minimum(nearest[part], away)
            close[part] *= 1 - 0.42 * np.exp(-np.where(local[:, 2] > 0, away, 50) / 1.1)
    return close, nearest


def _step_down(values: Floats, at: float, blur: Floats) -> Floats:
    """1 below a value, 0 above it, with a slope as wide as a pixel: (n,)."""
    result: Floats = np.clip((at - values) / np.maximum(blur, np.float32(1e-3)) + np.float32(0.5), 0, 1)
    return result


def _slabs(points: Floats, blur: Floats) -> Floats:
    """Shade of paving stones: joints and a tint for each, fading where they are smaller than a pixel."""
    x, z = points[:, 0] / 0.9, points[:, 2] / 0.6
    row = np.floor(z)
    x = x + 0.5 * (row % 2)
    rim = np.minimum(np.abs(x - np.round(x)) * 0.9, np.abs(z - np.round(z)) * 0.6)
    joint = np.clip(1 - (rim - 0.004) / (0.004 + blur), 0, 1) * np.clip(0.02 / (0.01 + blur), 0, 1)
    tint = np.sin(12.9 * np.floor(x) + 78.2 * row) * 43.7
    fade = np.clip(0.06 / (0.01 + blur), 0, 1)
    return (1 - 0.22 * joint + 0.05 * fade * (tint - np.floor(tint) - 0.5)).astype(np.float32)
