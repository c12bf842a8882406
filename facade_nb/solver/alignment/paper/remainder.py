"""What an alignment will cost from a node on, at least: the heuristic that informs the deepening.

*Pairs.* What the words still cost each other is told by `hierarchy`. The rest is told here.

*Shortfall.* W will be at least what is laid plus the longest rest of a word. A word whose rest is d metres short
of that has to make up for it: by ω, which is the same for all words of a column, or by leaving columns empty or
letters loose, which each word pays by itself at its weight w. So the cost is at least the minimum, over Ω ≥ 0, of
Ω + Σ w·max(0, d − Ω), and over all W that the tolerance allows, fit·|W − canvas| added. This is convex and
piecewise linear in W and Ω together, so that its least value is where it turns.

*Cover.* A column holds something of every word, or something opaque (C1). So W exceeds what a word has left and all
that the others have left of opaque letters, together, by no more than Ω.

The rest of a cut letter follows from what its pieces have taken so far. A piece may have left the lengths that
are free of cost at 1 a metre of ω; that is part of the same Ω.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from math import inf

from ...model.precision import EPS
from ..elements import Position
from ..group import Group

__all__ = ["Remainder"]


class Remainder:
    """The bounds of one group.

    Attributes
    ----------
    weights
        What a metre costs each band by which it falls short of W and for which ω does not make up.
    """

    def __init__(self, group: Group) -> None:
        self.group = group
        objective = group.objective
        self.weights = tuple(
            group.share
            * (
                min(objective.empty, objective.loose)
                if band.soft and not objective.plain
                else objective.empty
            )
            for band in group.bands
        )
        self._by_loose = 0.0 if objective.plain else objective.loose * group.share
        self._opaque: list[list[float]] = []
        for band in group.bands:
            rest = [0.0]
            for letter in reversed(band.letters):
                rest.append(rest[-1] + (letter.size or 0.0) * letter.opaque)
            self._opaque.append(rest[::-1])
        self._fills = [objective.plain or not band.soft for band in group.bands]

    def shortfall(
        self, state: Sequence[Position], spans: Sequence[tuple[float, float]], width: float, firm: bool
    ) -> float:
        """Least cost still to come; infinite where no W within the tolerance can be reached.

        Parameters
        ----------
        spans
            Per band: least and greatest size, at no cost, that the pieces of the cut letter have taken in which
            its head stands.
        width
            W of the columns laid.
        firm
            No column laid can be made wider without cost.
        """
        group = self.group
        canvas, objective = group.canvas, group.objective
        longest = soft = most_of_all = fixed = opaque = 0.0
        cover = inf
        rests: list[tuple[float, float]] = []  # width + rest, weight
        for b, (band, position) in enumerate(zip(group.bands, state, strict=True)):
            i = position >> 3
            if position & 4:
                least = band.rest_min[i + 1]
                longest = max(longest, least)
                size = band.letters[i].size
                if size is None:
                    most = inf
                else:
                    low, high = spans[b]
                    most = max(0.0, size - low) + band.rest_max[i + 1]
                    soft = max(soft, max(0.0, size - high) + least)
            else:
                longest = max(longest, band.rest_min[i])
                most = band.rest_max[i]
            most_of_all += most
            own = self._by_loose * band.soft_rest[i]
            fixed += own
            weight = self.weights[b]
            if weight > 0 and most < inf:
                rests.append((width + most + own / weight, weight))
            opaque_here = self._opaque[b][i]
            opaque += opaque_here
            if self._fills[b]:
                cover = min(cover, most - opaque_here)
        low = width + longest
        if low > canvas + group.tolerance + EPS:
            return inf
        if group.stiff and width + most_of_all < canvas - group.tolerance - EPS:
            return inf
        covered = inf if group.waived or not firm else width + cover + opaque
        soft += width
        below = objective.fit if firm else group.under
        floor = max(low, canvas - group.tolerance) if firm else low
        rests.sort()
        turns = [floor]
        if floor < canvas:
            turns.append(canvas)
        if floor < soft:
            turns.append(soft)
        top = max(canvas, soft)
        for rest in (*[own for own, _ in rests], covered):
            if floor < rest < top:
                turns.append(rest)
            if floor < (crossing := 0.5 * (soft + rest)) < soft:
                turns.append(crossing)
        best = inf
        for total in turns:
            over = total - canvas
            value = objective.fit * over if over > 0 else -below * over
            best = min(best, value + _made_up(rests, total, max(0.0, soft - total, total - covered)))
        return best + fixed


def _made_up(rests: Sequence[tuple[float, float]], total: float, need: float) -> float:
    """Least Ω + Σ w·max(0, d − Ω) with d = total − rest and Ω ≥ need; the smallest rests fall short the most."""
    short = bisect_left(rests, (total, -inf))
    omega, weight = need, 0.0
    for rest, own in rests[:short]:
        weight += own
        if weight > 1.0:  # from here on it is cheaper to let ω make up for all of them
            omega = max(need, total - rest)
            break
    return omega + sum(own * max(0.0, total - rest - omega) for rest, own in rests[:short])
