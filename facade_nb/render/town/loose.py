"""What stands apart in its block: rows of small houses, houses in gardens, slabs on a green, halls of industry."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, chance
from .footprints import Group
from .perimeter import Blocks, Edges
from .rings import Ints, inset, ragged, ring_numbers
from .roles import COURT, SIDE, STREET

__all__ = ["halls", "houses", "rows", "slabs"]

_ALL_ROUND = [STREET, SIDE, COURT, SIDE]


def rows(blocks: Blocks, seed: int) -> list[Group]:
    """Rows of small houses behind front gardens, five or six wall to wall, then a gap."""
    random = chance(seed, 6)
    count = len(blocks.corners)
    setback, deep = 4.0, 9.5
    edge, number, start = _lots(blocks, setback, deep, np.round(6.4 + 1.4 * random.random(count), 2))
    if not len(edge):
        return []
    wide, phase = (
        np.round(6.4 + 1.4 * chance(seed, 6).random(count), 2)[edge],
        random.integers(0, 6, count)[edge],
    )
    kept = (number + phase) % 6 != 5
    edge, wide, start = edge[kept], wide[kept], start[kept]
    back = np.round(setback + 1.2 * random.integers(0, 2, count)[edge], 2)
    corners = _boxes(blocks, edge, start, wide, back, np.full(len(edge), deep))
    return _apart(blocks, _group(blocks, edge, corners, _ALL_ROUND), 5.0)


def houses(blocks: Blocks, seed: int) -> list[Group]:
    """Houses in gardens, some with a wing."""
    random = chance(seed, 7)
    count = len(blocks.corners)
    lot = np.round(15 + 5 * random.random(count), 1)
    edge, _, start = _lots(blocks, 5.0, 10.0, lot)
    if not len(edge):
        return []
    m = len(edge)
    wide = np.round(np.minimum(8.5 + 4.5 * random.random(m), lot[edge] - 5), 1)
    deep = np.round(8 + 3 * random.random(m), 1)
    start = np.round(start + (lot[edge] - wide) * (0.3 + 0.4 * random.random(m)), 2)
    back = np.round(4.5 + 0.5 * random.integers(0, 6, m), 1)
    box = _boxes(blocks, edge, start, wide, back, deep)
    empty = random.random(m) < 0.04
    winged = (random.random(m) < 0.28) & (wide > 9.5)
    share = np.round(0.45 + 0.1 * random.random(m), 2)[:, None]
    out = np.round(2.5 + 1.5 * random.random(m), 1)
    inward = Edges.of(blocks).inward[edge] * out[:, None]
    split = box[:, 3] + (box[:, 2] - box[:, 3]) * share
    ell = np.stack([box[:, 0], box[:, 1], box[:, 2] + inward, split + inward, split, box[:, 3]], axis=1)
    found = []
    for corners, role, chosen in (
        (box, _ALL_ROUND, ~winged & ~empty),
        (ell, [STREET, SIDE, COURT, SIDE, COURT, SIDE], winged & ~empty),
    ):
        found.append(_group(blocks, edge, corners, role).take(chosen))
    return _apart(blocks, found, 5.5)


def slabs(blocks: Blocks, seed: int) -> list[Group]:
    """Slabs side by side on a green, each with its doors on one long side; here and there towers."""
    random = chance(seed, 8)
    count = len(blocks.rank)
    towers = random.random(count) < 0.22
    long = np.where(towers, 19.0, np.round(38 + 22 * random.random(count), 0))
    deep = np.where(towers, 18.0, np.round(11 + 1.5 * random.random(count), 1))
    gap = np.where(towers, 26.0, np.round(9 + 5 * random.random(count), 0))
    space = np.where(towers, 24.0, np.round(21 + 6 * random.random(count), 0))
    return _apart(blocks, _lattice(blocks, long, deep, gap, space, 5.0, random), 6.0)


def halls(blocks: Blocks, seed: int) -> list[Group]:
    """Halls of industry."""
    random = chance(seed, 9)
    count = len(blocks.rank)
    long = np.round(30 + 34 * random.random(count), 0)
    deep = np.round(20 + 16 * random.random(count), 0)
    gap = np.round(8 + 8 * random.random(count), 0)
    return _apart(blocks, _lattice(blocks, long, deep, gap, gap, 7.0, random), 5.0)


def _lots(blocks: Blocks, setback: float, deep: float, wide: Floats) -> tuple[Ints, Ints, Floats]:
    """Lots along edges: edge, number on it, metres from its start. The longer edge has the corner."""
    edges = Edges.of(blocks)
    order = np.lexsort((np.arange(len(edges.span)), -np.round(edges.span, 3)))
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    turn = np.maximum(np.abs(edges.sine), 0.5)
    bend = edges.sine / np.maximum(1 + edges.cosine, 0.2)
    sharp = edges.cosine < 0.9
    owns = rank < rank[edges.preceding]
    yields = (setback + deep + 5.0) / turn + np.maximum(bend, 0) * 2
    own = np.where(sharp, np.where(owns, 5.0 / turn + np.maximum(bend - 1, 0) * 9, yields), 1.5)
    follows = edges.following
    other = np.where(
        sharp[follows],
        np.where(
            rank < rank[follows], 5.0 / turn[follows] + np.maximum(bend[follows] - 1, 0) * 9, yields[follows]
        ),
        1.5,
    )
    room = edges.span - own - other
    count = np.maximum(np.floor(np.round(room / wide, 4)), 0).astype(np.int64)
    edge = np.repeat(np.arange(len(count)), count)
    number = ragged(np.zeros(len(count), np.int64), count)
    slack = (room - count * wide) / 2
    return edge, number, np.round((own + slack)[edge] + number * wide[edge], 3)


def _boxes(blocks: Blocks, edge: Ints, start: Floats, wide: Floats, back: Floats, deep: Floats) -> Floats:
    """Rectangles (m, 4, 2) along edges of blocks, some way back from them."""
    edges = Edges.of(blocks)
    along, inward = edges.along[edge], edges.inward[edge]
    foot = blocks.corners[edge] + along * start[:, None] + inward * back[:, None]
    side, rear = along * wide[:, None], inward * deep[:, None]
    return np.stack([foot, foot + side, foot + side + rear, foot + rear], axis=1)


def _group(blocks: Blocks, edge: Ints, corners: Floats, role: list[int]) -> Group:
    ring = ring_numbers(blocks.offsets)[edge]
    return Group(
        np.rint(corners * 1000) / 1000,
        np.tile(np.array(role, np.uint8), (len(edge), 1)),
        blocks.rank[ring],
        2 * edge,
        blocks.district[ring],
        blocks.street[edge],
        np.zeros(len(edge), bool),
    )


def _lattice(
    blocks: Blocks,
    long: Floats,
    deep: Floats,
    gap: Floats,
    space: Floats,
    margin: float,
    random: np.random.Generator,
) -> Group:
    """Rectangles in rows within blocks, square to each block's longest edge; their fronts look towards it or away."""
    edges = Edges.of(blocks)
    rings = ring_numbers(blocks.offsets)
    order = np.lexsort((np.arange(len(rings)), -np.round(edges.span, 3), rings))
    longest = order[blocks.offsets[:-1]]
    along, inward = edges.along[longest], edges.inward[longest]
    across = random.random(len(longest)) < 0.35
    along, inward = np.where(across[:, None], inward, along), np.where(across[:, None], -along, inward)
    at = blocks.corners - blocks.corners[longest][rings]
    u = (at * along[rings])[:, 0] + (at * along[rings])[:, 1]
    v = (at * inward[rings])[:, 0] + (at * inward[rings])[:, 1]
    u0, v0 = (np.minimum.reduceat(x, blocks.offsets[:-1]) for x in (u, v))
    u1, v1 = (np.maximum.reduceat(x, blocks.offsets[:-1]) for x in (u, v))
    columns = np.maximum(np.floor(np.round((u1 - u0 - 2 * margin + gap) / (long + gap), 4)), 1).astype(
        np.int64
    )
    lines = np.maximum(np.floor(np.round((v1 - v0 - 2 * margin + space) / (deep + space), 4)), 1).astype(
        np.int64
    )
    block = np.repeat(np.arange(len(longest)), columns * lines)
    number = ragged(np.zeros(len(longest), np.int64), columns * lines)
    column, line = number % columns[block], number // columns[block]
    spare_u = (u1 - u0 - columns * (long + gap) + gap) / 2
    spare_v = (v1 - v0 - lines * (deep + space) + space) / 2
    shrink = np.round(0.72 + 0.28 * random.random(len(block)), 2)
    x = (u0 + spare_u)[block] + column * (long + gap)[block]
    y = (v0 + spare_v)[block] + line * (deep + space)[block]
    foot = (blocks.corners[longest])[block] + along[block] * x[:, None] + inward[block] * y[:, None]
    side = along[block] * (long[block] * shrink)[:, None]
    rear = inward[block] * deep[block][:, None]
    corners = np.stack([foot, foot + side, foot + side + rear, foot + rear], axis=1)
    group = _group(blocks, longest[block], corners, _ALL_ROUND)
    return Group(group.corners, group.role, group.block, 2 * longest[block] + 0 * number, *(
        getattr(group, name) for name in ("district", "street", "corner")
    ))  # fmt: skip


def _apart(blocks: Blocks, groups: Group | list[Group], distance: float) -> list[Group]:
    """Those inside their block that keep a distance from what stands along its other edges, or touch as a row."""
    groups = groups if isinstance(groups, list) else [groups]
    polygons = np.concatenate([group.polygons() for group in groups])
    if not len(polygons):
        return []
    block = np.concatenate([group.block for group in groups])
    line = np.concatenate([group.line for group in groups])
    place = np.empty(blocks.rank.max() + 1, np.int64)
    place[blocks.rank] = np.arange(len(blocks.rank))
    shrunk, whole = inset(blocks.corners, blocks.offsets, 2.5)
    rings = Blocks(blocks.offsets, shrunk, blocks.street, blocks.district, blocks.rank).polygons()
    kept: NDArray[np.bool_] = whole[place[block]] & shapely.contains_properly(rings[place[block]], polygons)
    a, b = shapely.STRtree(polygons).query(polygons, predicate="dwithin", distance=distance)
    close = (line[a] != line[b]) | (shapely.relate_pattern(polygons[a], polygons[b], "T********"))
    close &= (a > b) & kept[a] & kept[b]
    # The first of two stays; what stands near one that goes may stay, in the order of the list.
    for one, other in zip(a[close].tolist(), b[close].tolist(), strict=True):
        if kept[one] and kept[other]:
            kept[one] = False
    ends = np.cumsum([len(group.block) for group in groups])[:-1]
    return [group.take(mask) for group, mask in zip(groups, np.split(kept, ends), strict=True)]
