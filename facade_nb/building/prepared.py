"""Buildings that ship: a corner house, a house around a yard, a row (docs/buildings.md, *Prepared buildings*).

>>> from facade_nb import building
>>> building.load("corner-house").height
11.4
"""

from __future__ import annotations

from functools import lru_cache
from importlib import resources
from importlib.resources.abc import Traversable

from ..design.errors import DesignError, Fault, nearest
from .model import Building

__all__ = ["load", "names"]


def names() -> list[str]:
    """Names of all prepared buildings, in alphabetical order."""
    return sorted(
        file.name.removesuffix(".json") for file in _folder().iterdir() if file.name.endswith(".json")
    )


def load(name: str) -> Building:
    """Return the prepared building of that name. A file of yours is read by `Building.from_json`.

    Raises
    ------
    DesignError
        For an unknown name, with the nearest valid one.
    """
    if name not in (valid := names()):
        listed = ", ".join(valid)
        found = f"found {name!r}{nearest(str(name), valid)}"
        message = f"expected the name of a prepared building ({listed}); {found}"
        raise DesignError(Fault("building", message))
    return _load(name)


@lru_cache(maxsize=16)
def _load(name: str) -> Building:
    return Building.from_json(_folder().joinpath(f"{name}.json").read_text(encoding="utf-8"))


def _folder() -> Traversable:
    return resources.files(__package__).joinpath("documents")
