"""The tiles that a grammar names, packed into one 8-bit image with their smaller versions: both evaluators read it.

Row 0 of the atlas is at the bottom, so that v goes up as it does on the façade. A tile's levels halve in size. Sampling
is bilinear between the four nearest texels of one level: the fourth of them lies in the tile itself, around the edge of
a repeated one and never beyond the edge of a stretched one, so neighbours in the atlas do not bleed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from math import sqrt
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ...design.errors import DesignError, Fault

__all__ = ["GOES_ON", "MAX_TEXELS", "STANDS", "Atlas", "Tiles", "pack"]

MAX_TEXELS = 1 << 26
"""The largest atlas: 256 MiB, and what a graphics card holds in one image."""

Floats = NDArray[np.float32]

GOES_ON, STANDS = (1, 2), 4
"""What a tile of heights is, beside its number: whether it goes on across, up; whether one sees past its edges."""


class Tiles(Protocol):
    """What is asked of a set of tiles: `facade_nb.render.tiles.TileSet`, or anything like it."""

    @property
    def names(self) -> Sequence[str]:
        """Names of the tiles."""
        ...

    def mips(self, name: str) -> Sequence[NDArray[Any]]:
        """The tile, and it in ever smaller sizes: (h, w, 4) from 0 to 1, row 0 at the top."""
        ...


class _Relief(Protocol):
    """What is asked of a tile's relief: `facade_nb.render.tiles.relief.Relief`, or anything like it."""

    @property
    def heights(self) -> NDArray[Any]:
        """(h, w) from 0 to 1, row 0 at the top."""
        ...

    @property
    def depth(self) -> float:
        """Metres from 0 to 1."""
        ...

    @property
    def high(self) -> float:
        """How far 1 stands out of the wall, metres."""
        ...

    @property
    def goes_on(self) -> tuple[bool, bool]:
        """Whether the tile goes on at its opposite edge, across and up."""
        ...

    @property
    def stands(self) -> bool:
        """Whether one sees past it at its edges."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Atlas:
    """Tiles in one image.

    Attributes
    ----------
    pixels
        (h, w, 4) uint8, row 0 at the bottom.
    table
        (tiles, levels, 4) int32: left, bottom, width, height of each level. A tile with fewer levels repeats its last.
    grey
        (tiles,) bool: the tile is opaque throughout; its mask is its brightness, not its alpha.
    relief
        (tiles, 3) float32: which tile, from 1, holds the heights of a tile, times 8, and what is so of it (`GOES_ON`,
        `STANDS`; 0: it is flat); from the deepest to the highest, metres; how far the highest stands out of the wall.
        Tiles of heights come after those that are named; a texel of them holds the heights at four corners: its own,
        right, above, right above.
    """

    pixels: NDArray[np.uint8]
    table: NDArray[np.int32]
    grey: NDArray[np.bool_]
    relief: NDArray[np.float32] = field(default_factory=lambda: np.zeros((1, 3), np.float32))

    def no_larger(self, side: int) -> Atlas:
        """The same tiles without the sizes that have a longer side; the smallest of each stays."""
        images = []
        for levels in self.table:
            own = [tuple(box) for box in dict.fromkeys(map(tuple, levels.tolist()))]
            kept = [box for box in own if max(box[2:]) <= side] or own[-1:]
            images.append([self.pixels[y : y + h, x : x + w] for x, y, w, h in kept])
        return _arranged(images, self.grey, self.relief)

    def within(self, limit: int, side: int = 1 << 16) -> Atlas:
        """The same tiles in at most `limit` bytes and `side` pixels a side: the largest sizes are left out.

        What is left out is seen as its next smaller size. Where even the smallest do not fit, all are given.
        """
        atlas = self
        while atlas.pixels.nbytes > limit or max(atlas.pixels.shape[:2]) > side:
            largest = int(atlas.table[..., 2:].max())
            if largest == 1:
                break
            smaller = atlas.no_larger(largest - 1)
            if smaller.pixels.nbytes >= atlas.pixels.nbytes:
                break
            atlas = smaller
        return atlas

    def sample(
        self, tile: int, u: Floats, v: Floats, wrap: bool, level: int | NDArray[np.int32] = 0
    ) -> Floats:
        """Values (n, 4) from 0 to 1 of tile number `tile`, from 1, at (u, v): its lower left corner is 0, 0.

        Parameters
        ----------
        wrap
            Whether the tile repeats; else its edge goes on.
        level
            Which of its sizes, 0 the largest: one, or one for each point.
        """
        levels = self.table[tile - 1]
        left, bottom, width, height = levels[np.minimum(level, len(levels) - 1)].T
        fx, x0, x1 = _neighbours(u, width, wrap)
        fy, y0, y1 = _neighbours(v, height, wrap)
        flat, wide = self.pixels.reshape(-1, 4), self.pixels.shape[1]
        low, high = (bottom + y0) * wide + left, (bottom + y1) * wide + left
        fx, fy = fx[:, None], fy[:, None]
        under = flat[low + x0] * (1 - fx) + flat[low + x1] * fx
        over = flat[high + x0] * (1 - fx) + flat[high + x1] * fx
        mixed: Floats = (under * (1 - fy) + over * fy) * np.float32(1 / 255)
        return mixed

    def height(
        self,
        tile: int,
        u: Floats,
        v: Floats,
        wrap: tuple[bool, bool],
        level: int | NDArray[np.int32] = 0,
    ) -> Floats:
        """Heights (n,) from 0 to 1 of the tile of heights number `tile`; parameters as of `sample`."""
        levels = self.table[tile - 1]
        left, bottom, width, height = levels[np.minimum(level, len(levels) - 1)].T
        fx, x = _corner(u, width, wrap[0])
        fy, y = _corner(v, height, wrap[1])
        four = self.pixels.reshape(-1, 4)[(bottom + y) * self.pixels.shape[1] + left + x]
        under = four[:, 0] * (1 - fx) + four[:, 1] * fx
        over = four[:, 2] * (1 - fx) + four[:, 3] * fx
        mixed: Floats = (under * (1 - fy) + over * fy) * np.float32(1 / 255)
        return mixed

    def mask(self, tile: int, values: Floats) -> Floats:
        """What a tile's values (n, 4) mean as a mask: brightness of an opaque tile, alpha of another one."""
        if self.grey[tile - 1]:
            return (values[:, 0] + values[:, 1] + values[:, 2]) * np.float32(1 / 3)
        return values[:, 3]


def _neighbours(
    u: Floats, size: NDArray[np.int32], wrap: bool
) -> tuple[Floats, NDArray[np.int32], NDArray[np.int32]]:
    """The two texels on either side of a place along one axis, and how far it is from the first to the second."""
    at = (u - np.floor(u) if wrap else np.clip(u, 0, 1)) * size.astype(np.float32) - np.float32(0.5)
    low = np.floor(at)
    first = low.astype(np.int32)
    second = first + 1
    if wrap:
        return at - low, np.where(first < 0, size - 1, first), np.where(second >= size, 0, second)
    return at - low, np.maximum(first, 0), np.minimum(second, size - 1)


def _corner(u: Floats, size: NDArray[np.int32], wrap: bool) -> tuple[Floats, NDArray[np.int32]]:
    """How far a place is from the texel before it along one axis, and that texel."""
    count, half = size.astype(np.float32), np.float32(0.5)
    at = (u - np.floor(u)) * count - half if wrap else np.clip(np.clip(u, 0, 1) * count - half, 0, count - 1)
    low = np.floor(at)
    first = low.astype(np.int32)
    return at - low, np.where(first < 0, size - 1, first)


def pack(tiles: Tiles | None, names: Sequence[str], relief: bool = False) -> Atlas:
    """Pack tiles with all their levels, the highest first, on shelves; with `relief` also their heights.

    Raises
    ------
    DesignError
        For more tiles than fit one image, and for one that cannot be read.
    """
    images: list[list[NDArray[np.uint8]]] = []
    texels = 0
    reliefs = _Reliefs(tiles, names if relief else ())
    for levels in (*(_read(tiles, name) for name in names), *reliefs.images()) if tiles is not None else ():
        images.append(levels)
        texels += 4 * images[-1][0].shape[0] * images[-1][0].shape[1] // 3
        if texels > MAX_TEXELS:
            message = (
                f"the {len(names)} tiles that are named take more than {MAX_TEXELS} pixels with their smaller "
                "versions: expected fewer, or smaller ones, such as those of TileSet.from_folder(…, size=256)"
            )
            raise DesignError(Fault("tiles", message))
    if not images:
        return Atlas(np.zeros((1, 1, 4), np.uint8), np.array([[[0, 0, 1, 1]]], np.int32), np.ones(1, bool))
    grey = np.array([bool((levels[0][..., 3] == 255).all()) for levels in images])
    return _arranged(images, grey, reliefs.table(len(images)))


def _arranged(images: list[list[NDArray[np.uint8]]], grey: NDArray[np.bool_], relief: Floats) -> Atlas:
    """The atlas of tiles, each with its sizes: they stand on shelves, the largest of all first."""
    every = [(k, level) for k, levels in enumerate(images) for level in range(len(levels))]
    every.sort(key=lambda own: (-images[own[0]][own[1]].shape[0], own))
    widest = max(image.shape[1] for levels in images for image in levels)
    area = sum(image.shape[0] * image.shape[1] for levels in images for image in levels)
    wide = widest * max(1, round(sqrt(area) / widest))
    count = max(len(levels) for levels in images)
    table = np.zeros((len(images), count, 4), np.int32)
    x = y = shelf = 0
    for k, level in every:
        height, width = images[k][level].shape[:2]
        if x + width > wide:
            x, y, shelf = 0, y + shelf, 0
        shelf = max(shelf, height)
        table[k, level:] = x, y, width, height  # a tile with fewer levels repeats its last
        x += width
    pixels = np.zeros((y + shelf, wide, 4), np.uint8)
    for k, level in every:
        left, bottom, width, height = table[k, level]
        pixels[bottom : bottom + height, left : left + width] = images[k][level]
    return Atlas(pixels, table, grey, relief)


def _read(tiles: Tiles, name: str) -> list[NDArray[np.uint8]]:
    ready: Callable[[str], Sequence[NDArray[Any]]] = getattr(tiles, "stored", tiles.mips)
    return [_stored(level) for level in ready(name)]


class _Reliefs:
    """The heights of tiles, those of companions once with their tile's."""

    def __init__(self, tiles: Tiles | None, names: Sequence[str]) -> None:
        self._of: list[_Relief | None] = []
        bases: dict[str, _Relief | None] = {}
        ask: Callable[[str], _Relief | None] = getattr(tiles, "relief", lambda _: None)
        for name in names:
            base = name.removesuffix(".normal").removesuffix(".specular")
            if base not in bases:
                bases[base] = ask(name)
            self._of.append(bases[base])
        self._own = [own for own in bases.values() if own is not None]

    def images(self) -> Iterator[list[NDArray[np.uint8]]]:
        """Of each, from the largest to one texel: heights at a texel and those right, above, and right above."""
        for own in self._own:
            level = np.asarray(own.heights, np.float32)
            levels = []
            while True:
                up = np.roll(level, 1, axis=0)
                four = np.stack([level, np.roll(level, -1, axis=1), up, np.roll(up, -1, axis=1)], axis=-1)
                levels.append(_stored(four))
                h, w = level.shape
                if max(h, w) == 1:
                    break
                h, w = max(h // 2, 1), max(w // 2, 1)
                tall, wide = level.shape[0] // h, level.shape[1] // w
                level = level[: h * tall, : w * wide].reshape(h, tall, w, wide).mean(axis=(1, 3))
            yield levels

    def table(self, tiles: int) -> NDArray[np.float32]:
        """`Atlas.relief` of so many tiles, those of heights among them."""
        table = np.zeros((tiles, 3), np.float32)
        first = tiles - len(self._own) + 1
        numbers = {id(own): first + k for k, own in enumerate(self._own)}
        for k, own in enumerate(self._of):
            if own is not None:
                marks = sum(
                    bit for bit, on in zip((*GOES_ON, STANDS), (*own.goes_on, own.stands), strict=True) if on
                )
                table[k] = 8 * numbers[id(own)] + marks, own.depth, own.high
        return table


def _stored(image: NDArray[Any]) -> NDArray[np.uint8]:
    """As 8 bits, row 0 at the bottom."""
    if image.dtype == np.uint8:
        return image[::-1]
    return (np.clip(image[::-1], 0, 1) * 255 + 0.5).astype(np.uint8)
