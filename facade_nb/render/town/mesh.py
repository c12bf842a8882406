"""A plan as a mesh: walls, roofs and ground, in chunks that lie together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..pipeline.scene import CHUNK
from ..pipeline.vertices import turning
from ..texture import Grammar
from .chance import Floats, length
from .cornices import add_cornices
from .faces import Faces
from .plan import COURT, FLAT, MANSARD, OUTBUILDING, PARTY, SIDE, STREET, Ground, Plan
from .rings import Ints, offsets_of, ring_numbers
from .roofing import Houses, cover
from .solids import add_cars, add_hedges
from .styles import Style
from .things import stand
from .welding import shared

__all__ = ["NOBODY", "Mesh", "Mesher", "build_mesh"]

CELL = 120.0
"""Chunks are cells of a net of so many metres."""

NOBODY = np.uint32(0xFFFFFFFF)
"""The building of a triangle of the ground."""

_WALLS = ("street", "side", "court", "front")
_FACES = (*_WALLS, *(f"short-{face}" for face in _WALLS), "party", "plain", "gable", "roof", "flat")
"""What a style has a rule for. Where it has none for short walls, these are plain."""


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """Triangles of a town.

    Attributes
    ----------
    vertices
        (v,) VERTEX, chunk by chunk, in each the ground first.
    indices
        (3 t,) uint32.
    building_of
        (t,) uint32: the building of each triangle; `NOBODY`: ground.
    chunks
        CHUNK.
    facades
        How many façades there are.
    """

    vertices: np.ndarray
    indices: NDArray[np.uint32]
    building_of: NDArray[np.uint32]
    chunks: np.ndarray
    facades: int


def starts_of(grammar: Grammar, styles: Sequence[Style]) -> dict[str, Floats]:
    """Column and row (s, 2) of the rule with which each face of each style begins."""
    places = dict(zip(grammar.encoding.names, grammar.encoding.positions, strict=True))
    return {
        face: np.array([places[one.starts.get(face, one.starts["plain"])] for one in styles], float)
        for face in _FACES
    }


class Mesher:
    """Makes a mesh part by part, in this order: houses, ground, what is left. Other work may go on beside each.

    Parameters
    ----------
    styles
        What a plan counts.
    grammar
        Of all of them.
    """

    def __init__(self, styles: Sequence[Style], grammar: Grammar) -> None:
        self._styles, self._grammar = styles, grammar
        self._names = dict(zip(grammar.encoding.names, grammar.encoding.positions, strict=True))
        self._faces = Faces()
        self._facades = 0
        self._ends: tuple[int, ...] = ()
        self._cells: Ints = np.zeros(0, np.int64)

    def houses(self, plan: Plan) -> Mesher:
        """Walls, roofs and cornices: the plan may be without ground."""
        faces, styles = self._faces, self._styles
        starts = starts_of(self._grammar, styles)
        _walls(faces, plan, styles, starts)
        self._facades = faces.count // 4
        over = _over(plan)
        level = np.isin(plan.roof[plan.building[~plan.added]], (FLAT, MANSARD))
        cover(faces, _houses(plan, styles, starts, np.where(level, 0.0, over)))
        add_cornices(faces, plan, styles, np.where(level, over, 0.0), self._names)
        faces.weld()
        self._ends = (faces.count,)
        return self

    def ground(self, ground: Ground) -> Mesher:
        """The ground, under all of them."""
        self._cells = _ground(self._faces, ground, self._grammar)
        self._ends = (*self._ends, self._faces.count)
        return self

    def rest(self, plan: Plan) -> Mesh:
        """All else that a plan has, and the mesh."""
        faces, (houses, ground) = self._faces, self._ends
        mark = faces.mark
        add_cars(faces, plan.cars, self._names, -2)
        add_hedges(faces, plan.hedges, self._names, -2 - len(plan.cars))
        faces.weld(mark)
        solids = faces.count
        stand(faces, plan.things, self._grammar, plan)
        return _chunked(faces, plan, self._facades, self._cells, (houses, ground, solids))


def build_mesh(plan: Plan, styles: Sequence[Style], grammar: Grammar) -> Mesh:
    """The mesh of a plan."""
    return Mesher(styles, grammar).houses(plan).ground(plan.ground).rest(plan)


def _walls(faces: Faces, plan: Plan, styles: Sequence[Style], starts: dict[str, Floats]) -> None:
    building = plan.building
    ends = plan.corners[plan.following]
    span = length(ends - plan.corners)
    style = plan.style[building]
    table = np.stack([starts[face] for face in _FACES])
    narrow, least = (np.array([getattr(one, name) for one in styles])[style] for name in ("narrow", "least"))
    face = np.select([plan.role == STREET, plan.role == SIDE, plan.role == COURT], [0, 1, 2], -1)
    face[plan.entrance[plan.entrance >= 0]] = 3
    # A short wall has no bays of its own at its corners, a stub no window.
    plain, width = _FACES.index("plain"), np.round(span, 3)
    face = np.where(width < least, plain, np.where(width < narrow, face + len(_WALLS), face))
    face = np.where(plan.kind[building] == OUTBUILDING, plain, face)
    face = np.where(plan.role == PARTY, _FACES.index("party"), face)
    eaves = plan.eaves[building]
    seen = np.flatnonzero((plan.covered < eaves - 0.005) & (span > 0))
    seed = plan.seed[building[seen]] / 64.0
    start = table[face[seen], style[seen]]
    faces.walls(plan.corners[seen], ends[seen], plan.covered[seen], eaves[seen], start, seed, building[seen])


def _over(plan: Plan) -> Floats:
    """How far a roof or a cornice stands out along each edge between true corners, metres.

    None does above a wall of which a neighbour covers a part.
    """
    true = ~plan.added
    edge = np.cumsum(true) - 1
    joined = np.bincount(edge, weights=plan.role == PARTY, minlength=int(true.sum())) > 0
    return np.where(joined, 0.0, plan.over[plan.building[true]])


def _houses(plan: Plan, styles: Sequence[Style], starts: dict[str, Floats], over: Floats) -> Houses:
    """The rings of true corners, and what roofs need to know."""
    true = ~plan.added
    counts = np.bincount(ring_numbers(plan.rings), weights=true, minlength=len(plan.ring_of)).astype(np.int64)
    works = np.array([one.name == "brickworks" for one in styles])[plan.style]
    return Houses(
        plan.corners[true],
        offsets_of(counts),
        np.asarray(plan.ring_of, np.int64),
        plan.roof,
        plan.eaves,
        plan.rise,
        np.asarray(plan.eave, np.int64),
        plan.run,
        works,
        {face: starts[face][plan.style] for face in ("gable", "roof", "flat", "plain")},
        plan.seed / 64.0,
        over,
    )


def _ground(faces: Faces, ground: Ground, grammar: Grammar) -> Ints:
    """The ground: one façade that lies on its back, so that a pattern runs on from triangle to triangle.

    Strips along streets are façades of their own: width runs along the street, height away from it. It tells for each
    vertex the chunk of the net (`_code`).
    """
    if not len(ground.corners):
        return np.zeros(0, np.int64)
    places = dict(zip(grammar.encoding.names, grammar.encoding.positions, strict=True))
    start = np.array([places[f"ground.{name.capitalize()}"] for name in ground.names], float)
    low = np.floor(ground.corners.min(axis=0))
    size = np.ceil(ground.corners.max(axis=0)) - low
    count = len(ground.corners)
    place, sizes = ground.corners - low, np.tile(size, (count, 1))
    tangent = np.tile([1.0, 0.0, 0.0], (count, 1))
    strips = np.flatnonzero(ground.along).reshape(-1, 4)
    quad = ground.corners[strips]
    way = quad[:, 1] - quad[:, 0]
    unit = way / np.maximum(length(way), 1e-9)[:, None]
    away = quad - quad[:, :1]
    across = np.stack([-unit[:, 1], unit[:, 0]], axis=1)
    own = np.stack([(away * axis[:, None]).sum(axis=2) for axis in (unit, across)], axis=2)
    own = np.round(own - own.min(axis=1, keepdims=True), 4)
    good = (length(way) > 0.01) & (
        own[..., 1].max(axis=1) > 0.01
    )  # a corner that is no strip lies as the rest does
    place[strips[good]] = own[good]
    sizes[strips[good]] = own.max(axis=1)[good][:, None]
    tangent[strips[good]] = np.column_stack([unit, np.zeros(len(unit))])[good][:, None]
    cells = _ground_cells(ground)
    mm = np.rint((ground.corners - low) * 1000).astype(np.int64)
    _, spots = np.unique(mm[:, 0] << 31 | mm[:, 1], return_inverse=True)
    # Strips show something else each, all other ground of a kind in a cell the same.
    looks = np.where(ground.along, -1 - ground.piece, cells * len(ground.names) + ground.kind)
    kept, triangles = shared(spots, np.unique(looks, return_inverse=True)[1], ground.triangles)
    count = len(kept)
    faces.loose(
        np.column_stack([ground.corners[kept], np.zeros(count)]),
        place[kept],
        sizes[kept],
        start[ground.kind[kept]],
        np.zeros((count, 2)),
        np.tile([0.0, 0.0, 1.0], (count, 1)),
        tangent[kept],
        np.full(count, -1),
        triangles,
    )
    return cells[kept]


def _ground_cells(ground: Ground) -> Ints:
    """The cell in which the middle of each corner's piece of ground lies."""
    count = np.maximum(np.bincount(ground.piece), 1)
    # Whole numbers add up exactly.
    sums = [np.bincount(ground.piece, weights=np.rint(ground.corners[:, k] * 1000)) for k in (0, 1)]
    middle = np.stack(sums, axis=1) / count[:, None] / 1000
    return _code(np.floor(middle / CELL).astype(np.int64))[ground.piece]


def _chunked(faces: Faces, plan: Plan, facades: int, cells: Ints, ends: tuple[int, int, int]) -> Mesh:
    """Order vertices and triangles by chunk and building.

    `cells`: of the ground's vertices. `ends`: so many vertices belong to houses; to these and the ground; to these and
    what else stands still.
    """
    vertices, triangles = np.concatenate(faces.vertices), np.concatenate(faces.triangles)
    owner = np.concatenate(faces.owners)
    houses, ground, solids = ends
    middle = _middles(plan)
    cell = np.floor(middle / CELL).astype(np.int64)
    key = np.empty(len(vertices), np.int64)
    key[:houses] = _code(cell)[owner[:houses]]
    key[houses:ground] = cells
    middles = np.concatenate([plan.cars.at, plan.hedges.start])
    key[ground:solids] = _code(np.floor(middles / CELL).astype(np.int64))[-2 - owner[ground:solids]]
    where = vertices["position"][solids:, ::2].astype(np.float64) * (1, -1)
    key[solids:] = _TURNING + _code(np.floor(where / CELL).astype(np.int64))
    # One number tells the chunk, and within it the building.
    key = key << 20 | (owner - owner.min(initial=0))
    order = np.argsort(key, kind="stable")
    moved = np.empty(len(order), np.int64)
    moved[order] = np.arange(len(order))
    # Its last vertex is a triangle's own, others may belong to what lies beside it.
    last = triangles[:, 2]
    by = np.argsort(key[last], kind="stable")
    triangles = moved[triangles[by]]
    keys = key[last][by] >> 20
    begin = np.flatnonzero(np.append(True, keys[1:] != keys[:-1]))
    vertices = vertices[order]
    position = vertices["position"]
    chunks = np.zeros(len(begin), CHUNK)
    chunks["first"] = 3 * begin
    chunks["count"] = 3 * np.diff(np.append(begin, len(triangles)))
    # What turns reaches as far on all sides as it is large.
    turns = np.flatnonzero(turning(vertices))
    reach = (0.5 * np.abs(vertices["size"][turns]).sum(axis=1)).astype(np.float32)
    corners = triangles.ravel()
    for axis in range(3):
        for name, sign, least in (("low", -1, np.minimum), ("high", 1, np.maximum)):
            own = position[:, axis].copy()
            own[turns] += sign * reach
            chunks[name][:, axis] = least.reduceat(own[corners], 3 * begin)
    building_of = np.where(owner[last][by] < 0, int(NOBODY), owner[last][by]).astype(np.uint32)
    return Mesh(vertices, triangles.astype(np.uint32).ravel(), building_of, chunks, facades)


_TURNING = 1 << 42
"""Chunks of what turns to whoever looks come after all others: passes of their own draw them."""


def _code(cell: Ints) -> Ints:
    """One number for each cell of the net, row by row."""
    return np.asarray((cell[..., 1] + (1 << 20)) * (1 << 21) + cell[..., 0] + (1 << 20))


def _middles(plan: Plan) -> Floats:
    """The middle (b, 2) of the box around each building, metres."""
    building = plan.building
    begin = np.flatnonzero(np.append(True, building[1:] != building[:-1]))
    low = np.minimum.reduceat(plan.corners, begin, axis=0)
    high = np.maximum.reduceat(plan.corners, begin, axis=0)
    return np.asarray((low + high) / 2)
