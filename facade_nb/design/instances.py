"""Names in keys of shapes that mean one instance of a symbol: ``B[2]`` is the second from the left or from below."""

from __future__ import annotations

import re
from collections.abc import Container

__all__ = ["Named", "meanings", "spell_instance", "split_instance"]

Named = tuple[str, int | None]
"""A symbol or ``*``, and the number of an instance; None where all of them are meant."""

_INSTANCE = re.compile(r"(.+)\[(-?[1-9][0-9]{0,8}|0)\]", re.DOTALL)


def split_instance(name: str, known: Container[str]) -> tuple[str, int | None]:
    """The symbol that a name in a key means, and the number of the instance; None where all are meant.

    Numbers count from 1, from the left or from below; -1 is the last. A symbol that is itself called ``B[2]`` (one of
    those `known`) is meant by its name.
    """
    found = None if name in known else _INSTANCE.fullmatch(name)
    return (name, None) if found is None else (found[1], int(found[2]))


def meanings(key: str, known: Container[str]) -> list[tuple[Named, Named]]:
    """Every pair of sides that a key of shapes may mean, where these symbols are `known`.

    Names may have blanks: where both halves of two cuts name something, the key means both pairs.
    """
    words = key.split(" ")
    pairs = ((" ".join(words[:cut]), " ".join(words[cut:])) for cut in range(1, len(words)))
    parted = ((split_instance(x, known), split_instance(y, known)) for x, y in pairs)
    return [pair for pair in parted if all(name == "*" or name in known for name, _ in pair)]


def spell_instance(symbol: str, number: int) -> str:
    """The name of one instance: ``B[2]``."""
    return f"{symbol}[{number}]"
