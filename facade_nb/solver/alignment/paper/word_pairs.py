"""Words aligned pair by pair, and the pairs with each other (supplement 3.3).

The words are paired in the order of the stack, and each pair is aligned by itself. Of two such alignments the
columns are then joined, never broken up: the network of both has the columns of one along one side and those of
the other along the other side, two dimensions again. After log m rounds all words are together.

Greedy as it is, the result need not be the best alignment. See `guides` for what is made of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from ..group import Group, make_group
from ..pricing import Structure
from .guides import Guide, nodes_between

__all__ = ["merged_guides"]

Align = Callable[[Group, Sequence[Guide]], Structure | None]
"""Some good alignment of a group along guides."""


def merged_guides(g: int, group: Group, align: Align) -> list[Guide]:
    """The last two alignments, whose columns are still to be joined; fewer where one was not found."""
    level: list[tuple[tuple[int, ...], list[Guide]]] = [((b,), []) for b in range(len(group.bands))]
    while len(level) > 2:
        joined: list[tuple[tuple[int, ...], list[Guide]]] = []
        for left, right in zip(level[::2], level[1::2], strict=False):
            bands = (*left[0], *right[0])
            along = [*left[1], *right[1]]
            found = _merge(g, group, bands, along, align)
            joined.append((bands, along if found is None else [found]))
        if len(level) % 2:
            joined.append(level[-1])
        level = joined
    return [guide for _, guides in level for guide in guides]


def _merge(
    g: int, group: Group, bands: tuple[int, ...], along: Sequence[Guide], align: Align
) -> Guide | None:
    """Align some words along what their parts were aligned to.

    What C1 asks of a column may be in another word, so here it is not asked for.
    """
    place = {b: n for n, b in enumerate(bands)}
    part = replace(
        make_group(
            [group.bands[b].letters for b in bands],
            group.canvas,
            group.tolerance,
            group.objective,
            cuts=all(band.cuts for band in group.bands),
            free=frozenset().union(*(band.free for band in group.bands)),
            check=group.bands[0].check,
        ),
        waived=True,
    )
    inner = [Guide(0, tuple(place[b] for b in own.bands), own.nodes, own.strict) for own in along]
    structure = align(part, inner)
    if structure is None:
        return None
    return Guide(g, bands, nodes_between(group, bands, structure[0]), strict=False)
