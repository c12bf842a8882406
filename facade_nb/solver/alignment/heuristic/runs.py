"""Runs of letters of a row, and what those of several rows come to in a column (see `laying`)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import inf
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..bands import Band

__all__ = ["Bools", "Cuts", "Floats", "Row", "Sum"]

Floats = NDArray[np.float64]
Cuts = NDArray[np.intp]
Bools = NDArray[np.bool_]


class Sum(NamedTuple):
    """What a column comes to, of some of its elements; every field has the shape of the columns."""

    high: Floats
    rest: Floats
    """Least size of an element without letters that are not opaque; infinite where there is none."""
    least: Floats
    """Least size of any element."""
    empties: Floats
    loose: Floats
    softs: Floats
    soft_sizes: Floats
    some: Bools
    """Some row comes further; else it is no column."""
    elastic: Bools
    bad: Bools

    def plus(self, other: Sum) -> Sum:
        """With the elements of both."""
        return Sum(
            np.maximum(self.high, other.high),
            np.minimum(self.rest, other.rest),
            np.minimum(self.least, other.least),
            self.empties + other.empties,
            self.loose + other.loose,
            self.softs + other.softs,
            self.soft_sizes + other.soft_sizes,
            self.some | other.some,
            self.elastic | other.elastic,
            self.bad | other.bad,
        )

    def within(self, wider: Sum) -> Sum:
        """The same as a part of wider tables."""
        for mine, field in zip(self, wider, strict=True):
            field[: mine.shape[0], : mine.shape[1]] = mine
        n, m = self.high.shape
        return wider.at((slice(n), slice(m)))

    def at(self, index: Any) -> Sum:
        """Of some of the columns, or in another shape."""
        return Sum(*[np.asarray(field[index]) for field in self])


class Row:
    """A band's spots, and what stands between each two of them, shape (spots, spots)."""

    def __init__(self, band: Band) -> None:
        letters = band.letters
        self.wild = any(letter.transparent for letter in letters)
        spots = [
            (i, mid) for i, letter in enumerate(letters) for mid in ((0, 1) if letter.transparent else (0,))
        ]
        spots.append((len(letters), 0))
        self.letter = np.array([i for i, _ in spots])
        self.mid = np.array([bool(mid) for _, mid in spots])
        self.before = np.flatnonzero(~self.mid)
        """The spot before each letter, and the last one."""
        self.last = len(spots) - 1
        sizes = [0.0 if letter.transparent else letter.size or 0.0 for letter in letters]
        ends = np.concatenate([[0.0], np.cumsum(sizes)])
        joints = np.concatenate([[0.0], np.cumsum([min(a, b) for a, b in pairwise(sizes)]), [0.0]])
        softs = _counted([not letter.opaque and not letter.transparent for letter in letters])
        transparent = _counted([letter.transparent for letter in letters])
        first = self.letter[:, None]
        end = (self.letter + self.mid)[None, :]  # one beyond the last letter that is touched
        forward = np.arange(self.last + 1)[None, :] >= np.arange(self.last + 1)[:, None]
        touched = np.where(forward, end - first, 0)
        end = np.maximum(end, first)
        pieces = transparent[end] - transparent[first]
        some = touched > 0
        elastic = some & (pieces > 0)
        rigid = some & ~elastic
        size = np.where(rigid, ends[end] - ends[first], 0.0)
        soft = rigid & (softs[end] > softs[first])
        loose = np.where(rigid, joints[np.maximum(end - 1, 0)] - joints[first], 0.0)
        self.elements = Sum(
            size,
            np.where(rigid & ~soft, size, inf),
            np.where(rigid, size, inf),
            (~some).astype(float),
            loose,
            soft.astype(float),
            np.where(soft, size, 0.0),
            some & ~np.eye(self.last + 1, dtype=bool),
            elastic,
            ~forward | (elastic & (pieces < touched)),
        )

    def nearest(self, ends: Floats, places: Floats, near: float) -> Cuts:
        """For each place the spot that is nearest, letters ending at `ends`; or the one within a placeholder."""
        k = np.clip(np.searchsorted(ends, places, "right") - 1, 0, len(ends) - 2)
        left, right = places - ends[k], ends[k + 1] - places
        spots: Cuts = self.before[np.where(left <= right, k, k + 1)]
        if self.wild:
            inside = self.mid[np.minimum(self.before[k] + 1, self.last)] & (left > near) & (right > near)
            spots = np.maximum.accumulate(np.where(inside, self.before[k] + 1, spots))
        return spots

    def fill(self, band: Band, sizes: Mapping[int, float], canvas: float) -> None:
        """Have whole placeholders be as long as they are to be; those that are free fill the canvas."""
        free = [i for i, letter in enumerate(band.letters) if letter.transparent and i not in sizes]
        taken = sum(sizes.get(i, letter.size or 0.0) for i, letter in enumerate(band.letters))
        for i, letter in enumerate(band.letters):
            if letter.transparent:
                size = sizes.get(i, max(0.0, canvas - taken) / max(1, len(free)))
                self.elements.high[self.before[i], self.before[i + 1]] = size

    def sized(self, band: Band, sizes: Mapping[str, float]) -> list[tuple[int, float]]:
        """Transparent letters that are to have a size, by number."""
        found: list[tuple[int, float]] = []
        for i, letter in enumerate(band.letters):
            size = sizes.get(letter.symbol) if letter.size is None else letter.size
            if letter.transparent and not band.is_free(letter) and size is not None:
                found.append((i, size))
        return found


def _counted(flags: Sequence[bool]) -> Cuts:
    return np.concatenate([[0], np.cumsum(flags)]).astype(np.intp)
