"""Parameters of geometries: ``arcade(bays=3, depth=2)`` in a design's `geometry` is the arcade with these told.

A parameter that is not told is chosen by the recipe, from the size of the shape.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..design.errors import DesignError, Fault, nearest

__all__ = ["Parameter", "read_call", "read_values"]

_CALL = re.compile(r"\s*([^()=,]*?)\s*(?:\((.*)\)\s*)?", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Parameter:
    """One number, word or text that a recipe takes.

    Attributes
    ----------
    name
        As designs write it.
    summary
        What it says, for documentation and menus.
    low, high
        Least and greatest value of a number.
    whole
        Whether the number is a whole one.
    words
        The words it may be; empty for a number.
    text
        Whether it is any text.
    """

    name: str
    summary: str
    low: float = 0.0
    high: float = 100.0
    whole: bool = False
    words: tuple[str, ...] = ()
    text: bool = False

    @property
    def expected(self) -> str:
        """What may be written, in words."""
        if self.text:
            return "a text"
        if self.words:
            return f"one of {', '.join(self.words)}"
        return f"a {'whole ' if self.whole else ''}number from {self.low:g} to {self.high:g}"

    @property
    def hint(self) -> str:
        """What it says, and what may be written where that is not listed."""
        return self.summary if self.words else f"{self.summary} ({self.expected.removeprefix('a ')})"

    def read(self, value: str) -> Any:
        """The value of a text. Raises ValueError with what was expected."""
        if self.text:
            return value
        if self.words:
            if value not in self.words:
                raise ValueError(f"expected {self.expected}; found {value!r}{nearest(value, self.words)}")
            return value
        try:
            number = float(value)
        except ValueError:
            number = float("nan")
        if not self.low <= number <= self.high or (self.whole and number != int(number)):
            raise ValueError(f"expected {self.expected}; found {value!r}")
        return int(number) if self.whole else number


def read_call(text: str) -> tuple[str, dict[str, str]] | None:
    """Name and parameters of ``name(key=value, key=value)``; None where it is not so written."""
    found = _CALL.fullmatch(text)
    if found is None:
        return None
    given: dict[str, str] = {}
    for piece in (found[2] or "").split(","):
        if piece.strip():
            key, equals, value = piece.partition("=")
            if not equals:
                return None
            given[key.strip()] = value.strip()
    return found[1], given


def read_values(
    given: Mapping[str, str], known: Sequence[Parameter], owner: str, place: str
) -> dict[str, Any]:
    """The values of parameters that were told.

    Raises
    ------
    DesignError
        With a fault for each parameter that there is not, or whose value is none of its own.
    """
    names = {parameter.name: parameter for parameter in known}
    values: dict[str, Any] = {}
    faults: list[Fault] = []
    for key, text in given.items():
        if key not in names:
            kinds = f"one of {', '.join(names)}" if names else "none"
            faults.append(
                Fault(place, f"parameter of {owner}: expected {kinds}; found {key!r}{nearest(key, names)}")
            )
            continue
        try:
            values[key] = names[key].read(text)
        except ValueError as error:
            faults.append(Fault(place, f"{key} of {owner}: {error}"))
    if faults:
        raise DesignError(faults)
    return values
