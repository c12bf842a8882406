"""Dormers in the roof over all: on its slope, back into it, and no higher than it covers them."""

from __future__ import annotations

from dataclasses import replace

from ..design.errors import DesignError
from ..render.scene import within_roof
from .bodies import slope_of
from .layout import BuildingLayout

__all__ = ["covered"]


def covered(layout: BuildingLayout) -> BuildingLayout:
    """The building with dormers as high as its roof covers them; what has no room is left out. Warnings tell of it."""
    faces, told = [], list(layout.warnings)
    for own in layout.faces:
        above = any(shape.rect[3] > layout.eaves + 1e-6 for shape in own.shown.shapes)
        try:
            shown, faults = within_roof(own.shown, slope_of(layout, own)) if above else (own.shown, ())
        except DesignError:  # who draws it tells that
            shown, faults = own.shown, ()
        faces.append(replace(own, shown=shown))
        told += [f"{own.face.name}: {fault}" for fault in faults]
    return replace(layout, faces=tuple(faces), warnings=tuple(dict.fromkeys(told)))
