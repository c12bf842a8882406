"""What a search of alignments found: the best structures, and what is proven of the rest."""

from __future__ import annotations

from dataclasses import dataclass, field

from ..model.precision import EPS
from .pricing import Priced

__all__ = ["Found"]


@dataclass(slots=True)
class Found:
    """What a search found.

    Attributes
    ----------
    ties
        The best structures, equal in cost, propriety and number of columns; empty: no alignment within the
        cap.
    bound
        Proven lower bound of the cost.
    nodes
        How many partial paths were taken up.
    cut
        The search ended before it knew everything below its cap.
    """

    ties: list[Priced] = field(default_factory=list)
    bound: float = 0.0
    nodes: int = 0
    cut: bool = False

    @property
    def best(self) -> Priced | None:
        """The first of the ties."""
        return self.ties[0] if self.ties else None

    def offer(self, priced: Priced, keep: int) -> None:
        """Take a structure in, if none known is better."""
        best = self.best
        if best is not None and priced.cost <= best.cost + EPS:
            ours, theirs = (not priced.proper, -priced.columns), (not best.proper, -best.columns)
            if priced.cost < best.cost - EPS or ours < theirs:
                self.ties = [priced]
            elif ours == theirs and len(self.ties) < keep:
                self.ties.append(priced)
        elif best is None:
            self.ties = [priced]
