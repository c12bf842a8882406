"""How near a layout comes to surveyed openings of a real building (docs/gallery.md).

>>> from facade_nb import gallery, solve
>>> from facade_nb.survey import compare, load_survey
>>> survey = load_survey("4018215")  # doctest: +SKIP
>>> round(compare(solve(gallery.load("ingolstadt-4018215")), survey.openings), 3)  # doctest: +SKIP
0.867
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import fsum, isfinite
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from .design.errors import FacadeError, nearest
from .solver.model.layout import Layout, PlacedShape, Rect

__all__ = ["OPENING_KINDS", "Pair", "Survey", "SurveyError", "compare", "load_survey", "match"]

OPENING_KINDS = frozenset({"window", "door"})
"""The kinds of shapes that a survey of openings can speak of."""

_VARIABLE = "FACADE_NB_DATA"
_FILE = "ingolstadt.json"


class SurveyError(FacadeError):
    """Survey data that are missing or cannot be read."""


@dataclass(frozen=True, slots=True)
class Survey:
    """The surveyed openings of one façade.

    Attributes
    ----------
    building
        Its number in the data.
    width, height
        Of all openings together, not of the wall, metres.
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

    Pairs that do not touch are left out: neither of them has a partner. Raises `SurveyError` as `compare` does.
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
        Where there is no such file, it is no survey, or has no such building.
    """
    file = _data_file(path)
    try:
        document = json.loads(file.read_text(encoding="utf-8"))
        found = {str(facade["building"]): facade for facade in document["facades"]}
    except OSError as error:
        raise SurveyError(f"{file}: cannot be read: {error.strerror}") from None
    except (ValueError, KeyError, TypeError) as error:
        raise SurveyError(
            f"{file}: expected a survey, an object with facades that each have building and openings; "
            f"found something else ({type(error).__name__}: {error})"
        ) from None
    facade = found.get(str(building))
    if facade is None:
        listed = ", ".join(found) or "there is none"
        hint = nearest(str(building), found)
        raise SurveyError(f"{file}: expected a building of the survey ({listed}); found {building!r}{hint}")
    openings = tuple(facade.get("openings", ()))
    rects = [
        _rect(opening, f"{file}: building {building}: openings[{i}]") for i, opening in enumerate(openings)
    ]
    return Survey(
        str(building),
        float(facade.get("width", max((r[2] for r in rects), default=0.0))),
        float(facade.get("height", max((r[3] for r in rects), default=0.0))),
        openings,
        str(document.get("source", "")),
        str(document.get("licence", "")),
    )


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
    rect = opening.get("rect") if isinstance(opening, Mapping) else None
    try:
        left, bottom, right, top = (float(v) for v in rect)  # type: ignore[union-attr]
    except (TypeError, ValueError):
        left = bottom = right = top = float("nan")
    if not all(map(isfinite, (left, bottom, right, top))) or left >= right or bottom >= top:
        raise SurveyError(f"{place}.rect: expected left < right and bottom < top in metres, found {rect!r}")
    return (left, bottom, right, top)


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
