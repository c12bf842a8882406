"""The roof over all: the faces of the town's roofs, each with its material."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..render.town.faces import Faces
from ..render.town.plan import FLAT, GABLE, HIP, MANSARD
from ..render.town.roofing import Houses, cover, room_of
from ..render.town.shapes import find_strips
from ..render.town.skeletons import shrink
from .faces import faces, turn
from .layout import BuildingLayout

__all__ = ["Roofing", "outline", "roofing"]

_KINDS = {"flat": FLAT, "gable": GABLE, "hip": HIP, "mansard": MANSARD}
_SLOPE, _STEEP = 0.7, 3.4
"""Rise over run where nothing is said, and the rise of a mansard, metres."""
_RUN = 7.0
"""How far a hipped roof runs up at most where nothing is said of its rise, metres."""

_PARTS = ("gable", "roof", "flat", "plain")
Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Roofing:
    """A roof as triangles.

    Attributes
    ----------
    positions
        (t, 3, 3) x east, y up, z south, metres.
    parts
        (t,) index into `names`.
    names
        ``gable``, ``roof``, ``flat`` and ``plain`` (upright parts that are no gable).
    """

    positions: Floats
    parts: NDArray[np.int64]
    names: tuple[str, ...] = _PARTS


def outline(layout: BuildingLayout) -> Floats:
    """Corners (n, 2) of the building in plan, cut ones as they are cut, without those at which no wall turns."""
    around = [face.start for face in faces(layout.building)]
    count = len(around)
    kept = [
        around[k] for k in range(count) if abs(turn(around[k - 1], around[k], around[(k + 1) % count])) > 1e-3
    ]
    return np.array(kept)


def roofing(layout: BuildingLayout) -> Roofing:
    """The roof of a building."""
    ring = outline(layout)
    offsets = np.array([0, len(ring)])
    own = layout.building.roof
    kind, edge, half = _KINDS[own.kind], -1, 0.0
    given = own.rise if own.rise is not None else max(layout.building.height - layout.eaves, 0.0) or None
    run = np.array([1e3])
    if kind == GABLE:
        strips = [s for s in find_strips(ring, offsets) if len(s.building)]
        if strips:
            best = max(strips, key=lambda s: _along(ring, s.front[0]))
            edge, half = int(best.eave[0]), float(best.width[0]) / 2
        else:
            kind = HIP
    if kind == MANSARD and room_of(ring, offsets)[0] < 2.2:
        kind = HIP
    if given is None and kind == HIP:
        run = np.array([_RUN])
    if kind == HIP:
        half = float(shrink(ring, offsets, run).far[0])
    rise = _STEEP if kind == MANSARD and given is None else given if given is not None else _SLOPE * half
    if rise <= 0:
        kind = FLAT
    starts = {name: np.array([[k, 0.0]]) for k, name in enumerate(_PARTS)}
    houses = Houses(
        corners=ring,
        offsets=offsets,
        ring_of=np.array([0]),
        roof=np.array([kind], np.uint8),
        eaves=np.array([layout.eaves]),
        rise=np.array([float(rise)]),
        eave=np.array([edge]),
        run=run,
        works=np.array([False]),
        start=starts,
        seed=np.zeros((1, 2)),
        over=np.full(len(ring), own.overhang),
    )
    made = Faces()
    cover(made, houses)
    if not made.vertices:
        return Roofing(np.zeros((0, 3, 3)), np.zeros(0, np.int64))
    vertices = np.concatenate(made.vertices)
    triangles = np.concatenate(made.triangles)
    positions = vertices["position"][triangles].astype(np.float64)
    parts = vertices["start"][triangles[:, 0], 0].astype(np.int64)
    whole = _apart(positions)
    return Roofing(positions[whole], parts[whole])


def _apart(triangles: Floats) -> NDArray[np.bool_]:
    """Which triangles (n, 3, 3) have three corners: where an eave shrinks to a point, the one beside it has two."""
    sides = np.linalg.norm(triangles[:, [1, 2, 0]] - triangles, axis=2)
    return np.asarray(sides.min(axis=1) > 1e-6)


def _along(ring: Floats, front: NDArray[np.integer]) -> float:
    """How long a chain of corners is."""
    steps = np.diff(ring[front], axis=0)
    return float(np.sqrt((steps * steps).sum(axis=1)).sum())
