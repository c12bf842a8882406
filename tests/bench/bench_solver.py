"""How long the solver takes: a cold solve of every gallery design, and an edit of one symbol.

CPU time of this process, one thread, warm process, empty caches; the median of the runs.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

from facade_nb import Design, gallery, solve
from facade_nb.design import edit
from facade_nb.solver import solving

__all__ = ["main"]

RUNS = 20


def main() -> None:
    """Print the table."""
    title = f"design, CPU ms (median of {RUNS})"
    print(f"{title:34} {'cold':>8} {'edit':>8}  {'J across':>9} {'J up':>7}  proven")
    for name in gallery.names():
        design = gallery.load(name)
        layout = solve(design, time_limit=60.0)
        edited = _edited(design)
        cold = _median(lambda design=design: _cold(design))
        again = _median(lambda design=design, edited=edited: _again(design, edited))
        proven = "yes" if layout.x.proven and layout.y.proven else "no"
        print(f"{name:34} {cold:8.1f} {again:8.1f}  {layout.x.cost:9.3f} {layout.y.cost:7.3f}  {proven}")


def _edited(design: Design) -> Design:
    """The design with its first sized symbol a little larger."""
    name, symbol = next((n, s) for n, s in design.symbols.items() if s.size is not None)
    return edit.with_symbol(design, name, size=symbol.size * 1.02)


def _cold(design: Design) -> float:
    solving.forget()
    begin = time.process_time()
    solve(design, time_limit=60.0)
    return time.process_time() - begin


def _again(design: Design, edited: Design) -> float:
    solving.forget()
    solve(design, time_limit=60.0)
    begin = time.process_time()
    solve(edited, time_limit=60.0)
    return time.process_time() - begin


def _median(run: Callable[[], float]) -> float:
    return 1e3 * statistics.median(run() for _ in range(RUNS))


if __name__ == "__main__":
    main()
