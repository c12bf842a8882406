"""How a façade begins: an empty canvas, a pattern that was typed, a surveyed building; and the gallery's pictures."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from ... import gallery
from ...design import Canvas, Design, DesignError, Fault
from ...design.edit import add_layer, with_pattern, with_symbol
from ...design.pattern import parse
from ...render import elevation_svg
from ...solver import solve
from ...survey import Survey, SurveyError, buildings, load_survey

__all__ = ["begun", "empty", "survey_of", "surveyed", "thumbnail"]

_FLOOR = 3.0
"""Metres of a floor, where nothing was said of it."""
_ROOM = 2.0
"""Metres of wall that a new canvas has around surveyed openings, in all."""
_THUMBNAIL = 220


def empty(name: str, width: float, height: float) -> Design:
    """A canvas with a first pattern, to be typed over. Raises `DesignError` for a size that cannot be."""
    return Design.from_dict(Design(name, Canvas(width, height), patterns=_nothing()).to_dict())


def _nothing() -> Mapping[str, Any]:
    return with_pattern(Design(), "P1", "ε").patterns


def begun(design: Design, text: str) -> Design:
    """A façade from one pattern, across; floors of three metres stand on each other.

    Symbols that have no size get one of a metre. Raises `DesignError` for a text that is no pattern.
    """
    parsed = parse(text)
    for symbol in parsed.symbols:
        if symbol in parsed.solids and design.symbol(symbol).size is None:
            design = with_symbol(design, symbol, size=1.0)
    taken = {*design.symbols, *parsed.symbols, *parsed.counters}
    floor = next(letter for letter in "FGHRSTUVWXYZ" if letter not in taken)
    counter = next(letter for letter in "nmpqrstu" if letter not in taken)
    design = with_symbol(design, floor, size=min(_FLOOR, design.canvas.height))
    design = with_pattern(design, "across", text)
    design = with_pattern(design, "floors", f"{floor}^{counter}")
    return add_layer(design, "wall", "across", "floors")


@lru_cache(maxsize=1)
def surveyed() -> tuple[str, ...]:
    """The buildings that were surveyed; none where the data are not there."""
    try:
        return buildings()
    except SurveyError:
        return ()


def survey_of(building: str) -> tuple[Design, Survey]:
    """A surveyed building: its design where the gallery has one, else a canvas of its size.

    Raises
    ------
    DesignError
        Where the data are not there, or lack the building.
    """
    try:
        survey = load_survey(building)
    except SurveyError as error:
        raise DesignError(Fault("", str(error))) from None
    own = f"ingolstadt-{building}"  # as the gallery names designs of surveyed buildings
    if own in gallery.names():
        return gallery.load(own), survey
    size = [round(side + _ROOM, 1) for side in (survey.width, survey.height)]
    return empty(f"Building {building}", *size), survey


@lru_cache(maxsize=64)
def thumbnail(name: str, theme: str) -> str:
    """A small elevation of a design of the gallery; made once in a process."""
    layout = solve(gallery.load(name), time_limit=5.0)
    return elevation_svg(layout, width_px=_THUMBNAIL, theme=theme, ids=False, background=False, prefix="t")
