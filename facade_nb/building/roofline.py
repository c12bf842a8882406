"""Where walls end and the roof begins: a design's own roof gives way to the one over all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from ..design.model import Canvas
from ..solver.model.layout import Layout, PlacedShape, Rect
from .faces import Face
from .model import Building

__all__ = ["eaves_of", "is_dormer", "is_roof", "shown"]

_ROOFS = frozenset({"roof", "hip", "pitched"})
_EPS = 1e-6


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
    """Where the walls of a design end; None where it says nothing of it, as a blind wall does not."""
    if layout.design is None:
        return None
    roofs = [shape.rect for shape in layout.shapes if is_roof(shape)]
    return max(
        (shape.rect[3] for shape in layout.shapes if not is_roof(shape) and not _before(shape.rect, roofs)),
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
        material = _material(shapes, top) or building.material
        shapes.append(PlacedShape("wall above", "wall", "wall", rect, material=material))
    highest = max((shape.rect[3] for shape in shapes), default=eaves)
    canvas = Canvas(face.length, max(eaves, highest))
    return replace(layout, canvas=canvas, shapes=tuple(shapes))


def _material(shapes: Sequence[PlacedShape], top: float) -> str | None:
    """What the wall is made of below its top."""
    near = [shape for shape in shapes if abs(shape.rect[3] - top) < _EPS and shape.kind == "wall"]
    wide = max(near or [s for s in shapes if s.kind == "wall"], key=lambda s: s.rect[2] - s.rect[0], default=None)
    return None if wide is None else wide.material
