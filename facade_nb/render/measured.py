"""What dimensions measure: boundaries along an axis, within what walls fill of it."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

from ..design.model import Axis
from ..solver.model.layout import Layout

__all__ = ["LEAST", "Chain", "ranges", "within"]

LEAST = 1e-3
"""Metres: closer boundaries are one."""

Chain = tuple[tuple[float, float], ...]
"""What a chain measures, in order: from where to where, metres. What no wall fills lies between two of them."""


def ranges(layout: Layout, axis: Axis) -> Chain:
    """What the walls fill along an axis: the canvas, or each wall of a building beside the others.

    A gap is a column that all rows of a group leave empty and where no shape stands.
    """
    size = layout.canvas.width if axis == "x" else layout.canvas.height
    low = 0 if axis == "x" else 1
    found, at = [], 0.0
    for start, end in sorted(
        span
        for group in layout.along(axis).groups.values()
        if group.rows
        for k, span in enumerate(pairwise(group.columns))
        if span[1] - span[0] >= LEAST and not any(row.columns[k] for row in group.rows)
    ):
        if any(
            shape.rect[low] < end - LEAST and shape.rect[low + 2] > start + LEAST for shape in layout.shapes
        ):
            continue
        if start - at >= LEAST:
            found.append((at, start))
        at = end
    return (*found, (at, size)) if size - at >= LEAST else tuple(found)


def within(walls: Chain, stops: Iterable[float]) -> Chain:
    """What lies between boundaries, as far as walls fill it: each wall from its beginning to its end."""
    inner = list(stops)
    return tuple(
        span
        for start, end in walls
        for span in pairwise((start, *(s for s in inner if start + LEAST < s < end - LEAST), end))
    )
