"""Relief mapping (the texture paper's section 6): where a viewing ray meets the surface of a tile that has heights.

The scope's plane is the highest of the tile's surface. The ray goes on behind it until it meets the surface: by steps,
then by halving the last one. What lies there is seen at the pixel. Beyond a scope a stretched tile is the same again
where it goes on, else as it is at its edge; past one that stands on a wall the layer below is seen, if there is one.
``glsl/texture/relief.glsl`` does the same for one pixel.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .atlas import GOES_ON, STANDS, Atlas
from .batch import Batch, Floats

__all__ = ["Struck", "strike"]

STEEPEST = np.float32(6)
"""Metres along the wall for one behind it, at most: seen along the wall, relief would be stretched without end."""

MOST_STEPS, MOST_SHADES = np.float32(32), np.float32(12)
AHEAD = np.float32(1.25)
"""Texels that one looks ahead at a steep side."""

NEAR_BY = np.float32(0.002)
"""As a share of the relief: half a step of 8 bits."""

_HALF, _TINY = np.float32(0.5), np.float32(1e-9)
Pair = tuple[Floats, Floats]


class Struck(NamedTuple):
    """What rays have met.

    Attributes
    ----------
    x, y
        (n,) the points that are seen, metres.
    beside
        (n,) bool: the ray has gone past it.
    shade
        (n,) how much of the sun the relief takes from there.
    near
        (n,) bool: other parts of the relief are near in the picture.
    """

    x: Floats
    y: Floats
    beside: NDArray[np.bool_]
    shade: Floats
    near: NDArray[np.bool_]


class _Field(NamedTuple):
    """The heights of a tile around n points: `at` is where they are on it, `scale` what a metre is there."""

    atlas: Atlas
    tile: int
    wrap: tuple[bool, bool]
    past: bool
    level: Any
    at: Pair
    scale: Pair
    size: Pair

    def deep(self, way: Pair, part: Any) -> Floats:
        """How far the surface lies behind its highest, 0 to 1, after that part of a way along the wall."""
        u, v = (a + part * w * s for a, w, s in zip(self.at, way, self.scale, strict=True))
        return 1 - self.atlas.height(self.tile, u, v, self.wrap, self.level)

    def texels(self, way: Pair) -> Floats:
        x, y = (w * s * count for w, s, count in zip(way, self.scale, self.size, strict=True))
        return np.sqrt(x * x + y * y)


def strike(
    atlas: Atlas,
    source: int,
    batch: Batch,
    start: Pair,
    scale: Pair,
    whole: tuple[bool, bool],
    below: bool,
    level: Any,
    sun: tuple[float, float, float],
) -> Struck | None:
    """What the rays of a batch meet of a tile; None if it is flat, or pixels are too large to show how deep it is.

    Parameters
    ----------
    source
        The tile: above 0 stretched over the scope, below 0 repeated.
    start, scale
        Where the points are on the tile, and what a metre is there, across and up.
    whole
        Whether all of the tile is shown, across and up.
    below
        Whether there is a layer below.
    level
        The size of the tile that fits a pixel.
    sun
        Towards the sun.
    """
    code, depth, _ = atlas.relief[abs(source) - 1]
    if not code:
        return None
    heights, marks = divmod(int(code), 8)
    fade = np.clip(2 - 2 * batch.footprint / depth, 0, 1).astype(np.float32)
    if not fade.any():
        return None
    table = atlas.table[heights - 1]
    goes_on = tuple(
        source < 0 or (bool(marks & bit) and all_) for bit, all_ in zip(GOES_ON, whole, strict=True)
    )
    past = source > 0 and below and bool(marks & STANDS)
    size = table[np.minimum(level, len(table) - 1)].T[2:].astype(np.float32)
    field = _Field(atlas, heights, (goes_on[0], goes_on[1]), past, level, start, scale, (size[0], size[1]))
    depth = depth * fade
    way = slope_of(batch.ray, depth)
    end = within_scope((batch.x, batch.y), batch, way, field.wrap) if past else np.float32(1)
    deep, further, met, apart = _march(field, way, np.broadcast_to(end, len(batch)), len(batch), depth)
    wide, tall = batch.right - batch.left, batch.top - batch.bottom
    long = np.sqrt(way[0] * way[0] + way[1] * way[1])
    alive = fade > 0
    x, y = (
        at + np.where(alive, (deep + further) * w, 0) for at, w in zip((batch.x, batch.y), way, strict=True)
    )
    shade = np.zeros(len(batch), np.float32)
    if sun[2] > 0 and not batch.faces:
        u, v = (a + deep * w * s for a, w, s in zip(start, way, scale, strict=True))
        shade = fade * _shade(
            field._replace(at=(u, v)),
            (batch.x + deep * way[0], batch.y + deep * way[1]),
            batch,
            deep,
            depth,
            sun,
        )
    if source > 0:  # in the scope beside it, where the same is seen
        x = x - np.floor((x - batch.left) / wide) * wide if goes_on[0] else x
        y = y - np.floor((y - batch.bottom) / tall) * tall if goes_on[1] else y
    return Struck(x, y, ~met & alive & past, shade, (apart * long > batch.footprint) & alive)


def slope_of(way: Sequence[Any], depth: Any) -> Pair:
    """Metres along the wall that a direction goes for so many behind it."""
    into = np.maximum(np.abs(way[2]), np.float32(1e-6))
    x, y = (np.asarray(way[k] / into, np.float32) for k in (0, 1))
    held = np.minimum(1, STEEPEST / np.maximum(np.sqrt(x * x + y * y), np.float32(1e-6)))
    return x * held * depth, y * held * depth


def within_scope(at: Pair, batch: Batch, way: Pair, wrap: tuple[bool, bool]) -> Floats:
    """How much of a way along the wall lies in the scope, but for the axes along which the tile goes on."""
    found: Floats = np.ones(1, np.float32)
    spans = ((batch.left, batch.right), (batch.bottom, batch.top))
    for a, w, (low, high), around in zip(at, way, spans, wrap, strict=True):
        if not around:
            space = np.where(w < 0, a - low, high - a)
            found = np.minimum(found, space / np.maximum(np.abs(w), _TINY))
    return np.maximum(found, np.float32(0))


def _march(
    field: _Field, way: Pair, end: Floats, count: int, depth: Floats
) -> tuple[Floats, Floats, NDArray[np.bool_], Floats]:
    """How far behind the highest rays meet the surface, 0 to 1, and how much further on one looks what is there.

    Then whether they meet it, and how much its depth differs before. A steep side is as its edge is, a texel further
    on: there nothing of what lies below it is mixed in.
    """
    texels = end * field.texels(way)
    deep = np.broadcast_to(field.deep(way, np.float32(0)), count).copy()
    straight = deep <= NEAR_BY
    met = straight | (texels < np.float32(0.05))
    deep[straight] = 0
    least, most = deep.copy(), deep.copy()
    steps = np.clip(np.ceil(np.float32(0.7) * texels), 1, MOST_STEPS)
    before = np.zeros(count, np.float32)
    marching, halved = ~met, np.zeros(count, bool)
    step = np.float32(1)
    while (marching := marching & (step <= steps)).any():
        place = end * step / steps
        surface = field.deep(way, place)
        least = np.where(marching, np.minimum(least, surface), least)
        most = np.where(marching, np.maximum(most, surface), most)
        deep = np.where(marching, place, deep)
        hit = marching & (surface - deep <= NEAR_BY)
        halved |= hit
        marching &= ~hit
        before = np.where(marching, deep, before)
        step += 1
    for _ in range(5 if halved.any() else 0):
        middle = _HALF * (before + deep)
        under = field.deep(way, middle) - middle <= NEAR_BY
        deep = np.where(halved & under, middle, deep)
        before = np.where(halved & ~under, middle, before)
    long = np.sqrt(way[0] * way[0] + way[1] * way[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        texel = np.where(halved, AHEAD / field.texels(way), np.float32(1)).astype(np.float32)
        rise = deep - field.deep(way, deep + texel)
        further = texel * np.clip(rise * depth / (texel * long) - 1, 0, 1)
    return deep, np.where(halved, further, np.float32(0)), met | halved, most - least


def _shade(
    field: _Field, at: Pair, batch: Batch, deep: Floats, depth: Floats, sun: tuple[float, float, float]
) -> Floats:
    """How much of the sun is hidden: the more the surface stands above the way there, and the nearer, the more."""
    way = slope_of([np.float32(value) for value in sun], deep * depth)
    end = within_scope(at, batch, way, field.wrap) if field.past else np.float32(1)
    count = np.clip(np.ceil(_HALF * end * field.texels(way)), 2, MOST_SHADES)
    far = np.sqrt(way[0] * way[0] + way[1] * way[1])
    shade = np.zeros(len(deep), np.float32)
    step = _HALF
    while (going := (step < count) & (deep > 0)).any():
        part = end * step / count
        above = (deep * (1 - part) - field.deep(way, part) - np.float32(0.01)) * depth
        hidden = above / (np.float32(0.002) + np.float32(0.05) * part * far)
        shade = np.where(going, np.maximum(shade, hidden), shade)
        step += 1
    return np.minimum(shade, 1)
