"""What rays meet of façades, by brute force."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facade_nb.render.texture.facades import Facade

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Hits:
    """Of n rays: which façade (-1: none), how far away in lengths of the ray, and where on it (n, 2)."""

    facade: NDArray[np.int32]
    distance: Floats
    places: Floats


def meet(facades: Sequence[Facade], eye: Floats, rays: Floats) -> Hits:
    """The first façade that rays (n, 3) from an eye (3,) meet from its front."""
    count = len(rays)
    found = Hits(
        np.full(count, -1, np.int32), np.full(count, np.inf, np.float32), np.zeros((count, 2), np.float32)
    )
    for k, facade in enumerate(facades):
        t, x, y, ahead = _on(facade, eye.astype(float), rays.astype(float))
        with np.errstate(invalid="ignore"):
            hit = ahead & (t > 0) & (t < found.distance) & (x >= 0) & (x < facade.size[0])
            hit &= (y >= 0) & (y < facade.size[1]) & (rays @ facade.axes[2] < 0)
        found.facade[hit], found.distance[hit] = k, t[hit]
        found.places[hit] = np.stack([x, y], axis=1)[hit]
    return found


def sees(
    facades: Sequence[Facade], points: Floats, towards: Floats, skip: NDArray[np.int32] | None = None
) -> NDArray[np.bool_]:
    """Whether nothing stands between points (n, 3) and a light in a direction (3,); `skip`: each point's own façade."""
    free = np.ones(len(points), bool)
    for k, facade in enumerate(facades):
        t, x, y, ahead = _on(facade, points.astype(float), towards.astype(float)[None])
        with np.errstate(invalid="ignore"):
            blocked = ahead & (t > 1e-3) & (x > 0) & (x < facade.size[0]) & (y > 0) & (y < facade.size[1])
        free &= ~blocked if skip is None else ~(blocked & (skip != k))
    return free


def _on(
    facade: Facade, starts: NDArray[np.float64], rays: NDArray[np.float64]
) -> tuple[NDArray[np.float64], ...]:
    """Lengths of rays from starts to a façade's plane, where on it, and whether they come to it."""
    right, up, out = facade.axes.astype(float)
    from_corner = starts - np.array(facade.origin)
    into = rays @ out
    with np.errstate(divide="ignore", invalid="ignore"):
        t = -(from_corner @ out) / into
        at = from_corner + t[:, None] * rays
        return t, at @ right, at @ up, np.abs(into) > 1e-9
