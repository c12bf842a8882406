"""Values of many counters at once, those whose words come nearest to the canvas first.

With three counters or more a pattern can have more words than anybody could align. A word's size is a sum
of what each counter adds to it, so that the sums that can still be reached are known from the last counter
backwards, on a grid of the canvas; values are then enumerated without dead ends inside a window around the
canvas, which grows until there are enough.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import ceil, inf

__all__ = ["nearest_values"]

_CELLS = 4096


def nearest_values(
    added: Mapping[str, Sequence[tuple[int, float]]],
    base: float,
    canvas: float,
    limit: float,
    most: int,
    check: Callable[[], None] | None = None,
) -> tuple[list[dict[str, int]], float]:
    """Values of the counters whose word sizes are nearest to the canvas.

    Parameters
    ----------
    added
        Per counter: its possible values, each with the metres it adds to the word.
    base
        Size of the word without what the counters add.
    canvas, limit
        Metres; sizes beyond the limit are left out in any case.
    most
        How many are wanted at most, about.

    Returns
    -------
    values
        In no particular order.
    left
        Every combination that is left out misses the canvas by at least so many metres; infinite where none is.
    """
    names = sorted(added, key=lambda name: max(size for _, size in added[name]), reverse=True)
    cell = limit / _CELLS
    reach = _reachable([added[name] for name in names], cell)
    window = canvas / 256
    while True:
        found = _within(
            names, added, reach, cell, base, canvas - window, min(canvas + window, limit), most, check
        )
        if window >= max(canvas, limit - canvas):
            return found[:most], inf if len(found) <= most else 0.0
        if len(found) >= most:
            sizes = sorted(_miss(added, base, canvas, values) for values in found)
            edge = min(window, sizes[most - 1])
            return [v for v in found if _miss(added, base, canvas, v) <= edge], edge
        window *= 2.0


def _reachable(tables: Sequence[Sequence[tuple[int, float]]], cell: float) -> list[int]:
    """Per counter: a bit for every cell that the counters from there on can add up to, rounded down or up."""
    reach = [1]
    mask = (1 << (_CELLS + 2)) - 1
    for table in reversed(tables):
        after, bits = reach[-1], 0
        for _, size in table:
            shift = int(size / cell)
            bits |= (after << shift) | (after << (shift + 1))
        reach.append(bits & mask)
    return reach[::-1]


def _within(
    names: Sequence[str],
    added: Mapping[str, Sequence[tuple[int, float]]],
    reach: Sequence[int],
    cell: float,
    base: float,
    low: float,
    high: float,
    most: int,
    check: Callable[[], None] | None,
) -> list[dict[str, int]]:
    found: list[dict[str, int]] = []

    def descend(k: int, size: float, values: dict[str, int]) -> None:
        if check is not None:
            check()
        if k == len(names):
            if low - 1e-9 <= size <= high + 1e-9:
                found.append(values)
            return
        for value, own in added[names[k]]:
            total = size + own
            if total > high + 1e-9 or len(found) > 4 * most:
                continue
            first = max(0, int((low - total) / cell) - len(names))
            last = ceil((high - total) / cell) + 1
            if (reach[k + 1] >> first) & ((1 << (last - first + 1)) - 1):
                descend(k + 1, total, {**values, names[k]: value})

    descend(0, base, {})
    return found


def _miss(
    added: Mapping[str, Sequence[tuple[int, float]]], base: float, canvas: float, values: Mapping[str, int]
) -> float:
    return abs(base + sum(dict(added[name])[value] for name, value in values.items()) - canvas)
