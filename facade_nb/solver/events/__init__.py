"""What the solver did, as frozen, typed events: the only thing that views of the solver read.

Events are made when a trace is read, from the few notes that the search left (`tracing.Recorder`); an untraced
solve makes none. Every event is plain data: what it holds are numbers, texts, tuples, mappings, and the small
records of this module, so that it can be written as JSON and read again (`tracing.codec`). No number is NaN or
infinite; None stands for what is not known or not bounded.

Letters of a word are counted from 0. A *band* is a distinct word of a group: rows with equal words are cut alike.
A band's *place* is twice the number of letters read, and one more where the next letter is cut and begun.
``docs/trace.md`` has every field.
"""

from __future__ import annotations

from .base import (
    AxisPosed,
    Event,
    GroupNote,
    LeftOut,
    NoLayoutFound,
    StageBegun,
    StageEnded,
    TraceBegun,
    TraceEnded,
    Warned,
)
from .choices import (
    CandidateJudged,
    LetterNote,
    PairInconsistent,
    PatternNotAnalysed,
    PatternsCompared,
    SystemReduced,
    WordJudged,
)
from .networks import (
    PRUNED,
    BandNote,
    ColumnNote,
    ControlsAligned,
    EdgeRefused,
    EdgeWeighed,
    LimitRaised,
    NetworkClosed,
    NetworkOpened,
    NodeTaken,
    PairsMerged,
    PathChosen,
    RegionTraced,
    StructurePriced,
    WaysMet,
)
from .placements import (
    ActiveSetStep,
    AxisSolved,
    BoundariesPlaced,
    HoleFound,
    LetterPlaced,
    ShapeHidden,
    ShapeMerged,
    SystemPosed,
    SystemSolved,
    VariableNote,
)

__all__ = [
    "PRUNED",
    "ActiveSetStep",
    "AxisPosed",
    "AxisSolved",
    "BandNote",
    "BoundariesPlaced",
    "CandidateJudged",
    "ColumnNote",
    "ControlsAligned",
    "EdgeRefused",
    "EdgeWeighed",
    "Event",
    "GroupNote",
    "HoleFound",
    "LeftOut",
    "LetterNote",
    "LetterPlaced",
    "LimitRaised",
    "NetworkClosed",
    "NetworkOpened",
    "NoLayoutFound",
    "NodeTaken",
    "PairInconsistent",
    "PairsMerged",
    "PathChosen",
    "PatternNotAnalysed",
    "PatternsCompared",
    "RegionTraced",
    "ShapeHidden",
    "ShapeMerged",
    "StageBegun",
    "StageEnded",
    "StructurePriced",
    "SystemPosed",
    "SystemReduced",
    "SystemSolved",
    "TraceBegun",
    "TraceEnded",
    "VariableNote",
    "Warned",
    "WaysMet",
    "WordJudged",
]
