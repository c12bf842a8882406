"""What an experiment says: two runs side by side, whether the answer is still the best there is, and if not, why."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from math import inf

from ..alignment.single import Alignment
from ..model.layout import Layout
from ..model.precision import EPS
from .views import Visit

__all__ = ["Counterexample", "Experiment", "Run"]


@dataclass(frozen=True, slots=True)
class Run:
    """One run of one case, or of one axis of a design.

    Attributes
    ----------
    axis
        ``"x"`` or ``"y"``; empty for a `Case`.
    nodes
        Nodes taken up, in all passes and for all candidates.
    limits
        The limit of each pass, metres.
    cost
        J of the answer, metres; infinite where there is none.
    answer
        Its columns, spelt out.
    cut
        It gave up before its end.
    candidates, tried
        How many there were; how many of them were aligned.
    visits
        The nodes in order, the first 5,000 of a search.
    alignment
        The answer of a `Case`.
    """

    axis: str
    nodes: int
    limits: tuple[float, ...]
    cost: float
    answer: str
    cut: bool = False
    candidates: int = 1
    tried: int = 1
    visits: tuple[Visit, ...] = ()
    alignment: Alignment | None = None

    @property
    def passes(self) -> int:
        """How many passes it made."""
        return len(self.limits)


@dataclass(frozen=True, slots=True)
class Counterexample:
    """Where the answer is not the best, or where a bound says too much.

    Attributes
    ----------
    case
        On what.
    found, best
        J of the answer; J of the best there is.
    better
        The best, spelt out.
    reason
        The node or candidate of which too much was said, in a sentence; empty where none was found.
    """

    case: str
    found: float
    best: float
    answer: str
    better: str
    reason: str

    def __str__(self) -> str:
        lines = [f"On {self.case}:"]
        if self.found > self.best + EPS:
            lines.append(f"  yours  J = {_metres(self.found)}  {self.answer}")
            lines.append(f"  best   J = {_metres(self.best)}  {self.better}")
        if self.reason:
            lines.append(f"  {self.reason}")
        return "\n".join(lines)


@dataclass(frozen=True, slots=True)
class Experiment:
    """The product's own search and yours, on the same words.

    Attributes
    ----------
    ours, yours
        A run for each axis; one of a `Case`.
    best
        J of the best there is, by another search: metres for each run.
    exact
        Whether your answer is as good as that; None where a search gave up.
    counterexample
        Where it is not; or, though it is, where your heuristic or bound says more than the truth. None: nowhere seen.
    layout
        Your layout of a design.
    """

    case: str
    changed: tuple[str, ...]
    ours: tuple[Run, ...]
    yours: tuple[Run, ...]
    best: tuple[float, ...]
    exact: bool | None
    counterexample: Counterexample | None
    layout: Layout | None = None
    first: bool = False
    """Under the paper's objective a design has the first candidate that aligns, not the best: yours is held to ours."""

    @property
    def nodes(self) -> int:
        """Nodes that yours took up."""
        return sum(run.nodes for run in self.yours)

    @property
    def passes(self) -> int:
        """Passes that yours made."""
        return sum(run.passes for run in self.yours)

    @property
    def cost(self) -> float:
        """J of your answer, metres."""
        return sum(run.cost for run in self.yours)

    @property
    def verdict(self) -> str:
        """Whether it is exact, in a sentence."""
        if self.exact is None:
            return "A search gave up, so that it is not known whether this is the best."
        if self.first:
            return (
                "No worse than ours."
                if self.exact
                else "Worse than ours: another candidate was the first to align."
            )
        if not self.exact:
            return "Not exact: there is a better answer."
        if self.counterexample is not None:
            return (
                "The best answer, but by luck: what you say of some node or candidate is more than the truth."
            )
        if self.cost == inf:
            return "Exact: there is no answer at all."
        return "Exact: no answer costs less."

    def _rows(self) -> list[tuple[str, ...]]:
        rows: list[tuple[str, ...]] = []
        # both look for the same, unless what a column costs or which are allowed has been changed
        other = ("column_error", "constraint", "objective")
        alike = not any(own.startswith(other) for own in self.changed)
        for n, (ours, yours) in enumerate(zip(self.ours, self.yours, strict=True)):
            for who, run in (("ours", ours), ("yours", yours)):
                mark = ""
                if who == "yours" or alike:
                    mark = "?" if run.cut or self.best[n] == -inf else _yes(run.cost <= self.best[n] + 1e-6)
                name = f"{run.axis}: {who}" if run.axis else who
                tried = (f"{run.tried} of {run.candidates}",) if run.axis else ()
                rows.append(
                    (
                        name,
                        f"{run.nodes:,}" + (" (gave up)" if run.cut else ""),
                        str(run.passes),
                        *tried,
                        _metres(run.cost),
                        mark,
                        run.answer,
                    )
                )
        return rows

    @property
    def _head(self) -> tuple[str, ...]:
        tried = ("candidates",) if self.ours and self.ours[0].axis else ()
        return ("", "nodes", "passes", *tried, "J", "exact?", "answer")

    def __str__(self) -> str:
        rows = [self._head, *self._rows()]
        wide = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
        lines = [f"{self.case}", f"yours: {'; '.join(self.changed) or 'nothing changed'}", ""]
        lines += [
            "  ".join(cell.ljust(w) for cell, w in zip(row, wide, strict=True)).rstrip() for row in rows
        ]
        lines += ["", self.verdict]
        if self.counterexample is not None:
            lines.append(str(self.counterexample))
        return "\n".join(lines)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{escape(cell)}</th>" for cell in self._head)
        body = "".join(
            "<tr>" + "".join(f"<td style='text-align: left'>{escape(cell)}</td>" for cell in row) + "</tr>"
            for row in self._rows()
        )
        told = f"<p>{escape(self.verdict)}</p>"
        if self.counterexample is not None:
            told += f"<pre>{escape(str(self.counterexample))}</pre>"
        return (
            f"<p>{escape(self.case)}<br>yours: <code>{escape('; '.join(self.changed) or 'nothing changed')}</code></p>"
            f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{told}"
        )


def _yes(true: bool) -> str:
    return "yes" if true else "no"


def _metres(value: float) -> str:
    return "none" if value == inf else f"{value:.3f} m"
