"""Roofs as faces. Each closes its house together with the walls, whose tops lie at the eaves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from mapbox_earcut import triangulate_int64
from numpy.typing import NDArray

from .chance import Floats, length
from .faces import Faces
from .overhangs import Hang, lowered, overhung
from .plan import FLAT, GABLE, HIP, MANSARD, SHED
from .rings import Ints, after, areas, inset, offsets_of, ragged, ring_numbers, take_rings
from .skeletons import shrink

__all__ = ["Houses", "cover", "room_of", "triangulated"]

PARAPET, COPING = 0.45, 0.3
"""How high a parapet rises above a flat roof, and how thick it is, metres."""

BRISK = 1.1
"""How far the steep part of a mansard runs back, metres."""

_TOOTH = 7.0
"""About how far apart the ridges of a sawtooth roof are, metres."""


@dataclass(frozen=True, slots=True, eq=False)
class Houses:
    """What roofs stand on: b buildings with r rings of true corners.

    Attributes
    ----------
    corners, offsets, ring_of
        Rings, those of a building one after the other, the outer one first.
    roof, eaves, rise, eave, run
        (b,) as of `Plan`.
    works
        (b,) whether shed roofs are sawtooth.
    start
        Rule positions (b, 2) of each kind of face: gable, roof, flat, plain.
    seed
        (b, 2) metres.
    over
        (n,) how far the roof hangs over the wall below, from each corner to the next, metres.
    """

    corners: Floats
    offsets: Ints
    ring_of: Ints
    roof: NDArray[np.uint8]
    eaves: Floats
    rise: Floats
    eave: Ints
    run: Floats
    works: NDArray[np.bool_]
    start: dict[str, Floats]
    seed: Floats
    over: Floats

    @property
    def first(self) -> Ints:
        """(b,) the outer ring of each building."""
        fresh = np.append(True, self.ring_of[1:] != self.ring_of[:-1])
        return np.flatnonzero(fresh)


def cover(faces: Faces, houses: Houses) -> None:
    """Add the roofs of houses."""
    strip = houses.eave >= 0
    for kind in (GABLE, HIP, MANSARD, SHED):
        chosen = np.flatnonzero((houses.roof == kind) & strip)
        outer = houses.first[chosen]
        counts = np.diff(houses.offsets)[outer]
        for count in np.unique(counts).tolist():
            _strip(faces, houses, kind, chosen[counts == count], int(count))
    _mansards(faces, houses, np.flatnonzero((houses.roof == MANSARD) & ~strip))
    _shrunk(faces, houses, np.flatnonzero((houses.roof == HIP) & ~strip))
    _flat(faces, houses, np.flatnonzero(houses.roof == FLAT))


def _chains(houses: Houses, chosen: Ints, count: int) -> tuple[Ints, Ints]:
    """Front and rear chains (s, m) of strips with so many corners, as numbers of corners."""
    ahead, behind = {
        4: ((0, 1), (3, 2)),
        6: ((0, 1, 2), (5, 4, 3)),
        7: ((0, 1, 2, 3), (6, 5, 5, 4)),
    }[count]
    base, eave = houses.offsets[houses.first[chosen]], houses.eave[chosen]
    front, rear = (base[:, None] + (eave[:, None] + np.array(way)) % count for way in (ahead, behind))
    return front, rear


def _strip(faces: Faces, houses: Houses, kind: int, chosen: Ints, count: int) -> None:
    """Roofs of a cross-section that is carried along two chains of corners."""
    ahead, behind = _chains(houses, chosen, count)
    front, rear = houses.corners[ahead], houses.corners[behind]
    if kind == HIP:
        _hipped(faces, houses, chosen, front, rear)
        return
    # What hangs over: along the front and the rear, and at both ends. Sawtooth roofs and mansards do not.
    over = [houses.over[ahead[:, :-1]], houses.over[behind[:, 1:]]]
    ends = np.stack([houses.over[behind[:, 0]], houses.over[ahead[:, -1]]], axis=1)
    if kind == SHED:
        over[1] = 0 * over[1]
    if kind == MANSARD:
        over, ends = [0 * one for one in over], 0 * ends
    gaps = length(rear - front).min(axis=1)
    teeth = np.where(houses.works[chosen] & (kind == SHED), np.maximum(np.rint(gaps / _TOOTH), 1), 0).astype(
        int
    )
    for number in np.unique(teeth).tolist():
        some = teeth == number
        own = chosen[some]
        t, h = _profile(kind, int(number), gaps[some])
        level = houses.eaves[own][:, None] + h * houses.rise[own][:, None]
        way = rear[some] - front[some]
        at = front[some][:, :, None] + way[:, :, None] * t[:, None, :, None]  # (s, m, j, 2)
        points = np.concatenate([at, np.broadcast_to(level[:, None, :, None], (*at.shape[:3], 1))], axis=3)
        none = 0.0 if number else 1.0
        hang = Hang(over[0][some] * none, over[1][some] * none, ends[some] * none)
        _carried(faces, houses, own, points, h, int(number), hang)


def _profile(kind: int, teeth: int, width: Floats) -> tuple[Floats, Floats]:
    """A cross-section from the front eaves to the rear ones: places (s, j) from 0 to 1, heights (j,) from 0 to 1."""
    if kind == GABLE:
        t, h = [0, 0.5, 1], [0, 1, 0]
    elif kind == MANSARD:
        brisk = np.minimum(BRISK / width, 0.25)
        ones = np.ones(len(width))
        return np.stack([0 * ones, brisk, 0.5 * ones, 1 - brisk, ones], axis=1), np.array(
            [0, 0.72, 1, 0.72, 0]
        )
    elif teeth:
        t = [i / teeth for i in range(teeth) for _ in (0, 1)] + [1]
        h = [0, 1] * teeth + [0]
    else:
        t, h = [0, 1, 1], [0, 1, 0]
    return np.tile(np.array(t, float), (len(width), 1)), np.array(h, float)


def _carried(
    faces: Faces, houses: Houses, own: Ints, points: Floats, h: Floats, teeth: int, hang: Hang
) -> None:
    """The planes of a cross-section (s, m, j, 3) from corner to corner of its chains, and its two ends."""
    seed = houses.seed[own]
    arms, steps = points.shape[1] - 1, points.shape[2] - 1
    for k in range(arms):
        wide, both = overhung(points, k, hang)
        for j in range(steps):
            one, two = wide[:, 0, j : j + 2], wide[:, 1, j : j + 2]
            quad = np.stack([one[:, 0], two[:, 0], two[:, 1], one[:, 1]], axis=1)
            lower, upper = two[:, 0] - one[:, 0], two[:, 1] - one[:, 1]
            shorter = (length(lower) < length(upper))[:, None]
            along = np.where(shorter, upper, lower)
            sign = 1.0 if (h[j + 1] > h[j] or (teeth and h[j] == 0)) else -1.0
            run = points[:, k, j + 1, :2] - points[:, k, j, :2]
            upright = bool(np.all(length(run) < 1e-9))
            face = "plain" if upright else "roof"
            faces.planes(quad, along * sign, houses.start[face][own], seed, own, both=both)
    for k, way in ((0, slice(None)), (arms, slice(None, None, -1))):
        end = points[:, k]
        along = (end[:, 0] - end[:, -1]) * (1 if k == 0 else -1)
        start = houses.start["gable"][own]
        if teeth:
            for i in range(teeth):
                tooth = end[:, 2 * i : 2 * i + 3][:, way]
                faces.planes(tooth, along, start, seed, own)
        else:
            faces.planes(end[:, way], along, start, seed, own)


def _hipped(faces: Faces, houses: Houses, own: Ints, front: Floats, rear: Floats) -> None:
    """Roofs whose ends slope like their sides: the ridge ends before them."""
    seed, low = houses.seed[own], houses.eaves[own]
    high = low + houses.rise[own]
    ridge = (front + rear) / 2
    last = front.shape[1] - 1
    for k, inward in ((0, 1), (last, last - 1)):
        way = front[:, inward] - front[:, k]
        arm = np.minimum(length(way), length(rear[:, inward] - rear[:, k]))
        most = arm * (0.5 if last == 1 else 0.9)
        back = np.minimum(length(rear[:, k] - front[:, k]) / 2, most)
        ridge[:, k] = ridge[:, k] + way / np.maximum(length(way), 1e-9)[:, None] * back[:, None]

    roof = houses.start["roof"][own]
    over, tops = _least_over(houses)[own], at3(ridge, high)
    eaves = [lowered(at3(chain, low), tops, over) for chain in (front, rear)]
    both = over > 0
    for k in range(last):
        for chain, feet, (i, j) in ((front, eaves[0], (k, k + 1)), (rear, eaves[1], (k + 1, k))):
            quad = np.stack([feet[:, i], feet[:, j], tops[:, j], tops[:, i]], 1)
            along = np.where(
                (length(chain[:, j] - chain[:, i]) < 1e-6)[:, None],
                quad[:, 2] - quad[:, 3],
                quad[:, 1] - quad[:, 0],
            )
            faces.planes(quad, along, roof, seed, own, both=both)
    ahead, behind = eaves
    for left, right, k in ((behind[:, 0], ahead[:, 0], 0), (ahead[:, last], behind[:, last], last)):
        triangle = np.stack([left, right, tops[:, k]], axis=1)
        faces.planes(triangle, triangle[:, 1] - triangle[:, 0], roof, seed, own, both=both)


def at3(points: Floats, height: Floats) -> Floats:
    """Points (s, m, 2) at heights (s,), as (s, m, 3)."""
    return np.concatenate([points, np.broadcast_to(height[:, None, None], (*points.shape[:2], 1))], axis=2)


def _least_over(houses: Houses) -> Floats:
    """How far the roof of each building hangs over all its outer walls, metres."""
    index, offsets = take_rings(houses.offsets, houses.first)
    return np.asarray(np.minimum.reduceat(houses.over[index], offsets[:-1]))


def room_of(corners: Floats, offsets: Ints) -> Floats:
    """How far a ring can be inset while it keeps its corners and does not touch itself, of some steps up to 5 m."""
    room = np.zeros(len(offsets) - 1)
    for before, step in ((0.0, 1.5), (1.5, 2.2), (2.2, 3.0), (3.0, 4.0), (4.0, 5.0)):
        going = np.flatnonzero(room == before)
        index, own = take_rings(offsets, going)
        moved, whole = inset(corners[index], own, step)
        whole &= _simple(moved, own)
        room[going[whole]] = step
    return room


def _simple(corners: Floats, offsets: Ints) -> NDArray[np.bool_]:
    """Whether rings do not cross themselves."""
    if len(offsets) < 2:
        return np.zeros(0, bool)
    rings = shapely.linearrings(corners, indices=ring_numbers(offsets))
    return np.asarray(shapely.is_valid(shapely.polygons(rings)))


def _shrunk(faces: Faces, houses: Houses, own: Ints) -> None:
    """Hipped roofs over any footprint: each plane rises from its edge to the ridges, or to a level top."""
    if not len(own):
        return
    index, offsets = take_rings(houses.offsets, houses.first[own])
    ring = houses.corners[index]
    run = houses.run[own]
    shrunk = shrink(ring, offsets, run)
    slope = houses.rise[own] / np.maximum(shrunk.far, 1e-9)
    number = ring_numbers(offsets)[shrunk.edge]
    owner = own[number]

    def height(far: Floats, of: Ints) -> Floats:
        return np.round(houses.eaves[own][of] + far * slope[of], 3)

    low, high = height(shrunk.low, number), height(shrunk.high, number)
    points = np.concatenate([shrunk.strips, np.stack([low, low, high, high], axis=1)[:, :, None]], axis=2)
    over = _least_over(houses)[own]
    wide, whole = inset(ring, offsets, -over[ring_numbers(offsets)])
    whole &= np.maximum.reduceat(length(wide - ring), offsets[:-1]) < 2.5 * over + 1e-9
    over = np.where(whole, over, 0.0)
    lowest = (shrunk.low == 0) & (over[number] > 0)
    drop = np.round(houses.eaves[owner] - over[number] * slope[number], 3)
    for k, corner in ((0, shrunk.edge), (1, after(offsets)[shrunk.edge])):
        points[lowest, k] = np.column_stack([wide[corner], drop])[lowest]
    foot, end = ring[shrunk.edge], ring[after(offsets)[shrunk.edge]]
    level = np.column_stack([foot, houses.eaves[owner]])
    along = np.column_stack([end - foot, np.zeros(len(foot))])
    faces.planes(
        points, along, houses.start["roof"][owner], houses.seed[owner], owner, level, shrunk.edge, lowest
    )
    corners, tops, of = shrunk.tops
    if len(of):
        order = np.argsort(of, kind="stable")
        index, tops = take_rings(tops, order)
        of = of[order]
        _level(faces, houses, own[of], tops, own[of], corners[index], height(shrunk.far[of], of))


def _mansards(faces: Faces, houses: Houses, own: Ints) -> None:
    """Mansards all round: a steep slope, a gentle one, flat above."""
    if not len(own):
        return
    index, offsets = take_rings(houses.offsets, houses.first[own])
    ring = houses.corners[index]
    room = room_of(ring, offsets)
    level = houses.eaves[own]
    top = level + houses.rise[own]
    rings = ring_numbers(offsets)
    knee, _ = inset(ring, offsets, BRISK)
    height = np.round(level + 0.72 * houses.rise[own], 3)
    _between(faces, houses, own, offsets, ring, level, knee, height)
    upper, _ = inset(ring, offsets, room[rings])
    _between(faces, houses, own, offsets, knee, height, upper, top)
    _level(faces, houses, own, offsets, own, upper, top)


def _between(
    faces: Faces,
    houses: Houses,
    own: Ints,
    offsets: Ints,
    lower: Floats,
    low: Floats,
    upper: Floats,
    high: Floats,
) -> None:
    """Slopes from rings at one height (b,) to rings at another."""
    b, i, j = ring_numbers(offsets), np.arange(len(lower)), after(offsets)
    quad = np.stack(
        [
            np.column_stack([p, h])
            for p, h in ((lower[i], low[b]), (lower[j], low[b]), (upper[j], high[b]), (upper[i], high[b]))
        ],
        axis=1,
    )
    building = own[b]
    faces.planes(
        quad, quad[:, 1] - quad[:, 0], houses.start["roof"][building], houses.seed[building], building
    )


def _flat(faces: Faces, houses: Houses, own: Ints) -> None:
    """Flat roofs behind a parapet."""
    if not len(own):
        return
    mine = np.zeros(len(houses.roof), bool)
    mine[own] = True
    rings = np.flatnonzero(mine[houses.ring_of])
    index, offsets = take_rings(houses.offsets, rings)
    outer, building = houses.corners[index], houses.ring_of[rings]
    inner, whole = inset(outer, offsets, COPING)
    whole &= _simple(inner, offsets)
    walled = np.ones(len(houses.roof), bool)
    np.logical_and.at(walled, building, whole)
    holed = np.flatnonzero(np.bincount(building, minlength=len(walled)) > 1)
    for one in holed[walled[holed]].tolist():  # courtyards may come too near the outer wall
        shell, *yards = (inner[offsets[k] : offsets[k + 1]] for k in np.flatnonzero(building == one))
        walled[one] = shapely.is_valid(shapely.Polygon(shell, yards))
    number = ring_numbers(offsets)
    following = after(offsets)
    i = np.flatnonzero(walled[building][number])
    j, b = following[i], building[number[i]]
    top, floor = houses.eaves[b], houses.eaves[b] - PARAPET
    plain, seed = houses.start["plain"][b], houses.seed[b]
    coping = np.stack([np.column_stack([p, top]) for p in (outer[i], outer[j], inner[j], inner[i])], axis=1)
    faces.planes(coping, coping[:, 1] - coping[:, 0], houses.start["flat"][b], seed, b)
    behind = np.stack(
        [
            np.column_stack([p, h])
            for p, h in ((inner[j], floor), (inner[i], floor), (inner[i], top), (inner[j], top))
        ],
        axis=1,
    )
    faces.planes(behind, behind[:, 1] - behind[:, 0], plain, seed, b)
    ring = np.where(walled[building][number][:, None], inner, outer)
    level = np.where(walled, houses.eaves - PARAPET, houses.eaves)
    _level(faces, houses, own, offsets, building, ring, level[own])


def _level(
    faces: Faces, houses: Houses, own: Ints, offsets: Ints, building: Ints, corners: Floats, height: Floats
) -> None:
    """Level polygons: one for each building of `own`, of the rings whose `building` it is, at heights of `own`."""
    place = np.full(len(houses.roof), -1)
    place[own] = np.arange(len(own))
    at = place[building]
    of = at[ring_numbers(offsets)]
    starts = np.searchsorted(at, np.arange(len(own)))
    low = np.minimum.reduceat(corners, offsets[:-1][starts], axis=0)
    size = np.maximum.reduceat(corners, offsets[:-1][starts], axis=0) - low
    owner = own[of]
    faces.loose(
        np.column_stack([corners, height[of]]),
        corners - low[of],
        size[of],
        houses.start["flat"][owner],
        houses.seed[owner],
        np.tile([0.0, 0.0, 1.0], (len(corners), 1)),
        np.tile([1.0, 0.0, 0.0], (len(corners), 1)),
        owner,
        triangulated(corners, offsets, at),
    )


def triangulated(corners: Floats, offsets: Ints, polygon: Ints) -> Ints:
    """Triangles (t, 3) of polygons, counter-clockwise.

    Parameters
    ----------
    polygon
        (r,) of each ring, rising; a polygon's outer ring is its first, the others are holes.
    """
    counts = np.diff(offsets)
    following = after(offsets)
    onward = corners[following] - corners
    turn = onward[:, 0] * onward[following][:, 1] - onward[:, 1] * onward[following][:, 0]
    convex = np.ones(len(counts), bool)
    np.logical_and.at(convex, ring_numbers(offsets), np.round(turn, 3) > 0)
    single = np.bincount(polygon, minlength=int(polygon.max(initial=-1)) + 1)[polygon] == 1
    simple = convex & single & (areas(corners, offsets) > 0)
    found = []
    for count in np.unique(counts[simple]).tolist():
        base = offsets[:-1][simple & (counts == count)]
        fan = np.array([[0, i, i + 1] for i in range(1, count - 1)])
        found.append((base[:, None, None] + fan).reshape(-1, 3))
    mm = np.rint(corners * 1000).astype(np.int64)
    others = np.flatnonzero(~simple)
    if len(others):
        found.append(_clipped(mm, ragged(offsets[others], counts[others]), counts[others], polygon[others]))
    if not found:
        return np.zeros((0, 3), np.int64)
    triangles = np.concatenate(found)
    a, b, c = (mm[triangles[:, k]] for k in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    turned = triangles[:, [0, 2, 1]]
    return np.where((area < 0)[:, None], turned, triangles)[area != 0]


def _clipped(mm: Ints, index: Ints, counts: Ints, polygon: Ints) -> Ints:
    """Triangles of polygons by cutting off ears: corners of their rings (`index`), so many each (`counts`)."""
    ends = offsets_of(counts)
    begin = np.flatnonzero(np.append(True, polygon[1:] != polygon[:-1]))
    rings = np.append(begin, len(counts))
    edges = ends[rings]
    # Seen from its first corner a polygon's coordinates are small.
    own = mm[index] - np.repeat(mm[index[edges[:-1]]], np.diff(edges), axis=0)
    closing = (ends[1:] - np.repeat(edges[:-1], np.diff(rings))).astype(np.uint32)
    made = [
        triangulate_int64(own[first:last], closing[one:two])
        for first, last, one, two in zip(
            edges[:-1].tolist(), edges[1:].tolist(), rings[:-1].tolist(), rings[1:].tolist(), strict=True
        )
    ]
    corners = np.concatenate(made).astype(np.int64) + np.repeat(edges[:-1], [len(own) for own in made])
    return np.asarray(index[corners].reshape(-1, 3))
