"""Within which limits numbers of a design lie: far beyond any façade, and what can be computed with.

Lengths are metres. `MAX_LETTERS` and `MAX_WORDS` of `facade_nb.design.tree` bound what patterns make.
"""

from __future__ import annotations

from math import isfinite

from .errors import Fault
from .model import AXES, Counter, Design

__all__ = ["LEAST_LENGTH", "MOST_COUNT", "MOST_LENGTH", "length_fault", "nearest_zero", "range_faults"]

LEAST_LENGTH = 1e-6
"""A micrometre: sizes are compared to a thousandth of it."""

MOST_LENGTH = 1e6
"""A thousand kilometres; offsets and depths lie within as much either way."""

MOST_COUNT = 1_000_000_000
"""Bounds and values of counters lie within so much either way."""


def length_fault(value: float) -> str:
    """What is wrong with a size in metres that is a number; empty where it is within the limits."""
    if not isfinite(value) or value <= 0:
        return f"expected a positive number of metres, found {value!r}"
    if not LEAST_LENGTH <= value <= MOST_LENGTH:
        return f"expected a length from {LEAST_LENGTH:f} to {MOST_LENGTH:,.0f} m, found {value!r}"
    return ""


def range_faults(design: Design) -> list[Fault]:
    """Numbers out of range in a design that was not read from a document, which is checked already."""
    lengths = [
        (f"canvas.{field}", design.canvas.along(axis))
        for field, axis in zip(("width", "height"), AXES, strict=True)
    ]
    for name, symbol in design.symbols.items():
        own = ((f"symbols.{name}.{field}", getattr(symbol, field)) for field in ("size", "min", "max"))
        lengths += [(place, value) for place, value in own if value is not None]
    faults = [Fault(place, fault) for place, value in lengths if (fault := length_fault(value))]
    for name, counter in design.counters.items():
        for field in ("min", "max", "value"):
            value = getattr(counter, field)
            if value is not None and abs(value) > MOST_COUNT:
                faults.append(
                    Fault(
                        f"counters.{name}.{field}", f"expected at most {MOST_COUNT:,} either way, found more"
                    )
                )
    return faults


def nearest_zero(counter: Counter) -> int:
    """The value nearest to 0 that a counter may have."""
    if counter.value is not None:
        return counter.value
    if counter.min > 0:
        return counter.min
    return 0 if counter.max is None else min(0, counter.max)
