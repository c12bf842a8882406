"""Openings in bodies: what shapes cut out of the walls that they stand in."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from .bodies import bodies_of, extruded
from .cuts import Cut
from .parts import Part, front

__all__ = ["carved"]

_AHEAD = 10.0
"""How far in front of a body its cuts begin, metres."""


def carved(parts: Sequence[Part], cuts: Sequence[Cut]) -> Iterator[tuple[Part, Any]]:
    """The bodies of parts with openings cut out; see `bodies_of`. They stay closed."""
    for part, body in bodies_of(parts):
        x0, y0, z0, x1, y1, z1 = body.bounding_box()
        for cut in cuts:
            left, bottom, right, top = cut.box
            if left < x1 and right > x0 and bottom < y1 and top > y0 and cut.back < z1:
                body -= extruded((cut.outline,), max(cut.back, z0 - 1.0), front(part) + _AHEAD)
        yield part, body
