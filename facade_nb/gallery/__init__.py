"""Designs and texture grammars that ship; docs/gallery.md and docs/grammars.md tell where each comes from.

>>> from facade_nb import gallery
>>> gallery.load("residential-house").canvas.width
6.0
>>> gallery.load("residential-house", "wider").canvas.width
9.4
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from functools import lru_cache
from importlib import resources
from types import MappingProxyType
from typing import Any

from ..design import edit
from ..design.errors import DesignError, Fault, nearest
from ..design.model import Design
from .prepared import Lesson, lesson, lesson_note, lessons

__all__ = [
    "Lesson", "grammar", "grammars", "lesson", "lesson_note", "lessons", "load", "names", "step_titles", "steps",
    "town", "towns", "variation_titles", "variations",
]  # fmt: skip

_EDITS: Mapping[str, Callable[..., Design]] = MappingProxyType(
    {name: getattr(edit, name) for name in edit.__all__}
)
"""What a step or a variation may do: the helpers of `facade_nb.design.edit`, by name."""


def names() -> list[str]:
    """Names of all designs, in alphabetical order."""
    return _listed("")


def load(name: str, variation: str | None = None) -> Design:
    """Return the design of that name, or one of its `variations`.

    Raises
    ------
    DesignError
        For an unknown name, with the nearest valid one.
    """
    _known(name, names(), "a design of the gallery")
    if variation is None:
        return _load(name)
    _known(variation, variations(name), f"a variation of {name!r}")
    return _varied(name, variation)


def variations(name: str) -> list[str]:
    """Return the names of a design's variations: on another canvas, with other sizes, with an edited structure.

    A building has some, another design none. `variation_titles` says what each is.

    Raises
    ------
    DesignError
        For an unknown name, with the nearest valid one.
    """
    _known(name, names(), "a design of the gallery")
    return list(_variations(name))


def variation_titles(name: str) -> list[str]:
    """Return what each of `variations` is, in their order. Raises `DesignError` as `variations` does."""
    return [_variations(name)[own]["title"] for own in variations(name)]


def steps(name: str) -> list[Design]:
    """Return how a design is made: the design that one begins with, then the design after each step.

    The last is the design that `load` gives. `step_titles` says what each step does.

    Raises
    ------
    DesignError
        For an unknown name, or for a design without steps; the message says which designs have them.
    """
    return list(_steps(_stepped(name))[1])


def step_titles(name: str) -> list[str]:
    """Return a title for each of the designs of `steps`, in their order. Raises `DesignError` as `steps` does."""
    return list(_steps(_stepped(name))[0])


def grammars() -> list[str]:
    """Names of all texture grammars, in the order of the paper's figures."""
    return sorted(_listed("grammars", ".txt"), key=_numbered)


def grammar(name: str) -> str:
    """Return the text of the texture grammar of that name, for `facade_nb.render.Grammar.parse`.

    Raises
    ------
    DesignError
        For an unknown name, with the nearest valid one.
    """
    _known(name, grammars(), "a texture grammar of the gallery")
    return _text("grammars", f"{name}.txt")


def towns() -> list[str]:
    """Names of the parts of the town's grammar: a style each, and what they share."""
    return _listed("town", ".txt")


def town(name: str) -> str:
    """Return the text of a part of the town's grammar; `facade_nb.render.town.styles` puts them together.

    Raises
    ------
    DesignError
        For an unknown name, with the nearest valid one.
    """
    _known(name, towns(), "a part of the town's grammar")
    return _text("town", f"{name}.txt")


def _numbered(name: str) -> tuple[int, str]:
    number = re.search(r"\d+", name)
    return (int(number[0]) if number else 0, name)


@lru_cache(maxsize=64)
def _load(name: str) -> Design:
    return Design.from_json(_text(f"{name}.json"))


@lru_cache(maxsize=64)
def _variations(name: str) -> Mapping[str, Any]:
    """What the file of a design's variations says: by name a title, and edits as those of steps."""
    return json.loads(_text("variations", f"{name}.json")) if name in _listed("variations") else {}


@lru_cache(maxsize=64)
def _varied(name: str, variation: str) -> Design:
    design = _load(name)
    for edited in _variations(name)[variation]["edits"]:
        design = _apply(design, *edited)
    return design


@lru_cache(maxsize=16)
def _steps(name: str) -> tuple[tuple[str, ...], tuple[Design, ...]]:
    document = json.loads(_text("steps", f"{name}.json"))
    titles: list[str] = [document["title"]]
    designs = [Design.from_dict(document["start"])]
    for step in document["steps"]:
        design = designs[-1]
        for edited in step["edits"]:
            design = _apply(design, *edited)
        titles.append(step["title"])
        designs.append(design)
    return tuple(titles), tuple(designs)


def _apply(
    design: Design, verb: str, values: list[Any], fields: Mapping[str, Any] = MappingProxyType({})
) -> Design:
    """Do one edit: the helper's name, its arguments in order and, where there are any, its fields."""
    return _EDITS[verb](design, *values, **fields)


def _stepped(name: str) -> str:
    _known(name, names(), "a design of the gallery")
    have = _listed("steps")
    if name not in have:
        message = (
            f"expected a design with steps ({', '.join(have)}); {name!r} has none, only the finished design"
        )
        raise DesignError(Fault("gallery", message))
    return name


def _known(name: str, valid: list[str], what: str) -> None:
    if name not in valid:
        listed = ", ".join(valid) or "it has none"
        message = f"expected the name of {what} ({listed}); found {name!r}{nearest(str(name), valid)}"
        raise DesignError(Fault("gallery", message))


def _listed(folder: str, suffix: str = ".json") -> list[str]:
    root = resources.files(__name__)
    place = root.joinpath(folder) if folder else root
    return sorted(file.name.removesuffix(suffix) for file in place.iterdir() if file.name.endswith(suffix))


def _text(*path: str) -> str:
    return resources.files(__name__).joinpath(*path).read_text(encoding="utf-8")
