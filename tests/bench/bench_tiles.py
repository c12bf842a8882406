"""Drawing the tiles that ship, against the obvious alternative: the same tiles stored as PNG files and decoded."""

from __future__ import annotations

import time
from io import BytesIO

import numpy as np
from PIL import Image

from facade_nb.render.tiles import TileSet

from .designs import line_of

__all__ = ["main"]


def main() -> None:
    """Print the table."""
    heads = (
        "pixels",
        "tiles",
        "draw all s",
        "a tile ms",
        "slowest ms",
        "PNG kB",
        "decode s",
        "ratio",
        "mipmaps s",
    )
    widths = (8, 7, 12, 11, 22, 9, 10, 8, 11)
    print(line_of(list(zip(heads, widths, strict=True))))
    for size in (128, 256, 512):
        tiles = TileSet({}, size, TileSet.builtin(size).names)  # nothing of it is drawn yet
        plain = [name for name in tiles.names if "." not in name]
        times = {}
        for name in plain:
            start = time.perf_counter()
            tiles.color(name)
            times[name] = time.perf_counter() - start
        drawn = sum(times.values())
        files = [_stored(tiles.color(name)) for name in plain]
        start = time.perf_counter()
        for file in files:
            np.asarray(Image.open(BytesIO(file)))
        decoded = time.perf_counter() - start
        start = time.perf_counter()
        for name in plain:
            tiles.mips(name)
        mips = time.perf_counter() - start
        slowest = max(times, key=lambda name: times[name])
        cells = (
            str(size), str(len(plain)), f"{drawn:.2f}", f"{1000 * drawn / len(plain):.1f}",
            f"{slowest} {1000 * times[slowest]:.0f}", f"{sum(map(len, files)) / 1000:.0f}", f"{decoded:.2f}",
            f"{drawn / decoded:.1f}", f"{mips:.2f}",
        )  # fmt: skip
        print(line_of(list(zip(cells, widths, strict=True))), flush=True)


def _stored(picture: np.ndarray) -> bytes:
    stream = BytesIO()
    Image.fromarray((picture * 255 + 0.5).astype(np.uint8)).save(stream, "PNG", optimize=True)
    return stream.getvalue()
