"""Parts as closed bodies, by manifold3d: boxes, extrusions, revolutions, hulls and their unions.

manifold3d is loaded when the first body is made: drawings of parts do without.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from itertools import groupby, pairwise
from math import frexp
from operator import add
from typing import Any

import numpy as np

from .parts import Block, Loft, Moulding, Part, Point, Polyhedron, Prism, Ring, Turned

__all__ = ["SEGMENTS", "bodies_of", "body_of", "extruded"]

SEGMENTS = 32
"""Sides of a turned body."""

_FINE = 13
"""Outlines are scaled to about 2 ** 13: Clipper, which manifold3d has for them, keeps eight decimals."""

_ALONG_X = np.array([[0.0, 0.0, 1.0, 0.0], [0.0, 1.0, 0.0, 0.0], [-1.0, 0.0, 0.0, 0.0]])
"""From the frame of an extruded profile (-z, y), which leads along x, to that of a part."""


def bodies_of(parts: Sequence[Part]) -> Iterator[tuple[Part, Any]]:
    """Bodies, each a `manifold3d.Manifold` with the first of its parts.

    Prisms that follow one another, of one slot and depth, are one body: strokes of a letter, stones along a curve.
    """
    for alike, same in groupby(parts, key=_alike):
        group = tuple(same)
        if alike is None:
            yield from ((part, body_of(part)) for part in group)
        else:
            outlines = [part.points for part in group if isinstance(part, Prism)]
            yield group[0], extruded(outlines, *alike[:2])


def _alike(part: Part) -> tuple[float, float, str] | None:
    return (part.z0, part.z1, part.slot) if isinstance(part, Prism) else None


def body_of(part: Part) -> Any:
    """The body of a part, as a `manifold3d.Manifold`."""
    from manifold3d import Manifold, Mesh64

    match part:
        case Block():
            box = Manifold.cube((part.x1 - part.x0, part.y1 - part.y0, part.z1 - part.z0))
            return box.translate((part.x0, part.y0, part.z0))
        case Ring():
            x0, y0, x1, y1, t = part.x0, part.y0, part.x1, part.y1, part.width
            outer = ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
            inner = ((x0 + t, y0 + t), (x0 + t, y1 - t), (x1 - t, y1 - t), (x1 - t, y0 + t))
            return extruded((outer, inner), part.z0, part.z1)
        case Prism():
            return extruded((part.points,), part.z0, part.z1)
        case Moulding():
            front = [(-z, y) for y, z in part.profile]
            section = ((-part.z0, front[0][1]), *front, (-part.z0, front[-1][1]))
            return extruded((section,), part.x0, part.x1).transform(_ALONG_X)
        case Turned():
            low, high = part.profile[0][0], part.profile[-1][0]
            half, scale = _section((((0.0, low), *((r, y) for y, r in part.profile), (0.0, high)),))
            body = half.revolve(SEGMENTS).scale((scale, scale, scale)).rotate((-90.0, 0.0, 0.0))
            return body.translate((part.cx, 0.0, part.cz))
        case Loft():
            loops = np.array(part.loops)
            low = loops.min(axis=(0, 1))
            size = np.maximum(loops.max(axis=(0, 1)) - low, 1e-300)
            loops = (loops - low) / size  # what is thin for its length has a hull in a cube
            body = reduce(add, (Manifold.hull_points(np.concatenate(pair)) for pair in pairwise(loops)))
            return body.scale(size).translate(low)
        case Polyhedron():
            faces = [(face[0], *side) for face in part.faces for side in pairwise(face[1:])]
            return Manifold(Mesh64(np.array(part.points, np.float64), np.array(faces, np.uint64)))


def extruded(outlines: Sequence[Sequence[Point]], z0: float, z1: float) -> Any:
    """Outlines, the holes in them clockwise, from one depth to another, as a `manifold3d.Manifold`."""
    section, scale = _section(outlines)
    return section.extrude(1.0).scale((scale, scale, z1 - z0)).translate((0.0, 0.0, z0))


def _section(outlines: Sequence[Sequence[Point]]) -> tuple[Any, float]:
    """The region within outlines, large enough for Clipper's decimals, and what to multiply it by."""
    from manifold3d import CrossSection, FillRule

    points = [np.array(outline, np.float64) for outline in outlines]
    scale = 2.0 ** (frexp(max(float(np.abs(own).max()) for own in points))[1] - _FINE)
    return CrossSection([own / scale for own in points], FillRule.NonZero), scale
