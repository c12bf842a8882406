"""The reflection modes of counts (Table 1 of the supplement): their signs, and the words that they make.

All that is known of a mode by its letters stands here. `solver.analysis.terms` has the same for counters left open.
"""

from __future__ import annotations

from collections.abc import Mapping

__all__ = ["MODES", "SYNONYMS", "Spelling", "mirrored", "repeated", "shared"]

Spelling = tuple[tuple[str, bool], ...]
"""A word as (symbol, mirrored) pairs."""

MODES: Mapping[str, str] = {
    "": "none",
    "~": "normal inner",
    "|": "normal outer",
    ".": "pivot inner",
    ":": "pivot outer",
    "@": "pivot total",
}
"""Reflection modes by the sign that stands after ``^``, with their names."""

SYNONYMS: Mapping[str, str] = {"·": ".", "∘": ":", "⊙": "@"}
"""The signs that the paper prints, where a keyboard has others."""


def mirrored(word: Spelling) -> Spelling:
    """The word reversed, every letter mirrored; a mirrored letter becomes a normal one."""
    return tuple((symbol, not flag) for symbol, flag in reversed(word))


def shared(mode: str, k: int) -> int:
    """How many letters of `k` copies and their mirror images stand for two: the pivots."""
    return {".": k, ":": k - 1, "@": 2 * k - 1}.get(mode, 0)


def repeated(w: Spelling, mode: str, k: int) -> Spelling:
    """`k` copies of `w`, one at least, joined with their mirror images as a mode says.

    A pivot, shared by a copy and its mirror image, comes from the copy and is not mirrored.
    """
    if not mode:
        return w * k
    v = mirrored(w)
    match mode:
        case "~":
            return (w + v) * k
        case "|":
            return w * k + v * k
        case ".":
            return (w + v[1:]) * k
        case ":":
            return (w + v[:-1]) * (k - 1) + w + v
        case "@":
            return (w + v[1:-1]) * (k - 1) + w + v[1:]
        case _:
            raise ValueError(f"expected one of the modes {' '.join(MODES)}; found {mode!r}")
