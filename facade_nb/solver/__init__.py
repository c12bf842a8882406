"""From a design to a layout: words, candidates, alignment, sizing (the paper's section 5)."""

from typing import TYPE_CHECKING

from .alignment.single import Alignment, align
from .model.layout import Layout
from .model.letters import Letter, Word
from .model.objective import Objective
from .solution import solve
from .words.enumeration import words

if TYPE_CHECKING:
    from .trace.trace import Trace

__all__ = ["Alignment", "Layout", "Letter", "Objective", "Trace", "Word", "align", "solve", "words"]


def __getattr__(name: str) -> object:
    if name == "Trace":  # its many kinds of events are loaded when somebody reads them
        from .trace.trace import Trace

        return Trace
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
