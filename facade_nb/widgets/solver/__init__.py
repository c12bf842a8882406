"""The solver made visible: steppable, linked views of a trace (docs/visible.md)."""

from .alignment import AlignmentView
from .analysis import AnalysisView
from .candidates import CandidatesView
from .codeview import CodeView
from .facade import FacadeView
from .model import TraceModel
from .network import NetworkView
from .page import SolverView
from .player import PlayerView
from .qualifiers import QualifiersView
from .runs import RunsView
from .sizing import SizingView
from .view import TraceView
from .words import WordsView

__all__ = [
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
]
