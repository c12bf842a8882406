"""Tiles that were drawn before: kept in memory, and on disk for the next process.

To draw a tile takes some 25 milliseconds, to read it 1. On disk each is a file of its own, in a folder that is named
after the sources of the painters: when one of them changes, all tiles are drawn anew. A folder that cannot be read or
written is no fault; tiles are then drawn.
"""

from __future__ import annotations

import hashlib
import shutil
import struct
import tempfile
import zlib
from collections.abc import Callable, Sequence
from functools import cache
from importlib.resources import files
from pathlib import Path

import numpy as np
import platformdirs
from numpy.typing import NDArray

from .relief import Relief

__all__ = ["Drawn", "Levels", "folder_of", "painters"]

Levels = tuple[NDArray[np.uint8], ...]
"""A tile and its halvings down to one pixel, each (h, w, 4), row 0 at the top."""

_KEPT = 1 << 26
"""Bytes in memory, about; beyond, those that were asked for longest ago are let go."""

_FOLDERS = 4
"""How many versions of the painters keep their tiles."""

_RELIEF = struct.Struct("<dd???")


@cache
def painters() -> str:
    """What tells one version of the painters from another."""
    digest = hashlib.sha256()
    for source in sorted(files(__package__).iterdir(), key=lambda own: own.name):
        if source.name.endswith(".py"):
            digest.update(source.name.encode() + b"\0" + source.read_bytes())
    return digest.hexdigest()[:16]


def folder_of() -> Path:
    """Where tiles of these painters are kept: in the user's folder for caches."""
    return platformdirs.user_cache_path("facade_nb") / "tiles" / painters()


class Drawn:
    """Tiles by name and size.

    Parameters
    ----------
    folder
        Where they are kept for the next process; None: as `folder_of` says.
    most
        Bytes that are kept in memory, about.
    """

    def __init__(self, folder: Path | None = None, most: int = _KEPT) -> None:
        self._folder = folder
        self._most = most
        self._levels: dict[tuple[str, int], Levels] = {}
        self._bytes = 0

    @property
    def folder(self) -> Path:
        """Where they are kept for the next process."""
        return self._folder if self._folder is not None else folder_of()

    def has(self, name: str, size: int) -> bool:
        """Whether a tile need not be drawn."""
        return (name, size) in self._levels or _path(self.folder, name, size).is_file()

    def levels(self, name: str, size: int, draw: Callable[[], Sequence[NDArray[np.floating]]]) -> Levels:
        """A tile; `draw` draws it, levels from 0 to 1, where it was not drawn before."""
        found = self._levels.pop((name, size), None)
        if found is None:
            path = _path(self.folder, name, size)
            found = _split(_read(path), size)
            if found is None:
                found = tuple(np.floor(level * 255 + 0.5).astype(np.uint8) for level in draw())
                _write(path, b"".join(level.tobytes() for level in found))
            for level in found:
                level.setflags(write=False)
            self._bytes += sum(level.nbytes for level in found)
        self._levels[name, size] = found  # at the end: the last one asked for
        while self._bytes > self._most and len(self._levels) > 1:
            gone = self._levels.pop(next(iter(self._levels)))
            self._bytes -= sum(level.nbytes for level in gone)
        return found

    def relief(self, name: str, size: int, draw: Callable[[], Relief | None]) -> Relief | None:
        """The heights of a tile, None if it is flat; `draw` finds them where they are not kept."""
        path = _path(self.folder, f"{name}.relief", size)
        content = _read(path)
        if content is not None and not content:
            return None
        if content is not None and len(content) == _RELIEF.size + 4 * size * size:
            depth, high, across, up, stands = _RELIEF.unpack_from(content)
            heights = np.frombuffer(content, np.float32, offset=_RELIEF.size).reshape(size, size)
            return Relief(heights, depth, high, (across, up), stands)
        found = draw()
        if found is None:
            _write(path, b"")
        elif found.heights.shape == (size, size):
            head = _RELIEF.pack(found.depth, found.high, *found.goes_on, found.stands)
            _write(path, head + np.asarray(found.heights, np.float32).tobytes())
        return found


def _path(folder: Path, name: str, size: int) -> Path:
    return folder / f"{name}.{size}.zz"


def _split(content: bytes | None, size: int) -> Levels | None:
    """The levels in the content of a file; None for what is none of ours."""
    sides = [size >> k for k in range(size.bit_length())]
    if content is None or len(content) != sum(4 * side * side for side in sides):
        return None
    levels, at = [], 0
    for side in sides:
        levels.append(np.frombuffer(content, np.uint8, 4 * side * side, at).reshape(side, side, 4))
        at += 4 * side * side
    return tuple(levels)


def _read(path: Path) -> bytes | None:
    try:
        return zlib.decompress(path.read_bytes())
    except (OSError, zlib.error):
        return None


def _write(path: Path, content: bytes) -> None:
    """Keep it if that can be done. Another process may do the same: each puts a whole file in place."""
    try:
        if not path.parent.is_dir():
            path.parent.mkdir(parents=True, exist_ok=True)
            _tidy(path.parent)
        with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as file:
            file.write(zlib.compress(content, 1))
        Path(file.name).replace(path)
    except OSError:
        pass  # it is drawn again next time


def _tidy(folder: Path) -> None:
    """Remove the tiles of painters that have long been changed."""
    every = sorted(
        (own for own in folder.parent.iterdir() if own.is_dir()), key=lambda own: own.stat().st_mtime
    )
    for old in every[:-_FOLDERS]:
        if old != folder:
            shutil.rmtree(old, ignore_errors=True)
