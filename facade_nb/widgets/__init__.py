"""Widgets: one shared observable design, and parts that show and edit it live (docs/widgets.md).

Each is imported when it is first asked for: a town does not wait for the studio.
"""

from typing import TYPE_CHECKING

from .lazily import lazily

if TYPE_CHECKING:
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

_ROOMS: dict[str, tuple[str, ...]] = {
    ".solver": (
        "AlignmentView",
        "AnalysisView",
        "CandidatesView",
        "CodeView",
        "FacadeView",
        "NetworkView",
        "PlayerView",
        "QualifiersView",
        "RunsView",
        "SizingView",
        "SolverView",
        "TraceModel",
        "TraceView",
        "WordsView",
    ),
    ".studio.around": ("BuildingStudio",),
    ".studio.building": ("BuildingView",),
    ".studio.massing_view": (
        "MassingView",
        "layout_mesh",
    ),
    ".studio.model": (
        "Draft",
        "FacadeModel",
        "Selection",
    ),
    ".studio.parts": (
        "CanvasEditor",
        "CounterEditor",
        "ElevationView",
        "LayerEditor",
        "Part",
        "PatternEditor",
        "ShapeEditor",
        "SymbolEditor",
        "Toolbar",
    ),
    ".studio.studio": ("Studio",),
    ".survey": (
        "SurveyEditor",
        "SurveyModel",
    ),
    ".texture": (
        "GrammarEditor",
        "GrammarTable",
        "PixelInspector",
        "TextureModel",
        "TextureStudio",
        "TextureView",
    ),
    ".town": (
        "PipelineView",
        "TownModel",
        "TownProgress",
        "TownView",
    ),
    ".variations": (
        "VariationsModel",
        "VariationsView",
    ),
}
"""Where each is."""


__getattr__ = lazily(__name__, _ROOMS)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
