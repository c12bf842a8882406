"""What the browser is told of a trace, cut into pieces that are made, and sent, when a view first needs them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ...solver import Trace
from ...solver.events import (
    ActiveSetStep,
    AxisPosed,
    BoundariesPlaced,
    CandidateJudged,
    Event,
    HoleFound,
    LetterPlaced,
    PairInconsistent,
    PathChosen,
    PatternNotAnalysed,
    PatternsCompared,
    ShapeMerged,
    SystemPosed,
    SystemReduced,
    SystemSolved,
    WordJudged,
)
from ...solver.trace.codec import to_plain
from ..shared.packing import pack
from .built import built
from .captions import captions
from .code import code
from .networks import aligned, networks
from .otherwise import CHANGES, run
from .timeline import timeline

__all__ = ["CHUNKS", "chunk", "events"]

Json = dict[str, Any]


def events(trace: Trace, *kinds: type[Event]) -> list[Json]:
    """The events of some kinds as plain data, each with its position in the trace under ``at``."""
    return [{"at": at, **to_plain(e)} for at, e in enumerate(trace.events) if isinstance(e, kinds)]


def _picking(*kinds: type[Event]) -> Callable[[Trace], Json]:
    return lambda trace: {"events": events(trace, *kinds)}


CHUNKS: Mapping[str, Callable[[Trace], Json]] = {
    "timeline": timeline,
    "captions": captions,
    "code": code,
    "facade": built,
    "placing": _picking(AxisPosed, PathChosen, BoundariesPlaced, LetterPlaced, ShapeMerged, HoleFound),
    "words": _picking(AxisPosed, WordJudged),
    "analysis": _picking(PatternNotAnalysed, PatternsCompared, SystemReduced, PairInconsistent),
    "candidates": _picking(CandidateJudged),
    "network": networks,
    "alignment": aligned,
    "sizing": _picking(SystemPosed, ActiveSetStep, SystemSolved),
    **{f"run_{change}": run(change) for change in CHANGES},
}
"""Every piece by its name; one line each. A view says in its `needs` which it reads."""


def chunk(trace: Trace, name: str) -> bytes:
    """One piece of a trace, packed."""
    return pack(CHUNKS[name](trace))
