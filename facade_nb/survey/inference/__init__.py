"""A design from surveyed openings (docs/surveys.md)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from statistics import median
from typing import Any

from ...design.fields import describe
from ...design.limits import length_fault
from ...design.model import Design
from ..openings import SurveyError, rect_of
from .search import search
from .structure import Opening, Span
from .writing import plain, written

__all__ = ["infer"]

_BEYOND = 0.006
"""Openings may reach so far beyond the façade, metres: surveys are rounded to centimetres."""
_TOLD = 20
"""So many faults are told."""


def infer(openings: Sequence[Mapping[str, Any]], width: float, height: float, name: str = "") -> Design:
    """A layered design whose windows and doors are the openings given.

    What repeats is counted, what is symmetric is reflected, rows that do not line up have patterns and groups of their
    own. On a larger canvas the design has more windows of the same kind. Without openings it is a plain wall.

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
        f"{field}: {fault}"
        for field, value in (("width", width), ("height", height))
        if (fault := _size_fault(value))
    ]
    if isinstance(openings, str | bytes | Mapping) or not isinstance(openings, Iterable):
        faults.append(f"openings: expected a list of openings, found {describe(openings)}")
    if faults:
        raise SurveyError("\n".join(faults))
    width, height = float(width), float(height)
    found: list[Opening] = []
    for i, opening in enumerate(openings):
        place = f"openings[{i}]"
        try:
            rect = rect_of(opening, place)
        except SurveyError as error:
            faults.append(str(error))
            continue
        left, bottom, right, top = rect
        if min(left, bottom) < -_BEYOND or right > width + _BEYOND or top > height + _BEYOND:
            faults.append(
                f"{place}.rect: expected an opening on the façade, {width:g} × {height:g} m from its lower left "
                f"corner; found [{', '.join(f'{side:g}' for side in rect)}]"
            )
            continue
        found.append(
            Opening(_span(left, right, width), _span(bottom, top, height), opening.get("kind") == "door")
        )
    if faults:
        more = [f"… and {len(faults) - _TOLD} more"] if len(faults) > _TOLD else []
        raise SurveyError("\n".join(faults[:_TOLD] + more))
    title = name or "Façade"
    if not found:
        return plain(width, height, title)
    # One order whatever the survey's: and of openings that are the same, one is drawn
    found = sorted(set(found), key=lambda opening: (opening.y, opening.x, opening.door))
    unit = _unit(found)
    scaled = [opening.scaled(1 / unit) for opening in found]
    order = search(scaled, width / unit, height / unit)
    return written(order, scaled, unit, (width, height), title)


def _span(low: float, high: float, canvas: float) -> Span:
    """An extent on the canvas, to a tenth of a millimetre: nothing hangs on the last bit."""
    low, high = max(0.0, low), min(canvas, high)
    return (round(low, 4), round(high, 4)) if high - low > 0.01 else (low, high)


def _unit(openings: Sequence[Opening]) -> float:
    """A metre, or for models and for hangars what a metre is on a house."""
    usual = float(median(opening.y[1] - opening.y[0] for opening in openings))
    return 1.0 if 0.3 <= usual <= 10 else usual / 1.5


def _size_fault(value: object) -> str:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return f"expected metres; found {describe(value)}"
    return length_fault(float(value))
