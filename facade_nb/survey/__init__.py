"""Surveyed openings of real buildings: their files, how near a layout comes, designs made from them (docs/surveys.md).

>>> from facade_nb import gallery, solve
>>> from facade_nb.survey import compare, load_survey
>>> survey = load_survey("4018215")  # doctest: +SKIP
>>> round(compare(solve(gallery.load("ingolstadt-4018215")), survey.openings), 3)  # doctest: +SKIP
0.867
"""

from .comparison import Pair, compare, match
from .inference import infer
from .openings import OPENING_KINDS, SurveyError
from .reading import Survey, buildings, load_survey

__all__ = [
    "OPENING_KINDS",
    "Pair",
    "Survey",
    "SurveyError",
    "buildings",
    "compare",
    "infer",
    "load_survey",
    "match",
]
