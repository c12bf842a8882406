"""How long the solver takes: a cold solve, and a solve after one symbol was edited, of every gallery design.

CPU time of this process, one thread, warm process. *Cold*: empty caches. *Edit*: the design has just been solved, and
one sized symbol becomes 2 % larger; each run takes the next symbol. Medians of the runs, and the slowest edit. The
designs of the paper's sizes come first; last, three of them with more wildcards. A design that takes long gets fewer
runs; what is not proven is told.
"""

from __future__ import annotations

import argparse
import statistics
import time

from facade_nb import Design, Layout, NoLayout, gallery, solve
from facade_nb.design import edit
from facade_nb.solver import solution as solving

from .designs import LARGE, harder, line_of, others

__all__ = ["main"]

RUNS = 20
EDIT_GOAL = 15.0
SLOW = 2.0
"""Seconds; a design whose first solve takes longer is run three times only."""


def main(limit: float = 10.0) -> None:
    """Print the table; each solve has `limit` seconds."""
    print(f"CPU ms, median of {RUNS}; goals: cold 50 (concert-hall 100), edit {EDIT_GOAL:g}")
    heads = ("design", "layers", "cold", "edit", "slowest", "J across", "J up", "goals")
    widths = (-24, 6, 8, 8, 16, 9, 9, -40)
    print(line_of(list(zip(heads, widths, strict=True))))
    missed = []
    named = {name: gallery.load(name) for name in (*LARGE, *others())}
    for name, design in {**named, **harder()}.items():
        cells, good = _measured(name, design, limit)
        print(line_of(list(zip(cells, widths, strict=True))), flush=True)
        if not good and name in LARGE:
            missed.append(name)
    print(f"\ngoals missed by: {', '.join(missed) or 'none of the large designs'}")


def _measured(name: str, design: Design, limit: float) -> tuple[list[str], bool]:
    solved(design, limit)  # whatever is loaded or compiled once
    begin = time.perf_counter()
    first = cold(design, limit)
    runs = RUNS if time.perf_counter() - begin < SLOW else 3
    layout = first[1]
    head = [name, str(len(design.layers))]
    if layout is None:
        return [*head, f"> {1e3 * first[0]:.0f}", "", "", "", "", "no layout in time"], False
    told = [f"{layout.x.cost:.3f}", f"{layout.y.cost:.3f}"]
    colds = [first[0], *(cold(design, limit)[0] for _ in range(runs - 1))]
    edits = _edits(design, runs, limit)
    median, again = 1e3 * statistics.median(colds), 1e3 * statistics.median(t for t, _ in edits)
    slowest, symbol = max(edits)
    goal = LARGE.get(name, 50.0)
    proven = layout.complete and layout.x.proven and layout.y.proven
    verdict = [
        *(["cold"] if median > goal else []),
        *(["edit"] if again > EDIT_GOAL else []),
        *([] if proven else [f"not proven (gap {layout.x.gap + layout.y.gap:.3f})"]),
    ]
    cells = [*head, f"{median:.1f}", f"{again:.1f}", f"{1e3 * slowest:.1f} ({symbol})", *told]
    return [*cells, "kept" if not verdict else "missed: " + ", ".join(verdict)], not verdict


def solved(design: Design, limit: float) -> Layout | None:
    """The layout, or None where there is none in time."""
    try:
        return solve(design, time_limit=limit)
    except NoLayout:
        return None


def cold(design: Design, limit: float) -> tuple[float, Layout | None]:
    """CPU seconds of a solve with empty caches, and the layout."""
    solving.forget()
    begin = time.process_time()
    layout = solved(design, limit)
    return time.process_time() - begin, layout


def _edits(design: Design, runs: int, limit: float) -> list[tuple[float, str]]:
    """CPU seconds of a solve after each of some edits, with the symbol that was edited."""
    sized = [(name, own.size) for name, own in design.symbols.items() if own.size is not None]
    times: list[tuple[float, str]] = []
    for run in range(runs if runs < RUNS else max(RUNS, len(sized))):
        name, size = sized[run % len(sized)]
        edited = edit.with_symbol(design, name, size=size * 1.02)
        solving.forget()
        solved(design, limit)
        begin = time.process_time()
        solved(edited, limit)
        times.append((time.process_time() - begin, name))
    return times


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--limit", type=float, default=10.0, help="seconds for a solve")
    main(parser.parse_args().limit)
