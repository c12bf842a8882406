"""Aligning given words: one candidate of one group (the paper's 5.2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import isfinite

from ...design.errors import NoLayout
from .. import tuning
from ..budget import Stopped
from ..effort import Effort
from ..model.letters import Letter
from ..model.objective import Objective
from .core.instances import session
from .core.search import search_best
from .found import Found
from .group import Group, make_group
from .lone import lone
from .paper.deepening import Ends
from .paper.ida import search_ida
from .pricing import Priced

__all__ = ["SEARCHES", "Alignment", "Element", "align", "alignment_of"]

Element = tuple[Letter, ...]
SEARCHES = ("best", "ida")


@dataclass(frozen=True, slots=True)
class Alignment:
    """Words cut into columns (the matrix of the paper's Eq. 8).

    Attributes
    ----------
    columns
        Per column, per row (topmost first): the letters in it; a piece of a cut letter, and an unsized
        letter, has the size that makes the objective least. An empty tuple is ε.
    error
        Ω = Σ ω_j, metres (Eq. 9, or its variant for non-opaque rows under the default objective).
    cost
        J under the objective; Ω under the paper's.
    width
        W = Σ_j of the largest row size.
    proven, gap
        Whether it is known that no alignment costs less. Where it is not, `gap` is the cost minus a lower bound
        of what any alignment costs.
    """

    columns: tuple[tuple[Element, ...], ...]
    error: float
    cost: float
    width: float
    proven: bool = True
    gap: float = 0.0

    def __str__(self) -> str:
        return " | ".join("/".join(" ".join(map(str, e)) or "ε" for e in column) for column in self.columns)


def align(
    rows: Sequence[Sequence[Letter]],
    canvas: float = 12.0,
    tolerance: float = 0.0,
    objective: Objective | None = None,
    search: str = "ida",
    cuts: bool = True,
) -> Alignment | None:
    """Best alignment of the given words, topmost first.

    Parameters
    ----------
    rows
        Words, topmost row first. A letter without a size gets the size that makes the objective least; all
        letters of a symbol get the same size.
    canvas, tolerance
        Metres: ω_j ≤ tolerance and |W − canvas| ≤ tolerance.
    objective
        Default `Objective.paper()`.
    search
        ``"ida"``, the paper's, or ``"best"``. Both return the same cost and number of columns. The one asked
        for begins. After some thousand partial alignments the two take turns, because rows that are slow for
        one are mostly quick for the other.
    cuts
        Whether transparent letters may be cut.

    Returns
    -------
    The alignment, or None where no alignment meets the constraints within the tolerance. If neither search has
    come to an end after a million partial alignments, it is the best one found so far, and `proven` is False.

    Raises
    ------
    ValueError
        For an unknown search, sizes that are not finite and positive, or a solid letter without a size.
    NoLayout
        If the search ran out of memory or of steps before it found one.
    """
    if search not in SEARCHES:
        raise ValueError(f"search: expected one of {', '.join(SEARCHES)}; found {search!r}")
    for i, row in enumerate(rows):
        for k, letter in enumerate(row):
            if letter.size is None and not letter.transparent:
                raise ValueError(f"rows[{i}][{k}]: {letter} is solid and needs a size")
            if letter.size is not None and not (isfinite(letter.size) and letter.size > 0):
                raise ValueError(f"rows[{i}][{k}]: expected a positive size, found {letter.size!r}")
    if not isfinite(canvas) or canvas < 0 or not tolerance >= 0:
        raise ValueError(f"expected canvas ≥ 0 and tolerance ≥ 0, found {canvas!r} and {tolerance!r}")
    if not any(rows):
        return Alignment((), 0.0, 0.0, 0.0) if canvas <= tolerance else None
    group = make_group(
        rows, canvas, tolerance, Objective.paper() if objective is None else objective, cuts=cuts
    )
    with session():
        found = lone([group]) or _searched(group, search)
    if found.cut and found.best is None:
        letters = " and ".join(str(len(word)) for word in dict.fromkeys(map(tuple, rows)))
        raise NoLayout(
            f"The alignment of words of {letters} letters takes more memory than it may, or too many steps; "
            "shorter words, a smaller tolerance, or Objective(), which is not degenerate, would do.",
            constraint="memory",
        )
    if found.best is None:
        return None
    best = alignment_of(group, found.best, 0)
    return replace(best, proven=False, gap=max(0.0, found.best.cost - found.bound)) if found.cut else best


def _searched(group: Group, first: str) -> Found:
    """What one of the searches finds first, as they take turns; or the best that both have come upon."""
    second = next(own for own in SEARCHES if own != first)
    best = Found(cut=True)
    ends: Ends | None = None
    for turn in zip(tuning.ALIGN_TURNS[first], tuning.ALIGN_TURNS[second], strict=True):
        check = Effort(call=tuning.ALIGN_PATH)
        for search, nodes in zip((first, second), turn, strict=True):
            try:
                if search == "ida":
                    ends = ends or Ends([group], check)
                    found = search_ida([group], keep=1, nodes=nodes, check=check, ends=ends)
                else:
                    found = search_best([group], keep=1, nodes=nodes, check=check)
            except Stopped:  # out of memory, or time
                found = Found(cut=True)
            if not found.cut:
                return found
            best.bound = max(best.bound, found.bound)
            for priced in found.ties:
                best.offer(priced, 1)
            # the second one may take twice as long as the first one took
            check = Effort(call=tuning.ALIGN_PATH, most=max(1.0, 2.0 * check.seconds))
    return best


def alignment_of(group: Group, priced: Priced, index: int) -> Alignment:
    """The matrix of one group of a priced structure, with every row of equal words written out."""
    columns: list[tuple[Element, ...]] = []
    for column, sizes in zip(priced.structure[index], priced.pieces[index], strict=True):
        elements = [
            tuple(replace(band.letters[i], size=size) for i, size in zip(option.letters, own, strict=True))
            for band, option, own in zip(group.bands, column, sizes, strict=True)
        ]
        columns.append(tuple(elements[b] for b in group.band_of))
    cost = priced.cost if len(priced.structure) == 1 else priced.omegas[index]
    return Alignment(tuple(columns), priced.omegas[index], cost, priced.widths[index])
