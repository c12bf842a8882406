"""Layouts for the tests of files: the gallery's, solved once, and small ones made by hand."""

from __future__ import annotations

from functools import cache
from typing import Any

from facade_nb import Layout, gallery, solve
from facade_nb.design import Canvas
from facade_nb.solver.model.layout import PlacedShape, Rect
from tests.known import FEW

NAMES = tuple(FEW)

QUICK = ("figure-7", "qualifiers-a", "residential-house", "ingolstadt-4018215")
"""Designs of few lines, for what takes long."""


@cache
def solved(name: str) -> Layout:
    """A design of the gallery, solved."""
    return solve(gallery.load(name))


def shape(
    rect: Rect, kind: str = "wall", *, layer: str = "base", x: str = "A", y: str = "P", **looks: Any
) -> PlacedShape:
    """A shape made by hand."""
    return PlacedShape(layer, x, y, rect, kind=kind, **looks)


def layout(width: float, height: float, *shapes: PlacedShape, name: str = "By hand") -> Layout:
    """A layout made by hand."""
    return Layout(name, Canvas(width, height), shapes=shapes)


def wall_with_window(width: float = 4.0, height: float = 3.0) -> Layout:
    """A plain wall with a window in the middle."""
    a, b, c, d = width / 4, height / 3, 3 * width / 4, 2 * height / 3
    return layout(
        width,
        height,
        shape((0, 0, width, height), material="brick"),
        shape((a, b, c, d), "window", layer="windows", x="W", y="F", geometry="window", offset=-0.1),
    )
