"""Corners that faces share: what a triangle shows is told by its last vertex alone, so that others serve many faces.

Shaders take place, size, rule, seed, normal and tangent of a triangle from its last vertex (``flat`` in GLSL), and of
the other two their positions. So a face needs one vertex of its own, and half of all are not needed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .rings import Ints

__all__ = ["welded"]


def welded(
    positions: NDArray[np.float32], triangles: Ints, owners: Ints, own: NDArray[np.bool_]
) -> tuple[Ints, Ints]:
    """Which vertices (k,) are kept, and the triangles (t, 3) with these alone.

    Parameters
    ----------
    positions
        (v, 3) metres.
    owners
        (v,) vertices of different owners, or of none (-1), stay apart.
    own
        (v,) which must stay: they tell what a face shows. Each face has one, the last of all its triangles.
    """
    free = np.flatnonzero(~own & (owners != -1))
    some = np.flatnonzero(owners != -1)
    mm = np.rint(positions[some].astype(np.float64) * 1000).astype(np.int64)
    order = np.lexsort((some, ~own[some], mm[:, 2], mm[:, 1], mm[:, 0], owners[some]))
    spot, owner = mm[order], owners[some[order]]
    new = np.append(True, (spot[1:] != spot[:-1]).any(axis=1) | (owner[1:] != owner[:-1]))
    first = some[order][np.flatnonzero(new)]
    becomes = np.arange(len(owners))
    # The first at a spot is one that stays, if there is one.
    becomes[some[order]] = np.where(own[some[order]], some[order], first[np.cumsum(new) - 1])
    kept = np.ones(len(owners), bool)
    kept[free] = becomes[free] == free
    number = np.cumsum(kept) - 1
    return np.flatnonzero(kept), number[becomes[triangles]]
