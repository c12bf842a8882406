"""Small readers of document values that collect faults instead of raising them."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from numbers import Integral, Real
from typing import Any, TypeVar

from .errors import Fault, cut, nearest, quoted
from .limits import LEAST_LENGTH, MOST_COUNT, MOST_LENGTH
from .text import control_character

__all__ = ["Faults", "at", "describe"]

T = TypeVar("T")


def at(place: str, key: str | int) -> str:
    """The place of a member: ``layers[1]``, ``patterns.Bx``, ``symbols["front door"]``."""
    if isinstance(key, int):
        return f"{place}[{key}]"
    key = cut(key)
    if re.fullmatch(r"\w+", key):
        return f"{place}.{key}" if place else key
    return f"{place}[{json.dumps(key, ensure_ascii=False)}]"


def describe(value: object) -> str:
    """What was found, in JSON's words, short."""
    match value:
        case None:
            return "null"
        case bool():
            return "true" if value else "false"
        case str():
            return quoted(value)
        case int():
            return str(value) if value.bit_length() < 64 else "a very large number"
        case Real():
            return cut(str(value))
        case Mapping():
            return "an object"
        case list() | tuple():
            return "a list"
        case _:
            return f"a Python {cut(type(value).__name__)}"


_HINTS = 20
"""So many faults are told with the nearest name. Looking for it takes longer the more names there are."""


class Faults:
    """The faults found so far. Each reader returns the value, or a default after noting what is wrong with it."""

    def __init__(self) -> None:
        self.found: list[Fault] = []

    def nearest(self, name: str, valid: Iterable[str]) -> str:
        """What `errors.nearest` says, for the first faults; a document with more of them is refused as quickly."""
        return nearest(name, valid) if len(self.found) < _HINTS else ""

    def add(self, place: str, message: str) -> None:
        """Note a fault."""
        self.found.append(Fault(place, message))

    def expected(self, place: str, expected: str, value: object, hint: str = "") -> None:
        """Note that one thing was expected and another found."""
        self.add(place, f"expected {expected}; found {describe(value)}{hint}")

    def mapping(self, value: object, place: str, expected: str = "an object") -> Mapping[str, Any]:
        """An object with texts as keys."""
        if not isinstance(value, Mapping):
            self.expected(place, expected, value)
            return {}
        for key in value:
            if not isinstance(key, str):
                self.expected(place, "texts as keys", key)
        return {key: member for key, member in value.items() if isinstance(key, str)}

    def record(
        self, value: object, place: str, known: Sequence[str], required: Iterable[str] = ()
    ) -> Mapping[str, Any]:
        """An object with known fields only."""
        fields = self.mapping(value, place)
        for key in fields:
            if key not in known:
                hint = self.nearest(key, known) or f"; known are {', '.join(known)}"
                self.add(at(place, key), f"unknown field {describe(key)}{hint}")
        if isinstance(value, Mapping):
            for key in required:
                if key not in fields:
                    self.add(at(place, key), "this field is missing")
        return {key: member for key, member in fields.items() if key in known}

    def sequence(self, value: object, place: str, expected: str = "a list") -> Sequence[Any]:
        """A list."""
        if isinstance(value, list | tuple):
            return value
        self.expected(place, expected, value)
        return ()

    def number(
        self, value: object, place: str, default: T, *, positive: bool = False, least: float | None = None
    ) -> float | T:
        """A finite number, greater than 0 or not less than `least` where asked for."""
        expected = "a number" if least is None else f"a number from {least:g}"
        if positive:
            expected = "a number greater than 0"
        if isinstance(value, bool) or not isinstance(value, Real):
            self.expected(place, expected, value)
            return default
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            self.expected(place, f"{expected}, and finite", value)
            return default
        if (positive and number <= 0) or (least is not None and number < least):
            self.expected(place, expected, value)
            return default
        if abs(number) > MOST_LENGTH or (positive and number < LEAST_LENGTH):
            low = f"{LEAST_LENGTH:f}" if positive else f"{-MOST_LENGTH if least is None else least:,.0f}"
            self.expected(place, f"a number from {low} to {MOST_LENGTH:,.0f}", value)
            return default
        return number

    def integer(self, value: object, place: str, default: T) -> int | T:
        """A whole number; 3.0 is one."""
        if isinstance(value, bool) or not (
            isinstance(value, Integral) or (isinstance(value, float) and value.is_integer())
        ):
            self.expected(place, "a whole number", value)
            return default
        number = int(value)
        if abs(number) > MOST_COUNT:
            self.expected(place, f"a whole number from {-MOST_COUNT:,} to {MOST_COUNT:,}", value)
            return default
        return number

    def flag(self, value: object, place: str, default: T) -> bool | T:
        """True or false."""
        if isinstance(value, bool):
            return value
        self.expected(place, "true or false", value)
        return default

    def text(self, value: object, place: str, default: T, *, empty: bool = False) -> str | T:
        """A text in one line."""
        if not isinstance(value, str):
            self.expected(place, "a text", value)
            return default
        if not value.strip() and not empty:
            self.expected(place, "a text that is not empty", value)
            return default
        control = control_character(value)
        if control:
            self.add(place, f"expected a text without control characters; found U+{ord(control):04X}")
            return default
        return value

    def choice(self, value: object, place: str, options: Sequence[T]) -> T:
        """One of the options."""
        for option in options:
            if value == option:
                return option
        hint = self.nearest(value, map(str, options)) if isinstance(value, str) else ""
        self.expected(place, f"one of {', '.join(map(str, options))}", value, hint)
        return options[0]

    def optional(self, fields: Mapping[str, Any], key: str, read: Callable[[Any], T]) -> T | None:
        """The field read, or None where it is missing or null."""
        value = fields.get(key)
        return None if value is None else read(value)
