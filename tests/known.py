"""Designs of the gallery that the long tests of the solver, of files and of compiled grammars are run on."""

from __future__ import annotations

from facade_nb import gallery

__all__ = ["FEW", "TELLING"]

_ALIKE = {"bookshop", "hotel", "kongresshaus", "terraced-house"} | {
    f"ingolstadt-{building}" for building in ("4018128", "4018154", "4018204c", "4018257", "4018262")
}
"""Those that would tell nothing that others of their kind do not; tests/gallery solves and draws them as well.

Of the three largest, which take the most time by far, the concert hall stays.
"""

TELLING = [name for name in gallery.names() if name not in _ALIKE]
"""The others, in alphabetical order."""

FEW = ["concert-hall", "figure-7", "ingolstadt-4018215", "qualifiers-a", "residential-house"]
"""One of each kind, for what is made of a layout once it is there: its files, its grammar."""
