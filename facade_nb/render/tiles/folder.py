"""Tiles from a folder of the user's own images."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...design.errors import DesignError, Fault

if TYPE_CHECKING:
    from PIL import Image

    from .canvas import Floats

__all__ = ["SUFFIXES", "TileError", "read_folder"]

SUFFIXES = (".png", ".jpg", ".jpeg", ".webp", ".bmp", ".tif", ".tiff", ".tga", ".gif")
"""Files that are looked at; all others in the folder are passed over."""

_NAME = re.compile(r"\w(?:[\w.\-]*\w)?")
_SIZES = (32, 1024)


class TileError(DesignError):
    """Tiles that cannot be used: all faults found, each with its file."""


def read_folder(path: str | Path, size: int | None = None) -> Mapping[str, Floats]:
    """Read every image of a folder as a tile named like its file, without the suffix.

    Parameters
    ----------
    path
        The folder. Folders in it are not looked into.
    size
        Pixels of every tile, across and up, a power of two; None: the power of two next above the largest image's
        smaller side, from 32 to 1024. Images are resampled to it, whatever their shape.

    Returns
    -------
    Mapping
        Names in alphabetical order; (size, size, 4), sRGB as stored, 0 to 1, row 0 at the top.

    Raises
    ------
    TileError
        With a fault for every file that is not an image, whose name a grammar cannot spell, or whose name another
        has too; for a missing folder; and for one without images.
    """
    folder = Path(path)
    if not folder.exists():
        raise TileError(Fault(str(path), "expected a folder of images; there is nothing of that name"))
    if not folder.is_dir():
        raise TileError(Fault(str(path), "expected a folder of images; this is a file"))
    try:
        files = sorted(
            file for file in folder.iterdir() if file.suffix.lower() in SUFFIXES and file.is_file()
        )
    except OSError as error:
        raise TileError(Fault(str(path), f"cannot read this folder: {error.strerror or error}")) from error
    files = sorted((f for f in files if not f.name.startswith(".")), key=lambda file: (file.stem, file.name))
    if not files:
        raise TileError(
            Fault(str(path), f"expected images ({', '.join(SUFFIXES)}) in this folder; found none")
        )
    faults: list[Fault] = []
    images: dict[str, Image.Image] = {}
    first: dict[str, str] = {}
    for file in files:
        name = file.stem
        if not _NAME.fullmatch(name):
            message = (
                "expected a name that a grammar can spell after Fit: or Rep:, of letters, digits, '_', '-' and '.', "
                f"ending in a letter or a digit; found {name!r}"
            )
            faults.append(Fault(str(file), message))
            continue
        if name in first:
            faults.append(
                Fault(
                    str(file), f"expected one file for the tile {name!r}; {first[name]!r} has the same name"
                )
            )
            continue
        first[name] = file.name
        try:
            images[name] = _opened(file)
        except Exception as error:  # whatever a broken file makes Pillow raise: many kinds
            faults.append(Fault(str(file), f"cannot read this image: {_reason(error)}"))
    if faults:
        raise TileError(faults)
    if size is None:
        largest = max(min(image.size) for image in images.values())
        size = min(max(1 << (largest - 1).bit_length(), _SIZES[0]), _SIZES[1])
    return {name: _fitted(image, size) for name, image in images.items()}


def _reason(error: Exception) -> str:
    text = str(error) or type(error).__name__
    if "cannot identify image file" in text:
        return "it is not an image of a known kind"
    return text


def _opened(file: Path) -> Image.Image:
    """The picture, upright, as RGBA."""
    from PIL import Image, ImageOps

    with Image.open(file) as image:
        image.load()
        upright = ImageOps.exif_transpose(image)
    if (
        upright.mode.startswith("I") or upright.mode == "F"
    ):  # grey values of more than 8 bits, which Pillow would clip
        values = np.asarray(upright, np.float64)
        top = 1.0 if upright.mode == "F" and values.max() <= 1 else 255.0 if values.max() <= 255 else 65535.0
        upright = Image.fromarray((np.clip(values / top, 0, 1) * 255 + 0.5).astype(np.uint8))
    return upright.convert("RGBA")


def _fitted(image: Image.Image, size: int) -> Floats:
    from PIL import Image

    if image.size != (size, size):
        image = image.resize(
            (size, size), Image.Resampling.LANCZOS
        )  # Pillow weighs colours by their alpha here
    return (np.asarray(image, np.float32) / np.float32(255)).astype(np.float32)
