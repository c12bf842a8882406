"""Widgets: one shared observable design, and parts that show and edit it live (docs/widgets.md)."""

from .solver import (
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
from .studio.model import Draft, FacadeModel, Selection
from .studio.parts import (
    CanvasEditor,
    CounterEditor,
    ElevationView,
    LayerEditor,
    Part,
    PatternEditor,
    SymbolEditor,
    Toolbar,
)
from .studio.studio import MassingView, Studio
from .texture import GrammarEditor, GrammarTable, PixelInspector, TextureModel, TextureStudio, TextureView
from .town import PipelineView, TownModel, TownProgress, TownView

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
    "PipelineView",
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
    "TownModel",
    "TownProgress",
    "TownView",
    "TraceModel",
    "TraceView",
    "WordsView",
]
