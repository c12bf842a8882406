"""Stills of any size: piece by piece where the card cannot draw them at once, each pixel the mean of several."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from math import ceil
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..texture.daytime import Daytime
from .frame import Frame, Looks
from .renderer import Renderer
from .viewpoint import Frustum

__all__ = ["LOOK_AT", "buffers_of", "pictured", "still"]

_LOOKS = Looks()

_PIECE = 2048
"""Pixels of each side of a piece, at most, its rim included."""

_LOOK, _RIM = 0.06, 12
"""How far occlusion looks at unit distance, and edges, pixels: so much is drawn around a piece and cut off."""


_EVEN = 8
"""Pieces begin at multiples of so many pixels: the pattern of occlusion's taps runs on."""


def still(
    renderer: Renderer,
    frustum: Frustum,
    daytime: Daytime,
    pixels: tuple[int, int],
    looks: Looks = _LOOKS,
    samples: int = 1,
    tell: Callable[[float], None] | None = None,
    of: str | None = None,
) -> NDArray[np.uint8]:
    """A picture (h, w, 3), row 0 at the top; with alpha (h, w, 4) where `of` is a buffer that is cut out.

    Parameters
    ----------
    samples
        Each pixel is the mean of `samples` × `samples` points.
    tell
        Told after each piece what part of the picture there is.
    of
        The buffer that is wanted in place of the picture. What is transparent in it counts for nothing in a mean.

    Raises
    ------
    ValueError
        For a size without pixels, or no sample.
    """
    if min(pixels) < 1 or samples < 1:
        raise ValueError(f"expected at least one pixel and sample; found {pixels}, {samples}")
    width, height = pixels
    found = np.empty((height, width, 4 if of else 3), np.uint8)
    name = of or shown(looks)
    look = _LOOK * height / (frustum.window[3] - frustum.window[1])
    pieces = list(_pieces(pixels, samples, _EVEN * ceil((look + _RIM) / _EVEN)))
    for number, (left, top, wide, tall, rim) in enumerate(pieces):
        box = (left - rim, top - rim, left + wide + rim, top + tall + rim)
        part = frustum.crop(box[0] / width, 1 - box[3] / height, box[2] / width, 1 - box[1] / height)
        size = ((wide + 2 * rim) * samples, (tall + 2 * rim) * samples)
        drawn = renderer.draw(Frame(renderer.scene, part, daytime, size, looks), (name,))[name]
        edge = rim * samples
        inner = drawn[edge : edge + tall * samples, edge : edge + wide * samples, : found.shape[2]]
        found[top : top + tall, left : left + wide] = _mean(inner, samples, (left, top))
        if tell is not None:
            tell((number + 1) / len(pieces))
    return found


def shown(looks: Looks) -> str:
    """The buffer that is the picture."""
    return "picture" if looks.smooth else "toned"


def _pieces(pixels: tuple[int, int], samples: int, rim: int) -> Iterator[tuple[int, int, int, int, int]]:
    """Left, top, width, height of pieces that make up the picture, and the width of the rim around each."""
    width, height = pixels
    if max(pixels) * samples <= _PIECE:
        yield 0, 0, width, height, 0
        return
    side = _EVEN * max((_PIECE // samples - 2 * rim) // _EVEN, 1)
    for top in range(0, height, side):
        for left in range(0, width, side):
            yield left, top, min(side, width - left), min(side, height - top), rim


def _mean(pixels: NDArray[np.uint8], samples: int, first: tuple[int, int]) -> NDArray[np.uint8]:
    """Means of `samples` × `samples` pixels; colours count as much as their alpha, where there is one.

    Without alpha, what is left of a mean is rounded by a grain, as in ``tone.frag``: else bands in a sky that its grain
    has dissolved would come back. `first`: column and row in the whole picture.
    """
    if samples == 1:
        return pixels
    height, width, channels = pixels.shape[0] // samples, pixels.shape[1] // samples, pixels.shape[2]

    def sums(values: NDArray[Any]) -> NDArray[np.uint32]:
        parts = values.reshape(height, samples, width, samples, -1)
        return np.asarray(parts.sum(axis=(1, 3), dtype=np.uint32))

    count = samples * samples
    if channels == 3:
        column, row = (
            np.arange(own, own + size, dtype=np.uint32)
            for own, size in zip(first, (width, height), strict=True)
        )
        grain = (column * np.uint32(3242174889) + (row * np.uint32(2447445414))[:, None]) >> np.uint32(24)
        return ((256 * sums(pixels) + count * grain[..., None]) // (256 * count)).astype(np.uint8)
    alpha = sums(pixels[..., 3:])
    colour = sums(pixels[..., :3].astype(np.uint32) * pixels[..., 3:])
    mean = (2 * colour + alpha) // np.maximum(2 * alpha, 1)
    return np.concatenate([mean, (2 * alpha + count) // (2 * count)], axis=2).astype(np.uint8)


def buffers_of(
    renderer: Renderer, frustum: Frustum, daytime: Daytime, pixels: tuple[int, int], looks: Looks = _LOOKS
) -> dict[str, NDArray[np.uint8]]:
    """Every buffer of a picture as one looks at it (h, w, 3), by name, in the order of the passes."""
    frame = Frame(renderer.scene, frustum, daytime, pixels, looks)
    drawn = renderer.draw(frame, tuple(renderer.buffers))
    return {name: pictured(name, values, frame) for name, values in drawn.items()}


def pictured(name: str, values: NDArray[Any], frame: Frame) -> NDArray[np.uint8]:
    """A buffer's values as colours that one can look at (h, w, 3)."""
    data = np.nan_to_num(
        values.astype(np.float32) / (255 if values.dtype == np.uint8 else 1), posinf=1, neginf=0
    )
    how = LOOK_AT.get(name, _plain)
    return (np.clip(how(data, frame), 0, 1) * 255 + 0.5).astype(np.uint8)


Values = NDArray[Any]


def _grey(values: Values) -> Values:
    return np.repeat(values[..., None], 3, axis=2)


def _plain(values: Values, frame: Frame) -> Values:
    return values[..., :3] if values.shape[2] >= 3 else _grey(values[..., 0])


def _near(depth: Values) -> Values:
    """Near is bright."""
    return _grey(np.where(depth > 0, 1 / (1 + depth / 25), 0))


def _place(values: Values, frame: Frame) -> Values:
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.nan_to_num(values[..., :2] / values[..., 2:], posinf=0)
    return np.concatenate([share, np.zeros_like(share[..., :1])], axis=2)


def _hashed(values: Values, frame: Frame) -> Values:
    """A colour of its own for every rule and seed."""
    mixed = np.abs(
        np.sin(values @ np.array([[12.99, 78.23, 37.7], [3.1, 9.7, 5.3], [1.3, 0.7, 2.1], [0.9, 1.7, 0.4]]))
    )
    return np.where((values != 0).any(axis=2, keepdims=True), 0.25 + 0.7 * mixed, 0).astype(np.float32)


def _signed(values: Values, frame: Frame) -> Values:
    return np.where((values[..., :3] != 0).any(axis=2, keepdims=True), 0.5 + 0.5 * values[..., :3], 0)


def _linear(values: Values, frame: Frame) -> Values:
    from ..developing import developed

    flat = np.maximum(values[..., :3].reshape(-1, 3), 0)
    return developed(flat, frame.daytime.exposure).reshape(*values.shape[:2], 3)


LOOK_AT: Mapping[str, Callable[[Values, Frame], Values]] = MappingProxyType(
    {
        "shadow_near": lambda values, _: _grey(values[..., 0]),
        "shadow_far": lambda values, _: _grey(values[..., 0]),
        "lamp_map": lambda values, _: _grey(1 - values[..., 0]),
        "depth": lambda values, _: _grey(np.clip((1 - values[..., 0]) * 40, 0, 1)),
        "place": _place,
        "rule": _hashed,
        "facing": _signed,
        "along": _signed,
        "normal": _signed,
        "light": _linear,
        "air": _linear,
    }
)
"""How buffers are looked at whose values are not colours."""
