"""Walls laid in courses: brick, ashlar, rustication, and roofs, which are laid in courses too."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .canvas import Canvas, Floats, Values, noise, paint, randoms, smooth
from .images import evened

__all__ = ["Units", "ashlar", "brick", "rustic", "slates", "tiles"]


_ROUNDS, _COARSE = 6, 128
_ODD = 1.7
"""How many standard deviations a stone may differ from the others: the oddest are known again wherever they repeat."""


@dataclass(frozen=True, slots=True, eq=False)
class Units:
    """Which stone of which course each pixel lies in.

    Attributes
    ----------
    id
        (h, w) number of the stone.
    count
        How many stones there are.
    left, right, below, above
        (h, w) metres from the pixel to the stone's four edges, the middles of the joints.
    """

    id: np.ndarray
    count: int
    left: Floats
    right: Floats
    below: Floats
    above: Floats

    def distance(self, joint: float, radius: float) -> Floats:
        """Signed distance to the stones: `joint` metres apart, their corners rounded."""
        half_w, half_h = (self.left + self.right) / 2, (self.below + self.above) / 2
        qx = np.abs(self.left - half_w) - half_w + joint / 2 + radius
        qy = np.abs(self.below - half_h) - half_h + joint / 2 + radius
        outside = np.hypot(np.maximum(qx, 0), np.maximum(qy, 0))
        return (outside + np.minimum(np.maximum(qx, qy), 0) - radius).astype(np.float32)

    def pick(self, values: Floats) -> Floats:
        """The value of each pixel's stone."""
        return values[self.id]

    def blended(self, colours: Floats, waves: float) -> Floats:
        """Colours (count, 3) changed a little, so that no patch of the wall is darker or lighter than another.

        What chance makes would be seen from afar, over and over, since the tile repeats. Each stone has one colour.
        `waves`: swings across the tile below which patches are slow (see `evened`).
        """
        step = max(1, len(self.id) // _COARSE)
        seen = self.id[step // 2 :: step, step // 2 :: step]
        pixels = np.maximum(np.bincount(seen.ravel(), minlength=self.count), 1)[:, None]
        mean, spread = colours.mean(axis=0), colours.std(axis=0)
        for _ in range(_ROUNDS):
            picture = colours[seen]
            slow = picture - evened(picture, waves)
            sums = [np.bincount(seen.ravel(), slow[..., k].ravel(), self.count) for k in range(3)]
            colours = colours - (np.stack(sums, axis=1) / pixels).astype(np.float32)
            colours = np.clip(colours, mean - _ODD * spread, mean + _ODD * spread)
        return colours


def courses(canvas: Canvas, heights: Sequence[float], cuts: Sequence[Sequence[float] | Values]) -> Units:
    """Stones in courses from the bottom up; `cuts` has each course's joints, metres from the left, below the width.

    Courses go on around the edges: the stone after the last joint ends at the first.
    """
    tops = np.cumsum(heights)
    row_of = np.minimum(np.searchsorted(tops, canvas.y[:, 0]), len(heights) - 1)
    bottoms = tops - heights
    left, right, ids = [], [], []
    first = 0
    x = canvas.x[0]
    for cut in cuts:
        edges = np.sort(np.asarray(cut, np.float64))
        looped = np.concatenate([[edges[-1] - canvas.width], edges, [edges[0] + canvas.width]])
        place = np.searchsorted(looped, x, side="right") - 1
        left.append(x - looped[place])
        right.append(looped[place + 1] - x)
        ids.append(first + (place - 1) % len(edges))
        first += len(edges)
    below = np.broadcast_to(canvas.y - bottoms[row_of][:, None], (canvas.size, canvas.size))
    above = np.broadcast_to(tops[row_of][:, None] - canvas.y, (canvas.size, canvas.size))
    return Units(
        np.stack(ids)[row_of],
        first,
        np.stack(left)[row_of].astype(np.float32),
        np.stack(right)[row_of].astype(np.float32),
        below.astype(np.float32),
        above.astype(np.float32),
    )


def _palette(colours: Sequence[str], picks: Floats) -> Floats:
    table = np.stack([paint(colour) for colour in colours])
    return table[np.minimum((picks * len(colours)).astype(int), len(colours) - 1)]


def _mottle(colour: Floats, by: Floats) -> Floats:
    return np.clip(colour * (1 + by[..., None]), 0, 1)


def brick(
    canvas: Canvas,
    seed: int,
    bricks: Sequence[str],
    mortar: str,
    *,
    length: float = 0.25,
    course: float = 1 / 12,
    joint: float = 0.012,
    bond: str = "stretcher",
) -> None:
    """Lay bricks: ``stretcher`` bond, or ``cross`` bond (a course of headers on each course of stretchers)."""
    rows = round(canvas.tall / course)
    cuts: list[Values] = []
    for row in range(rows):
        unit = length if bond == "stretcher" or row % 2 == 0 else length / 2
        shift = (
            (length / 2) * (row % 2)
            if bond == "stretcher"
            else length / 4 * (row % 2) + length / 2 * (row // 2 % 2)
        )
        cuts.append((np.arange(round(canvas.width / unit)) * unit + shift) % canvas.width)
    units = courses(canvas, [canvas.tall / rows] * rows, cuts)
    wobble = canvas.noise(0.025, seed + 1, 2)
    distance = units.distance(joint, 0.006) + 0.0011 * wobble
    face = canvas.cover(distance)
    picks, tints, tilts = (randoms(seed + k, units.count) for k in (2, 3, 4))
    colour = units.pick(
        units.blended(
            _palette(bricks, picks) * (1 + 0.13 * (tints - 0.5))[:, None], max(3.5, canvas.width / 0.4)
        )
    )
    fire = canvas.noise((0.09, 0.05), seed + 5, 3)
    grain = canvas.noise(0.012, seed + 6, 2)
    colour = _mottle(colour, 0.035 * fire + 0.03 * grain)
    sand = _mottle(np.broadcast_to(paint(mortar), colour.shape), 0.03 * canvas.noise(0.01, seed + 7, 2))
    canvas.lay(canvas.full(), sand, height=-0.006)
    rounded = 0.004 * (1 - np.clip(-distance / 0.006, 0, 1)) ** 2
    canvas.lay(face, colour, height=0.0008 * grain + 0.0022 * (units.pick(tilts) - 0.5) - rounded, gloss=0.06)


def ashlar(
    canvas: Canvas,
    seed: int,
    stones: Sequence[str],
    mortar: str,
    heights: Sequence[float],
    lengths: Sequence[Sequence[float]],
    *,
    joint: float = 0.007,
    bed: float = 0.0,
    vary: float = 0.07,
) -> None:
    """Lay dressed blocks. Each course has its stones' `lengths`, its start shifted so that joints break.

    `bed` is the strength of the beds that show in the stone, `vary` that of differences between stones.
    """
    cuts = []
    for row, stretch in enumerate(lengths):
        unit = canvas.width / sum(stretch)
        shift = 0.5 * stretch[0] * unit * (row % 2) + 0.07 * unit * (row % 3)
        cuts.append((np.cumsum([0.0, *stretch[:-1]]) * unit + shift) % canvas.width)
    scale = canvas.tall / sum(heights)
    units = courses(canvas, [h * scale for h in heights], cuts)
    distance = units.distance(joint, 0.004) + 0.0006 * canvas.noise(0.03, seed + 1, 2)
    face = canvas.cover(distance)
    picks, tints = randoms(seed + 2, units.count), randoms(seed + 3, units.count)
    colour = units.pick(
        units.blended(_palette(stones, picks) * (1 + vary * (tints - 0.5))[:, None], canvas.width / 0.6)
    )
    grain = canvas.noise(0.01, seed + 4, 2)
    cloud = canvas.noise((0.3, 0.16), seed + 5, 3)
    colour = _mottle(colour, 0.022 * cloud + 0.014 * grain)
    if bed:
        colour = _mottle(colour, bed * canvas.noise((0.7, 0.022), seed + 6, 2))
    canvas.lay(canvas.full(), mortar, height=-0.008)
    rounded = 0.004 * (1 - np.clip(-distance / 0.006, 0, 1)) ** 2
    canvas.lay(face, colour, height=0.0006 * grain + 0.0018 * (units.pick(tints) - 0.5) - rounded, gloss=0.1)


def rustic(
    canvas: Canvas,
    seed: int,
    stone: str,
    rows: int,
    columns: float,
    *,
    groove: float = 0.035,
    sink: float = 0.03,
) -> None:
    """Lay rusticated blocks with sunk, bevelled joints; without columns only courses are marked, as in plaster."""
    unit = canvas.width / columns if columns else canvas.width * 4
    cuts = [
        (np.arange(max(1, round(columns))) * unit + 0.5 * unit * (row % 2)) % canvas.width
        if columns
        else [0.0]
        for row in range(rows)
    ]
    units = courses(canvas, [canvas.tall / rows] * rows, cuts)
    if not columns:
        far = np.full_like(units.left, 1.0)
        units = Units(units.id, units.count, far, far, units.below, units.above)
    distance = units.distance(groove * 0.4, 0.004)
    tints = randoms(seed + 3, units.count)
    grain = canvas.noise(0.012, seed + 4, 2)
    colour = np.broadcast_to(paint(stone), (canvas.size, canvas.size, 3))
    colour = colour * (1 + (0.05 if columns else 0.0) * (units.pick(tints) - 0.5))[..., None]
    colour = _mottle(colour, 0.02 * canvas.noise((0.5, 0.3), seed + 5, 3) + 0.013 * grain)
    bevel = np.clip(-distance / (groove * 0.5), 0, 1)
    canvas.lay(
        canvas.full(),
        colour,
        height=(-0.6 * sink * (1 - bevel) + 0.0003 * grain).astype(np.float32),
        gloss=0.08,
    )


def tiles(canvas: Canvas, seed: int, clay: Sequence[str], rows: int, columns: int) -> None:
    """Hang pantiles: each covers the head of those below it, and rolls over its neighbour."""
    pitch, width = canvas.tall / rows, canvas.width / columns
    units = courses(canvas, [pitch] * rows, [np.arange(columns) * width for _ in range(rows)])
    across = units.left / (units.left + units.right)
    roll = np.where(across < 0.3, np.sin(np.pi * across / 0.3), -0.55 * np.sin(np.pi * (across - 0.3) / 0.7))
    up = units.below / pitch
    lip = smooth(0.0, 0.05, up)
    height = 0.04 * roll + 0.035 * (1 - up) - 0.02 * (1 - lip)
    picks, tints = randoms(seed + 2, units.count), randoms(seed + 3, units.count)
    grain = canvas.noise(0.012, seed + 4, 2)
    colour = units.pick(
        units.blended(_palette(clay, picks) * (1 + 0.12 * (tints - 0.5))[:, None], canvas.width / 0.6)
    )
    colour = _mottle(colour, 0.03 * canvas.noise((0.1, 0.2), seed + 5, 3) + 0.02 * grain)
    seam = canvas.cover(np.abs(units.left) - 0.003)
    colour = colour * (1 - 0.25 * seam)[..., None]
    canvas.lay(canvas.full(), colour, height=(height + 0.0005 * grain).astype(np.float32), gloss=0.12)


def slates(canvas: Canvas, seed: int, slate: Sequence[str], rows: int, columns: int) -> None:
    """Hang slates in broken bond, each lapping the two below it."""
    pitch, width = canvas.tall / rows, canvas.width / columns
    cuts = [(np.arange(columns) * width + 0.5 * width * (row % 2)) % canvas.width for row in range(rows)]
    units = courses(canvas, [pitch] * rows, cuts)
    picks, tints, lifts = (randoms(seed + k, units.count) for k in (2, 3, 6))
    cleft = noise(canvas.size, (10, 26), seed + 4, 3)
    colour = units.pick(
        units.blended(_palette(slate, picks) * (1 + 0.16 * (tints - 0.5))[:, None], canvas.width / 0.6)
    )
    colour = _mottle(colour, 0.035 * cleft)
    up = units.below / pitch
    edge = np.minimum(np.minimum(units.left, units.right), units.below + 0.002)
    body = canvas.cover(0.0018 - edge)
    height = (0.006 + 0.004 * units.pick(lifts)) * (1 - up) + 0.0007 * cleft
    canvas.lay(canvas.full(), "#34383d", height=0.0)
    canvas.lay(body, colour, height=height.astype(np.float32), gloss=0.3)
