"""Sizing and placement: one least-squares problem for an axis, all groups together (the paper's 5.3,
supplement 3.4, 3.5).

Variables are the size z of every symbol, every boundary between columns, and every boundary between letters
inside an element. Stitched letters and columns share a boundary, which is how the paper's stitching
constraints are kept; what remains are the rows named here: a letter's two bounds are its symbol's size
apart, pieces of a cut letter add up to it, the gaps γ around a non-opaque element are equal in pairs, and a
substituted symbol that is left standing elsewhere has the extent of its content.

Two rounds: the first minimises Σ (z − preferred)² over the sized symbols, which fixes their sizes (the
objective is strictly convex in them); the second, with those sizes kept, brings unsized symbols and pieces
as near as can be to their sizes in the alignment.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np

from ...design.model import Symbol
from .. import tuning
from ..alignment.group import Group
from ..alignment.pricing import Priced
from ..budget import Stopped
from ..model.letters import Letter
from ..model.sizing import FREE, Key, Solution, System
from ..model.sums import dot, times
from .least_squares import least_squares

__all__ = ["Placement", "Sized", "size_axis", "strain"]

_Place = tuple[int, int, int, int]
"""Group, row, column, and place in the element."""


_SOME = 0.1
"""A part of its size that a letter should have."""

Placement = tuple[tuple[tuple[float, float], ...], ...]
"""Per band: the intervals of its letters and pieces, column by column."""


@dataclass(frozen=True, slots=True)
class Sized:
    """The solved axis.

    Attributes
    ----------
    sizes
        Solved size of each symbol in use.
    boundaries
        Per group: every column boundary, 0 first, the canvas last.
    placements
        Per group: `Placement`.
    deviation
        √Σ (z − preferred)², metres.
    """

    sizes: Mapping[str, float]
    boundaries: tuple[tuple[float, ...], ...]
    placements: tuple[Placement, ...]
    deviation: float
    system: System
    solution: Solution
    placed: tuple[float, ...]
    """Every variable after the second round."""


class _Builder:
    """Variables and rows, as they are met; rows by kind, so that numpy fills the matrix."""

    def __init__(self, canvas: float, symbol: Callable[[str], Symbol], least: float) -> None:
        self.canvas, self.symbol, self.least = canvas, symbol, least
        self.keys: list[Key] = []
        self.variables: list[float] = []
        """Five numbers each: low, high, target, weight, pull."""
        self.inner = (0.0, canvas, 0.0, 0.0, 0.0)
        """A boundary between letters."""
        self.greater: list[int] = []
        self.less: list[int] = []
        self.by: list[float] = []
        """Two variables of which one is greater, and by how much at least."""
        self.difference_keys: list[Key] = []
        self.starts: list[int] = []
        self.ends: list[int] = []
        self.lengths: list[int] = []
        """Start, end and size of a letter, which are the same length."""
        self.span_keys: list[Key] = []
        self.equations: list[Mapping[int, float]] = []
        """Terms that add up to nothing."""
        self.equation_keys: list[Key] = []
        self.size_of: dict[str, int] = {}
        self.extents: dict[tuple[int, int, int, str, int], dict[int, float]] = {}
        self.open = False
        """Whether the sizes of the sized symbols leave anything undecided."""

    def variable(
        self, key: Key, low: float, high: float, target: float, weight: float = 0.0, pull: float = 0.0
    ) -> int:
        self.keys.append(key)
        self.variables += (low, high, target, weight, pull)
        return len(self.keys) - 1

    def difference(self, key: Key, greater: int, less: int, low: float) -> None:
        """``greater - less >= low``."""
        self.difference_keys.append(key)
        self.greater.append(greater)
        self.less.append(less)
        self.by.append(low)

    def equation(self, key: Key, terms: Mapping[int, float]) -> None:
        """``terms = 0``."""
        self.equation_keys.append(key)
        self.equations.append(terms)

    def size(self, name: str, aligned: float) -> int:
        """A variable for the size of a symbol; an unsized one is drawn towards its size in the alignment."""
        own = self.symbol(name)
        low, high = max(self.least, own.min or 0.0), FREE if own.max is None else own.max
        sized = own.size is not None
        self.open = self.open or not sized
        target = aligned if own.size is None else own.size
        v = self.variable(("|", name), low, high, target, 1.0 if sized else 0.0, 0.0 if sized else 1.0)
        self.size_of[name] = v
        return v

    def system(self) -> System:
        """The matrices."""
        n, m, k, e = len(self.keys), len(self.by), len(self.lengths), len(self.equations)
        if n * (n + m + k + e) > tuning.SIZING_CELLS:
            raise Stopped(full=True)
        variables = np.array(self.variables).reshape(n, 5)
        lower, upper = np.zeros(n + m + k + e), np.zeros(n + m + k + e)
        lower[:n], upper[:n] = variables[:, 0], variables[:, 1]
        lower[n : n + m], upper[n : n + m] = self.by, FREE
        matrix = np.zeros((m + k + e, n))
        cells, first = matrix.reshape(-1), np.arange(0, (m + k) * n, n)  # of each row
        cells[np.add(first, _numbers([*self.greater, *self.ends]))] = 1.0
        cells[np.add(first, _numbers([*self.less, *self.starts]))] = -1.0
        cells[np.add(first[m:], _numbers(self.lengths))] = -1.0
        for row, terms in enumerate(self.equations, m + k):
            for v, coefficient in terms.items():
                matrix[row, v] = coefficient
        return System(
            tuple(self.keys),
            (*self.difference_keys, *self.span_keys, *self.equation_keys),
            matrix,
            lower,
            upper,
            np.ascontiguousarray(variables[:, 3]),
            np.ascontiguousarray(variables[:, 2]),
            np.maximum(variables[:, 4], 1e-6),
        )


def size_axis(
    groups: Sequence[Group],
    parts: Sequence[tuple[Priced, int]],
    canvas: float,
    symbol: Callable[[str], Symbol],
) -> Sized | None:
    """Size and place every letter of an axis.

    Parameters
    ----------
    groups
        All alignment groups of the axis.
    parts
        Per group: the priced structure that aligns it, and the group's number there.
    canvas
        Extent in metres.
    symbol
        Symbols by name.

    Returns
    -------
    The sized axis, or None where the constraints contradict each other.
    """
    long = _are_long(groups, parts)
    build, edges, bounds = (
        _of_sizes(groups, parts, canvas, symbol) if long else _built(groups, parts, canvas, symbol)
    )
    system = build.system()
    first = least_squares(system.weight, system.target, system.matrix, system.lower, system.upper)
    if first is None:
        return None
    x = _settle(system, first.x) if build.open else first.x
    # 1 m is to be 1 and not a bit less; the ends are 0 and the canvas exactly
    n = x.size
    at = np.minimum(np.maximum(x.round(12), system.lower[:n]), system.upper[:n]).tolist()
    off = first.x - system.target
    sizes = {name: at[v] for name, v in build.size_of.items()}
    if long:
        boundaries, placements = _laid_out(groups, parts, canvas, sizes)
    else:
        boundaries = tuple([tuple([at[v] for v in own]) for own in edges])
        placements = tuple(
            [tuple([tuple([(at[s], at[t]) for s, t in band]) for band in own]) for own in bounds]
        )
    return Sized(
        sizes,
        boundaries,
        placements,
        sqrt(dot(system.weight, off * off)),
        system,
        first,
        tuple(at),
    )


def _are_long(groups: Sequence[Group], parts: Sequence[tuple[Priced, int]]) -> bool:
    """Whether there are so many letters that only sizes are to be variables, and all else follows from these.

    That is so where each letter stands in one column as a whole, is opaque, and is no part of a content.
    """
    if sum(len(band.letters) for group in groups for band in group.bands) <= tuning.LONG_AXIS:
        return False
    return all(
        all(letter.opaque and not letter.transparent for letter in band.letters)
        and not any(origin is not None for origins in band.origins for origin in origins)
        for group in groups
        for band in group.bands
    )


def _of_sizes(
    groups: Sequence[Group],
    parts: Sequence[tuple[Priced, int]],
    canvas: float,
    symbol: Callable[[str], Symbol],
) -> tuple[_Builder, list[list[int]], list[list[list[tuple[int, int]]]]]:
    """Sizes and the canvas alone: the rows of a column are equally wide, and the columns fill the canvas."""
    letters = sum(len(band.letters) + 1 for group in groups for band in group.bands)
    build = _Builder(canvas, symbol, min(1e-3, 0.01 * canvas / max(1, letters)))
    whole = build.variable((":", 0, 1), canvas, canvas, canvas)
    seen: set[frozenset[tuple[int, float]]] = set()
    for g, (group, (priced, k)) in enumerate(zip(groups, parts, strict=True)):
        total: dict[int, float] = {whole: -1.0}
        for j, column in enumerate(priced.structure[k]):
            first: dict[int, float] | None = None
            for b, (band, option) in enumerate(zip(group.bands, column, strict=True)):
                if option.empty:
                    continue
                own: dict[int, float] = {}
                for i in option.letters:
                    letter = band.letters[i]
                    z = build.size_of.get(letter.symbol)
                    if z is None:
                        z = build.size(letter.symbol, letter.size or 0.0)
                    own[z] = own.get(z, 0.0) + 1.0
                if first is None:
                    first = own
                    for z, times in own.items():
                        total[z] = total.get(z, 0.0) + times
                    continue
                less = {z: own.get(z, 0.0) - first.get(z, 0.0) for z in {**first, **own}}
                terms = {z: times for z, times in less.items() if times}
                one = frozenset(terms.items())
                if terms and one not in seen:
                    seen.add(one)
                    build.equation(("column", g, b, j), terms)
        one = frozenset(total.items())
        if one not in seen:
            seen.add(one)
            build.equation(("canvas", g), total)
    return build, [], []


def _laid_out(
    groups: Sequence[Group], parts: Sequence[tuple[Priced, int]], canvas: float, sizes: Mapping[str, float]
) -> tuple[tuple[tuple[float, ...], ...], tuple[Placement, ...]]:
    """Boundaries of columns, and of letters, that follow from the sizes."""
    boundaries: list[tuple[float, ...]] = []
    placements: list[Placement] = []
    for group, (priced, k) in zip(groups, parts, strict=True):
        columns = priced.structure[k]
        at = [0.0]
        for column in columns:
            b = next(b for b, option in enumerate(column) if not option.empty)
            letters = group.bands[b].letters
            at.append(at[-1] + sum(sizes[letters[i].symbol] for i in column[b].letters))
        at = [round(own, 12) for own in at]
        at[-1] = canvas
        boundaries.append(tuple(at))
        rows: list[tuple[tuple[float, float], ...]] = []
        for b, band in enumerate(group.bands):
            own: list[tuple[float, float]] = []
            for j, column in enumerate(columns):
                start, final = at[j], len(column[b].letters) - 1
                for n, i in enumerate(column[b].letters):
                    end = at[j + 1] if n == final else round(start + sizes[band.letters[i].symbol], 12)
                    own.append((start, end))
                    start = end
            rows.append(tuple(own))
        placements.append(tuple(rows))
    return tuple(boundaries), tuple(placements)


def strain(
    groups: Sequence[Group],
    parts: Sequence[tuple[Priced, int]],
    canvas: float,
    symbol: Callable[[str], Symbol],
) -> float:
    """By how many metres, about, the constraints contradict each other; 0 where they do not.

    With the equations alone, what should have a length has a negative one, or next to none.
    """
    build, _, _ = _built(groups, parts, canvas, symbol)
    system = build.system()
    equation = system.lower == system.upper
    lower, upper = np.where(equation, system.lower, -FREE), np.where(equation, system.upper, FREE)
    found = least_squares(system.weight + 1e-3, system.target, system.matrix, lower, upper)
    if found is None:
        return canvas
    values = np.concatenate([found.x, times(system.matrix, found.x)])
    lower = system.lower.copy()
    sized = np.flatnonzero(system.weight > 0)
    lower[sized] = np.maximum(lower[sized], _SOME * system.target[sized])
    missed = np.maximum(0.0, lower - values) + np.maximum(0.0, values - system.upper)
    return float(np.add.accumulate(missed)[-1])


def _built(
    groups: Sequence[Group],
    parts: Sequence[tuple[Priced, int]],
    canvas: float,
    symbol: Callable[[str], Symbol],
) -> tuple[_Builder, list[list[int]], list[list[list[tuple[int, int]]]]]:
    """Variables and rows of an axis; per group, the edges of its columns and the bounds of its letters."""
    letters = sum(len(band.letters) + 1 for group in groups for band in group.bands)
    build = _Builder(canvas, symbol, min(1e-3, 0.01 * canvas / max(1, letters)))
    edges: list[list[int]] = []
    bounds: list[list[list[tuple[int, int]]]] = []
    for g, (group, (priced, k)) in enumerate(zip(groups, parts, strict=True)):
        edges.append(_edges(build, g, priced, k))
        bounds.append(_letters(build, g, group, priced, k, edges[g]))
    for (_, _, _, name, _), terms in build.extents.items():
        z = build.size_of.get(name)
        if z is not None:
            build.equation(("extent", name), {**terms, z: terms.get(z, 0.0) - 1.0})
    return build, edges, bounds


def _numbers(numbers: Sequence[int]) -> np.ndarray:
    return np.asarray(numbers, dtype=np.intp)  # also where there is none


def _settle(system: System, x: np.ndarray) -> np.ndarray:
    """The second round: sized symbols keep their sizes, the rest comes near to the alignment."""
    lower, upper = system.kept(x)
    second = least_squares(system.pull, system.target, system.matrix, lower, upper, tolerance=1e-9)
    return x if second is None else second.x


def _edges(build: _Builder, g: int, priced: Priced, k: int) -> list[int]:
    """Column boundaries, from 0 to the canvas."""
    widths = [max(map(sum, column)) for column in priced.pieces[k]]
    total = sum(widths)
    scale = build.canvas / total if total > 0 else 1.0
    at = 0.0
    out = [build.variable((":", g, 0), 0.0, 0.0, 0.0)]
    for j, width in enumerate(widths):
        at += width * scale
        last = j == len(widths) - 1
        low, high = (build.canvas, build.canvas) if last else (0.0, build.canvas)
        out.append(build.variable((":", g, j + 1), low, high, at))
        build.difference(("<", g, j), out[-1], out[-2], build.least)
    return out


def _letters(
    build: _Builder, g: int, group: Group, priced: Priced, k: int, edges: Sequence[int]
) -> list[list[tuple[int, int]]]:
    """The bounds of every letter and piece of a group, per band, with the rows they must keep."""
    structure, pieces = priced.structure[k], priced.pieces[k]
    placed: list[list[tuple[int, int]]] = []
    keys, variables, inner = build.keys, build.variables, build.inner
    starts, ends, lengths, span_keys = build.starts, build.ends, build.lengths, build.span_keys
    for row, band in enumerate(group.bands):
        word, size_of = band.letters, build.size_of
        # equal words may owe their letters to other contents
        marked = [(n, origins) for n, origins in enumerate(band.origins) if any(origins)]
        stands: list[list[tuple[_Place, int, int, float]]] = [[] for _ in word]
        intervals: list[tuple[int, int]] = []
        placed.append(intervals)
        for j, column in enumerate(structure):
            option = column[row]
            if option.empty:
                continue
            start, end = left, right = edges[j], edges[j + 1]
            own_letters, sizes = option.letters, pieces[j][row]
            final = len(own_letters) - 1
            if option.soft:
                soft = next(word[i] for i in own_letters if not word[i].opaque)
                start, end = _gaps(build, (g, row, j), final, soft, start, end)
            at = start
            for i, letter in enumerate(own_letters):
                place = (g, row, j, i)
                if i == final:
                    to = end
                else:
                    to = len(keys)
                    keys.append(("t", g, row, j, i))
                    variables += inner
                intervals.append((at, to))
                stands[letter].append((place, at, to, sizes[i]))
                for n, origins in marked:
                    origin = origins[letter]
                    if origin is not None:  # the extent of a content takes in the gaps beside it
                        extent = build.extents.setdefault((g, row, n, *origin), {})
                        edge = right if i == final else to
                        extent[edge] = extent.get(edge, 0.0) + 1.0
                        edge = left if i == 0 else at
                        extent[edge] = extent.get(edge, 0.0) - 1.0
                at = to
        for symbol, own in zip((letter.symbol for letter in word), stands, strict=True):
            z = size_of.get(symbol)
            if z is None:
                z = build.size(symbol, sum(size for *_, size in own))
            if len(own) == 1:
                ((place, s, t, _),) = own
                span_keys.append(("=", symbol, place))
                starts.append(s)
                ends.append(t)
                lengths.append(z)
            else:
                _pieces(build, symbol, own, z)
    return placed


def _pieces(build: _Builder, symbol: str, own: Sequence[tuple[_Place, int, int, float]], z: int) -> None:
    """The pieces of a cut letter add up to its size, and each is longer than nothing."""
    build.open = True
    total: dict[int, float] = {z: -1.0}
    for place, s, t, _ in own:
        total[t] = total.get(t, 0.0) + 1.0
        total[s] = total.get(s, 0.0) - 1.0
        build.difference(("piece", *place), t, s, build.least)
    build.equation(("=", symbol, *(place for place, *_ in own)), total)


def _gaps(
    build: _Builder, place: tuple[int, int, int], final: int, soft: Letter, start: int, end: int
) -> tuple[int, int]:
    """Put gap letters γ around an element with a non-opaque letter; the first such letter says how it is placed."""
    build.open = True
    placement = build.symbol(soft.symbol).placement
    if soft.mirrored and placement != "center":
        placement = "right" if placement == "left" else "left"
    s, t = start, end
    if placement != "left":
        s = build.variable(("s", *place, 0), 0.0, build.canvas, build.variables[5 * start + 2])
        build.difference(("before", *place, 0), s, start, 0.0)
    if placement != "right":
        t = build.variable(("t", *place, final), 0.0, build.canvas, build.variables[5 * end + 2])
        build.difference(("after", *place, final), end, t, 0.0)
    if placement == "center":
        build.equation(("gaps", *place, 0), {s: 1.0, start: -1.0, end: -1.0, t: 1.0})
    return s, t
