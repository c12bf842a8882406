"""The town in the notebook, and the pipeline that draws it, buffer by buffer (docs/town-widgets.md)."""

from .model import TownModel
from .progress import TownProgress
from .view import PipelineView, TownView

__all__ = ["PipelineView", "TownModel", "TownProgress", "TownView"]
