"""The timeline of a trace: what kind each event is of, which stage it belongs to, and where something happens."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np

from ...design import Design, DesignError, Fault
from ...design.model import AXES
from ...solver import Trace
from ...solver.events import (
    AxisPosed,
    CandidateJudged,
    ControlsAligned,
    Event,
    HoleFound,
    NetworkOpened,
    NoLayoutFound,
    PairInconsistent,
    PairsMerged,
    PathChosen,
    StageBegun,
    StageEnded,
    StructurePriced,
    SystemSolved,
    TraceBegun,
    TraceEnded,
    Warned,
    WaysMet,
)
from ...solver.model.precision import EPS
from .captions import caption

__all__ = ["STAGES", "Segment", "begun", "hues", "locate", "moment_of", "segments", "timeline"]

STAGES = {
    "analysis": "Analysis",
    "words": "Words",
    "candidates": "Candidates",
    "alignment": "Alignment",
    "sizing": "Sizing",
    "merging": "Merging",
}
"""The stages as the player calls them. The trace's stage ``search`` is two: candidates, then alignment."""

_MARKED = (CandidateJudged, HoleFound, NoLayoutFound, PairInconsistent, PathChosen, SystemSolved, Warned)


@dataclass(frozen=True, slots=True)
class Segment:
    """A run of events of one stage of one axis (empty: of both), from `first` to `last`."""

    axis: str
    stage: str
    first: int
    last: int
    seconds: float | None


def segments(events: Sequence[Event]) -> list[Segment]:
    """The stages of a trace; every event is in one of them.

    What comes between two stages belongs to the one before, but the posing of an axis opens its first stage.
    """
    cuts: list[tuple[int, str, str]] = []
    seconds: dict[tuple[str, str], float] = {}
    opened: int | None = 0
    searching = ""
    for at, e in enumerate(events):
        if isinstance(e, AxisPosed):
            opened = at if cuts else 0
        elif isinstance(e, StageBegun):
            name = "candidates" if e.stage == "search" else e.stage
            cuts.append((at if opened is None else opened, e.axis, name))
            opened = None
            searching = e.axis if e.stage == "search" else ""
        elif isinstance(e, StageEnded):
            seconds[e.axis, "alignment" if e.stage == "search" else e.stage] = e.seconds
            searching = ""
        elif isinstance(e, (NetworkOpened, PathChosen)) and searching and cuts[-1][2] == "candidates":
            cuts.append((at, searching, "alignment"))
    if not cuts:  # an empty canvas, or a fault found before the first stage
        cuts = [(0, "", "merging")]
    ends = [first - 1 for first, *_ in cuts[1:]] + [len(events) - 1]
    return [
        Segment(axis, stage, first, last, seconds.get((axis, stage)))
        for (first, axis, stage), last in zip(cuts, ends, strict=True)
    ]


def moment_of(events: Sequence[Event], position: int) -> str:
    """A position as text that says what it is: the axis, the stage, and how many events into it, ``x/words+12``.

    Where a stage comes several times, its number stands behind it: ``x/words.2+12``.
    """
    cuts = segments(events)
    at = next(n for n, own in enumerate(cuts) if own.first <= position <= own.last)
    own = cuts[at]
    before = sum((other.axis, other.stage) == (own.axis, own.stage) for other in cuts[:at])
    name = f"{own.axis or 'both'}/{own.stage}" + (f".{before + 1}" if before else "")
    return f"{name}+{position - own.first}"


def locate(events: Sequence[Event], moment: str) -> int:
    """The position that `moment_of` wrote; in another trace the place that is nearest to it.

    Raises
    ------
    ValueError
        For text that is no moment, or a stage that the trace does not have.
    """
    place, _, offset = moment.partition("+")
    axis, slash, stage = place.partition("/")
    stage, _, turn = stage.partition(".")
    if not slash or not (offset or "0").isdigit() or not (turn or "1").isdigit():
        raise ValueError(f"moment: expected a text such as 'x/words+12', found {moment!r}")
    cuts = segments(events)
    found = [own for own in cuts if (own.axis or "both", own.stage) == (axis, stage)]
    if not found:
        known = dict.fromkeys(f"{own.axis or 'both'}/{own.stage}" for own in cuts)
        raise ValueError(f"moment: this trace has no {axis}/{stage}; it has {', '.join(known)}")
    own = found[min(int(turn or 1), len(found)) - 1]
    return min(own.first + int(offset or 0), own.last)


def begun(trace: Trace) -> TraceBegun:
    """What was asked: the first event of every trace that `solve` made. Raises `DesignError` where it is missing."""
    first = trace.events[0] if len(trace.events) else None
    if not isinstance(first, TraceBegun):
        raise DesignError(Fault("events[0]", f"expected TraceBegun, found {type(first).__name__}"))
    return first


def timeline(trace: Trace) -> dict[str, Any]:
    """What the player and the frame of every view read."""
    events = list(trace.events)
    names = list(dict.fromkeys(type(e).__name__ for e in events))
    number = {name: n for n, name in enumerate(names)}
    asked = begun(trace)
    design = Design.from_dict(asked.design)
    last = events[-1]
    return {
        "name": design.name,
        "canvas": {"x": design.canvas.width, "y": design.canvas.height},
        "kinds": names,
        "kind": np.array([number[type(e).__name__] for e in events], np.uint8),
        "stages": [
            {
                "axis": own.axis,
                "stage": own.stage,
                "title": STAGES.get(own.stage, own.stage),
                "first": own.first,
                "last": own.last,
                "seconds": own.seconds,
            }
            for own in segments(events)
        ],
        "improved": np.array(_improved(events), np.int32),
        "marks": [{"at": at, "kind": type(e).__name__, "text": caption(e)} for at, e in _marked(events)],
        "patterns": [_pattern(design, name) for name in design.patterns],
        "symbols": hues(design),
        "sizes": {name: own.size for name, own in design.symbols.items()},
        "chosen": {axis: _chosen(events, axis) for axis in AXES},
        "objective": dict(asked.objective),
        "search": asked.search,
        "seconds": last.seconds if isinstance(last, TraceEnded) else None,
        "failure": next((e.message for e in events if isinstance(e, NoLayoutFound)), ""),
    }


def _improved(events: Sequence[Event]) -> list[int]:
    """Where an alignment is found that is cheaper than all before it in its network."""
    best: dict[tuple[str, int], float] = {}
    found: list[int] = []
    for at, e in enumerate(events):
        if isinstance(e, (StructurePriced, WaysMet, ControlsAligned, PairsMerged)) and e.cost is not None:
            own = (e.axis, e.network)
            if e.cost < best.get(own, inf) - EPS:
                best[own] = e.cost
                found.append(at)
    return found


def _marked(events: Sequence[Event]) -> list[tuple[int, Event]]:
    return [
        (at, e)
        for at, e in enumerate(events)
        if isinstance(e, _MARKED) and not (isinstance(e, CandidateJudged) and e.fate != "best")
    ]


def _pattern(design: Design, name: str) -> dict[str, Any]:
    pattern = design.patterns[name]
    return {
        "name": name,
        "text": pattern.text,
        "counters": list(pattern.parsed.counters),
        "layers": {
            axis: [own.name for own in design.stack if own.along(axis).pattern == name] for axis in AXES
        },
    }


def _chosen(events: Sequence[Event], axis: str) -> dict[str, Any] | None:
    """The candidate that became the layout: where that is told, its number, the word of each pattern."""
    for at, e in enumerate(events):
        if isinstance(e, CandidateJudged) and e.axis == axis and e.fate == "best":
            return {"at": at, "number": e.number, "words": dict(e.words)}
    return None


def hues(design: Design) -> dict[str, int]:
    """A number for each symbol, by which every view colours it: symbols of one axis differ as long as they can."""
    found: dict[str, int] = {}
    for axis in AXES:
        used = dict.fromkeys(own.along(axis).pattern for own in design.stack)
        symbols = dict.fromkeys(s for name in used for s in design.patterns[name].parsed.symbols)
        sized = [s for s in symbols if design.symbol(s).size is not None]
        for n, symbol in enumerate([*sized, *(s for s in symbols if s not in sized)]):
            found.setdefault(symbol, n)
    return found
