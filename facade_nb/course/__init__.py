"""The exercises of the tutorials: what is right, hints before it is told, and the solutions, which are kept apart."""

from .chapters import chapter
from .exercises import Chapter, Exercise
from .houses import house
from .network import drawn
from .words import listed

__all__ = ["Chapter", "Exercise", "chapter", "drawn", "house", "listed"]
