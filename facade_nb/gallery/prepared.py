"""Lessons: small designs in which the solver's search has something to decide (docs/gallery.md, *Lessons*).

>>> from facade_nb import gallery
>>> gallery.lesson("attached").name
'Attached'
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources

from ..design.errors import DesignError, Fault, nearest
from ..design.model import Design

__all__ = ["Lesson", "lesson", "lesson_note", "lessons"]


@dataclass(frozen=True, slots=True)
class Lesson:
    """What a lesson is about.

    Attributes
    ----------
    name, title
        By what it is loaded, and called.
    look
        What to look at, in a sentence.
    search
        The search that shows it: ``"best"``, or ``"ida"`` for the paper's.
    moment
        Where in the trace it begins, as views write a moment: ``x/alignment+0``.
    design
        The design.
    """

    name: str
    title: str
    look: str
    search: str
    moment: str
    design: Design


def lessons() -> list[str]:
    """Names of all lessons, in the order in which they are best taken."""
    return list(_lessons())


def lesson(name: str) -> Design:
    """Return the design of a lesson.

    Raises
    ------
    DesignError
        For an unknown name, with the nearest valid one.
    """
    return lesson_note(name).design


def lesson_note(name: str) -> Lesson:
    """Return what a lesson is about. Raises `DesignError` as `lesson` does."""
    known = _lessons()
    if name not in known:
        valid = list(known)
        message = (
            f"expected the name of a lesson ({', '.join(valid)}); found {name!r}{nearest(str(name), valid)}"
        )
        raise DesignError(Fault("gallery", message))
    return known[name]


@lru_cache(maxsize=1)
def _lessons() -> dict[str, Lesson]:
    """All lessons; their files are numbered, ``03-deepening.json``."""
    found: dict[str, Lesson] = {}
    files = resources.files(__package__).joinpath("lessons").iterdir()
    for file in sorted((own for own in files if own.name.endswith(".json")), key=lambda own: own.name):
        document = json.loads(file.read_text(encoding="utf-8"))
        name = file.name.removesuffix(".json").split("-", 1)[1]
        found[name] = Lesson(**{**document, "name": name, "design": Design.from_dict(document["design"])})
    return found
