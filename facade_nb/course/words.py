"""The words of a pattern, short."""

from __future__ import annotations

from ..solver import words

__all__ = ["listed"]

_SIZES = dict.fromkeys("ABCDEFG", 1.0)


def listed(pattern: str, **most: int) -> list[str]:
    """The words of a pattern without blanks, its counters from 0 to a value: ``listed("A(BA)^k", k=2)``.

    Letters A to G are seen; others are placeholders.
    """
    bounds = {name: (0, value) for name, value in most.items()}
    found = words(pattern, _SIZES, canvas=100.0, tolerance=100.0, counters=bounds)
    return [str(word).replace(" ", "") for word in found]
