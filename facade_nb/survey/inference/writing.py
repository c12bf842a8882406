"""A design that says what was found: patterns, symbols, layers and shapes, with names that a person would give."""

from __future__ import annotations

from collections import Counter as Tally
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate, count
from typing import Any

from ...design.model import Design
from .fitting import Axis
from .growth import Looks, grown, shares
from .repeats import Expression, Leaf, Mirror, Run, Series, leaves, shortest
from .search import Order
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

_WALL = {"kind": "wall", "geometry": "box", "material": "plaster"}
_LOOKS = {
    False: {"kind": "window", "geometry": "window", "material": "painted-wood"},
    True: {"kind": "door", "geometry": "door", "material": "oak"},
}
_UNSEEN = {"visible": False}

_BAY = 3.0
"""About as wide and as high as a bay of a wall without openings is, metres."""


@dataclass(frozen=True, slots=True)
class _Named:
    """An axis with names for its symbols and texts for its lines."""

    symbols: tuple[str, ...]
    texts: tuple[str, ...]
    counters: tuple[str, ...]
    shares: tuple[list[float], ...]


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
            "shapes": {"* *": dict(_WALL)},
        }
    )


def written(
    order: Order, openings: Sequence[Opening], unit: float, canvas: tuple[float, float], name: str
) -> Design:
    """The design of an order of openings, whose lengths are in units of so many metres; `canvas` is in metres."""
    structure = order.structure
    width, height = (extent / unit for extent in canvas)
    across = _named("x", structure.x, order.x, _odd(order, openings, "x"), width, ())
    along = _named("y", structure.y, order.y, _odd(order, openings, "y"), height, across.counters)
    patterns = {f"{_title('x', n)}": text for n, text in enumerate(across.texts)}
    patterns |= {f"{_title('y', n)}": text for n, text in enumerate(along.texts)}
    document: dict[str, Any] = {
        "format": "facade-nb/design/1",
        "name": name,
        "canvas": {"width": canvas[0], "height": canvas[1]},
        "symbols": {
            **_symbols(structure.x, order.x, across, unit),
            **_symbols(structure.y, order.y, along, unit),
        },
        "counters": {counter: {"min": 1} for counter in across.counters + along.counters},
        "patterns": patterns,
        "layers": list(_layers(order, openings, across, along)),
        "shapes": {"* *": dict(_WALL)},
    }
    return Design.from_dict(document)


def _title(axis: str, n: int) -> str:
    first = "bays" if axis == "x" else "storeys"
    return first if n == 0 else f"{first} {n + 1}"


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


def _named(
    axis: str, lines: Sequence[Line], fitted: Axis, odd: frozenset[int], canvas: float, taken: Sequence[str]
) -> _Named:
    solid = {
        s: c != GAP
        for line, word in zip(lines, fitted.names, strict=True)
        for s, c in zip(word, line.categories, strict=True)
    }
    letters = {kind: _letters(_NAMES[axis, kind]) for kind in (True, False)}
    symbols = tuple(next(letters[solid[symbol]]) for symbol in range(fitted.symbols))
    counters: Iterator[str] = (c for c in _letters(_COUNTERS[axis]) if c not in taken)
    texts, used, grows = [], [], []
    for n, (line, word) in enumerate(zip(lines, fitted.names, strict=True)):
        weights: Tally[int] = Tally()
        for i, weight in zip(line.solid, line.weights, strict=True):
            weights[word[i]] = max(weights[word[i]], weight)
        most = max(weights.values())
        looks = Looks(fitted.sizes, {s: w / most for s, w in weights.items()}, odd, canvas)
        counter = next(counters)
        expression = _growing(word, counter, looks, len(line.solid), only_runs=axis == "y" and n > 0)
        if _counts(expression):
            used.append(counter)
        else:
            counters = _before(counter, counters)
        texts.append(_text(expression, symbols).strip())
        grows.append(shares(expression))
    return _Named(symbols, tuple(texts), tuple(used), tuple(grows))


def _growing(
    word: Sequence[int], counter: str, looks: Looks, openings: int, *, only_runs: bool
) -> Expression:
    """The shortest expression of a word in which a counter has a place; without one where there is none."""
    best = shortest(word)
    if openings < 2:
        return best
    reaches = (None,) if only_runs else (None, (len(word) + 1) // 2 + 1, 0)
    for reach in reaches:
        expression = grown(shortest(word, reach), counter, looks, only_runs=only_runs)
        if _counts(expression):
            return expression
    return best


def _before(first: str, rest: Iterator[str]) -> Iterator[str]:
    yield first
    yield from rest


def _counts(expression: Expression) -> bool:
    match expression:
        case Run(body, _, counter):
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
            return (
                f"{_grouped(body, symbols)}^{'{' + counter + '}' if len(counter) > 1 else counter or times} "
            )
        case Mirror(body, pivot):
            return f"{_grouped(body, symbols)}^{'.' if pivot else '~'}1 "


def _grouped(body: Expression, symbols: Sequence[str]) -> str:
    text = _text(body, symbols).strip()
    return text if isinstance(body, Leaf) else f"({text})"


def _symbols(
    lines: Sequence[Line], fitted: Axis, named: _Named, unit: float
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


def _kept(lines: Sequence[Line], fitted: Axis, named: _Named) -> set[int]:
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


def _layers(
    order: Order, openings: Sequence[Opening], across: _Named, along: _Named
) -> Iterator[dict[str, Any]]:
    """A layer for each pair of lines that meet in an opening: the one with most of them lies below all."""
    structure = order.structure
    cells: dict[tuple[int, int], dict[tuple[int, int], bool]] = defaultdict(dict)
    for (xn, column, yn, band), opening in zip(structure.cells, openings, strict=True):
        cells[xn, yn][column, band] = opening.door
    pairs = sorted(cells, key=lambda pair: (pair[1] > 0, -len(cells[pair]), pair))
    base = pairs[0]
    shown: set[int] = set()
    for depth, (xn, yn) in enumerate(pairs):
        bands = sorted({band for _, band in cells[xn, yn]})
        ours = _symbol_names(structure.y[yn], order.y.names[yn], along.symbols)
        columns = _symbol_names(structure.x[xn], order.x.names[xn], across.symbols)
        walls = yn == 0 and not shown & set(bands)
        x: dict[str, Any] = {"pattern": _title("x", xn), "group": _title("x", xn)}
        y: dict[str, Any] = {"pattern": _title("y", yn), "group": _title("y", yn)}
        if (xn, yn) != base:
            y["mask"] = list(dict.fromkeys(ours[band] for band in bands))
            if not walls:
                x["mask"] = list(dict.fromkeys(columns[c] for c in sorted({c for c, _ in cells[xn, yn]})))
        elif len(pairs) > 1:
            others = {ours[b] for p in pairs[1:] if p[1] == 0 for _, b in cells[p]} - {ours[b] for b in bands}
            if others:
                every = [along.symbols[s] for s in dict.fromkeys(leaves(shortest(order.y.names[yn])))]
                y["mask"] = [symbol for symbol in every if symbol not in others]
        shown |= set(bands) if yn == 0 else set()
        numbers = (
            _numbers(columns, structure.x[xn], across.shares[xn]),
            _numbers(ours, structure.y[yn], along.shares[yn]),
        )
        shapes = _shapes(cells[xn, yn], columns, ours, numbers, set(y.get("mask", ours)), walls)
        title = "walls and windows" if (xn, yn) == base else f"{_what(cells[xn, yn])} {depth}"
        yield {"name": title, "x": x, "y": y, "depth": depth, "shapes": shapes}


def _what(cells: Mapping[tuple[int, int], bool]) -> str:
    return "doors" if all(cells.values()) else "windows"


def _symbol_names(line: Line, word: Sequence[int], names: Sequence[str]) -> list[str]:
    """Names of the openings of a line, in their order."""
    return [names[word[i]] for i in line.solid]


def _shapes(
    cells: Mapping[tuple[int, int], bool],
    columns: Sequence[str],
    bands: Sequence[str],
    numbers: tuple[list[int], list[int]],
    seen: set[str],
    walls: bool,
) -> dict[str, Any]:
    """What a layer shows: for each pair of symbols what most have, and single ones that differ."""
    groups: dict[tuple[str, str], list[tuple[int, int]]] = defaultdict(list)
    for c, column in enumerate(columns):
        for b, band in enumerate(bands):
            if band in seen:
                groups[column, band].append((c, b))
    found: dict[str, Any] = {}
    blank = _WALL if walls else _UNSEEN
    for (column, band), places in groups.items():
        kinds = Tally(cells.get(place) for place in places)
        usual = None if 2 * kinds[None] > len(places) else max((False, True), key=lambda kind: kinds[kind])
        if usual is not None or not walls:
            found[f"{column} {band}"] = dict(blank if usual is None else _LOOKS[usual])
        again = {"visible": True} if usual is None and not walls else {}  # else it would be inherited
        for c, b in places:
            kind = cells.get((c, b))
            if kind != usual:
                key = f"{column}[{numbers[0][c]}] {band}[{numbers[1][b]}]"
                found[key] = dict(blank if kind is None else _LOOKS[kind] | again)
    return found


def _numbers(names: Sequence[str], line: Line, grows: Sequence[float]) -> list[int]:
    """Which instance of its name each opening is: from 1, or from -1 at the far end where most is added before it."""
    total = Tally(names)
    tally: Tally[str] = Tally()
    found = []
    for name, token in zip(names, line.solid, strict=True):
        tally[name] += 1
        far = bool(grows) and grows[token] > 0.5
        found.append(tally[name] - total[name] - 1 if far else tally[name])
    return found
