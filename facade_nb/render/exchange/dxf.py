"""DXF (R2010): every shape's rectangle by kind, the drawing's lines by weight, dimensions. Metres."""

from __future__ import annotations

import re
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING

from ...design.files import write_atomically
from ...solver.model.layout import Layout
from ..scene import build_scene
from .chains import FIRST, PITCH, TEXT, Units, chains, check_units, label, levels, offset
from .linework import WEIGHTS, Linework, linework
from .schedule import OTHER
from .sheet import scale_of

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.layouts import Modelspace

__all__ = ["layer_of", "to_dxf", "write_dxf"]

_DIMENSIONS, _OUTLINE = "dimensions", "outline"

_KEPT = re.compile(r"(0|defpoints|dimensions|outline|line.*)", re.IGNORECASE)
"""Names of layers that are not for kinds."""

_NOT_ALLOWED = re.compile(r"[<>/\\\":;?*|=`,\x00-\x1f]")

_COLOURS = {"window": 4, "door": 30, "wall": 8, "roof": 14, OTHER: 9}
"""Colours of AutoCAD's index, for the layers of kinds; others are grey."""


def to_dxf(layout: Layout, units: str = "m") -> str:
    """Return a layout as DXF.

    Parameters
    ----------
    layout
        What to draw.
    units
        Of the dimensions' texts: ``m``, or ``ft`` for feet and inches. The drawing is in metres either way.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material.
    ValueError
        For other units.
    """
    import ezdxf
    from ezdxf import zoom
    from ezdxf.units import M

    known = check_units(units)
    lines = linework(build_scene(layout))
    document = ezdxf.new("R2010", setup=False, units=M)
    document.header["$MEASUREMENT"] = 1
    document.header["$LWDISPLAY"] = 1
    space = document.modelspace()
    _draw_shapes(layout, document, space)
    _draw_lines(lines, document, space)
    document.layers.add(_OUTLINE, color=1, lineweight=18, plot=False)
    space.add_lwpolyline(
        _corners((0.0, 0.0, layout.canvas.width, layout.canvas.height)),
        close=True,
        dxfattribs={"layer": _OUTLINE},
    )
    _draw_dimensions(layout, lines, document, space, known)
    zoom.extents(space, 1.05)
    text = StringIO()
    document.write(text)
    return text.getvalue()


def write_dxf(layout: Layout, path: str | Path, units: str = "m") -> Path:
    """Write a layout as DXF (see `to_dxf`), atomically, and return the path.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material, or a file that cannot be written.
    ValueError
        For units other than ``m`` and ``ft``.
    """
    write_atomically(path, to_dxf(layout, units))
    return Path(path)


def layer_of(kind: str) -> str:
    """The name of the layer for shapes of a kind: the kind, without what no layer may be called."""
    name = " ".join(_NOT_ALLOWED.sub("_", kind).split())[:200] or OTHER
    return f"kind {name}" if _KEPT.fullmatch(name) else name


def _draw_shapes(layout: Layout, document: Drawing, space: Modelspace) -> None:
    """The rectangles. They are there to be picked and counted; what is plotted are the lines."""
    for shape in layout.shapes:
        layer = layer_of(shape.kind)
        if layer not in document.layers:
            colour = _COLOURS.get(layer.lower(), 9)
            document.layers.add(layer, color=colour, lineweight=13, plot=False)
        space.add_lwpolyline(_corners(shape.rect), close=True, dxfattribs={"layer": layer})


def _draw_lines(lines: Linework, document: Drawing, space: Modelspace) -> None:
    for weight, width in WEIGHTS.items():
        layer = f"line {weight}"
        document.layers.add(layer, color=8 if weight == "fine" else 7, lineweight=round(100 * width))
        for line in lines.lines[weight]:
            closed = len(line) > 3 and line[0] == line[-1]
            attributes = {"layer": layer}
            if len(line) == 2:
                space.add_line(*line, dxfattribs=attributes)
            else:
                space.add_lwpolyline(line[:-1] if closed else line, close=closed, dxfattribs=attributes)


def _draw_dimensions(
    layout: Layout, lines: Linework, document: Drawing, space: Modelspace, units: Units
) -> None:
    scale = scale_of(layout, lines)
    mm = scale / 1000  # metres in the drawing of a millimetre on paper
    document.layers.add(_DIMENSIONS, color=7, lineweight=13)
    document.styles.add("facade", font="arial.ttf")
    style = document.dimstyles.new(f"facade 1-{scale}")
    style.dxf.dimtxsty = "facade"
    style.dxf.dimtxt = TEXT * mm
    style.dxf.dimtsz = 0.8 * mm  # oblique strokes, as architects have them
    style.dxf.dimgap = 0.5 * mm
    style.dxf.dimtad = 1
    style.dxf.dimtih = style.dxf.dimtoh = 0
    style.dxf.dimtix = style.dxf.dimtofl = 1
    style.dxf.dimdle = 0.0
    style.dxf.dimexe = 1.0 * mm
    style.dxf.dimexo = 1.0 * mm
    style.dxf.dimfxlon, style.dxf.dimfxl = 1, 1.2 * mm  # short: they do not run through the chains before
    style.dxf.dimdec, style.dxf.dimzin, style.dxf.dimdsep = 2, 0, ord(".")
    style.dxf.dimclrd = style.dxf.dimclre = style.dxf.dimclrt = 7
    left, bottom, _, _ = lines.bounds or (0.0, 0.0, 0.0, 0.0)
    for axis in ("x", "y"):
        at = min(bottom if axis == "x" else left, 0.0) - FIRST * mm
        for chain in chains(layout, axis):
            for (a, b), level in zip(chain, levels(chain, scale, units), strict=True):
                written = "<>" if units == "m" else label(b - a, units)
                place = at - offset(axis, level) * mm if level else None
                middle = (a + b) / 2
                across = axis == "x"
                dimension = space.add_linear_dim(
                    base=(middle, at) if across else (at, middle),
                    p1=(a, 0.0) if across else (0.0, a),
                    p2=(b, 0.0) if across else (0.0, b),
                    angle=0 if across else 90,
                    dimstyle=style.dxf.name,
                    text=" " if level is None else written,
                    override={"dimtmove": 2},
                    dxfattribs={"layer": _DIMENSIONS},
                )
                if place is not None:
                    dimension.set_location((middle, place) if across else (place, middle), leader=False)
                dimension.render()
                if dimension.dimension.dxf.get("text_midpoint") is None:  # as where no text is drawn
                    dimension.dimension.dxf.text_midpoint = (middle, at, 0) if across else (at, middle, 0)
            at -= PITCH * mm


def _corners(rect: tuple[float, float, float, float]) -> list[tuple[float, float]]:
    left, bottom, right, top = rect
    return [(left, bottom), (right, bottom), (right, top), (left, top)]
