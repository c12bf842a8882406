"""Widgets: one shared observable design, and parts that show and edit it live (docs/widgets.md)."""

from .solver import (
    AlignmentView,
    AnalysisView,
    CandidatesView,
    CodeView,
    FacadeView,
    NetworkView,
    PlayerView,
    QualifiersView,
    RunsView,
    SizingView,
    SolverView,
    TraceModel,
    TraceView,
    WordsView,
)
from .studio.around import BuildingStudio
from .studio.building import BuildingView
from .studio.massing_view import MassingView, layout_mesh
from .studio.model import Draft, FacadeModel, Selection
from .studio.parts import (
    CanvasEditor,
    CounterEditor,
    ElevationView,
    LayerEditor,
    Part,
    PatternEditor,
    ShapeEditor,
    SymbolEditor,
    Toolbar,
)
from .studio.studio import Studio
from .survey import SurveyEditor, SurveyModel
from .texture import GrammarEditor, GrammarTable, PixelInspector, TextureModel, TextureStudio, TextureView
from .town import PipelineView, TownModel, TownProgress, TownView
from .variations import VariationsModel, VariationsView

__all__ = [
    "AlignmentView",
    "AnalysisView",
    "BuildingStudio",
    "BuildingView",
    "CandidatesView",
    "CanvasEditor",
    "CodeView",
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
    "RunsView",
    "Selection",
    "ShapeEditor",
    "SizingView",
    "SolverView",
    "Studio",
    "SurveyEditor",
    "SurveyModel",
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
    "VariationsModel",
    "VariationsView",
    "WordsView",
    "layout_mesh",
]
