"""facade_nb: procedural façades designed in layers, solved, seen and rendered in a notebook.

>>> from facade_nb import gallery, solve
>>> layout = solve(gallery.load("residential-house"))
"""

from . import display as display  # registers how designs and layouts show themselves
from .design import Design, DesignError, NoLayout
from .solver import Layout, solve

__all__ = ["Design", "DesignError", "Layout", "NoLayout", "__version__", "gallery", "solve"]
__version__ = "0.1.0"


def __getattr__(name: str) -> object:
    if name == "gallery":  # loaded when asked for, so that importing the solver stays quick
        import facade_nb.gallery as gallery

        return gallery
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
