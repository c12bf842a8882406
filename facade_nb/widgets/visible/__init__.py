"""The solver made visible: steppable, linked views of a trace (docs/visible.md)."""

from .facade import FacadeView
from .model import TraceModel
from .view import TraceView
from .words import WordsView

__all__ = ["FacadeView", "TraceModel", "TraceView", "WordsView"]
