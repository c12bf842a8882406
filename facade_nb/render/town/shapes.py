"""Shapes of footprints that a roof can follow: strips of one, two or three arms, between two ends.

A strip has a front chain and a rear chain of as many corners. A roof's cross-section is carried along them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .chance import Floats, length
from .rings import Ints, after, before

__all__ = ["Strips", "find_strips"]


@dataclass(frozen=True, slots=True, eq=False)
class Strips:
    """Footprints of the same shape.

    Attributes
    ----------
    building
        (s,) which of the footprints.
    front, rear
        (s, m) corners of the chains, both from the same end.
    eave
        (s,) number of the first front edge among the ring's corners.
    width
        (s,) least distance of the chains, metres.
    """

    building: Ints
    front: Ints
    rear: Ints
    eave: Ints
    width: Floats

    def take(self, chosen: NDArray[np.bool_]) -> Strips:
        """Some of them."""
        return Strips(*(getattr(self, name)[chosen] for name in self.__slots__))


def find_strips(corners: Floats, offsets: Ints) -> list[Strips]:
    """Strips among rings: four corners, twice (along either pair of edges), then six, then seven with a cut corner."""
    counts = np.diff(offsets)
    following, preceding = after(offsets), before(offsets)
    onward = corners[following] - corners
    back = onward[preceding]
    cross = back[:, 0] * onward[:, 1] - back[:, 1] * onward[:, 0]
    reflex = np.round(cross, 3) < 0
    bent = np.concatenate([[0], np.cumsum(reflex)])
    hollow = bent[offsets[1:]] - bent[offsets[:-1]]
    found = []
    four = np.flatnonzero((counts == 4) & (hollow == 0))
    base = offsets[:-1][four]
    for e in (0, 1):
        front = base[:, None] + np.array([e, e + 1])
        rear = base[:, None] + np.array([(e + 3) % 4, (e + 2) % 4])
        found.append(_strips(corners, four, front, rear, np.full(len(four), e)))
    for count, ahead, behind in ((6, (2, 3, 4), (1, 0, 5)), (7, (2, 3, 4, 5), (1, 0, 0, 6))):
        some = np.flatnonzero((counts == count) & (hollow == 1))
        base = offsets[:-1][some]
        ring = reflex[base[:, None] + np.arange(count)] if len(some) else np.zeros((0, count), bool)
        corner = ring.argmax(axis=1)
        front, rear = (base[:, None] + (corner[:, None] + np.array(way)) % count for way in (ahead, behind))
        found.append(_strips(corners, some, front, rear, (corner + ahead[0]) % count))
    return found


def _strips(corners: Floats, building: Ints, front: Ints, rear: Ints, eave: Ints) -> Strips:
    """Those whose chains run side by side."""
    f, r = corners[front], corners[rear]
    along, beside = np.diff(f, axis=1), np.diff(r, axis=1)
    one, other = length(along), length(beside)
    dot = along[..., 0] * beside[..., 0] + along[..., 1] * beside[..., 1]
    safe = np.maximum(one * other, 1e-9)
    parallel = (np.round(dot / safe, 4) > 0.985) | (other < 1e-6)
    way = r[:, :-1] - f[:, :-1]
    gaps = np.round((along[..., 0] * way[..., 1] - along[..., 1] * way[..., 0]) / np.maximum(one, 1e-9), 3)
    width = gaps.min(axis=1) if len(gaps) else np.zeros(0)
    good = parallel.all(axis=1) & (width > 1.5) & (one > 0.5).all(axis=1)
    return Strips(building, front, rear, eave, width).take(good)
