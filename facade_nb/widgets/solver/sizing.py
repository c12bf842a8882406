"""Sizing: the least-squares system, its objective and its forces (the paper's 5.3, the supplement's Figure 7)."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from ...solver import Trace
from ...solver.events import AxisPosed, LetterPlaced, PathChosen, SystemPosed, SystemSolved
from .sheet import ACCENT, ARC, MUTED, PATH, Sheet, shortened, table
from .timeline import timeline
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["SizingView", "forces", "said"]

_ROWS = 60
_TINY = 1e-6
_LEFT, _SCALE, _RIGHT, _NAME = 160.0, 680.0, 60.0, 22
_BEFORE, _AFTER, _ARROW = 7.0, 20.0, 20.0
_LEGEND = (
    "Above each word, thin: before, at preferred sizes. Orange lines: the canvas. Blue: the letter is stretched and "
    "pulls; red: it is squeezed and pushes."
)


class SizingView(TraceView):
    """The system as a matrix with an equation on every line, the active set, multipliers as forces."""

    _shows = "sizing"
    _needs = ("sizing", "alignment")

    @property
    def frame(self) -> pd.DataFrame:
        """Bounds and rows of the system with their multipliers: `Trace.equations`."""
        return self.model.trace.equations()

    def to_html(self) -> str:
        """The words before and after with their forces; tables of the sizes, and of the system's equations."""
        trace, name = self.model.trace, self.model.name
        solved = {e.axis: e for e in trace.of_kind(SystemSolved)}
        sheet = Sheet(_LEFT + _SCALE + _RIGHT)
        sizes, rows, slack = [], [], 0
        for posed in trace.of_kind(SystemPosed):
            answer = solved.get(posed.axis)
            if answer is not None:
                _draw(sheet, trace, posed, answer)
            sizes += _sizes(posed, answer)
            own = _rows(posed, answer, [path.group for path in trace.of_kind(PathChosen, posed.axis)])
            rows += own
            slack += len(posed.rows) - len(own)
        sheet.text(12, sheet.height + 4, _LEGEND, fill=MUTED, size=11)
        sheet.height += 14
        left = len(rows) - _ROWS
        shown = rows[:_ROWS] + ([("", f"… {left} more", "", "")] if left > 0 else [])
        drawn = sheet.image(f"Words of {name} before and after sizing") if solved else ""
        head = ("axis", "symbol", "preferred, m", "solved, m", "squared, m²")
        rest = f" (of {slack} inequalities that pull at nothing none is listed)" if slack else ""
        return (
            drawn
            + table(f"Sizes of {name}", head, sizes)
            + table(
                f"The least-squares system of {name}: i-j-k is word, column, letter, from s to t{rest}",
                ("axis", "row", "kind", "multiplier"),
                shown,
            )
        )


def _draw(sheet: Sheet, trace: Trace, posed: SystemPosed, answer: SystemSolved) -> None:
    axis = posed.axis
    hues: dict[str, int] = timeline(trace)["symbols"]
    layers = {group.name: group.layers for own in trace.of_kind(AxisPosed, axis) for group in own.groups}
    paths = trace.of_kind(PathChosen, axis)
    letters = trace.of_kind(LetterPlaced, axis)
    canvas = max((e.end for e in letters), default=1.0)
    scale = _SCALE / canvas
    pulls = forces(posed, answer)
    largest = max((abs(force) for force in pulls.values()), default=0.0)
    top = sheet.height
    for g, path in enumerate(paths):
        sheet.height += 20
        sheet.text(12, sheet.height, f"{axis}, group {path.group}", size=13, bold=True)
        sheet.height += 8
        for b, band in enumerate(path.bands):
            y, names = sheet.height, layers.get(path.group, ())
            layer = names[band.rows[0]] if band.rows[0] < len(names) else ""
            sheet.text(_LEFT - 10, y + _BEFORE + 15, shortened(layer, _NAME), anchor="end")
            at = 0.0
            for n, letter in enumerate(band.letters):
                size = letter.size
                if size is None:
                    size = sum(
                        piece
                        for column in path.columns
                        for own, piece in zip(column.letters[b], column.sizes[b], strict=True)
                        if own == n
                    )
                hue = hues.get(letter.symbol, 0)
                sheet.letter(_LEFT + at * scale, y, size * scale, _BEFORE, letter, hue, dim=True, named=False)
                at += size
            y += _BEFORE + 2
            for e in letters:
                if e.group != path.group or e.layer != layer:
                    continue
                x0, x1 = _LEFT + e.start * scale, _LEFT + e.end * scale
                sheet.letter(x0, y, x1 - x0, _AFTER, band.letters[e.letter], hues.get(e.symbol, 0))
                force = pulls.get((g, b, e.column, e.place), 0.0)
                if abs(force) > _TINY:
                    _arrows(sheet, x0, x1, y + _AFTER + 5, force / largest)
            sheet.height = y + _AFTER + 14
    for x in (_LEFT, _LEFT + _SCALE):
        sheet.line(x, top + 24, x, sheet.height - 4, stroke=ACCENT, dash="3 3")


def _arrows(sheet: Sheet, x0: float, x1: float, y: float, force: float) -> None:
    """What a letter does to its ends: inwards where it pulls, outwards where it pushes."""
    long = min(max(5.0, _ARROW * abs(force)), max(4.0, (x1 - x0) / 2 - 1))
    if force > 0:
        sheet.arrow(x0, x0 + long, y, stroke=ARC)
        sheet.arrow(x1, x1 - long, y, stroke=ARC)
    else:
        sheet.arrow(x0 + long, x0, y, stroke=PATH)
        sheet.arrow(x1 - long, x1, y, stroke=PATH)


_PLACE = re.compile(r"(\d+):(\d+)-(\d+)-(\d+)")


def forces(posed: SystemPosed, answer: SystemSolved) -> Mapping[tuple[int, ...], float]:
    """The multiplier of the row that gives a letter its size, by group, band, column and place."""
    n = len(posed.variables)
    return {
        tuple(map(int, place)): answer.multipliers[n + r]
        for r, row in enumerate(posed.rows)
        if row.endswith("|")
        for place in _PLACE.findall(row)
    }


def _sizes(posed: SystemPosed, answer: SystemSolved | None) -> list[tuple[str, ...]]:
    out: list[tuple[str, ...]] = []
    for v, meaning in enumerate(posed.meaning):
        if meaning.kind != "size":
            continue
        value = answer.placed[v] if answer else posed.target[v]
        counts = posed.weight[v] > 0
        squared = f"{(value - posed.target[v]) ** 2:.2g}" if counts and answer else ""
        wanted = f"{posed.target[v]:.4g}" if counts else "free"
        out.append((posed.axis, meaning.symbol, wanted, f"{value:.4g}" if answer else "", squared))
    return out


def _rows(posed: SystemPosed, answer: SystemSolved | None, groups: Sequence[str]) -> list[tuple[str, ...]]:
    """The equations, and the inequalities that pull at something."""
    out: list[tuple[str, ...]] = []
    n = len(posed.variables)
    for r, row in enumerate(posed.rows):
        force = answer.multipliers[n + r] if answer else 0.0
        equal = posed.lower[n + r] == posed.upper[n + r]
        if not equal and abs(force) <= _TINY:
            continue
        told = f"{force:.3g}" if abs(force) > _TINY else "0" if answer else ""
        out.append((posed.axis, said(row, groups), "=" if equal else "≤", told))
    return sorted(out, key=lambda own: own[2] != "=")


def said(row: str, groups: Sequence[str]) -> str:
    """A row of the system as the view in the page has it: ``i-j-k`` counts from 1, and groups have their names."""
    places = [(int(g), "-".join(str(int(n) + 1) for n in ijk)) for g, *ijk in _PLACE.findall(row)]
    group = places[0][0] if places else int(found[1]) if (found := re.match(r"(\d+):", row)) else -1
    name = f"{groups[group]}: " if len(groups) > 1 and 0 <= group < len(groups) else ""
    letters = [ijk for _, ijk in places]
    if row.startswith("extent of"):
        return f"extent of the content of {row[10:].split(' = ', maxsplit=1)[0]} = {row.split(' = ')[1]}"
    if row.endswith("|"):
        spans = [f"{ijk}.t − {ijk}.s" for ijk in letters]
        if len(spans) > 1:
            spans = [f"({span})" for span in spans]
        if len(spans) > 3:
            spans = [*spans[:2], "…", spans[-1]]
        return f"{name}{' + '.join(spans)} = {row.split(' = ')[1]}"
    if not letters:
        left, right = re.findall(r"\d+:(\d+)", row)
        return f"{name}x{left} < x{right}"
    if "gaps equal" in row:
        return f"{name}γ before {letters[0]} = γ after it"
    if "gap" in row:
        return f"{name}γ {'before' if 'before' in row else 'after'} {letters[0]} ≥ 0"
    return f"{name}{letters[0]}.s < {letters[0]}.t"
