"""Sizes of symbols, so that lines of them come as near as can be to what was measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count

import numpy as np
from numpy.typing import NDArray

from .repeats import letters
from .structure import Line, Structure, clusters

__all__ = ["Axis", "Names", "agreement", "count_letters", "fit", "measured", "named", "renumbered", "solved"]

Names = tuple[tuple[int, ...], ...]
"""For each line the symbol of each token."""

_LEAST = 0.002
"""No symbol that is fitted is smaller, metres."""
_REFITS = 2
"""So often sizes are fitted again, with less weight for edges that are further off: near to least absolute errors."""
_SLIGHT = 0.04
"""Edges that are no further off weigh alike, metres."""
_TIE = 1e-6
"""How much the measured size of a symbol counts where places leave it open."""


@dataclass(frozen=True, slots=True)
class Axis:
    """The lines of an axis with symbols and their sizes; `spans`: where each opening of each line comes to stand."""

    names: Names
    sizes: tuple[float, ...]
    spans: tuple[NDArray[np.float64], ...]
    letters: int

    @property
    def symbols(self) -> int:
        """How many symbols there are."""
        return len(self.sizes)


def named(lines: Sequence[Line], tolerance: float, symmetric: float = 0.0) -> Names:
    """Give tokens of about the same size the same symbol.

    Lines whose halves mirror each other up to `symmetric` metres are made symmetric first.
    """
    sizes = [_symmetric(line, symmetric) for line in lines]
    tokens = [(n, i) for n, line in enumerate(lines) for i in range(len(line.sizes))]
    kinds = list(dict.fromkeys(lines[n].categories[i] for n, i in tokens))
    numbers = clusters(
        [(sizes[n][i], 1e6 * kinds.index(lines[n].categories[i])) for n, i in tokens], tolerance
    )
    found = dict(zip(tokens, numbers, strict=True))
    return tuple(tuple(found[n, i] for i in range(len(line.sizes))) for n, line in enumerate(lines))


def _symmetric(line: Line, tolerance: float) -> tuple[float, ...]:
    other = line.sizes[::-1]
    if line.categories != line.categories[::-1]:
        return line.sizes
    if max(abs(a - b) for a, b in zip(line.sizes, other, strict=True)) > tolerance:
        return line.sizes
    return tuple((a + b) / 2 for a, b in zip(line.sizes, other, strict=True))


def renumbered(names: Names) -> Names:
    """The same with symbols numbered in the order in which they appear."""
    numbers: dict[int, int] = {}
    return tuple(tuple(numbers.setdefault(s, len(numbers)) for s in line) for line in names)


def fit(lines: Sequence[Line], names: Names, canvas: float, *, mirrors: bool) -> Axis | None:
    """Least errors of the places of all openings, with every line as long as the canvas; None where that fails.

    Without `mirrors` no opening is mirrored: along y, windows would stand upside down.
    """
    names = renumbered(names)
    fitted = solved(lines, names, [canvas] * len(lines))
    if fitted is None:
        return None
    return Axis(names, *fitted, count_letters(lines, names, mirrors=mirrors))


def solved(
    lines: Sequence[Line], names: Names, canvases: Sequence[float]
) -> tuple[tuple[float, ...], tuple[NDArray[np.float64], ...]] | None:
    """The sizes of symbols, numbered as they appear, and where the openings of each line come to stand.

    Each line is as long as its canvas; None where that fails.
    """
    n = 1 + max(symbol for line in names for symbol in line)
    system = np.zeros((n + len(lines), n + len(lines)))
    right = np.concatenate([np.zeros(n), canvases])
    tally = np.zeros((n, 2))
    parts: list[tuple[NDArray[np.float64], NDArray[np.float64]]] = []
    for number, (line, word) in enumerate(zip(lines, names, strict=True)):
        sums = np.zeros((len(word) + 1, n))
        sums[range(1, len(word) + 1), word] = 1
        np.add.at(tally, (list(word), 0), line.sizes)
        np.add.at(tally, (list(word), 1), 1)
        sums = sums.cumsum(axis=0)
        solid = np.array(line.solid)
        parts.append((sums[solid], sums[solid + 1]))
        system[n + number, :n] = system[:n, n + number] = sums[-1]
    rows = np.concatenate([edge for part in parts for edge in part])
    aims = np.concatenate([edge for line in lines for edge in np.array(line.spans).T])
    shares = np.concatenate([_shares(line) for line in lines])
    weights = shares / _SLIGHT
    for _ in range(_REFITS + 1):
        weighted = rows.T * weights
        system[:n, :n] = weighted @ rows
        right[:n] = weighted @ aims
        system[range(n), range(n)] += _TIE
        right[:n] += _TIE * tally[:, 0] / tally[:, 1]
        found = np.linalg.lstsq(system, right, rcond=None)[0][:n]
        weights = shares / np.maximum(np.abs(rows @ found - aims), _SLIGHT)
    sizes = np.round(found, 3)
    lengths = system[n:, :n]
    slack = 0.02 + 1e-3 * lengths.sum(axis=1).max()
    if sizes.min() < _LEAST or np.abs(lengths @ sizes - canvases).max() > slack:
        return None
    spans = tuple(np.stack([low @ sizes, high @ sizes], axis=1) for low, high in parts)
    return tuple(float(size) for size in sizes), spans


def _shares(line: Line) -> NDArray[np.float64]:
    """What an edge that is a metre off costs in agreement, for the low and then the high edges of a line."""
    low, high = np.array(line.spans).T
    share = np.array(line.weights) / (high - low)
    return np.concatenate([share, share])


def count_letters(lines: Sequence[Line], names: Names, *, mirrors: bool) -> int:
    """How many letters the patterns of some lines have. Without `mirrors` no opening is mirrored."""
    return sum(
        letters(word, () if mirrors else [word[i] for i in line.solid])
        for line, word in zip(lines, names, strict=True)
    )


def measured(lines: Sequence[Line]) -> Axis:
    """The axis as it was measured: nothing is like anything else."""
    numbers = count()
    names = tuple(tuple(next(numbers) for _ in line.sizes) for line in lines)
    spans = tuple(np.array(line.spans) for line in lines)
    return Axis(names, tuple(size for line in lines for size in line.sizes), spans, sum(map(len, names)))


def agreement(structure: Structure, target: NDArray[np.float64], x: Axis, y: Axis) -> NDArray[np.float64]:
    """Intersection over union of each opening (n, 4) with what stands for it, both moved to their corners."""
    across = np.array([x.spans[n][i] for n, i, _, _ in structure.cells])
    along = np.array([y.spans[n][i] for _, _, n, i in structure.cells])
    placed = np.stack([across[:, 0], along[:, 0], across[:, 1], along[:, 1]], axis=1)
    placed = placed - np.tile(placed[:, :2].min(axis=0), 2)
    low, high = np.maximum(placed[:, :2], target[:, :2]), np.minimum(placed[:, 2:], target[:, 2:])
    shared = np.clip(high - low, 0.0, None).prod(axis=1)
    areas = [(rects[:, 2:] - rects[:, :2]).prod(axis=1) for rects in (placed, target)]
    near: NDArray[np.float64] = shared / (areas[0] + areas[1] - shared)
    return near
