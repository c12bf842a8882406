"""Corners that faces share: what a triangle shows is told by its last vertex alone, so that others serve many faces.

Shaders take place, size, rule, seed, normal and tangent of a triangle from its last vertex (``flat`` in GLSL), and of
the other two their positions. So a face needs one vertex of its own, and half of all are not needed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .rings import Ints

__all__ = ["shared", "welded"]


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
    x, y, z = (mm - mm.min(axis=0, initial=0)).T
    # Whole numbers below 2 ** 31: two keys hold all that is compared, and those that stay come first.
    level = x << 32 | z << 1 | ~own[some]
    house = (owners[some] - owners.min(initial=0)) << 31 | y
    order = np.lexsort((level, house))
    spot, owner = level[order] >> 1, house[order]
    new = np.append(True, (spot[1:] != spot[:-1]) | (owner[1:] != owner[:-1]))
    first = some[order][np.flatnonzero(new)]
    becomes = np.arange(len(owners))
    # The first at a spot is one that stays, if there is one.
    becomes[some[order]] = np.where(own[some[order]], some[order], first[np.cumsum(new) - 1])
    kept = np.ones(len(owners), bool)
    kept[free] = becomes[free] == free
    number = np.cumsum(kept) - 1
    return np.flatnonzero(kept), number[becomes[triangles]]


def shared(spots: Ints, faces: Ints, triangles: Ints) -> tuple[Ints, Ints]:
    """Which vertices (k,) of loose triangles (t, 3) are kept, and these with them alone.

    Each triangle is turned so that it ends with a vertex of its own face, one that many triangles of this face have.

    Parameters
    ----------
    spots
        (v,) the number of the place at which each vertex is.
    faces
        (v,) the number of what it shows: of vertices at one spot with the same number one will do.
    """
    names = spots * (int(faces.max(initial=0)) + 1) + faces
    _, first, node = np.unique(names, return_index=True, return_inverse=True)
    corners = node[triangles]
    votes = np.bincount(corners.ravel(), minlength=len(first))
    rows = np.arange(len(triangles))
    for _ in range(_ROUNDS):
        last = (votes * len(votes) - np.arange(len(votes)))[corners].argmax(axis=1)
        votes = np.bincount(corners[rows, last], minlength=len(first))
    tells = first[votes > 0]
    # At spots where none tells anything one stays as well.
    at, one = np.unique(spots, return_index=True)
    stands = np.zeros(int(at.max(initial=-1)) + 1, np.int64)
    stands[at] = one
    stands[spots[tells]] = tells
    turned = triangles[rows[:, None], (last[:, None] + np.array([1, 2, 0])) % 3]
    turned = np.column_stack([stands[spots[turned[:, :2]]], first[node[turned[:, 2]]]])
    kept, index = np.unique(turned, return_inverse=True)
    return kept, index.reshape(-1, 3)


_ROUNDS = 4
"""So often triangles choose again which vertex tells what they show: one that others have chosen, too."""
