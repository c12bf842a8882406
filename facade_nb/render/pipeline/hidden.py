"""Which chunks of a mesh are hidden behind what has been drawn: in a street most of a town is.

A software renderer takes long for triangles that nobody sees. So what is near is drawn first, and of the rest only
those chunks whose box is not, all over, behind that. No picture changes: a box holds all of its chunk.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["BLOCK", "hidden", "nearest_first"]

BLOCK = 32
"""Pixels of each side of a square of the picture of which the farthest depth is kept."""

_SURE = 4 / (1 << 24)  # steps of a map of depths
_FIRST = 12_000  # triangles, about, that are drawn before one looks what they hide

_CORNERS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], bool)


def nearest_first(chunks: np.ndarray, eye: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Places of chunks that are drawn first, and of the others, each in their order in the mesh.

    Who looks down from above sees them all: then there are no others.
    """
    low, high = (chunks[name].astype(np.float64) for name in ("low", "high"))
    apart = np.maximum(np.maximum(low - eye, eye - high), 0)
    order = np.argsort((apart * apart).sum(axis=1), kind="stable")
    drawn = np.cumsum(chunks["count"][order].astype(np.int64)) // 3
    near, rest = np.split(order, [int(np.searchsorted(drawn, _FIRST)) + 1])
    if not len(rest) or high[near, 1].max() < eye[1]:
        return np.arange(len(chunks)), rest[:0]
    return np.sort(near), np.sort(rest)


def hidden(
    chunks: np.ndarray, through: NDArray[np.float64], depths: NDArray[np.float32]
) -> NDArray[np.bool_]:
    """Which chunks nobody sees.

    Parameters
    ----------
    chunks
        (c,) `CHUNK`.
    through
        From the world to clip space (4, 4).
    depths
        (h, w) of what has been drawn, from 0 to 1, row 0 at the bottom.
    """
    low, high = (chunks[name].astype(np.float64) for name in ("low", "high"))
    corners = np.where(_CORNERS[None], high[:, None], low[:, None])  # (c, 8, 3)
    clip = (corners[:, :, None, :] * through[None, None, :, :3]).sum(axis=3) + through[:, 3]
    before = (clip[..., 3] > 0).all(axis=1) & (clip[..., 2] > -clip[..., 3]).all(axis=1)
    found = np.zeros(len(chunks), bool)
    places = np.flatnonzero(before)
    if not len(places):
        return found
    shares = 0.5 * clip[places, :, :3] / clip[places, :, 3:] + 0.5
    farthest = _farthest(depths)
    across, up = (
        _reached(shares[..., k], pixels, count)
        for k, pixels, count in zip((0, 1), depths.shape[::-1], farthest.shape[::-1], strict=True)
    )
    nearest = shares[..., 2].min(axis=1) - _SURE
    free = up[:, :, None] & across[:, None, :] & (farthest >= nearest[:, None, None])
    found[places] = ~free.any(axis=(1, 2))
    return found


def _reached(shares: NDArray[np.float64], pixels: int, count: int) -> NDArray[np.bool_]:
    """(c, n) which blocks along an axis corners (c, 8) reach to, given as shares of the picture."""
    first, last = (np.clip(end(axis=1), 0, 1) * pixels / BLOCK for end in (shares.min, shares.max))
    blocks = np.arange(count)
    return (blocks + 1 >= first[:, None] - 1e-3) & (blocks <= last[:, None] + 1e-3)


def _farthest(depths: NDArray[np.float32]) -> NDArray[np.float32]:
    """The farthest depth of each block; blocks at the upper and right rim may be smaller."""
    rows = np.stack([depths[y : y + BLOCK].max(axis=0) for y in range(0, len(depths), BLOCK)])
    columns = [rows[:, x : x + BLOCK].max(axis=1) for x in range(0, depths.shape[1], BLOCK)]
    return np.stack(columns, axis=1)
