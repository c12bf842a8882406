"""Many designs at once: every combination of values (`sweep`), and random ones by seed (`vary`, `solve_each`)."""

from .chance import vary
from .sheet import contact_sheet
from .sweep import solve_each, sweep

__all__ = ["contact_sheet", "solve_each", "sweep", "vary"]
