"""Alignment: the matrix of the paper's Eq. 8, to scale, with the columns' errors below."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ...solver.events import AxisPosed, PathChosen
from .sheet import ACCENT, MUTED, Sheet, shortened
from .timeline import timeline
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["AlignmentView"]

_LEFT, _SCALE, _RIGHT, _ROW, _NAME = 160.0, 680.0, 30.0, 26.0, 22


_LEGEND = (
    "At preferred sizes, metres. Columns between orange lines; dashed: transparent, it may be cut; ε: empty; "
    "error ω: max − min of a column (Eq. 9)."
)


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
        sheet.text(12, sheet.height, _LEGEND, fill=MUTED, size=11)
        sheet.height += 10
        return sheet.image(f"Alignments of {self.model.name}")


def _draw(sheet: Sheet, path: PathChosen, layers: tuple[str, ...], hues: dict[str, int]) -> None:
    sheet.height += 22
    sheet.text(12, sheet.height, f"{path.axis}, group {path.group}", size=13, bold=True)
    sheet.text(
        _LEFT + _SCALE,
        sheet.height,
        f"Ω = {path.error:.4g} m, W = {path.width:.4g} m",
        fill=MUTED,
        anchor="end",
    )
    edges = [0.0]
    for column in path.columns:
        edges.append(edges[-1] + column.width)
    scale = _SCALE / max(edges[-1], 1e-9)

    def below(values: Iterable[str], *, muted: bool = False) -> None:
        cells = [
            (_LEFT + edges[j] * scale, _LEFT + edges[j + 1] * scale, text) for j, text in enumerate(values)
        ]
        sheet.height = sheet.labels(cells, sheet.height, muted=muted) + 14

    sheet.height += 16
    below((str(j + 1) for j in range(len(path.columns))), muted=True)
    sheet.height -= 6
    top = sheet.height
    rows = sorted((row, band) for band in path.bands for row in band.rows)
    for row, band in rows:
        b = path.bands.index(band)
        if row < len(layers):
            sheet.text(_LEFT - 10, sheet.height + 17, shortened(layers[row], _NAME), anchor="end")
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
    sheet.text(_LEFT - 10, sheet.height, "size", fill=MUTED, anchor="end")
    below(f"{column.width:.3g}" for column in path.columns)
    sheet.text(_LEFT - 10, sheet.height, "error ω", fill=MUTED, anchor="end")
    below(f"{column.omega:.2g}" for column in path.columns)
