"""Solved fronts: a house has one where its only wall on the street is of a size that the solved layout may take."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .chance import Floats
from .finishing import Pairs
from .looks import lists_of
from .rings import Ints
from .styles import Style

__all__ = ["fit_fronts", "single_fronts"]

NEAR = 4.5
"""A solved front may be so much higher or lower than the house would be, metres."""


def fit_fronts(
    style: NDArray[np.int32],
    wanted: NDArray[np.bool_],
    front: Floats,
    height: Floats,
    pairs: Pairs,
    styles: Sequence[Style],
    random: Floats,
) -> NDArray[np.int32]:
    """Styles of which some are solved ones; no two that touch or see each other have the same.

    Parameters
    ----------
    wanted
        (b,) whether a solved front would be welcome.
    front
        (b,) width of the only wall on the street, metres; 0 where there is none, or are several.
    height
        (b,) how high its walls would be, metres.
    random
        (b,) from 0 to below 1: which of those that fit.
    """
    solved = [(k, one, one.eaves(one.storeys[0])) for k, one in enumerate(styles) if one.widths is not None]
    if not solved:
        return style
    chosen = style.copy()
    begin, near = lists_of(np.concatenate([pairs.beside, pairs.near]), len(style))
    for b in np.flatnonzero(wanted & (front > 0)).tolist():
        taken = {int(chosen[other]) for other in near[begin[b] : begin[b + 1]]}
        width, high = float(front[b]), float(height[b])
        fits = [
            k
            for k, one, eaves in solved
            if k not in taken and abs(eaves - high) <= NEAR and one.suits(width, eaves)
        ]
        if fits:
            chosen[b] = fits[int(random[b] * len(fits))]
    return chosen


def single_fronts(street: NDArray[np.bool_], span: Floats, building: Ints, count: int) -> Floats:
    """Width of the only wall on the street of each building; 0 where there is none, or are several."""
    number = np.bincount(building[street], minlength=count)
    width = np.bincount(building[street], weights=np.round(span[street], 3), minlength=count)
    return np.where(number == 1, width, 0.0)
