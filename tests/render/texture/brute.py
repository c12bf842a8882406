"""An evaluator of texture grammars from the docs and the paper alone: one point, plain Python, 64-bit floats.

It follows the parsed rules, not their texture, with every number rounded to 16 bits as the texture rounds it. A layer
is a generator of what it paints; whoever listens stops when colour is opaque. Beside the answer it says how near the
point came to a boundary, and the corners that chance looked at to an edge of their steps: there 32-bit evaluators may
decide otherwise.
"""

from __future__ import annotations

import struct
from collections.abc import Generator, Sequence
from dataclasses import dataclass, field, replace
from math import ceil, floor, frexp, inf
from typing import NamedTuple

from facade_nb.render.texture import Grammar, Rule, Source
from facade_nb.render.texture.noise import noise_texture

from .stand_in import StandIn

__all__ = ["Answer", "answer", "half"]

Rect = tuple[float, float, float, float]
Four = tuple[float, float, float, float]


def half(value: float) -> float:
    """The value as a 16-bit float holds it."""
    found: float = struct.unpack("<e", struct.pack("<e", value))[0]
    return found


def step(value: float) -> float:
    """Half of what a 16-bit float is apart from the next one."""
    return max(2.0 ** (frexp(value)[1] - 12), 2.0**-25)


@dataclass
class Answer:
    """Colour, normal, specular (each with alpha), the rule, and the distances to what is uncertain."""

    totals: dict[str, list[float]] = field(default_factory=lambda: {u: [0.0] * 4 for u in ("c", "n", "s")})
    rule: int = -1
    margin: float = inf

    def near(self, distance: float) -> None:
        self.margin = min(self.margin, abs(distance))


@dataclass(frozen=True)
class Here:
    scope: Rect
    loose: tuple[float, float]  # how far its extents may be from what was meant
    at: tuple[float, float]
    ray: tuple[float, float, float]
    stack: tuple[tuple[float, float], ...] = ()
    times: int = 1
    turn: tuple[tuple[int, ...], ...] = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


class Paint(NamedTuple):
    usage: int
    value: Four
    rule: int


def answer(
    grammar: Grammar,
    tiles: StandIn,
    point: tuple[float, float],
    size: tuple[float, float],
    seed: tuple[float, float] = (0.0, 0.0),
    start: str | None = None,
    ray: tuple[float, float, float] = (0.0, 0.0, -1.0),
) -> Answer:
    found = Answer()
    here = Here((0.0, 0.0, *size), (0.0, 0.0), point, (ray[0], ray[1], -abs(ray[2])))
    walk = _Walk(grammar.rules, tiles, seed, found).walk(grammar.index(start), here)
    for paint in walk:
        total = found.totals[" cns"[paint.usage]]
        *rgb, alpha = paint.value
        for k in range(3):
            total[k] += (1 - total[3]) * alpha * rgb[k]
        total[3] += (1 - total[3]) * alpha
        if paint.usage == 1:
            if alpha > 0 and found.rule < 0:
                found.rule = paint.rule
            found.near(total[3] - 0.999) if total[3] != 1 else None
            if total[3] >= 0.999:
                break
    return found


@dataclass
class _Walk:
    rules: Sequence[Rule]
    tiles: StandIn
    seed: tuple[float, float]
    found: Answer

    def walk(self, number: int, here: Here) -> Generator[Paint, None, int]:
        """Paints of a rule; the value is how many layers below are to be passed over."""
        rule = self.rules[number]
        left, bottom, right, top = here.scope
        if right - left <= 0 or top - bottom <= 0:
            self.found.near(0)
            return 0
        name, fixed = rule.operator.name, rule.fixed
        if name in ("SplitX", "SplitY"):
            target, lower, upper, loose = self.split(rule, here, name == "SplitY")
            return (yield from self.walk(target, _cut(here, name == "SplitY", lower, upper, loose)))
        if name in ("RepeatX", "RepeatY"):
            axis = name == "RepeatY"
            start, extent = (bottom, top - bottom) if axis else (left, right - left)
            largest = half(fixed[0]) + step(half(fixed[0]))
            ratio = (extent - here.loose[axis] - _lost(here.scope, axis)) / largest
            self.found.near((ratio - round(ratio)) * 10)
            count = max(1, ceil(ratio))
            each = extent / count
            k = min(max(floor((here.at[axis] - start) / each), 0), count - 1)
            self.boundary(here.at[axis] - start - k * each, each)
            low, high = start + k * each, start + (k + 1) * each
            return (yield from self.walk(fixed[1], _cut(here, axis, low, high, here.loose[axis] / count)))
        if name in ("Rand", "RandUni"):
            return (yield from self.walk(self.chance(rule, here), here))
        if name == "RandStack":
            pushed = (left + here.times * self.seed[0], bottom + here.times * self.seed[1])
            return (yield from self.walk(fixed[0], replace(here, stack=(*here.stack, pushed))))
        if name == "Layer":
            skip = 0
            for i in range(len(rule.parts), 0, -1):
                if skip:
                    skip -= 1
                else:
                    skip = yield from self.walk(rule.parts[i - 1][0], replace(here, times=here.times + i))
            return skip
        if name == "Skip":
            return fixed[0]
        if name == "SkipMask":
            u, v = (here.at[0] - left) / (right - left), (here.at[1] - bottom) / (top - bottom)
            value = self.mask(fixed[0], self.texel(fixed[0].tile, u, v, False))
            self.found.near((value - 0.5) * 10)
            return fixed[2] if value >= 0.5 else fixed[1]
        if name == "Intrusion":
            number, inside = self.room(rule, here)
            return (yield from self.walk(number, inside))
        value = list(self.value(fixed[1], [half(v) for v in fixed[2:6]], here))
        if name == "MatAlpha":
            factor = self.value(fixed[6], [half(v) for v in fixed[7:11]], here)
            value[3] *= self.mask(fixed[6], factor) if fixed[6].tile else factor[3]
        if fixed[0] == 2:
            local = [2 * v - 1 for v in value[:3]]
            value[:3] = [sum(local[k] * here.turn[k][j] for k in range(3)) / 2 + 0.5 for j in range(3)]
        yield Paint(fixed[0], tuple(value), number)
        return 0

    def boundary(self, inside: float, extent: float) -> None:
        self.found.near(inside)
        self.found.near(extent - inside)

    def split(self, rule: Rule, here: Here, axis: bool) -> tuple[int, float, float, float]:
        """Eq. 1, then parts are clamped from the end, and the last one has what is left.

        Absolute parts that may have been meant to fill the scope do; those that may have been meant to end with it do.
        """
        start, extent = here.scope[axis], here.scope[axis + 2] - here.scope[axis]
        sizes = [(s, half(v), target) for s, v, target in rule.parts]
        share = half(sum(v for s, v, _ in sizes if s == 1))
        taken = half(sum(v for s, v, _ in sizes if s == -1))
        if share:
            self.found.near(extent - taken)
        lost, loose = _lost(here.scope, axis), here.loose[axis]
        fixed = [v for s, v, _ in sizes if s == -1]
        missing = abs(extent - sum(fixed)) - loose - lost - sum(map(step, fixed))
        fills = bool(fixed) and missing <= 0
        stretch = extent / sum(fixed) if fills else 1.0
        unit = 0.0 if fills or not share else max(0.0, extent - taken) / share
        if fixed:
            self.found.near(missing)
        about = (loose + (taken / 2048 + step(taken) if fixed else 0)) / (share or 1)
        many = about + unit * (1 / 2048 + step(share) / share) if share else 0.0
        edges, slacks = [0.0], []
        for k, (s, v, _) in enumerate(sizes):
            width = v * stretch if s == -1 else unit * v
            own = step(v) + abs(width - v) if s == -1 else v * about
            if s == 1 and v != share:
                own = v * many + unit * step(v)
            end = min(edges[-1] + width, extent)
            before = loose + sum(slacks)
            if fills and sum(f for t, f, _ in sizes[: k + 1] if t == -1) >= sum(fixed):
                end = extent
            if not fills and taken > extent:
                gap = extent - end - before - own - lost
                self.found.near(gap)
                end = extent if gap <= 0 else end
            if k == len(sizes) - 1:
                end = extent
            if end == extent:
                own = min(own + abs(end - edges[-1] - width), before)
            edges.append(end)
            slacks.append(own)
        at = min(max(here.at[axis] - start, 0.0), extent)
        for k, (_, _, target) in enumerate(sizes):
            if edges[k + 1] > edges[k] and (at < edges[k + 1] or edges[k + 1] == extent):
                self.boundary(at - edges[k], edges[k + 1] - edges[k])
                return target, start + edges[k], start + edges[k + 1], slacks[k]
        raise AssertionError("a part is hit")

    def chance(self, rule: Rule, here: Here) -> int:
        level = min(rule.fixed[0], len(here.stack))
        if level:
            x, y = here.stack[-level]
        else:
            x, y = (here.scope[k] + here.times * self.seed[k] for k in (0, 1))
        steps = []
        for corner in (x, y):
            place = corner * 64 + 0.5
            self.found.near((place - round(place)) / 64)
            steps.append(floor(place) % 2**32)
        mixed = _mix(_mix(steps[0]) ^ steps[1])
        r = float(noise_texture()[mixed >> 24, mixed >> 16 & 255])
        if rule.operator.name == "RandUni":
            return rule.parts[floor(r * len(rule.parts))][0]
        total = 0.0
        for weight, target in rule.parts[:-1]:
            total += weight
            if r < half(total):
                return target
        return rule.parts[-1][1]

    def room(self, rule: Rule, here: Here) -> tuple[int, Here]:
        """March to each of the five planes; the first one hit is the face."""
        depth = half(rule.fixed[0])
        left, bottom, right, top = here.scope
        dx, dy, dz = here.ray
        px, py = here.at[0], here.at[1]
        planes = {
            0: (left - px, dx),
            2: (right - px, dx),
            3: (bottom - py, dy),
            4: (top - py, dy),
            1: (-depth, dz),
        }
        hits = {
            face: max(gap / speed, 0.0)
            for face, (gap, speed) in planes.items()
            if speed and ((face in (0, 3, 1) and speed < 0) or (face in (2, 4) and speed > 0))
        }
        if 1 in hits and max(depth / abs(dz), 0) > 1e29:
            self.found.near(0)
        face = min(hits, key=lambda k: (hits[k], k != 1))
        t = hits[face]
        x, y, z = px + dx * t, py + dy * t, -dz * t
        length = (dx * dx + dy * dy + dz * dz) ** 0.5
        others = sorted(hits.values())
        if len(others) > 1:
            self.found.near((others[1] - others[0]) * length * min(1, abs(dz) / length) ** 2)
        if abs(dz) / length < 0.02:
            self.found.near(0)
        w, h = right - left, top - bottom
        across = {  # how far to the right, how far up, how wide, how tall, seen from inside
            0: (z, y - bottom, depth, h),
            1: (x - left, y - bottom, w, h),
            2: (depth - z, y - bottom, depth, h),
            3: (x - left, z, w, depth),
            4: (x - left, depth - z, w, depth),
        }[face]
        axes = {  # right, up and towards the viewer of each face, in the scope's own axes
            0: ((0, 0, -1), (0, 1, 0), (1, 0, 0)),
            1: ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
            2: ((0, 0, 1), (0, 1, 0), (-1, 0, 0)),
            3: ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
            4: ((1, 0, 0), (0, 0, 1), (0, -1, 0)),
        }[face]
        u, v, wide, tall = across
        ray = tuple(sum(a * b for a, b in zip(axis, here.ray, strict=True)) for axis in axes)
        turn = tuple(
            tuple(sum(axis[k] * here.turn[k][j] for k in range(3)) for j in range(3)) for axis in axes
        )
        scope = (left, bottom, left + wide, bottom + tall)
        far = step(depth)
        loose = (far if face in (0, 2) else here.loose[0], far if face in (3, 4) else here.loose[1])
        inside = Here(scope, loose, (left + u, bottom + v), ray, here.stack, here.times + face + 1, turn)
        return rule.fixed[face + 1], inside

    def value(self, source: Source, numbers: Sequence[float], here: Here) -> Four:
        a, b, c, d = numbers
        if not source.mode:
            return a, b, c, d
        if source.mode == "Rep":
            return self.texel(source.tile, a + here.at[0] * c, b + here.at[1] * d, True)
        left, bottom, right, top = here.scope
        u, v = (here.at[0] - left) / (right - left), (here.at[1] - bottom) / (top - bottom)
        return self.texel(source.tile, a + u * (c - a), b + v * (d - b), False)

    def mask(self, source: Source, value: Four) -> float:
        image = self.tiles.image(source.tile)
        return sum(value[:3]) / 3 if image[..., 3].min() == 255 else value[3]

    def texel(self, tile: str, u: float, v: float, wrap: bool) -> Four:
        image = self.tiles.image(tile)
        height, width = image.shape[:2]
        x, y = u * width - 0.5, (1 - v) * height - 0.5
        total = [0.0] * 4
        for j in (floor(y), floor(y) + 1):
            for i in (floor(x), floor(x) + 1):
                weight = (1 - abs(x - i)) * (1 - abs(y - j))
                column, row = (
                    (i % width, j % height)
                    if wrap
                    else (min(max(i, 0), width - 1), min(max(j, 0), height - 1))
                )
                for k in range(4):
                    total[k] += weight * int(image[row, column, k]) / 255
        return total[0], total[1], total[2], total[3]


def _cut(here: Here, axis: bool, lower: float, upper: float, loose: float) -> Here:
    left, bottom, right, top = here.scope
    other = here.loose[not axis]
    return replace(
        here,
        scope=(left, lower, right, upper) if axis else (lower, bottom, upper, top),
        loose=(other, loose) if axis else (loose, other),
    )


def _lost(scope: Rect, axis: bool) -> float:
    """What 32 bits may have lost of a scope's extent."""
    return max(abs(scope[axis]), abs(scope[axis + 2])) / 2**21


def _mix(value: int) -> int:
    value ^= value >> 16
    value = value * 0x7FEB352D % 2**32
    value ^= value >> 15
    value = value * 0x846CA68B % 2**32
    return value ^ value >> 16
