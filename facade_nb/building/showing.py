"""How buildings and their layouts show themselves in a notebook: as their elevations, side by side."""

from __future__ import annotations

from ..design.errors import NoLayout
from ..design.mimebundle import register
from .layout import BuildingLayout
from .model import Building

__all__ = ["MOMENT"]

MOMENT = 1.0
"""Seconds that solving a building may take when it is shown."""


def _building(building: Building) -> dict[str, str]:
    """The elevations of a building that is solved for a moment; without a layout, the reason."""
    text = f"<Building {building.name!r}: {len(building.plan)} walls, {building.height:g} m high>"
    try:
        return {**_layout(building.solve(time_limit=MOMENT)), "text/plain": text}
    except NoLayout as error:
        if error.constraint == "time":
            return {"text/plain": f"{text}\nNot solved in a moment: building.solve() goes on looking."}
        return {"text/plain": f"{text}\nNo layout: {error}"}


def _layout(layout: BuildingLayout) -> dict[str, str]:
    return {"image/svg+xml": layout.elevation_svg(), "text/plain": repr(layout)}


register(Building, _building)
register(BuildingLayout, _layout)
