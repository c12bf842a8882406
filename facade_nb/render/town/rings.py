"""Rings of corners in flat arrays: ring r has the corners from ``offsets[r]`` to below ``offsets[r + 1]``."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, length, millimetres

__all__ = [
    "Ints",
    "after",
    "areas",
    "before",
    "inset",
    "line_offsets",
    "offsets_of",
    "polygons_of",
    "ragged",
    "ring_numbers",
    "take_rings",
]

Ints = NDArray[np.integer[Any]]


def offsets_of(counts: NDArray[np.integer]) -> Ints:
    """Offsets of rings of so many corners."""
    return np.concatenate([[0], np.cumsum(counts, dtype=np.int64)])


def ring_numbers(offsets: Ints) -> Ints:
    """The ring of each corner."""
    return np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))


def after(offsets: Ints) -> Ints:
    """The next corner of each corner in its ring."""
    following = np.arange(1, offsets[-1] + 1)
    full = np.diff(offsets) > 0
    following[offsets[1:][full] - 1] = offsets[:-1][full]
    return following


def before(offsets: Ints) -> Ints:
    """The corner before each corner in its ring."""
    preceding = np.arange(-1, offsets[-1] - 1)
    full = np.diff(offsets) > 0
    preceding[offsets[:-1][full]] = offsets[1:][full] - 1
    return preceding


def ragged(starts: NDArray[np.integer], counts: NDArray[np.integer]) -> Ints:
    """The numbers from each start on, so many of each, one after the other."""
    counts = np.asarray(counts, np.int64)
    ends = np.cumsum(counts)
    return np.repeat(np.asarray(starts, np.int64) - (ends - counts), counts) + np.arange(
        ends[-1] if len(ends) else 0
    )


def take_rings(offsets: Ints, chosen: NDArray[np.integer]) -> tuple[Ints, Ints]:
    """Indices of the corners of some rings, in their order, and the offsets of these rings."""
    counts = np.diff(offsets)[chosen]
    return ragged(offsets[:-1][chosen], counts), offsets_of(counts)


def polygons_of(offsets: Ints, corners: Floats, chosen: NDArray[np.bool_]) -> NDArray[np.object_]:
    """Some rings as shapely's polygons."""
    index, offsets = take_rings(offsets, np.flatnonzero(chosen))
    rings = shapely.linearrings(corners[index], indices=ring_numbers(offsets))
    return np.asarray(shapely.polygons(rings), object)


def areas(corners: Floats, offsets: Ints) -> Floats:
    """Signed areas of rings, square metres; counter-clockwise ones are positive. Exact for whole millimetres."""
    mm = np.rint(np.asarray(corners) * 1000).astype(np.int64)
    first = mm[np.repeat(offsets[:-1], np.diff(offsets))]  # near the origin, products stay small
    mm = mm - first
    following = mm[after(offsets)]
    cross = mm[:, 0] * following[:, 1] - mm[:, 1] * following[:, 0]
    sums = np.concatenate([[0], np.cumsum(cross)])
    return (sums[offsets[1:]] - sums[offsets[:-1]]) / 2e6


def line_offsets(corners: Floats, offsets: Ints, distance: Floats | float) -> Floats:
    """Corners of rings whose edges are moved inwards, each by its distance (metres), and meet again (mitred).

    The rings keep their corners. Where that is no longer a true inset, edges run backwards: see `inset`.
    """
    following, preceding = after(offsets), before(offsets)
    along = corners[following] - corners
    along = along / np.maximum(length(along), 1e-9)[:, None]
    distance = np.broadcast_to(np.asarray(distance, np.float64), (len(corners),))
    here, there = along, along[preceding]
    own, other = distance, distance[preceding]
    cross = there[:, 0] * here[:, 1] - there[:, 1] * here[:, 0]
    dot = there[:, 0] * here[:, 0] + there[:, 1] * here[:, 1]
    straight = np.abs(cross) < 0.05
    safe = np.where(straight, 1.0, cross)
    # The point at `own` left of the edge from here and at `other` left of the edge that comes here.
    mitred = (here * other[:, None] - there * own[:, None]) / safe[:, None]
    middle = here + there
    normal = np.stack([-middle[:, 1], middle[:, 0]], axis=1)
    normal = normal / np.maximum(length(normal), 1e-9)[:, None]
    level = normal * (np.maximum(own, other) / np.sqrt(np.maximum((1 + dot) / 2, 0.1)))[:, None]
    return np.asarray(corners + np.where(straight[:, None], level, mitred))


def inset(corners: Floats, offsets: Ints, distance: Floats | float) -> tuple[Floats, NDArray[np.bool_]]:
    """Rings inset as by `line_offsets`, in whole millimetres, and for each ring whether all edges keep their sense."""
    moved = millimetres(line_offsets(corners, offsets, distance))
    following = after(offsets)
    old, new = corners[following] - corners, moved[following] - moved
    kept = (old[:, 0] * new[:, 0] + old[:, 1] * new[:, 1] > 0) | (length(old) < 1e-6)
    whole = np.ones(len(offsets) - 1, bool)
    np.logical_and.at(whole, ring_numbers(offsets), kept)
    return moved, whole
