"""How long runs of a spine's letters may be, as their design allows it by itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from ..solver.alignment.linear_programme import solve_lp
from ..solver.model.sizing import System

__all__ = ["Reach"]

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Reach:
    """How long each run of letters of a spine may be, as its design allows it by itself.

    Attributes
    ----------
    low, high
        (n + 1, n + 1): metres from letter i up to letter j, where i < j.
    """

    low: Floats
    high: Floats

    @classmethod
    def of(cls, system: System, symbols: Sequence[str], floors: dict[str, float]) -> Reach:
        """Of the letters of a spine.

        Parameters
        ----------
        system
            The sizing problem of its design alone.
        floors
            What symbols may not get smaller than.
        """
        place = {key[1]: v for v, key in enumerate(system.keys) if key[0] == "|"}
        size = len(system.keys)
        lower = system.lower.copy()
        for name, least in floors.items():
            if name in place:
                lower[place[name]] = max(lower[place[name]], least)
        n = len(symbols)
        low, high = np.zeros((n + 1, n + 1)), np.full((n + 1, n + 1), inf)
        known: dict[bytes, tuple[float, float]] = {}
        for i in range(n):
            goal = np.zeros(size)
            for j in range(i, n):
                goal[place[symbols[j]]] += 1.0
                told = goal.tobytes()
                if told not in known:
                    ends = [solve_lp(sign * goal, system.matrix, system.upper, lower) for sign in (1.0, -1.0)]
                    lengths = [None if x is None else float(goal @ x) for x in ends]
                    known[told] = lengths[0] or 0.0, inf if lengths[1] is None else lengths[1]
                low[i, j + 1], high[i, j + 1] = known[told]
        return cls(low, high)
