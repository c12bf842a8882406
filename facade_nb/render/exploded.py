"""The paper's Figure 1: the stack of layers drawn apart in depth, as one SVG text."""

from __future__ import annotations

import secrets
from html import escape
from math import cos, radians, sin

from ..solver.model.layout import Layout
from .annotate import FONT, Frame
from .elevation import draw_facade
from .ink import Defs
from .scene import Scene, build_scene
from .style import Style, find_style, num

__all__ = ["exploded_svg"]

_TURN = radians(32.0)
"""How far the layers are turned away."""
_MARGIN = 26.0
_CAPTION = 22.0


def exploded_svg(
    layout: Layout,
    *,
    apart: float | None = None,
    theme: str = "light",
    ids: bool = True,
    background: bool = True,
    prefix: str | None = None,
) -> str:
    """Draw the layers of a layout apart from each other, the bottom layer farthest away.

    Each layer is a sheet of the canvas's size with its shapes on it, in parallel projection: uprights stay upright,
    and horizontals rise to the right. Corners of the canvas are joined by dashed lines. With `ids` shapes carry the
    data attributes of `elevation_svg`, and sheets ``data-sheet``, the name of their layer.

    Parameters
    ----------
    layout
        What to draw.
    apart
        Metres between two layers along the line of sight; None: so that each is well seen.
    theme
        ``light`` or ``dark``.
    ids
        Whether shapes carry their data attributes and titles, for picking.
    background
        Whether to draw the paper.
    prefix
        What the ids in the drawing begin with; None: something that no other drawing has.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material.
    ValueError
        For an unknown theme.
    """
    style = find_style(theme)
    scene = build_scene(layout)
    names = _layers(layout)
    wide, tall = layout.canvas.width, layout.canvas.height
    many = max(len(names) - 1, 0)
    step = apart if apart is not None else min(0.75 * max(wide, 0.6 * tall), 3.6 * wide / max(many, 1))
    # A sheet rises to the right; one that is nearer to the eye stands further to the right, and lower.
    across, rise = cos(_TURN), 0.62 * sin(_TURN)
    right, down = 0.8 * step, 0.3 * step
    whole = (wide * across + many * right, tall + wide * rise + many * down)
    scale = min(840 / whole[0], 560 / whole[1], 90.0)
    frame = Frame(scale, 0.0, 0.0, 0.0, 0.0, (wide, tall))
    prefix = prefix or f"x{secrets.token_hex(4)}"
    defs = Defs(prefix, style, scale, frame.at(0, 0), scene.library)
    width, height = whole[0] * scale + 2 * _MARGIN, whole[1] * scale + 2 * _MARGIN + _CAPTION
    high = _MARGIN + wide * rise * scale
    origin = [(_MARGIN + k * right * scale, high + k * down * scale) for k in range(len(names))]
    body = []
    if background:
        body.append(f'<rect width="100%" height="100%" fill="{style.paper}"/>')
    turned = f"{across:.5g},{-rise:.5g},0,1"
    for k, (name, (x, y)) in enumerate(zip(names, origin, strict=True)):
        if k:
            body.append(_joins(origin[k - 1], (x, y), (wide * scale, tall * scale), (across, -rise), style))
        own = Scene(scene.canvas, tuple(solid for solid in scene.solids if solid.shape.layer == name))
        drawn = "".join(draw_facade(own, defs, frame, style, ids=ids)) if own.solids else ""
        tag = f' data-sheet="{escape(name)}"' if ids else ""
        body.append(
            f'<g{tag} transform="matrix({turned},{num(x)},{num(y)})">'
            f'<rect width="{num(wide * scale)}" height="{num(tall * scale)}" fill="{style.paper}" fill-opacity=".2" '
            f'stroke="{style.faint}" stroke-width=".8"/>{drawn}</g>'
        )
    for name, (x, y) in zip(names, origin, strict=True):
        foot = y + tall * scale + 14
        body.append(
            f'<text {FONT} font-size="12" fill="{style.faint}" '
            f'transform="matrix({turned},{num(x)},{num(foot)})">{escape(name)}</text>'
        )
    w, h = num(width), num(height)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}" role="img" '
        f'aria-label="{escape(f"The layers of {layout.name}, drawn apart")}" style="max-width:100%;height:auto" '
        f'data-scale="{scale:.6g}" data-origin="0 {h}"><defs>{defs}</defs>{"".join(body)}</svg>'
    )


def _layers(layout: Layout) -> list[str]:
    """Names of the layers that are shown, from the bottom of the stack."""
    if layout.design is not None:
        return [layer.name for layer in reversed(layout.design.stack)]
    return list(dict.fromkeys(shape.layer for shape in layout.shapes))


def _joins(
    back: tuple[float, float],
    front: tuple[float, float],
    size: tuple[float, float],
    turned: tuple[float, float],
    style: Style,
) -> str:
    """Dashed lines between the corners of two sheets, one behind the other."""
    d = ""
    for u, v in ((0.0, 0.0), (size[0], 0.0), (0.0, size[1]), (size[0], size[1])):
        dx, dy = u * turned[0], u * turned[1] + v
        d += f"M{num(back[0] + dx)} {num(back[1] + dy)}L{num(front[0] + dx)} {num(front[1] + dy)}"
    return f'<path d="{d}" stroke="{style.faint}" stroke-width=".6" stroke-dasharray="3 3" fill="none"/>'
