"""Write the pieces of some traces for the tests of the front end: ``python -m tests.widgets.solver.pieces FOLDER``."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

from facade_nb import Design, NoLayout, gallery, solve
from facade_nb.solver import Objective, Trace
from facade_nb.solver.events import PathChosen
from facade_nb.widgets.shared.packing import pack
from facade_nb.widgets.solver.chunks import CHUNKS, chunk

__all__ = ["TRACES", "write"]


def _gallery(name: str) -> Callable[[], Trace]:
    return lambda: solve(gallery.load(name), trace=True, time_limit=None).trace


def _figure_7() -> Trace:
    """The paper's own way: tolerance by tolerance."""
    return solve(gallery.load("figure-7"), objective=Objective.paper(), trace=True, time_limit=None).trace


def _supplement() -> Trace:
    """The pair of supplement 3.1, m + 2 = l."""
    return solve(_pair("A^k c C^m c A^k; c := C", "A^k C^l A^k"), trace=True, time_limit=None).trace


def _contradiction() -> Trace:
    """Odd against even: there is no layout, and pattern analysis says why."""
    try:
        solve(_pair("A A^m A^m", "A^l A^l", {"m": {"max": 2}, "l": {"max": 2}}), trace=True, time_limit=None)
    except NoLayout as none:
        return none.trace
    raise AssertionError("expected no layout")


def _pair(over: str, under: str, counters: Mapping[str, Any] | None = None) -> Design:
    layer = {"y": {"pattern": "Y"}}
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": "A pair",
            "canvas": {"width": 9.0, "height": 1.0},
            "symbols": {"A": {"size": 2.0}, "C": {"size": 1.3}, "H": {"size": 1.0}},
            "counters": counters or {},
            "patterns": {"Pattern0": over, "Pattern1": under, "Y": "H"},
            "layers": [
                {"name": "under", "x": {"pattern": "Pattern1", "group": "one"}, **layer},
                {"name": "over", "x": {"pattern": "Pattern0", "group": "two"}, **layer, "depth": 1},
            ],
        }
    )


def _figure_8(search: str = "best") -> Trace:
    """The network of (CeC, ABABA), with the sizes of Figure 8."""
    return solve(gallery.load("figure-8"), search=search, trace=True, time_limit=None).trace


def _lesson(name: str) -> Trace:
    note = gallery.lesson_note(name)
    return solve(note.design, search=note.search, trace=True, time_limit=None).trace


def _alternation() -> Trace:
    """A pattern with alternatives, one of them of the wrong length, and a mirrored group."""
    design = Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": "Alternatives",
            "canvas": {"width": 6.0, "height": 1.0},
            "symbols": {
                name: {"size": size} for name, size in (("A", 1.0), ("B", 2.0), ("door", 3.0), ("H", 1.0))
            },
            "patterns": {"P": "(A|B|<door>)^k (AB)'", "Y": "H"},
            "layers": [{"name": "wall", "x": {"pattern": "P"}, "y": {"pattern": "Y"}}],
        }
    )
    return solve(design, trace=True, time_limit=None).trace


TRACES: Mapping[str, Callable[[], Trace]] = {
    name: cache(make)
    for name, make in {
        **{name: _gallery(name) for name in ("figure-7", "residential-house", "apartment-house")},
        "figure-7-paper": _figure_7,
        "alternation": _alternation,
        "supplement-3.1": _supplement,
        "contradiction": _contradiction,
        "figure-8": _figure_8,
        "figure-8-ida": lambda: _figure_8("ida"),
        "qualifiers-d": _gallery("qualifiers-d"),
        "lesson-deepening": lambda: _lesson("deepening"),
        "lesson-table": lambda: _lesson("table"),
    }.items()
}


def write(folder: Path) -> None:
    """Write every piece of every trace, as ``design.piece.bin``."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in TRACES.items():
        trace = make()
        for piece in CHUNKS:
            if piece.startswith("run_") and name != "lesson-table":
                continue  # it has the design searched again
            (folder / f"{name}.{piece}.bin").write_bytes(chunk(trace, piece))
        (folder / f"{name}.oracle.bin").write_bytes(pack(_oracle(trace)))


def _oracle(trace: Trace) -> dict[str, Any]:
    """What Python says of columns, for the twin in the browser: whole lattices, and alignments made up at random."""
    random = Random(8)
    lattices, judged = [], []
    for path in trace.of_kind(PathChosen):
        if len(path.bands) <= 2:
            lattices.append({"axis": path.axis, "group": path.group, "edges": _edges(trace, path)})
        for _ in range(60):
            columns = _made_up(random, path)
            try:
                verdicts = trace.judge(path.axis, path.group, columns)
            except ValueError:
                told = None
            else:
                told = [
                    [w.omega, w.cost, w.width, r.constraint if r else "", r.text if r else ""]
                    for w, r in verdicts
                ]
            judged.append({"axis": path.axis, "group": path.group, "columns": columns, "verdicts": told})
    return {"lattices": lattices, "judged": judged}


def _edges(trace: Trace, path: PathChosen) -> list[Any]:
    lattice = trace.lattice(path.axis, path.group)
    if len(lattice.edges) > 5000:
        return []
    at = [[*n.position, int(n.owed)] for n in lattice.nodes]
    alive = [int(n.reachable) + 2 * int(n.alive) for n in lattice.nodes]
    return [
        [
            at[e.source],
            at[e.target],
            e.column,
            e.omega,
            e.cost,
            e.width,
            e.constraint or "",
            e.text,
            alive[e.source],
        ]
        for e in lattice.edges
    ]


def _made_up(random: Random, path: PathChosen) -> list[list[list[int]]]:
    """The chosen alignment with some boundaries moved by a letter, and some letters cut."""
    ends = [list(column.after) for column in path.columns]
    for _ in range(random.randrange(1, 4)):
        j, b = random.randrange(len(ends)), random.randrange(len(path.bands))
        ends[j][b] += random.choice((-2, -1, 1, 2))
    columns, before = [], [0] * len(path.bands)
    for places in ends:
        columns.append([_letters(old, new) for old, new in zip(before, places, strict=True)])
        before = [max(old, new) for old, new in zip(before, places, strict=True)]
    return columns


def _letters(old: int, new: int) -> list[int]:
    return list(range(old >> 1, (new + 1) >> 1)) if new > old or (new == old and new & 1) else []


if __name__ == "__main__":
    write(Path(sys.argv[1]))
