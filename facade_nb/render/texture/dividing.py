"""How Split and Repeat divide a scope (texture paper, Eq. 1; docs/texture.md, "What an evaluator does").

A texture of 16 bits holds not the decimals that were written but floats near them: 3.2 m is 3.19921875 m there. So
divisions are computed with what may have been written: a size as held, half a step of its float more or less. Whatever
fits exactly by its decimals then fits, and no sliver is left. How far a scope's extent may be from what was meant goes
along with it as its slack, since a Repeat may stand in a part of a Split. `divide.glsl` does the same, in that order.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .batch import Floats
from .encoding import Record
from .limits import GRAIN, half_step_of

__all__ = ["Parts", "half_step", "repeated", "split"]

_EXPONENT = np.int32(0x7F800000)
_MOST = 1 << 20
"""Ends of parts that are held at once, where each point has a scope of its own."""


class Parts(NamedTuple):
    """Where points are in a division.

    Attributes
    ----------
    part
        (n,) the number of the part that each point is in, from 0.
    start, end
        Where parts begin and end, metres from the scope's lower end.
    slack
        How far their extents may be from what was meant.
    shared
        Whether all points have the same scope: then the last three are (parts,), else (n,), each for its point's part.
    """

    part: NDArray[np.intp]
    start: Floats
    end: Floats
    slack: Floats
    shared: bool

    def of(self, k: int, chosen: Any) -> tuple[Floats, Floats, Floats]:
        """Start, end and slack of part k, for the chosen points, which are in it."""
        at = slice(k, k + 1) if self.shared else chosen
        return self.start[at], self.end[at], self.slack[at]


def half_step(values: Floats | np.float32, bits: int) -> Floats:
    """Half the distance to the next larger float that a texture of so many bits can hold (0 and more)."""
    relative, least = half_step_of(bits)
    power: Floats = (np.asarray(values, np.float32).view(np.int32) & _EXPONENT).view(np.float32)
    return np.maximum(power * relative, least)


def repeated(low: Floats, high: Floats, slack: Floats, v: float, bits: int) -> Floats:
    """Into how many parts of about the size v a scope is divided: as few as what was meant allows."""
    size = high - low - slack - _grain(low, high)
    held = np.full(1, v, np.float32)
    return np.maximum(np.ceil(size / (held + half_step(held, bits))), 1)


def split(record: Record, at: Floats, low: Floats, high: Floats, slack: Floats, bits: int) -> Parts:
    """Where points `at` metres from the lower end of their scope are in the parts of a Split."""
    shared = len(low) == len(high) == len(slack) == 1
    if shared:
        ends, slacks = _ends(record, low, high, slack, bits)
        part = np.searchsorted(ends[:-1, 0], at, side="right")
        starts = np.concatenate([np.zeros(1, np.float32), ends[:-1, 0]])
        return Parts(part, starts, ends[:, 0], slacks[:, 0], shared)
    count = len(at)
    low, high, slack = (np.broadcast_to(values, count) for values in (low, high, slack))
    part = np.empty(count, np.intp)
    start, end, loose = (np.empty(count, np.float32) for _ in range(3))
    stride = max(1, _MOST // record.count)
    for first in range(0, count, stride):
        some = slice(first, first + stride)
        ends, slacks = _ends(record, low[some], high[some], slack[some], bits)
        part[some] = (at[some] >= ends[:-1]).sum(axis=0)
        each = part[some][None]
        end[some] = np.take_along_axis(ends, each, 0)[0]
        loose[some] = np.take_along_axis(slacks, each, 0)[0]
        before = np.take_along_axis(ends, np.maximum(each - 1, 0), 0)[0]
        start[some] = np.where(each[0] > 0, before, 0)
    return Parts(part, start, end, loose, shared)


def _ends(record: Record, low: Floats, high: Floats, slack: Floats, bits: int) -> tuple[Floats, Floats]:
    """Where parts end and how loose their extents are, (parts, n)."""
    signed = record.parts["sv"][:, None]
    absolute, relative = np.float32(record.head["Σabs"]), np.float32(record.head["Σrel"])
    size, grain = high - low, _grain(low, high)
    fixed, held = signed < 0, np.abs(signed)
    steps = half_step(held, bits)
    sums, about = (np.add.accumulate(np.where(fixed, v, np.float32(0)), axis=0) for v in (held, steps))
    fits = (absolute > 0) & (np.abs(size - sums[-1]) <= slack + grain + about[-1])
    over = ~fits & (absolute > size)
    whole = relative if relative > 0 else np.float32(1)
    unit = np.where(fits, np.float32(0), np.maximum(size - absolute, np.float32(0)) / whole)
    stretch = np.where(fits, size / (sums[-1] if absolute > 0 else np.float32(1)), np.float32(1))
    width = np.where(fixed, held * stretch, unit * held)
    # What is left for relative parts is as loose as the scope and all absolute parts; so are their shares of it.
    bound = half_step_of(bits)[0]
    taken = absolute * bound + half_step(absolute, bits) if absolute > 0 else np.float32(0)
    alone = (slack + taken) / whole
    among = alone + unit * (bound + half_step(relative, bits) / whole)
    several = held != relative
    own = np.where(
        fixed,
        steps + np.abs(held * stretch - held),
        held * np.where(several, among, alone) + np.where(several, unit * steps, np.float32(0)),
    )
    reach = np.add.accumulate(np.concatenate([np.broadcast_to(slack, (1, len(size))), own]), axis=0)
    ends = np.minimum(np.add.accumulate(width, axis=0), size)
    full = (fits & (sums >= sums[-1])) | (over & (size - ends <= reach[1:] + grain))
    ends = np.where(full, size, ends)
    ends[-1] = size
    starts = np.concatenate([np.zeros((1, len(size)), np.float32), ends[:-1]])
    rest = np.minimum(own + np.abs(ends - starts - width), reach[:-1])
    return ends, np.where(ends == size, rest, own)


def _grain(low: Floats, high: Floats) -> Floats:
    """What 32-bit floats may have lost on the way to a scope."""
    grain: Floats = np.maximum(np.abs(low), np.abs(high)) * GRAIN
    return grain
