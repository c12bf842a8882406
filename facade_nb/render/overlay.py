"""A layout and a survey of the same building on one sheet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from ..solver.model.layout import Layout
from .annotate import FONT, solved_look, surveyed_look
from .elevation import elevation_svg
from .style import find_style, num

__all__ = ["overlay_svg"]


def overlay_svg(
    layout: Layout,
    openings: Sequence[Mapping[str, Any]],
    *,
    score: float | None = None,
    width_px: float | None = None,
    theme: str = "light",
    prefix: str | None = None,
) -> str:
    """Draw a layout's elevation, faded, with the surveyed openings outlined on top, a legend and how well they agree.

    Parameters
    ----------
    layout
        The solved façade.
    openings
        The survey: ``{"kind": ..., "rect": [left, bottom, right, top]}``, metres. Both are moved to their common lower
        left corner, as `facade_nb.survey.compare` does.
    score
        The agreement that is written on the drawing; None: what `compare` gives.
    width_px, theme, prefix
        As for `elevation_svg`.
    """
    if score is None:
        from ..survey import compare  # needs nothing of this package, and is not needed by the rest of it

        score = compare(layout, openings)
    style = find_style(theme)
    drawing = elevation_svg(layout, width_px=width_px, theme=theme, survey=openings, ids=False, prefix=prefix)
    head, _, body = drawing.partition("</defs>")
    width, height = _size(head)
    foot = 34.0
    tall = num(height + foot)
    head = head.replace(
        f'height="{num(height)}" viewBox="0 0 {num(width)} {num(height)}"',
        f'height="{tall}" viewBox="0 0 {num(width)} {tall}"',
    )
    start = body.index('<rect class="solved"') if '<rect class="solved"' in body else body.rindex("</svg>")
    y = height + 6
    colour = "#3a3631" if theme == "light" else "#d5dae0"
    legend = (
        f'<g {FONT} font-size="12" fill="{colour}">'
        f'<rect x="24" y="{num(y)}" width="20" height="12" {solved_look(style)}/>'
        f'<text x="50" y="{num(y + 10)}">solved</text>'
        f'<rect x="112" y="{num(y)}" width="20" height="12" {surveyed_look(style)}/>'
        f'<text x="138" y="{num(y + 10)}">surveyed ({len(openings)})</text>'
        f'<text x="{num(width - 24)}" y="{num(y + 10)}" text-anchor="end">'
        f"{escape(f'mean intersection over union {score:.3f}')}</text></g>"
    )
    paper, facade = _split_paper(body[:start])
    return (
        f'{head}</defs>{paper}<g opacity=".5">{facade}</g>{body[start:].removesuffix("</svg>")}{legend}</svg>'
    )


def _size(head: str) -> tuple[float, float]:
    box = head.partition('viewBox="')[2].partition('"')[0].split()
    return float(box[2]), float(box[3])


def _split_paper(body: str) -> tuple[str, str]:
    end = body.index("/>") + 2  # the paper is the first thing drawn
    return body[:end], body[end:]
