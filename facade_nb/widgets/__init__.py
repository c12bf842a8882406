"""Widgets: one shared observable design, and parts that show and edit it live (docs/widgets.md)."""

from .model import Draft, FacadeModel, Selection
from .parts import (
    CanvasEditor,
    CounterEditor,
    ElevationView,
    LayerEditor,
    Part,
    PatternEditor,
    SymbolEditor,
    Toolbar,
)
from .studio import MassingView, Studio
from .visible import (
    AnalysisView,
    CandidatesView,
    FacadeView,
    PlayerView,
    QualifiersView,
    SolverView,
    TraceModel,
    TraceView,
    WordsView,
)

__all__ = [
    "AnalysisView",
    "CandidatesView",
    "CanvasEditor",
    "CounterEditor",
    "Draft",
    "ElevationView",
    "FacadeModel",
    "FacadeView",
    "LayerEditor",
    "MassingView",
    "Part",
    "PatternEditor",
    "PlayerView",
    "QualifiersView",
    "Selection",
    "SolverView",
    "Studio",
    "SymbolEditor",
    "Toolbar",
    "TraceModel",
    "TraceView",
    "WordsView",
]
