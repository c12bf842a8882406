"""PDF: one sheet with the elevation to scale, its dimensions, a title block and the schedule, in vectors.

What a rule of the design's grammar draws is a picture within them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from io import BytesIO
from itertools import product
from math import ceil, floor
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...design.files import write_atomically
from ...solver.model.layout import Layout, Rect
from ..baked import SHARP, face_size
from ..materials import mix
from ..measured import ranges
from ..ruled import library_of, material_of, rule_pixels
from ..scene import Scene, build_scene, without
from .chains import FIRST, PITCH, TEXT, Units, chains, check_units, label, levels, offset
from .linework import WEIGHTS, Drawn, Linework, linework
from .schedule import Item, items, items_on
from .sheet import MARGIN, PAPER, ROW, TITLE, Sheet, Table, lay_out

if TYPE_CHECKING:
    from reportlab.lib.utils import ImageReader
    from reportlab.pdfgen.canvas import Canvas

__all__ = ["Page", "largest_scale", "sheets_pdf", "to_pdf", "write_pdf"]

_MM = 72 / 25.4
_SMALL = 1.7
"""Height of the schedule's text, millimetres."""

_NAME, _NAMES = 2.4, 5.0
"""Heights of a name's capitals and of all names below a drawing, millimetres."""

_CAP = 0.72
"""Height of a capital as a share of a font's size, which is what `TEXT` and `_SMALL` mean: about so in Helvetica."""

_PALE = 0.4
"""How much white is in the picture of a rule."""

_HAIR = 1e-4
"""What is seen of a picture beyond its rectangle by less than this share of it is not drawn."""

_ELSEWHERE = "STSong-Light"
"""The font for letters that Helvetica lacks: Greek, Cyrillic, Chinese, Japanese. Readers bring it; no file holds it."""

_LONGEST = 22
"""Letters of a word of the schedule."""

_MARKED = ("window", "door")
"""Kinds that carry their marks in the drawing."""

_HEADINGS = ("Mark", "Kind", "Geometry", "Material", "W", "H", "No.")
_AREAS: dict[Units, tuple[str, float]] = {"m": ("m²", 1.0), "ft": ("ft²", 0.3048**-2)}


def to_pdf(layout: Layout, units: str = "m") -> bytes:
    """Return a layout as PDF, A3 landscape.

    Parameters
    ----------
    layout
        What to draw.
    units
        Of the dimensions and the schedule's sizes: ``m``, or ``ft`` for feet and inches.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material.
    ValueError
        For other units.
    """
    return sheets_pdf(layout, [Page(layout)], check_units(units))


@dataclass(frozen=True, slots=True)
class Page:
    """What is drawn on one sheet, and the names of what stands there side by side: each from where to where, metres."""

    layout: Layout
    names: tuple[tuple[str, float, float], ...] = ()

    @property
    def foot(self) -> float:
        """Millimetres that names take below the dimensions."""
        return _NAMES if self.names else 0.0


def largest_scale(page: Page, units: Units) -> int:
    """The largest scale at which a page fits on its sheet, with its schedule: 50 for 1:50."""
    import numpy as np

    rows = _cells(items(page.layout), units)
    widths = _widths([(*_HEADINGS, _AREAS[units][0]), *rows])
    spots = [solid.mesh().vertices[:, :2] for solid in build_scene(page.layout).solids] + [np.zeros((1, 2))]
    (left, bottom), (right, top) = (ends(np.concatenate(spots), axis=0).tolist() for ends in (np.min, np.max))
    return lay_out(page.layout, (left, bottom, right, top), len(rows), sum(widths), foot=page.foot).scale


def sheets_pdf(whole: Layout, pages: Sequence[Page], units: Units, largest: int = 1) -> bytes:
    """Pages of one drawing, a sheet each. Marks are those of the whole; no scale is larger than `largest`."""
    from reportlab.pdfgen.canvas import Canvas

    data = BytesIO()
    canvas = Canvas(data, pagesize=(PAPER[0] * _MM, PAPER[1] * _MM), pageCompression=1, invariant=1)
    canvas.setCreator("facade_nb")
    headings = (*_HEADINGS, _AREAS[units][0])
    for number, page in enumerate(pages, 1):
        layout = page.layout
        scene = build_scene(layout)
        lines = linework(scene)
        rows = items_on(layout, whole)
        table = _cells(rows, units)
        widths = _widths([headings, *table])
        sheet = lay_out(layout, lines.bounds, len(rows), sum(widths), foot=page.foot, largest=largest)
        canvas.setTitle(f"{whole.name}, elevation 1:{sheet.scale}")
        canvas.scale(_MM, _MM)  # millimetres from here on
        pen = _Pen(canvas, sheet)
        pen.elevation(layout, lines)
        pen.marks(scene, rows)
        for axis in ("x", "y"):
            pen.chains(layout, lines, "x" if axis == "x" else "y", units)
        pen.names(page, lines)
        pen.frame()
        pen.title(
            layout, units, f"Elevation, sheet {number} of {len(pages)}" if len(pages) > 1 else "Elevation"
        )
        pen.table(headings, table, widths)
        canvas.showPage()
    canvas.save()
    return data.getvalue()


def write_pdf(layout: Layout, path: str | Path, units: str = "m") -> Path:
    """Write a layout as PDF (see `to_pdf`), atomically, and return the path.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material, or a file that cannot be written.
    ValueError
        For units other than ``m`` and ``ft``.
    """
    write_atomically(path, to_pdf(layout, units))
    return Path(path)


class _Pen:
    """What draws on the sheet, in millimetres."""

    def __init__(self, canvas: Canvas, sheet: Sheet) -> None:
        self.canvas, self.sheet = canvas, sheet

    def at(self, x: float, y: float) -> tuple[float, float]:
        """The place on paper of a point of the façade."""
        left, bottom = self.sheet.origin
        return left + x * 1000 / self.sheet.scale, bottom + y * 1000 / self.sheet.scale

    def elevation(self, layout: Layout, lines: Linework) -> None:
        canvas = self.canvas
        for surface in lines.surfaces:
            path = self._path(surface.polygon)
            material = material_of(library_of(layout), surface.material)
            share = 0.55 if material.pattern == "glass" else 0.75
            canvas.setFillColor(mix(material.fill, "#ffffff", share))
            canvas.drawPath(path, stroke=0, fill=1, fillMode=0)
        for drawn in lines.drawn:
            self._picture(library_of(layout), drawn)
        canvas.setLineJoin(0)
        canvas.setLineCap(2)
        for weight in reversed(WEIGHTS):
            if not lines.lines[weight]:
                continue
            canvas.setLineWidth(WEIGHTS[weight])
            canvas.setStrokeColor("#777777" if weight == "fine" else "#000000")
            path = canvas.beginPath()
            for line in lines.lines[weight]:
                self._trace(path, line)
            canvas.drawPath(path, stroke=1, fill=0)
        canvas.setStrokeColor("#000000")
        width, height = layout.canvas.width, layout.canvas.height
        if not lines.surfaces:
            canvas.setLineWidth(WEIGHTS["fine"])
            canvas.setDash(3, 2)
            (x, y), (right, top) = self.at(0, 0), self.at(width, height)
            canvas.rect(x, y, right - x, top - y)
            canvas.setDash()
        canvas.setLineWidth(0.7)
        (x, y), (right, _) = self.at(0, 0), self.at(width, 0)
        canvas.line(x - 3, y, right + 3, y)

    def _picture(self, library: str, drawn: Drawn) -> None:
        """A rule in the rectangle of its shape, and again beside it where more is seen; only what is seen of it."""
        canvas = self.canvas
        canvas.saveState()
        canvas.clipPath(self._path(drawn.polygon), stroke=0, fill=0, fillMode=0)
        left, bottom, right, top = drawn.rect
        wide, tall = right - left, top - bottom
        image = _image(library, drawn.material, face_size(drawn.rect))
        x0, y0, x1, y1 = drawn.polygon.bounds
        columns = range(floor((x0 - left) / wide + _HAIR), ceil((x1 - left) / wide - _HAIR))
        rows = range(floor((y0 - bottom) / tall + _HAIR), ceil((y1 - bottom) / tall - _HAIR))
        for column, row in product(columns, rows):
            (x, y), (right, top) = (
                self.at(left + (column + k) * wide, bottom + (row + k) * tall) for k in (0, 1)
            )
            canvas.drawImage(image, x, y, right - x, top - y)
        canvas.restoreState()

    def marks(self, scene: Scene, rows: tuple[Item, ...]) -> None:
        """The marks of the schedule in windows and doors that have room for them, none over another.

        Each stands where its own opening is seen, for a reader takes it for the mark of what it stands on.
        """
        tall = _SMALL + 1.0
        placed: list[tuple[float, float]] = []
        places = _mark_places(scene)
        for item in rows:
            if item.kind not in _MARKED:
                continue
            wide = _measured(item.mark, _SMALL) + 1.2
            for index in item.shapes:
                for left, bottom, right, top in places.get(index, ()):
                    (x0, y0), (x1, y1) = self.at(left, bottom), self.at(right, top)
                    if x1 - x0 < wide or y1 - y0 < tall:
                        continue
                    x, y = (x0 + x1) / 2, (y0 + y1) / 2
                    if any(abs(x - p) < wide + 1 and abs(y - q) < tall for p, q in placed):
                        continue
                    placed.append((x, y))
                    self.canvas.setFillColor("#ffffff")
                    self.canvas.roundRect(x - wide / 2, y - tall / 2, wide, tall, 0.6, stroke=0, fill=1)
                    self._text(x, y - _SMALL / 2, item.mark, _SMALL, "middle", colour="#0b4f6c")
                    break

    def chains(self, layout: Layout, lines: Linework, axis: Any, units: Units) -> None:
        """The chains of dimensions along an axis."""
        canvas, scale = self.canvas, self.sheet.scale
        across = axis == "x"
        left, bottom, _, _ = lines.bounds or (0.0, 0.0, 0.0, 0.0)
        corner = self.at(min(left, 0.0), min(bottom, 0.0))
        line = corner[1 if across else 0] - FIRST
        canvas.setStrokeColor("#000000")
        for chain in chains(layout, axis):
            spans = [tuple(self.at(stop, stop)[0 if across else 1] for stop in span) for span in chain]
            ends = list(dict.fromkeys(end for span in spans for end in span))
            canvas.setLineWidth(0.13)
            for p, q in spans:
                self._stroke(across, p, line, q, line)
            for end in ends:
                self._stroke(across, end, line - 1.0, end, line + 1.2)
            canvas.setLineWidth(0.3)
            for end in ends:
                self._stroke(across, end - 0.7, line - 0.7, end + 0.7, line + 0.7)
            for (a, b), (p, q), level in zip(chain, spans, levels(chain, scale, units), strict=True):
                if level is None:
                    continue
                canvas.saveState()
                place = line - offset(axis, level)
                canvas.translate(*((p + q) / 2, place) if across else (place, (p + q) / 2))
                if not across:
                    canvas.rotate(90)
                self._text(0, -TEXT / 2, label(b - a, units), TEXT, "middle")
                canvas.restoreState()
            line -= PITCH

    def names(self, page: Page, lines: Linework) -> None:
        """The name of each thing under its dimensions."""
        _, bottom, _, _ = lines.bounds or (0.0, 0.0, 0.0, 0.0)
        count = len(chains(page.layout, "x"))
        y = self.at(0.0, min(bottom, 0.0))[1] - FIRST - PITCH * (count - 1) - 3.0 - page.foot
        for name, start, end in page.names:
            (left, _), (right, _) = self.at(start, 0.0), self.at(end, 0.0)
            text = self._fit(name, _NAME, right - left)
            self._text((left + right) / 2, y + 1.5, text, _NAME, "middle", bold=True)

    def frame(self) -> None:
        """The frame of the sheet."""
        self.canvas.setLineWidth(0.5)
        self.canvas.rect(MARGIN - 3, MARGIN - 3, PAPER[0] - 2 * MARGIN + 6, PAPER[1] - 2 * MARGIN + 6)

    def title(self, layout: Layout, units: Units, told: str) -> None:
        """The title block: what it is, name, scale, size, units, and a date that is left to whoever signs."""
        canvas = self.canvas
        wide, tall = TITLE
        left, bottom = PAPER[0] - MARGIN - wide, MARGIN
        canvas.setFillColor("#ffffff")
        canvas.setLineWidth(0.35)
        canvas.rect(left, bottom, wide, tall, fill=1)
        canvas.line(left, bottom + 11, left + wide, bottom + 11)
        canvas.setLineWidth(0.18)
        size = (sum(b - a for a, b in ranges(layout, "x")), layout.canvas.height)
        measures = " × ".join(label(length, units) for length in size) + (" m" if units == "m" else "")
        fields = (
            ("Scale", f"1:{self.sheet.scale} (A3)", 24.0),
            ("Size", measures, 36.0),
            ("Dimensions in", "metres" if units == "m" else "feet and inches", 28.0),
            ("Date", "", 30.0),
        )
        x = left
        for name, value, column in fields:
            if x > left:
                canvas.line(x, bottom, x, bottom + 11)
            self._text(x + 1.5, bottom + 7.8, name, 1.3, colour="#555555")
            self._text(x + 1.5, bottom + 2.8, self._fit(value, 2.1, column - 3), 2.1)
            x += column
        self._text(left + 1.5, bottom + tall - 3.6, told, 1.3, colour="#555555")
        self._text(left + 1.5, bottom + 14.2, self._fit(layout.name or "-", 3.6, wide - 3), 3.6)

    def table(self, headings: tuple[str, ...], cells: list[tuple[str, ...]], widths: list[float]) -> None:
        """The schedule."""
        table: Table = self.sheet.table
        wide = sum(widths)
        kept = cells[: len(cells) - table.left_out]
        for column in range(table.columns):
            rows = kept[column * table.rows : (column + 1) * table.rows]
            left, top = table.left + column * (wide + 4.0), table.top
            if not rows and column:
                break
            self._text(
                left, top - 0.72 * ROW, "Schedule" if not column else "Schedule, continued", 2.0, bold=True
            )
            self._row(left, top - ROW, headings, widths, bold=True)
            for number, row in enumerate(rows):
                self._row(left, top - (2 + number) * ROW, row, widths)
        if table.left_out:
            y = table.top - (table.rows + 2) * ROW - 0.72 * ROW
            self._text(table.left, y, f"and {table.left_out} more rows: see the schedule's own file", _SMALL)

    def _row(
        self, left: float, top: float, row: tuple[str, ...], widths: list[float], *, bold: bool = False
    ) -> None:
        x = left
        for number, (text, wide) in enumerate(zip(row, widths, strict=True)):
            baseline = top - ROW + (ROW - _SMALL) / 2
            if number < 4:
                self._text(x + 0.6, baseline, text, _SMALL, bold=bold)
            else:
                self._text(x + wide - 0.6, baseline, text, _SMALL, "right", bold=bold)
            x += wide
        self.canvas.setLineWidth(0.25 if bold else 0.08)
        self.canvas.line(left, top - ROW, left + sum(widths), top - ROW)

    def _stroke(self, across: bool, a: float, p: float, b: float, q: float) -> None:
        self.canvas.line(*((a, p, b, q) if across else (p, a, q, b)))

    def _path(self, polygon: Any) -> Any:
        """A shapely polygon, its holes with it."""
        path = self.canvas.beginPath()
        for ring in (polygon.exterior, *polygon.interiors):
            self._trace(path, ring.coords)
        return path

    def _trace(self, path: Any, points: Any) -> None:
        first, *rest = [self.at(x, y) for x, y in points]
        closed = len(rest) > 1 and rest[-1] == first
        path.moveTo(*first)
        for point in rest[:-1] if closed else rest:
            path.lineTo(*point)
        if closed:
            path.close()

    def _text(
        self,
        x: float,
        y: float,
        text: str,
        height: float,
        align: str = "left",
        *,
        bold: bool = False,
        colour: str = "#000000",
    ) -> None:
        """A text with its baseline at y; `height` is that of a capital."""
        self.canvas.setFillColor(colour)
        self.canvas.setFont(_font(text, bold=bold), height / _CAP)
        draw = {"left": self.canvas.drawString, "right": self.canvas.drawRightString}
        draw.get(align, self.canvas.drawCentredString)(x, y, text)

    def _fit(self, text: str, height: float, wide: float) -> str:
        """The text, or as much of it as fits."""
        if _measured(text, height) <= wide:
            return text
        while text and _measured(f"{text}…", height) > wide:
            text = text[:-1]
        return f"{text}…"


def _mark_places(scene: Scene) -> dict[int, list[Rect]]:
    """Where each window and door is seen, best place first: all of it, or what later shapes leave of it."""
    import numpy as np

    solids = scene.solids
    covers = [own for own in solids if own.geometry.full or own.shape.kind in _MARKED]
    lefts, bottoms, rights, tops = np.array([own.rect for own in covers]).reshape(-1, 4).T
    numbers = np.array([own.index for own in covers])
    places: dict[int, list[Rect]] = {}
    for own in solids:
        if own.shape.kind not in _MARKED:
            continue
        left, bottom, right, top = own.rect
        over = (lefts < right) & (rights > left) & (bottoms < top) & (tops > bottom) & (numbers > own.index)
        rest = without(own.rect, [covers[k].rect for k in np.flatnonzero(over)])
        places[own.index] = sorted(rest, key=lambda r: (r[0] - r[2]) * (r[3] - r[1]))  # the largest first
    return places


@lru_cache(maxsize=64)
def _image(library: str, material: str, size: tuple[float, float]) -> ImageReader:
    """The picture of a rule, as pale as it can be and still be known, so that lines and marks are read over it."""
    import numpy as np
    from PIL import Image
    from reportlab.lib.utils import ImageReader

    pixels = rule_pixels(library, material, size, SHARP)
    pale = (255 - (255 - pixels.astype(np.float64)) * (1 - _PALE)).round().astype(np.uint8)
    return ImageReader(Image.fromarray(pale))


def _font(text: str, *, bold: bool = False) -> str:
    """A font that has all letters of a text."""
    try:
        text.encode("cp1252")
    except UnicodeEncodeError:
        from reportlab.pdfbase.cidfonts import UnicodeCIDFont
        from reportlab.pdfbase.pdfmetrics import getRegisteredFontNames, registerFont

        if _ELSEWHERE not in getRegisteredFontNames():
            registerFont(UnicodeCIDFont(_ELSEWHERE))
        return _ELSEWHERE
    return "Helvetica-Bold" if bold else "Helvetica"


def _measured(text: str, height: float, *, bold: bool = False) -> float:
    """How wide a text is, millimetres; `height` is that of a capital."""
    from reportlab.pdfbase.pdfmetrics import stringWidth

    font = _font(text, bold=bold)
    return float(stringWidth(text, font, height / _CAP))


def _cells(rows: tuple[Item, ...], units: Units) -> list[tuple[str, ...]]:
    return [
        (
            item.mark,
            _short(item.kind),
            _short(item.geometry),
            _short(item.material),
            f"{item.width:.3f}" if units == "m" else label(item.width, units),
            f"{item.height:.3f}" if units == "m" else label(item.height, units),
            str(len(item.shapes)),
            f"{item.area * _AREAS[units][1]:.2f}",
        )
        for item in rows
    ]


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= _LONGEST else f"{line[: _LONGEST - 1]}…"


def _widths(rows: list[tuple[str, ...]]) -> list[float]:
    """The widths of the schedule's columns, millimetres; the headings are bold."""
    return [
        max(_measured(text, _SMALL, bold=text == column[0]) for text in column) + 1.8
        for column in zip(*rows, strict=True)
    ]
