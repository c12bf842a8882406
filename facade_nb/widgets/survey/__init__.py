"""The widget in which a façade is drawn by hand, as rectangles over a photograph."""

from .model import SurveyModel
from .view import SurveyEditor

__all__ = ["SurveyEditor", "SurveyModel"]
