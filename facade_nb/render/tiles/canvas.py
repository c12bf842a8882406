"""A canvas that tiles are drawn on: colour, alpha, gloss and the height of the surface, pixel by pixel.

Shapes are signed distances in metres, so their edges are smooth at any resolution. What is drawn also has a height
above the plane of the wall; normals and the light of an overcast sky (`relief`) follow from it.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Canvas", "Colour", "Floats", "Values", "noise", "paint", "randoms", "smooth"]

Floats = NDArray[np.float32]

Values = NDArray[np.floating[Any]]

Colour = str | Sequence[float] | Values
"""``#rrggbb``, three numbers from 0 to 1, or an array (h, w, 3) of them; sRGB."""

_FAR = np.float32(1e9)


@lru_cache(maxsize=512)
def _hex(code: str) -> Floats:
    return np.array([int(code[i : i + 2], 16) / 255 for i in (1, 3, 5)], np.float32)


def paint(colour: Colour) -> Floats:
    """The colour as an array: (3,) or (h, w, 3)."""
    return _hex(colour) if isinstance(colour, str) else np.asarray(colour, np.float32)


def smooth(low: float, high: float, value: Values) -> Floats:
    """0 below `low`, 1 above `high`, and a smooth step in between."""
    t = np.clip((value - low) / (high - low), 0, 1)
    return (t * t * (3 - 2 * t)).astype(np.float32)


def randoms(seed: int, *shape: int) -> Floats:
    """Numbers from 0 to 1 that depend on `seed` alone: made from the bits of PCG64, which NumPy promises to keep."""
    bits = np.random.PCG64(seed).random_raw(int(np.prod(shape)))
    return (
        ((np.asarray(bits, np.uint64) >> np.uint64(40)) / np.float64(1 << 24))
        .astype(np.float32)
        .reshape(shape)
    )


@lru_cache(maxsize=256)
def _weights(size: int, cells: int, wrap: bool) -> tuple[tuple[NDArray[np.intp], Floats], ...]:
    """Cubic B-spline: the four lattice points next to each pixel's centre, and their weights."""
    at = (np.arange(size) + 0.5) / size * cells
    cell = np.floor(at).astype(np.intp)
    t = at - cell
    parts = ((1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, -3 * t**3 + 3 * t**2 + 3 * t + 1, t**3)
    return tuple(
        ((cell + i - 1) % cells if wrap else cell + i, (part / 6).astype(np.float32))
        for i, part in enumerate(parts)
    )


def _spread(lattice: Floats, weights: tuple[tuple[NDArray[np.intp], Floats], ...]) -> Floats:
    """Values between the rows of a lattice."""
    lattice = np.ascontiguousarray(lattice)
    spread = np.zeros((len(weights[0][0]), lattice.shape[1]), np.float32)
    for at, weight in weights:
        spread += lattice[at] * weight[:, None]
    return spread


def noise(size: int, cells: tuple[int, int], seed: int, octaves: int = 1, wrap: bool = True) -> Floats:
    """Smooth noise (size, size) about 0, of standard deviation near 1.

    `cells` are those of its coarsest lattice, across and up; each further octave halves them and the strength. With
    `wrap` the left edge goes on at the right one, and the top at the bottom.
    """
    total = np.zeros((size, size), np.float32)
    power = 0.0
    for octave in range(octaves):
        across, up = cells[0] << octave, cells[1] << octave
        if octave and max(across, up) > size:
            break
        wider = 0 if wrap else 3
        lattice = randoms(seed * 7919 + octave * 131 + 17, up + wider, across + wider) - np.float32(0.5)
        rows = _spread(lattice, _weights(size, up, wrap))
        total += np.float32(0.5**octave) * _spread(rows.T, _weights(size, across, wrap)).T
        power += 0.25**octave
    return total * np.float32(7.2 / np.sqrt(power))


def _steepest(values: Values, axis: int) -> Values:
    """The larger of the steps to both neighbours: right on the ridge of a distance too, where a mean step is 0."""
    steps = np.abs(np.diff(values, axis=axis))
    before, after = [(0, 0), (0, 0)], [(0, 0), (0, 0)]
    before[axis], after[axis] = (1, 0), (0, 1)
    return np.maximum(np.pad(steps, before), np.pad(steps, after))


def _extent(cover: Floats) -> tuple[slice, slice] | None:
    """The rows and columns where there is any coverage."""
    rows, columns = np.flatnonzero(cover.any(axis=1)), np.flatnonzero(cover.any(axis=0))
    if not len(rows):
        return None
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


class Canvas:
    """A square picture of a part of a façade, row 0 at the top.

    Parameters
    ----------
    size
        Its pixels, across and up.
    width, height
        What it shows, metres.
    wrap
        Whether it goes on at the opposite edge, across and up.
    colour
        Of the ground; None: transparent.

    Attributes
    ----------
    width, tall
        What it shows, metres.
    x, y
        Metres from the lower left corner at the centres of the pixels: (1, size) and (size, 1).
    dx, dy
        Size of a pixel, metres.
    colour
        (size, size, 3), sRGB, 0 to 1.
    alpha, gloss, height
        (size, size): opacity, strength of highlights (0 to 1), and metres before the plane of the wall.
    """

    def __init__(
        self,
        size: int,
        width: float = 1.0,
        height: float = 1.0,
        *,
        wrap: tuple[bool, bool] = (False, False),
        colour: Colour | None = None,
    ) -> None:
        self.size, self.width, self.tall = size, width, height
        self.wrap = wrap
        self.dx, self.dy = width / size, height / size
        steps = (np.arange(size, dtype=np.float32) + np.float32(0.5)) / np.float32(size)
        self.x: Floats = (steps * np.float32(width))[None, :]
        self.y: Floats = ((1 - steps) * np.float32(height))[:, None]
        self.colour: Floats = np.zeros((size, size, 3), np.float32)
        self.alpha: Floats = np.zeros((size, size), np.float32)
        self.gloss: Floats = np.zeros((size, size), np.float32)
        self.height: Floats = np.zeros((size, size), np.float32)
        if colour is not None:
            self.colour[:] = paint(colour)
            self.alpha[:] = 1

    # -- coverage -------------------------------------------------------------------------------------------------

    def full(self) -> Floats:
        """Coverage of everything."""
        return np.ones((self.size, self.size), np.float32)

    def box(self, left: float, bottom: float, right: float, top: float) -> Floats:
        """Coverage of a rectangle: exactly the share of each pixel that it covers."""
        across = np.clip(
            (np.minimum(self.x + self.dx / 2, right) - np.maximum(self.x - self.dx / 2, left)) / self.dx, 0, 1
        )
        up = np.clip(
            (np.minimum(self.y + self.dy / 2, top) - np.maximum(self.y - self.dy / 2, bottom)) / self.dy, 0, 1
        )
        return (across * up).astype(np.float32)

    def cover(self, distance: Values) -> Floats:
        """Coverage of the inside of a shape, whose signed distance (negative inside, metres) is given."""
        distance = np.broadcast_to(distance, (self.size, self.size))
        step = np.maximum(np.hypot(_steepest(distance, 0), _steepest(distance, 1)), 1e-9)
        return np.clip(0.5 - distance / step, 0, 1).astype(np.float32)

    # -- signed distances -----------------------------------------------------------------------------------------

    def box_distance(
        self, left: float, bottom: float, right: float, top: float, radius: float = 0.0
    ) -> Floats:
        """Signed distance to a rectangle, its corners rounded by `radius`."""
        qx = np.abs(self.x - (left + right) / 2) - (right - left) / 2 + radius
        qy = np.abs(self.y - (bottom + top) / 2) - (top - bottom) / 2 + radius
        outside = np.hypot(np.maximum(qx, 0), np.maximum(qy, 0))
        return (outside + np.minimum(np.maximum(qx, qy), 0) - radius).astype(np.float32)

    def disc_distance(self, x: float, y: float, radius: float) -> Floats:
        """Signed distance to a disc."""
        return (np.hypot(self.x - x, self.y - y) - radius).astype(np.float32)

    def arch_distance(
        self, left: float, bottom: float, right: float, spring: float, rise: float | None = None
    ) -> Floats:
        """Signed distance to an opening whose head is a circular arc; `rise` None: a half circle."""
        half, middle = (right - left) / 2, (left + right) / 2
        rise = half if rise is None else rise
        radius = (half * half + rise * rise) / (2 * rise)
        disc = self.disc_distance(middle, spring + rise - radius, radius)
        body = self.box_distance(left, bottom, right, spring + rise)
        sides = np.maximum(np.abs(self.x - middle) - half, bottom - self.y)
        return np.where(self.y > spring, np.maximum(disc, sides), np.maximum(body, sides)).astype(np.float32)

    def line_distance(self, points: Sequence[tuple[float, float]], width: float) -> Floats:
        """Signed distance to a polyline of that width with round ends."""
        best = np.full((self.size, self.size), _FAR, np.float32)
        for (ax, ay), (bx, by) in pairwise(points):
            length = max((bx - ax) ** 2 + (by - ay) ** 2, 1e-12)
            t = np.clip(((self.x - ax) * (bx - ax) + (self.y - ay) * (by - ay)) / length, 0, 1)
            best = np.minimum(best, np.hypot(self.x - ax - t * (bx - ax), self.y - ay - t * (by - ay)))
        return best - np.float32(width / 2)

    def polygon_distance(self, points: Sequence[tuple[float, float]]) -> Floats:
        """Signed distance to a polygon, its corners in either order."""
        edges = list(zip(points, [*points[1:], points[0]], strict=True))
        best = np.full((self.size, self.size), _FAR, np.float32)
        inside = np.zeros((self.size, self.size), bool)
        for (ax, ay), (bx, by) in edges:
            length = max((bx - ax) ** 2 + (by - ay) ** 2, 1e-12)
            t = np.clip(((self.x - ax) * (bx - ax) + (self.y - ay) * (by - ay)) / length, 0, 1)
            best = np.minimum(best, np.hypot(self.x - ax - t * (bx - ax), self.y - ay - t * (by - ay)))
            if ay != by:
                crosses = ((ay > self.y) != (by > self.y)) & (
                    self.x < ax + (self.y - ay) * (bx - ax) / (by - ay)
                )
                inside ^= np.broadcast_to(crosses, inside.shape)
        return np.where(inside, -best, best)

    # -- drawing --------------------------------------------------------------------------------------------------

    def lay(
        self,
        cover: Floats,
        colour: Colour,
        *,
        height: float | Values | None = None,
        gloss: float | None = None,
        alpha: float | Values = 1.0,
    ) -> None:
        """Lay a colour over what is there, where `cover` (0 to 1) says, with a new height and gloss if given."""
        part = _extent(cover)
        if part is None:
            return

        def here(value: float | Values) -> float | Values:
            return (
                np.broadcast_to(value, (self.size, self.size))[part]
                if isinstance(value, np.ndarray)
                else value
            )

        seen = cover[part]
        share = (seen * here(alpha)).astype(np.float32)
        total = share + self.alpha[part] * (1 - share)
        weight = share / np.maximum(total, 1e-6)
        tone = paint(colour)
        if tone.ndim > 1:
            tone = np.broadcast_to(tone, self.colour.shape)[part]
        below = self.colour[part]
        below += (tone - below) * weight[..., None]
        self.alpha[part] = total
        if height is not None:
            self.height[part] += (here(height) - self.height[part]) * seen
        if gloss is not None:
            self.gloss[part] += (gloss - self.gloss[part]) * seen

    def cut(self, cover: Floats, *, height: float | None = None, alpha: float = 0.0) -> None:
        """Make what is there transparent where `cover` says, down to `alpha`."""
        self.alpha *= 1 - cover * (1 - alpha)
        if height is not None:
            self.height += (height - self.height) * cover

    def slab(
        self,
        left: float,
        bottom: float,
        right: float,
        top: float,
        colour: Colour,
        height: float,
        *,
        edge: float = 0.0,
        fall: float = 0.01,
        gloss: float | None = None,
    ) -> None:
        """Lay a rectangle whose face is at `height`, with edges of that width sloping down by `fall`."""
        face: float | Floats = height
        if edge > 0:
            inward = -self.box_distance(left, bottom, right, top)
            face = (height - fall * (1 - np.clip(inward / edge, 0, 1))).astype(np.float32)
        self.lay(self.box(left, bottom, right, top), colour, height=face, gloss=gloss)

    def shade(self, factor: Values) -> None:
        """Make what is there lighter or darker by a factor (h, w), keeping its hue."""
        self.colour *= factor[..., None]
        np.clip(self.colour, 0, 1, out=self.colour)

    def noise(self, cell: float | tuple[float, float], seed: int, octaves: int = 1) -> Floats:
        """`noise` with cells of about that many metres (across and up), going on at the edges as the canvas does."""
        across, up = cell if isinstance(cell, tuple) else (cell, cell)
        cells = (max(1, round(self.width / across)), max(1, round(self.tall / up)))
        return noise(self.size, cells, seed, octaves, wrap=any(self.wrap))
