"""Spines aligned with each other: opaque rows without gaps, in columns that all of them fill.

Two spines are searched best first, over all ways to cut them into the same number of columns. What has been cut off is
tried as it is found: where no sizes of the symbols make it, nothing that begins like it is looked at. Of more spines,
the best alignment is asked of the solver's search. Where that cannot be sized, its columns are joined until they can
be, and parted again where that is better; what comes of it may not be the best.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from heapq import heappop, heappush
from itertools import count, islice, pairwise, product
from math import inf
from typing import TypeVar

from ..solver.alignment.bands import Band
from ..solver.alignment.elements import Option, Position
from ..solver.alignment.group import Group
from ..solver.alignment.pricing import Columns, Priced, price
from ..solver.effort import Effort
from ..solver.selection.clusters import GroupSearch

__all__ = ["aligned"]

T = TypeVar("T")

_PATHS = 200_000
"""So many partial alignments of more than two spines are looked at."""

_TRIES = 400
"""So many ways to join columns are sized."""

_PARTS, _SPLITS = 20_000, 60
"""So many ways to part a column are looked at, and so many of the best of all columns are sized."""

_EPS = 1e-9

_Cut = tuple[int, ...]
"""How many letters of each spine stand before a boundary."""


def aligned(
    group: Group, fits: Callable[[Priced], T | None], check: Effort, most: float
) -> tuple[list[T], bool]:
    """What `fits` makes of the cheapest alignments that it takes, and whether no others are as cheap.

    Parameters
    ----------
    fits
        What an alignment comes to, once it is sized; None: it cannot be.
    most
        Alignments that cost as much or more are of no use.
    """
    if len(group.bands) == 2:
        return _pair(group, fits, check, most), True
    run = GroupSearch([group], "best", _PATHS, check, None)
    while not run.done:
        run.advance(inf)
    full = [
        priced for priced in run.ties if not any(o.empty for column in priced.structure[0] for o in column)
    ]
    found = [own for priced in full if (own := fits(priced)) is not None]
    if found or run.floor >= most:
        return found, not run.cut
    starts = [_cuts_of(priced) for priced in run.ties] or [[_start(group), _goal(group)]]
    joined = _joined(group, starts[0], fits, check)
    if joined is None:
        return [], False
    cuts, own = joined
    return [_parted(group, cuts, own, fits, check)], False


def _pair(group: Group, fits: Callable[[Priced], T | None], check: Effort, most: float) -> list[T]:
    """The cheapest alignments of two spines."""
    first, second = group.bands
    sums = [_sums(band) for band in group.bands]
    fit, canvas = group.objective.fit, group.canvas
    whole = max(own[0][-1] for own in sums)
    least = fit * abs(whole - canvas)
    rise = 1.0 - fit if whole < canvas else 1.0

    def cost(a: _Cut, b: _Cut) -> float:
        sizes = [size[e] - size[s] for (size, _), s, e in zip(sums, a, b, strict=True)]
        omega = abs(sizes[0] - sizes[1])
        if omega > group.tolerance + _EPS:
            return inf
        loose = sum(own[e - 1] - own[s] for (_, own), s, e in zip(sums, a, b, strict=True))
        return rise * omega + group.by_loose * loose

    n, m = len(first.letters), len(second.letters)
    rest = {(n, m): 0.0}
    for i in range(n - 1, -1, -1):
        for j in range(m - 1, -1, -1):
            check()
            rest[i, j] = min(
                cost((i, j), (p, q)) + rest.get((p, q), inf)
                for p in range(i + 1, n + 1)
                for q in range(j + 1, m + 1)
            )
    tick = count()
    queue: list[tuple[float, int, float, tuple[_Cut, ...], bool]] = [
        (least + rest[0, 0], 0, 0.0, ((0, 0),), False)
    ]
    best, found = most, []
    while queue:
        floor, _, spent, path, done = heappop(queue)
        if floor > best + _EPS or floor >= most:
            break
        check()
        if done:
            priced = _priced(group, path)
            own = None if priced is None else fits(priced)
            if own is not None:
                best = min(best, floor)
                found.append(own)
            continue
        i, j = path[-1]
        begun = _priced(group, (*path, (n, m))) if len(path) > 1 else None
        if begun is not None and fits(begun) is None:
            continue
        for p in range(i + 1, n + 1):
            for q in range(j + 1, m + 1):
                ahead = rest.get((p, q), inf)
                if ahead == inf:
                    continue
                so_far = spent + cost((i, j), (p, q))
                longer = (*path, (p, q))
                if (p, q) == (n, m):
                    complete = _priced(group, longer)
                    if complete is not None:
                        heappush(queue, (complete.cost, next(tick), so_far, longer, True))
                elif least + so_far + ahead <= best + _EPS:
                    heappush(queue, (least + so_far + ahead, next(tick), so_far, longer, False))
    return found


def _sums(band: Band) -> tuple[list[float], list[float]]:
    """Sizes of a spine's letters summed, and what neighbours cost that stand in one column."""
    sizes = [letter.size or 0.0 for letter in band.letters]
    total, loose = [0.0], [0.0]
    for k, size in enumerate(sizes):
        total.append(total[-1] + size)
        if k:
            loose.append(loose[-1] + min(size, sizes[k - 1]))
    return total, [*loose, loose[-1]]


def _start(group: Group) -> _Cut:
    return (0,) * len(group.bands)


def _goal(group: Group) -> _Cut:
    return tuple(len(band.letters) for band in group.bands)


def _cuts_of(priced: Priced) -> list[_Cut]:
    """The boundaries of an alignment at which every spine has got further."""
    at = [0] * len(priced.structure[0][0])
    found = [tuple(at)]
    for column in priced.structure[0]:
        at = [n + len(option.letters) for n, option in zip(at, column, strict=True)]
        if all(n > before for n, before in zip(at, found[-1], strict=True)):
            found.append(tuple(at))
    found[-1] = tuple(at)
    return found


def _joined(
    group: Group, cuts: Sequence[_Cut], fits: Callable[[Priced], T | None], check: Effort
) -> tuple[Sequence[_Cut], T] | None:
    """The cheapest of what comes of an alignment by leaving out boundaries: those that are left, and what it is."""
    tick = count()
    queue = [(0.0, 0, tuple(cuts))]
    seen = {tuple(cuts)}
    for _ in range(_TRIES):
        if not queue:
            return None
        check()
        _, _, path = heappop(queue)
        priced = _priced(group, path)
        own = None if priced is None else fits(priced)
        if own is not None:
            return path, own
        for k in range(1, len(path) - 1):
            shorter = (*path[:k], *path[k + 1 :])
            if shorter not in seen:
                seen.add(shorter)
                dear = _priced(group, shorter)
                heappush(queue, (inf if dear is None else dear.cost, next(tick), shorter))
    ends = _start(group), _goal(group)
    priced = _priced(group, ends)
    own = None if priced is None else fits(priced)
    return None if own is None else (ends, own)


def _parted(
    group: Group, cuts: Sequence[_Cut], own: T, fits: Callable[[Priced], T | None], check: Effort
) -> T:
    """An alignment with boundaries more, as long as one makes it cheaper and can be sized."""
    sums = [_sums(band) for band in group.bands]

    def cost(a: _Cut, b: _Cut) -> float:
        sizes = [size[e] - size[s] for (size, _), s, e in zip(sums, a, b, strict=True)]
        loose = sum(own[e - 1] - own[s] for (_, own), s, e in zip(sums, a, b, strict=True))
        return max(sizes) - min(sizes) + group.by_loose * loose

    path = list(cuts)
    for _ in range(len(group.bands[0].letters)):
        gains: list[tuple[float, int, _Cut]] = []
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
            priced = _priced(group, longer)
            better = None if priced is None else fits(priced)
            if better is not None:
                path, own = longer, better
                break
        else:
            break
    return own


def _priced(group: Group, cuts: Sequence[_Cut]) -> Priced | None:
    """The alignment with some boundaries; None: its columns are out of tolerance."""
    rows = [list(_elements(band, [cut[b] for cut in cuts])) for b, band in enumerate(group.bands)]
    columns: Columns = tuple(zip(*rows, strict=True))
    return price([group], (columns,))


def _elements(band: Band, stops: Sequence[int]) -> Iterator[Option]:
    position: Position = 0
    for start, end in pairwise(stops):
        option = next(o for o in band.options(position) if o.letters == tuple(range(start, end)))
        position = option.target
        yield option
