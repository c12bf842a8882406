"""How the openings of a façade are ordered: bands across it, columns along the bands, and what stands where.

A *band* has the openings with about the same sill and head. Bands that do not overlap make a *line* along y; those that
overlap others make lines of their own. The openings of a band make a row; rows that line up share a line along x.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from .repeats import letters

__all__ = [
    "GAP",
    "LEAST",
    "Grouping",
    "Line",
    "Opening",
    "Span",
    "Structure",
    "arranged",
    "clusters",
    "corner",
    "mean",
]

Span = tuple[float, float]

GAP = "gap"
"""The category of what stands between openings."""

LEAST = 0.005
"""Gaps under so many metres are none."""

_EXCEPTION = 0.25
"""What an opening that is missing weighs, in letters."""


@dataclass(frozen=True, slots=True)
class Opening:
    """A surveyed opening: where it is across and along, metres, and whether it is a door."""

    x: Span
    y: Span
    door: bool

    def scaled(self, by: float) -> Opening:
        """The same in another unit."""
        if by == 1:
            return self
        return Opening((self.x[0] * by, self.x[1] * by), (self.y[0] * by, self.y[1] * by), self.door)


@dataclass(frozen=True, slots=True)
class Line:
    """A row of openings and gaps from end to end of the canvas, not named yet.

    `categories` of its tokens: only tokens of one category can be alike. `sizes` are measured. `spans` and `weights`
    are of the tokens that are no gaps, in their order: where they are, and how many openings say so.
    """

    categories: tuple[str, ...]
    sizes: tuple[float, ...]
    spans: tuple[Span, ...]
    weights: tuple[int, ...]

    @property
    def solid(self) -> tuple[int, ...]:
        """Which tokens are no gaps."""
        return tuple(i for i, category in enumerate(self.categories) if category != GAP)


@dataclass(frozen=True, slots=True)
class Structure:
    """The order of a façade. `cells`: for each opening its line along x, its place there, and the same along y."""

    x: tuple[Line, ...]
    y: tuple[Line, ...]
    cells: tuple[tuple[int, int, int, int], ...]
    exceptions: int


@dataclass(frozen=True, slots=True)
class Grouping:
    """What decides a structure: bands, and how far openings may be from columns they join, metres.

    `slack` has openings that may be further off than the rest; `aside` those that have no say in where their band is.
    """

    bands: tuple[tuple[int, ...], ...]
    tolerance: float
    margin: float
    slack: Mapping[int, float] = field(default_factory=dict)
    aside: frozenset[int] = frozenset()


@dataclass(slots=True)
class _Column:
    """Openings above each other; the span is of those that are `firm`."""

    members: list[int] = field(default_factory=list)
    span: Span = (0.0, 0.0)
    firm: list[int] = field(default_factory=list)


def corner(openings: Sequence[Opening]) -> NDArray[np.float64]:
    """The rectangles of openings (n, 4), moved to their common lower left corner."""
    rects = np.array([(o.x[0], o.y[0], o.x[1], o.y[1]) for o in openings])
    return rects - np.tile(rects[:, :2].min(axis=0), 2)


def clusters(values: Sequence[Sequence[float]], tolerance: float) -> list[int]:
    """Number each of some points so that those of one number differ by no more than the tolerance; the first is 0."""
    groups = {i: [i] for i in range(len(values))}
    for n, (a, b, distance) in enumerate(_tree(tuple(map(tuple, values)))):
        if distance > tolerance + 1e-9:
            break
        groups[len(values) + n] = groups.pop(a) + groups.pop(b)
    numbers = {i: number for number, group in enumerate(sorted(groups.values(), key=min)) for i in group}
    return [numbers[i] for i in range(len(values))]


@lru_cache(maxsize=2000)
def _tree(values: tuple[tuple[float, ...], ...]) -> list[tuple[int, int, float]]:
    """Which groups of points become one, and at which distance, the nearest first: the n-th makes group points + n."""
    if len(values) < 2:
        return []
    from scipy.cluster.hierarchy import linkage  # a third of the time that the studio takes to be imported

    found = linkage(np.array(values, float), "complete", metric="chebyshev")
    return [(int(a), int(b), float(distance)) for a, b, distance, _ in found]


def mean(spans: Iterable[Span]) -> Span:
    """The span whose ends are the means of those of others."""
    low, high = zip(*spans, strict=True)
    return (round(sum(low) / len(low), 6), round(sum(high) / len(high), 6))


def _apart(spans: dict[int, Span], weights: dict[int, int]) -> list[list[int]]:
    """Sort spans into sets without overlaps, the heaviest set first; each set from low to high."""
    left = dict(spans)
    sets: list[list[int]] = []
    while left:
        order = sorted(left, key=lambda key: (left[key][1], left[key][0], key))
        best: list[tuple[int, list[int]]] = [(0, [])]
        for i, key in enumerate(order):
            before = max(
                (n for n in range(i + 1) if n == 0 or left[order[n - 1]][1] <= left[key][0] + 1e-6), default=0
            )
            with_it = best[before][0] + weights[key], [*best[before][1], key]
            best.append(max(best[i], with_it, key=lambda entry: entry[0]))
        sets.append(best[-1][1])
        for key in best[-1][1]:
            del left[key]
    return sets


def arranged(openings: Sequence[Opening], grouping: Grouping, width: float, height: float) -> Structure:
    """The structure of a grouping."""
    bands, margin = grouping.bands, grouping.margin
    spans = {
        b: mean([openings[i].y for i in band if i not in grouping.aside] or [openings[i].y for i in band])
        for b, band in enumerate(bands)
    }
    of_y = _apart(spans, {b: len(band) for b, band in enumerate(bands)})
    rows = [
        (b, row)
        for b, band in enumerate(bands)
        for row in _apart({i: openings[i].x for i in band}, dict.fromkeys(band, 1))
    ]
    rows.sort(key=lambda item: (-len(item[1]), spans[item[0]], item[1]))
    lines: list[list[_Column]] = []
    line_of: list[int] = []
    for n, (band, row) in enumerate(rows):
        others = {line for (other, _), line in zip(rows[:n], line_of, strict=True) if other == band}
        line_of.append(_place(openings, lines, row, others, grouping, width))
    made_x = tuple(
        _line([(c.span, "open", len(c.firm)) for c in columns], width, margin) for columns in lines
    )
    used = {
        b: sorted({line for (own, _), line in zip(rows, line_of, strict=True) if own == b}) for b in spans
    }
    made_y = tuple(
        _line([(spans[b], " ".join(map(str, used[b])), len(bands[b])) for b in word], height, margin)
        for word in of_y
    )
    where_x = {
        i: (n, c) for n, line in enumerate(lines) for c, column in enumerate(line) for i in column.members
    }
    where_y = {i: (n, b) for n, word in enumerate(of_y) for b, band in enumerate(word) for i in bands[band]}
    cells = tuple((*where_x[i], *where_y[i]) for i in range(len(openings)))
    exceptions = 0
    for (_, row), line in zip(rows, line_of, strict=True):
        missing = len(lines[line]) - len(row)
        exceptions += min(missing, len(row))
    return Structure(made_x, made_y, cells, exceptions)


def _line(parts: Sequence[tuple[Span, str, int]], canvas: float, margin: float) -> Line:
    """The line of some openings (span, category, weight) that do not overlap, with the gaps between."""
    categories: list[str] = []
    sizes: list[float] = []
    end = 0.0
    for (low, high), category, _ in parts:
        if low - end > (LEAST if sizes else margin):
            categories.append(GAP)
            sizes.append(low - end)
        categories.append(category)
        sizes.append(high - low)
        end = high
    if canvas - end > margin:
        categories.append(GAP)
        sizes.append(canvas - end)
    rounded = tuple(round(size, 6) for size in sizes)
    return Line(tuple(categories), rounded, tuple(p[0] for p in parts), tuple(p[2] for p in parts))


def _place(
    openings: Sequence[Opening],
    lines: list[list[_Column]],
    row: list[int],
    taken: set[int],
    grouping: Grouping,
    width: float,
) -> int:
    """Put a row into the line where it costs fewest letters, or into one of its own; which that is.

    Lines that are taken have another row of the same band, which overlaps this one.
    """
    tolerance, margin = grouping.tolerance, grouping.margin
    alone = [_Column([i], openings[i].x, [i]) for i in row]
    best, chosen, found = float(_letters(alone, tolerance, width, margin)), len(lines), alone
    for n, line in enumerate(lines):
        joined = None if n in taken else _joined(openings, line, row, grouping)
        if joined is None:
            continue
        missing = len(joined) - len(row)
        cost = 0.0 + _letters(joined, tolerance, width, margin)
        cost -= _letters(line, tolerance, width, margin)
        cost += _EXCEPTION * min(missing, len(row))
        if cost <= best - (chosen < len(lines)) * 1e-9:
            best, chosen, found = cost, n, joined
    if chosen == len(lines):
        lines.append(found)
    else:
        lines[chosen] = found
    return chosen


def _joined(
    openings: Sequence[Opening], line: list[_Column], row: list[int], grouping: Grouping
) -> list[_Column] | None:
    """A line with a row put into it; None where they do not line up."""
    columns = [_Column(list(column.members), column.span, list(column.firm)) for column in line]
    taken: set[int] = set()
    new: list[_Column] = []
    for i in row:
        low, high = openings[i].x
        reach = max(grouping.tolerance, grouping.slack.get(i, 0.0)) + 1e-9
        fits = [
            (max(abs(c.span[0] - low), abs(c.span[1] - high)), n)
            for n, c in enumerate(columns)
            if n not in taken and max(abs(c.span[0] - low), abs(c.span[1] - high)) <= reach
        ]
        if fits:
            off, n = min(fits)
            taken.add(n)
            columns[n].members.append(i)
            if off <= grouping.tolerance + 1e-9:
                columns[n].firm.append(i)
        elif any(c.span[0] < high - 1e-6 and low < c.span[1] - 1e-6 for c in columns):
            return None
        else:
            new.append(_Column([i], (low, high), [i]))
    for column in columns:
        column.span = mean(openings[i].x for i in column.firm)
    columns = sorted(columns + new, key=lambda column: column.span)
    for a, b in pairwise(columns):
        if b.span[0] < a.span[1] - 1e-6:
            return None
    return columns


def _letters(columns: Sequence[_Column], tolerance: float, width: float, margin: float) -> int:
    """About how many letters a line takes, if what differs by the tolerance is alike."""
    line = _line([(column.span, "open", 1) for column in columns], width, margin)
    word = clusters(
        [(size, 1e6 * (c == GAP)) for size, c in zip(line.sizes, line.categories, strict=True)], tolerance
    )
    return letters(word)
