"""What is minimised (docs/problem.md; the paper's 5.2).

Both objectives are sums over columns of an alignment, in metres, with ties broken by the larger number of
columns.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Objective"]


@dataclass(frozen=True, slots=True)
class Objective:
    """J = Σ ω_j + fit·|W − canvas| + empty·E + loose·Λ, then most columns.

    Parameters
    ----------
    empty
        Price of a metre of column that a row leaves empty (E), weighted by the row's share.
    loose
        Price of a metre of looseness (Λ): letters that share an element, and non-opaque letters that do not
        fill their column.
    fit
        Price of a metre by which the columns' sum W misses the canvas. It is below 1. So it never pays to make
        a column wider than its letters only to fill the canvas, and J stays convex in the sizes (see
        `alignment.pricing`).
    plain
        Whether ω_j is Eq. 9 as printed. If not, a row with a non-opaque letter counts in ω_j only by what it is
        larger than the other rows, because it need not fill the column (supplement 3.4).
    """

    empty: float = 0.8
    loose: float = 0.25
    fit: float = 0.25
    plain: bool = False

    def __post_init__(self) -> None:
        for name in ("empty", "loose", "fit"):
            value = getattr(self, name)
            if not 0 <= value < float("inf"):
                raise ValueError(f"objective: {name} must be 0 or more, found {value!r}")
        if self.fit >= 1:
            raise ValueError(f"objective: fit must be below 1, found {self.fit!r}")

    @classmethod
    def paper(cls) -> Objective:
        """The paper's objective: the least Ω = Σ ω_j, and among equals the most columns."""
        return cls(empty=0.0, loose=0.0, fit=0.0, plain=True)
