"""Which openings belong together: groupings by tolerance, and looser ones, where some join what they are far from."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from .structure import LEAST, Grouping, Opening, Structure, clusters, mean

__all__ = ["groupings", "looser"]

_TOLERANCES = (0.0, 0.03, 0.08, 0.16, 0.3, 0.5, 0.8)
"""Edges that differ by no more are one, metres. All are tried."""

_MARGINS = (0.0, 0.15)
"""Walls at the ends of a line that are no wider are left out, metres: surveys often end with their openings."""

_LOOSE = (0.3, 0.5, 0.8, 1.2, 2.0)
"""Openings that would need letters of their own may be so far from the column they join, metres."""

_NEAR, _RAISED = 1.0, 0.35
"""Bands whose sills and heads differ by no more may be one, where no door is raised or lowered by more, metres."""


def groupings(openings: Sequence[Opening]) -> Iterator[Grouping]:
    """Groupings at several tolerances; the exact one first."""
    scale = _scale(openings)
    for of_bands in _TOLERANCES:
        bands = tuple(map(tuple, _bands(openings, of_bands * scale)))
        for of_columns in _TOLERANCES:
            for margin in _MARGINS:
                yield Grouping(bands, of_columns * scale, max(LEAST, margin * scale))


def _scale(openings: Sequence[Opening]) -> float:
    """How large the façade's windows are beside usual ones."""
    return float(np.median([opening.y[1] - opening.y[0] for opening in openings])) / 1.5


def looser(openings: Sequence[Opening], grouping: Grouping, structure: Structure) -> Iterator[Grouping]:
    """Groupings in which some openings that have a line, a column or a band of their own join others."""
    scale = _scale(openings)
    for members in _apart(structure):
        for reach in _LOOSE:
            if reach * scale > max(grouping.tolerance, *(grouping.slack.get(i, 0.0) for i in members)):
                slack = {**grouping.slack, **dict.fromkeys(members, reach * scale)}
                yield replace(grouping, slack=slack)
    order = sorted(range(len(grouping.bands)), key=lambda n: (-len(grouping.bands[n]), n))
    for large, small in combinations(order, 2):
        own, other = grouping.bands[large], grouping.bands[small]
        firm = [i for i in own if i not in grouping.aside]
        if _mergeable(openings, firm, own, other, scale):
            rest = (band for n, band in enumerate(grouping.bands) if n not in (large, small))
            bands = (tuple(sorted(own + other)), *rest)
            yield replace(grouping, bands=bands, aside=grouping.aside | frozenset(other))


def _apart(structure: Structure) -> list[tuple[int, ...]]:
    """The openings of each line but the first along x, of each row there, and each that has a column for itself."""
    sets: dict[tuple[int, ...], list[int]] = {}
    for i, (line, column, band_line, band) in enumerate(structure.cells):
        for place in ((0, line), (1, line, band_line, band), (2, line, column)):
            sets.setdefault(place, []).append(i)
    found = [
        tuple(members)
        for (kind, line, *_), members in sorted(sets.items())
        if (line > 0 if kind < 2 else len(members) == 1)
    ]
    return list(dict.fromkeys(found))


def _mergeable(
    openings: Sequence[Opening], firm: Sequence[int], large: Sequence[int], small: Sequence[int], scale: float
) -> bool:
    """Whether openings of a band may stand in another: about there, beside its own, and no door above the ground."""
    low, high = mean(openings[i].y for i in firm)
    if any(max(abs(openings[i].y[0] - low), abs(openings[i].y[1] - high)) > _NEAR * scale for i in small):
        return False
    if any(abs(openings[i].y[0] - low) > _RAISED * scale for i in small if openings[i].door):
        return False
    return all(
        openings[i].x[1] <= openings[j].x[0] + 1e-6 or openings[j].x[1] <= openings[i].x[0] + 1e-6
        for i in small
        for j in large
    )


def _bands(openings: Sequence[Opening], tolerance: float) -> list[list[int]]:
    """The openings of each band."""
    numbers = clusters([opening.y for opening in openings], tolerance)
    bands: list[list[int]] = [[] for _ in range(max(numbers) + 1)]
    for i, number in enumerate(numbers):
        bands[number].append(i)
    return bands
