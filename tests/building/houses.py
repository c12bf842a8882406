"""Designs and buildings that tests share; small, so that they are solved in a moment."""

from __future__ import annotations

from functools import cache

from facade_nb.building import Building, BuildingLayout
from facade_nb.building.treatments import chamfer, quoins
from facade_nb.design import Design


def house(name: str, floors: str, sizes: dict[str, float], door: str, window: str) -> Design:
    """Bays of piers and openings; `floors` is its pattern along y, `door` and `window` the rows of openings."""
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": name,
            "canvas": {"width": 9.0, "height": 9.9},
            "symbols": {"A": {"size": 0.9}, "B": {"size": 1.2}}
            | {symbol: {"size": size} for symbol, size in sizes.items()},
            "patterns": {"bays": "A(BA)^k", "floors": floors},
            "layers": [{"name": "wall", "x": {"pattern": "bays"}, "y": {"pattern": "floors"}}],
            "shapes": {
                "* *": {"kind": "wall", "geometry": "box", "material": "plaster", "thickness": 0.3},
                f"B {door}": {"kind": "door", "geometry": "door"},
                f"B {window}": {"kind": "window", "geometry": "window"},
                "* K": {"kind": "cornice", "geometry": "cornice", "offset": 0.3},
            },
        }
    )


FRONT = house("Front", "G(VW)^nK", {"G": 3.4, "V": 1.2, "W": 1.8, "K": 0.5}, "G", "W")
"""Alone it is 9.9 m high to the centimetre: 3.4 + 2 · 3.0 + 0.5."""

SIDE = house("Side", "H(UX)^mK", {"H": 4.0, "U": 1.3, "X": 1.6, "K": 0.4}, "H", "X")
"""Alone it would have its first floor at 4.0 m."""


@cache
def corner_house() -> BuildingLayout:
    """An L: fronts to the streets, sides to the yard, a cut corner with a door, quoins, a party wall behind."""
    walls = {"front": FRONT, "left": FRONT, "right": SIDE, "yard": SIDE, "wing": SIDE}
    corners = {0: ("chamfer", chamfer(width=2.4)), 1: ("quoins", quoins())}
    return Building.ell(14.0, 12.0, (7.0, 6.0), walls, height=9.9, corners=corners, name="Corner").solve()
