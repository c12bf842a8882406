"""Layouts made by hand, so that drawing is tested without solving."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from facade_nb.design.model import Canvas
from facade_nb.solver.model.layout import Layout, PlacedShape

Looks = dict[str, object]


def layer(
    name: str,
    xs: Sequence[tuple[str, float]],
    ys: Sequence[tuple[str, float]],
    looks: dict[str, Looks],
    *,
    only: Iterable[str] | None = None,
    start: tuple[float, float] = (0.0, 0.0),
) -> list[PlacedShape]:
    """The cells of two words of (symbol, size); `looks` by ``"X Y"`` with wildcards; `only` keeps these pairs."""
    shapes: list[PlacedShape] = []
    bottom = start[1]
    for y, height in ys:
        left = start[0]
        for x, width in xs:
            if only is None or f"{x} {y}" in only:
                look: Looks = {}
                for key in ("* *", f"* {y}", f"{x} *", f"{x} {y}"):
                    look |= looks.get(key, {})
                rect = (left, bottom, left + width, bottom + height)
                shapes.append(PlacedShape(name, x, y, rect, **look))  # type: ignore[arg-type]
            left += width
        bottom += height
    return shapes


def house() -> Layout:
    """The residential house of the paper: walls and windows on two floors, columns, a door, a roof."""
    a, b = 0.92, 0.7733333333333333
    base = layer(
        "base",
        [("A", a), ("B", b), ("A", a), ("B", b), ("A", a), ("B", b), ("A", a)],
        [("P", 1.6), ("Q", 1.4)],
        {
            "* *": {"material": "plaster"},
            "* P": {"material": "brick"},
            "B P": {"kind": "window", "geometry": "window", "material": "painted-wood"},
            "B Q": {"kind": "window", "geometry": "window", "material": "painted-wood"},
        },
    )
    columns = layer(
        "columns",
        [("C", 0.3), ("e", 5.4), ("C", 0.3)],
        [("P", 1.6)],
        {
            "C P": {
                "kind": "column",
                "geometry": "column",
                "material": "stone",
                "offset": 0.3,
                "thickness": 0.3,
            }
        },
        only=["C P"],
    )
    door = layer(
        "door",
        [("f", 2.55), ("D", 0.9), ("f", 2.55)],
        [("P", 1.6)],
        {"D P": {"kind": "door", "geometry": "door", "material": "oak"}},
        only=["D P"],
    )
    roof = layer(
        "roof",
        [("H", 6.0)],
        [("R", 1.3)],
        {"* *": {"kind": "roof", "geometry": "roof", "material": "tiles"}},
        start=(0, 3.0),
    )
    return Layout("Residential house", Canvas(6.0, 4.3), {"k": 3}, shapes=(*base, *columns, *door, *roof))


def apartment() -> Layout:
    """A larger house, 21 by 10 metres, of about 150 shapes in four layers."""
    xs = [("G", 0.5), ("C", 0.925), *[("A", 0.95), ("B", 1.2)] * 8, ("A", 0.95), ("C", 0.925), ("G", 0.5)]
    ys = [
        ("Z", 3.0),
        ("Y", 0.3),
        ("V", 0.6),
        ("W", 1.7),
        ("V", 0.6),
        ("W", 1.7),
        ("X", 0.6),
        ("U", 0.5),
        ("T", 1.0),
    ]
    plain = {"material": "plaster-ochre"}
    base = layer(
        "base",
        xs,
        ys,
        {
            "* *": plain,
            "* Z": {"material": "ashlar"},
            "* Y": {"geometry": "ledge", "material": "stone"},
            "G *": {"material": "stone", "offset": 0.08},
            "G Y": {"geometry": "ledge", "material": "stone", "offset": 0.16},
            "B W": {"kind": "window", "geometry": "window", "material": "painted-wood"},
            "B V": {"geometry": "panel", "material": "plaster-ochre"},
            "* U": {"geometry": "cornice", "material": "stone"},
            "* T": {"geometry": "pitched", "material": "tiles"},
        },
    )
    base = [s for s in base if s.y not in ("T", "Z", "U")]
    base += layer(
        "base",
        [("H", 21.0)],
        [("U", 0.5)],
        {"* *": {"geometry": "cornice", "material": "stone", "offset": 0.4}},
        start=(0, 8.5),
    )
    base += layer(
        "base", [("H", 21.0)], [("T", 1.0)], {"* *": {"geometry": "hip", "material": "slate"}}, start=(0, 9.0)
    )
    ground = layer(
        "ground floor",
        [
            ("D", 0.65625),
            *[("E", 2.4), ("D", 0.65625)] * 3,
            ("F", 1.35),
            ("D", 0.65625),
            *[("E", 2.4), ("D", 0.65625)] * 3,
        ],
        [("Z", 3.0)],
        {
            "* *": {"material": "ashlar"},
            "E *": {"kind": "window", "geometry": "shop", "material": "painted-green"},
            "F *": {"kind": "door", "geometry": "door", "material": "oak"},
        },
    )
    balconies = layer(
        "balconies",
        [("g", 4.425), ("L", 3.55), ("g", 5.05), ("L", 3.55), ("g", 4.425)],
        [("z", 3.9), ("W", 1.7), ("z", 0.6), ("W", 1.7)],
        {
            "L W": {
                "kind": "balcony",
                "geometry": "balcony",
                "offset": 0.8,
                "thickness": 0.8,
                "material": "stone",
            }
        },
        only=["L W"],
    )
    return Layout(
        "Apartment house", Canvas(21.0, 10.0), {"k": 8, "l": 2}, shapes=(*base, *ground, *balconies)
    )
