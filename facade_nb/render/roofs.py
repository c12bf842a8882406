"""Recipes of roofs. A roof is as deep as its shape is thick; `scene` can make it as deep as a building."""

from __future__ import annotations

from math import cos, hypot, pi, sin

from .lofts import beam, upright
from .parts import Block, Part, Point, Prism

__all__ = ["gable", "hip", "hipped", "mansard", "pitched"]


def gable(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A gabled roof seen from its gable: two slabs over a boarded triangle, with a round window where it is high."""
    half, verge = w / 2, 0.25
    slab = min(0.16, 0.16 * h)
    tall = min(slab * hypot(half, h) / half, 0.3 * h)  # thickness of the slab measured upright
    slope = (h - tall) / half
    eave = min(0.25, 0.06 * w, 0.25 / slope)
    under = slope * half
    left = ((-eave, -slope * eave), (half, under), (half, h), (-eave, tall - slope * eave))
    right = ((half, under), (w + eave, -slope * eave), (w + eave, tall - slope * eave), (half, h))
    parts: list[Part] = [
        Prism(((0, 0), (w, 0), (half, under)), -d, 0.0, "gable"),
    ]
    radius = min(0.3, 0.2 * under, 0.12 * w)
    if radius > 0.1:
        cy = 0.42 * under
        for r, z, slot in ((radius, 0.03, "frame"), (0.78 * radius, 0.032, "glass")):
            circle = tuple(
                (half + r * cos(2 * pi * i / 24), cy + r * sin(2 * pi * i / 24)) for i in range(24)
            )
            parts.append(Prism(circle, 0.0, z, slot))
        bar = 0.09 * radius
        parts.append(
            Block(half - bar, cy - 0.78 * radius, half + bar, cy + 0.78 * radius, 0.0, 0.036, "frame")
        )
        parts.append(
            Block(half - 0.78 * radius, cy - bar, half + 0.78 * radius, cy + bar, 0.0, 0.036, "frame")
        )
    board = 0.55 * tall  # a painted verge board under the tiles
    for quad in (left, right):
        low = tuple((x, y) if i < 2 else (x, y - tall + board) for i, (x, y) in enumerate(quad))
        high = tuple((x, y + board) if i < 2 else (x, y) for i, (x, y) in enumerate(quad))
        parts.append(Prism(low, -d, verge - 0.04, "frame"))
        parts.append(Prism(high, -d, verge))
    return tuple(parts)


def mansard(w: float, h: float, d: float, *, knee: float = 0.68, ends: str = "upright") -> tuple[Part, ...]:
    """A mansard roof: a steep slope up to the knee, a flat one above it; its ends upright or hipped."""
    run, front = max(d, 1.6 * h), 0.25
    break_y = knee * h
    steep, gentle = 0.3 * break_y, min(1.9 * (h - break_y), 0.3 * run)
    draw = min(steep, 0.12 * w) if ends == "hipped" else 0.0
    far = draw + (min(gentle, 0.25 * w) if ends == "hipped" else 0.0)

    def plan(x: float, back: float) -> tuple[Point, ...]:
        return (
            (x, front - back),
            (w - x, front - back),
            (w - x, -run - front + back),
            (x, -run - front + back),
        )

    lip = min(0.07, 0.05 * h)
    z = front - steep
    return (
        upright(plan(0.0, 0.0), 0.0, break_y, "body", top=plan(draw, steep)),
        upright(plan(draw, steep), break_y, h, "upper", top=plan(far, steep + gentle)),
        Block(draw, break_y - lip, w - draw, break_y + lip / 2, z - 0.05, z + 0.07, "gutter"),
        Block(0, -0.1, w, 0.0, -0.1, front + 0.06, "gutter"),
    )


def hipped(
    w: float, h: float, d: float, *, ridge: float | None = None, eaves: float = 0.3
) -> tuple[Part, ...]:
    """A hipped roof under hip and ridge tiles; `ridge` is the share of the width that the ridge has."""
    run = max(d, 1.6 * h)
    share = max(0.0, 1 - 2 * h / w) if ridge is None else ridge
    draw = min((1 - share) / 2, 0.495) * w
    near = -min(run / 2, 1.2 * h)
    far = min(-run - near, near - 0.01 * h)
    back = near + far - eaves
    e = min(eaves, 0.06 * w)
    low = ((-e, eaves), (w + e, eaves), (w + e, back), (-e, back))
    high = ((draw, near), (w - draw, near), (w - draw, far), (draw, far))
    cap = min(0.14, 0.05 * h, 0.05 * w)
    top = h - cap / 2
    hips = [
        beam((x, 0.0, eaves - cap), (to, top, near), cap, "caps")
        for x, to in ((-e + cap / 2, draw), (w + e - cap / 2, w - draw))
    ]
    board = min(0.14, 0.1 * h)
    return (
        upright(low, 0.0, top, "body", top=high),
        *hips,
        Block(draw - cap / 2, top - cap / 2, w - draw + cap / 2, h, near - cap / 2, near + cap / 2, "caps"),
        Block(-e, -board, w + e, 0.0, back, eaves, "frame"),
        Block(-e, -0.6 * board, w + e, 0.0, eaves, eaves + 0.09, "gutter"),
    )


def hip(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A hipped roof seen from its long side; the ridge draws in by as much as the slope runs back, at most by 0.3 w."""
    return _slope(w, h, d, min(h, 0.3 * w), 0.3)


def pitched(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A pitched roof seen from its eaves: the whole rectangle is slope."""
    return _slope(w, h, d, 0.0, 0.0)


def _slope(w: float, h: float, d: float, draw: float, eave: float) -> tuple[Part, ...]:
    run = max(d, 1.6 * h)
    front, back = 0.3, -run - 0.3
    near = -min(run / 2, 1.2 * h)  # on a deep house the slope stays as steep and the top is flat
    far = -run - near - 0.001
    e = min(eave, 0.06 * w)
    low = ((-e, front), (w + e, front), (w + e, back), (-e, back))
    high = ((draw, near), (w - draw, near), (w - draw, far), (draw, far))
    ridge_cap = Block(draw, h - 0.06, w - draw, h, near - 0.06, near + 0.06)
    gutter = Block(-e, -0.1, w + e, 0.0, -0.1, front + 0.06, "gutter")
    return (upright(low, 0.0, h, top=high), ridge_cap, gutter)
