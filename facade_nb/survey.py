"""How near a layout comes to surveyed openings of a real building (docs/gallery.md).

>>> from facade_nb import gallery, solve
>>> from facade_nb.survey import compare, load_survey
>>> survey = load_survey("4018215")  # doctest: +SKIP
>>> round(compare(solve(gallery.load("ingolstadt-4018215")), survey.openings), 3)  # doctest: +SKIP
0.867
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from math import fsum
from numbers import Real
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from .design.errors import DesignError, FacadeError, cut, nearest, quoted
from .design.fields import Faults, at, describe
from .design.inputs import read_json_text, read_text
from .design.sections import DocumentReader
from .solver.model.layout import Layout, PlacedShape, Rect

__all__ = [
    "OPENING_KINDS",
    "Pair",
    "Survey",
    "SurveyError",
    "buildings",
    "compare",
    "load_survey",
    "match",
]

OPENING_KINDS = frozenset({"window", "door"})
"""The kinds of shapes that a survey of openings can speak of."""

_LEAST = 1e-6
"""Sides of openings are no shorter, metres."""
_MOST = 1e9
"""Places lie within so many metres: surveys may be in the coordinates of a country."""
_VARIABLE = "FACADE_NB_DATA"
_FILE = "ingolstadt.json"


class SurveyError(FacadeError):
    """Raised for survey data that are missing or cannot be read."""


@dataclass(frozen=True, slots=True)
class Survey:
    """The surveyed openings of one façade.

    Attributes
    ----------
    building
        Its number in the data.
    width, height
        Width and height of all openings together, in metres; the wall is larger.
    openings
        ``{"kind": "window", "rect": [left, bottom, right, top]}``, metres.
    source, licence
        Where the data come from, and under what terms.
    """

    building: str
    width: float
    height: float
    openings: tuple[Mapping[str, Any], ...]
    source: str = ""
    licence: str = ""


@dataclass(frozen=True, slots=True)
class Pair:
    """An opening and the shape it was matched with.

    Attributes
    ----------
    opening, shape
        Indices into the openings given and into `Layout.shapes`.
    surveyed, solved
        Their rectangles, each moved to the common lower left corner of its kind, metres.
    iou
        Intersection over union, 0 to 1.
    """

    opening: int
    shape: int
    surveyed: Rect
    solved: Rect
    iou: float


def compare(layout: Layout, openings: Sequence[Mapping[str, Any]]) -> float:
    """Mean intersection over union of surveyed openings and the windows and doors of a layout.

    Openings and shapes are each moved to their common lower left corner and matched one to one as well as can be; their
    kinds need not agree. Every visible shape counts, also where shapes overlap.

    Parameters
    ----------
    layout
        A solved façade.
    openings
        ``{"kind": ..., "rect": [left, bottom, right, top]}``, metres.

    Returns
    -------
    float
        Sum of the intersections over unions of the pairs / max(number of openings, number of shapes), from 0 to 1; 1
        where there are neither openings nor shapes, for then nothing differs.

    Raises
    ------
    SurveyError
        For an opening that has no proper rectangle.
    """
    pairs = match(layout, openings)
    most = max(len(openings), len(_shapes(layout)))
    return fsum(pair.iou for pair in pairs) / most if most else 1.0


def match(layout: Layout, openings: Sequence[Mapping[str, Any]]) -> tuple[Pair, ...]:
    """The best one-to-one matching of openings with windows and doors, in the order of the openings.

    An opening and a shape that do not overlap make no pair. It raises `SurveyError` as `compare` does.
    """
    shapes = _shapes(layout)
    surveyed = _to_corner([_rect(opening, f"openings[{i}]") for i, opening in enumerate(openings)])
    solved = _to_corner([shape.rect for _, shape in shapes])
    if not len(surveyed) or not len(solved):
        return ()
    scores = _overlaps(surveyed, solved)
    rows, columns = linear_sum_assignment(scores, maximize=True)
    return tuple(
        Pair(int(i), shapes[j][0], _as_rect(surveyed[i]), _as_rect(solved[j]), float(scores[i, j]))
        for i, j in zip(rows, columns, strict=True)
        if scores[i, j] > 0
    )


def buildings(path: str | Path | None = None) -> tuple[str, ...]:
    """The buildings that a data file has, in its order. `path`, and what it raises, are as for `load_survey`."""
    return tuple(_read_file(path)[2])


def load_survey(building: str, path: str | Path | None = None) -> Survey:
    """Read the surveyed openings of a building.

    Parameters
    ----------
    building
        Its number, such as ``"4018215"``.
    path
        The data file, or the folder it lies in. None: what the environment variable ``FACADE_NB_DATA`` names, else
        ``shared/data`` beside the checkout.

    Raises
    ------
    SurveyError
        If the file does not exist, is no survey, or lacks the building. The message has the place of every
        fault, what was expected and what was found.
    """
    reader, file, found = _read_file(path)
    name = str(building)
    if name not in found:
        known = ", ".join(map(cut, islice(found, 8))) + (", …" if len(found) > 8 else "") or "there is none"
        raise SurveyError(
            f"{file}: expected a building of the survey ({known}); found {quoted(name)}{nearest(name, found)}"
        )
    survey = reader.survey(name, found[name][1])
    if reader.faults.found:
        raise SurveyError(f"{file}: building {cut(name)}: {DesignError(reader.faults.found)}")
    return survey


def _read_file(path: str | Path | None) -> tuple[_Reader, Path, dict[str, tuple[str, Mapping[str, Any]]]]:
    """Read a data file: its reader, the file, and place and members of each building."""
    file = _data_file(path)
    try:
        document = read_json_text(read_text(file, "a survey"), str(file))
    except DesignError as error:
        raise SurveyError(f"expected a survey; {error}") from None
    reader = _Reader(document)
    found = reader.facades()
    if reader.faults.found:
        raise reader.error(file)
    return reader, file, found


def _named(name: str | int) -> bool:
    """Whether a building has a name, or a number of fewer digits than Python minds."""
    return bool(name.strip()) if isinstance(name, str) else abs(name) < 10**100


class _Reader:
    """Reads a document of surveys; what is wrong with it is noted with its place."""

    def __init__(self, document: object) -> None:
        self.document = document
        self.faults = Faults()

    def error(self, place: object) -> SurveyError:
        """What is wrong, all of it."""
        what = "expected a survey, an object with facades that each have building and openings"
        return SurveyError(f"{place}: {what}\n{DesignError(self.faults.found)}")

    def facades(self) -> dict[str, tuple[str, Mapping[str, Any]]]:
        """Place and members of each building; none may stand twice."""
        faults = self.faults
        keys = DocumentReader()
        keys.repeated_keys(self.document)
        faults.found += keys.faults.found
        values = faults.mapping(self.document, "", "a survey (an object)")
        if isinstance(self.document, Mapping) and "facades" not in values:
            faults.add("facades", "this field is missing")
        found: dict[str, tuple[str, Mapping[str, Any]]] = {}
        for index, item in enumerate(
            faults.sequence(values.get("facades", ()), "facades", "a list of facades")
        ):
            place = at("facades", index)
            facade = faults.mapping(item, place)
            name = facade.get("building")
            if isinstance(name, bool) or not isinstance(name, str | int) or not _named(name):
                if isinstance(item, Mapping):
                    faults.expected(at(place, "building"), "the number of a building", name)
                continue
            if str(name) in found:
                first = found[str(name)][0]
                faults.add(
                    at(place, "building"), f"expected a building of its own; {quoted(name)} is {first}"
                )
                continue
            found[str(name)] = place, facade
        return found

    def survey(self, name: str, facade: Mapping[str, Any]) -> Survey:
        """The survey of one building."""
        faults = self.faults
        openings: list[Mapping[str, Any]] = []
        rects: list[Rect] = []
        for index, opening in enumerate(
            faults.sequence(facade.get("openings"), "openings", "a list of openings")
        ):
            own = at("openings", index)
            if not isinstance(opening, Mapping):
                faults.expected(own, "an opening (an object with kind and rect)", opening)
                continue
            fault = _rect_fault(opening)
            if fault:
                faults.add(f"{own}.rect", fault)
                continue
            if "kind" in opening:
                faults.text(opening["kind"], at(own, "kind"), "")
            openings.append(opening)
            rects.append(_rect(opening, own))
        extent = [max((rect[side] for rect in rects), default=0.0) for side in (2, 3)]
        given = (facade.get(field) for field in ("width", "height"))
        width, height = (
            default if value is None else faults.number(value, field, default, least=0)
            for value, field, default in zip(given, ("width", "height"), extent, strict=True)
        )
        values = self.document if isinstance(self.document, Mapping) else {}
        texts = [
            "" if values.get(key) is None else faults.text(values[key], key, "", empty=True)
            for key in ("source", "licence")
        ]
        return Survey(name, width, height, tuple(openings), *texts)


def _data_file(path: str | Path | None) -> Path:
    given = path if path is not None else os.environ.get(_VARIABLE)
    place = Path(given) if given else Path(__file__).resolve().parents[2] / "shared" / "data"
    file = place / _FILE if place.is_dir() or not given else place
    if file.is_file():
        return file
    raise SurveyError(
        f"The survey is not at {file}. It is not part of this package, for its licence is CC BY-SA 4.0: openings of "
        "buildings in Ingolstadt, taken from the CityGML models of savenow/lod3-road-space-models. Name the file, "
        f"or the folder that {_FILE} lies in, with load_survey(..., path=...) or in the environment variable "
        f"{_VARIABLE}."
    )


def _shapes(layout: Layout) -> list[tuple[int, PlacedShape]]:
    return [(i, shape) for i, shape in enumerate(layout.shapes) if shape.kind in OPENING_KINDS]


def _rect(opening: object, place: str) -> Rect:
    fault = _rect_fault(opening)
    if fault:
        raise SurveyError(f"{place}.rect: {fault}")
    assert isinstance(opening, Mapping)
    left, bottom, right, top = (float(v) for v in opening["rect"])
    return (left, bottom, right, top)


def _rect_fault(opening: object) -> str:
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


def _to_corner(rects: Sequence[Rect]) -> NDArray[np.float64]:
    """Rectangles, shape (n, 4), moved so that the lower left corner of all of them together is the origin."""
    if not rects:
        return np.zeros((0, 4))
    found = np.array(rects, float)
    left, bottom = found[:, :2].min(axis=0)
    moved: NDArray[np.float64] = found - np.array([left, bottom, left, bottom])
    return moved


def _overlaps(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Intersection over union of each rectangle of `a` (n, 4) with each of `b` (m, 4): shape (n, m)."""
    low = np.maximum(a[:, None, :2], b[None, :, :2])
    high = np.minimum(a[:, None, 2:], b[None, :, 2:])
    shared = np.clip(high - low, 0.0, None).prod(axis=2)
    union = _areas(a)[:, None] + _areas(b)[None, :] - shared
    overlaps: NDArray[np.float64] = shared / union
    return overlaps


def _areas(rects: NDArray[np.float64]) -> NDArray[np.float64]:
    areas: NDArray[np.float64] = (rects[:, 2:] - rects[:, :2]).prod(axis=1)
    return areas


def _as_rect(values: NDArray[np.float64]) -> Rect:
    left, bottom, right, top = (float(v) for v in values)
    return (left, bottom, right, top)
