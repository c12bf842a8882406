"""A learner's own code in the solver: run inside the paper's search, and compared with it (docs/experiments.md)."""

from .cases import Case
from .checking import Verdict, check
from .functions import ExperimentError
from .outcome import Counterexample, Experiment, Run
from .running import experiment
from .views import Choice, Column, Node, Pass, Visit
from .weighing import Weighed, WeighedColumn, weigh

__all__ = [
    "Case",
    "Choice",
    "Column",
    "Counterexample",
    "Experiment",
    "ExperimentError",
    "Node",
    "Pass",
    "Run",
    "Verdict",
    "Visit",
    "Weighed",
    "WeighedColumn",
    "check",
    "experiment",
    "weigh",
]
