"""A contact sheet: the layouts of a sweep side by side, all at one scale, as one SVG."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from html import escape
from numbers import Integral
from typing import TYPE_CHECKING

from ..design.errors import DesignError
from ..render.annotate import FONT
from ..render.elevation import elevation_svg
from ..render.style import Style, find_style, num
from ..solver.model.layout import Layout
from .variants import RESULTS

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["contact_sheet", "picture_at"]

CAPTION = 34.0
"""Pixels under each elevation: its values, and what it has."""
LEAST = 96.0
"""Pixels that a picture is wide at least, so that its caption has room."""


def contact_sheet(
    table: pd.DataFrame, *, columns: int = 4, width_px: float = 1100, theme: str = "light"
) -> str:
    """Draw the layouts of `sweep` on one sheet.

    Parameters
    ----------
    table
        What `sweep` returned, or some of its rows.
    columns
        How many elevations stand in a row.
    width_px
        Width of the sheet in pixels.
    theme
        ``light`` or ``dark``.

    Returns
    -------
    str
        An SVG document. Façades are drawn at one scale and stand on one line, so that sizes can be compared; a
        variant without a layout says why.

    Raises
    ------
    ValueError
        For a table without layouts, an unknown theme, for fewer than one column, or a sheet without room for them.
    """
    style = find_style(theme)
    if "layout" not in getattr(table, "columns", ()):
        raise ValueError(
            f"contact_sheet: expected a table with a column 'layout', such as sweep's; found {type(table).__name__}"
        )
    if not _is_count(columns) or columns < 1 or width_px < columns * LEAST:
        raise ValueError(
            f"contact_sheet: expected at least 1 column and {LEAST:.0f} pixels for each; "
            f"found {columns!r} columns on {width_px:g} pixels"
        )
    rows = table.to_dict("records")
    cell = width_px / columns
    layouts = [row["layout"] for row in rows if row["layout"] is not None]
    widest = max((layout.canvas.width for layout in layouts), default=1.0)
    scale = 0.9 * cell / widest
    body: list[str] = []
    top = 0.0
    for first in range(0, len(rows), columns):
        shown = [picture_at(row["layout"], scale, theme) for row in rows[first : first + columns]]
        height = max([height for _, _, height in shown] + [104.0])
        for k, (row, (svg, wide, high)) in enumerate(zip(rows[first:], shown, strict=False)):
            left = k * cell
            if svg:
                x, y = left + (cell - wide) / 2, top + height - high
                body.append(svg.replace("<svg ", f'<svg x="{num(x)}" y="{num(y)}" ', 1))
            else:
                body += _refusal(str(row["error"]), left, top, cell, height, style)
            body += _caption(row, left + cell / 2, top + height, cell, style)
        top += height + CAPTION
    label = _many(len(rows), "variant")
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{num(width_px)}" height="{num(top)}" role="img" '
        f'viewBox="0 0 {num(width_px)} {num(max(top, 1.0))}" aria-label="{label}" style="max-width:100%;height:auto">'
        f'<rect width="100%" height="100%" fill="{style.paper}"/>{"".join(body)}</svg>'
    )


def _is_count(columns: object) -> bool:
    """Whether this is a whole number."""
    return isinstance(columns, Integral)


def _many(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"


def _text(style: Style) -> str:
    """The colour of writing: ink is for lines of façades, which are dark on dark paper, too."""
    return style.faint if style.name == "dark" else style.ink


def picture_at(
    layout: object, scale: float, theme: str, prefix: str | None = None
) -> tuple[str, float, float]:
    """An elevation at so many pixels a metre, and its width and height in pixels; empty for what is no layout."""
    if not isinstance(layout, Layout):
        return "", 0.0, 0.0
    wide = layout.canvas.width * scale
    wide = max(
        wide / 0.9, wide + 16
    )  # an elevation keeps a twentieth of its width free on either side, or 8 pixels
    side = max(8.0, 0.05 * wide)
    try:
        svg = elevation_svg(layout, width_px=wide, theme=theme, ids=False, background=False, prefix=prefix)
    except DesignError:  # of a geometry or material that there is not: its design says it where it is edited
        return "", 0.0, 0.0
    return svg, wide, layout.canvas.height * scale + min(side, 34.0) + 22.0


def _values(row: Mapping[str, object]) -> str:
    """The values that a variant has, a text such as a variation's name without its column's.

    One that it lacks is None, or in a table not equal to itself.
    """
    found = ((name, value) for name, value in row.items() if name not in RESULTS)
    return " · ".join(
        value if isinstance(value, str) else f"{name} {value:g}"
        for name, value in found
        if value is not None and value == value
    )


def _caption(row: Mapping[str, object], x: float, y: float, cell: float, style: Style) -> Sequence[str]:
    text = textwrap.shorten(_values(row), max(8, int(cell / 6.4)), placeholder=" …")
    shown = [
        f'<text x="{num(x)}" y="{num(y + 10)}" font-size="12" fill="{_text(style)}">{escape(text)}</text>'
    ]
    if row["layout"] is not None:
        about = _many(int(str(row["windows"])), "window")
        shown.append(
            f'<text x="{num(x)}" y="{num(y + 25)}" font-size="11" fill="{style.faint}">{about}</text>'
        )
    return [f'<g {FONT} text-anchor="middle">', *shown, "</g>"]


def _refusal(error: str, left: float, top: float, cell: float, height: float, style: Style) -> Sequence[str]:
    lines = textwrap.wrap(error, max(10, int((cell - 36) / 5.6)), max_lines=max(1, int((height - 24) / 14)))
    box = f'x="{num(left + 10)}" y="{num(top + 6)}" width="{num(cell - 20)}" height="{num(height - 12)}"'
    parts = [
        f'<rect {box} fill="none" stroke="{style.faint}" stroke-dasharray="5 4"/><g {FONT} font-size="11">'
    ]
    for k, line in enumerate(lines):
        parts.append(
            f'<text x="{num(left + 18)}" y="{num(top + 24 + 14 * k)}" fill="{_text(style)}">{escape(line)}</text>'
        )
    return [*parts, "</g>"]
