"""A survey that is drawn by hand, with its history. It needs no notebook."""

from __future__ import annotations

import json
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from traitlets import HasTraits, Instance, Int

from ...design import Design
from ...design.errors import quoted
from ...design.fields import describe
from ...design.files import write_atomically
from ...design.limits import length_fault
from ...survey import Survey, SurveyError, infer
from ...survey.openings import rect_fault
from ...survey.reading import survey_text
from ..shared.history import History, Undoable

__all__ = ["Drawn", "SurveyModel"]

_MOST = 2000
"""Openings of a façade."""

Corners = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Drawn:
    """What is drawn: a façade in metres, its openings, and where its corners lie in the photograph.

    Attributes
    ----------
    corners
        Lower left, lower right, upper right, upper left: parts of the picture's width and height, from its upper left.
        Empty: the picture is that of the façade as it is.
    """

    name: str = ""
    width: float = 12.0
    height: float = 9.0
    openings: tuple[tuple[str, tuple[float, float, float, float]], ...] = ()
    corners: Corners = ()

    @classmethod
    def of(cls, value: object) -> Drawn:
        """What a browser, or a survey, says is drawn. `SurveyError` for what cannot be."""
        own: Mapping[str, Any] = value if isinstance(value, Mapping) else {}
        faults = []
        sides = {}
        for field in ("width", "height"):
            side = own.get(field)
            number = isinstance(side, int | float) and not isinstance(side, bool)
            fault = length_fault(float(side)) if number else f"expected metres; found {describe(side)}"  # type: ignore[arg-type]
            if fault:
                faults.append(f"{field}: {fault}")
            else:
                sides[field] = round(float(side), 4)  # type: ignore[arg-type]
        given = own.get("openings", ())
        given = given if isinstance(given, Sequence) and not isinstance(given, str) else ()
        if len(given) > _MOST:
            faults.append(f"openings: expected at most {_MOST:,}; found {len(given):,}")
        openings = []
        for k, opening in enumerate(given[:_MOST]):
            fault = rect_fault(opening)
            if fault:
                faults.append(f"openings[{k}].rect: {fault}")
                continue
            kind = "door" if opening.get("kind") == "door" else "window"
            left, bottom, right, top = (round(float(side), 4) for side in opening["rect"])
            openings.append((kind, (left, bottom, right, top)))
        if faults:
            raise SurveyError("\n".join(faults[:20]))
        corners = _corners(own.get("corners"))
        return cls(str(own.get("name") or ""), sides["width"], sides["height"], tuple(openings), corners)

    @classmethod
    def of_survey(cls, survey: Survey, corners: Corners = ()) -> Drawn:
        """A survey, with the corners of a photograph."""
        own = {"name": survey.building, "width": survey.width, "height": survey.height}
        return replace(cls.of({**own, "openings": survey.openings}), corners=corners)

    def told(self) -> dict[str, Any]:
        """The same as the browser has it."""
        return {
            "name": self.name,
            "width": self.width,
            "height": self.height,
            "openings": [{"kind": kind, "rect": list(rect)} for kind, rect in self.openings],
            "corners": [list(corner) for corner in self.corners],
        }


def _corners(value: object) -> Corners:
    """Four pairs of numbers; else none."""
    if not isinstance(value, Sequence) or len(value) != 4:
        return ()
    try:
        found = tuple((float(x), float(y)) for x, y in value)
    except (TypeError, ValueError):
        return ()
    return found if all(-10 <= part <= 10 for corner in found for part in corner) else ()


class SurveyModel(Undoable[Drawn], HasTraits):
    """A façade that is drawn: what is drawn now, and what was.

    Attributes
    ----------
    drawn
        What is drawn.
    version
        Goes up once after each change.
    """

    drawn = Instance(Drawn)
    version = Int(0)

    def __init__(self, drawn: Drawn | None = None) -> None:
        super().__init__(drawn=drawn or Drawn())
        self._history = History(self.drawn)

    @property
    def survey(self) -> Survey:
        """What is drawn, as a survey."""
        own = self.drawn
        openings = tuple({"kind": kind, "rect": list(rect)} for kind, rect in own.openings)
        return Survey(own.name, own.width, own.height, openings)

    @survey.setter
    def survey(self, survey: Survey) -> None:
        self.draw(Drawn.of_survey(survey, self.drawn.corners))

    def draw(self, drawn: Drawn, *, key: Hashable | None = None) -> None:
        """Have this drawn, as a step that can be undone; steps with one key in quick succession are one."""
        self._note(drawn, key)
        self._restore(drawn)

    def scale(self, axis: str, length: float, known: float) -> None:
        """Make the façade larger or smaller so that what is `length` long becomes as long as is known, metres.

        Raises
        ------
        SurveyError
            For a length that is none.
        """
        fault = length_fault(known) or length_fault(length)
        if fault or axis not in ("x", "y"):
            raise SurveyError(f"scale: {fault or f'expected x or y, found {quoted(axis)}'}")
        by = known / length
        x, y = (by, 1.0) if axis == "x" else (1.0, by)
        own = self.drawn
        openings = [
            {"kind": kind, "rect": [left * x, bottom * y, right * x, top * y]}
            for kind, (left, bottom, right, top) in own.openings
        ]
        self.draw(
            Drawn.of({**own.told(), "width": own.width * x, "height": own.height * y, "openings": openings})
        )

    def open(self, text: str) -> None:
        """Take over a survey from the text of its file: JSON, or a city model. `SurveyError` for what is none."""
        self.survey = survey_text(text)

    def to_json(self, path: str | Path | None = None) -> str:
        """The survey as the text of a file, which `load_survey` reads; with `path` it is also written there."""
        own = self.drawn.told()
        corners = own.pop("corners")
        facade = {"building": own.pop("name") or "facade", **own, **({"corners": corners} if corners else {})}
        text = json.dumps({"facades": [facade]}, ensure_ascii=False, indent=1) + "\n"
        if path is not None:
            write_atomically(path, text)
        return text

    def infer(self, name: str = "") -> Design:
        """The design of what is drawn; it raises what `facade_nb.survey.infer` raises."""
        own = self.survey
        return infer(own.openings, own.width, own.height, name or own.building)

    def _restore(self, state: Drawn) -> None:
        self.drawn = state
        self.version += 1
