"""What is still to come costs at least so much: by how far rows fall short of W, and by pairs of rows."""

from __future__ import annotations

from math import inf

from ...model.precision import EPS
from ..bands import Band
from ..group import Group
from .paths import Path, Span, State

__all__ = ["ahead", "shortfall"]


def shortfall(group: Group, path: Path) -> float:
    """Least cost still to come at the end of a path.

    With rests R_b and W ≥ `path.width` + max R_b, band b is short of W by at least d_b = W − width − R_b.
    In each column it is short by ω_j, or it is empty there and pays for it, or it holds a non-opaque letter
    and pays Λ. As ω is shared by all bands and Σ weights ≤ 1, Σ weight_b·d_b + fit·|W − canvas| is a lower
    bound, convex in W, so that its least is where it turns. Non-opaque letters to come are loose before
    whatever stands behind them, which a band pays if it is more than its part of that sum.

    Columns already laid could be made wider than they are charged for: a firm one at 1 > fit a metre, which
    never pays, another one at `under` a metre. Rests of cut and of unsized letters follow from what their
    pieces have taken so far; they are soft, because a piece may leave its range at 1 a metre of ω. So W may
    stay below the longest soft rest at that price, which is the same ω that pays for what bands are short
    of. Where every row counts in ω, non-opaque letters to come ask for some of it (`Band.fill`). Returns infinity
    where no W within the tolerance can be reached.
    """
    width, canvas, objective = path.width, group.canvas, group.objective
    longest = soft_longest = 0.0
    rests: list[tuple[float, float, float]] = []  # rest, weight, looseness
    by_loose = objective.loose * group.share
    strain = 0.0
    needs: list[tuple[float, int]] = []
    known = known_sizes(group, path) if group.tied else {}
    for b, (band, position, weight) in enumerate(zip(group.bands, path.state, group.weights, strict=True)):
        i = position >> 3
        mid = position & 4
        least = band.rest_min[i + 1] if mid else band.rest_min[i]
        most = band.rest_max[i]
        if least > longest:
            longest = least
        multiple = 1
        if band.tied:
            if mid and (size := band.letters[i].size) is not None:
                low, high, _ = path.spans[b]
                least = max(least, size - high + band.rest_min[i + 1])
                most = min(most, size - low + band.rest_max[i + 1]) if size > low else band.rest_max[i + 1]
            if known and (waiting := band.unsized_from(i + 1 if mid else i)):
                lows = [(n, known[symbol]) for symbol, n in waiting if symbol in known]
                copies = sum(n for n, _ in lows)
                multiple += copies
                least += sum(n * span[0] for n, span in lows)
                if len(lows) == len(waiting) and (not mid or band.letters[i].size is not None):
                    sized = band.rest_min[i] if not mid else most_sized(band, i, path.spans[b])
                    most = sized + sum(n * span[1] for n, span in lows)
                if copies > 1:
                    needs.append((width + least, copies))
                    least = 0.0
            if least > soft_longest:
                soft_longest = least
        strain += weight * multiple
        rests.append((most, weight, by_loose * band.soft_rest[i]))
    low = width + longest
    if low > canvas + group.tolerance + EPS:
        return inf
    below = objective.fit if path.firm else group.under
    scale = 1.0 if strain <= 1.0 else 1.0 / strain
    soft = width + soft_longest
    best = inf
    turns = [low]
    if low < canvas:
        turns.append(canvas)
    if low < soft:
        turns.append(soft)
    turns += [reach for reach, _ in needs if low < reach]
    top = max(canvas, soft, *(reach for reach, _ in needs))
    turns += [width + rest for rest, _, _ in rests if low < width + rest < top]
    for total in turns:
        over = total - canvas
        value = objective.fit * over if over > 0 else -below * over
        future = total - width
        short = loose = 0.0
        for rest, weight, own in rests:
            lack = weight * scale * (future - rest)
            if lack > own:
                short += lack - own
            loose += own
        need = soft - total
        for reach, copies in needs:
            need = max(need, (reach - total) / copies)
        value += loose + (need if need > short else short)
        if value < best:
            best = value
    gap = max([band.gap_rest[p >> 3] for band, p in zip(group.bands, path.state, strict=True)])
    return max(best, path.ahead + objective.fit * max(0.0, low - canvas), gap)


def known_sizes(group: Group, path: Path) -> dict[str, tuple[float, float]]:
    """What sizes unsized symbols may have at no cost, from those that stand and those that are being laid."""
    known: dict[str, tuple[float, float]] = {}
    for band, position, span in zip(group.bands, path.state, path.spans, strict=True):
        if position & 4:
            letter = band.letters[position >> 3]
            if letter.size is None and span[0] > known.get(letter.symbol, (0.0, inf))[0]:
                known[letter.symbol] = (span[0], inf)
    known.update((symbol, (low, high)) for symbol, low, high in path.learnt)
    return known


def most_sized(band: Band, i: int, span: Span) -> float:
    """Greatest size of the sized letters to come, of which letter i has given up `span` already."""
    return max(0.0, (band.letters[i].size or 0.0) - span[0]) + band.rest_min[i + 1]


def ahead(group: Group, state: State) -> float:
    """What the rows still cost each other, by pairs with the reference (see `pairs`)."""
    if group.reference is None:
        return 0.0
    place = state[group.reference]
    return sum(table.at(place, p) for table, p in zip(group.pairs, state, strict=True) if table is not None)
