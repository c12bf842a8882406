"""Elements: what one word may put into a column (the paper's 5.2, its a_ij)."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Option", "Position"]

Position = int
"""Where a band stands: ``8·i + 4·mid + 2·gap + held``.

- i: the next letter;
- mid: letter i is cut, and its rest is still to come;
- gap: the column before was empty here and letter i is attached, so it may not begin the next column (C4);
- held: the last element ended with an attached letter, so the next column may not be empty here (C4).
"""


@dataclass(slots=True, eq=False)
class Option:
    """One element a band may put into a column. Never changed, but made too often to be checked for that.

    Attributes
    ----------
    target
        The band's position after the column.
    empty, transparent
        Kind of the element; neither: solid.
    size
        Its size in metres; None: elastic (it holds a piece of a cut letter, or an unsized letter).
    least
        The size of its whole sized letters; of an elastic element, less than its size.
    loose
        Σ over neighbouring solid letters of the smaller size, metres.
    soft
        Solid, with a letter that is not opaque.
    opaque
        Solid, with every letter opaque.
    guarded
        Holds a solid unoccludable letter.
    begins, ends
        A letter starts at its left edge; a letter ends at its right edge.
    letters
        Indices into the band's word of the letters, or pieces, in it.
    tied
        Elastic, and some piece in it answers to an equation (a fixed size, or a size shared with other
        letters).
    sized
        The size of the letter that ends a transparent element, where it has one.
    """

    target: Position
    empty: bool = False
    transparent: bool = False
    size: float | None = 0.0
    loose: float = 0.0
    soft: bool = False
    opaque: bool = False
    guarded: bool = False
    begins: bool = False
    ends: bool = False
    letters: tuple[int, ...] = ()
    tied: bool = False
    sized: float | None = None
    least: float = 0.0
