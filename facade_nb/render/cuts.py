"""What a shape opens in the wall behind it."""

from __future__ import annotations

from dataclasses import dataclass

from .parts import Point

__all__ = ["Cut"]

_THROUGH = -1e4
"""From there on a cut goes through whatever there is, metres."""


@dataclass(frozen=True, slots=True)
class Cut:
    """An opening: its outline counter-clockwise, in the frame of the shape that is cut, and how far back it goes."""

    outline: tuple[Point, ...]
    back: float = _THROUGH

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Left, bottom, right, top."""
        xs, ys = [x for x, _ in self.outline], [y for _, y in self.outline]
        return min(xs), min(ys), max(xs), max(ys)
