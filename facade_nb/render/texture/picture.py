"""Pictures of a grammar: pixels, PNG files, and which rule is seen where."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...design.files import write_atomically
from ..camera import Camera
from .antialias import check_kind, smoothed
from .atlas import Tiles
from .daytime import Daytime
from .gl import GlPainter
from .grammar import Grammar
from .lit import lit
from .painters import choose_painter
from .shot import Painter
from .view import Sight

__all__ = ["MAX_PIXELS", "MAX_SIDE", "png", "render_texture", "rules_seen", "texture_pixels"]

MAX_PIXELS = 1 << 26
"""The largest picture, in pixels."""

MAX_SIDE = 1 << 16
"""The largest width or height of a picture, in pixels: a longer one would be a thread of small parts."""

_PART_PIXELS, _PART_SIDE = 1 << 20, 8192


def render_texture(
    grammar: Grammar,
    path: str | Path | None = None,
    *,
    size: tuple[float, float],
    pixels: tuple[int, int] = (800, 600),
    seed: tuple[float, float] = (0.0, 0.0),
    start: str | None = None,
    camera: Camera | Sight | None = None,
    tiles: Tiles | None = None,
    backend: str | None = None,
    antialias: str = "adaptive",
    hour: float | None = None,
    relief: bool = False,
) -> bytes:
    """Render a façade by its grammar as a PNG picture.

    Parameters
    ----------
    grammar
        What to draw.
    path
        Where to write it, atomically; None: nowhere.
    size
        Width and height of the façade, metres.
    pixels
        Width and height of the picture.
    seed, start, tiles
        As for `Grammar.evaluate`.
    camera
        Where to stand; a `Camera` takes in the whole façade. None: straight on, with the façade filling the
        picture.
    backend
        ``osmesa``, ``egl`` or ``cpu``; None: the best that works here.
    antialias
        ``none``, ``adaptive`` or ``supersample`` (see `antialias`).
    hour
        Of the day, 0 to 24, in whose light the façade stands (see `daytime`); None: colours as the grammar gives them.
    relief
        Whether tiles that have heights are seen with them: cornices, reveals, ornaments (docs/texture.md, "Relief").

    Returns
    -------
    bytes
        The PNG file: red, green, blue and alpha, transparent where the grammar gives nothing.

    Raises
    ------
    DesignError
        As `Grammar.evaluate`, and for a file that cannot be written.
    BackendError
        If the backend asked for does not work here; its text says what would help.
    ValueError
        For a size or a number of pixels that is not positive, an unknown backend or kind of antialiasing,
        or an hour beyond 0 to 24.
    """
    data = png(
        texture_pixels(
            grammar,
            size=size,
            pixels=pixels,
            seed=seed,
            start=start,
            camera=camera,
            tiles=tiles,
            backend=backend,
            antialias=antialias,
            hour=hour,
            relief=relief,
        )
    )
    if path is not None:
        write_atomically(path, data)
    return data


def texture_pixels(
    grammar: Grammar,
    *,
    size: tuple[float, float],
    pixels: tuple[int, int] = (800, 600),
    seed: tuple[float, float] = (0.0, 0.0),
    start: str | None = None,
    camera: Camera | Sight | None = None,
    tiles: Tiles | None = None,
    backend: str | None = None,
    antialias: str = "adaptive",
    hour: float | None = None,
    relief: bool = False,
) -> NDArray[np.uint8]:
    """As `render_texture`, but the pixels: (h, w, 4) uint8, row 0 at the top, colour not multiplied by alpha."""
    from ..pipeline.facade import alone, colours

    sight = _sight(size, pixels, camera)
    question = grammar.question(size, seed, start, tiles, relief)
    painter: Painter = choose_painter(backend)
    daytime = None if hour is None else Daytime.at(hour)
    check_kind(antialias)
    image = np.empty((sight.pixels[1], sight.pixels[0], 4), np.uint8)
    parts = list(_parts(sight))
    if isinstance(painter, GlPainter):
        own = grammar if tiles is None else replace(grammar, tiles=tiles)
        scene = alone(own, question.size, seed, start)
        drawn = colours(painter, scene, (part for _, part in parts), antialias, daytime, relief)
        for (where, _), found in zip(parts, drawn, strict=True):
            image[where] = (np.clip(found, 0, 1) * 255 + np.float32(0.5)).astype(np.uint8)
        return image
    for where, part in parts:
        color = (
            smoothed(painter, question, part, antialias)
            if daytime is None
            else lit(painter, question, part, daytime, antialias)
        )
        image[where] = _bytes(color).reshape(*image[where].shape)
    return image


def rules_seen(
    grammar: Grammar,
    *,
    size: tuple[float, float],
    pixels: tuple[int, int] = (800, 600),
    seed: tuple[float, float] = (0.0, 0.0),
    start: str | None = None,
    camera: Camera | Sight | None = None,
    tiles: Tiles | None = None,
    backend: str | None = None,
) -> NDArray[np.int32]:
    """(h, w) int32, row 0 at the top: the topmost terminal rule that gave colour at each pixel's centre; -1: none."""
    sight = _sight(size, pixels, camera)
    question = grammar.question(size, seed, start, tiles)
    painter = choose_painter(backend)
    rules = np.empty((sight.pixels[1], sight.pixels[0]), np.int32)
    for where, part in _parts(sight):
        rules[where] = painter.paint(question, part, color_only=True).surface.rule.reshape(rules[where].shape)
    return rules


def png(image: NDArray[np.uint8]) -> bytes:
    """Pixels (h, w, 4) as a PNG file."""
    from PIL import Image

    stream = BytesIO()
    Image.fromarray(image).save(stream, "PNG")
    return stream.getvalue()


def _sight(size: tuple[float, float], pixels: tuple[int, int], camera: Camera | Sight | None) -> Sight:
    width, height = pixels
    if min(pixels) < 1 or max(pixels) > MAX_SIDE or width * height > MAX_PIXELS:
        raise ValueError(
            f"pixels: expected a width and a height, each at most {MAX_SIDE}, and at most {MAX_PIXELS} pixels; "
            f"found {pixels}"
        )
    if isinstance(camera, Sight):
        return camera
    return Sight.flat(size, pixels) if camera is None else Sight.through(camera, size, pixels)


def _parts(sight: Sight) -> Iterator[tuple[tuple[slice, slice], Sight]]:
    """A picture in parts that fit memory and what a graphics card draws at once, with their places in it."""
    width, height = sight.pixels
    across = min(width, _PART_SIDE)
    up = max(1, min(_PART_SIDE, _PART_PIXELS // across))
    for top in range(0, height, up):
        for left in range(0, width, across):
            wide, tall = min(across, width - left), min(up, height - top)
            part = sight if (wide, tall) == (width, height) else sight.crop(left, top, wide, tall)
            yield (slice(top, top + tall), slice(left, left + wide)), part


def _bytes(color: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Colours multiplied by alpha (n, 4) as bytes that are not."""
    alpha = color[:, 3:]
    straight = np.concatenate([color[:, :3] / np.maximum(alpha, np.float32(1e-6)), alpha], axis=1)
    return (np.clip(straight, 0, 1) * 255 + np.float32(0.5)).astype(np.uint8)
