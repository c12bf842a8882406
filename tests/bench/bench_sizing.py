"""The sizing step against the QP code alone, on the same matrices.

The step (`size_axis`) names the variables and rows of an axis, fills the matrices, solves the two rounds, and places
the letters. Alone are the calls of daqp that it makes, with the same arguments, one after the other; and, stricter,
the first of them. A solve sizes both axes, so that it is their sum, for each design, that the goal speaks of: on the
smallest axes the step takes some tens of microseconds, whatever there is to solve.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any
from unittest.mock import patch

import daqp

from facade_nb import gallery
from facade_nb.solver import solution as solving
from facade_nb.solver.selection import axis
from facade_nb.solver.sizing import least_squares as qp
from facade_nb.solver.sizing import system as sizing

from .designs import LARGE, line_of, others, solved

__all__ = ["main"]

RUNS = 50
GOAL = 3.0


def main(limit: float = 60.0) -> None:
    """Print the table."""
    heads = ("axis", "variables", "rows", "calls", "step us", "daqp us", "ratio", "one call us", "ratio")
    widths = (-26, 9, 6, 6, 9, 9, 7, 12, 7)
    print(line_of(list(zip(heads, widths, strict=True))))
    sums: dict[str, tuple[float, float]] = {}
    for name in (*LARGE, *others()):
        steps = alones = 0.0
        for place, arguments in _last_steps(name, limit):
            cells, step, alone = _measured(f"{name} {place}", arguments)
            steps, alones = steps + step, alones + alone
            print(line_of(list(zip(cells, widths, strict=True))), flush=True)
        sums[name] = steps, alones
    print("\nboth axes")
    for name, (steps, alones) in sums.items():
        told = "" if name in LARGE else " (small)"
        print(f"{name + told:32} {steps:6.0f} us, daqp {alones:6.0f} us, ratio {steps / alones:5.2f}")
    ratios = [steps / alones for name, (steps, alones) in sums.items() if name in LARGE]
    print(
        f"\nlarge designs: median ratio {statistics.median(ratios):.2f}, worst {max(ratios):.2f}; goal at most {GOAL:g}"
    )


def _last_steps(name: str, limit: float) -> list[tuple[str, tuple[Any, ...]]]:
    """What the step was asked last on each axis, as the design was solved."""
    steps: dict[str, tuple[Any, ...]] = {}
    real = sizing.size_axis

    def spy(*arguments: Any) -> Any:
        sized = real(*arguments)
        place = f"{arguments[2]:g} m"
        if sized is not None and len(arguments[0]) >= len(steps.get(place, [()])[0]):  # all groups, not some
            steps[place] = arguments
        return sized

    solving.forget()
    with patch.object(axis, "size_axis", spy):
        solved(gallery.load(name), limit)
    return list(steps.items())


def _measured(name: str, arguments: tuple[Any, ...]) -> tuple[list[str], float, float]:
    calls: list[tuple[tuple[Any, ...], dict[str, Any]]] = []

    class Recorded:
        @staticmethod
        def solve(*given: Any, **options: Any) -> Any:
            calls.append((given, options))
            return daqp.solve(*given, **options)

    with patch.object(qp, "daqp", Recorded):
        sized = sizing.size_axis(*arguments)
    assert sized is not None
    step = _median(lambda: sizing.size_axis(*arguments))
    alone = _median(lambda: [_again(*call) for call in calls])
    first = _median(lambda: _again(*calls[0]))
    counts = [str(len(sized.system.variables)), str(len(sized.system.rows)), str(len(calls))]
    times = [f"{step:.0f}", f"{alone:.0f}", f"{step / alone:.2f}", f"{first:.0f}", f"{step / first:.2f}"]
    return [name, *counts, *times], step, alone


def _again(given: tuple[Any, ...], options: dict[str, Any]) -> None:
    *matrices, sense = given
    daqp.solve(*matrices, sense.copy(), **options)  # daqp writes into it


def _median(run: Callable[[], object]) -> float:
    """Microseconds of CPU time."""
    times = []
    for _ in range(RUNS):
        begin = time.process_time()
        run()
        times.append(time.process_time() - begin)
    return 1e6 * statistics.median(times)


if __name__ == "__main__":
    main()
