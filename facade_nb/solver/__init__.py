"""From a design to a layout: words, candidates, alignment, sizing (the paper's section 5)."""

from importlib import import_module
from typing import TYPE_CHECKING

from .alignment import Alignment, align
from .layout import Layout
from .letters import Letter, Word
from .objective import Objective
from .solving import solve
from .words import words

if TYPE_CHECKING:
    from .tracing import Trace

__all__ = ["Alignment", "Layout", "Letter", "Objective", "Trace", "Word", "align", "solve", "words"]


def __getattr__(name: str) -> object:
    if name == "Trace":  # its many kinds of events are loaded when somebody reads them
        return import_module(".tracing", __name__).Trace
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
