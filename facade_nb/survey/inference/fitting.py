"""Sizes of symbols, so that lines of them come as near as can be to what was measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .repeats import letters
from .structure import GAP, Line, Structure, clusters

__all__ = ["Axis", "Names", "agreement", "fit", "named"]

Names = tuple[tuple[int, ...], ...]
"""For each line the symbol of each token."""

_LEAST = 0.01
"""No symbol is smaller, metres."""
_TIE = 1e-3
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
    numbers = clusters([(sizes[n][i], 1e6 * kinds.index(lines[n].categories[i])) for n, i in tokens], tolerance)
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


def fit(lines: Sequence[Line], names: Names, canvas: float) -> Axis | None:
    """Least squares over the places of all openings, with every line as long as the canvas; None where that fails."""
    names = renumbered(names)
    n = 1 + max(symbol for line in names for symbol in line)
    rows: list[NDArray[np.float64]] = []
    aims: list[float] = []
    full: list[NDArray[np.float64]] = []
    measured = np.zeros(n)
    count = np.zeros(n)
    parts: list[tuple[NDArray[np.float64], list[int]]] = []
    for line, word in zip(lines, names, strict=True):
        sums = np.zeros((len(word) + 1, n))
        for i, symbol in enumerate(word):
            sums[i + 1] = sums[i]
            sums[i + 1, symbol] += 1
            measured[symbol] += line.sizes[i]
            count[symbol] += 1
        solid = list(line.solid)
        parts.append((sums, solid))
        full.append(sums[-1])
        for i, span, weight in zip(solid, line.spans, line.weights, strict=True):
            root = weight**0.5
            rows += [sums[i] * root, sums[i + 1] * root]
            aims += [span[0] * root, span[1] * root]
    rows += list(np.eye(n) * _TIE)
    aims += list(measured / count * _TIE)
    a, b, c = np.array(rows), np.array(aims), np.array(full)
    normal = np.block([[a.T @ a, c.T], [c, np.zeros((len(c), len(c)))]])
    right = np.concatenate([a.T @ b, np.full(len(c), canvas)])
    sizes = np.round(np.linalg.lstsq(normal, right, rcond=None)[0][:n], 3)
    if sizes.min() < _LEAST or np.abs(c @ sizes - canvas).max() > 0.02 + 1e-3 * c.sum(axis=1).max():
        return None
    spans = tuple(
        np.stack([(sums @ sizes)[solid], (sums @ sizes)[[i + 1 for i in solid]]], axis=1) for sums, solid in parts
    )
    return Axis(names, tuple(float(size) for size in sizes), spans, sum(letters(word) for word in names))


def agreement(structure: Structure, target: NDArray[np.float64], x: Axis, y: Axis) -> float:
    """Mean intersection over union of openings (n, 4) with what stands for them, both moved to their corners."""
    across = np.array([x.spans[n][i] for n, i, _, _ in structure.cells])
    along = np.array([y.spans[n][i] for _, _, n, i in structure.cells])
    placed = np.stack([across[:, 0], along[:, 0], across[:, 1], along[:, 1]], axis=1)
    placed = placed - np.tile(placed[:, :2].min(axis=0), 2)
    low, high = np.maximum(placed[:, :2], target[:, :2]), np.minimum(placed[:, 2:], target[:, 2:])
    shared = np.clip(high - low, 0.0, None).prod(axis=1)
    areas = [(rects[:, 2:] - rects[:, :2]).prod(axis=1) for rects in (placed, target)]
    return float((shared / (areas[0] + areas[1] - shared)).mean())
