"""Surfaces: the colour of a material at a point in space, courses and all, worked out rather than painted.

Every pattern is anchored in the world, so it runs on over the joints between shapes. Joints that are finer than a
pixel fade instead of flickering.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from .materials import Material, rgb

__all__ = ["albedo", "linear", "noise"]

Floats = NDArray[np.float32]


def linear(colour: Floats) -> Floats:
    """Linear light from sRGB, 0 to 1."""
    return np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4).astype(np.float32)


def albedo(material: Material, points: Floats, normals: Floats, footprint: Floats) -> Floats:
    """Linear base colour (n, 3) of a material at `points` (n, 3) on surfaces with `normals` (n, 3).

    `footprint` (n,) is the size of a pixel there, in metres.
    """
    base = linear((np.array(rgb(material.base)) / 255).astype(np.float32))
    u, v = _unrolled(points, normals)
    pattern = _PATTERNS.get(material.pattern)
    shade = np.ones(len(points), np.float32) if pattern is None else pattern(u, v, footprint)
    weather = 1 + 0.07 * (noise(u * 0.9, v * 0.9) - 0.5)
    return base * (shade * weather)[:, None]


def noise(u: Floats, v: Floats) -> Floats:
    """Smooth random numbers, 0 to 1, on a lattice of one unit, at `u` and `v` (n,)."""
    iu, iv = np.floor(u), np.floor(v)
    fu, fv = u - iu, v - iv
    fu, fv = fu * fu * (3 - 2 * fu), fv * fv * (3 - 2 * fv)
    iu, iv = iu.astype(np.int32), iv.astype(np.int32)
    low = _hash(iu, iv) * (1 - fu) + _hash(iu + 1, iv) * fu
    high = _hash(iu, iv + 1) * (1 - fu) + _hash(iu + 1, iv + 1) * fu
    return (low * (1 - fv) + high * fv).astype(np.float32)


def _hash(i: NDArray[np.int32], j: NDArray[np.int32]) -> Floats:
    n = i.astype(np.uint32) * np.uint32(374761393) + j.astype(np.uint32) * np.uint32(668265263)
    n = (n ^ (n >> np.uint32(13))) * np.uint32(1274126177)
    return ((n ^ (n >> np.uint32(16))) & np.uint32(0xFFFF)).astype(np.float32) / np.float32(65535)


def _unrolled(points: Floats, normals: Floats) -> tuple[Floats, Floats]:
    """Coordinates on the surface: along it and up it (up the slope, on a roof), metres."""
    nx, ny, nz = np.abs(normals).T
    u = np.where(nx > nz, points[:, 2], points[:, 0])
    steep = np.sqrt(np.maximum(1 - ny * ny, 1e-4))
    v = np.where(ny > 0.97, points[:, 2], points[:, 1] / steep)
    gable = (ny > 0.2) & (ny <= 0.97) & (nx > nz)
    return np.where(gable, points[:, 2], u), v


def _joint(distance: Floats, width: float, footprint: Floats) -> Floats:
    """How much of a pixel at `distance` metres from a joint's middle is joint, 0 to 1."""
    reach = np.maximum(width, footprint)
    share = np.clip((reach / 2 - distance) / (0.5 * footprint) + 0.5, 0, 1) * (width / reach)
    return share.astype(np.float32)


def _coursed(course: float, length: float, joint: float, dark: float, vary: float) -> Callable[..., Floats]:
    def shade(u: Floats, v: Floats, footprint: Floats) -> Floats:
        row = np.floor(v / course)
        along = u / length + 0.5 * (row % 2)
        unit = np.floor(along)
        across = np.abs(v / course - np.round(v / course)) * course
        beside = np.abs(along - np.round(along)) * length
        gap = np.maximum(_joint(across, joint, footprint), _joint(beside, joint, footprint))
        tint = 1 + vary * (_hash(unit.astype(np.int32), row.astype(np.int32)) - 0.5)
        return (tint * (1 - gap) + dark * gap).astype(np.float32)

    return shade


def _roofing(course: float, width: float, round_: float, vary: float) -> Callable[..., Floats]:
    def shade(u: Floats, v: Floats, footprint: Floats) -> Floats:
        row = np.floor(v / course)
        fine = np.clip(1.4 - footprint / (0.35 * course), 0, 1)
        along = u / width + 0.5 * (row % 2)
        unit = np.floor(along)
        rise = v / course - row  # 0 at a tile's lower edge
        lap = 1 - 0.45 * np.clip((rise - 0.72) / 0.28, 0, 1) + 0.1 * np.clip(1 - rise / 0.2, 0, 1)
        bulge = 1 - round_ * np.abs(2 * (along - unit) - 1) ** 2
        beside = np.abs(along - np.round(along)) * width
        gap = 1 - 0.5 * _joint(beside, 0.006, footprint)
        tint = 1 + vary * (_hash(unit.astype(np.int32), row.astype(np.int32)) - 0.5)
        return (tint * (1 + fine * (lap * bulge * gap - 1))).astype(np.float32)

    return shade


def _boards(u: Floats, v: Floats, footprint: Floats) -> Floats:
    board = np.floor(u / 0.14)
    gap = _joint(np.abs(u / 0.14 - np.round(u / 0.14)) * 0.14, 0.008, footprint)
    grain = noise(u * 60, v * 1.5 + board * 7)
    tint = (
        1
        + 0.22 * (_hash(board.astype(np.int32), np.zeros(len(u), np.int32)) - 0.5)
        + 0.1 * np.clip(1.6 - 60 * footprint, 0, 1) * (grain - 0.5)
    )
    return (tint * (1 - 0.65 * gap)).astype(np.float32)


def _seams(u: Floats, v: Floats, footprint: Floats) -> Floats:
    offset = u / 0.5 - np.round(u / 0.5)
    seam = _joint(np.abs(offset) * 0.5, 0.03, footprint)
    return (1 + seam * np.where(offset > 0, -0.3, 0.2)).astype(np.float32)


def _speckle(u: Floats, v: Floats, footprint: Floats) -> Floats:
    fine = np.clip(1.6 - 50 * footprint, 0, 1)
    return 1 + 0.12 * fine * (noise(u * 45, v * 45) - 0.5) + 0.06 * (noise(u * 2.3, v * 2.3) - 0.5)


def _grain(u: Floats, v: Floats, footprint: Floats) -> Floats:
    return 1 + 0.03 * np.clip(1.6 - 60 * footprint, 0, 1) * (noise(u * 55, v * 55) - 0.5)


_PATTERNS: Mapping[str, Callable[..., Floats]] = {
    "brick": _coursed(0.075, 0.25, 0.011, 1.5, 0.32),
    "ashlar": _coursed(0.34, 0.72, 0.012, 0.62, 0.14),
    "tiles": _roofing(0.19, 0.2, 0.4, 0.2),
    "slates": _roofing(0.18, 0.26, 0.0, 0.3),
    "boards": _boards,
    "seams": _seams,
    "speckle": _speckle,
    "grain": _grain,
}
