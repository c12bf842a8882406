"""What hangs together by links between pairs."""

from __future__ import annotations

import numpy as np

from .rings import Ints

__all__ = ["groups_of"]


def groups_of(pairs: Ints, count: int) -> tuple[int, Ints]:
    """How many groups things form that are linked in pairs, and the group of each.

    Parameters
    ----------
    pairs : (n, 2)
        Numbers of the things that a link joins.
    count
        How many things there are.
    """
    from scipy.sparse import coo_matrix  # a studio is imported without
    from scipy.sparse.csgraph import connected_components

    link = coo_matrix((np.ones(len(pairs), np.int8), np.asarray(pairs).reshape(-1, 2).T), (count, count))
    groups, label = connected_components(link, directed=False)
    return int(groups), label
