"""Network: the alignment decision network, as the paper's Figure 8 draws it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...solver.events import BandNote, PathChosen
from ...solver.tracing.lattice import Lattice
from .sheet import ARC, MUTED, PATH, STEP, Sheet, table
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["NetworkView"]

_MOST = 200
"""A network of so many nodes of whole letters is drawn in the static form; of a larger one, its path is listed."""
_ARCS = 60
_CELL, _ROW, _LEFT = 104.0, 58.0, 66.0


class NetworkView(TraceView):
    """States as suffixes of the words, the automaton's steps, the closure's arcs with their weights, the path."""

    _shows = "network"
    _needs = ("network",)

    @property
    def frame(self) -> pd.DataFrame:
        """Columns that the search weighed and refused: `Trace.edges`."""
        return self.model.trace.edges()

    def to_html(self) -> str:
        """Small networks of two words drawn as Figure 8 is; of the others, the edges of the path."""
        trace = self.model.trace
        sheet = Sheet(0)
        listed: list[tuple[str, ...]] = []
        for path in trace.of_kind(PathChosen):
            bands = path.bands
            nodes = 1
            for band in bands:
                nodes *= len(band.letters) + 1
            if len(bands) == 2 and nodes <= _MOST:
                _draw(sheet, path, trace.lattice(path.axis, path.group))
            else:
                listed += _listed(path)
        name = self.model.name
        drawn = sheet.image(f"Networks of {name}") if sheet.width else ""
        head = ("group", "column", "from", "letters", "ω", "width")
        return drawn + (table(f"Paths through the networks of {name}", head, listed) if listed else "")


def _draw(sheet: Sheet, path: PathChosen, lattice: Lattice) -> None:
    down, right = path.bands
    sheet.width = max(sheet.width, _LEFT + _CELL * len(right.letters) + 90)
    sheet.height += 20
    size = f"{len(down.letters) + 1} × {len(right.letters) + 1} nodes"
    title = f"{path.axis}: {path.group}, {size}, Ω = {path.error:.4g} m"
    sheet.text(12, sheet.height, title, size=13, bold=True)
    top = sheet.height + 40

    def at(places: tuple[int, ...]) -> tuple[float, float]:
        return _LEFT + _CELL * places[1] / 2, top + _ROW * places[0] / 2

    last = at((2 * len(down.letters), 2 * len(right.letters)))
    for i in range(len(down.letters) + 1):
        sheet.line(_LEFT, top + _ROW * i, last[0], top + _ROW * i, stroke=STEP)
    for j in range(len(right.letters) + 1):
        sheet.line(_LEFT + _CELL * j, top, _LEFT + _CELL * j, last[1], stroke=STEP)
    permitted = {
        (lattice.nodes[e.source].places, lattice.nodes[e.target].places)
        for e in lattice.edges
        if e.constraint is None and lattice.nodes[e.source].reachable and lattice.nodes[e.target].alive
    }
    for start, end in sorted(permitted)[:_ARCS]:
        sheet.arc(*at(start), *at(end), stroke=ARC)
    before: tuple[int, ...] = (0, 0)
    weights = []
    for column in path.columns:
        middle = sheet.arc(*at(before), *at(column.after), stroke=PATH, width=3)
        weights.append((middle, f"{column.omega:.3g}"))
        before = column.after
    for i in range(len(down.letters) + 1):
        for j in range(len(right.letters) + 1):
            x, y = at((2 * i, 2 * j))
            sheet.node(x, y, 66, 32, (_rest(down, i), _rest(right, j)))
    for (x, y), text in weights:
        sheet.badge(x, y, text, stroke=PATH)
    sheet.height = last[1] + 44
    sheet.text(
        12, sheet.height - 8, "orange: steps of the automaton; blue: arcs of its closure; red: the path, with ω",
        fill=MUTED, size=11,
    )  # fmt: skip


def _rest(band: BandNote, n: int) -> str:
    text = "".join(letter.symbol + "′" * letter.mirrored for letter in band.letters[n:]) or "ε"
    return text if len(text) <= 8 else f"{text[:7]}…"


def _listed(path: PathChosen) -> list[tuple[str, ...]]:
    rows: list[tuple[str, ...]] = []
    before: tuple[int, ...] = tuple(0 for _ in path.bands)
    for j, column in enumerate(path.columns):
        letters = " / ".join(
            "".join(band.letters[i].symbol for i in own) or "ε"
            for band, own in zip(path.bands, column.letters, strict=True)
        )
        where = "/".join(f"{place / 2:g}" for place in before)
        rows.append(
            (
                f"{path.axis}: {path.group}",
                f"{j + 1}",
                where,
                letters,
                f"{column.omega:.3g}",
                f"{column.width:.4g}",
            )
        )
        before = column.after
    return rows
