"""The chapters that have exercises, by the names of their files."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module

from .exercises import Chapter

__all__ = ["CHAPTERS", "chapter"]

CHAPTERS: Mapping[str, str] = {
    "01-a-stack-of-layers": "layers",
    "02-patterns-and-words": "patterns",
    "03-what-is-known-beforehand": "beforehand",
    "04-what-goes-wrong": "wrong",
    "05-columns-and-constraints": "columns",
    "06-a-shortest-path": "shortest_path",
    "07-iterative-deepening": "deepening",
    "08-candidates-and-proof": "candidates",
    "09-sizes": "sizes",
    "10-a-pixel-by-grammar": "pixel",
    "11-rooms-behind-windows": "rooms",
    "12-the-pipeline-and-a-town": "deferred",
    "13-change-the-solver": "own_code",
}
"""The module of each, which is loaded when the chapter is opened."""


def chapter(name: str) -> Chapter:
    """The exercises of a tutorial, by its file's name: ``check = chapter("06-a-shortest-path")``."""
    if name not in CHAPTERS:
        raise ValueError(f"chapter: expected one of {', '.join(CHAPTERS)}; found {name!r}")
    return Chapter(name, import_module(f"{__package__}.{CHAPTERS[name]}").EXERCISES)
