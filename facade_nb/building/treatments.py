"""Designs for corners that suit many buildings: quoins, and the façade of a cut corner with a door."""

from __future__ import annotations

from ..design.model import Design

__all__ = ["chamfer", "quoins"]


def quoins(
    *,
    long: float = 0.75,
    short: float = 0.45,
    course: float = 0.35,
    material: str = "stone",
    projection: float = 0.04,
) -> Design:
    """Stones at a corner, long and short by turns: what is long on one wall is short on the other.

    Parameters
    ----------
    long, short
        Along a wall, metres.
    course
        Preferred height of a stone. Courses fill the wall from bottom to top.
    projection
        How far they stand before the wall, metres.
    """
    pad = max(long - short, 0.01)
    stone = {"kind": "quoin", "geometry": "box", "material": material, "offset": projection}
    hidden = {"visible": False}
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": "Quoins",
            "canvas": {"width": 2 * (short + pad), "height": 3.0},
            "symbols": {
                "L": {"size": short + pad},
                "S": {"size": short},
                "p": {"size": pad},
                "Q": {"size": course},
                "q": {"size": course},
            },
            "patterns": {"left": "L S p", "right": "p S L", "courses": "(Qq)^r | (Qq)^r Q"},
            "layers": [
                {
                    "name": name,
                    "x": {"pattern": name, "mask": ["L", "S"], "group": name},
                    "y": {"pattern": "courses", "mask": [rows], "group": "courses"},
                }
                for name, rows in (("left", "Q"), ("right", "q"))
            ],
            "shapes": {"* *": stone, "p *": hidden},
        }
    )


def chamfer(
    *,
    width: float = 2.6,
    ground: float = 3.4,
    storey: float = 3.0,
    material: str = "plaster",
    base: str = "stone",
) -> Design:
    """The façade of a cut corner: a door below, a window in each storey.

    Parameters
    ----------
    width
        Of the cut, metres.
    ground, storey
        Preferred heights; the building's floors decide.
    material, base
        Of its wall above and at the ground.
    """
    pier = width / 4
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": "Cut corner",
            "canvas": {"width": width, "height": ground + 2 * storey},
            "symbols": {
                "A": {"size": pier},
                "B": {"size": width - 2 * pier},
                "G": {"size": ground},
                "W": {"size": storey * 0.55},
                "P": {"size": storey * 0.3},
                "H": {"size": storey * 0.15},
            },
            "patterns": {"across": "A B A", "up": "G (P W H)^n"},
            "layers": [{"name": "corner", "x": {"pattern": "across"}, "y": {"pattern": "up"}}],
            "shapes": {
                "* *": {"kind": "wall", "geometry": "box", "material": material, "thickness": 0.35},
                "* G": {"kind": "wall", "material": base},
                "B G": {"kind": "door", "geometry": "door", "material": "oak"},
                "B W": {"kind": "window", "geometry": "window", "material": "painted-wood"},
            },
        }
    )
