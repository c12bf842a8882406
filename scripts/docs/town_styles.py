"""``python -m scripts.docs.town_styles [FOLDER]``: a house of each style, by day and at dusk, for its page."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from facade_nb.render.camera import Camera
from facade_nb.render.texture.facades import Facade, box
from facade_nb.render.texture.grammar import Grammar
from facade_nb.render.texture.photograph import Photo, photographs, save_picture
from facade_nb.render.tiles import TileSet
from facade_nb.render.town.styles import STYLES, Style, town_text

HOUSES = (  # style, width, depth, storeys, seed
    ("detached", 11.0, 9.0, 2, (1.5, 5.0)),
    ("half-timbered", 11.0, 9.0, 3, (3.0, 5.0)),
    ("gruenderzeit", 16.0, 11.0, 4, (3.0, 5.0)),
    ("shop-street", 15.0, 11.0, 3, (3.0, 5.0)),
    ("bookshop-19.6", 19.6, 11.0, 6, (3.0, 5.0)),
    ("slab", 30.0, 11.0, 6, (1.5, 5.0)),
    ("brickworks", 26.0, 16.0, 2, (5.0, 5.0)),
)
_GAP = 3.0


def main(folder: Path, hours: tuple[float, ...] = (14.0, 20.3)) -> None:
    """Write ``town-styles.jpg``."""
    facades: list[Facade] = []
    x = 0.0
    styles = {style.name: style for style in STYLES}
    gables = "".join(
        f"\nCutGable{k} -> Layer({_gable(styles[name], seed)}, GableCut)"
        for k, (name, *_, seed) in enumerate(HOUSES)
    )
    text = f"{town_text()}{gables}\nGableCut -> SkipMask(Fit:mask-gable, 1, 0)\n"
    grammar = Grammar.parse(text, TileSet.builtin(512))
    for k, (name, width, depth, storeys, seed) in enumerate(HOUSES):
        facades += _house(grammar, styles[name], (width, depth), storeys, seed, x + width / 2, f"CutGable{k}")
        x += width + _GAP
    photo = Photo(
        (1600, 440),
        hours[0],
        Camera(azimuth=14, height=5.0, angle=46, fill=0.97),
        (0.0, 0.0, x - _GAP, 25.0),
        3,
    )
    path = folder / "img" / "town-styles.jpg"
    save_picture(np.concatenate(photographs(facades, photo, hours)), path)
    print(path)


def _house(
    grammar: Grammar, style: Style, size: tuple[float, float], storeys: int,
    seed: tuple[float, float], at: float, gable: str,
) -> list[Facade]:  # fmt: skip
    """Walls and roof of a house whose front stands on the street."""
    width, depth = size
    high = style.eaves(storeys)
    roof = 0.45 * depth if max(style.roofs, key=lambda kind: kind[1])[0] == "gable" else 0.0
    walls = box(
        grammar, width, high, depth, at=(at, 0.0), seed=seed, roof=roof, side=style.start("side", depth),
        gable=gable, cover=style.starts["roof"],
    )  # fmt: skip
    first = replace(walls[0], start=style.start("front", width))
    return [
        first,
        *(replace(w, start=style.start("court", width)) if w.start is None else w for w in walls[1:]),
    ]


def _gable(style: Style, seed: tuple[float, float]) -> str:
    """The rule that the gable's first choice goes on with, so that it may be cut to a triangle."""
    grammar = Grammar.parse(town_text(), TileSet.builtin(16))
    rule = grammar.rules[grammar.index(style.starts["gable"])]
    first = grammar.steps((0.1, 0.1), (9, 4), seed, style.starts["gable"])
    return grammar.rules[first[1].rule].name if rule.operator.name == "RandUni" else rule.name


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "docs"))
