"""From the events of a trace to the layout that they tell, and from nothing else.

The path of each group says which letters stand in which column; the solution of the least-squares system says where;
the merged shapes come as they were told. A trace without one of these is not complete, and that is said.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import fields
from typing import TypeVar

from ...design.errors import DesignError, Fault
from ...design.model import AXES, Canvas
from ..events import (
    AxisPosed,
    AxisSolved,
    CandidateJudged,
    Event,
    GroupNote,
    HoleFound,
    NoLayoutFound,
    PathChosen,
    ShapeMerged,
    SystemPosed,
    SystemSolved,
    TraceBegun,
    VariableNote,
    Warned,
)
from ..model.layout import AxisLayout, GroupLayout, Layout, PlacedLetter, PlacedShape, RowLayout

__all__ = ["replay"]

_Kind = TypeVar("_Kind", bound=Event)
_Place = tuple[str, int, int, int, int]  # kind, group, band, column, place


def replay(events: Iterable[Event]) -> Layout:
    """Make the layout that the events of one solve tell.

    Raises
    ------
    DesignError
        Where an event is missing that is needed, or the solve ended without a layout.
    """
    told = list(events)
    failed = next((e for e in told if isinstance(e, NoLayoutFound)), None)
    if failed is not None:
        raise DesignError(f"this trace tells of no layout: {failed.message}")
    begun = _one(told, TraceBegun, "")
    canvas = Canvas(begun.design["canvas"]["width"], begun.design["canvas"]["height"])
    counters: dict[str, int] = {}
    axes: dict[str, AxisLayout] = {}
    complete = True
    for axis in AXES if any(isinstance(e, AxisPosed) for e in told) else ():
        own = [e for e in told if e.axis == axis]
        best = _one(
            [e for e in own if isinstance(e, CandidateJudged) and e.fate == "best"], CandidateJudged, axis
        )
        counters.update(best.counters)
        solved = _one(own, AxisSolved, axis)
        complete = complete and solved.complete
        axes[axis] = _axis(own, axis, solved)
    return Layout(
        begun.design["name"],
        canvas,
        dict(sorted(counters.items())),
        axes.get("x", AxisLayout()),
        axes.get("y", AxisLayout()),
        tuple(_shape(e) for e in told if isinstance(e, ShapeMerged)),
        tuple(e.rect for e in told if isinstance(e, HoleFound)),
        tuple(e.text for e in told if isinstance(e, Warned)),
        complete,
    )


def _one(events: Iterable[Event], kind: type[_Kind], axis: str) -> _Kind:
    found = next((e for e in events if isinstance(e, kind)), None)
    if found is None:
        where = f" of axis {axis}" if axis else ""
        raise DesignError(Fault("events", f"expected a {kind.__name__}{where}, found none"))
    return found


def _axis(events: list[Event], axis: str, solved: AxisSolved) -> AxisLayout:
    posed, system = _one(events, AxisPosed, axis), _one(events, SystemPosed, axis)
    solution = _one(events, SystemSolved, axis)
    at: dict[_Place, float] = {}
    sizes: dict[str, float] = {}
    for what, value in zip(system.meaning, solution.placed, strict=True):
        if what.kind == "size":
            sizes[what.symbol] = value
        else:
            at[_place(what)] = value
    paths = {e.group: e for e in events if isinstance(e, PathChosen)}
    groups: dict[str, GroupLayout] = {}
    for g, group in enumerate(posed.groups):
        if group.name not in paths:
            raise DesignError(Fault("events", f"expected a PathChosen of group {group.name!r}, found none"))
        groups[group.name] = _group(g, group, paths[group.name], at)
    return AxisLayout(solved.cost, solved.gap, solution.deviation, solved.proven, sizes, groups)


def _place(what: VariableNote) -> _Place:
    return (what.kind, what.group, what.band, what.column, what.place)


def _group(g: int, group: GroupNote, path: PathChosen, at: Mapping[_Place, float]) -> GroupLayout:
    """Boundaries and rows: what has no bound of its own begins where the letter before it ends, or the column does."""
    boundaries = tuple(at["boundary", g, -1, j, -1] for j in range(len(path.columns) + 1))
    rows: dict[int, RowLayout] = {}
    for b, band in enumerate(path.bands):
        columns: list[tuple[PlacedLetter, ...]] = []
        for j, column in enumerate(path.columns):
            letters = column.letters[b]
            element: list[PlacedLetter] = []
            start = at.get(("start", g, b, j, 0), boundaries[j])
            for place, n in enumerate(letters):
                end = at.get(("end", g, b, j, place), boundaries[j + 1])
                letter = band.letters[n]
                element.append(PlacedLetter(letter.symbol, start, end, letter.mirrored, letter.transparent))
                start = end
            columns.append(tuple(element))
        for i in band.rows:
            rows[i] = RowLayout(group.layers[i], group.patterns[i], tuple(columns))
    return GroupLayout(path.error, boundaries, tuple(rows[i] for i in sorted(rows)))


def _shape(e: ShapeMerged) -> PlacedShape:
    return PlacedShape(**{own.name: getattr(e, own.name) for own in fields(PlacedShape)})
