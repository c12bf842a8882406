"""The exercises of the tutorials: what is right, hints before it is told, and the solutions, which are kept apart."""

from .chapters import chapter
from .exercises import Chapter, Exercise
from .houses import house
from .network import drawn
from .pictures import Picture, painted, sheet
from .words import listed

__all__ = ["Chapter", "Exercise", "Picture", "chapter", "drawn", "house", "listed", "painted", "sheet"]
