"""The reference evaluator, in NumPy: a grammar at many points at once (the texture paper's 3; docs/texture.md).

It is written for reading; the shader (`glsl/texture`) does the same for one pixel, faster. Points that stand at the
same rule on the same way go on together, as a `Batch`. An operator takes a batch and gives it on, divided among the
rules that come next. Only Layer waits for what it has called: the layers above decide which points need those below.

Everything is 32-bit floats, as in the shader, and in the same order, so that the two differ by roundings alone.
All values come from the grammar's texture.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .batch import Batch, Floats, joined
from .dividing import half_step, pick, repeated, split
from .encoding import Record
from .limits import MAX_STEPS
from .noise import look_up, steps_of
from .operators import USAGES
from .question import Question, Surface
from .relief import Struck, strike
from .steps import FACES, Chosen, Divided, Entered, Layered, Painted, Passed, Stacked, Step

__all__ = ["BELOW_ONE", "OPAQUE", "evaluate"]

OPAQUE = np.float32(0.999)
"""From this alpha on, colour hides what lies below."""

BELOW_ONE = np.float32(0.9999999)
"""The largest place in a scope of size 1: what lies on its far edge belongs to its last part."""

_CHUNK = 1 << 16
_TINY, _HUGE, _FAR = np.float32(1e-30), np.float32(1e30), np.float32(1e9)
_STEEP, _SHARE, _LONG = np.float32(1000), np.float32(1 / 9), np.float32(16)
_USAGES = {number: name for name, number in USAGES.items()}


def evaluate(
    question: Question,
    points: Floats,
    rays: Floats | None = None,
    footprint: Floats | None = None,
    spread: float = 0.0,
    steps: list[Step] | None = None,
    margin: Floats | None = None,
    color_only: bool = False,
    shade: Floats | None = None,
) -> Surface:
    """The surface at points of a façade.

    Parameters
    ----------
    points
        (n, 2) metres.
    rays
        (n, 3); None: straight on.
    footprint
        (n,) metres that a pixel covers, from which the sizes of tiles follow; None: the largest, everywhere.
    spread
        How much larger that becomes along a ray, for each of the ray's lengths behind the façade.
    steps
        Gathers the derivation, of a single point.
    margin
        (n,) is filled with how near each point came to a boundary, in footprints as seen along the ray.
    color_only
        Passes over normals and specular values.
    shade
        (n,) is filled with how much of the sun the relief takes from what is seen.
    """
    count = len(points)
    color, normal, specular = (np.zeros((count, 4), np.float32) for _ in range(3))
    surface = Surface(color, normal, specular, np.full(count, -1, np.int32))
    run = _Run(question, surface, footprint is not None, spread, steps, margin, color_only, shade)
    if margin is not None:
        margin[:] = _FAR
    if shade is not None:
        shade[:] = 0
    zero, (width, height) = np.zeros(1, np.float32), (np.full(1, v, np.float32) for v in question.size)
    ahead = (zero, zero, np.full(1, -1, np.float32))
    for first in range(0, count, _CHUNK):
        index = np.arange(first, min(first + _CHUNK, count))
        x, y = np.ascontiguousarray(points[index].T)
        ray = ahead if rays is None else _ray(*np.ascontiguousarray(rays[index].T))
        pixel = zero if footprint is None else footprint[index]
        run.run(question.start, Batch(index, x, y, zero, zero, width, height, ray, pixel, (zero, zero)))
    return surface


def _ray(x: Floats, y: Floats, z: Floats) -> tuple[Floats, Floats, Floats]:
    """A viewing ray goes into the façade, whichever way its z points."""
    return x, y, -np.abs(z)


class _Run:
    """One evaluation: what all batches share."""

    def __init__(
        self,
        question: Question,
        surface: Surface,
        sized: bool,
        spread: float,
        steps: list[Step] | None,
        margin: Floats | None,
        color_only: bool,
        shade: Floats | None,
    ) -> None:
        self.color_only, self.shade = color_only, shade
        self.question, self.surface, self.steps, self.margin = question, surface, steps, margin
        self.sized, self.spread = sized, np.float32(spread)
        self.bits = question.texture.dtype.itemsize * 8
        self.passing = np.zeros(len(surface.rule), np.int32)  # layers that a point still has to pass over
        self.taken = np.zeros(len(surface.rule), np.int32)  # operators on the way of each point
        self.sums = (surface.color, surface.normal, surface.specular)

    def run(self, rule: int, batch: Batch) -> None:
        """Take points from a rule to their terminals, but for layers further below."""
        waiting = [(rule, batch)]
        while waiting:
            rule, batch = self._next(waiting)
            batch = self._count(batch)
            if not len(batch):
                continue
            record = self.question.records[rule]
            match record.operator.name:
                case "SplitX" | "SplitY":
                    waiting += self._split(rule, record, batch, "XY".index(record.operator.name[-1]))
                case "RepeatX" | "RepeatY":
                    waiting += self._repeat(rule, record, batch, "XY".index(record.operator.name[-1]))
                case "Rand" | "RandUni":
                    waiting += self._random(rule, record, batch)
                case "RandStack":
                    waiting += self._stack(rule, record, batch)
                case "Layer":
                    waiting += self._layer(rule, record, batch)
                case "Skip":
                    self._skip(rule, record, batch)
                case "SkipMask":
                    self._skip_mask(rule, record, batch)
                case "Intrusion":
                    waiting += self._intrusion(rule, record, batch)
                case _ if record.operator.move is not None:
                    waiting += self._move(rule, record, batch)
                case _:
                    self._material(rule, record, batch)

    def _next(self, waiting: list[tuple[int, Batch]]) -> tuple[int, Batch]:
        """A rule and the points at it. Recursion would part them ever more, so those that meet again are joined."""
        if not self.question.recurs:
            return waiting.pop()
        rule, batch = waiting.pop(0)
        same = [k for k, (other, met) in enumerate(waiting) if other == rule and met.way == batch.way]
        batches = [waiting.pop(k)[1] for k in reversed(same)]
        return rule, joined([batch, *batches]) if batches else batch

    def _count(self, batch: Batch) -> Batch:
        """The points that may take one more step: a point that has taken too many, or has no scope left, ends."""
        alive = (batch.right > batch.left) & (batch.top > batch.bottom)
        if self.question.recurs:
            self.taken[batch.index] += 1
            alive = alive & (self.taken[batch.index] <= MAX_STEPS)
        if alive.all():
            return batch
        return batch.take(np.flatnonzero(np.broadcast_to(alive, len(batch))))

    def _near(self, batch: Batch, at: Floats, extent: Floats) -> None:
        """Note how near points are to the ends of their part: `at` metres from the lower one, of `extent` metres."""
        if self.margin is not None:
            x, y, z = batch.ray
            pixel = np.maximum(batch.footprint, np.float32(1e-9)) * np.sqrt(x * x + y * y + z * z)
            here = np.minimum(at, extent - at) * np.abs(z) / pixel
            self.margin[batch.index] = np.minimum(self.margin[batch.index], here)

    # Arrangement ------------------------------------------------------------------------------------------

    def _split(self, rule: int, record: Record, batch: Batch, axis: int) -> list[tuple[int, Batch]]:
        """Split (Eq. 1): relative parts share what absolute ones leave; parts that no longer fit become empty.

        The last part ends with the scope: it has what is left over, and what the rounding of sums leaves.
        """
        place, low, high = batch.span(axis)
        at = np.clip(place - low, 0, (high - low) * BELOW_ONE)
        onward = []
        for part in split(record, at, low, high, batch.slack[axis], self.bits):
            some = batch if isinstance(part.chosen, slice) else batch.take(part.chosen)
            if record.count > 1:
                self._near(some, at[part.chosen] - part.start, part.end - part.start)
            lowest = pick(low, part.chosen)
            ours = some.within(axis, lowest + part.start, lowest + part.end, part.slack)
            onward.append((record.targets[part.number], ours))
            if self.steps is not None:
                bounds = tuple(float(v[0]) for v in ours.span(axis)[1:])
                read = (*record.head_places, *record.pixels(0, part.number))
                here = self._here(rule, batch, read)
                self.steps.append(
                    Divided(**here, part=part.number, count=record.count, low=bounds[0], high=bounds[1])
                )
        return onward

    def _repeat(self, rule: int, record: Record, batch: Batch, axis: int) -> list[tuple[int, Batch]]:
        """Repeat: equal parts of about the size v."""
        place, low, high = batch.span(axis)
        size = high - low
        slack = batch.slack[axis]
        count = repeated(low, high, slack, record.head["v"], self.bits)
        width = size / count
        at = np.clip(place - low, 0, size * BELOW_ONE)
        part = np.minimum(np.floor(at / width), count - 1)
        if (
            self.margin is not None
            and (several := np.flatnonzero(np.broadcast_to(count > 1, len(batch)))).size
        ):
            some = (at - part * width)[several]
            self._near(batch.take(several), some, np.broadcast_to(width, len(batch))[several])
        onward = batch.within(axis, low + part * width, low + (part + 1) * width, slack / count)
        if self.steps is not None:
            bounds = tuple(float(v[0]) for v in onward.span(axis)[1:])
            here = self._here(rule, batch, record.head_places)
            self.steps.append(
                Divided(**here, part=int(part[0]), count=int(count[0]), low=bounds[0], high=bounds[1])
            )
        return [(record.targets[0], onward)]

    def _move(self, rule: int, record: Record, batch: Batch) -> list[tuple[int, Batch]]:
        """An operator that is being tried: points and scopes as it leaves them."""
        assert record.operator.move is not None
        if self.steps is not None:
            self.steps.append(Step(**self._here(rule, batch, record.head_places)))
        return [(record.targets[0], record.operator.move(batch, record.head.get("v", 0.0)))]

    # Chance -----------------------------------------------------------------------------------------------

    def _corner(self, batch: Batch) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """The lower left corner of the scope plus the seed, in steps."""
        seed = self.question.seed
        return (
            steps_of(batch.left, batch.shift, seed.whole[0], seed.rest[0]),
            steps_of(batch.bottom, batch.shift, seed.whole[1], seed.rest[1]),
        )

    def _random(self, rule: int, record: Record, batch: Batch) -> list[tuple[int, Batch]]:
        """Rand and RandUni: one part by a random number; a stack that is too short gives its oldest corner."""
        level = min(int(record.head["l"]), len(batch.seeds))
        x, y = batch.seeds[-level] if level else self._corner(batch)
        number = look_up(*np.broadcast_arrays(x, y))
        if record.operator.name == "Rand":
            part = np.zeros(len(number), np.intp)
            for total in record.parts["Σv"][:-1]:
                part += number >= total
        else:
            part = np.floor(number * np.float32(record.count)).astype(np.intp)
        onward = [
            (target, some) for k, target in enumerate(record.targets) for _, some in _those(part, k, batch)
        ]
        if self.steps is not None:
            k = int(part[0])
            read = record.pixels(0 if record.operator.name == "Rand" else k, k)
            here = self._here(rule, batch, (*record.head_places, *read))
            self.steps.append(Chosen(**here, part=k, random=float(number[0]), corner=(int(x[0]), int(y[0]))))
        return onward

    def _stack(self, rule: int, record: Record, batch: Batch) -> list[tuple[int, Batch]]:
        """RandStack: the corner goes on the seed stack."""
        corner = self._corner(batch)
        if self.steps is not None:
            here = self._here(rule, batch, record.head_places)
            self.steps.append(Stacked(**here, corner=(int(corner[0][0]), int(corner[1][0]))))
        return [(record.targets[0], replace(batch, seeds=(*batch.seeds, corner)))]

    # Layers -----------------------------------------------------------------------------------------------

    def _layer(self, rule: int, record: Record, batch: Batch) -> list[tuple[int, Batch]]:
        """Layer: from the last rule down, where colour is not opaque yet and the layer is not passed over.

        The lowest layer is given on like the part of any other operator: what it skips beyond itself goes on in the
        layers around.
        """
        before: tuple[tuple[int, int], ...] = ()
        for layer in range(record.count, 0, -1):
            passing = self.passing[batch.index]
            through = (self.surface.color[batch.index, 3] < OPAQUE) & (passing == 0)
            self.passing[batch.index] = np.maximum(passing - 1, 0)
            if not through.any():
                continue
            ours = batch if through.all() else batch.take(through)
            ours = replace(ours, shift=batch.shift + layer, layers=(*batch.layers, (rule, layer)))
            if self.steps is not None:
                pixels = record.pixels(layer - 1, layer - 1)
                new = tuple(place for place in pixels if place not in before)  # two layers share a pixel
                read = new if before else (*record.head_places, *new)
                self.steps.append(Layered(**self._here(rule, batch, read), layer=layer))
                before = pixels
            if layer == 1:
                return [(record.targets[0], ours)]
            self.run(record.targets[layer - 1], ours)
        return []

    def _skip(self, rule: int, record: Record, batch: Batch) -> None:
        """Skip: nothing here, and so many layers below are passed over."""
        levels = int(record.head["l"])
        self.passing[batch.index] = levels
        if self.steps is not None:
            self.steps.append(Passed(**self._here(rule, batch, record.head_places), levels=levels, mask=None))

    def _skip_mask(self, rule: int, record: Record, batch: Batch) -> None:
        """SkipMask: Skip by the tile's mask, which is stretched over the scope."""
        tile = int(record.head["m"])
        value = self.question.atlas.mask(tile, self._fit(tile, batch, (0.0, 0.0, 1.0, 1.0)))
        if self.margin is not None:
            self.margin[batch.index[(value > np.float32(0.02)) & (value < np.float32(0.98))]] = 0
        levels = np.where(value >= np.float32(0.5), int(record.head["l1"]), int(record.head["l0"]))
        self.passing[batch.index] = levels
        if self.steps is not None:
            here = self._here(rule, batch, record.head_places)
            self.steps.append(Passed(**here, levels=int(levels[0]), mask=float(value[0])))

    # Rooms ------------------------------------------------------------------------------------------------

    def _intrusion(self, rule: int, record: Record, batch: Batch) -> list[tuple[int, Batch]]:
        """Intrusion: the face of the box behind the scope that the ray hits, as a scope seen from inside.

        Its lower left corner is that of the scope that it lies behind.
        """
        depth = np.float32(record.head["v"])
        (dx, dy, dz), (left, bottom, right, top) = (
            batch.ray,
            (batch.left, batch.bottom, batch.right, batch.top),
        )
        width, height, into = right - left, top - bottom, np.abs(dz)
        x, y = np.clip(batch.x - left, 0, width), np.clip(batch.y - bottom, 0, height)
        far_x = np.where(dx < 0, x, width - x) / np.maximum(np.abs(dx), _TINY)
        far_y = np.where(dy < 0, y, height - y) / np.maximum(np.abs(dy), _TINY)
        far_z = depth / np.maximum(into, _TINY)
        far = np.minimum(np.minimum(far_x, far_y), far_z)
        face = np.where(
            far_z <= far, 1, np.where(far_x <= far, np.where(dx < 0, 0, 2), np.where(dy < 0, 3, 4))
        )
        far = np.minimum(far, _HUGE)
        x, y = np.clip(x + dx * far, 0, width), np.clip(y + dy * far, 0, height)
        z = np.clip(into * far, 0, depth)
        onward = []
        own = half_step(np.full(1, depth, np.float32), self.bits)
        for k, target in enumerate(record.targets):
            for chosen, some in _those(face, k, batch):
                hx, hy, hz, ax, ay, az, w, h = (
                    pick(v, chosen) for v in (x, y, z, dx, dy, into, width, height)
                )
                u, v = ((hz, hy), (hx, hy), (depth - hz, hy), (hx, hz), (hx, depth - hz))[k]
                wide, tall = ((depth, h), (w, h), (depth, h), (w, depth), (w, depth))[k]
                ray = ((az, ay, ax), (ax, ay, -az), (-az, ay, -ax), (ax, az, ay), (ax, -az, -ay))[k]
                ours = replace(
                    some,
                    x=np.broadcast_to(some.left + u, len(some)),
                    y=np.broadcast_to(some.bottom + v, len(some)),
                    right=some.left + wide,
                    top=some.bottom + tall,
                    ray=ray,
                    footprint=some.footprint + self.spread * pick(far, chosen),
                    slack=(own if k in (0, 2) else some.slack[0], own if k in (3, 4) else some.slack[1]),
                    shift=batch.shift + k + 1,
                    faces=(*batch.faces, k + 1),
                )
                self._near(ours, u, np.broadcast_to(wide, len(u)))
                self._near(ours, v, np.broadcast_to(tall, len(v)))
                onward.append((target, ours))
                if self.steps is not None:
                    pixels = sorted({0, (0, 1, 1, 2, 2)[k]})  # each face's rule stands in one of three
                    here = self._here(rule, batch, [record.head_places[pixel] for pixel in pixels])
                    self.steps.append(Entered(**here, face=FACES[k], depth=float(hz[0])))
        return onward

    # Materials --------------------------------------------------------------------------------------------

    def _material(self, rule: int, record: Record, batch: Batch) -> None:
        """Mat and MatAlpha: add a value where what lies above has left room (Eq. 2, 3)."""
        head = record.head
        usage = int(head["u"])
        if self.color_only and usage != 1:
            self.passing[batch.index] = 0
            return
        value, struck = self._value(head, "m", batch, self.question.relief)
        alpha = value[:, 3]
        if "a1" in head:
            factor, _ = self._value(head, "a", batch)
            tile = abs(int(head["a1"]))
            alpha = alpha * (self.question.atlas.mask(tile, factor) if tile else factor[:, 3])
        alpha = _beside(alpha, struck)
        if usage == 2:
            value = _turned(value, batch.faces)
        total = self.sums[usage - 1]
        held = total[batch.index]
        weight = (1 - held[:, 3]) * alpha
        if usage == 1 and struck is not None and self.shade is not None:
            self.shade[batch.index] += weight * struck.shade
        held[:, :3] += weight[:, None] * value[:, :3]
        held[:, 3] += weight
        total[batch.index] = held
        if usage == 1:
            first = (self.surface.rule[batch.index] < 0) & (alpha > 0)
            self.surface.rule[batch.index[first]] = rule
        self.passing[batch.index] = 0
        if self.steps is not None:
            added, so_far = (*value[0, :3], alpha[0]), total[batch.index[0]]
            here = self._here(rule, batch, record.head_places)
            self.steps.append(Painted(**here, usage=_USAGES[usage], value=_four(added), total=_four(so_far)))

    def _value(
        self, head: Any, letter: str, batch: Batch, relief: bool = False
    ) -> tuple[Floats, Struck | None]:
        """Red, green, blue and alpha (n, 4) of a source and its four numbers; and what rays met, if it has relief."""
        source = int(head[f"{letter}1"])
        numbers = tuple(np.float32(head[f"{letter}{k}"]) for k in range(2, 6))
        if not source:
            return np.broadcast_to(np.array(numbers, np.float32), (len(batch), 4)), None
        struck = self._strike(source, batch, numbers) if relief else None
        if struck is not None:
            batch = replace(batch, x=struck.x, y=struck.y)
        return self._tile(source, batch, numbers), struck

    def _tile(self, source: int, batch: Batch, numbers: Sequence[Any]) -> Floats:
        """A tile, stretched or repeated."""
        if source > 0:
            return self._fit(source, batch, numbers)
        u, v = numbers[0] + batch.x * numbers[2], numbers[1] + batch.y * numbers[3]
        return self.question.atlas.sample(
            -source, u, v, True, self._level(-source, batch, *np.abs(numbers[2:]))
        )

    def _fit(self, tile: int, batch: Batch, part: Sequence[Any]) -> Floats:
        """The part (left, bottom, right, top) of a tile, stretched over the scope."""
        left, bottom, right, top = (np.float32(value) for value in part)
        width, height = batch.right - batch.left, batch.top - batch.bottom
        u = np.clip((batch.x - batch.left) / width, 0, 1)
        v = np.clip((batch.y - batch.bottom) / height, 0, 1)
        across, up = np.abs(right - left) / width, np.abs(top - bottom) / height
        return self.question.atlas.sample(
            tile,
            left + u * (right - left),
            bottom + v * (top - bottom),
            False,
            self._level(tile, batch, across, up),
        )

    def _strike(self, source: int, batch: Batch, numbers: Sequence[Any]) -> Struck | None:
        """What rays meet of a tile that has heights."""
        atlas = self.question.atlas
        heights = int(atlas.relief[min(abs(source), len(atlas.relief)) - 1, 0]) // 8
        if not heights:
            return None
        scale: tuple[Any, Any]
        whole = (True, True)
        if source < 0:
            scale = numbers[2], numbers[3]
            start = numbers[0] + batch.x * scale[0], numbers[1] + batch.y * scale[1]
        else:
            left, bottom, right, top = numbers
            width, height = batch.right - batch.left, batch.top - batch.bottom
            scale = (right - left) / width, (top - bottom) / height
            whole = (abs(right - left) == 1, abs(top - bottom) == 1)
            start = (
                left + np.clip((batch.x - batch.left) / width, 0, 1) * (right - left),
                bottom + np.clip((batch.y - batch.bottom) / height, 0, 1) * (top - bottom),
            )
        level = self._level(heights, batch, np.abs(scale[0]), np.abs(scale[1]))
        below = any(layer > 1 for _, layer in batch.layers)
        struck = strike(atlas, source, batch, start, scale, whole, below, level, self.question.sun)
        if struck is not None and self.margin is not None:
            self.margin[batch.index[struck.near]] = 0
        return struck

    def _level(self, tile: int, batch: Batch, across: Any, up: Any) -> int | NDArray[np.int32]:
        """Which size of a tile fits a pixel, a tile that stands so often in a metre: 0 is the largest.

        Seen slantwise, or on a tile that is drawn out, a pixel is an ellipse. Texels are to be no larger than its small
        axis, but no smaller than a third of the large one; one sample cannot see all of an ellipse longer than that.
        """
        if not self.sized:
            return 0
        _, _, width, height = self.question.atlas.table[tile - 1, 0].astype(np.float32)
        x, y, z = batch.ray
        away = np.maximum(np.abs(z), _TINY)
        slope_x, slope_y = (np.clip(v / away, -_STEEP, _STEEP) for v in (x, y))
        u, v = (
            across * width * batch.footprint,
            up * height * batch.footprint,
        )  # texels, were it seen straight on
        a, b, c = u * u * (1 + slope_x * slope_x), u * v * slope_x * slope_y, v * v * (1 + slope_y * slope_y)
        mean, half = np.float32(0.5) * (a + c), np.float32(0.5) * (a - c)
        apart = np.sqrt(half * half + b * b)
        small, large = mean - apart, mean + apart  # squares of the axes
        if self.margin is not None:
            long = np.broadcast_to(large > _LONG * np.maximum(small, 1), len(batch))
            self.margin[batch.index[long]] = 0
        texels = np.maximum(np.maximum(small, large * _SHARE), 1)
        return (np.frexp(texels)[1] - 1) >> 1  # half the exponent: how often its root can be halved

    # Steps ------------------------------------------------------------------------------------------------

    def _here(self, rule: int, batch: Batch, read: Sequence[tuple[int, int]]) -> dict[str, Any]:
        """What every step says."""
        scope = tuple(float(v[0]) for v in (batch.left, batch.bottom, batch.right, batch.top))
        seeds = tuple((int(x[0]), int(y[0])) for x, y in batch.seeds)
        return {
            "rule": rule,
            "name": self.question.names[rule],
            "operator": self.question.records[rule].operator.name,
            "scope": scope,
            "point": (float(batch.x[0]), float(batch.y[0])),
            "seeds": seeds,
            "shift": batch.shift,
            "faces": tuple(FACES[face - 1] for face in batch.faces),
            "layers": batch.layers,
            "records": tuple(read),
        }


def _those(part: NDArray[Any], k: int, batch: Batch) -> list[tuple[Any, Batch]]:
    """The points of a batch whose part is k, as a mask or indices and as a batch: none or one of them."""
    if len(part) == 1:
        return [(slice(None), batch)] if part[0] == k else []
    chosen = np.flatnonzero(part == k)
    if not len(chosen):
        return []
    return [(slice(None), batch) if len(chosen) == len(batch) else (chosen, batch.take(chosen))]


def _beside(alpha: Floats, struck: Struck | None) -> Floats:
    """Alpha of a material: nothing where the ray has gone past its relief."""
    return alpha if struck is None else np.where(struck.beside, np.float32(0), alpha)


def _turned(value: Floats, faces: Sequence[int]) -> Floats:
    """Normals of a face of an intrusion, written as (n + 1) / 2, as the façade has them."""
    for face in reversed(faces):
        x, y, z = value[:, 0], value[:, 1], value[:, 2]
        turned = ((z, y, 1 - x), (x, y, z), (1 - z, y, x), (x, z, 1 - y), (x, 1 - z, y))[face - 1]
        value = np.stack([*turned, value[:, 3]], axis=1)
    return value


def _four(values: Any) -> tuple[float, float, float, float]:
    r, g, b, a = (float(value) for value in values)
    return r, g, b, a
