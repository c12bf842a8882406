"""The exercises of the tutorials: what is right, hints before it is told, and the solutions, which are kept apart."""

from .exercises import Chapter, Exercise
from .houses import house
from .network import drawn
from .words import listed

__all__ = ["Chapter", "Exercise", "chapter", "drawn", "house", "listed"]


def chapter(name: str) -> Chapter:
    """The exercises of a tutorial, by its file's name: ``check = chapter("06-a-shortest-path")``."""
    from . import chapters

    known = chapters.CHAPTERS
    if name not in known:
        raise ValueError(f"chapter: expected one of {', '.join(known)}; found {name!r}")
    return known[name]()
