"""facade_nb: procedural façades designed in layers, solved, seen and rendered in a notebook.

>>> from facade_nb import gallery, solve
>>> layout = solve(gallery.load("residential-house"))
"""

from typing import TYPE_CHECKING

from . import display as display  # registers how designs and layouts show themselves
from .design import Design, DesignError, NoLayout
from .solver import Layout, solve

if TYPE_CHECKING:
    from .building import Building
    from .comparison import complexity
    from .variations import contact_sheet, sweep, vary

__all__ = [
    "Building",
    "Design",
    "DesignError",
    "Layout",
    "NoLayout",
    "__version__",
    "complexity",
    "contact_sheet",
    "gallery",
    "solve",
    "sweep",
    "vary",
]
__version__ = "0.1.0"


def __getattr__(name: str) -> object:  # loaded when asked for, so that importing the solver stays quick
    if name == "gallery":
        import facade_nb.gallery as gallery

        return gallery
    if name == "Building":
        from .building import Building

        return Building
    if name == "complexity":
        from .comparison import complexity

        return complexity
    if name in ("contact_sheet", "sweep", "vary"):
        from . import variations

        return getattr(variations, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
