"""Façade textures by grammar, evaluated for each pixel (the texture paper; docs/texture.md).

A text is compiled (`compiling`) into rules (`program`), which are checked (`checks`) and written into a texture
(`encoding`), all by one table of operators (`operators`). Two evaluators read that texture: one in NumPy
(`evaluating`), one in GLSL (`gl`).
"""

from .encoding import Encoding, decode, encode
from .grammar import Grammar
from .operators import OPERATORS, Kind, Operator, Param
from .picture import render_texture, rules_seen, texture_pixels
from .program import Rule, Source
from .question import Surface
from .view import Sight

__all__ = [
    "OPERATORS",
    "Encoding",
    "Grammar",
    "Kind",
    "Operator",
    "Param",
    "Rule",
    "Sight",
    "Source",
    "Surface",
    "decode",
    "encode",
    "render_texture",
    "rules_seen",
    "texture_pixels",
]
