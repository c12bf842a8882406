"""Chimneys: on the ridges of houses that people live in."""

from __future__ import annotations

import numpy as np

from .chance import chance
from .plan import GABLE, HIP, INDUSTRIAL, OUTBUILDING, Plan
from .rings import offsets_of, ring_numbers
from .things import CHIMNEY, Things

__all__ = ["chimneys_of"]

_SHARE = 0.5
"""Of the roofs that may have one."""


def chimneys_of(plan: Plan, seed: int) -> Things:
    """A chimney each on some of the roofs with a ridge between four walls."""
    true = ~plan.added
    number = ring_numbers(plan.rings)
    counts = np.bincount(number, weights=true, minlength=len(plan.ring_of)).astype(np.int64)
    corners, offsets = plan.corners[true], offsets_of(counts)
    first = np.flatnonzero(np.append(True, plan.ring_of[1:] != plan.ring_of[:-1]))
    chances, along = chance(seed, 65).random((2, len(plan)))
    fit = np.isin(plan.roof, (GABLE, HIP)) & (plan.eave >= 0) & (counts[first] == 4) & (chances < _SHARE)
    fit &= ~np.isin(plan.kind, (INDUSTRIAL, OUTBUILDING))
    own = np.flatnonzero(fit)
    a, b, c, d = (corners[offsets[first[own]] + (plan.eave[own] + k) % 4] for k in range(4))
    one, other = (a + d) / 2, (b + c) / 2
    share = np.where(plan.roof[own] == HIP, 0.5, 0.2 + 0.6 * along[own])
    at = one + (other - one) * share[:, None]
    ridge = plan.eaves[own] + plan.rise[own]
    return Things.of(at, CHIMNEY, 1.7, 0.62, ridge - 0.85)
