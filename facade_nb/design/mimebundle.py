"""How a value of this package shows itself in a notebook: registered from above by what draws it.

A design and a layout know nothing of drawing. `facade_nb.display` registers what draws them when the package is
imported; without it they show themselves as text.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ["bundle_of", "register"]

_SHOWN: dict[type, Callable[[Any], dict[str, str]]] = {}
"""Per class: what makes a MIME bundle of its instances."""


def register(kind: type, show: Callable[[Any], dict[str, str]]) -> None:
    """Let instances of a class be shown by a function that gives their MIME bundle: text by MIME type."""
    _SHOWN[kind] = show


def bundle_of(value: object) -> dict[str, str]:
    """The MIME bundle of a value: what was registered for its class, else its ``repr`` as plain text."""
    show = _SHOWN.get(type(value))
    return {"text/plain": repr(value)} if show is None else show(value)
