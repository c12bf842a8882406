"""Buildings: several façades around the corner, with one height for all (docs/buildings.md)."""

from . import showing as showing  # registers how buildings show themselves
from .faces import Face, faces
from .layout import BuildingLayout, SolvedFace
from .model import Building, Corner, Roof
from .prepared import load, names
from .solution import solve

__all__ = [
    "Building",
    "BuildingLayout",
    "Corner",
    "Face",
    "Roof",
    "SolvedFace",
    "faces",
    "load",
    "names",
    "solve",
]
