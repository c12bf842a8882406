"""What things are made of: how a material is drawn in the elevation and how it takes light in a picture."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType

from ..design.errors import DesignError, Fault, nearest

__all__ = ["DEFAULT_MATERIAL", "MATERIALS", "RULE", "Material", "find_material", "mix", "rgb"]

DEFAULT_MATERIAL = "card"
"""What a shape is made of where the design says nothing: the paper's plain boxes, with every cell to be seen."""


RULE = "rule:"
"""What a material begins with that is a rule of a texture grammar (`texture.from_layout`)."""


@dataclass(frozen=True, slots=True)
class Material:
    """One material.

    Attributes
    ----------
    name
        As designs write it; a colour such as ``#c8b9a0`` names itself.
    fill, line
        Colours of the elevation: the surface, and the joints and edges drawn on it (``#rrggbb``).
    pattern
        What is drawn on the surface: ``brick``, ``ashlar``, ``tiles``, ``slates``, ``boards``, ``seams``, ``speckle``,
        ``grain``, ``glass``, or empty for none.
    base
        Base colour of the physically based model, sRGB ``#rrggbb``.
    roughness, metallic
        The other two numbers of that model, 0 to 1.
    summary
        One line for the documentation and for menus.
    """

    name: str
    fill: str
    line: str
    pattern: str = ""
    base: str = "#cccccc"
    roughness: float = 0.9
    metallic: float = 0.0
    summary: str = ""


_TABLE = (
    Material("card", "#dcc9ab", "#9a7f57", "grain", "#d2b88f", 0.95, 0.0, "model board, each cell outlined"),
    Material("plaster", "#ece4d3", "#a89c85", "grain", "#e6dcc6", 0.95, 0.0, "lime render, warm white"),
    Material("plaster-white", "#f4f1e9", "#aaa598", "grain", "#eeeae0", 0.95, 0.0, "render, nearly white"),
    Material(
        "plaster-ochre", "#ead6a9", "#ab9058", "grain", "#d9c194", 0.95, 0.0, "render, Schönbrunn yellow"
    ),
    Material("plaster-rose", "#e3bfae", "#a1796a", "grain", "#d8a894", 0.95, 0.0, "render, old rose"),
    Material("plaster-sage", "#cdd3bd", "#868d73", "grain", "#b9c2a5", 0.95, 0.0, "render, sage green"),
    Material("plaster-blue", "#c6d0d8", "#78868f", "grain", "#afbfcb", 0.95, 0.0, "render, pale blue grey"),
    Material("plaster-grey", "#d3d1cc", "#8b8881", "grain", "#c4c1ba", 0.95, 0.0, "render, light grey"),
    Material("brick", "#c9977e", "#a8745d", "brick", "#9c6350", 0.9, 0.0, "red brick, stretcher bond"),
    Material(
        "brick-yellow", "#dcc391", "#b49a66", "brick", "#cdae72", 0.9, 0.0, "gault brick, stretcher bond"
    ),
    Material(
        "stone", "#d6d1c5", "#948d7e", "grain", "#c6bfaf", 0.8, 0.0, "dressed limestone, no joints drawn"
    ),
    Material("ashlar", "#d9d2c2", "#a39a86", "ashlar", "#cbc1ab", 0.8, 0.0, "limestone blocks in courses"),
    Material(
        "sandstone", "#dcc5a0", "#a58a5f", "ashlar", "#d0b184", 0.85, 0.0, "golden sandstone in courses"
    ),
    Material("granite", "#b9bab8", "#7f817f", "speckle", "#8f9190", 0.6, 0.0, "grey granite"),
    Material("concrete", "#cfcecb", "#97958f", "speckle", "#b4b2ac", 0.85, 0.0, "fair-faced concrete"),
    Material("wood", "#c4a177", "#8a6942", "boards", "#a08059", 0.7, 0.0, "larch boards"),
    Material("oak", "#8f6a45", "#5c4229", "boards", "#604530", 0.6, 0.0, "dark oak, for doors"),
    Material("painted-wood", "#f6f3ea", "#a19d92", "", "#f3f1ea", 0.5, 0.0, "white paint, for frames"),
    Material(
        "painted-green", "#6f8672", "#42564a", "", "#44594c", 0.5, 0.0, "green paint, for doors and shutters"
    ),
    Material(
        "painted-blue", "#6d859a", "#415466", "", "#38566f", 0.5, 0.0, "blue paint, for doors and shutters"
    ),
    Material("glass", "#9db4bf", "#566b76", "glass", "#36454d", 0.08, 0.0, "glazing, which mirrors the sky"),
    Material("metal", "#b4b9bd", "#72797f", "seams", "#9aa1a6", 0.4, 0.8, "zinc sheet with standing seams"),
    Material("iron", "#54585b", "#2e3032", "", "#3c3f42", 0.5, 0.6, "wrought iron, for railings"),
    Material("bronze", "#8d7654", "#57472f", "", "#7b5f3a", 0.4, 0.8, "bronze"),
    Material("copper", "#8fb3a1", "#5a7f6e", "seams", "#76a28f", 0.6, 0.2, "copper with its patina"),
    Material("slate", "#7e8790", "#565e67", "slates", "#565f68", 0.6, 0.0, "roof slates"),
    Material("tiles", "#bf8163", "#8f573e", "tiles", "#96573f", 0.8, 0.0, "clay roof tiles"),
    Material("shade", "#5a5f62", "#3a3e41", "", "#33373a", 1.0, 0.0, "dark interior behind an opening"),
)

MATERIALS: Mapping[str, Material] = MappingProxyType({material.name: material for material in _TABLE})
"""Every named material, in the order menus show them."""

_HEX = re.compile(r"#(?:[0-9a-fA-F]{3}|[0-9a-fA-F]{6})")


def find_material(name: str, place: str = "material") -> Material:
    """Return the material of that name; a colour ``#rgb`` or ``#rrggbb`` is plain paint, ``rule:Name`` neutral grey.

    Raises
    ------
    DesignError
        For an unknown name, with `place` as the fault's place and the nearest valid name.
    """
    found = MATERIALS.get(name)
    if found is not None:
        return found
    if _HEX.fullmatch(name):
        return _paint(name.lower())
    if name.startswith(RULE) and name != RULE:
        return _by_rule(name)
    known = ", ".join(MATERIALS)
    message = (
        f"expected one of {known}, or a colour such as #c8b9a0; found {name!r}{nearest(name, MATERIALS)}"
    )
    raise DesignError(Fault(place, message))


@lru_cache(maxsize=256)
def _by_rule(name: str) -> Material:
    """What only a texture grammar can draw is neutral grey everywhere else."""
    return Material(
        name, "#cbc7be", "#85817a", "", "#bdb9b0", 0.9, 0.0, "drawn by a rule of a texture grammar"
    )


@lru_cache(maxsize=256)
def _paint(code: str) -> Material:
    if len(code) == 4:
        code = "#" + "".join(2 * digit for digit in code[1:])
    return Material(code, code, mix(code, "#000000", 0.38), "", code, 0.85, 0.0, "plain paint")


def rgb(code: str) -> tuple[int, int, int]:
    """Red, green and blue, 0 to 255, of ``#rrggbb``."""
    return int(code[1:3], 16), int(code[3:5], 16), int(code[5:7], 16)


@lru_cache(maxsize=1024)
def mix(first: str, second: str, share: float) -> str:
    """The colour that lies `share` (0 to 1) of the way from `first` to `second`."""
    a, b = rgb(first), rgb(second)
    return "#" + "".join(f"{round(p + (q - p) * share):02x}" for p, q in zip(a, b, strict=True))
