"""The solver made visible: steppable, linked views of a trace (docs/visible.md)."""

from .analysis import AnalysisView
from .candidates import CandidatesView
from .facade import FacadeView
from .model import TraceModel
from .page import SolverView
from .player import PlayerView
from .qualifiers import QualifiersView
from .view import TraceView
from .words import WordsView

__all__ = [
    "AnalysisView",
    "CandidatesView",
    "FacadeView",
    "PlayerView",
    "QualifiersView",
    "SolverView",
    "TraceModel",
    "TraceView",
    "WordsView",
]
