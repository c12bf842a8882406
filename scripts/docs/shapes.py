"""The pictures of shapes in docs/rendering.md: ``python -m scripts.docs.shapes [FOLDER]``.

It writes ``shapes.svg`` (an elevation) and ``shapes.jpg`` (a picture) into the folder, by default ``docs/img``.
"""

from __future__ import annotations

import sys
from pathlib import Path

from PIL import Image

from facade_nb.design.files import write_atomically
from facade_nb.design.model import Canvas
from facade_nb.render import elevation_svg
from facade_nb.render.camera import Camera
from facade_nb.render.picture import picture
from facade_nb.solver.model.layout import Layout, PlacedShape

__all__ = ["main", "showpiece"]

Rect = tuple[float, float, float, float]

_PIECES: tuple[tuple[str, str, Rect], ...] = (
    ("quoin", "stone", (0.0, 0.0, 0.7, 7.0)),
    ("quoin", "stone", (21.3, 0.0, 22.0, 7.0)),
    ("arcade(bays=2)", "sandstone", (1.4, 0.0, 6.8, 3.6)),
    ("loggia", "plaster-white", (2.4, 4.1, 5.8, 6.6)),
    ("bay(storeys=2)", "plaster-white", (7.6, 0.7, 10.2, 6.7)),
    ("stair", "stone", (11.0, 0.0, 13.4, 0.9)),
    ("door", "oak", (11.4, 0.9, 13.0, 3.4)),
    ("pediment", "stone", (11.0, 3.4, 13.4, 4.3)),
    ("arched-window", "painted-wood", (11.6, 4.7, 12.8, 6.6)),
    ("statue", "stone", (14.0, 0.9, 15.0, 3.0)),
    ("arched-window(rise=0.25)", "painted-wood", (13.9, 4.5, 15.1, 6.6)),
    ("shop", "painted-green", (15.8, 0.3, 20.6, 3.0)),
    ("awning", "painted-green", (15.8, 2.5, 20.6, 3.5)),
    ("sign(text=BOOKS & TEA)", "painted-blue", (16.4, 3.7, 20.0, 4.3)),
    ("arched-window", "painted-wood", (16.4, 4.7, 17.6, 6.6)),
    ("arched-window", "painted-wood", (18.8, 4.7, 20.0, 6.6)),
    ("cornice", "stone", (0.0, 7.0, 22.0, 7.4)),
    ("mansard", "slate", (0.0, 7.4, 14.2, 10.4)),
    ("dormer", "painted-wood", (2.0, 7.7, 3.3, 9.6)),
    ("dormer(roof=arch)", "painted-wood", (6.2, 7.7, 7.5, 9.6)),
    ("dormer(roof=flat)", "painted-wood", (10.4, 7.7, 11.8, 9.4)),
    ("gable(form=curved)", "brick", (15.8, 7.4, 20.6, 11.4)),
    ("hipped", "tiles", (14.4, 7.4, 22.0, 9.6)),
)


def showpiece() -> Layout:
    """A house that has one of each, or more."""
    wall = PlacedShape(
        "wall", "A", "P", (0, 0, 22, 7), geometry="box", material="brick-yellow", thickness=0.35
    )
    pieces = [
        PlacedShape(
            f"{number:02d} {geometry.partition('(')[0]}", "B", "Q", rect, (rect[0] > 20, False),
            geometry=geometry, material=material, thickness=0.35, offset=0.02 if geometry.startswith("gable") else 0.0,
        )
        for number, (geometry, material, rect) in enumerate(sorted(_PIECES, key=lambda own: own[0] != "hipped"))
    ]  # fmt: skip
    return Layout("Shapes", Canvas(22, 11.4), shapes=(wall, *pieces))


def main(folder: Path) -> list[Path]:
    """Write the pictures into a folder, which is made if it is missing, and return their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    layout = showpiece()
    drawing, rendered = folder / "shapes.svg", folder / "shapes.jpg"
    write_atomically(drawing, elevation_svg(layout, width_px=1100, prefix="shapes", ids=False))
    pixels = picture(layout, (1400, 860), Camera(), rays=64)
    Image.fromarray(pixels).save(rendered, quality=86)
    return [drawing, rendered]


if __name__ == "__main__":
    for path in main(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/img")):
        print(path)
