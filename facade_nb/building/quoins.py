"""Quoins: a strip of a design of its own, folded around a corner, half on either wall."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ..solver.model.layout import Layout, PlacedShape

__all__ = ["folded"]

_LEAST = 1e-6


def folded(strip: Layout, name: str, length: float, eaves: float, *, left: bool) -> Iterator[PlacedShape]:
    """The shapes of a strip that lie on one wall.

    Parameters
    ----------
    strip
        Solved across both walls; the corner is in its middle.
    name
        Of the corner: shapes stand on a layer named after it.
    length
        Of the wall, metres.
    eaves
        Where they end, metres up.
    left
        Whether the corner is at the wall's left end: then the strip's right half lies on it.
    """
    fold = strip.canvas.width / 2
    low, high, shift = (fold, 2 * fold, -fold) if left else (0.0, fold, length - fold)
    for shape in strip.shapes:
        a, bottom, b, top = shape.rect
        a, b = max(a, low), min(b, high)
        top = min(top, eaves)
        if b - a <= _LEAST or top - bottom <= _LEAST:
            continue
        start = length if not left and a + shift > length - _LEAST else a + shift
        end = length if not left and abs(b - high) <= _LEAST else b + shift
        start = 0.0 if left and abs(a - low) <= _LEAST else start
        yield replace(shape, layer=f"{name}: {shape.layer}", rect=(start, bottom, end, top))
