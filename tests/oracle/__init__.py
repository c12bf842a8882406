"""An independent answer to what `facade_nb.solver.align` computes: docs/problem.md, slow and plain."""

from .alignment import Best, TooBig, best
from .cases import Case, make_case
from .checking import Drawn, check, drawn, measure
from .pricing import DEFAULT, PAPER, Price, Task, Weights, positive, price
from .structures import Group, enumerate_structures

__all__ = [
    "DEFAULT",
    "PAPER",
    "Best",
    "Case",
    "Drawn",
    "Group",
    "Price",
    "Task",
    "TooBig",
    "Weights",
    "best",
    "check",
    "drawn",
    "enumerate_structures",
    "make_case",
    "measure",
    "positive",
    "price",
]
