"""A design that says what was found: patterns, symbols, layers and shapes, with names that a person would give."""

from __future__ import annotations

from collections import Counter as Tally
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import accumulate, count
from types import MappingProxyType
from typing import Any

from ...design.model import Design
from .fitting import Axis
from .growth import Looks, counted, grown, shares
from .layering import WALL, Named, layers, title
from .repeats import Chain, Expression, Leaf, Mirror, Run, Series, leaves, shortest
from .search import Order
from .sharing import shared
from .structure import GAP, Line, Opening

__all__ = ["plain", "written"]

_NAMES = {("x", True): "BCDEFGH", ("x", False): "abcdefgh", ("y", True): "PQRSTUVW", ("y", False): "pqrstuvw"}
"""Letters of openings and of what is between them, across and along."""
_COUNTERS = {"x": "kmnijl", "y": "nmkijl"}
_BOUNDS = (0.8, 1.05)
"""How small and how large openings may become, of their surveyed size; walls take the rest."""
_WALLS = 0.25
"""So much of a line must be wall for that."""
_POST = 0.5
"""Walls that are no wider, metres, are posts between openings: they become no less than half as wide."""

_BAY = 3.0
"""About as wide and as high as a bay of a wall without openings is, metres."""


def plain(width: float, height: float, name: str) -> Design:
    """A wall without openings, in bays that come and go with its size."""
    sizes = [extent / max(1, round(extent / _BAY)) for extent in (width, height)]
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": name,
            "canvas": {"width": width, "height": height},
            "symbols": {"a": {"size": round(sizes[0], 6)}, "p": {"size": round(sizes[1], 6)}},
            "counters": {"k": {"min": 1}, "n": {"min": 1}},
            "patterns": {"bays": "a^k", "storeys": "p^n"},
            "layers": [{"name": "wall", "x": {"pattern": "bays"}, "y": {"pattern": "storeys"}}],
            "shapes": {"* *": dict(WALL)},
        }
    )


def written(
    order: Order, openings: Sequence[Opening], unit: float, canvas: tuple[float, float], name: str
) -> Design:
    """The design of an order of openings, whose lengths are in units of so many metres; `canvas` is in metres."""
    structure = order.structure
    width, height = (extent / unit for extent in canvas)
    across = _named("x", structure.x, order.x, _odd(order, openings, "x"), width, ())
    odd = _odd(order, openings, "y")
    along = _named("y", structure.y, order.y, odd, height, across.counters)
    kinds = (
        _kinds(structure.x, order.x, across, unit),
        _kinds(structure.y, order.y, along, unit),
    )
    order, pairs = shared(order, openings, (width, height), kinds)
    names = {y: across.symbols[x] for y, x in pairs.items()}
    along = _named("y", structure.y, order.y, odd, height, across.counters, names)
    symbols = _symbols(structure.x, order.x, across, unit)
    for symbol, fields in _symbols(structure.y, order.y, along, unit).items():
        if symbols.setdefault(symbol, fields).keys() != fields.keys():  # bounded along one axis alone
            symbols[symbol] = {"size": fields["size"]}
    patterns = {f"{title('x', n)}": text for n, text in enumerate(across.texts)}
    patterns |= {f"{title('y', n)}": text for n, text in enumerate(along.texts)}
    document: dict[str, Any] = {
        "format": "facade-nb/design/1",
        "name": name,
        "canvas": {"width": canvas[0], "height": canvas[1]},
        "symbols": symbols,
        "counters": {counter: {"min": 1} for counter in across.counters + along.counters},
        "patterns": patterns,
        "layers": list(layers(order, openings, across, along)),
        "shapes": {"* *": dict(WALL)},
    }
    return Design.from_dict(document)


def _odd(order: Order, openings: Sequence[Opening], axis: str) -> frozenset[int]:
    """Symbols that doors have: these do not repeat."""
    found = set()
    lines, names = (order.structure.x, order.x.names) if axis == "x" else (order.structure.y, order.y.names)
    tally: Tally[int] = Tally()
    doors: Tally[int] = Tally()
    for cell, opening in zip(order.structure.cells, openings, strict=True):
        n, place = cell[:2] if axis == "x" else cell[2:]
        symbol = names[n][lines[n].solid[place]]
        tally[symbol] += 1
        doors[symbol] += opening.door
        if 2 * doors[symbol] >= tally[symbol]:
            found.add(symbol)
    return frozenset(symbol for symbol in found if 2 * doors[symbol] >= tally[symbol])


def _kinds(
    lines: Sequence[Line], fitted: Axis, named: Named, unit: float
) -> list[tuple[bool, tuple[str, ...]]]:
    """For each symbol whether openings have it, and how its size is bounded: what differs in that is never one."""
    solid = {word[i] for line, word in zip(lines, fitted.names, strict=True) for i in line.solid}
    symbols = _symbols(lines, fitted, named, unit)
    return [(symbol in solid, tuple(symbols[name])) for symbol, name in enumerate(named.symbols)]


def _named(
    axis: str,
    lines: Sequence[Line],
    fitted: Axis,
    odd: frozenset[int],
    canvas: float,
    taken: Sequence[str],
    names: Mapping[int, str] = MappingProxyType({}),
) -> Named:
    """An axis with texts, without the counters that are taken, and with names for its symbols: some may have theirs."""
    solid = {
        s: c != GAP
        for line, word in zip(lines, fitted.names, strict=True)
        for s, c in zip(word, line.categories, strict=True)
    }
    letters = {kind: _letters(_NAMES[axis, kind]) for kind in (True, False)}
    symbols = tuple(names.get(symbol) or next(letters[solid[symbol]]) for symbol in range(fitted.symbols))
    counters: Iterator[str] = (c for c in _letters(_COUNTERS[axis]) if c not in taken)
    texts, used, grows, repeats = [], [], [], []
    for n, (line, word) in enumerate(zip(lines, fitted.names, strict=True)):
        weights: Tally[int] = Tally()
        for i, weight in zip(line.solid, line.weights, strict=True):
            weights[word[i]] = max(weights[word[i]], weight)
        most = max(weights.values())
        looks = Looks(fitted.sizes, {s: w / most for s, w in weights.items()}, odd, canvas)
        counter = next(counters)
        expression = _growing(word, counter, looks, len(line.solid), axis, only_runs=axis == "y" and n > 0)
        if _counts(expression):
            used.append(counter)
        else:
            counters = _before(counter, counters)
        texts.append(_text(expression, symbols).strip())
        grows.append(shares(expression))
        repeats.append(counted(expression))
    return Named(symbols, tuple(texts), tuple(used), tuple(grows), tuple(repeats))


def _growing(
    word: Sequence[int], counter: str, looks: Looks, openings: int, axis: str, *, only_runs: bool
) -> Expression:
    """The shortest expression of a word in which a counter has a place; without one where there is none.

    No opening is mirrored along y: windows would stand upside down.
    """
    upright = () if axis == "x" else frozenset(looks.usual)
    best = shortest(word, upright)
    if openings < 2:
        return best
    found = (grown(expression, counter, looks, only_runs=only_runs) for expression in _written(word, upright))
    return min(filter(_counts, found), key=_letter_count, default=best)


def _written(word: Sequence[int], upright: Collection[int]) -> Iterator[Expression]:
    """Short expressions of a word; in some only short parts of it are reflected, so that more of it can grow."""
    n = len(word)
    half = (n + 1) // 2
    reaches = (None, half + 1, 0, 5, 3)
    yield from (shortest(word, upright, reach) for reach in reaches)
    if n > 2 and list(word) == list(word)[::-1] and not set(word[half:]) & set(upright):
        yield from (Mirror(shortest(word[:half], upright, reach), n % 2 == 1) for reach in reaches)


def _letter_count(expression: Expression) -> int:
    return sum(1 for _ in leaves(expression))


def _before(first: str, rest: Iterator[str]) -> Iterator[str]:
    yield first
    yield from rest


def _counts(expression: Expression) -> bool:
    match expression:
        case Run(body, _, counter) | Chain(body, _, _, counter):
            return bool(counter) or _counts(body)
        case Mirror(body):
            return _counts(body)
        case Series(parts):
            return any(map(_counts, parts))
        case _:
            return False


def _letters(names: str) -> Iterator[str]:
    """The letters, then with numbers."""
    yield from names
    for number in count(2):
        for name in names:
            yield f"{name}{number}"


def _text(expression: Expression, symbols: Sequence[str]) -> str:
    match expression:
        case Leaf(symbol):
            return symbols[symbol]
        case Series(parts):
            return "".join(_text(part, symbols) for part in parts)
        case Run(body, times, counter):
            return f"{_grouped(body, symbols)}^{_count(times, counter)} "
        case Chain(body, times, total, counter):
            return f"{_grouped(body, symbols)}^{'@' if total else ':'}{_count(times, counter)} "
        case Mirror(body, pivot):
            return f"{_grouped(body, symbols)}^{'.' if pivot else '~'}1 "


def _count(times: int, counter: str) -> str:
    return f"{{{counter}}}" if len(counter) > 1 else counter or str(times)


def _grouped(body: Expression, symbols: Sequence[str]) -> str:
    text = _text(body, symbols).strip()
    return text if isinstance(body, Leaf) else f"({text})"


def _symbols(
    lines: Sequence[Line], fitted: Axis, named: Named, unit: float
) -> dict[str, Mapping[str, float]]:
    """Sizes; openings keep theirs where every line that they stand in has walls to take the rest."""
    free = set(range(fitted.symbols))
    posts = {symbol for symbol in free if fitted.sizes[symbol] <= _POST}
    for line, word in zip(lines, fitted.names, strict=True):
        solid = {word[i] for i in line.solid}
        free -= set(word) - solid
        walls = sum(fitted.sizes[s] for s in word if s not in solid and s not in posts)
        if walls < _WALLS * sum(line.sizes):
            free -= solid
            posts -= set(word)
        posts -= solid
    free |= _kept(lines, fitted, named)
    found: dict[str, Mapping[str, float]] = {}
    for symbol, name in enumerate(named.symbols):
        size = _length(fitted.sizes[symbol] * unit)
        bounds = dict(zip(("min", "max"), (_length(size * bound) for bound in _BOUNDS), strict=True))
        if symbol not in free:
            bounds = {"min": _length(size / 2)} if symbol in posts else {}
        found[name] = {"size": size, **bounds}
    return found


def _kept(lines: Sequence[Line], fitted: Axis, named: Named) -> set[int]:
    """Margins of lines without a counter that stay as wide: what stands beside them then moves with the first line."""
    first = named.shares[0]
    if not first:
        return set()
    ends = _ends(lines[0])
    kept = set()
    for n, (line, word) in enumerate(zip(lines, fitted.names, strict=True)):
        others = {s for m, other in enumerate(fitted.names) if m != n for s in other}
        if named.shares[n] or line.categories[0] != GAP or line.categories[-1] != GAP or word[0] == word[-1]:
            continue
        own = _ends(line)
        low, high = own[0], own[-2]  # where the openings of this line begin and end
        before = next((share for end, share in zip(ends, first, strict=True) if end > low), 1.0)
        after = next((share for end, share in zip(ends, first, strict=True) if end >= high), 1.0)
        if before == after == 0.0 and word.count(word[0]) == 1 and word[0] not in others:
            kept.add(word[0])
        if before == after == 1.0 and word.count(word[-1]) == 1 and word[-1] not in others:
            kept.add(word[-1])
    return kept


def _ends(line: Line) -> list[float]:
    """Where each token of a line ends."""
    return list(accumulate(line.sizes))


def _length(metres: float) -> float:
    """To the millimetre, if that is precise enough."""
    return round(metres, 3 if metres >= 0.1 else 5 if metres >= 0.002 else 9)
