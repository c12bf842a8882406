"""Where walls end and the roof begins: a design's own roof gives way to the one over all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from ..design.model import Canvas
from ..render.geometry import find_geometry
from ..solver.model.layout import Layout, PlacedShape, Rect
from .faces import Face
from .model import Building

__all__ = ["eaves_of", "is_dormer", "is_roof", "shown", "wall_material"]

_ROOFS = frozenset({"roof", "hip", "pitched"})
_EPS = 1e-6
_SETBACK = 0.3
"""How far a wall stands back that is added behind a railing, metres."""


def is_roof(shape: PlacedShape) -> bool:
    """Whether a shape is a roof, by its kind or its geometry."""
    return shape.kind == "roof" or shape.geometry in _ROOFS


def is_dormer(shape: PlacedShape, eaves: float) -> bool:
    """Whether a shape stands above the eaves."""
    return shape.rect[1] >= eaves - _EPS


def eaves_of(building: Building, layouts: Iterable[Layout]) -> float:
    """The height at which the highest wall ends, metres; shapes that stand before a roof are no wall."""
    tops = [top for layout in layouts if (top := _top(layout)) is not None]
    return max(tops, default=building.height)


def _top(layout: Layout) -> float | None:
    """Where the walls of a design end; None where it says nothing of it, as a blind wall does not.

    What does not fill its rectangle, as a railing does not, is no wall.
    """
    if layout.design is None:
        return None
    roofs = [shape.rect for shape in layout.shapes if is_roof(shape)]
    return max(
        (
            shape.rect[3]
            for shape in layout.shapes
            if not is_roof(shape) and find_geometry(shape.geometry).full and not _before(shape.rect, roofs)
        ),
        default=None,
    )


def _before(rect: Rect, roofs: Sequence[Rect]) -> bool:
    """Whether a shape stands before a roof, as a dormer does."""
    return any(rect[1] >= roof[1] - _EPS and rect[1] < roof[3] - _EPS for roof in roofs)


def shown(building: Building, face: Face, layout: Layout, eaves: float) -> Layout:
    """What is built of a face: no roof of its own, its wall up to the eaves, dormers above."""
    if layout.design is None:
        walls = [replace(shape, rect=(*shape.rect[:3], eaves)) for shape in layout.shapes]
        return replace(layout, canvas=Canvas(face.length, eaves), shapes=tuple(walls))
    shapes = [shape for shape in layout.shapes if not is_roof(shape)]
    top = _top(layout)
    if top is None:  # a design without a wall: there is one all the same
        top = 0.0
    if top < eaves - _EPS:
        rect = (0.0, top, face.length, eaves)
        material = wall_material(shapes) or building.material
        before = any(shape.rect[3] > top + _EPS for shape in shapes)
        offset = -_SETBACK if before else 0.0  # behind what stands there
        shapes.insert(0, PlacedShape("wall above", "wall", "wall", rect, material=material, offset=offset))
    highest = max((shape.rect[3] for shape in shapes), default=eaves)
    canvas = Canvas(face.length, max(eaves, highest))
    return replace(layout, canvas=canvas, shapes=tuple(shapes))


def wall_material(shapes: Sequence[PlacedShape]) -> str | None:
    """What the walls among some shapes are made of, at their highest; None: there are none."""
    walls = [shape for shape in shapes if shape.kind == "wall" and find_geometry(shape.geometry).full]
    top = max((shape.rect[3] for shape in walls), default=0.0)
    near = [shape for shape in walls if shape.rect[3] > top - 1.0]
    return max(near, key=lambda shape: shape.rect[2] - shape.rect[0]).material if near else None
