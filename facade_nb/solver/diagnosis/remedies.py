"""Small changes that would give a design a layout, each tried before it is named."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from math import ceil, floor, inf, log10
from typing import NamedTuple

from ...design.edit import take
from ...design.errors import DesignError, Suggestion, quoted
from ...design.model import Axis, Counter, Design, Symbol
from .. import tuning
from ..budget import Stopped

__all__ = ["Remedies", "Tried", "Works", "nice", "relaxed", "size_of"]

_EXTENT: dict[Axis, str] = {"x": "width", "y": "height"}


class Tried(NamedTuple):
    """The layout of a changed design: solved sizes of its symbols, and values of its counters."""

    sizes: Mapping[str, float]
    counters: Mapping[str, int]


Works = Callable[[Design, float | None], Tried | None]
"""Solves a changed design, at a tolerance or the usual ones; None: it has no layout."""


class Remedies:
    """Tries changes until enough work, or the time that it has been given is over."""

    def __init__(self, design: Design, axis: Axis, works: Works) -> None:
        self.design, self.axis, self._works = design, axis, works
        self.over = False
        self._known: dict[tuple[tuple[str, ...], object], Tried | None] = {}

    def sizes(self, suggestion: Suggestion) -> Mapping[str, float] | None:
        """The solved sizes of the changed design; None where it has no layout, or the time is over."""
        found = self.tried(suggestion)
        return None if found is None else found.sizes

    def tried(self, suggestion: Suggestion) -> Tried | None:
        """What the changed design comes to; None where it has no layout, or the time is over."""
        key = (suggestion.path, suggestion.value)
        if key not in self._known and not self.over:
            try:
                self._known[key] = self._solved(suggestion)
            except Stopped:
                self.over = True
        return self._known.get(key)

    def _solved(self, suggestion: Suggestion) -> Tried | None:
        if suggestion.path == ("tolerances",):
            return self._works(self.design, float(suggestion.value[-1]))
        try:
            changed = take(self.design, suggestion)
        except DesignError:
            return None
        return self._works(changed, None)

    def working(self, suggestions: Iterable[Suggestion], most: int = 1) -> list[Suggestion]:
        """The first of them that work."""
        found: list[Suggestion] = []
        for suggestion in suggestions:
            if self.sizes(suggestion) is not None:
                found.append(suggestion)
            if self.over or len(found) == most:
                break
        return found

    def canvas(self, sizes: Iterable[float] = ()) -> list[Suggestion]:
        """The canvas nearest to its size that works: one of those given, or else one found by trying."""
        now = self.design.canvas.along(self.axis)
        given = sorted({nice(size) for size in sizes if size > 0}, key=lambda size: abs(size - now))
        found = self.working(_canvas_of(self.axis, size) for size in given[:4])
        return found or self._nearest(lambda size: _canvas_of(self.axis, size), now)

    def size(self, names: Iterable[str]) -> list[Suggestion]:
        """The size of one of these symbols that works and changes it least."""
        found: list[tuple[float, Suggestion]] = []
        for name in names:
            now = self.design.symbol(name).size
            if now is not None:
                for own in self._nearest(lambda size, name=name: size_of(name, size), now):  # type: ignore[misc]
                    found.append((abs(log10(own.value / now)), own))
        return [min(found, key=lambda own: own[0])[1]] if found else []

    def _nearest(self, make: Callable[[float], Suggestion], now: float) -> list[Suggestion]:
        """Go away from a value in growing steps, both ways; then back to where it just works."""
        before = {1: now, -1: now}
        for factor in tuning.FACTORS:
            for way, value in ((1, _nicer(now * factor)), (-1, _nicer(now / factor))):
                if self.over:
                    return []
                if self.sizes(make(value)) is not None:
                    return [make(self._back(make, before[way], value))]
                before[way] = value
        return []

    def _back(self, make: Callable[[float], Suggestion], bad: float, good: float) -> float:
        for _ in range(tuning.FINER):
            middle = _nicer((bad + good) / 2)
            if middle in (bad, good) or self.over:
                break
            if self.sizes(make(middle)) is not None:
                good = middle
            else:
                bad = middle
        return good

    def bounds(self, symbols: Iterable[Symbol]) -> Iterator[Suggestion]:
        """A min or max moved just as far as is needed for it to work."""
        for symbol in symbols:
            for field, word, away in (("max", "up to", ceil), ("min", "from", floor)):
                now = getattr(symbol, field)
                if now is None:
                    continue
                open_ended = Suggestion(
                    f"{quoted(symbol.name)} without {field}", ("symbols", symbol.name, field), None
                )
                sizes = self.sizes(open_ended)
                if sizes is None or symbol.name not in sizes:
                    continue
                value = _rounded(sizes[symbol.name], away)
                exact = Suggestion(
                    f"{quoted(symbol.name)} {word} {value:.4g} m", ("symbols", symbol.name, field), value
                )
                yield from self.working([exact, open_ended])

    def counters(self, names: Iterable[str]) -> Iterator[Suggestion]:
        """A value or a bound of a counter that works, the nearest one."""
        for name in names:
            own = self.design.counter(name)
            if own.value is not None:
                yield from self._value(name, own)
                continue
            if own.min > 0 and self.sizes(_counter(name, "min", "from 0 on", 0)) is not None:
                yield from self.working(_counter(name, "min", f"from {v} on", v) for v in _down(own.min))
            if own.max is not None and self.sizes(_counter(name, "max", "without a max", None)) is not None:
                yield from self.working(_counter(name, "max", f"up to {v}", v) for v in _up(own.max))

    def _value(self, name: str, own: Counter) -> list[Suggestion]:
        """Another value of a counter: what it would be if it were free, and from there back to where it just works."""
        free = self.tried(_counter(name, "value", "without a value", None))
        if free is None or name not in free.counters or own.value is None:
            return []
        bad, good = own.value, free.counters[name]
        while abs(good - bad) > 1 and not self.over:
            middle = (good + bad) // 2
            good, bad = (middle, bad) if self.sizes(_at(name, middle)) is not None else (good, middle)
        return self.working([_at(name, good)])


def _down(value: int) -> Iterator[int]:
    """Whole numbers below one, ever further away, 0 the last."""
    step = 1
    while value - step > 0:
        yield value - step
        step = step + 1 if step < 6 else step * 2
    yield 0


def _up(value: int) -> Iterator[int]:
    step = 1
    while step < 2000:
        yield value + step
        step = step + 1 if step < 6 else step * 2


def _at(name: str, value: int) -> Suggestion:
    return _counter(name, "value", f"at {value}", value)


def _counter(name: str, field: str, text: str, value: int | None) -> Suggestion:
    return Suggestion(f"counter {quoted(name)} {text}", ("counters", name, field), value)


def _canvas_of(axis: Axis, size: float) -> Suggestion:
    """A canvas of another size."""
    return Suggestion(f"a {_EXTENT[axis]} of {size:.5g} m", ("canvas", _EXTENT[axis]), size)


def size_of(name: str, size: float) -> Suggestion:
    """A symbol of another size."""
    return Suggestion(f"{quoted(name)} of {size:.5g} m", ("symbols", name, "size"), size)


def relaxed(symbol: Symbol) -> Iterator[tuple[str, Suggestion]]:
    """Each qualifier of a symbol that forbids something, as the constraint it makes, and the symbol without it."""
    name = symbol.name
    if symbol.unoccludable:
        yield "C3", Suggestion(f"{quoted(name)} not unoccludable", ("symbols", name, "unoccludable"), False)
    if symbol.attached:
        yield "C4", Suggestion(f"{quoted(name)} not attached", ("symbols", name, "attached"), False)
    if not symbol.opaque and not symbol.transparent:
        yield "C1", Suggestion(f"{quoted(name)} opaque", ("symbols", name, "opaque"), True)


def nice(size: float) -> float:
    """A size to four digits."""
    return _rounded(size, round)


def _nicer(size: float) -> float:
    """A size to three digits."""
    return _rounded(size, round, 3)


def _rounded(size: float, way: Callable[[float], int], digits: int = 4) -> float:
    if not 0 < size < inf:
        return size
    digits = digits - 1 - floor(log10(size))
    exact = round(size, digits + 6)  # what is a round number but for the last bits is left as it is
    return float(round(way(round(exact * 10**digits, 6)) / 10**digits, max(0, digits)))
