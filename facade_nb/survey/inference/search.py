"""The simplest order of a façade that is near enough: tolerances are tried, then symbols merged while it pays."""

from __future__ import annotations

from collections import Counter as Tally
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .fitting import Axis, Names, agreement, count_letters, fit, measured, named
from .grouping import groupings, looser
from .structure import Grouping, Line, Opening, Structure, arranged, corner

__all__ = ["ERROR", "NEAR", "SYMBOL", "Order", "search"]

NEAR = 0.903
"""A design agrees with the survey at least so well where that can be."""

_TOLERANCES = (0.02, 0.05, 0.1, 0.2, 0.4)
"""Sizes that differ by no more may be one, metres. All are tried."""
_SYMMETRIC = 3.0
"""Halves of a line mirror each other where they differ by no more than this times the tolerance."""
_ROUNDS, _LOOSENED = 2, 6
"""So often so many of the best structures are tried with openings that join what they are further from."""
_POLISHED, _STARTS = 12, 3
"""So many of the best orders are simplified further, of any one structure no more than the second."""
_ALIKE = 0.5
"""What takes the name of another differs from it by no more than this part of the larger."""
_TRIALS = 20_000
"""So many letters are looked at in simplifying a line, all trials together."""

SYMBOL, _EXCEPTION, _LINE = 0.5, 0.25, 0.5
"""What a symbol, an exception and a line weigh, in letters."""
ERROR = 1.0
"""What it costs, in letters an opening, to agree in nothing."""
_FAR = 60.0
"""The same, of what lacks to `NEAR`."""


_FAIR, _POOR = 0.7, 6.0
"""No opening should agree less than that; what one costs that agrees in nothing, in letters."""


@dataclass(frozen=True, slots=True)
class Order:
    """A structure with both axes fitted; `agreement` is the mean intersection over union, `cost` what is least."""

    structure: Structure
    x: Axis
    y: Axis
    agreement: float
    cost: float


def search(openings: Sequence[Opening], width: float, height: float) -> Order:
    """The order that costs least."""
    target = corner(openings)
    found: list[Order] = []
    groups: dict[int, Grouping] = {}
    seen: dict[Structure, None] = {}

    def look(grouping: Grouping) -> None:
        structure = arranged(openings, grouping, width, height)
        if structure in seen:
            return
        seen[structure] = None
        groups[id(structure)] = grouping
        if not found:  # the exact one, which is there whatever else cannot be fitted
            found.append(_order(structure, target, measured(structure.x), measured(structure.y)))
        along = list(_candidates(structure.y, height, mirrors=False))
        for x in _candidates(structure.x, width, mirrors=True):
            found.extend(_order(structure, target, x, y) for y in along)

    for grouping in groupings(openings):
        look(grouping)
    found.sort(key=lambda order: order.cost)
    done: set[int] = set()
    for _ in range(_ROUNDS):
        for order in list(_different(found, _LOOSENED)):
            if id(order.structure) in done:
                continue
            done.add(id(order.structure))
            for grouping in looser(openings, groups[id(order.structure)], order.structure):
                look(grouping)
        found.sort(key=lambda order: order.cost)
    best = found[0]
    for order in list(_different(found, _POLISHED, _STARTS)):
        polished = _polished(order, target, width, height)
        if polished.cost < best.cost - 1e-9:
            best = polished
    return best


def _different(found: Sequence[Order], number: int, each: int = 1) -> Iterator[Order]:
    """The first orders of a list, of any one structure no more than `each`."""
    seen: Tally[int] = Tally()
    names: set[tuple[int, Names, Names]] = set()
    for order in found:
        own = id(order.structure)
        if seen[own] < each and (own, order.x.names, order.y.names) not in names:
            names.add((own, order.x.names, order.y.names))
            seen[own] += 1
            yield order
            if seen.total() == number:
                return


def _candidates(lines: Sequence[Line], canvas: float, *, mirrors: bool) -> Iterator[Axis]:
    seen: set[Names] = set()
    for tolerance in _TOLERANCES:
        for symmetric in (0.0, _SYMMETRIC * tolerance):
            names = named(lines, tolerance, symmetric)
            if names not in seen:
                seen.add(names)
                axis = fit(lines, names, canvas, mirrors=mirrors)
                if axis:
                    yield axis


def _order(structure: Structure, target: NDArray[np.float64], x: Axis, y: Axis) -> Order:
    each = agreement(structure, target, x, y)
    near = float(each.mean())
    size = x.letters + y.letters + SYMBOL * (x.symbols + y.symbols) + _EXCEPTION * structure.exceptions
    size += _LINE * (len(structure.x) + len(structure.y)) + _POOR * np.clip(1 - each / _FAIR, 0.0, None).sum()
    cost = size / len(target) + ERROR * (1 - near) + _FAR * max(0.0, NEAR - near)
    return Order(structure, x, y, near, round(float(cost), 9))


def _polished(order: Order, target: NDArray[np.float64], width: float, height: float) -> Order:
    """Simplify both axes, in turn, while it pays."""
    left = dict.fromkeys("xy", _TRIALS)
    while True:
        before = order.cost
        for axis in "xy":
            while left[axis] > 0:
                best = order
                lines = order.structure.x if axis == "x" else order.structure.y
                own = order.x if axis == "x" else order.y
                mirrors = axis == "x"
                for names in _simpler(lines, own):
                    left[axis] -= sum(map(len, names))
                    if order.agreement >= NEAR and _weight(lines, names, mirrors) >= _weight(
                        lines, own.names, mirrors
                    ):
                        continue
                    fitted = fit(lines, names, width if mirrors else height, mirrors=mirrors)
                    if fitted:
                        x, y = (fitted, order.y) if axis == "x" else (order.x, fitted)
                        other = _order(order.structure, target, x, y)
                        if other.cost < best.cost - 1e-9:
                            best = other
                    if left[axis] <= 0:
                        break
                if best is order:
                    break
                order = best
        if order.cost >= before:
            return order


def _weight(lines: Sequence[Line], names: Names, mirrors: bool) -> float:
    """What symbols and letters of some lines weigh."""
    symbols = len({s for word in names for s in word})
    return SYMBOL * symbols + count_letters(lines, names, mirrors=mirrors)


def _simpler(lines: Sequence[Line], axis: Axis) -> Iterator[Names]:
    """Other names of the tokens, among which shorter patterns may be. What takes another's name is about as large."""
    names, sizes = axis.names, axis.sizes
    categories: dict[int, str] = {}
    for line, word in zip(lines, names, strict=True):
        categories.update(zip(word, line.categories, strict=True))
    symbols = sorted(categories)

    def alike(a: int, b: int) -> bool:
        near = abs(sizes[a] - sizes[b]) <= _ALIKE * max(sizes[a], sizes[b])
        return near and categories[a] == categories[b]

    for i, a in enumerate(symbols):
        for b in symbols[i + 1 :]:
            if alike(a, b):
                yield tuple(tuple(a if s == b else s for s in word) for word in names)
    seen = set(names)
    for regular in (_regular, _partly_regular):
        for n, (line, word) in enumerate(zip(lines, names, strict=True)):
            for other in regular(line, word):
                if other not in seen and all(map(alike, word, other)):
                    seen.add(other)
                    yield (*names[:n], other, *names[n + 1 :])
    for n, word in enumerate(names):
        for i, own in enumerate(word):
            for symbol in symbols:
                if symbol != own and alike(symbol, own):
                    yield (*names[:n], (*word[:i], symbol, *word[i + 1 :]), *names[n + 1 :])


def _partly_regular(line: Line, word: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    """The word with a part of it made symmetric, or made to repeat the part before or after it."""
    kinds = line.categories
    for length in range(len(word), 2, -1):
        for i in range(len(word) - length + 1):
            j = i + length
            if kinds[i:j] == kinds[i:j][::-1]:
                half = length // 2
                low, high = word[i : i + half], word[j - half : j]
                yield (*word[: j - half], *low[::-1], *word[j:])
                yield (*word[:i], *high[::-1], *word[i + half :])
            if length % 2 == 0 and kinds[i : i + length // 2] == kinds[i + length // 2 : j]:
                half = length // 2
                yield (*word[: i + half], *word[i : i + half], *word[j:])
                yield (*word[:i], *word[i + half : j], *word[i + half :])


def _regular(line: Line, word: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    """The word made symmetric, from its left and from its right, and made to repeat."""
    kinds = line.categories
    if kinds == kinds[::-1]:
        half = len(word) // 2
        rest = len(word) - half
        yield word[:rest] + word[:half][::-1]
        yield word[::-1][:rest] + word[::-1][:half][::-1]
    for period in (2, 4, 6, 8):
        for start in (0, 1, 2, 3):
            for end in (len(word), len(word) - 1, len(word) - 2, len(word) - 3):
                if end - start < 2 * period:
                    continue
                other = list(word)
                for i in range(start + period, end):
                    if kinds[i] != kinds[i - period]:
                        break
                    other[i] = other[i - period]
                else:
                    yield tuple(other)
