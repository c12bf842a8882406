"""Light on what the camera sees: sun with its shadow, the sky as each point sees it, glass that mirrors it.

The camera gives the triangle at each pixel. From that follow the point, its normal and its material. The sky's light
is gathered by looking at the scene from many directions of the sky and asking which points each of them sees, so
corners, reveals and the ground beside the wall darken as they do out of doors.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .backends import Backend, Canvas3D
from .camera import View, light_matrix
from .daylight import Daylight, floats
from .materials import Material, find_material
from .scene import Triangles
from .surfaces import albedo, noise

__all__ = ["Exposure", "Shot", "expose"]

Floats = NDArray[np.float32]

_BOUNCE = floats([0.30, 0.28, 0.25])
"""Light that comes back from the ground, as a share of what falls on it."""


@dataclass(frozen=True, slots=True, eq=False)
class Shot:
    """What a picture needs.

    Attributes
    ----------
    triangles
        Everything that stands on the ground.
    view
        The camera.
    size
        Pixels (width, height).
    light
        The time of day.
    rays
        From how many directions the sky is looked at.
    rects
        (s, 4): the rectangles of the layout's shapes, metres.
    """

    triangles: Triangles
    view: View
    size: tuple[int, int]
    light: Daylight
    rays: int
    rects: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Exposure:
    """What comes out: linear `light` (h, w, 3); where `building` and `ground` are seen, and its `shade` (h, w)."""

    light: Floats
    building: NDArray[np.bool_]
    ground: NDArray[np.bool_]
    shade: Floats


@dataclass(frozen=True, slots=True, eq=False)
class _Seen:
    """The n points the camera sees: position, normal, material (-1: ground), distance, and at which pixel."""

    points: Floats
    normals: Floats
    material: NDArray[np.int64]
    triangle: NDArray[np.int64]
    distance: Floats
    where: NDArray[np.int64]


def expose(shot: Shot, backend: Backend) -> Exposure:
    """Work out the light at every pixel."""
    positions = shot.triangles.positions
    with backend.open(positions, shot.size) as canvas:
        index, _ = canvas.draw(shot.view.matrix)
    seen = _trace(shot, index)
    sun = _sun(shot, backend, seen)
    sky, open_sky = _sky(shot, backend, seen)
    colour = _colours(shot, seen)
    lit = colour * (sun[:, None] * floats(shot.light.sun_colour) + sky)
    glass = np.array(
        [find_material(name).pattern == "glass" for name in shot.triangles.material_names] + [False]
    )
    panes = glass[seen.material]
    if panes.any():
        lit[panes] = _mirror(shot, seen, panes, lit[panes], open_sky[panes])
    full = floats(shot.light.sun_colour) * max(shot.light.towards[1], 0.05) + floats(shot.light.zenith)
    shade = np.clip(1 - (lit / np.maximum(colour, 1e-4)).mean(axis=1) / full.mean(), 0, 1)
    on_ground = seen.material < 0

    def spread(values: NDArray[Any]) -> NDArray[Any]:
        whole = np.zeros((shot.size[0] * shot.size[1], *values.shape[1:]), values.dtype)
        whole[seen.where] = values
        return whole.reshape(shot.size[1], shot.size[0], *values.shape[1:])

    return Exposure(spread(lit), spread(~on_ground), spread(on_ground), spread(shade.astype(np.float32)))


def _trace(shot: Shot, index: NDArray[np.int32]) -> _Seen:
    """The points behind the pixels: on the triangle that is seen there, or else on the ground."""
    eye = shot.view.eye.astype(np.float32)
    rays = shot.view.rays(shot.size).reshape(-1, 3)
    flat = index.reshape(-1)
    hit = np.flatnonzero(flat >= 0)
    corners = shot.triangles.positions
    plane = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    plane /= np.maximum(np.linalg.norm(plane, axis=1, keepdims=True), 1e-12)
    k = flat[hit]
    steep = np.einsum("ij,ij->i", plane[k], rays[hit])
    t = np.einsum("ij,ij->i", plane[k], corners[k, 0] - eye) / np.where(np.abs(steep) > 1e-7, steep, 1e-7)
    points = eye + rays[hit] * t[:, None]
    normals = _interpolated(shot.triangles, k, points)
    free = np.flatnonzero((flat < 0) & (rays[:, 1] < -1e-4))
    s = -eye[1] / rays[free, 1]
    floor = eye + rays[free] * s[:, None]
    up = np.zeros_like(floor)
    up[:, 1] = 1
    return _Seen(
        np.concatenate([points, floor]),
        np.concatenate([normals, up]),
        np.concatenate([shot.triangles.materials[k], np.full(len(free), -1)]),
        np.concatenate([k.astype(np.int64), np.full(len(free), -1)]),
        np.concatenate([t, s]).astype(np.float32),
        np.concatenate([hit, free]),
    )


def _interpolated(triangles: Triangles, k: NDArray[np.int32], points: Floats) -> Floats:
    """Normals at points of triangles `k`, from the corners where these differ."""
    own = triangles.normals[k]
    normals = own[:, 0].copy()
    curved = np.flatnonzero((own[:, 0] != own[:, 1]).any(axis=1) | (own[:, 0] != own[:, 2]).any(axis=1))
    if len(curved):
        a, b, c = (triangles.positions[k[curved], i].astype(np.float64) for i in range(3))
        p = points[curved]
        across = np.cross(b - a, c - a)
        area = np.maximum(np.einsum("ij,ij->i", across, across), 1e-18)
        wb = np.einsum("ij,ij->i", np.cross(p - a, c - a), across) / area
        wc = np.einsum("ij,ij->i", np.cross(b - a, p - a), across) / area
        weights = np.clip(np.stack([1 - wb - wc, wb, wc], 1), 0, 1)
        mixed = np.einsum("ij,ijk->ik", weights, own[curved])
        normals[curved] = mixed / np.maximum(np.linalg.norm(mixed, axis=1, keepdims=True), 1e-6)
    return normals


class _Shadows:
    """Which points a direction of light reaches."""

    def __init__(self, canvas: Canvas3D, shot: Shot, towards: NDArray[np.float64], size: int) -> None:
        corners = shot.triangles.positions.reshape(-1, 3)
        self._matrix = light_matrix(towards, corners.astype(np.float64))
        span = 2 / np.linalg.norm(self._matrix[:3, :3], axis=1)  # metres across, up and deep
        depth = np.pad(canvas.depth(self._matrix), 1, constant_values=1)
        depth = np.where(depth < 1, depth + np.float32(0.006 / span[2]), np.float32(np.inf))
        self._depth, self._size = depth.reshape(-1), size
        self._texel = floats(size / span[:2])  # texels per metre
        self._lift = np.float32(
            0.004 + 1.2 / float(self._texel.min())
        )  # off the surface, so that it doesn't shade itself

    def reach(self, points: Floats, normals: Floats, jitter: Floats) -> NDArray[np.bool_]:
        """Whether light arrives at `points` (3, n), looked up `jitter` (2, n) metres off."""
        half = np.float32(self._size / 2)
        across, up, deep, _ = self._matrix.astype(np.float32)

        def seen(row: Floats) -> Floats:
            value = points[0] * row[0]
            for axis in (1, 2):
                value += points[axis] * row[axis]
            for axis in (0, 1, 2):
                value += normals[axis] * (row[axis] * self._lift)
            value += row[3]
            return value

        x, y = seen(across) * half, seen(up) * -half
        x += jitter[0] * self._texel[0] + (half + 1)
        y += jitter[1] * self._texel[1] + (half + 1)
        edge = self._size + 1
        place = np.clip(y, 0, edge).astype(np.int32) * (edge + 1) + np.clip(x, 0, edge).astype(np.int32)
        return seen(deep) * np.float32(0.5) + np.float32(0.5) <= self._depth.take(place)


class _Jitter:
    """Random offsets within a disc, drawn once and handed out in ever different order."""

    def __init__(self, count: int) -> None:
        random = np.random.default_rng(1)
        angle, length = random.random(count + 9973) * 2 * np.pi, np.sqrt(random.random(count + 9973))
        self._pool = np.stack([np.cos(angle) * length, np.sin(angle) * length]).astype(np.float32)

    def take(self, turn: int, count: int, radius: float) -> Floats:
        start = turn * 1471 % 9973
        return self._pool[:, start : start + count] * np.float32(radius)


def _sun(shot: Shot, backend: Backend, seen: _Seen) -> Floats:
    """How much sun falls on each point: its slant times the share of the sun's disc that is seen."""
    towards = shot.light.towards
    slant = np.clip(seen.normals @ towards.astype(np.float32), 0, None)
    size = 768 if backend.name == "cpu" else 3072
    facing = np.flatnonzero(slant > 0)
    points, normals = (
        np.ascontiguousarray(seen.points[facing].T),
        np.ascontiguousarray(seen.normals[facing].T),
    )
    total = np.zeros(len(facing), np.float32)
    with backend.open(shot.triangles.positions, (size, size)) as canvas:
        shadows = _Shadows(canvas, shot, towards, size)
    jitter = _Jitter(len(facing))
    taps = 9
    for tap in range(taps):
        total += shadows.reach(points, normals, jitter.take(tap, len(facing), 0.014))
    result = np.zeros(len(slant), np.float32)
    result[facing] = slant[facing] * total / taps
    return result


def _sky(shot: Shot, backend: Backend, seen: _Seen) -> tuple[Floats, Floats]:
    """The sky's and the ground's light (n, 3) at each point, and the share of the sky it sees (n,).

    Light from the sky changes slowly: it is worked out at every second pixel both ways, and again only at those
    pixels whose neighbour there lies on another surface.
    """
    source = _neighbours(shot, seen)
    chosen, back = np.unique(source, return_inverse=True)
    points, normals = (
        np.ascontiguousarray(seen.points[chosen].T),
        np.ascontiguousarray(seen.normals[chosen].T),
    )
    count = shot.rays
    order = np.arange(count)
    height = (order + 0.5) / count  # even over the hemisphere
    angle = order * np.pi * (3 - np.sqrt(5))
    flat = np.sqrt(1 - height**2)
    directions = np.stack([flat * np.cos(angle), height, flat * np.sin(angle)], 1)
    colours = shot.light.sky(height.astype(np.float32))
    size = 256 if backend.name == "cpu" else 512
    light = np.zeros((4, len(chosen)), np.float32)  # red, green, blue, and how open the sky is
    best = np.full(len(chosen), 1e-6, np.float32)
    jitter = _Jitter(len(chosen))
    with backend.open(shot.triangles.positions, (size, size)) as canvas:
        for k, (x, y, z) in enumerate(directions.astype(np.float32)):
            slant = normals[0] * x + normals[1] * y + normals[2] * z
            np.maximum(slant, 0, out=slant)
            best += slant
            shadows = _Shadows(canvas, shot, directions[k], size)
            slant *= shadows.reach(points, normals, jitter.take(k, len(chosen), 0.05))
            for channel, strength in enumerate((*colours[k], 1.0)):
                light[channel] += slant * np.float32(strength)
    light[:3] *= 2 / count
    light[3] /= best
    light = _smoothed(light, shot, seen, chosen)
    openness = light[3]
    # What comes from below: the lit ground, seen by surfaces as far as they look down, and as open as the place is.
    downward = 0.5 - 0.5 * normals[1]
    ground = floats(shot.light.sun_colour) * max(shot.light.towards[1], 0.0) + floats(shot.light.zenith)
    near = np.exp(-np.maximum(points[1], 0) / 6)
    below = downward * (0.35 + 0.65 * openness) * (0.55 + 0.45 * near)
    gathered = light[:3] + below * (_BOUNCE * ground)[:, None]
    gathered += floats([[0.05], [0.05], [0.055]]) * (0.3 + 0.7 * openness)  # what has bounced many times
    return gathered.T[back], openness[back]


def _smoothed(light: Floats, shot: Shot, seen: _Seen, chosen: NDArray[np.int64]) -> Floats:
    """The light (4, n) of the `chosen` points averaged with those around on the same surface: takes the grain out."""
    width, height = (shot.size[0] + 1) // 2, (shot.size[1] + 1) // 2
    row, column = np.divmod(seen.where[chosen], shot.size[0])
    even = np.flatnonzero((row % 2 == 0) & (column % 2 == 0))
    place = (row[even] // 2 + 2) * (width + 4) + column[even] // 2 + 2
    source = np.full((height + 4) * (width + 4), -1, np.int64)
    source[place] = even
    points, normals = seen.points[chosen[even]], seen.normals[chosen[even]]
    level = np.einsum("ij,ij->i", points, normals)
    total, weight = light[:, even].copy(), np.ones(len(even), np.float32)
    inverse = np.full(len(chosen), 0)
    inverse[even] = np.arange(len(even))
    for step in [(dy, dx) for dy in (-2, -1, 0, 1, 2) for dx in (-2, -1, 0, 1, 2) if (dy, dx) != (0, 0)]:
        other = source[place + step[0] * (width + 4) + step[1]]
        mate = inverse[np.maximum(other, 0)]
        same = (other >= 0) & (np.abs(level[mate] - level) < 0.01)
        same &= (normals[mate] * normals).sum(axis=1) > 0.98
        share = same.astype(np.float32)
        total += light[:, np.maximum(other, 0)] * share
        weight += share
    result = light.copy()
    result[:, even] = total / weight
    return result


def _neighbours(shot: Shot, seen: _Seen) -> NDArray[np.int64]:
    """For each point the one whose light of the sky it shares: that of the even pixel beside it, if on one surface."""
    width, height = shot.size
    at = np.full(width * height, -1, np.int64)
    at[seen.where] = np.arange(len(seen.where))
    row, column = np.divmod(seen.where, width)
    mate = at[row // 2 * 2 * width + column // 2 * 2]
    own = np.arange(len(mate))
    safe = np.where(mate < 0, own, mate)
    aligned = np.einsum("ij,ij->i", seen.normals, seen.normals[safe]) > 0.97
    apart = np.abs(np.einsum("ij,ij->i", seen.normals, seen.points - seen.points[safe]))
    return np.where(aligned & (apart < 0.01), safe, own)


def _colours(shot: Shot, seen: _Seen) -> Floats:
    """Base colours (n, 3) of the points, patterns of materials and of the paving included."""
    result = np.zeros_like(seen.points)
    footprint = seen.distance * np.float32((shot.view.window[2] - shot.view.window[0]) / shot.size[0])
    for k, name in enumerate((*shot.triangles.material_names, None)):
        chosen = np.flatnonzero(seen.material == (k if name is not None else -1))
        if not len(chosen):
            continue
        points, foot = seen.points[chosen], footprint[chosen]
        if name is None:
            result[chosen] = _paving(points, foot)
        else:
            material: Material = find_material(name)
            result[chosen] = albedo(material, points, seen.normals[chosen], foot)
    return result


def _paving(points: Floats, footprint: Floats) -> Floats:
    """The ground: large slabs of light stone near the building, fading into an even tone."""
    x, z = points[:, 0], points[:, 2]
    tone = 0.40 + 0.04 * (noise(x * 0.35, z * 0.35) - 0.5)
    slab = 0.9
    across = np.minimum(np.abs(x / slab - np.round(x / slab)), np.abs(z / slab - np.round(z / slab))) * slab
    reach = np.maximum(0.016, footprint * 2)
    joint = np.clip((reach / 2 - across) / np.maximum(footprint, 1e-4) + 0.5, 0, 1) * 0.016 / reach
    near = np.clip(1.6 - np.abs(z) / 8, 0, 1)
    tone = tone * (1 - 0.4 * joint * near)
    return (tone[:, None] * floats([1.0, 0.975, 0.935])).astype(np.float32)


def _mirror(shot: Shot, seen: _Seen, panes: NDArray[np.bool_], inside: Floats, openness: Floats) -> Floats:
    """Glass: curtains and a dark room behind, the sky and the houses opposite in it, each pane a little out of true."""
    points, normals = seen.points[panes], seen.normals[panes].copy()
    triangle = seen.triangle[panes]
    lean = np.sin((triangle // 12)[:, None] * np.array([12.9898, 78.233, 37.719])) * 43758.5453
    normals += ((lean - np.floor(lean) - 0.5) * 0.045).astype(np.float32)
    normals[:, 0] += 0.02 * (noise(points[:, 0] * 2.3, points[:, 1] * 2.3) - 0.5)
    normals[:, 1] += 0.03 * (noise(points[:, 1] * 1.7, points[:, 0] * 1.7 + 9) - 0.5)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    view = points - shot.view.eye.astype(np.float32)
    view /= np.linalg.norm(view, axis=1, keepdims=True)
    facing = -np.einsum("ij,ij->i", view, normals)
    bounced = view + 2 * facing[:, None] * normals
    mirrored = np.clip(0.3 + 0.7 * (1 - np.clip(facing, 0, 1)) ** 4, 0, 0.9)[:, None]
    up = bounced[:, 1]
    sky = shot.light.sky(np.clip(up * 1.6 + 0.05, 0, 1))
    spot = np.arctan2(bounced[:, 0], np.abs(bounced[:, 2]) + 1e-3)
    still = np.zeros_like(spot)
    skyline = -0.04 + 0.06 * noise(spot * 7 + 3, still) + 0.02 * noise(spot * 31, still)
    house = (
        (0.22 + 0.12 * noise(spot * 7 + 3.5, still))[:, None]
        * floats(shot.light.horizon)
        * floats([1.0, 0.96, 0.9])
    )
    street = floats(shot.light.sun_colour) * 0.16 + floats(shot.light.zenith) * 0.2
    shown = sky + (house - sky) * np.clip((skyline - up) / 0.03 + 0.5, 0, 1)[:, None]
    shown += (street - shown) * np.clip((-0.08 - up) / 0.08 + 0.5, 0, 1)[:, None]
    room = floats([0.028, 0.031, 0.034]) + np.zeros_like(points)
    shape = shot.triangles.shapes[triangle]
    left, bottom, right, top = shot.rects[np.maximum(shape, 0)].T
    u = (points[:, 0] - left) / np.maximum(right - left, 1e-3)
    v = (points[:, 1] - bottom) / np.maximum(top - bottom, 1e-3)
    edge = 0.2 + 0.1 * np.clip(v, 0, 1) ** 2
    hang = (
        np.clip((edge - np.minimum(u, 1 - u)) / 0.02, 0, 1) * (shape >= 0) * (right - left < 2) * (v > 0.06)
    )
    folds = 0.75 + 0.25 * np.sin(u * (right - left) * 75)
    cloth = inside.mean(axis=1, keepdims=True) * floats([6.0, 5.8, 5.5]) * folds[:, None]
    room = room * (1 - hang[:, None]) + np.clip(cloth, 0, 0.9) * hang[:, None]
    return room * (1 - mirrored) + shown * mirrored * (0.35 + 0.65 * openness)[:, None]
