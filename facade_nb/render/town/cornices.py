"""Cornices of flat roofs and mansards: they stand out of walls that no neighbour touches, along their upper edge."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .chance import Floats, length, millimetres
from .faces import Faces
from .plan import Plan
from .rings import Ints, after, before, line_offsets, offsets_of, ring_numbers
from .styles import Style

__all__ = ["CORNICES", "add_cornices"]

CORNICES = ("cornice.Stone", "cornice.Lead")
"""Rules of what is seen from below, and from above."""

_DEEP, _TIP, _RISE = 0.8, 0.05, 0.03
"""How far a cornice begins below the wall's end, as a part of how far it stands out; how far its edge lies below that
end; where it comes back to the wall above it, metres."""

_SHORTEST = 0.6
"""Walls that are shorter have none, metres."""


def add_cornices(
    faces: Faces, plan: Plan, styles: Sequence[Style], over: Floats, places: Mapping[str, tuple[int, int]]
) -> None:
    """Add the cornices to a mesh: from each wall out to an edge, back above it, and a cap where one ends.

    Parameters
    ----------
    over
        (n,) how far one stands out along each edge between true corners, metres; 0 where there is none.
    """
    true = ~plan.added
    corners, building = plan.corners[true], plan.building[true]
    counts = np.bincount(ring_numbers(plan.rings), weights=true, minlength=len(plan.ring_of))
    offsets = offsets_of(counts.astype(np.int64))
    following, preceding = after(offsets), before(offsets)
    span = length(corners[following] - corners)
    out = np.where(span > _SHORTEST, over, 0.0)
    if not out.any():
        return
    edges = millimetres(line_offsets(corners, offsets, -out))
    top = plan.eaves[building]
    # At sharp corners the edge would run far out; there, and where it would run backwards, is none.
    way, moved = corners[following] - corners, edges[following] - edges
    ahead = way[:, 0] * moved[:, 0] + way[:, 1] * moved[:, 1] > 0
    near = length(edges - corners) < 2.5 * np.maximum(out, out[preceding]) + 1e-9
    out = np.where(ahead & near & near[following], out, 0.0)
    own = np.flatnonzero(out > 0)
    wall, tip, end = top - millimetres(_DEEP * out), top - _TIP, top + _RISE

    def at(points: Floats, height: Floats, corner: Ints) -> Floats:
        return np.column_stack([points[corner], height[own]])

    here, there = own, following[own]
    below = [at(corners, wall, here), at(corners, wall, there), at(edges, tip, there), at(edges, tip, here)]
    above = [at(edges, tip, here), at(edges, tip, there), at(corners, end, there), at(corners, end, here)]
    seed = plan.seed[building] / 64.0
    level = np.column_stack([way, np.zeros(len(way))])
    lead = np.array([styles[k].name == "slab" for k in plan.style[building[own]]])
    stone = np.where(lead[:, None], np.array(places[CORNICES[1]]), np.array(places[CORNICES[0]])).astype(
        float
    )
    metal = np.tile(np.array(places[CORNICES[1]], float), (len(own), 1))
    for quad, start in ((below, stone), (above, metal)):
        faces.planes(np.stack(quad, axis=1), level[own], start, seed[own], building[own])
    for first, corner in ((True, own), (False, following[own])):
        beside = out[preceding[corner]] if first else out[corner]
        chosen = beside == 0
        if not chosen.any():
            continue
        cap = [at(corners, wall, corner), at(edges, tip, corner), at(corners, end, corner)]
        points = np.stack(cap if first else cap[::-1], axis=1)[chosen]
        aside = points[:, 1] - points[:, 0] if first else points[:, 1] - points[:, 2]
        faces.planes(points, aside * (1.0, 1.0, 0.0), stone[chosen], seed[own][chosen], building[own][chosen])
