"""Tiles by name: what a grammar's ``Fit:name`` and ``Rep:name`` are looked up in."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...design.errors import Fault, nearest, quoted
from ...design.names import nfc
from .canvas import Floats
from .catalogue import CATALOGUE, MAPS
from .drawing import draw, relief
from .drawn import Drawn, Levels
from .folder import Folder, TileError, read_folder
from .images import bled, mipmaps, rounded
from .relief import Relief

__all__ = ["DEFAULT_SIZE", "TileSet"]

DEFAULT_SIZE = 256
"""Pixels of a tile, across and up."""

PICTURE_DEPTH = 0.05
"""Metres from black to white of a picture of heights, ``NAME.height``."""

_MAX_SIZE = 2048
_KEPT = 1 << 27
"""Bytes of tiles that a set keeps at least for a while; beyond, those that were asked for first are made anew."""

_DRAWN = Drawn()


class TileSet:
    """Tiles of one size, each drawn or decoded when it is first asked for; the last ones asked for are kept.

    Colours are sRGB as stored, and composited as stored, without going through linear light: what the paper's 8-bit
    textures do. Values are multiples of 1/255, so a texture of 8 bits holds them exactly. A tile ``brick`` may have
    companions ``brick.normal`` (a unit normal n as (n + 1) / 2; x right, y up, z out of the wall) and
    ``brick.specular`` (strength of highlights). A tile whose name begins with ``mask`` is made to be
    a mask: its mipmaps keep its coverage.

    Parameters
    ----------
    pictures
        Tiles read from files, by name: (size, size, 4). A `Folder` reads each when it is asked for.
    size
        Pixels of a tile, across and up; a power of two.
    builtin
        Names of tiles that ship, in front of `pictures`.
    """

    def __init__(self, pictures: Mapping[str, Floats], size: int, builtin: Sequence[str] = ()) -> None:
        self._pictures = pictures
        self._names = (*(name for name in builtin if name not in self._pictures), *self._pictures)
        self._size = size
        self._ready: dict[str, Floats] = {}
        self._levels: dict[str, tuple[Floats, ...]] = {}

    @classmethod
    def builtin(cls, size: int = DEFAULT_SIZE) -> TileSet:
        """The tiles that ship (docs/tiles.md), at that many pixels.

        Raises
        ------
        TileError
            For a size that is no power of two, or beyond 16 to 2048.
        """
        return _builtin(_checked(size))

    @classmethod
    def from_folder(cls, path: str | Path, *, size: int | None = None, builtin: bool = True) -> TileSet:
        """Tiles from a folder of images, each named like its file without the suffix.

        Parameters
        ----------
        path
            The folder; folders in it are not looked into.
        size
            Pixels of every tile, a power of two; None: as the largest image needs, from 32 to 1024, and at least
            `DEFAULT_SIZE` where tiles that ship come along.
        builtin
            Whether the tiles that ship come along. An image of the same name takes the place of one, and of its
            companions: a new ``brick`` does not keep the old ``brick.normal``.

        Raises
        ------
        TileError
            For a missing folder, and for one of which no image can be used, with all faults. A file that cannot be
            read, a name that a grammar cannot spell, or two files of one name keep no other tile out: they are in
            `faults`.
        """
        if size is not None:
            _checked(size)
        pictures = read_folder(path, size)
        if size is None and builtin and pictures.size < DEFAULT_SIZE:
            pictures = pictures.of(DEFAULT_SIZE)
        if not builtin:
            return cls(pictures, pictures.size)
        replaced = {name for name in pictures if name in CATALOGUE}
        kept = tuple(
            name
            for name in _builtin_names()
            if name not in pictures
            and name not in pictures.unusable
            and name.partition(".")[0] not in replaced
        )
        return cls(pictures, pictures.size, kept)

    @property
    def names(self) -> tuple[str, ...]:
        """Every name. Its place here, counted from 1, is the tile's number in a grammar texture."""
        return self._names

    @property
    def faults(self) -> tuple[Fault, ...]:
        """The files of the folder that are no tile, each with what is wrong with it."""
        return self._pictures.faults if isinstance(self._pictures, Folder) else ()

    @property
    def unusable(self) -> Mapping[str, str]:
        """For names that files have and that stand for no tile, why."""
        found = self._pictures.unusable if isinstance(self._pictures, Folder) else {}
        return {name: why for name, why in found.items() if name not in self._names}

    @property
    def size(self) -> int:
        """Pixels of every tile, across and up."""
        return self._size

    def __len__(self) -> int:
        return len(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __repr__(self) -> str:
        return f"<TileSet of {len(self)} tiles, {self._size} × {self._size} pixels>"

    def _repr_png_(self) -> bytes:
        from .sheet import sheet

        return sheet(self)

    def number(self, name: str) -> int:
        """The tile's number in a grammar texture, from 1. Raises `TileError` for an unknown name, with the nearest."""
        return self._known(name) + 1

    def is_mask(self, name: str) -> bool:
        """Whether mipmaps of the tile keep its coverage instead of its mean."""
        return name.startswith("mask")

    def color(self, name: str) -> Floats:
        """The tile (size, size, 4): red, green, blue (sRGB) and alpha, 0 to 1, row 0 at the top. Not to be written to.

        Raises
        ------
        TileError
            For an unknown name, with the nearest valid one.
        """
        name = nfc(name)
        ready = self._ready.get(name)
        if ready is None:
            self._known(name)
            own = name in self._pictures
            ready = rounded(bled(self._pictures[name])) if own else _floats(self.stored(name)[0])
            ready.setflags(write=False)
            self._ready[name] = ready
            self._forget()
        return ready

    def mips(self, name: str) -> tuple[Floats, ...]:
        """The tile and its halvings, down to 1 × 1, each as `color` gives level 0.

        Colours weigh as much as they are opaque; normals stay of length 1; a mask keeps its coverage, that is, the
        share of it that is at least a half.
        """
        name = nfc(name)
        levels = self._levels.get(name)
        if levels is None:
            self._known(name)
            if name in self._pictures:
                levels = mipmaps(self.color(name), self._kind(name))
            else:
                levels = tuple(map(_floats, self.stored(name)))
            self._levels[name] = levels
            self._forget()
        return levels

    def stored(self, name: str) -> Levels:
        """What `mips` gives, in 8 bits: 0 to 255. A tile that ships is drawn once, and kept for the next process.

        Raises
        ------
        TileError
            For an unknown name, with the nearest valid one.
        """
        name = nfc(name)
        self._known(name)
        if name in self._pictures:
            return tuple(np.floor(level * 255 + 0.5).astype(np.uint8) for level in self.mips(name))
        return _DRAWN.levels(name, self._size, lambda: self._paint(name))

    def is_drawn(self, name: str) -> bool:
        """Whether a tile is at hand: to draw one that ships takes a while."""
        name = nfc(name)
        self._known(name)
        return name in self._pictures or _DRAWN.has(name, self._size)

    def of(self, size: int) -> TileSet:
        """The tiles that ship of these, in another size."""
        return TileSet({}, _checked(size), tuple(name for name in self._names if name not in self._pictures))

    def _paint(self, name: str) -> tuple[Floats, ...]:
        base, _, companion = name.partition(".")
        return mipmaps(rounded(bled(draw(base, self._size)[companion or "color"])), self._kind(name))

    def _kind(self, name: str) -> str:
        companion = name.rpartition(".")[2] if "." in name else ""
        return "mask" if self.is_mask(name) else "normal" if companion == MAPS[0] else "color"

    def relief(self, name: str) -> Relief | None:
        """The heights of a tile; None if it is flat. Its companions have those of the tile.

        Tiles that ship have those that they are drawn with; a picture has those of the picture ``NAME.height``:
        white is the plane of the wall, black lies `PICTURE_DEPTH` behind it.

        Raises
        ------
        TileError
            For an unknown name, with the nearest valid one.
        """
        name = nfc(name)
        self._known(name)
        base, _, companion = name.rpartition(".")
        base = base if companion in MAPS else name
        heights = f"{base}.height"
        if heights in self._pictures:
            grey = self._pictures[heights][..., :3].mean(axis=-1).astype(np.float32)
            stands = bool(self._pictures[base][..., 3].min() >= 1) if base in self._pictures else True
            return Relief(grey, PICTURE_DEPTH, 0.0, stands=stands) if float(np.ptp(grey)) > 0 else None
        if base not in self._names or base in self._pictures:
            return None
        return _DRAWN.relief(base, self._size, lambda: relief(base, self._size))

    def sample(self, name: str, u: Floats, v: Floats, *, clamp: bool = False) -> Floats:
        """Colours (n, 4) of a tile at `u`, `v` (n,); (0, 0) is its lower left corner, (1, 1) the upper right one.

        Bilinear between the centres of pixels, at level 0, as GL's ``GL_LINEAR`` does. With T[i, j] the pixel in column
        i from the left and row j from the *bottom*, N pixels across,

            x = u N − 1/2,  y = v N − 1/2,  i = ⌊x⌋,  j = ⌊y⌋,  a = x − i,  b = y − j,
            value = (1 − b) ((1 − a) T[i, j] + a T[i+1, j]) + b ((1 − a) T[i, j+1] + a T[i+1, j+1]).

        Columns and rows are taken modulo N (``GL_REPEAT``), or with `clamp` held within 0 to N − 1
        (``GL_CLAMP_TO_EDGE``), so that the head of a window does not show below its sill. All four channels are
        interpolated alike; colour is not weighted by alpha, and need not be, since transparent pixels have their
        neighbours' colour.
        """
        picture = self.color(name)
        count = picture.shape[0]
        x = np.asarray(u, np.float32) * np.float32(count) - np.float32(0.5)
        y = np.asarray(v, np.float32) * np.float32(count) - np.float32(0.5)
        column, row = np.floor(x), np.floor(y)
        a, b = (x - column)[..., None], (y - row)[..., None]
        i, j = column.astype(np.int64), row.astype(np.int64)
        if clamp:
            i0, i1 = np.clip(i, 0, count - 1), np.clip(i + 1, 0, count - 1)
            j0, j1 = np.clip(j, 0, count - 1), np.clip(j + 1, 0, count - 1)
        else:
            i0, i1, j0, j1 = i % count, (i + 1) % count, j % count, (j + 1) % count
        low, high = count - 1 - j0, count - 1 - j1
        below = picture[low, i0] * (1 - a) + picture[low, i1] * a
        above = picture[high, i0] * (1 - a) + picture[high, i1] * a
        return (below * (1 - b) + above * b).astype(np.float32)

    def array(self, levels: int | None = None, names: Sequence[str] | None = None) -> list[NDArray[np.uint8]]:
        """What a texture array is uploaded from: for each mip level, bytes (layers, h, w, 4), row 0 at the *bottom*.

        Parameters
        ----------
        levels
            How many; None: all, down to 1 × 1.
        names
            Which tiles, one a layer; None: all, so that tile number k is layer k − 1. Only these are drawn: a shader
            needs those that its grammar names.
        """
        chosen = self._names if names is None else tuple(names)
        most = self._size.bit_length()
        count = most if levels is None else max(1, min(levels, most))
        sources = [self.mips(name) if count > 1 else (self.color(name),) for name in chosen]
        return [
            np.stack([np.floor(source[level][::-1] * 255 + 0.5).astype(np.uint8) for source in sources])
            if sources
            else np.zeros((0, max(1, self._size >> level), max(1, self._size >> level), 4), np.uint8)
            for level in range(count)
        ]

    def _forget(self) -> None:
        """Let go of the tiles that were made first, where all take too much memory together."""
        most = max(2, _KEPT // (16 * self._size * self._size))
        for kept in (self._ready, self._levels):
            while len(kept) > most:
                del kept[next(iter(kept))]

    def _known(self, name: str) -> int:
        try:
            return self._names.index(nfc(name))
        except ValueError:
            if name in self.unusable:
                message = f"the tile {quoted(name)} cannot be used: {self.unusable[name]}"
            else:
                message = f"there is no tile {quoted(name)}{nearest(name, self._names)}"
            raise TileError(Fault("tiles", message)) from None


def _floats(image: NDArray[np.uint8]) -> Floats:
    """From 0 to 1, to the bit what was rounded to 8 bits."""
    return (image / np.float32(255)).astype(np.float32)


def _checked(size: int) -> int:
    if not isinstance(size, int) or not 16 <= size <= _MAX_SIZE or size & (size - 1):
        raise TileError(Fault("size", f"expected a power of two from 16 to {_MAX_SIZE}; found {size!r}"))
    return size


@lru_cache(maxsize=1)
def _builtin_names() -> tuple[str, ...]:
    return tuple(
        name
        for recipe in CATALOGUE.values()
        for name in (recipe.name, *(f"{recipe.name}.{kind}" for kind in recipe.maps))
    )


@lru_cache(maxsize=4)
def _builtin(size: int) -> TileSet:
    return TileSet({}, size, _builtin_names())
