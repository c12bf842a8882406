"""Blocks built up around their edge: houses wall to wall along the street, corner houses that turn the corner."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, chance, length, millimetres
from .footprints import District, Group
from .rings import Ints, after, before, inset, line_offsets, offsets_of, ragged, ring_numbers, take_rings
from .roles import COURT, SIDE, STREET

__all__ = ["Blocks", "Edges", "blunted", "perimeter"]


@dataclass(frozen=True, slots=True, eq=False)
class Blocks:
    """Blocks to be built up.

    Attributes
    ----------
    offsets, corners
        Their rings, counter-clockwise.
    street
        (n,) kind of the street along each edge.
    district
        (k,) of each block.
    rank
        (k,) which block it is in the order in which the town grows.
    """

    offsets: Ints
    corners: Floats
    street: Ints
    district: Ints
    rank: Ints

    def take(self, chosen: Ints) -> Blocks:
        """Some of them."""
        index, offsets = take_rings(self.offsets, chosen)
        return Blocks(
            offsets, self.corners[index], self.street[index], self.district[chosen], self.rank[chosen]
        )

    def where(self, *districts: int) -> Blocks:
        """Those of some districts."""
        return self.take(np.flatnonzero(np.isin(self.district, districts)))

    def polygons(self) -> NDArray[np.object_]:
        """As shapely's polygons."""
        rings = shapely.linearrings(self.corners, indices=ring_numbers(self.offsets))
        return np.asarray(shapely.polygons(rings), object)


@dataclass(frozen=True, slots=True, eq=False)
class Edges:
    """Edges of blocks: direction, normal to the inside, length; turn (sine, cosine) and mitre at the first corner."""

    along: Floats
    inward: Floats
    span: Floats
    sine: Floats
    cosine: Floats
    following: Ints
    preceding: Ints

    @classmethod
    def of(cls, blocks: Blocks) -> Edges:
        """The edges of blocks."""
        following, preceding = after(blocks.offsets), before(blocks.offsets)
        way = blocks.corners[following] - blocks.corners
        span = length(way)
        along = way / np.maximum(span, 1e-9)[:, None]
        there = along[preceding]
        sine = np.round(there[:, 0] * along[:, 1] - there[:, 1] * along[:, 0], 6)
        cosine = np.round(there[:, 0] * along[:, 0] + there[:, 1] * along[:, 1], 6)
        inward = np.stack([-along[:, 1], along[:, 0]], axis=1)
        return cls(along, inward, span, sine, cosine, following, preceding)


def perimeter(blocks: Blocks, seed: int) -> tuple[list[Group], Blocks]:
    """Houses around the edges of blocks, and the blocks that are too narrow for it."""
    random = chance(seed, 2)
    count = len(blocks.rank)
    old = blocks.district == District.OLD
    depth = np.round(np.where(old, 9 + 2.5 * random.random(count), 11 + 2.5 * random.random(count)), 1)
    room = 5.0 + 4.0 * random.random(len(blocks.corners))
    rings = ring_numbers(blocks.offsets)
    fits = np.zeros(count, bool)
    for share in (1.0, 0.85, 0.72):
        own = np.where(fits, depth, np.round(depth * share, 1))
        _, fine = _allot(blocks, own, room)
        _, whole = inset(blocks.corners, blocks.offsets, own[rings] + 3.0)
        good = fine & whole & ~fits
        depth = np.where(good, own, depth)
        fits |= good
    rest = blocks.take(np.flatnonzero(~fits))
    blocks, depth, room = blocks.take(np.flatnonzero(fits)), depth[fits], room[fits[rings]]
    if not len(blocks.rank):
        return [], rest
    (start, end, sharp), _ = _allot(blocks, depth, room)
    groups = _corners(blocks, depth, start, end, sharp, seed)
    groups += _middles(blocks, depth, start, end, sharp, seed)
    return groups, rest


def blunted(blocks: Blocks) -> Blocks:
    """Blocks with their acute corners cut off: there is a small place, and houses of a usable shape."""
    edges = Edges.of(blocks)
    half = edges.sine / np.maximum(1 + edges.cosine, 0.05)
    # Angles below 56°; the sine of half the angle inside is the cosine of half the turn.
    narrow = 1 / np.sqrt(1 + half * half)
    back = np.round(9.5 / np.maximum(narrow, 0.15), 3)
    acute = (half > 1.9) & (back < 0.45 * np.minimum(edges.span, edges.span[edges.preceding]))
    counts = np.where(acute, 2, 1)
    corner = np.repeat(np.arange(len(counts)), counts)
    second = np.append(False, corner[1:] == corner[:-1])
    first = acute[corner] & ~second
    away = np.where(
        first[:, None],
        -edges.along[edges.preceding[corner]] * back[corner][:, None],
        np.where(second[:, None], edges.along[corner] * back[corner][:, None], 0),
    )
    street = np.where(
        first,
        np.minimum(blocks.street[corner], blocks.street[edges.preceding[corner]]),
        blocks.street[corner],
    )
    offsets = offsets_of(np.add.reduceat(counts, blocks.offsets[:-1]))
    return Blocks(offsets, millimetres(blocks.corners[corner] + away), street, blocks.district, blocks.rank)


def _allot(
    blocks: Blocks, depth: Floats, room: Floats
) -> tuple[tuple[Floats, Floats, NDArray[np.bool_]], NDArray[np.bool_]]:
    """Metres of edges that go to the corner houses at start and end, which corners have one, which blocks fit."""
    edges, rings = Edges.of(blocks), ring_numbers(blocks.offsets)
    sharp = (edges.cosine < 0.94) & (edges.sine > 0)
    half = edges.sine / np.maximum(1 + edges.cosine, 0.05)  # the tangent of half the turn
    least = np.where(sharp, depth[rings] * half, 0)
    room = np.where(sharp, room, 0)
    first, last = room, room[edges.following]
    left = edges.span - least - least[edges.following]
    both = sharp & sharp[edges.following]
    short = left - first - last < 9.0
    spare = np.where(short, left - first - last, 0.0)
    shared = np.where(both, spare / 2, spare)
    first = np.where(short & sharp, first + shared, first)
    last = np.where(short & sharp[edges.following], last + shared, last)
    bad = (
        (sharp & (first < 2.5)) | (sharp[edges.following] & (last < 2.5)) | (half > 2.2) | (edges.sine < -0.3)
    )
    bad |= ~sharp & ~sharp[edges.following] & (edges.span < 7)
    fine = np.ones(len(blocks.rank), bool)
    np.logical_and.at(fine, rings, ~bad)
    return (np.round(least + first, 3), np.round(least[edges.following] + last, 3), sharp), fine


def _corners(
    blocks: Blocks, depth: Floats, start: Floats, end: Floats, sharp: NDArray[np.bool_], seed: int
) -> list[Group]:
    """Houses at corners: six edges, or seven where the corner is cut off for a door."""
    edges, rings = Edges.of(blocks), ring_numbers(blocks.offsets)
    at = np.flatnonzero(sharp)
    back = edges.preceding[at]
    random = chance(seed, 4)
    deep = depth[rings[at]][:, None]
    inner = line_offsets(blocks.corners, blocks.offsets, depth[rings])[at]
    corner = blocks.corners[at]
    before_it = corner - edges.along[back] * end[back][:, None]
    behind_it = corner + edges.along[at] * start[at][:, None]
    # A house that reaches as far as a slight bend ends there as its neighbour begins.
    mitre = line_offsets(blocks.corners, blocks.offsets, 1.0) - blocks.corners
    ahead = edges.following[at]
    on = (np.abs(start[at] - edges.span[at]) < 0.01) & ~sharp[ahead]
    before_bend = (np.abs(end[back] - edges.span[back]) < 0.01) & ~sharp[back]
    from_behind = np.where(on[:, None], mitre[ahead], edges.inward[at])
    from_before = np.where(before_bend[:, None], mitre[back], edges.inward[back])
    behind = [behind_it + from_behind * deep, inner, before_it + from_before * deep]
    district = blocks.district[rings[at]]
    street = np.minimum(blocks.street[at], blocks.street[back])
    plain = random.random(len(at))
    cut = np.round(2.4 + 1.2 * random.random(len(at)), 2)[:, None]
    chamfered = (
        (plain < 0.6) & (district == District.INNER) & (edges.cosine[at] < 0.6) & (edges.cosine[at] > -0.5)
    )
    # Lines in the order of walking around the block: this house stands before the edge that begins here.
    common = (blocks.rank[rings[at]], 2 * at, district, street, np.ones(len(at), bool))
    six = np.stack([before_it, corner, behind_it, *behind], axis=1)
    seven = np.stack(
        [before_it, corner - edges.along[back] * cut, corner + edges.along[at] * cut, behind_it, *behind],
        axis=1,
    )
    found = []
    for corners, chosen, role in (
        (six, ~chamfered, [STREET, STREET, SIDE, COURT, COURT, SIDE]),
        (seven, chamfered, [STREET, STREET, STREET, SIDE, COURT, COURT, SIDE]),
    ):
        roles = np.tile(np.array(role, np.uint8), (len(at), 1))
        found.append(Group(corners, roles, *common).take(chosen))
    return found


def _middles(
    blocks: Blocks, depth: Floats, start: Floats, end: Floats, sharp: NDArray[np.bool_], seed: int
) -> list[Group]:
    """Houses along edges, wall to wall; some have a wing into the yard."""
    edges, rings = Edges.of(blocks), ring_numbers(blocks.offsets)
    random = chance(seed, 5)
    old = blocks.district[rings] == District.OLD
    wide = np.where(old, 7.5 + 5 * random.random(len(old)), 14 + 7 * random.random(len(old)))
    room = np.round(edges.span - start - end, 3)
    count = np.where(room > 6.0, np.maximum(1, np.rint(room / wide)), 0).astype(np.int64)
    edge = np.repeat(np.arange(len(count)), count)
    number = ragged(np.zeros(len(count), np.int64), count)
    parts = count[edge]
    shake = 0.36 * (random.random((len(edge), 1))[:, 0] - 0.5)
    low = np.where(number == 0, 0.0, (number + shake) / parts)
    first = number == 0
    high = np.append(low[1:], 1.0)
    high[np.append(first[1:], True)] = 1.0
    low, high = (np.round(start[edge] + v * room[edge], 3) for v in (low, high))
    mitre = line_offsets(blocks.corners, blocks.offsets, 1.0) - blocks.corners
    last = np.append(first[1:], True)
    inward = edges.inward[edge]
    from_first = np.where((first & ~sharp[edge])[:, None], mitre[edge], inward)
    from_last = np.where(
        (last & ~sharp[edges.following[edge]])[:, None], mitre[edges.following[edge]], inward
    )
    steps = np.array([-1.4, -0.8, 0, 0, 0, 0, 0.9, 1.6])
    # Beside an acute corner a deep house would reach into the rear of the corner's.
    acute = (first & (edges.cosine < 0.05)[edge]) | (last & (edges.cosine < 0.05)[edges.following[edge]])
    more = steps[random.integers(0, len(steps), len(edge))]
    deep = (depth[rings[edge]] + np.where(acute, np.minimum(more, 0), more))[:, None]
    front = [blocks.corners[edge] + edges.along[edge] * v[:, None] for v in (low, high)]
    rear = [front[0] + from_first * deep, front[1] + from_last * deep]
    district, street = blocks.district[rings[edge]], blocks.street[edge]
    common = (blocks.rank[rings[edge]], 2 * edge + 1, district, street, np.zeros(len(edge), bool))
    quads = Group(
        np.stack([front[0], front[1], rear[1], rear[0]], axis=1),
        np.tile(np.array([STREET, SIDE, COURT, SIDE], np.uint8), (len(edge), 1)),
        *common,
    )
    # A wing stands at the party wall, at the end or the start of the rear, by turns, so that two stand back to back.
    span = length(rear[1] - rear[0])
    out = np.round(7 + 7 * random.random(len(edge)), 1)[:, None]
    thick = np.round(5.4 + 1.4 * random.random(len(edge)), 1)[:, None]
    wants = (random.random(len(edge)) < 0.6) & (district == District.INNER) & (span > 12.0) & ~first & ~last
    way = (rear[1] - rear[0]) / np.maximum(span, 1e-9)[:, None]
    right = (number % 2 == 0)[:, None]
    near = np.where(right, rear[1], rear[0])
    across = np.where(right, -way, way) * thick
    wings = np.stack([near, near + inward * out, near + across + inward * out, near + across], axis=1)
    wants &= _free(blocks, quads, wings, inward, wants, edge, number)
    r = wings[wants & right[:, 0]]
    left = wings[wants & ~right[:, 0]]
    q = quads.corners
    on_right = np.concatenate(
        [q[wants & right[:, 0]][:, :2], r[:, 1:3], r[:, 3:], q[wants & right[:, 0]][:, 3:]], axis=1
    )
    on_left = np.concatenate(
        [q[wants & ~right[:, 0]][:, :3], left[:, 3:], left[:, 2:3], left[:, 1:2]], axis=1
    )
    found = [quads.take(~wants)]
    for corners, chosen in ((on_right, wants & right[:, 0]), (on_left, wants & ~right[:, 0])):
        base = quads.take(chosen)
        roles = np.tile(np.array([STREET, SIDE, COURT, COURT, COURT, SIDE], np.uint8), (len(corners), 1))
        found.append(Group(corners, roles, base.block, base.line, base.district, base.street, base.corner))
    return found


def _free(
    blocks: Blocks,
    quads: Group,
    wings: Floats,
    inward: Floats,
    wants: NDArray[np.bool_],
    edge: Ints,
    number: Ints,
) -> NDArray[np.bool_]:
    """Which of the wings keep away from all houses and wings but their own and the next one."""
    free = np.zeros(len(wings), bool)
    at = np.flatnonzero(wants)
    if not len(at):
        return free
    far = wings[at].copy()
    far[:, [0, 3]] += inward[at][:, None, :] * 5.5
    tips = np.asarray(shapely.polygons(far), object)
    houses = shapely.STRtree(quads.polygons())
    one, _ = houses.query(tips, predicate="dwithin", distance=3.6)
    inner, whole = inset(blocks.corners, blocks.offsets, 16.5)
    polygons = Blocks(blocks.offsets, inner, blocks.street, blocks.district, blocks.rank).polygons()
    rings = ring_numbers(blocks.offsets)[edge[at]]
    good = whole[rings] & shapely.contains_properly(polygons[rings], tips)
    good[one] = False
    kept = np.flatnonzero(good)
    a, b = shapely.STRtree(tips[kept]).query(tips[kept], predicate="dwithin", distance=3.6)
    a, b = at[kept[a]], at[kept[b]]
    clash = (a > b) & ~((edge[a] == edge[b]) & (np.abs(number[a] - number[b]) == 1))
    free[at[kept]] = True
    free[a[clash]] = False
    return free
