"""What is drawn around and on top of a façade: frame, dimensions, holes, surveyed openings, the empty canvas."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..solver.model.layout import Layout, Rect
from .measured import Chain, ranges, within
from .parts import Point
from .style import Style, num

__all__ = [
    "FONT",
    "Frame",
    "common_corner",
    "draw_dimensions",
    "draw_empty",
    "draw_holes",
    "draw_survey",
    "opening_rects",
    "solved_look",
    "surveyed_look",
]

FONT = 'font-family="Helvetica,Arial,sans-serif"'
_OPENINGS = frozenset({"window", "door"})


@dataclass(frozen=True, slots=True)
class Frame:
    """Where the façade lies on the sheet: pixels per metre and the margins in pixels."""

    scale: float
    left: float
    right: float
    top: float
    bottom: float
    canvas: tuple[float, float]

    @classmethod
    def fit(
        cls, width: float, height: float, width_px: float | None, *, dimensions: bool, below: float = 0.0
    ) -> Frame:
        """The frame for a canvas of `width` by `height` metres; `below` pixels are kept free at the foot.

        Raises
        ------
        ValueError
            If `width_px` leaves no room.
        """
        extra = 34.0 if dimensions else 0.0
        if width_px is None:
            scale = min(840 / width, 580 / height, 140.0)
            side = min(52.0, max(26.0, 0.36 * scale))
        else:
            side = min(52.0, max(8.0, 0.05 * width_px))
            scale = (width_px - 2 * side - extra) / width
            if scale <= 0:
                raise ValueError(
                    f"width_px: expected more than {2 * side + extra:.0f} pixels, found {width_px:g}"
                )
        return cls(scale, side + extra, side, min(side, 34.0), 22.0 + extra + below, (width, height))

    @property
    def width(self) -> float:
        """Of the sheet, pixels."""
        return self.left + self.canvas[0] * self.scale + self.right

    @property
    def height(self) -> float:
        """Of the sheet, pixels."""
        return self.top + self.canvas[1] * self.scale + self.bottom

    def at(self, x: float, y: float) -> Point:
        """The pixel of a point of the façade, given in metres."""
        return self.left + x * self.scale, self.top + (self.canvas[1] - y) * self.scale

    def box(self, rect: Rect) -> str:
        """The attributes of an SVG rectangle."""
        x, y = self.at(rect[0], rect[3])
        w, h = (rect[2] - rect[0]) * self.scale, (rect[3] - rect[1]) * self.scale
        return f'x="{num(x)}" y="{num(y)}" width="{num(w)}" height="{num(h)}"'


def draw_empty(width: float, height: float, frame: Frame, style: Style, *, layers: bool) -> Iterable[str]:
    """The canvas before anything stands on it: a dashed outline, its size, a hint; `layers`: there are some already."""
    hint = (
        "Nothing is drawn yet: choose shapes for a layer"
        if layers
        else "An empty canvas: add a layer to begin"
    )
    x, y = frame.at(width / 2, height / 2)
    yield (
        f'<rect {frame.box((0, 0, width, height))} fill="{style.faint}" fill-opacity=".05" stroke="{style.faint}" '
        f'stroke-width="1" stroke-dasharray="6 5"/>'
    )
    yield (
        f'<g {FONT} text-anchor="middle" fill="{style.faint}"><text x="{num(x)}" y="{num(y)}" font-size="18">'
        f"{width:g} × {height:g} m</text>"
        f'<text x="{num(x)}" y="{num(y + 22)}" font-size="12">{hint}</text></g>'
    )


def draw_holes(holes: Sequence[Rect], frame: Frame, style: Style, prefix: str) -> Iterable[str]:
    """The places that no shape covers: hatched, with a thin dashed outline."""
    yield (
        f'<pattern id="{prefix}-hole" width="7" height="7" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">'
        f'<rect width="7" height="7" fill="#e5484d" fill-opacity=".12"/>'
        f'<path d="M0 0V7" stroke="#e5484d" stroke-opacity=".55" stroke-width="1.2"/></pattern>'
    )
    for hole in holes:
        yield (
            f'<rect class="hole" {frame.box(hole)} fill="url(#{prefix}-hole)" stroke="#e5484d" stroke-width=".8" '
            f'stroke-dasharray="4 3"><title>no shape covers this place</title></rect>'
        )


def draw_dimensions(layout: Layout, frame: Frame, style: Style) -> Iterable[str]:
    """Chains of dimensions along the foot and the left side: every boundary of the skin, then the whole."""
    colour = style.faint
    base = frame.at(0, 0)[1] + 18
    side = frame.left - frame.right - 4  # clear of eaves
    lines, texts = [], []
    for across in (True, False):
        walls = ranges(layout, "x" if across else "y")
        parts = _parts(layout, across, walls, 30 / frame.scale)
        for level, chain in enumerate((parts,) if parts == walls else (parts, walls)):
            at = base + 16 * level if across else side - 18 * level
            spans = [[frame.at(s, 0)[0] if across else frame.at(0, s)[1] for s in span] for span in chain]
            for end in dict.fromkeys(end for span in spans for end in span):
                x, y = (end, at) if across else (at, end)
                lines.append(f"M{num(x - 3)} {num(y + 3)}l6 -6")
            for (a, b), (p, q) in zip(chain, spans, strict=True):
                lines.append(f"M{num(p)} {num(at)}H{num(q)}" if across else f"M{num(at)} {num(p)}V{num(q)}")
                middle = (p + q) / 2
                place = (
                    f'x="{num(middle)}" y="{num(at - 3)}"'
                    if across
                    else f'transform="translate({num(at - 3)} {num(middle)})rotate(-90)"'
                )
                texts.append(f"<text {place}>{b - a:.2f}</text>")
    yield f'<path class="dimensions" d="{"".join(lines)}" stroke="{colour}" stroke-width=".6" fill="none"/>'
    yield f'<g {FONT} font-size="8.5" text-anchor="middle" fill="{colour}">{"".join(texts)}</g>'


def _parts(layout: Layout, across: bool, walls: Chain, least: float) -> Chain:
    """Between the solved columns of the axis, where there is room to write between all; else the walls alone."""
    groups = (layout.x if across else layout.y).groups
    found = within(walls, sorted({c for group in list(groups.values())[:1] for c in group.columns}))
    return found if all(b - a >= least for a, b in found) else walls


def opening_rects(layout: Layout) -> list[Rect]:
    """Rectangles of the shapes that are windows or doors."""
    return [shape.rect for shape in layout.shapes if shape.kind in _OPENINGS]


def common_corner(rects: Sequence[Rect]) -> Point:
    """The lower left corner that rectangles have in common."""
    return min((r[0] for r in rects), default=0.0), min((r[1] for r in rects), default=0.0)


def draw_survey(
    layout: Layout, survey: Sequence[Mapping[str, Any]], frame: Frame, style: Style
) -> Iterable[str]:
    """Surveyed openings over the layout's own, both moved to their common lower left corner."""
    own = opening_rects(layout)
    seen: list[Rect] = [(o["rect"][0], o["rect"][1], o["rect"][2], o["rect"][3]) for o in survey]
    (ax, ay), (bx, by) = common_corner(own), common_corner(seen)
    dx, dy = ax - bx, ay - by
    for rect in own:
        yield f'<rect class="solved" {frame.box(rect)} {solved_look(style)}/>'
    for left, bottom, right, top in seen:
        box = frame.box((left + dx, bottom + dy, right + dx, top + dy))
        yield f'<rect class="surveyed" {box} {surveyed_look(style)}/>'


def solved_look(style: Style) -> str:
    """Attributes of an opening of the layout."""
    return f'fill="{style.second}" fill-opacity=".16" stroke="{style.second}" stroke-width="1.1"'


def surveyed_look(style: Style) -> str:
    """Attributes of an opening of the survey."""
    return f'fill="none" stroke="{style.accent}" stroke-width="1.6" stroke-dasharray="5 3"'
