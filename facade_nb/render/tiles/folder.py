"""Tiles from a folder of the user's own images."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...design.characters import letters_in
from ...design.errors import DesignError, Fault, quoted
from ...design.names import nfc

if TYPE_CHECKING:
    from PIL import Image

    from .canvas import Floats

__all__ = ["MAX_PIXELS", "SUFFIXES", "Folder", "TileError", "read_folder"]

SUFFIXES = (".png", ".jpg", ".jpeg", ".webp", ".bmp", ".tif", ".tiff", ".tga", ".gif")
"""Files that are looked at; all others in the folder are passed over."""

MAX_PIXELS = 1 << 26
"""The largest image that is decoded, in pixels."""

_SIZES = (32, 1024)
_STRIP = 1 << 20


class TileError(DesignError):
    """Tiles that cannot be used: all faults found, each with its file."""


@dataclass(frozen=True)
class Folder(Mapping[str, "Floats"]):
    """The images of a folder by name. Each is decoded when it is asked for, every time: none is kept.

    Names are in alphabetical order; a picture is (size, size, 4), sRGB as stored, 0 to 1, row 0 at the top.

    Attributes
    ----------
    files
        The file of each tile.
    size
        Pixels of every tile, across and up.
    unusable
        For names that files have and that stand for no tile, why.
    faults
        Every file that is no tile.
    """

    files: Mapping[str, Path]
    size: int
    unusable: Mapping[str, str] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()

    def __getitem__(self, name: str) -> Floats:
        file = self.files[name]
        try:
            return _fitted(file, self.size)
        except Exception as error:  # whatever a broken file makes Pillow raise: many kinds
            raise TileError(Fault(str(file), f"cannot read this image: {_reason(error)}")) from None

    def __contains__(self, name: object) -> bool:
        return name in self.files

    def __iter__(self) -> Iterator[str]:
        return iter(self.files)

    def __len__(self) -> int:
        return len(self.files)

    def of(self, size: int) -> Folder:
        """The same images in another size."""
        return Folder(self.files, size, self.unusable, self.faults)


def read_folder(path: str | Path, size: int | None = None) -> Folder:
    """Look at every image of a folder: a tile is named like its file, without the suffix.

    No more than the head of a file is read. What is wrong with a file, or with its name, keeps no other out.

    Parameters
    ----------
    path
        The folder. Folders in it are not looked into.
    size
        Pixels of every tile, across and up, a power of two; None: the power of two next above the largest image's
        smaller side, from 32 to 1024. Images are resampled to it, whatever their shape.

    Raises
    ------
    TileError
        For a missing folder; for one without images; and where no file of it can be used, with all faults.
    """
    files = _images(Path(path), path)
    faults: list[Fault] = []
    unusable: dict[str, str] = {}
    named: dict[str, list[Path]] = {}
    for file in files:
        named.setdefault(nfc(file.stem), []).append(file)
    usable: dict[str, Path] = {}
    largest = 1
    for name, same in sorted(named.items()):
        problem, side = _looked_at(name, same)
        if problem:
            unusable[name] = problem
            faults += [Fault(str(file), problem) for file in same[:1]]
        else:
            usable[name] = same[0]
            largest = max(largest, side)
    if not usable:
        raise TileError(faults)
    if size is None:
        size = min(max(1 << (largest - 1).bit_length(), _SIZES[0]), _SIZES[1])
    return Folder(usable, size, unusable, tuple(faults))


def _images(folder: Path, told: str | Path) -> list[Path]:
    """The files that may be images, by name."""
    try:
        if not folder.exists():
            raise TileError(Fault(str(told), "expected a folder of images; there is nothing of that name"))
        if not folder.is_dir():
            raise TileError(Fault(str(told), "expected a folder of images; this is a file"))
        files = [f for f in folder.iterdir() if f.suffix.lower() in SUFFIXES and f.is_file()]
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise TileError(Fault(str(told), f"cannot read this folder: {reason}")) from error
    files = sorted((f for f in files if not f.name.startswith(".")), key=lambda file: (file.stem, file.name))
    if not files:
        raise TileError(
            Fault(str(told), f"expected images ({', '.join(SUFFIXES)}) in this folder; found none")
        )
    return files


@lru_cache(maxsize=1)
def _spelled() -> re.Pattern[str]:
    return re.compile(letters_in(r"\w(?:[@.\-]*[@])?"))


def _looked_at(name: str, files: list[Path]) -> tuple[str, int]:
    """What is wrong with the files of a name, or an empty text; and the smaller side of the image, in pixels."""
    if not _spelled().fullmatch(name):
        return (
            "expected a name that a grammar can spell after Fit: or Rep:, of letters, digits, '_', '-' and '.', "
            f"ending in a letter or a digit; found {quoted(name)}"
        ), 0
    if len(files) > 1:
        told = " and ".join(repr(file.name) for file in files[:2])
        return f"expected one file for the tile {quoted(name)}; found {told}", 0
    try:
        with _opened(files[0]) as image:
            width, height = image.size
    except Exception as error:
        return f"cannot read this image: {_reason(error)}", 0
    return "", min(width, height)


def _reason(error: Exception) -> str:
    text = str(error) or type(error).__name__
    if "cannot identify image file" in text:
        return "it is not an image of a known kind"
    if "decompression bomb" in text:
        return f"expected at most {MAX_PIXELS} pixels"
    return getattr(error, "strerror", None) or text


def _opened(file: Path) -> Image.Image:
    """The image, of which no more than the head has been read. Raises ValueError for one that is too large."""
    from PIL import Image

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of large images, which are refused here, and of odd heads
        image = Image.open(file)
    width, height = image.size
    if width * height > MAX_PIXELS:
        image.close()
        raise ValueError(f"expected at most {MAX_PIXELS} pixels; found {width} × {height}")
    return image


def _fitted(file: Path, size: int) -> Floats:
    """The picture, upright, (size, size, 4). Large ones are made smaller as early as their kind allows."""
    from PIL import Image, ImageOps

    with warnings.catch_warnings(), _opened(file) as image:
        warnings.simplefilter("ignore")
        image.draft(None, (2 * size, 2 * size))  # JPEG alone
        depth = _depth(image)
        image.load()
        upright = _grey(image, depth) if image.mode.startswith("I") or image.mode == "F" else image
        ImageOps.exif_transpose(upright, in_place=True)
        if upright.mode not in ("L", "LA", "RGB", "RGBA") or "transparency" in upright.info:
            upright = upright.convert("RGBA")
        if upright.size != (size, size):  # Pillow weighs colours by their alpha here
            upright = upright.resize((size, size), Image.Resampling.LANCZOS, reducing_gap=3.0)
        return (np.asarray(upright.convert("RGBA"), np.float32) / np.float32(255)).astype(np.float32)


def _depth(image: Image.Image) -> float:
    """White of an image of grey values with more than 8 bits: what its kind holds, however dark it is; 0: unknown."""
    if image.mode == "F":
        return 0.0
    bits = getattr(image, "tag_v2", {}).get(258, (16,))[0]  # of a TIFF; PNG has 16
    return 65535.0 if image.mode != "I" or bits <= 16 else 0.0


def _grey(image: Image.Image, white: float) -> Image.Image:
    """Grey values of more than 8 bits, which Pillow would clip, as 8; what is no number is black."""
    from PIL import Image

    if not white:
        tops = (part.max(where=np.isfinite(part), initial=0.0) for _, part in _strips(image))
        top = float(max(tops))
        whites = (1.0, 255.0, 65535.0) if image.mode == "F" else (65535.0, 2.0**31 - 1)
        white = next((white for white in whites if top <= white), max(top, 1.0))
    grey = Image.new("L", image.size)
    for row, part in _strips(image):
        part = np.nan_to_num(part, nan=0.0, posinf=white, neginf=0.0)
        part = np.clip(part, 0, white) * np.float32(255 / white) + np.float32(0.5)
        grey.paste(Image.fromarray(part.astype(np.uint8)), (0, row))
    grey.info, exif = {}, image.getexif()
    if exif:
        grey.info["exif"] = exif.tobytes()
    return grey


def _strips(image: Image.Image) -> Iterator[tuple[int, Floats]]:
    """The rows of an image, some at a time: as numbers they take much more memory than it does."""
    width, height = image.size
    rows = max(1, _STRIP // width)
    for row in range(0, height, rows):
        part = image.crop((0, row, width, min(row + rows, height)))
        yield row, np.array(part, np.float32)
