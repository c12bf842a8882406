"""How near a layout comes to surveyed openings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import fsum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..solver.model.layout import Layout, PlacedShape, Rect
from .openings import OPENING_KINDS, rect_of

__all__ = ["Pair", "compare", "match"]


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
    surveyed = _to_corner([rect_of(opening, f"openings[{i}]") for i, opening in enumerate(openings)])
    solved = _to_corner([shape.rect for _, shape in shapes])
    if not len(surveyed) or not len(solved):
        return ()
    from scipy.optimize import linear_sum_assignment  # half a second, which no notebook need wait for

    scores = _overlaps(surveyed, solved)
    rows, columns = linear_sum_assignment(scores, maximize=True)
    return tuple(
        Pair(int(i), shapes[j][0], _as_rect(surveyed[i]), _as_rect(solved[j]), float(scores[i, j]))
        for i, j in zip(rows, columns, strict=True)
        if scores[i, j] > 0
    )


def _shapes(layout: Layout) -> list[tuple[int, PlacedShape]]:
    return [(i, shape) for i, shape in enumerate(layout.shapes) if shape.kind in OPENING_KINDS]


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
