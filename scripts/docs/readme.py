"""The pictures of the README and the documentation: ``python -m scripts.docs.readme [FOLDER]``.

It solves the residential house of the gallery and writes ``residential-house.png`` (the building in the morning) and
``residential-house.svg`` (its elevation) into the folder, by default ``docs/img``.
"""

from __future__ import annotations

import sys
from pathlib import Path

from facade_nb.design.files import write_atomically
from facade_nb.gallery import load
from facade_nb.render import elevation_svg, render_png
from facade_nb.solver import solve

__all__ = ["main"]


def main(folder: Path) -> list[Path]:
    """Write the pictures into a folder, which is made if it is missing, and return their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    layout = solve(load("residential-house"))
    picture, drawing = folder / "residential-house.png", folder / "residential-house.svg"
    render_png(layout, picture, size=(1600, 1000), rays=96)
    write_atomically(drawing, elevation_svg(layout, dimensions=True, prefix="house"))
    return [picture, drawing]


if __name__ == "__main__":
    for path in main(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/img")):
        print(path)
