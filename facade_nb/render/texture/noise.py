"""Random numbers: a noise texture, looked up at a corner plus the seed, in steps of 1/64 m (the texture paper's 3).

Corner and seed are kept apart. The seed is split, in 64 bits, into whole steps and a rest below one; the corner and the
rest, both small, are rounded to whole steps together, and the seed's whole steps are added as integers. So a large
seed costs no precision. Rounding is to the nearest step: corners at whole centimetres or quarters of a metre do not lie
on an edge, where two machines might disagree.

The texture has 256 × 256 texels, which alone would repeat every 4 m. So the place is mixed into 16 bits first (a hash
of 32-bit integers, wrapping), and these choose the texel: the same corner has the same number everywhere, other ones
have no pattern. The texture holds each of 0, 1/65536, … once, so its numbers are uniform.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import floor

import numpy as np
from numpy.typing import NDArray

__all__ = ["QUANTUM", "SIDE", "Seed", "look_up", "noise_texture", "steps_of"]

QUANTUM = 64.0
"""Steps in a metre."""

SIDE = 256
"""Width and height of the noise texture."""


@dataclass(frozen=True, slots=True)
class Seed:
    """A façade's seed in steps: whole ones as they wrap in 32 bits, and the rest from 0 to below 1, for x and y."""

    whole: tuple[int, int]
    rest: tuple[float, float]

    @classmethod
    def of(cls, seed: tuple[float, float]) -> Seed:
        """Split a seed in metres."""
        steps = [float(value) * QUANTUM for value in seed]
        whole = [floor(step) for step in steps]
        x, y = (_wrapped(value) for value in whole)
        return cls((x, y), (steps[0] - whole[0], steps[1] - whole[1]))


def _wrapped(value: int) -> int:
    return (value + 2**31) % 2**32 - 2**31


@lru_cache(maxsize=1)
def noise_texture() -> NDArray[np.float32]:
    """(SIDE, SIDE) float32 from 0 to below 1, each of the 65536 values once; row 0 at the bottom. Read-only."""
    order = np.argsort(_mixed(np.arange(1, SIDE * SIDE + 1, dtype=np.uint32)), kind="stable")
    texture = (order.astype(np.float32) / np.float32(SIDE * SIDE)).reshape(SIDE, SIDE)
    texture.setflags(write=False)
    return texture


def steps_of(corner: NDArray[np.float32], shift: int, whole: int, rest: float) -> NDArray[np.int32]:
    """Corners along one axis (metres) in steps, shifted by `shift` times the seed of `whole` and `rest` steps."""
    near = np.floor(corner * np.float32(QUANTUM) + np.float32(shift) * np.float32(rest) + np.float32(0.5))
    return near.astype(np.int32) + np.int32(_wrapped(shift * whole))


def look_up(x: NDArray[np.int32], y: NDArray[np.int32]) -> NDArray[np.float32]:
    """The random numbers, from 0 to below 1, of corners in steps."""
    place = _mixed(_mixed(x.view(np.uint32)) ^ y.view(np.uint32))
    return noise_texture()[(place >> np.uint32(24)), (place >> np.uint32(16)) & np.uint32(255)]


def _mixed(value: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """A bijection of 32-bit integers in which every bit depends on all others."""
    value = value ^ (value >> np.uint32(16))
    value = value * np.uint32(0x7FEB352D)
    value = value ^ (value >> np.uint32(15))
    value = value * np.uint32(0x846CA68B)
    return value ^ (value >> np.uint32(16))
