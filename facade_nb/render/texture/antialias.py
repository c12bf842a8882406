"""Antialiasing that takes care of split boundaries, which the texture paper leaves open (its section 6).

Inside a part of a split, a pixel needs one sample: tiles are read in the size that fits it. Only where a boundary
crosses the pixel is one sample wrong. An evaluator knows where: on its way it passes every boundary next to the pixel,
as an end of the part that it goes into, and keeps the least distance. A part thinner than a pixel is noticed as well,
since it begins where its neighbour ends. So the pixels near a boundary, and they alone, are sampled again, at
16 places of which no two share a column or a row: boundaries are level or upright, and so are seen in 16 grades.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...design.errors import nearest
from .question import Question, Surface
from .shot import Painter, Shot
from .view import Looks, Sight

__all__ = ["ANTIALIAS", "averaged", "check_kind", "smoothed"]

ANTIALIAS = ("none", "adaptive", "supersample")
"""One sample at the centre, tiles in full size; more samples near boundaries; 16 samples everywhere."""

_PLACES = tuple(((i + 0.5) / 16, (int(f"{i:04b}"[::-1], 2) + 0.5) / 16) for i in range(16))  # Hammersley's
_SHARE = 0.25
"""Of a pixel's width: how large a sample is."""

_REACH = np.float32(0.75)
"""How near a boundary has to be, in pixels: half a diagonal, and a little."""


def smoothed(
    painter: Painter, question: Question, sight: Sight, how: str = "adaptive"
) -> NDArray[np.float32]:
    """Colours (n, 4) of a view's pixels, multiplied by alpha.

    Raises
    ------
    ValueError
        If `how` is not one of `ANTIALIAS`.
    """
    return averaged(painter, question, sight, how, color_only=True).surface.color


def averaged(
    painter: Painter, question: Question, sight: Sight, how: str = "adaptive", color_only: bool = False
) -> Shot:
    """What a view's pixels show, each the mean of its samples: colour, normal, specular value, and shade of relief.

    Light is worked out from the means, so a picture at an hour costs no more samples. Rules are of no use there.
    """
    check_kind(how)
    if how == "none":
        return painter.paint(question, sight, color_only=color_only)
    if how == "supersample":
        return _mean(painter, question, sight, None, color_only)
    shot = painter.paint(question, sight, mips=True, color_only=color_only)
    chosen = np.flatnonzero((shot.margin < _REACH) | _outline(sight))
    if not len(chosen):
        return shot
    finer = _mean(painter, question, sight, chosen, color_only)
    surface = Surface(*(_put(*pair, chosen) for pair in zip(shot.surface, finer.surface, strict=True)))
    shade = None
    if shot.shade is not None and finer.shade is not None:
        shade = _put(shot.shade, finer.shade, chosen)
    return replace(shot, surface=surface, shade=shade)


def _put(whole: NDArray[Any], part: NDArray[Any], chosen: NDArray[np.intp]) -> NDArray[Any]:
    whole = whole.copy()
    whole[chosen] = part
    return whole


def check_kind(how: str) -> None:
    """Raise `ValueError` for what is not one of `ANTIALIAS`."""
    if how not in ANTIALIAS:
        known = ", ".join(ANTIALIAS)
        raise ValueError(f"antialias: expected one of {known}; found {how!r}{nearest(how, ANTIALIAS)}")


def _outline(sight: Sight) -> NDArray[np.bool_]:
    """Pixels next to the façade's outline (n,): one is on it where another beside it is not."""
    width, height = sight.pixels
    if sight.eye is None and sight.window == (0.0, 0.0, *sight.size):  # it fills the picture
        return np.zeros(width * height, bool)
    around = sight.crop(-1, -1, width + 2, height + 2)
    inside = around.looks().inside.reshape(height + 2, width + 2)
    edge = np.zeros_like(inside)
    for axis in (0, 1):
        change = np.diff(inside, axis=axis)
        ahead, behind = [slice(None), slice(None)], [slice(None), slice(None)]
        ahead[axis], behind[axis] = slice(1, None), slice(None, -1)
        edge[tuple(ahead)] |= change
        edge[tuple(behind)] |= change
    return edge[1:-1, 1:-1].ravel()


def _mean(
    painter: Painter, question: Question, sight: Sight, chosen: NDArray[np.intp] | None, color_only: bool
) -> Shot:
    """Means of 16 samples in each pixel; each reads tiles in the size that fits a sixteenth of it."""
    shots = None
    for place in _PLACES:
        looks = _finer(sight.looks(chosen, place))
        shot = painter.paint_at(question, looks, mips=True, color_only=color_only)
        own = [*shot.surface[:3], *(() if shot.shade is None else (shot.shade,))]
        shots = own if shots is None else [total + part for total, part in zip(shots, own, strict=True)]
    assert shots is not None
    color, normal, specular, *rest = (total * np.float32(1 / len(_PLACES)) for total in shots)
    return replace(
        shot, surface=Surface(color, normal, specular, shot.surface.rule), shade=rest[0] if rest else None
    )


def _finer(looks: Looks) -> Looks:
    return replace(looks, footprint=looks.footprint * np.float32(_SHARE), spread=looks.spread * _SHARE)
