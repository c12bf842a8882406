"""Many designs at once: every combination of values (`sweep`), and random ones by seed (`vary`)."""

from .chance import vary
from .sheet import contact_sheet
from .sweep import sweep

__all__ = ["contact_sheet", "sweep", "vary"]
