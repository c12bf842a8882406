"""Alignment: the matrix of the paper's Eq. 8, to scale, with the columns' errors below."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...solver.events import AxisPosed, PathChosen
from .sheet import ACCENT, MUTED, Sheet
from .timeline import timeline
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["AlignmentView"]

_LEFT, _SCALE, _RIGHT, _ROW = 120.0, 620.0, 60.0, 26.0


class AlignmentView(TraceView):
    """Every group's words in columns. Its boundaries can be dragged: the page judges what the reader tries."""

    _shows = "alignment"
    _needs = ("alignment", "placing")

    @property
    def frame(self) -> pd.DataFrame:
        """Elements of the chosen alignments, a line each: `Trace.path`."""
        return self.model.trace.path()

    def to_html(self) -> str:
        """Every group's matrix at preferred sizes."""
        trace = self.model.trace
        hues: dict[str, int] = timeline(trace)["symbols"]
        layers = {
            (posed.axis, group.name): group.layers
            for posed in trace.of_kind(AxisPosed)
            for group in posed.groups
        }
        sheet = Sheet(_LEFT + _SCALE + _RIGHT)
        for path in trace.of_kind(PathChosen):
            _draw(sheet, path, layers.get((path.axis, path.group), ()), hues)
        return sheet.image(f"Alignments of {self.model.name}")


def _draw(sheet: Sheet, path: PathChosen, layers: tuple[str, ...], hues: dict[str, int]) -> None:
    sheet.height += 22
    sheet.text(12, sheet.height, f"{path.axis}: {path.group}", size=13, bold=True)
    sheet.text(
        _LEFT + _SCALE,
        sheet.height,
        f"Ω = {path.error:.4g} m, W = {path.width:.4g} m",
        fill=MUTED,
        anchor="end",
    )
    sheet.height += 8
    top = sheet.height
    edges = [0.0]
    for column in path.columns:
        edges.append(edges[-1] + column.width)
    scale = _SCALE / max(edges[-1], 1e-9)
    rows = sorted((row, band) for band in path.bands for row in band.rows)
    for row, band in rows:
        b = path.bands.index(band)
        if row < len(layers):
            sheet.text(_LEFT - 10, sheet.height + 17, layers[row][:16], anchor="end")
        for j, column in enumerate(path.columns):
            at, sizes = edges[j], column.sizes[b]
            if not sizes:
                sheet.text(
                    _LEFT + (edges[j] + edges[j + 1]) / 2 * scale,
                    sheet.height + 17,
                    "ε",
                    fill=MUTED,
                    anchor="middle",
                )
            for n, size in zip(column.letters[b], sizes, strict=True):
                letter = band.letters[n]
                sheet.letter(
                    _LEFT + at * scale,
                    sheet.height + 3,
                    size * scale,
                    _ROW - 6,
                    letter,
                    hues.get(letter.symbol, 0),
                )
                at += size
        sheet.height += _ROW
    for edge in edges:
        sheet.line(_LEFT + edge * scale, top, _LEFT + edge * scale, sheet.height, stroke=ACCENT)
    sheet.height += 14
    sheet.text(_LEFT - 10, sheet.height, "error ω", fill=MUTED, anchor="end")
    for j, column in enumerate(path.columns):
        if column.width * scale >= 20:
            middle = _LEFT + (edges[j] + edges[j + 1]) / 2 * scale
            sheet.text(middle, sheet.height, f"{column.omega:.2g}", size=11, anchor="middle")
    sheet.height += 10
