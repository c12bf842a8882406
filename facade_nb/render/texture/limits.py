"""What the shader can hold. Both evaluators have these bounds, and the checks refuse a grammar that goes beyond."""

from __future__ import annotations

__all__ = ["MAX_EXACT", "MAX_FACES", "MAX_FRAMES", "MAX_HALF", "MAX_SEEDS", "MAX_STEPS"]

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
