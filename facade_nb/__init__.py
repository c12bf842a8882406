"""facade_nb: procedural façades designed in layers, solved, seen and rendered in a notebook.

>>> from facade_nb import gallery, solve
>>> layout = solve(gallery.load("residential-house"))
"""

from .design import Design, DesignError, NoLayout
from .solver import Layout, solve

__all__ = ["Design", "DesignError", "Layout", "NoLayout", "__version__", "gallery", "solve"]
__version__ = "0.1.0"


def __getattr__(name: str) -> object:
    if (
        name == "gallery"
    ):  # sits above solver; loaded when asked for, so that importing the solver stays quick
        from importlib import import_module

        return import_module(".gallery", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
