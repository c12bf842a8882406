"""Layers of an inferred design: which patterns meet, what is masked, what each pair of symbols is."""

from __future__ import annotations

from collections import Counter as Tally
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .repeats import leaves, shortest
from .search import Order
from .structure import Line, Opening

__all__ = ["WALL", "Named", "layers", "title"]

WALL = {"kind": "wall", "geometry": "box", "material": "plaster"}
_LOOKS = {
    False: {"kind": "window", "geometry": "window", "material": "painted-wood"},
    True: {"kind": "door", "geometry": "door", "material": "oak"},
}
_UNSEEN = {"visible": False}


@dataclass(frozen=True, slots=True)
class Named:
    """An axis with names for its symbols and texts for its lines.

    For each letter of each line: which part of what a counter adds comes before it; whether it is itself repeated.
    """

    symbols: tuple[str, ...]
    texts: tuple[str, ...]
    counters: tuple[str, ...]
    shares: tuple[list[float], ...]
    repeats: tuple[list[bool], ...]


def title(axis: str, n: int) -> str:
    """The name of the n-th pattern of an axis, and of its group."""
    first = "bays" if axis == "x" else "storeys"
    return first if n == 0 else f"{first} {n + 1}"


def layers(
    order: Order, openings: Sequence[Opening], across: Named, along: Named
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
        x: dict[str, Any] = {"pattern": title("x", xn), "group": title("x", xn)}
        y: dict[str, Any] = {"pattern": title("y", yn), "group": title("y", yn)}
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
        repeats = (
            [across.repeats[xn][token] for token in structure.x[xn].solid],
            [along.repeats[yn][token] for token in structure.y[yn].solid],
        )
        shapes = _shapes(cells[xn, yn], columns, ours, numbers, repeats, set(y.get("mask", ours)), walls)
        name = "walls and windows" if (xn, yn) == base else f"{_what(cells[xn, yn])} {depth}"
        yield {"name": name, "x": x, "y": y, "depth": depth, "shapes": shapes}


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
    repeats: tuple[list[bool], list[bool]],
    seen: set[str],
    walls: bool,
) -> dict[str, Any]:
    """What a layer shows: for each pair of symbols what most have, and bands and single ones that differ.

    What a counter repeats decides for the rest: what is added is like it.
    """
    groups: dict[tuple[str, str], dict[int, list[int]]] = defaultdict(lambda: defaultdict(list))
    for b, band in enumerate(bands):
        if band in seen:
            for c, column in enumerate(columns):
                groups[column, band][b].append(c)
    found: dict[str, Any] = {}
    blank = WALL if walls else _UNSEEN

    def usual(places: Sequence[tuple[int, int]]) -> bool | None:
        """Whether most are doors or windows; None: neither."""
        kinds = Tally(cells.get(place) for place in places)
        return None if 2 * kinds[None] > len(places) else max((False, True), key=lambda kind: kinds[kind])

    def look(kind: bool | None, inherited: bool | None) -> dict[str, Any]:
        shown = {"visible": True} if inherited is None and kind is not None and not walls else {}
        return dict(blank if kind is None else _LOOKS[kind]) | shown

    for (column, band), rows in groups.items():
        grown_x = any(repeats[0][c] for row in rows.values() for c in row)
        ours = {b: [c for c in row if repeats[0][c] or not grown_x] for b, row in rows.items()}
        grown_y = any(repeats[1][b] for b in rows)
        common = usual([(c, b) for b, row in ours.items() for c in row if repeats[1][b] or not grown_y])
        if common is not None or not walls:
            found[f"{column} {band}"] = look(common, common)
        for b, row in rows.items():
            own = usual([(c, b) for c in ours[b]])
            name = f"{band}[{numbers[1][b]}]"
            differ = [c for c in row if cells.get((c, b)) != own]
            if own != common and len(differ) + 1 < sum(cells.get((c, b)) != common for c in row) + grown_x:
                found[f"{column} {name}"] = look(own, common)
            else:
                own, differ = common, [c for c in row if cells.get((c, b)) != common]
            for c in differ:
                found[f"{column}[{numbers[0][c]}] {name}"] = look(cells.get((c, b)), own)
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
