"""The texture grammars of the gallery as pictures: ``python -m scripts.docs.exhibits FOLDER [NAME …]``.

The name of a design of the gallery gives its layout drawn by a grammar, by day and by night.

Each exhibit is the counterpart of a figure of the texture paper: one or more views of a grammar, side by side.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from facade_nb.design.errors import DesignError, Fault, nearest
from facade_nb.gallery import grammar as grammar_text
from facade_nb.gallery import load, names
from facade_nb.render.camera import Camera
from facade_nb.render.texture.facades import Facade, box
from facade_nb.render.texture.from_layout import grammar_of
from facade_nb.render.texture.grammar import Grammar
from facade_nb.render.texture.photograph import STANDPOINT, Photo, flat, photographs, save_picture
from facade_nb.render.tiles import TileSet
from facade_nb.solver import solve

__all__ = ["EXHIBITS", "Exhibit", "View", "exhibit", "layout_exhibit", "street"]

_PAPER = np.array([248, 246, 241], np.uint8)
_GAP = 10
_TILE_SIZE = 512


@dataclass(frozen=True, slots=True)
class View:
    """One picture of an exhibit.

    Attributes
    ----------
    pixels
        Width and height.
    size
        Of the façade, metres.
    seed, start
        As of `Grammar.evaluate`.
    hour
        Of the day; None: colours as they are, seen straight on.
    camera, frame
        As of `Photo`.
    street
        Whether it shows a street of houses instead of one façade.
    """

    pixels: tuple[int, int]
    size: tuple[float, float] = (12.0, 9.0)
    seed: tuple[float, float] = (0.0, 0.0)
    start: str | None = None
    hour: float | None = 9.5
    camera: Camera = STANDPOINT
    frame: tuple[float, float, float, float] | None = None
    street: bool = False

    def take(self, grammar: Grammar, samples: int, hours: Sequence[float] = ()) -> list[NDArray[np.uint8]]:
        """The picture, (h, w, 3) uint8, at each of some hours; at none: straight on, colours as they are."""
        if not hours:
            return [flat(grammar, self.size, self.pixels, seed=self.seed, start=self.start)]
        facades = (
            street(grammar, self.seed)
            if self.street
            else [Facade(grammar, self.size, seed=self.seed, start=self.start)]
        )
        return photographs(facades, Photo(self.pixels, hours[0], self.camera, self.frame, samples), hours)


@dataclass(frozen=True, slots=True)
class Exhibit:
    """A grammar of the gallery with the views that show it.

    Attributes
    ----------
    grammar
        Its name.
    title
        What there is to see.
    rows
        The views, row by row; those of a row have one height.
    """

    grammar: str
    title: str
    rows: tuple[tuple[View, ...], ...] = field(repr=False)


def street(grammar: Grammar, seed: tuple[float, float] = (0.0, 0.0)) -> list[Facade]:
    """Houses on both sides of a street, from a grammar with the rules `Side` and `Roof`."""
    widths = (17.5, 13.0, 15.5, 18.5, 12.5, 16.0, 14.0)
    heights = (15.0, 18.3, 11.7, 15.0, 18.3, 11.7, 15.0)
    rows = (
        (widths, heights, 0.0, 0.0, (31.7, 5.3), 0.0),
        (widths[::-1], heights[::-1], 17.0, 180.0, (-23.1, 7.9), 40.0),
    )
    facades: list[Facade] = []
    for wide, high, z, turn, (seed_x, seed_y), more in rows:
        x = -62.0
        for k, (width, height) in enumerate(zip(wide, high, strict=True)):
            facades += box(
                grammar,
                width,
                height,
                11.0,
                at=(x + width / 2, z),
                turn=turn,
                seed=(seed[0] + seed_x * k, seed[1] + seed_y * k + more),
                roof=3.6,
                side="Side",
                gable="Gable",
                cover="Roof",
            )
            x += width
    return facades


def _sixth() -> tuple[tuple[View, ...], ...]:
    return (
        tuple(
            View((430, 400), (15, 14), (5.2, 3.84), start, None) for start in ("ByPart", "ByFloor", "Every")
        ),
    )


def _seventh() -> tuple[tuple[View, ...], ...]:
    street = Camera(azimuth=-24, height=1.7, angle=48, fill=1.0)
    near = Camera(azimuth=-18, height=5.0, angle=48, fill=1.0)
    return (
        tuple(
            View((330, 300), (13.0, 13.5), start=start, hour=None)
            for start in ("Wall", "Windows", "Ornament", "Awnings")
        ),
        (View((1350, 700), (26.0, 13.5), hour=10.2, camera=Camera(azimuth=-16, angle=34, fill=0.9)),),
        (
            View((670, 500), (26.0, 13.5), hour=10.2, camera=street, frame=(2, 0, 11, 6.5)),
            View((670, 500), (26.0, 13.5), hour=10.2, camera=near, frame=(7.5, 3.2, 11.5, 6.6)),
        ),
    )


def _eighth() -> tuple[tuple[View, ...], ...]:
    close = Camera(azimuth=12, height=1.6, angle=40, fill=0.98)
    return (
        tuple(
            View((300, 300), (4, 4), start=start, hour=10.5, camera=close)
            for start in ("WallOnly", "MaskOnly", "Masked", None)
        ),
        (
            View((605, 560), (4, 4), hour=10.5, camera=Camera(azimuth=-32, height=1.6, angle=46, fill=0.9)),
            View((605, 560), (4, 4), hour=21.0, camera=Camera(azimuth=-32, height=1.6, angle=46, fill=0.9)),
        ),
    )


def _ninth() -> tuple[tuple[View, ...], ...]:
    return (
        tuple(
            View(
                (420, 400),
                (6, 5),
                (1.7, 0.4),
                hour=10.5,
                camera=Camera(azimuth=azimuth, height=height, angle=46, fill=0.93),
            )
            for azimuth, height in ((-30, 1.2), (0, 2.5), (28, 3.6))
        ),
    )


def _tenth() -> tuple[tuple[View, ...], ...]:
    far = Camera(azimuth=-34, height=46, angle=32, fill=0.94)
    along = Camera(azimuth=-62, height=1.8, angle=62, fill=1.0)
    near = Camera(azimuth=-24, height=6.0, angle=44, fill=1.0)
    return (
        (View((1300, 620), seed=(10.6, 2.4), hour=9.0, camera=far, street=True),),
        (
            View((645, 520), seed=(10.6, 2.4), hour=11.0, camera=along, frame=(3, 0, 40, 12), street=True),
            View(
                (645, 520), seed=(10.6, 2.4), hour=9.5, camera=near, frame=(5.4, 4.4, 10.8, 8.4), street=True
            ),
        ),
        (
            View((645, 520), seed=(10.6, 2.4), hour=21.0, camera=along, frame=(3, 0, 40, 12), street=True),
            View(
                (645, 520), seed=(10.6, 2.4), hour=21.2, camera=near, frame=(5.4, 4.4, 10.8, 8.4), street=True
            ),
        ),
    )


def _first() -> tuple[tuple[View, ...], ...]:
    seed = (3.7, 1.3)
    size = (17.0, 17.5)
    near = Camera(azimuth=24, height=5.2, angle=46, fill=1.0)
    return (
        (
            View((650, 640), size, seed, hour=9.5, camera=Camera(azimuth=20, height=7, angle=40, fill=0.9)),
            View((650, 640), size, seed, hour=21.1, camera=Camera(azimuth=20, height=7, angle=40, fill=0.9)),
        ),
        (
            View((430, 400), size, seed, hour=9.5, camera=near, frame=(3.2, 4.4, 6.6, 7.4)),
            View(
                (430, 400),
                size,
                seed,
                hour=9.5,
                camera=Camera(azimuth=-26, height=1.7, angle=52, fill=1.0),
                frame=(0.6, 0.3, 5.2, 4.1),
            ),
            View((430, 400), size, seed, hour=20.7, camera=near, frame=(8.4, 4.4, 11.8, 7.4)),
        ),
    )


def _twelfth() -> tuple[tuple[View, ...], ...]:
    return (
        tuple(View((430, 330), (15, 11.5), seed, hour=None) for seed in ((5.2, 4.4), (0, 0), (0.7, 1.9))),
        tuple(
            View((430, 330), (15, 11.5), seed, hour=None) for seed in ((4.2, 2.4), (11.9, 5.3), (7.0, 1.0))
        ),
    )


def _thirteenth(chance: bool) -> tuple[tuple[View, ...], ...]:
    if not chance:
        camera = Camera(azimuth=17, angle=36, fill=0.9)
        return ((View((1300, 760), (21.8, 11.1), hour=9.8, camera=camera),),)
    seeds = ((1.2, 2.04), (2.1, 3.57), (4.8, 3.16), (8.4, 4.28), (6.6, 1.22), (15.6, 1.52))
    return tuple(
        tuple(
            View((430, 380), (13.1, 12.9), seed, hour=9.8, camera=Camera(azimuth=14, angle=36, fill=0.92))
            for seed in row
        )
        for row in (seeds[:3], seeds[3:])
    )


_TABLE: tuple[tuple[str, str, Callable[[], tuple[tuple[View, ...], ...]]], ...] = (
    ("figure-1", "a façade on one rectangle, by day and by night, from afar and close", _first),
    ("figure-6", "random groups: one colour for a part, for a floor, for each field", _sixth),
    ("figure-7", "layers one by one, and together, from afar and close", _seventh),
    ("figure-8", "a hole in the wall by a mask, the room behind it, a frame before it", _eighth),
    ("figure-9", "the five faces of an intrusion, from three sides", _ninth),
    ("figure-10", "a street with all operators: from afar, from the pavement, close", _tenth),
    ("figure-12", "the printed grammar with six seeds", _twelfth),
    ("figure-13a", "subdivisions alone", lambda: _thirteenth(False)),
    ("figure-13b", "subdivisions and chance, with six seeds", lambda: _thirteenth(True)),
)

EXHIBITS: Mapping[str, Exhibit] = MappingProxyType(
    {name: Exhibit(name, title, rows()) for name, title, rows in _TABLE}
)
"""The exhibits by the name of their grammar."""


def exhibit(name: str, *, samples: int = 3, scale: float = 1.0) -> NDArray[np.uint8]:
    """Render an exhibit: (h, w, 3) uint8.

    Parameters
    ----------
    name
        Of its grammar.
    samples
        Each pixel is the mean of `samples` × `samples` points.
    scale
        Of the picture's width and height.

    Raises
    ------
    DesignError
        For an unknown name, with the nearest valid one.
    """
    if name not in EXHIBITS:
        raise DesignError(
            Fault(
                "exhibit", f"expected one of {', '.join(EXHIBITS)}; found {name!r}{nearest(name, EXHIBITS)}"
            )
        )
    grammar = Grammar.parse(grammar_text(name), TileSet.builtin(_TILE_SIZE))
    return _page(EXHIBITS[name].rows, grammar, samples, scale)


def layout_exhibit(name: str, *, samples: int = 3, scale: float = 1.0) -> NDArray[np.uint8]:
    """Solve a design of the gallery and render its layout by the grammar it compiles to; parameters as of `exhibit`."""
    compiled = grammar_of(solve(load(name)))
    grammar = compiled.grammar(TileSet.builtin(_TILE_SIZE))
    camera = Camera(azimuth=-20, height=min(8.0, 0.5 * compiled.size[1]), angle=38, fill=0.92)
    views = [View((850, 930), compiled.size, (3.1, 2.2), hour=hour, camera=camera) for hour in (9.5, 21.1)]
    return _page([views], grammar, samples, scale)


def _page(rows: Sequence[Sequence[View]], grammar: Grammar, samples: int, scale: float) -> NDArray[np.uint8]:
    """The pictures of views, row by row. Views that differ in their hour alone are taken together."""
    views = list(dict.fromkeys(view for row in rows for view in row))
    taken: dict[View, NDArray[np.uint8]] = {}
    for view in views:
        if view not in taken:
            alike = [view]
            if view.hour is not None:
                alike = [
                    one for one in views if one.hour is not None and replace(one, hour=view.hour) == view
                ]
            hours = [one.hour for one in alike if one.hour is not None]
            pictures = _scaled(view, scale).take(grammar, samples, hours)
            taken.update(zip(alike, pictures, strict=True))
    return _below([_beside([taken[view] for view in row]) for row in rows])


def _scaled(view: View, scale: float) -> View:
    return replace(
        view, pixels=(max(16, round(view.pixels[0] * scale)), max(16, round(view.pixels[1] * scale)))
    )


def _beside(pictures: Sequence[NDArray[np.uint8]]) -> NDArray[np.uint8]:
    gap = np.broadcast_to(_PAPER, (pictures[0].shape[0], _GAP, 3))
    parts: list[NDArray[np.uint8]] = []
    for picture in pictures:
        parts += [picture, gap]
    return np.concatenate(parts[:-1], axis=1)


def _below(rows: Sequence[NDArray[np.uint8]]) -> NDArray[np.uint8]:
    """Rows under each other, in the middle of a page, with a margin around."""
    width = max(row.shape[1] for row in rows) + 2 * _GAP
    height = sum(row.shape[0] + _GAP for row in rows) + _GAP
    page = np.empty((height, width, 3), np.uint8)
    page[:] = _PAPER
    y = _GAP
    for row in rows:
        x = (width - row.shape[1]) // 2
        page[y : y + row.shape[0], x : x + row.shape[1]] = row
        y += row.shape[0] + _GAP
    return page


def main(arguments: Sequence[str]) -> None:
    """Write the exhibits of those names, or all, into a folder: PNG, or with ``--small`` JPEG as the docs have them."""
    small = "--small" in arguments
    words = [word for word in arguments if word != "--small"]
    folder = Path(words[0] if words else "gallery")
    folder.mkdir(parents=True, exist_ok=True)
    for name in words[1:] or EXHIBITS:
        own = name in EXHIBITS or name not in names()
        draw = exhibit if own else layout_exhibit
        path = folder / f"{name}{'' if own else '-grammar'}{'.jpg' if small else '.png'}"
        save_picture(draw(name, scale=0.75 if small else 1.0), path)
        print(path, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
