"""Designs: model, pattern language, documents, errors. Readable without numpy."""

from .errors import DesignError, FacadeError, Fault, NoLayout, PatternError, Suggestion
from .model import Canvas, Counter, Design, Layer, LayerAxis, PatternDef, Shape, Symbol, Variant
from .pattern import Glyph, Pattern, parse
from .schema import design_schema

__all__ = [
    "Canvas",
    "Counter",
    "Design",
    "DesignError",
    "FacadeError",
    "Fault",
    "Glyph",
    "Layer",
    "LayerAxis",
    "NoLayout",
    "Pattern",
    "PatternDef",
    "PatternError",
    "Shape",
    "Suggestion",
    "Symbol",
    "Variant",
    "design_schema",
    "parse",
]
