"""A contact sheet of tiles."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from typing import TYPE_CHECKING

import numpy as np

from .catalogue import CATALOGUE

if TYPE_CHECKING:
    from .tileset import TileSet

__all__ = ["sheet"]

_PAPER, _INK = (248, 246, 241), (70, 66, 60)


def sheet(tiles: TileSet, names: Sequence[str] | None = None, *, cell: int = 128, columns: int = 10) -> bytes:
    """A PNG of tiles in rows, in the proportions of what they show; what is transparent is checked.

    Parameters
    ----------
    tiles
        The set.
    names
        Which; None: all but companions.
    cell
        Pixels of the larger side of each.
    columns
        How many in a row.
    """
    from PIL import Image, ImageDraw

    chosen = [name for name in tiles.names if "." not in name] if names is None else list(names)
    gap, label = 12, 14
    rows = -(-len(chosen) // columns)
    width, height = columns * (cell + gap) + gap, rows * (cell + gap + label) + gap
    page = Image.new("RGB", (width, height), _PAPER)
    pen = ImageDraw.Draw(page)
    yy, xx = np.mgrid[0 : tiles.size, 0 : tiles.size]
    square = max(1, tiles.size // 16)
    check = (0.80 + 0.07 * ((xx // square + yy // square) % 2))[..., None]
    for k, name in enumerate(chosen):
        picture = tiles.color(name)
        recipe = CATALOGUE.get(name.partition(".")[0])
        across, up = (recipe.width, recipe.height) if recipe else (1.0, 1.0)
        scale = cell / max(across, up)
        flat = picture[..., :3] * picture[..., 3:] + check * (1 - picture[..., 3:])
        image = Image.fromarray((flat * 255 + 0.5).astype(np.uint8))
        shown = image.resize(
            (max(1, round(across * scale)), max(1, round(up * scale))), Image.Resampling.LANCZOS
        )
        x = gap + (k % columns) * (cell + gap)
        y = gap + (k // columns) * (cell + gap + label)
        page.paste(shown, (x + (cell - shown.width) // 2, y + cell - shown.height))
        pen.text((x + cell / 2, y + cell + 3), name, fill=_INK, anchor="ma")
    file = BytesIO()
    page.save(file, "PNG", optimize=True)
    return file.getvalue()
