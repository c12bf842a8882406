"""How Split and Repeat divide a scope (texture paper, Eq. 1; docs/texture.md, "What an evaluator does").

A texture of 16 bits holds not the decimals that were written but floats near them: 3.2 m is 3.19921875 m there. So
divisions are computed with what may have been written: a size as held, half a step of its float more or less. Whatever
fits exactly by its decimals then fits, and no sliver is left. How far a scope's extent may be from what was meant goes
along with it as its slack, since a Repeat may stand in a part of a Split. `divide.glsl` does the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .batch import Floats
from .encoding import Record
from .limits import GRAIN, half_step_of

__all__ = ["Part", "half_step", "pick", "repeated", "split"]

_EXPONENT = np.int32(0x7F800000)
_ZERO = np.zeros(1, np.float32)
_ALL = slice(None)


class Part(NamedTuple):
    """A part of a division, and the points that are in it.

    Attributes
    ----------
    number
        From 0.
    chosen
        Which of the points asked for they are: their numbers, or a slice of all.
    start, end
        Where the part begins and ends, metres from the scope's lower end. One value, or one for each of these points.
    slack
        How far its extent may be from what was meant.
    """

    number: int
    chosen: Any
    start: Floats
    end: Floats
    slack: Floats


def half_step(values: Floats | np.float32, bits: int) -> Floats:
    """Half the distance to the next larger float that a texture of so many bits can hold (0 and more)."""
    relative, least = half_step_of(bits)
    power: Floats = (np.asarray(values, np.float32).view(np.int32) & _EXPONENT).view(np.float32)
    return np.maximum(power * relative, least)


def repeated(low: Floats, high: Floats, slack: Floats, v: float, bits: int) -> Floats:
    """Into how many parts of about the size v a scope is divided: as few as what was meant allows."""
    size = high - low - slack - high * GRAIN
    held = np.float32(v)
    return np.maximum(np.ceil(size / (held + half_step(held, bits))), 1)


def split(record: Record, at: Floats, low: Floats, high: Floats, slack: Floats, bits: int) -> Iterator[Part]:
    """The parts of a Split that points are in, `at` metres from the lower end of their scope."""
    scope = _Scope(_sizes(record, bits), low, high, slack)
    left, below, end = len(at), np.zeros(len(at), bool), _ZERO
    for k in range(record.count):
        start, end = end, scope.end(k, end)
        here = at < end if k < record.count - 1 else np.ones(len(at), bool)
        chosen: Any = np.flatnonzero(here > below)
        below = here
        if not len(chosen):
            continue
        left -= len(chosen)
        if len(chosen) == len(at):
            chosen = slice(None)
        yield Part(k, chosen, pick(start, chosen), pick(end, chosen), scope.slack(k, chosen, start, end))
        if not left:
            return


class _Sizes(NamedTuple):
    """What a Split's record says of its parts: nothing that depends on the scope.

    Attributes
    ----------
    fixed, held, step
        Of each part: whether it is absolute, its size, and half a step of that.
    laid, about
        Sizes of the absolute parts before each part, and half steps of them, added up; last the sums of all.
    shared, apart
        The same of the relative parts.
    absolute, relative
        Sums as the texture holds them.
    taken
        How far the sum of absolute parts may be from what was meant.
    bound
        How far the sum of relative parts may be, as a share of it.
    several
        Whether more than one part shares what absolute ones leave.
    """

    fixed: tuple[bool, ...]
    held: Floats
    step: Floats
    laid: Floats
    about: Floats
    shared: Floats
    apart: Floats
    absolute: np.float32
    relative: np.float32
    taken: np.float32
    bound: np.float32
    several: bool


@lru_cache(maxsize=1024)
def _sizes(record: Record, bits: int) -> _Sizes:
    signed = record.parts["sv"]
    absolute, relative = np.float32(record.head["Σabs"]), np.float32(record.head["Σrel"])
    fixed, held = signed < 0, np.abs(signed)
    step = half_step(held, bits)
    zero = np.float32(0)
    laid, about, shared, apart = (
        np.concatenate([_ZERO, np.add.accumulate(np.where(some, values, zero))])
        for some in (fixed, ~fixed)
        for values in (held, step)
    )
    each, _ = half_step_of(bits)
    return _Sizes(
        tuple(fixed.tolist()),
        held,
        step,
        laid,
        about,
        shared,
        apart,
        absolute,
        relative,
        taken=np.float32(absolute * each + half_step(absolute, bits) if absolute > 0 else zero),
        bound=np.float32(each + half_step(relative, bits) / relative if relative > 0 else zero),
        several=not bool((~fixed & (held == relative)).any()),
    )


class _Scope:
    """Scopes that a Split divides: what its parts take of each of them. One value, or one for each point."""

    def __init__(self, sizes: _Sizes, low: Floats, high: Floats, slack: Floats) -> None:
        self.sizes, self.size, self.loose = sizes, high - low, slack
        self.high = high
        self.fits, self.over = self._full(high)
        whole = sizes.relative if sizes.relative > 0 else np.float32(1)
        self.unit = self.size if sizes.absolute == 0 else np.maximum(self.size - sizes.absolute, _ZERO)
        if whole != 1:
            self.unit = self.unit / whole
        self.stretch = None
        if self.fits is not None:
            self.unit = np.where(self.fits, _ZERO, self.unit)
            self.stretch = np.where(self.fits, self.size / sizes.laid[-1], np.float32(1))
        # What is left for relative parts is as loose as the scope and all absolute parts; so are their shares of it.
        self.share = (slack + sizes.taken) / whole
        if sizes.several:
            self.share = self.share + self.unit * sizes.bound

    def _full(self, high: Floats) -> tuple[NDArray[np.bool_] | None, NDArray[np.bool_] | None]:
        """Which scopes absolute parts fill, and for which they are too much; None where it is so for none."""
        sizes, size = self.sizes, self.size
        if sizes.absolute == 0:
            return None, None
        fits, over = None, None
        total, least = sizes.laid[-1], _least(size)
        away = np.float32(1.01) * (_most(self.loose) + _most(high) * GRAIN + sizes.about[-1])
        if least - away <= total <= _most(size) + away:
            fits = np.abs(size - total) <= self.loose + high * GRAIN + sizes.about[-1]
            fits = fits if fits.any() else None
        if sizes.absolute > least:
            over = sizes.absolute > size if fits is None else ~fits & (sizes.absolute > size)
            over = over if over.any() else None
        return fits, over

    def end(self, k: int, start: Floats) -> Floats:
        """Where part k ends, which begins at `start`: the last one with the scope."""
        sizes, size = self.sizes, self.size
        if k == len(sizes.fixed) - 1:
            return size
        end = np.minimum(start + self._width(k), size)
        if self.fits is not None and sizes.laid[k + 1] >= sizes.laid[-1]:
            end = np.where(self.fits, size, end)
        if self.over is not None:
            end = np.where(self.over & (size - end <= self._reach(k + 1) + self.high * GRAIN), size, end)
        return end

    def slack(self, k: int, chosen: Any, start: Floats, end: Floats) -> Floats:
        """How far the extent of part k may be from what was meant: of the chosen points, which are in it."""
        size, start, end = (pick(values, chosen) for values in (self.size, start, end))
        own = self._own(k, chosen)
        last = k == len(self.sizes.fixed) - 1
        if not last and not (ends := end == size).any():
            return own
        rest = np.minimum(own + np.abs(end - start - self._width(k, chosen)), self._reach(k, chosen))
        return rest if last else np.where(ends, rest, own)

    def _width(self, k: int, chosen: Any = _ALL) -> Floats:
        held = self.sizes.held[k : k + 1]
        if not self.sizes.fixed[k]:
            return held * pick(self.unit, chosen)
        return held if self.stretch is None else held * pick(self.stretch, chosen)

    def _own(self, k: int, chosen: Any) -> Floats:
        """How far the size of part k, by itself, may be from what was meant."""
        sizes, held, step = self.sizes, self.sizes.held[k : k + 1], self.sizes.step[k : k + 1]
        if sizes.fixed[k]:
            return step if self.stretch is None else step + np.abs(self._width(k, chosen) - held)
        own = held * pick(self.share, chosen)
        return own + step * pick(self.unit, chosen) if sizes.several else own

    def _reach(self, k: int, chosen: Any = _ALL) -> Floats:
        """How far the place where part k begins may be from what was meant: by the scope's slack and all before."""
        sizes = self.sizes
        reach = pick(self.loose, chosen)
        if sizes.about[k]:
            reach = reach + sizes.about[k]
            if self.stretch is not None:
                reach = reach + sizes.laid[k] * np.abs(pick(self.stretch, chosen) - 1)
        if sizes.shared[k]:
            reach = reach + sizes.shared[k] * pick(self.share, chosen)
            if sizes.several:
                reach = reach + sizes.apart[k] * pick(self.unit, chosen)
        return reach


def pick(values: Floats, chosen: Any) -> Floats:
    """The values of some points; what is the same for all points stays one."""
    return values[chosen] if len(values) > 1 else values


def _least(values: Floats) -> np.float32:
    return values[0] if len(values) == 1 else values.min()


def _most(values: Floats) -> np.float32:
    return values[0] if len(values) == 1 else values.max()
