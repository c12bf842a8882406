"""Materials that are rules of a design's texture grammar: ``rule:Name``, for drawings that know of no grammar.

A rule is drawn in the rectangle of its shape, by the evaluator in NumPy. Where there is no room for that (a drawing's
joinery, a 3D view of plain colours) its mean colour stands for it.
"""

from __future__ import annotations

from functools import lru_cache
from io import BytesIO
from typing import TYPE_CHECKING

from ..design.errors import DesignError, Fault, GrammarError, nearest
from ..solver.model.layout import Layout
from .materials import RULE, Material, find_material, mix

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .texture.grammar import Grammar

__all__ = [
    "grammar_faults",
    "is_rule",
    "library_of",
    "material_of",
    "rule_fault",
    "rule_names",
    "rule_pixels",
    "rule_png",
]

_MOST = 512
"""Pixels of a picture of a rule, along each side, at most."""

_SAMPLE = 2.0
"""Metres: of the square whose mean colour stands for a rule."""


def library_of(layout: Layout) -> str:
    """The texture grammar of a layout's design, or nothing."""
    return layout.design.grammar if layout.design is not None else ""


def is_rule(material: str) -> bool:
    """Whether a material is a rule of a grammar."""
    return material.startswith(RULE) and material != RULE


def rule_fault(library: str, material: str, place: str) -> Fault | None:
    """What is wrong with a material that is a rule; None if its grammar can draw it."""
    name = material.removeprefix(RULE)
    if not library.strip():
        return Fault(place, f"expected a rule of the design's grammar, which is empty; found {material!r}")
    try:
        names = _grammar(library).encoding.names
    except (GrammarError, DesignError) as error:
        told = str(error).splitlines()[0]
        return Fault(place, f"rule {name!r} cannot be drawn: the design's grammar has a fault: {told}")
    if name not in names:
        return Fault(
            place, f"expected a rule of the design's grammar; found {material!r}{nearest(name, names)}"
        )
    return None


def grammar_faults(library: str) -> tuple[Fault, ...]:
    """What is wrong with a design's grammar, each fault with its line; an empty one has none."""
    try:
        if library.strip():
            _grammar(library)
    except (GrammarError, DesignError) as error:
        return error.faults
    return ()


def rule_names(library: str) -> tuple[str, ...]:
    """The names of the rules that a material may be: those of a grammar without faults."""
    if not library.strip() or grammar_faults(library):
        return ()
    return tuple(_grammar(library).encoding.names)


def material_of(library: str, name: str) -> Material:
    """A material; a rule that the grammar can draw has its mean colour."""
    if not is_rule(name) or rule_fault(library, name, "material") is not None:
        return find_material(name)
    return _mean(library, name)


@lru_cache(maxsize=64)
def _grammar(library: str) -> Grammar:
    from .texture.grammar import Grammar

    return Grammar.parse(library)


@lru_cache(maxsize=256)
def _mean(library: str, name: str) -> Material:
    red, green, blue = rule_pixels(library, name, (_SAMPLE, _SAMPLE), 12.0).reshape(-1, 3).mean(axis=0)
    code = f"#{round(red):02x}{round(green):02x}{round(blue):02x}"
    return Material(
        name, code, mix(code, "#000000", 0.38), "", code, 0.9, 0.0, "a rule of the design's grammar"
    )


@lru_cache(maxsize=128)
def rule_pixels(library: str, name: str, size: tuple[float, float], scale: float) -> NDArray[np.uint8]:
    """A rule drawn in a rectangle `size` metres large, about `scale` pixels a metre: (h, w, 3) sRGB, row 0 at the top.

    What the rule leaves open is white.
    """
    import numpy as np

    width, height = size
    w, h = (max(4, min(_MOST, round(length * scale))) for length in size)
    x, y = (np.arange(w) + 0.5) * width / w, (np.arange(h)[::-1] + 0.5) * height / h
    points = np.stack(np.meshgrid(x, y), axis=2).reshape(-1, 2)
    color = _grammar(library).evaluate(points, size, start=name.removeprefix(RULE)).color
    shown = color[:, :3] + (1 - color[:, 3:])
    return (np.clip(shown, 0, 1) * 255 + 0.5).astype(np.uint8).reshape(h, w, 3)


@lru_cache(maxsize=128)
def rule_png(library: str, name: str, size: tuple[float, float], scale: float) -> bytes:
    """The same as a PNG file."""
    from PIL import Image

    stream = BytesIO()
    Image.fromarray(rule_pixels(library, name, size, scale)).save(stream, "PNG", optimize=True)
    return stream.getvalue()


def forget() -> None:
    """Let go of what grammars have drawn: an operator may do something else now."""
    for kept in (_grammar, _mean, rule_pixels, rule_png):
        kept.cache_clear()
