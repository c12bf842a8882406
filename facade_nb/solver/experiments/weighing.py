"""An alignment that somebody has made up, weighed column by column: the ledger of its J."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from html import escape

from ..alignment.bands import Band
from ..alignment.elements import Option
from ..alignment.group import Group
from ..alignment.pricing import price
from ..alignment.rules import broken, tally
from ..alignment.rules import price as column_price
from ..model.objective import Objective
from .cases import Case
from .views import spelled

__all__ = ["Weighed", "WeighedColumn", "weigh"]

_WHY = {
    "empty": "takes nothing from any word",
    "boundary": "begins where no letter does",
    "C1": "has nothing in it that is opaque throughout (C1)",
    "C3": "covers an unoccludable letter with one that is not opaque (C3)",
}


@dataclass(frozen=True, slots=True)
class WeighedColumn:
    """A column and what it costs, metres: its sizes (None: ε), ω, E and Λ, and the sum at their prices."""

    text: str
    sizes: tuple[float | None, ...]
    omega: float
    empty: float
    loose: float
    cost: float


@dataclass(frozen=True, slots=True)
class Weighed:
    """An alignment, weighed.

    Attributes
    ----------
    columns
        From left to right; empty where the text is no alignment of the words.
    faults
        What is wrong with it, in sentences. An alignment that has any is none that the solver may take.
    omega, empty, loose
        Ω, and E and Λ of all columns, metres.
    width, canvas
        W and the canvas, metres.
    cost
        J, metres.
    """

    columns: tuple[WeighedColumn, ...]
    faults: tuple[str, ...]
    omega: float = 0.0
    empty: float = 0.0
    loose: float = 0.0
    width: float = 0.0
    canvas: float = 0.0
    cost: float = 0.0

    def _rows(self) -> list[tuple[str, ...]]:
        rows: list[tuple[str, ...]] = [("column", "sizes", "ω", "E", "Λ", "cost")]
        for own in self.columns:
            sizes = " / ".join("ε" if size is None else f"{size:.3g}" for size in own.sizes)
            rows.append((own.text, sizes, *(f"{x:.3f}" for x in (own.omega, own.empty, own.loose, own.cost))))
        if self.columns:
            rows.append(
                (f"|W − canvas| = |{self.width:.4g} − {self.canvas:.4g}|", "", "", "", "", f"{self._fit:.3f}")
            )
            total = (f"{x:.3f}" for x in (self.omega, self.empty, self.loose, self.cost))
            rows.append(("together", "", *total))
        return rows

    @property
    def _fit(self) -> float:
        return self.cost - sum(own.cost for own in self.columns)

    def __str__(self) -> str:
        rows = self._rows() if self.columns else []
        wide = [max(len(row[k]) for row in rows) for k in range(6)] if rows else []
        lines = ["  ".join(cell.ljust(w) for cell, w in zip(row, wide, strict=True)).rstrip() for row in rows]
        return "\n".join([*lines, *self.faults])

    __repr__ = __str__

    def _repr_html_(self) -> str:
        rows = self._rows() if self.columns else []
        cells = [
            "<tr>" + "".join(f"<td style='text-align: left'>{escape(cell)}</td>" for cell in row) + "</tr>"
            for row in rows
        ]
        table = f"<table>{''.join(cells)}</table>" if cells else ""
        return table + "".join(f"<p>✗ {escape(fault)}</p>" for fault in self.faults)


def weigh(case: Case, text: str, objective: Objective | None = None) -> Weighed:
    """Weigh an alignment: its columns from left to right, each from the top, as in ``"C/A | e/BAB | C/ε"``.

    A placeholder that stands in several columns one after the other is cut.
    """
    group = replace(case, tolerance=1e6).group(
        objective or Objective()
    )  # what is beyond μ is weighed, too, and told
    columns = [
        [own.replace(" ", "").replace("ε", "") for own in column.split("/")] for column in text.split("|")
    ]
    for n, column in enumerate(columns, 1):
        if len(column) != len(case.words):
            return Weighed(
                (), (f"Column {n} has {len(column)} elements; there are {len(case.words)} words.",)
            )
    rows: list[list[Option]] = []
    for band in group.bands:
        given = [column[band.rows[0]] for column in columns]
        read = _read(band, given)
        if read is None:
            return Weighed((), (_unread(band, given, band.rows[0]),))
        rows.append(read)
        for other in band.rows[1:]:
            if [column[other] for column in columns] != given:
                return Weighed(
                    (), (f"Words {band.rows[0] + 1} and {other + 1} are equal, and have to be cut alike.",)
                )
    return _weighed(case, group, tuple(zip(*rows, strict=True)))


def _weighed(case: Case, group: Group, structure: tuple[tuple[Option, ...], ...]) -> Weighed:
    faults: list[str] = []
    owed = False
    for n, column in enumerate(structure, 1):
        why = broken(group, owed, column)
        if why in _WHY:
            faults.append(f"Column {n} {_WHY[why]}.")
        owed = not any(option.ends for option in column)
    priced = price([group], (structure,))
    assert priced is not None, "any sizes are within that tolerance"
    out: list[WeighedColumn] = []
    share = group.share
    for column, parts in zip(structure, priced.pieces[0], strict=True):
        own = tally(group, column, [sum(part) for part in parts])
        letters = [
            spelled(tuple([band.letters[i] for i in option.letters]))
            for band, option in zip(group.bands, column, strict=True)
        ]
        out.append(
            WeighedColumn(
                " / ".join(letters),
                tuple([None if o.empty else sum(part) for o, part in zip(column, parts, strict=True)]),
                own.omega,
                share * own.empties * own.high,
                share * (own.loose + own.softs * own.high - own.soft_sizes),
                column_price(group, own, own.omega),
            )
        )
    for n, line in enumerate(out, 1):
        if line.omega > case.tolerance + 1e-6:
            faults.append(f"Column {n} errs by {line.omega:.4g} m; μ is {case.tolerance:g} m.")
    if abs(priced.widths[0] - case.canvas) > case.tolerance + 1e-6:
        faults.append(
            f"W is {priced.widths[0]:.4g} m; the canvas is {case.canvas:g} m, and μ {case.tolerance:g} m."
        )
    return Weighed(
        tuple(out),
        tuple(faults),
        sum(own.omega for own in out),
        sum(own.empty for own in out),
        sum(own.loose for own in out),
        priced.widths[0],
        case.canvas,
        priced.cost,
    )


def _read(band: Band, given: Sequence[str]) -> list[Option] | None:
    """The elements of a word as they are given; None where the word cannot be read like that."""

    def go(n: int, position: int) -> list[Option] | None:
        if n == len(given):
            return [] if position >> 2 == band.end >> 2 else None
        for option in band.options(position):
            if "".join(band.letters[i].symbol for i in option.letters) == given[n]:
                rest = go(n + 1, option.target)
                if rest is not None:
                    return [option, *rest]
        return None

    return go(0, 0)


def _unread(band: Band, given: Sequence[str], row: int) -> str:
    """Why a word cannot be read as it is given."""
    word = "".join(a.symbol for a in band.letters)
    text = "".join(given)
    seen = {a.symbol: a.transparent for a in band.letters}
    whole = "".join(c for n, c in enumerate(text) if n == 0 or c != text[n - 1] or not seen.get(c))
    if word not in (text, whole):
        return f"Word {row + 1} is {word}; these columns take {text or 'nothing'} from it."
    for n, element in enumerate(given, 1):
        if len({seen.get(c) for c in element}) > 1:
            return f"Column {n} puts {element} into one element: placeholders and others do not go together (C2)."
    cut = " | ".join(own or "ε" for own in given)
    why = "an attached letter forbids a gap (C4), or its placeholders are whole"
    return f"Word {row + 1} cannot be cut into {cut}: {why}."
