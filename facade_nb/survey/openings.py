"""Openings as surveys give them: a kind, and a rectangle in metres."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice
from numbers import Real
from typing import Any

from ..design.errors import FacadeError
from ..design.fields import describe
from ..solver.model.layout import Rect

__all__ = ["OPENING_KINDS", "SurveyError", "rect_fault", "rect_of"]

OPENING_KINDS = frozenset({"window", "door"})
"""The kinds of shapes that a survey of openings can speak of."""

_LEAST = 1e-6
"""Sides of openings are no shorter, metres."""
_MOST = 1e9
"""Places lie within so many metres: surveys may be in the coordinates of a country."""


class SurveyError(FacadeError):
    """Raised for survey data that are missing or cannot be read."""


def rect_of(opening: object, place: str) -> Rect:
    """The rectangle of an opening; `SurveyError`, with the place, where it has no proper one."""
    fault = rect_fault(opening)
    if fault:
        raise SurveyError(f"{place}.rect: {fault}")
    assert isinstance(opening, Mapping)
    left, bottom, right, top = (float(v) for v in opening["rect"])
    return (left, bottom, right, top)


def rect_fault(opening: object) -> str:
    """What is wrong with the rectangle of an opening; empty where it is one."""
    rect = opening.get("rect") if isinstance(opening, Mapping) else None
    values: list[Any] = [] if isinstance(rect, str | bytes | Mapping) else _four(rect)
    if len(values) == 4 and all(map(_is_length, values)):
        left, bottom, right, top = map(float, values)
        if min(right - left, top - bottom) >= _LEAST:
            return ""
    shown = "[" + ", ".join(map(describe, values)) + "]" if values else describe(rect)
    return f"expected left < right and bottom < top in metres, found {shown}"


def _four(rect: object) -> list[Any]:
    """The members of a list, no more than are needed to see that it has four."""
    try:
        return list(islice(iter(rect), 5))  # type: ignore[call-overload]
    except TypeError:
        return []


def _is_length(value: object) -> bool:
    """Whether this is a number that a façade may have as a place; true is none."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return False
    try:
        return abs(float(value)) <= _MOST
    except OverflowError:
        return False
