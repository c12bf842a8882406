"""Texture grammars live: picture, editor, inspector, table (docs/texture-widgets.md)."""

from .model import TextureModel
from .view import GrammarEditor, GrammarTable, PixelInspector, TextureStudio, TextureView

__all__ = [
    "GrammarEditor",
    "GrammarTable",
    "PixelInspector",
    "TextureModel",
    "TextureStudio",
    "TextureView",
]
