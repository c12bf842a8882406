"""From a design to a layout: words, candidates, alignment, sizing (the paper's section 5)."""

from .alignment import Alignment, align
from .layout import Layout
from .letters import Letter, Word
from .objective import Objective
from .solving import solve
from .words import words

__all__ = ["Alignment", "Layout", "Letter", "Objective", "Word", "align", "solve", "words"]
