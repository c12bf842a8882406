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
    "GrammarEditor",
    "GrammarTable",
    "LayerEditor",
    "MassingView",
    "Part",
    "PatternEditor",
    "PixelInspector",
    "PlayerView",
    "QualifiersView",
    "Selection",
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
