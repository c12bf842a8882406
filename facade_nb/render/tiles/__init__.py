"""Tiles: the windows, doors, walls and rooms that texture grammars are composed of (docs/tiles.md).

They are drawn by code, in NumPy, when they are first needed; a folder of images can take their place.
"""

from .catalogue import CATALOGUE, Recipe
from .folder import TileError
from .sheet import sheet
from .tileset import DEFAULT_SIZE, TileSet

__all__ = ["CATALOGUE", "DEFAULT_SIZE", "Recipe", "TileError", "TileSet", "sheet"]
