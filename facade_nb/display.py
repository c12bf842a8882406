"""How designs and layouts show themselves in a notebook: as their elevation.

Importing this registers it with `facade_nb.design.mimebundle`, so that neither a design nor a layout depends on what
draws it. What draws is loaded when something is shown.
"""

from __future__ import annotations

from .design import Design, NoLayout
from .design.mimebundle import register
from .solver import Layout, solve

__all__ = ["MOMENT", "design_bundle", "layout_bundle"]

MOMENT = 0.5
"""Seconds that solving a design may take when it is shown. A cell that ends in a design is not a call to solve it."""


def layout_bundle(layout: Layout) -> dict[str, str]:
    """The elevation, and one line of text."""
    from .render import elevation_svg

    return {"image/svg+xml": elevation_svg(layout), "text/plain": repr(layout)}


def design_bundle(design: Design) -> dict[str, str]:
    """The elevation of the solved design; for a design without a layout, the reason.

    A design that takes longer than a moment shows the best layout found until then, and says so; where there is none
    yet, it names the call that goes on looking.
    """
    canvas = f"{design.canvas.width:g} × {design.canvas.height:g} m"
    text = f"<Design {design.name!r}: {canvas}, {len(design.layers)} layers>"
    try:
        layout = solve(design, time_limit=MOMENT)
    except NoLayout as error:
        if error.constraint == "time":
            return {"text/plain": f"{text}\nNot solved in a moment: solve(design) goes on looking."}
        return {"text/plain": f"{text}\nNo layout: {error}"}
    if not layout.complete:
        text += "\nThe best layout found in a moment: solve(design) goes on looking."
    return {**layout_bundle(layout), "text/plain": text}


register(Design, design_bundle)
register(Layout, layout_bundle)
