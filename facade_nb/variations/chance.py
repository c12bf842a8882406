"""Random designs: values drawn from ranges by a seed."""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import replace
from numbers import Integral, Real
from typing import Any

from ..design.edit import with_canvas, with_counter, with_symbol
from ..design.errors import quoted
from ..design.model import Design
from .variants import checked_mapping, known_names

__all__ = ["vary"]

STEP = 0.01
"""Metres: lengths are whole multiples of it, as one would build."""

MOST = 1e6
"""What a range may reach: as much as any number of a design."""

Range = tuple[float, float]


def vary(
    design: Design,
    seed: int,
    *,
    width: Range | None = None,
    height: Range | None = None,
    counters: Mapping[str, tuple[int, int]] | None = None,
    sizes: Mapping[str, Range] | None = None,
) -> Design:
    """A design with values drawn at random, evenly, each from its range.

    Parameters
    ----------
    design
        The design; it stays as it is. Its own `seed`, which chooses among variants of shapes, becomes `seed`.
    seed
        The same seed gives the same design, on every machine.
    width, height
        Least and greatest extent of the canvas, metres; lengths are drawn in whole centimetres.
    counters
        For names of counters their least and greatest value.
    sizes
        For names of symbols their least and greatest preferred size, metres.

    Raises
    ------
    ValueError
        For a range that is none, or whose ends are not in order; a seed that is no whole number; a name that the
        design does not have.
    DesignError
        For a value that a design cannot have.
    """
    seed = _whole(seed)
    drawn = random.Random(f"facade_nb {seed}")  # a text: hashed by SHA-512, the same everywhere

    def length(place: str, ends: Range) -> float:
        low, high = _ends(place, ends)
        found = round(drawn.randint(round(low / STEP), round(high / STEP)) * STEP, 2)
        return min(max(found, low), high)  # an end between two centimetres is not passed

    names = known_names(design)
    if width is not None:
        design = with_canvas(design, width=length("width", width))
    if height is not None:
        design = with_canvas(design, height=length("height", height))
    for name, counts in checked_mapping("vary", "counters", counters).items():
        names.check("vary", "counters", name)
        least, most = map(int, _ends(f"counters: {quoted(name)}", counts, whole=True))
        design = with_counter(design, name, value=drawn.randint(least, most))
    for name, ends in checked_mapping("vary", "sizes", sizes).items():
        names.check("vary", "sizes", name)
        design = with_symbol(design, name, size=length(f"sizes: {quoted(name)}", ends))
    return replace(design, seed=seed)


def _whole(seed: object) -> int:
    """A seed, or ValueError."""
    if not isinstance(seed, Integral):
        raise ValueError(f"vary: seed: expected a whole number, found {seed!r:.80}")
    return int(seed)


def _ends(place: str, ends: Any, *, whole: bool = False) -> Range:
    """The ends of a range, or ValueError."""
    try:
        low, high = ends
    except (TypeError, ValueError):
        raise ValueError(f"vary: {place}: expected a range (least, greatest), found {ends!r:.80}") from None
    for end in (low, high):
        if not isinstance(end, Real) or not abs(end) <= MOST:  # type: ignore[operator]
            raise ValueError(f"vary: {place}: expected two finite numbers, found {ends!r:.80}")
        if whole and not float(end).is_integer():
            raise ValueError(f"vary: {place}: expected whole numbers, found {ends!r:.80}")
    if not low <= high:
        raise ValueError(
            f"vary: {place}: expected a range from its least to its greatest value, found {ends!r}"
        )
    return float(low), float(high)
