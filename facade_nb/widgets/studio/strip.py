"""All walls of a building side by side, as its studio shows them above the chosen one."""

from __future__ import annotations

import re
from html import escape

from ...building import BuildingLayout
from ...building.developed import GAP
from ...building.vertical import SPINES
from ...render import elevation_svg

__all__ = ["strip_of"]

_TALL = 240
"""Pixels that the strip is high at most."""


def strip_of(layout: BuildingLayout, wall: str, theme: str, prefix: str) -> str:
    """All walls side by side, the lines at which they meet, and what there is to say.

    Parameters
    ----------
    wall
        The name of the one that is marked.
    theme
        ``light`` or ``dark``.
    prefix
        Of the ids in it, which no other drawing of the page may have.
    """
    svg = elevation_svg(layout.developed, theme=theme, ids=False, background=False, prefix=prefix)
    scale, (origin, _), (width, height) = _scale(svg)
    svg = svg.replace("<svg ", '<svg style="width:100%;height:auto;display:block" ', 1)
    at, marks = 0.0, []
    for own in layout.faces:
        chosen = own.face.name == wall
        left = 100 * (origin + at * scale) / width
        wide = 100 * own.face.length * scale / width
        style = (
            "border-top:3px solid currentColor;font-weight:bold" if chosen else "border-top:1px solid #8888"
        )
        marks.append(
            f'<div style="position:absolute;left:{left:.3f}%;width:{wide:.3f}%;text-align:center;{style}">'
            f"{escape(own.face.name)}</div>"
        )
        at += own.face.length + GAP
    shared = layout.heights.groups.get(SPINES)
    told = "All walls are of one design."
    if shared is not None:
        told = f"Walls meet at {', '.join(f'{stop:.2f}' for stop in shared.columns)} m."
    notes = "".join(f"<div>{escape(text)}</div>" for text in layout.warnings)
    return (
        f'<div class="facade-nb-around" style="max-width:{_TALL * width / height:.0f}px">{svg}'
        f'<div style="position:relative;height:1.8em">{"".join(marks)}</div>'
        f'<div style="font-size:smaller">{escape(told)}{notes}</div></div>'
    )


def _scale(svg: str) -> tuple[float, tuple[float, float], tuple[float, float]]:
    """Pixels per metre of an elevation, where its lower left corner is, and how large it is."""
    head = svg[: svg.index(">")]

    def numbers(name: str) -> list[float]:
        return [float(value) for value in re.split(r"[ ,]+", head.split(f'{name}="', 1)[1].split('"', 1)[0])]

    (scale,), (x, y), (_, _, width, height) = (
        numbers("data-scale"),
        numbers("data-origin"),
        numbers("viewBox"),
    )
    return scale, (x, y), (width, height)
