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
from .visible import AnalysisView, FacadeView, TraceModel, TraceView, WordsView

__all__ = [
    "AnalysisView",
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
    "Selection",
    "Studio",
    "SymbolEditor",
    "Toolbar",
    "TraceModel",
    "TraceView",
    "WordsView",
]
