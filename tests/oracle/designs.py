"""Small designs: written down shortly, or random ones with shared counters, groups, substitutions, every qualifier."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from typing import Any

from facade_nb.design import Design

__all__ = ["FILL", "design", "make_design"]

FILL = {"H": 2.0}
"""A symbol that fills the height of the canvas of `design`, so that only the width is at stake."""


def design(
    symbols: Mapping[str, Any],
    patterns: Mapping[str, Any],
    layers: Sequence[str | tuple[str, ...]],
    width: float = 4.0,
    height: float = 2.0,
    **sections: Any,
) -> Design:
    """Return a design; layers are listed from the top: pattern across, group across, pattern up, group up.

    What is missing has its default: group ``g``, and up a pattern ``h`` of one letter H that fills the height. Symbols
    may be given by their sizes alone.
    """
    given = [(own,) if isinstance(own, str) else own for own in layers]
    rows = [(*own, *("", "g", "h", "g")[len(own) :]) for own in given]
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "canvas": {"width": width, "height": height},
            "symbols": {
                name: own if isinstance(own, dict) else {"size": own}
                for name, own in (FILL | dict(symbols)).items()
            },
            "patterns": {"h": "H", **patterns},
            "layers": [
                {"name": f"L{n}", "x": {"pattern": x, "group": across}, "y": {"pattern": y, "group": up}}
                for n, (x, across, y, up) in reversed(list(enumerate(rows)))
            ],
            **sections,
        }
    )


SOLID = [
    "AB", "A^k", "A(BA)^k", "A(A|B)A", "A^kB", "AB^k", "A^kB^l", "(AB)^-k", "A^~k", "(AB)^.k", "CC|AB|B^3", "ACA",
    "(C|ε)A^k", "BCB", "A'BA", "C^k", "B^lA", "A^k|B^k|C^k",
]  # fmt: skip
CONTROL = [
    "{e}m{e}; m := {c}",
    "m{e}m; m := {c}",
    "{e}m; m := {c}",
    "{e}m{f}; m := {c}",
    "m^2; m := {c}",
    "{e}{e}m; m := {c}",
    "Am{e}; m := {c}",
    "m{e}m'; m := {c}",
]
CONTENT = ["A", "B", "AB", "B^k", "C", "A|B", "CB"]
STANDING = ["mt; t := B", "tm; t := C", "mtm; t := A|B"]


def make_design(seed: int) -> Design:
    """One design. Its unsized symbols stand in patterns of one group each, so that groups can be solved one by one."""
    pick = random.Random(seed).choice
    grid = pick([True, True, False])
    sizes = [0.5, 1.0, 1.0, 1.5, 2.0] if grid else [0.7, 0.83, 1.13, 1.4, 1.93]
    symbols: dict[str, Any] = {}
    for name in "ABC":
        symbols[name] = own = {"size": pick(sizes)}
        if pick([False] * 4 + [True]):
            own |= {"opaque": False, "placement": pick(["center", "left", "right"])}
        for quality in ("attached", "unoccludable"):
            if pick([False] * 5 + [True]):
                own[quality] = True
        if pick([False] * 9 + [True]):
            own |= pick([{"min": round(own["size"] * 0.9, 3)}, {"max": round(own["size"] * 1.1, 3)}])
    counters: dict[str, Any] = {}
    for name in "kl":
        counters[name] = pick(
            [{}, {"min": 1}, {"min": 1, "max": 3}, {"min": -2, "max": 1}, {"value": 2}, {"max": 3}, {}]
        )
    two = pick([False, False, True])
    patterns: dict[str, Any] = {}
    stacks: dict[str, list[tuple[str, str]]] = {}
    layers = pick([1, 2, 2, 2, 3, 3, 4])
    for axis in "xy":
        own_groups = ["a", "b"] if two and axis == "x" else ["a"]
        known: dict[str, list[str]] = {group: [] for group in own_groups}
        rows: list[tuple[str, str]] = []
        substituted = False
        for place in range(layers):
            group = pick(own_groups)
            everywhere = [name for names in known.values() for name in names]
            solid_only = [name for name in everywhere if ":=" not in patterns[name]]
            if axis == "y":
                text = "A^n" if place == 0 else ""
                if place == 0 and pick([False, True]):
                    text = pick(["A^k", "A(BA)^k", "A^kB", "B^l|A^n"])
            elif everywhere and pick([False] * 3 + [True]):
                text = ""
            elif place < layers - 1 and pick([False, False, True]):
                e, f = (f"{letter}{place}" for letter in "ef")
                text = pick(CONTROL).format(e=e, f=f, c=pick(CONTENT))
                substituted = True
            elif substituted and place < layers - 1 and pick([False] * 3 + [True]):
                text = pick(STANDING)
            else:
                text = pick(SOLID)
            if text:
                name = f"{axis}{place}"
                patterns[name] = text
                known[group].append(name)
            else:
                name = pick(solid_only or everywhere)
                if name not in solid_only:
                    group = next(own for own, names in known.items() if name in names)
            rows.append((name, group))
        stacks[axis] = rows
    document = {
        "format": "facade-nb/design/1",
        "canvas": {"width": pick([2.0, 3.0, 3.5, 4.0]), "height": pick([1.5, 2.0, 2.3])},
        "symbols": symbols,
        "counters": counters,
        "patterns": patterns,
        "layers": [
            {
                "name": f"L{place}",
                "x": {"pattern": stacks["x"][place][0], "group": stacks["x"][place][1]},
                "y": {"pattern": stacks["y"][place][0]},
            }
            for place in reversed(range(layers))
        ],
    }
    return Design.from_dict(document)
