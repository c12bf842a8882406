"""The solver made visible: steppable, linked views of a trace (docs/visible.md)."""

from .analysis import AnalysisView
from .facade import FacadeView
from .model import TraceModel
from .view import TraceView
from .words import WordsView

__all__ = ["AnalysisView", "FacadeView", "TraceModel", "TraceView", "WordsView"]
