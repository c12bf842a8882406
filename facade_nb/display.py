"""How designs and layouts show themselves in a notebook: as their elevation.

`Design` and `Layout` call this by name when a notebook asks them to, so that neither depends on what draws them.
"""

from __future__ import annotations

from .design import Design, NoLayout
from .render import elevation_svg
from .solver import Layout, solve

__all__ = ["design_bundle", "layout_bundle"]


def layout_bundle(layout: Layout) -> dict[str, str]:
    """The elevation, and one line of text."""
    return {"image/svg+xml": elevation_svg(layout), "text/plain": repr(layout)}


def design_bundle(design: Design) -> dict[str, str]:
    """The elevation of the solved design; for a design without a layout, the reason."""
    canvas = f"{design.canvas.width:g} × {design.canvas.height:g} m"
    text = f"<Design {design.name!r}: {canvas}, {len(design.layers)} layers>"
    try:
        layout = solve(design, time_limit=5.0)
    except NoLayout as error:
        return {"text/plain": f"{text}\nNo layout: {error}"}
    return {"image/svg+xml": elevation_svg(layout), "text/plain": text}
