"""What the shader can hold. Both evaluators have these bounds, and the checks refuse a grammar that goes beyond."""

from __future__ import annotations

import numpy as np

__all__ = [
    "GRAIN",
    "MAX_EXACT",
    "MAX_FACES",
    "MAX_FRAMES",
    "MAX_HALF",
    "MAX_LEVEL",
    "MAX_PARTS",
    "MAX_RULES",
    "MAX_SEEDS",
    "MAX_STEPS",
    "half_step_of",
]

MAX_FRAMES = 12
"""Layer operators inside each other, of which layers are still to come."""

MAX_SEEDS = 12
"""Corners on the seed stack."""

MAX_FACES = 6
"""Intrusions inside each other."""

MAX_STEPS = 1024
"""Operators on the way of one pixel. One that goes further keeps what it has gathered."""

MAX_EXACT = 2048
"""The largest whole number up to which a 16-bit float holds every one."""

MAX_HALF = 65504.0
"""The largest number that a 16-bit float holds."""

MAX_PARTS = 8000
"""Parts of one rule: a texture's row holds them in any browser."""

MAX_RULES = 20_000
"""Rules of one grammar, copies with other arguments among them."""

MAX_LEVEL = 2**24
"""Layers and corners are counted below this, up to which 32-bit floats hold every whole number."""

GRAIN = np.float32(2**-21)
"""What 32-bit floats may have lost on the way to a scope, as a share of its coordinates."""


def half_step_of(bits: int) -> tuple[np.float32, np.float32]:
    """Half a step of the floats of a texture: as a share of the power of two below, and the least there is, metres."""
    return (np.float32(2**-11), np.float32(2**-25)) if bits == 16 else (np.float32(2**-24), np.float32(0))
