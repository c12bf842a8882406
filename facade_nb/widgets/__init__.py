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
from .texture import GrammarEditor, GrammarTable, PixelInspector, TextureModel, TextureStudio, TextureView
from .visible import (
    AlignmentView,
    AnalysisView,
    CandidatesView,
    FacadeView,
    NetworkView,
    PlayerView,
    QualifiersView,
    SizingView,
    SolverView,
    TraceModel,
    TraceView,
    WordsView,
)

__all__ = [
    "AlignmentView",
    "AnalysisView",
    "CandidatesView",
    "CanvasEditor",
    "CounterEditor",
    "Draft",
    "ElevationView",
    "FacadeModel",
    "FacadeView",
    "GrammarEditor",
    "GrammarTable",
    "LayerEditor",
    "MassingView",
    "NetworkView",
    "Part",
    "PatternEditor",
    "PixelInspector",
    "PlayerView",
    "QualifiersView",
    "Selection",
    "SizingView",
    "SolverView",
    "Studio",
    "SymbolEditor",
    "TextureModel",
    "TextureStudio",
    "TextureView",
    "Toolbar",
    "TraceModel",
    "TraceView",
    "WordsView",
]
