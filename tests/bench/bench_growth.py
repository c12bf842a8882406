"""How solving time grows with layers, letters and counters, for consistent designs; the exponents are fitted.

Consistent: all sizes fit, so that what is measured is how the search walks straight on, not how it decides. The rows
are distinct words. Each point is the median of a few cold solves, CPU time, with a limit; what is not proven within
it is told, with its gap, and takes no part in the fit.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from facade_nb import Design, NoLayout, solve
from facade_nb.solver import solution as solving

from .designs import line_of

__all__ = ["by_counters", "by_layers", "by_letters", "main"]

RUNS = 3
LAYERS = (2, 3, 4, 6, 8, 12, 16, 20, 26, 32, 40)
LETTERS = (5, 10, 20, 40, 80, 120, 160, 200)
COUNTERS = (1, 2, 3, 4, 5, 6, 7, 8)


def main(limit: float = 10.0) -> None:
    """Print the tables."""
    for title, points, make in (
        ("layers", LAYERS, by_layers),
        ("letters a row", LETTERS, by_letters),
        ("counters", COUNTERS, by_counters),
    ):
        _table(title, points, make, limit)


def _table(title: str, points: Sequence[int], make: Callable[[int], Design], limit: float) -> None:
    print(f"\n{line_of([(title, -14), ('ms', 10), ('', -40)])}")
    fitted: list[tuple[int, float]] = []
    for n in points:
        seconds, note = _point(make(n), limit)
        if not note:
            fitted.append((n, seconds))
        print(line_of([(str(n), -14), (f"{1e3 * seconds:.1f}", 10), (note, -40)]), flush=True)
    if len(fitted) > 2:
        sizes, times = np.log([n for n, _ in fitted]), np.log([t for _, t in fitted])
        (exponent, _), (upper, _) = np.polyfit(sizes, times, 1), np.polyfit(sizes[-4:], times[-4:], 1)
        print(f"time ~ {title}^{exponent:.2f} over all proven points, ^{upper:.2f} over the last four")


def _point(design: Design, limit: float) -> tuple[float, str]:
    times: list[float] = []
    note = ""
    for _ in range(RUNS):
        solving.forget()
        begin = time.process_time()
        try:
            layout = solve(design, time_limit=limit)
        except NoLayout:
            return time.process_time() - begin, "no layout in time"
        times.append(time.process_time() - begin)
        if not (layout.complete and layout.x.proven):
            note = f"not proven, J {layout.x.cost:.3f}, gap {layout.x.gap:.3f}"
        if times[-1] > 2.0:
            break
    return statistics.median(times), note


def _design(name: str, canvas: float, sizes: Mapping[str, float], patterns: Sequence[str]) -> Design:
    """A design whose layers differ across; upwards there is one storey."""
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": name,
            "canvas": {"width": canvas, "height": 3.0},
            "symbols": {**{symbol: {"size": size} for symbol, size in sizes.items()}, "P": {"size": 3.0}},
            "patterns": {**{f"x{n}": text for n, text in enumerate(patterns)}, "storey": "P"},
            "layers": [
                {"name": f"layer {n}", "x": {"pattern": f"x{n}"}, "y": {"pattern": "storey"}}
                for n in range(len(patterns))
            ],
        }
    )


def by_layers(n: int) -> Design:
    """Rows of ten bays AB; in each row other bays are one letter D of the same width."""
    bays = 10
    codes = [(37 * k + 11) % (2**bays) for k in range(n)]
    rows = ["".join("D" if code >> bay & 1 else "AB" for bay in range(bays)) for code in codes]
    return _design(f"{n} layers", 2.0 * bays, {"A": 0.8, "B": 1.2, "D": 2.0}, rows)


def by_letters(n: int) -> Design:
    """Three rows of n letters or so: bays, the same bays with a door now and then, and their halves exchanged."""
    bays = max(1, n // 2)
    rows = [
        "AB" * bays,
        "".join("D" if bay % 5 == 2 else "AB" for bay in range(bays)),
        "".join("D" if bay % 7 == 3 else "EF" for bay in range(bays)),
    ]
    sizes = {"A": 0.8, "B": 1.2, "D": 2.0, "E": 0.8, "F": 1.2}
    return _design(f"{n} letters", 2.0 * bays, sizes, [*dict.fromkeys(rows)])


def by_counters(n: int) -> Design:
    """Two rows of n runs of bays, each as often as an unbounded counter says; the second does not divide its bays."""
    rows: list[list[str]] = [[], []]
    sizes: dict[str, float] = {"Z": 0.5}
    for k in range(n):
        first, second, bay = "ACEGIKMO"[k], "BDFHJLNQ"[k], f"W{k}"
        sizes[first], sizes[second] = 0.5 + 0.05 * k, 1.0 + 0.1 * k
        sizes[bay] = sizes[first] + sizes[second]
        rows[0].append(f"({first}{second})^{{c{k}}} Z")
        rows[1].append(f"({bay})^{{c{k}}} Z")
    canvas = sum(2 * sizes[f"W{k}"] + 0.5 for k in range(n))
    return _design(f"{n} counters", canvas, sizes, [" ".join(row) for row in rows])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--limit", type=float, default=10.0, help="seconds for a solve")
    main(parser.parse_args().limit)
