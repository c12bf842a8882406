"""Many polygons at once: what a drawing has hundreds of is cut, and written, in a few steps for all of them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .annotate import Frame

__all__ = ["clip_all", "hundredths", "polygons_path", "segments_path", "texts"]


def clip_all(polygons: NDArray[np.float64], boxes: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Convex polygons of equally many corners, (n, m, 2), each cut to its box x0, y0, x1, y1.

    What comes of each is what `ink.clip` makes of it.
    """
    count, corners = polygons.shape[:2]
    points = np.concatenate([polygons, np.zeros((count, 4, 2))], axis=1)  # a cut adds one corner at most
    many = np.full(count, corners)
    numbers = np.arange(corners + 4)
    for axis, side, sign in ((0, 0, 1), (0, 2, -1), (1, 1, 1), (1, 3, -1)):
        beyond = sign * (points[:, :, axis] - boxes[:, side, None]) < 0
        rows = np.flatnonzero((beyond & (numbers < many[:, None])).any(axis=1))
        if not len(rows):
            continue
        own, there = points[rows], numbers < many[rows, None]
        now = sign * (own[:, :, axis] - boxes[rows, side, None])
        last = many[rows] - 1
        before = np.roll(own, 1, axis=1)
        before[:, 0] = own[np.arange(len(rows)), last]
        was = np.roll(now, 1, axis=1)
        was[:, 0] = now[np.arange(len(rows)), last]
        inside = (now >= 0) & there
        crosses = there & ((now >= 0) != (was >= 0))
        t = np.divide(was, was - now, out=np.zeros_like(was), where=crosses)[:, :, None]
        # Of each side of the polygon: where it crosses the box's side, and the corner that it leads to.
        both = np.stack([before + t * (own - before), own], axis=2).reshape(len(rows), -1, 2)
        kept = np.stack([crosses, inside], axis=2).reshape(len(rows), -1)
        order = np.argsort(~kept, axis=1, kind="stable")[:, : corners + 4]
        points[rows] = np.take_along_axis(both, order[:, :, None], 1)
        many[rows] = kept.sum(axis=1)
    return [own[:n] for own, n in zip(points, many.tolist(), strict=True)]


def polygons_path(polygons: Sequence[NDArray[np.float64]], frame: Frame) -> str:
    """Closed polygons, in metres, as the data of one path, as short as it gets: to a hundredth of a pixel."""
    if not polygons:
        return ""
    points = np.concatenate(polygons)
    xs, ys = hundredths(*frame.at(*points.T))
    ends = np.cumsum([len(polygon) for polygon in polygons]) - 1
    begins = np.zeros(len(xs), bool)
    begins[0] = begins[ends[:-1] + 1] = True
    upright, level = np.append(False, xs[1:] == xs[:-1]), np.append(False, ys[1:] == ys[:-1])
    # What is written of each point: a letter, x, a blank, y, and an end.
    text = np.full((len(xs), 5), "", object)
    text[:, 0] = np.where(begins, "M", np.where(upright, np.where(level, "", "V"), np.where(level, "H", "L")))
    across, along = begins | ~upright, begins | ~level
    text[across, 1] = texts(xs[across])
    text[across & along, 2] = " "
    text[along, 3] = texts(ys[along])
    text[ends, 4] = "z"
    return "".join(text.ravel().tolist())


def hundredths(*pixels: Any) -> list[NDArray[np.int64]]:
    """Arrays of pixels as whole hundredths."""
    return [np.rint(100 * own).astype(np.int64) for own in pixels]


def texts(numbers: NDArray[np.int64]) -> list[str]:
    """Hundredths as decimal numbers."""
    return [*map(_text, numbers.tolist())]


def segments_path(segments: Sequence[tuple[float, float, float, float]], frame: Frame) -> str:
    """Upright and level lines, in metres, as the data of one path."""
    ends = np.array(segments)
    ways = hundredths(*frame.at(*ends[:, :2].T), *frame.at(*ends[:, 2:].T))
    upright = (ways[0] == ways[2]).tolist()
    return "".join(
        [
            f"M{x} {y}V{below}" if down else f"M{x} {y}H{right}"
            for x, y, right, below, down in zip(*map(texts, ways), upright, strict=True)
        ]
    )


@lru_cache(maxsize=1 << 15)
def _text(hundredths: int) -> str:
    """Hundredths as a decimal number."""
    whole, rest = divmod(abs(hundredths), 100)
    sign = "-" if hundredths < 0 else ""
    return f"{sign}{whole}.{rest:02}".rstrip("0") if rest else f"{sign}{whole}"
