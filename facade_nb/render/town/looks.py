"""Seeds with which no house looks like the one beside it or across the street.

A façade's first random choice looks up the noise texture at its corner, which is the seed. So what it chooses is known
beforehand: the neighbours' looks are passed over, and a seed is drawn that gives another one.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..pipeline.vertices import SEEDS
from ..texture.noise import look_up
from .chance import chance
from .rings import Ints, offsets_of
from .styles import Style

__all__ = ["choose_seeds", "lists_of", "looks_of"]

_TRIES = 48


def looks_of(seed: NDArray[np.int32], looks: NDArray[np.integer]) -> Ints:
    """What seeds (…, 2) in steps choose among so many looks (…)."""
    steps = np.ascontiguousarray(seed, np.int32)
    number = look_up(np.ascontiguousarray(steps[..., 0]), np.ascontiguousarray(steps[..., 1]))
    return np.minimum((number * looks.astype(np.float32)).astype(np.int64), looks - 1)


def choose_seeds(
    style: NDArray[np.int32], styles: Sequence[Style], near: Ints, beside: Ints, seed: int
) -> NDArray[np.int32]:
    """A seed for each building, steps of 1/64 m.

    Parameters
    ----------
    style
        (b,) of each.
    near, beside
        (m, 2) pairs of buildings that see each other, and (k, 2) that touch. Where there are fewer looks than
        neighbours, those that touch come first.
    """
    count = len(style)
    looks = np.array([max(1, one.looks) for one in styles])[style]
    seeds = chance(seed, 22).integers(0, SEEDS, (count, _TRIES, 2), dtype=np.int32)
    found = looks_of(seeds, np.broadcast_to(looks[:, None], seeds.shape[:2]))
    wish = chance(seed, 23).permuted(np.tile(np.arange(int(looks.max(initial=1))), (count, 1)), axis=1)
    first = [lists_of(pairs[style[pairs[:, 0]] == style[pairs[:, 1]]], count) for pairs in (beside, near)]
    (hard_at, hard), (soft_at, soft) = first
    chosen = [-1] * count
    for k in range(count):
        own = int(looks[k])
        if own == 1:
            chosen[k] = 0
            continue
        never = {chosen[j] for j in hard[hard_at[k] : hard_at[k + 1]]}
        rather = {chosen[j] for j in soft[soft_at[k] : soft_at[k + 1]]}
        order = [w for w in wish[k].tolist() if w < own]
        free = [w for w in order if w not in never]
        chosen[k] = next((w for w in free if w not in rather), free[0] if free else order[0])
    right = found == np.array(chosen)[:, None]
    return np.ascontiguousarray(seeds[np.arange(count), right.argmax(axis=1)])


def lists_of(pairs: Ints, count: int) -> tuple[list[int], list[int]]:
    """For each building, which ones it is paired with: offsets and a flat list."""
    both = np.concatenate([pairs, pairs[:, ::-1]])
    order = np.lexsort((both[:, 1], both[:, 0]))
    return offsets_of(np.bincount(both[:, 0], minlength=count)).tolist(), both[order, 1].tolist()
