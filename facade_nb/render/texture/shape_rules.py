"""The rules that shapes of a layout become, by their geometry (`from_layout` puts them in their places).

A recipe gives the body of a rule. It may use the rules of building_parts.txt by name: those that are used come along.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import lru_cache
from importlib import resources
from typing import Protocol

import numpy as np

from ...solver.model.layout import PlacedShape
from ..materials import find_material, rgb
from ..tiles import CATALOGUE
from .projection_rules import PROJECTIONS

__all__ = ["LIBRARY", "RECIPES", "Recipe", "Walls", "colour", "needed", "parts", "repeats", "words"]

LIBRARY = "@"
"""Stands before a rule of the library until the text is whole, so that it is not taken for one of ours."""


class Walls(Protocol):
    """What writes the rules of surfaces."""

    def wall(self, material: str) -> str:
        """The name of a rule for a surface of a material."""
        ...

    def rule(self, name: str, body: str) -> str:
        """The name of a rule with that body; `name` is what it is called like."""
        ...


Recipe = Callable[[Walls, PlacedShape, str, float, float], str]
"""From the walls, a shape, its material, width and height (metres) to the body of its rule."""


def _fitted(tile: str, shape: PlacedShape) -> str:
    """Colour, relief and shine of a tile; mirrored as the shape is."""
    recipe = CATALOGUE[tile]
    maps = [f"Fit:{tile}.{kind}" for kind in recipe.maps]
    return f"Fit:{tile}, {', '.join(maps)}{', 1, 0' if shape.mirrored[0] else ''}"


def _layered(tile: str, shape: PlacedShape) -> str:
    left, right = (1, 0) if shape.mirrored[0] else (0, 1)
    maps = [f"FittedColor(Fit:{tile}, {left}, {right})", f"FittedRelief(Fit:{tile}.normal, {left}, {right})"]
    return f"Layer({', '.join([*maps, f'FittedShine(Fit:{tile}.specular, {left}, {right})'])})"


def _window(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    if material in ("metal", "iron", "bronze") or width > 1.25 * height:
        frame = "frame-modern"
    elif material in ("oak", "wood"):
        frame = "frame-brown"
    else:
        frame = "frame-casement" if height > 1.1 * width else "frame-sash"
    return f"Layer(Room, Curtain, Glass, Fitted({_fitted(frame, shape)}))"


def _french_window(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    return f"Layer(Window({_fitted('frame-balcony', shape)}), LowRailing)"


def _shop(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    return f"Layer(Room, Glass, Fitted({_fitted('frame-shop', shape)}))"


def _door(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    tile = {"painted-green": "door-green", "painted-blue": "door-blue"}.get(material, "door")
    return _layered("door-modern" if material in ("metal", "bronze", "iron") else tile, shape)


def _arch(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    return f"Layer(Room, {walls.wall(material)}, ArchHole, Fitted({_fitted('frame-arch', shape)}))"


def _upright(tile: str) -> Recipe:
    return lambda walls, shape, material, width, height: _layered(tile, shape)


def _running(tile: str) -> Recipe:
    def recipe(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
        pitch = CATALOGUE[tile].width * height / CATALOGUE[tile].height
        return f"RepeatX({min(max(pitch, 0.1), 60000.0):.4g}, Fitted({_fitted(tile, shape)}))"

    return recipe


def _railing(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    return (
        f"SplitY(Abs, {min(height, 1.0):.4g}, Rail, Rel, 1, Open)"
        if height > 1.0
        else "RepeatX(1, RailPiece)"
    )


def _balcony(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    slab = min(0.2, 0.25 * height)
    rail = min(1.0, height - slab)
    return f"SplitY(Abs, {slab:.4g}, {walls.wall(material)}, Abs, {rail:.4g}, Rail, Rel, 1, Open)"


def _gable(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    across, up = repeats(material)
    tall = min(0.16 * float(np.hypot(width / 2, height)) / (width / 2), 0.3 * height)
    return f"Layer(GableTiles(Rep:{_tile(material)}, {across}, {up}), GableBoards({tall:.4g}))"


def _hip(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    across, up = repeats(material)
    draw = min(height, 0.3 * width)
    sides = [f"HipSide(Rep:{_tile(material)}, {across}, {up}, {part})" for part in ("0, 0.5", "0.5, 1")]
    return f"SplitX(Abs, {draw:.4g}, {sides[0]}, Rel, 1, {walls.wall(material)}, Abs, {draw:.4g}, {sides[1]})"


RECIPES: Mapping[str, Recipe] = {
    "window": _window,
    "french-window": _french_window,
    "shop": _shop,
    "door": _door,
    "arch": _arch,
    "column": _upright("column"),
    "pilaster": _upright("pilaster"),
    "cornice": _running("cornice"),
    "ledge": _running("string-course"),
    "balcony": _balcony,
    "railing": _railing,
    "roof": _gable,
    "hip": _hip,
    **PROJECTIONS,
}
"""How geometries are drawn; a box, a panel, a sign and a pitched roof are walls of their material."""


def _tile(material: str) -> str:
    """The tile of a material, or that of roof tiles."""
    recipe = CATALOGUE.get(material)
    return material if recipe is not None and recipe.tiling == "xy" else "tiles"


def repeats(material: str) -> tuple[str, str]:
    """Repeats per metre, across and up, of a material's tile."""
    recipe = CATALOGUE[_tile(material)]
    return f"{1 / recipe.width:.4g}", f"{1 / recipe.height:.4g}"


def colour(material: str) -> tuple[str, str, str]:
    """Red, green and blue, 0 to 1, of a material in drawings."""
    red, green, blue = (f"{value / 255:.3g}" for value in rgb(find_material(material).fill))
    return red, green, blue


@lru_cache(maxsize=1)
def parts() -> Mapping[str, str]:
    """The rules of building_parts.txt by name."""
    text = resources.files(__package__).joinpath("building_parts.txt").read_text("utf-8")
    lines = [line for line in text.splitlines() if "->" in line]
    return {re.match(r"\w+", line)[0]: line for line in lines}  # type: ignore[index]


def words(text: str) -> set[str]:
    """Names in a rule, but for those of tiles and of the library."""
    return set(re.findall(r"(?<![:@\w.-])[^\W\d]\w*", text))


def needed(used: set[str]) -> set[str]:
    """Those of the parts that are used, and what they use."""
    known = parts()
    found: set[str] = set()
    waiting = [name for name in used if name in known]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += [word for word in words(known[name]) if word in known]
    return found
