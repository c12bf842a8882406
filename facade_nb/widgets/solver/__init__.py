"""The solver made visible: steppable, linked views of a trace (docs/visible.md)."""

from typing import TYPE_CHECKING

from ..lazily import lazily

if TYPE_CHECKING:
    from .alignment import AlignmentView
    from .analysis import AnalysisView
    from .candidates import CandidatesView
    from .facade import FacadeView
    from .model import TraceModel
    from .network import NetworkView
    from .page import SolverView
    from .player import PlayerView
    from .qualifiers import QualifiersView
    from .sizing import SizingView
    from .view import TraceView
    from .words import WordsView

__all__ = [
    "AlignmentView",
    "AnalysisView",
    "CandidatesView",
    "FacadeView",
    "NetworkView",
    "PlayerView",
    "QualifiersView",
    "SizingView",
    "SolverView",
    "TraceModel",
    "TraceView",
    "WordsView",
]

__getattr__ = lazily(
    __name__,
    {
        ".alignment": ("AlignmentView",),
        ".analysis": ("AnalysisView",),
        ".candidates": ("CandidatesView",),
        ".facade": ("FacadeView",),
        ".model": ("TraceModel",),
        ".network": ("NetworkView",),
        ".page": ("SolverView",),
        ".player": ("PlayerView",),
        ".qualifiers": ("QualifiersView",),
        ".sizing": ("SizingView",),
        ".view": ("TraceView",),
        ".words": ("WordsView",),
    },
)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
