"""Spines aligned with each other quickly: opaque rows without gaps, in columns that all of them fill.

What `cuts` finds is the best there is. Here an answer is made at once, so that there is one when the time is over, or
where there are too many ways to look at them all: one column is parted, again and again, where that gains most and
sizes can make it. What comes of it may not be the best.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import islice, pairwise, product
from typing import TypeVar

from ..solver.alignment.pricing import Priced
from ..solver.effort import Effort
from .cuts import Cut, Ways, priced

__all__ = ["quickly"]

T = TypeVar("T")

_PARTS, _SPLITS = 20_000, 60
"""So many ways to part a column are looked at, and so many of the best of all columns are sized."""

_EPS = 1e-9


def quickly(ways: Ways, fits: Callable[[Priced], T | None], check: Effort) -> T | None:
    """What `fits` makes of a good alignment of spines; None: none was found that can be sized."""
    spines, group = ways.spines, ways.group
    path: list[Cut] = [(0,) * len(spines), tuple(len(band.letters) for band in group.bands)]
    made = priced(group, path)
    own = None if made is None else fits(made)
    return None if own is None else _parted(ways, path, own, fits, check)


def _parted(ways: Ways, path: list[Cut], own: T, fits: Callable[[Priced], T | None], check: Effort) -> T:
    """An alignment with boundaries more, as long as one makes it cheaper and can be sized."""
    spines, group = ways.spines, ways.group

    def cost(a: Cut, b: Cut) -> float:
        sizes = [own.sizes[e] - own.sizes[s] for own, s, e in zip(spines, a, b, strict=True)]
        loose = sum(own.loose[e - 1] - own.loose[s] for own, s, e in zip(spines, a, b, strict=True))
        return float(max(sizes) - min(sizes) + group.by_loose * loose)

    for _ in range(len(group.bands[0].letters)):
        gains: list[tuple[float, int, Cut]] = []
        for k, (a, b) in enumerate(pairwise(path)):
            check()
            now = cost(a, b)
            for middle in islice(product(*(range(s + 1, e) for s, e in zip(a, b, strict=True))), _PARTS):
                gain = now - cost(a, middle) - cost(middle, b)
                if gain > _EPS:
                    gains.append((-gain, k, middle))
        for _, k, middle in sorted(gains)[:_SPLITS]:
            check()
            longer = [*path[: k + 1], middle, *path[k + 1 :]]
            made = priced(group, longer)
            better = None if made is None else fits(made)
            if better is not None:
                path, own = longer, better
                break
        else:
            break
    return own
