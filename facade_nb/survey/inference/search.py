"""The simplest order of a façade that is near enough: tolerances are tried, then symbols merged while it pays.

What is near enough hangs on what can be had. Half a letter for each opening is worth some agreement; where that is out
of reach, agreement is worth more letters.
"""

from __future__ import annotations

from collections import Counter as Tally
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .fitting import Axis, Names, agreement, count_letters, fit, measured, named
from .grouping import groupings, looser
from .structure import Grouping, Line, Opening, Structure, arranged, corner

__all__ = ["SYMBOL", "Order", "search"]

_FEW = 0.5
"""So many letters an opening are few: what a design of repeats and reflections comes to on a façade that has them."""

_TOLERANCES = (0.02, 0.05, 0.1, 0.2, 0.4)
"""Sizes that differ by no more may be one, metres. All are tried."""
_SYMMETRIC = 3.0
"""Halves of a line mirror each other where they differ by no more than this times the tolerance."""
_LOOSENED = 6
"""So many of the best structures are tried at once with openings that join what they are further from."""
_STARTS = 3
"""No more orders of any one structure are simplified further."""
_ALIKE = 0.5
"""What takes the name of another differs from it by no more than this part of the larger."""
_TRIALS = 20_000
"""So many letters are looked at in simplifying a line, all trials together."""

SYMBOL, _EXCEPTION, _LINE = 0.5, 0.25, 0.5
"""What a symbol, an exception and a line weigh, in letters."""
_FAR = 60.0
"""The same, of what lacks to what is aimed at."""
_FAIR, _POOR = 0.7, 6.0
"""No opening should agree less than that; what one costs that agrees in nothing, in letters."""


@dataclass(frozen=True, slots=True)
class _Aim:
    """What is asked of a design.

    It agrees with the survey to `near` at least, where that can be. To agree in nothing costs `error`, and each letter
    beyond half an opening costs `over` more, both in letters an opening. So often, `rounds`, openings are let join what
    they are further from; so many orders, `starts`, are simplified.
    """

    near: float
    error: float
    over: float = 0.0
    rounds: int = 2
    starts: int = 12


_USUAL, _SHORT, _FAITHFUL = (
    _Aim(0.903, 1.0),
    _Aim(0.82, 10.0, 30.0, starts=6),
    _Aim(0.935, 4.0, rounds=0, starts=4),
)
"""What is aimed at first; where that takes more letters than half; where half cannot be had either."""
_FAR_OVER = 0.75
"""Where the usual design has more letters than that, an opening, beyond half, half is not tried."""


@dataclass(frozen=True, slots=True)
class Order:
    """A structure with both axes fitted.

    `agreement` is the mean intersection over union, `size` what letters and all else weigh, in letters. Symbols may be
    shared while the agreement stays at `near` or more.
    """

    structure: Structure
    x: Axis
    y: Axis
    agreement: float
    size: float
    near: float = 1.0
    error: float = 1.0

    @property
    def over(self) -> float:
        """Letters beyond half an opening each."""
        return max(0.0, self.x.letters + self.y.letters - _FEW * len(self.structure.cells))

    def cost(self, aim: _Aim) -> float:
        """What is least in the order that suits an aim best."""
        size = (self.size + aim.over * self.over) / len(self.structure.cells)
        return round(size + aim.error * (1 - self.agreement) + _FAR * max(0.0, aim.near - self.agreement), 9)


def search(openings: Sequence[Opening], width: float, height: float) -> Order:
    """The order that costs least."""
    searched = _Search(openings, width, height)
    best = searched.best(_USUAL)
    if not best.over:
        return replace(best, near=_USUAL.near)
    if best.over <= _FAR_OVER * len(openings):
        short = searched.best(_SHORT)
        if not short.over and short.agreement >= _SHORT.near:
            return replace(
                short, near=short.agreement
            )  # symbols are few enough: no agreement is given for one less
    return replace(searched.best(_FAITHFUL), near=_FAITHFUL.near, error=_FAITHFUL.error)


class _Search:
    """All orders found so far of some openings; what an aim asks for beyond them is added."""

    def __init__(self, openings: Sequence[Opening], width: float, height: float) -> None:
        self._openings = openings
        self._canvas = (width, height)
        self._target = corner(openings)
        self._found: list[Order] = []
        self._groups: dict[int, Grouping] = {}
        self._seen: dict[Structure, None] = {}
        self._loosened: set[int] = set()
        self._fitted: dict[tuple[int, bool, Names], Axis | None] = {}
        for grouping in groupings(openings):
            self._look(grouping)

    def best(self, aim: _Aim) -> Order:
        """The order that suits an aim best."""

        def cost(order: Order) -> float:
            return order.cost(aim)

        self._found.sort(key=cost)
        for _ in range(aim.rounds):
            for order in list(_different(self._found, _LOOSENED)):
                if id(order.structure) in self._loosened:
                    continue
                self._loosened.add(id(order.structure))
                for grouping in looser(self._openings, self._groups[id(order.structure)], order.structure):
                    self._look(grouping)
            self._found.sort(key=cost)
        best = self._found[0]
        for order in list(_different(self._found, aim.starts, _STARTS)):
            polished = self._polished(order, aim)
            if polished.cost(aim) < best.cost(aim) - 1e-9:
                best = polished
        return best

    def _look(self, grouping: Grouping) -> None:
        """Add the orders of a grouping."""
        structure = arranged(self._openings, grouping, *self._canvas)
        if structure in self._seen:
            return
        self._seen[structure] = None
        self._groups[id(structure)] = grouping
        if not self._found:  # the exact one, which is there whatever else cannot be fitted
            self._found.append(self._order(structure, measured(structure.x), measured(structure.y)))
        along = list(_candidates(structure.y, self._canvas[1], mirrors=False))
        for x in _candidates(structure.x, self._canvas[0], mirrors=True):
            self._found.extend(self._order(structure, x, y) for y in along)

    def _order(self, structure: Structure, x: Axis, y: Axis) -> Order:
        each = agreement(structure, self._target, x, y)
        size = x.letters + y.letters + SYMBOL * (x.symbols + y.symbols) + _EXCEPTION * structure.exceptions
        size += (
            _LINE * (len(structure.x) + len(structure.y)) + _POOR * np.clip(1 - each / _FAIR, 0.0, None).sum()
        )
        return Order(structure, x, y, float(each.mean()), float(size))

    def _polished(self, order: Order, aim: _Aim) -> Order:
        """Simplify both axes, in turn, while it pays."""
        left = dict.fromkeys("xy", _TRIALS)
        while True:
            before = order.cost(aim)
            for axis in "xy":
                while left[axis] > 0:
                    best, left[axis] = self._step(order, aim, axis == "x", left[axis])
                    if best is order:
                        break
                    order = best
            if order.cost(aim) >= before:
                return order

    def _step(self, order: Order, aim: _Aim, mirrors: bool, left: int) -> tuple[Order, int]:
        """The best order with other names along one axis, or the order; how many letters may still be looked at."""
        best = order
        lines, own = (order.structure.x, order.x) if mirrors else (order.structure.y, order.y)
        weight = _weight(lines, own.names, mirrors)
        for names in _simpler(lines, own):
            left -= sum(map(len, names))
            if order.agreement < aim.near or _weight(lines, names, mirrors) < weight:
                fitted = self._fit(order.structure, names, mirrors)
                if fitted:
                    x, y = (fitted, order.y) if mirrors else (order.x, fitted)
                    other = self._order(order.structure, x, y)
                    if other.cost(aim) < best.cost(aim) - 1e-9:
                        best = other
            if left <= 0:
                break
        return best, left

    def _fit(self, structure: Structure, names: Names, mirrors: bool) -> Axis | None:
        """The axis of a structure with its tokens so named, fitted once for all aims."""
        key = (id(structure), mirrors, names)
        if key not in self._fitted:
            lines, canvas = (structure.x, self._canvas[0]) if mirrors else (structure.y, self._canvas[1])
            self._fitted[key] = fit(lines, names, canvas, mirrors=mirrors)
        return self._fitted[key]


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
