"""Both axes together, where a counter stands on both: the least J of both."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from heapq import heappop, heappush
from math import inf

from ...design.model import AXES, Axis
from ..budget import Stopped
from ..model.precision import EPS
from ..selection.axis import AxisSearch, Best
from .run import Found, Run, Unsolved

__all__ = ["tied"]


def tied(run: Run, axes: Sequence[Axis] = AXES) -> Found:
    """Both axes together, where a counter ties them: least J of both, over the values of the shared counters."""
    walks = {axis: run.walk(axis, run.tolerances[-1]) for axis in axes}
    best: Mapping[Axis, Best] | None = None
    rank: _Rank = (inf, 0, inf, ())
    bound, complete = inf, True
    pairs = _by_floor(run, walks)
    left = min(walk.left_out for walk in walks.values())
    while True:
        try:
            floor, side_x, side_y = next(pairs, (inf, None, None))
        except Stopped:
            complete, bound = False, 0.0
            break
        if floor > rank[0] + 1e-9 or side_x is None or side_y is None:
            bound = min(bound, floor)
            break
        x = run.best(side_x, rank[0] - side_y.floor)
        y = run.best(side_y, rank[0] - x.cost) if x.solved else Best(bound=side_y.floor)
        side_x.leave()
        side_y.leave()
        complete = complete and x.complete and y.complete
        bound = min(bound, x.bound + y.bound)
        if x.solved is not None and y.solved is not None:
            deviation = x.solved.sized.deviation + y.solved.sized.deviation
            values = tuple(x.solved.candidate.counters[name] for name in run.shared)
            columns = x.solved.columns + y.solved.columns
            own = (x.solved.cost + y.solved.cost, -columns, deviation, values)
            if _less(own, rank):
                best, rank = {"x": x, "y": y}, own
        if not complete:
            bound = min(bound, floor)  # the others, which come later, cost no less
            break
    bound = min(bound, left)
    if best is None:
        raise Unsolved(walks["x"], Best(complete=complete), walks["y"])
    gap = max(0.0, rank[0] - bound)
    for axis in AXES:
        own_best = best[axis]
        own_best.complete = complete
        own_best.bound = (own_best.solved.cost if own_best.solved else 0.0) - gap
    return {axis: (walks[axis], best[axis]) for axis in AXES}


def _by_floor(run: Run, walks: Mapping[Axis, AxisSearch]) -> Iterator[tuple[float, AxisSearch, AxisSearch]]:
    """Both axes with the shared counters held at values that both have, by growing lower bound of J."""
    streams = [walks[axis].restricted({}).stream for axis in AXES]
    across, up = streams
    assert across is not None and up is not None
    least = [across.bound, up.bound]
    floors: list[dict[tuple[int, ...], float]] = [
        {},
        {},
    ]  # of the first, and so the best, candidate with some values
    ahead: list[tuple[float, tuple[int, ...]]] = []
    while True:
        unseen = min(across.bound + least[1], least[0] + up.bound)
        if unseen == inf and not ahead:
            return
        if ahead and ahead[0][0] <= unseen:
            floor, values = heappop(ahead)
            held = dict(zip(run.shared, values, strict=True))
            yield floor, walks["x"].restricted(held), walks["y"].restricted(held)
            continue
        turn = 0 if across.bound + least[1] <= least[0] + up.bound else 1
        candidate = (across, up)[turn].take()
        assert candidate is not None
        values = tuple(candidate.counters[name] for name in run.shared)
        if values not in floors[turn]:
            floors[turn][values] = candidate.bound
            if values in floors[1 - turn]:
                heappush(ahead, (floors[0][values] + floors[1][values], values))


_Rank = tuple[float, int, float, tuple[int, ...]]
"""J, minus the columns, deviation, values of the shared counters."""


def _less(a: _Rank, b: _Rank) -> bool:
    """In this order; costs and deviations that are all but equal are equal."""
    if abs(a[0] - b[0]) > EPS:
        return a[0] < b[0]
    if a[1] != b[1]:
        return a[1] < b[1]
    if abs(a[2] - b[2]) > EPS:
        return a[2] < b[2]
    return a[3] < b[3]
