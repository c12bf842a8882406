"""The faces of a building side by side in one plane: its developed elevation, a layout like any other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..design.model import Canvas, Design
from ..render.ruled import library_of
from ..solver.model.layout import (
    AxisLayout,
    GroupLayout,
    Layout,
    PlacedLetter,
    PlacedShape,
    Rect,
    RowLayout,
)
from .bodies import rules_of
from .layout import BuildingLayout, SolvedFace

__all__ = ["GAP", "developed"]

GAP = 1.5
"""Metres between two faces."""


def developed(layout: BuildingLayout, faces: Sequence[SolvedFace] = ()) -> Layout:
    """All faces, or some, from wall 1 on from left to right, on one ground.

    Shapes stand on layers ``wall 1/layer``. Its dimensions are the faces' widths along x, and the heights of the main
    groups along y.
    """
    shapes: list[PlacedShape] = []
    walls: list[tuple[PlacedLetter, ...]] = []
    holes: list[Rect] = []
    stops = [0.0]
    at, rules = 0.0, rules_of(layout)
    for own in faces or layout.faces:
        library = library_of(own.shown)
        for shape in own.shown.shapes:
            left, bottom, right, top = shape.rect
            rect = (left + at, bottom, right + at, top)
            material = rules.material(library, shape.material)
            layer = f"{own.face.name}/{shape.layer}"
            shapes.append(replace(shape, rect=rect, layer=layer, material=material))
        for left, bottom, right, top in own.shown.holes:
            if bottom < layout.eaves - 1e-6:
                holes.append((left + at, bottom, right + at, min(top, layout.eaves)))
        end = at + own.face.length
        walls += [(PlacedLetter(own.face.name, at, end),), ()]  # the wall, then a gap that nothing fills
        stops += [end, end + GAP]
        at = end + GAP
    highest = max((own.shown.canvas.height for own in faces or layout.faces), default=layout.eaves)
    row = RowLayout("faces", "faces", tuple(walls[:-1]))
    across = GroupLayout(0.0, tuple(stops[:-1]), (row,))
    heights = {
        name: replace(group, columns=tuple(v for v in group.columns if v <= highest + 1e-9), rows=())
        for name, group in _heights(layout).items()
    }
    return Layout(
        layout.name,
        Canvas(max(at - GAP, 0.1), highest),
        x=AxisLayout(groups={"faces": across}),
        y=AxisLayout(groups=heights),
        shapes=tuple(shapes),
        holes=tuple(holes),
        warnings=layout.warnings,
        complete=layout.complete,
        design=Design(grammar=rules.text) if rules.text else None,
    )


def _heights(layout: BuildingLayout) -> dict[str, GroupLayout]:
    """The groups whose boundaries are worth a chain: what the walls share, else those of the first wall."""
    from .vertical import SPINES

    if SPINES in layout.heights.groups:
        return {SPINES: layout.heights.groups[SPINES]}
    first = next((own.layout.y.groups for own in layout.faces if own.face.design is not None), {})
    return dict(first)
