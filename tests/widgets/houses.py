"""A small house to edit in tests: two layers, a mask, a counter."""

from __future__ import annotations

from facade_nb import Design

__all__ = ["HOUSE", "house"]

HOUSE = {
    "format": "facade-nb/design/1",
    "name": "Test house",
    "canvas": {"width": 6.0, "height": 3.0},
    "symbols": {
        "A": {"size": 1.0},
        "B": {"size": 0.8, "unoccludable": True},
        "P": {"size": 1.6},
        "Q": {"size": 1.4},
        "C": {"size": 0.3, "opaque": False},
    },
    "patterns": {"Bx": "A(BA)^k", "By": "PQ", "Cx": "cec; c := C"},
    "layers": [
        {"name": "base", "x": {"pattern": "Bx"}, "y": {"pattern": "By"}},
        {"name": "columns", "x": {"pattern": "Cx"}, "y": {"pattern": "By", "mask": ["P"]}},
    ],
    "shapes": {
        "* *": {"material": "brick"},
        "B *": {"kind": "window", "geometry": "window", "material": "wood"},
    },
}


def house() -> Design:
    """The house, anew."""
    return Design.from_dict(HOUSE)
