"""The elevation: a layout drawn as an architect would, as one SVG text."""

from __future__ import annotations

import secrets
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from html import escape
from typing import Any

import numpy as np

from ..solver.model.layout import Layout
from .annotate import Frame, draw_dimensions, draw_empty, draw_holes, draw_survey
from .ink import Defs, draw_parts, inline
from .polygons import hundredths, polygons_path, segments_path, texts
from .relief import Edges, Relief
from .scene import Scene, Solid, build_scene
from .style import FINE, HEAVY, MEDIUM, Style, find_style, num

__all__ = ["draw_facade", "elevation_pieces", "elevation_svg"]


def elevation_svg(
    layout: Layout,
    *,
    width_px: float | None = None,
    theme: str = "light",
    survey: Sequence[Mapping[str, Any]] | None = None,
    ids: bool = True,
    dimensions: bool = False,
    holes: bool = False,
    background: bool = True,
    prefix: str | None = None,
) -> str:
    """Draw a layout as an elevation.

    Each shape is a ``<g>`` whose first child, after its title, is a rectangle of class ``cell`` that covers exactly
    the shape's rectangle and takes the pointer. With `ids` the group carries ``data-shape`` (index into
    ``layout.shapes``), ``data-layer``, ``data-x``, ``data-y`` and ``data-number`` (of the two
    instances). ``<svg>`` carries ``data-scale`` (pixels per metre) and ``data-origin`` (the pixel of the façade's lower
    left corner).

    Parameters
    ----------
    layout
        What to draw.
    width_px
        Width of the whole drawing in pixels; None: as large as fits about 900 by 640.
    theme
        ``light`` or ``dark``.
    survey
        Surveyed openings (``{"kind": ..., "rect": [left, bottom, right, top]}``) to outline on top.
    ids
        Whether shapes carry their data attributes and titles, for picking.
    dimensions
        Whether to add dimension lines.
    holes
        Whether to mark the places that no shape covers.
    background
        Whether to draw the paper; without it the drawing is transparent around the façade.
    prefix
        What the ids in the drawing begin with; None: something that no other drawing has.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material.
    ValueError
        For an unknown theme, or a width without room for the drawing.
    """
    return "".join(
        elevation_pieces(
            layout,
            width_px=width_px,
            theme=theme,
            survey=survey,
            ids=ids,
            dimensions=dimensions,
            holes=holes,
            background=background,
            prefix=prefix,
        )
    )


def elevation_pieces(
    layout: Layout,
    *,
    width_px: float | None = None,
    theme: str = "light",
    survey: Sequence[Mapping[str, Any]] | None = None,
    ids: bool = True,
    dimensions: bool = False,
    holes: bool = False,
    background: bool = True,
    prefix: str | None = None,
    scene: Scene | None = None,
) -> list[str]:
    """The text of `elevation_svg` in pieces: each is a whole element, or a tag that opens or closes one around others.

    A view that holds the drawing compares them with those that it has, and changes what differs. `scene` is that of
    the layout, where it has been built already.
    """
    style = find_style(theme)
    scene = scene or build_scene(layout)
    frame = Frame.fit(layout.canvas.width, layout.canvas.height, width_px, dimensions=dimensions)
    prefix = prefix or f"f{secrets.token_hex(4)}"
    body: list[str] = []
    defs = Defs(prefix, style, frame.scale, frame.at(0, 0), scene.library)
    if background:
        body.append(f'<rect width="100%" height="100%" fill="{style.paper}"/>')
    if scene.solids:
        body += draw_facade(scene, defs, frame, style, ids=ids)
    else:
        layers = layout.design is not None and bool(layout.design.layers)
        body += draw_empty(layout.canvas.width, layout.canvas.height, frame, style, layers=layers)
    body += _ground(frame, style)
    if holes and layout.holes and scene.solids:  # where nothing is drawn yet, nothing is missing
        body += draw_holes(layout.holes, frame, style, prefix)
    if dimensions:
        body += draw_dimensions(layout, frame, style)
    if survey is not None:
        body += draw_survey(layout, survey, frame, style)
    label = escape(f"Elevation of {layout.name}, {layout.canvas.width:g} by {layout.canvas.height:g} metres")
    w, h = num(frame.width), num(frame.height)
    x, y = frame.at(0, 0)
    root = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}" role="img" '
        f'aria-label="{label}" style="max-width:100%;height:auto" data-scale="{frame.scale:.6g}" '
        f'data-origin="{num(x)} {num(y)}">'
    )
    return [root, "<defs>", *defs, "</defs>", *body, "</svg>"]


def draw_facade(scene: Scene, defs: Defs, frame: Frame, style: Style, *, ids: bool) -> Iterable[str]:
    """The shapes of a scene with their shadows and lines, layer by layer."""
    relief = Relief(scene)
    edges, shadows = relief.edges(), relief.shadows()
    layers: list[list[str]] = [[] for _ in relief.layers]
    for solid, cell in zip(scene.solids, _cells(scene.solids, frame), strict=True):
        layers[relief.layers[solid.shape.layer]].append(_shape(solid, cell, defs, frame, ids=ids))
    for shapes, lines, shade in zip(layers, edges, shadows, strict=True):
        yield "<g>"
        yield from shapes
        if shade:
            d = polygons_path(shade, frame)
            yield (
                f'<path class="shadow" d="{d}" fill="{style.shadow}" fill-opacity="{style.shade}" '
                'pointer-events="none"/>'
            )
        yield from _lines(lines, frame, style)
        yield "</g>"


def _cells(solids: Sequence[Solid], frame: Frame) -> list[tuple[str, ...]]:
    """Left, top, width and height of each shape in pixels, as they are written."""
    left, bottom, right, top = np.array([solid.shape.rect for solid in solids]).T
    numbers = hundredths(*frame.at(left, top), (right - left) * frame.scale, (top - bottom) * frame.scale)
    return [*zip(*map(texts, numbers), strict=True)]


def _shape(solid: Solid, cell: tuple[str, ...], defs: Defs, frame: Frame, *, ids: bool) -> str:
    shape = solid.shape
    x, y, w, h = cell
    head = "<g>"
    if ids:
        of, title = _called(shape.layer, shape.x, shape.y, shape.kind, shape.geometry, shape.material)
        head = f'<g data-shape="{solid.index}"{of} data-number="{shape.number[0]} {shape.number[1]}">{title}'
    head += f'<rect class="cell" x="{x}" y="{y}" width="{w}" height="{h}" fill='
    if solid.geometry.name == "box" or not solid.parts:
        return f"{head}{defs.plain(solid, frame)}/></g>"
    if inline(solid):
        drawn = draw_parts(solid, defs, frame.at(*shape.rect[:2]))
    else:
        drawn = f'<use href="#{defs.shape(solid, w, h)}" x="{x}" y="{y}"/>'
    return f'{head}"none" pointer-events="all"/>{drawn}</g>'


@lru_cache(maxsize=4096)
def _called(layer: str, x: str, y: str, kind: str, geometry: str, material: str) -> tuple[str, str]:
    """The attributes that say whose a shape is, and its title."""
    attributes = f' data-layer="{escape(layer)}" data-x="{escape(x)}" data-y="{escape(y)}"'
    return attributes, f"<title>{escape(f'{layer}: {x} {y}, {kind} ({geometry}, {material})')}</title>"


def _lines(edges: Edges, frame: Frame, style: Style) -> Iterable[str]:
    for segments, weight in ((edges.joint, FINE), (edges.depth, MEDIUM), (edges.outline, HEAVY)):
        if segments:
            yield (
                f'<path d="{segments_path(segments, frame)}" stroke="{style.ink}" stroke-width="{weight}" '
                f'stroke-linecap="square" fill="none" pointer-events="none"/>'
            )


def _ground(frame: Frame, style: Style) -> Iterable[str]:
    """A heavy ground line with a thin band of earth below it."""
    y = frame.at(0, 0)[1]
    x0, x1 = 0.35 * frame.left, frame.width - 0.35 * frame.right
    colour = style.ink if style.name == "light" else style.faint
    step = 6.0
    ticks = "".join(f"M{num(x0 + i * step + 5)} {num(y + 2)}l-5 5" for i in range(int((x1 - x0) / step)))
    yield (f'<path d="{ticks}" stroke="{colour}" stroke-width=".4" stroke-opacity=".45" fill="none"/>')
    yield f'<path d="M{num(x0)} {num(y + 1)}H{num(x1)}" stroke="{colour}" stroke-width="2.2" stroke-linecap="round"/>'
