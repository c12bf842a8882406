"""A design from surveyed openings (docs/surveys.md)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ...design.limits import length_fault
from ...design.model import Design
from ...design.fields import describe
from ..openings import SurveyError, rect_of
from .search import search
from .structure import Opening
from .writing import plain, written

__all__ = ["infer"]

_BEYOND = 0.006
"""Openings may reach so far beyond the façade, metres: surveys are rounded to centimetres."""


def infer(openings: Sequence[Mapping[str, Any]], width: float, height: float, name: str = "") -> Design:
    """A layered design whose windows and doors are the openings given.

    What repeats is counted, what is symmetric is reflected, rows that do not line up have patterns and groups of their
    own. On a larger canvas the design has more windows of the same kind. Where there are no openings, it is a plain wall.

    Parameters
    ----------
    openings
        ``{"kind": ..., "rect": [left, bottom, right, top]}``, metres, from the façade's lower left corner. What is no
        ``"door"`` is a window.
    width, height
        The façade, metres.
    name
        The design's name.

    Raises
    ------
    SurveyError
        For an opening that has no proper rectangle or reaches beyond the façade, and for a façade without a size. The
        message has the place of every fault.
    """
    faults = [
        f"{field}: {fault}" for field, value in (("width", width), ("height", height)) if (fault := _size_fault(value))
    ]
    found: list[Opening] = []
    for i, opening in enumerate(openings):
        place = f"openings[{i}]"
        try:
            left, bottom, right, top = rect_of(opening, place)
        except SurveyError as error:
            faults.append(str(error))
            continue
        if not faults and (
            min(left, bottom) < -_BEYOND or right > width + _BEYOND or top > height + _BEYOND
        ):
            faults.append(
                f"{place}.rect: expected an opening on the façade, {width:g} × {height:g} m from its lower left corner; "
                f"found {describe([left, bottom, right, top])}"
            )
            continue
        x = (round(max(0.0, left), 3), round(right, 3))
        y = (round(max(0.0, bottom), 3), round(top, 3))
        found.append(Opening(x, y, opening.get("kind") == "door"))
    if faults:
        raise SurveyError("\n".join(faults[:20]))
    width, height = float(width), float(height)
    if not found:
        return plain(width, height, name or "Façade")
    found.sort(key=lambda opening: (opening.y, opening.x, opening.door))
    return written(search(found, width, height), found, width, height, name or "Façade")


def _size_fault(value: object) -> str:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return f"expected metres; found {describe(value)}"
    return length_fault(float(value))
