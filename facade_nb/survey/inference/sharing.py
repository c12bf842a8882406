"""Symbols that both axes have: a gap across and one along of about the same size are one, where little is lost by that.

Nothing ties the axes: each is solved alone, so that what is wider is no higher. Only the preferred size is one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .fitting import Axis, agreement, solved
from .search import SYMBOL, Order
from .structure import Opening, corner

__all__ = ["Shared", "shared"]

Shared = dict[int, int]
"""For symbols along: the symbol across that each is one with."""

_ALIKE = 0.12
"""Sizes that differ by more, as a part of the larger, are not tried."""


def shared(
    order: Order,
    openings: Sequence[Opening],
    canvas: tuple[float, float],
    kinds: tuple[Sequence[object], Sequence[object]],
) -> tuple[Order, Shared]:
    """The order with the symbols of its axes made one while that pays, and which are; only those of the same kind.

    A symbol less is weighed against what is lost in agreement, as in the search; the nearest sizes are tried first.
    """
    target = corner(openings)
    found: Shared = {}
    for x, y in _pairs(order, kinds):
        if y in found or x in found.values():
            continue
        other = _fitted(order, target, found | {y: x}, canvas)
        if other is None:
            continue
        lost = order.agreement - other.agreement
        if other.agreement >= order.near and order.error * lost < SYMBOL / len(openings):
            order, found = other, found | {y: x}
    return order, found


def _pairs(order: Order, kinds: tuple[Sequence[object], Sequence[object]]) -> Iterator[tuple[int, int]]:
    """Symbols of both axes that may be one, those of the nearest sizes first."""
    apart = sorted(
        (round(abs(a - b) / max(a, b), 6), x, y)
        for x, a in enumerate(order.x.sizes)
        for y, b in enumerate(order.y.sizes)
        if kinds[0][x] == kinds[1][y] and abs(a - b) <= _ALIKE * max(a, b)
    )
    return ((x, y) for _, x, y in apart)


def _fitted(
    order: Order, target: NDArray[np.float64], pairs: Shared, canvas: tuple[float, float]
) -> Order | None:
    """Both axes fitted at once with some symbols of theirs in common; None where that fails."""
    of_x, of_y = order.x.names, order.y.names
    first = order.x.symbols
    numbers = [pairs.get(y, first + y) for y in range(order.y.symbols)]
    names = (*of_x, *(tuple(numbers[s] for s in word) for word in of_y))
    lines = (*order.structure.x, *order.structure.y)
    canvases = [canvas[0]] * len(of_x) + [canvas[1]] * len(of_y)
    dense = {s: n for n, s in enumerate(dict.fromkeys(s for word in names for s in word))}
    fitted = solved(lines, tuple(tuple(dense[s] for s in word) for word in names), canvases)
    if fitted is None:
        return None
    sizes, spans = fitted
    x = Axis(of_x, tuple(sizes[dense[s]] for s in range(first)), spans[: len(of_x)], order.x.letters)
    y = Axis(of_y, tuple(sizes[dense[s]] for s in numbers), spans[len(of_x) :], order.y.letters)
    return replace(order, x=x, y=y, agreement=float(agreement(order.structure, target, x, y).mean()))
