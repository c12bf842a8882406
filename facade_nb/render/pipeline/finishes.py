"""Materials as rules of a grammar: what solids in a scene are made of, what is behind their panes, the ground.

A material has the tile of its name, where there is one, as façades by grammar have it (`texture.from_layout`); so both
look alike side by side. Others have the tile of another one with their pattern, under a coat of their own colour. What
has no pattern is plain paint with a little weather.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import asin, cos, pi, sin

import numpy as np

from ..bodies import SEGMENTS
from ..materials import RULE, Material, find_material, rgb
from ..ruled import is_rule, material_of, rule_fault
from ..texture.grammar import Grammar
from ..texture.shape_rules import needed, parts
from ..tiles import CATALOGUE
from .street import PAVING

__all__ = ["BOWED", "GROUND", "PANE", "Finishes", "finishes"]

PANE, GROUND = "Behind", "Ground"
"""The rules of panes, with the room behind them, and of the ground."""

_STRIPS = 8
"""A side of a round body is shaded in so many strips."""

_BENT = pi / SEGMENTS
"""By how much the surface of a round body turns from the middle of a side to its edges."""

BOWED, _ROWS = 0.75, 30
"""Sine of what it leans up and down at most from what a side does, where its profile is bowed; in so many strips."""

_STAINED = {
    "brick": "brick",
    "ashlar": "ashlar",
    "tiles": "tiles",
    "slates": "slate",
    "boards": "wood",
    "seams": "metal",
    "speckle": "granite",
    "grain": "plaster-white",
}
"""By pattern: a material without a tile of its name is that of another one under a coat of its own colour."""

_COAT = 0.72
"""How much that covers."""

_WEATHER = "Weather -> MatAlpha(Color, 0, 0.33, 0.31, 0.28, 0.1, Rep:clouds, 0.2, 0.4, 0.21, 0.23)"
_GROUND = (
    f"{GROUND} -> Layer(Flags, Light, Trodden)",
    "Light -> Mat(Color, 0, 0.76, 0.752, 0.738, 0.8)",
)
_PANES = (
    f"{PANE} -> Layer(Room, Curtain, Dim, Glass)",
    "Dim -> Mat(Color, 0, 0.07, 0.09, 0.10, 0.5)",  # what comes in is less than what falls on the wall
)


@dataclass(frozen=True, slots=True, eq=False)
class Finishes:
    """The grammar of some materials.

    Attributes
    ----------
    grammar
        Its first rules are those of the materials: a flat one and round ones for each.
    flat, round, bulging, hollow
        For each material, the place of its rule in the grammar's texture (m, 2). A bulging one leans from `BOWED` down
        at its foot to as much up at its head; a hollow one the other way.
    pane, ground
        Places of the rules of panes and of the ground.
    glass
        (m,) which materials are glass.
    period
        (m, 2) after how many metres along and up its pattern repeats.
    ruled
        (m,) which materials are rules that draw the whole of a shape.
    """

    grammar: Grammar
    flat: np.ndarray
    round: np.ndarray
    bulging: np.ndarray
    hollow: np.ndarray
    pane: tuple[int, int]
    ground: tuple[int, int]
    glass: np.ndarray
    period: np.ndarray
    ruled: np.ndarray


@lru_cache(maxsize=16)
def finishes(materials: tuple[str, ...], library: str = "") -> Finishes:
    """The rules of materials; rules are of `library`. Raises `DesignError` for an unknown one."""
    found = [material_of(library, name) for name in materials]
    ruled = [is_rule(name) and rule_fault(library, name, "") is None for name in materials]
    lines = [line for number, material in enumerate(found) for line in _rules(number, material)]
    shared = needed({"Room", "Curtain", "Glass"})
    lines += [
        _WEATHER,
        *_PANES,
        *_GROUND,
        *_bends(),
        *(line for name, line in parts().items() if name in shared),
    ]
    lines += [line.strip() for line in PAVING.splitlines() if line.strip()]
    text, space = "\n".join(lines), ""
    if any(ruled):
        space = _free_space(library)
        text = f"namespace {space} {{\n{text}\n}}\n{library}"
    grammar = Grammar.parse(text)
    places = dict(zip(grammar.encoding.names, grammar.encoding.positions, strict=True))
    prefix = f"{space}." if space else ""

    def each(kind: str) -> np.ndarray:
        names = [
            name.removeprefix(RULE) if own else f"{prefix}{kind}{number}"
            for number, (name, own) in enumerate(zip(materials, ruled, strict=True))
        ]
        return np.array([places[name] for name in names], np.float32).reshape(-1, 2)

    return Finishes(
        grammar,
        each("Flat"),
        each("Round"),
        each("Bulging"),
        each("Hollow"),
        places[prefix + PANE],
        places[prefix + GROUND],
        np.array([own.pattern == "glass" for own in found], bool),
        np.array([_period(own) for own in found]).reshape(-1, 2),
        np.array(ruled, bool),
    )


def _free_space(library: str) -> str:
    """A namespace that the library does not speak of."""
    return next(name for name in ("coats", *(f"coats{k}" for k in range(2, 99))) if name not in library)


def _tile(material: Material) -> str:
    """The tile of a material, or nothing."""
    own = CATALOGUE.get(material.name)
    return material.name if own is not None and own.tiling == "xy" else _STAINED.get(material.pattern, "")


def _coat(material: Material, tile: str) -> str:
    """The colour that, over the tile, makes about that of the material."""
    under, wanted = (np.array(rgb(own.base)) / 255 for own in (find_material(tile), material))
    return _numbers(np.clip((wanted - (1 - _COAT) * under) / _COAT, 0, 1))


def _numbers(values: np.ndarray) -> str:
    return ", ".join(f"{value:.3g}" for value in values)


def _repeats(tile: str) -> tuple[str, str]:
    recipe = CATALOGUE[tile]
    return f"{1 / recipe.width:.4g}", f"{1 / recipe.height:.4g}"


def _period(material: Material) -> tuple[float, float]:
    """As the grammar's texture has it, in 16 bits."""
    tile = _tile(material)
    across, up = _repeats(tile) if tile else ("1", "1")
    return 1 / float(np.float16(float(across))), 1 / float(np.float16(float(up)))


def _rules(number: int, material: Material) -> Iterator[str]:
    """A flat and a round rule, with what they are made of."""
    colour = _numbers(np.array(rgb(material.base)) / 255)
    tile = _tile(material)
    layers: list[str] = []
    shine = _shine(material)
    if tile:
        at = f"0, 0, {', '.join(_repeats(tile))}"
        yield f"Color{number} -> Mat(Color, Rep:{tile}, {at})"
        layers.append(f"Color{number}")
        if tile != material.name:
            yield f"Stain{number} -> Mat(Color, 0, {_coat(material, tile)}, {_COAT})"
            layers.append(f"Stain{number}")
        for usage, kind in (("Normal", "normal"), ("Specular", "specular")):
            if kind in CATALOGUE[tile].maps:
                yield f"{usage}{number} -> Mat({usage}, Rep:{tile}.{kind}, {at})"
                layers.append(f"{usage}{number}")
    yield f"Plain{number} -> Mat(Color, 0, {colour}, 1)"
    yield f"Shine{number} -> Mat(Specular, 0, {shine}, 1)"
    if not layers:
        layers = [f"Plain{number}", "Weather", f"Shine{number}"]
    yield f"Flat{number} -> Layer({', '.join(layers)})"
    for name, bent in (("Round", "Bent"), ("Bulging", "Bulge"), ("Hollow", "Scoop")):
        yield f"{name}{number} -> Layer(Plain{number}, {bent}, Shine{number})"


def _shine(material: Material) -> str:
    """How strong the sun's highlight is; that of metals has their colour."""
    strength = 0.6 * (1 - material.roughness) ** 2
    base = np.array(rgb(material.base)) / 255
    tint = 1 - material.metallic + material.metallic * base / base.max()
    return _numbers(strength * (1 + 2 * material.metallic) * tint)


def _bends() -> Iterator[str]:
    """Normals of a side of a round body, as if it were round: across it, and up it where its profile is bowed."""
    across = [_BENT * ((2 * k + 1) / _STRIPS - 1) for k in range(_STRIPS)]
    up = [asin(BOWED * ((2 * k + 1) / _ROWS - 1)) for k in range(_ROWS)]
    for k, a in enumerate(across):
        yield f"Bent{k} -> {_normal(a, 0.0)}"
        yield from (f"Bent{k}At{j} -> {_normal(a, b)}" for j, b in enumerate(up))
        rows = [f"Rel, 1, Bent{k}At{j}" for j in range(_ROWS)]
        yield f"Bulge{k} -> SplitY({', '.join(rows)})"
        yield f"Scoop{k} -> SplitY({', '.join(reversed(rows))})"
    for name in ("Bent", "Bulge", "Scoop"):
        yield f"{name} -> SplitX({', '.join(f'Rel, 1, {name}{k}' for k in range(_STRIPS))})"


def _normal(across: float, up: float) -> str:
    x, y, z = sin(across) * cos(up), sin(up), cos(across) * cos(up)
    return f"Mat(Normal, 0, {0.5 + 0.5 * x:.4g}, {0.5 + 0.5 * y:.4g}, {0.5 + 0.5 * z:.4g}, 1)"
