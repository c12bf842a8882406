"""What a parameter or a setting of a grammar can hold, and what an operator's value must be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite

from ...design.errors import quoted
from .limits import MAX_HALF, MAX_LEVEL
from .operators import POLICIES, USAGES, Kind, Param
from .program import Source, Value

__all__ = ["Bound", "Key", "Word", "checked", "plain", "told"]

_SMALLEST = 6e-8


@dataclass(frozen=True, slots=True)
class Key:
    """A rule of a namespace with the values of its parameters.

    A compiler has one object for each. So they are told apart by identity: they may hold each other, many times over.
    """

    space: str
    name: str
    given: tuple[Bound, ...] = ()
    __eq__ = object.__eq__
    __hash__ = object.__hash__


@dataclass(frozen=True, slots=True)
class Word:
    """A constant such as Abs, where a parameter has it as its value."""

    text: str


Bound = float | Source | Key | Word
"""What a parameter or a setting can hold."""


def checked(param: Param, value: Bound, index: Mapping[Key, int]) -> tuple[Value | None, str]:
    """A value as a kind asks, or what was expected."""
    wanted = f"{param.kind.value} for {param.name}"
    match param.kind, value:
        case Kind.RULE, Key():
            return index[value], ""
        case Kind.POLICY, Word(text=text) if text in POLICIES:
            return POLICIES[text], ""
        case Kind.USAGE, Word(text=text) if text in USAGES:
            return USAGES[text], ""
        case Kind.SOURCE, Source():
            return value, ""
        case Kind.SOURCE, float() if value == 0:
            return Source(), ""
        case Kind.MASK, Source(mode="Fit"):
            return value, ""
        case Kind.LEVEL, float() if 0 <= value < MAX_LEVEL and value == int(value):
            return int(value), ""
        case Kind.LEVEL, float() if value >= MAX_LEVEL:
            return None, f"{wanted}, below {MAX_LEVEL}"
        case ((Kind.SIZE | Kind.WEIGHT | Kind.NUMBER), float()) if (
            not isfinite(value) or abs(value) > MAX_HALF
        ):
            return None, f"a number that 16 bits can hold, at most {MAX_HALF:g}"
        case ((Kind.SIZE | Kind.WEIGHT), float()) if 0 < value < _SMALLEST:
            return None, f"a number that 16 bits can hold, at least {_SMALLEST:g}"
        case Kind.SIZE, float() if value > 0:
            return value, ""
        case Kind.WEIGHT, float() if 0 < value <= 1:
            return value, ""
        case Kind.NUMBER, float():
            return value, ""
    return None, wanted


def told(value: Bound) -> str:
    """A value as messages name it."""
    match value:
        case float():
            return f"{value:g}"
        case Source():
            return quoted(value)
        case Word(text=text):
            return repr(text)
        case Key(name=name):
            return f"the rule {quoted(name)}"


def plain(value: Bound) -> str:
    """A value as the name of a copy tells it."""
    return value.text if isinstance(value, Word) else f"{value:g}" if isinstance(value, float) else str(value)
