"""Network: the alignment decision network, as the paper's Figure 8 draws it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...solver.events import BandNote, PathChosen
from ...solver.trace.lattice import Lattice
from .sheet import ARC, MUTED, PATH, STEP, Sheet, table
from .timeline import timeline
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["NetworkView"]

_MOST, _DOTS = 80, 700
"""So many nodes of whole letters are drawn with suffixes, or with dots; of a larger network the path is listed."""
_ARCS = 60
_CELL, _ROW, _LEFT = 104.0, 58.0, 66.0
_SMALL, _LETTER = 34.0, 20.0


class NetworkView(TraceView):
    """The alignment decision network: states, steps and weighted arcs, and the path that was chosen."""

    _shows = "network"
    _needs = ("network",)

    @property
    def frame(self) -> pd.DataFrame:
        """Columns that the search weighed and refused: `Trace.edges`."""
        return self.model.trace.edges()

    def to_html(self) -> str:
        """Small networks of two words as Figure 8 has them, larger ones with dots; of others, the path."""
        trace = self.model.trace
        sheet = Sheet(0)
        hues: dict[str, int] = timeline(trace)["symbols"]
        listed: list[tuple[str, ...]] = []
        for path in trace.of_kind(PathChosen):
            bands = path.bands
            nodes = 1
            for band in bands:
                nodes *= len(band.letters) + 1
            if len(bands) == 2 and nodes <= _MOST:
                _draw(sheet, path, trace.lattice(path.axis, path.group))
            elif len(bands) == 2 and nodes <= _DOTS:
                _draw_small(sheet, path, hues)
            else:
                listed += _listed(path)
        name = self.model.name
        drawn = sheet.image(f"Networks of {name}") if sheet.width else ""
        head = ("group", "column", "letters", "ω, m", "width, m")
        return drawn + (table(f"Paths through the networks of {name}", head, listed) if listed else "")


def _draw(sheet: Sheet, path: PathChosen, lattice: Lattice) -> None:
    down, right = path.bands
    sheet.width = max(sheet.width, _LEFT + _CELL * len(right.letters) + 90)
    sheet.height += 20
    size = f"{len(down.letters) + 1} × {len(right.letters) + 1} nodes"
    title = f"{path.axis}, group {path.group}: {size}, Ω = {path.error:.4g} m"
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
    shortest = sorted(permitted, key=lambda own: (sum(own[1]) - sum(own[0]), own))[:_ARCS]
    for start, end in shortest:
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
    arcs = "arcs of its closure" if len(permitted) <= _ARCS else "the shortest arcs of its closure"
    legend = f"orange: steps of the automaton; blue: {arcs}; red: the path, with ω in metres"
    sheet.text(12, sheet.height - 8, legend, fill=MUTED, size=11)


def _draw_small(sheet: Sheet, path: PathChosen, hues: dict[str, int]) -> None:
    """Dots for nodes, the words along the edges, the path with its weights."""
    down, right = path.bands
    step = _SMALL * 0.7
    left = 44.0
    sheet.width = max(sheet.width, left + _SMALL * len(right.letters) + 60)
    sheet.height += 20
    size = f"{len(down.letters) + 1} × {len(right.letters) + 1} nodes"
    title = f"{path.axis}, group {path.group}: {size}, Ω = {path.error:.4g} m"
    sheet.text(12, sheet.height, title, size=13, bold=True)
    top = sheet.height + 48

    def at(down_place: int, right_place: int) -> tuple[float, float]:
        return left + _SMALL * right_place / 2, top + step * down_place / 2

    for j, letter in enumerate(right.letters):
        x, _ = at(0, 2 * j + 1)
        sheet.letter(x - _LETTER / 2, top - 38, _LETTER, _LETTER, letter, hues.get(letter.symbol, 0))
    for i, letter in enumerate(down.letters):
        _, y = at(2 * i + 1, 0)
        sheet.letter(left - 34, y - 8, _LETTER, 16, letter, hues.get(letter.symbol, 0))
    end = at(2 * len(down.letters), 2 * len(right.letters))
    for i in range(len(down.letters) + 1):
        sheet.line(left, top + step * i, end[0], top + step * i, stroke=STEP)
    for j in range(len(right.letters) + 1):
        sheet.line(left + _SMALL * j, top, left + _SMALL * j, end[1], stroke=STEP)
    for i in range(len(down.letters) + 1):
        for j in range(len(right.letters) + 1):
            sheet.dot(*at(2 * i, 2 * j), 3)
    before, weights = (0, 0), []
    for column in path.columns:
        after = (column.after[0], column.after[1])
        middle = sheet.arc(*at(*before), *at(*after), stroke=PATH, width=3)
        weights.append((middle, f"{column.omega:.2g}"))
        before = after
    for (x, y), text in weights:
        sheet.badge(x, y, text, stroke=PATH)
    sheet.height = end[1] + 30
    sheet.text(
        12, sheet.height - 6,
        "dots: what is left of both words; orange: steps of the automaton; red: the path, with ω in metres",
        fill=MUTED, size=11,
    )  # fmt: skip


def _rest(band: BandNote, n: int) -> str:
    text = "".join(letter.symbol + "′" * letter.mirrored for letter in band.letters[n:]) or "ε"
    return text if len(text) <= 8 else f"{text[:7]}…"


def _listed(path: PathChosen) -> list[tuple[str, ...]]:
    """A line for each column of the path; a word alone has one line: nothing is decided in it."""
    group = f"{path.axis}, group {path.group}"
    if len(path.bands) == 1:
        letters = " ".join(letter.symbol for letter in path.bands[0].letters) or "ε"
        return [(group, f"1 to {len(path.columns)}", letters, f"{path.error:.3g}", f"{path.width:.4g}")]
    return [
        (
            group,
            f"{j + 1}",
            " / ".join(
                "".join(band.letters[i].symbol for i in own) or "ε"
                for band, own in zip(path.bands, column.letters, strict=True)
            ),
            f"{column.omega:.3g}",
            f"{column.width:.4g}",
        )
        for j, column in enumerate(path.columns)
    ]
