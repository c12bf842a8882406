"""The alignment of a word that stands alone: each letter is a column.

Nothing is looked for, so that a word may have as many letters as there can be. A row alone has no errors (Eq. 9), and
two letters in one column are looser than in two and fewer columns, so that one structure is the best.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from ..model.precision import EPS
from .elements import Option
from .found import Found
from .group import Group
from .pricing import price

__all__ = ["lone"]


def lone(groups: Sequence[Group]) -> Found | None:
    """What any search finds for one group of one word, all of whose letters are solid; None for other groups."""
    if len(groups) != 1 or len(groups[0].bands) != 1:
        return None
    (group,), (band,) = groups, groups[0].bands
    if not band.letters or not all(a.size and not a.transparent for a in band.letters):
        return None
    if band.soft and (not group.waived or any(a.unoccludable for a in band.letters)):
        return None if group.waived else Found(bound=inf)  # nothing can stand behind it (C1)
    if abs(band.rest_min[0] - group.canvas) > group.tolerance + EPS:
        return Found(bound=inf)
    columns: list[tuple[Option, ...]] = []
    state = 0
    for _ in band.letters:
        option = band.option(state, 0 if state & 1 else 1)  # before a letter that has to follow there is no ε
        columns.append((option,))
        state = option.target
    priced = price(groups, (tuple(columns),))
    return Found(bound=inf) if priced is None else Found([priced], priced.cost)
